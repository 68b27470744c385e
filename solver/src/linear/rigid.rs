//! How large rounding is in the stiffness of bodies.
//!
//! A body that moves as if it were rigid strains nothing, and what its reduced stiffness gives for that is rounding of its
//! mesh: so large is the rounding of all that is as slow. It is measured, body by body, in place of being guessed.

use crate::bodies::Body;
use crate::error::Error;
use crate::linalg::generalised_symmetric_eigen;
use crate::machine::Machine;

/// Share of the largest ω² of a body below which it moves as if it were rigid.
const RIGID: f64 = 1e-10;

/// The largest ω² that rounding gives a body for its rigid motions ((rad/s)²).
///
/// # Errors
/// A mass that is not positive definite, or values that are not finite.
pub(super) fn rounding(machine: &Machine) -> Result<f64, Error> {
    let mut most: f64 = 0.0;
    for body in &machine.bodies {
        let squares = match body {
            Body::Turning { shaft, .. } if shaft.size() > 0 => {
                generalised_symmetric_eigen(&shaft.stiffness.symmetric_part(), &shaft.mass)?.values
            }
            Body::Turning { .. } => continue,
            Body::Standing { support, .. } => support.stiffness.clone(),
        };
        let largest = squares.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        let rigid = squares.iter().map(|own| own.abs()).filter(|own| *own <= RIGID * largest);
        most = rigid.fold(most, f64::max);
    }
    Ok(most)
}
