//! A turning body in the equations of the machine: its coordinates {θ, η} side by side, as the kernels of its motion
//! have them, and their places in q.

use whirl_specs::{Motion, MotionState};

use super::state::{State, Weights};
use crate::linalg::{Matrix, add_product, dot};
use crate::machine::{BodyPlace, Machine};
use crate::shaft::Shaft;

/// A turning body with memory for its kernels.
pub(crate) struct TurningBody<'m> {
    pub(crate) shaft: &'m Shaft,
    pub(crate) place: &'m BodyPlace,
    motion: &'static Motion,
    tensors: Vec<&'m [f64]>,
    workspace: Vec<f64>,
    /// A value a coordinate, θ first.
    row: Vec<f64>,
    /// A matrix over the coordinates, column after column.
    block: Vec<f64>,
    /// The factor of K that C is, if it is one.
    pub(crate) proportional: Option<f64>,
    /// Norms of the rows of M, C and K, a coordinate of η each.
    pub(crate) row_norms: Vec<[f64; 3]>,
}

impl<'m> TurningBody<'m> {
    pub(crate) fn new(machine: &'m Machine, shaft: &'m Shaft, place: &'m BodyPlace) -> Self {
        let n = shaft.size();
        let matrices = [&shaft.mass, &shaft.damping, &shaft.stiffness];
        let norm =
            |matrix: &Matrix, i: usize| (0..n).map(|j| matrix[(i, j)].powi(2)).sum::<f64>().sqrt();
        TurningBody {
            shaft,
            place,
            motion: machine.motion,
            tensors: machine.tensors(shaft),
            workspace: vec![0.0; (machine.motion.workspace)(n)],
            row: vec![0.0; 1 + n],
            block: vec![0.0; (1 + n) * (1 + n)],
            proportional: proportional(&shaft.damping, &shaft.stiffness),
            row_norms: (0..n).map(|i| matrices.map(|matrix| norm(matrix, i))).collect(),
        }
    }

    /// Place of θ in q.
    pub(crate) fn theta(&self) -> usize {
        self.place.rotation.expect("a body that turns")
    }

    /// Writes Q_v − M q̈ at the places of the body, and C q̇ and K q, where zeros stand.
    pub(crate) fn evaluate(
        &mut self,
        state: &State,
        [inertia, damper, elastic]: [&mut Vec<f64>; 3],
    ) {
        let (motion, place) = (motion_state(state, self.place), self.place.flexible.clone());
        (self.motion.inertia_force)(&self.tensors, &motion, &mut self.workspace, &mut self.row);
        inertia[self.theta()] = self.row[0];
        inertia[place.clone()].copy_from_slice(&self.row[1..]);
        let (damper, elastic) = (&mut damper[place.clone()], &mut elastic[place]);
        add_product(elastic, &self.shaft.stiffness, motion.eta);
        match self.proportional {
            None => add_product(damper, &self.shaft.damping, motion.eta_dot),
            Some(factor) => {
                add_product(damper, &self.shaft.stiffness, motion.eta_dot);
                damper.iter_mut().for_each(|own| *own *= factor);
            }
        }
    }

    /// Q_v − M q̈ of the body at a state, a value a coordinate, θ first.
    pub(crate) fn inertia(&mut self, state: &State) -> &[f64] {
        let motion = motion_state(state, self.place);
        (self.motion.inertia_force)(&self.tensors, &motion, &mut self.workspace, &mut self.row);
        &self.row
    }

    /// Minus the derivatives of [`TurningBody::inertia`] by q, plus a1 and a2 times those by q̇ and q̈: a column a coordinate,
    /// θ first.
    pub(crate) fn inertia_tangent(&mut self, state: &State, [a1, a2]: [f64; 2]) -> Matrix {
        let motion = motion_state(state, self.place);
        let (workspace, block) = (&mut self.workspace, &mut self.block);
        (self.motion.tangent)(&self.tensors, &motion, a1, a2, workspace, block);
        let rows = 1 + self.shaft.size();
        Matrix { rows, cols: rows, data: self.block.clone() }
    }

    /// Adds a2 M + a1 C + K + PF − a1 P − B of the motion to a matrix over q, column after column.
    pub(crate) fn add_tangent(&mut self, state: &State, weights: Weights, out: &mut [f64]) {
        let motion = motion_state(state, self.place);
        let (workspace, block) = (&mut self.workspace, &mut self.block);
        (self.motion.tangent)(
            &self.tensors,
            &motion,
            weights.rate,
            weights.acceleration,
            workspace,
            block,
        );
        let rows = 1 + self.shaft.size();
        for j in 0..self.shaft.size() {
            let column = &mut block[(1 + j) * rows + 1..(2 + j) * rows];
            let parts = self.shaft.damping.col(j).iter().zip(self.shaft.stiffness.col(j));
            column.iter_mut().zip(parts).for_each(|(sum, (c, k))| *sum += weights.rate * c + k);
        }
        self.add_block(out, state.q.len());
    }

