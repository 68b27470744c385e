//! A rigid part that follows the mean motion of many nodes.

use std::f64::consts::TAU;

use nalgebra::DMatrix;
use whirl_solver::error::ReductionError;
use whirl_solver::linalg::LinearAlgebraError;
use whirl_solver::mesh::Mesh;
use whirl_solver::reduction::Interface;

use super::rigid::{dense, fields, labels};
use super::{Brick, Bricks, ROUNDING, clean, free, of_body, six_of};

/// Where the mean and the rigid part meet.
const REFERENCE: [f64; 3] = [0.03, 0.02, 0.035];

/// Two plates of n × n cells, and labels of the nodes of the faces that look at each other.
fn plates(n: usize) -> (Bricks, Vec<usize>, Vec<usize>) {
    let plate = |from: f64, to: f64| Brick {
        from: [0.0, 0.0, from],
        to: [0.1, 0.09, to],
        cells: [n, n, 1],
        order: 1,
    };
    let bricks = Bricks::new(&[plate(0.0, 0.02), plate(0.05, 0.07)]);
    let mean = bricks.at(0, |at| at[2] > 0.01);
    let rigid = bricks.at(1, |at| at[2] < 0.06);
    (bricks, mean, rigid)
}

/// The first plate by its mean on one reference node with the second one, as a rigid part; in both orders of Abaqus, and of
/// Nastran.
fn joined((bricks, mean, rigid): &(Bricks, Vec<usize>, Vec<usize>)) -> Vec<Mesh> {
    let [x, y, z] = REFERENCE;
    let surface =
        |name: &str, own: &[usize]| format!("*SURFACE, NAME={name}, TYPE=NODE\n{}", labels(own));
    let coupling = |name: &str, kind: &str| {
        format!("*COUPLING, CONSTRAINT NAME={name}, REF NODE=9000, SURFACE={name}\n*{kind}\n1, 6\n")
    };
    let point =
        format!("*NODE\n9000, {x}, {y}, {z}\n{}{}", surface("MEAN", mean), surface("RIGID", rigid));
    let (spread, rigidly) = (coupling("MEAN", "DISTRIBUTING"), coupling("RIGID", "KINEMATIC"));
    let inp = [format!("{point}{spread}{rigidly}"), format!("{point}{rigidly}{spread}")];
    let mut rbe3 = "RBE3,9001,,9000,123456,1.,123".to_owned();
    for (place, label) in mean.iter().enumerate() {
        rbe3 += if place > 1 && (place + 6) % 8 == 0 { "\n," } else { "," };
        rbe3 += &label.to_string();
    }
    let bdf =
        format!("GRID,9000,,{x:?},{y:?},{z:?}\n{rbe3}\nRBE2,9002,9000,123456{}\n", fields(rigid));
    let mut all: Vec<Mesh> =
        inp.iter().map(|cards| clean(&bricks.inp(["", ""], cards), "plates.inp")).collect();
    all.push(clean(&bricks.bdf("", &bdf), "plates.bdf"));
    all
}

/// Nodes at the far end of the first plate.
fn held(mesh: &Mesh) -> Vec<usize> {
    (0..mesh.nodes().len()).filter(|&node| mesh.nodes()[node][2] < 1e-9).collect()
}

/// ω² with one end held, found within so many bytes.
fn within(mesh: &Mesh, memory: usize) -> Result<Vec<f64>, ReductionError> {
    let held: Vec<usize> =
        held(mesh).iter().flat_map(|node| (0..3).map(move |i| 3 * node + i)).collect();
    let interface = Interface { held: &held, ..Interface::default() };
    let reduced = of_body(mesh, memory, |solid| solid.reduce(&interface, 8))?;
    Ok(reduced.hertz.iter().map(|hertz| (TAU * hertz).powi(2)).collect())
}

fn alike(own: &[f64], known: &[f64]) {
    for (own, known) in own.iter().zip(known) {
        assert!((own / known - 1.0).abs() < ROUNDING, "{own} {known}");
    }
}

/// T by hand: the rigid part moves as the least squares of what the others do have it.
fn by_hand(mesh: &Mesh, mean: &[usize], rigid: &[usize]) -> Vec<f64> {
    // Shifts of 1 and turns of ten radians a metre, so that both are of one order.
    let motions = |own: &[usize]| -> DMatrix<f64> {
        let mut s = DMatrix::zeros(3 * own.len(), 6);
        for (place, label) in own.iter().enumerate() {
            for axis in 0..3 {
                let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
                let at = |k: usize| 10.0 * (mesh.nodes()[label - 1][k] - REFERENCE[k]);
                s[(3 * place + axis, axis)] = 1.0;
                s[(3 * place + j, 3 + axis)] = -at(k);
                s[(3 * place + k, 3 + axis)] = at(j);
            }
        }
        s
    };
    let (of_mean, of_rigid) = (motions(mean), motions(rigid));
    let squares = (of_mean.transpose() * &of_mean).try_inverse().unwrap();
    let follows = of_rigid * squares * of_mean.transpose();
    let still = held(mesh);
    let free: Vec<usize> = (0..mesh.nodes().len())
        .filter(|node| !rigid.contains(&(node + 1)) && !still.contains(node))
        .collect();
    let mut t = DMatrix::zeros(mesh.dof_count(), 3 * free.len());
    for (place, node) in free.iter().enumerate() {
        (0..3).for_each(|i| t[(3 * node + i, 3 * place + i)] = 1.0);
        let Some(own) = mean.iter().position(|label| label - 1 == *node) else { continue };
        for (other, label) in rigid.iter().enumerate() {
            for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
                t[(3 * (label - 1) + i, 3 * place + j)] = follows[(3 * other + i, 3 * own + j)];
            }
        }
    }
    dense(mesh, &t)
}

#[test]
fn a_rigid_part_follows_the_least_squares_of_what_it_hangs_on() {
    let own = plates(2);
    for mesh in joined(&own) {
        assert_eq!(mesh.tie_rows().len(), 3 * own.2.len());
        let found = within(&mesh, usize::MAX).unwrap();
        alike(&found, &by_hand(&mesh, &own.1, &own.2));
        six_of(&free(&mesh, 8));
    }
}

/// 169 nodes on either side: multiplied out, T has 507 terms for each of 507 dofs, and a product of two of them for each
/// entry of K among these, some 3 GB of a row, a column and a value for each.
#[test]
fn what_many_nodes_hang_on_takes_little_memory() {
    let all: Vec<Vec<f64>> = joined(&plates(12))
        .iter()
        .map(|mesh| within(mesh, 200 << 20).unwrap_or_else(|error| panic!("{error}")))
        .collect();
    for own in &all {
        alike(own, &all[0]);
    }
    let refused = within(&joined(&plates(12))[0], 20 << 20).unwrap_err();
    let ReductionError::LinearAlgebra(LinearAlgebraError::TooLarge { bytes, limit, .. }) = refused
    else {
        panic!("{refused}")
    };
    assert!(limit == 20 << 20 && bytes > limit && bytes < 200 << 20, "{bytes} {limit}");
}
