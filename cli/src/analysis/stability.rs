//! The least stable motion over speeds, and where it begins to grow.

use std::fmt::Write;

use whirl_solver::linear::{Campbell, LinearMachine, Mode};

use super::facts::Facts;
use super::found::{Found, drawn, followed};
use super::speeds::Wanted;
use super::{roots, words};
use crate::case::{Analysis, Case};
use crate::errors::Failure;
use crate::figures::{Dot, Figure, Label, Line, Mark, Panel, Stroke, Style};
use crate::report::table;
use crate::signals::Interruption;

/// Share of the range of speeds by which thresholds that are named in a figure are apart.
const APART: f64 = 0.1;

/// The least stable mode at each speed.
pub(super) fn found(
    case: &Case,
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    interruption: &Interruption,
    figures: bool,
) -> Result<Found, Failure> {
    let of = wanted.of.expect("a body that turns");
    let all = followed(linear, (analysis, wanted), interruption, &[])?;
    let least: Vec<Option<&Mode>> = (0..all.speeds.len()).map(|place| least(&all, place)).collect();
    let name = &analysis.name;
    let mut files = vec![
        (format!("{name}.csv"), rows(&all, &least).into_bytes()),
        (format!("{name}.thresholds.csv"), words::thresholds_file(&all).into_bytes()),
    ];
    if figures && all.speeds.len() > 1 {
        files.extend(drawn(name, &figure(case, linear, of, &all, &least)));
        let body = linear.machine().bodies[of].name();
        let stem = format!("{name}.roots");
        files.extend(drawn(&stem, &roots::figure(&case.name, body, &all)));
    }
    let mut text = format!("{}: {}\n", case.name, case.title);
    let head = ["speed (rpm)", "least log decrement", "frequency (Hz)", "whirl", "moves", ""];
    let mut lines = vec![head.map(str::to_owned).to_vec()];
    for ((place, speed), mode) in all.speeds.iter().enumerate().zip(&least) {
        let Some(mode) = mode else { continue };
        lines.push(vec![
            words::speed(*speed),
            words::decrement(mode),
            words::hertz(mode),
            words::whirl(mode, *speed).to_owned(),
            words::movers(linear, mode),
            if all.stable[place] { String::new() } else { "UNSTABLE".to_owned() },
        ]);
    }
    text.push('\n');
    text.push_str(&table(&lines));
    text.push('\n');
    text.push_str(&words::thresholds(&all));
    text.push_str(&words::doubts(&all.doubts));
    let facts = Facts::of_stability(&all);
    Ok(Found { text, files, interrupted: all.interrupted, facts })
}

/// The listed mode with the smallest logarithmic decrement at a speed.
fn least(all: &Campbell, place: usize) -> Option<&Mode> {
    let modes = all.branches.iter().filter_map(|branch| branch[place].as_ref());
    modes.min_by(|a, b| a.log_decrement().total_cmp(&b.log_decrement()))
}

fn rows(all: &Campbell, least: &[Option<&Mode>]) -> String {
    let mut text =
        String::from("speed_rpm,stable,least_log_decrement,frequency_hz,real_1_s,whirl\n");
    for ((place, speed), mode) in all.speeds.iter().enumerate().zip(least) {
        let values = mode.map_or(",,,".to_owned(), |mode| {
            let whirl = words::whirl(mode, *speed);
            format!("{},{},{},{whirl}", mode.log_decrement(), mode.hertz(), mode.value.re)
        });
        let stable = all.stable[place];
        writeln!(text, "{},{stable},{values}", words::rpm(*speed)).expect("text can be written");
    }
    text
}

fn figure(
    case: &Case,
    linear: &LinearMachine,
    of: usize,
    all: &Campbell,
    least: &[Option<&Mode>],
) -> Figure {
    let body = linear.machine().bodies[of].name();
    let mut panel = Panel {
        title: "stability".to_owned(),
        x: format!("speed of {body} (rpm)"),
        y: "least logarithmic decrement (1)".to_owned(),
        levels: vec![Mark { x: 0.0, name: String::new() }],
        ..Panel::default()
    };
    let mut points: Vec<(f64, f64, bool)> = all
        .speeds
        .iter()
        .zip(least)
        .filter_map(|(speed, mode)| {
            let mode = (*mode)?;
            Some((words::rpm(*speed), mode.log_decrement(), mode.grows()))
        })
        .collect();
    // At a threshold nothing decays or grows; intervals may lie between two speeds.
    let crossed =
        all.thresholds.iter().map(|own| (words::rpm(own.speed), 0.0, own.grows || own.others));
    points.extend(crossed);
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    for piece in points.windows(2) {
        let [(x, y, grows), (u, v, _)] = [piece[0], piece[1]];
        let (style, name) = match grows {
            true => (Style::Doubted, "unstable"),
            false => (Style::First, "the least stable mode"),
        };
        match panel.strokes.last_mut() {
            Some(last) if last.line.style == style => last.line.points.push((u, v)),
            _ => {
                let line = Line { points: vec![(x, y), (u, v)], style, name: name.to_owned() };
                panel.strokes.push(Stroke { line, width: 1.6 });
            }
        }
    }
    let length = points.last().zip(points.first()).map_or(0.0, |(last, first)| last.0 - first.0);
    for own in &all.thresholds {
        let at = (words::rpm(own.speed), 0.0);
        panel.dots.push(Dot { at, name: "thresholds".to_owned() });
        // Of several that are close together the first is named.
        if panel.labels.last().is_none_or(|last| at.0 - last.at.0 > APART * length) {
            panel.labels.push(Label { at, text: format!("{:.0} rpm", at.0) });
        }
    }
    Figure { title: format!("{}: least stable mode", case.name), panels: vec![panel], columns: 1 }
}
