//! Least and largest value of every revolution of a run and those beside it, by the speed there: what whirls at about half the speed
//! takes two revolutions or more for one of its own.

use std::f64::consts::TAU;

/// Points at most; where there are more revolutions a point stands for several.
const POINTS: f64 = 400.0;
/// What the last turn may lack of a whole one (rad) beside a row, as its angle is rounded: runs begin a row before their first one.
const WHOLE: f64 = 1e-6;

/// Those of the columns of one angle while the rows pass.
pub(crate) struct Enveloper {
    /// Places of the angle and of the columns in a row.
    angle: usize,
    columns: Vec<usize>,
    /// Revolutions of a point, and the sense of the rotation.
    revolutions: f64,
    sense: f64,
    /// The angle at which the first one begins (rad), how many are done, and the one at work.
    begins: f64,
    own: Option<Turn>,
    found: Vec<Turn>,
}

/// One or a few revolutions.
struct Turn {
    number: f64,
    /// Time and angle (rad) of the first and the last row, and how far that is from the row before.
    ends: [[f64; 2]; 2],
    row: f64,
    /// A column each: least and largest.
    columns: Vec<[f64; 2]>,
}

/// Least and largest values point by point.
#[derive(Debug)]
pub(crate) struct Envelope {
    /// Of a point.
    pub(crate) revolutions: f64,
    /// s, in the middle.
    pub(crate) time: Vec<f64>,
    pub(crate) rpm: Vec<f64>,
    /// A column each.
    pub(crate) signals: Vec<Extremes>,
}

/// Those of a column.
#[derive(Debug)]
pub(crate) struct Extremes {
    pub(crate) column: String,
    pub(crate) least: Vec<f64>,
    pub(crate) most: Vec<f64>,
}

impl Enveloper {
    /// Of columns over an angle that turns from `begins` to `ends` (rad), whose places in a row are given.
    pub(crate) fn new((angle, columns): (usize, Vec<usize>), [begins, ends]: [f64; 2]) -> Self {
        let revolutions = ((ends - begins).abs() / TAU / POINTS).ceil().max(1.0);
        let sense = (ends - begins).signum();
        let begins = sense * begins;
        Enveloper { angle, columns, revolutions, sense, begins, own: None, found: Vec::new() }
    }

    /// Takes a row.
    pub(crate) fn add(&mut self, time: f64, row: &[f64]) {
        let angle = self.sense * row[self.angle];
        let number = ((angle - self.begins) / (self.revolutions * TAU)).floor();
        // What comes back stays in the turn in which it was.
        if self.own.as_ref().is_none_or(|own| number > own.number) {
            let columns = vec![[f64::INFINITY, f64::NEG_INFINITY]; self.columns.len()];
            let next = Turn { number, ends: [[time, angle]; 2], row: 0.0, columns };
            self.found.extend(self.own.replace(next));
        }
        let Some(own) = &mut self.own else { return };
        own.row = angle - own.ends[1][1];
        own.ends[1] = [time, angle];
        for ([least, most], place) in own.columns.iter_mut().zip(&self.columns) {
            (*least, *most) = (least.min(row[*place]), most.max(row[*place]));
        }
    }

