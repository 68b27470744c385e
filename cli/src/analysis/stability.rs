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

/// Share of a motion's inertia from which on a body is said to be moved by it.
const TAKES_PART: f64 = 0.1;

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
    let places = 0..all.speeds.len();
    let least_with = |share: f64| -> Vec<Option<&Mode>> {
        places.clone().map(|place| least(&all, place, (of, share))).collect()
    };
    let (least, own) = (least_with(0.0), least_with(TAKES_PART));
    let name = &analysis.name;
    let mut files = vec![
        (format!("{name}.csv"), rows(&all, &least, &own).into_bytes()),
        (format!("{name}.thresholds.csv"), words::thresholds_file(&all).into_bytes()),
    ];
    if figures && all.speeds.len() > 1 {
        files.extend(drawn(name, &figure(case, linear, of, &all, &least)));
        let body = linear.machine().bodies[of].name();
        let stem = format!("{name}.roots");
        files.extend(drawn(&stem, &roots::figure(&case.name, body, &all)));
    }
    let mut text = format!("{}: {}\n", case.name, case.title);
    let head = ["speed (rpm)", "least log decrement", "frequency (Hz)", "whirl", "moves"];
    let mut head = head.map(str::to_owned).to_vec();
    // Where others are damped less, those that move the body are told beside them.
    let other = (least != own).then(|| linear.machine().bodies[of].name());
    head.extend(other.map(|body| format!("least that moves {body}")));
    head.push(String::new());
    let mut lines = vec![head];
    for ((place, speed), mode) in all.speeds.iter().enumerate().zip(&least) {
        let Some(mode) = mode else { continue };
        let mut line = vec![
            words::speed(*speed),
            words::decrement(mode),
            words::hertz(mode),
            words::whirl(mode, *speed).to_owned(),
            words::movers(linear, mode),
        ];
        line.extend(other.map(|_| {
            let of_mode =
                |own: &Mode| format!("{} at {} Hz", words::decrement(own), words::hertz(own));
            own[place].map_or(String::new(), of_mode)
        }));
        line.push(match &all.growing[place] {
            None => String::new(),
            Some(_) if mode.grows() => "UNSTABLE".to_owned(),
            Some(own) => format!("UNSTABLE: {}", words::growing(linear, own)),
        });
        lines.push(line);
    }
    text.push('\n');
    text.push_str(&table(&lines));
    text.push('\n');
    text.push_str(&words::thresholds(linear, &all));
    text.push_str(&words::doubts(&all.doubts));
    let facts = Facts::of_stability(&all);
    Ok(Found { text, files, interrupted: all.interrupted, facts })
}

/// The listed mode with the smallest logarithmic decrement at a speed among those in which a body has a share.
fn least(all: &Campbell, place: usize, (of, share): (usize, f64)) -> Option<&Mode> {
    let modes = all.branches.iter().filter_map(|branch| branch[place].as_ref());
    modes
        .filter(|own| own.shares[of] >= share)
        .min_by(|a, b| a.log_decrement().total_cmp(&b.log_decrement()))
}

fn rows(all: &Campbell, least: &[Option<&Mode>], own: &[Option<&Mode>]) -> String {
    let mut text = String::from(
        "speed_rpm,stable,least_log_decrement,frequency_hz,real_1_s,whirl,body_log_decrement,body_frequency_hz\n",
    );
    for ((place, speed), (mode, own)) in all.speeds.iter().enumerate().zip(least.iter().zip(own)) {
        let values = mode.map_or(",,,".to_owned(), |mode| {
            let whirl = words::whirl(mode, *speed);
            format!("{},{},{},{whirl}", mode.log_decrement(), mode.hertz(), mode.value.re)
        });
        let stable = all.growing[place].is_none();
        let own =
            own.map_or(",".to_owned(), |own| format!("{},{}", own.log_decrement(), own.hertz()));
        writeln!(text, "{},{stable},{values},{own}", words::rpm(*speed))
            .expect("text can be written");
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
        .zip(least.iter().zip(&all.growing))
        .filter_map(|(speed, (mode, growing))| {
            Some((words::rpm(*speed), (*mode)?.log_decrement(), growing.is_some()))
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
