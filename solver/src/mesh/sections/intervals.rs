//! Ranges along z in which rows neither begin nor end, with the rows that are there from the axis outwards.

use super::row::{SAME, SectionRow};
use crate::error::Error;
use crate::mesh::layers::{length, wrong};

/// Radii nearer than this part of the largest one are the same.
pub(super) const SAME_RADIUS: f64 = 1e-7;

/// Ends of rows may be nearer to each other than this part of the radius only if they are the same.
const SLIVER: f64 = 1e-4;
/// Walls are at least this part of the radius thick at one of their ends.
const THINNEST: f64 = 1e-4;

/// Such a range.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Interval {
    /// m.
    pub(super) z: [f64; 2],
    /// Indices of the rows, from the axis outwards.
    pub(super) rows: Vec<usize>,
}

impl Interval {
    /// The largest radius in it (m).
    pub(super) fn outer(&self, rows: &[SectionRow]) -> f64 {
        let ends = |row: &usize| self.z.map(|z| rows[*row].at(z)[1]);
        self.rows.iter().flat_map(ends).fold(0.0, f64::max)
    }
}

/// The largest radius of all (m).
pub(super) fn largest(rows: &[SectionRow]) -> f64 {
    rows.iter().flat_map(|row| row.outer).fold(0.0, f64::max)
}

/// The intervals of rows, ascending.
///
/// # Errors
/// A row that cannot be: with lengths that are none, over another one, or that touches no other.
pub(super) fn intervals(rows: &[SectionRow]) -> Result<Vec<Interval>, Error> {
    if rows.is_empty() {
        let help = "add a row: its length and its outer diameter";
        return Err(wrong("sections", "[]", "has no row", help));
    }
    rows.iter().enumerate().try_for_each(|(place, row)| shape(place, row))?;
    let ends = ends(rows);
    slivers(rows, &ends)?;
    let same = SAME_RADIUS * largest(rows);
    let mut all = Vec::with_capacity(ends.len());
    for pair in ends.windows(2) {
        let z = [pair[0], pair[1]];
        let middle = 0.5 * (z[0] + z[1]);
        let here = |row: &usize| rows[*row].z[0] < middle && middle < rows[*row].z[1];
        let mut own: Vec<usize> = (0..rows.len()).filter(here).collect();
        let radius = |row: usize| rows[row].at(middle);
        own.sort_by(|a, b| radius(*a)[0].total_cmp(&radius(*b)[0]));
        if own.is_empty() {
            let after = (0..rows.len()).find(|row| rows[*row].z[0] >= middle).unwrap_or(0);
            let what = format!(
                "leaves a gap: nothing is between z = {} and {}",
                length(z[0]),
                length(z[1])
            );
            let help = "let each row begin where another one ends";
            return Err(wrong(&called(after), rows[after].described(), what, help));
        }
        for pair in own.windows(2) {
            let [inside, around] = [pair[0], pair[1]];
            let over = |z: f64| rows[inside].at(z)[1] > rows[around].at(z)[0] + same;
            if z.into_iter().any(over) {
                // Of both the later one is the more likely mistake.
                let [first, second] = [inside.min(around), inside.max(around)];
                let what = format!(
                    "overlaps {} ({}) between z = {} and {}",
                    called(first),
                    rows[first].described(),
                    length(z[0]),
                    length(z[1])
                );
                let help = "rows at the same z are layers: let the inner diameter of one be the outer diameter of the other";
                return Err(wrong(&called(second), rows[second].described(), what, help));
            }
        }
        all.push(Interval { z, rows: own });
    }
    joined(rows, &all, same)?;
    Ok(all)
}

/// How a row is called in errors.
pub(super) fn called(row: usize) -> String {
    format!("sections[{}]", row + 1)
}

