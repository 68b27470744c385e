//! What of a machine rings, and how much.

/// Amplitude of what alternates from step to step, as a fraction of the range of the same quantity: peaks are off by so much.
pub(super) const RINGING: f64 = 0.02;

/// What of a machine rings, and how much.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Ringing {
    /// Largest amplitude of an alternation that lasts, of velocities that which one step in twenty exceeds, as a fraction of the
    /// range of the same quantity, of the one where it is largest. What alternates alone does so by half of its range.
    pub share: f64,
    /// Where it is that.
    pub of: Option<RingingPart>,
    /// Whether the integrator damps what rings.
    pub damped: bool,
}

/// A quantity that may ring.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RingingPart {
    /// The force at a bearing, counted from 0.
    Force(usize),
    /// A moment there.
    Moment(usize),
    /// The couple of all loads and drives on the rotation of a body.
    Couple(usize),
    /// The speed of rotation of a body.
    Speed(usize),
    /// The velocities of a body in its frame, root mean square over its mass.
    Velocity(usize),
}

/// Second differences in a row that have to alternate: with a spectral radius of 0.9 what rings has fallen to 1.5 % then.
pub(super) const LASTS: f64 = 40.0;
