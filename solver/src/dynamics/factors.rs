//! The factors of [AK], kept over iterations and steps, and those of other step lengths on shelves beside them.

use serde::{Deserialize, Serialize};

use super::merit::Merit;
use super::newmark::{Coefficients, Newmark, State};
use super::system::System;
use crate::linalg::{Lu, RoughInverse, copy_block_from};

/// Directions from factors before they are inverted, which takes as long as some hundred directions from the inverse save.
const FACTORED: usize = 64;

/// Factors of a matrix for the unknowns: all coordinates from `first` on.
pub(super) struct KeptFactors {
    first: usize,
    lu: Lu,
    /// Factors for other step lengths.
    shelves: Vec<Lu>,
    /// The inverse of factors that are kept for long, and whether it is of those.
    inverse: RoughInverse,
    is_inverse: bool,
    /// [AK] of all coordinates, where not all are unknown.
    whole: Vec<f64>,
    state: FactorsState,
}

/// Enough to compute kept factors again with the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct FactorsState {
    current: Factored,
    /// Directions that the current ones have given.
    directions: usize,
    /// The fewest iterations of a step since, and how many more others took, summed.
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
            lu: Lu::new(unknowns),
            shelves: (0..shelves).map(|_| Lu::new(unknowns)).collect(),
            inverse: RoughInverse::new(unknowns),
            is_inverse: false,
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
            std::mem::swap(&mut self.lu, &mut self.shelves[shelf]);
        }
        if kept.current.is_there() {
            let step = self.repeat(system, method, &kept.current);
            if kept.directions >= FACTORED {
                merit.weigh(system, &step);
                self.is_inverse = self.inverse.invert(&mut self.lu, merit.weights());
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

    /// Puts the factors of another step length on a shelf, and takes those of `dt` s from theirs.
    pub(super) fn exchange(&mut self, dt: f64) {
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
        std::mem::swap(&mut self.lu, &mut self.shelves[shelf]);
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
            system.tangent(t, at, step, self.lu.values_mut());
        } else {
            system.tangent(t, at, step, &mut self.whole);
            copy_block_from(first, &self.whole, size, self.lu.values_mut());
        }
        let done = self.lu.factor_in_place().is_ok();
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
            self.is_inverse = self.inverse.invert(&mut self.lu, merit.weights());
        }
        match self.is_inverse {
            true => self.inverse.apply(r),
            false => self.lu.solve_in_place(r),
        }
        self.state.directions += 1;
    }

    /// Counts the iterations of a step that is solved. Factors end where steps have taken so many more than the best one as
    /// new factors cost, which is about one for each row.
    pub(super) fn count(&mut self, iterations: usize) {
        let state = &mut self.state;
        state.fewest = state.fewest.min(iterations);
        state.excess += iterations - state.fewest;
        if state.excess > self.lu.size() {
            self.drop();
        }
    }
}
