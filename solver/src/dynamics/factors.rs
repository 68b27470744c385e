//! The factors of [AK], kept over iterations and steps, and those of other step lengths on shelves beside them.

use serde::{Deserialize, Serialize};
use whirl_specs::ContactTangent;

use super::condensed::Condensed;
use super::merit::Merit;
use super::newmark::{Coefficients, Integrator};
use super::secants::Secants;
use crate::equations::Equations;
use crate::equations::State;
use crate::linalg::{Lu, RoughInverse, copy_block_from};
use crate::told::ToldLoad;

/// Directions from factors before they are inverted, which takes as long as so many from the inverse save.
const FACTORED: usize = 24;

/// Iterations more than one a step that take as long as evaluating the bodies of the condensed iteration.
const LATE: usize = 6;
/// Steps in which bodies are solved twice that take longer than that.
const TWICE: usize = 64;
/// Steps that are worth evaluating the bodies for.
const SOON: usize = 16;
/// Corrections of the measures that take as long as an iteration.
const CORRECTIONS: usize = 4;

/// How many times as much new factors cost with what the condensed iteration makes of them.
const PREPARED: usize = 3;

/// Factors of a matrix for the unknowns: all coordinates from `first` on.
pub(super) struct KeptFactors {
    first: usize,
    current: Factors,
    /// Factors for other step lengths.
    shelves: Vec<Factors>,
    /// What is made of factors that are kept for long.
    inverse: RoughInverse,
    condensed: Option<Condensed>,
    /// One value an unknown.
    memory: Vec<f64>,
    /// Corrections of the measures in the step so far, and whether they got smaller.
    followed: usize,
    contracts: bool,
    /// [AK] of all coordinates, where not all are unknown.
    whole: Vec<f64>,
    state: FactorsState,
}

/// What gives directions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
enum Directions {
    /// The factors.
    Factors,
    /// Their inverse.
    Inverse,
    /// The iteration in the measures of the joints.
    Condensed,
}

/// Factors of [AK], and the tangents of the springs in it.
struct Factors {
    lu: Lu,
    tangents: Vec<ContactTangent>,
}

impl Factors {
    fn new(equations: &Equations, unknowns: usize) -> Self {
        Factors { lu: Lu::new(unknowns), tangents: equations.spring_tangents().to_vec() }
    }
}

/// Enough to compute kept factors again with the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct FactorsState {
    current: Factored,
    /// Directions that the current ones have given, and what gives the next one.
    directions: usize,
    by: Directions,
    /// What these directions lack, where they are not condensed.
    secants: Secants,
    /// The fewest corrections of a step since, and how many more others took, summed; see `KeptFactors::count`.
    fewest: usize,
    excess: usize,
    /// Where the bodies of the condensed iteration were evaluated, and how many iterations more than one steps took since.
    bodies: Factored,
    more: usize,
    /// Whether bodies that turn are solved twice, and steps since they are, or since they were evaluated.
    again: bool,
    since: usize,
    /// Where the factors on the shelves were computed, and the shelf that is emptied next.
    shelved: Vec<Factored>,
    next_shelf: usize,
    /// How often a matrix was factored.
    factorisations: usize,
}

/// Where factors were computed: time (s), state, released and told loads, the side of a jump, and step length (s), 0 where there are none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Factored {
    time: f64,
    state: State,
    released: Vec<bool>,
    told: Vec<Option<ToldLoad>>,
    before: bool,
    dt: f64,
}

impl Factored {
    fn keep(&mut self, (time, state, dt): (f64, &State, f64), equations: &Equations) {
        (self.time, self.before, self.dt) = (time, equations.before, dt);
        self.state.copy_from(state);
        self.released.copy_from_slice(&equations.released);
        self.told.copy_from_slice(&equations.told);
    }

    /// Sets what acts on a system to what acted there.
    fn restore(&self, equations: &mut Equations) {
        equations.before = self.before;
        equations.released.copy_from_slice(&self.released);
        equations.told.copy_from_slice(&self.told);
    }

    fn is_there(&self) -> bool {
        self.dt > 0.0
    }
}

impl FactorsState {
    /// As it is, with no matrix factored yet.
    pub(super) fn counted_anew(&self) -> FactorsState {
        FactorsState { factorisations: 0, ..self.clone() }
    }

    fn begin_count(&mut self) {
        self.by = Directions::Factors;
        self.secants.clear();
        (self.directions, self.fewest, self.excess) = (0, usize::MAX, 0);
        (self.bodies.dt, self.more, self.again, self.since) = (0.0, 0, false, 0);
    }
}

