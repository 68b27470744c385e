//! The work of the springs along a step.
//!
//! Of a force Q that works on h Newmark's method counts ½ (Q_n + Q_{n+1})·Δh. What it does on the way is ∫ Q dh; the
//! difference is energy that the step makes or destroys. What a law takes, and the measures on which its forces
//! work, go in a straight line from one end of the step to the other.

use serde::{Deserialize, Serialize};
use whirl_specs::registers::{Register, Registers, Task};

use super::law_memory::LawMemory;
use super::placed_law::PlacedLaw;
use super::spin::Spin;
use super::springs::Springs;
use super::state::{LawState, SpringState};
use crate::film::Shapes;
use crate::linalg::{sum_of, sum_over};

/// Nodes in (0, 1) of Lobatto's rule of five points, exact for polynomials of degree 7, and their weights.
const NODES: [(f64, f64); 3] = [
    (0.172_673_164_646_011_42, 49.0 / 180.0),
    (0.5, 16.0 / 45.0),
    (0.827_326_835_353_988_6, 49.0 / 180.0),
];
/// Weight of each end.
const END: f64 = 0.05;

/// A place along the step, in parts of it, its weight, and whether rates are left out there.
type Node = (f64, f64, bool);

/// Along the way, then along the way at rest, where its ends are not known either.
const ALL: [Node; 8] = [
    (NODES[0].0, NODES[0].1, false),
    (NODES[1].0, NODES[1].1, false),
    (NODES[2].0, NODES[2].1, false),
    (0.0, END, true),
    (1.0, END, true),
    (NODES[0].0, NODES[0].1, true),
    (NODES[1].0, NODES[1].1, true),
    (NODES[2].0, NODES[2].1, true),
];

/// Springs, times nodes, that are evaluated together: laws of few springs take as long for some more.
const TOGETHER: usize = 64;

/// Nodes that are evaluated together of a law at so many springs.
fn together(springs: usize) -> usize {
    (TOGETHER / springs.max(1)).clamp(1, ALL.len())
}

/// Work of springs along steps, in J.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct SpringWork {
    /// Work done against the forces that the springs would have at rest.
    pub(crate) stored: f64,
    /// Work done against the rest of the forces.
    pub(crate) dissipated: f64,
}

impl SpringWork {
    /// Adds a force of a spring: its work along the way, and along the way at rest.
    fn add(&mut self, along: f64, at_rest: f64) {
        self.stored -= at_rest;
        self.dissipated -= along - at_rest;
    }

    /// Takes for stored what was taken for dissipated.
    fn store(&mut self, energy: f64) {
        self.stored += energy;
        self.dissipated -= energy;
    }

    /// Adds the work of another step.
    pub(crate) fn add_step(&mut self, other: &SpringWork) {
        self.stored += other.stored;
        self.dissipated += other.dissipated;
    }
}

/// Motions at a bearing that are judged: those that its law takes, such as clearances and displacements, by themselves, then all
/// together, with the slips and turns of which it takes no more than rates. The power of friction hides no impact.
pub(crate) const MOTIONS: usize = 2;

/// Energy made and energy that flowed at a bearing, in some of its motions (J).
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Flow {
    /// Σ |½ (Q_n + Q_{n+1})·Δh − ∫ Q dh| over its springs and the steps.
    pub(crate) made: f64,
    /// Σ |Σ ∫ Q dh|: the work on its springs together, without sign. What springs hold against each other
    /// flows nowhere.
    pub(crate) flowed: f64,
    /// Σ |Δh| over its springs that push at either end of a step (m, or rad of a moment): a force that is solved to a tolerance
    /// leaves energy unknown by as much times that.
    pub(crate) moved: f64,
}

impl Flow {
    /// Adds another step or part.
    pub(crate) fn add(&mut self, other: &Flow) {
        self.made += other.made;
        self.flowed += other.flowed;
        self.moved += other.moved;
    }

    /// Made over flowed; 0 where nothing was made.
    pub(crate) fn fraction(&self) -> f64 {
        if self.made == 0.0 { 0.0 } else { self.made / self.flowed }
    }
}

