//! Spectra of what oscillates: over the last part of a run, and over a run-up.
//!
//! Amplitudes are those of sines, from 0 to the peak, 2 |X| / Σ w with Hann window w, the mean taken off. A span of whole
//! cycles puts what repeats with them on lines of the spectrum, where the amplitude is exact; zeros behind it put more lines
//! between these.

use std::collections::VecDeque;
use std::f64::consts::TAU;
use std::io;

use num_complex::Complex;
use realfft::RealFftPlanner;

use super::figure::{Figure, Line, Mark, Panel, Style};
use super::orders::ORDERS;
use super::stack::{Stacked, stack};
use crate::history::ReadHistory;
use crate::report::{Oscillation, begun};

/// Cycles of a spectrum at most, and rows.
const CYCLES: f64 = 16.0;
const MOST_ROWS: usize = 1 << 17;
/// Values of a transform about which few are filled up with zeros.
const PADDED: usize = 1 << 13;
/// Amplitudes below this part of the largest are not worth an axis.
const SMALL: f64 = 0.01;
/// Points of a line at most.
const POINTS: usize = 400;
/// Spectra of a run-up, and into how many parts of the run one reaches.
const SLICES: usize = 32;
const REACH: usize = 16;
/// Speed changes by this part at least in a run-up.
const VARIES: f64 = 0.2;
/// Panels of a run-up at most.
const PANELS: usize = 6;

/// The transform of windowed values, of a mean of 0.
pub(crate) struct Lines {
    /// From line to line (Hz).
    pub(crate) step: f64,
    /// From 0 Hz to half the frequency of the rows.
    pub(crate) values: Vec<Complex<f64>>,
    /// Of the weights of the window.
    pub(crate) sum: f64,
}

/// Of values that are `dt` (s) apart, with zeros behind them where they are few.
pub(crate) fn lines(values: &[f64], dt: f64) -> Lines {
    let n = values.len();
    let window = |i: usize| 0.5 - 0.5 * (TAU * i as f64 / n as f64).cos();
    let sum: f64 = (0..n).map(window).sum();
    let mean = values.iter().enumerate().map(|(i, x)| window(i) * x).sum::<f64>() / sum;
    let mut input: Vec<f64> =
        values.iter().enumerate().map(|(i, x)| window(i) * (x - mean)).collect();
    // Zeros behind the values: more lines between those that there are.
    let padded = n * (PADDED / n).max(1);
    input.resize(padded, 0.0);
    let transform = RealFftPlanner::<f64>::new().plan_fft_forward(padded);
    let mut values = transform.make_output_vec();
    transform.process(&mut input, &mut values).expect("lengths are those of the plan");
    Lines { step: 1.0 / (padded as f64 * dt), values, sum }
}

/// Amplitudes by frequency, of a mean of 0.
pub(crate) struct Spectrum {
    /// Hz.
    step: f64,
    amplitudes: Vec<f64>,
}

impl Spectrum {
    /// Of values that are `dt` (s) apart.
    fn of(values: &[f64], dt: f64) -> Spectrum {
        let Lines { step, values, sum } = lines(values, dt);
        Spectrum { step, amplitudes: values.iter().map(|x| 2.0 * x.norm() / sum).collect() }
    }

    /// Of all amplitudes.
    pub(crate) fn largest(&self) -> f64 {
        self.amplitudes.iter().copied().fold(0.0, f64::max)
    }

    /// The frequency above which all is small beside `largest` (Hz).
    pub(crate) fn end(&self, largest: f64) -> f64 {
        let last = self.amplitudes.iter().rposition(|own| *own >= SMALL * largest);
        self.step * last.unwrap_or(0) as f64
    }

    /// So many points at most up to a frequency, of many the largest.
    pub(crate) fn points(&self, end: f64, most: usize) -> Vec<(f64, f64)> {
        let count = ((end / self.step).ceil() as usize + 1).min(self.amplitudes.len());
        let every = count.div_ceil(most).max(1);
        let lines = self.amplitudes[..count].chunks(every).enumerate();
        lines
            .map(|(place, own)| {
                let (at, value) = own
                    .iter()
                    .enumerate()
                    .fold((0, 0.0), |most, (i, &x)| if x > most.1 { (i, x) } else { most });
                (self.step * (place * every + at) as f64, value)
            })
            .collect()
    }
}

/// Spectra over the last cycles.
pub(crate) struct LastSpectra {
    /// How long they are (s).
    span: f64,
    /// Of each that oscillates: a spectrum a column, and how fast it turns (Hz), 0 where it does not.
    pub(crate) signals: Vec<(Vec<Spectrum>, f64)>,
}

