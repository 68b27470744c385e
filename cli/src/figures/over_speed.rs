//! Orders and envelopes over the speed of a run-up or a run-down.

use std::collections::BTreeSet;
use std::io;

use super::figure::{Figure, Line, Panel, Style};
use crate::history::ReadHistory;
use crate::report::{Enveloper, Oscillation, Tracker, varying};

/// Panels at most.
const MOST: usize = 12;
/// Parts below 1X that are shown reach this share of all motion somewhere.
const WHIRLS: f64 = 0.2;
/// The abscissa where the speed rises or falls all along.
const SPEED: &str = "speed (rpm)";

/// Styles of both lines of each column.
const STYLES: [[Style; 2]; 3] =
    [[Style::First, Style::Third], [Style::Second, Style::Fourth], [Style::Thin; 2]];

/// What is drawn of a signal: names, styles and values of its lines.
type Lines = Vec<(String, Style, Vec<f64>)>;

/// The signals that turn with one angle.
struct Turning<'a> {
    angle: &'a str,
    /// The angles of other bodies.
    others: Vec<&'a str>,
    /// First and last angle (rad).
    span: [f64; 2],
    signals: Vec<&'a Oscillation>,
}

impl Turning<'_> {
    /// Columns of the rows: time, angle, the other angles, and those of the signals.
    fn names(&self) -> Vec<&str> {
        let own = self.signals.iter().flat_map(|own| own.columns.iter().map(|own| own.0.as_str()));
        ["t_s", self.angle].into_iter().chain(self.others.iter().copied()).chain(own).collect()
    }

    /// The angle, the other angles and the columns by their places.
    fn places(&self) -> (usize, Vec<usize>, Vec<usize>) {
        let first = 2 + self.others.len();
        (1, (2..first).collect(), (first..self.names().len()).collect())
    }

    fn panels(
        &self,
        (time, rpm): (&[f64], &[f64]),
        (suffix, mut lines): (&str, impl FnMut(&Oscillation) -> Lines),
    ) -> Vec<Panel> {
        let steps = |pair: &[f64], sense: f64| sense * (pair[1] - pair[0]) > 0.0;
        let over_speed =
            [1.0, -1.0].iter().any(|sense| rpm.windows(2).all(|own| steps(own, *sense)));
        let (x, label) = if over_speed { (rpm, SPEED) } else { (time, "time (s)") };
        let panel = |own: &&Oscillation| Panel {
            title: own.title.clone(),
            x: label.to_owned(),
            y: format!("{}{suffix} ({})", own.quantity, own.unit),
            lines: lines(own)
                .into_iter()
                .map(|(name, style, y)| Line {
                    points: x.iter().copied().zip(y).collect(),
                    style,
                    name,
                })
                .collect(),
            ..Panel::default()
        };
        self.signals.iter().map(panel).collect()
    }
}

/// The signals of angles whose speed varies.
fn turning<'a>(
    history: &dyn ReadHistory,
    all: &'a [Oscillation],
    begins: f64,
) -> io::Result<Vec<Turning<'a>>> {
    let Some(ends) = history.last_time()? else { return Ok(Vec::new()) };
    let shown = &all[..all.len().min(MOST)];
    let angles: BTreeSet<&str> = shown.iter().filter_map(|own| own.angle.as_deref()).collect();
    let angles: Vec<&str> = angles.into_iter().collect();
    let found = varying(history, &angles, [begins, ends])?;
    let of = |(place, span): (usize, [f64; 2])| {
        let angle = angles[place];
        let signals = shown.iter().filter(|own| own.angle.as_deref() == Some(angle)).collect();
        let others = angles.iter().copied().filter(|own| *own != angle).collect();
        Turning { angle, others, span, signals }
    };
    Ok(found.into_iter().map(of).collect())
}

/// Names of a quantity along the axes of a signal.
fn named(what: &str, own: &Oscillation, axis: &str) -> String {
    match own.columns.len() {
        1 => what.to_owned(),
        _ => format!("{what} {}", axis.to_lowercase()),
    }
}

fn figure(what: &str, panels: Vec<Panel>) -> Option<Figure> {
    let columns = if panels.len() > 1 { 2 } else { 1 };
    let over = if panels.iter().all(|own| own.x == SPEED) { "speed" } else { "the run" };
    (!panels.is_empty()).then(|| Figure { title: format!("{what} over {over}"), panels, columns })
}

/// Amplitudes of 1X and 2X, of the largest part below 1X where it matters, and half of largest less least value; none where the speed does not vary over enough revolutions.
///
/// # Errors
/// The history cannot be read.
pub(super) fn orders(
    history: &dyn ReadHistory,
    all: &[Oscillation],
    begins: f64,
) -> io::Result<Option<Figure>> {
    let mut panels = Vec::new();
    for own in turning(history, all, begins)? {
        let names = own.names();
        let Some(mut tracker) = Tracker::new(own.places(), own.span) else { continue };
        history.scan(history.start(), &names, &mut |row| tracker.add(row[0], row))?;
        let names: Vec<String> = names.into_iter().map(str::to_owned).collect();
        let Some(found) = tracker.finish(&names) else { continue };
        let lines = |signal: &Oscillation| {
            let mut lines = Lines::new();
            let mut overall = vec![0.0_f64; found.time.len()];
            for ((column, axis), styles) in signal.columns.iter().zip(STYLES) {
                let Some(one) = found.signals.iter().find(|own| own.column == *column) else {
                    continue;
                };
                for ((what, style), values) in
                    ["1X", "2X"].into_iter().zip(styles).zip(&one.amplitudes)
                {
                    lines.push((named(what, signal, axis), style, values.clone()));
                }
                // What is small beside all motion is no whirl but the rest of a fit.
                let below = &one.below[0];
                if below.iter().zip(&one.overall).any(|(own, all)| *own > WHIRLS * all) {
                    let name = named("largest below 1X", signal, axis);
                    lines.push((name, Style::Doubted, below.clone()));
                }
                overall.iter_mut().zip(&one.overall).for_each(|(most, own)| *most = most.max(*own));
            }
            lines.push(("overall".to_owned(), Style::Limit, overall));
            lines
        };
        panels.extend(own.panels((&found.time, &found.rpm), (", zero to peak", lines)));
    }
    Ok(figure("Orders", panels))
}

/// Least and largest value of every revolution, or of a few; none where the speed does not vary.
///
/// # Errors
/// The history cannot be read.
pub(super) fn envelope(
    history: &dyn ReadHistory,
    all: &[Oscillation],
    begins: f64,
) -> io::Result<Option<Figure>> {
    let mut panels = Vec::new();
    for own in turning(history, all, begins)? {
        let names = own.names();
        let (angle, _, columns) = own.places();
        let mut enveloper = Enveloper::new((angle, columns), own.span);
        history.scan(history.start(), &names, &mut |row| enveloper.add(row[0], row))?;
        let names: Vec<String> = names.into_iter().map(str::to_owned).collect();
        let Some(found) = enveloper.finish(&names) else { continue };
        let lines = |signal: &Oscillation| {
            let mut lines = Lines::new();
            for ((column, axis), [most, least]) in signal.columns.iter().zip(STYLES) {
                let Some(one) = found.signals.iter().find(|own| own.column == *column) else {
                    continue;
                };
                lines.push((named("largest", signal, axis), most, one.most.clone()));
                lines.push((named("least", signal, axis), least, one.least.clone()));
            }
            lines
        };
        panels.extend(own.panels((&found.time, &found.rpm), ("", lines)));
    }
    Ok(figure("Envelope", panels))
}
