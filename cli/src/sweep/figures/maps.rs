//! Numbers over the values of two keys, as colours.

use super::cell::Cell;
use super::grid::Grid;
use super::quantities::{Group, Series, Topic};
use super::style::DOUBTED;
use crate::figures::{Cloud, Figure, Map, Panel, Style};

/// A panel for each number of a topic; of those with a least and a largest value the larger size.
pub(super) fn figure(topic: &Topic, grid: &Grid, cells: &[Cell]) -> Option<Figure> {
    let mut panels = Vec::new();
    let mut columns = 1;
    for group in &topic.groups {
        let before = panels.len();
        for series in &group.series {
            let ways = grid.ways.iter().enumerate();
            panels.extend(ways.filter_map(|way| panel((group, series), way, grid, cells)));
        }
        columns = columns.max(panels.len() - before);
    }
    (!panels.is_empty()).then(|| Figure { title: topic.title.to_owned(), columns, panels })
}

/// The sizes of a series; none where no point has one.
fn panel(
    (group, series): (&Group, &Series),
    (way, name): (usize, &Option<&str>),
    grid: &Grid,
    cells: &[Cell],
) -> Option<Panel> {
    let y = grid.y.as_ref()?;
    let cell = |row: usize, column: usize| &cells[grid.place(way, row, column)];
    let size = |row: usize, column: usize| cell(row, column).largest(&series.columns);
    let row = |row: usize| (0..grid.x.count()).map(|column| size(row, column)).collect();
    let values: Vec<Vec<f64>> = (0..y.count()).map(row).collect();
    if !values.iter().flatten().any(|own| own.is_finite()) {
        return None;
    }
    let (across, up) = (grid.x.cells(), y.cells());
    let mut doubted = Vec::new();
    for row in 0..y.count() {
        for column in (0..grid.x.count()).filter(|column| cell(row, *column).is_doubted()) {
            doubted.push((grid.x.middle(&across, column), y.middle(&up, row)));
        }
    }
    let what = match series.columns.len() {
        1 => series.symbol.clone(),
        _ => format!("largest |{}|", series.symbol),
    };
    let way = name.map_or(String::new(), |way| format!(", {way}"));
    let what = format!("{what} ({}){way}", group.unit);
    let title = if group.title.is_empty() { what } else { format!("{}, {what}", group.title) };
    let (style, name) = (Style::Doubted, DOUBTED.to_owned());
    let clouds = Cloud { points: doubted, style, radius: 2.5, name };
    Some(Panel {
        title,
        x: grid.x.label.clone(),
        y: y.label.clone(),
        clouds: if clouds.points.is_empty() { Vec::new() } else { vec![clouds] },
        map: Some(Map { x: across, y: up, values }),
        ..Panel::default()
    })
}
