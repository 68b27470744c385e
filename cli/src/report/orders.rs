//! Order tracking: amplitudes and phases of what oscillates once and twice a revolution.
//!
//! Over the last whole revolutions of a body by θ, x = Σ A_n cos(n θ + φ_n) is fitted by least squares, whose terms are
//! a constant, the orders 1 to 3 and, over two revolutions or more, ½ and 1½: what else there is, is nearly orthogonal to
//! them over whole revolutions. Of a run that came to no steady state the orders 1 to 3 are fitted over eight revolutions, with the weights
//! of a Hann window, which keeps what is no order out of them. Once and twice the angles of other bodies are fitted beside them, where they differ by a
//! revolution or more: what a second spool does is no order of the first.

use std::f64::consts::TAU;
use std::io;

use serde::Serialize;

use super::fit::{Fit, Terms, polar};
use super::{Oscillation, last_cycle};
use crate::history::ReadHistory;

/// What phases mean.
const REFERENCE: &str =
    "x = A cos(n θ + φ): A zero to peak in the unit of the signal, θ the column `angle`";
/// Orders that are fitted beside the constant, and those over two revolutions or more where no other angle has one near them.
const ORDERS: [f64; 3] = [1.0, 2.0, 3.0];
const HALVES: [f64; 2] = [0.5, 1.5];
/// Orders of every other angle that are fitted beside them.
const BESIDE: [f64; 2] = [1.0, 2.0];
/// Revolutions that are fitted of a run that came to no steady state, if it has so many: what turns nearly as often is told apart then.
const UNSTEADY: usize = 8;
/// How far orders are apart that are fitted together, in revolutions of the window: with equal weights, and with those of a Hann window.
const APART: [f64; 2] = [1.0, 2.0];
/// Revolutions up to which more are taken than a cycle has, where orders of other angles are nearer than a revolution.
const TOGETHER: f64 = 64.0;
/// Bodies that turn against each other by less than this (rad) all along are one.
const LOCKED: f64 = 0.5;
/// Rows for one unknown, at least.
const ROWS: usize = 2;
/// Rows a revolution, at least: four in a period of the highest order that is fitted. With N of them what oscillates m times
/// a revolution is seen as |m − N|, so that all up to m = N − 4 leaves the orders that are fitted alone.
const LEAST_ROWS: f64 = 12.0;
/// Rows a revolution below which that is said: as many as the steps that a cycle has at least.
pub(super) const FEW_ROWS: f64 = 23.0;

/// All orders of a run.
#[derive(Debug, Serialize)]
pub(crate) struct OrderFacts {
    reference: &'static str,
    /// Signal by signal.
    pub(crate) signals: Vec<Signal>,
}

/// The orders of a signal.
#[derive(Debug, Serialize)]
pub(crate) struct Signal {
    /// Its column.
    pub(crate) signal: String,
    /// What people call it.
    #[serde(skip)]
    pub(crate) title: String,
    /// The column by which orders count.
    angle: String,
    /// Columns of other angles of which once or twice is too near to its 1X or 2X to be told apart.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) mixed_with: Vec<String>,
    /// Whole revolutions that were fitted.
    pub(crate) revolutions: usize,
    /// On average.
    pub(super) rows_per_revolution: f64,
    /// Once a revolution.
    #[serde(rename = "1X")]
    pub(crate) first: Order,
    /// Twice a revolution.
    #[serde(rename = "2X")]
    pub(crate) second: Order,
    /// Once and three times in two revolutions, where so many were fitted and nothing else has nearly that frequency.
    #[serde(rename = "0.5X", skip_serializing_if = "Option::is_none")]
    half: Option<Order>,
    #[serde(rename = "1.5X", skip_serializing_if = "Option::is_none")]
    one_half: Option<Order>,
}

/// One order.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(crate) struct Order {
    /// From 0 to the peak.
    pub(crate) amplitude: f64,
    /// φ in degrees, from −180 to 180.
    pub(crate) phase_deg: f64,
}

