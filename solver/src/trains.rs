//! What turns together: rotations that couplings and gears tie to each other, each with its speed in its train.

/// Trains of things that turn, by their places.
#[derive(Debug, Clone)]
pub(crate) struct Trains {
    /// The smallest place in the train, and the speed where the train turns with 1 rad/s.
    members: Vec<(usize, f64)>,
}

impl Trains {
    /// So many, each by itself.
    pub(crate) fn new(count: usize) -> Self {
        Trains { members: (0..count).map(|own| (own, 1.0)).collect() }
    }

    /// Ties b to a; `ratio`: the speed of b over that of a. What is in one train already stays as it is.
    pub(crate) fn tie(&mut self, [a, b]: [usize; 2], ratio: f64) {
        let ((train, of_a), (other, of_b)) = (self.members[a], self.members[b]);
        if train == other {
            return;
        }
        // Speed of the train of b where that of a turns with 1 rad/s.
        let speed = of_a * ratio / of_b;
        let ((keep, joins), factor) = match train < other {
            true => ((train, other), speed),
            false => ((other, train), 1.0 / speed),
        };
        for own in self.members.iter_mut().filter(|own| own.0 == joins) {
            *own = (keep, own.1 * factor);
        }
    }

    /// The smallest place in the train of one.
    pub(crate) fn train(&self, place: usize) -> usize {
        self.members[place].0
    }

    /// Its speed where the train turns with 1 rad/s.
    pub(crate) fn ratio(&self, place: usize) -> f64 {
        self.members[place].1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_multiply_along_a_train_in_whatever_order_it_is_tied() {
        let ties = [([3, 1], -0.5), ([1, 4], 2.0), ([0, 4], 3.0)];
        for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
            let mut trains = Trains::new(6);
            for k in order {
                trains.tie(ties[k].0, ties[k].1);
            }
            assert_eq!([0, 1, 2, 3, 4, 5].map(|own| trains.train(own)), [0, 0, 2, 0, 0, 5]);
            // 4 turns with 3, 1 with half of that, 3 with −2 times that.
            let speeds = [0, 4, 1, 3].map(|own| trains.ratio(own) / trains.ratio(0));
            for (own, expected) in speeds.into_iter().zip([1.0, 3.0, 1.5, -3.0]) {
                assert!((own - expected).abs() < 1e-14, "{order:?}: {speeds:?}");
            }
        }
    }
}
