//! Whether steps follow the gaps of films, whether their surfaces touch, how far their bores turn and how hot they become.
//!
//! Nodes hold oil by the gap and half a step's change of it. Where that is more than half of the gap, the gap alone counts, which
//! is of first order and feels another rate than Newmark's.

use serde::{Deserialize, Serialize};

use crate::bearing::{SpringState, Springs};
use crate::machine::Machine;

/// The films that stand out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmQuality {
    /// Steps in which a node's gap changes too fast, as a fraction of all, in the film in which they are most.
    pub share: f64,
    /// Its bearing, counted from 0.
    pub bearing: usize,
    /// The smallest gap of a film (m), and its bearing.
    pub thinnest: (f64, usize),
    /// How far the bore of a film turns about its axis (rad), at most, and its bearing: pads turn a little.
    pub turned: (f64, usize),
    /// The highest temperature of a film (K), and its bearing; none where no film has a temperature.
    pub hottest: Option<(f64, usize)>,
    /// The temperature (K) that is farthest beyond the rows of its film's viscosity, their end, and the bearing.
    pub unknown: Option<([f64; 2], usize)>,
}

/// What is carried from step to step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct FilmSums {
    steps: u64,
    /// By films the steps in which a node was too fast.
    fast: Vec<u64>,
    /// Their smallest gaps (m), and how far their bores turned (rad).
    least: Vec<f64>,
    turned: Vec<f64>,
    /// Their highest and lowest temperatures (K).
    hottest: Vec<f64>,
    coldest: Vec<f64>,
}

/// Counts the steps of all films.
pub(super) struct FilmMeter {
    pub(super) sums: FilmSums,
    bearings: Vec<usize>,
    /// Temperatures (K) between which their viscosities are known.
    known: Vec<[f64; 2]>,
}

impl FilmMeter {
    pub(super) fn new(springs: &Springs) -> Self {
        let bearings: Vec<usize> = springs.planes_of_films().map(|own| own.bearing).collect();
        FilmMeter {
            sums: FilmSums {
                steps: 0,
                fast: vec![0; bearings.len()],
                least: vec![f64::MAX; bearings.len()],
                turned: vec![0.0; bearings.len()],
                hottest: vec![0.0; bearings.len()],
                coldest: vec![f64::MAX; bearings.len()],
            },
            known: springs.known_viscosities().collect(),
            bearings,
        }
    }

    /// Adds a step that ends with coordinates `q`, where the films were just solved.
    pub(super) fn add(&mut self, machine: &Machine, springs: &SpringState, q: &[f64]) {
        self.sums.steps += 1;
        let films = self.sums.least.iter_mut().zip(springs.least_gaps());
        films.for_each(|(least, own)| *least = least.min(own));
        for (most, bearing) in self.sums.turned.iter_mut().zip(&self.bearings) {
            *most = most.max(machine.turn_of_bore(*bearing, q).abs());
        }
        let films = self.sums.fast.iter_mut().zip(springs.fast_nodes());
        films.for_each(|(steps, nodes)| *steps += u64::from(nodes > 0));
        let films = self.sums.hottest.iter_mut().zip(springs.film_temperatures());
        films.for_each(|(most, own)| *most = most.max(own));
        let films = self.sums.coldest.iter_mut().zip(springs.film_temperatures());
        films.filter(|own| own.1 > 0.0).for_each(|(least, own)| *least = least.min(own));
    }

    /// The worst of them; none without films.
    pub(super) fn worst(&self) -> Option<FilmQuality> {
        let most = |values: &mut dyn Iterator<Item = f64>| -> Option<(f64, usize)> {
            let all = values.zip(self.bearings.iter().copied());
            all.reduce(|worst, own| if own.0 > worst.0 { own } else { worst })
        };
        let steps = self.sums.steps.max(1) as f64;
        let (share, bearing) = most(&mut self.sums.fast.iter().map(|fast| *fast as f64 / steps))?;
        let (gap, thin) = most(&mut self.sums.least.iter().map(|own| -own))?;
        let (thinnest, turned) = ((-gap, thin), most(&mut self.sums.turned.iter().copied())?);
        let hottest = most(&mut self.sums.hottest.iter().copied()).filter(|own| own.0 > 0.0);
        Some(FilmQuality { share, bearing, thinnest, turned, hottest, unknown: self.unknown() })
    }

    /// The temperature that is farthest beyond what is known of its film's viscosity, with the end of that, and its bearing.
    fn unknown(&self) -> Option<([f64; 2], usize)> {
        let films = self.known.iter().zip(self.sums.hottest.iter().zip(&self.sums.coldest));
        let beyond = films.zip(&self.bearings).flat_map(|((known, (hot, cold)), bearing)| {
            [(*hot, known[1], hot - known[1]), (*cold, known[0], known[0] - cold)]
                .into_iter()
                .filter(move |own| *hot > 0.0 && own.2 > 0.0)
                .map(|(value, limit, by)| (by, ([value, limit], *bearing)))
        });
        beyond.reduce(|worst, own| if own.0 > worst.0 { own } else { worst }).map(|own| own.1)
    }
}
