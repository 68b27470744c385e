//! Where a march begins, if not at what its options say.
//!
//! ```text
//! equilibrium  in equilibrium at speed
//! restart      from the last state of another march
//! cycle        again and again at one time, each from another state, for periodic motions
//! ```

mod cycle;
mod equilibrium;
mod restart;

pub use equilibrium::{Equilibrium, equilibrium};
pub(crate) use equilibrium::{Standing, standing_at};
pub use restart::LastState;
