//! The machine as it was linearised during a march: in these modes its steps are judged, until they are no longer its own.
//!
//! What a machine is held by changes on the way: films carry, clearances close. Whether the modes still hold is read from the
//! motion of a step itself, by the quotient of Rayleigh of its part in every kind of mode: the work that elastic forces do on it
//! by the stiffness of the modes, and by as much more as the forces of the step were others. It takes no tangent and no
//! eigenvalue.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::modes::MachineModes;
use super::parts::Part;
use crate::equations::{Equations, State};
use crate::error::Error;
use crate::told::ToldLoad;

/// Where a machine was linearised: enough to do it again with the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::dynamics) struct Place {
    time: f64,
    state: State,
    released: Vec<bool>,
    told: Vec<Option<ToldLoad>>,
}

impl Place {
    /// Where a system was just evaluated.
    pub(in crate::dynamics) fn of(equations: &Equations, state: &State) -> Self {
        let (released, told) = (equations.released.clone(), equations.told.clone());
        Place { time: equations.time, state: state.clone(), released, told }
    }
}

/// Motions slower than ωΔt = 1e-3, more than 6000 steps a period, are as good as free.
const SLOW: f64 = 1e-6;
/// Share in a mode from which on a part takes part in it.
const SHARE: f64 = 1e-9;
/// Kinds of modes are told apart by ω², here with a margin: within it, neither kind is wrong.
const MARGIN: f64 = 4.0;
/// Share of a step's motion, by its kinetic energy, that counts; and the motion that counts, of the largest displacement.
const COUNTS: f64 = 0.01;
const MOVES: f64 = 1e-6;

/// What acts on the motion in a kind of mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::dynamics) enum Kind {
    /// Nothing.
    Free,
    /// What the step resolves: ωΔt < 1.
    Resolved,
    /// What it does not.
    Fast,
}

impl Kind {
    pub(in crate::dynamics) const ALL: [Kind; 3] = [Kind::Free, Kind::Resolved, Kind::Fast];
}

/// A linearised machine.
pub(in crate::dynamics) struct Linearised {
    modes: MachineModes,
    /// Longest step (s).
    length: f64,
    /// By parts of the machine the least ω² of the modes in which the part moves and on which something acts ((rad/s)²);
    /// infinite where there is none, as of a body that nothing touches.
    slowest: Vec<f64>,
}

impl Linearised {
    /// At a state that was just evaluated, and is again, for steps of `length` s at most: states of laws that a step has found are
    /// then those that are found from the state alone, to the bit.
    ///
    /// # Errors
    /// A mass matrix that is not positive definite.
    pub(in crate::dynamics) fn new(
        equations: &mut Equations,
        parts: &[Part],
        length: f64,
        state: &State,
    ) -> Result<Self, Error> {
        // What begins at this instant acts, whichever side of it the step was on.
        let before = std::mem::replace(&mut equations.before, false);
        let time = equations.time;
        equations.evaluate(time, state);
        let modes = MachineModes::told_apart(equations, state, (SLOW / (length * length), length));
        equations.before = before;
        equations.evaluate(time, state);
        let modes = modes?;
        let [acted, fast] = modes.acted(0.0);
        let slowest = parts.iter().map(|part| {
            let mut own = (acted.start..fast.end)
                .filter(|mode| modes.share(*mode, part.place.clone()) > SHARE);
            own.next().map_or(f64::INFINITY, |mode| modes.square(mode))
        });
        Ok(Linearised { slowest: slowest.collect(), modes, length })
    }

    /// Where it was done before; the system is evaluated there.
    ///
    /// # Errors
    /// A mass matrix that is not positive definite.
    pub(in crate::dynamics) fn again(
        equations: &mut Equations,
        parts: &[Part],
        length: f64,
        place: &Place,
    ) -> Result<Self, Error> {
        let released = std::mem::replace(&mut equations.released, place.released.clone());
        let told = std::mem::replace(&mut equations.told, place.told.clone());
        equations.evaluate(place.time, &place.state);
        let new = Linearised::new(equations, parts, length, &place.state);
        (equations.released, equations.told) = (released, told);
        new
    }

    /// Whether anything acts on a part.
    pub(in crate::dynamics) fn is_held(&self, part: usize) -> bool {
        self.slowest[part] < f64::INFINITY
    }

    /// Whether a part moves in modes that a step of `dt` s resolves, or that are free: its error can be judged.
    pub(in crate::dynamics) fn resolves(&self, part: usize, dt: f64) -> bool {
        !self.is_held(part) || self.slowest[part] * dt * dt < 1.0
    }

    /// ω of the fastest mode (rad/s).
    pub(in crate::dynamics) fn fastest(&self) -> f64 {
        self.modes.fastest()
    }

    fn range(&self, kind: Kind, dt: f64) -> Range<usize> {
        let [resolved, fast] = self.modes.acted(1.0 / (dt * dt));
        match kind {
            Kind::Free => self.modes.free(),
            Kind::Resolved => resolved,
            Kind::Fast => fast,
        }
    }

    /// Writes what of a motion of the unknowns is in a kind of modes of a step of `dt` s.
    pub(in crate::dynamics) fn part(&self, kind: Kind, dt: f64, x: &[f64], out: &mut [f64]) {
        self.modes.part(self.range(kind, dt), x, out);
    }

    /// Writes the acceleration by a force on the unknowns in the modes that a step of `dt` s resolves.
    pub(in crate::dynamics) fn driven(&self, dt: f64, force: &[f64], out: &mut [f64]) {
        self.modes.driven(self.range(Kind::Resolved, dt), force, out);
    }

    /// Writes K x, K the stiffness in these modes.
    pub(in crate::dynamics) fn pull(&self, x: &[f64], out: &mut [f64]) {
        self.modes.pull(x, out);
    }

    /// In which kinds of modes a part moves otherwise than they are, by its motion in a step of `dt` s; `displacement`: its largest
    /// so far (m).
    pub(in crate::dynamics) fn changed(
        &self,
        dt: f64,
        moved: &PartMotion,
        displacement: f64,
    ) -> [bool; 3] {
        let all: f64 = moved.squares.iter().sum();
        let counts = all.sqrt() > MOVES * displacement * moved.mass.sqrt();
        let fast = 1.0 / (dt * dt);
        std::array::from_fn(|place| {
            let [square, work] = [moved.squares, moved.works].map(|own| own[place]);
            let now = work + moved.changes[place];
            counts
                && square > COUNTS * all
                && match Kind::ALL[place] {
                    Kind::Free => now.abs() > MARGIN * SLOW / (self.length * self.length) * square,
                    Kind::Resolved => now > MARGIN * (fast * square).max(work.abs()),
                    Kind::Fast => MARGIN * now < (fast * square).min(work.abs()),
                }
        })
    }
}

/// What a part of the machine moved by in a step, in each kind of modes.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::dynamics) struct PartMotion {
    /// Δqᵀ M Δq.
    pub(in crate::dynamics) squares: [f64; 3],
    /// Δqᵀ K Δq by the stiffness in these modes, and by how much what springs and deformations held against changed it.
    pub(in crate::dynamics) works: [f64; 3],
    pub(in crate::dynamics) changes: [f64; 3],
    /// What divides a square to make it that of a displacement (kg).
    pub(in crate::dynamics) mass: f64,
}
