//! Whether laws are used where they may be believed: the worst value of every measure at every bearing.

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::Bearing;
use super::law::Validity;
use super::placed_law::PlacedLaw;
use super::plane::Plane;

/// A measure of the law of a bearing.
#[derive(Debug, Clone, PartialEq)]
pub struct Measure {
    /// Which bearing, counted from 0.
    pub bearing: usize,
    /// Name of the law.
    pub law: String,
    /// What is measured, and its limits.
    pub validity: Validity,
}

/// The worst value of a measure so far: the one furthest beyond a limit or, while it is within both, nearest to one.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Worst {
    /// SI; not a number where the measure is none.
    pub value: f64,
    /// When it was measured, s.
    pub time: f64,
}

impl Measure {
    /// How far beyond a limit a value is, SI; negative within both.
    pub fn excess(&self, value: f64) -> f64 {
        let [least, most] = self.validity.limits;
        if value.is_nan() { f64::INFINITY } else { (value - most).max(least - value) }
    }
}

/// All measures of a machine, and where their laws find their inputs.
pub(crate) struct Measures {
    pub(crate) all: Vec<Measure>,
    pub(super) observed: Vec<Observed>,
    /// Rows times springs of the law with the most.
    most: usize,
}

/// A law with measures.
pub(super) struct Observed {
    /// Which law.
    pub(super) law: usize,
    pub(super) count: usize,
    pub(super) springs: usize,
    /// Springs of a plane among those of the law, and the first measure of its bearing.
    planes: Vec<(Range<usize>, usize)>,
}

impl Measures {
    pub(super) fn new(bearings: &[Bearing], laws: &[PlacedLaw], planes: &[Plane]) -> Self {
        let mut measures = Measures { all: Vec::new(), observed: Vec::new(), most: 0 };
        for (place, law) in laws.iter().enumerate() {
            measures.observe(bearings.len(), place, law, &planes[law.planes.clone()]);
        }
        measures
    }

    /// Adds the measures of a law at each of its bearings.
    fn observe(&mut self, bearings: usize, law: usize, own: &PlacedLaw, planes: &[Plane]) {
        let (valid, springs) = (own.bound.law.valid(), own.springs);
        if valid.is_empty() || springs == 0 {
            return;
        }
        let mut first: Vec<Option<usize>> = vec![None; bearings];
        let mut placed = Vec::with_capacity(planes.len());
        for plane in planes {
            let place = *first[plane.bearing].get_or_insert_with(|| {
                let place = self.all.len();
                self.all.extend(valid.iter().map(|validity| Measure {
                    bearing: plane.bearing,
                    law: own.bound.law.name().to_owned(),
                    validity: validity.clone(),
                }));
                place
            });
            placed.push((plane.springs.clone(), place));
        }
        self.most = self.most.max(valid.len() * springs);
        self.observed.push(Observed { law, count: valid.len(), springs, planes: placed });
    }
}

/// The worst values so far, and memory for those of an instant.
pub(super) struct ValidityMonitor {
    pub(super) worst: Vec<Option<Worst>>,
    pub(super) values: Vec<f64>,
}

impl ValidityMonitor {
    pub(super) fn new(measures: &Measures) -> Self {
        ValidityMonitor { worst: vec![None; measures.all.len()], values: vec![0.0; measures.most] }
    }

    /// Takes the measures of a law at `time`, which stand in `values`.
    pub(super) fn take(&mut self, all: &[Measure], observed: &Observed, time: f64) {
        for (plane, first) in &observed.planes {
            for place in 0..observed.count {
                let row = &self.values[place * observed.springs..][plane.clone()];
                let measure = &all[first + place];
                let value = extreme(measure, row);
                let worst = &mut self.worst[first + place];
                let before = worst.map_or(f64::NEG_INFINITY, |own| measure.excess(own.value));
                if worst.is_none() || measure.excess(value) > before {
                    *worst = Some(Worst { value, time });
                }
            }
        }
    }
}

