//! What is drawn of a point.

use std::collections::BTreeMap;

use crate::sweep::kept::Kept;
use crate::sweep::row::Verdict;
use crate::sweep::trace::Trace;

/// A point: what it came to, if it is done.
#[derive(Debug, Default)]
pub(super) struct Cell {
    pub(super) verdict: Option<Verdict>,
    /// The numbers that are wanted, in their order; NaN where there is none.
    pub(super) values: Vec<f64>,
    pub(super) trace: Option<Trace>,
}

impl Cell {
    /// Whether its numbers are not to be believed.
    pub(super) fn is_doubted(&self) -> bool {
        self.verdict == Some(Verdict::NotSound)
    }

    /// The one with the largest size of some of its numbers; NaN without one.
    pub(super) fn largest(&self, columns: &[usize]) -> f64 {
        let values = columns.iter().filter_map(|column| self.values.get(*column));
        values.map(|own| own.abs()).fold(f64::NAN, f64::max)
    }

    /// A number of its own; NaN if it has none.
    pub(super) fn value(&self, column: usize) -> f64 {
        self.values.get(column).copied().unwrap_or(f64::NAN)
    }
}

/// The points with these numbers, of each what is `wanted`. Those that failed have no numbers.
///
/// # Errors
/// The journal cannot be read, in words.
pub(super) fn cells(
    kept: &mut Kept,
    points: &[usize],
    wanted: &[String],
) -> Result<Vec<Cell>, String> {
    let mut places: BTreeMap<usize, Vec<Option<usize>>> = BTreeMap::new();
    let mut all = Vec::with_capacity(points.len());
    for number in points {
        let Some((list, row)) = kept.row(*number)? else {
            all.push(Cell::default());
            continue;
        };
        let names = &kept.names[list];
        let places = places.entry(list).or_insert_with(|| {
            let place = |own: &String| names.iter().position(|name| name == own);
            wanted.iter().map(place).collect()
        });
        let value = |place: &Option<usize>| match place {
            Some(place) if row.verdict != Verdict::Failed => row.values[*place],
            _ => f64::NAN,
        };
        let values = places.iter().map(value).collect();
        all.push(Cell { verdict: Some(row.verdict), values, trace: row.trace });
    }
    Ok(all)
}
