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
use crate::machine::Machine;

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
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
enum Directions {
    /// The factors.
    Factors,
    /// Their inverse.
    Inverse,
    /// The iteration in the measures of the joints, with its bodies.
    Condensed(Box<KeptBodies>),
}

/// What is known of some factors: enough to compute them again with the same bits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct OfFactors {
    at: Factored,
    /// Directions that they have given, and what gives the next one. Of all factors one at most has more than itself.
    directions: usize,
    by: Directions,
    /// What directions from the factors or their inverse lack.
    secants: Secants,
    /// What the best step since has cost, and how much more others did, summed; see `KeptFactors::count`.
    fewest: usize,
    excess: usize,
}

impl OfFactors {
    /// Of none.
    fn none(machine: &Machine) -> Self {
        OfFactors {
            at: Factored::nowhere(machine),
            directions: 0,
            by: Directions::Factors,
            secants: Secants::new(machine.active()),
            fewest: usize::MAX,
            excess: 0,
        }
    }

    /// Begins with new factors.
    fn begin(&mut self) {
        self.lose_inverse();
        self.secants.clear();
        (self.fewest, self.excess) = (usize::MAX, 0);
    }

    /// What was made of the factors is made of others now.
    fn lose_inverse(&mut self) {
        (self.by, self.directions) = (Directions::Factors, 0);
    }
}

/// What is known of all factors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct FactorsState {
    current: OfFactors,
    /// Those of other step lengths, and the place that is emptied next.
    spare: Vec<OfFactors>,
    next_spare: usize,
    /// How often a matrix was factored.
    factorisations: usize,
}

impl FactorsState {
    /// As it is, with no matrix factored yet.
    pub(super) fn counted_anew(&self) -> FactorsState {
        FactorsState { factorisations: 0, ..self.clone() }
    }
}

impl KeptFactors {
    /// Memory for one step length and so many spare ones.
    pub(super) fn new(equations: &Equations, spare: usize) -> Self {
        let machine = equations.machine;
        let (size, unknowns) = (machine.size(), machine.active());
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
                current: OfFactors::none(machine),
                spare: (0..spare).map(|_| OfFactors::none(machine)).collect(),
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
        self.state.current.at.dt == dt
    }

    /// Has them computed anew when they are needed next.
    pub(super) fn drop(&mut self) {
        self.state.current.at.forget();
    }

    /// Has all of them computed anew, those of other step lengths, too.
    pub(super) fn drop_all(&mut self) {
        self.drop();
        self.state.spare.iter_mut().for_each(|own| own.at.forget());
    }

    /// Goes on with what was kept; the system is evaluated elsewhere for it, with loads released as they were.
    pub(super) fn resume_from(
        &mut self,
        (equations, method): (&mut Equations, Integrator),
        kept: FactorsState,
        merit: &mut Merit,
    ) {
        for (place, own) in kept.spare.iter().enumerate() {
            self.repeat((equations, method), own, merit);
            std::mem::swap(&mut self.current, &mut self.spare[place]);
        }
        self.repeat((equations, method), &kept.current, merit);
        equations.before = false;
        self.state = kept;
    }

    /// Computes factors again where they were computed, and what had been made of them.
    fn repeat(
        &mut self,
        (equations, method): (&mut Equations, Integrator),
        own: &OfFactors,
        merit: &mut Merit,
    ) {
        if !own.at.is_there() {
            return;
        }
        let step = own.at.evaluate(equations, method);
        self.current.take(equations, (own.at.time, &own.at.state, &step), &mut self.whole);
        if own.by != Directions::Factors {
            merit.weigh(equations, &step);
            self.invert(equations, merit);
        }
        if let Directions::Condensed(bodies) = &own.by
            && bodies.at.is_there()
        {
            bodies.at.restore(equations);
            self.take_bodies(equations, (bodies.at.time, &bodies.at.state, &step));
        }
    }