/// The spectra of all that oscillates over the last cycles; `step`: from row to row (s). None where rows are too few.
pub(crate) fn last_spectra(
    history: &dyn ReadHistory,
    all: &[Oscillation],
    (step, cycle): (f64, f64),
) -> io::Result<Option<LastSpectra>> {
    let end = history.last_time()?.unwrap_or(0.0);
    let duration = end - begun(history, step)?;
    let cycles = (0.5 * duration / cycle).floor().clamp(1.0, CYCLES);
    let rows = ((cycles * cycle).min(duration) / step).round() as usize;
    let rows = rows.min(MOST_ROWS);
    if rows < 16 || all.is_empty() {
        return Ok(None);
    }
    let names = columns(all);
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let from = history.place_of_time(end - (rows as f64 - 0.5) * step)?;
    let mut values: Vec<Vec<f64>> = vec![Vec::with_capacity(rows); names.len()];
    history.scan(from, &names, &mut |row| {
        values.iter_mut().zip(row).for_each(|(own, value)| own.push(*value));
    })?;
    let found = values[0].len();
    if found < 16 {
        return Ok(None);
    }
    let mut values = values.into_iter();
    let mut signals = Vec::new();
    for own in all {
        let spectra: Vec<Spectrum> = own
            .columns
            .iter()
            .map(|_| Spectrum::of(&values.next().expect("a column"), step))
            .collect();
        let angle = own.angle.as_ref().map(|_| values.next().expect("a column"));
        let turned = angle.map_or(0.0, |angle| (angle[found - 1] - angle[0]).abs());
        let frequency = turned / TAU / (step * (found - 1) as f64);
        signals.push((spectra, if turned > 0.5 * TAU { frequency } else { 0.0 }));
    }
    Ok(Some(LastSpectra { span: step * found as f64, signals }))
}

/// [`last_spectra`], a panel for each that oscillates.
pub(crate) fn spectrum(
    history: &dyn ReadHistory,
    all: &[Oscillation],
    (step, cycle): (f64, f64),
) -> io::Result<Option<Figure>> {
    let Some(LastSpectra { span, signals }) = last_spectra(history, all, (step, cycle))? else {
        return Ok(None);
    };
    let panels =
        all.iter().zip(signals).map(|(own, (spectra, frequency))| (own, spectra, frequency));
    let panels: Vec<_> = panels.collect();
    let ends = panels.iter().map(|(_, spectra, frequency)| {
        let largest = spectra.iter().map(Spectrum::largest).fold(0.0, f64::max);
        spectra.iter().map(|own| own.end(largest)).fold(3.0 * frequency, f64::max)
    });
    let shown = (1.1 * ends.fold(0.0, f64::max)).min(0.5 / step);
    let panel = |(own, spectra, frequency): (&Oscillation, Vec<Spectrum>, f64)| {
        let styles = [Style::First, Style::Second, Style::Third];
        let lines = own.columns.iter().zip(&spectra).zip(styles);
        let marks = ORDERS.iter().filter(|_| frequency > 0.0);
        Panel {
            title: own.title.clone(),
            x: "frequency (Hz)".to_string(),
            y: format!("{}, zero to peak ({})", own.quantity, own.unit),
            lines: lines
                .map(|(((_, name), spectrum), style)| {
                    let name = name.to_lowercase();
                    Line { points: spectrum.points(shown, POINTS), style, name }
                })
                .collect(),
            marks: marks
                .map(|(order, name)| Mark { x: order * frequency, name: (*name).to_string() })
                .collect(),
            ..Panel::default()
        }
    };
    Ok(Some(Figure {
        title: format!(
            "Spectra of the last {} ms (Hann window)",
            whirl_text::rounded(1e3 * span, 4)
        ),
        panels: panels.into_iter().map(panel).collect(),
        columns: 2,
    }))
}

/// Columns of all, each with its angle behind its own.
fn columns(all: &[Oscillation]) -> Vec<String> {
    let of = |own: &Oscillation| {
        let names: Vec<String> = own.columns.iter().map(|(name, _)| name.clone()).collect();
        names.into_iter().chain(own.angle.clone())
    };
    all.iter().flat_map(of).collect()
}

/// A slice of a run: when, how fast it turns (Hz), and spectra of the first column of each that is shown.
struct Slice {
    time: f64,
    speeds: Vec<f64>,
    spectra: Vec<Spectrum>,
}