impl KeptFactors {
    /// Memory for as many step lengths as there are shelves, and one.
    pub(super) fn new(equations: &Equations, shelves: usize) -> Self {
        let machine = equations.machine;
        let (size, first) = (machine.size(), machine.first_unknown());
        let unknowns = size - first;
        let (released, told) = (vec![false; machine.loads.len()], vec![None; machine.loads.len()]);
        let nothing = || Factored {
            time: 0.0,
            state: State::new(size),
            released: released.clone(),
            told: told.clone(),
            before: false,
            dt: 0.0,
        };
        KeptFactors {
            first,
            current: Factors::new(equations, unknowns),
            shelves: (0..shelves).map(|_| Factors::new(equations, unknowns)).collect(),
            inverse: RoughInverse::new(unknowns),
            condensed: Condensed::new(equations),
            memory: vec![0.0; unknowns],
            followed: 0,
            contracts: true,
            whole: vec![0.0; if first > 0 { size * size } else { 0 }],
            state: FactorsState {
                current: nothing(),
                directions: 0,
                by: Directions::Factors,
                secants: Secants::new(unknowns),
                fewest: usize::MAX,
                excess: 0,
                bodies: nothing(),
                more: 0,
                again: false,
                since: 0,
                shelved: (0..shelves).map(|_| nothing()).collect(),
                next_shelf: 0,
                factorisations: 0,
            },
        }
    }

    pub(super) fn state(&self) -> &FactorsState {
        &self.state
    }

    /// How often a matrix was factored.
    pub(super) fn factorisations(&self) -> usize {
        self.state.factorisations
    }

    /// Whether there are factors for steps of `dt` s.
    pub(super) fn are_of(&self, dt: f64) -> bool {
        self.state.current.dt == dt
    }

    /// Has them computed anew when they are needed next.
    pub(super) fn drop(&mut self) {
        self.state.current.dt = 0.0;
    }

    /// Has all of them computed anew, those of other step lengths, too.
    pub(super) fn drop_all(&mut self) {
        self.drop();
        self.state.shelved.iter_mut().for_each(|own| own.dt = 0.0);
    }

    /// Goes on with what was kept; the system is evaluated elsewhere for it, with loads released as they were.
    pub(super) fn resume_from(
        &mut self,
        (equations, method): (&mut Equations, Integrator),
        kept: FactorsState,
        merit: &mut Merit,
    ) {
        for (shelf, own) in kept.shelved.iter().enumerate().filter(|(_, own)| own.is_there()) {
            self.repeat(equations, method, own);
            std::mem::swap(&mut self.current, &mut self.shelves[shelf]);
        }
        if kept.current.is_there() {
            let step = self.repeat(equations, method, &kept.current);
            if kept.directions >= FACTORED {
                merit.weigh(equations, &step);
                self.invert(equations, merit);
            }
            if kept.bodies.is_there() {
                kept.bodies.restore(equations);
                let (time, state) = (kept.bodies.time, &kept.bodies.state);
                self.take_bodies(equations, (time, state, &step));
            }
        }
        equations.before = false;
        self.state = kept;
    }

    /// Computes factors again where they were computed.
    fn repeat(
        &mut self,
        equations: &mut Equations,
        method: Integrator,
        own: &Factored,
    ) -> Coefficients {
        own.restore(equations);
        equations.evaluate(own.time, &own.state);
        let step = Coefficients::new(method, own.dt);
        self.factor(equations, own.time, &own.state, &step);
        step
    }

    /// Begins a step: puts the factors of another step length on a shelf, and takes those of `dt` s from theirs.
    pub(super) fn begin(&mut self, dt: f64) {
        (self.followed, self.contracts) = (0, true);
        let state = &mut self.state;
        state.secants.begin();
        if state.current.dt == dt || state.shelved.is_empty() {
            return;
        }
        let is_used = state.current.is_there();
        let known = state.shelved.iter().position(|own| own.dt == dt);
        let free = || state.shelved.iter().position(|own| !own.is_there());
        let shelf = match known.or_else(|| is_used.then(free).flatten()) {
            Some(shelf) => shelf,
            None if is_used => {
                let next = state.next_shelf;
                state.next_shelf = (next + 1) % state.shelved.len();
                next
            }
            None => return,
        };
        std::mem::swap(&mut self.current, &mut self.shelves[shelf]);
        std::mem::swap(&mut state.current, &mut state.shelved[shelf]);
        if state.current.dt != dt {
            state.current.dt = 0.0;
        }
        // An inverse is not kept: it is made again where these factors give many directions again.
        state.begin_count();
    }

