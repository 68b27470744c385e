//! A periodic motion that is looked for: its cycle, its beginning, what is found.

use std::ops::ControlFlow;

use whirl_solver::Error;
use whirl_solver::dynamics::{BodyStart, equilibrium};
use whirl_solver::error::PeriodicError;
use whirl_solver::periodic::{
    Cycle, CycleMap, CycleProgress, Method, Periodic, PeriodicOptions, Repeating, common_period,
    least_harmonics, periodic_from, remembers_nothing, repeating, self_excited, start, undriven,
};

use super::motions::Motion;
use super::place::not_there;
use crate::case::{Analysis, Beginning, Case};
use crate::machine::Built;
use crate::report::VerdictFacts;
use crate::signals::Interruption;

/// Steps of a cycle where neither the analysis nor the march says them.
const STEPS: usize = 360;
/// At least as many for each time that the fastest load repeats.
const EACH: usize = 72;
/// Steps at least, whatever the time step of the march.
const LEAST: f64 = 8.0;

/// A motion that is looked for.
pub(super) struct Sought<'a> {
    pub(super) case: &'a Case,
    pub(super) analysis: &'a Analysis,
    pub(super) built: &'a Built,
    pub(super) speed: Option<f64>,
}

impl Sought<'_> {
    /// The motion, from the state of another one or from the beginning.
    pub(super) fn found(
        &self,
        near: Option<&[f64]>,
        interruption: &Interruption,
    ) -> Result<Motion, Error> {
        let Sought { built, .. } = *self;
        if self.analysis.periodic.self_excited {
            return self.own(interruption);
        }
        let (repeating, cycle) = self.cycle(None)?;
        let options = self.options(cycle);
        let mut map = CycleMap::new(&built.machine, cycle, options.newton)?;
        let mut observe = |_: &CycleProgress| match interruption.asked() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        let from_near = near.filter(|x| x.len() == map.size());
        let followed = from_near.map(|x| periodic_from(&mut map, &options, x, &mut observe));
        let periodic = match followed {
            Some(Ok(found)) => found,
            Some(Err(error)) if !not_there(&error) => return Err(error),
            _ => {
                let (bodies, laws_at_rest) = self.beginning(cycle)?;
                let x = map.beginning(&bodies, laws_at_rest);
                periodic_from(&mut map, &options, &x, &mut observe)?
            }
        };
        Ok(self.motion(repeating, periodic))
    }

    /// A motion that the machine has by itself.
    fn own(&self, interruption: &Interruption) -> Result<Motion, Error> {
        let mut observe = |_: &CycleProgress| match interruption.asked() {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        };
        let cycle = self.own_cycle()?;
        let (start, _) = self.beginning(cycle)?;
        let machine = &self.built.machine;
        let periodic = self_excited(machine, &self.options(cycle), &start, &mut observe)?;
        let hertz = 1.0 / periodic.cycle.period;
        let mut all = vec![Repeating { hertz, what: "the motion itself".to_owned() }];
        all.extend(repeating(machine).unwrap_or_default());
        Ok(self.motion(all, periodic))
    }

    /// About how long a period of its own is.
    fn own_cycle(&self) -> Result<Cycle, Error> {
        let keys = &self.analysis.periodic;
        let fastest = repeating(&self.built.machine)
            .map_or(0.0, |all| all.iter().map(|own| own.hertz).fold(0.0, f64::max));
        let near = keys.near.or((fastest > 0.0).then_some(0.5 * fastest));
        let period = 1.0 / near.ok_or(PeriodicError::NoFrequency)?;
        Ok(Cycle { start: 0.0, period, steps: keys.steps.unwrap_or(STEPS) })
    }

    /// What keeps the search from beginning.
    ///
    /// # Errors
    /// What does not repeat, or drives a machine that is to move by itself; a law that no cycle goes over.
    pub(super) fn foreseen(&self) -> Result<(), Error> {
        let machine = &self.built.machine;
        if self.analysis.periodic.self_excited {
            let options = self.options(self.own_cycle()?);
            return undriven(machine, &options).map(|_| ());
        }
        let (_, cycle) = self.cycle(None)?;
        least_harmonics(machine, cycle.period, self.analysis.periodic.harmonics)?;
        if self.analysis.periodic.method == Some(Method::Harmonic) {
            remembers_nothing(machine)?;
        }
        let map = CycleMap::new(machine, cycle, self.options(cycle).newton)?;
        match self.analysis.periodic.vary {
            Some(_) => Ok(map.suits_branches()?),
            None => Ok(()),
        }
    }

    fn motion(&self, repeating: Vec<Repeating>, periodic: Periodic) -> Motion {
        let length = (periodic.cycle.time_step(), None);
        let verdict = VerdictFacts::new(
            (&self.built.machine, &self.case.supports()),
            &periodic.outcome,
            length,
            (None, None),
        );
        let columns = periodic.history.names().to_vec();
        Motion { speed: self.speed, repeating, periodic, verdict, columns }
    }

    /// What repeats, and the cycle, in so many steps if they are told.
    pub(super) fn cycle(&self, steps: Option<usize>) -> Result<(Vec<Repeating>, Cycle), Error> {
        let machine = &self.built.machine;
        let repeating = repeating(machine)?;
        let period = self.analysis.periodic.periods as f64 * common_period(&repeating)?;
        let steps = steps.unwrap_or_else(|| self.steps(period, &repeating));
        Ok((repeating, Cycle { start: start(machine, period), period, steps }))
    }

    /// How it is looked for.
    pub(super) fn options(&self, cycle: Cycle) -> PeriodicOptions {
        let (keys, multipliers) = (&self.analysis.periodic, self.analysis.count);
        let (method, marched, most_cycles) = (keys.method, keys.marched, keys.cycles);
        let harmonics = keys.harmonics;
        PeriodicOptions {
            method,
            harmonics,
            marched,
            most_cycles,
            multipliers,
            ..PeriodicOptions::of(cycle)
        }
    }

    /// Steps of a cycle: as they are told, or as near to the time step of the march as they can be.
    fn steps(&self, period: f64, repeating: &[Repeating]) -> usize {
        let march = self.case.march.as_ref().filter(|own| own.automatic.is_none());
        let of_march = march.map(|own| (period / own.time_step).round().max(LEAST) as usize);
        let fastest = repeating.iter().map(|own| (own.hertz * period).round() as usize).max();
        let periods = self.analysis.periodic.periods;
        let enough = (periods * STEPS).max(EACH * fastest.unwrap_or(0));
        self.analysis.periodic.steps.or(of_march).unwrap_or(enough)
    }

    /// Where the search begins, and whether laws have been there for long.
    pub(super) fn beginning(&self, cycle: Cycle) -> Result<(Vec<BodyStart>, bool), Error> {
        let speeds: Vec<Option<f64>> =
            self.case.machine.bodies.iter().map(|body| body.initial_speed).collect();
        let balanced = || {
            let found = equilibrium(&self.built.machine, &speeds, Some(cycle.time_step()))?;
            Ok((found.bodies, true))
        };
        let at_rest = || (self.built.initial.clone(), false);
        match self.analysis.periodic.begin {
            Some(Beginning::Rest) => Ok(at_rest()),
            Some(Beginning::Equilibrium) => balanced(),
            None => balanced().or_else(|_: Error| Ok(at_rest())),
        }
    }
}
