//! Gravity: the weight of a body, as a force fixed in space on its centre of mass.
//!
//! With P = φᵀM 1 and the first moment s0 = ∫ρ x0 dV, a turning body has Q_η = PAᵀg and Q_θ = (A_θ(s0 + Pᵀη))·g. That is the
//! force m g on a node at s0/m whose shapes are Pᵀ/m.

use crate::bodies::Body;
use crate::centre_of_mass::CentreOfMass;
use crate::loads::{Frame, Load};
use crate::time_function::TimeFunction;

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
