//! Numbers over the values of one key.

use super::cell::Cell;
use super::grid::{Grid, Ruler};
use super::quantities::{Group, Series, Topic};
use super::style::{DOUBTED, style};
use crate::figures::{Cloud, Figure, Line, Panel, Style};

/// Values up to which each is marked by a dot.
const MARKED: usize = 64;

/// A panel for each of a topic.
pub(super) fn figure(topic: &Topic, grid: &Grid, cells: &[Cell]) -> Figure {
    let panels: Vec<Panel> = topic.groups.iter().map(|own| panel(own, grid, cells)).collect();
    let ends = topic.groups.iter().flat_map(|own| &own.series).any(|own| own.columns.len() > 1);
    let title =
        if ends { format!("{}, minimum and maximum", topic.title) } else { topic.title.into() };
    Figure { title, columns: panels.len().min(2), panels }
}

/// An empty panel over an axis.
pub(super) fn over(x: &Ruler, title: &str, y: String) -> Panel {
    Panel {
        title: title.to_owned(),
        x: x.label.clone(),
        y,
        x_names: x.texts(),
        x_log: x.log,
        ..Panel::default()
    }
}

fn panel(group: &Group, grid: &Grid, cells: &[Cell]) -> Panel {
    let mut panel = over(&grid.x, &group.title, format!("{} ({})", group.quantity, group.unit));
    for (way, name) in grid.ways.iter().enumerate() {
        let along = |read: &dyn Fn(&Cell) -> f64| -> Vec<(f64, f64)> {
            let at = |k: usize| (grid.x.at(k), read(&cells[grid.place(way, 0, k)]));
            (0..grid.x.count()).map(at).collect()
        };
        if let (0, Some(limit)) = (way, group.limit) {
            // A bushing has no clearance.
            let clearance = |cell: &Cell| match cell.value(limit) {
                own if own > 0.0 => own,
                _ => f64::NAN,
            };
            for side in [-1.0, 1.0] {
                let points = along(&|cell| side * clearance(cell));
                add(&mut panel, points, Style::Limit, "radial clearance");
            }
        }
        for (k, series) in group.series.iter().enumerate() {
            let style = style(k, way);
            for column in &series.columns {
                let points = along(&|cell| cell.value(*column));
                add(&mut panel, points, style, &called(series, *name));
                let doubted = along(&|cell| match cell.is_doubted() {
                    true => cell.value(*column),
                    false => f64::NAN,
                });
                mark(&mut panel, doubted);
            }
        }
    }
    panel
}

/// The name of a series on its way.
pub(super) fn called(series: &Series, way: Option<&str>) -> String {
    way.map_or(series.name.clone(), |way| format!("{}, {way}", series.name))
}

/// Adds points with lines between them, where there are some on both sides; without lines over texts.
fn add(panel: &mut Panel, points: Vec<(f64, f64)>, style: Style, name: &str) {
    let texts = !panel.x_names.is_empty();
    let there: Vec<(f64, f64)> = points.iter().copied().filter(|own| own.1.is_finite()).collect();
    if !texts {
        for piece in points.split(|own| !own.1.is_finite()).filter(|piece| piece.len() > 1) {
            let (points, name) = (piece.to_vec(), name.to_owned());
            panel.lines.push(Line { points, style, name });
        }
    }
    if (texts || points.len() <= MARKED) && style != Style::Limit && !there.is_empty() {
        let radius = if texts { 3.0 } else { 2.0 };
        panel.clouds.push(Cloud { points: there, style, radius, name: name.to_owned() });
    }
}

/// Marks points whose numbers are not to be believed.
pub(super) fn mark(panel: &mut Panel, points: Vec<(f64, f64)>) {
    let points: Vec<(f64, f64)> = points.into_iter().filter(|own| own.1.is_finite()).collect();
    if !points.is_empty() {
        let (style, name) = (Style::Doubted, DOUBTED.to_owned());
        panel.clouds.push(Cloud { points, style, radius: 3.5, name });
    }
}
