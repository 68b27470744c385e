//! The equations of the machine at one instant: the residual
//! r = Q_v − M q̈ + Q_e + Q_s − C q̇ − K q and its derivatives.

mod frames;
mod joints;
mod outputs;
mod remembered;
mod spring_tangent;
mod state;
mod turning;

use std::array;
use std::ops::Range;

use whirl_specs::ContactTangent;

pub(crate) use self::frames::{frame_of, turn};
pub(crate) use self::joints::displaced;
pub(crate) use self::spring_tangent::SpringTangent;
pub use self::state::{State, Weights};
pub(crate) use self::turning::TurningBody;

use crate::bearing::{OnJournal, SpringRounding, SpringState};
use crate::linalg::{Matrix, dot, widely};
use crate::loads::{Load, Position};
use crate::machine::{Body, BodyPlace, Machine};
use crate::support::Support;
use crate::time_function::Instant;
use crate::told::{ToldLoad, told_or_own};

/// What derivatives by q̇ weigh beside those by q where they are told apart (1/s): so much that rounding of these, which are
/// larger by frequencies of about that, takes no digits of them.
const RATE: f64 = 1e6;

/// Matrices of small motions, unknowns × unknowns.
#[derive(Debug, Clone, PartialEq)]
pub struct Tangents {
    /// −∂r/∂q̈.
    pub mass: Matrix,
    /// −∂r/∂q̇.
    pub damping: Matrix,
    /// −∂r/∂q.
    pub stiffness: Matrix,
    /// By planes of springs −∂F/∂ε and −∂F/∂ε̇ of what acts on the journal, along axes of its body.
    pub(crate) planes: Vec<[OnJournal; 2]>,
}

/// Memory for evaluating a machine, and what was last evaluated.
pub struct Equations<'m> {
    pub(crate) machine: &'m Machine,
    pub(crate) turning: Vec<TurningBody<'m>>,
    pub(crate) standing: Vec<(&'m Support, Range<usize>)>,
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
    /// For every load the amplitude that it was told to have in place of its own; none of one that has its own.
    pub(crate) told: Vec<Option<ToldLoad>>,
    /// What every load had as its amplitude.
    pub(crate) amplitudes: Vec<[f64; 3]>,
    /// Whether what begins at the instant of an evaluation does not act yet: see `dynamics::marching`.
    pub(crate) before: bool,
    /// What the loads were multiplied by.
    pub(crate) load_factors: Vec<f64>,
    /// What every row may have by its own terms, and |q̈| + |predicted q̈|; see `Equations::row_error`.
    pub(crate) row_bounds: Vec<f64>,
    pub(crate) accelerations: Vec<f64>,
    pub(crate) spring_rounding: SpringRounding,
    spring_tangent: SpringTangent,
    /// Q_v − M q̈, C q̇, K q and loads of bodies that turn at another state.
    other: [Vec<f64>; 4],
}

impl<'m> Equations<'m> {
    /// Memory for a machine.
    pub fn new(machine: &'m Machine) -> Self {
        let values = || vec![0.0; machine.size()];
        let (mut turning, mut standing) = (Vec::new(), Vec::new());
        for (body, place) in machine.bodies.iter().zip(machine.places()) {
            match body {
                Body::Turning { shaft, .. } => {
                    turning.push(TurningBody::new(machine, shaft, place));
                }
                Body::Standing { support, .. } => standing.push((support, place.flexible.clone())),
            }
        }
        Equations {
            machine,
            turning,
            standing,
            time: 0.0,
            residual: values(),
            inertia: values(),
            damper: values(),
            elastic: values(),
            load: values(),
            spring: values(),
            springs: machine.spring_state(),
            released: vec![false; machine.loads.len()],
            told: vec![None; machine.loads.len()],
            amplitudes: machine.loads.iter().map(|load| load.action.amplitude()).collect(),
            before: false,
            load_factors: vec![0.0; machine.loads.len()],
            row_bounds: values(),
            accelerations: values(),
            spring_rounding: SpringRounding::new(&machine.springs, machine.size()),
            spring_tangent: SpringTangent::new(&machine.springs),
            other: std::array::from_fn(|_| values()),
        }
    }

    /// Says of every load of the machine whether it has stopped driving.
    pub fn release(&mut self, released: &[bool]) {
        self.released.copy_from_slice(released);
    }

