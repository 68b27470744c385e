//! The time step as textbooks write it: full Newton, with a dense matrix of nalgebra that is made and factored anew in every
//! iteration. Its forces and the entries of its matrix are those of the solver's own kernels.

use nalgebra::{DMatrix, DVector};
use whirl_solver::dynamics::{Coefficients, Newmark};
use whirl_solver::equations::{Equations, State};
use whirl_solver::machine::Machine;

/// A machine whose coordinates are all unknown.
pub struct PlainStep<'m> {
    equations: Equations<'m>,
    method: Newmark,
    dt: f64,
    tangent: Vec<f64>,
}

impl<'m> PlainStep<'m> {
    /// Steps of `dt` s.
    ///
    /// # Panics
    /// If a rotation is given.
    pub fn new(machine: &'m Machine, method: Newmark, dt: f64) -> Self {
        assert_eq!(machine.first_unknown(), 0, "all coordinates are unknown");
        let tangent = vec![0.0; machine.size() * machine.size()];
        PlainStep { equations: Equations::new(machine), method, dt, tangent }
    }

    /// Takes a state from t − Δt to `t` (s), where loads have stopped driving as `released` says; the iterations that it took. They end where corrections no longer count:
    /// below 1e-10 of what the step moves.
    ///
    /// # Panics
    /// If the matrix is singular, or the corrections never end.
    pub fn advance(&mut self, t: f64, state: &mut State, released: &[bool]) -> usize {
        self.equations.release(released);
        let (dt, Newmark { gamma, beta }) = (self.dt, self.method);
        let (a1, a2) = (gamma / (beta * dt), 1.0 / (beta * dt * dt));
        let step = Coefficients::new(self.method, dt);
        let size = state.q.len();
        let start = state.q.clone();
        // The end if accelerations stay as they are.
        for i in 0..size {
            state.q[i] += dt * (state.v[i] + 0.5 * dt * state.a[i]);
            state.v[i] += dt * state.a[i];
        }
        for iteration in 1..=50 {
            self.equations.evaluate(t, state);
            self.equations.tangent(t, state, step.weights(), &mut self.tangent);
            let matrix = DMatrix::from_column_slice(size, size, &self.tangent);
            let residual = DVector::from_column_slice(self.equations.residual());
            let moved = matrix.lu().solve(&residual).expect("a matrix that is not singular");
            for (i, moved) in moved.iter().enumerate() {
                state.q[i] += moved;
                state.v[i] += a1 * moved;
                state.a[i] += a2 * moved;
            }
            let length = state.q.iter().zip(&start).map(|(q, start)| (q - start).powi(2));
            if moved.norm() <= 1e-10 * length.sum::<f64>().sqrt() {
                return iteration;
            }
        }
        panic!("the corrections of the step that ends at {t} s do not end");
    }
}