/// The orders of all that oscillates, over the whole revolutions of the last `cycle` (s), or over the last one; none of
/// what does not turn that far.
///
/// # Errors
/// The history cannot be read.
pub(crate) fn orders(
    history: &dyn ReadHistory,
    all: &[Oscillation],
    (cycle, is_steady): (f64, bool),
) -> io::Result<Option<OrderFacts>> {
    let mut signals = Vec::new();
    let mut all_angles: Vec<&String> = Vec::new();
    for angle in all.iter().filter_map(|own| own.angle.as_ref()) {
        if !all_angles.contains(&angle) {
            all_angles.push(angle);
        }
    }
    for &angle in &all_angles {
        let others: Vec<&str> =
            all_angles.iter().filter(|own| **own != angle).map(|own| own.as_str()).collect();
        let Some(window) = Window::of(history, (angle, &others), (cycle, is_steady))? else {
            continue;
        };
        let own = all.iter().filter(|own| own.angle.as_ref() == Some(angle));
        let columns: Vec<(&str, String)> = own
            .flat_map(|own| {
                let title = |axis: &str| format!("{} {axis} ({})", own.title, own.unit);
                own.columns.iter().map(move |(column, axis)| (column.as_str(), title(axis)))
            })
            .collect();
        let angles = std::iter::once(angle.as_str()).chain(others.iter().copied());
        let names: Vec<&str> = angles.chain(columns.iter().map(|own| own.0)).collect();
        let revolutions = window.revolutions;
        let orders = window.terms();
        let halves = HALVES.map(|half| orders.iter().position(|own| *own == (0, half)));
        let mut fit = Fit::new(orders.len(), columns.len());
        let mut terms = Terms::new(orders);
        let whole = revolutions as f64 * TAU;
        let mut before: Option<f64> = None;
        history.scan(window.from, &names, &mut |row| {
            // A row counts by the angle since the row before, as far as it belongs to these revolutions.
            let turned = before.map_or(0.0, |before| (row[0] - before).abs());
            let left = (window.ends[0][1] - row[0]).abs();
            let inside = turned.min(whole - left);
            if inside > 0.0 {
                let (angles, values) = row.split_at(1 + others.len());
                // Hann's window keeps what is no order out of those that are.
                let taper = 1.0 - (TAU * left / whole).cos();
                let weight = if is_steady { inside } else { taper * inside };
                fit.add(weight, terms.at(angles), values);
            }
            before = Some(row[0]);
        })?;
        let rows_per_revolution = fit.rows as f64 / revolutions as f64;
        if rows_per_revolution < LEAST_ROWS {
            continue;
        }
        // Too few rows do not tell them.
        let Some(found) = Some(fit).filter(|own| own.rows >= ROWS * own.terms) else { continue };
        let Some(found) = found.solve() else { continue };
        let order = |own: &[f64], place: usize| {
            let [amplitude, phase_deg] = polar(own, place);
            Order { amplitude, phase_deg }
        };
        let mixed = window.mixed();
        let mixed: Vec<String> = mixed.into_iter().map(|own| others[own - 1].to_owned()).collect();
        for ((column, title), own) in columns.into_iter().zip(found) {
            let [first, second] = [0, 1].map(|place| order(&own, place));
            let (signal, angle) = (column.to_string(), angle.clone());
            let mixed_with = mixed.clone();
            signals.push(Signal {
                mixed_with,
                signal,
                title,
                angle,
                revolutions,
                rows_per_revolution,
                first,
                second,
                half: halves[0].map(|place| order(&own, place)),
                one_half: halves[1].map(|place| order(&own, place)),
            });
        }
    }
    Ok((!signals.is_empty()).then_some(OrderFacts { reference: REFERENCE, signals }))
}

/// The last whole revolutions of an angle.
struct Window {
    /// Where its rows begin.
    from: u64,
    revolutions: usize,
    /// The angle, and the others, there and at the end.
    ends: Vec<[f64; 2]>,
    /// Which of them turn as the first one does.
    locked: Vec<bool>,
    /// Whether what varies in a cycle repeats itself, so that all that is no order of an angle is an order of the cycle.
    is_steady: bool,
}

