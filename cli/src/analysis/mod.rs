//! Analyses: small motions about the state in which a machine stands at constant speeds, and motions that repeat themselves.
//!
//! A case → its machine → bodies made round ([`whirl_solver::linear::LinearMachine`]) → each analysis over its speeds → a text, tables and figures.

mod asked;
mod at_points;
mod campbell;
mod coefficients;
mod facts;
mod forces;
mod foreseen;
mod found;
mod lateral;
mod map;
mod matrices;
mod modes;
mod orders;
mod peaked;
mod periodic;
mod response;
mod roots;
mod shapes;
mod space;
mod speeds;
mod stability;
mod states;
mod stations;
mod subject;
mod through;
mod torsion;
mod words;

pub use self::asked::{Analysed, Asked, Described};
pub(crate) use self::at_points::{AtPoint, named, need_machine};
pub(crate) use self::foreseen::foreseen;
pub(crate) use self::space::Space;
pub(crate) use self::subject::Subject;
