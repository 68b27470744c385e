//! Rigid motions of a body of matrices, and the mass that they show.

use super::super::body_matrices::{BodyMatrices, Slot};
use crate::linalg::{Matrix, dot, transpose_multiply};
use crate::mesh::Mesh;
use crate::sparse::SparseMatrix;

/// A rigid motion is resisted if it costs at least this part of what its dofs would cost alone: text keeps nine digits or
/// more of each entry.
const RESISTED: f64 = 1e-8;
/// And at least this part of what the stiffest displacement of a node costs.
const NEGLIGIBLE: f64 = 1e-10;

/// Centres of mass agree to this part of the largest radius of gyration: text keeps nine digits of entries of M or more.
const OFF: f64 = 1e-6;

/// Nodes stand on the axis to this part of the largest coordinate.
const ON_AXIS: f64 = 1e-9;

/// Mass, first and second moments by the rigid motions of a body.
pub(crate) struct RigidMass {
    /// That moves along x, y, z (kg).
    pub(crate) along: [f64; 3],
    /// kg.
    pub(crate) mass: f64,
    /// ∫ρ x dV (kg·m).
    pub(crate) first: [f64; 3],
    /// Moments of inertia about the origin: of e_i × x by e_j × x (kg·m²).
    pub(crate) inertia: [[f64; 3]; 3],
    /// M times the shifts along x, y, z and the turns about them through the origin: 3·nodes × 6.
    pub(crate) momenta: Matrix,
}

/// Displacements of the dofs by shifts along x, y, z and by turns about them through the origin: 3·nodes × 6.
pub(super) fn motions(positions: &[[f64; 3]], slots: &[Slot]) -> Matrix {
    let mut shapes = Matrix::zeros(slots.len(), 6);
    for (dof, slot) in slots.iter().enumerate() {
        match *slot {
            Slot::Translation(i) => {
                // e_j × x has component i = j + 1 from −x_k and i = j + 2 from x_{j+1}.
                let x = positions[dof / 3];
                shapes[(dof, i)] = 1.0;
                shapes[(dof, 3 + (i + 2) % 3)] = -x[(i + 1) % 3];
                shapes[(dof, 3 + (i + 1) % 3)] = x[(i + 2) % 3];
            }
            Slot::Turn(i) => shapes[(dof, 3 + i)] = 1.0,
            Slot::Coordinate | Slot::Absent => {}
        }
    }
    shapes
}

/// Which of the six motions the stiffness resists; those that move no dof it does not.
pub(super) fn resisted(
    positions: &[[f64; 3]],
    slots: &[Slot],
    stiffness: &SparseMatrix,
) -> [bool; 6] {
    // About the middle, so that turns are not mostly shifts.
    let count = positions.len().max(1) as f64;
    let middle = [0, 1, 2].map(|k| positions.iter().map(|x| x[k]).sum::<f64>() / count);
    let about: Vec<[f64; 3]> =
        positions.iter().map(|x| [0, 1, 2].map(|k| x[k] - middle[k])).collect();
    let shapes = motions(&about, slots);
    let mut forces = Matrix::zeros(shapes.rows, 6);
    stiffness.multiply(&shapes.data, &mut forces.data);
    let diagonal = stiffness.lower().map(|lower| lower.diagonal()).unwrap_or_default();
    let of_nodes =
        slots.iter().zip(&diagonal).filter(|(slot, _)| matches!(slot, Slot::Translation(_)));
    let stiffest = of_nodes.map(|(_, own)| *own).fold(0.0, f64::max);
    let reach = about.iter().flatten().fold(0.0, |most: f64, x| most.max(x * x));
    std::array::from_fn(|j| {
        let (mut energy, mut alone) = (0.0, 0.0);
        for (dof, own) in diagonal.iter().enumerate() {
            energy += shapes[(dof, j)] * forces[(dof, j)];
            alone += own * shapes[(dof, j)].powi(2);
        }
        // A motion that costs little alone has the rounding of the stiff dofs all the same.
        let least = NEGLIGIBLE * stiffest * if j < 3 { 1.0 } else { reach };
        energy > (RESISTED * alone).max(least)
    })
}