/// Refuses lengths and radii that are none.
fn shape(place: usize, row: &SectionRow) -> Result<(), Error> {
    let refuse = |what: &str, help: &str| Err(wrong(&called(place), row.described(), what, help));
    let numbers = [row.z, row.outer, row.inner];
    if numbers.iter().flatten().any(|x| !x.is_finite()) {
        return refuse("is not finite", "give lengths in m, cm, mm or another unit of length");
    }
    if row.z[1] <= row.z[0] {
        return refuse("has no length", "give a length above zero");
    }
    if row.outer.iter().any(|x| *x <= 0.0) {
        return refuse(
            "has no outer diameter at one of its ends",
            "give a diameter above zero at both ends; let a cone end with a small one",
        );
    }
    if row.inner.iter().any(|x| *x < 0.0) {
        return refuse("has a negative bore", "give 0 or a positive inner diameter");
    }
    if (row.inner[0] == 0.0) != (row.inner[1] == 0.0) {
        return refuse(
            "has a bore that ends in a point",
            "give its inner diameter at both ends, with a small one at the point",
        );
    }
    let [first, last] = [0, 1].map(|end| row.outer[end] - row.inner[end]);
    let largest = row.outer[0].max(row.outer[1]);
    if first.min(last) >= 0.0 && first.max(last) > SAME_RADIUS * largest {
        if first.max(last) < THINNEST * largest {
            let what =
                format!("has a wall of {}, too thin for solid cells", length(first.max(last)));
            return refuse(&what, "leave it out, or give the row outside of it that diameter");
        }
    } else {
        return refuse(
            "has a bore that is not smaller than the outside",
            "check inner and outer diameter; both are diameters, not radii",
        );
    }
    Ok(())
}

/// All z where a row begins or ends, ascending; what is nearly the same is the first of them.
fn ends(rows: &[SectionRow]) -> Vec<f64> {
    let mut ends: Vec<f64> = rows.iter().flat_map(|row| row.z).collect();
    ends.sort_by(f64::total_cmp);
    let same = SAME * (ends[ends.len() - 1] - ends[0]);
    ends.dedup_by(|later, first| *later - *first <= same);
    ends
}

/// Refuses ends of rows that are apart by far less than cells can be long.
fn slivers(rows: &[SectionRow], ends: &[f64]) -> Result<(), Error> {
    let [first, last] = [ends[0], ends[ends.len() - 1]];
    let same = SAME * (last - first);
    if let Some(place) = rows.iter().position(|row| row.z[1] - row.z[0] <= same) {
        let help = "leave it out, or check the units of its length";
        return Err(wrong(&called(place), rows[place].described(), "is too short for cells", help));
    }
    for pair in ends.windows(2) {
        let (z, middle) = ([pair[0], pair[1]], 0.5 * (pair[0] + pair[1]));
        let near = |row: &usize| rows[*row].z.into_iter().any(|end| (end - z[1]).abs() <= same);
        let around = rows.iter().filter(|row| row.z[0] <= middle && middle <= row.z[1]);
        let outer = around.flat_map(|row| row.outer).fold(0.0, f64::max);
        if z[1] - z[0] >= SLIVER * outer {
            continue;
        }
        let within = |row: &usize| near(row) && z[0] - rows[*row].z[0] <= same;
        let place = (0..rows.len()).find(within).or_else(|| (0..rows.len()).rfind(near));
        if let Some(place) = place {
            let what = format!(
                "makes a sliver: from z = {} to {} are {}",
                length(z[0]),
                length(z[1]),
                length(z[1] - z[0])
            );
            let help = "let rows end at the same z, or leave out what is so short";
            return Err(wrong(&called(place), rows[place].described(), what, help));
        }
    }
    Ok(())
}

/// Refuses rows that are not joined to the first one: in an interval side by side, or from one to the next one.
fn joined(rows: &[SectionRow], all: &[Interval], same: f64) -> Result<(), Error> {
    let mut group: Vec<usize> = (0..rows.len()).collect();
    let mut join = |a: usize, b: usize| {
        let (a, b) = (group[a], group[b]);
        group.iter_mut().filter(|own| **own == b).for_each(|own| *own = a);
    };
    for (place, own) in all.iter().enumerate() {
        for pair in own.rows.windows(2) {
            let apart = own.z.map(|z| rows[pair[1]].at(z)[0] - rows[pair[0]].at(z)[1]);
            if apart.iter().all(|gap| gap.abs() <= same) {
                join(pair[0], pair[1]);
            }
        }
        let Some(next) = all.get(place + 1) else { continue };
        for (&left, &right) in
            own.rows.iter().flat_map(|left| next.rows.iter().map(move |r| (left, r)))
        {
            let ([a, b], [c, d]) = (rows[left].at(own.z[1]), rows[right].at(own.z[1]));
            if b.min(d) - a.max(c) > same {
                join(left, right);
            }
        }
    }
    match (0..rows.len()).find(|row| group[*row] != group[0]) {
        None => Ok(()),
        Some(loose) => {
            let what = "touches nothing of the rest";
            let help = "let it share a face with another row: layers have the same diameter where they touch, and rows \
                        along z overlap in their radii";
            Err(wrong(&called(loose), rows[loose].described(), what, help))
        }
    }
}
