//! Spectra of the end of a run, two-sided where x and y are there, and over a run-up.
//!
//! z = x + i y, so that a circle of radius R run through with the rotation has R at its frequency, forward, and one against
//! it R at minus that; what vibrates along a line has half of its amplitude at both. What has one column has the amplitude of
//! its sine. All are from 0 to the peak, with a Hann window.

use std::collections::{BTreeMap, VecDeque};
use std::f64::consts::TAU;

use serde::Serialize;

use super::about::Signal;
use super::encode::Packed;
use crate::figures::{Lines, lines};

/// Cycles of a spectrum at most, and rows at least.
pub(super) const CYCLES: f64 = 16.0;
pub(super) const LEAST_ROWS: usize = 16;
/// Parts of one side, of each of which a point or two are shown, at most.
const POINTS: usize = 500;
/// An axis ends where what lies beyond has this share of the power at most.
const BEYOND: f64 = 1e-5;
/// Amplitudes below this part of the largest value that anything of the unit has are rounding.
const ROUNDING: f64 = 1e-8;
/// Spectra of a run-up, into how many parts of the run one reaches, and its rows at least and at most.
const SLICES: usize = 48;
const REACH: usize = 16;
const ROWS: [usize; 2] = [32, 1 << 15];
/// Cells of one side of a map.
const CELLS: usize = 140;
/// Highest order of a map, with some room.
const HIGHEST: f64 = 2.6;

/// Amplitudes over frequencies.
#[derive(Debug)]
struct Sides {
    step: f64,
    /// From 0 Hz on, at minus these frequencies and at them; the first is empty where there is one column.
    backward: Vec<f64>,
    forward: Vec<f64>,
}

impl Sides {
    /// Of one column, or of x and y; `sense`: the sign of the rotation.
    fn of(columns: &[&[f64]], dt: f64, sense: f64) -> Self {
        let first = lines(columns[0], dt);
        let Some(second) = columns.get(1).map(|own| lines(own, dt)) else {
            let Lines { step, values, sum } = first;
            let forward = values.iter().map(|own| 2.0 * own.norm() / sum).collect();
            return Sides { step, backward: Vec::new(), forward };
        };
        let side = |sign: f64| -> Vec<f64> {
            let both = first.values.iter().zip(&second.values);
            let turned = |y: &num_complex::Complex<f64>| {
                num_complex::Complex::new(-sign * y.im, sign * y.re)
            };
            both.map(|(x, y)| (x + turned(y)).norm() / first.sum).collect()
        };
        Sides { step: first.step, backward: side(-sense), forward: side(sense) }
    }

    fn largest(&self) -> f64 {
        self.backward.iter().chain(&self.forward).copied().fold(0.0, f64::max)
    }

    /// The frequency beyond which nearly nothing is left.
    fn end(&self) -> f64 {
        let power = |place: usize| -> f64 {
            let both = [&self.backward, &self.forward].into_iter().filter_map(|own| own.get(place));
            both.map(|own| own * own).sum()
        };
        // What does not move stands at 0 Hz.
        let (count, mut left) = (self.forward.len(), 0.0);
        let limit = BEYOND * (1..count).map(power).sum::<f64>();
        let last = (1..count).rev().find(|&place| {
            left += power(place);
            left > limit
        });
        self.step * last.unwrap_or(0) as f64
    }

    /// Frequencies and amplitudes up to `end`: of many those where one side is the largest, of both sides.
    fn points(&self, end: f64) -> (Vec<f64>, Vec<f64>) {
        let count = ((end / self.step).ceil() as usize + 1).min(self.forward.len());
        let every = count.div_ceil(POINTS).max(1);
        let mut places: Vec<usize> = Vec::new();
        for first in (0..count).step_by(every) {
            let within = first..count.min(first + every);
            for side in [&self.forward, &self.backward] {
                let larger = |best: usize, k: usize| if side[k] > side[best] { k } else { best };
                if side.len() >= within.end {
                    places.push(within.clone().fold(first, larger));
                }
            }
        }
        places.sort_unstable();
        places.dedup();
        let frequency = |k: &usize| self.step * *k as f64;
        let backward = places.iter().rev().filter(|k| **k > 0 && **k < self.backward.len());
        let backward = backward.map(|k| (-frequency(k), self.backward[*k]));
        backward.chain(places.iter().map(|k| (frequency(k), self.forward[*k]))).unzip()
    }
}

