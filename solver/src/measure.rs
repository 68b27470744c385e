//! Measures of a body: the mean motion of a set of its nodes, as rows over its coordinates.

use serde::{Deserialize, Serialize};

use crate::body::{BodyNode, Coordinates};
use crate::linalg::{Matrix, multiply};
use crate::mesh::{MeanComponent, NodeSetMean};
use crate::reduction::{CraigBampton, Row};

/// The mean motion of a node set, and how it moves with the body's coordinates: see [`NodeSetMean`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MeanMotion {
    /// The undeformed point (m) whose displacement is the mean displacement.
    pub centre: [f64; 3],
    /// Mean displacement along x, y, z by a unit of each coordinate (m): 3 × n.
    pub displacement: Matrix,
    /// Mean rotation about x, y, z by a unit of each coordinate (rad): 3 × n. Zero about an axis about which the set
    /// shows no turn.
    pub rotation: Matrix,
}

impl MeanMotion {
    /// `place`: the place of a node of the mesh among those whose shapes the reduction has.
    pub(crate) fn new(
        reduction: &CraigBampton,
        active: &Coordinates,
        mean: &NodeSetMean,
        place: impl Fn(usize) -> usize,
    ) -> Self {
        let rows = |motion: fn(usize) -> MeanComponent| {
            let rows = [0, 1, 2].map(|axis| mean.row(motion(axis)));
            let places = rows.map(|row| {
                row.into_iter().map(|(dof, c)| (3 * place(dof / 3) + dof % 3, c)).collect::<Row>()
            });
            let shapes = Matrix::from_fn(3, reduction.shapes.cols, |i, j| {
                places[i].iter().map(|&(row, c)| c * reduction.shapes[(row, j)]).sum()
            });
            multiply(shapes.view(), active.transform.view())
        };
        MeanMotion {
            centre: mean.centre(),
            displacement: rows(MeanComponent::Displacement),
            rotation: rows(MeanComponent::Rotation),
        }
    }

    /// Over other coordinates, of which these are a transform.
    pub(crate) fn over(&self, transform: &Matrix) -> MeanMotion {
        let over = |rows: &Matrix| multiply(rows.view(), transform.view());
        let (displacement, rotation) = (over(&self.displacement), over(&self.rotation));
        MeanMotion { centre: self.centre, displacement, rotation }
    }

    /// The motion of a point that moves with the set: as a node at `position` (m).
    pub fn node_at(&self, position: [f64; 3]) -> BodyNode {
        let r = [0, 1, 2].map(|axis| position[axis] - self.centre[axis]);
        let shapes = Matrix::from_fn(3, self.displacement.cols, |axis, j| {
            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
            let turn = |k: usize| self.rotation[(k, j)];
            self.displacement[(axis, j)] + turn(next) * r[last] - turn(last) * r[next]
        });
        BodyNode { position, shapes }
    }
}
