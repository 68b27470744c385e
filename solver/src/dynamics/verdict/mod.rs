//! What a march is measured by, step by step, and what the program believes of it in the end.
//!
//! ```text
//! meters     all of them: energy (windows), quality_meter, ringing (rings), state_errors, film_meter, periods
//! quality    quality_meter: by parts and turns (part_sums, turn_sums, in_space) of steps that are sampled (sampling, sampled), the
//!            first ones early; part_errors: before a part is accepted; histogram: how many errors of every size
//! verdict    quality: what steps were worth ─▶ findings: what is beyond its limit
//! ```

mod early;
mod energy;
mod film_findings;
mod film_meter;
mod finding;
mod findings;
mod histogram;
mod in_space;
mod meters;
mod part_errors;
mod part_sums;
mod periods;
mod quality;
mod quality_meter;
mod ringing;
mod rings;
mod sampled;
mod sampling;
mod state_errors;
mod turn_sums;
mod windows;

pub use energy::EnergyBalance;
pub use film_meter::FilmQuality;
pub use finding::Finding;
pub use findings::findings;
pub(super) use meters::{MeterSums, Meters};
pub use periods::{FewestSteps, LEAST_STEPS};
pub use quality::Quality;
pub use rings::{Ringing, RingingPart};
pub use state_errors::StateError;
