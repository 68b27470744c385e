//! Newmark's method in displacements, eqs. (36b) and (36c), and generalized-α on it.
//!
//! Generalized-α (Chung and Hulbert, 1993) integrates accelerations a that differ from q̈, as Arnold and Brüls (2007) have it:
//! (1 − α_m) a_{n+1} + α_m a_n = (1 − α_f) q̈_{n+1} + α_f q̈_n, Newmark's formulas with a in place of q̈, and the equations of the
//! machine with q̈ at the end of the step. So q̇ and q̈ follow from q there as in Newmark's method, with another a2, and what
//! acts at the end is what balances there. Of a, (a − q̈)/Δt is kept: it is (α_m − α_f) times the rate of q̈ whatever Δt, so that
//! steps may change.

use crate::bearing::{Hold, LawStates};
use crate::equations::{State, Weights};
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

/// How a step is integrated: Newmark's method, of q̈ itself where α_m = α_f = 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Integrator {
    /// γ and β.
    pub newmark: Newmark,
    /// α_m.
    pub alpha_m: f64,
    /// α_f.
    pub alpha_f: f64,
}

impl From<Newmark> for Integrator {
    fn from(newmark: Newmark) -> Self {
        Integrator { newmark, ..Integrator::default() }
    }
}

impl Integrator {
    /// Generalized-α, of second order, that leaves the fraction ρ of motion which is far faster than the step, 0 to 1 (Chung and
    /// Hulbert, 1993, eqs. 17 to 25).
    pub fn generalized_alpha(spectral_radius: f64) -> Self {
        let rho = spectral_radius;
        let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let apart = alpha_m - alpha_f;
        let newmark = Newmark { gamma: 0.5 - apart, beta: 0.25 * (1.0 - apart).powi(2) };
        Integrator { newmark, alpha_m, alpha_f }
    }

    /// Whether it integrates q̈ itself.
    pub(in crate::dynamics) fn is_direct(&self) -> bool {
        self.alpha_m == 0.0 && self.alpha_f == 0.0
    }

    /// Error of a step of `dt` s over the change of q̈ in it (s²): (β + (α_m − α_f)/2 − 1/6) Δt² (q̈_{n+1} − q̈_n), of Newmark's
    /// method as Zienkiewicz and Xie (1991) have it.
    pub(in crate::dynamics) fn error_factor(&self, dt: f64) -> f64 {
        let apart = self.alpha_m - self.alpha_f;
        (self.newmark.beta + 0.5 * apart - 1.0 / 6.0).abs() * dt * dt
    }

    /// Whether it damps motion that is far faster than the step.
    pub(in crate::dynamics) fn damps(&self) -> bool {
        self.newmark.gamma > 0.5
    }

    /// How much K weighs in a step of motion at ω beside M, over (ωΔt)²: β of Newmark's method.
    pub(in crate::dynamics) fn elastic_weight(&self) -> f64 {
        self.newmark.beta * ((1.0 - self.alpha_f) / (1.0 - self.alpha_m))
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
    pub(in crate::dynamics) integrator: Integrator,
}

impl Coefficients {
    /// The coefficients for a step of `dt` s.
    pub fn new(integrator: impl Into<Integrator>, dt: f64) -> Self {
        let integrator = integrator.into();
        let Newmark { gamma, beta } = integrator.newmark;
        let shares = (1.0 - integrator.alpha_m) / (1.0 - integrator.alpha_f);
        Coefficients { dt, a1: gamma / (beta * dt), a2: shares / (beta * dt * dt), integrator }
    }

    /// What C and M weigh in the tangent of a step.
    pub fn weights(&self) -> Weights {
        Weights { rate: self.a1, acceleration: self.a2 }
    }

