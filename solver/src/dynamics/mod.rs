//! Marching a machine in time.

mod checkpoint;
mod condensed;
mod contacts;
mod control;
mod energy;
mod equilibrium;
mod extrapolation;
mod factors;
mod histogram;
mod jumps;
mod march;
mod merit;
mod meters;
mod modes;
mod newmark;
mod newton;
mod outputs;
mod part_errors;
mod parts;
mod quality;
mod release;
mod restart;
mod row;
mod rows;
mod settled;
#[cfg(test)]
mod small;
mod spring_tangent;
mod steady;
mod strides;
mod system;
mod turning;
mod verdict;
mod windows;

pub use checkpoint::Checkpoint;
pub use control::{AutomaticStep, PartsTaken};
pub use energy::EnergyBalance;
pub use equilibrium::{Equilibrium, equilibrium};
pub use march::{BodyStart, Failure, March, MarchOptions, Outcome, Progress, march};
pub use newmark::{Coefficients, Newmark, State};
pub use newton::NewtonOptions;
pub use quality::{MovingPart, Quality};
pub use restart::LastState;
pub use steady::SteadyState;
pub use system::System;
pub use verdict::{Finding, findings};
