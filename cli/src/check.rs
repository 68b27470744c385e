//! `whirl check`: the machine of a case, without marching; what was found about a spec.

use std::fmt::Write;
use std::path::Path;

use whirl_solver::cache::Cache;

use crate::arguments::CheckArguments;
use crate::case::{Case, CaseText, Joint, JointKind, LawSource};
use crate::errors::Failure;
use crate::explain;
use crate::figures;
use crate::machine::{self, JoinedPlan};
use crate::progress::{self, ProgressMode};
use crate::{picture_file, spec_file, start, streams, sweep};

/// Adds a line to a text.
macro_rules! line {
    ($text:expr, $($what:tt)*) => {
        writeln!($text, $($what)*).expect("text can be written")
    };
}

mod analyses;
mod bodies;
mod contacts;
mod frequencies;
mod joints;
mod laws;
mod loads;
mod made;
mod marched;
mod mass;
mod meshes;
mod outputs;
mod picture;
mod round;
mod sets;
mod words;

pub(crate) use self::words::words;

/// What is reported only where it is asked for.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Wanted {
    /// How much of the compliance of its mesh each reduced body lacks.
    pub(crate) contacts: bool,
    /// All that is known of the laws.
    pub(crate) laws: bool,
}

/// Reads a case and builds its machine; describes it, and what would be marched. Of a spec file, says its report; of a
/// sweep, its points.
///
/// # Errors
/// Whatever keeps the case from being marched, or is wrong with the spec.
pub(crate) fn check(arguments: &CheckArguments) -> Result<String, Failure> {
    let name = arguments.case.as_str();
    if spec_file::is_spec(name) {
        return explain::check(name);
    }
    // Before anything is read.
    arguments.picture.as_deref().map(picture_file::is_png).transpose()?;
    let cache = arguments.cache.open();
    if sweep::is_sweep(name) {
        return sweep::check(Path::new(name), cache);
    }
    let case = streams::warned(|warnings| machine::read_to_check(name, warnings))?;
    let drawn =
        arguments.picture.as_deref().map(|file| Ok::<_, Failure>((picture::figure(&case)?, file)));
    let drawn = drawn.transpose()?;
    let show = ProgressMode::on_terminal();
    let wanted = Wanted { contacts: arguments.contacts, laws: arguments.laws };
    // Branches read the case again, with other values.
    let text = CaseText::find(name, None)?;
    let said = |warnings: &mut Vec<String>| {
        of_case((&case, Some(&text)), (cache.as_ref(), wanted), show, warnings)
    };
    let text = streams::warned(said)?;
    if let Some((figure, file)) = drawn {
        picture_file::write(figures::svg(&figure), file)?;
    }
    Ok(text)
}

/// What is said of a case: what an engineer asks of a machine first, then how it is computed. `warnings` are added to.
///
/// # Errors
/// Whatever keeps it from being marched.
pub(crate) fn of_case(
    (case, read_from): (&Case, Option<&CaseText>),
    (cache, wanted): (Option<&Cache>, Wanted),
    show: ProgressMode,
    warnings: &mut Vec<String>,
) -> Result<String, Failure> {
    let mut text = format!("{}: {}\n", case.name, case.title);
    if !case.origin.is_empty() {
        line!(text, "source: {}", case.origin);
    }
    // Meshes are read once, and warned of once.
    let plan = machine::plan(case, warnings)?;
    plan.verify()?;
    // What only shows when the bodies are reduced and the springs placed.
    let build = || machine::build(case, &plan, cache, warnings);
    let built = progress::during(show, case.reducing(), build)?;
    let machine = &*case.machine;
    if machine.is_mass() {
        mass::say(&mut text, machine, &plan);
    } else {
        bodies::say(&mut text, machine, &plan)?;
        frequencies::say(&mut text, machine, &built, case.run())?;
        round::say(&mut text, case, &built)?;
        bodies::say_speeds(&mut text, machine, case);
        joints::say(&mut text, machine, &plan);
        loads::say(&mut text, machine);
    }
    if let Some(words) = start::described(case, &built)? {
        line!(text, "\nStart\n{words}");
    }
    match &case.march {
        Some(march) => line!(text, "\nTime\n{}", marched::lines(march).join("\n")),
        None if case.analyses.is_empty() => line!(
            text,
            "\nTime\nno `[march]`, which `whirl run` needs; `whirl modes`, `campbell`, `response`, … do not"
        ),
        None => {}
    }
    if !machine.is_mass() {
        meshes::say(&mut text, machine, &plan, &built)?;
        contacts::say_loads(&mut text, case, (&plan, wanted.contacts), cache)?;
        if wanted.contacts {
            contacts::say(&mut text, case, &plan, cache)?;
        }
    }
    analyses::warn((case, read_from), &built, cache, warnings)?;
    laws::say(&mut text, &laws_of(case, &plan), wanted.laws);
    Ok(text)
}

/// The laws that a reader of the case has chosen: what a bushing or a coupling is stands beside its joint.
fn laws_of(case: &Case, plan: &JoinedPlan) -> Vec<LawSource> {
    let chosen = |joint: &Joint| matches!(joint.kind, JointKind::Bearing | JointKind::Stop);
    let laws = case.machine.joints.iter().zip(&plan.laws).filter(|(joint, _)| chosen(joint));
    laws.map(|(_, law)| law.clone()).collect()
}
