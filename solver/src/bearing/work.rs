//! The work of the springs along a step.
//!
//! Newmark's method counts ½ (Q_n + Q_{n+1})·Δh. What the force does on the way from h_n to h_{n+1} is ∫ Q dh; the
//! difference is energy that the step makes or destroys. Coordinates and rates go in a straight line from one
//! end of the step to the other; where a law acts at every spring and takes what its forces work on, as Q(h, ḣ)
//! does, what it takes goes so.

use serde::{Deserialize, Serialize};

use super::spin::Spin;
use super::state::{LawState, PlaneState, SpringState};
use super::{PlacedLaw, Springs};

/// Nodes in (0, 1) of Lobatto's rule of five points, exact for polynomials of degree 7, and their weights.
const NODES: [(f64, f64); 3] = [
    (0.172_673_164_646_011_42, 49.0 / 180.0),
    (0.5, 16.0 / 45.0),
    (0.827_326_835_353_988_6, 49.0 / 180.0),
];
/// Weight of each end.
const END: f64 = 0.05;

/// Work of springs along steps, in J.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct SpringWork {
    /// Work done against the forces that the springs would have at rest.
    pub(crate) stored: f64,
    /// Work done against the rest of the forces.
    pub(crate) dissipated: f64,
}

impl SpringWork {
    /// Adds one spring: its work along the way, and along the way at rest.
    fn add(&mut self, along: f64, at_rest: f64) {
        self.stored -= at_rest;
        self.dissipated -= along - at_rest;
    }

    /// Adds the work of another step.
    pub(crate) fn add_step(&mut self, other: &SpringWork) {
        self.stored += other.stored;
        self.dissipated += other.dissipated;
    }
}

/// Energy made and energy that flowed at a bearing (J).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Flow {
    /// Σ |½ (Q_n + Q_{n+1})·Δh − ∫ Q dh| over its springs and the steps.
    pub(crate) made: f64,
    /// Σ |Σ ∫ Q dh|: the work on its springs together, without sign. What springs hold against each other
    /// flows nowhere.
    pub(crate) flowed: f64,
}

impl Flow {
    /// Adds another step or part.
    pub(crate) fn add(&mut self, other: &Flow) {
        self.made += other.made;
        self.flowed += other.flowed;
    }

    /// Made over flowed; 0 where nothing was made.
    pub(crate) fn fraction(&self) -> f64 {
        if self.made == 0.0 { 0.0 } else { self.made / self.flowed }
    }
}

/// Where the springs were when the step began, and memory for the way.
pub(crate) struct WorkAlong {
    planes: Vec<PlaneState>,
    laws: Vec<LawState>,
    /// Generalised forces of the planes, as the machine's coordinates give them.
    plane_forces: Vec<[f64; 3]>,
    probe: SpringState,
    /// Of the forces of a law, spring by spring: ∫ along the way, and along the way at rest.
    along: Vec<f64>,
    at_rest: Vec<f64>,
    inputs: Vec<f64>,
    outputs: Vec<f64>,
    /// Work in every plane along the way, and along the way at rest.
    plane_work: Vec<[f64; 2]>,
    /// Energy made and the work on all springs of each bearing in the last step.
    bearings: Vec<Flow>,
}

impl WorkAlong {
    /// Starts at a state that was just evaluated.
    pub(crate) fn new(springs: &Springs, state: &SpringState) -> Self {
        let most = |rows: fn(&PlacedLaw) -> usize| {
            springs.laws.iter().map(|law| rows(law) * law.springs).max().unwrap_or(0)
        };
        let forces = most(|law| law.bound.forces.len());
        let mut work = WorkAlong {
            planes: state.planes.clone(),
            laws: state.laws.clone(),
            plane_forces: vec![[0.0; 3]; springs.planes.len()],
            probe: SpringState::new(springs),
            along: vec![0.0; forces],
            at_rest: vec![0.0; forces],
            inputs: vec![0.0; most(|law| law.bound.inputs.len())],
            outputs: vec![0.0; most(|law| law.bound.forces.len() * (1 + law.bound.inputs.len()))],
            plane_work: vec![[0.0; 2]; springs.planes.len()],
            bearings: vec![Flow::default(); springs.bearings],
        };
        work.start(state);
        work
    }

