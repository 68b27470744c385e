//! Torsion of a train: its modes, the interference diagram with what excites them, and what couplings and gears carry.
//!
//! The modes are those of the whole machine of which a part is torsion, motions sideways of gears included.

mod excitation;
mod figure;
mod files;
mod text;
mod train;

use std::fmt::Write;

use whirl_solver::Error;
use whirl_solver::bodies::Rotation;
use whirl_solver::cache::Cache;
use whirl_solver::linear::{LinearMachine, Mode};
use whirl_text::rounded;

use self::excitation::excitations;
use self::train::{Own, Train};
use super::found::{Found, drawn, followed, nothing};
use super::speeds::Wanted;
use super::words;
use crate::case::{Analysis, Case, JointKind};
use crate::errors::Failure;
use crate::machine;
use crate::signals::Interruption;

/// Share of torsion from which on a mode is one of the train.
const SHARE: f64 = 0.1;
/// Distance (m) up to which two axes are one.
const ONE_AXIS: f64 = 1e-9;
/// Modes that are looked for beside each that is asked for: most move sideways.
const BESIDE: usize = 3;

/// The machine of a train: rotations that the case prescribes are free, so that no drive holds an end of it.
///
/// # Errors
/// As [`machine::build_planned`].
pub(super) fn released(
    (case, linear): (&Case, &LinearMachine),
    of: Option<usize>,
    cache: Option<&Cache>,
) -> Result<(LinearMachine, Vec<usize>), Failure> {
    let mut bodies = linear.machine().tied_bodies();
    bodies.extend(of.filter(|of| !bodies.contains(of)));
    let mut free = case.clone();
    let prescribed = |body: &usize| case.machine.bodies[*body].rotation != Some(Rotation::Free);
    let bodies: Vec<usize> = bodies.into_iter().filter(prescribed).collect();
    for &body in &bodies {
        let own = &mut free.machine.bodies[body];
        (own.rotation, own.speeds, own.initial_speed) = (Some(Rotation::Free), None, None);
    }
    // What there is to warn of was said of the machine as it is.
    let built = machine::build_planned(&free, cache, &mut Vec::new())?;
    Ok((LinearMachine::new(built.machine)?.with_swinging_bodies(), bodies))
}

/// Modes and diagram of a train, and the torques of the machine as it is `driven`.
pub(super) fn found(
    (case, driven): (&Case, &LinearMachine),
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    released: &[usize],
    interruption: &Interruption,
    figures: bool,
) -> Result<Found, Failure> {
    let of = wanted.of.expect("a body that turns");
    let mut analysis = analysis.clone();
    analysis.ratios.resize(linear.machine().bodies.len(), None);
    for &body in released {
        let told = |body: usize| told(case, body).filter(|own| *own != 0.0);
        let known = analysis.ratios[body].is_some() || body == of;
        if let (false, Some(own), Some(first)) = (known, told(body), told(of)) {
            analysis.ratios[body] = Some(own / first);
        }
    }
    let operation = operation(case, &analysis, wanted);
    let at = linear.standing(&linear.speeds(of, operation[1], &analysis.ratios), None)?;
    let equations = linear.linearised(&at)?;
    let torsion = |mode: &Mode| linear.torsion(&equations.turning, &equations.mass, mode);
    let looked_for = analysis.count * (1 + BESIDE) + 2 * BESIDE;
    let mut modes = Vec::new();
    let all = match linear.modes_while(&equations, looked_for, &|| !interruption.asked()) {
        Err(Error::Interrupted) => return Err(nothing()),
        own => own?,
    };
    for mode in all.oscillating {
        let torsion = torsion(&mode)?;
        if torsion.share >= SHARE && modes.len() < analysis.count {
            modes.push(Own { mode, torsion });
        }
    }
    let all = excitations(case, linear, (&analysis, of), &at.speeds);
    let mut orders: Vec<f64> = all.iter().map(|own| own.order).collect();
    orders.sort_by(f64::total_cmp);
    orders.dedup();
    let looked_for = Analysis { count: looked_for, ..analysis.clone() };
    let campbell = followed(linear, (&looked_for, wanted), interruption, &orders)?;
    // Branches of torsion, each by the largest share that one of its modes has.
    let mut branches = Vec::new();
    for (place, branch) in campbell.branches.iter().enumerate() {
        let mut most = 0.0_f64;
        for mode in branch.iter().flatten() {
            most = most.max(torsion(mode)?.share);
        }
        if most >= SHARE && branches.len() < analysis.count {
            branches.push(place);
        }
    }
    let torques = match released {
        [] => linear.torques(&at),
        _ => {
            let speeds = driven.speeds(of, operation[1], &analysis.ratios);
            driven.torques(&driven.standing(&speeds, None)?)
        }
    };
    let train = Train {
        case,
        linear,
        of,
        operation,
        modes: &modes,
        excitations: &all,
        campbell: &campbell,
        branches: &branches,
        margin: analysis.margin,
    };
    let name = &analysis.name;
    let mut files = vec![
        (format!("{name}.csv"), train.rows(&torsion)?.into_bytes()),
        (format!("{name}.modes.csv"), train.shapes().into_bytes()),
        (format!("{name}.interference.csv"), train.interference().into_bytes()),
        (format!("{name}.torques.csv"), train.torques(&torques).into_bytes()),
    ];
    if figures {
        files.extend(drawn(name, &train.figure()));
    }
    let mut text = train.text(&torques);
    let before = text.len();
    let mut facts = train.facts();
    for body in released {
        let name = linear.machine().bodies[*body].name();
        let _ = writeln!(
            text,
            "note: {name} turns freely in these modes, though its speed is prescribed: a drive holds no end of a train"
        );
    }
    for own in apart(case) {
        let _ = writeln!(text, "note: {own}");
    }
    let exciting = linear.exciting_torsion(of);
    if !exciting.is_empty() {
        let _ = writeln!(
            text,
            "note: this analysis compares frequencies and has no amplitudes: of {} only the orders that `orders` names are looked at. Run the case in time for the torques that they make",
            exciting.join(", ")
        );
    }
    facts.lines(&text[before..]);
    text += &words::doubts(&campbell.doubts);
    facts.doubts(&campbell.doubts);
    Ok(Found { text, files, interrupted: campbell.interrupted, facts })
}

