//! Undamped critical speeds over the stiffness of the joints.

use std::fmt::Write;

use whirl_solver::linear::{LinearMachine, Undamped, Way};

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
    let goes_on = || !interruption.asked();
    let speeds = linear.undamped(&machine, &stiffness, analysis.count, &goes_on)?;
    let all: Vec<(f64, Vec<Undamped>)> = stiffness.iter().copied().zip(speeds).collect();
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
        "undamped critical speeds of {body} (rpm), all joints springs of one stiffness along x and y; f forward, b backward, - along a line, a axial, t torsional\n"
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
    match own.mode.sense {
        sense if sense > CIRCULAR => "forward",
        sense if sense < -CIRCULAR => "backward",
        _ => "-",
    }
}

fn rows(all: &[(f64, Vec<Undamped>)]) -> String {
    let mut text = String::from("stiffness_N_m,number,speed_rpm,whirl,sense,branch,motion\n");
    for (stiffness, speeds) in all {
        for (place, own) in speeds.iter().enumerate() {
            let (rpm, whirl) = (words::rpm(own.speed()), whirl(own));
            let (number, sense, branch) = (place + 1, own.mode.sense, own.branch + 1);
            let way = words::way(own.way);
            writeln!(text, "{stiffness},{number},{rpm},{whirl},{sense},{branch},{way}")
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
            let sense = match (whirl(own), own.way) {
                (_, Way::Axial) => " a",
                (_, Way::Torsional) => " t",
                ("forward", _) => " f",
                ("backward", _) => " b",
                _ => " -",
            };
            words::speed(own.speed()) + sense
        };
        let mut cells = vec![format!("{stiffness:.3e}")];
        cells.extend(speeds.iter().map(cell));
        cells.resize(columns + 1, String::new());
        rows.push(cells);
    }
    table(&rows)
}

fn figure(case: &Case, linear: &LinearMachine, of: usize, all: &[(f64, Vec<Undamped>)]) -> Figure {
    let kind = |own: &Undamped| match (own.way, whirl(own)) {
        (Way::Axial | Way::Torsional, _) => ("axial or torsional", Style::Third),
        (Way::Lateral, "forward") => ("forward whirl", Style::First),
        (Way::Lateral, "backward") => ("backward whirl", Style::Second),
        (Way::Lateral, _) => ("along a line", Style::Fourth),
    };
    let branches = all.iter().flat_map(|own| &own.1).map(|own| own.branch + 1).max().unwrap_or(0);
    let mut lines: Vec<Line> = Vec::new();
    for branch in 0..branches {
        let on = all.iter().filter_map(|(stiffness, speeds)| {
            Some((*stiffness, speeds.iter().find(|own| own.branch == branch)?))
        });
        // A piece for each way in which it goes round, from where the one before ends.
        let mut before: Option<(&str, (f64, f64))> = None;
        for (stiffness, own) in on {
            let ((name, style), at) = (kind(own), (stiffness, words::rpm(own.speed())));
            match before {
                Some((same, _)) if same == name => {
                    lines.last_mut().expect("that of the point before").points.push(at);
                }
                _ => {
                    let from = before.map(|own| own.1).into_iter();
                    let points = from.chain([at]).collect();
                    lines.push(Line { points, style, name: name.to_owned() });
                }
            }
            before = Some((name, at));
        }
    }
    let body = linear.machine().bodies[of].name();
    let panel = Panel {
        title: "undamped critical speeds".to_owned(),
        x: "stiffness of every joint (N/m)".to_owned(),
        y: format!("speed of {body} (rpm)"),
        lines: lines.into_iter().filter(|own| own.points.len() > 1).collect(),
        x_log: true,
        ..Panel::default()
    };
    Figure { title: format!("{}: critical speed map", case.name), panels: vec![panel], columns: 1 }
}
