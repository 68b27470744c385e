//! Orders over a run: amplitude and phase of what oscillates once and twice a revolution, tracked by the angle.
//!
//! About every place of the angle x = A₀ + Σ A_n cos(n θ + φ_n), n = 1 … 3, is fitted by least squares over N revolutions
//! with the weights of a Hann window in θ. What oscillates m times a revolution is told from the order n where |m − n| ≥ 2/N:
//! with eight revolutions an oil whirl at 0.48 of the speed is out of 1X, and with two it would be in it. What is left below 1X
//! is looked through for its largest part. Once and twice the angles of other bodies are fitted, too, where they are 2/N or more from these
//! orders: what a second spool does is no whirl of the first. Twice an angle is not below 1X, where a ring would hide the whirl of its film.

use std::collections::VecDeque;
use std::f64::consts::TAU;

use super::below::Below;
use super::fit::{Fit, Terms, polar};

/// Orders that are fitted, of which the first two are shown.
const ORDERS: [f64; 3] = [1.0, 2.0, 3.0];
/// Orders of every other angle that are fitted beside them.
const BESIDE: [f64; 2] = [1.0, 2.0];
/// How far those are from the others at least, in 1/N, where the windows of both do not touch.
const APART: f64 = 2.0;
/// Revolutions of a window, at most and at least, and how many windows a run has room for at least.
const MOST: f64 = 8.0;
const LEAST: f64 = 4.0;
const WINDOWS: f64 = 6.0;
/// Places at which orders are found, at most.
const PLACES: f64 = 240.0;
/// Rows of a revolution, at least, as of the orders of a summary, and rows of a window, at most.
const ROWS: f64 = 12.0;
const MOST_ROWS: usize = 1 << 17;

/// The orders of the signals of one angle while the rows pass.
pub(crate) struct Tracker {
    /// Places of the angle, of the angles of other bodies, and of the columns in a row.
    angle: usize,
    others: Vec<usize>,
    columns: Vec<usize>,
    /// Half a window, and from place to place (rad); the sense of the rotation.
    half: f64,
    hop: f64,
    sense: f64,
    /// Where the next one is.
    next: f64,
    /// Time, angle, other angles and values of the rows of a window.
    rows: VecDeque<Vec<f64>>,
    found: Vec<Place>,
}

/// What is found about a place.
struct Place {
    time: f64,
    /// Hz, at the place.
    speed: f64,
    columns: Vec<PlaceOfColumn>,
}

struct PlaceOfColumn {
    /// Half of largest less least.
    overall: f64,
    /// Amplitudes and phases (°) of 1X and 2X.
    orders: [[f64; 2]; 2],
    /// Amplitude and order of the largest part below 1X.
    below: [f64; 2],
}

/// Orders place by place.
#[derive(Debug)]
pub(crate) struct Tracked {
    /// Revolutions of a window.
    pub(crate) revolutions: f64,
    /// s.
    pub(crate) time: Vec<f64>,
    pub(crate) rpm: Vec<f64>,
    /// A column each.
    pub(crate) signals: Vec<TrackedSignal>,
}

/// Those of a column.
#[derive(Debug)]
pub(crate) struct TrackedSignal {
    pub(crate) column: String,
    /// Half of largest less least value.
    pub(crate) overall: Vec<f64>,
    /// 1X and 2X, from 0 to the peak.
    pub(crate) amplitudes: [Vec<f64>; 2],
    /// Of both, in degrees.
    pub(crate) phases: [Vec<f64>; 2],
    /// Of the largest part below 1X, from 0 to the peak, and its order.
    pub(crate) below: [Vec<f64>; 2],
}