    /// The end of the step if the accelerations that are integrated stay as they are: q_n + Δt q̇_n + ½ Δt² a_n, q̇_n + Δt a_n,
    /// and the q̈ that goes with them, in Newmark's method q̈_n.
    pub(crate) fn predict(&self, start: &State, end: &mut State) {
        self.foresee(&start.laws, &mut end.laws);
        let (dt, n) = (self.dt, start.q.len());
        if !self.integrator.is_direct() {
            let rest = dt / (1.0 - self.integrator.alpha_f);
            for i in 0..n {
                let integrated = start.a[i] + dt * start.lag[i];
                end.q[i] = start.q[i] + dt * (start.v[i] + 0.5 * dt * integrated);
                end.v[i] = start.v[i] + dt * integrated;
                end.a[i] = start.a[i] + rest * start.lag[i];
            }
            return;
        }
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

impl Integrator {
    /// δ_m and δ_f, by which the rates w of states that are integrated go with ṡ: (1 − δ_m) w_{n+1} + δ_m w_n =
    /// (1 − δ_f) ṡ_{n+1} + δ_f ṡ_n (Brüls and Golinval, 2006); zero in Newmark's method.
    fn of_states(&self) -> [f64; 2] {
        if self.is_direct() { [0.0; 2] } else { [2.0 * self.alpha_f - 0.5, self.alpha_f] }
    }

    /// θ of s_{n+1} = s_n + Δt ((1 − θ) w_n + θ w_{n+1}): γ in Newmark's method, ½ + δ_f − δ_m in generalized-α.
    fn theta(&self) -> f64 {
        let [carried, of_rates] = self.of_states();
        if self.is_direct() { self.newmark.gamma } else { 0.5 + of_rates - carried }
    }

    /// What a step misses of a state: the first times Δt² s̈, which is none of the methods of second order, and the second times
    /// Δt³ d³s/dt³. With w = ṡ + LΔt s̈ + MΔt² d³s/dt³, L = δ_m − δ_f and M = L (δ_m − ½), they are θ + L − ½ and
    /// θ (½ + L) + M − 1/6.
    pub(in crate::dynamics) fn missed_of_states(&self) -> [f64; 2] {
        let ([carried, of_rates], theta) = (self.of_states(), self.theta());
        let apart = carried - of_rates;
        let second = theta + apart - 0.5;
        let third = theta * (0.5 + apart) + apart * (carried - 0.5) - 1.0 / 6.0;
        [if second.abs() < f64::EPSILON { 0.0 } else { second }, third]
    }
}

impl Coefficients {
    /// Takes over of the states of laws what is known of them at the end of the step: s_{n+1} = s_n + Δt ((1 − θ) w_n + θ w_{n+1}) is
    /// that and a share of ṡ_{n+1}.
    fn foresee(&self, start: &LawStates, end: &mut LawStates) {
        end.copy_from(start);
        if start.known.is_empty() && start.films.is_empty() {
            return;
        }
        let (dt, [carried, of_rates]) = (self.dt, self.integrator.of_states());
        end.step = dt;
        let theta = self.integrator.theta();
        for i in 0..end.known.len() {
            let (rate, w) = (start.rates[i], start.rates[i] + dt * start.lag[i]);
            let known = (of_rates * rate - carried * w) / (1.0 - carried);
            end.known[i] = start.known[i] + dt * ((1.0 - theta) * w + theta * known);
        }
        end.hold = Hold::Implicit(dt * theta * ((1.0 - of_rates) / (1.0 - carried)));
    }

    /// Takes what the method carries on to the next step, of the coordinates from `first` on, where a step from `start` has
    /// ended.
    pub(crate) fn end(&self, start: &State, first: usize, end: &mut State) {
        let Integrator { alpha_m, alpha_f, .. } = self.integrator;
        if self.integrator.is_direct() {
            return;
        }
        let [carried, of_rates] = self.integrator.of_states();
        let (before, after) = (&start.laws, &mut end.laws);
        for i in 0..after.lag.len() {
            let rate = (after.rates[i] - before.rates[i]) / self.dt;
            after.lag[i] =
                ((carried - of_rates) * rate - carried * before.lag[i]) / (1.0 - carried);
        }
        for i in first..end.lag.len() {
            let rate = (end.a[i] - start.a[i]) / self.dt;
            end.lag[i] = ((alpha_m - alpha_f) * rate - alpha_m * start.lag[i]) / (1.0 - alpha_m);
        }
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
        let start =
            State { q: vec![1.0, -2.0], v: vec![3.0, 0.5], a: vec![-7.0, 40.0], ..State::new(2) };
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

    /// Whatever ρ, by the formulas of the method.
    #[test]
    fn a_corrected_prediction_is_the_end_of_a_step_of_generalized_alpha() {
        for rho in [0.0, 0.3, 0.9, 1.0] {
            let method = Integrator::generalized_alpha(rho);
            let (dt, Newmark { gamma, beta }) = (0.02, method.newmark);
            let step = Coefficients::new(method, dt);
            let start = State {
                q: vec![0.0, 1.0, -2.0],
                v: vec![0.0, 3.0, 0.5],
                a: vec![0.0, -7.0, 40.0],
                lag: vec![0.0, 500.0, -30.0],
                ..State::new(3)
            };
            let (mut predicted, mut end) = (State::new(3), State::new(3));
            step.predict(&start, &mut predicted);
            end.copy_from(&predicted);
            step.correct(&predicted, [0.003, -0.02].into_iter(), 1, &mut end);
            step.end(&start, 1, &mut end);
            for i in 1..3 {
                let [a, b] = [&start, &end].map(|own| own.a[i] + dt * own.lag[i]);
                let q = start.q[i] + dt * start.v[i] + dt * dt * ((0.5 - beta) * a + beta * b);
                let v = start.v[i] + dt * ((1.0 - gamma) * a + gamma * b);
                let left = (1.0 - method.alpha_m) * b + method.alpha_m * a;
                let right = (1.0 - method.alpha_f) * end.a[i] + method.alpha_f * start.a[i];
                assert!((end.q[i] - q).abs() <= 1e-14, "{rho}: {} for {q}", end.q[i]);
                assert!((end.v[i] - v).abs() <= 1e-13, "{rho}: {} for {v}", end.v[i]);
                assert!((left - right).abs() <= 1e-11, "{rho}: {left} for {right}");
            }
            assert_eq!(end.lag[0], 0.0);
        }
    }

    /// ρ = 1 damps nothing, and is the average acceleration.
    #[test]
    fn a_spectral_radius_of_one_is_newmarks_method() {
        let method = Integrator::generalized_alpha(1.0);
        assert_eq!(method.newmark, Newmark::default());
        let [own, newmark] = [method, Integrator::default()].map(|own| Coefficients::new(own, 0.1));
        assert_eq!((own.a1, own.a2), (newmark.a1, newmark.a2));
        assert_eq!(method.error_factor(0.1), Integrator::default().error_factor(0.1));
    }

    /// Of a free motion with q̈ = t: what a step misses of t³/6 is the error that is measured.
    #[test]
    fn the_error_of_a_step_is_what_it_misses() {
        for rho in [0.0, 0.5, 0.9, 1.0] {
            let (method, dt) = (Integrator::generalized_alpha(rho), 0.1);
            let step = Coefficients::new(method, dt);
            let lag = method.alpha_m - method.alpha_f;
            let start = State { lag: vec![lag], ..State::new(1) };
            let mut end = State::new(1);
            step.predict(&start, &mut end);
            let (predicted, moved) = (end.clone(), (dt - end.a[0]) / step.a2);
            step.correct(&predicted, [moved].into_iter(), 0, &mut end);
            step.end(&start, 0, &mut end);
            assert!((end.a[0] - dt).abs() < 1e-15 && (end.lag[0] - lag).abs() < 1e-14);
            let missed = (end.q[0] - dt.powi(3) / 6.0).abs();
            assert!(
                (missed / (method.error_factor(dt) * dt) - 1.0).abs() < 1e-12,
                "{rho}: {missed}"
            );
        }
    }
}
