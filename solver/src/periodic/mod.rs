//! Periodic motions of a machine, stable or not, with their multipliers.
//!
//! A [`Cycle`] in equal steps → the map that a march over it makes of the state at its start ([`CycleMap`]) → a state that it
//! leaves as it is, by Anderson's acceleration, Newton's method (shooting) or harmonic balance (`harmonic`) → the derivative of the map there, whose
//! eigenvalues are the multipliers ([`Multiplier`]) → the same with steps half as long, against which both are judged
//! ([`Periodic`]). Over a parameter of the machine motions are followed from one to the next ([`Branch`]).
//!
//! The map is that of the march itself, with every step solved to rounding: what is found is where the march would end that
//! has waited for ever, or what it would leave for ever where that is unstable.

mod anderson;
mod branch;
mod common;
mod contacts;
mod cycle;
mod doubled;
mod events;
mod family;
mod found;
mod harmonic;
mod in_space;
mod krylov;
mod map;
mod metric;
mod motion;
mod multipliers;
mod options;
mod path;
mod shooting;
mod solve;
mod switched;
mod weighed;

pub use branch::{Branch, BranchEnd, BranchOptions, branch};
pub use common::{GROUND_MOTION, Repeating, common_period, repeating, start};
pub use cycle::Cycle;
pub use doubled::StepError;
pub use events::{BranchEvent, EventKind};
pub use family::At;
pub use found::{periodic, periodic_from};
pub use harmonic::{least_harmonics, remembers_nothing, self_excited, undriven};
pub use map::CycleMap;
pub use motion::{Harmonics, Periodic};
pub use multipliers::{Multiplier, MultiplierKind, Stability};
pub use options::{CycleProgress, Method, PeriodicOptions};
pub use path::BranchPoint;
pub use switched::switched;
