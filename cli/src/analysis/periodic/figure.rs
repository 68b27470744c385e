//! Figures of periodic motions: orbits over the cycle, multipliers in the unit circle, and both over the speed.

use std::f64::consts::TAU;

use whirl_solver::periodic::MultiplierKind;

use super::motions::{Motion, Motions, range};
use super::text::{is_stable, leading};
use crate::analysis::found;
use crate::analysis::words;
use crate::figures::{Cloud, Dot, Figure, Line, Mark, Panel, Style};

/// Corners of a circle.
const CORNERS: usize = 180;

/// All figures as files.
pub(super) fn drawn(name: &str, motions: &Motions) -> Vec<(String, Vec<u8>)> {
    let title = |what: &str| format!("{}: {what}", motions.case.name);
    let mut files = Vec::new();
    if let Some(motion) = motions.all.last() {
        let at = motion.speed.map_or(String::new(), |own| format!(" at {} rpm", words::speed(own)));
        let panels = orbits(motions, motion);
        if !panels.is_empty() {
            let figure =
                Figure { title: title(&format!("periodic motion{at}")), panels, columns: 2 };
            let stem =
                if motions.all.len() > 1 { format!("{name}.orbits") } else { name.to_owned() };
            files.extend(found::drawn(&stem, &figure));
        }
        let figure = Figure {
            title: title(&format!("multipliers{at}")),
            panels: vec![circle(motion)],
            columns: 1,
        };
        files.extend(found::drawn(&format!("{name}.multipliers"), &figure));
    }
    if motions.all.len() > 1 {
        let figure =
            Figure { title: title("periodic motions"), panels: over_speeds(motions), columns: 1 };
        files.extend(found::drawn(name, &figure));
    }
    files
}

/// A panel for every joint whose journal moves: X up, Y to the right.
fn orbits(motions: &Motions, motion: &Motion) -> Vec<Panel> {
    let supports = motions.case.supports();
    let history = &motion.periodic.history;
    let panel = |own: &crate::case::SupportName| {
        let place = |quantity: &str| {
            let name = own.column(quantity, "um");
            motion.columns.iter().position(|column| *column == name)
        };
        let (x, y) = (place("X")?, place("Y")?);
        let at = |row: usize| (history.values(row)[y], history.values(row)[x]);
        let last = history.rows().checked_sub(1)?;
        let points: Vec<(f64, f64)> =
            std::iter::once(last).chain(0..history.rows()).map(at).collect();
        let moves = points.iter().any(|own| *own != points[0]);
        moves.then(|| Panel {
            title: own.title.clone(),
            x: "Y (µm)".to_owned(),
            y: "X (µm)".to_owned(),
            dots: vec![Dot { at: points[0], name: "start of the cycle".to_owned() }],
            lines: vec![Line { points, style: Style::First, name: "journal".to_owned() }],
            equal_axes: true,
            ..Panel::default()
        })
    };
    supports.iter().filter_map(panel).collect()
}

/// The multipliers of a motion, and the unit circle.
fn circle(motion: &Motion) -> Panel {
    let of = |kind: MultiplierKind, style: Style, name: &str| Cloud {
        points: motion
            .periodic
            .multipliers
            .iter()
            .filter(|own| own.kind == kind)
            .map(|own| (own.value.re, own.value.im))
            .collect(),
        style,
        radius: 3.0,
        name: name.to_owned(),
    };
    let corner = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / CORNERS as f64).sin_cos();
        (cos, sin)
    };
    let unit = Line {
        points: (0..=CORNERS).map(corner).collect(),
        style: Style::Limit,
        name: "unit circle".to_owned(),
    };
    let clouds = [
        of(MultiplierKind::Motion, Style::First, "of the motion"),
        of(MultiplierKind::Unresolved, Style::Second, "of what steps do not resolve"),
    ];
    Panel {
        title: "multipliers".to_owned(),
        x: "real part (1)".to_owned(),
        y: "imaginary part (1)".to_owned(),
        lines: vec![unit],
        clouds: clouds.into_iter().filter(|own| !own.points.is_empty()).collect(),
        equal_axes: true,
        ..Panel::default()
    }
}

/// Ranges of displacements and the largest multiplier over the speed.
fn over_speeds(motions: &Motions) -> Vec<Panel> {
    let body = motions.of.map_or("", |of| motions.case.machine.bodies[of].name.text());
    let x = format!("speed of {body} (rpm)");
    let speed = |motion: &Motion| words::rpm(motion.speed.unwrap_or(0.0));
    let styles = [Style::First, Style::Second, Style::Third, Style::Fourth];
    let amplitude = |motion: &Motion, name: &str| {
        let place = motion.columns.iter().position(|column| column == name)?;
        let [least, most] = range(&motion.periodic.history, place);
        Some(0.5 * (most - least))
    };
    let lines =
        motions.case.supports().into_iter().zip(styles.into_iter().cycle()).map(|(own, style)| {
            let name = own.column("X", "um");
            let points = motions
                .all
                .iter()
                .filter_map(|motion| Some((speed(motion), amplitude(motion, &name)?)));
            Line { points: points.collect(), style, name: own.title }
        });
    let lines: Vec<Line> = lines.filter(|own| own.points.iter().any(|at| at.1 > 0.0)).collect();
    let unstable =
        motions.all.iter().filter(|own| is_stable(own.periodic.stability) == Some(false));
    let dots = unstable.flat_map(|motion| {
        let at = speed(motion);
        lines.iter().filter_map(move |line| {
            let point = line.points.iter().find(|own| own.0 == at)?;
            Some(Dot { at: *point, name: "unstable".to_owned() })
        })
    });
    let amplitudes = Panel {
        title: "half of the range of X".to_owned(),
        x: x.clone(),
        y: "displacement (µm)".to_owned(),
        dots: dots.collect(),
        lines: lines.clone(),
        ..Panel::default()
    };
    let sizes = motions
        .all
        .iter()
        .filter_map(|motion| Some((speed(motion), leading(&motion.periodic)?.value.norm())));
    let multipliers = Panel {
        title: "the largest multiplier".to_owned(),
        x,
        y: "modulus (1)".to_owned(),
        levels: vec![Mark { x: 1.0, name: String::new() }],
        lines: vec![Line {
            points: sizes.collect(),
            style: Style::First,
            name: "largest multiplier".to_owned(),
        }],
        ..Panel::default()
    };
    vec![amplitudes, multipliers]
}
