//! Bodies whose speed varies over a run: what oscillates with them is shown over speed.

use std::io;

use crate::history::ReadHistory;

/// Speed changes by this part at least, and places at which it is looked for.
const VARIES: f64 = 0.2;
const LOOKED_AT: u32 = 16;

/// Those of these columns of angles that turn with a speed that varies between two times (s), by their places, with their first and
/// last values (rad).
///
/// # Errors
/// The history cannot be read.
pub(crate) fn varying(
    history: &dyn ReadHistory,
    angles: &[&str],
    [begins, ends]: [f64; 2],
) -> io::Result<Vec<(usize, [f64; 2])>> {
    let wanted: Vec<&str> = ["t_s"].into_iter().chain(angles.iter().copied()).collect();
    let mut seen: Vec<Vec<f64>> = Vec::new();
    for k in 0..=LOOKED_AT {
        let time = begins + (ends - begins) * f64::from(k) / f64::from(LOOKED_AT);
        let place = history.place_of_time(time.min(ends))?;
        history.first_row(place, &wanted, &mut |row| seen.push(row.to_vec()))?;
    }
    let own = |at: usize| {
        let speed = |pair: &[Vec<f64>]| {
            ((pair[1][at + 1] - pair[0][at + 1]) / (pair[1][0] - pair[0][0])).abs()
        };
        let speeds: Vec<f64> =
            seen.windows(2).filter(|pair| pair[1][0] > pair[0][0]).map(speed).collect();
        let most = speeds.iter().copied().fold(0.0, f64::max);
        let least = speeds.iter().copied().fold(f64::INFINITY, f64::min);
        let span = [seen.first()?[at + 1], seen.last()?[at + 1]];
        (most > 0.0 && most - least >= VARIES * most).then_some((at, span))
    };
    Ok((0..angles.len()).filter_map(own).collect())
}