    /// Begins a step: puts the factors of another step length aside, and takes those of `dt` s from where they are.
    pub(super) fn begin(&mut self, dt: f64) {
        (self.followed, self.contracts) = (0, true);
        let state = &mut self.state;
        if state.current.at.dt != dt && !state.spare.is_empty() {
            let is_used = state.current.at.is_there();
            let known = state.spare.iter().position(|own| own.at.dt == dt);
            let free = || state.spare.iter().position(|own| !own.at.is_there());
            let place = known.or_else(|| is_used.then(free).flatten()).or_else(|| {
                is_used.then(|| {
                    let next = state.next_spare;
                    state.next_spare = (next + 1) % state.spare.len();
                    next
                })
            });
            if let Some(place) = place {
                std::mem::swap(&mut self.current, &mut self.spare[place]);
                std::mem::swap(&mut state.current, &mut state.spare[place]);
                if state.current.at.dt != dt {
                    state.current.at.forget();
                }
            }
        }
        self.state.current.secants.begin();
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
        self.state.factorisations += 1;
        let own = &mut self.state.current;
        own.begin();
        own.at.keep((t, at, if done { step.dt } else { 0.0 }), equations);
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
        if self.state.current.directions == FACTORED {
            let by = self.invert(equations, merit);
            self.state
                .spare
                .iter_mut()
                .filter(|own| own.by != Directions::Factors)
                .for_each(OfFactors::lose_inverse);
            self.state.current.by = by;
        }
        self.state.current.directions += 1;
        if let Directions::Condensed(bodies) = &mut self.state.current.by
            && !bodies.at.is_there()
        {
            bodies.begin();
            let is_taken = self.take_bodies(equations, (t, at, step));
            match &mut self.state.current.by {
                Directions::Condensed(bodies) if is_taken => {
                    bodies.at.keep((t, at, step.dt), equations);
                }
                by => *by = Directions::Factors,
            }
        }
        let own = &mut self.state.current;
        match (&own.by, &mut self.condensed) {
            (Directions::Condensed(bodies), Some(condensed)) => {
                let tangents = &self.current.tangents;
                let judged = (tolerance, bodies.are_solved_twice());
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
                return;
            }
            (Directions::Inverse, _) => self.inverse.apply(r),
            _ => self.current.lu.solve_in_place(r),
        }
        own.secants.correct(r, merit.weights(), &mut self.memory);
    }

    /// Makes of the factors what gives directions faster.
    fn invert(&mut self, equations: &Equations, merit: &Merit) -> Directions {
        let (lu, springs) = (&mut self.current.lu, &equations.machine.springs);
        let is_condensed = self
            .condensed
            .as_mut()
            .is_some_and(|own| own.take_compliance(springs, self.inverse.exact(lu)));
        match is_condensed {
            true => Directions::Condensed(Box::new(KeptBodies::none(equations.machine))),
            false if self.inverse.invert(lu, merit.weights()) => Directions::Inverse,
            false => Directions::Factors,
        }
    }

    /// Evaluates the bodies of the condensed iteration at a state; whether it can be used.
    fn take_bodies(
        &mut self,
        equations: &mut Equations,
        (t, at, step): (f64, &State, &Coefficients),
    ) -> bool {
        self.condensed.as_mut().is_some_and(|own| own.take_bodies(equations, t, at, step))
    }

    /// Whether the corrections of the measures in the step got smaller.
    pub(super) fn contract(&self) -> bool {
        self.contracts
    }

    /// Counts the iterations of a step that is solved. Factors end where steps have cost so much more than the best one as new
    /// factors do.
    pub(super) fn count(&mut self, iterations: usize) {
        let (state, rows) = (&mut self.state.current, self.current.lu.size());
        let all = iterations * cost(Work::Iteration) + self.followed * cost(Work::Correction);
        state.fewest = state.fewest.min(all);
        state.excess += all - state.fewest;
        let anew = match &mut state.by {
            Directions::Condensed(bodies) => {
                bodies.count(iterations);
                Work::Prepared(rows)
            }
            Directions::Factors | Directions::Inverse => Work::Factors(rows),
        };
        if state.excess > cost(anew) {
            self.drop();
        }
    }
}
