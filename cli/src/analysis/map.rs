//! Undamped critical speeds over the stiffness of the joints.

use std::fmt::Write;

use whirl_solver::linear::{LinearMachine, Undamped};

use super::facts::Facts;
use super::found::{Found, drawn, nothing};
use super::speeds::Wanted;
use super::words;
use crate::case::{Analysis, Case};
use crate::errors::Failure;
use crate::figures::{Figure, Line, Panel, Style};
use crate::report::table;
use crate::signals::Interruption;

/// Stiffnesses where none are asked for: ends (N/m), and how many.
const USUAL: ([f64; 2], usize) = ([1e5, 1e10], 41);
/// Senses beyond which a motion is said to go round.
const CIRCULAR: f64 = 0.1;
/// Rows of the table for people.
const SHOWN: usize = 11;

/// Critical speeds at each stiffness.
pub(super) fn found(
    case: &Case,
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    interruption: &Interruption,
    figures: bool,
) -> Result<Found, Failure> {
    let of = wanted.of.expect("a body that turns");
    let stiffness = match analysis.stiffness.as_slice() {
        [] => {
            let ([first, last], count) = USUAL;
            let share = |k: usize| k as f64 / (count - 1) as f64;
            (0..count).map(|k| first * (last / first).powf(share(k))).collect()
        }
        own => own.to_vec(),
    };
    let machine = linear.unsupported(&linear.speeds(of, 1.0, &analysis.ratios));
    let mut all: Vec<(f64, Vec<Undamped>)> = Vec::new();
    for &value in stiffness.iter().take_while(|_| !interruption.asked()) {
        all.push((value, linear.undamped(&machine, value, analysis.count)?));
    }
    if all.is_empty() {
        return Err(nothing());
    }
    let name = &analysis.name;
    let mut files = vec![(format!("{name}.csv"), rows(&all).into_bytes())];
    if figures && all.len() > 1 {
        files.extend(drawn(name, &figure(case, linear, of, &all)));
    }
    let body = linear.machine().bodies[of].name();
    let mut text = format!("{}: {}\n", case.name, case.title);
    let _ = writeln!(
        text,
        "undamped critical speeds of {body} (rpm), all joints springs of one stiffness along x and y; f forward, b backward\n"
    );
    text.push_str(&shown(&all));
    let mut facts = Facts::default();
    let left_out = linear.left_out_of_map();
    if !left_out.is_empty() {
        let note = format!("note: left out is what joints do otherwise: {}\n", left_out.join(", "));
        facts.lines(&note);
        text.push_str(&note);
    }
    if let [(_, speeds)] = all.as_slice() {
        facts.undamped(speeds, |own| whirl(own) == "forward");
    }
    Ok(Found { text, files, interrupted: all.len() < stiffness.len(), facts })
}

/// How a motion goes round, seen by a body that turns from x to y.
fn whirl(own: &Undamped) -> &'static str {
    match own.sense {
        sense if sense > CIRCULAR => "forward",
        sense if sense < -CIRCULAR => "backward",
        _ => "-",
    }
}

fn rows(all: &[(f64, Vec<Undamped>)]) -> String {
    let mut text = String::from("stiffness_N_m,number,speed_rpm,whirl,sense\n");
    for (stiffness, speeds) in all {
        for (place, own) in speeds.iter().enumerate() {
            let (rpm, whirl) = (words::rpm(own.speed), whirl(own));
            writeln!(text, "{stiffness},{},{rpm},{whirl},{}", place + 1, own.sense)
                .expect("text can be written");
        }
    }
    text
}

/// Some of the stiffnesses, a line each.
fn shown(all: &[(f64, Vec<Undamped>)]) -> String {
    let columns = all.iter().map(|own| own.1.len()).max().unwrap_or(0);
    let head = std::iter::once("stiffness (N/m)".to_owned());
    let mut rows = vec![head.chain((1..=columns).map(|k| k.to_string())).collect::<Vec<_>>()];
    let step = (all.len() - 1).div_ceil(SHOWN - 1).max(1);
    for (stiffness, speeds) in all.iter().step_by(step) {
        let cell = |own: &Undamped| {
            let sense = match whirl(own) {
                "forward" => " f",
                "backward" => " b",
                _ => "",
            };
            words::speed(own.speed) + sense
        };
        let mut cells = vec![format!("{stiffness:.3e}")];
        cells.extend(speeds.iter().map(cell));
        cells.resize(columns + 1, String::new());
        rows.push(cells);
    }
    table(&rows)
}

fn figure(case: &Case, linear: &LinearMachine, of: usize, all: &[(f64, Vec<Undamped>)]) -> Figure {
    let kinds = [("forward", Style::First), ("backward", Style::Second), ("-", Style::Third)];
    let most = all.iter().map(|own| own.1.len()).max().unwrap_or(0);
    let lines = kinds.into_iter().flat_map(|(kind, style)| {
        (0..most).map(move |place| {
            let points = all.iter().filter_map(|(stiffness, speeds)| {
                let own = speeds.iter().filter(|own| whirl(own) == kind).nth(place)?;
                Some((*stiffness, words::rpm(own.speed)))
            });
            let name = match kind {
                "-" => "axial or torsional".to_owned(),
                own => format!("{own} whirl"),
            };
            Line { points: points.collect(), style, name }
        })
    });
    let body = linear.machine().bodies[of].name();
    let panel = Panel {
        title: "undamped critical speeds".to_owned(),
        x: "stiffness of every joint (N/m)".to_owned(),
        y: format!("speed of {body} (rpm)"),
        lines: lines.filter(|own| own.points.len() > 1).collect(),
        x_log: true,
        ..Panel::default()
    };
    Figure { title: format!("{}: critical speed map", case.name), panels: vec![panel], columns: 1 }
}
