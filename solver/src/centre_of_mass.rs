//! The centre of mass of a body.

use serde::{Deserialize, Serialize};

use crate::body::BodyNode;
use crate::linalg::Matrix;

/// The centre of mass of a body, and how it moves.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CentreOfMass {
    /// kg.
    pub mass: f64,
    /// Where it is undeformed (m), and its displacement by a unit of each coordinate.
    pub node: BodyNode,
}

impl CentreOfMass {
    /// Of a body without mass, of n coordinates.
    pub fn none(n: usize) -> CentreOfMass {
        let node = BodyNode { position: [0.0; 3], shapes: Matrix::zeros(3, n) };
        CentreOfMass { mass: 0.0, node }
    }

    /// Of the body and of a mass that moves with a node.
    pub(crate) fn add(&mut self, mass: f64, node: &BodyNode) {
        let total = self.mass + mass;
        let [own, other] = [self.mass / total, mass / total];
        for (x, added) in self.node.position.iter_mut().zip(node.position) {
            *x = own * *x + other * added;
        }
        for (x, added) in self.node.shapes.data.iter_mut().zip(&node.shapes.data) {
            *x = own * *x + other * added;
        }
        self.mass = total;
    }

    /// With unbalance (kg·m along x and y), which moves the centre and adds no mass.
    pub(crate) fn shift(&mut self, moment: [f64; 2]) {
        if self.mass > 0.0 {
            self.node.position.iter_mut().zip(moment).for_each(|(x, own)| *x += own / self.mass);
        }
    }
}