/// Spectra over the whole run, one above the other by speed or, where that does not rise all the time, by time; the orders
/// are lines across. None where the speed varies little.
pub(crate) fn waterfall(
    history: &dyn ReadHistory,
    all: &[Oscillation],
    step: f64,
) -> io::Result<Option<Figure>> {
    let all: Vec<Oscillation> = all
        .iter()
        .filter(|own| own.angle.is_some())
        .take(PANELS)
        .map(|own| Oscillation { columns: own.columns[..1].to_vec(), ..own.clone() })
        .collect();
    let slices = slices(history, &all, step)?;
    let panels: Vec<Panel> = (0..all.len()).filter_map(|k| stacked(&all[k], k, &slices)).collect();
    Ok((!panels.is_empty()).then(|| Figure {
        title: "Spectra over the run (Hann window)".to_string(),
        panels,
        columns: 2,
    }))
}

fn slices(history: &dyn ReadHistory, all: &[Oscillation], step: f64) -> io::Result<Vec<Slice>> {
    let Some(end) = history.last_time()? else { return Ok(Vec::new()) };
    let begun = begun(history, step)?;
    let total = ((end - begun) / step).round() as usize;
    let reach = (total / REACH).min(MOST_ROWS / 4);
    if reach < 32 || all.is_empty() {
        return Ok(Vec::new());
    }
    let names = columns(all);
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut kept: VecDeque<Vec<f64>> = VecDeque::with_capacity(reach);
    let (mut slices, mut count) = (Vec::with_capacity(SLICES), 0);
    history.scan(history.start(), &names, &mut |row| {
        let mut own = match kept.len() == reach {
            true => kept.pop_front().expect("rows"),
            false => vec![0.0; row.len()],
        };
        own.copy_from_slice(row);
        kept.push_back(own);
        count += 1;
        let next = reach + (total - reach) * slices.len() / (SLICES - 1);
        if count < next.max(reach) || slices.len() == SLICES {
            return;
        }
        let column = |place: usize| -> Vec<f64> { kept.iter().map(|row| row[place]).collect() };
        let (first, last) = (&kept[0], &kept[reach - 1]);
        let speed = |k: usize| (last[2 * k + 1] - first[2 * k + 1]).abs() / TAU;
        let span = step * (reach - 1) as f64;
        slices.push(Slice {
            time: begun + step * count as f64 - 0.5 * span,
            speeds: (0..all.len()).map(|k| speed(k) / span).collect(),
            spectra: (0..all.len()).map(|k| Spectrum::of(&column(2 * k), step)).collect(),
        });
    })?;
    Ok(slices)
}

