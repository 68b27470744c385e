//! Whether steps follow the gaps of films.
//!
//! Nodes hold oil by the gap and half a step's change of it. Where that is more than half of the gap, the gap alone counts, which
//! is of first order and feels another rate than Newmark's.

use serde::{Deserialize, Serialize};

use crate::bearing::{SpringState, Springs};

/// The film that is most often too fast for its steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmRates {
    /// Steps in which a node's gap changes too fast, as a fraction of all.
    pub share: f64,
    /// The bearing, counted from 0.
    pub bearing: usize,
}

/// What is carried from step to step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct FilmSums {
    steps: u64,
    /// By films the steps in which a node was too fast.
    fast: Vec<u64>,
}

/// Counts the steps of all films.
pub(super) struct FilmMeter {
    pub(super) sums: FilmSums,
    bearings: Vec<usize>,
}

impl FilmMeter {
    pub(super) fn new(springs: &Springs) -> Self {
        let bearings = springs.bearings_of_films();
        FilmMeter { sums: FilmSums { steps: 0, fast: vec![0; bearings.len()] }, bearings }
    }

    /// Adds a step that ends where the films were just solved.
    pub(super) fn add(&mut self, springs: &SpringState) {
        self.sums.steps += 1;
        let films = self.sums.fast.iter_mut().zip(springs.fast_nodes());
        films.for_each(|(steps, nodes)| *steps += u64::from(nodes > 0));
    }

    /// The worst film; none without films.
    pub(super) fn worst(&self) -> Option<FilmRates> {
        let steps = self.sums.steps.max(1) as f64;
        let all = self.sums.fast.iter().zip(&self.bearings);
        let all = all.map(|(fast, &bearing)| FilmRates { share: *fast as f64 / steps, bearing });
        all.reduce(|worst, own| if own.share > worst.share { own } else { worst })
    }
}