    /// r at the state that was last evaluated, one value a coordinate. That of a rotation that is no unknown is
    /// the couple which would be needed beside the loads, with the sign changed.
    pub fn residual(&self) -> &[f64] {
        &self.residual
    }

    /// Generalised forces of the joints at the state that was last evaluated, one value a coordinate.
    pub fn spring_forces(&self) -> &[f64] {
        &self.spring
    }

    /// Computes r and its parts at time `t` (s).
    // A phase of its own in tables of where the time goes.
    #[inline(never)]
    pub fn evaluate(&mut self, t: f64, state: &State) {
        self.time = t;
        let machine = self.machine;
        self.damper.fill(0.0);
        self.elastic.fill(0.0);
        for body in &mut self.turning {
            body.evaluate(state, [&mut self.inertia, &mut self.damper, &mut self.elastic]);
        }
        for (support, place) in &self.standing {
            let n = place.len();
            let [x, v, a] = [&state.q, &state.v, &state.a].map(|own| &own[place.clone()]);
            let (c, k) = (&support.damping[..n], &support.stiffness[..n]);
            let [inertia, damper, elastic] =
                [&mut self.inertia, &mut self.damper, &mut self.elastic]
                    .map(|terms| &mut terms[place.clone()]);
            widely(|| {
                for i in 0..n {
                    inertia[i] = -a[i];
                    damper[i] = c[i] * v[i];
                    elastic[i] = k[i] * x[i];
                }
            });
        }

        self.load.fill(0.0);
        let now = Instant { before: self.before, ..instant(machine, t, state) };
        for (k, load) in machine.loads.iter().enumerate() {
            let (place, position) = placed(machine, load, &state.q);
            let (amplitude, factor) = (&mut self.amplitudes[k], &mut self.load_factors[k]);
            *amplitude = told_or_own(load, self.told[k].as_ref(), t);
            *factor = load.factor(&now, self.released[k]);
            load.add_force((amplitude, *factor), &position, &state.q, place, &mut self.load);
        }

        self.springs.update(&machine.springs, t, [&state.q, &state.v], &state.laws);
        self.spring.fill(0.0);
        self.springs.add_forces(&machine.springs, &mut self.spring);

        let applied = self.load.iter().zip(&self.spring);
        let own = self.inertia.iter().zip(self.elastic.iter().zip(&self.damper));
        let terms = self.residual.iter_mut().zip(applied.zip(own));
        widely(|| {
            for (r, ((load, spring), (inertia, (elastic, damper)))) in terms {
                *r = (inertia - elastic) + (load + spring - damper);
            }
        });
    }

    /// Writes by how much Q_v − M q̈ − C q̇ − K q and the loads of bodies that turn differ in a state from the one that was
    /// evaluated last, at the same time.
    pub(crate) fn change_of_turning(&mut self, state: &State, out: &mut [f64]) {
        let [inertia, damper, elastic, load] = &mut self.other;
        for terms in [&mut *damper, &mut *elastic, &mut *load] {
            terms.fill(0.0);
        }
        for body in &mut self.turning {
            body.evaluate(state, [&mut *inertia, &mut *damper, &mut *elastic]);
        }
        let machine = self.machine;
        let now = Instant { before: self.before, ..instant(machine, self.time, state) };
        let acting = machine.loads.iter().zip(&self.amplitudes).zip(&self.released);
        for ((own, amplitude), released) in acting {
            let (place, position) = placed(machine, own, &state.q);
            if place.rotation.is_some() {
                let strength = (amplitude, own.factor(&now, *released));
                own.add_force(strength, &position, &state.q, place, load);
            }
        }
        for body in &self.turning {
            for i in std::iter::once(body.theta()).chain(body.place.flexible.clone()) {
                let other = inertia[i] - elastic[i] + (load[i] - damper[i]);
                out[i] =
                    other - (self.inertia[i] - self.elastic[i] + (self.load[i] - self.damper[i]));
            }
        }
    }

    /// Writes by how much Q_v − M q̈ − C q̇ of the bodies that turn differs in the second of two states.
    pub(crate) fn change_of_inertia(&mut self, states: [&State; 2], out: &mut [f64]) {
        let [inertia, damper, elastic, _] = &mut self.other;
        out.fill(0.0);
        for (sign, state) in [-1.0, 1.0].into_iter().zip(states) {
            damper.fill(0.0);
            elastic.fill(0.0);
            for body in &mut self.turning {
                body.evaluate(state, [&mut *inertia, &mut *damper, &mut *elastic]);
                for i in body.place.flexible.clone() {
                    out[i] += sign * (inertia[i] - damper[i]);
                }
            }
        }
    }

