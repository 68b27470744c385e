//! The start of a march: at rest, in equilibrium, or from the state in which another run ended.

use std::fs;
use std::io;
use std::path::Path;

use whirl_solver::Error;
use whirl_solver::cache::{Key, pack, unpack, write_whole};
use whirl_solver::dynamics::{
    BodyStart, Equilibrium, LastState, March, MarchOptions, NewtonOptions, equilibrium,
};
use whirl_solver::machine::Machine;

use crate::case::{Case, Start};
use crate::errors::Failure;
use crate::machine::Built;
use crate::results::STATE;
use crate::watch::Watch;

/// Layout of the file.
const LAYOUT: &str = "whirl state 11";

/// How a case is marched.
pub(crate) fn options(case: &Case, built: &Built) -> MarchOptions {
    MarchOptions {
        time_step: case.march().time_step,
        automatic: case.march().automatic,
        steps: case.march().steps,
        integrator: case.march().integrator,
        newton: NewtonOptions {
            force_tolerance: case.march().force_tolerance,
            ..NewtonOptions::default()
        },
        cycle: case.march().steady_cycle(),
        steady_rule: case.march().steady_rule,
        stop_when_steady: case.march().stop_when_steady,
        initial: built.initial.clone(),
        laws_at_rest: matches!(case.start, Start::Equilibrium),
    }
}

/// The march of a case, whose results go to `out` if they go to a folder, before its first step.
///
/// # Errors
/// No equilibrium, or no state that fits.
pub(crate) fn begin<'m>(
    (case, built): (&Case, &'m Built),
    options: &MarchOptions,
    out: Option<&Path>,
    watch: &dyn Watch,
) -> Result<March<'m>, Failure> {
    let machine = &built.machine;
    let initial = match &case.start {
        Start::State(folder) => {
            let (last, sound) = read(Path::new(folder.text()), out)?;
            let march = March::from_last(machine, options, &last);
            let march = march.map_err(|error| refused(folder.text(), error))?;
            watch.note(&going_on(folder.text(), &last, machine));
            if !sound {
                watch.warn(&format!(
                    "this run continues the run in `{}`, whose verdict is NOT SOUND",
                    folder.text()
                ));
            }
            return Ok(march);
        }
        Start::After(state) => {
            let (last, _) = unpacked(state).expect("it was packed by this program");
            return March::from_last(machine, options, &last).map_err(Failure::from);
        }
        Start::Rest => rest(case, built),
        Start::Equilibrium => {
            let found = equilibrium(machine, &speeds(case), options.equal_step())?;
            watch.note(&words(case, &found));
            found.bodies
        }
    };
    beyond(built, &initial).iter().for_each(|words| watch.warn(words));
    let options = MarchOptions { initial, ..options.clone() };
    March::new(machine, &options).map_err(|failure| failure.error.into())
}

/// What a case says of its start, if that is not at rest, in words.
///
/// # Errors
/// As [`begin`].
pub(crate) fn described(case: &Case, built: &Built) -> Result<Option<String>, Failure> {
    Ok(match &case.start {
        Start::Rest | Start::After(_) => None,
        Start::Equilibrium => {
            let step = case.march.as_ref().and_then(|_| options(case, built).equal_step());
            Some(words(case, &equilibrium(&built.machine, &speeds(case), step)?))
        }
        Start::State(folder) => {
            let (last, _) = read(Path::new(folder.text()), None)?;
            last.check(&built.machine).map_err(|error| refused(folder.text(), error))?;
            if let (Some(fields), Some(march)) = (&case.fields, &case.march) {
                fields.check_times([last.time(), last.time() + march.duration()])?;
            }
            Some(going_on(folder.text(), &last, &built.machine))
        }
    })
}

/// A state that does not fit, with its folder.
fn refused(folder: &str, error: Error) -> Failure {
    match error {
        Error::OtherBodies(_) | Error::OtherRotation { .. } => {
            Failure::NoState { folder: folder.into(), reason: error.to_string() }
        }
        error => error.into(),
    }
}

/// Lets a case begin with the state in which another point of its sweep ended, packed: the times of its fields are as far behind
/// that as they were behind the start that it gives.
pub(crate) fn go_on(case: &mut Case, state: &[u8]) {
    let (last, _) = unpacked(state).expect("it was packed by this program");
    let begun = match &case.start {
        Start::State(folder) => {
            read(Path::new(folder.text()), None).map_or(0.0, |own| own.0.time())
        }
        Start::Rest | Start::Equilibrium | Start::After(_) => 0.0,
    };
    if let Some(fields) = &mut case.fields {
        fields.shift(last.time() - begun);
    }
    case.start = Start::After(state.into());
}

/// What a case goes on from, in words, where that is not sound by its own verdict.
pub(crate) fn unsound(start: &Start) -> Option<String> {
    let (sound, words) = match start {
        Start::Rest | Start::Equilibrium => return None,
        Start::State(folder) => {
            let (_, sound) = read(Path::new(folder.text()), None).ok()?;
            (sound, format!("the run in {}", folder.text()))
        }
        Start::After(state) => {
            let (_, sound) = unpacked(state)?;
            (sound, "the point before this one".to_owned())
        }
    };
    (!sound).then_some(words)
}

