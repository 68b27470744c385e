//! Marching a machine in time.

mod contacts;
mod energy;
mod march;
mod newmark;
mod newton;
mod rows;
mod steady;
mod system;

pub use energy::EnergyBalance;
pub use march::{Failure, March, MarchOptions, Outcome, Progress, march};
pub use newmark::{Coefficients, Newmark, State};
pub use newton::NewtonOptions;
pub use steady::SteadyState;
pub use system::System;