    /// Starts a step at a state that was just evaluated.
    pub(crate) fn start(&mut self, state: &SpringState) {
        self.planes.clone_from_slice(&state.planes);
        self.laws.iter_mut().zip(&state.laws).for_each(|(own, law)| own.copy_motion(law));
        for (place, force) in self.plane_forces.iter_mut().enumerate() {
            *force = state.plane_force(place);
        }
    }

    /// The work of the step that ends at a state just evaluated, where the next one starts.
    pub(crate) fn end(
        &mut self,
        springs: &Springs,
        state: &SpringState,
        spins: [Option<[f64; 2]>; 2],
    ) -> SpringWork {
        let mut work = SpringWork::default();
        self.bearings.fill(Flow::default());
        for (place, law) in springs.laws.iter().enumerate() {
            if law.bound.takes_what_it_works_on() {
                self.integrate_forces(law, place, state);
                self.add_springs(springs, place, state, &mut work);
            } else {
                self.integrate_power(springs, place, state, spins);
                self.add_planes(springs, place, state, &mut work);
            }
        }
        self.bearings.iter_mut().for_each(|own| own.flowed = own.flowed.abs());
        self.start(state);
        work
    }

    /// Of the last step, one a bearing.
    pub(crate) fn bearings(&self) -> &[Flow] {
        &self.bearings
    }

    /// ∫ of the forces of a law that takes what they work on.
    fn integrate_forces(&mut self, law: &PlacedLaw, place: usize, state: &SpringState) {
        let (bound, n) = (&law.bound, law.springs);
        let (start, end) = (&self.laws[place], &state.laws[place]);
        for (k, &force) in bound.forces.iter().enumerate() {
            let ends = start.forces[force * n..].iter().zip(&end.forces[force * n..]);
            let sums = self.along[k * n..][..n].iter_mut();
            sums.zip(ends).for_each(|(sum, (a, b))| *sum = END * (a + b));
        }
        self.at_rest.fill(0.0);
        let inputs = &mut self.inputs[..bound.inputs.len() * n];
        let outputs = &mut self.outputs[..bound.forces.len() * (1 + bound.inputs.len()) * n];
        let workspace = &mut self.probe.law_workspace;
        let mut add = |s: f64, weight: f64, at_rest: bool, sums: &mut [f64]| {
            for (row, &input) in bound.inputs.iter().enumerate() {
                let values = &mut inputs[row * n..][..n];
                if at_rest && bound.kind.inputs[input].rate {
                    values.fill(0.0);
                    continue;
                }
                let ends = start.inputs[input * n..].iter().zip(&end.inputs[input * n..]);
                values.iter_mut().zip(ends).for_each(|(v, (a, b))| *v = a + s * (b - a));
            }
            bound.law.evaluate(n, inputs, outputs, workspace);
            let forces = outputs.chunks_exact(n.max(1)).step_by(1 + bound.inputs.len());
            for (sums, forces) in sums.chunks_exact_mut(n.max(1)).zip(forces) {
                sums.iter_mut().zip(forces).for_each(|(sum, force)| *sum += weight * force);
            }
        };
        for (s, weight) in NODES {
            add(s, weight, false, &mut self.along);
        }
        if bound.takes_rates() {
            for (s, weight) in [(0.0, END), (1.0, END)].into_iter().chain(NODES) {
                add(s, weight, true, &mut self.at_rest);
            }
        } else {
            self.at_rest.copy_from_slice(&self.along);
        }
    }

