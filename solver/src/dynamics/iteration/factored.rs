//! Factors of [AK], and where they were computed.

use serde::{Deserialize, Serialize};
use whirl_specs::ContactTangent;

use super::newmark::{Coefficients, Integrator};
use crate::equations::{Equations, State};
use crate::linalg::{Lu, copy_block_from};
use crate::machine::Machine;
use crate::told::ToldLoad;

/// Factors of [AK], and the tangents of the springs in it.
pub(super) struct Factors {
    pub(super) lu: Lu,
    pub(super) tangents: Vec<ContactTangent>,
}

impl Factors {
    /// None, of so many unknowns.
    pub(super) fn new(equations: &Equations, unknowns: usize) -> Self {
        Factors { lu: Lu::new(unknowns), tangents: equations.spring_tangents().to_vec() }
    }

    /// Computes them at a state that was evaluated; whether there are any. `whole`: memory for [AK] of all coordinates, where not
    /// all are unknown.
    pub(super) fn take(
        &mut self,
        equations: &mut Equations,
        (t, at, step): (f64, &State, &Coefficients),
        whole: &mut [f64],
    ) -> bool {
        let first = equations.machine.first_unknown();
        if first == 0 {
            equations.tangent(t, at, step.weights(), self.lu.values_mut());
        } else {
            equations.tangent(t, at, step.weights(), whole);
            copy_block_from(first, whole, at.q.len(), self.lu.values_mut());
        }
        for (own, tangent) in self.tangents.iter_mut().zip(equations.spring_tangents()) {
            copy_tangent(tangent, own);
        }
        self.lu.factor_in_place().is_ok()
    }
}

fn copy_tangent(from: &ContactTangent, to: &mut ContactTangent) {
    to.ring_ring = from.ring_ring;
    to.ring_bore.copy_from_slice(&from.ring_bore);
    to.bore_ring.copy_from_slice(&from.bore_ring);
    to.bore_bore.copy_from_slice(&from.bore_bore);
}

/// Where factors were computed: time (s), state, released and told loads, the side of a jump, and step length (s), 0 where there are none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Factored {
    pub(super) time: f64,
    pub(super) state: State,
    released: Vec<bool>,
    told: Vec<Option<ToldLoad>>,
    before: bool,
    pub(super) dt: f64,
}

impl Factored {
    /// Nowhere.
    pub(super) fn nowhere(machine: &Machine) -> Self {
        let loads = machine.loads.len();
        Factored {
            time: 0.0,
            state: State::new(machine.size()),
            released: vec![false; loads],
            told: vec![None; loads],
            before: false,
            dt: 0.0,
        }
    }

    /// Forgets where, as what was computed there is not to be used.
    pub(super) fn forget(&mut self) {
        self.dt = 0.0;
    }

    pub(super) fn keep(&mut self, (time, state, dt): (f64, &State, f64), equations: &Equations) {
        (self.time, self.before, self.dt) = (time, equations.before, dt);
        self.state.copy_from(state);
        self.released.copy_from_slice(&equations.released);
        self.told.copy_from_slice(&equations.told);
    }

    /// Sets what acts on a system to what acted there.
    pub(super) fn restore(&self, equations: &mut Equations) {
        equations.before = self.before;
        equations.released.copy_from_slice(&self.released);
        equations.told.copy_from_slice(&self.told);
    }

    pub(super) fn is_there(&self) -> bool {
        self.dt > 0.0
    }

    /// Evaluates a system there, with what acted; the step of what was computed.
    pub(super) fn evaluate(&self, equations: &mut Equations, method: Integrator) -> Coefficients {
        self.restore(equations);
        equations.evaluate(self.time, &self.state);
        Coefficients::new(method, self.dt)
    }
}
