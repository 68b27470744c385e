//! What the figures of a sweep need of a point beside its row: where what oscillates is once a cycle, and its spectrum.
//! Numbers are rounded to single precision, finer than any figure, and their count is bounded, however long the run.

use std::collections::VecDeque;
use std::f64::consts::TAU;
use std::io;

use serde::{Deserialize, Serialize};

use crate::case::{Case, TWO_REVOLUTIONS};
use crate::figures::{Spectrum, last_spectra};
use crate::history::ReadHistory;
use crate::machine::Built;
use crate::report::{Oscillation, oscillations};

/// Signals of a point at most: as many as a waterfall has panels.
const SIGNALS: usize = 6;
/// Cycles at most. They lie in the second half of the run, after what is due to its start.
const CYCLES: usize = 32;
/// Part of a revolution by which a cycle may miss whole ones.
const MISSED: f64 = 0.01;
/// Points of a spectrum at most.
const LINES: usize = 200;

/// Of all signals of a point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Trace(pub(super) Vec<Traced>);

/// Of one signal.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Traced {
    /// The support, the joint or the output.
    pub(super) title: String,
    /// What it is, such as `displacement`.
    pub(super) quantity: String,
    pub(super) unit: String,
    /// What its components are called.
    pub(super) axes: Vec<String>,
    /// Once a cycle, at the same phase of it, of each component.
    pub(super) positions: Vec<Vec<f32>>,
    /// Frequencies (Hz) and amplitudes of the first component over the last cycles.
    pub(super) spectrum: Vec<[f32; 2]>,
    /// How fast its body turns (Hz) in these cycles; 0 where it does not.
    pub(super) speed: f64,
}

impl Trace {
    /// Of a run.
    ///
    /// # Errors
    /// Its history cannot be read.
    pub(super) fn of(case: &Case, built: &Built, history: &dyn ReadHistory) -> io::Result<Self> {
        let mut all = oscillations(case, &built.machine);
        if case.machine.is_mass() && all.is_empty() {
            all.extend(mass(case));
        }
        all.truncate(SIGNALS);
        let alone = case.march().cycle_called == TWO_REVOLUTIONS;
        let positions = positions(history, &all, (case.march().cycle, alone))?;
        let step = case.march().time_step * case.march().output_every as f64;
        let spectra = last_spectra(history, &all, (step, case.march().cycle))?;
        let mut spectra = spectra.map_or(Vec::new(), |own| own.signals).into_iter();
        let traced = |(own, positions): (Oscillation, Vec<Vec<f32>>)| {
            let (found, speed) = spectra.next().unwrap_or_default();
            Traced {
                title: own.title,
                quantity: own.quantity.to_owned(),
                unit: own.unit.to_owned(),
                axes: own.columns.iter().map(|(_, axis)| axis.to_lowercase()).collect(),
                positions,
                spectrum: found.first().map_or(Vec::new(), |own| lines(own, speed)),
                speed,
            }
        };
        Ok(Trace(all.into_iter().zip(positions).map(traced).collect()))
    }
}

/// The mass of a case in which nothing turns.
fn mass(case: &Case) -> Option<Oscillation> {
    let first = case.supports().into_iter().next()?;
    Some(Oscillation {
        title: "Mass".to_owned(),
        quantity: "displacement",
        unit: "µm".to_owned(),
        columns: vec![(first.column("X", "um"), "x")],
        angle: None,
    })
}

/// A spectrum as far as there is anything in it, and at least beyond the second order.
fn lines(spectrum: &Spectrum, speed: f64) -> Vec<[f32; 2]> {
    let end = 1.1 * spectrum.end(spectrum.largest()).max(2.5 * speed);
    let points = spectrum.points(end, LINES).into_iter();
    points.map(|(x, y)| [x as f32, y as f32]).collect()
}

/// By what a signal is seen once a cycle: whenever a column passes a multiple of a value, an angle or a time.
struct Strobe {
    column: String,
    period: f64,
}

impl Strobe {
    /// Of a signal whose body turns a whole number of revolutions in a cycle its angle, so that all runs are seen at the same
    /// phase of what turns, whatever their start; else the time. `alone`: whether nothing but rotation repeats: once a
    /// revolution then, as what takes two of them is to be seen as two.
    fn of(
        history: &dyn ReadHistory,
        own: &Oscillation,
        (cycle, alone): (f64, bool),
    ) -> io::Result<Self> {
        let by_time = Strobe { column: "t_s".to_owned(), period: cycle };
        let (Some(end), Some(angle)) = (history.last_time()?, &own.angle) else {
            return Ok(by_time);
        };
        let at = |place| -> io::Result<[f64; 2]> {
            let mut found = [0.0; 2];
            let columns = ["t_s", angle.as_str()];
            history.first_row(place, &columns, &mut |row| found = [row[0], row[1]])?;
            Ok(found)
        };
        let [first, start] = at(second_half(history)?)?;
        let [last, stop] = at(history.place_of_time(end)?)?;
        let turns = (stop - start).abs() / TAU / (last - first) * cycle;
        let whole = if alone && turns > MISSED { 1.0 } else { turns.round() };
        let fits = whole >= 1.0 && (alone || (turns - whole).abs() < MISSED);
        let by_angle = || Strobe { column: angle.clone(), period: TAU * whole };
        Ok(if fits { by_angle() } else { by_time })
    }
}