/// The spectrum of a signal.
#[derive(Debug, Serialize)]
pub(super) struct Spectrum {
    /// How fast it turns on average (Hz); 0 where it does not.
    turning_hz: f64,
    /// How far its frequencies are apart (Hz), and what the length of the rows resolves: 1/T, more where zeros are added behind them.
    step_hz: f64,
    resolved_hz: f64,
    /// Whether backward motion is told from forward motion.
    two_sided: bool,
    /// One a column, or one of both; none where nothing but rounding oscillates.
    lines: Vec<SpectrumLine>,
    #[serde(skip)]
    sides: Vec<Sides>,
    /// The largest of its values.
    #[serde(skip)]
    size: f64,
}

#[derive(Debug, Serialize)]
struct SpectrumLine {
    name: String,
    frequency_hz: Packed,
    amplitude: Packed,
}

impl Spectrum {
    /// Of the columns of a signal, rows that are `dt` (s) apart, and of its angle.
    pub(super) fn of(signal: &Signal, columns: &[&[f64]], angle: Option<&[f64]>, dt: f64) -> Self {
        let rows = columns[0].len();
        let turned = angle.map_or(0.0, |own| own[rows - 1] - own[0]);
        let turns = turned.abs() > 0.5 * TAU;
        let turning_hz = if turns { turned.abs() / TAU / (dt * (rows - 1) as f64) } else { 0.0 };
        let two_sided = is_plane(signal);
        let sides: Vec<Sides> = match two_sided {
            true => vec![Sides::of(columns, dt, if turned < 0.0 { -1.0 } else { 1.0 })],
            false => columns.iter().map(|own| Sides::of(&[own], dt, 1.0)).collect(),
        };
        let size =
            columns.iter().copied().flatten().fold(0.0, |most: f64, own| most.max(own.abs()));
        let step_hz = sides.first().map_or(0.0, |own| own.step);
        let resolved_hz = 1.0 / (dt * rows as f64);
        Spectrum { turning_hz, step_hz, resolved_hz, two_sided, lines: Vec::new(), sides, size }
    }

    /// The frequency up to which it is worth showing.
    fn end(&self) -> f64 {
        self.sides.iter().map(Sides::end).fold(3.0 * self.turning_hz, f64::max)
    }
}

/// Each up to where it has something to show, and its rows resolve it.
pub(super) fn shown(signals: &[Signal], all: &mut [Spectrum], dt: f64) {
    let mut sizes: BTreeMap<&str, f64> = BTreeMap::new();
    for (signal, own) in signals.iter().zip(all.iter()) {
        let most = sizes.entry(&signal.unit).or_insert(0.0);
        *most = most.max(own.size);
    }
    for (signal, own) in signals.iter().zip(all) {
        let largest = own.sides.iter().map(Sides::largest).fold(0.0, f64::max);
        if !(largest > ROUNDING * sizes[signal.unit.as_str()]) {
            continue;
        }
        let end = (1.1 * own.end()).min(0.5 / dt);
        let names = signal.columns.iter().map(|own| own.1.clone());
        let both = "backward and forward".to_owned();
        let names: Vec<String> = if own.two_sided { vec![both] } else { names.collect() };
        let line = |(name, sides): (String, &Sides)| {
            let (frequency, amplitude) = sides.points(end);
            let amplitude = Packed::single(amplitude);
            SpectrumLine { name, frequency_hz: Packed::single(frequency), amplitude }
        };
        own.lines = names.into_iter().zip(&own.sides).map(line).collect();
    }
}

/// Whether a signal has x and y.
pub(super) fn is_plane(signal: &Signal) -> bool {
    let [(_, x), (_, y)] = signal.columns.as_slice() else { return false };
    x == "x" && y == "y"
}

/// Spectra over a run while its rows pass.
pub(super) struct Slices {
    /// Places of the columns and the angle of each signal in a row.
    places: Vec<(Vec<usize>, usize)>,
    total: usize,
    reach: usize,
    count: usize,
    rows: VecDeque<Vec<f64>>,
    dt: f64,
    /// Time, and of each signal how fast it turns (Hz) and its spectrum.
    found: Vec<(f64, Vec<(f64, Sides)>)>,
}

