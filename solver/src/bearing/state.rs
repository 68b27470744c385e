//! The springs at one instant: clearances, forces, generalised forces and their derivatives.

use std::ops::Range;

use whirl_specs::{Ring, RingTangent, SpringForce};

use super::contact::ContactsState;
use super::valid::ValidityMonitor;
use super::{BoundLaw, Input, SpringLaw, Springs};
use crate::linalg::{Matrix, add_product, largest_and_sum};

/// Position and velocity of the machine's coordinates, as the springs see them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Motion<'a> {
    pub(crate) theta: f64,
    pub(crate) theta_dot: f64,
    /// Angle (rad) and speed (rad/s) of the shaft in its frame, where it spins in one at rest.
    pub(crate) spin: Option<[f64; 2]>,
    pub(crate) eta: &'a [f64],
    pub(crate) eta_dot: &'a [f64],
    pub(crate) support: &'a [f64],
    pub(crate) support_dot: &'a [f64],
}

/// All springs at one instant. Rows have one value a spring. Allocated once, filled at will.
pub struct SpringState {
    /// δ: radial displacement of the bore (m), and its rate (m/s).
    delta: Vec<f64>,
    delta_dot: Vec<f64>,
    /// h (m).
    pub h: Vec<f64>,
    /// ḣ (m/s).
    pub h_dot: Vec<f64>,
    /// Forces tested for convergence (N): Q of every spring with a law Q(h, ḣ), then what other laws
    /// give, moments over the journal's radius.
    pub forces: Vec<f64>,
    dq_dh: Vec<f64>,
    dq_dh_dot: Vec<f64>,
    /// State of every plane.
    rings: Vec<Ring>,
    pub(crate) contacts: ContactsState,
    /// Generalised forces on (θ, ε_x, ε_y) of every plane: N·m, N, N; ε in the frame of the shaft.
    pub plane_force: Vec<[f64; 3]>,
    /// Generalised force on δ_j of every spring (N).
    spring_force: Vec<f64>,
    pub(super) law_inputs: Vec<f64>,
    pub(super) law_outputs: Vec<f64>,
    pub(super) law_workspace: Vec<f64>,
    rates: bool,
    /// Whether the laws are used where they may be believed.
    pub(super) monitor: ValidityMonitor,
}

impl SpringState {
    /// Memory for the springs.
    pub fn new(springs: &Springs) -> Self {
        let n = springs.len();
        let row = || vec![0.0; n];
        let most = |of: fn(&super::BoundLaw) -> usize| {
            springs.laws.iter().map(|(law, range)| of(law) * range.len()).max().unwrap_or(0)
        };
        let workspace = springs.laws.iter().map(|(law, _)| law.law.workspace()).max();
        SpringState {
            delta: row(),
            delta_dot: row(),
            h: row(),
            h_dot: row(),
            forces: vec![0.0; springs.forces()],
            contacts: ContactsState::new(&springs.contacts),
            dq_dh: row(),
            dq_dh_dot: row(),
            rings: vec![Ring::default(); springs.planes.len()],
            plane_force: vec![[0.0; 3]; springs.planes.len()],
            spring_force: row(),
            law_inputs: vec![0.0; most(|law| law.inputs.len())],
            law_outputs: vec![0.0; most(|law| law.output_rows)],
            law_workspace: vec![0.0; workspace.unwrap_or(0)],
            rates: springs.needs_rates(),
            monitor: ValidityMonitor::new(&springs.measures),
        }
    }

    /// Computes everything but the tangent from the motion.
    pub(crate) fn update(&mut self, springs: &Springs, motion: Motion) {
        multiply(&springs.bore, motion.support, &mut self.delta);
        if self.rates {
            multiply(&springs.bore, motion.support_dot, &mut self.delta_dot);
        }
        for (plane, ring) in springs.planes.iter().zip(&mut self.rings) {
            let [x, y] = &plane.eccentricity;
            ring.position = [motion.theta, along(x, motion.eta), along(y, motion.eta)];
            ring.velocity = [motion.theta_dot, along(x, motion.eta_dot), along(y, motion.eta_dot)];
            ring.c = plane.clearance;
            let range = plane.springs.clone();
            (springs.kernels.clearance)(
                range.len(),
                &plane.table,
                ring,
                &self.delta[range.clone()],
                &self.delta_dot[range.clone()],
                &mut self.h[range.clone()],
                &mut self.h_dot[range],
            );
        }
        self.evaluate_laws(springs);
        for (plane, (ring, force)) in
            springs.planes.iter().zip(self.rings.iter().zip(&mut self.plane_force))
        {
            let range = plane.springs.clone();
            (springs.kernels.force)(
                range.len(),
                &plane.table,
                ring,
                &self.delta[range.clone()],
                &self.forces[range.clone()],
                force,
                &mut self.spring_force[range],
            );
        }
        let tested = &mut self.forces[springs.len()..];
        self.contacts.update(&springs.contacts, motion, tested);
    }

