//! Gravity: the weight of a body, as a force fixed in space on its centre of mass; and the same of a ground that is accelerated.
//!
//! With P = φᵀM 1 and the first moment s0 = ∫ρ x0 dV, a turning body has Q_η = PAᵀg and Q_θ = (A_θ(s0 + Pᵀη))·g. That is the
//! force m g on a node at s0/m whose shapes are Pᵀ/m.

use std::sync::Arc;

use crate::bodies::Body;
use crate::centre_of_mass::CentreOfMass;
use crate::curve::Curve;
use crate::loads::{Frame, Load};
use crate::time_function::TimeFunction;

/// The weights of the bodies that have a mass, under gravity (m/s² along x, y, z of space).
pub fn weights(bodies: &[Body], gravity: [f64; 3]) -> Vec<Load> {
    uniform(bodies, gravity, &TimeFunction::Constant)
}

/// Inertia forces on the bodies that have a mass, seen from a ground that moves with these accelerations (m/s² along x, y, z of
/// space, over t in s) and does not turn: −m a on each, as a gravity of −a would have it.
pub fn shaken(bodies: &[Body], ground: &[Option<Arc<Curve>>; 3]) -> Vec<Load> {
    let along = |(axis, curve): (usize, &Option<Arc<Curve>>)| {
        let mut one = [0.0; 3];
        one[axis] = -1.0;
        let curve = curve.as_ref()?;
        Some(uniform(bodies, one, &TimeFunction::OverTime(curve.clone())))
    };
    ground.iter().enumerate().filter_map(along).flatten().collect()
}

/// A force on all mass alike, as an acceleration (m/s²).
fn uniform(bodies: &[Body], field: [f64; 3], time_function: &TimeFunction) -> Vec<Load> {
    let own = bodies.iter().enumerate().filter(|(_, body)| body.centre_of_mass().mass > 0.0);
    own.map(|(place, body)| {
        let CentreOfMass { mass, node } = body.centre_of_mass();
        let force = field.map(|own| mass * own);
        Load::force(place, node.clone(), force, time_function.clone(), Frame::Space)
    })
    .collect()
}
