//! Round bodies from tables of their sections: rows along the axis, with cones, steps, bores and layers.
//!
//! A [`SectionTable`] is cut into `intervals`, in which rows neither begin nor end; layers of cells and the radii at their
//! ends make a `partition`; `strip` joins the radii of two neighbouring planes by quadrilaterals and triangles, and
//! `solid` turns these about the axis.

mod intervals;
mod partition;
mod row;
mod solid;
mod strip;

use whirl_specs::Element;

use self::intervals::{Interval, intervals};
use self::partition::Partition;
pub use self::row::SectionRow;
use super::fineness::Beam;
use super::layers::{MOST_CELLS, wrong};
use super::shaft::{ROUND, shear_ratio};
use super::{Fineness, Mesh};
use crate::error::Error;

/// Part by which frequencies of bending may be off where a case says nothing.
pub const TOLERANCE: f64 = 1e-4;
/// Layers are at most this part of the outer diameter long, times a whole number that says how fine the mesh is.
const LONGEST: f64 = 1.0;
/// A layer ends at a wanted plane unless one does so near, as a part of the outer radius.
const NEAR: f64 = 5e-3;

/// How fine the mesh is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TableCells {
    /// Around the axis; even, 6 at least.
    pub sectors: usize,
    /// Layers and rings are made so many times as fine.
    pub refine: usize,
    /// Part by which the three lowest frequencies of bending of a beam of equal section may be off.
    pub tolerance: f64,
}

impl Default for TableCells {
    fn default() -> Self {
        TableCells { sectors: 12, refine: 1, tolerance: TOLERANCE }
    }
}

/// A round body about z, from rows that touch each other.
///
/// Cells are quadratic: hexahedra, wedges around a full centre, and wedges about the axis where radii of both ends of a layer
/// differ in number. Circles have the second moments of area of their diameters. Node sets: `LEFT_END` and `RIGHT_END`, all
/// nodes of the sections at the ends; of a row with a name, its outer surface `NAME` and its bore `NAME_BORE`, as far as they
/// are free; `Nall`. Element sets: of a row with a name `NAME`; `Ewedge15`, `Ehex20`.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionTable {
    /// In any order.
    pub rows: Vec<SectionRow>,
    /// z at which layers are to end, m: of discs, bearings, probes and loads.
    pub planes: Vec<f64>,
    /// How fine it is.
    pub cells: TableCells,
}

impl SectionTable {
    /// The mesh, with the elements of `elements` that Abaqus calls C3D15 and C3D20.
    ///
    /// # Errors
    /// [`Error::Dimension`] naming the row that cannot be (`sections[k]`, k from 1) or the number of cells,
    /// [`Error::Mesh`] for a missing element.
    pub fn mesh(&self, elements: &[&'static Element]) -> Result<Mesh, Error> {
        let partition = self.partition()?;
        solid::mesh((&self.rows, self.cells.sectors), &partition, elements)
    }

    /// z between its layers of cells (m), ascending; none where its rows cannot be.
    pub fn planes_of_cells(&self) -> Option<Vec<f64>> {
        Some(self.layers(&intervals(&self.rows).ok()?))
    }

    /// How fine its layers are; none where its rows cannot be.
    pub fn fineness(&self) -> Option<Fineness> {
        let intervals = intervals(&self.rows).ok()?;
        let planes = self.layers(&intervals);
        let whole = extent(&intervals);
        let (mut longest, mut error) = (0.0, 0.0);
        for pair in planes.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let own = intervals.iter().find(|own| from < own.z[1])?;
            longest = f64::max(longest, to - from);
            error = f64::max(error, self.beam(own, whole).quadratic_error(to - from));
        }
        Some(Fineness { order: 2, longest, error })
    }

    fn partition(&self) -> Result<Partition, Error> {
        let TableCells { sectors, refine, .. } = self.cells;
        if sectors < 6 || !sectors.is_multiple_of(2) {
            let help = "make it 8, 12, 16 or another even number";
            return Err(wrong("cells.sectors", sectors, "is not an even number from 6 on", help));
        }
        let intervals = intervals(&self.rows)?;
        let planes = self.layers(&intervals);
        let most = MOST_CELLS / sectors;
        let too_many = |count: usize| {
            let what = format!(
                "makes too many cells: more than {} in {count} layers around {sectors} sectors, where a mesh made from \
                 sections has at most {MOST_CELLS}",
                count.saturating_mul(sectors)
            );
            let help = match refine {
                0 | 1 => "check the units of lengths and diameters, or raise `cells.tolerance`",
                _ => "refine less, or raise `cells.tolerance`",
            };
            wrong("cells.refine", refine, what, help)
        };
        if planes.len() > most {
            return Err(too_many(planes.len() - 1));
        }
        let partition = Partition::new(&self.rows, &intervals, planes, refine);
        if partition.cells() > most {
            return Err(too_many(partition.layers()));
        }
        Ok(partition)
    }

    /// z between layers of cells, ascending.
    fn layers(&self, intervals: &[Interval]) -> Vec<f64> {
        let whole = extent(intervals);
        let mut ends: Vec<f64> = intervals.iter().map(|own| own.z[0]).collect();
        ends.extend(intervals.last().map(|own| own.z[1]));
        let mut wanted = self.planes.clone();
        wanted.sort_by(f64::total_cmp);
        for z in wanted {
            let Some(own) = intervals.iter().find(|own| own.z[0] < z && z < own.z[1]) else {
                continue;
            };
            let near = NEAR * own.outer(&self.rows);
            if ends.iter().all(|end| (end - z).abs() > near) {
                let place = ends.partition_point(|end| *end < z);
                ends.insert(place, z);
            }
        }
        let refine = self.cells.refine.max(1);
        let mut planes = Vec::new();
        for pair in ends.windows(2) {
            let [from, to] = [pair[0], pair[1]];
            let Some(own) = intervals.iter().find(|own| from < own.z[1]) else { continue };
            let of_beam = self.beam(own, whole).longest_layer(self.cells.tolerance);
            let longest = of_beam.min(2.0 * LONGEST * own.outer(&self.rows));
            let count =
                ((to - from) / longest - 1e-9).ceil().clamp(1.0, MOST_CELLS as f64) as usize;
            let count = count.saturating_mul(refine).min(MOST_CELLS);
            planes.extend((0..count).map(|k| from + (to - from) * k as f64 / count as f64));
        }
        planes.extend(ends.last());
        planes
    }

    /// A beam as long as the body with the section of an interval.
    fn beam(&self, own: &Interval, whole: f64) -> Beam {
        let (mut area, mut moment, mut shear) = (0.0, 0.0, 0.0);
        for &row in &own.rows {
            let [inner, outer] = self.rows[row].middle(own.z);
            area += outer.powi(2) - inner.powi(2);
            moment += 0.25 * (outer.powi(4) - inner.powi(4));
            shear = f64::max(shear, ROUND * shear_ratio(&self.rows[row].material));
        }
        Beam { length: whole, area_over_moment: area / moment, shear }
    }
}

/// From the first to the last z (m).
fn extent(intervals: &[Interval]) -> f64 {
    match intervals {
        [first, .., last] => last.z[1] - first.z[0],
        [only] => only.z[1] - only.z[0],
        [] => 0.0,
    }
}

#[cfg(test)]
mod tests;
