//! Numbers of a Latin hypercube over each of its keys.

use super::cell::Cell;
use super::curves::mark;
use super::quantities::{Group, Topic};
use super::style::style;
use crate::figures::{Cloud, Figure, Panel};
use crate::sweep::column::{Column, Shown};
use crate::sweep::definition::Sweep;
use crate::sweep::points::Point;

/// Points that are drawn, at most: the first ones, which are drawn at random as all are.
const MOST: usize = 2000;
/// Keys that are drawn, at most.
const KEYS: usize = 6;

/// Points of a Latin hypercube over the keys that have numbers.
pub(super) struct Samples {
    pub(super) points: Vec<usize>,
    /// Of each key: its name and unit, and a number a point.
    keys: Vec<(String, Vec<f64>)>,
}

impl Samples {
    /// Of a sweep that is a Latin hypercube over numbers; none of others.
    pub(super) fn of(sweep: &Sweep) -> Option<Self> {
        let count = sweep.samples?.min(MOST);
        let points: Vec<_> = (0..count).map(|number| sweep.point(number)).collect();
        let mut keys = Vec::new();
        for (place, key) in sweep.keys.iter().enumerate() {
            let column = Column::of(key);
            let value = |point: &Point| match column.shown(&point.levels[place]) {
                Shown::Number(value) => Some(value),
                Shown::Text(_) => None,
            };
            let values: Option<Vec<f64>> = points.iter().map(value).collect();
            keys.extend(values.map(|values| (column.label(), values)));
        }
        keys.truncate(KEYS);
        (!keys.is_empty()).then(|| Samples { points: (0..count).collect(), keys })
    }
}

/// A row of panels for each of a topic, a key a panel; of numbers with a least and a largest value the larger size.
pub(super) fn figure(topic: &Topic, samples: &Samples, cells: &[Cell]) -> Figure {
    let mut panels = Vec::new();
    for group in &topic.groups {
        panels.extend(samples.keys.iter().map(|key| panel(group, key, cells)));
    }
    let ends = topic.groups.iter().flat_map(|own| &own.series).any(|own| own.columns.len() > 1);
    let title =
        if ends { format!("{}, largest magnitude", topic.title) } else { topic.title.to_owned() };
    Figure { title, columns: samples.keys.len(), panels }
}

fn panel(group: &Group, (label, values): &(String, Vec<f64>), cells: &[Cell]) -> Panel {
    let mut panel = Panel {
        title: group.title.clone(),
        x: label.clone(),
        y: format!("{} ({})", group.quantity, group.unit),
        ..Panel::default()
    };
    for (k, series) in group.series.iter().enumerate() {
        let at = |(x, cell): (&f64, &Cell)| (*x, cell.largest(&series.columns));
        let all: Vec<(f64, f64)> = values.iter().zip(cells).map(at).collect();
        let doubted = values.iter().zip(cells).filter(|(_, cell)| cell.is_doubted()).map(at);
        let points = all.iter().copied().filter(|own| own.1.is_finite()).collect();
        let name = series.name.clone();
        panel.clouds.push(Cloud { points, style: style(k, 0), radius: 2.0, name });
        mark(&mut panel, doubted.collect());
    }
    panel
}