    /// Adds what was integrated, spring by spring.
    fn add_springs(
        &mut self,
        springs: &Springs,
        place: usize,
        state: &SpringState,
        work: &mut SpringWork,
    ) {
        let law = &springs.laws[place];
        let (start, end, n) = (&self.laws[place], &state.laws[place], law.springs);
        for plane in &springs.planes[law.planes.clone()] {
            let mut flow = Flow::default();
            for (k, &force) in law.bound.forces.iter().enumerate() {
                let measure = law.bound.kind.forces[force].measure.unwrap_or_default();
                for j in plane.springs.clone() {
                    let moved = end.inputs[measure * n + j] - start.inputs[measure * n + j];
                    let ends = start.forces[force * n + j] + end.forces[force * n + j];
                    let [along, at_rest] =
                        [self.along[k * n + j], self.at_rest[k * n + j]].map(|sum| sum * moved);
                    flow.made += (0.5 * ends * moved - along).abs();
                    flow.flowed += along;
                    work.add(along, at_rest);
                }
            }
            self.bearings[plane.bearing].add(&flow);
        }
    }

    /// The work in every plane of any law: along the way, and along the way at rest.
    fn integrate_power(
        &mut self,
        springs: &Springs,
        place: usize,
        state: &SpringState,
        [before, after]: [Option<[f64; 2]>; 2],
    ) {
        let law = &springs.laws[place];
        self.plane_work[law.planes.clone()].fill([0.0; 2]);
        for (s, weight) in [(0.0, END), (1.0, END)].into_iter().chain(NODES) {
            for (kind, rate) in [1.0, 0.0].into_iter().enumerate() {
                let spin = before
                    .zip(after)
                    .map(|([a, speed], [b, _])| Spin::new([a + s * (b - a), rate * speed]));
                self.probe.spin = spin;
                let between = |a: f64, b: f64| a + s * (b - a);
                for number in law.planes.clone() {
                    let (start, end) = (&self.planes[number], &state.planes[number]);
                    let own = &mut self.probe.planes[number];
                    own.position = [0, 1, 2].map(|i| between(start.position[i], end.position[i]));
                    own.velocity =
                        [0, 1, 2].map(|i| rate * between(start.velocity[i], end.velocity[i]));
                }
                let (start, end) = (&self.laws[place], &state.laws[place]);
                let own = &mut self.probe.laws[place];
                for i in 0..own.bore.len() {
                    own.bore[i] = between(start.bore[i], end.bore[i]);
                    own.bore_dot[i] = rate * between(start.bore_dot[i], end.bore_dot[i]);
                }
                self.probe.act(springs, place);
                for number in law.planes.clone() {
                    let force = self.probe.plane_force(number);
                    let bore_force = &self.probe.laws[place].bore_force;
                    let power = self.power(springs, number, state, &force, bore_force);
                    self.plane_work[number][kind] += weight * power;
                }
            }
        }
    }

    /// Adds what was integrated, plane by plane.
    fn add_planes(
        &mut self,
        springs: &Springs,
        place: usize,
        state: &SpringState,
        work: &mut SpringWork,
    ) {
        for number in springs.laws[place].planes.clone() {
            let [along, at_rest] = self.plane_work[number];
            let (before, after) = (&self.laws[place].bore_force, &state.laws[place].bore_force);
            let before = self.power(springs, number, state, &self.plane_forces[number], before);
            let after = self.power(springs, number, state, &state.plane_force(number), after);
            let own = &mut self.bearings[springs.planes[number].bearing];
            own.made += (0.5 * (before + after) - along).abs();
            own.flowed += along;
            work.add(along, at_rest);
        }
    }

    /// Work of constant forces in a plane over the step.
    fn power(
        &self,
        springs: &Springs,
        number: usize,
        state: &SpringState,
        force: &[f64; 3],
        bore_force: &[f64],
    ) -> f64 {
        let plane = &springs.planes[number];
        let (start, end) = (&self.planes[number].position, &state.planes[number].position);
        let on_ring = force.iter().zip(start.iter().zip(end));
        let on_ring: f64 = on_ring.map(|(force, (a, b))| force * (b - a)).sum();
        let n = springs.laws[plane.law].springs;
        let (start, end) = (&self.laws[plane.law].bore, &state.laws[plane.law].bore);
        let moved = |i: usize| bore_force[i] * (end[i] - start[i]);
        let motions = (0..start.len()).step_by(n.max(1));
        let on_bore = motions.flat_map(|first| plane.springs.clone().map(move |j| first + j));
        on_ring + on_bore.map(moved).sum::<f64>()
    }
}
