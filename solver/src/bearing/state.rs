//! The springs at one instant: how they move, what their laws give, generalised forces and their derivatives.

use whirl_specs::{ContactState, ContactTangent, Ring};

use super::spin::Spin;
use super::valid::ValidityMonitor;
use super::{PlacedLaw, Plane, Springs};
use crate::linalg::{Matrix, add_product};

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

/// All springs at one instant. Allocated once, filled at will.
pub struct SpringState {
    /// Forces tested for convergence (N): law after law, force after force, spring after spring; moments over
    /// the journal's radius.
    pub(crate) forces: Vec<f64>,
    pub(super) planes: Vec<PlaneState>,
    pub(super) laws: Vec<LawState>,
    /// The turn of the journals in their frame, where they spin in it.
    pub(super) spin: Option<Spin>,
    /// Motions of the bores (T_b times the support's coordinates), their rates, and the generalised forces on them.
    bore: Vec<f64>,
    bore_dot: Vec<f64>,
    bore_force: Vec<f64>,
    pub(super) memory: LawMemory,
    rates: bool,
    /// Whether the laws are used where they may be believed.
    pub(super) monitor: ValidityMonitor,
}

/// One plane.
#[derive(Clone, Default)]
pub(super) struct PlaneState {
    /// θ, ε_x and ε_y as the machine's coordinates give them, and their rates.
    position: [f64; 3],
    velocity: [f64; 3],
    /// The same in the frame that turns with the journal.
    pub(super) ring: Ring,
    /// Generalised forces on (θ, ε_x, ε_y) there: N·m, N, N.
    pub(super) ring_force: [f64; 3],
}

impl PlaneState {
    /// The ring of a clearance `c` (m) in the frame that turns with the journal.
    fn ring_with(&self, spin: Option<Spin>, c: f64) -> Ring {
        let ([_, x, y], [_, x_dot, y_dot]) = (self.position, self.velocity);
        match spin {
            Some(spin) => spin.ring([x, y], [x_dot, y_dot], c),
            None => Ring { position: self.position, velocity: self.velocity, c },
        }
    }
}

/// A law at all its springs; rows as in [`whirl_specs::Contact`].
pub(super) struct LawState {
    bore: Vec<f64>,
    bore_dot: Vec<f64>,
    /// Inputs and further measures.
    pub(super) inputs: Vec<f64>,
    pub(super) forces: Vec<f64>,
    slopes: Vec<f64>,
    pub(super) bore_force: Vec<f64>,
}

impl LawState {
    fn new(law: &PlacedLaw) -> Self {
        let (kind, row) = (law.bound.kind, |rows: usize| vec![0.0; rows * law.springs]);
        LawState {
            bore: row(kind.bore.len()),
            bore_dot: row(kind.bore.len()),
            inputs: row(kind.rows),
            forces: row(kind.forces.len()),
            slopes: row(kind.forces.len() * kind.inputs.len()),
            bore_force: row(kind.bore.len()),
        }
    }

    /// Where the kernels find the motion of a plane.
    fn state<'s>(
        law: &'s PlacedLaw,
        plane: &Plane,
        ring: &'s Ring,
        bore: &'s [f64],
        bore_dot: &'s [f64],
    ) -> ContactState<'s> {
        let first = plane.springs.start;
        ContactState {
            stride: law.springs,
            table: from(&law.table, first),
            ring,
            radius: plane.radius,
            bore: from(bore, first),
            bore_dot: from(bore_dot, first),
        }
    }
}

/// Memory in which any of the laws is evaluated at all its springs.
pub(super) struct LawMemory {
    pub(super) inputs: Vec<f64>,
    outputs: Vec<f64>,
    pub(super) workspace: Vec<f64>,
}

impl LawMemory {
    pub(super) fn new(springs: &Springs) -> Self {
        let outputs = springs.most(|law| law.bound.forces.len() * (1 + law.bound.inputs.len()));
        let workspace = springs.laws.iter().map(|law| law.bound.law.workspace()).max();
        LawMemory {
            inputs: vec![0.0; springs.most(|law| law.bound.inputs.len())],
            outputs: vec![0.0; outputs],
            workspace: vec![0.0; workspace.unwrap_or(0)],
        }
    }

    /// What a law gives of the inputs that stand here: a row a force, each before those of its derivatives.
    pub(super) fn evaluate(&mut self, law: &PlacedLaw) -> &[f64] {
        let (bound, n) = (&law.bound, law.springs);
        let inputs = &self.inputs[..bound.inputs.len() * n];
        let outputs = &mut self.outputs[..bound.forces.len() * (1 + bound.inputs.len()) * n];
        bound.law.evaluate(n, inputs, outputs, &mut self.workspace);
        outputs
    }
}

/// Rows from the spring at `first` on; nothing of no rows.
fn from(rows: &[f64], first: usize) -> &[f64] {
    rows.get(first..).unwrap_or_default()
}

