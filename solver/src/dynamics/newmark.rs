//! Newmark's method in displacements, eqs. (36b) and (36c).

use serde::{Deserialize, Serialize};

use crate::linalg::widely;

/// Parameters of the method. (½, ¼), the average acceleration, neither damps nor lets energy grow in
/// linear systems; γ > ½ damps, which in a turning frame makes false lateral forces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Newmark {
    /// γ.
    pub gamma: f64,
    /// β.
    pub beta: f64,
}

impl Default for Newmark {
    fn default() -> Self {
        Newmark { gamma: 0.5, beta: 0.25 }
    }
}

/// What one time step turns positions into: q̇ = a1 (q−q_n) − a3 q̇_n − a4 q̈_n,
/// q̈ = a2 (q−q_n) − a5 q̇_n − a6 q̈_n. Written from the prediction (see `Coefficients::predict`) only a1 and
/// a2 are left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients {
    pub(crate) dt: f64,
    pub(crate) a1: f64,
    pub(crate) a2: f64,
}

impl Coefficients {
    /// The coefficients for a step of `dt` s.
    pub fn new(method: Newmark, dt: f64) -> Self {
        let Newmark { gamma, beta } = method;
        Coefficients { dt, a1: gamma / (beta * dt), a2: 1.0 / (beta * dt * dt) }
    }

    /// Of a machine at rest that takes all the time there is: a1 = a2 = 0.
    pub(crate) fn at_rest() -> Self {
        Coefficients { dt: f64::INFINITY, a1: 0.0, a2: 0.0 }
    }

    /// The end of the step if accelerations stay as they are: q_n + Δt q̇_n + ½ Δt² q̈_n, q̇_n + Δt q̈_n, q̈_n.
    pub(crate) fn predict(&self, start: &State, end: &mut State) {
        let (dt, n) = (self.dt, start.q.len());
        let [q, v, a] = [&start.q, &start.v, &start.a].map(|own| &own[..n]);
        let [to_q, to_v, to_a] = [&mut end.q, &mut end.v, &mut end.a].map(|own| &mut own[..n]);
        widely(|| {
            for i in 0..n {
                to_q[i] = q[i] + dt * (v[i] + 0.5 * dt * a[i]);
                to_v[i] = v[i] + dt * a[i];
                to_a[i] = a[i];
            }
        });
    }

    /// The end of the step from its prediction and the correction of the positions there, for the coordinates
    /// from `first` on. Together with [`Coefficients::predict`] these are eqs. (36b) and (36c), without the
    /// difference q − q_n, whose rounding a2 would enlarge.
    pub(crate) fn correct(
        &self,
        predicted: &State,
        correction: impl Iterator<Item = f64>,
        first: usize,
        end: &mut State,
    ) {
        let (a1, a2) = (self.a1, self.a2);
        let [q, v, a] = [&predicted.q, &predicted.v, &predicted.a].map(|own| &own[first..]);
        let [to_q, to_v, to_a] =
            [&mut end.q, &mut end.v, &mut end.a].map(|own| own[first..].iter_mut());
        let from = q.iter().zip(v).zip(a).zip(correction);
        widely(|| {
            for (((to_q, to_v), to_a), (((q, v), a), moved)) in to_q.zip(to_v).zip(to_a).zip(from) {
                *to_q = q + moved;
                *to_v = v + a1 * moved;
                *to_a = a + a2 * moved;
            }
        });
    }
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
}

impl State {
    /// All zeros.
    pub fn new(size: usize) -> Self {
        State { q: vec![0.0; size], v: vec![0.0; size], a: vec![0.0; size] }
    }

    /// Takes over the first coordinates only, which no correction moves.
    pub(crate) fn copy_first(&mut self, first: usize, other: &State) {
        self.q[..first].copy_from_slice(&other.q[..first]);
        self.v[..first].copy_from_slice(&other.v[..first]);
        self.a[..first].copy_from_slice(&other.a[..first]);
    }

    pub(crate) fn copy_from(&mut self, other: &State) {
        self.q.copy_from_slice(&other.q);
        self.v.copy_from_slice(&other.v);
        self.a.copy_from_slice(&other.a);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_corrected_prediction_is_newmarks_end_of_the_step() {
        let (method, dt) = (Newmark { gamma: 0.6, beta: 0.31 }, 0.02);
        let Newmark { gamma, beta } = method;
        let step = Coefficients::new(method, dt);
        let start = State { q: vec![1.0, -2.0], v: vec![3.0, 0.5], a: vec![-7.0, 40.0] };
        let (mut predicted, mut end) = (State::new(2), State::new(2));
        step.predict(&start, &mut predicted);
        end.copy_from(&predicted);
        step.correct(&predicted, [0.003].into_iter(), 1, &mut end);
        // What is before `first` stays as predicted.
        assert_eq!((end.q[0], end.v[0], end.a[0]), (predicted.q[0], predicted.v[0], -7.0));
        for i in 0..2 {
            // q = q_n + Δt q̇_n + Δt² ((½ − β) q̈_n + β q̈), q̇ = q̇_n + Δt ((1 − γ) q̈_n + γ q̈).
            let mean = (0.5 - beta) * start.a[i] + beta * end.a[i];
            let rate = (1.0 - gamma) * start.a[i] + gamma * end.a[i];
            let q = start.q[i] + dt * start.v[i] + dt * dt * mean;
            assert!((end.q[i] - q).abs() <= 1e-15, "{} for {q}", end.q[i]);
            assert!((end.v[i] - start.v[i] - dt * rate).abs() <= 1e-14);
        }
    }
}
