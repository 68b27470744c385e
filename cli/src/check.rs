//! `whirl check`: what a case would run, without marching; what was found about a spec.

use std::fmt::Write;
use std::path::Path;

use whirl_solver::cache::Cache;
use whirl_solver::dynamics::AutomaticStep;

use crate::arguments::CheckArguments;
use crate::case::{Case, Joint, JointKind, LawSource};
use crate::errors::Failure;
use crate::explain;
use crate::machine;
use crate::progress::{self, ProgressMode};
use crate::{spec_file, start, streams, sweep};

/// Adds a line to a text.
macro_rules! line {
    ($text:expr, $($what:tt)*) => {
        writeln!($text, $($what)*).expect("text can be written")
    };
}

mod contacts;
mod joined;
mod round;
mod sets;

/// Reads a case and builds its machine; says counts, masses, sets, laws and what would be marched. Of a spec
/// file, says its report; of a sweep, its points.
///
/// # Errors
/// Whatever keeps the case from being marched, or is wrong with the spec.
pub(crate) fn check(arguments: &CheckArguments) -> Result<String, Failure> {
    let name = arguments.case.as_str();
    if spec_file::is_spec(name) {
        return explain::check(name);
    }
    let cache = arguments.cache.open();
    if sweep::is_sweep(name) {
        return sweep::check(Path::new(name), cache);
    }
    let case = streams::warned(|warnings| machine::read(name, warnings))?;
    let show = ProgressMode::on_terminal();
    streams::warned(|warnings| of_case(&case, (cache.as_ref(), arguments.contacts), show, warnings))
}

/// What is said of a case, of the contacts of its bores, too, if they are wanted. `warnings` are added to.
///
/// # Errors
/// Whatever keeps it from being marched.
pub(crate) fn of_case(
    case: &Case,
    (cache, contacts): (Option<&Cache>, bool),
    show: ProgressMode,
    warnings: &mut Vec<String>,
) -> Result<String, Failure> {
    let mut text = format!("{}: {}\n", case.name, case.title);
    if !case.origin.is_empty() {
        line!(text, "source: {}", case.origin);
    }
    text.push('\n');
    // Meshes are read once, and warned of once.
    let plan = machine::plan(case, warnings)?;
    plan.verify()?;
    // What only shows when the bodies are reduced and the springs placed.
    let build = || machine::build(case, &plan, cache, warnings);
    let built = progress::during(show, case.reducing(), build)?;
    joined::say(&mut text, &case.machine, &plan, &built, case.run())?;
    contacts::say_loads(&mut text, case, (&plan, contacts), cache)?;
    round::say(&mut text, case, &built)?;
    if contacts {
        contacts::say(&mut text, case, &plan, cache)?;
    }
    // What a bushing or a coupling is stands beside its joint.
    let reported = |joint: &Joint| matches!(joint.kind, JointKind::Bearing | JointKind::Stop);
    let laws = case.machine.joints.iter().zip(&plan.laws);
    let laws: Vec<&LawSource> =
        laws.filter(|(joint, _)| reported(joint)).map(|(_, law)| law).collect();
    say_laws(&mut text, &laws);
    if case.march.is_some() {
        say_march(&mut text, case);
    }
    if let Some(words) = start::described(case, &built)? {
        line!(text, "{words}");
    }
    Ok(text)
}

/// Each law once, in the order in which the case first names them.
fn say_laws(text: &mut String, laws: &[&LawSource]) {
    let mut listed: Vec<String> = Vec::new();
    for law in laws {
        if listed.contains(&law.name()) {
            continue;
        }
        listed.push(law.name());
        let spec = law.spec();
        line!(text, "\nlaw {}: {}", law.name(), spec.title);
        text.push_str(&spec.report.to_string());
    }
}

fn say_march(text: &mut String, case: &Case) {
    let march = case.march();
    let what = if march.automatic.is_some() { "rows, one every" } else { "steps of" };
    line!(
        text,
        "\n{} {what} {:e} s: {:.6} s; a cycle is {:.6} s",
        march.steps,
        march.time_step,
        march.duration(),
        march.cycle
    );
    if let Some(AutomaticStep { tolerance, longest }) = march.automatic {
        line!(
            text,
            "steps are chosen by the program, {:e} s at most, for a local error of {tolerance:e}",
            longest.min(march.time_step)
        );
    }
    if let Some(radius) = march.spectral_radius {
        line!(text, "integrated by generalized-α, spectral radius {radius}");
    }
    line!(text, "the cycle is {}", march.cycle_called);
    if march.no_common_cycle {
        line!(
            text,
            "rotation and loads have no common period: with `cycle_frequency`, write the one after which the motion \
             repeats"
        );
    }
    if march.stop_when_steady {
        line!(text, "stops at its steady state");
    }
    if march.steady_cycle().is_none() {
        line!(text, "shorter than {}: not checked for a steady state", march.steady_cycles());
    }
    if march.output_every > 1 {
        line!(text, "a row of the history every {} steps", march.output_every);
    }
}
