//! How many steps a load that follows an angle has in its period.

use serde::{Deserialize, Serialize};

use crate::equations::State;
use crate::machine::Machine;

/// Steps in a period of what acts at least. Between N samples of a sine lies (2π/N)²/8 of its amplitude: that much a
/// straight line between two of them misses it, and the largest of them its peak. From 23 on this is below
/// the 1 % by which a steady state is tested.
pub const LEAST_STEPS: f64 = 23.0;

/// Where a load that follows an angle had the fewest steps in a period.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct FewestSteps {
    /// How many.
    pub steps: f64,
    /// The body whose angle it follows.
    pub body: usize,
    /// The speed that it had (rad/s).
    pub speed: f64,
}

/// Measures them.
pub(super) struct PeriodMeter {
    /// For every angle that a load follows: its place in q, the body, and most periods in a revolution over 2π.
    angles: Vec<(usize, usize, f64)>,
    pub(super) fewest: Option<FewestSteps>,
}

impl PeriodMeter {
    pub(super) fn new(machine: &Machine) -> Self {
        let mut angles: Vec<(usize, usize, f64)> = Vec::new();
        for load in &machine.loads {
            let Some((body, rate)) = load.time_function.periods() else { continue };
            let Some(place) = machine.places()[body].rotation else { continue };
            match angles.iter_mut().find(|own| own.0 == place) {
                Some(own) => own.2 = own.2.max(rate),
                None => angles.push((place, body, rate)),
            }
        }
        PeriodMeter { angles, fewest: None }
    }

    /// The part of a period that a step takes at most, times the steps that there are to be: above 1 it has too few.
    pub(super) fn excess(&self, [start, end]: [&State; 2]) -> f64 {
        let parts = self.angles.iter().map(|&(place, _, rate)| {
            LEAST_STEPS * rate * (end.q[place] - start.q[place]).abs() / std::f64::consts::TAU
        });
        parts.fold(0.0, f64::max)
    }

    /// Adds a step of `dt` s.
    pub(super) fn add(&mut self, dt: f64, [start, end]: [&State; 2]) {
        for &(place, body, rate) in &self.angles {
            let turned = end.q[place] - start.q[place];
            let steps = std::f64::consts::TAU / (rate * turned.abs());
            if self.fewest.is_none_or(|own| steps < own.steps) {
                self.fewest = Some(FewestSteps { steps, body, speed: turned / dt });
            }
        }
    }
}