/// Where the springs were when the step began, and memory for the way.
pub(crate) struct WorkAlong {
    starts: Vec<LawStart>,
    /// Of the forces of a law, spring by spring: ∫ along the way, and along the way at rest.
    along: Vec<f64>,
    at_rest: Vec<f64>,
    memory: LawMemory,
    /// The turn of each plane's journal when the step began, where it spins in its frame, and the measures at its end
    /// if they had not turned since: what drives a spin does its work on no coordinate.
    spins: Vec<Option<Spin>>,
    without_spin: Vec<f64>,
    /// By the springs of a plane: energy made in motions that its law takes, and in the others (J), and |Δh| of a force.
    by_spring: [Vec<f64>; 3],
    /// Energy made and the work on all springs in the step that was measured last; every bearing has its [`MOTIONS`].
    flows: Vec<Flow>,
}

/// Inputs, measures and forces of a law when the step began; rows as in [`whirl_specs::Contact`].
struct LawStart {
    inputs: Vec<f64>,
    forces: Vec<f64>,
    states: Vec<f64>,
    /// Shapes in which a bore gives way under a film, and the forces on them.
    shapes: [Vec<f64>; 2],
}

/// What a force of the springs of a plane does along a step, spring by spring.
struct Ways<'a> {
    /// The measures on which it works, and the forces, at both ends.
    measures: [&'a [f64]; 2],
    ends: [&'a [f64]; 2],
    /// Its means along the way, and along the way at rest.
    along: &'a [f64],
    at_rest: &'a [f64],
    /// Takes the energy that the step makes, by spring.
    made: &'a mut [f64],
    /// Room for |Δh| of springs that push.
    moved: &'a mut [f64],
}

impl Task for Ways<'_> {
    /// Work along the way, along the way at rest (J), and Σ |Δh| of springs that push.
    type Output = [f64; 3];

    #[inline(always)]
    fn run<L: Register>(self) -> [f64; 3] {
        // Of one length, so that no bound is checked on the way.
        let n = self.made.len();
        let [from, to] = self.measures.map(|own| &own[..n]);
        let [before, after] = self.ends.map(|own| &own[..n]);
        let [along, at_rest] = [self.along, self.at_rest].map(|own| &own[..n]);
        let (made, moved) = (&mut self.made[..n], &mut self.moved[..n]);
        for j in 0..n {
            let way = to[j] - from[j];
            let both = before[j] + after[j];
            made[j] += 0.5 * both * way - along[j] * way;
            moved[j] = if both == 0.0 { 0.0 } else { way.abs() };
        }
        [
            sum_of(n, |j| along[j] * (to[j] - from[j])),
            sum_of(n, |j| at_rest[j] * (to[j] - from[j])),
            sum_of(n, |j| moved[j]),
        ]
    }
}

/// How a bore stands in the shapes in which it gives way under a film, and the forces on them.
fn shapes_of<'s>(placed: &PlacedLaw, law: &'s LawState) -> [&'s [f64]; 2] {
    let count = placed.shapes.as_ref().map_or(0, Shapes::count);
    [&law.bore, &law.bore_force].map(|own| &own[own.len() - count..])
}

impl WorkAlong {
    /// Starts at a state that was just evaluated.
    pub(crate) fn new(springs: &Springs, state: &SpringState) -> Self {
        let forces = springs.most(|law| law.bound.forces.len());
        let start = |(placed, law): (&PlacedLaw, &LawState)| LawStart {
            inputs: law.inputs.clone(),
            forces: law.forces.clone(),
            states: law.states.clone(),
            shapes: shapes_of(placed, law).map(<[f64]>::to_vec),
        };
        WorkAlong {
            starts: springs.laws.iter().zip(&state.laws).map(start).collect(),
            along: vec![0.0; forces],
            at_rest: vec![0.0; forces],
            memory: LawMemory::for_times(springs, together),
            spins: state.planes.iter().map(|own| own.spin).collect(),
            without_spin: vec![0.0; springs.most(|law| law.bound.kind.rows)],
            by_spring: std::array::from_fn(|_| vec![0.0; springs.most(|_| 1)]),
            flows: vec![Flow::default(); MOTIONS * springs.bearings],
        }
    }

