//! Gravity: the weight of a body, as a force fixed in space on its centre of mass.
//!
//! With P = φᵀM 1 and the first moment s0 = ∫ρ x0 dV, a turning body has Q_η = PAᵀg and Q_θ = (A_θ(s0 + Pᵀη))·g. That is the
//! force m g on a node at s0/m whose shapes are Pᵀ/m.

use serde::{Deserialize, Serialize};

use crate::body::BodyNode;
use crate::linalg::Matrix;
use crate::loads::{Frame, Load};
use crate::machine::Body;
use crate::time_function::TimeFunction;

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

/// The weights of the bodies that have a mass, under gravity (m/s² along x, y, z of space).
pub fn weights(bodies: &[Body], gravity: [f64; 3]) -> Vec<Load> {
    let own = bodies.iter().enumerate().filter(|(_, body)| body.centre_of_mass().mass > 0.0);
    own.map(|(place, body)| {
        let CentreOfMass { mass, node } = body.centre_of_mass();
        let force = gravity.map(|g| mass * g);
        Load::force(place, node.clone(), force, TimeFunction::Constant, Frame::Space)
    })
    .collect()
}
