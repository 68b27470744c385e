//! What is measured of every step that is accepted: where its energy goes, and how good it is.

use serde::{Deserialize, Serialize};

use super::energy::{EnergyBalance, EnergyMeter, EnergySums};
use super::newmark::{Newmark, State};
use super::quality::{Quality, QualityMeter, QualitySums};
use super::system::System;
use crate::error::Error;

/// All meters of a march.
pub(crate) struct Meters {
    energy: EnergyMeter,
    quality: QualityMeter,
}

/// What the meters carry from step to step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct MeterSums {
    energy: EnergySums,
    quality: QualitySums,
}

impl Meters {
    /// Starts at a state that was just evaluated, for steps of `dt` s.
    ///
    /// # Errors
    /// A mass matrix that is not positive definite.
    pub(crate) fn new(
        system: &mut System,
        method: Newmark,
        dt: f64,
        state: &State,
    ) -> Result<Self, Error> {
        Ok(Meters {
            energy: EnergyMeter::new(system, state),
            quality: QualityMeter::new(system, method, dt, state)?,
        })
    }

    /// Adds a step of `dt` s from `start` at time `t` (s) to `end`, which was just evaluated.
    pub(crate) fn add(
        &mut self,
        system: &System,
        span: (f64, f64),
        start: &State,
        end: &State,
        row_error: f64,
    ) {
        let made = self.energy.add(system, start, end);
        self.quality.add(span, start, end, made, row_error);
    }

    /// Goes on at the state of the step that was added last, just evaluated, after loads have changed at once.
    pub(crate) fn jump(&mut self, system: &System) {
        self.energy.jump(system);
    }

    /// What was measured so far.
    pub(crate) fn sums(&self) -> MeterSums {
        MeterSums { energy: self.energy.sums.clone(), quality: self.quality.sums.clone() }
    }

    /// Goes on from what was measured before, at a state that was just evaluated.
    pub(crate) fn resume_from(&mut self, system: &System, sums: MeterSums) {
        self.energy.resume_from(system, sums.energy);
        self.quality.sums = sums.quality;
    }

    /// The energy balance at a state.
    pub(crate) fn balance(&self, system: &mut System, state: &State) -> EnergyBalance {
        self.energy.balance(system, state)
    }

    /// What the steps were worth; the system is evaluated elsewhere for it.
    pub(crate) fn quality(&self, system: &mut System) -> Quality {
        self.quality.quality(system, &self.energy.sums.flows, self.energy.negligible())
    }
}
