//! Nodes that move as one body.

use std::fmt::Write;

use nalgebra::{DMatrix, SymmetricEigen};
use whirl_solver::assembly::assemble;
use whirl_solver::mesh::Mesh;

use super::{Brick, Bricks};
use super::{ROUNDING, alike, clean, free, halves, pairs, six_of, tried};

/// A bar with its ends, by label, and a point beside it.
fn bar() -> (Bricks, Vec<usize>, Vec<usize>) {
    let brick = Brick { from: [0.0; 3], to: [0.02, 0.03, 0.2], cells: [2, 2, 5], order: 1 };
    let bricks = Bricks::new(&[brick]);
    let (low, high) = (bricks.at(0, |at| at[2] < 1e-9), bricks.at(0, |at| at[2] > 0.2 - 1e-9));
    (bricks, low, high)
}

pub(super) fn labels(own: &[usize]) -> String {
    own.iter().map(|label| format!("{label},\n")).collect()
}

pub(super) fn fields(own: &[usize]) -> String {
    let mut text = String::new();
    for (place, label) in own.iter().enumerate() {
        text += if place > 0 && (place + 3) % 8 == 0 { "\n," } else { "," };
        text += &label.to_string();
    }
    text
}

/// ω² by dense matrices, of motions in which these nodes (by index) move as one body about a point.
fn by_hand(mesh: &Mesh, bodies: &[&[usize]]) -> Vec<f64> {
    let size = mesh.dof_count();
    let mut columns: Vec<Vec<(usize, f64)>> = Vec::new();
    for node in (0..mesh.nodes().len()).filter(|node| bodies.iter().all(|own| !own.contains(node)))
    {
        columns.extend((0..3).map(|i| vec![(3 * node + i, 1.0)]));
    }
    for own in bodies {
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            columns.push(own.iter().map(|node| (3 * node + i, 1.0)).collect());
            let turn = |node: &usize| {
                let at = mesh.nodes()[*node];
                [(3 * node + j, -30.0 * at[k]), (3 * node + k, 30.0 * at[j])]
            };
            columns.push(own.iter().flat_map(turn).collect());
        }
    }
    let mut t = DMatrix::zeros(size, columns.len());
    for (j, column) in columns.iter().enumerate() {
        column.iter().for_each(|&(dof, value)| t[(dof, j)] = value);
    }
    dense(mesh, &t)
}

/// ω² of the lowest motions u = T û, by dense matrices.
pub(super) fn dense(mesh: &Mesh, t: &DMatrix<f64>) -> Vec<f64> {
    let size = mesh.dof_count();
    let [k, m] = ["stiffness", "mass"].map(|form| {
        let columns = assemble(mesh, form).unwrap().to_columns();
        let mut own = DMatrix::<f64>::zeros(size, size);
        (0..size).for_each(|j| columns.column(j).for_each(|(i, value)| own[(i, j)] = value));
        own
    });
    let (k, m) = (t.transpose() * k * t, t.transpose() * m * t);
    let inverse = m.cholesky().unwrap().l().try_inverse().unwrap();
    let own = SymmetricEigen::new(&inverse * k * inverse.transpose());
    let mut squares: Vec<f64> = own.eigenvalues.iter().copied().collect();
    squares.sort_by(f64::total_cmp);
    squares.truncate(12);
    squares
}

