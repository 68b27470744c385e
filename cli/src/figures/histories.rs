//! Reactions, eccentricity orbits, displacement and rotation out of a history, read row by row.

use std::collections::VecDeque;
use std::f64::consts::TAU;
use std::io;

use super::figure::{Dot, Figure, Line, Panel, Style};
use crate::case::SupportName;
use crate::history::{Bucket, ReadHistory, Thinned};
use crate::report::{FilmChart, last_cycle};

/// What histories are drawn over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Span {
    /// All of it, against time.
    All,
    /// The last cycle, in s, against the angle turned in it.
    LastCycle(f64),
    /// The last revolutions, in s, of a cycle of more than a person can tell apart.
    LastTurns(f64),
}

/// Revolutions that a person can tell apart.
const READABLE: f64 = 4.0;

/// Rows to draw, and what their abscissae are.
struct Rows<'h> {
    history: &'h dyn ReadHistory,
    span: Span,
    /// Where they begin in the file.
    from: u64,
    buckets: Bucket,
    /// θ of the first row (rad), and the angle turned up to the last.
    start: f64,
    turned: f64,
}

impl Span {
    /// The last cycle if the shaft turns in it, or the last revolutions of one of many; else everything.
    pub(crate) fn fitting(history: &dyn ReadHistory, cycle: f64) -> io::Result<Span> {
        let turned = |seconds: f64| -> io::Result<f64> {
            Ok(Span::LastCycle(seconds).rows(history)?.turned.abs() / TAU)
        };
        let whole = turned(cycle)?;
        if whole <= 0.5 {
            return Ok(Span::All);
        }
        // A cycle of two revolutions has not quite as many where rows do not meet its start.
        if whole <= READABLE + 0.5 {
            return Ok(Span::LastCycle(cycle));
        }
        // Twice, as the speed may change within the cycle.
        let mut seconds = cycle * READABLE / whole;
        seconds *= READABLE / turned(seconds)?.max(0.5);
        Ok(Span::LastTurns(seconds))
    }

    fn rows(self, history: &dyn ReadHistory) -> io::Result<Rows<'_>> {
        let from = match self {
            Span::All => history.start(),
            Span::LastCycle(seconds) | Span::LastTurns(seconds) => last_cycle(history, seconds)?,
        };
        let end = history.last_time()?.unwrap_or(0.0);
        let angle = |at| -> io::Result<[f64; 2]> {
            let mut found = None;
            history
                .first_row(at, &["t_s", "theta_rad"], &mut |row| found = Some([row[0], row[1]]))?;
            Ok(found.unwrap_or_default())
        };
        let ([first, start], [_, last]) = (angle(from)?, angle(history.place_of_time(end)?)?);
        let buckets = Bucket::between(first, end);
        Ok(Rows { history, span: self, from, buckets, start, turned: last - start })
    }
}

impl Rows<'_> {
    fn label(&self) -> &'static str {
        match self.span {
            Span::All => "time (ms)",
            Span::LastCycle(_) => "rotation in the last cycle (°)",
            Span::LastTurns(_) => "rotation in the last four revolutions (°)",
        }
    }

    /// Points of these columns over the abscissa.
    fn curves(&self, names: &[&str]) -> io::Result<Vec<Vec<(f64, f64)>>> {
        let columns = [&["t_s", "theta_rad"][..], names].concat();
        let mut curves: Vec<Thinned> = names.iter().map(|_| Thinned::default()).collect();
        self.history.scan(self.from, &columns, &mut |row| {
            let x = match self.span {
                Span::All => 1e3 * row[0],
                Span::LastCycle(_) | Span::LastTurns(_) => (row[1] - self.start).to_degrees(),
            };
            for (curve, y) in curves.iter_mut().zip(&row[2..]) {
                curve.push(self.buckets, row[0], (x, *y));
            }
        })?;
        Ok(curves.into_iter().map(Thinned::finish).collect())
    }

    /// An axis in eighths of two revolutions, or in whole ones where there are many, where the shaft turns forward.
    fn scale(&self, span: Span) -> Option<(f64, f64)> {
        /// Labels that have room.
        const MOST: f64 = 12.0;
        let decades =
            (0..9).flat_map(|power| [2.0, 5.0, 10.0].map(|k| 360.0 * k * 10_f64.powi(power)));
        let mut steps = [90.0, 180.0, 360.0].into_iter().chain(decades);
        let turned = self.turned.to_degrees();
        let step = steps.find(|step| turned <= MOST * step)?;
        // Not a step more for the rounding of an angle.
        let end = (turned / step - 1e-6).ceil() * step;
        (span != Span::All && end > 0.0).then_some((end, step))
    }
}

