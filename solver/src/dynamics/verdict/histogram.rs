//! How many values there are of every size.

use serde::{Deserialize, Serialize};

/// Counts of values by their size, fifty classes a decade from 1e-24 to 1e8: metres, as far as they
/// mean anything.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Histogram {
    zeros: u64,
    counts: Vec<u64>,
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

    pub(super) fn add(&mut self, value: f64) {
        self.add_times(value, 1);
    }

    /// Adds a value that stands for so many. What is no number, or beyond all classes, counts as the largest.
    pub(super) fn add_times(&mut self, value: f64, times: u64) {
        let class = (value.log10() - Self::LEAST) * Self::CLASSES;
        let last = self.counts.len() - 1;
        match class {
            _ if class.is_nan() || class >= last as f64 => self.counts[last] += times,
            _ if class < 0.0 => self.zeros += times,
            _ => self.counts[class as usize] += times,
        }
    }

    /// How many values there are.
    pub(super) fn count(&self) -> u64 {
        self.zeros + self.counts.iter().sum::<u64>()
    }

    /// What a fraction of the values stays below, to 1/50 decade.
    pub(super) fn below(&self, fraction: f64) -> f64 {
        let mut left = (fraction * self.count() as f64).ceil() as u64;
        if left <= self.zeros {
            return 0.0;
        }
        left -= self.zeros;
        for (class, count) in self.counts.iter().enumerate() {
            if left <= *count {
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
    fn a_value_counts_as_often_as_it_stands_for() {
        let mut histogram = Histogram::new();
        histogram.add_times(1.0, 90);
        histogram.add_times(3.0, 10);
        assert_eq!(histogram.count(), 100);
        assert!((1.0..1.1).contains(&histogram.below(0.9)));
        assert!((3.0..3.2).contains(&histogram.below(0.91)));
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