#[test]
fn spiders_hold_their_nodes_together_as_a_rigid_body() {
    let (bricks, low, high) = bar();
    let index = |own: &[usize]| -> Vec<usize> { own.iter().map(|label| label - 1).collect() };
    let plain = clean(&bricks.inp(["", ""], ""), "bar.inp");
    let known = by_hand(&plain, &[&index(&high)]);
    six_of(&known);
    let unbound = free(&plain, 12);
    assert!(known.iter().zip(&unbound).skip(6).any(|(own, unbound)| *own > 1.001 * unbound));
    // The reference node stands off the axis.
    let point = "*NODE\n900, 0.07, -0.04, 0.31\n";
    let set = format!("*NSET, NSET=END\n{}", labels(&high));
    let surface = format!("*SURFACE, NAME=FACE, TYPE=NODE\n{}", labels(&high));
    let cells: Vec<usize> = (17..21).collect();
    let with_cells = bricks.at(0, |at| at[2] > 0.16 - 1e-9);
    let coupling =
        format!("{point}{surface}*COUPLING, CONSTRAINT NAME=C, REF NODE=900, SURFACE=FACE\n");
    for cards in [
        format!("{coupling}*KINEMATIC\n"),
        format!("{coupling}*KINEMATIC\n1, 3\n4, 6\n"),
        format!("{point}{set}*RIGID BODY, REF NODE=900, NSET=END\n"),
        format!("{point}{set}*KINEMATIC COUPLING, REF NODE=900\nEND, 1, 6\n"),
        // The reference node is one of the nodes.
        format!("{set}*RIGID BODY, REF NODE={}, NSET=END\n", high[4]),
        // Two bodies that share their reference node are one.
        format!(
            "{point}*NSET, NSET=A\n{}*NSET, NSET=B\n{}*RIGID BODY, REF NODE=900, NSET=A\n*RIGID BODY, REF NODE=900, NSET=B\n",
            labels(&high[..4]),
            labels(&high[4..])
        ),
        format!(
            "{point}{}*MPC\n{}",
            "",
            high.iter().map(|label| format!("BEAM, {label}, 900\n")).collect::<String>()
        ),
    ] {
        let read = tried(&bricks.inp(["", ""], &cards), "bar.inp", None);
        let read = read.unwrap_or_else(|errors| panic!("{cards}: {errors}"));
        assert!(read.warnings.is_empty(), "{cards}: {:?}", read.warnings);
        assert_eq!(read.mesh.tie_rows().len(), 3 * high.len() - 6, "{cards}");
        let own = free(&read.mesh, 12);
        six_of(&own);
        alike(&own, &known);
    }
    for cards in [
        format!("GRID,900,,.07,-.04,.31\nRBE2,8,900,123456{}\n", fields(&high)),
        format!("RBE2,8,{},123{}\n", high[0], fields(&high[1..])),
        // A bar between the reference nodes of two spiders makes one body of them.
        format!(
            "GRID,900,,.07,-.04,.31\nGRID,901,,-.05,.02,.4\nRBE2,8,900,123{}\nRBE2,9,901,123{}\nRBAR,10,900,901,123456\n",
            fields(&high[..4]),
            fields(&high[4..])
        ),
        format!("GRID,900,,.07,-.04,.31\n{}", {
            let mut text = String::new();
            for (place, label) in high.iter().enumerate() {
                writeln!(text, "RBAR1,{},900,{label},123", 20 + place).unwrap();
            }
            text
        }),
    ] {
        let mesh = clean(&bricks.bdf("", &cards), "bar.bdf");
        assert_eq!(mesh.tie_rows().len(), 3 * high.len() - 6, "{cards}");
        let own = free(&mesh, 12);
        six_of(&own);
        alike(&own, &known);
    }
    // A node that nothing names is none of them.
    let text = format!("{coupling}*KINEMATIC\n*NODE\n901, 1., 1., 1.\n");
    let warnings = tried(&bricks.inp(["", ""], &text), "bar.inp", None).unwrap().warnings;
    let [warning] = &warnings[..] else { panic!("{warnings:?}") };
    assert!(warning.to_string().contains("1 node in no cell, left out: 901"), "{warning}");
    // The cells of a set, which keep their mass; both ends at once.
    assert_eq!(cells.len(), 4);
    let layer: String = cells.iter().map(|label| format!("{label},\n")).collect();
    let text = format!(
        "{point}*ELSET, ELSET=TOP\n{layer}*RIGID BODY, REF NODE=900, ELSET=TOP\n*NSET, NSET=BASE\n{}*RIGID BODY, REF NODE=1, NSET=BASE\n",
        labels(&low)
    );
    let mesh = tried(&bricks.inp(["", ""], &text), "bar.inp", None).unwrap().mesh;
    let own = free(&mesh, 12);
    six_of(&own);
    alike(&own, &by_hand(&plain, &[&index(&with_cells), &index(&low)]));
}

