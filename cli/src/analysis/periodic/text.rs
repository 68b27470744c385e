//! Periodic motions for people.

use std::f64::consts::TAU;
use std::fmt::Write;

use whirl_solver::periodic::{Method, Multiplier, MultiplierKind, Periodic, Stability, StepError};
use whirl_text::shown;

use super::motions::{Motion, Motions, range};
use crate::analysis::words;
use crate::report::table;

/// Steps that a contact needs so that multipliers are to be believed.
const CONTACT: usize = 35;
/// By what a march over a cycle may differ from its harmonics.
const MARCHED: f64 = 0.02;
/// What steps half as long may change.
const CHANGE: f64 = 0.01;

/// As files and texts call a method.
pub(super) fn method(own: Method) -> &'static str {
    match own {
        Method::Accelerated => "accelerated",
        Method::Shooting => "shooting",
        Method::Harmonic => "harmonic",
    }
}

/// What files call a verdict on stability.
pub(super) fn stability(own: Stability) -> &'static str {
    match own {
        Stability::Stable => "stable",
        Stability::Diverges => "unstable: real multiplier above 1",
        Stability::Doubles => "unstable: real multiplier below -1",
        Stability::Wanders => "unstable: pair of multipliers outside the unit circle",
        Stability::Undecided => "undecided",
    }
}

/// Whether it is stable, if that is decided.
pub(super) fn is_stable(own: Stability) -> Option<bool> {
    match own {
        Stability::Stable => Some(true),
        Stability::Undecided => None,
        _ => Some(false),
    }
}

/// The largest multiplier of the motion itself.
pub(super) fn leading(own: &Periodic) -> Option<&Multiplier> {
    own.multipliers.iter().find(|own| own.kind == MultiplierKind::Motion)
}

/// All of it.
pub(super) fn of(motions: &Motions) -> String {
    let mut text = format!("{}: {}\n", motions.case.name, motions.case.title);
    match motions.all.as_slice() {
        [one] => text.push_str(&alone(motions, one)),
        all => text.push_str(&each(motions, all)),
    }
    for own in notes(motions) {
        let _ = writeln!(text, "note: {own}");
    }
    text
}

fn body<'m>(motions: &'m Motions) -> &'m str {
    motions.of.map_or("", |of| motions.case.machine.bodies[of].name.text())
}

/// A motion in full.
fn alone(motions: &Motions, motion: &Motion) -> String {
    let Motion { periodic, repeating, verdict, .. } = motion;
    let mut text = String::new();
    if let Some(speed) = motion.speed {
        let _ = writeln!(text, "{} at {} rpm", body(motions), words::speed(speed));
    }
    let cycle = periodic.cycle;
    let what = repeating.iter().map(|own| {
        let times = shown(own.hertz * cycle.period, 6, 1e-3..1e6);
        format!("{times} of {}", own.what)
    });
    let _ = writeln!(
        text,
        "a cycle of {} ms: {}; {} steps of {} s",
        shown(1e3 * cycle.period, 6, 1e-3..1e7),
        what.collect::<Vec<_>>().join(", "),
        cycle.steps,
        shown(cycle.time_step(), 6, 1e-4..1e3)
    );
    let _ = match &periodic.harmonics {
        None => writeln!(
            text,
            "found in {} cycles ({}): it misses its start by {:.1e} of itself",
            periodic.cycles,
            method(periodic.method),
            periodic.miss
        ),
        Some(own) => writeln!(
            text,
            "{} harmonic{} balanced at {} instants, in {} corrections after {} cycles: the last changed it by {:.1e} of itself",
            own.count,
            if own.count == 1 { "" } else { "s" },
            own.instants,
            own.corrections,
            periodic.cycles,
            periodic.miss
        ),
    };
    let _ = writeln!(text, "\n{}", ranges(motions, motion));
    let _ = writeln!(text, "{}", leading_words(periodic));
    for own in periodic.multipliers.iter().filter(|own| is_listed(own)).take(LISTED) {
        let _ = writeln!(text, "  {}", multiplier(own, cycle.period));
    }
    if let Some(error) = periodic.step_error {
        let _ = writeln!(
            text,
            "steps half as long change reactions by {}, displacements by {} of the largest",
            percent(error.force),
            percent(error.displacement)
        );
    }
    if let Some(own) = &periodic.harmonics {
        let both = |own: &StepError| [percent(own.force), percent(own.displacement)];
        if let Some([force, displacement]) = own.change.as_ref().map(both) {
            let _ = writeln!(
                text,
                "twice as many harmonics change reactions by {force}, displacements by {displacement} of the largest"
            );
        }
        let [force, displacement] = both(&own.steps);
        let _ = writeln!(
            text,
            "a march over the cycle, from its start, differs in reactions by {force}, in displacements by {displacement}"
        );
    }
    text + &verdict.words()
}

