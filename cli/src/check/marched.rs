//! What `whirl check` says of the march of a case.

use whirl_solver::dynamics::AutomaticStep;

use crate::case::MarchSettings;

/// Its steps, its cycle and how it ends, a line each.
pub(super) fn lines(march: &MarchSettings) -> Vec<String> {
    let what = if march.automatic.is_some() { "rows, one every" } else { "steps of" };
    let mut lines = vec![format!(
        "{} {what} {:e} s: {:.6} s; a cycle is {:.6} s",
        march.steps,
        march.time_step,
        march.duration(),
        march.cycle
    )];
    if let Some(AutomaticStep { tolerance, longest }) = march.automatic {
        let longest = longest.min(march.time_step);
        lines.push(format!(
            "the program chooses the steps, at most {longest:e} s, for a local error of {tolerance:e}"
        ));
    }
    if let Some(radius) = march.spectral_radius {
        lines.push(format!("integrated by generalized-α with spectral radius {radius}"));
    }
    lines.push(format!("the cycle is {}", march.cycle_called));
    if march.no_common_cycle {
        lines.push(
            "rotation and loads have no common period: give the frequency at which the motion repeats as \
             `cycle_frequency`"
                .to_owned(),
        );
    }
    if march.stop_when_steady {
        lines.push("the run stops at its steady state".to_owned());
    }
    if march.steady_cycle().is_none() {
        let cycles = march.steady_cycles();
        lines.push(format!("shorter than {cycles}: not checked for a steady state"));
    }
    if march.output_every > 1 {
        lines.push(format!("a row of the history every {} steps", march.output_every));
    }
    lines
}