    /// Writes a2 M + a1 C + K + PF − a1 P − B, eq. (46), column after column, at the state that was last
    /// evaluated.
    pub fn tangent(&mut self, t: f64, state: &State, weights: Weights, out: &mut [f64]) {
        self.tangent_of_bodies(t, state, weights, out);
        let (machine, size) = (self.machine, self.machine.size());
        self.springs.slope_films(&machine.springs);
        self.spring_tangent.subtract(&machine.springs, &self.springs, weights.rate, size, out);
    }

    /// −∂r/∂q̈, −∂r/∂q̇ and −∂r/∂q at the state that was last evaluated, over the unknown coordinates.
    pub fn tangents(&mut self, state: &State) -> Tangents {
        let machine = self.machine;
        let (size, first, t) = (machine.size(), machine.first_unknown(), self.time);
        let unknowns: Vec<usize> = (first..size).collect();
        let mut weighted = |weights: Weights| {
            let mut data = vec![0.0; size * size];
            self.tangent(t, state, weights, &mut data);
            let planes = self.spring_tangents().iter().enumerate();
            let planes = planes.map(|(plane, own)| machine.springs.on_journal(plane, own));
            let planes: Vec<OnJournal> = planes.collect();
            (Matrix { rows: size, cols: size, data }.select(&unknowns, &unknowns), planes)
        };
        let (stiffness, held) = weighted(Weights::POSITION);
        let (mut damping, both) = weighted(Weights { rate: RATE, acceleration: 0.0 });
        for (both, position) in damping.data.iter_mut().zip(&stiffness.data) {
            *both = (*both - position) / RATE;
        }
        let mass = self.mass(state).select(&unknowns, &unknowns);
        let planes = held.into_iter().zip(both).map(|(held, both)| {
            let rate = array::from_fn(|i| array::from_fn(|j| (both[i][j] - held[i][j]) / RATE));
            [held, rate]
        });
        Tangents { mass, damping, stiffness, planes: planes.collect() }
    }

    /// What −∂r/∂q, −∂r/∂q̇ and −∂r/∂q̈ come to with these weights, −∂r/∂q̇, and −∂r/∂q̈, at the state that was last evaluated, over the
    /// unknown coordinates. Derivatives by q̇ and q̈ of bodies are the same to the bit where nothing of them changes.
    pub(crate) fn tangents_of_step(&mut self, state: &State, weights: Weights) -> [Matrix; 3] {
        let (size, first, t) = (self.machine.size(), self.machine.first_unknown(), self.time);
        let unknowns: Vec<usize> = (first..size).collect();
        let with_springs = self.machine.springs.needs_rates();
        let rates = Weights { rate: RATE, acceleration: 0.0 };
        let [mut damping, stiffness, whole] =
            [(rates, with_springs), (Weights::POSITION, with_springs), (weights, true)].map(
                |(weights, springs)| {
                    let mut data = vec![0.0; size * size];
                    match springs {
                        true => self.tangent(t, state, weights, &mut data),
                        false => self.tangent_of_bodies(t, state, weights, &mut data),
                    }
                    Matrix { rows: size, cols: size, data }.select(&unknowns, &unknowns)
                },
            );
        for (both, position) in damping.data.iter_mut().zip(&stiffness.data) {
            *both = (*both - position) / RATE;
        }
        [whole, damping, self.mass(state).select(&unknowns, &unknowns)]
    }

    /// As [`Equations::tangent`], without springs.
    pub(crate) fn tangent_of_bodies(
        &mut self,
        t: f64,
        state: &State,
        weights: Weights,
        out: &mut [f64],
    ) {
        let machine = self.machine;
        let size = machine.size();
        out.fill(0.0);
        for body in &mut self.turning {
            body.add_tangent(state, weights, out);
        }
        for (support, place) in &self.standing {
            for (i, place) in place.clone().enumerate() {
                out[place * (size + 1)] +=
                    weights.acceleration + weights.rate * support.damping[i] + support.stiffness[i];
            }
        }
        let now = Instant { before: self.before, ..instant(machine, t, state) };
        let acting = machine.loads.iter().zip(&self.told).zip(&self.released);
        for ((load, told), released) in acting {
            let (_, position) = placed(machine, load, &state.q);
            let amplitude = told_or_own(load, told.as_ref(), t);
            load.subtract_tangent(&amplitude, &now, *released, &position, weights.rate, out);
        }
    }