/// What is to be said of couplings between bodies whose axes are not the same.
fn apart(case: &Case) -> Vec<String> {
    let couplings = case.machine.joints.iter().filter(|own| own.kind == JointKind::Coupling);
    let told = couplings.filter_map(|joint| {
        let [first, second] = [0, 1].map(|side| joint.sides.get(side)?.body);
        let [first, second] = [first?, second?].map(|body| &case.machine.bodies[body]);
        if !first.turns() || !second.turns() {
            return None;
        }
        let [x, y] = [0, 1].map(|k| second.axis[k] - first.axis[k]);
        let distance = x.hypot(y);
        (distance > ONE_AXIS).then(|| {
            format!(
                "the axes of {} and {} are {} mm apart: the coupling {} carries the couple between them and no force, as one of constant \
                 speed with two universal joints does. Give both the same `axis` if that is not meant",
                first.name.text(),
                second.name.text(),
                rounded(1e3 * distance, 6),
                joint.name.text()
            )
        })
    });
    told.collect()
}

/// The speed that a case gives a body (rad/s), with its sign.
fn told(case: &Case, body: usize) -> Option<f64> {
    let own = &case.machine.bodies[body];
    match own.rotation.as_ref()? {
        Rotation::Free => own.initial_speed,
        Rotation::Prescribed { speed, .. } => Some(*speed),
        Rotation::Scheduled(own) => Some(own.at(0.0)[1]),
        Rotation::Held | Rotation::Spinning { .. } => None,
    }
}

/// Least and largest speed of operation (rad/s).
fn operation(case: &Case, analysis: &Analysis, wanted: &Wanted) -> [f64; 2] {
    let of = wanted.of.unwrap_or(0);
    let last = wanted.speeds.last().copied().unwrap_or(0.0);
    // What a drive could reach is no speed of operation, unless the case says no other.
    let given = [
        case.machine.constant_speed(of, case.run()),
        told(case, of),
        Some(case.machine.fastest(of, case.run())),
    ];
    let own = given.into_iter().flatten().find(|own| *own != 0.0);
    let in_sense = |own: f64| if last > 0.0 { own.abs() } else { own };
    match (analysis.operation.first(), analysis.operation.last()) {
        (Some(first), Some(last)) => [*first, *last],
        _ => [own.map_or(last, in_sense); 2],
    }
}
