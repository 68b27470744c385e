//! Marching a machine in time.

mod contacts;
mod energy;
mod march;
mod meters;
mod newmark;
mod newton;
mod quality;
mod rows;
#[cfg(test)]
mod small;
mod steady;
mod system;
mod verdict;

pub use energy::EnergyBalance;
pub use march::{
    CHECKPOINT_STEPS, Checkpoint, Failure, March, MarchOptions, Outcome, Progress, march,
};
pub use newmark::{Coefficients, Newmark, State};
pub use newton::NewtonOptions;
pub use quality::Quality;
pub use steady::SteadyState;
pub use system::System;
pub use verdict::{ENERGY_MADE, Finding, LOCAL_ERROR, ROW_ERROR, findings};
