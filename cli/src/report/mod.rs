//! Results of a run: summary and tables.

mod below;
mod envelope;
mod films;
mod fit;
mod orders;
mod oscillations;
mod summary;
mod table;
mod tracked;
mod varying;
mod verdict;

use std::io;

pub(crate) use envelope::{Envelope, Enveloper, Extremes};
pub(crate) use films::{FilmChart, films};
pub(crate) use orders::{OrderFacts, orders};
pub(crate) use oscillations::{Oscillation, angle, oscillations, shown_unit};
pub(crate) use summary::{Summary, Times};
pub(crate) use table::{of_orders, stops, supports, table};
pub(crate) use tracked::{Tracked, TrackedSignal, Tracker};
pub(crate) use varying::varying;
pub(crate) use verdict::VerdictFacts;

use crate::history::ReadHistory;

/// Where the rows of the last `cycle` seconds begin.
pub(crate) fn last_cycle(history: &dyn ReadHistory, cycle: f64) -> io::Result<u64> {
    let end = history.last_time()?.unwrap_or(0.0);
    // A row that lies a rounding error, of the sum or of its ten digits, before the cycle belongs to it.
    history.place_of_time(end - cycle - 1e-9 * (cycle + end))
}

/// When the rows of a history begin (s), which are `step` s apart: 0, or where a run goes on from another one.
pub(crate) fn begun(history: &dyn ReadHistory, step: f64) -> io::Result<f64> {
    let mut begun = 0.0;
    history.first_row(history.start(), &["t_s"], &mut |row| begun = row[0] - step)?;
    Ok(begun)
}
