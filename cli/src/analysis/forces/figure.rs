//! Deflection, shear, bending moment, axial force and torque over z, a panel each.

use whirl_solver::linear::Along;

use super::quantities::values;
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
