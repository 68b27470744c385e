//! What is measured of the steps that are sampled, by the parts of the machine: their local error, how far they go, and what
//! they move in modes that they do not resolve, and what they make of inertia.

use super::in_space::{InSpace, weight};
use super::quality_meter::QualityMeter;
use super::sampling::{scattered, stands_for};
use crate::bodies::Rotation;
use crate::dynamics::iteration::Integrator;
use crate::dynamics::motion::{Kind, Linearised, Part, Place, larger};
use crate::equations::{Equations, State};

/// Steps from one linearisation to the next, at least. Of many unknowns it is as dear as hundreds of steps, so that they are
/// n²/4 apart: together they take a few hundredths of the time that steps do.
fn apart(unknowns: usize) -> u64 {
    const LEAST: u64 = 16;
    LEAST.max((unknowns as u64).pow(2) / 4)
}

impl QualityMeter {
    /// Measures a step of `dt` s that ends at a state just evaluated.
    pub(super) fn sample(
        &mut self,
        equations: &mut Equations,
        dt: f64,
        start: &State,
        end: &State,
    ) {
        let Some(mut linearised) = self.linearised.take() else { return };
        self.parts.displacement(end, &mut self.motion);
        self.parts.displacement(start, &mut self.before);
        self.motion.iter_mut().zip(&self.before).for_each(|(out, before)| *out -= before);
        self.move_parts(&linearised, dt);
        if self.is_compared() {
            self.compare(&linearised);
            for (sums, moved) in self.sums.parts.iter_mut().zip(&self.moved) {
                let changed = linearised.changed(dt, moved, sums.displacement);
                sums.changed = changed.contains(&true);
                let [free, _, fast] = changed;
                sums.unknown = free || fast;
            }
        }
        let changed = self.sums.parts.iter().any(|own| own.changed) && self.may_linearise();
        if let Some(new) = changed.then(|| self.linearise(equations, end)).flatten() {
            linearised = new;
            self.sums.parts.iter_mut().for_each(|own| (own.changed, own.unknown) = (false, false));
            self.move_parts(&linearised, dt);
        }
        self.add_errors(&linearised, dt, start, end);
        self.add_displacement(&linearised, end);
        self.linearised = Some(linearised);
    }

    /// Whether the modes are compared with the motion of the step: of few unknowns in each that is sampled.
    fn is_compared(&self) -> bool {
        const FEW: usize = 32;
        let steps = self.sums.steps;
        let now_and_then = steps < 8 || steps < 128 && steps.is_multiple_of(16);
        self.motion.len() <= FEW || now_and_then || scattered(steps).is_multiple_of(256)
    }

    /// Whether the last linearisation is so long ago that another one costs little.
    fn may_linearise(&self) -> bool {
        self.sums.steps - self.sums.linearised_at >= apart(self.motion.len())
    }

    /// The machine at a state that was just evaluated; none if its mass matrix is not positive definite.
    pub(super) fn linearise(
        &mut self,
        equations: &mut Equations,
        state: &State,
    ) -> Option<Linearised> {
        let new = Linearised::new(equations, &self.parts.all, self.steps.most(), state).ok()?;
        self.sums.linearised = Some(Place::of(equations, state));
        self.sums.linearised_at = self.sums.steps;
        self.sums.fastest = larger(self.sums.fastest, new.fastest());
        Some(new)
    }

    /// Tells apart by kinds of modes what the parts moved by, or are displaced by, which is in `motion`.
    fn move_parts(&mut self, linearised: &Linearised, dt: f64) {
        let QualityMeter { parts, motion, kinds, moved, .. } = self;
        for (place, (kind, own)) in Kind::ALL.into_iter().zip(kinds).enumerate() {
            linearised.part(kind, dt, motion, own);
            for (moved, part) in moved.iter_mut().zip(&parts.all) {
                moved.mass = part.mass();
                moved.squares[place] = moved.mass * part.measure(own).powi(2);
            }
        }
    }

    /// Compares the elastic forces of the step with those by the stiffness in the modes, along the motion in every kind of them.
    fn compare(&mut self, linearised: &Linearised) {
        let QualityMeter { parts, kinds, moved, change, within, .. } = self;
        let work = |part: &Part, motion: &[f64], force: &[f64]| -> f64 {
            let own = motion[part.place.clone()].iter().zip(&force[part.place.clone()]);
            own.map(|(x, f)| x * f).sum()
        };
        for (place, own) in kinds.iter().enumerate() {
            linearised.pull(own, within);
            change.iter_mut().zip(&*within).for_each(|(change, pulled)| *change -= pulled);
            for (moved, part) in moved.iter_mut().zip(&parts.all) {
                moved.works[place] = work(part, own, within);
            }
        }
        for (place, own) in kinds.iter().enumerate() {
            for (moved, part) in moved.iter_mut().zip(&parts.all) {
                moved.changes[place] = work(part, own, change);
            }
        }
    }