    /// Starts a step at a state that was just evaluated.
    pub(crate) fn start(&mut self, state: &SpringState) {
        for (start, law) in self.starts.iter_mut().zip(&state.laws) {
            start.inputs.copy_from_slice(&law.inputs);
            start.forces.copy_from_slice(&law.forces);
            start.states.copy_from_slice(&law.states);
            for (own, now) in start.shapes.iter_mut().zip([&law.bore, &law.bore_force]) {
                let from = now.len() - own.len();
                own.copy_from_slice(&now[from..]);
            }
        }
        self.spins.iter_mut().zip(&state.planes).for_each(|(spin, own)| *spin = own.spin);
    }

    /// The work of the step that ends at a state just evaluated; the next one starts there only after
    /// [`WorkAlong::start`].
    pub(crate) fn measure(&mut self, springs: &Springs, state: &SpringState) -> SpringWork {
        let mut work = SpringWork::default();
        self.flows.fill(Flow::default());
        for (place, law) in springs.laws.iter().enumerate() {
            self.integrate(law, place, &state.laws[place]);
            if self.any_spins(law) {
                state.measure_with(springs, place, &self.spins, &mut self.without_spin);
            }
            self.add(springs, place, &state.laws[place], &mut work);
            if law.bound.law.stores() {
                work.store(self.gain(law, place, &state.laws[place]));
            }
        }
        self.flows.iter_mut().for_each(|own| own.flowed = own.flowed.abs());
        work
    }

    /// Whether a journal of a law spins in its frame.
    fn any_spins(&self, law: &PlacedLaw) -> bool {
        self.spins[law.planes.clone()].iter().any(Option::is_some)
    }

    /// Of the step that was measured last, [`MOTIONS`] of a bearing, then of the next.
    pub(crate) fn flows(&self) -> &[Flow] {
        &self.flows
    }

    /// The means of the forces of a law along the way, and along the way at rest.
    fn integrate(&mut self, law: &PlacedLaw, place: usize, end: &LawState) {
        let (bound, n) = (&law.bound, law.springs);
        let start = &self.starts[place];
        for (k, &force) in bound.forces.iter().enumerate() {
            let ends = start.forces[force * n..].iter().zip(&end.forces[force * n..]);
            let sums = self.along[k * n..][..n].iter_mut();
            sums.zip(ends).for_each(|(sum, (a, b))| *sum = END * (a + b));
        }
        self.at_rest.fill(0.0);
        if bound.law.film().is_some() {
            // What the oil is on the way is not known: the ends count for all of it, and nothing is stored.
            self.along[..bound.forces.len() * n].iter_mut().for_each(|sum| *sum *= 0.5 / END);
            return;
        }
        // What a law with states stores, it says itself; the rest is dissipated.
        let parted = bound.states.is_empty() && bound.takes_rates();
        let nodes = if parted { &ALL[..] } else { &ALL[..NODES.len()] };
        for nodes in nodes.chunks(together(n)) {
            self.take_along(law, place, end, nodes);
            let forces = self.memory.forces(law, nodes.len());
            for (k, forces) in forces.chunks_exact((n * nodes.len()).max(1)).enumerate() {
                for ((_, weight, at_rest), forces) in
                    nodes.iter().zip(forces.chunks_exact(n.max(1)))
                {
                    let sums = if *at_rest { &mut self.at_rest } else { &mut self.along };
                    let sums = sums[k * n..][..n].iter_mut();
                    sums.zip(forces).for_each(|(sum, force)| *sum += weight * force);
                }
            }
        }
        if bound.states.is_empty() && !parted {
            self.at_rest.copy_from_slice(&self.along);
        }
    }

    /// Gives a law what it takes at some nodes of the step, node after node in each row.
    fn take_along(&mut self, law: &PlacedLaw, place: usize, end: &LawState, nodes: &[Node]) {
        let (bound, n, start) = (&law.bound, law.springs, &self.starts[place]);
        let width = n * nodes.len();
        let mut rows = self.memory.inputs.chunks_exact_mut(width.max(1));
        let between = |(s, ..): &Node, [a, b]: [&[f64]; 2], out: &mut [f64]| {
            let ends = a.iter().zip(b);
            out.iter_mut().zip(ends).for_each(|(v, (a, b))| *v = a + s * (b - a));
        };
        for (&input, row) in bound.inputs.iter().zip(rows.by_ref()) {
            let ends = [&start.inputs[input * n..][..n], &end.inputs[input * n..][..n]];
            for (node, values) in nodes.iter().zip(row.chunks_exact_mut(n.max(1))) {
                match node.2 && bound.kind.inputs[input].rate {
                    true => values.fill(0.0),
                    false => between(node, ends, values),
                }
            }
        }
        let states = start.states.chunks_exact(n.max(1)).zip(end.states.chunks_exact(n.max(1)));
        for ((a, b), row) in states.zip(rows) {
            for (node, values) in nodes.iter().zip(row.chunks_exact_mut(n.max(1))) {
                between(node, [a, b], values);
            }
        }
    }

