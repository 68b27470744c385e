//! Reactions, eccentricity orbits, displacement and rotation out of a history.

use std::f64::consts::TAU;
use std::ops::Range;

use whirl_solver::history::History;

use super::figure::{Dot, Figure, Line, Panel, Style};
use crate::report::{column, last_cycle};

/// What histories are drawn over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Span {
    /// All of it, against time.
    All,
    /// The last cycle, in s, against the angle turned in it.
    LastCycle(f64),
}

/// Rows to draw, and their abscissae.
struct Rows {
    rows: Range<usize>,
    abscissae: Vec<f64>,
    label: &'static str,
    /// Angle turned, rad.
    turned: f64,
}

impl Span {
    /// The last cycle if the shaft turns in it, else everything.
    pub(crate) fn fitting(history: &History, cycle: f64) -> Span {
        let turned = Span::LastCycle(cycle).rows(history).turned;
        if turned.abs() > 0.5 * TAU { Span::LastCycle(cycle) } else { Span::All }
    }

    fn rows(self, history: &History) -> Rows {
        let (time, theta) = (column(history, "t_s"), column(history, "theta_rad"));
        let rows = match self {
            Span::All => 0..time.len(),
            Span::LastCycle(cycle) => last_cycle(&time, cycle),
        };
        let (first, last) = match &theta[rows.clone()] {
            [first, .., last] => (*first, *last),
            _ => (0.0, 0.0),
        };
        let (abscissae, label) = match self {
            Span::All => (time.iter().map(|t| 1e3 * t).collect(), "time (ms)"),
            Span::LastCycle(_) => {
                let degrees = |angle: &f64| (angle - first).to_degrees();
                (
                    theta[rows.clone()].iter().map(degrees).collect(),
                    "rotation in the last cycle (°)",
                )
            }
        };
        Rows { rows, abscissae, label, turned: last - first }
    }
}

impl Rows {
    fn line(&self, history: &History, name: &str, legend: &str, style: Style) -> Line {
        let values = &column(history, name)[self.rows.clone()];
        let points = self.abscissae.iter().copied().zip(values.iter().copied()).collect();
        Line { points, style, name: legend.to_string() }
    }

    /// An axis in eighths of two revolutions where the shaft turns forward.
    fn scale(&self, span: Span) -> Option<(f64, f64)> {
        const STEP: f64 = 90.0;
        let end = (self.turned.to_degrees() / STEP).ceil() * STEP;
        (span != Span::All && end > 0.0).then_some((end, STEP))
    }
}

/// RX and RY of every support, a panel each.
pub(crate) fn reactions(history: &History, supports: &[String], span: Span) -> Figure {
    let rows = span.rows(history);
    let panel = |(index, title): (usize, &String)| {
        let k = index + 1;
        Panel {
            title: title.clone(),
            x: rows.label.to_string(),
            y: "force on the shaft (N)".to_string(),
            x_scale: rows.scale(span),
            lines: vec![
                rows.line(history, &format!("RX{k}_N"), "RX, vertical", Style::First),
                rows.line(history, &format!("RY{k}_N"), "RY, lateral", Style::Second),
            ],
            ..Panel::default()
        }
    };
    Figure {
        title: "Reactions at the supports".to_string(),
        panels: supports.iter().enumerate().map(panel).collect(),
        columns: 2,
    }
}

