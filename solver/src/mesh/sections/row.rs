//! One row of a table of sections.

use crate::mesh::Material;
use crate::mesh::layers::length;

/// z nearer than this part of the body's length are the same.
pub(super) const SAME: f64 = 1e-9;

/// A row: what is between two circles from one z to another.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionRow {
    /// From where to where along z, m.
    pub z: [f64; 2],
    /// Outer radius at both ends, m.
    pub outer: [f64; 2],
    /// Inner radius at both ends, m; 0 of a full row.
    pub inner: [f64; 2],
    /// What it is made of.
    pub material: Material,
    /// What its sets are called.
    pub name: Option<String>,
}

impl SectionRow {
    /// Inner and outer radius at a z within the row (m).
    pub(super) fn at(&self, z: f64) -> [f64; 2] {
        let [from, to] = self.z;
        [self.inner, self.outer].map(|[first, last]| {
            if z == from || first == last {
                first
            } else if z == to {
                last
            } else {
                first + (last - first) * (z - from) / (to - from)
            }
        })
    }

    /// The same half way between two z (m).
    pub(super) fn middle(&self, [from, to]: [f64; 2]) -> [f64; 2] {
        self.at(0.5 * (from + to))
    }

    /// What it is, for people.
    pub(super) fn described(&self) -> String {
        let range = |[from, to]: [f64; 2]| match from == to {
            true => length(2.0 * from),
            false => format!("{} to {}", length(2.0 * from), length(2.0 * to)),
        };
        let bore = match self.inner == [0.0; 2] {
            true => String::new(),
            false => format!(", bore {}", range(self.inner)),
        };
        format!("z {} to {}, Ø {}{bore}", length(self.z[0]), length(self.z[1]), range(self.outer))
    }
}