    /// By how much the energy that a law stores has grown over the step (J).
    fn gain(&mut self, law: &PlacedLaw, place: usize, end: &LawState) -> f64 {
        let (bound, n, start) = (&law.bound, law.springs, &self.starts[place]);
        let memory = &mut self.memory;
        let mut energy = |inputs: &[f64], states: &[f64]| -> f64 {
            for (row, &input) in bound.inputs.iter().enumerate() {
                memory.inputs[row * n..][..n].copy_from_slice(&inputs[input * n..][..n]);
            }
            memory.inputs[bound.inputs.len() * n..][..states.len()].copy_from_slice(states);
            let given = &memory.inputs[..bound.rows_in() * n];
            let energies = &mut memory.outputs[..n];
            bound.law.stored(n, given, energies, &mut memory.workspace);
            energies.iter().sum()
        };
        let before = energy(&start.inputs, &start.states);
        energy(&end.inputs, &end.states) - before
    }

    /// Adds the work of a law, spring by spring: its mean forces times what their measures changed. What its forces
    /// make of each other's energy at a spring, or in a ring, is none.
    fn add(&mut self, springs: &Springs, place: usize, end: &LawState, work: &mut SpringWork) {
        let law = &springs.laws[place];
        let (start, n) = (&self.starts[place], law.springs);
        let moved_to = if self.any_spins(law) { &self.without_spin } else { &end.inputs };
        for plane in &springs.planes[law.planes.clone()] {
            // In motions that the law takes, and in the others.
            let [mut taken, mut others] = [Flow::default(); 2];
            let count = plane.springs.len();
            let [made, made_in_others, moved] = &mut self.by_spring;
            made[..count].fill(0.0);
            made_in_others[..count].fill(0.0);
            for (k, &force) in law.bound.forces.iter().enumerate() {
                let row = law.bound.kind.measures[force];
                let (made, flow) = match row < law.bound.kind.inputs.len() {
                    true => (&mut made[..count], &mut taken),
                    false => (&mut made_in_others[..count], &mut others),
                };
                let place = |row: usize| row * n + plane.springs.start..row * n + plane.springs.end;
                let [from, to] = [&start.inputs, moved_to].map(|own| &own[place(row)]);
                let ends = [&start.forces, &end.forces].map(|own| &own[place(force)]);
                let [along, at_rest] = [&self.along, &self.at_rest].map(|own| &own[place(k)]);
                let ways = Ways { measures: [from, to], ends, along, at_rest, made, moved };
                let [along, at_rest, moved] = Registers::current().run(ways);
                flow.flowed += along;
                flow.moved += moved;
                work.add(along, at_rest);
            }
            // Of films the ends count, on the shapes of their bores as well.
            let shapes = start.shapes.iter().zip(shapes_of(law, end));
            let mut shapes = shapes.map(|(from, to)| from.iter().zip(to));
            if let (Some(by), Some(forces)) = (shapes.next(), shapes.next()) {
                for ((from, to), (before, after)) in by.zip(forces) {
                    let along = 0.5 * (before + after) * (to - from);
                    taken.flowed += along;
                    work.add(along, 0.0);
                }
            }
            let (made, others_made) = (&made[..count], &made_in_others[..count]);
            taken.made = sum_over([made], |[made]| made.abs());
            let made_in_all = sum_over([made, others_made], |[a, b]| (a + b).abs());
            let all = Flow {
                made: made_in_all,
                flowed: taken.flowed + others.flowed,
                moved: taken.moved + others.moved,
            };
            let flows: [Flow; MOTIONS] = [taken, all];
            let own = &mut self.flows[MOTIONS * plane.bearing..];
            own.iter_mut().zip(&flows).for_each(|(sum, flow)| sum.add(flow));
        }
    }
}
