//! What figures of a sweep are drawn over: one or two axes with more than one value, of very many values some.

use crate::figures::Cells;
use crate::sweep::column::{Column, Shown, numbers};
use crate::sweep::definition::Sweep;
use crate::sweep::vary::Varied;
use crate::values::level::digits;

/// Values of a curve at most, and of each axis of a map.
pub(super) const MOST_OF_CURVE: usize = 1000;
const MOST_OF_MAP: usize = 100;
/// Labels below an axis at most, where they are no numbers on a scale.
const LABELS: usize = 10;

/// One axis of a figure.
#[derive(Debug, Clone)]
pub(super) struct Ruler {
    /// The key and its unit.
    pub(super) label: String,
    /// The unit by itself; empty if there is none.
    pub(super) unit: String,
    /// The values that are drawn, as numbers that rise; none of texts.
    pub(super) values: Option<Vec<f64>>,
    /// The same as texts.
    names: Vec<String>,
    /// Their places among the values of the key.
    places: Vec<usize>,
    /// Whether they have equal ratios.
    pub(super) log: bool,
}

impl Ruler {
    /// Of a key with so many values, of which so many are drawn at most.
    fn of(key: &Varied, count: usize, most: usize) -> Self {
        let column = Column::of(key);
        let found = numbers(key, count).map(|(_, values)| values);
        let mut places: Vec<usize> = (0..count).collect();
        if let Some(values) = &found {
            places.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
        }
        if count > most {
            places = (0..most).map(|k| places[k * (count - 1) / (most - 1)]).collect();
        }
        let name = |place: &usize| match column.shown(&key.level(*place)) {
            Shown::Number(value) => digits(whirl_text::rounded(value, 4)),
            Shown::Text(text) => text,
        };
        Ruler {
            label: column.label(),
            unit: column.unit(),
            values: found.map(|values| places.iter().map(|place| values[*place]).collect()),
            names: places.iter().map(name).collect(),
            places,
            log: key.is_logarithmic(),
        }
    }

    /// The key without its unit.
    pub(super) fn name(&self) -> &str {
        self.label.strip_suffix(&format!(" ({})", self.unit)).unwrap_or(&self.label)
    }

    /// Number of values that are drawn.
    pub(super) fn count(&self) -> usize {
        self.places.len()
    }

    /// Where a value is on the axis.
    pub(super) fn at(&self, k: usize) -> f64 {
        self.values.as_ref().map_or(k as f64 + 1.0, |values| values[k])
    }

    /// What stands below the values where they are texts; nothing of numbers.
    pub(super) fn texts(&self) -> Vec<String> {
        if self.values.is_some() { Vec::new() } else { self.labels() }
    }

    /// The axis of a map: a scale where the values are evenly spaced, else a cell of the same size for each.
    pub(super) fn cells(&self) -> Cells {
        if let Some(values) = &self.values
            && let (Some(first), Some(last)) = (values.first(), values.last())
        {
            let step = (last - first) / (values.len() - 1) as f64;
            let even =
                |(k, value): (usize, &f64)| (value - first - k as f64 * step).abs() < 0.01 * step;
            if values.iter().enumerate().all(even) {
                return Cells::Even([*first, *last]);
            }
        }
        Cells::Named(self.labels())
    }

    /// Where a cell of a map is.
    pub(super) fn middle(&self, cells: &Cells, k: usize) -> f64 {
        match cells {
            Cells::Even(_) => self.at(k),
            Cells::Named(_) => k as f64 + 1.0,
        }
    }

    /// Texts of the values, of many some.
    fn labels(&self) -> Vec<String> {
        let every = self.names.len().div_ceil(LABELS).max(1);
        let label = |(k, name): (usize, &String)| match k % every {
            0 => shortened(name),
            _ => String::new(),
        };
        self.names.iter().enumerate().map(label).collect()
    }
}

/// A text with room below an axis: of a long one the end, where paths have their names.
fn shortened(text: &str) -> String {
    const MOST: usize = 18;
    let count = text.chars().count();
    if count <= MOST {
        return text.to_owned();
    }
    std::iter::once('…').chain(text.chars().skip(count - MOST + 1)).collect()
}

/// Number of values on an axis of a sweep.
pub(super) fn values(sweep: &Sweep, axis: usize) -> usize {
    sweep.keys[sweep.axes[axis].keys[0]].count().unwrap_or(1)
}

/// Axes of a sweep with more than one value; none of a Latin hypercube.
pub(super) fn varying(sweep: &Sweep) -> Vec<usize> {
    let grid = sweep.samples.is_none();
    (0..sweep.axes.len()).filter(|axis| grid && values(sweep, *axis) > 1).collect()
}

/// The points that are drawn.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    /// Whichever ways pass the values, where points go on from each other.
    pub(super) ways: Vec<Option<&'static str>>,
    pub(super) x: Ruler,
    /// Of a map.
    pub(super) y: Option<Ruler>,
    /// Numbers of points: way by way, row by row of a map, along x.
    pub(super) points: Vec<usize>,
}

impl Grid {
    /// Of a sweep over one or two axes with more than one value; none of others.
    pub(super) fn of(sweep: &Sweep) -> Option<Self> {
        let varying = varying(sweep);
        let ruler = |axis: usize, most| {
            let key = &sweep.keys[sweep.axes[axis].keys[0]];
            Ruler::of(key, values(sweep, axis), most)
        };
        let (x, y) = match varying.as_slice() {
            [x] => (ruler(*x, MOST_OF_CURVE), None),
            [x, y] => (ruler(*x, MOST_OF_MAP), Some(ruler(*y, MOST_OF_MAP))),
            _ => return None,
        };
        let ways = match sweep.along {
            Some(along) => along.ways().iter().map(|way| Some(*way)).collect(),
            None => vec![None],
        };
        let mut points = Vec::new();
        let mut places = vec![0; sweep.axes.len()];
        for way in &ways {
            for row in 0..y.as_ref().map_or(1, Ruler::count) {
                for column in 0..x.count() {
                    places[varying[0]] = x.places[column];
                    if let Some(y) = &y {
                        places[varying[1]] = y.places[row];
                    }
                    points.push(sweep.number(&places, *way));
                }
            }
        }
        Some(Grid { ways, x, y, points })
    }

    /// Place among the points, by the places of its way and its values.
    pub(super) fn place(&self, way: usize, row: usize, column: usize) -> usize {
        let rows = self.y.as_ref().map_or(1, Ruler::count);
        (way * rows + row) * self.x.count() + column
    }
}
