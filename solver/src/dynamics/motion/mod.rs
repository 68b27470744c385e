//! What of the motion of a machine is judged by itself: its parts, its turns, and what of them is in which modes.
//!
//! ```text
//! parts      parts: bodies and rotations that joints hold, by masses; named to others as moving_part
//! turns      turns of bodies that nothing elastic holds
//! modes      modes; linearised: in which kinds of them a part moves, for as long as they hold; stiffest: the fastest at an instant
//! worst      the larger of two measures, and of what share of what they may be
//! ```

mod linearised;
mod masses;
mod modes;
mod moving_part;
mod parts;
mod stiffest;
mod turns;
mod worst;

pub(super) use linearised::{Kind, Linearised, PartMotion, Place};
pub(super) use modes::MachineModes;
pub use moving_part::MovingPart;
pub(super) use moving_part::{SMALLEST, StepLength};
pub(super) use parts::{Part, Parts, largest_sensible};
pub(super) use stiffest::largest_eigenvalue;
pub(super) use turns::{FreeTurn, TurnRange, reach, widen};
pub(super) use worst::{larger, ratio, worse};