    /// What was found in whole revolutions, with names of columns; none without any.
    pub(crate) fn finish(self, names: &[String]) -> Option<Envelope> {
        // Turns that began but did not end, or in which a standstill is, tell of no speed.
        let ended = |own: &&Turn| {
            let end = self.begins + (own.number + 1.0) * self.revolutions * TAU;
            own.ends[1][1] + own.row.max(0.0) >= end - WHOLE
        };
        let all = self.found.iter().chain(self.own.as_ref().filter(ended));
        let all: Vec<&Turn> = all.filter(|own| own.ends[1][0] > own.ends[0][0]).collect();
        if all.is_empty() {
            return None;
        }
        let each = |of: &dyn Fn(&Turn) -> f64| all.iter().map(|own| of(own)).collect::<Vec<f64>>();
        let rpm = |own: &Turn| {
            let [[from, first], [to, last]] = own.ends;
            (last - first) / (to - from) * 60.0 / TAU
        };
        let beside = |at: usize| at.saturating_sub(1)..(at + 2).min(all.len());
        let signal = |(k, place): (usize, &usize)| {
            let [mut least, mut most] = [Vec::new(), Vec::new()];
            for at in 0..all.len() {
                let own = all[beside(at)].iter().map(|own| own.columns[k]);
                let wider = |[a, b]: [f64; 2], own: [f64; 2]| [a.min(own[0]), b.max(own[1])];
                let [low, high] = own.fold([f64::INFINITY, f64::NEG_INFINITY], wider);
                least.push(low);
                most.push(high);
            }
            Extremes { column: names[*place].clone(), least, most }
        };
        Some(Envelope {
            revolutions: self.revolutions,
            time: each(&|own| 0.5 * (own.ends[0][0] + own.ends[1][0])),
            rpm: each(&rpm),
            signals: self.columns.iter().enumerate().map(signal).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A run-up in which the amplitude grows with the angle, in both senses, with a spike in one revolution.
    #[test]
    fn every_revolution_has_its_extremes() {
        for sense in [1.0, -1.0] {
            let angle = |t: f64| sense * (20.0 * t + 40.0 * t * t);
            let x = |t: f64| (1.0 + angle(t).abs()) * angle(t).sin();
            let mut own = Enveloper::new((0, vec![1]), [0.0, angle(4.0)]);
            assert_eq!(own.revolutions, 1.0);
            for step in 0..=4000 {
                let t = 1e-3 * f64::from(step);
                own.add(t, &[angle(t), if step == 1234 { 1e4 } else { x(t) }]);
            }
            let spiked = (angle(1.234).abs() / TAU).floor() as usize;
            assert_eq!(own.found.len(), (angle(4.0).abs() / TAU).floor() as usize);
            for (k, turn) in own.found.iter().enumerate() {
                let [least, most] = turn.columns[0];
                let size = 1.0 + TAU * (k as f64 + 0.75);
                // Peaks are a quarter before and behind, and rows miss them by 0.17 rad at most.
                assert!(least < -0.9 * (size - TAU) && least > -size - 1.0, "{k} {least} {size}");
                assert_eq!(most > 9e3, k == spiked, "{k} {most}");
                let rate = (20.0 + 80.0 * 0.5 * (turn.ends[0][0] + turn.ends[1][0])) * 60.0 / TAU;
                let [[from, first], [to, last]] = turn.ends;
                assert!(((last - first) / (to - from) * 60.0 / TAU / rate - 1.0).abs() < 1e-9);
            }
            let whole = own.finish(&["theta".into(), "x".into()]).expect("turns");
            assert_eq!((whole.signals.len(), whole.signals[0].column.as_str()), (1, "x"));
            // The spike is in the points beside it, too.
            let spikes = whole.signals[0].most.iter().enumerate().filter(|own| *own.1 > 9e3);
            let spikes: Vec<usize> = spikes.map(|own| own.0).collect();
            assert_eq!(spikes, [spiked - 1, spiked, spiked + 1]);
        }
    }

    #[test]
    fn many_revolutions_share_points() {
        let mut own = Enveloper::new((0, vec![0]), [0.0, 1000.0 * TAU]);
        assert_eq!(own.revolutions, 3.0);
        for step in 0..=10_000 {
            own.add(f64::from(step), &[0.1 * TAU * f64::from(step)]);
        }
        assert_eq!(own.found.len(), 333);
        // A run that ends with its last turn, as far as angles are rounded.
        let mut whole = Enveloper::new((0, vec![0]), [0.0, 3.0 * TAU]);
        (0..=30).for_each(|step| {
            whole.add(f64::from(step), &[0.1 * TAU * f64::from(step) - 1e-9]);
        });
        assert_eq!(whole.finish(&["theta".into()]).expect("turns").time.len(), 3);
        assert!(own.finish(&["theta".into()]).is_some());
        let still = Enveloper::new((0, vec![0]), [0.0, 0.0]);
        assert!(still.finish(&["theta".into()]).is_none());
    }
}
