//! The factors of [AK], kept over iterations and steps, and those of other step lengths on shelves beside them.

use serde::{Deserialize, Serialize};
use whirl_specs::ContactTangent;

use super::joint_iteration::JointIteration;
use super::merit::Merit;
use super::newmark::{Coefficients, Newmark, State};
use super::system::System;
use crate::linalg::{Lu, RoughInverse, copy_block_from};

/// Directions from factors before they are inverted, which takes as long as some hundred directions from the inverse save.
const FACTORED: usize = 64;

/// Corrections of the measures that take as long as an iteration.
const CORRECTIONS: usize = 4;

/// Factors of a matrix for the unknowns: all coordinates from `first` on.
pub(super) struct KeptFactors {
    first: usize,
    current: Factors,
    /// Factors for other step lengths.
    shelves: Vec<Factors>,
    /// The inverse of factors that are kept for long, and whether it is of those.
    inverse: RoughInverse,
    is_inverse: bool,
    /// The iteration in the measures of the joints with that inverse, and whether it is of those factors.
    joints: Option<JointIteration>,
    joints_are_ready: bool,
    /// Corrections of the measures in the step so far, and whether they get smaller.
    followed: usize,
    contracts: bool,
    /// A correction of the unknowns.
    correction: Vec<f64>,
    /// [AK] of all coordinates, where not all are unknown.
    whole: Vec<f64>,
    state: FactorsState,
}

/// Factors of [AK], and the tangents of the springs in it.
struct Factors {
    lu: Lu,
    tangents: Vec<ContactTangent>,
}

impl Factors {
    fn new(system: &System, unknowns: usize) -> Self {
        Factors { lu: Lu::new(unknowns), tangents: system.spring_tangents().to_vec() }
    }
}

/// Enough to compute kept factors again with the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct FactorsState {
    current: Factored,
    /// Directions that the current ones have given.
    directions: usize,
    /// The fewest corrections of a step since, and how many more others took, summed; see `KeptFactors::count`.
    fewest: usize,
    excess: usize,
    /// Where the factors on the shelves were computed, and the shelf that is emptied next.
    shelved: Vec<Factored>,
    next_shelf: usize,
    /// How often a matrix was factored.
    factorisations: usize,
}

/// Where factors were computed: time (s), state, released loads and step length (s), 0 where there are none.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Factored {
    time: f64,
    state: State,
    released: Vec<bool>,
    dt: f64,
}

impl Factored {
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
        (self.directions, self.fewest, self.excess) = (0, usize::MAX, 0);
    }
}

