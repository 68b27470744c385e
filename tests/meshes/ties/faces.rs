//! Nodes that follow faces of other cells.

use nalgebra::{DMatrix, DVector};
use whirl_solver::assembly::assemble;
use whirl_solver::mesh::Mesh;

use super::{Brick, Bricks, alike, clean, free, six_of, tried};

/// A bar along z in two parts: the lower one of 2 × 1 cells across, the upper one of these.
fn bar(upper: [usize; 2], order: usize, gap: f64) -> Bricks {
    let brick = |from: f64, to: f64, across: [usize; 2]| Brick {
        from: [0.0, 0.0, from],
        to: [0.02, 0.03, to],
        cells: [across[0], across[1], 2],
        order,
    };
    Bricks::new(&[brick(0.0, 0.1, [2, 1]), brick(0.1 + gap, 0.2 + gap, upper)])
}

/// The cards by which the upper part's nodes follow the lower part.
fn tie(bricks: &Bricks, gap: f64, more: &str) -> String {
    let seam = bricks.at(1, |at| (at[2] - 0.1 - gap).abs() < 1e-9);
    let nodes: String = seam.iter().map(|label| format!("{label}\n")).collect();
    format!(
        "*SURFACE, NAME=UPPER, TYPE=NODE\n{nodes}*SURFACE, NAME=LOWER, TYPE=ELEMENT\nBRICK0, S2\n\
         *TIE, NAME=SEAM{more}\nUPPER, LOWER\n"
    )
}

fn dense(mesh: &Mesh) -> DMatrix<f64> {
    let columns = assemble(mesh, "stiffness").unwrap().to_columns();
    let size = mesh.dof_count();
    let mut k = DMatrix::zeros(size, size);
    (0..size).for_each(|j| columns.column(j).for_each(|(i, value)| k[(i, j)] = value));
    k
}

/// Uniform strain satisfies the equations, and its forces are in balance but for multiples of the equations: the forces of
/// the two parts meet. True where the following nodes hold all of the other face's.
#[test]
fn a_uniform_stress_passes_from_part_to_part() {
    for order in [1, 2] {
        let bricks = bar([4, 3], order, 0.0);
        let mesh = clean(&bricks.inp(["", ""], &tie(&bricks, 0.0, "")), "bar.inp");
        let k = dense(&mesh);
        let gradient = [[1.0, -0.4, 0.3], [0.2, -0.7, 0.5], [-0.1, 0.6, 0.9]];
        let u = DVector::from_fn(mesh.dof_count(), |dof, _| {
            (0..3).map(|k| gradient[dof % 3][k] * mesh.nodes()[dof / 3][k]).sum()
        });
        let rows = mesh.tie_rows();
        // Of 5 × 4 nodes, and those between them.
        assert_eq!(rows.len(), 3 * if order == 1 { 20 } else { 20 + 16 + 15 });
        let mut equations = DMatrix::zeros(mesh.dof_count(), rows.len());
        for (j, row) in rows.iter().enumerate() {
            row.iter().for_each(|&(dof, c)| equations[(dof, j)] += c);
        }
        let left = equations.transpose() * &u;
        assert!(left.amax() < 1e-12 * u.amax(), "{}", left.amax());
        // Forces on nodes of the seam alone; those at its rim carry tractions of the sides, too.
        let inner: Vec<usize> = (0..mesh.nodes().len())
            .filter(|&node| {
                let [x, y, z] = mesh.nodes()[node];
                0.001 < z && z < 0.199 && 0.001 < x && x < 0.019 && 0.001 < y && y < 0.029
            })
            .flat_map(|node| (0..3).map(move |i| 3 * node + i))
            .collect();
        let rim = |dof: &usize| !inner.contains(dof);
        // Multipliers of the equations, and free forces outside of the inner nodes, give all forces.
        let outside: Vec<usize> = (0..mesh.dof_count()).filter(rim).collect();
        let mut system = DMatrix::zeros(mesh.dof_count(), rows.len() + outside.len());
        system.columns_mut(0, rows.len()).copy_from(&equations);
        for (j, &dof) in outside.iter().enumerate() {
            system[(dof, rows.len() + j)] = 1.0;
        }
        let forces = &k * &u;
        let solved = system.clone().svd(true, true).solve(&forces, 1e-10).unwrap();
        let left = &system * solved - &forces;
        // Rounding of a solution by singular values.
        assert!(left.amax() < 1e-10 * forces.amax(), "order {order}: {}", left.amax());
    }
}

