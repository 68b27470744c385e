//! How good the steps of a march are: the energy that they make, their local error, what is left in their rows.

use super::film_rates::FilmRates;
use super::halvings::HalvedSteps;
use super::moving_part::MovingPart;
use super::periods::FewestSteps;
use super::rings::Ringing;
use super::state_errors::StateError;

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
    /// as a fraction of its largest elastic force.
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
    pub films: Option<FilmRates>,
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
