//! What directions cost, all in one unit: whatever is kept for them is made anew once steps have spent as much more than the
//! best of them did.

/// What is done for directions.
#[derive(Clone, Copy)]
pub(super) enum Work {
    /// An iteration of a step.
    Iteration,
    /// A correction of the measures within one, of the condensed iteration.
    Correction,
    /// Bodies that turn solved twice in a step of it.
    Again,
    /// Its bodies evaluated.
    Bodies,
    /// A matrix of so many rows factored: an iteration for each row.
    Factors(usize),
    /// The same with what the condensed iteration makes of it.
    Prepared(usize),
}

/// In units of which a correction takes eight.
pub(super) const fn cost(work: Work) -> usize {
    match work {
        Work::Again => 3,
        Work::Correction => 8,
        Work::Iteration => 4 * cost(Work::Correction),
        Work::Bodies => 6 * cost(Work::Iteration),
        Work::Factors(rows) => rows * cost(Work::Iteration),
        Work::Prepared(rows) => 3 * cost(Work::Factors(rows)),
    }
}
