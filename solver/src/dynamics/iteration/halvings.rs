//! Steps that were halved, as they could not be solved: how many, and where.

use serde::{Deserialize, Serialize};

/// Where the iteration of a step failed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum HalvedAt {
    /// The row of a coordinate, by its place in q, is not solved.
    Coordinate(usize),
    /// The forces of a bearing or stop, counted from 0, do not come to rest.
    Bearing(usize),
}

/// The steps of a march that had to be halved.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HalvedSteps {
    /// Steps that were halved, of so many; of parts of them where the march chooses those.
    pub steps: usize,
    /// Those that were done, halved or not.
    pub of: usize,
    /// Halvings in all.
    pub halvings: u64,
    /// Where most of them failed.
    pub at: Option<HalvedAt>,
}

/// Counts of halvings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(in crate::dynamics) struct Halvings {
    /// Steps that were halved.
    pub(in crate::dynamics) steps: usize,
    /// Halvings by where they failed: coordinates, then bearings.
    counts: Vec<u64>,
    coordinates: usize,
}

impl Halvings {
    pub(in crate::dynamics) fn new(coordinates: usize, bearings: usize) -> Self {
        Halvings { steps: 0, counts: vec![0; coordinates + bearings], coordinates }
    }

    /// Counts a halving of a step, or of a part of it that is one already.
    pub(in crate::dynamics) fn count(&mut self, whole: bool, at: HalvedAt) {
        self.steps += usize::from(whole);
        let place = match at {
            HalvedAt::Coordinate(place) => place,
            HalvedAt::Bearing(bearing) => self.coordinates + bearing,
        };
        self.counts[place] += 1;
    }

    /// What was counted in so many steps.
    pub(in crate::dynamics) fn of(&self, of: usize) -> HalvedSteps {
        // The first of equals.
        let most = self.counts.iter().enumerate().rev().max_by_key(|(_, count)| **count);
        let at = most.filter(|(_, count)| **count > 0).map(|(place, _)| {
            match place.checked_sub(self.coordinates) {
                None => HalvedAt::Coordinate(place),
                Some(bearing) => HalvedAt::Bearing(bearing),
            }
        });
        HalvedSteps { steps: self.steps, of, halvings: self.counts.iter().sum(), at }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_place_of_most_halvings_is_named() {
        let mut halvings = Halvings::new(3, 2);
        assert_eq!(halvings.of(7), HalvedSteps { of: 7, ..HalvedSteps::default() });
        halvings.count(true, HalvedAt::Coordinate(2));
        for whole in [true, false] {
            halvings.count(whole, HalvedAt::Bearing(1));
        }
        let at = Some(HalvedAt::Bearing(1));
        assert_eq!(halvings.of(9), HalvedSteps { steps: 2, of: 9, halvings: 3, at });
        (0..2).for_each(|_| halvings.count(false, HalvedAt::Coordinate(2)));
        assert_eq!(halvings.of(9).at, Some(HalvedAt::Coordinate(2)));
    }
}