/// A map of spectra as a page has it.
#[derive(Debug, Serialize)]
pub(super) struct Waterfall {
    /// Place of the signal.
    signal: usize,
    /// Middles of the slices (s), and the speeds there (rpm).
    time: Vec<f64>,
    rpm: Vec<f64>,
    /// Length of a slice (s).
    slice_s: f64,
    /// Width of a cell (Hz); cells of one side, the first one about 0 Hz.
    cell_hz: f64,
    cells: usize,
    two_sided: bool,
    /// Slice by slice from the least frequency on, in parts of `largest` / 65535.
    amplitude: Packed,
    largest: f64,
}

impl Slices {
    /// Of signals over so many rows; none where these are too few.
    pub(super) fn new(places: Vec<(Vec<usize>, usize)>, total: usize, dt: f64) -> Option<Self> {
        let reach = (total / REACH).min(ROWS[1]);
        let room = reach >= ROWS[0] && !places.is_empty();
        let (rows, found) = (VecDeque::new(), Vec::new());
        room.then_some(Slices { places, total, reach, count: 0, rows, dt, found })
    }

    /// Takes a row.
    pub(super) fn add(&mut self, time: f64, row: &[f64]) {
        if self.rows.len() == self.reach {
            self.rows.pop_front();
        }
        let own = self.places.iter().flat_map(|(columns, angle)| columns.iter().chain([angle]));
        self.rows.push_back(own.map(|place| row[*place]).collect());
        self.count += 1;
        let next = self.reach + (self.total - self.reach) * self.found.len() / (SLICES - 1);
        if self.count < next.max(self.reach) || self.found.len() == SLICES {
            return;
        }
        let span = self.dt * (self.reach - 1) as f64;
        let mut at = 0;
        let signals = self.places.iter().map(|(columns, _)| {
            let take = |at: usize| -> Vec<f64> { self.rows.iter().map(|row| row[at]).collect() };
            let values: Vec<Vec<f64>> = (at..at + columns.len()).map(take).collect();
            let angle = at + columns.len();
            let turned = self.rows[self.reach - 1][angle] - self.rows[0][angle];
            at = angle + 1;
            let values: Vec<&[f64]> = values.iter().map(Vec::as_slice).collect();
            let sense = if turned < 0.0 { -1.0 } else { 1.0 };
            (turned.abs() / TAU / span, Sides::of(&values, self.dt, sense))
        });
        let signals = signals.collect();
        self.found.push((time - 0.5 * span, signals));
    }

