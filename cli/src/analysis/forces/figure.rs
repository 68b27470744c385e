//! Deflection, shear, bending moment, axial force and torque over z, a panel each: of what stands, and amplitudes of what moves.

use whirl_solver::linear::Along;

use super::quantities::{size, values};
use crate::analysis::words;
use crate::case::Case;
use crate::figures::{Figure, Line, Panel, Style};

/// Panels: title, axis, and curves by the places of their quantities.
const PANELS: [(&str, &str, &[(usize, &str)]); 4] = [
    ("deflection along x and y", "displacement (µm)", &[(0, "x"), (1, "y")]),
    ("shear force along x and y", "force (N)", &[(3, "x"), (4, "y")]),
    ("bending moment about x and y", "moment (N·m)", &[(6, "x"), (7, "y")]),
    ("axial force and torque", "force (N), torque (N·m)", &[(5, "axial force"), (8, "torque")]),
];
/// The same of amplitudes: of two quantities at right angles their major semi-axis.
const AMPLITUDES: [(&str, &str, &[usize]); 4] = [
    ("deflection", "major semi-axis (µm)", &[0, 1]),
    ("shear force", "major semi-axis (N)", &[3, 4]),
    ("bending moment", "major semi-axis (N·m)", &[6, 7]),
    ("torque", "amplitude (N·m)", &[8]),
];
const STYLES: [Style; 4] = [Style::First, Style::Second, Style::Third, Style::Fourth];

/// The figure of what stands at a speed (rad/s).
pub(super) fn of(case: &Case, speed: f64, all: &[(String, Vec<Along>)]) -> Figure {
    let panels = PANELS.map(|(title, y, curves)| {
        let lines = all.iter().enumerate().flat_map(|(number, (body, sections))| {
            curves.iter().enumerate().map(move |(k, (place, name))| {
                let points = sections.iter().map(|own| (1e3 * own.z, values(own)[*place].re));
                let style = STYLES[(2 * number + k) % STYLES.len()];
                Line { points: points.collect(), style, name: format!("{body}, {name}") }
            })
        });
        Panel {
            title: title.to_owned(),
            x: "z (mm)".to_owned(),
            y: y.to_owned(),
            lines: lines.collect(),
            ..Panel::default()
        }
    });
    let title = format!("{}: {}, at {} rpm", case.name, case.title, words::speed(speed));
    Figure { title, panels: panels.to_vec(), columns: 2 }
}

/// The figure of amplitudes at a speed (rad/s), `what` moves: by its name each motion, and what is seen along the bodies.
pub(super) fn of_motions(
    case: &Case,
    speed: f64,
    what: &str,
    all: &[(String, Vec<(String, Vec<Along>)>)],
) -> Figure {
    let panels = AMPLITUDES.map(|(title, y, which)| {
        let lines = all.iter().enumerate().flat_map(|(number, (motion, bodies))| {
            bodies.iter().map(move |(body, sections)| {
                let points = sections.iter().map(|own| (1e3 * own.z, size(&values(own), which)));
                let style = STYLES[number % STYLES.len()];
                Line { points: points.collect(), style, name: format!("{motion}, {body}") }
            })
        });
        Panel {
            title: title.to_owned(),
            x: "z (mm)".to_owned(),
            y: y.to_owned(),
            lines: lines.collect(),
            ..Panel::default()
        }
    });
    let title = format!("{}: {what}, at {} rpm", case.name, words::speed(speed));
    Figure { title, panels: panels.to_vec(), columns: 2 }
}
