//! Small changes of a march: what becomes of them in each of its steps.
//!
//! A step ends where r(q, q̇, q̈) = 0. With the prediction p of the change at the start, which Newmark's formulas give, it is
//! A δq = C (a1 p − ṗ) + M (a2 p − p̈) at the end, A = K + a1 C + a2 M, all at the state that was found there: the derivative of
//! the step itself, whatever factors its iteration used.

use std::sync::Arc;

use crate::dynamics::iteration::Coefficients;
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
    Step { step: Coefficients, lu: Lu, damping: Arc<Sparse>, mass: Arc<Sparse> },
    /// Accelerations from the forces: M δq̈ = −C δq̇ − K δq.
    Forces { mass: Lu, damping: Matrix, stiffness: Matrix },
}

/// A matrix, and its entries that are not zero, column after column, by which few columns are multiplied.
pub(crate) struct Sparse {
    whole: Matrix,
    entries: Vec<(usize, usize, f64)>,
}

/// Columns from which on the whole matrix is the faster one.
const MANY: usize = 8;

impl Sparse {
    fn new(whole: Matrix) -> Self {
        let columns = (0..whole.cols).flat_map(|j| {
            let column = whole.col(j).iter().enumerate();
            column.filter(|own| *own.1 != 0.0).map(move |(i, value)| (i, j, *value))
        });
        Sparse { entries: columns.collect(), whole }
    }

    /// Adds the product with columns.
    fn add(&self, to: &mut [f64], columns: Columns) {
        if columns.cols >= MANY {
            return multiply_add(to, 1.0, self.whole.view(), columns);
        }
        let rows = columns.rows;
        for (to, own) in to.chunks_exact_mut(rows).zip(columns.data.chunks_exact(rows)) {
            self.entries.iter().for_each(|&(i, j, value)| to[i] += value * own[j]);
        }
    }
}

/// Steps about which a march is linearised: changes that go on with it, and the steps themselves, if they are kept.
pub(crate) struct LinearSteps {
    pub(crate) changes: Changes,
    kept: Option<Vec<LinearStep>>,
    /// C and M of the step before, which are shared where they are the same.
    last: [Arc<Sparse>; 2],
    memory: Vec<f64>,
}

impl LinearSteps {
    /// For changes that go on with the march, or to keep the steps.
    pub(crate) fn new(changes: Changes, keep: bool) -> Self {
        LinearSteps {
            changes,
            kept: keep.then(Vec::new),
            last: std::array::from_fn(|_| Arc::new(Sparse::new(Matrix::zeros(0, 0)))),
            memory: Vec::new(),
        }
    }

    /// The steps that were kept.
    pub(crate) fn into_steps(self) -> Vec<LinearStep> {
        self.kept.unwrap_or_default()
    }

    /// Takes a state at which accelerations follow from the forces; the system was just evaluated there.
    pub(crate) fn begin(&mut self, equations: &mut Equations, state: &State) -> Result<(), Error> {
        let Tangents { mass, damping, stiffness, .. } = equations.tangents(state);
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
        let [whole, damping, mass] = equations.tangents_of_step(state, step.weights());
        let mut lu = Lu::new(mass.rows);
        lu.factor(&whole.data)?;
        for (last, own) in self.last.iter_mut().zip([damping, mass]) {
            if last.whole != own {
                *last = Arc::new(Sparse::new(own));
            }
        }
        let [damping, mass] = self.last.clone();
        self.take(LinearStep::Step { step, lu, damping, mass });
        Ok(())
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
        if q.data.is_empty() {
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
                damping.add(memory, columns(&weighted));
                let weighted: Vec<f64> =
                    q.data.iter().zip(&a.data).map(|(q, a)| a2 * q - a).collect();
                mass.add(memory, columns(&weighted));
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
