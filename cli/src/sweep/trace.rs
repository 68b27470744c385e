//! What the figures of a sweep need of a point beside its row: where what oscillates is once a cycle, and its spectrum.
//! Numbers are rounded to single precision, finer than any figure, and their count is bounded, however long the run.

use std::io;

use serde::{Deserialize, Serialize};

use crate::case::{Case, System};
use crate::figures::{Spectrum, last_spectra};
use crate::history::ReadHistory;
use crate::machine::Built;
use crate::report::{Oscillation, oscillations};

/// Signals of a point at most: as many as a waterfall has panels.
const SIGNALS: usize = 6;
/// Cycles at most. They lie in the second half of the run, after what is due to its start.
const CYCLES: usize = 32;
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
    /// Once a cycle up to the end of the run, of each component.
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
        if let (System::Lumped(_), true) = (&case.system, all.is_empty()) {
            all.extend(mass(case));
        }
        all.truncate(SIGNALS);
        let positions = positions(history, &all, case.march.cycle)?;
        let step = case.march.time_step * case.march.output_every as f64;
        let spectra = last_spectra(history, &all, (step, case.march.cycle))?;
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
        unit: "µm",
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

/// Values once a cycle, on straight lines between rows, of every component of every signal.
fn positions(
    history: &dyn ReadHistory,
    all: &[Oscillation],
    cycle: f64,
) -> io::Result<Vec<Vec<Vec<f32>>>> {
    let end = history.last_time()?.unwrap_or(0.0);
    // Rounding is no reason to leave one out.
    let count = ((0.5 * end / cycle * (1.0 + 1e-9)) as usize + 1).min(CYCLES);
    let names = all.iter().flat_map(|own| own.columns.iter().map(|(name, _)| name.as_str()));
    let names: Vec<&str> = std::iter::once("t_s").chain(names).collect();
    let mut found: Vec<Vec<f32>> = vec![Vec::with_capacity(count); names.len() - 1];
    let mut times = (0..count).rev().map(|k| end - k as f64 * cycle).peekable();
    let mut before: Option<Vec<f64>> = None;
    // One row more, so that the first time lies between two of them.
    let from = history.place_of_time(end - count as f64 * cycle)?;
    history.scan(from, &names, &mut |row| {
        while let Some(time) = times.next_if(|time| *time <= row[0]) {
            let share = before.as_ref().map_or(1.0, |last| match row[0] > last[0] {
                true => ((time - last[0]) / (row[0] - last[0])).clamp(0.0, 1.0),
                false => 1.0,
            });
            let last = before.as_deref().unwrap_or(row);
            for ((found, last), value) in found.iter_mut().zip(&last[1..]).zip(&row[1..]) {
                found.push((last + share * (value - last)) as f32);
            }
        }
        match &mut before {
            Some(before) => before.copy_from_slice(row),
            None => before = Some(row.to_vec()),
        }
    })?;
    let mut found = found.into_iter();
    let of = |own: &Oscillation| found.by_ref().take(own.columns.len()).collect();
    Ok(all.iter().map(of).collect())
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::history::HistoryTable;

    /// Rows do not meet the cycle, and what repeats with it is at one place.
    #[test]
    fn what_repeats_every_cycle_is_at_one_place_and_what_takes_two_at_two() {
        let mut history = HistoryTable::new(["t_s", "x_um"].map(str::to_owned).to_vec());
        let cycle = 0.05;
        for step in 1..=10_000 {
            let t = 1.7e-4 * f64::from(step);
            let (once, half) = ((TAU * t / cycle).cos(), (0.5 * TAU * t / cycle).cos());
            history.push(&[t, 3.0 * once + half]).unwrap();
        }
        let all = [Oscillation {
            title: "disc".into(),
            quantity: "displacement",
            unit: "µm",
            columns: vec![("x_um".into(), "x")],
            angle: None,
        }];
        let found = positions(&history, &all, cycle).unwrap().remove(0).remove(0);
        assert_eq!(found.len(), 18);
        // 1.7 s: at the end and at every second cycle before. Straight lines leave out (ω h)²/8 of the curve.
        let error = 2.0 * (TAU / cycle * 1.7e-4).powi(2) / 8.0 * 4.0 + 1e-6;
        for (k, value) in found.iter().rev().enumerate() {
            let expected = if k % 2 == 0 { 4.0 } else { 2.0 };
            assert!((f64::from(*value) - expected).abs() < error, "{k}: {value} {error}");
        }
        assert_eq!(positions(&history, &all, 5.0).unwrap()[0][0].len(), 1);
        assert_eq!(positions(&history, &all, 1e-3).unwrap()[0][0].len(), CYCLES);
    }
}
