//! What bodies weigh.

use crate::machine::Body;
use crate::shaft::Shaft;

/// The mass of a body, where it is known (kg).
pub(super) fn known_mass(body: &Body) -> Option<f64> {
    Some(body.centre_of_mass().mass).filter(|mass| *mass > 0.0)
}

/// The mass of a body that turns (kg); the mean of its coordinates' where it is not known.
pub(super) fn mass(body: &Body, shaft: &Shaft) -> f64 {
    known_mass(body).unwrap_or_else(|| {
        let trace = (0..shaft.size()).map(|j| shaft.mass[(j, j)]).sum::<f64>();
        trace / shaft.size().max(1) as f64
    })
}