impl KeptFactors {
    /// Memory for as many step lengths as there are shelves, and one.
    pub(super) fn new(system: &System, shelves: usize) -> Self {
        let machine = system.machine;
        let (size, first) = (machine.size(), machine.first_unknown());
        let unknowns = size - first;
        let released = vec![false; machine.loads.len()];
        let nothing =
            || Factored { time: 0.0, state: State::new(size), released: released.clone(), dt: 0.0 };
        KeptFactors {
            first,
            current: Factors::new(system, unknowns),
            shelves: (0..shelves).map(|_| Factors::new(system, unknowns)).collect(),
            inverse: RoughInverse::new(unknowns),
            is_inverse: false,
            joints: JointIteration::new(system),
            joints_are_ready: false,
            followed: 0,
            contracts: true,
            correction: vec![0.0; unknowns],
            whole: vec![0.0; if first > 0 { size * size } else { 0 }],
            state: FactorsState {
                current: nothing(),
                directions: 0,
                fewest: usize::MAX,
                excess: 0,
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

    /// Goes on with what was kept; the system is evaluated elsewhere for it, with loads released as they were.
    pub(super) fn resume_from(
        &mut self,
        (system, method): (&mut System, Newmark),
        kept: FactorsState,
        merit: &mut Merit,
    ) {
        for (shelf, own) in kept.shelved.iter().enumerate().filter(|(_, own)| own.is_there()) {
            self.repeat(system, method, own);
            std::mem::swap(&mut self.current, &mut self.shelves[shelf]);
        }
        if kept.current.is_there() {
            let step = self.repeat(system, method, &kept.current);
            if kept.directions >= FACTORED {
                merit.weigh(system, &step);
                self.invert(merit);
            }
        }
        self.state = kept;
    }

    /// Computes factors again where they were computed.
    fn repeat(&mut self, system: &mut System, method: Newmark, own: &Factored) -> Coefficients {
        system.released.copy_from_slice(&own.released);
        system.evaluate(own.time, &own.state);
        let step = Coefficients::new(method, own.dt);
        self.factor(system, own.time, &own.state, &step);
        step
    }

    /// Begins a step: puts the factors of another step length on a shelf, and takes those of `dt` s from theirs.
    pub(super) fn begin(&mut self, dt: f64) {
        (self.followed, self.contracts) = (0, true);
        let state = &mut self.state;
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
        self.is_inverse = false;
        state.begin_count();
    }

    /// Computes factors at a state that was evaluated; whether there are any.
    pub(super) fn factor(
        &mut self,
        system: &mut System,
        t: f64,
        at: &State,
        step: &Coefficients,
    ) -> bool {
        let (first, size) = (self.first, at.q.len());
        if first == 0 {
            system.tangent(t, at, step, self.current.lu.values_mut());
        } else {
            system.tangent(t, at, step, &mut self.whole);
            copy_block_from(first, &self.whole, size, self.current.lu.values_mut());
        }
        for (own, tangent) in self.current.tangents.iter_mut().zip(system.spring_tangents()) {
            copy_tangent(tangent, own);
        }
        let done = self.current.lu.factor_in_place().is_ok();
        self.is_inverse = false;
        self.state.begin_count();
        self.state.factorisations += 1;
        let current = &mut self.state.current;
        (current.time, current.dt) = (t, if done { step.dt } else { 0.0 });
        current.state.copy_from(at);
        current.released.copy_from_slice(&system.released);
        done
    }

    /// Replaces r by the Δq of [AK] Δq = r.
    pub(super) fn solve(&mut self, r: &mut [f64], merit: &Merit) {
        if self.state.directions == FACTORED {
            self.invert(merit);
        }
        match self.is_inverse {
            true => self.inverse.apply(r),
            false => self.current.lu.solve_in_place(r),
        }
        self.state.directions += 1;
    }

    /// Takes the inverse of the factors, and what follows from it for the joints.
    fn invert(&mut self, merit: &Merit) {
        self.is_inverse = self.inverse.invert(&mut self.current.lu, merit.weights());
        let ready = self.is_inverse.then_some(&self.inverse).zip(self.joints.as_mut());
        self.joints_are_ready = ready.is_some_and(|(own, joints)| joints.prepare(own.exact()));
    }

    /// Carries a correction of a state just evaluated on in the measures of the joints, where that is possible, until less
    /// than `tolerance` (N) is missing at every spring. The springs are left where they are foreseen.
    pub(super) fn follow(
        &mut self,
        system: &mut System,
        a1: f64,
        direction: &mut [f64],
        tolerance: f64,
    ) {
        let Some(joints) = self.joints.as_mut().filter(|_| self.is_inverse && self.joints_are_ready)
        else {
            return;
        };
        let tangents = &self.current.tangents;
        let followed = joints.follow(system, tangents, a1, direction, tolerance);
        self.followed += followed.corrections;
        self.correction.fill(0.0);
        joints.add_forces(system, &mut self.correction);
        self.inverse.apply(&mut self.correction);
        direction.iter_mut().zip(&self.correction).for_each(|(sum, own)| *sum += own);
        self.contracts &= followed.contracts;
    }

    /// Whether the corrections of the measures in the step got smaller.
    pub(super) fn contract(&self) -> bool {
        self.contracts
    }

    /// Counts the iterations of a step that is solved, a correction of the measures as a part of one. Factors end where steps
    /// have taken so many more than the best one as new factors cost, which is about one for each row.
    pub(super) fn count(&mut self, iterations: usize) {
        let state = &mut self.state;
        let all = CORRECTIONS * iterations + self.followed;
        state.fewest = state.fewest.min(all);
        state.excess += all - state.fewest;
        if state.excess > CORRECTIONS * self.current.lu.size() {
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