    /// Adds the error of a step of `dt` s, and its motion in modes that are not resolved. Where the modes of a part are not those
    /// of the machine any more, and cannot be taken anew yet, its whole motion counts: as resolved or not by its own ω, that by
    /// which its acceleration changes with it. Overdamped motion is slow in fast modes; what rings in them is not resolved.
    fn add_errors(&mut self, linearised: &Linearised, dt: f64, start: &State, end: &State) {
        let (factor, stands_for) = (self.method.error_factor(dt), stands_for(self.sums.steps));
        end.integrated_since(start, dt, &mut self.motion);
        for kind in [None, Some(Kind::Free), Some(Kind::Resolved)] {
            match kind {
                None => self.within.copy_from_slice(&self.motion),
                Some(kind) => linearised.part(kind, dt, &self.motion, &mut self.within),
            }
            self.parts.refer(&mut self.within);
            for number in 0..self.moved.len() {
                let unknown = self.sums.parts[number].unknown;
                let own = match (unknown, linearised.is_held(number)) {
                    (true, _) => None,
                    (false, false) => Some(Kind::Free),
                    (false, true) => Some(Kind::Resolved),
                };
                if own != kind {
                    continue;
                }
                let change = self.parts.all[number].measure(&self.within);
                let (sums, moved) = (&mut self.sums.parts[number], &self.moved[number]);
                let [.., fast] = moved.squares;
                let (resolves, motion) = match kind {
                    // By the quotient of Rayleigh of the step, as all of its motion counts.
                    None => {
                        let all = (moved.squares.iter().sum::<f64>() / moved.mass).sqrt();
                        let resolves = !(change * dt * dt >= all) || all == 0.0;
                        (resolves, if resolves { 0.0 } else { all })
                    }
                    Some(_) => (linearised.resolves(number, dt), (fast / moved.mass).sqrt()),
                };
                if resolves {
                    let error = factor * change;
                    sums.errors.add_times(error, stands_for);
                    sums.largest_error = larger(sums.largest_error, error);
                }
                sums.motions.add_times(motion, stands_for);
            }
        }
    }

    /// Adds the displacement of a state to the largest, and to those in modes.
    pub(super) fn add_displacement(&mut self, linearised: &Linearised, state: &State) {
        self.add_whole_displacement(state);
        let dt = self.steps.most();
        self.move_parts(linearised, dt);
        for (number, (sums, moved)) in self.sums.parts.iter_mut().zip(&self.moved).enumerate() {
            let [free, resolved, fast] = moved.squares;
            let judged = if linearised.is_held(number) { resolved } else { free + resolved };
            sums.reach = larger(sums.reach, ((judged + fast) / moved.mass).sqrt());
        }
    }

    /// Adds the displacement of a state, which is left in `motion`, to the largest.
    pub(super) fn add_whole_displacement(&mut self, state: &State) {
        let QualityMeter { sums, parts, motion, .. } = self;
        let rates = &state.v[state.v.len() - motion.len()..];
        parts.displacement(state, motion);
        for (sums, part) in sums.parts.iter_mut().zip(&parts.all) {
            sums.displacement = larger(sums.displacement, part.measure(motion));
            sums.kinetic = larger(sums.kinetic, part.kinetic_energy(rates));
        }
    }

    /// Measures what becomes of inertia (`in_space`) at a step of `dt` s that is sampled, where the steps before were as long;
    /// needs those before it.
    pub(super) fn add_in_space(&mut self, equations: &mut Equations, dt: f64, ends: [&State; 2]) {
        let steps = self.sums.steps;
        if !InSpace::needs(steps)
            || equations.turning.is_empty()
            || self.method != Integrator::default()
        {
            self.sums.in_space.forget();
            return;
        }
        let follow = self.sums.in_space.keep(dt, ends);
        let (Some(linearised), Some(weight), true) = (&self.linearised, weight(steps), follow)
        else {
            return;
        };
        if !self.sums.in_space.correct(&mut self.corrected) {
            return;
        }
        let middle = self.sums.in_space.middle();
        equations.change_of_inertia([middle, &self.corrected], &mut self.inertia);
        let first = self.inertia.len() - self.motion.len();
        let judged = self.steps.most();
        linearised.driven(judged, &self.inertia[first..], &mut self.within);
        linearised.driven(judged, &self.held, &mut self.before);
        let machine = equations.machine;
        let judged_parts = || {
            self.parts.all.iter().enumerate().filter(|(_, part)| {
                // A frame that never turns makes no such forces.
                let rotation = machine.bodies[part.moving().body].rotation();
                let turns = rotation
                    .is_some_and(|own| !matches!(own, Rotation::Held | Rotation::Spinning { .. }));
                turns && !part.turns()
            })
        };
        for (number, part) in judged_parts() {
            let measured = [&self.within, &self.before].map(|own| part.measure(own));
            self.sums.in_space.add(number, measured, weight);
        }
        // What holds a ring between two films cancels: what flows through it is what its bores take.
        let in_bores = |part: &Part| {
            let (start, end) = (first + part.place.start, first + part.place.end);
            let springs = &machine.springs;
            springs.bores.iter().any(|own| own.place.start < end && start < own.place.end)
        };
        if !judged_parts().any(|(_, part)| in_bores(part)) {
            return;
        }
        self.inertia.fill(0.0);
        equations.springs.add_bore_forces(&machine.springs, &mut self.inertia);
        linearised.driven(judged, &self.inertia[first..], &mut self.before);
        for (number, part) in judged_parts() {
            self.sums.in_space.add_force(number, part.measure(&self.before));
        }
    }
}