/// RX and RY of every support, a panel each.
pub(crate) fn reactions(
    history: &dyn ReadHistory,
    supports: &[SupportName],
    span: Span,
) -> io::Result<Figure> {
    let rows = span.rows(history)?;
    let columns = |own: &SupportName| ["RX", "RY"].map(|quantity| own.column(quantity, "N"));
    let names: Vec<String> = supports.iter().flat_map(columns).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let mut curves = rows.curves(&names)?.into_iter();
    let mut line = |name: &str, style| {
        let points = curves.next().expect("a curve a column");
        Line { points, style, name: name.to_string() }
    };
    let panel = |own: &SupportName| Panel {
        title: own.title.clone(),
        x: rows.label().to_string(),
        y: "force on the shaft (N)".to_string(),
        x_scale: rows.scale(span),
        lines: vec![line("RX, vertical", Style::First), line("RY, lateral", Style::Second)],
        ..Panel::default()
    };
    Ok(Figure {
        title: "Reactions at the supports".to_string(),
        panels: supports.iter().map(panel).collect(),
        columns: 2,
    })
}

/// Eccentricity of every journal in its bore, a panel each: equal axes, X upwards, the clearance circle
/// (`clearances` in µm), and a dot where the keyphasor sees the shaft (θ a multiple of 360°).
pub(crate) fn eccentricities(
    history: &dyn ReadHistory,
    supports: &[SupportName],
    clearances: &[f64],
    span: Span,
) -> io::Result<Figure> {
    let rows = span.rows(history)?;
    let what = match span {
        Span::All => "Eccentricity of the journals",
        Span::LastCycle(_) => "Eccentricity of the journals in the last cycle",
        Span::LastTurns(_) => "Eccentricity of the journals in the last four revolutions",
    };
    // Seen along +z, x up and y to the right: positive rotation is clockwise.
    let lateral = match span {
        Span::All => "EY, lateral (µm)",
        _ if rows.turned > 0.0 => "EY, lateral (µm); rotation ↻",
        _ => "EY, lateral (µm); rotation ↺",
    };
    let orbits = orbits(&rows, supports)?;
    let panel = |((own, &clearance), (points, dots)): ((&SupportName, &f64), Orbit)| {
        let name = "centre of the journal".to_string();
        let dot = |at| Dot { at, name: "keyphasor, θ = 0°".to_string() };
        Panel {
            title: own.title.clone(),
            x: lateral.to_string(),
            y: "EX, vertical (µm)".to_string(),
            lines: circle(clearance)
                .into_iter()
                .chain([Line { points, style: Style::First, name }])
                .collect(),
            dots: dots.into_iter().map(dot).collect(),
            equal_axes: true,
            ..Panel::default()
        }
    };
    Ok(Figure {
        title: what.to_string(),
        panels: supports.iter().zip(clearances).zip(orbits).map(panel).collect(),
        columns: 2,
    })
}

/// Points (EY, EX) of a journal, and those at which the keyphasor sees the shaft, the last ones if they are many.
type Orbit = (Vec<(f64, f64)>, VecDeque<(f64, f64)>);

fn orbits(rows: &Rows, supports: &[SupportName]) -> io::Result<Vec<Orbit>> {
    const MOST_DOTS: usize = 256;
    let columns = |own: &SupportName| ["EY", "EX"].map(|quantity| own.column(quantity, "um"));
    let names: Vec<String> = supports.iter().flat_map(columns).collect();
    let supports = supports.len();
    let mut all = vec!["t_s", "theta_rad"];
    all.extend(names.iter().map(String::as_str));
    let mut curves: Vec<Thinned> = (0..supports).map(|_| Thinned::default()).collect();
    let mut dots = vec![VecDeque::new(); supports];
    let mut before: Option<Vec<f64>> = None;
    rows.history.scan(rows.from, &all, &mut |row| {
        for (curve, at) in curves.iter_mut().zip(row[2..].chunks_exact(2)) {
            curve.push(rows.buckets, row[0], (at[0], at[1]));
        }
        if let Some(before) = &mut before {
            if let Some(part) = passage(before[1], row[1]) {
                let mix = |place: usize| before[place] + part * (row[place] - before[place]);
                for (k, dots) in dots.iter_mut().enumerate() {
                    if dots.len() == MOST_DOTS {
                        dots.pop_front();
                    }
                    dots.push_back((mix(2 + 2 * k), mix(3 + 2 * k)));
                }
            }
            before.copy_from_slice(row);
        } else {
            before = Some(row.to_vec());
        }
    })?;
    Ok(curves.into_iter().map(Thinned::finish).zip(dots).collect())
}

/// The part of a step after which θ passes a whole revolution, if it does.
fn passage(before: f64, after: f64) -> Option<f64> {
    let (before, after) = (before / TAU, after / TAU);
    let whole = after.floor();
    (before < whole && after > before).then(|| (whole - before) / (after - before))
}