fn going_on(folder: &str, last: &LastState, machine: &Machine) -> String {
    let time = whirl_text::shown(last.time(), 6, 1e-4..1e6);
    let anew = match last.begins_anew(machine) {
        true => "; what laws and films remember begins anew, as they are others here",
        false => "",
    };
    format!("going on from {folder} at t = {time} s{anew}")
}

/// Bodies at rest, but for speeds that the case gives.
fn rest(case: &Case, built: &Built) -> Vec<BodyStart> {
    let mut initial = built.initial.clone();
    initial.resize(built.machine.bodies.len(), BodyStart::default());
    for (own, speed) in initial.iter_mut().zip(speeds(case)) {
        own.speed = speed.unwrap_or(own.speed);
    }
    initial
}

/// Couples that end before they begin, as the body is at their target at the start.
fn beyond(built: &Built, initial: &[BodyStart]) -> Vec<String> {
    let rpm = |speed: f64| whirl_text::rounded(speed * 60.0 / std::f64::consts::TAU, 6);
    let idle = built.machine.loads.iter().filter_map(|load| {
        let (speed, target) = (initial.get(load.body)?.speed, load.target()?.speed);
        let name = built.machine.bodies[load.body].name();
        load.reaches(speed).then(|| {
            format!(
                "the couple on `{name}` until {} rpm never acts: the run starts at {} rpm, at its target or beyond",
                rpm(target),
                rpm(speed)
            )
        })
    });
    idle.collect()
}

/// Speeds of the bodies at t = 0 (rad/s), where the case gives them, in the order of the machine.
fn speeds(case: &Case) -> Vec<Option<f64>> {
    case.machine.bodies.iter().map(|body| body.initial_speed).collect()
}

/// What was found, in words: speeds that the case leaves open, and where journals stand.
fn words(case: &Case, found: &Equilibrium) -> String {
    let mut parts = Vec::new();
    for (body, own) in case.machine.bodies.iter().zip(&found.bodies) {
        if body.is_free() && body.initial_speed.is_none() {
            let rpm = own.speed * 60.0 / std::f64::consts::TAU;
            let speed = whirl_text::shown(rpm, 5, 1e-3..1e7);
            parts.push(format!("{} turns at {speed} rpm", body.name.text()));
        }
        if own.angle != 0.0 {
            let angle = whirl_text::shown(own.angle.to_degrees(), 5, 1e-3..1e6);
            parts.push(format!("{} is at {angle} deg", body.name.text()));
        }
    }
    for (name, ratio) in &found.eccentricities {
        if let Some(ratio) = ratio {
            parts.push(format!("{:.3} in {name}", ratio));
        }
    }
    let what = if found.eccentricities.iter().any(|(_, ratio)| ratio.is_some()) {
        " (eccentricity ratio)"
    } else {
        ""
    };
    let found =
        if parts.is_empty() { String::new() } else { format!(": {}{what}", parts.join(", ")) };
    format!("starting in equilibrium{found}")
}

/// Writes the state after the last step of a run, with whether the run is sound.
///
/// # Errors
/// It cannot be written.
pub(crate) fn write(path: &Path, state: &LastState, sound: bool) -> io::Result<()> {
    write_whole(path, &packed(state, sound)?)
}

/// The bytes of such a file.
///
/// # Errors
/// The state refuses to be serialised.
pub(crate) fn packed(state: &LastState, sound: bool) -> io::Result<Vec<u8>> {
    pack(&Key::of(&LAYOUT), &(state, sound))
}

/// Time of the state (s) of the bytes of such a file.
///
/// # Errors
/// They are those of no such file.
pub(crate) fn time_of(bytes: &[u8]) -> Result<f64, Failure> {
    let reason = || format!("`{STATE}` is damaged, or of another version of the program");
    let failure = || Failure::NoState { folder: Path::new(".").into(), reason: reason() };
    unpacked(bytes).map(|(state, _)| state.time()).ok_or_else(failure)
}

fn unpacked(bytes: &[u8]) -> Option<(LastState, bool)> {
    unpack(&Key::of(&LAYOUT), bytes)
}

/// The state in which the run in a folder ended, and whether that run is sound; `out`: where the results of this run go.
fn read(folder: &Path, out: Option<&Path>) -> Result<(LastState, bool), Failure> {
    let missing = |reason: String| Failure::NoState { folder: folder.to_path_buf(), reason };
    if let (Ok(from), Some(Ok(to))) = (folder.canonicalize(), out.map(Path::canonicalize))
        && from == to
    {
        return Err(missing("the results of this run go there, too".to_owned()));
    }
    let bytes = fs::read(folder.join(STATE)).map_err(|error| match error.kind() {
        io::ErrorKind::NotFound if !folder.is_dir() => missing(
            "there is no such folder; the path is relative to the folder in which the command is run, like that of results"
                .to_owned(),
        ),
        io::ErrorKind::NotFound => {
            missing(format!("it has no `{STATE}`, which only a finished run leaves"))
        }
        _ => missing(format!("cannot read `{STATE}`: {error}")),
    })?;
    let damaged = || missing(format!("`{STATE}` is damaged, or of another version of the program"));
    unpacked(&bytes).ok_or_else(damaged)
}