/// Quadratic cells of the upper part that refine those of the lower one make a space between those of the whole bar with
/// coarse and with fine cells, so that frequencies are between theirs (Rayleigh and Ritz).
#[test]
fn a_refined_part_has_frequencies_between_those_of_the_coarse_and_the_fine_bar() {
    let whole = |across: [usize; 2]| -> Vec<f64> {
        let brick = Brick {
            from: [0.0; 3],
            to: [0.02, 0.03, 0.2],
            cells: [across[0], across[1], 4],
            order: 2,
        };
        free(&clean(&Bricks::new(&[brick]).inp(["", ""], ""), "bar.inp"), 12)
    };
    let bricks = bar([4, 2], 2, 0.0);
    let own = free(&clean(&bricks.inp(["", ""], &tie(&bricks, 0.0, "")), "bar.inp"), 12);
    six_of(&own);
    let (coarse, fine) = (whole([2, 1]), whole([4, 2]));
    for k in 6..12 {
        let (above, below) = (coarse[k] * (1.0 + 1e-9), fine[k] * (1.0 - 1e-9));
        assert!(below < own[k] && own[k] < above, "{k}: {} {} {}", fine[k], own[k], coarse[k]);
    }
    // A part that is none of these differs from the whole bar by no more than these from each other, a few times.
    let odd = bar([3, 2], 2, 0.0);
    let odd = free(&clean(&odd.inp(["", ""], &tie(&odd, 0.0, "")), "bar.inp"), 12);
    six_of(&odd);
    assert!((odd[6] / fine[6] - 1.0).abs() < 1e-2, "{} {}", odd[6], fine[6]);
}

#[test]
fn gaps_are_bridged_within_the_tolerance_and_said_beyond_it() {
    let gap = 2e-4;
    let bricks = bar([3, 2], 1, gap);
    // By the size of faces a twentieth, 1.5 mm, is near enough; rigid motions are followed across the gap.
    let own = free(&clean(&bricks.inp(["", ""], &tie(&bricks, gap, "")), "bar.inp"), 12);
    six_of(&own);
    let closed = bar([3, 2], 1, 0.0);
    let known = free(&clean(&closed.inp(["", ""], &tie(&closed, 0.0, "")), "bar.inp"), 12);
    // What is in the gap has no mass, and is rigid: a thousandth of the length.
    assert!((own[6] / known[6] - 1.0).abs() < 1e-2);
    let text = bricks.inp(["", ""], &tie(&bricks, gap, ", POSITION TOLERANCE=1e-4"));
    let read = tried(&text, "bar.inp", None).unwrap();
    let said = read.warnings[0].to_string();
    assert!(said.contains("12 nodes of UPPER are farther from the faces of LOWER"), "{said}");
    assert!(read.mesh.ties().is_empty());
    let refused =
        tried(&bricks.inp(["", ""], &tie(&bricks, gap, ", CYCLIC SYMMETRY")), "b.inp", None);
    assert!(refused.unwrap_err().to_string().contains("CYCLIC SYMMETRY of *TIE is not read"));
}

#[test]
fn faces_are_followed_wherever_the_machine_stands() {
    let bricks = bar([3, 2], 2, 1e-4);
    let cards = tie(&bricks, 1e-4, "");
    let still = free(&clean(&bricks.inp(["", ""], &cards), "bar.inp"), 12);
    let instance = "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n0.3, -0.2, 0.7\n\
                    0., 0., 0., 1., 2., -0.5, 37.\n*END INSTANCE\n";
    let text = bricks.inp(["*PART, NAME=P\n", instance], &(cards + "*END ASSEMBLY\n"));
    let moved = free(&clean(&text, "bar.inp"), 12);
    six_of(&moved);
    alike(&moved, &still);
}
