//! Units for co-simulation after FMI 2.0: a case with its reduced bodies and the solver, which other programs run.
//!
//! `export` writes them; the crate `whirl-fmu` runs them, with what is here of their resources and variables.

mod description;
mod export;
mod layout;
mod library;
mod parameters;
mod unit;
mod units;
mod variables;
mod xml;

pub(crate) use self::export::export;
pub use self::unit::{Made, Unit};
pub use self::variables::{Role, ToldGroup, Variable};