/// The spectra of one signal; none where its speed varies little.
fn stacked(own: &Oscillation, k: usize, slices: &[Slice]) -> Option<Panel> {
    let speeds = || slices.iter().map(|slice| slice.speeds[k]);
    let (least, most) =
        speeds().fold((f64::INFINITY, 0.0), |(a, b), x| (f64::min(a, x), f64::max(b, x)));
    let largest = slices.iter().map(|slice| slice.spectra[k].largest()).fold(0.0, f64::max);
    if slices.len() < 2 || most - least < VARIES * most || !(largest > 0.0) {
        return None;
    }
    let steady = |pair: &[Slice]| {
        let change = (pair[1].speeds[k] - pair[0].speeds[k]) / (most - least);
        change < 0.25 / SLICES as f64
    };
    let by_time = slices.windows(2).any(steady);
    let heights: Vec<f64> = match by_time {
        true => slices.iter().map(|slice| 1e3 * slice.time).collect(),
        false => speeds().map(|speed| 60.0 * speed).collect(),
    };
    let nyquist = slices[0].spectra[k].step * (slices[0].spectra[k].amplitudes.len() - 1) as f64;
    let end = (2.6 * most).min(nyquist);
    let of = |(slice, height): (&Slice, f64)| Stacked {
        height,
        speed: slice.speeds[k],
        points: slice.spectra[k].points(end, POINTS),
    };
    let all: Vec<Stacked> = slices.iter().zip(heights).map(of).collect();
    let title = format!("{}, {} {}", own.title, own.quantity, own.columns[0].1.to_lowercase());
    let heights = if by_time { ("time", "ms") } else { ("speed", "rpm") };
    Some(stack(&all, end, (largest, &own.unit), (title, heights)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::history::{HistoryFile, HistoryWriter};

    const STEP: f64 = 1e-4;

    fn oscillation() -> Oscillation {
        Oscillation {
            title: "disc".into(),
            quantity: "displacement",
            unit: "µm".to_owned(),
            columns: vec![("x_um".into(), "x")],
            angle: Some("theta_rad".into()),
        }
    }

    /// A history of x over the angle, which is α t + β t².
    fn history(rates: [f64; 2], x: impl Fn(f64, f64) -> f64) -> (tempfile::TempDir, HistoryFile) {
        history_from(0.0, rates, x)
    }

    /// The same of a run that goes on at a time (s).
    fn history_from(
        begun: f64,
        [a, b]: [f64; 2],
        x: impl Fn(f64, f64) -> f64,
    ) -> (tempfile::TempDir, HistoryFile) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let names = ["t_s", "theta_rad", "x_um"].map(str::to_owned).to_vec();
        let mut writer = HistoryWriter::create(&path, &names).unwrap();
        for step in 1..=8000 {
            let t = STEP * f64::from(step);
            let theta = a * t + b * t * t;
            writer.push(&[begun + t, theta, x(t, theta)]).unwrap();
        }
        writer.finish().unwrap();
        let history = HistoryFile::open(&path).unwrap();
        (folder, history)
    }

    #[test]
    fn peaks_of_a_spectrum_are_amplitudes_at_their_frequencies() {
        let turns = TAU * 50.0;
        let (_folder, history) = history([turns, 0.0], |t, theta| {
            100.0 + 8.0 * (theta + 0.3).cos() + 3.0 * (TAU * 125.0 * t).sin()
        });
        let figure = spectrum(&history, &[oscillation()], (STEP, 0.04)).unwrap().expect("a figure");
        let panel = &figure.panels[0];
        let peak = |frequency: f64| {
            let near = panel.lines[0].points.iter().filter(|p| (p.0 - frequency).abs() < 4.0);
            near.fold((0.0, 0.0), |most, point| if point.1 > most.1 { *point } else { most })
        };
        for (frequency, amplitude) in [(50.0, 8.0), (125.0, 3.0)] {
            let found = peak(frequency);
            assert!((found.0 - frequency).abs() < 1e-6, "{found:?}");
            assert!((found.1 / amplitude - 1.0).abs() < 1e-6, "{found:?}");
        }
        // Between lines that are there Hann window leaks a little.
        assert!(peak(90.0).1 < 0.02);
        let marks: Vec<f64> = panel.marks.iter().map(|mark| mark.x).collect();
        assert!((marks[1] - 50.0).abs() < 1e-6 && (marks[2] - 100.0).abs() < 1e-6, "{marks:?}");
        // Nothing varies: no waterfall.
        assert!(waterfall(&history, &[oscillation()], STEP).unwrap().is_none());
    }

    #[test]
    fn a_run_up_shows_its_orders() {
        let (_folder, history) = history([100.0, 300.0], |_, theta| 5.0 * theta.cos());
        let figure = waterfall(&history, &[oscillation()], STEP).unwrap().expect("a figure");
        let panel = &figure.panels[0];
        assert_eq!((panel.lines.len(), panel.y.as_str()), (SLICES + 3, "speed (rpm)"));
        let first = panel.lines.iter().find(|line| line.name == "1X").expect("an order");
        for (frequency, rpm) in &first.points {
            assert!((60.0 * frequency / rpm - 1.0).abs() < 1e-9);
        }
        // The top spectrum has its peak where the order is.
        let top = &panel.lines[0].points;
        let peak = top.iter().fold((0.0, 0.0), |most, p| if p.1 > most.1 { *p } else { most });
        let order = first.points.last().expect("points").0;
        assert!((peak.0 / order - 1.0).abs() < 0.1, "{peak:?} {order}");
    }

    /// A run that goes on from another one has all slices, at its own times, and spectra of its own length.
    #[test]
    fn a_run_that_goes_on_is_as_long_as_it_is() {
        let all = [oscillation()];
        let (_folder, whole) = history([400.0, -150.0], |_, theta| theta.cos());
        let (_folder, later) = history_from(3.2, [400.0, -150.0], |_, theta| theta.cos());
        let [first, second] = [&whole, &later].map(|own| slices(own, &all, STEP).unwrap());
        assert_eq!((first.len(), second.len()), (SLICES, SLICES));
        for (first, second) in first.iter().zip(&second) {
            assert!((second.time - first.time - 3.2).abs() < 1e-9, "{}", second.time);
        }
        assert!(first[0].time > 0.0 && first[SLICES - 1].time < 0.8);
        // Five of the ten cycles of the run.
        let [first, second] = [&whole, &later]
            .map(|own| last_spectra(own, &all, (STEP, 0.075)).unwrap().expect("spectra").span);
        assert!((first - 0.375).abs() < 1e-9 && (second - 0.375).abs() < 1e-9, "{first} {second}");
    }

    #[test]
    fn short_histories_have_no_spectra() {
        let (_folder, history) = history([1.0, 0.0], |t, _| t);
        assert!(spectrum(&history, &[], (STEP, 0.1)).unwrap().is_none());
        assert!(spectrum(&history, &[oscillation()], (0.1, 0.1)).unwrap().is_none());
    }
}
