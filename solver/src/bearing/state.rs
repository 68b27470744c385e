//! The springs at one instant: how they move, what their laws give, generalised forces and their derivatives.

use whirl_specs::{ContactState, ContactTangent, Ring};

use super::apart::Seen;
use super::bores::Bores;
use super::films::Films;
use super::hold::LawStates;
use super::law_memory::LawMemory;
use super::mark::Mark;
use super::mirrors::BlockMemory;
use super::placed_law::PlacedLaw;
use super::plane::Plane;
use super::spin::Spin;
use super::springs::Springs;
use super::states::Remembering;
use super::valid::ValidityMonitor;

/// All springs at one instant. Allocated once, filled at will.
pub struct SpringState {
    /// Forces tested for convergence (N): law after law, force after force, spring after spring; moments over
    /// the journal's radius.
    pub(crate) forces: Vec<f64>,
    pub(super) planes: Vec<PlaneState>,
    pub(super) laws: Vec<LawState>,
    pub(super) bores: Vec<BoreState>,
    pub(super) memory: LawMemory,
    pub(super) rates: bool,
    /// Of every force of every plane the largest and the sum of all, without sign; see [`SpringState::size_forces`].
    pub(super) sizes: Vec<(f64, f64)>,
    /// What is known of the states of the laws, and memory for finding them.
    pub(super) remembering: Remembering,
    /// The films.
    pub(super) films: Films,
    /// Where the measures are moved from.
    pub(super) mark: Mark,
    /// Whether the laws are used where they may be believed.
    pub(super) monitor: ValidityMonitor,
}

/// Motions of the bores of a body (T_b times its coordinates), their rates, and the generalised forces on them.
pub(super) struct BoreState {
    pub(super) motion: Vec<f64>,
    pub(super) rate: Vec<f64>,
    pub(super) force: Vec<f64>,
    memory: BlockMemory,
}

impl BoreState {
    fn new(bores: &Bores) -> Self {
        let motions = || vec![0.0; bores.rows.rows];
        let memory = bores.memory();
        BoreState { motion: motions(), rate: motions(), force: motions(), memory }
    }
}

/// One plane.
#[derive(Clone)]
pub(super) struct PlaneState {
    /// [`Plane::rows`] as they are at this instant.
    pub(crate) rows: [Vec<(usize, f64)>; 3],
    /// Angle of the journal's frame against the bore's, ε_x and ε_y without run-out as the machine's coordinates give
    /// them, and their rates.
    pub(super) position: [f64; 3],
    pub(super) velocity: [f64; 3],
    /// ε0 in the plane (m), where it is not left out.
    run_out: [f64; 2],
    /// The turn of the journal in its frame, where it spins in it.
    pub(super) spin: Option<Spin>,
    /// How the axes of both bodies stand apart, where they do.
    pub(super) apart: Seen,
    /// θ, ε_x and ε_y in the frame that turns with the journal.
    pub(super) ring: Ring,
    /// Generalised forces on (θ, ε_x, ε_y) there: N·m, N, N.
    pub(super) ring_force: [f64; 3],
}

impl PlaneState {
    fn new(plane: &Plane) -> Self {
        PlaneState {
            rows: plane.rows.clone(),
            position: [0.0; 3],
            velocity: [0.0; 3],
            run_out: plane.run_out,
            spin: None,
            apart: Seen::default(),
            ring: Ring::default(),
            ring_force: [0.0; 3],
        }
    }

    /// Takes the motion of the machine at time `t` (s).
    fn take(&mut self, plane: &Plane, t: f64, q: &[f64], v: &[f64]) {
        self.spin = plane.spin.map(|speed| Spin::new([speed * t, speed]));
        self.position = plane.rows.each_ref().map(|row| along(row, q));
        if let Some(apart) = &plane.apart {
            self.apart = apart.seen(q, v);
            for axis in 0..2 {
                self.position[1 + axis] += self.apart.value[axis];
                if let (Some(_), Some(last)) = (apart.theta, self.rows[1 + axis].last_mut()) {
                    last.1 = self.apart.slope[axis];
                }
            }
        }
        self.velocity = self.rows.each_ref().map(|row| along(row, v));
    }

