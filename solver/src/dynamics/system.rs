//! The equations of the machine at one instant: the residual
//! r = Q_v − M q̈ + Q_e + Q_s − C q̇ − K q and its derivatives.

use whirl_specs::MotionState;

use super::newmark::{Coefficients, State};
use super::spring_tangent::SpringTangent;
use crate::bearing::SpringState;
use crate::bearing::state::Motion;
use crate::linalg::add_product;
use crate::loads::Position;
use crate::machine::Machine;

/// Memory for evaluating a machine, and what was last evaluated.
pub struct System<'m> {
    pub(crate) machine: &'m Machine,
    tensors: Vec<&'m [f64]>,
    workspace: Vec<f64>,
    /// Time of the last evaluation (s).
    pub(crate) time: f64,
    /// r, one value a coordinate, and its terms: Q_v − M q̈, C q̇, K q, and the generalised forces of the
    /// loads and of the springs.
    pub(crate) residual: Vec<f64>,
    pub(crate) inertia: Vec<f64>,
    pub(crate) damper: Vec<f64>,
    pub(crate) elastic: Vec<f64>,
    pub(crate) load: Vec<f64>,
    pub(crate) spring: Vec<f64>,
    pub(crate) springs: SpringState,
    /// For every load whether it has stopped driving.
    pub(crate) released: Vec<bool>,
    pub(crate) shaft_block: Vec<f64>,
    /// Norms of the rows of M, C and K of the shaft.
    pub(crate) row_norms: Vec<[f64; 3]>,
    /// What every row may have by its own terms; see `System::row_error`.
    pub(super) row_bounds: Vec<f64>,
    spring_tangent: SpringTangent,
}

impl<'m> System<'m> {
    /// Memory for a machine.
    pub fn new(machine: &'m Machine) -> Self {
        let (size, n_s) = (machine.size(), machine.shaft.size());
        let springs = &machine.springs;
        System {
            machine,
            tensors: machine.tensors(),
            workspace: vec![0.0; (machine.motion.workspace)(n_s)],
            time: 0.0,
            residual: vec![0.0; size],
            inertia: vec![0.0; size],
            damper: vec![0.0; size],
            elastic: vec![0.0; size],
            load: vec![0.0; size],
            spring: vec![0.0; size],
            springs: SpringState::new(springs),
            released: vec![false; machine.loads.len()],
            shaft_block: vec![0.0; (1 + n_s) * (1 + n_s)],
            row_norms: System::row_norms(&machine.shaft),
            row_bounds: vec![0.0; size],
            spring_tangent: SpringTangent::new(springs, machine.support.size()),
        }
    }

    /// r at the state that was last evaluated, one value a coordinate. That of a rotation that is no unknown is
    /// the couple which would be needed beside the loads, with the sign changed.
    pub fn residual(&self) -> &[f64] {
        &self.residual
    }

    /// Computes r and its parts at time `t` (s).
    pub fn evaluate(&mut self, t: f64, state: &State) {
        self.time = t;
        let machine = self.machine;
        let (shaft, support) = (&machine.shaft, &machine.support);
        let first = 1 + shaft.size();
        let (eta, eta_dot) = (&state.q[1..first], &state.v[1..first]);
        let motion = motion_state(state, first);
        let inertia = &mut self.inertia[..first];
        (machine.motion.inertia_force)(&self.tensors, &motion, &mut self.workspace, inertia);

        self.damper.fill(0.0);
        self.elastic.fill(0.0);
        add_product(&mut self.damper[1..first], &shaft.damping, eta_dot);
        add_product(&mut self.elastic[1..first], &shaft.stiffness, eta);
        for i in 0..support.size() {
            let (x, v, a) = (state.q[first + i], state.v[first + i], state.a[first + i]);
            self.inertia[first + i] = -a;
            self.damper[first + i] = support.damping[i] * v;
            self.elastic[first + i] = support.stiffness[i] * x;
        }

        self.load.fill(0.0);
        let position = Position::new(state.q[0]);
        let (q_theta, q_eta) = self.load.split_first_mut().expect("θ");
        for (load, released) in machine.loads.iter().zip(&self.released) {
            let factor = load.factor(t, *released);
            load.add_force(factor, &position, eta, q_theta, &mut q_eta[..shaft.size()]);
        }

        let springs = Motion {
            theta: state.q[0],
            theta_dot: state.v[0],
            spin: machine.spin(t),
            eta,
            eta_dot,
            support: &state.q[first..],
            support_dot: &state.v[first..],
        };
        self.springs.update(&machine.springs, springs);
        self.spring.fill(0.0);
        let (on_shaft, on_support) = self.spring.split_at_mut(first);
        let (theta, on_shaft) = on_shaft.split_first_mut().expect("θ");
        self.springs.add_forces(&machine.springs, theta, on_shaft, on_support);

        let applied = self.load.iter().zip(&self.spring);
        let own = self.inertia.iter().zip(self.elastic.iter().zip(&self.damper));
        for (r, ((load, spring), (inertia, (elastic, damper)))) in
            self.residual.iter_mut().zip(applied.zip(own))
        {
            *r = (inertia - elastic) + (load + spring - damper);
        }
    }

