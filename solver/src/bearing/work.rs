//! The work of the springs along a step.
//!
//! Newmark's method counts ½ (Q_n + Q_{n+1})·Δh. What the force does on the way from h_n to h_{n+1} is ∫ Q dh; the
//! difference is energy that the step makes or destroys. Coordinates and rates go in a straight line from one
//! end of the step to the other.

use serde::{Deserialize, Serialize};

use super::contact::{ContactsState, PlaneState};
use super::spin::Spin;
use super::state::SpringState;
use super::{Input, Springs};

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
    h: Vec<f64>,
    h_dot: Vec<f64>,
    forces: Vec<f64>,
    /// Work of every spring along the way, and along the way at rest.
    along: Vec<f64>,
    at_rest: Vec<f64>,
    inputs: Vec<f64>,
    outputs: Vec<f64>,
    workspace: Vec<f64>,
    planes: Vec<PlaneStart>,
    probe: ContactsState,
    plane_work: Vec<[f64; 2]>,
    /// Energy made and the work on all springs of each bearing in the last step.
    bearings: Vec<Flow>,
}

/// One plane of another law when the step began.
struct PlaneStart {
    position: [f64; 3],
    velocity: [f64; 3],
    force: [f64; 3],
    bore: Vec<f64>,
    bore_dot: Vec<f64>,
    bore_force: Vec<f64>,
}

impl WorkAlong {
    /// Starts at a state that was just evaluated.
    pub(crate) fn new(springs: &Springs, state: &SpringState) -> Self {
        let probe = ContactsState::new(&springs.contacts);
        let plane = |plane: &PlaneState| PlaneStart {
            position: [0.0; 3],
            velocity: [0.0; 3],
            force: [0.0; 3],
            bore: vec![0.0; plane.bore.len()],
            bore_dot: vec![0.0; plane.bore_dot.len()],
            bore_force: vec![0.0; plane.bore_force.len()],
        };
        let n = springs.len();
        let mut work = WorkAlong {
            h: vec![0.0; n],
            h_dot: vec![0.0; n],
            forces: vec![0.0; n],
            along: vec![0.0; n],
            at_rest: vec![0.0; n],
            inputs: state.law_inputs.clone(),
            outputs: state.law_outputs.clone(),
            workspace: state.law_workspace.clone(),
            planes: probe.planes.iter().map(plane).collect(),
            plane_work: vec![[0.0; 2]; probe.planes.len()],
            probe,
            bearings: vec![Flow::default(); springs.bearings],
        };
        work.start(springs, state);
        work
    }

