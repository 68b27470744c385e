//! Errors of a cycle at the words of the case that are to blame.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::Error;
use whirl_solver::error::PeriodicError;
use whirl_solver::periodic::GROUND_MOTION;

use crate::analysis::found::nothing;
use crate::case::Case;
use crate::errors::Failure;

/// The error, with its place and what to do, where it is one of the case.
pub(super) fn of(case: &Case, error: Error) -> Failure {
    let Error::Periodic(own) = &error else { return error.into() };
    let at = |place: Option<&Located>, help: &str| match place {
        Some(place) => {
            let found = place.error_here(Code::BAD_VALUE, own.to_string()).help(help);
            Failure::Input(found.into())
        }
        None => Failure::Argument { message: own.to_string(), help: help.to_owned() },
    };
    match own {
        PeriodicError::TurnsFreely { body } => {
            let help = "give its speed in the analysis, `speeds = \"3000 rpm\"`, which then is prescribed, or a ratio to that in \
                        `ratios`; a drive that ends at a speed has no cycle";
            at(body_called(case, body), help)
        }
        PeriodicError::SpeedChanges { body } => {
            let help = "give a constant speed in the analysis: `speeds = \"3000 rpm\"`, or a range of them";
            at(body_called(case, body), help)
        }
        PeriodicError::NotWhole { body, .. } => {
            let help = "give speeds whose ratios are those of small whole numbers, by `ratios`; several periods make a cycle by \
                        `periods`";
            at(body_called(case, body), help)
        }
        PeriodicError::OneOff { load } if load == GROUND_MOTION => {
            let help = "a record of the ground ends: march it (`whirl run`), or leave out `[ground_motion]`";
            at(None, help)
        }
        PeriodicError::OneOff { load } => {
            let help = "give the load a `period`, after which its table begins anew, or take it out of the case";
            at(load_called(case, load), help)
        }
        PeriodicError::NotRepeated { load, .. } => {
            let help = "let it repeat after a period that it has in common with the rest, or take it out of the case";
            at(load_called(case, load), help)
        }
        PeriodicError::NoCommon { all, .. } => {
            let help = "change one of them so that their ratio is one of small whole numbers, to all digits: for a load that goes \
                        with a rotation write `order` in place of `frequency`";
            let place = all.iter().find_map(|name| load_called(case, name));
            at(place, help)
        }
        PeriodicError::Remembers { .. } => at(
            None,
            "with loads or an unbalance: `method = \"accelerated\"` or `\"shooting\"`, which close states as well; a motion of the \
             machine itself: march it until it repeats itself (`whirl run`, `stop_when_steady`)",
        ),
        PeriodicError::ManyValues { .. } => at(
            None,
            "ask for single motions (`speeds`, or `whirl sweep --vary`) in place of `vary`, or give the film a coarser `grid`",
        ),
        PeriodicError::NoFrequency => {
            at(None, "say about which frequency the motion has: `near = \"24 Hz\"`")
        }
        PeriodicError::LeftOut { times, .. } => {
            let help = format!(
                "give at least `harmonics = {times}`, or leave it out: as many as are enough are taken then"
            );
            at(None, &help)
        }
        PeriodicError::NothingRepeats => at(None, "give a body a speed, or a load a frequency"),
        PeriodicError::Driven { .. } => at(
            None,
            "leave out `self_excited`, or take out of the case what turns or varies: unbalance, run-out, loads, motion of the ground",
        ),
        PeriodicError::DiesOut
        | PeriodicError::NotFound { .. }
        | PeriodicError::NotBalanced { .. }
        | PeriodicError::NoMachine { .. }
        | PeriodicError::Interrupted { .. } => error.into(),
    }
}

/// Refuses laws with jumps: the derivative of a cycle knows nothing of them.
///
/// # Errors
/// There are some, each at the place where a joint names it.
pub(super) fn without_jumps(case: &Case) -> Result<(), Failure> {
    let mut errors = Diagnostics::new();
    for joint in &case.machine.joints {
        let law = &joint.bearing.law;
        let Some(output) = law.source.accepts_jump() else { continue };
        let message = format!(
            "`{output}` of the law of `{}` jumps: the multipliers of a motion that passes there are not those of its derivative",
            joint.name.text()
        );
        let help = "let the law go from one value to the other over a small range, without `jump = \"accept\"`";
        errors.push(law.name.error_here(Code::BAD_VALUE, message).help(help));
    }
    errors.into_result(()).map_err(Failure::from)
}

fn body_called<'c>(case: &'c Case, name: &str) -> Option<&'c Located> {
    case.machine.bodies.iter().map(|own| &own.name).find(|own| own.text() == name)
}

fn load_called<'c>(case: &'c Case, name: &str) -> Option<&'c Located> {
    let of = |kind: &str| name.strip_prefix(kind).and_then(|rest| rest.strip_prefix('.'));
    let load = of("load").and_then(|name| {
        case.machine.loads.iter().map(|own| &own.name).find(|own| own.text() == name)
    });
    let drive = || {
        let name = of("drive")?;
        case.machine.drives.iter().map(|own| &own.name).find(|own| own.text() == name)
    };
    load.or_else(drive)
}

/// Whether it says that at this speed there is no motion, as there may be at others.
pub(super) fn not_there(error: &Error) -> bool {
    matches!(
        error,
        Error::Periodic(
            PeriodicError::NotFound { .. }
                | PeriodicError::NotBalanced { .. }
                | PeriodicError::DiesOut
        ) | Error::NewtonDiverged { .. }
            | Error::NoForce { .. }
    )
}

/// That there is no motion, and where else to look for it.
pub(super) fn unfound(reason: String, self_excited: bool) -> Failure {
    let own = "look for it beyond the threshold at which the machine begins to move by itself (`whirl stability`), in more `cycles`, from \
               another `begin`, with more `harmonics`, or `near` its frequency, after more `marched` stretches";
    let help = "look for it from another `begin`, after more `marched` cycles, with more `steps` or the other `method`; if the motion \
                repeats after several periods, say so by `periods = 2`";
    let help = if self_excited { own } else { help };
    Failure::Unfinished { reason, kept: None, help: Some(help.to_owned()) }
}

/// Why there is nothing, where that is an error of the solver.
pub(super) fn failed(case: &Case, error: Error) -> Failure {
    match error {
        Error::Periodic(PeriodicError::Interrupted { .. }) => nothing(),
        error if not_there(&error) => unfound(error.to_string(), false),
        error => of(case, error),
    }
}
