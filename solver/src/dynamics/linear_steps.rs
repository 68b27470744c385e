//! Small changes of a march: what becomes of them in each of its steps.
//!
//! A step ends where r(q, q̇, q̈) = 0. With the prediction p of the change at the start, which Newmark's formulas give, it is
//! A δq = C (a1 p − ṗ) + M (a2 p − p̈) at the end, A = K + a1 C + a2 M, all at the state that was found there: the derivative of
//! the step itself, whatever factors its iteration used.

use std::sync::Arc;

use super::newmark::Coefficients;
use crate::equations::{Equations, State, Tangents};
use crate::error::Error;
use crate::linalg::{Columns, Lu, Matrix, multiply_add};

/// Changes of the positions, rates and accelerations of the unknowns, a column each.
#[derive(Debug, Clone)]
pub(crate) struct Changes {
    pub(crate) q: Matrix,
    pub(crate) v: Matrix,
    pub(crate) a: Matrix,
}

impl Changes {
    /// So many columns of so many unknowns, of positions and rates that `entry` gives by row (rates behind positions) and column.
    pub(crate) fn new(
        unknowns: usize,
        columns: usize,
        entry: impl Fn(usize, usize) -> f64,
    ) -> Changes {
        Changes {
            q: Matrix::from_fn(unknowns, columns, &entry),
            v: Matrix::from_fn(unknowns, columns, |i, j| entry(unknowns + i, j)),
            a: Matrix::zeros(unknowns, columns),
        }
    }

    /// A change of a position, or of a rate behind them, in a column.
    pub(crate) fn value(&self, row: usize, column: usize) -> f64 {
        match row.checked_sub(self.q.rows) {
            None => self.q[(row, column)],
            Some(row) => self.v[(row, column)],
        }
    }
}

/// What a step, or an instant at which accelerations begin anew, makes of changes.
pub(crate) enum LinearStep {
    /// A step.
    Step { step: Coefficients, lu: Lu, damping: Arc<Matrix>, mass: Arc<Matrix> },
    /// Accelerations from the forces: M δq̈ = −C δq̇ − K δq.
    Forces { mass: Lu, damping: Arc<Matrix>, stiffness: Arc<Matrix> },
}

/// Steps about which a march is linearised: changes that go on with it, and the steps themselves, if they are kept.
pub(crate) struct LinearSteps {
    pub(crate) changes: Changes,
    kept: Option<Vec<LinearStep>>,
    /// Matrices of the step before, which are shared where they are the same.
    last: [Arc<Matrix>; 3],
    memory: Vec<f64>,
}

impl LinearSteps {
    /// For changes that go on with the march, or to keep the steps.
    pub(crate) fn new(changes: Changes, keep: bool) -> Self {
        LinearSteps {
            changes,
            kept: keep.then(Vec::new),
            last: std::array::from_fn(|_| Arc::new(Matrix::zeros(0, 0))),
            memory: Vec::new(),
        }
    }

    /// The steps that were kept.
    pub(crate) fn into_steps(self) -> Vec<LinearStep> {
        self.kept.unwrap_or_default()
    }

    /// Takes a state at which accelerations follow from the forces; the system was just evaluated there.
    pub(crate) fn begin(&mut self, equations: &mut Equations, state: &State) -> Result<(), Error> {
        let [mass, damping, stiffness] = self.shared(equations.tangents(state));
        let mut lu = Lu::new(mass.rows);
        lu.factor(&mass.data)?;
        self.take(LinearStep::Forces { mass: lu, damping, stiffness });
        Ok(())
    }

    /// Takes a step that ends at a state at which the system was just evaluated.
    pub(super) fn add(
        &mut self,
        equations: &mut Equations,
        step: Coefficients,
        state: &State,
    ) -> Result<(), Error> {
        let Tangents { mass, damping, stiffness, planes } = equations.tangents(state);
        let (a1, a2) = (step.a1, step.a2);
        let all = stiffness.data.iter().zip(damping.data.iter().zip(&mass.data));
        let data: Vec<f64> = all.map(|(k, (c, m))| k + (a1 * c + a2 * m)).collect();
        let mut lu = Lu::new(mass.rows);
        lu.factor(&data)?;
        let empty = Matrix::zeros(0, 0);
        let [mass, damping, _] = self.shared(Tangents { mass, damping, stiffness: empty, planes });
        self.take(LinearStep::Step { step, lu, damping, mass });
        Ok(())
    }

    fn shared(&mut self, tangents: Tangents) -> [Arc<Matrix>; 3] {
        let Tangents { mass, damping, stiffness, .. } = tangents;
        for (last, own) in self.last.iter_mut().zip([mass, damping, stiffness]) {
            if **last != own {
                *last = Arc::new(own);
            }
        }
        self.last.clone()
    }

    fn take(&mut self, mut step: LinearStep) {
        step.apply(&mut self.changes, &mut self.memory);
        if let Some(kept) = &mut self.kept {
            kept.push(step);
        }
    }
}

impl LinearStep {
    /// Takes changes from the start of the step to its end.
    pub(crate) fn apply(&mut self, changes: &mut Changes, memory: &mut Vec<f64>) {
        let Changes { q, v, a } = changes;
        if q.cols == 0 {
            return;
        }
        memory.clear();
        memory.resize(q.data.len(), 0.0);
        let columns = |data| Columns { rows: q.rows, cols: q.cols, data };
        match self {
            LinearStep::Forces { mass, damping, stiffness } => {
                a.data.fill(0.0);
                multiply_add(&mut a.data, -1.0, damping.view(), columns(&v.data));
                multiply_add(&mut a.data, -1.0, stiffness.view(), columns(&q.data));
                solve(mass, &mut a.data);
            }
            LinearStep::Step { step, lu, damping, mass } => {
                let (dt, a1, a2) = (step.dt, step.a1, step.a2);
                for ((q, v), a) in q.data.iter_mut().zip(&mut v.data).zip(&a.data) {
                    *q += dt * (*v + 0.5 * dt * a);
                    *v += dt * a;
                }
                let weighted: Vec<f64> =
                    q.data.iter().zip(&v.data).map(|(q, v)| a1 * q - v).collect();
                multiply_add(memory, 1.0, damping.view(), columns(&weighted));
                let weighted: Vec<f64> =
                    q.data.iter().zip(&a.data).map(|(q, a)| a2 * q - a).collect();
                multiply_add(memory, 1.0, mass.view(), columns(&weighted));
                solve(lu, memory);
                let all = q.data.iter_mut().zip(&mut v.data).zip(&mut a.data);
                for (((q, v), a), end) in all.zip(&*memory) {
                    let moved = end - *q;
                    *q = *end;
                    *v += a1 * moved;
                    *a += a2 * moved;
                }
            }
        }
    }
}

/// Solves for any number of columns.
fn solve(lu: &mut Lu, columns: &mut [f64]) {
    let most = lu.size() * lu.size();
    columns.chunks_mut(most.max(1)).for_each(|some| lu.solve_in_place(some));
}