    /// Writes a2 M + a1 C + K + PF − a1 P − B, eq. (46), column after column, at the state that was last
    /// evaluated.
    pub fn tangent(&mut self, t: f64, state: &State, step: &Coefficients, out: &mut [f64]) {
        let machine = self.machine;
        let (shaft, support) = (&machine.shaft, &machine.support);
        let (n_s, size) = (shaft.size(), machine.size());
        let first = 1 + n_s;
        out.fill(0.0);

        let motion = motion_state(state, first);
        (machine.motion.tangent)(
            &self.tensors,
            &motion,
            step.a1,
            step.a2,
            &mut self.workspace,
            &mut self.shaft_block,
        );
        for j in 0..first {
            out[j * size..j * size + first]
                .copy_from_slice(&self.shaft_block[j * first..(j + 1) * first]);
        }
        for j in 0..n_s {
            let column = &mut out[(1 + j) * size + 1..(1 + j) * size + first];
            let parts = shaft.damping.col(j).iter().zip(shaft.stiffness.col(j));
            column.iter_mut().zip(parts).for_each(|(sum, (c, k))| *sum += step.a1 * c + k);
        }
        let position = Position::new(state.q[0]);
        for (load, released) in machine.loads.iter().zip(&self.released) {
            let factor = load.factor(t, *released);
            load.subtract_tangent(factor, &position, &state.q[1..first], size, out);
        }
        let springs = &machine.springs;
        self.spring_tangent.subtract(springs, &self.springs, step.a1, first, size, out);
        for i in 0..support.size() {
            let place = first + i;
            out[place * (size + 1)] +=
                step.a2 + step.a1 * support.damping[i] + support.stiffness[i];
        }
    }

    /// M(q) of the shaft with θ, column after column.
    pub(crate) fn shaft_mass(&mut self, state: &State, out: &mut [f64]) {
        let motion = motion_state(state, 1 + self.machine.shaft.size());
        (self.machine.motion.mass)(&self.tensors, &motion, &mut self.workspace, out);
    }

    /// ½ q̇ᵀM q̇ (J).
    pub fn kinetic_energy(&mut self, state: &State) -> f64 {
        let first = 1 + self.machine.shaft.size();
        let motion = motion_state(state, first);
        let shaft = match self.machine.motion.kinetic_energy {
            Some(energy) => energy(&self.tensors, &motion, &mut self.workspace),
            None => {
                let mass = &mut self.shaft_block;
                (self.machine.motion.mass)(&self.tensors, &motion, &mut self.workspace, mass);
                let v = &state.v[..first];
                let columns = mass.chunks_exact(first).zip(v);
                0.5 * columns.map(|(column, v_j)| v_j * crate::linalg::dot(column, v)).sum::<f64>()
            }
        };
        shaft + 0.5 * state.v[first..].iter().map(|v| v * v).sum::<f64>()
    }

    /// ½ qᵀK q (J).
    pub fn strain_energy(&self, state: &State) -> f64 {
        let (shaft, support) = (&self.machine.shaft, &self.machine.support);
        let first = 1 + shaft.size();
        let eta = &state.q[1..first];
        let bent: f64 =
            (0..eta.len()).map(|j| eta[j] * crate::linalg::dot(shaft.stiffness.col(j), eta)).sum();
        let rest = state.q[first..].iter().zip(&support.stiffness);
        0.5 * (bent + rest.map(|(x, k)| k * x * x).sum::<f64>())
    }
}

fn motion_state(state: &State, first: usize) -> MotionState<'_> {
    MotionState {
        theta: state.q[0],
        theta_dot: state.v[0],
        theta_ddot: state.a[0],
        eta: &state.q[1..first],
        eta_dot: &state.v[1..first],
        eta_ddot: &state.a[1..first],
    }
}