    /// Computes factors at a state that was evaluated; whether there are any.
    // A phase of its own in tables of where the time goes.
    #[inline(never)]
    pub(super) fn factor(
        &mut self,
        equations: &mut Equations,
        t: f64,
        at: &State,
        step: &Coefficients,
    ) -> bool {
        let (first, size) = (self.first, at.q.len());
        if first == 0 {
            equations.tangent(t, at, step.weights(), self.current.lu.values_mut());
        } else {
            equations.tangent(t, at, step.weights(), &mut self.whole);
            copy_block_from(first, &self.whole, size, self.current.lu.values_mut());
        }
        for (own, tangent) in self.current.tangents.iter_mut().zip(equations.spring_tangents()) {
            copy_tangent(tangent, own);
        }
        let done = self.current.lu.factor_in_place().is_ok();
        self.state.begin_count();
        self.state.factorisations += 1;
        self.state.current.keep((t, at, if done { step.dt } else { 0.0 }), equations);
        done
    }

    /// Replaces r, the residual of a state just evaluated, by the Δq of [AK] Δq = r, or by what the laws make of it until less than
    /// `tolerance` (N) is missing at every spring. The springs are left where their forces are foreseen.
    // A phase of its own in tables of where the time goes.
    #[inline(never)]
    pub(super) fn solve(
        &mut self,
        equations: &mut Equations,
        (t, at, step): (f64, &State, &Coefficients),
        r: &mut [f64],
        (merit, tolerance): (&Merit, f64),
    ) {
        if self.state.directions == FACTORED {
            self.invert(equations, merit);
        }
        self.state.directions += 1;
        if self.state.by == Directions::Condensed && !self.state.bodies.is_there() {
            self.take_bodies(equations, (t, at, step));
        }
        match (self.state.by, &mut self.condensed) {
            (Directions::Condensed, Some(condensed)) => {
                let tangents = &self.current.tangents;
                let judged = (tolerance, self.state.again);
                match condensed.solve(equations, tangents, (at, step), r, judged) {
                    Some(followed) => {
                        self.followed += followed.corrections;
                        self.contracts &= followed.contracts;
                    }
                    None => {
                        self.contracts = false;
                        self.current.lu.solve_in_place(r);
                    }
                }
            }
            (Directions::Inverse, _) => self.inverse.apply(r),
            _ => self.current.lu.solve_in_place(r),
        }
        if self.state.by != Directions::Condensed {
            self.state.secants.correct(r, merit.weights(), &mut self.memory);
        }
    }

    /// Makes of the factors what gives directions faster.
    fn invert(&mut self, equations: &Equations, merit: &Merit) {
        let (lu, springs) = (&mut self.current.lu, &equations.machine.springs);
        let is_condensed = self
            .condensed
            .as_mut()
            .is_some_and(|own| own.take_compliance(springs, self.inverse.exact(lu)));
        self.state.by = match is_condensed {
            true => Directions::Condensed,
            false if self.inverse.invert(lu, merit.weights()) => Directions::Inverse,
            false => Directions::Factors,
        };
    }

    /// Evaluates the bodies of the condensed iteration at a state.
    fn take_bodies(
        &mut self,
        equations: &mut Equations,
        (t, at, step): (f64, &State, &Coefficients),
    ) {
        let Some(condensed) = self.condensed.as_mut() else { return };
        if condensed.take_bodies(equations, t, at, step) {
            self.state.bodies.keep((t, at, step.dt), equations);
        } else {
            self.state.by = Directions::Factors;
        }
        (self.state.more, self.state.again, self.state.since) = (0, false, 0);
    }

    /// Whether the corrections of the measures in the step got smaller.
    pub(super) fn contract(&self) -> bool {
        self.contracts
    }

    fn most_excess(&self) -> usize {
        let most = CORRECTIONS * self.current.lu.size();
        if self.state.by == Directions::Condensed { PREPARED * most } else { most }
    }

    /// Counts the iterations of a step that is solved, a correction of the measures as a part of one. Factors end where steps
    /// have taken so many more than the best one as new factors cost, which is about one for each row.
    pub(super) fn count(&mut self, iterations: usize) {
        let state = &mut self.state;
        let all = CORRECTIONS * iterations + self.followed;
        state.fewest = state.fewest.min(all);
        state.excess += all - state.fewest;
        // Bodies that have gone too far from where L⁻¹ was made have it made anew, or are solved twice where that would be due
        // again soon, until that is not enough or has taken as long.
        state.since += 1;
        state.more += iterations - 1;
        let made_anew = match state.again {
            true => state.more > LATE || state.since >= TWICE,
            false => state.more > 0 && state.since > SOON,
        };
        if made_anew {
            state.bodies.dt = 0.0;
        } else if state.more > 0 && !state.again {
            (state.again, state.more, state.since) = (true, 0, 0);
        }
        if state.excess > self.most_excess() {
            self.drop();
        }
    }
}

fn copy_tangent(from: &ContactTangent, to: &mut ContactTangent) {
    to.ring_ring = from.ring_ring;
    to.ring_bore.copy_from_slice(&from.ring_bore);
    to.bore_ring.copy_from_slice(&from.bore_ring);
    to.bore_bore.copy_from_slice(&from.bore_bore);
}