impl Window {
    /// Those of the last `cycle` (s) or the last one, or as many as tell the orders of other angles apart; none where there is none.
    fn of(
        history: &dyn ReadHistory,
        (angle, others): (&str, &[&str]),
        (cycle, is_steady): (f64, bool),
    ) -> io::Result<Option<Self>> {
        let Some(end) = history.last_time()? else { return Ok(None) };
        let names: Vec<&str> = std::iter::once(angle).chain(others.iter().copied()).collect();
        let at = |place| -> io::Result<Vec<f64>> {
            let mut found = Vec::new();
            history.first_row(place, &names, &mut |row| found = row.to_vec())?;
            Ok(found)
        };
        let last = at(history.place_of_time(end)?)?;
        let begun = at(history.start())?;
        let turned: Vec<f64> = last.iter().zip(&begun).map(|(last, begun)| last - begun).collect();
        let locked: Vec<bool> = turned.iter().map(|own| (own - turned[0]).abs() < LOCKED).collect();
        let mut window = cycle;
        let mut best: Option<Self> = None;
        loop {
            let first = at(last_cycle(history, window)?)?;
            // Rows do not always meet the start of a revolution.
            let whole = ((last[0] - first[0]).abs() / TAU + 0.02).floor();
            let mut next = 2.0 * window;
            if whole >= 1.0 {
                let from = last_cycle(history, 1.05 * window)?;
                let ends = first.into_iter().zip(last.iter().copied()).map(<[f64; 2]>::from);
                let (ends, locked) = (ends.collect(), locked.clone());
                let own = Window { from, revolutions: whole as usize, ends, locked, is_steady };
                let needed = own.needed().max(if is_steady { 1.0 } else { UNSTEADY as f64 });
                if needed <= whole {
                    return Ok(Some(own));
                }
                // Where no window tells them apart the shortest one is as good as any, and the longest one where nothing is steady.
                best = if is_steady { best.or(Some(own)) } else { Some(own) };
                if needed > TOGETHER {
                    return Ok(best);
                }
                next = window * f64::max(1.05, (needed + 0.2) / whole);
            }
            if window >= end {
                return Ok(best);
            }
            window = if next > end { f64::min(next, 1.001 * end) } else { next };
        }
    }

    /// Orders by the first angle of what goes by the others: angle, how often it goes in a revolution of that, and the order.
    fn beside(&self) -> Vec<(usize, f64, f64)> {
        let turned = |own: &[f64; 2]| own[1] - own[0];
        let others = self.ends.iter().enumerate().skip(1);
        let all = others.flat_map(|(place, own)| {
            let ratio = (turned(own) / turned(&self.ends[0])).abs();
            BESIDE.map(|times| (place, times, times * ratio))
        });
        all.collect()
    }

    /// Whether orders differ by as many revolutions as tell them apart.
    fn apart(&self, a: f64, b: f64) -> bool {
        (a - b).abs() * self.revolutions as f64 >= APART[usize::from(!self.is_steady)] - 1e-3
    }

    /// Revolutions after which those beside are a revolution away from all of its own orders, but for those that are one of these.
    fn needed(&self) -> f64 {
        let all = self.beside().into_iter().filter(|own| !self.locked[own.0]);
        let away = all.flat_map(|(.., order)| ORDERS.map(|own| (order - own).abs()));
        // Gears and drives keep ratios to the digits of a history.
        let apart = APART[usize::from(!self.is_steady)];
        let revolutions = away.filter(|own| *own > 1e-6).map(|own| (apart / own - 1e-3).ceil());
        revolutions.fold(1.0, f64::max)
    }

    /// The angles of which once or twice is nearer than a revolution to 1X or 2X.
    fn mixed(&self) -> Vec<usize> {
        let near = |order: f64| ORDERS[..2].iter().any(|own| !self.apart(order, *own));
        let all = self.beside().into_iter().filter(|own| !self.locked[own.0] && near(own.2));
        let mut places: Vec<usize> = all.map(|own| own.0).collect();
        places.dedup();
        places
    }

