//! Newmark's method in displacements, eqs. (36b) and (36c).

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

/// a1 … a6 of one time step:
/// q̇ = a1 (q−q_n) − a3 q̇_n − a4 q̈_n,  q̈ = a2 (q−q_n) − a5 q̇_n − a6 q̈_n.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients {
    pub(crate) dt: f64,
    pub(crate) a1: f64,
    pub(crate) a2: f64,
    a3: f64,
    a4: f64,
    a5: f64,
    a6: f64,
}

impl Coefficients {
    /// The coefficients for a step of `dt` s.
    pub fn new(method: Newmark, dt: f64) -> Self {
        let Newmark { gamma, beta } = method;
        Coefficients {
            dt,
            a1: gamma / (beta * dt),
            a2: 1.0 / (beta * dt * dt),
            a3: gamma / beta - 1.0,
            a4: dt * (gamma / (2.0 * beta) - 1.0),
            a5: 1.0 / (beta * dt),
            a6: 1.0 / (2.0 * beta) - 1.0,
        }
    }

    /// a1 = γ/(β Δt): how velocities at the end follow positions there.
    pub fn a1(&self) -> f64 {
        self.a1
    }

    /// a2 = 1/(β Δt²): how accelerations at the end follow positions there.
    pub fn a2(&self) -> f64 {
        self.a2
    }

    /// Positions at the end of the step if accelerations stay as they are.
    pub fn predict(&self, start: &State, end: &mut State) {
        for i in 0..start.q.len() {
            let half = 0.5 * self.dt * start.a[i];
            end.q[i] = start.q[i] + self.dt * (start.v[i] + half);
        }
        self.rates(start, end);
    }

    /// Velocities and accelerations at the end from the positions there.
    pub fn rates(&self, start: &State, end: &mut State) {
        for i in 0..start.q.len() {
            let moved = end.q[i] - start.q[i];
            end.v[i] = self.a1 * moved - self.a3 * start.v[i] - self.a4 * start.a[i];
            end.a[i] = self.a2 * moved - self.a5 * start.v[i] - self.a6 * start.a[i];
        }
    }
}

/// Positions, velocities and accelerations of all coordinates q = {θ, η, x_b}.
#[derive(Debug, Clone, PartialEq)]
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
    fn the_prediction_keeps_accelerations() {
        let method = Newmark { gamma: 0.6, beta: 0.31 };
        let step = Coefficients::new(method, 0.02);
        let start = State { q: vec![1.0, -2.0], v: vec![3.0, 0.5], a: vec![-7.0, 40.0] };
        let mut end = State::new(2);
        step.predict(&start, &mut end);
        for i in 0..2 {
            assert!((end.a[i] - start.a[i]).abs() <= 1e-10);
            assert!((end.v[i] - start.v[i] - 0.02 * start.a[i]).abs() <= 1e-12);
        }
    }
}
