//! The state of a machine, and what its tangents are weighted by.

use serde::{Deserialize, Serialize};

use crate::bearing::LawStates;

/// What C and M weigh in a tangent, K having the weight 1: those of Newmark's method are a1 and a2, eq. (46).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Weights {
    /// Of derivatives by q̇ (1/s).
    pub rate: f64,
    /// Of derivatives by q̈ (1/s²).
    pub acceleration: f64,
}

impl Weights {
    /// Of derivatives by q alone.
    pub const POSITION: Weights = Weights { rate: 0.0, acceleration: 0.0 };
}

/// Positions, velocities and accelerations of all coordinates q = {θ, η, x_b}.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// q: θ (rad), η, x_b.
    pub q: Vec<f64>,
    /// q̇.
    pub v: Vec<f64>,
    /// q̈.
    pub a: Vec<f64>,
    /// (a − q̈)/Δt, by which what is integrated differs from q̈; zero in Newmark's method.
    pub lag: Vec<f64>,
    /// The states of the laws.
    pub laws: LawStates,
}

impl State {
    /// All zeros, the laws at rest.
    pub fn new(size: usize) -> Self {
        let values = || vec![0.0; size];
        State { q: values(), v: values(), a: values(), lag: values(), laws: LawStates::default() }
    }

    /// Takes over what no correction moves: the first coordinates, and what is known of the laws.
    pub(crate) fn copy_first(&mut self, first: usize, other: &State) {
        self.q[..first].copy_from_slice(&other.q[..first]);
        self.v[..first].copy_from_slice(&other.v[..first]);
        self.a[..first].copy_from_slice(&other.a[..first]);
        self.laws.copy_from(&other.laws);
    }

    /// Writes by how much the accelerations that steps of `dt` s integrate, those of Newmark's method are q̈, differ from those at the
    /// start of a step, of as many of the last coordinates.
    pub(crate) fn integrated_since(&self, start: &State, dt: f64, out: &mut [f64]) {
        let first = self.a.len() - out.len();
        let integrated = |of: &State, place: usize| of.a[place] + dt * of.lag[place];
        for (out, place) in out.iter_mut().zip(first..) {
            *out = integrated(self, place) - integrated(start, place);
        }
    }

    pub(crate) fn copy_from(&mut self, other: &State) {
        self.q.copy_from_slice(&other.q);
        self.v.copy_from_slice(&other.v);
        self.a.copy_from_slice(&other.a);
        self.lag.copy_from_slice(&other.lag);
        self.laws.copy_from(&other.laws);
    }
}