/// The worst value of a row.
fn extreme(measure: &Measure, row: &[f64]) -> f64 {
    /// Values side by side.
    const LANES: usize = 8;
    let (mut least, mut most) = ([f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
    let mut numbers = [true; LANES];
    let (whole, rest) = row.as_chunks::<LANES>();
    for values in whole {
        for lane in 0..LANES {
            let value = values[lane];
            least[lane] = if value < least[lane] { value } else { least[lane] };
            most[lane] = if value > most[lane] { value } else { most[lane] };
            numbers[lane] &= !value.is_nan();
        }
    }
    for (lane, value) in rest.iter().enumerate() {
        least[lane] = least[lane].min(*value);
        most[lane] = most[lane].max(*value);
        numbers[lane] &= !value.is_nan();
    }
    if !numbers.iter().all(|own| *own) {
        return f64::NAN;
    }
    let least = least.iter().copied().fold(f64::INFINITY, f64::min);
    let most = most.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if measure.excess(least) > measure.excess(most) { least } else { most }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measure(limits: [f64; 2]) -> Measure {
        let text = String::new;
        let validity = Validity {
            name: text(),
            title: text(),
            help: text(),
            unit: text(),
            per_unit: 1.0,
            limits,
        };
        Measure { bearing: 0, law: text(), validity }
    }

    #[test]
    fn the_worst_of_a_row_is_furthest_beyond_a_limit() {
        let row: Vec<f64> = (0..19).map(f64::from).collect();
        assert_eq!(extreme(&measure([f64::NEG_INFINITY, 3.0]), &row), 18.0);
        assert_eq!(extreme(&measure([5.0, f64::INFINITY]), &row), 0.0);
        // 18 is 2 beyond, 0 is 1 beyond.
        assert_eq!(extreme(&measure([1.0, 16.0]), &row), 18.0);
        assert_eq!(extreme(&measure([4.0, 16.0]), &row), 0.0);
        // Wherever it stands: among those taken eight at a time, or in the rest.
        for place in 0..19 {
            for (limits, worst) in [([f64::NEG_INFINITY, 3.0], 40.0), ([5.0, f64::INFINITY], -40.0)]
            {
                let mut row = row.clone();
                row[place] = worst;
                assert_eq!(extreme(&measure(limits), &row), worst);
            }
        }
        // Within both, the nearest to one.
        assert_eq!(extreme(&measure([-5.0, 20.0]), &row), 18.0);
        for bad in [0, 9, 18] {
            let mut row = row.clone();
            row[bad] = f64::NAN;
            assert!(extreme(&measure([-5.0, 20.0]), &row).is_nan());
        }
        assert_eq!(measure([0.0, 1.0]).excess(f64::NAN), f64::INFINITY);
    }

    #[test]
    fn worst_values_keep_their_time() {
        let all = [measure([f64::NEG_INFINITY, 1.0]), measure([0.0, f64::INFINITY])];
        let planes = vec![(0..2, 0), (2..3, 0)];
        let observed = Observed { law: 0, count: 2, springs: 3, planes };
        let mut monitor =
            ValidityMonitor { worst: vec![None; 2], values: vec![0.1, 0.2, 0.3, 0.3, 0.2, 0.1] };
        monitor.take(&all, &observed, 1.0);
        let worst = |value, time| Some(Worst { value, time });
        assert_eq!(monitor.worst, [worst(0.3, 1.0), worst(0.1, 1.0)]);
        monitor.values = vec![0.1, 1.5, 0.2, 0.4, 0.4, 0.4];
        monitor.take(&all, &observed, 2.0);
        assert_eq!(monitor.worst, [worst(1.5, 2.0), worst(0.1, 1.0)]);
        monitor.values = vec![1.5, 1.5, 1.5, -0.1, f64::NAN, 0.0];
        monitor.take(&all, &observed, 3.0);
        assert_eq!(monitor.worst[0], worst(1.5, 2.0));
        let last = monitor.worst[1].unwrap();
        assert!(last.value.is_nan() && last.time == 3.0);
        monitor.values = vec![0.0, 0.0, 0.0, -1.0, -1.0, -1.0];
        monitor.take(&all, &observed, 4.0);
        assert_eq!(monitor.worst[1].unwrap().time, 3.0);
    }
}