impl Tracker {
    /// Of columns over an angle that turns from `begins` to `ends` (rad), beside angles of other bodies, all by their places in a row;
    /// none where that is too little.
    pub(crate) fn new(
        (angle, others, columns): (usize, Vec<usize>, Vec<usize>),
        [begins, ends]: [f64; 2],
    ) -> Option<Self> {
        let total = (ends - begins).abs() / TAU;
        let revolutions = (total / WINDOWS).floor().min(MOST);
        if !(revolutions >= LEAST) || columns.is_empty() {
            return None;
        }
        let sense = (ends - begins).signum();
        let half = 0.5 * TAU * revolutions;
        let hop = (0.25 * revolutions).max(total / PLACES) * TAU;
        Some(Tracker {
            angle,
            others,
            columns,
            half,
            hop,
            sense,
            next: sense * begins + half,
            rows: VecDeque::new(),
            found: Vec::new(),
        })
    }

    /// Takes a row.
    pub(crate) fn add(&mut self, time: f64, row: &[f64]) {
        let angle = self.sense * row[self.angle];
        // What comes back to where it was is not fitted twice.
        if self.rows.back().is_some_and(|last| angle <= last[1]) {
            return;
        }
        while self.rows.front().is_some_and(|first| first[1] < self.next - self.half) {
            self.rows.pop_front();
        }
        let own = self.others.iter().chain(&self.columns).map(|place| row[*place]);
        self.rows.push_back([time, angle].into_iter().chain(own).collect());
        if self.rows.len() > MOST_ROWS {
            // Near standstill: no window is so long.
            self.rows.clear();
            self.next = angle + self.half;
        }
        while angle >= self.next + self.half {
            if let Some(place) = self.fitted() {
                self.found.push(place);
            }
            self.next += self.hop;
        }
    }

    /// What the rows about the next place come to; none where they are too few.
    fn fitted(&self) -> Option<Place> {
        let [from, to] = [self.next - self.half, self.next + self.half];
        let within: Vec<&Vec<f64>> =
            self.rows.iter().filter(|own| own[1] >= from && own[1] <= to).collect();
        if (within.len() as f64) < ROWS * self.half / (0.5 * TAU) {
            return None;
        }
        let orders = self.terms(&within);
        let values = 2 + self.others.len();
        let mut fit = Fit::new(orders.len(), self.columns.len());
        let mut terms = Terms::new(orders);
        let weights = within.iter().enumerate().map(|(k, row)| {
            let angles = [k.saturating_sub(1), (k + 1).min(within.len() - 1)];
            let [before, after] = angles.map(|at| within[at][1]);
            let window = 0.5 + 0.5 * ((row[1] - self.next) / self.half * 0.5 * TAU).cos();
            window * (after - before)
        });
        let weights: Vec<f64> = weights.collect();
        for (row, weight) in within.iter().zip(&weights) {
            fit.add(*weight, terms.at(&self.angles(row)), &row[values..]);
        }
        let at = within.partition_point(|own| own[1] < self.next).clamp(1, within.len() - 1);
        let [first, second] = [within[at - 1], within[at]];
        let speed = (second[1] - first[1]) / (second[0] - first[0]) / TAU;
        let overall = |place: usize| {
            let values = || within.iter().map(|own| own[values + place]);
            let least = values().fold(f64::INFINITY, f64::min);
            0.5 * (values().fold(f64::NEG_INFINITY, f64::max) - least)
        };
        let share = (self.next - first[1]) / (second[1] - first[1]);
        let fitted = fit.solve()?;
        let mut below = Below::new(self.half / (0.5 * TAU), self.columns.len());
        let mut left = vec![0.0; self.columns.len()];
        for (row, weight) in within.iter().zip(&weights) {
            let terms = terms.at(&self.angles(row));
            for ((left, value), own) in left.iter_mut().zip(&row[values..]).zip(&fitted) {
                *left = value - own.iter().zip(terms).map(|(own, term)| own * term).sum::<f64>();
            }
            below.add(*weight, self.sense * row[1], &left);
        }
        let of_column = |(k, own): (usize, &Vec<f64>)| PlaceOfColumn {
            overall: overall(k),
            orders: [0, 1].map(|place| polar(own, place)),
            below: below.largest(k),
        };
        Some(Place {
            time: first[0] + share * (second[0] - first[0]),
            speed,
            columns: fitted.iter().enumerate().map(of_column).collect(),
        })
    }

