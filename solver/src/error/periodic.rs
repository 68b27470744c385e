//! Why a machine has no cycle, or its periodic motion was not found.

/// Why a machine has no cycle, or its periodic motion was not found.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PeriodicError {
    /// A body that turns freely, with nothing that ties it to one whose speed is known.
    #[error("{body} turns freely: how far it turns in a cycle is not known")]
    TurnsFreely {
        /// Its name.
        body: String,
    },
    /// A speed that changes.
    #[error("the speed of {body} changes: it does not repeat")]
    SpeedChanges {
        /// The name of the body.
        body: String,
    },
    /// A body that does not turn by whole turns.
    #[error("{body} turns {turns} times in the cycle of {period} s, which are no whole turns")]
    NotWhole {
        /// Its name.
        body: String,
        /// How often it turns.
        turns: f64,
        /// s.
        period: f64,
    },
    /// A load by a table over time that does not repeat.
    #[error("{load} goes by a table over time that does not repeat")]
    OneOff {
        /// Its name.
        load: String,
    },
    /// A law with states, or a film, of which harmonics know nothing.
    #[error("{joint} has the law {law}, which has states: harmonics are balanced of motions only")]
    Remembers {
        /// The joint.
        joint: String,
        /// The law.
        law: String,
    },
    /// A film in a branch, which would take a cycle for each of its values at every point.
    #[error(
        "{joint} has the film {law}, and films and laws of the machine remember {values} values, each of which takes two cycles at every point of a branch: at most {most} are followed"
    )]
    ManyValues {
        /// The joint.
        joint: String,
        /// The law.
        law: String,
        /// Values that films and laws remember: one a node of a film.
        values: usize,
        /// So many are followed.
        most: usize,
    },
    /// Nothing turns, and no load changes.
    #[error("nothing turns and no load repeats: there is no cycle")]
    NothingRepeats,
    /// Two things without a common period.
    #[error(
        "{} ({} Hz) and {} ({} Hz) have no common period: their ratio is nearest to {}/{}", .all[0], .hertz[0], .all[1], .hertz[1],
        .nearest[0], .nearest[1]
    )]
    NoCommon {
        /// What they are, the slowest of all first.
        all: [String; 2],
        /// Hz.
        hertz: [f64; 2],
        /// The quotient of whole numbers nearest to that of the second over the first.
        nearest: [f64; 2],
    },
    /// Something that goes with a frequency of its own beside a motion that should have the only one.
    #[error("{what} drives the machine: a motion of its own would have two frequencies")]
    Driven {
        /// What, in words.
        what: String,
    },
    /// Nothing turns, so that nothing tells how long a motion may take.
    #[error("nothing turns, so that nothing tells about how long the motion takes")]
    NoFrequency,
    /// A machine that comes to rest.
    #[error("the motion dies out: the machine does not keep itself going")]
    DiesOut,
    /// Harmonics whose residual was not brought to zero.
    #[error("no motion was found in which the first {harmonics} harmonics are balanced")]
    NotBalanced {
        /// How many.
        harmonics: usize,
    },
    /// Fewer harmonics than something that repeats in the cycle has.
    #[error("{harmonics} harmonics leave out {what}, which repeats {times} times in the cycle")]
    LeftOut {
        /// How many there are.
        harmonics: usize,
        /// What it is, in words.
        what: String,
        /// How often it repeats.
        times: usize,
    },
    /// A load that is another one after the cycle.
    #[error("{load} does not repeat after the cycle of {period} s")]
    NotRepeated {
        /// Its name.
        load: String,
        /// s.
        period: f64,
    },
    /// No periodic motion where it was looked for.
    #[error(
        "no periodic motion was found in {cycles} cycles: what a cycle does not close is {miss:.1e} of the motion, and was {least:.1e} at best"
    )]
    NotFound {
        /// Cycles marched.
        cycles: usize,
        /// ‖x(T) − x(0)‖/‖x‖ in the energy norm at the end, and the least.
        miss: f64,
        /// The same at best.
        least: f64,
    },
    /// A value of a parameter with which there is no machine.
    #[error("there is no machine with the value {value}")]
    NoMachine {
        /// The value.
        value: f64,
    },
    /// It was to end before.
    #[error("interrupted after {cycles} cycles")]
    Interrupted {
        /// Cycles marched.
        cycles: usize,
    },
}