    /// The tangents of the planes of springs, as [`Equations::tangent`] had them last.
    pub(crate) fn spring_tangents(&self) -> &[ContactTangent] {
        self.spring_tangent.planes()
    }

    /// ∂M/∂θ of a plane of springs, as [`Equations::tangent`] had it last with a1 = 0.
    pub(crate) fn torsion(&self, plane: usize) -> f64 {
        self.spring_tangent.by_angle(plane)
    }

    /// The diagonal of a2 M + a1 C + K, undeformed.
    pub(crate) fn diagonal(&self, weights: Weights) -> Vec<f64> {
        let mut diagonal = vec![0.0; self.machine.size()];
        for body in &self.turning {
            body.diagonal(weights, &mut diagonal);
        }
        for (support, place) in &self.standing {
            for (i, place) in place.clone().enumerate() {
                diagonal[place] =
                    weights.acceleration + weights.rate * support.damping[i] + support.stiffness[i];
            }
        }
        diagonal
    }

    /// M(q) of the whole machine.
    pub(crate) fn mass(&mut self, state: &State) -> Matrix {
        let size = self.machine.size();
        let mut mass = Matrix::zeros(size, size);
        for body in &mut self.turning {
            body.evaluate_mass(state);
            body.add_block(&mut mass.data, size);
        }
        for place in self.standing.iter().flat_map(|(_, place)| place.clone()) {
            mass[(place, place)] = 1.0;
        }
        mass
    }

    /// ½ q̇ᵀM q̇ (J).
    pub fn kinetic_energy(&mut self, state: &State) -> f64 {
        let turning: f64 = self.turning.iter_mut().map(|body| body.kinetic_energy(state)).sum();
        let standing = self.standing.iter().flat_map(|(_, place)| &state.v[place.clone()]);
        turning + 0.5 * standing.map(|v| v * v).sum::<f64>()
    }

    /// Kinetic and strain energy of a body (J).
    pub(crate) fn energies(&mut self, body: usize, state: &State) -> [f64; 2] {
        let place = self.machine.places()[body].flexible.clone();
        let (q, v) = (&state.q[place.clone()], &state.v[place]);
        match &self.machine.bodies[body] {
            Body::Turning { shaft, .. } => {
                let rows = q.iter().enumerate();
                let strain = rows.map(|(j, x)| x * dot(shaft.stiffness.col(j), q)).sum::<f64>();
                let place = self.machine.turning().position(|own| own == body);
                let own = &mut self.turning[place.expect("a body that turns")];
                [own.kinetic_energy(state), 0.5 * strain]
            }
            Body::Standing { support, .. } => {
                let strain = q.iter().zip(&support.stiffness).map(|(x, k)| k * x * x);
                [0.5 * v.iter().map(|v| v * v).sum::<f64>(), 0.5 * strain.sum::<f64>()]
            }
        }
    }

    /// ½ qᵀK q (J).
    pub fn strain_energy(&self, state: &State) -> f64 {
        let turning = self.turning.iter().map(|body| {
            let eta = &state.q[body.place.flexible.clone()];
            (0..eta.len()).map(|j| eta[j] * dot(body.shaft.stiffness.col(j), eta)).sum::<f64>()
        });
        let standing = self.standing.iter().flat_map(|(support, place)| {
            state.q[place.clone()].iter().zip(&support.stiffness).map(|(x, k)| k * x * x)
        });
        0.5 * (turning.sum::<f64>() + standing.sum::<f64>())
    }
}

/// An instant of a machine, as its loads see it.
pub(crate) fn instant<'s>(machine: &'s Machine, t: f64, state: &'s State) -> Instant<'s> {
    Instant { t, before: false, q: &state.q, v: &state.v, places: machine.places() }
}

/// Where the coordinates of a load's body stand, and how its frame is turned.
pub(crate) fn placed<'m>(
    machine: &'m Machine,
    load: &Load,
    q: &[f64],
) -> (&'m BodyPlace, Position) {
    let place = &machine.places()[load.body];
    (place, frame_of(machine, load.body, q))
}