impl RigidMass {
    pub(super) fn new(positions: &[[f64; 3]], slots: &[Slot], mass: &SparseMatrix) -> RigidMass {
        let shapes = motions(positions, slots);
        let mut momenta = Matrix::zeros(shapes.rows, 6);
        mass.multiply(&shapes.data, &mut momenta.data);
        let all = transpose_multiply(shapes.view(), momenta.view()).symmetric_part();
        // Of the shifts that have dofs.
        let along = [0, 1, 2].map(|i| all[(i, i)]);
        let mass = along.into_iter().fold(0.0, f64::max);
        // With e_i × e_j = e_k: e_i · (e_j × x) = x_k and e_j · (e_i × x) = −x_k, of shifts and turns that move dofs.
        let shown = |i: usize, j: usize| along[i] > 0.0 && all[(3 + j, 3 + j)] > 0.0;
        let first = [0, 1, 2].map(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let (one, other) = (all[(i, 3 + j)], -all[(j, 3 + i)]);
            match (shown(i, j), shown(j, i)) {
                (true, true) => 0.5 * (one + other),
                (true, false) => one,
                _ => other,
            }
        });
        let inertia = [0, 1, 2].map(|i| [0, 1, 2].map(|j| all[(3 + i, 3 + j)]));
        RigidMass { along, mass, first, inertia, momenta }
    }

    /// ∫ρ xᵢ xⱼ dV about the origin (kg·m²).
    pub(crate) fn second_moments(&self) -> [[f64; 3]; 3] {
        let half = 0.5 * (0..3).map(|i| self.inertia[i][i]).sum::<f64>();
        let second = |i: usize, j: usize| if i == j { half } else { 0.0 } - self.inertia[i][j];
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| second(i, j)))
    }
}

/// What shows that a body turns about z.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TurnAboutZ {
    /// Nothing: all nodes stand on the axis and have no turn about it.
    Nothing,
    /// This dof, the turn of a node.
    Dof(usize),
    /// Displacements of nodes away from the axis.
    Displacements,
}

impl BodyMatrices {
    /// What shows that the body turns about z, with the nodes of `mesh` about its axis.
    pub fn turn_about_z(&self, mesh: &Mesh) -> TurnAboutZ {
        if let Some(dof) = self.slots.iter().position(|slot| *slot == Slot::Turn(2)) {
            return TurnAboutZ::Dof(dof);
        }
        let reach = mesh.nodes().iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        let away = |dof: usize| match self.slots[dof] {
            Slot::Translation(i @ 0..2) => mesh.nodes()[dof / 3][1 - i].abs() > ON_AXIS * reach,
            _ => false,
        };
        match (0..self.slots.len()).any(away) {
            true => TurnAboutZ::Displacements,
            false => TurnAboutZ::Nothing,
        }
    }

    /// How `spin_load`, about the axis of `mesh`, differs from what M says of the centre of mass, and what to do: at 1 rad/s its
    /// resultant is ∫ρ x dV, the mass times the place of its centre. None where they agree.
    pub fn wrong_spin_load(&self, mesh: &Mesh) -> Option<(String, String)> {
        let load = self.spin_load()?;
        let (own, shapes) = (self.rigid_mass(mesh), motions(mesh.nodes(), &self.slots));
        let resultant = [0, 1].map(|axis| dot(shapes.col(axis), load));
        let square = (0..3).map(|axis| own.inertia[axis][axis]).fold(0.0, f64::max) / own.mass;
        let off = [0, 1].map(|axis| (resultant[axis] - own.first[axis]).abs());
        if !(own.mass > 0.0) || off.iter().all(|off| *off <= OFF * own.mass * square.sqrt()) {
            return None;
        }
        let at = |[x, y]: [f64; 2]| {
            let mm = |moment: f64| (1e9 * moment / own.mass).round() / 1e6 + 0.0;
            format!("x = {} mm, y = {} mm", mm(x), mm(y))
        };
        let what = format!(
            "`spin_load` is that of a centre of mass at {} from the axis of the body; by M it is at {}",
            at(resultant),
            at([own.first[0], own.first[1]])
        );
        let help = "give Y x0 with x0 counted from this axis, reduced as M is: along x and y its parts sum to the mass times \
                    the place of its centre";
        Some((what, help.to_owned()))
    }

    /// The mass that the rigid motions of the nodes of `mesh` show.
    pub(crate) fn rigid_mass(&self, mesh: &Mesh) -> RigidMass {
        RigidMass::new(mesh.nodes(), &self.slots, &self.mass)
    }
}
