//! Where the work of the loads goes.

use super::newmark::State;
use super::system::System;

/// The energy balance of a march, in J: work in = kinetic + strain + spring + dissipated + error, each
/// counted from the start.
///
/// Work, dissipation and spring energy are sums of ½ (F_n + F_{n+1})·(q_{n+1} − q_n): with (γ, β) = (½, ¼)
/// this is exact for constant matrices, so that the error is what the varying ones leave.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct EnergyBalance {
    /// Work of the external loads.
    pub work_in: f64,
    /// Kinetic energy gained.
    pub kinetic: f64,
    /// Strain energy of shaft and support gained.
    pub strain: f64,
    /// Work done on the springs of the bearings, stored or lost in them.
    pub spring: f64,
    /// Work done on the dampers of shaft and support.
    pub dissipated: f64,
}

impl EnergyBalance {
    /// What does not balance.
    pub fn error(&self) -> f64 {
        self.work_in - self.kinetic - self.strain - self.spring - self.dissipated
    }
}

/// Sums the balance over steps.
pub(crate) struct Ledger {
    balance: EnergyBalance,
    start: (f64, f64),
    load: Vec<f64>,
    spring: Vec<f64>,
    damper: Vec<f64>,
}

impl Ledger {
    /// Opens the account at a state that was just evaluated.
    pub(crate) fn new(system: &mut System, state: &State) -> Self {
        Ledger {
            balance: EnergyBalance::default(),
            start: (system.kinetic_energy(state), system.strain_energy(state)),
            load: system.load.clone(),
            spring: system.spring.clone(),
            damper: system.damper.clone(),
        }
    }

    /// Adds a step that ends at a state just evaluated.
    pub(crate) fn add(&mut self, system: &System, start: &State, end: &State) {
        let moved = |before: &[f64], after: &[f64]| -> f64 {
            let forces = before.iter().zip(after).map(|(a, b)| 0.5 * (a + b));
            forces.zip(start.q.iter().zip(&end.q)).map(|(force, (a, b))| force * (b - a)).sum()
        };
        self.balance.work_in += moved(&self.load, &system.load);
        self.balance.spring -= moved(&self.spring, &system.spring);
        self.balance.dissipated += moved(&self.damper, &system.damper);
        self.load.copy_from_slice(&system.load);
        self.spring.copy_from_slice(&system.spring);
        self.damper.copy_from_slice(&system.damper);
    }

    /// The balance at a state.
    pub(crate) fn balance(&self, system: &mut System, state: &State) -> EnergyBalance {
        EnergyBalance {
            kinetic: system.kinetic_energy(state) - self.start.0,
            strain: system.strain_energy(state) - self.start.1,
            ..self.balance
        }
    }
}