impl SpringState {
    /// Memory for the springs.
    pub(crate) fn new(springs: &Springs) -> Self {
        let motions = || vec![0.0; springs.bore.rows];
        SpringState {
            forces: vec![0.0; springs.forces()],
            planes: vec![PlaneState::default(); springs.planes.len()],
            laws: springs.laws.iter().map(LawState::new).collect(),
            spin: None,
            bore: motions(),
            bore_dot: motions(),
            bore_force: motions(),
            memory: LawMemory::new(springs),
            rates: springs.needs_rates(),
            monitor: ValidityMonitor::new(&springs.measures),
        }
    }

    /// Computes everything but the tangent from the motion.
    pub(crate) fn update(&mut self, springs: &Springs, motion: Motion) {
        self.spin = motion.spin.map(Spin::new);
        for (plane, own) in springs.planes.iter().zip(&mut self.planes) {
            let [x, y] = &plane.eccentricity;
            own.position = [motion.theta, along(x, motion.eta), along(y, motion.eta)];
            own.velocity = [motion.theta_dot, along(x, motion.eta_dot), along(y, motion.eta_dot)];
        }
        multiply(&springs.bore, motion.support, &mut self.bore);
        if self.rates {
            multiply(&springs.bore, motion.support_dot, &mut self.bore_dot);
        }
        for (law, own) in springs.laws.iter().zip(&mut self.laws) {
            for (row, rows) in law.bore_rows() {
                own.bore[row.clone()].copy_from_slice(&self.bore[rows.clone()]);
                if self.rates {
                    own.bore_dot[row].copy_from_slice(&self.bore_dot[rows]);
                }
            }
        }
        for law in 0..springs.laws.len() {
            self.act(springs, law);
        }
        for (law, own) in springs.laws.iter().zip(&self.laws) {
            for (row, rows) in law.bore_rows() {
                self.bore_force[rows].copy_from_slice(&own.bore_force[row]);
            }
        }
        self.test_forces(springs);
    }

    /// What a law does in its planes, from how they move.
    fn act(&mut self, springs: &Springs, place: usize) {
        let law = &springs.laws[place];
        let own = &mut self.laws[place];
        let planes = springs.planes[law.planes.clone()].iter();
        let planes = planes.zip(&mut self.planes[law.planes.clone()]);
        for (plane, moved) in planes {
            let (c, first) = (plane.clearance, plane.springs.start);
            moved.ring = moved.ring_with(self.spin, c);
            let state = LawState::state(law, plane, &moved.ring, &own.bore, &own.bore_dot);
            let inputs = &mut own.inputs[first..];
            (law.bound.kind.evaluate)(plane.springs.len(), &state, inputs);
        }
        self.evaluate(law, place);
        let own = &mut self.laws[place];
        let planes = springs.planes[law.planes.clone()].iter();
        let planes = planes.zip(&mut self.planes[law.planes.clone()]);
        for (plane, moved) in planes {
            let first = plane.springs.start;
            let state = LawState::state(law, plane, &moved.ring, &own.bore, &own.bore_dot);
            let bore_force = own.bore_force.get_mut(first..).unwrap_or_default();
            let (count, ring_force) = (plane.springs.len(), &mut moved.ring_force);
            (law.bound.kind.force)(count, &state, &own.forces[first..], ring_force, bore_force);
        }
    }

    /// Inputs and measures of a law if the journals had turned in their frame as `spin` says.
    pub(super) fn measure_with(
        &self,
        springs: &Springs,
        place: usize,
        spin: Spin,
        rows: &mut [f64],
    ) {
        let (law, own) = (&springs.laws[place], &self.laws[place]);
        let planes = springs.planes[law.planes.clone()].iter();
        for (plane, moved) in planes.zip(&self.planes[law.planes.clone()]) {
            let ring = moved.ring_with(Some(spin), plane.clearance);
            let state = LawState::state(law, plane, &ring, &own.bore, &own.bore_dot);
            let rows = &mut rows[plane.springs.start..];
            (law.bound.kind.evaluate)(plane.springs.len(), &state, rows);
        }
    }

    /// Evaluates a law at all its springs.
    fn evaluate(&mut self, law: &PlacedLaw, place: usize) {
        let (bound, n) = (&law.bound, law.springs);
        self.gather(law, place);
        let own = &mut self.laws[place];
        let mut rows = self.memory.evaluate(law).chunks_exact(n.max(1));
        for &force in &bound.forces {
            let values = rows.next().unwrap_or_default();
            own.forces[force * n..][..n].copy_from_slice(values);
            for &input in &bound.inputs {
                let row = force * bound.kind.inputs.len() + input;
                let values = rows.next().unwrap_or_default();
                own.slopes[row * n..][..n].copy_from_slice(values);
            }
        }
    }

    /// The inputs of a law, one row each.
    pub(super) fn gather(&mut self, law: &PlacedLaw, place: usize) {
        let (n, own) = (law.springs, &self.laws[place].inputs);
        for (row, &input) in law.bound.inputs.iter().enumerate() {
            self.memory.inputs[row * n..][..n].copy_from_slice(&own[input * n..][..n]);
        }
    }