/// Eccentricity of every journal in its bore, a panel each: equal axes, X upwards, the clearance circle
/// (`clearances` in µm), and a dot where the keyphasor sees the shaft (θ a multiple of 360°).
pub(crate) fn eccentricities(
    history: &History,
    supports: &[String],
    clearances: &[f64],
    span: Span,
) -> Figure {
    let rows = span.rows(history);
    let (what, lateral) = match span {
        Span::All => ("Eccentricity of the journals", "EY, lateral (µm)"),
        // Seen along +z, x up and y to the right: positive rotation is clockwise.
        Span::LastCycle(_) if rows.turned > 0.0 => {
            ("Eccentricity of the journals in the last cycle", "EY, lateral (µm); rotation ↻")
        }
        Span::LastCycle(_) => {
            ("Eccentricity of the journals in the last cycle", "EY, lateral (µm); rotation ↺")
        }
    };
    let passages = passages(&column(history, "theta_rad")[rows.rows.clone()]);
    let panel = |(index, (title, &clearance)): (usize, (&String, &f64))| {
        let k = index + 1;
        let x = &column(history, &format!("EX{k}_um"))[rows.rows.clone()];
        let y = &column(history, &format!("EY{k}_um"))[rows.rows.clone()];
        let dot = |&(row, part): &(usize, f64)| {
            let mix = |values: &[f64]| values[row] + part * (values[row + 1] - values[row]);
            Dot { at: (mix(y), mix(x)), name: "keyphasor, θ = 0°".to_string() }
        };
        let orbit = Line {
            points: y.iter().copied().zip(x.iter().copied()).collect(),
            style: Style::First,
            name: "centre of the journal".to_string(),
        };
        Panel {
            title: title.clone(),
            x: lateral.to_string(),
            y: "EX, vertical (µm)".to_string(),
            lines: vec![circle(clearance), orbit],
            dots: passages.iter().map(dot).collect(),
            equal_axes: true,
            x_scale: None,
        }
    };
    Figure {
        title: what.to_string(),
        panels: supports.iter().zip(clearances).enumerate().map(panel).collect(),
        columns: 2,
    }
}

/// Orbits without the clearance circle, each axis filled by the orbit: its shape, where it is flat.
pub(crate) fn stretched(orbits: &Figure) -> Figure {
    let panel = |panel: &Panel| Panel {
        lines: panel.lines.iter().filter(|line| line.style != Style::Limit).cloned().collect(),
        equal_axes: false,
        ..panel.clone()
    };
    Figure {
        title: format!("{}, axes stretched", orbits.title),
        panels: orbits.panels.iter().map(panel).collect(),
        columns: orbits.columns,
    }
}

fn circle(radius: f64) -> Line {
    const CORNERS: usize = 180;
    let corner = |i: usize| {
        let (sin, cos) = (TAU * i as f64 / CORNERS as f64).sin_cos();
        (radius * cos, radius * sin)
    };
    Line {
        points: (0..=CORNERS).map(corner).collect(),
        style: Style::Limit,
        name: "radial clearance".to_string(),
    }
}

/// Where θ passes a whole revolution: the row before, and the part of the step after it.
fn passages(theta: &[f64]) -> Vec<(usize, f64)> {
    let revolutions: Vec<f64> = theta.iter().map(|angle| angle / TAU).collect();
    let mut found = Vec::new();
    for (row, pair) in revolutions.windows(2).enumerate() {
        let whole = pair[1].floor();
        if pair[0] < whole && pair[1] > pair[0] {
            found.push((row, (whole - pair[0]) / (pair[1] - pair[0])));
        }
    }
    found
}

/// Displacement along x of the first journal against time, in mm.
pub(crate) fn displacement(history: &History) -> Figure {
    let rows = Span::All.rows(history);
    let mut line = rows.line(history, "X1_um", "displacement", Style::First);
    line.points.iter_mut().for_each(|point| point.1 *= 1e-3);
    let panel = Panel {
        x: rows.label.to_string(),
        y: "displacement (mm)".to_string(),
        lines: vec![line],
        ..Panel::default()
    };
    Figure { title: "Displacement of the mass".to_string(), panels: vec![panel], columns: 1 }
}

/// Angle and speed of rotation against time.
pub(crate) fn rotation(history: &History) -> Figure {
    let rows = Span::All.rows(history);
    let panel = |title: &str, y: &str, name: &str, scale: f64| {
        let mut line = rows.line(history, name, "shaft", Style::First);
        line.points.iter_mut().for_each(|point| point.1 *= scale);
        Panel {
            title: title.to_string(),
            x: rows.label.to_string(),
            y: y.to_string(),
            lines: vec![line],
            ..Panel::default()
        }
    };
    Figure {
        title: "Rotation of the shaft".to_string(),
        panels: vec![
            panel("Angle of rotation", "angle (revolutions)", "theta_rad", 1.0 / TAU),
            panel("Speed of rotation", "speed (rpm)", "omega_rad_s", 60.0 / TAU),
        ],
        columns: 2,
    }
}