    /// Starts a step at a state that was just evaluated.
    pub(crate) fn start(&mut self, springs: &Springs, state: &SpringState) {
        self.h.copy_from_slice(&state.h);
        self.h_dot.copy_from_slice(&state.h_dot);
        self.forces.copy_from_slice(&state.forces[..springs.len()]);
        for (place, start) in self.planes.iter_mut().enumerate() {
            let own = &state.contacts.planes[place];
            (start.position, start.velocity) = (own.position, own.velocity);
            start.force = state.contacts.plane_force(place);
            start.bore.copy_from_slice(&own.bore);
            start.bore_dot.copy_from_slice(&own.bore_dot);
            start.bore_force.copy_from_slice(&own.bore_force);
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
        self.along_springs(springs, state);
        for plane in &springs.planes {
            let mut flow = Flow::default();
            for j in plane.springs.clone() {
                let moved = state.h[j] - self.h[j];
                let trapezoid = 0.5 * (self.forces[j] + state.forces[j]) * moved;
                flow.made += (trapezoid - self.along[j]).abs();
                flow.flowed += self.along[j];
                work.add(self.along[j], self.at_rest[j]);
            }
            self.bearings[plane.bearing].add(&flow);
        }
        if !self.planes.is_empty() {
            self.along_planes(springs, state, spins);
            for (place, [along, at_rest]) in self.plane_work.iter().enumerate() {
                let (start, end) = (&self.planes[place], &state.contacts.planes[place]);
                let force = state.contacts.plane_force(place);
                let before = power(start, end, &start.force, &start.bore_force);
                let after = power(start, end, &force, &end.bore_force);
                let own = &mut self.bearings[springs.contacts.planes[place].bearing];
                own.made += (0.5 * (before + after) - along).abs();
                own.flowed += along;
                work.add(*along, *at_rest);
            }
        }
        self.bearings.iter_mut().for_each(|own| own.flowed = own.flowed.abs());
        self.start(springs, state);
        work
    }

    /// Of the last step, one a bearing.
    pub(crate) fn bearings(&self) -> &[Flow] {
        &self.bearings
    }

    /// ∫ Q dh of the springs with laws Q(h, ḣ).
    fn along_springs(&mut self, springs: &Springs, state: &SpringState) {
        for (law, range) in &springs.laws {
            let n = range.len();
            let rates = law.uses(Input::ClearanceRate);
            let ends = range.clone().map(|j| END * (self.forces[j] + state.forces[j]));
            self.along[range.clone()].iter_mut().zip(ends).for_each(|(sum, end)| *sum = end);
            self.at_rest[range.clone()].fill(0.0);
            let mut add = |s: f64, weight: f64, at_rest: bool, sums: &mut [f64]| {
                for (row, input) in law.inputs.iter().enumerate() {
                    let values = &mut self.inputs[row * n..(row + 1) * n];
                    let between = |start: &[f64], end: &[f64], values: &mut [f64]| {
                        let pairs = start[range.clone()].iter().zip(&end[range.clone()]);
                        values.iter_mut().zip(pairs).for_each(|(v, (a, b))| *v = a + s * (b - a));
                    };
                    match input {
                        Input::Clearance => between(&self.h, &state.h, values),
                        Input::ClearanceRate if at_rest => values.fill(0.0),
                        Input::ClearanceRate => between(&self.h_dot, &state.h_dot, values),
                    }
                }
                let inputs = &self.inputs[..law.inputs.len() * n];
                let outputs = &mut self.outputs[..law.output_rows * n];
                law.law.evaluate(n, inputs, outputs, &mut self.workspace);
                let forces = &outputs[law.q_row * n..(law.q_row + 1) * n];
                sums.iter_mut().zip(forces).for_each(|(sum, force)| *sum += weight * force);
            };
            for (s, weight) in NODES {
                add(s, weight, false, &mut self.along[range.clone()]);
            }
            if rates {
                for (s, weight) in [(0.0, END), (1.0, END)].into_iter().chain(NODES) {
                    add(s, weight, true, &mut self.at_rest[range.clone()]);
                }
            }
            for j in range.clone() {
                let moved = state.h[j] - self.h[j];
                self.along[j] *= moved;
                self.at_rest[j] = if rates { self.at_rest[j] * moved } else { self.along[j] };
            }
        }
    }

    /// The work of every plane of other laws: along the way, and along the way at rest.
    fn along_planes(
        &mut self,
        springs: &Springs,
        state: &SpringState,
        [before, after]: [Option<[f64; 2]>; 2],
    ) {
        let contacts = &springs.contacts;
        self.plane_work.fill([0.0; 2]);
        for (s, weight) in [(0.0, END), (1.0, END)].into_iter().chain(NODES) {
            for (kind, rate) in [1.0, 0.0].into_iter().enumerate() {
                let spin = before
                    .zip(after)
                    .map(|([a, speed], [b, _])| Spin::new([a + s * (b - a), rate * speed]));
                self.probe.spin = spin;
                for (place, start) in self.planes.iter().enumerate() {
                    let (own, end) = (&mut self.probe.planes[place], &state.contacts.planes[place]);
                    let between = |a: f64, b: f64| a + s * (b - a);
                    own.position = [0, 1, 2].map(|i| between(start.position[i], end.position[i]));
                    own.velocity =
                        [0, 1, 2].map(|i| rate * between(start.velocity[i], end.velocity[i]));
                    for i in 0..start.bore.len() {
                        own.bore[i] = between(start.bore[i], end.bore[i]);
                        own.bore_dot[i] = rate * between(start.bore_dot[i], end.bore_dot[i]);
                    }
                }
                for (law, planes) in &contacts.laws {
                    self.probe.act(contacts, law, planes.clone());
                }
                for (place, work) in self.plane_work.iter_mut().enumerate() {
                    let (start, end) = (&self.planes[place], &state.contacts.planes[place]);
                    let force = self.probe.plane_force(place);
                    let bore_force = &self.probe.planes[place].bore_force;
                    work[kind] += weight * power(start, end, &force, bore_force);
                }
            }
        }
    }
}

/// Work of constant forces over a step.
fn power(start: &PlaneStart, end: &PlaneState, force: &[f64; 3], bore_force: &[f64]) -> f64 {
    let ring = force.iter().zip(start.position.iter().zip(&end.position));
    let bore = bore_force.iter().zip(start.bore.iter().zip(&end.bore));
    ring.chain(bore).map(|(force, (a, b))| force * (b - a)).sum()
}