    /// What is fitted beside the constant: places of angles, and how often each goes in a revolution of its angle.
    fn terms(&self) -> Vec<(usize, f64)> {
        let mut orders: Vec<f64> = ORDERS.to_vec();
        let mut all: Vec<(usize, f64)> = orders.iter().map(|own| (0, *own)).collect();
        orders.push(0.0);
        // What is near half of the speed and does not repeat itself is no order.
        let halves = if self.is_steady && self.revolutions > 1 { &HALVES[..] } else { &[] };
        let halves = halves.iter().map(|own| (0, *own, *own));
        for (place, times, order) in self.beside().into_iter().chain(halves) {
            if orders.iter().all(|own| self.apart(order, *own)) {
                orders.push(order);
                all.push((place, times));
            }
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::history::{HistoryFile, HistoryWriter};

    fn disc() -> Oscillation {
        Oscillation {
            title: "disc".into(),
            quantity: "displacement",
            unit: "µm".to_owned(),
            columns: vec![("x_um".into(), "x")],
            angle: Some("theta_rad".into()),
        }
    }

    /// 1X of 20 µm beside an order of 5 µm, in so many rows a revolution over ten of them.
    fn of_rows(count: u32, order: f64) -> Option<Signal> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let names = ["t_s", "theta_rad", "x_um"].map(str::to_owned).to_vec();
        let mut writer = HistoryWriter::create(&path, &names).unwrap();
        for step in 0..=10 * count {
            let t = f64::from(step) / f64::from(count);
            let theta = TAU * t;
            writer.push(&[t, theta, 20.0 * theta.cos() + 5.0 * (order * theta).cos()]).unwrap();
        }
        writer.finish().unwrap();
        let history = HistoryFile::open(&path).unwrap();
        let all = [disc()];
        orders(&history, &all, (10.0, true)).unwrap().map(|mut found| found.signals.remove(0))
    }

    #[test]
    fn orders_of_few_rows_are_left_out_or_marked() {
        // What is seen as 1X is 8X.
        assert!(of_rows(7, 8.0).is_none() && of_rows(11, 8.0).is_none());
        let found = of_rows(14, 8.0).expect("enough for 8X");
        assert!((found.first.amplitude - 20.0).abs() < 1e-6, "{found:?}");
        assert!((found.rows_per_revolution - 14.0).abs() < 0.2, "{found:?}");
        let seen = of_rows(14, 13.0).expect("too few for 13X");
        assert!((seen.first.amplitude - 25.0).abs() < 1e-6, "{seen:?}");
        let few = |count: u32| {
            let signals = vec![of_rows(count, 4.0).expect("orders")];
            super::super::of_orders(Some(&OrderFacts { reference: REFERENCE, signals }))
        };
        let said = "few rows: 14 a revolution; components at 12 times the speed or more may alias to 1X or 2X";
        assert!(few(14).contains(said), "{}", few(14));
        assert!(!few(24).contains("few rows"), "{}", few(24));
    }

    /// 1X and 2X beside a whirl that decays at 0.43X and one at 1.6X, of a run that is not steady: to 0.15 and 0.1 µm, where a fit with equal weights
    /// over the cycle is off by more than 1 µm.
    #[test]
    fn orders_of_what_is_not_steady_are_told_from_what_is_none() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let names = ["t_s", "theta_rad", "x_um"].map(str::to_owned).to_vec();
        let mut writer = HistoryWriter::create(&path, &names).unwrap();
        for step in 0..=6000 {
            let t = 1e-3 * f64::from(step);
            let theta = TAU * 5.0 * t;
            let rest = 30.0 * (-0.05 * t).exp() * (0.43 * theta).sin() + 4.0 * (1.6 * theta).cos();
            let own = 2.0 * (theta + 0.4).cos() + 0.5 * (2.0 * theta - 1.0).cos();
            writer.push(&[t, theta, own + rest]).unwrap();
        }
        writer.finish().unwrap();
        let history = HistoryFile::open(&path).unwrap();
        let all = [disc()];
        let of = |is_steady| {
            orders(&history, &all, (0.4, is_steady)).unwrap().expect("orders").signals.remove(0)
        };
        let found = of(false);
        assert_eq!((found.revolutions, found.half), (8, None));
        assert!((found.first.amplitude - 2.0).abs() < 0.15, "{found:?}");
        assert!((found.second.amplitude - 0.5).abs() < 0.1, "{found:?}");
        assert!((of(true).first.amplitude - 2.0).abs() > 1.0);
    }

    /// Two spools whose speeds are 5 : 7, in cycles of one revolution and more: 1X and 2X of each without those of the other; of spools
    /// at 1 : 2 what is 2X of one is 1X of the other.
    #[test]
    fn orders_of_two_spools_are_told_apart() {
        for (ratio, cycle) in
            [(1.4, 0.2), (1.4, 1.0), (1.1, 0.2), (1.05, 0.4), (1.017, 0.2), (2.0, 0.2)]
        {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("history.csv");
            let names = ["t_s", "theta_rad", "theta_b_rad", "x_um", "y_um"].map(str::to_owned);
            let mut writer = HistoryWriter::create(&path, &names).unwrap();
            for step in 0..=26000 {
                let t = 5e-4 * f64::from(step);
                let (a, b) = (TAU * 5.0 * t, TAU * 5.0 * ratio * t);
                let x = 20.0 * (a + 0.4).cos() + 3.0 * (2.0 * a).cos() + 8.0 * (b - 1.0).cos();
                let y = 11.0 * (b + 0.4).cos() + 30.0 * a.sin() + 2.0 * (2.0 * b).sin();
                writer.push(&[t, a, b, x, y]).unwrap();
            }
            writer.finish().unwrap();
            let history = HistoryFile::open(&path).unwrap();
            let of = |column: &str, angle: &str| Oscillation {
                title: column.into(),
                quantity: "displacement",
                unit: "µm".to_owned(),
                columns: vec![(column.into(), "x")],
                angle: Some(angle.into()),
            };
            let all = [of("x_um", "theta_rad"), of("y_um", "theta_b_rad")];
            let found = orders(&history, &all, (cycle, true)).unwrap().expect("they turn").signals;
            let known = match ratio {
                2.0 => {
                    [[20.0, (3.0 + 8.0 * 1.0_f64.cos()).hypot(8.0 * 1.0_f64.sin())], [11.0, 2.0]]
                }
                _ => [[20.0, 3.0], [11.0, 2.0]],
            };
            // 1X of the second is 2X of the first, and ½X, which is not looked for, of it.
            assert_eq!(found[0].mixed_with.is_empty(), ratio != 2.0, "{ratio} {:?}", found[0]);
            for (own, known) in found.iter().zip(known) {
                let far = [own.first.amplitude - known[0], own.second.amplitude - known[1]];
                assert!(far.iter().all(|far| far.abs() < 0.02), "{ratio} {cycle} {own:?}");
            }
        }
    }

