//! The clearance of springs: a formula over ring and spring coordinates, from which rates, forces and
//! tangents follow by differentiation.
//!
//! ```toml
//! kind = "clearance"
//! name = "…"
//! title = "…"
//! source = "paper and equation"
//!
//! [spring.psi]        # one angle, fixed, by which the springs of a ring differ
//! unit = "rad"
//! [constants.c]       # one length
//! unit = "m"
//! [ring.theta]        # an angle and two displacements that the springs of a ring share
//! unit = "rad"
//! [radial.delta]      # one displacement, each spring's own
//! unit = "m"
//! [definitions]       # optional
//! u_x = '…'
//! [clearance]
//! h = 'c - …'
//! [axial]             # three functions of one variable, z over the length of the bearing
//! s = ['…', '…', '…']
//! ```

mod derive;
mod read;
#[cfg(test)]
mod tests;

use std::sync::Arc;

pub use derive::{Derived, Force, Tangent};

use crate::diagnostic::{Diagnostics, Source};
use crate::expression::{Graph, Id};
use crate::formula::Formula;

/// Ring coordinates: an angle and two displacements.
pub const RING: usize = 3;
/// Rings of a bearing, between which the axial functions interpolate.
pub const RINGS: usize = 3;

/// A clearance, ready to be differentiated and scheduled.
#[derive(Debug, Clone)]
pub struct ClearanceSpec {
    /// Name of the spec.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Paper and equation.
    pub reference: String,
    /// The file.
    pub file: Arc<Source>,
    /// The fixed angle of a spring.
    pub spring: Coordinate,
    /// The radial clearance of the undeformed bearing.
    pub constant: Coordinate,
    /// Ring coordinates, in the order of the file.
    pub ring: [Coordinate; RING],
    /// The coordinate of each spring.
    pub radial: Coordinate,
    /// Definitions in the order of the file, with what they stand for.
    pub definitions: Vec<(String, Id)>,
    /// Name of the clearance, such as `h`.
    pub clearance: String,
    /// Its formula.
    pub formula: Formula,
    /// Its value in the graph.
    pub value: Id,
    /// The variable of the axial functions.
    pub axial_variable: Coordinate,
    /// The axial functions in the graph.
    pub axial: [Id; RINGS],
    /// Symbols and values, all SI.
    pub graph: Graph,
}

/// A symbol of the spec.
#[derive(Debug, Clone)]
pub struct Coordinate {
    /// Name, such as `theta`.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// SI unit.
    pub unit: String,
    /// The symbol in the graph.
    pub symbol: Id,
}

impl ClearanceSpec {
    /// Reads a clearance file.
    ///
    /// # Errors
    /// Everything that is wrong with it, each with its place.
    pub fn read(file: &Arc<Source>) -> Result<Self, Diagnostics> {
        read::read(file)
    }

    /// Rates, generalised forces and their tangents.
    ///
    /// # Errors
    /// None for a spec that was read without errors.
    pub fn derive(&self) -> Result<Derived, Diagnostics> {
        derive::derive(self)
    }
}
