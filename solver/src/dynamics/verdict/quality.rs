//! How good the steps of a march are: the energy that they make, their local error, what is left in their rows.

use super::film_meter::FilmQuality;
use super::part_sums::PartSums;
use super::periods::FewestSteps;
use super::quality_meter::QualityMeter;
use super::rings::Ringing;
use super::state_errors::StateError;
use super::turn_sums::TurnSums;
use super::windows::Windows;
use crate::bearing::work::MOTIONS;
use crate::dynamics::iteration::HalvedSteps;
use crate::dynamics::motion::{
    MovingPart, Part, SMALLEST, larger, largest_eigenvalue, largest_sensible, ratio, worse,
};
use crate::equations::Equations;

/// ωΔt that counts as resolved, for [`Quality::mode_step`].
const RESOLVED: f64 = 0.3;
/// √λ Δt of a contact that makes no more energy than it may wherever in a step it begins, for [`Quality::resolving_step`]:
/// (ωΔt)²/4 of what it takes where that is in the middle.
const IMPACT: f64 = 0.28;

/// Share of the energy in play in the bodies of a bearing that may be made there, or lost, whatever flows through it.
const NEGLIGIBLE: f64 = 1e-3;

/// What the steps of a march were worth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Quality {
    /// Energy made at the springs of a bearing as a fraction of what flowed there, at the bearing and in the part of
    /// the march where it is largest; see `Windows::fraction`.
    pub energy_made_share: f64,
    /// The bearing where it is largest, counted from 0; none where no energy was made.
    pub bearing: Option<usize>,
    /// Energy that steps made or destroyed at that bearing, summed without sign (J).
    pub energy_made: f64,
    /// Energy that flowed into that bearing and out of it, summed without sign (J).
    pub energy_flowed: f64,
    /// Local error of a step that 95 % of the steps stay below, in the modes that the step resolves (ωΔt < 1), of
    /// the part of the machine where it is the largest fraction of the largest displacement of the part. A part is the
    /// deformation and the motion of a body, in the norm of its mass matrix, or a rotation: against others where joints hold
    /// it, else by how far it departs from a uniform one.
    pub local_error: f64,
    /// The part where it is that.
    pub local_error_of: Option<MovingPart>,
    /// Whether the local error of any part could be judged: whether there was one that steps resolve.
    pub judged: bool,
    /// The largest local error of any part: of the first 128 steps and of one in 32 after.
    pub largest_local_error: f64,
    /// Motion in a step, in modes that the step does not resolve (ωΔt ≥ 1), that 95 % of the steps stay below, of the
    /// part where it is the largest fraction of the largest displacement of the part.
    pub unresolved_motion: f64,
    /// The part where it is that.
    pub unresolved_motion_of: Option<MovingPart>,
    /// False inertia forces of motion that stands or is slow in space, of a body that turns, that 95 % of the steps stay below,
    /// as a fraction of the largest force that holds it.
    pub inertia_error: f64,
    /// The part where it is that.
    pub inertia_error_of: Option<MovingPart>,
    /// The largest displacement of a body, root mean square over its mass (m), and the body.
    pub largest_displacement: f64,
    /// The body where it is that.
    pub farthest: Option<usize>,
    /// The largest displacement that can be meant (m).
    pub sensible_displacement: f64,
    /// What changes its sign from step to step.
    pub ringing: Ringing,
    /// The worst local error of the states of laws; none without states.
    pub states: Option<StateError>,
    /// Whether steps follow the gaps of films; none without films.
    pub films: Option<FilmQuality>,
    /// Largest residual of a row over what it may have; see `Equations::row_error`.
    pub row_error: f64,
    /// Steps that had to be halved, as they could not be solved.
    pub halved: HalvedSteps,
    /// A step that resolves the machine with the springs as they were when most energy was made (s):
    /// 0.28/√λ, λ the largest eigenvalue of M⁻¹K; none if no energy was made.
    pub resolving_step: Option<f64>,
    /// A step that resolves all modes of the machine at the start: 0.3/ω of the fastest (s); none where all are
    /// resolved.
    pub(crate) mode_step: Option<f64>,
    /// Where a load that follows an angle had the fewest steps in a period; none where no load does.
    pub fewest_steps: Option<FewestSteps>,
}

