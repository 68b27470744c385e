//! The nodes of a body at an instant.

use whirl_solver::Error;
use whirl_solver::machine::{Field, Machine};
use whirl_solver::mesh::Mesh;
use whirl_solver::stress::{Stress, at_nodes, von_mises};

use super::frames::Frame;
use super::vtu::{Array, Values};

/// A body in its own frame, and how far that has turned.
pub(super) struct Motion {
    /// Where its nodes would be without deformation (m).
    positions: Vec<[f64; 3]>,
    /// By which they are beside that (m), 3·nodes.
    deformation: Vec<f64>,
    /// How far its frame has turned (rad), and sin and cos of that.
    rotation: f64,
    angle: [f64; 2],
}

/// Of a frame.
pub(super) fn motion(machine: &Machine, field: &Field, frame: &Frame) -> Motion {
    let place = &machine.places()[field.body];
    let rotation = place.rotation.map_or(0.0, |at| frame.q[at]);
    let flexible = &frame.q[place.flexible.clone()];
    let mut deformation = Vec::with_capacity(3 * field.nodes.len());
    for node in &field.nodes {
        let along = |i: usize| (0..flexible.len()).map(|j| node.shapes[(i, j)] * flexible[j]).sum();
        deformation.extend([0, 1, 2].map(along) as [f64; 3]);
    }
    let positions = field.nodes.iter().map(|node| node.position).collect();
    Motion { positions, deformation, rotation, angle: rotation.sin_cos().into() }
}

impl Motion {
    fn turned(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let [sin, cos] = self.angle;
        [cos * x - sin * y, sin * x + cos * y, z]
    }

    /// Beside its place without deformation, in its frame (m), a node each.
    pub(super) fn displacements(&self) -> &[[f64; 3]] {
        self.deformation.as_chunks::<3>().0
    }

    /// How far its frame has turned (rad).
    pub(super) fn turned_by(&self) -> f64 {
        self.rotation
    }

    /// Points and deformation in space; `axis`: x and y of where the coordinates of the nodes count from (m).
    pub(super) fn moved(&self, axis: [f64; 2]) -> Vec<Array> {
        let place = |position: &[f64; 3]| {
            let [x, y, z] = self.turned(*position);
            [x + axis[0], y + axis[1], z]
        };
        let (deformation, _) = self.deformation.as_chunks::<3>();
        let deformation = deformation.iter().map(|own| self.turned(*own)).collect();
        vec![
            Array::points(self.positions.iter().map(place).collect()),
            Array { name: "deformation_m", values: Values::Vectors(deformation) },
        ]
    }

    /// The stress at every node, in the frame of the body.
    ///
    /// # Errors
    /// As [`at_nodes`].
    pub(super) fn in_body(&self, mesh: &Mesh) -> Result<Vec<Stress>, Error> {
        at_nodes(mesh, &self.deformation)
    }

    /// The stress at every node, in space, and its size by von Mises.
    ///
    /// # Errors
    /// As [`at_nodes`].
    pub(super) fn stresses(&self, mesh: &Mesh) -> Result<[Array; 2], Error> {
        let stresses = self.in_body(mesh)?;
        let sizes = stresses.iter().map(von_mises).collect();
        let stresses = stresses.into_iter().map(|own| turned(own, self.angle)).collect();
        Ok([
            Array { name: "stress_Pa", values: Values::Tensors(stresses) },
            Array { name: "von_mises_Pa", values: Values::Scalars(sizes) },
        ])
    }
}

/// R σ Rᵀ for a turn about z by an angle with this sin and cos.
fn turned([xx, yy, zz, xy, yz, zx]: Stress, [s, c]: [f64; 2]) -> Stress {
    [
        c * c * xx - 2.0 * s * c * xy + s * s * yy,
        s * s * xx + 2.0 * s * c * xy + c * c * yy,
        zz,
        s * c * (xx - yy) + (c * c - s * s) * xy,
        s * zx + c * yz,
        c * zx - s * yz,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stress_turns_as_a_matrix_does() {
        let (sin, cos) = 0.7_f64.sin_cos();
        let own: Stress = [5.0, -3.0, 2.0, 1.5, -4.0, 7.0];
        let [xx, yy, zz, xy, yz, zx] = own;
        let sigma = [[xx, xy, zx], [xy, yy, yz], [zx, yz, zz]];
        let turn = [[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]];
        let entry = |i: usize, j: usize| -> f64 {
            let products = (0..3).flat_map(|k| (0..3).map(move |l| (k, l)));
            products.map(|(k, l)| turn[i][k] * sigma[k][l] * turn[j][l]).sum()
        };
        let found = turned(own, [sin, cos]);
        let places = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)];
        for (found, (i, j)) in found.iter().zip(places) {
            assert!((found - entry(i, j)).abs() < 1e-14, "{i} {j}: {found} for {}", entry(i, j));
        }
    }
}