    /// Fills the forces that are tested for convergence.
    fn test_forces(&mut self, springs: &Springs) {
        let mut rest = self.forces.as_mut_slice();
        for (law, own) in springs.laws.iter().zip(&self.laws) {
            for (is_moment, forces) in law.forces_of(own) {
                let (tested, others) = std::mem::take(&mut rest).split_at_mut(law.springs);
                tested.copy_from_slice(forces);
                rest = others;
                for plane in springs.planes[law.planes.clone()].iter().filter(|_| is_moment) {
                    tested[plane.springs.clone()].iter_mut().for_each(|m| *m /= plane.arm);
                }
            }
        }
    }

    /// Generalised forces on (θ, ε_x, ε_y) of a plane: N·m, N, N; ε as the machine's coordinates give it.
    pub(crate) fn plane_force(&self, plane: usize) -> [f64; 3] {
        let force = self.planes[plane].ring_force;
        self.spin.as_ref().map_or(force, |spin| spin.force(force))
    }

    /// Torque on the journal about its own centre in a plane (N·m): the generalised force on θ without the
    /// moment that the forces on the displaced centre have about the axis.
    pub(crate) fn plane_torque(&self, plane: usize) -> f64 {
        let own = &self.planes[plane];
        let ([_, x, y], [moment, along_x, along_y]) = (own.ring.position, own.ring_force);
        moment - (x * along_y - y * along_x)
    }

    /// Adds the generalised forces on θ, η and the support's coordinates.
    pub(crate) fn add_forces(
        &self,
        springs: &Springs,
        theta: &mut f64,
        eta: &mut [f64],
        support: &mut [f64],
    ) {
        for (place, plane) in springs.planes.iter().enumerate() {
            let force = self.plane_force(place);
            *theta += force[0];
            for (row, value) in plane.eccentricity.iter().zip(&force[1..]) {
                row.iter().for_each(|&(j, coefficient)| eta[j] += coefficient * value);
            }
        }
        add_product(support, &springs.bore_transposed, &self.bore_force);
    }

    /// A law that gave no number when the springs were last updated, and its bearing.
    pub(crate) fn without_value(&self, springs: &Springs) -> Option<(String, usize)> {
        springs.planes.iter().find_map(|plane| {
            let law = &springs.laws[plane.law];
            let mut forces = law.forces_of(&self.laws[plane.law]);
            let lost = |row: &[f64]| row[plane.springs.clone()].iter().any(|f| !f.is_finite());
            let name = || law.bound.law.name().to_owned();
            forces.any(|(_, row)| lost(row)).then(|| (name(), plane.bearing))
        })
    }

    /// The derivatives of the generalised forces of a plane, B + a1 P; see [`ContactTangent`].
    pub(crate) fn tangent(
        &self,
        springs: &Springs,
        place: usize,
        a1: f64,
        out: &mut ContactTangent,
    ) {
        let plane = &springs.planes[place];
        let (law, own) = (&springs.laws[plane.law], &self.laws[plane.law]);
        let ring = &self.planes[place].ring;
        let state = LawState::state(law, plane, ring, &own.bore, &own.bore_dot);
        let (count, first) = (plane.springs.len(), plane.springs.start);
        let (forces, slopes) = (from(&own.forces, first), from(&own.slopes, first));
        let mut tangent = |a1: f64| {
            (law.bound.kind.tangent)(count, &state, forces, slopes, a1, out);
            out.ring_ring
        };
        // B + a1 P is linear in a1. What `out` holds of the bore in the end is of a1 itself.
        let step = if a1 > 0.0 { a1 } else { 1.0 };
        let beyond = self.spin.as_ref().map(|spin| (spin, tangent(a1 + step)));
        let both = tangent(a1);
        if let Some((spin, more)) = beyond {
            let rate = [0, 1, 2].map(|i| [0, 1, 2].map(|j| (more[i][j] - both[i][j]) / step));
            out.ring_ring = spin.tangent(&both, &rate);
        }
    }
}

impl PlacedLaw {
    /// For every motion of the bore that the law needs its row in the law's own rows, and those of T_b.
    pub(super) fn bore_rows(
        &self,
    ) -> impl Iterator<Item = (std::ops::Range<usize>, std::ops::Range<usize>)> {
        let n = self.springs;
        let motions = self.motions.iter().enumerate();
        motions.filter_map(move |(motion, first)| {
            first.map(|first| (motion * n..(motion + 1) * n, first..first + n))
        })
    }

    /// The rows of the forces that the law gives, and whether they are moments.
    pub(super) fn forces_of<'s>(
        &'s self,
        own: &'s LawState,
    ) -> impl Iterator<Item = (bool, &'s [f64])> {
        let n = self.springs;
        self.bound.forces.iter().map(move |&force| {
            let is_moment = self.bound.kind.forces[force].unit != "N";
            (is_moment, &own.forces[force * n..][..n])
        })
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
