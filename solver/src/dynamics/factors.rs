//! The factors of [AK], kept over iterations and steps, and spare ones of other step lengths.

use serde::{Deserialize, Serialize};

use super::condensed::{Condensed, KeptBodies};
use super::costs::{Work, cost};
use super::factored::{Factored, Factors};
use super::merit::Merit;
use super::newmark::{Coefficients, Integrator};
use super::secants::Secants;
use crate::equations::{Equations, State};
use crate::linalg::RoughInverse;

/// Directions from factors before they are inverted, which takes as long as so many from the inverse save.
const FACTORED: usize = 24;

/// Factors of a matrix for the unknowns: all coordinates from `first` on.
pub(super) struct KeptFactors {
    current: Factors,
    /// Factors for other step lengths.
    spare: Vec<Factors>,
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

/// Enough to compute kept factors again with the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct FactorsState {
    current: Factored,
    /// Directions that the current ones have given, and what gives the next one.
    directions: usize,
    by: Directions,
    /// What these directions lack, where they are not condensed.
    secants: Secants,
    /// What the best step since has cost, and how much more others did, summed; see `KeptFactors::count`.
    fewest: usize,
    excess: usize,
    /// The bodies of the condensed iteration.
    bodies: KeptBodies,
    /// Where the spare factors were computed, and the place that is emptied next.
    spare_at: Vec<Factored>,
    next_spare: usize,
    /// How often a matrix was factored.
    factorisations: usize,
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
        self.bodies.forget();
    }
}

impl KeptFactors {
    /// Memory for one step length and so many spare ones.
    pub(super) fn new(equations: &Equations, spare: usize) -> Self {
        let machine = equations.machine;
        let (size, unknowns) = (machine.size(), machine.active());
        let nowhere = || Factored::nowhere(machine);
        KeptFactors {
            current: Factors::new(equations, unknowns),
            spare: (0..spare).map(|_| Factors::new(equations, unknowns)).collect(),
            inverse: RoughInverse::new(unknowns),
            condensed: Condensed::new(equations),
            memory: vec![0.0; unknowns],
            followed: 0,
            contracts: true,
            whole: vec![0.0; if unknowns < size { size * size } else { 0 }],
            state: FactorsState {
                current: nowhere(),
                directions: 0,
                by: Directions::Factors,
                secants: Secants::new(unknowns),
                fewest: usize::MAX,
                excess: 0,
                bodies: KeptBodies::none(machine),
                spare_at: (0..spare).map(|_| nowhere()).collect(),
                next_spare: 0,
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
        self.state.current.forget();
    }

    /// Has all of them computed anew, those of other step lengths, too.
    pub(super) fn drop_all(&mut self) {
        self.drop();
        self.state.spare_at.iter_mut().for_each(Factored::forget);
    }

    /// Goes on with what was kept; the system is evaluated elsewhere for it, with loads released as they were.
    pub(super) fn resume_from(
        &mut self,
        (equations, method): (&mut Equations, Integrator),
        kept: FactorsState,
        merit: &mut Merit,
    ) {
        for (place, own) in kept.spare_at.iter().enumerate().filter(|(_, own)| own.is_there()) {
            self.repeat(equations, method, own);
            std::mem::swap(&mut self.current, &mut self.spare[place]);
        }
        if kept.current.is_there() {
            let step = self.repeat(equations, method, &kept.current);
            if kept.directions >= FACTORED {
                merit.weigh(equations, &step);
                self.invert(equations, merit);
            }
            if kept.bodies.at.is_there() {
                kept.bodies.at.restore(equations);
                let (time, state) = (kept.bodies.at.time, &kept.bodies.at.state);
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
        let step = own.evaluate(equations, method);
        self.factor(equations, own.time, &own.state, &step);
        step
    }

    /// Begins a step: puts the factors of another step length aside, and takes those of `dt` s from where they are.
    pub(super) fn begin(&mut self, dt: f64) {
        (self.followed, self.contracts) = (0, true);
        let state = &mut self.state;
        state.secants.begin();
        if state.current.dt == dt || state.spare_at.is_empty() {
            return;
        }
        let is_used = state.current.is_there();
        let known = state.spare_at.iter().position(|own| own.dt == dt);
        let free = || state.spare_at.iter().position(|own| !own.is_there());
        let place = match known.or_else(|| is_used.then(free).flatten()) {
            Some(place) => place,
            None if is_used => {
                let next = state.next_spare;
                state.next_spare = (next + 1) % state.spare_at.len();
                next
            }
            None => return,
        };
        std::mem::swap(&mut self.current, &mut self.spare[place]);
        std::mem::swap(&mut state.current, &mut state.spare_at[place]);
        if state.current.dt != dt {
            state.current.forget();
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
        let done = self.current.take(equations, (t, at, step), &mut self.whole);
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
        if self.state.by == Directions::Condensed && !self.state.bodies.at.is_there() {
            self.take_bodies(equations, (t, at, step));
        }
        match (self.state.by, &mut self.condensed) {
            (Directions::Condensed, Some(condensed)) => {
                let tangents = &self.current.tangents;
                let judged = (tolerance, self.state.bodies.are_solved_twice());
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
            self.state.bodies.at.keep((t, at, step.dt), equations);
        } else {
            self.state.by = Directions::Factors;
        }
        self.state.bodies.begin();
    }

    /// Whether the corrections of the measures in the step got smaller.
    pub(super) fn contract(&self) -> bool {
        self.contracts
    }

    /// Counts the iterations of a step that is solved. Factors end where steps have cost so much more than the best one as new
    /// factors do.
    pub(super) fn count(&mut self, iterations: usize) {
        let (state, rows) = (&mut self.state, self.current.lu.size());
        let all = iterations * cost(Work::Iteration) + self.followed * cost(Work::Correction);
        state.fewest = state.fewest.min(all);
        state.excess += all - state.fewest;
        state.bodies.count(iterations);
        let anew = match state.by {
            Directions::Condensed => Work::Prepared(rows),
            Directions::Factors | Directions::Inverse => Work::Factors(rows),
        };
        if state.excess > cost(anew) {
            self.drop();
        }
    }
}