    /// Adds what stands in the block to a matrix of `size` rows over q.
    pub(crate) fn add_block(&self, out: &mut [f64], size: usize) {
        let (theta, place) = (self.theta(), self.place.flexible.clone());
        let columns = std::iter::once(theta).chain(place.clone());
        for (column, own) in columns.zip(self.block.chunks_exact(1 + place.len())) {
            let out = &mut out[column * size..(column + 1) * size];
            out[theta] += own[0];
            out[place.clone()].iter_mut().zip(&own[1..]).for_each(|(sum, value)| *sum += value);
        }
    }

    /// Writes the diagonal of a2 M + a1 C + K, undeformed, at the places of the body.
    pub(crate) fn diagonal(&self, weights: Weights, out: &mut [f64]) {
        let shaft = self.shaft;
        out[self.theta()] = weights.acceleration * shaft.j0;
        for (j, place) in self.place.flexible.clone().enumerate() {
            out[place] = weights.acceleration * shaft.mass[(j, j)]
                + weights.rate * shaft.damping[(j, j)]
                + shaft.stiffness[(j, j)];
        }
    }

    /// Leaves M(q) of the body in its block.
    pub(crate) fn evaluate_mass(&mut self, state: &State) {
        let motion = motion_state(state, self.place);
        (self.motion.mass)(&self.tensors, &motion, &mut self.workspace, &mut self.block);
    }

    /// Leaves nothing in the block that could be taken for a matrix.
    #[cfg(test)]
    pub(crate) fn spoil(&mut self) {
        self.block.fill(f64::NAN);
    }

    /// The block that was evaluated last; its columns.
    pub(crate) fn columns(&self) -> impl Iterator<Item = &[f64]> {
        self.block.chunks_exact(1 + self.shaft.size())
    }

    /// A column of the block that was evaluated last, θ first.
    pub(crate) fn column(&self, j: usize) -> &[f64] {
        let rows = 1 + self.shaft.size();
        &self.block[j * rows..(j + 1) * rows]
    }

    /// θ and η among values over q.
    pub(crate) fn of<'s>(&self, q: &'s [f64]) -> impl Iterator<Item = f64> + 's {
        std::iter::once(q[self.theta()]).chain(q[self.place.flexible.clone()].iter().copied())
    }

    /// ½ q̇ᵀM q̇ of the body (J).
    pub(crate) fn kinetic_energy(&mut self, state: &State) -> f64 {
        if let Some(energy) = self.motion.kinetic_energy {
            let motion = motion_state(state, self.place);
            return energy(&self.tensors, &motion, &mut self.workspace);
        }
        self.evaluate_mass(state);
        self.row[0] = state.v[self.theta()];
        self.row[1..].copy_from_slice(&state.v[self.place.flexible.clone()]);
        let v = &self.row;
        0.5 * self.columns().zip(v).map(|(column, v_j)| v_j * dot(column, v)).sum::<f64>()
    }

    /// The block of M of the coordinates that are unknown, η alone where θ is given.
    pub(crate) fn unknown_mass(&mut self, state: &State, theta_is_given: bool) -> Matrix {
        self.evaluate_mass(state);
        let (first, rows) = (usize::from(theta_is_given), 1 + self.shaft.size());
        Matrix::from_fn(rows - first, rows - first, |i, j| {
            self.block[(first + j) * rows + first + i]
        })
    }
}

/// The motion of a turning body.
fn motion_state<'s>(state: &'s State, place: &BodyPlace) -> MotionState<'s> {
    let theta = place.rotation.expect("a body that turns");
    let flexible = place.flexible.clone();
    MotionState {
        theta: state.q[theta],
        theta_dot: state.v[theta],
        theta_ddot: state.a[theta],
        eta: &state.q[flexible.clone()],
        eta_dot: &state.v[flexible.clone()],
        eta_ddot: &state.a[flexible],
    }
}

/// The factor of one matrix that another is, to rounding.
fn proportional(own: &Matrix, of: &Matrix) -> Option<f64> {
    let largest = of.data.iter().zip(&own.data).max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()))?;
    let factor = largest.1 / largest.0;
    let alike =
        |(own, of): (&f64, &f64)| (own - factor * of).abs() <= 4.0 * f64::EPSILON * own.abs();
    (factor.is_finite() && own.data.iter().zip(&of.data).all(alike)).then_some(factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrices_are_proportional_to_rounding_or_not_at_all() {
        let of = Matrix { rows: 2, cols: 2, data: vec![3.0, -0.1, -0.1, 7.0] };
        let times = |factor: f64| Matrix {
            data: of.data.iter().map(|k| factor * k).collect(),
            ..of.clone()
        };
        let factor = proportional(&times(1e-4), &of).expect("proportional");
        assert!((factor / 1e-4 - 1.0).abs() < 1e-15);
        assert_eq!(proportional(&times(0.0), &of), Some(0.0));
        let mut other = times(1e-4);
        other.data[1] *= 1.0 + 1e-12;
        assert_eq!(proportional(&other, &of), None);
        assert_eq!(proportional(&times(1.0), &Matrix::zeros(2, 2)), None);
    }
}