    /// Maps of the signals by their places; none of those that turn less than once in a part.
    pub(super) fn finish(self, signals: &[usize]) -> Vec<Waterfall> {
        let map = |(k, signal): (usize, &usize)| {
            let all: Vec<&(f64, Sides)> = self.found.iter().map(|own| &own.1[k]).collect();
            let most = all.iter().map(|own| own.0).fold(0.0, f64::max);
            let largest = all.iter().map(|own| own.1.largest()).fold(0.0, f64::max);
            // What turns less than once in a part shows no order.
            let span = self.dt * (self.reach - 1) as f64;
            if all.len() < 2 || !(most * span >= 1.0 && largest > 0.0) {
                return None;
            }
            let end = (HIGHEST * most).min(0.5 / self.dt);
            let cell_hz = end / (CELLS as f64 - 0.5);
            let two_sided = !all[0].1.backward.is_empty();
            // A cell shows the largest amplitude in it.
            let cell = |side: &[f64], step: f64, at: usize| {
                let edge = |own: f64| ((own * cell_hz / step).round().max(0.0)) as usize;
                let [from, to] = [edge(at as f64 - 0.5), edge(at as f64 + 0.5)];
                let own = side[from.min(side.len() - 1)..to.max(from + 1).min(side.len())].iter();
                own.copied().fold(0.0, f64::max)
            };
            let row = |own: &Sides| -> Vec<f64> {
                let of = |side: &[f64]| (0..CELLS).map(|at| cell(side, own.step, at)).collect();
                let forward: Vec<f64> = of(&own.forward);
                let backward: Vec<f64> = if two_sided { of(&own.backward) } else { Vec::new() };
                backward.into_iter().skip(1).rev().chain(forward).collect()
            };
            let values = all.iter().flat_map(|own| row(&own.1));
            let parts = values.map(|own| (own / largest * f64::from(u16::MAX)).round() as u16);
            let rounded = |value: f64| whirl_text::rounded(value, 7);
            Some(Waterfall {
                signal: *signal,
                time: self.found.iter().map(|own| rounded(own.0)).collect(),
                rpm: all.iter().map(|own| rounded(60.0 * own.0)).collect(),
                slice_s: span,
                cell_hz,
                cells: CELLS,
                two_sided,
                amplitude: Packed::short(parts),
                largest,
            })
        };
        signals.iter().enumerate().filter_map(map).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f64 = 1e-3;

    fn orbit(forward: f64, backward: f64, sense: f64) -> [Vec<f64>; 3] {
        let angle = |k: usize| sense * TAU * 20.0 * DT * k as f64;
        let x = |k: usize| (forward + backward) * angle(k).cos() + 3.0;
        let y = |k: usize| (forward - backward) * angle(k).sin() - 1.0;
        let of = |value: &dyn Fn(usize) -> f64| (0..1000).map(value).collect();
        [of(&x), of(&y), of(&angle)]
    }

    fn signal(axes: &[&str]) -> Signal {
        Signal {
            title: "disc".into(),
            quantity: "displacement".into(),
            unit: "µm".into(),
            columns: axes.iter().map(|axis| (format!("{axis}_um"), (*axis).to_owned())).collect(),
            angle: Some("theta_rad".into()),
        }
    }

    /// An ellipse is two circles; which of them is the forward one goes by the rotation.
    #[test]
    fn an_ellipse_is_a_forward_and_a_backward_circle() {
        for sense in [1.0, -1.0] {
            let [x, y, angle] = orbit(8.0, 3.0, sense);
            let own = Spectrum::of(&signal(&["x", "y"]), &[&x, &y], Some(&angle), DT);
            assert!(own.two_sided && (own.turning_hz - 20.0).abs() < 1e-9);
            let line = (20.0 / own.sides[0].step).round() as usize;
            let [forward, backward] = [&own.sides[0].forward, &own.sides[0].backward];
            assert!((forward[line] - 8.0).abs() < 1e-9, "{}", forward[line]);
            assert!((backward[line] - 3.0).abs() < 1e-9, "{}", backward[line]);
            let (frequencies, amplitudes) = own.sides[0].points(40.0);
            assert!(frequencies.windows(2).all(|pair| pair[1] > pair[0]));
            let at = frequencies.iter().position(|f| (f + 20.0).abs() < 1e-6).expect("a line");
            assert!((amplitudes[at] - 3.0).abs() < 1e-9);
        }
        let [x, _, angle] = orbit(8.0, 3.0, 1.0);
        let own = Spectrum::of(&signal(&["x"]), &[&x], Some(&angle), DT);
        let line = (20.0 / own.sides[0].step).round() as usize;
        assert!(!own.two_sided && (own.sides[0].forward[line] - 11.0).abs() < 1e-9);
    }

    #[test]
    fn a_map_has_its_peaks_where_the_orders_are() {
        let total = 4000;
        let mut slices = Slices::new(vec![(vec![1, 2], 0)], total, DT).expect("rows");
        for k in 0..total {
            let t = DT * k as f64;
            let angle = TAU * (20.0 * t + 10.0 * t * t);
            slices.add(t, &[angle, 5.0 * angle.cos(), 5.0 * angle.sin()]);
        }
        let speeds: Vec<f64> = slices.found.iter().map(|own| own.1[0].0).collect();
        assert_eq!(speeds.len(), SLICES);
        for ((time, _), speed) in slices.found.iter().zip(&speeds) {
            assert!((speed / (20.0 + 20.0 * time) - 1.0).abs() < 1e-2, "{speed} at {time}");
        }
        let sides: Vec<usize> = slices.found.iter().map(|own| peak(&own.1[0].1.forward)).collect();
        let step = slices.found[0].1[0].1.step;
        for (line, speed) in sides.iter().zip(&speeds) {
            assert!((*line as f64 * step / speed - 1.0).abs() < 0.1, "{line} {speed}");
        }
        let map = slices.finish(&[7]).remove(0);
        assert!(map.two_sided && map.signal == 7);
    }

    fn peak(values: &[f64]) -> usize {
        let most = values.iter().enumerate();
        most.fold((0, 0.0), |most, (k, &own)| if own > most.1 { (k, own) } else { most }).0
    }
}