    /// What is fitted beside the constant: the place of an angle, and how often each goes in its revolution.
    fn terms(&self, within: &[&Vec<f64>]) -> Vec<(usize, f64)> {
        let (first, last) = (within[0], within[within.len() - 1]);
        let mut orders: Vec<f64> = ORDERS.iter().copied().chain([0.0]).collect();
        let mut all: Vec<(usize, f64)> = ORDERS.iter().map(|own| (0, *own)).collect();
        for place in 2..2 + self.others.len() {
            let ratio = ((last[place] - first[place]) / (last[1] - first[1])).abs();
            for times in BESIDE {
                let order = times * ratio;
                // A floating ring turns at about a quarter of the speed, and an oil whirl with twice that.
                if times > 1.0 && order < 1.0 {
                    continue;
                }
                let apart = APART / (self.half / (0.5 * TAU));
                if orders.iter().all(|own| (own - order).abs() >= apart) {
                    orders.push(order);
                    all.push((place - 1, times));
                }
            }
        }
        all
    }

    /// The angle as it is, whichever way that turns, so that phases count by it, and the others.
    fn angles(&self, row: &[f64]) -> Vec<f64> {
        let own = self.sense * row[1];
        [own].into_iter().chain(row[2..2 + self.others.len()].iter().copied()).collect()
    }

