//! Peaks of many readings over speed, each speed looked at once for all of them.

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::fmt::Write;

use whirl_solver::Error;
use whirl_solver::linear::{Amplitude, Peak, Peaks, Resonance, peaks};

use super::words;

/// All readings at a speed (rad/s), not a number where there is none; nothing where the machine does not stand.
pub(super) type AtSpeed<'a> = dyn FnMut(f64) -> Result<Option<Vec<f64>>, Error> + 'a;

/// Readings over speed, with those that were taken.
pub(super) struct Readings<'a> {
    at: &'a mut AtSpeed<'a>,
    /// By readings: only those of one kind can be compared.
    kinds: Vec<usize>,
    taken: BTreeMap<u64, Option<Vec<f64>>>,
}

impl<'a> Readings<'a> {
    pub(super) fn new(kinds: Vec<usize>, at: &'a mut AtSpeed<'a>) -> Readings<'a> {
        Readings { at, kinds, taken: BTreeMap::new() }
    }

    /// The peaks of one of them within a range.
    ///
    /// # Errors
    /// Those of the readings.
    pub(super) fn peaks(
        &mut self,
        reading: usize,
        resonances: &[Resonance],
        range: [f64; 2],
    ) -> Result<Peaks, Error> {
        let Readings { at, kinds, taken } = self;
        let mut response = |speed: f64| -> Result<Option<Amplitude>, Error> {
            let all = match taken.entry(speed.to_bits()) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(new) => new.insert(at(speed)?),
            };
            Ok(all.as_ref().filter(|all| !all[reading].is_nan()).map(|all| {
                let alike = all.iter().zip(&*kinds).filter(|own| *own.1 == kinds[reading]);
                let largest = alike.map(|own| *own.0).fold(0.0, f64::max);
                Amplitude { own: all[reading], largest }
            }))
        };
        peaks(&mut response, resonances, range)
    }
}

/// What is made of a machine at a speed: none where it does not stand, or nothing limits its response.
///
/// # Errors
/// Any other error.
pub(super) fn standing<T>(made: Result<T, Error>) -> Result<Option<T>, Error> {
    match made {
        Ok(own) => Ok(Some(own)),
        Err(error) if error.is_of_balance() || error.is_singular() => Ok(None),
        Err(error) => Err(error),
    }
}

/// What is said of speeds (rpm) of a table at which nothing limits the response.
pub(super) fn left_out(speeds: &[String]) -> String {
    match speeds {
        [] => String::new(),
        speeds => format!(
            "note: {} rpm is left out: a critical speed without damping, at which nothing limits the response\n",
            speeds.join(", ")
        ),
    }
}

/// How an amplification factor was found.
pub(super) fn sides(own: &Peak) -> &'static str {
    match own.half_power {
        _ if own.is_undamped() => "undamped",
        [Some(_), Some(_)] => "both",
        [Some(_), None] => "below",
        [None, Some(_)] => "above",
        [None, None] => "",
    }
}

/// What is said of the peaks of readings: which have no damping, which are by one side only, and which readings are largest at an
/// end of the range. `what` they are readings of.
pub(super) fn notes(what: &str, all: &[(&str, &Peaks)]) -> String {
    let mut text = String::new();
    let listed = |of: &dyn Fn(&Peaks) -> Vec<f64>| -> Vec<String> {
        let told = all.iter().filter_map(|(name, own)| {
            let speeds: Vec<String> = of(own).into_iter().map(words::speed).collect();
            (!speeds.is_empty()).then(|| format!("{name} at {} rpm", speeds.join(", ")))
        });
        told.collect()
    };
    let of_peaks = |is: &'static dyn Fn(&Peak) -> bool| {
        listed(&move |own| own.all.iter().filter(|own| is(own)).map(|own| own.speed).collect())
    };
    let undamped = of_peaks(&Peak::is_undamped);
    if !undamped.is_empty() {
        let _ = writeln!(
            text,
            "note: {what}UNDAMPED peaks: {}; there the amplitude grows without limit, and what tables show beside is a matter of \
             their speeds. Give joints or bodies their damping",
            undamped.join("; ")
        );
    }
    let one_sided = of_peaks(&|own| matches!(sides(own), "below" | "above"));
    if !one_sided.is_empty() {
        let _ = writeln!(
            text,
            "note: {what}peaks that fall to 1/√2 on one side only, whose amplification factor is N_c/(2 |N_c - N_1|): {}",
            one_sided.join("; ")
        );
    }
    let flat = of_peaks(&|own| sides(own).is_empty());
    if !flat.is_empty() {
        let _ = writeln!(
            text,
            "note: {what}peaks that do not fall to 1/√2 on either side within the range, so that they have no amplification factor: {}",
            flat.join("; ")
        );
    }
    let ends = listed(&|own| own.end.iter().map(|own| own.0).collect());
    if !ends.is_empty() {
        let _ = writeln!(
            text,
            "note: {what}largest at an end of the range, which is no peak: {}; let `speeds` reach further to see what follows",
            ends.join("; ")
        );
    }
    text
}
