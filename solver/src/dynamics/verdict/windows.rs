//! Energy made and energy that flowed, by places (the motions of each bearing) and by parts of the march.

use serde::{Deserialize, Serialize};

use crate::bearing::work::Flow;
use crate::dynamics::motion::larger;

/// Steps of a window at first: longer than a contact whose first step makes energy that matters.
const SHORTEST: u64 = 64;
/// Windows that are kept at most; then two and two become one.
const MOST: usize = 256;
/// Windows that are taken together: one of them is an eighth of the part of a march that is checked.
const TOGETHER: usize = 8;

/// Sums of [`Flow`] over windows of equal numbers of steps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Windows {
    places: usize,
    /// Steps of a window, and those in the last.
    length: u64,
    in_last: u64,
    /// Windows × places.
    flows: Vec<Flow>,
}

impl Windows {
    pub(crate) fn new(places: usize) -> Self {
        Windows { places, length: SHORTEST, in_last: SHORTEST, flows: Vec::new() }
    }

    /// Adds a step, one flow a place.
    pub(crate) fn add(&mut self, step: &[Flow]) {
        if self.places == 0 {
            return;
        }
        if self.in_last == self.length {
            if self.flows.len() == MOST * self.places {
                self.merge();
            }
            self.flows.extend(std::iter::repeat_n(Flow::default(), self.places));
            self.in_last = 0;
        }
        let last = self.flows.len() - self.places;
        self.flows[last..].iter_mut().zip(step).for_each(|(sum, own)| sum.add(own));
        self.in_last += 1;
    }

    /// Makes one window of two.
    fn merge(&mut self) {
        let pairs = self.flows.chunks_exact(2 * self.places);
        let merged = pairs.flat_map(|pair| {
            let (first, second) = pair.split_at(self.places);
            first.iter().zip(second).map(|(a, b)| {
                let mut sum = *a;
                sum.add(b);
                sum
            })
        });
        self.flows = merged.collect();
        self.length *= 2;
        self.in_last = self.length;
    }

    /// The flow of a place over the whole march.
    pub(crate) fn whole(&self, place: usize) -> Flow {
        sum(self.of(place))
    }

    /// The largest fraction of energy made at a place: over the whole march, or over eight windows of it, so that
    /// a long quiet time hides no bad impact. What flowed in eight windows includes that in the windows beside
    /// them, which a contact may reach into, and is never less than it is on average, nor than `least` (J). What is made counts as
    /// far as forces are known: to `unknown` (N).
    pub(crate) fn fraction(&self, place: usize, least: f64, unknown: f64) -> f64 {
        let flows: Vec<&Flow> = self.of(place).collect();
        let whole = self.whole(place);
        let average = whole.flowed * TOGETHER as f64 / flows.len().max(TOGETHER) as f64;
        let fraction = |own: Flow, flowed: f64| {
            let made = own.made - unknown * own.moved;
            let made = if made < 0.0 { 0.0 } else { made };
            Flow { made, flowed: flowed.max(least), moved: 0.0 }.fraction()
        };
        let parts = (0..flows.len().saturating_sub(TOGETHER - 1)).map(|start| {
            let end = start + TOGETHER;
            let beside = start.saturating_sub(1)..(end + 1).min(flows.len());
            let own = sum(flows[start..end].iter().copied());
            let flowed = sum(flows[beside].iter().copied()).flowed;
            fraction(own, f64::max(flowed, average))
        });
        parts.fold(fraction(whole, whole.flowed), larger)
    }

    fn of(&self, place: usize) -> impl Iterator<Item = &Flow> {
        self.flows.iter().skip(place).step_by(self.places.max(1))
    }
}

fn sum<'a>(flows: impl Iterator<Item = &'a Flow>) -> Flow {
    flows.fold(Flow::default(), |mut sum, own| {
        sum.add(own);
        sum
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn windows_sum_up_to_the_whole_however_long_it_is() {
        let mut windows = Windows::new(2);
        let steps = 300_000_u32;
        for step in 0..steps {
            let flow = |made: f64| Flow { made, flowed: 1.0, moved: 0.0 };
            windows.add(&[flow(f64::from(step)), flow(0.0)]);
        }
        assert!(windows.flows.len() <= 2 * MOST);
        let whole = f64::from(steps) * f64::from(steps - 1) / 2.0;
        let flowed = f64::from(steps);
        assert_eq!(windows.whole(0), Flow { made: whole, flowed, moved: 0.0 });
        assert_eq!(windows.whole(1), Flow { made: 0.0, flowed, moved: 0.0 });
        assert_eq!(windows.fraction(1, 0.0, 0.0), 0.0);
    }

    #[test]
    fn a_quiet_time_hides_no_impact_and_the_edge_of_a_window_makes_none() {
        for at in [700, 703, 704, 705] {
            let mut windows = Windows::new(1);
            for step in 0..100_000 {
                // A contact of 30 steps: its first makes 13 % of the energy that flows in and out.
                let made = if step == at { 0.13 * 30.0 } else { 0.0 };
                let flowed = if (at..at + 30).contains(&step) { 1.0 } else { 1e-3 };
                windows.add(&[Flow { made, flowed, moved: made }]);
            }
            assert!(windows.whole(0).fraction() < 0.04);
            let fraction = windows.fraction(0, 0.0, 0.0);
            assert!((0.1..=0.13).contains(&fraction), "{fraction} where it begins in step {at}");
            let of = |least: f64, unknown: f64| windows.fraction(0, least, unknown);
            let fraction = of(390.0, 0.0);
            assert!((fraction - 0.01).abs() < 1e-12, "{fraction} of 390 J, 3.9 J made");
            assert!((of(390.0, 0.25) - 0.0075).abs() < 1e-12, "a quarter of a newton over 3.9 m");
            assert_eq!(of(390.0, 1.0), 0.0);
        }
    }

    #[test]
    fn energy_made_where_none_flowed_is_beyond_every_limit() {
        let fraction = |made, flowed| Flow { made, flowed, moved: 1.0 }.fraction();
        assert_eq!(fraction(0.0, 0.0), 0.0);
        assert_eq!(fraction(1e-9, 0.0), f64::INFINITY);
        assert!(fraction(f64::NAN, f64::NAN).is_nan());
    }
}