    /// What was found, with names of columns; none where that is nothing.
    pub(crate) fn finish(self, names: &[String]) -> Option<Tracked> {
        if self.found.len() < 2 {
            return None;
        }
        let all = &self.found;
        let signal = |(place, column): (usize, &usize)| {
            let of = |part: usize, order: usize| {
                all.iter().map(|own| own.columns[place].orders[order][part]).collect()
            };
            let below =
                |part: usize| all.iter().map(|own| own.columns[place].below[part]).collect();
            TrackedSignal {
                column: names[*column].clone(),
                overall: all.iter().map(|own| own.columns[place].overall).collect(),
                amplitudes: [0, 1].map(|order| of(0, order)),
                phases: [0, 1].map(|order| of(1, order)),
                below: [0, 1].map(below),
            }
        };
        Some(Tracked {
            revolutions: self.half / (0.5 * TAU),
            time: all.iter().map(|own| own.time).collect(),
            rpm: all.iter().map(|own| 60.0 * own.speed).collect(),
            signals: self.columns.iter().enumerate().map(signal).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A run-up by which θ = a t + b t², and what it leaves.
    fn tracked([a, b]: [f64; 2], end: f64, x: impl Fn(f64) -> f64) -> Tracker {
        let angle = |t: f64| a * t + b * t * t;
        let mut tracker =
            Tracker::new((0, Vec::new(), vec![1]), [0.0, angle(end)]).expect("revolutions");
        for step in 0..(end / 1e-4) as u32 {
            let t = 1e-4 * f64::from(step);
            tracker.add(t, &[angle(t), x(angle(t))]);
        }
        tracker
    }

    /// Amplitudes and phases through a run-up, beside an oil whirl as large as the unbalance, forward and backward.
    #[test]
    fn orders_are_found_beside_a_whirl_at_half_the_speed() {
        for sense in [1.0, -1.0] {
            let x = |angle: f64| {
                let wave = |order: f64, size: f64, phase: f64| size * (order * angle + phase).cos();
                7.0 + wave(1.0, 20.0, 0.5) + wave(2.0, 3.0, -2.5) + wave(0.48, 20.0, 1.0)
            };
            // Half of largest less least value between two angles.
            let half = |[from, to]: [f64; 2]| {
                let all = (0..=20_000).map(|k| x(from + (to - from) * f64::from(k) / 20_000.0));
                let ends = |(a, b): (f64, f64), own: f64| (f64::min(a, own), f64::max(b, own));
                let (least, most) = all.fold((f64::INFINITY, f64::NEG_INFINITY), ends);
                0.5 * (most - least)
            };
            let own = tracked([sense * 300.0, sense * 200.0], 2.0, x);
            assert_eq!(own.half, 4.0 * TAU);
            assert!(own.found.len() > 50, "{}", own.found.len());
            for place in &own.found {
                // dθ/dt = a + 2 b t; a difference of two rows is right to their curvature.
                let rate = (300.0 + 400.0 * place.time) / TAU;
                assert!((place.speed / rate - 1.0).abs() < 1e-3, "{} {rate}", place.speed);
                let [first, second] = place.columns[0].orders;
                let [amplitude, order] = place.columns[0].below;
                assert!((order - 0.48).abs() < 2e-3, "{order}");
                assert!((0.97..1.03).contains(&(amplitude / 20.0)), "{amplitude}");
                // The Hann window's side lobes are below 2.7 %, and fall from there.
                assert!((first[0] / 20.0 - 1.0).abs() < 0.027, "{first:?}");
                assert!((first[1] - 0.5_f64.to_degrees()).abs() < 1.6, "{first:?}");
                assert!((second[0] - 3.0).abs() < 0.027 * 20.0, "{second:?}");
                // The rows of a window miss its ends by a row each, 0.11 rad at most, and peaks by half of that, where
                // |x″| is 37 at most.
                let (at, row) = (sense * (300.0 + 200.0 * place.time) * place.time, 0.11);
                let (overall, reach) = (place.columns[0].overall, 8.0 * 0.5 * TAU);
                assert!(
                    overall <= half([at - reach - 1e-3, at + reach + 1e-3]) + 1e-3,
                    "{overall}"
                );
                let inner = half([at - reach + row, at + reach - row]);
                assert!(overall >= inner - 0.5 * 37.0 * (0.5 * row).powi(2), "{overall} {inner}");
            }
        }
    }

    /// Another spool at 0.7 of the speed is neither in 1X nor below it, and what drifts has no order below 1X.
    #[test]
    fn other_spools_and_drifts_are_no_whirls() {
        let angle = |t: f64| 300.0 * t + 200.0 * t * t;
        let (a, b) = (|t: f64| angle(t), |t: f64| 0.7 * angle(t) + 0.3);
        let mut tracker =
            Tracker::new((0, vec![1], vec![2, 3]), [0.0, angle(2.0)]).expect("revolutions");
        for step in 0..20_000 {
            let t = 1e-4 * f64::from(step);
            let drift = 40.0 * (0.8 * t).cos();
            tracker.add(
                t,
                &[
                    a(t),
                    b(t),
                    20.0 * a(t).cos() + 15.0 * (b(t) + 0.4).cos(),
                    3.0 * a(t).sin() + drift,
                ],
            );
        }
        assert!(tracker.found.len() > 50);
        for place in &tracker.found {
            let [own, drifting] = [0, 1].map(|k| &place.columns[k]);
            assert!(
                (own.orders[0][0] - 20.0).abs() < 0.05 && own.below[0] < 0.05,
                "{:?}",
                own.below
            );
            assert!(drifting.below[0] < 0.02 || drifting.below[1].is_nan(), "{:?}", drifting.below);
        }
    }

    #[test]
    fn a_few_revolutions_are_not_tracked() {
        assert!(Tracker::new((0, Vec::new(), vec![1]), [0.0, 20.0 * TAU]).is_none());
        let few = Tracker::new((0, Vec::new(), vec![1]), [0.0, 31.0 * TAU]).expect("enough");
        assert_eq!(few.half, 2.5 * TAU);
        assert!(tracked([300.0, 0.0], 1.0, f64::cos).finish(&["a".into(), "x".into()]).is_some());
    }
}