    fn evaluate_laws(&mut self, springs: &Springs) {
        for (law, range) in &springs.laws {
            let n = range.len();
            self.gather(law, range.clone());
            let inputs = &self.law_inputs[..law.inputs.len() * n];
            let outputs = &mut self.law_outputs[..law.output_rows * n];
            law.law.evaluate(n, inputs, outputs, &mut self.law_workspace);
            let row = |place: usize| &outputs[place * n..(place + 1) * n];
            self.forces[range.clone()].copy_from_slice(row(law.q_row));
            for (place, input) in law.inputs.iter().enumerate() {
                let target = match input {
                    Input::Clearance => &mut self.dq_dh,
                    Input::ClearanceRate => &mut self.dq_dh_dot,
                };
                target[range.clone()].copy_from_slice(row(law.q_row + 1 + place));
            }
        }
    }

    /// The inputs of a law, one row each.
    pub(super) fn gather(&mut self, law: &BoundLaw, range: Range<usize>) {
        let n = range.len();
        for (row, input) in law.inputs.iter().enumerate() {
            let values = match input {
                Input::Clearance => &self.h[range.clone()],
                Input::ClearanceRate => &self.h_dot[range.clone()],
            };
            self.law_inputs[row * n..(row + 1) * n].copy_from_slice(values);
        }
    }

    /// Adds the generalised forces on θ, η and the support's coordinates.
    pub(crate) fn add_forces(
        &self,
        springs: &Springs,
        theta: &mut f64,
        eta: &mut [f64],
        support: &mut [f64],
    ) {
        for (plane, force) in springs.planes.iter().zip(&self.plane_force) {
            *theta += force[0];
            for (row, value) in plane.eccentricity.iter().zip(&force[1..]) {
                row.iter().for_each(|&(j, coefficient)| eta[j] += coefficient * value);
            }
        }
        add_product(support, &springs.bore_transposed, &self.spring_force);
        self.contacts.add_forces(&springs.contacts, theta, eta, support);
    }

    /// Of coordinate `place` of q (θ is 0, η_j is 1 + j) the largest single force projected on it, and the sum
    /// of |force| over all that act on it: forces tested for convergence, times how far a unit of the
    /// coordinate moves where they act.
    pub(crate) fn projected(&self, springs: &Springs, place: usize) -> (f64, f64) {
        let (mut largest, mut sum) = (0.0, 0.0);
        let mut add = |(size, all): (f64, f64)| {
            largest = f64::max(largest, size);
            sum += all;
        };
        let (quick, others) = self.forces.split_at(springs.len());
        let first = 1 + springs.shaft_size;
        if place >= first {
            let column = springs.bore.col(place - first);
            add(largest_and_sum(quick.len(), |j| column[j] * quick[j]));
            let contacts = &springs.contacts;
            let mut single = |force| add((force, force));
            self.contacts.projected_on_support(contacts, place - first, &mut single);
            return (largest, sum);
        }
        for (number, (plane, ring)) in springs.planes.iter().zip(&self.rings).enumerate() {
            let arm = match place.checked_sub(1) {
                None => ring.position[1].hypot(ring.position[2]),
                Some(j) => springs.arms[(number, j)],
            };
            let forces = &quick[plane.springs.clone()];
            add(largest_and_sum(forces.len(), |j| arm * forces[j]));
        }
        let mut single = |force| add((force, force));
        self.contacts.projected_on_shaft(&springs.contacts, place, others, &mut single);
        (largest, sum)
    }

    /// A law that gave no number when the springs were last updated, and its bearing.
    pub(crate) fn without_value(&self, springs: &Springs) -> Option<(String, usize)> {
        let lost = |forces: &[f64]| forces.iter().any(|force| !force.is_finite());
        let name = |law: &dyn SpringLaw| law.name().to_owned();
        let own = springs.laws.iter().find_map(|(law, range)| {
            let mut planes = springs.planes.iter().filter(|p| range.contains(&p.springs.start));
            let plane = planes.find(|plane| lost(&self.forces[plane.springs.clone()]))?;
            Some((name(law.law.as_ref()), plane.bearing))
        });
        own.or_else(|| {
            springs.contacts.laws.iter().find_map(|(law, planes)| {
                let place =
                    planes.clone().find(|&place| lost(&self.contacts.planes[place].forces))?;
                Some((name(law.law.as_ref()), springs.contacts.planes[place].bearing))
            })
        })
    }

    /// The derivatives of the generalised forces of one plane, B + a1 P; see [`RingTangent`].
    pub(crate) fn tangent(&self, springs: &Springs, plane: usize, a1: f64, out: &mut RingTangent) {
        let range = springs.planes[plane].springs.clone();
        let law = SpringForce {
            q: &self.forces[range.clone()],
            dq_dh: &self.dq_dh[range.clone()],
            dq_dh_dot: &self.dq_dh_dot[range.clone()],
        };
        (springs.kernels.tangent)(
            range.len(),
            &springs.planes[plane].table,
            &self.rings[plane],
            &self.delta[range.clone()],
            &self.delta_dot[range],
            &law,
            a1,
            out,
        );
    }
}

/// Σ coefficient · x.
pub(crate) fn along(row: &[(usize, f64)], x: &[f64]) -> f64 {
    row.iter().map(|&(j, coefficient)| coefficient * x[j]).sum()
}

/// y = A x.
pub(crate) fn multiply(matrix: &Matrix, x: &[f64], y: &mut [f64]) {
    y.fill(0.0);
    add_product(y, matrix, x);
}
