//! How a step is solved: made equations for the positions at its end, and these by Newton's method.
//!
//! ```text
//! step       newmark: rates and accelerations by the positions at the end of a step
//! iteration  newton: extrapolation ─▶ direction ─▶ merit, until rows are solved; halvings: where they are not
//! direction  factors (factored), kept while they pay (costs); what they lack by secants, or condensed: in the measures of joints
//! besides    kept_columns: vectors of the last steps, for extrapolation and secants
//! ```

mod condensed;
mod costs;
mod extrapolation;
mod factored;
mod factors;
mod halvings;
mod kept_columns;
mod merit;
mod newmark;
mod newton;
mod rows;
mod secants;

pub(super) use halvings::Halvings;
pub use halvings::{HalvedAt, HalvedSteps};
pub use newmark::{Coefficients, Integrator, Newmark};
pub use newton::NewtonOptions;
pub(super) use newton::{Ending, Newton, NewtonState, StepReport};