/// Multipliers in the text, at most; one of each pair.
const LISTED: usize = 6;

fn is_listed(own: &Multiplier) -> bool {
    own.kind == MultiplierKind::Motion && own.value.im >= 0.0 && own.value.norm() > 1e-6
}

fn percent(share: f64) -> String {
    format!("{} %", shown(100.0 * share, 2, 1e-3..1e6))
}

fn multiplier(own: &Multiplier, period: f64) -> String {
    let size = shown(own.value.norm(), 6, 1e-3..1e6);
    let rate = shown(own.value.norm().ln() / period, 4, 1e-3..1e7);
    match own.value.im == 0.0 {
        true if own.value.re < 0.0 => format!("-{size}: {rate} 1/s, the other sign in every cycle"),
        true => format!("{size}: {rate} 1/s"),
        false => {
            // Only up to whole multiples of the cycle's.
            let hertz = shown(own.value.arg() / (TAU * period), 5, 1e-3..1e7);
            let cycle = shown(1.0 / period, 5, 1e-3..1e7);
            format!("{size}, a pair: {rate} 1/s, {hertz} Hz beside multiples of {cycle} Hz")
        }
    }
}

/// What multipliers say, in a line.
fn leading_words(own: &Periodic) -> String {
    let size = leading(own).map_or(0.0, |own| own.value.norm());
    let size = shown(size, 6, 1e-3..1e6);
    match own.stability {
        Stability::Stable => format!("stable: the largest multiplier is {size}"),
        Stability::Diverges => {
            format!("UNSTABLE: a change grows to one side, {size} times in a cycle")
        }
        Stability::Doubles => {
            format!(
                "UNSTABLE: a change grows {size} times in a cycle and takes the other sign (period doubling)"
            )
        }
        Stability::Wanders => {
            format!("UNSTABLE: a change of another frequency grows {size} times in a cycle")
        }
        Stability::Undecided => {
            let own = own.doubtful().map_or(0.0, |own| own.value.norm());
            let own = shown(own, 6, 1e-3..1e6);
            format!("undecided: the multiplier {own} is nearer to 1 than these steps tell")
        }
    }
}

/// The ranges of reactions and displacements.
fn ranges(motions: &Motions, motion: &Motion) -> String {
    let columns = &motion.columns;
    let supports = motions.case.supports();
    let mut lines = vec![
        ["", "force x (N)", "force y (N)", "displacement x (µm)", "displacement y (µm)"]
            .map(str::to_owned)
            .to_vec(),
    ];
    for own in &supports {
        let cell = |quantity: &str, unit: &str| {
            let name = own.column(quantity, unit);
            let Some(place) = columns.iter().position(|column| *column == name) else {
                return "-".to_owned();
            };
            let [least, most] = range(&motion.periodic.history, place);
            let bound = 1e-12 * least.abs().max(most.abs());
            match most - least <= bound {
                true => shown(most, 6, 1e-4..1e7),
                false => {
                    format!("{} .. {}", shown(least, 6, 1e-4..1e7), shown(most, 6, 1e-4..1e7))
                }
            }
        };
        lines.push(vec![
            own.title.clone(),
            cell("RX", "N"),
            cell("RY", "N"),
            cell("X", "um"),
            cell("Y", "um"),
        ]);
    }
    table(&lines)
}

