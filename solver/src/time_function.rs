//! How loads vary: in time, with the angle of a body, with a speed.

use std::sync::Arc;

use crate::bodies::BodyPlace;
use crate::curve::Curve;

/// How a load varies.
#[derive(Debug, Clone, PartialEq)]
pub enum TimeFunction {
    /// Constant from t = 0.
    Constant,
    /// sin(2π f t + φ).
    Sine {
        /// f (Hz).
        frequency: f64,
        /// φ (rad).
        phase: f64,
    },
    /// sin(nθ + φ), with θ of a body that turns.
    Order {
        /// The body, by its place in the machine.
        body: usize,
        /// n.
        order: f64,
        /// φ (rad).
        phase: f64,
    },
    /// A curve over t (s).
    OverTime(Arc<Curve>),
    /// A curve over θ (rad) of a body that turns.
    OverAngle {
        /// The body, by its place in the machine.
        body: usize,
        /// Values over θ.
        curve: Arc<Curve>,
    },
    /// A curve over the speed (rad/s) of that on which the load acts: θ̇ of its body, and of a couple what its section turns beside
    /// that.
    OverSpeed(Arc<Curve>),
    /// Constant until θ̇ is at the target or beyond it; zero from then on.
    UntilSpeed(Target),
}

/// A speed at which a load ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    /// θ̇ (rad/s).
    pub speed: f64,
    /// Whether the load brings the speed down to it, as a negative couple does, and not up.
    pub from_above: bool,
    /// When it ends.
    pub release: Release,
}

/// When a couple ends that acts until a speed is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Release {
    /// At the instant at which the speed is reached: the step is split there, and θ is of second order in Δt.
    Located,
    /// When a step starts at the speed or beyond it: θ is of first order in Δt.
    AtStep,
}

/// From when on a load acts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Onset {
    /// From t = 0.
    Start,
    /// From a time (s).
    Step(f64),
    /// From nothing at the first time (s) to all at the second one, in proportion.
    Ramp(f64, f64),
}

/// An instant, as loads see it.
#[derive(Clone, Copy)]
pub(crate) struct Instant<'s> {
    /// s.
    pub(crate) t: f64,
    /// Whether what begins at this instant does not act yet.
    pub(crate) before: bool,
    pub(crate) q: &'s [f64],
    pub(crate) v: &'s [f64],
    pub(crate) places: &'s [BodyPlace],
}

impl Instant<'_> {
    /// θ of a body, and its place in q; none of one that does not turn.
    fn angle(&self, body: usize) -> Option<(usize, f64)> {
        let place = self.places[body].rotation?;
        Some((place, self.q[place]))
    }
}

/// A derivative of a factor.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Slope {
    /// By the θ at this place of q (1/rad).
    Angle(usize, f64),
    /// By the speed of that on which the load acts (s/rad).
    Speed(f64),
}

impl Onset {
    /// The part of the load that acts at an instant.
    pub(crate) fn factor(self, &Instant { t, before, .. }: &Instant) -> f64 {
        match self {
            Onset::Start => 1.0,
            // A sum of steps may miss a time by rounding.
            Onset::Step(from) if before => f64::from(t > from + 1e-12 * from.abs()),
            Onset::Step(from) => f64::from(t >= from - 1e-12 * from.abs()),
            Onset::Ramp(from, to) => ((t - from) / (to - from)).clamp(0.0, 1.0),
        }
    }
}

impl TimeFunction {
    /// The body whose angle it follows.
    pub fn follows(&self) -> Option<usize> {
        match self {
            TimeFunction::Order { body, .. } | TimeFunction::OverAngle { body, .. } => Some(*body),
            _ => None,
        }
    }

    /// The body whose angle it follows, and periods in one radian times 2π, where it has any.
    pub(crate) fn periods(&self) -> Option<(usize, f64)> {
        let (body, rate) = match self {
            TimeFunction::Order { body, order, .. } => (*body, order.abs()),
            TimeFunction::OverAngle { body, curve } => {
                (*body, std::f64::consts::TAU / curve.period()?)
            }
            _ => return None,
        };
        (rate > 0.0).then_some((body, rate))
    }

    /// The same, following the body at another place if it follows one.
    pub(crate) fn of(&self, body: usize) -> TimeFunction {
        match self.clone() {
            TimeFunction::Order { order, phase, .. } => TimeFunction::Order { body, order, phase },
            TimeFunction::OverAngle { curve, .. } => TimeFunction::OverAngle { body, curve },
            other => other,
        }
    }

    /// The factor on the amplitude of a load on what turns at a speed; `released` once the target speed was reached.
    pub(crate) fn factor(&self, at: &Instant, speed: impl FnOnce() -> f64, released: bool) -> f64 {
        match self {
            TimeFunction::Constant => 1.0,
            TimeFunction::Sine { frequency, phase } => {
                (std::f64::consts::TAU * frequency * at.t + phase).sin()
            }
            TimeFunction::UntilSpeed(_) => f64::from(!released),
            TimeFunction::Order { body, order, phase } => {
                let theta = at.angle(*body).map_or(0.0, |(_, theta)| theta);
                (order * theta + phase).sin()
            }
            TimeFunction::OverTime(curve) => curve.value(at.t),
            TimeFunction::OverAngle { body, curve } => {
                curve.value(at.angle(*body).map_or(0.0, |(_, theta)| theta))
            }
            TimeFunction::OverSpeed(curve) => curve.value(speed()),
        }
    }

    /// Its derivative by what moves.
    pub(crate) fn slope(&self, at: &Instant, speed: impl FnOnce() -> f64) -> Option<Slope> {
        match self {
            TimeFunction::Order { body, order, phase } => {
                let (place, theta) = at.angle(*body)?;
                Some(Slope::Angle(place, order * (order * theta + phase).cos()))
            }
            TimeFunction::OverAngle { body, curve } => {
                let (place, theta) = at.angle(*body)?;
                Some(Slope::Angle(place, curve.slope(theta)))
            }
            TimeFunction::OverSpeed(curve) => Some(Slope::Speed(curve.slope(speed()))),
            TimeFunction::Constant
            | TimeFunction::Sine { .. }
            | TimeFunction::OverTime(_)
            | TimeFunction::UntilSpeed(_) => None,
        }
    }
}