    /// Speeds that no window tells apart are said, and those of bodies that turn as one are not.
    #[test]
    fn orders_that_cannot_be_told_apart_are_said() {
        for (ratio, said) in [(1.001, true), (-1.0, true), (1.0, false)] {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("history.csv");
            let names = ["t_s", "theta_rad", "theta_b_rad", "x_um", "y_um"].map(str::to_owned);
            let mut writer = HistoryWriter::create(&path, &names).unwrap();
            for step in 0..=100_000 {
                let t = 5e-4 * f64::from(step);
                let a = TAU * 5.0 * t;
                writer.push(&[t, a, ratio * a, a.cos(), a.sin()]).unwrap();
            }
            writer.finish().unwrap();
            let history = HistoryFile::open(&path).unwrap();
            let of = |column: &str, angle: &str| Oscillation {
                title: column.into(),
                quantity: "displacement",
                unit: "µm".to_owned(),
                columns: vec![(column.into(), "x")],
                angle: Some(angle.into()),
            };
            let all = [of("x_um", "theta_rad"), of("y_um", "theta_b_rad")];
            let found = orders(&history, &all, (0.4, true)).unwrap().expect("they turn");
            assert_eq!(!found.signals[0].mixed_with.is_empty(), said, "{ratio}");
            let text = super::super::of_orders(Some(&found));
            assert_eq!(text.contains("cannot be told apart"), said, "{text}");
        }
    }

    /// Known amplitudes and phases, among other orders, through a run-up and through steps that no revolution is a whole
    /// number of.
    #[test]
    fn amplitudes_and_phases_are_found_among_other_orders() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let names = ["t_s", "theta_rad", "x_um", "y_um"].map(str::to_owned).to_vec();
        let mut writer = HistoryWriter::create(&path, &names).unwrap();
        for step in 0..4000 {
            let t = 1e-4 * f64::from(step);
            let theta = 400.0 * t + 300.0 * t * t;
            let wave =
                |order: f64, amplitude: f64, phase: f64| amplitude * (order * theta + phase).cos();
            let x = 7.0 + wave(1.0, 20.0, 0.5) + wave(2.0, 3.0, -2.5) + wave(0.5, 9.0, 1.0);
            let other = wave(4.0, 2.0, 0.3) + wave(7.0, 1.0, 0.1);
            writer
                .push(&[t, theta, x + wave(3.0, 5.0, 2.0) + other, -4.0 * wave(1.0, 1.0, 0.0)])
                .unwrap();
        }
        writer.finish().unwrap();
        let history = HistoryFile::open(&path).unwrap();
        let all = [Oscillation {
            title: "disc".into(),
            quantity: "displacement",
            unit: "µm".to_owned(),
            columns: vec![("x_um".into(), "x"), ("y_um".into(), "y")],
            angle: Some("theta_rad".into()),
        }];
        for cycle in [0.1, 0.05, 0.001] {
            let found = orders(&history, &all, (cycle, true)).unwrap().expect("it turns").signals;
            let [x, y] = found.as_slice() else { panic!("two signals") };
            // Orders that are not fitted leave a trace, as rows do not meet the revolution's start.
            let near = |found: Order, amplitude: f64, phase: f64| {
                let turned = (found.phase_deg - phase.to_degrees()).rem_euclid(360.0);
                assert!((found.amplitude / amplitude - 1.0).abs() < 0.01, "{found:?} {cycle}");
                assert!(turned.min(360.0 - turned) < 0.5, "{found:?} {cycle}");
            };
            if x.revolutions > 1 {
                near(x.first, 20.0, 0.5);
                near(x.second, 3.0, -2.5);
            }
            assert!((y.first.amplitude - 4.0).abs() < 1e-6 && y.second.amplitude < 1e-6);
            assert!((y.first.phase_deg.abs() - 180.0).abs() < 1e-5);
        }
        assert!(orders(&history, &[], (0.1, true)).unwrap().is_none());
    }
}
