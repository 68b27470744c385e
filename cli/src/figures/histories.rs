//! Reactions, eccentricity orbits and rotation out of a history.

use std::f64::consts::TAU;

use super::figure::{Dot, Figure, Line, Panel, Style};
use crate::report::Columns;

/// What histories are drawn over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Span {
    /// All of it, against time.
    All,
    /// The last cycle, in s, against the angle turned in it.
    LastCycle(f64),
}

impl Span {
    /// The last cycle if the shaft turns in it, else everything.
    pub(crate) fn fitting(columns: &Columns, cycle: f64) -> Span {
        let theta = &columns["theta_rad"][last_cycle(&columns["t_s"], cycle)];
        let turned = theta.last().zip(theta.first()).map_or(0.0, |(last, first)| last - first);
        if turned.abs() > 0.5 * TAU { Span::LastCycle(cycle) } else { Span::All }
    }

    /// Abscissae with their label, and the rows to draw.
    fn abscissae(self, columns: &Columns) -> (Vec<f64>, &'static str, std::ops::Range<usize>) {
        let time = &columns["t_s"];
        match self {
            Span::All => (time.iter().map(|t| 1e3 * t).collect(), "time (ms)", 0..time.len()),
            Span::LastCycle(cycle) => {
                let rows = last_cycle(time, cycle);
                let theta = &columns["theta_rad"][rows.clone()];
                let degrees = theta.iter().map(|angle| (angle - theta[0]).to_degrees()).collect();
                (degrees, "rotation in the last cycle (°)", rows)
            }
        }
    }
}

/// Rows of the last `cycle` seconds.
pub(crate) fn last_cycle(time: &[f64], cycle: f64) -> std::ops::Range<usize> {
    let end = time.last().copied().unwrap_or(0.0);
    // A row that lies a rounding error before the cycle belongs to it.
    let first = time.partition_point(|&t| t < end - cycle * (1.0 + 1e-9));
    first..time.len()
}

/// Distance between the labels of an axis of two revolutions, in degrees.
const EIGHTH_OF_TWO_TURNS: f64 = 90.0;

/// RX and RY of every support, a panel each.
pub(crate) fn reactions(columns: &Columns, supports: usize, span: Span) -> Figure {
    let (abscissae, label, rows) = span.abscissae(columns);
    let curve = |column: String, name: &str, style| Line {
        points: abscissae
            .iter()
            .copied()
            .zip(columns[&column][rows.clone()].iter().copied())
            .collect(),
        style,
        name: name.to_string(),
    };
    let x_scale = match span {
        Span::All => None,
        Span::LastCycle(_) => {
            let most = abscissae.iter().copied().fold(0.0, f64::max);
            Some(((most / EIGHTH_OF_TWO_TURNS).ceil() * EIGHTH_OF_TWO_TURNS, EIGHTH_OF_TWO_TURNS))
        }
    };
    let panel = |k: usize| Panel {
        title: format!("Support {k}"),
        x: label.to_string(),
        x_scale,
        y: "force on the shaft (N)".to_string(),
        lines: vec![
            curve(format!("RX{k}_N"), "RX, vertical", Style::First),
            curve(format!("RY{k}_N"), "RY, lateral", Style::Second),
        ],
        ..Panel::default()
    };
    Figure {
        title: "Reactions at the supports".to_string(),
        panels: (1..=supports).map(panel).collect(),
        columns: 2,
    }
}

/// Eccentricity of every journal in its bore, a panel each: equal axes, X upwards, the clearance circle
/// (`clearances` in µm), and a dot where the keyphasor sees the shaft (θ a multiple of 360°).
pub(crate) fn eccentricities(columns: &Columns, clearances: &[f64], span: Span) -> Figure {
    let (_, _, rows) = span.abscissae(columns);
    let what = match span {
        Span::All => "Eccentricity of the journals",
        Span::LastCycle(_) => "Eccentricity of the journals in the last cycle",
    };
    // Seen along +z, x up and y to the right: positive rotation is clockwise.
    let theta = &columns["theta_rad"][rows.clone()];
    let turned = theta.last().zip(theta.first()).map_or(0.0, |(last, first)| last - first);
    let lateral = match span {
        Span::LastCycle(_) if turned > 0.0 => "EY, lateral (µm); rotation ↻",
        Span::LastCycle(_) => "EY, lateral (µm); rotation ↺",
        Span::All => "EY, lateral (µm)",
    };
    let panel = |(index, &clearance): (usize, &f64)| {
        let k = index + 1;
        let x = &columns[&format!("EX{k}_um")][rows.clone()];
        let y = &columns[&format!("EY{k}_um")][rows.clone()];
        let at = |row: usize, part: f64| {
            let mix = |values: &[f64]| values[row] + part * (values[row + 1] - values[row]);
            Dot { at: (mix(y), mix(x)), name: "keyphasor, θ = 0°".to_string() }
        };
        Panel {
            title: format!("Support {k}"),
            x: lateral.to_string(),
            y: "EX, vertical (µm)".to_string(),
            lines: vec![
                circle(clearance),
                Line {
                    points: y.iter().copied().zip(x.iter().copied()).collect(),
                    style: Style::First,
                    name: "centre of the journal".to_string(),
                },
            ],
            dots: passages(theta).into_iter().map(|(row, part)| at(row, part)).collect(),
            equal_axes: true,
            x_scale: None,
        }
    };
    Figure {
        title: what.to_string(),
        panels: clearances.iter().enumerate().map(panel).collect(),
        columns: 2,
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

/// Angle and speed of rotation against time.
pub(crate) fn rotation(columns: &Columns) -> Figure {
    let (time, label, _) = Span::All.abscissae(columns);
    let panel = |title: &str, y: &str, values: Vec<f64>| Panel {
        title: title.to_string(),
        x: label.to_string(),
        y: y.to_string(),
        lines: vec![Line {
            points: time.iter().copied().zip(values).collect(),
            style: Style::First,
            name: "shaft".to_string(),
        }],
        ..Panel::default()
    };
    let revolutions = columns["theta_rad"].iter().map(|angle| angle / TAU).collect();
    let rpm = columns["omega_rad_s"].iter().map(|omega| omega * 60.0 / TAU).collect();
    Figure {
        title: "Rotation of the shaft".to_string(),
        panels: vec![
            panel("Angle of rotation", "angle (revolutions)", revolutions),
            panel("Speed of rotation", "speed (rpm)", rpm),
        ],
        columns: 2,
    }
}