/// Orbits without the clearance circle, each axis filled by the orbit: its shape, where it is flat.
pub(crate) fn stretched(orbits: &Figure) -> Figure {
    let panel = |panel: &Panel| Panel {
        lines: panel.lines.iter().filter(|line| line.style != Style::Limit).cloned().collect(),
        equal_axes: false,
        ..panel.clone()
    };
    Figure {
        title: format!("{}, axes not to scale", orbits.title),
        panels: orbits.panels.iter().map(panel).collect(),
        columns: orbits.columns,
    }
}

/// The clearance, where there is one: a bushing has none.
fn circle(radius: f64) -> Option<Line> {
    const CORNERS: usize = 180;
    let corner = |i: usize| {
        let (sin, cos) = (TAU * i as f64 / CORNERS as f64).sin_cos();
        (radius * cos, radius * sin)
    };
    (radius > 0.0).then(|| Line {
        points: (0..=CORNERS).map(corner).collect(),
        style: Style::Limit,
        name: "radial clearance".to_string(),
    })
}

/// What is in films, a panel each.
pub(crate) fn films(
    history: &dyn ReadHistory,
    charts: &[FilmChart],
    span: Span,
) -> io::Result<Figure> {
    let rows = span.rows(history)?;
    let lines = charts.iter().flat_map(|own| own.lines.iter());
    let names: Vec<&str> = lines.map(|own| own.0.as_str()).collect();
    let mut curves = rows.curves(&names)?.into_iter();
    let styles = [Style::First, Style::Second, Style::Third, Style::Fourth];
    let panel = |own: &FilmChart| {
        let lines = own.lines.iter().zip(styles.into_iter().cycle());
        let line = |((_, name), style): (&(String, String), Style)| {
            let points = curves.next().expect("a curve a column");
            // Of one alone the title says what it is.
            let name = if own.lines.len() == 1 { "in the film" } else { name };
            Line { points, style, name: name.to_owned() }
        };
        Panel {
            title: own.title.clone(),
            x: rows.label().to_string(),
            y: format!("{} ({})", own.quantity, own.unit),
            x_scale: rows.scale(span),
            lines: lines.map(line).collect(),
            ..Panel::default()
        }
    };
    let title = "Oil films".to_string();
    Ok(Figure { title, panels: charts.iter().map(panel).collect(), columns: 2 })
}

/// Displacement along x of the first journal against time, in mm.
pub(crate) fn displacement(history: &dyn ReadHistory) -> io::Result<Figure> {
    let rows = Span::All.rows(history)?;
    let mut points = rows.curves(&["X1_um"])?.remove(0);
    points.iter_mut().for_each(|point| point.1 *= 1e-3);
    let panel = Panel {
        x: rows.label().to_string(),
        y: "displacement (mm)".to_string(),
        lines: vec![Line { points, style: Style::First, name: "displacement".to_string() }],
        ..Panel::default()
    };
    let title = "Displacement of the mass".to_string();
    Ok(Figure { title, panels: vec![panel], columns: 1 })
}

/// Angle and speed of rotation against time: of the shaft, or of each of `bodies`, two panels each.
pub(crate) fn rotation(history: &dyn ReadHistory, bodies: &[String]) -> io::Result<Figure> {
    let rows = Span::All.rows(history)?;
    let shaft = ["shaft".to_string()];
    let bodies = if bodies.is_empty() { &shaft } else { bodies };
    let of = |body: &str| match bodies.len() {
        1 => String::new(),
        _ => format!(" of {body}"),
    };
    let (mut panels, mut names) = (Vec::new(), Vec::new());
    for (place, body) in bodies.iter().enumerate() {
        // The columns of the first one carry no name.
        let label = if place == 0 { String::new() } else { format!("_{body}") };
        for (title, y, quantity, scale) in [
            ("Angle of rotation", "angle (revolutions)", "theta{}_rad", 1.0 / TAU),
            ("Speed of rotation", "speed (rpm)", "omega{}_rad_s", 60.0 / TAU),
        ] {
            names.push(quantity.replace("{}", &label));
            // Titles say which body, where there are several.
            let name = if bodies.len() == 1 { body } else { "rotation" };
            panels.push((format!("{title}{}", of(body)), y, scale, name));
        }
    }
    let panel = |(mut points, (title, y, scale, name)): (Vec<(f64, f64)>, (_, &str, f64, &str))| {
        points.iter_mut().for_each(|point| point.1 *= scale);
        Panel {
            title,
            x: rows.label().to_string(),
            y: y.to_string(),
            lines: vec![Line { points, style: Style::First, name: name.to_owned() }],
            ..Panel::default()
        }
    };
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let curves = rows.curves(&names)?;
    let what = if bodies.len() == 1 { "of the shaft" } else { "of the bodies" };
    Ok(Figure {
        title: format!("Rotation {what}"),
        panels: curves.into_iter().zip(panels).map(panel).collect(),
        columns: 2,
    })
}
