//! How many values there are of every size.

use serde::{Deserialize, Serialize};

/// Counts of values by their size, fifty classes a decade from 1e-24 to 1e8: metres, as far as they
/// mean anything.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Histogram {
    zeros: u64,
    counts: Vec<u32>,
}

impl Histogram {
    const CLASSES: f64 = 50.0;
    /// Of the smallest class, and of all.
    const LEAST: f64 = -24.0;
    const DECADES: f64 = 32.0;

    pub(super) fn new() -> Self {
        let classes = (Self::DECADES * Self::CLASSES) as usize;
        Histogram { zeros: 0, counts: vec![0; classes] }
    }

    /// What is no number, or beyond all classes, counts as the largest.
    pub(super) fn add(&mut self, value: f64) {
        let class = (value.log10() - Self::LEAST) * Self::CLASSES;
        let last = self.counts.len() - 1;
        match class {
            _ if class.is_nan() || class >= last as f64 => self.add_to(last),
            _ if class < 0.0 => self.zeros += 1,
            _ => self.add_to(class as usize),
        }
    }

    fn add_to(&mut self, class: usize) {
        self.counts[class] = self.counts[class].saturating_add(1);
    }

    /// How many values there are.
    pub(super) fn count(&self) -> u64 {
        self.zeros + self.counts.iter().map(|&count| u64::from(count)).sum::<u64>()
    }

    /// What a fraction of the values stays below, to 1/50 decade.
    pub(super) fn below(&self, fraction: f64) -> f64 {
        let mut left = (fraction * self.count() as f64).ceil() as u64;
        if left <= self.zeros {
            return 0.0;
        }
        left -= self.zeros;
        for (class, count) in self.counts.iter().enumerate() {
            let count = u64::from(*count);
            if left <= count {
                return 10.0_f64.powf((class + 1) as f64 / Self::CLASSES + Self::LEAST);
            }
            left -= count;
        }
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fraction_of_the_values_is_found_to_a_fiftieth_of_a_decade() {
        let mut histogram = Histogram::new();
        // In an order that makes classes at both ends, and with zeros.
        for i in 0..1000_u32 {
            let place = (i * 617) % 1000;
            histogram.add(if place < 100 { 0.0 } else { 1e-12 * f64::from(place) });
        }
        for fraction in [0.05, 0.5, 0.95, 1.0] {
            let exact: f64 = 1e-12 * (1000.0 * fraction - 1.0);
            let exact = if fraction < 0.1 { 0.0 } else { exact };
            let found = histogram.below(fraction);
            let wide = 10.0_f64.powf(1.0 / Histogram::CLASSES);
            assert!(found >= exact && found <= exact * wide * wide, "{found} for {exact}");
        }
    }

    #[test]
    fn values_of_any_size_that_means_something_are_counted() {
        for value in [1e-23, 1.0, 1e7_f64] {
            let mut histogram = Histogram::new();
            histogram.add(value);
            let found = histogram.below(1.0);
            assert!(found >= value && found <= value * 1.1, "{found} for {value}");
        }
    }
}