impl QualityMeter {
    /// What the steps so far were worth; forces of springs are known to `unknown` (N).
    pub(crate) fn quality(
        &mut self,
        equations: &mut Equations,
        flows: &Windows,
        unknown: f64,
    ) -> Quality {
        self.judge_rest(equations);
        let sums = &self.sums;
        let places = 0..MOTIONS * equations.machine.springs.bearings;
        let fractions = places.map(|place| {
            let least = NEGLIGIBLE * self.in_play(equations, place / MOTIONS);
            (place, flows.fraction(place, least, unknown).abs())
        });
        // No number is larger than any.
        let worst =
            fractions.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, fraction)| *fraction != 0.0);
        let flow = worst.map(|(place, _)| flows.whole(place)).unwrap_or_default();
        let ends =
            worst.map(|(place, _)| &sums.worst[place / MOTIONS]).filter(|own| own.made > 0.0);
        let eigenvalues = ends.into_iter().flat_map(|own| &own.ends).filter_map(|(t, state)| {
            let value = largest_eigenvalue(equations, *t, state);
            (value > 0.0).then_some(value)
        });
        let largest = eigenvalues.reduce(f64::max);
        let parts = || sums.parts.iter().zip(&self.parts.all);
        let most = parts().map(|(sums, part)| sums.reach.min(part.most())).fold(0.0, larger);
        let least = SMALLEST * most;
        // The largest fraction of what moves, and the part where it is; turns have errors only.
        let judge = |of: &dyn Fn(&PartSums) -> f64, of_turn: &dyn Fn(&TurnSums) -> f64| {
            let judged = parts().map(|(sums, part)| {
                let amplitude = larger(sums.reach.min(part.most()), least);
                (ratio(of(sums), amplitude), part.moving())
            });
            let turns = sums.turns.iter().zip(&self.parts.turns).map(|(sums, turn)| {
                let way = turn.radius * sums.reach(self.steps.most());
                let part = MovingPart { body: turn.body, turns: true };
                (ratio(turn.radius * of_turn(sums), larger(way, least)), part)
            });
            let all = judged.chain(turns);
            all.fold((0.0, None), |worst, (value, part)| worse(worst, (value, Some(part))))
        };
        // Classes round up.
        let (local_error, local_error_of) =
            judge(&|sums| sums.errors.below(0.95).min(sums.largest_error), &TurnSums::error);
        let (unresolved_motion, unresolved_motion_of) =
            judge(&|sums| sums.motions.below(0.95), &|_| 0.0);
        let false_inertia = self.parts.all.iter().enumerate();
        let false_inertia =
            false_inertia.map(|(place, part)| (sums.in_space.error(place), part.moving()));
        let (inertia_error, inertia_error_of) = false_inertia
            .fold((0.0, None), |worst, (value, part)| worse(worst, (value, Some(part))));
        let bodies = parts().filter(|(_, part)| !part.turns());
        let farthest = bodies.max_by(|a, b| a.0.displacement.total_cmp(&b.0.displacement));
        let displacement = farthest.map_or(0.0, |(sums, _)| sums.displacement);
        let fastest = sums.fastest;
        Quality {
            energy_made_share: worst.map_or(0.0, |(_, fraction)| fraction),
            bearing: worst.map(|(place, _)| place / MOTIONS),
            energy_made: flow.made,
            energy_flowed: flow.flowed,
            local_error,
            local_error_of,
            judged: sums.steps == 0
                || sums.parts.is_empty()
                || sums.parts.iter().any(|own| own.errors.count() > 0)
                || sums.turns.iter().any(TurnSums::is_judged),
            largest_local_error: judge(&|sums| sums.largest_error, &|sums| sums.largest_error).0,
            unresolved_motion,
            unresolved_motion_of,
            inertia_error,
            inertia_error_of,
            largest_displacement: displacement,
            farthest: farthest.map(|(_, part): (_, &Part)| part.body),
            sensible_displacement: largest_sensible(equations.machine),
            ringing: Ringing::default(),
            states: None,
            films: None,
            row_error: sums.row_error,
            halved: HalvedSteps::default(),
            resolving_step: largest.map(|value| IMPACT / value.sqrt()),
            mode_step: (fastest * self.steps.most() >= 1.0).then_some(RESOLVED / fastest),
            fewest_steps: None,
        }
    }

    /// The energy in play in the bodies that a bearing joins: the most kinetic energy that each had, of the one that had less (J).
    /// What flows in others says nothing of this bearing.
    fn in_play(&self, equations: &Equations, bearing: usize) -> f64 {
        let joined = &equations.machine.monitors[bearing].bodies;
        let parts = self.sums.parts.iter().zip(&self.parts.all);
        let own = parts.filter(|(_, part)| !part.turns() && joined.contains(&part.body));
        own.map(|(sums, _)| sums.kinetic).reduce(f64::min).unwrap_or(0.0)
    }
}