/// Values once a cycle, on straight lines between rows, of every component of every signal: the last ones.
fn positions(
    history: &dyn ReadHistory,
    all: &[Oscillation],
    cycle: (f64, bool),
) -> io::Result<Vec<Vec<Vec<f32>>>> {
    let strobes =
        all.iter().map(|own| Strobe::of(history, own, cycle)).collect::<io::Result<Vec<_>>>()?;
    let mut names: Vec<&str> = Vec::new();
    for (own, strobe) in all.iter().zip(&strobes) {
        names.push(&strobe.column);
        names.extend(own.columns.iter().map(|(name, _)| name.as_str()));
    }
    let empty = |own: &Oscillation| vec![VecDeque::with_capacity(CYCLES); own.columns.len()];
    let mut found: Vec<Vec<VecDeque<f32>>> = all.iter().map(empty).collect();
    let mut before: Option<Vec<f64>> = None;
    history.scan(second_half(history)?, &names, &mut |row| {
        let Some(before) = &mut before else {
            before = Some(row.to_vec());
            return;
        };
        let mut place = 0;
        for (found, strobe) in found.iter_mut().zip(&strobes) {
            let part = passage(before[place] / strobe.period, row[place] / strobe.period);
            for (k, found) in found.iter_mut().enumerate() {
                let (last, next) = (before[place + 1 + k], row[place + 1 + k]);
                if let Some(part) = part {
                    if found.len() == CYCLES {
                        found.pop_front();
                    }
                    found.push_back((last + part * (next - last)) as f32);
                }
            }
            place += 1 + found.len();
        }
        before.copy_from_slice(row);
    })?;
    Ok(found.into_iter().map(|own| own.into_iter().map(Vec::from).collect()).collect())
}

/// Where the second half of a run begins.
fn second_half(history: &dyn ReadHistory) -> io::Result<u64> {
    let mut first = 0.0;
    history.first_row(history.start(), &["t_s"], &mut |row| first = row[0])?;
    let last = history.last_time()?.unwrap_or(first);
    history.place_of_time(0.5 * (first + last))
}

/// The part of a step after which a whole number is passed, if one is, whichever way.
fn passage(before: f64, after: f64) -> Option<f64> {
    let whole = before.floor().max(after.floor());
    (before.floor() != after.floor()).then(|| (whole - before) / (after - before))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::history::HistoryTable;

    const STEP: f64 = 1.7e-4;

    /// What oscillates over t and θ, in rows that do not meet its cycle.
    fn seen(
        cycle: (f64, bool),
        angle: impl Fn(f64) -> f64,
        value: impl Fn(f64, f64) -> f64,
    ) -> Vec<f64> {
        let names = ["t_s", "theta_rad", "x_um"].map(str::to_owned).to_vec();
        let mut history = HistoryTable::new(names);
        for step in 1..=10_000 {
            let t = STEP * f64::from(step);
            history.push(&[t, angle(t), value(t, angle(t))]).unwrap();
        }
        let all = [Oscillation {
            title: "disc".into(),
            quantity: "displacement",
            unit: "µm".to_owned(),
            columns: vec![("x_um".into(), "x")],
            angle: Some("theta_rad".into()),
        }];
        let found = positions(&history, &all, cycle).unwrap().remove(0).remove(0);
        found.into_iter().map(f64::from).collect()
    }

    /// Straight lines between rows leave out (ω h)²/8 of an amplitude of 4.
    const ERROR: f64 = 4.0 * (TAU * 20.0 * STEP) * (TAU * 20.0 * STEP) / 8.0 + 1e-6;

    #[test]
    fn what_repeats_every_cycle_is_at_one_place_and_what_takes_two_at_two() {
        // Nothing turns: by time.
        let found = seen(
            (0.05, false),
            |_| 0.0,
            |t, _| 3.0 * (TAU * 20.0 * t).cos() + (TAU * 10.0 * t).cos(),
        );
        assert!((16..=18).contains(&found.len()), "{found:?}");
        for pair in found.windows(2) {
            let places = [pair[0].max(pair[1]), pair[0].min(pair[1])];
            let [far, near] = [places[0] - 4.0, places[1] - 2.0];
            assert!(far.abs() < ERROR && near.abs() < ERROR, "{found:?}");
        }
        assert!(seen((5.0, false), |_| 0.0, |t, _| t).is_empty());
        assert_eq!(seen((1e-3, false), |_| 0.0, |t, _| t).len(), CYCLES);
    }

    /// Whatever the angle at the start, and backwards, too.
    #[test]
    fn what_turns_is_seen_at_its_own_phase() {
        for (start, sign) in [(0.0, 1.0), (1.3, 1.0), (2.0, -1.0)] {
            let angle = |t: f64| start + sign * TAU * 20.0 * t;
            let wave = |_, theta: f64| 3.0 * theta.cos() + (0.5 * theta).cos();
            // A cycle of two revolutions that nothing else asks for, and one of the loads.
            let (once, twice) = (seen((0.1, true), angle, wave), seen((0.1, false), angle, wave));
            assert!((16..=18).contains(&once.len()) && (8..=9).contains(&twice.len()));
            assert!(once.windows(2).all(|pair| ((pair[0] - pair[1]).abs() - 2.0).abs() < ERROR));
            assert!(twice.iter().all(|own| (own - 4.0).abs() < ERROR), "{twice:?}");
        }
        // Loads that have nothing to do with the angle are seen at their own phase.
        let found = seen((0.05, false), |t| 77.0 * t, |t, _| (TAU * 20.0 * t).cos());
        assert!(found.iter().all(|own| (own - 1.0).abs() < ERROR), "{found:?}");
    }
}