/// A line for each of several motions.
fn each(motions: &Motions, all: &[Motion]) -> String {
    let supports = motions.case.supports();
    let head = [
        "speed (rpm)",
        "cycles",
        "largest multiplier",
        "",
        "largest force (N)",
        "largest displacement (µm)",
    ];
    let mut lines = vec![head.map(str::to_owned).to_vec()];
    for motion in all {
        let periodic = &motion.periodic;
        let most = |quantity: &str, unit: &str| {
            let columns = supports.iter().flat_map(|own| {
                ["X", "Y"].map(|axis| own.column(&format!("{quantity}{axis}"), unit))
            });
            let places =
                columns.filter_map(|name| motion.columns.iter().position(|column| *column == name));
            let all = places.map(|place| {
                let [least, most] = range(&periodic.history, place);
                most.max(-least)
            });
            shown(all.fold(0.0, f64::max), 6, 1e-4..1e7)
        };
        let size = leading(periodic).map_or(0.0, |own| own.value.norm());
        lines.push(vec![
            motion.speed.map_or(String::new(), words::speed),
            periodic.cycles.to_string(),
            shown(size, 6, 1e-3..1e6),
            match is_stable(periodic.stability) {
                Some(true) => "stable",
                Some(false) => "UNSTABLE",
                None => "undecided",
            }
            .to_owned(),
            most("R", "N"),
            most("", "um"),
        ]);
    }
    format!("\n{}\n", table(&lines))
}

/// What limits the worth of all.
pub(super) fn notes(motions: &Motions) -> Vec<String> {
    let mut notes = motions.notes.clone();
    let at = |speed: Option<f64>| {
        speed.map_or(String::new(), |own| format!(" at {} rpm", words::speed(own)))
    };
    for motion in &motions.all {
        let Motion { periodic, speed, .. } = motion;
        let unresolved =
            periodic.multipliers.iter().filter(|own| own.kind == MultiplierKind::Unresolved);
        let leading = leading(periodic).map_or(0.0, |own| own.value.norm());
        let before = unresolved.filter(|own| own.value.norm() > leading).count();
        if before > 0 {
            notes.push(format!(
                "{before} multipliers larger than that of the motion{} are of modes that the steps do not resolve",
                at(*speed)
            ));
        }
        if let Some(steps) = periodic.contact_steps.filter(|steps| *steps < CONTACT) {
            notes.push(format!(
                "the shortest contact{} lasts {steps} steps: {CONTACT} are needed for multipliers to be believed; take more `steps`",
                at(*speed)
            ));
        }
        if let Some(error) =
            periodic.step_error.filter(|own| own.force.max(own.displacement) > CHANGE)
        {
            notes.push(format!(
                "steps half as long change the motion{} by {}: take more `steps`",
                at(*speed),
                percent(error.force.max(error.displacement))
            ));
        }
        if let Some(own) = &periodic.harmonics {
            let apart = own.steps.force.max(own.steps.displacement);
            if apart > MARCHED {
                notes.push(format!(
                    "a march over the cycle{} differs from its harmonics by {}: take more `steps`, or more `harmonics`",
                    at(*speed),
                    percent(apart)
                ));
            }
        }
        let change = periodic.harmonics.as_ref().and_then(|own| own.change);
        if let Some(error) = change.filter(|own| own.force.max(own.displacement) > CHANGE) {
            notes.push(format!(
                "twice as many harmonics change the motion{} by {}: take more `harmonics`",
                at(*speed),
                percent(error.force.max(error.displacement))
            ));
        }
        if !motion.verdict.sound && motions.all.len() > 1 {
            notes.push(format!(
                "the steps of the motion{} are NOT SOUND: see the verdict",
                at(*speed)
            ));
        }
    }
    for (speed, reason) in &motions.lost {
        notes.push(format!("left out{}, as {reason}", at(*speed)));
    }
    notes
}