/// Two halves that are joined by bars askew from the end of one to nodes within the other.
#[test]
fn a_bar_keeps_the_distance_of_nodes_that_do_not_turn() {
    let bricks = halves();
    let all = pairs(&bricks);
    // Of two nodes of solids, a rigid bar is a rod.
    let mut bars = String::new();
    let mut rods = String::new();
    let far = bricks.at(1, |at| at[2] > 0.13);
    for (place, (a, _)) in all.iter().enumerate() {
        let b = far[(5 * place) % far.len()];
        writeln!(bars, "RBAR,{},{a},{b},123456,,,123", 40 + place).unwrap();
        writeln!(rods, "RROD,{},{a},{b},1", 40 + place).unwrap();
    }
    let own = |cards: &str| {
        let read = tried(&bricks.bdf("", cards), "bar.bdf", None);
        let mesh = read.unwrap_or_else(|errors| panic!("{errors}")).mesh;
        (mesh.tie_rows().len(), free(&mesh, 14))
    };
    let (bars, rods) = (own(&bars), own(&rods));
    assert_eq!((bars.0, rods.0), (9, 9));
    six_of(&rods.1);
    alike(&bars.1, &rods.1);
}

#[test]
fn a_node_that_follows_a_mean_joins_nothing_unless_something_hangs_on_it() {
    let (bricks, low, high) = bar();
    let grids = "GRID,900,,.07,-.04,.31\nGRID,901,,.01,.01,-.05\n";
    let mean = |label: usize, reference: usize, own: &[usize]| {
        format!("RBE3,{label},,{reference},123456,1.,123{}\n", {
            let mut text = String::new();
            for (place, node) in own.iter().enumerate() {
                text += if place > 0 && (place + 6) % 8 == 0 { "\n," } else { "," };
                text += &node.to_string();
            }
            text
        })
    };
    let plain = clean(&bricks.bdf("", ""), "bar.bdf");
    let alone = clean(
        &bricks.bdf("", &format!("GRID,900,,.07,-.04,.31\n{}", mean(8, 900, &high))),
        "bar.bdf",
    );
    assert!(alone.ties().is_empty());
    let distributing = format!(
        "*NODE\n900, 0.07, -0.04, 0.31\n*SURFACE, NAME=FACE, TYPE=NODE\n{}*COUPLING, CONSTRAINT NAME=C, REF NODE=900, SURFACE=FACE\n*DISTRIBUTING\n",
        labels(&high)
    );
    let inp = tried(&bricks.inp(["", ""], &distributing), "bar.inp", None).unwrap();
    assert!(inp.mesh.ties().is_empty());
    alike(&free(&alone, 12), &free(&plain, 12));
    // Means of both ends on one body: six equations, which no rigid motion feels, and no stretch is free.
    let cards =
        format!("{grids}{}{}RBAR,10,900,901,123456\n", mean(8, 900, &high), mean(9, 901, &low));
    let joined = clean(&bricks.bdf("", &cards), "bar.bdf");
    assert_eq!(joined.tie_rows().len(), 6);
    let own = free(&joined, 12);
    six_of(&own);
    for (own, known) in own.iter().zip(&free(&plain, 12)).skip(6) {
        assert!(*own > known * (1.0 - ROUNDING), "{own} {known}");
    }
    assert!(own[6] > 1.5 * free(&plain, 12)[6]);
    // A node of a cell that follows a mean.
    let follows = clean(&bricks.bdf("", &mean(8, low[0], &high)), "bar.bdf");
    assert_eq!(follows.tie_rows().len(), 3);
    six_of(&free(&follows, 12));
}