    /// The ring of a plane in the frame that turns with the journal.
    fn ring_with(&self, plane: &Plane, spin: Option<Spin>) -> Ring {
        let ([_, x, y], [_, x_dot, y_dot], c) = (self.position, self.velocity, plane.clearance);
        let mut ring = match spin {
            Some(spin) => spin.ring([x, y], [x_dot, y_dot], c),
            None => Ring { position: self.position, velocity: self.velocity, c },
        };
        ring.position[0] += plane.flank.map_or(0.0, |own| own.first_angle());
        ring.position[1] += self.run_out[0];
        ring.position[2] += self.run_out[1];
        ring
    }

    /// How far the centre of the journal stands from the axis of its own body, or from that of the bore (m).
    pub(super) fn distance_from(&self, own_axis: bool) -> f64 {
        let ([_, x, y], [along_x, along_y]) = (self.ring.position, self.apart.value);
        if own_axis { (x - along_x).hypot(y - along_y) } else { x.hypot(y) }
    }
}

/// A law at all its springs; rows as in [`whirl_specs::Contact`].
pub(super) struct LawState {
    pub(super) bore: Vec<f64>,
    pub(super) bore_dot: Vec<f64>,
    /// Inputs and further measures.
    pub(super) inputs: Vec<f64>,
    pub(super) forces: Vec<f64>,
    pub(super) slopes: Vec<f64>,
    pub(super) bore_force: Vec<f64>,
    /// The states, their rates, and the rate at which each relaxes by itself (1/s): a row of springs a state.
    pub(super) states: Vec<f64>,
    pub(super) rates: Vec<f64>,
    pub(super) relaxes: Vec<f64>,
}

