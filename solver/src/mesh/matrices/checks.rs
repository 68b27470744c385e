//! Whether K and M can be those of a body.

use super::super::body_matrices::{BodyMatrices, Slot};
use super::super::raw::{LinePosition, MeshReport};
use super::entries::{Entries, Entry};
use super::rigid::RigidMass;
use crate::linalg::{LinearAlgebraError, LowerTriangle, SparseCholesky};
use crate::ordering::{Neighbours, nested_dissection};
use crate::sparse::SparseMatrix;

/// A_ij² is at most A_ii A_jj but for this part of it, and entries beside a diagonal of zero are at most this part of the
/// largest: single precision keeps no more.
const ROUNDING: f64 = 1e-6;
/// Errors of one kind that are listed for a matrix.
const LISTED: usize = 5;
/// Bytes that a factor may take; of a larger one nothing is said.
const MEMORY: usize = 4 << 30;
/// Masses along x, y and z differ by at most this part.
const ALIKE: f64 = 1e-5;

/// Notes entries that no positive semidefinite matrix has.
pub(super) fn minors(
    matrix: &Entries,
    lower: &[Entry],
    called: &[String],
    report: &mut MeshReport,
) {
    let mut diagonal = vec![0.0; called.len()];
    let mut largest: f64 = 0.0;
    for entry in lower {
        largest = largest.max(entry.value.abs());
        if entry.row == entry.column {
            diagonal[entry.row] = entry.value;
        }
    }
    let mut bad = 0;
    for entry in lower {
        let [row, column] = [entry.row, entry.column].map(|dof| &called[dof]);
        let value = entry.value;
        let what = if entry.row == entry.column {
            match value < 0.0 {
                true => format!("the diagonal of {} is negative at {row}: {value:e}", matrix.name),
                false => continue,
            }
        } else {
            let product = diagonal[entry.row] * diagonal[entry.column];
            let noise = ROUNDING * largest;
            if value * value <= (1.0 + ROUNDING) * product.max(0.0)
                || value.abs() <= noise * ROUNDING
            {
                continue;
            }
            format!(
                "the entry ({row}, {column}) of {} is {value:e}, larger than √({:e} · {:e}) of the diagonal",
                matrix.name, diagonal[entry.row], diagonal[entry.column]
            )
        };
        bad += 1;
        if bad <= LISTED {
            let help = "no body has such a matrix: look for files that were exchanged, and for dofs in another order";
            report.error(matrix.at(entry), what, help);
        }
    }
    if lower.iter().all(|entry| entry.value == 0.0) {
        let what = format!("{} has no entries", matrix.name);
        let at = LinePosition { file: matrix.file, line: 0, column: 0 };
        report.error(at, what, "export the matrix of a body that has stiffness and mass");
    }
}

/// Notes a mass that differs along x, y and z, and matrices that are not positive semidefinite; warns of a stiffness that
/// holds the body to the ground. `files`: those of K and M.
pub(super) fn body(
    body: &BodyMatrices,
    positions: &[[f64; 3]],
    labels: &[u64],
    files: [usize; 2],
    report: &mut MeshReport,
) {
    let [stiff, heavy] = files.map(|file| LinePosition { file, line: 0, column: 0 });
    let own = RigidMass::new(positions, &body.slots, &body.mass);
    // Of a body that is held the masses on held dofs are missing.
    let masses: Vec<(usize, f64)> = (0..3)
        .filter(|&i| !body.held[i] && body.slots.contains(&Slot::Translation(i)))
        .map(|i| (i, own.along[i]))
        .collect();
    let most = masses.iter().map(|(_, mass)| *mass).fold(0.0, f64::max);
    if let Some((axis, mass)) = masses.iter().find(|(_, mass)| most - mass > ALIKE * most) {
        let all: Vec<String> = masses
            .iter()
            .map(|(i, mass)| format!("{mass:.6e} kg along {}", ["x", "y", "z"][*i]))
            .collect();
        let what = format!("M has another mass along each axis: {}", all.join(", "));
        let help = format!(
            "M must be of the same dofs as K, and reduced with the same shapes: look for dofs along {} that are missing \
             ({:.1} % of the mass)",
            ["x", "y", "z"][*axis],
            100.0 * (1.0 - mass / most)
        );
        report.error(heavy, what, help);
    }
    for (name, matrix, at) in [("K", &body.stiffness, stiff), ("M", &body.mass, heavy)] {
        if let Some(dof) = indefinite(matrix, positions) {
            let what = format!(
                "{name} is not positive semidefinite (found near node {})",
                labels[dof / 3]
            );
            let help = match name {
                "K" => "export the stiffness of the body at rest, without loads and contact",
                _ => "look for negative masses, and for dofs in another order than those of K",
            };
            report.error(at, what, help);
        }
    }
    let held = body.held_against();
    if !held.is_empty() {
        let what = format!("K holds the body to the ground against {}", held.join(", "));
        let help = "write K without constraints if the body is to be held by the case";
        report.warn(stiff, what, help);
    }
}

/// A dof near which a matrix has a negative eigenvalue, beyond the rounding of its text.
fn indefinite(matrix: &SparseMatrix, positions: &[[f64; 3]]) -> Option<usize> {
    let lower = matrix.lower()?;
    let diagonal = lower.diagonal();
    let firm = LowerTriangle::from_columns(lower.size, |j| {
        let own = if diagonal[j] > 0.0 { ROUNDING * diagonal[j] } else { 1.0 };
        let rest = lower.column(j).filter(move |&(i, _)| i != j);
        rest.chain(std::iter::once((j, diagonal[j] + own)))
    });
    let mut neighbours: Neighbours = vec![Vec::new(); positions.len()];
    for column in 0..lower.size {
        for (row, _) in lower.column(column) {
            let (a, b) = (row / 3, column / 3);
            if a != b {
                neighbours[a].push(b);
                neighbours[b].push(a);
            }
        }
    }
    for row in &mut neighbours {
        row.sort_unstable();
        row.dedup();
    }
    let order: Vec<usize> = nested_dissection(positions, &neighbours)
        .into_iter()
        .flat_map(|node| [3 * node, 3 * node + 1, 3 * node + 2])
        .collect();
    match SparseCholesky::new(&firm, &order, MEMORY) {
        Err(LinearAlgebraError::NotPositiveDefinite { row, .. }) => Some(row),
        _ => None,
    }
}
