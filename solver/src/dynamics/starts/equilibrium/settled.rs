//! States that only integrate, where the search takes them for settled.
//!
//! The balance gives such a state a value where that moves its input to where its rate is zero. Where it does not, as the speed that a
//! controller reads is told, or the state acts on nothing, s = h ṡ is ten times as much after ten times the time h.

use super::balance::Balance;
use super::search::search;
use crate::bearing::{Hold, LONG};
use crate::error::Error;

/// Multiple of the time, and that of the state from which on its rate is taken to stay.
const LONGER: f64 = 10.0;
const STAYS: f64 = 5.0;
/// Rates up to which a state rests (SI).
const RESTS: f64 = 1e-12;

/// States whose rates stay whatever they are, by their places among all; the balance is left as it was found.
pub(super) fn unsettled(balance: &mut Balance) -> Result<Vec<usize>, Error> {
    let has_integrators = balance.equations.springs.relaxing().any(|own| own == 0.0);
    if !has_integrators {
        return Ok(Vec::new());
    }
    let z = balance.unknowns();
    let first = balance.states();
    let before = balance.state.laws.clone();
    balance.state.laws.hold = Hold::Settled(LONGER * LONG);
    let later = match search(balance, Some(&z))? {
        Ok(_) => balance.states(),
        // Where nothing balances what they have become, they go on.
        Err(_) => first.iter().map(|own| LONGER * own).collect(),
    };
    balance.state.laws = before;
    balance.set(&z)?;
    let goes_on = |(first, later): (&f64, f64)| {
        first.abs() > RESTS * LONG && later.abs() > STAYS * first.abs()
    };
    let all = first.iter().zip(later).enumerate();
    Ok(all.filter(|(_, own)| goes_on(*own)).map(|(place, _)| place).collect())
}

/// Keeps states as their laws begin, and searches again.
pub(super) fn freeze(balance: &mut Balance, places: &[usize]) -> Result<bool, Error> {
    let starts = balance.machine.springs.starts();
    let known = starts.iter().enumerate();
    let known = known.map(|(place, own)| if places.contains(&place) { *own } else { f64::NAN });
    balance.state.laws.known = known.collect();
    let z = balance.unknowns();
    Ok(search(balance, Some(&z))?.is_ok())
}
