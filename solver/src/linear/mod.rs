//! Small motions of a machine about the states in which it stands at constant speeds.
//!
//! A [`Machine`] with bodies that are made exactly round ([`LinearMachine`]) → the balance of forces at the speeds
//! ([`LinearMachine::standing`]) → M, C′ and K′ of small motions seen from space ([`Linearised`]) → modes ([`Modes`]) → modes
//! followed over speeds ([`Campbell`]) → critical speeds and thresholds of stability; or → what acts on them and is seen of them
//! ([`StateSpace`]), for other programs.
//!
//! In the frames of bodies that turn the machine of section 5 varies with their angles. Round ones, whose tensors a turn
//! exp(αS) leaves as they are, do not if their coordinates are turned back: with q = exp(−Dt) z, D = Ω S for each body, the
//! equations M′z̈ + C′ż + K′z = 0 are constant, z being the motion seen from space. With a body that is not round they are
//! constant in its own frame, if all else is round and nothing stands in space (`varying`), or vary with its angle (Hill's
//! method, [`crate::linalg`]).

mod along;
mod applied;
mod beside;
mod by_angle;
mod campbell;
mod coefficients;
mod dependent;
mod doubts;
mod excited;
mod first_order;
mod frame;
mod golden;
mod growing;
mod hill;
mod in_space;
mod limits;
mod linearised;
mod load_orders;
mod map;
mod meeting;
mod modes;
mod motions;
mod own_frequency;
mod parametric;
mod peaks;
mod points;
mod range;
mod remembered;
mod resonances;
mod response;
mod rigid;
mod roots;
mod round;
mod shapes;
mod slow;
mod standing_loads;
mod state_doubts;
mod state_space;
mod stood;
#[cfg(test)]
mod tests;
mod through;
mod torsion;
mod track;
mod unheld;
mod varying;

pub use along::Along;
pub use applied::AppliedUnbalance;
pub use campbell::{Branch, Campbell, Critical, Reduced};
pub use coefficients::JointCoefficients;
pub use doubts::Doubt;
pub use excited::Excited;
pub use growing::Growing;
pub use limits::Limit;
pub use linearised::{Linearised, Standstill};
pub use map::{Undamped, Unsupported};
pub use modes::{Mode, Modes, Orbit, Whirl};
pub use peaks::{Amplitude, Peak, Peaks, peaks};
pub use range::Range;
pub use resonances::Resonance;
pub use response::{Point, Vibration};
pub use roots::Threshold;
pub use round::LinearMachine;
pub use standing_loads::Counted;
pub use state_doubts::StateDoubts;
pub use state_space::StateSpace;
pub use through::Through;
pub use torsion::{Node, Torque, Torsion, Way};

#[cfg(doc)]
use crate::machine::Machine;