impl LawState {
    fn new(law: &PlacedLaw) -> Self {
        let (kind, row) = (law.bound.kind, |rows: usize| vec![0.0; rows * law.springs]);
        LawState {
            bore: row(law.motions.len()),
            bore_dot: row(law.motions.len()),
            inputs: row(kind.rows),
            forces: row(kind.forces.len()),
            slopes: row(kind.forces.len() * kind.inputs.len()),
            bore_force: row(law.motions.len()),
            states: row(law.bound.states.len()),
            rates: row(law.bound.states.len()),
            relaxes: row(law.bound.states.len()),
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

/// Rows from the spring at `first` on; nothing of no rows.
fn from(rows: &[f64], first: usize) -> &[f64] {
    rows.get(first..).unwrap_or_default()
}

impl SpringState {
    /// Leaves out the run-out of the bearings of some planes.
    pub(crate) fn run_true(&mut self, springs: &Springs, bearing: impl Fn(usize) -> bool) {
        for (own, plane) in self.planes.iter_mut().zip(&springs.planes) {
            if bearing(plane.bearing) {
                own.run_out = [0.0; 2];
            }
        }
    }

    /// Memory for the springs.
    pub(crate) fn new(springs: &Springs) -> Self {
        let sizes = springs.planes.iter().map(|own| springs.laws[own.law].bound.forces.len());
        SpringState {
            forces: vec![0.0; springs.forces()],
            planes: springs.planes.iter().map(PlaneState::new).collect(),
            laws: springs.laws.iter().map(LawState::new).collect(),
            bores: springs.bores.iter().map(BoreState::new).collect(),
            memory: LawMemory::new(springs),
            rates: springs.needs_rates(),
            sizes: Vec::with_capacity(sizes.sum()),
            remembering: Remembering::new(springs),
            films: Films::new(springs),
            mark: Mark::new(springs),
            monitor: ValidityMonitor::new(&springs.measures),
        }
    }

    /// Computes everything but the tangent from the machine's motion at time `t` (s), and what is known of the laws' states.
    pub(crate) fn update(
        &mut self,
        springs: &Springs,
        t: f64,
        [q, v]: [&[f64]; 2],
        laws: &LawStates,
    ) {
        self.remembering.given.copy_from(laws);
        self.films.take(springs, laws);
        for (plane, own) in springs.planes.iter().zip(&mut self.planes) {
            own.take(plane, t, q, v);
        }
        for (bores, own) in springs.bores.iter().zip(&mut self.bores) {
            match &bores.offset {
                Some(offset) => own.motion.copy_from_slice(offset),
                None => own.motion.fill(0.0),
            }
            bores.add_motion(&q[bores.place.clone()], &mut own.motion, &mut own.memory);
            bores.add_given(q, &mut own.motion);
            if self.rates {
                own.rate.fill(0.0);
                bores.add_motion(&v[bores.place.clone()], &mut own.rate, &mut own.memory);
                bores.add_given(v, &mut own.rate);
            }
        }
        self.respond(springs);
    }

    /// What the laws do where their planes and bores stand.
    pub(super) fn respond(&mut self, springs: &Springs) {
        for (law, own) in springs.laws.iter().zip(&mut self.laws) {
            let bores = &self.bores[law.bores];
            for (row, rows) in law.bore_rows() {
                own.bore[row.clone()].copy_from_slice(&bores.motion[rows.clone()]);
                if self.rates {
                    own.bore_dot[row].copy_from_slice(&bores.rate[rows]);
                }
            }
        }
        for law in 0..springs.laws.len() {
            self.act(springs, law);
        }
        for (law, own) in springs.laws.iter().zip(&self.laws) {
            let bores = &mut self.bores[law.bores];
            for (row, rows) in law.bore_rows() {
                bores.force[rows].copy_from_slice(&own.bore_force[row]);
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
            let first = plane.springs.start;
            moved.ring = moved.ring_with(plane, moved.spin);
            let state = LawState::state(law, plane, &moved.ring, &own.bore, &own.bore_dot);
            let inputs = &mut own.inputs[first..];
            (law.bound.kind.evaluate)(plane.springs.len(), &state, inputs);
        }
        self.evaluate(law, place);
        self.push(springs, place);
    }

    /// What the forces of a law do to its planes and bores.
    pub(super) fn push(&mut self, springs: &Springs, place: usize) {
        let law = &springs.laws[place];
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

    /// Inputs and measures of a law if the journals had turned in their frames as `spins` say, one a plane.
    pub(super) fn measure_with(
        &self,
        springs: &Springs,
        place: usize,
        spins: &[Option<Spin>],
        rows: &mut [f64],
    ) {
        let (law, own) = (&springs.laws[place], &self.laws[place]);
        for number in law.planes.clone() {
            let plane = &springs.planes[number];
            let ring = self.planes[number].ring_with(plane, spins[number]);
            let state = LawState::state(law, plane, &ring, &own.bore, &own.bore_dot);
            let rows = &mut rows[plane.springs.start..];
            (law.bound.kind.evaluate)(plane.springs.len(), &state, rows);
        }
    }

    /// Evaluates a law at all its springs.
    fn evaluate(&mut self, law: &PlacedLaw, place: usize) {
        if !law.bound.states.is_empty() {
            return self.evaluate_remembering(law, place);
        }
        if let Some(journal) = law.bound.law.film() {
            return self.evaluate_films(law, place, journal);
        }
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

    /// The inputs of a law, one row each, then its states.
    pub(super) fn gather(&mut self, law: &PlacedLaw, place: usize) {
        let (n, LawState { inputs: own, states, .. }) = (law.springs, &self.laws[place]);
        self.memory.inputs[law.bound.inputs.len() * n..][..states.len()].copy_from_slice(states);
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
        let own = &self.planes[plane];
        own.spin.as_ref().map_or(own.ring_force, |spin| spin.force(own.ring_force))
    }

    /// Adds the generalised forces on q.
    pub(crate) fn add_forces(&mut self, springs: &Springs, out: &mut [f64]) {
        for (place, own) in self.planes.iter().enumerate() {
            for (row, value) in own.rows.iter().zip(&self.plane_force(place)) {
                row.iter().for_each(|&(j, coefficient)| out[j] += coefficient * value);
            }
        }
        self.add_bore_forces(springs, out);
    }

    /// Adds those on bores alone.
    pub(crate) fn add_bore_forces(&mut self, springs: &Springs, out: &mut [f64]) {
        for (bores, own) in springs.bores.iter().zip(&mut self.bores) {
            bores.add_force(&own.force, &mut out[bores.place.clone()], &mut own.memory);
            bores.given.iter().for_each(|&(row, place, part)| out[place] += part * own.force[row]);
        }
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

    /// The first plane of springs whose law gave forces without finite derivatives when the springs were last updated.
    pub(crate) fn without_slope<'s>(&self, springs: &'s Springs) -> Option<&'s Plane> {
        springs.planes.iter().find(|plane| {
            let own = &self.laws[plane.law];
            let count = springs.laws[plane.law].springs;
            let mut rows = own.slopes.chunks_exact(count.max(1));
            rows.any(|row| row[plane.springs.clone()].iter().any(|slope| !slope.is_finite()))
        })
    }

    /// [`Plane::rows`] as they are at this instant.
    pub(crate) fn rows(&self, plane: usize) -> &[Vec<(usize, f64)>; 3] {
        &self.planes[plane].rows
    }

    /// The derivatives of the generalised forces of a plane, B + a1 P; see [`ContactTangent`]. Where the axes are
    /// apart `turned` gets what rows that change add to the derivatives by θ of the journal.
    pub(crate) fn tangent(
        &self,
        springs: &Springs,
        place: usize,
        a1: f64,
        out: &mut ContactTangent,
        turned: &mut TurnedRows,
    ) {
        let plane = &springs.planes[place];
        let (law, own) = (&springs.laws[plane.law], &self.laws[plane.law]);
        let moved = &self.planes[place];
        let state = LawState::state(law, plane, &moved.ring, &own.bore, &own.bore_dot);
        let (count, first) = (plane.springs.len(), plane.springs.start);
        let (forces, slopes) = (from(&own.forces, first), from(&own.slopes, first));
        let tangent = |a1: f64, out: &mut ContactTangent| match self.film_slopes(plane.law) {
            None => (law.bound.kind.tangent)(count, &state, forces, slopes, a1, out),
            Some(film) => film.tangent(&law.bound, &state, [forces, slopes], a1, out),
        };
        // B + a1 P is linear in a1. What `out` holds of the bore in the end is of a1 itself.
        let step = if a1 > 0.0 { a1 } else { 1.0 };
        let turns = plane.apart.is_some_and(|apart| apart.theta.is_some());
        let beyond = (moved.spin.is_some() || turns).then(|| {
            tangent(a1 + step, out);
            (out.ring_ring, if turns { out.bore_ring.clone() } else { Vec::new() })
        });
        tangent(a1, out);
        let Some((more, more_on_bore)) = beyond else { return };
        let both = out.ring_ring;
        let rate = [0, 1, 2].map(|i| [0, 1, 2].map(|j| (more[i][j] - both[i][j]) / step));
        if let Some(spin) = &moved.spin {
            out.ring_ring = spin.tangent(&both, &rate);
        }
        if turns {
            turned.of(moved, &rate, &more_on_bore, &out.bore_ring, (count, step));
        }
    }
}

/// Where the axes of journal and bore are apart, ε depends on θ of the journal by more than a constant row. This is what
/// that adds to the derivatives by θ of the forces on the ring (θ, ε_x, ε_y), on θ through the row itself, and on the
/// motions of the bore (a row of springs a motion).
#[derive(Default)]
pub(crate) struct TurnedRows {
    pub(crate) ring: [f64; 3],
    pub(crate) row: f64,
    pub(crate) bore: Vec<f64>,
}

impl TurnedRows {
    fn of(
        &mut self,
        moved: &PlaneState,
        rate: &[[f64; 3]; 3],
        more: &[f64],
        bore: &[f64],
        (count, step): (usize, f64),
    ) {
        let ([x, y], [_, along_x, along_y]) = (moved.apart.rate_slope, moved.ring_force);
        self.ring = rate.map(|row| row[1] * x + row[2] * y);
        let [curved_x, curved_y] = moved.apart.curvature;
        self.row = along_x * curved_x + along_y * curved_y;
        self.bore.clear();
        let n = count.max(1);
        let by_ring = more.chunks_exact(3 * n).zip(bore.chunks_exact(3 * n));
        self.bore.extend(by_ring.flat_map(|(more, own)| {
            let rate = move |i: usize, j: usize| (more[i * n + j] - own[i * n + j]) / step;
            (0..n).map(move |j| rate(1, j) * x + rate(2, j) * y)
        }));
    }
}

impl PlacedLaw {
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
