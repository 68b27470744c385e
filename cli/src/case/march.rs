//! Time step, duration and tolerances.

use std::f64::consts::TAU;

use whirl_codegen::diagnostic::Code;

use super::SystemDraft;
use super::reader::Reader;
use super::schema::MOST_STEPS;

/// How a case is marched in time.
#[derive(Debug, Clone)]
pub struct March {
    /// Δt in s.
    pub time_step: f64,
    /// Steps.
    pub steps: usize,
    /// Largest change of a spring force between iterations, in N, at which a step has converged.
    pub force_tolerance: f64,
    /// Period over which steady state is judged and results are summed up, in s.
    pub cycle: f64,
}

impl March {
    /// End of the analysis in s.
    pub fn duration(&self) -> f64 {
        self.time_step * self.steps as f64
    }
}

/// Of the reference histories: far below every force of interest, far above rounding.
const FORCE_TOLERANCE: f64 = 1e-3;

pub(super) fn read(file: &Reader, system: &SystemDraft) -> Option<March> {
    let march = file.table("march")?;
    let time_step = march.quantity_or_one("time_step");
    let steps = steps(&march, time_step);
    let force_tolerance = march.quantity("force_tolerance").unwrap_or(FORCE_TOLERANCE);
    let cycle = match march.quantity("cycle_frequency") {
        Some(frequency) => 1.0 / frequency,
        None => natural_cycle(system).unwrap_or(time_step * steps as f64),
    };
    Some(March { time_step, steps, force_tolerance, cycle })
}

/// The longest period of the loads, or else two revolutions at the speed that the drive aims at; one
/// revolution of an unbalance.
fn natural_cycle(system: &SystemDraft) -> Option<f64> {
    let rotor = match system {
        SystemDraft::Rotor(rotor) => rotor,
        SystemDraft::Lumped(lumped) => {
            return lumped.as_ref()?.unbalance.map(|own| TAU / own.speed);
        }
    };
    let lowest = rotor.loads.iter().filter_map(|load| load.frequency).reduce(f64::min);
    let drive = rotor.drive.as_ref().filter(|drive| drive.acts && drive.target_speed != 0.0);
    let two_revolutions = drive.map(|drive| 2.0 * TAU / drive.target_speed.abs());
    lowest.map(|frequency| 1.0 / frequency).or(two_revolutions)
}

fn steps(march: &Reader, time_step: f64) -> usize {
    let (steps, duration) = (march.count("steps"), march.quantity("duration"));
    match (march.has("steps"), march.has("duration")) {
        (true, true) => march.conflict("steps", "duration"),
        (false, false) => march.absent("steps", "add `steps = 1000` or `duration = \"0.1 s\"`"),
        _ => {}
    }
    let Some(duration) = duration else { return steps.unwrap_or(1) };
    let whole = (duration / time_step).round().max(1.0);
    if steps.is_none() && march.has("time_step") && whole > MOST_STEPS as f64 {
        let most = MOST_STEPS as f64;
        let message = format!(
            "`duration` takes {} steps of `time_step`, more than the {MOST_STEPS} that are allowed",
            plain(whole)
        );
        let help = format!(
            "lower `duration` to {} s at most, or raise `time_step` to {} s at least",
            plain(most * time_step),
            plain(duration / most)
        );
        let place = march.places().remove("duration");
        let place = place.unwrap_or_else(|| march.place().text(""));
        march.push(place.error_here(Code::BAD_VALUE, message).help(help));
        return 1;
    }
    steps.unwrap_or(whole as usize)
}

/// A number without the digits that rounding adds.
fn plain(value: f64) -> String {
    let rounded: f64 = format!("{value:.9e}").parse().unwrap_or(value);
    if (1e-4..1e9).contains(&rounded) { format!("{rounded}") } else { format!("{rounded:e}") }
}
