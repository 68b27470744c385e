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
//! [apart]             # axes of journal and bore that are apart: added to the ring's displacements, by the journal's angle
//! phi = { D_x = '…', D_y = '…' }
//! ```
//!
//! Laws that take or give more than Q(h, ḣ) need further measures of the motion:
//!
//! ```toml
//! [constants.R]       # a second length: the journal's radius
//! unit = "m"
//! [tangential.tau]    # the bore's other displacement at each spring
//! unit = "m"
//! [bore.b_x]          # mean motion of the bore: two displacements and an angle
//! unit = "m"
//! [section.gamma]     # turn of the journal's section against the frame of its body
//! unit = "rad"
//! [measures.s]
//! value = 'R*theta - …'
//! rate = "v_t"        # what laws call its rate; `s_dot` if it says nothing
//! force = "T"         # the force that works on it, if laws may give one
//! [laws.spring]       # a kind of law: what it may take (measures, rates, shared coordinates, the angle)
//! inputs = ["h", "h_dot", "v_t", "theta", "psi"]
//! forces = ["Q", "T"]
//! ```

mod derive;
mod explain;
mod kernels;
mod kinds;
mod read;
mod schema;
#[cfg(test)]
mod tests;

use std::sync::Arc;

pub use derive::{Contact, ContactForce, ContactInput, Derived, Taken};
pub(super) use schema::KIND;

use crate::diagnostic::{Diagnostics, Source};
use crate::expression::{Graph, Id};
use crate::formula::Formula;
use crate::spec::kind::About;

/// Ring coordinates: an angle and two displacements.
pub const RING: usize = 3;
/// Coordinates of the mean motion of a bore: two displacements and an angle.
pub(crate) const BORE: usize = 3;
/// Rings of a bearing, between which the axial functions interpolate.
pub(crate) const RINGS: usize = 3;

/// A clearance, ready to be differentiated and scheduled.
#[derive(Debug, Clone)]
pub struct ClearanceSpec {
    /// Name of the spec.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Paper and equation.
    pub(crate) reference: String,
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
    /// Radius of the journal, if the spec has it.
    pub(crate) radius: Option<Coordinate>,
    /// Displacement of the bore along the tangent at each spring, if the spec has it.
    pub(crate) tangential: Option<Coordinate>,
    /// Mean displacements of the bore along x and y and its mean turn, if the spec has them.
    pub(crate) bore: Option<[Coordinate; BORE]>,
    /// Mean turn of the journal's section against the frame of its body, if the spec has it.
    pub(crate) section: Option<Coordinate>,
    /// Kinds of laws, that of Q(h, ḣ) first.
    pub contacts: Vec<Contact>,
    /// Names and values of the measures, the clearance first.
    pub(crate) measures: Vec<(String, Id)>,
    /// Definitions in the order of the file, with what they stand for.
    pub(crate) definitions: Vec<(String, Id)>,
    /// Name of the clearance, such as `h`.
    pub(crate) clearance: String,
    /// Its formula.
    pub(crate) formula: Formula,
    /// Its value in the graph.
    pub value: Id,
    /// The variable of the axial functions.
    pub(crate) axial_variable: Coordinate,
    /// The axial functions in the graph.
    pub(crate) axial: [Id; RINGS],
    /// What axes that are apart add to the ring's displacements.
    pub(crate) apart: Apart,
    /// Symbols and values of the measures, the axial functions and of axes that are apart, all SI.
    pub graph: Graph,
}

/// A way in which a bore moves, or the journal's section in its body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum BoreMotion {
    /// Outwards at a spring.
    Radial,
    /// Along the tangent at a spring.
    Tangential,
    /// All around, along x.
    MeanX,
    /// All around, along y.
    MeanY,
    /// All around, turning.
    MeanTurn,
    /// None of the bore: the journal's section, turning against the frame of its body.
    SectionTurn,
}

/// Axes of journal and bore that are apart.
#[derive(Debug, Clone)]
pub(crate) struct Apart {
    /// Angle of the journal's body.
    pub(crate) angle: Coordinate,
    /// How far its axis stands from that of the bore, in space.
    pub(crate) distances: [Coordinate; 2],
    /// What is added to the displacements of the ring.
    pub(crate) values: [Id; 2],
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
    /// What it says about itself.
    pub(crate) fn about(&self) -> About<'_> {
        let ClearanceSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: Vec::new() }
    }

    /// Reads a clearance file.
    ///
    /// # Errors
    /// Everything that is wrong with it, each with its place.
    pub fn read(file: &Arc<Source>) -> Result<Self, Diagnostics> {
        read::read(file)
    }

    /// Kinds of laws of this name; those of springs are laws Q(h, ḣ), too.
    pub(crate) fn contacts_of<'s>(&'s self, name: &'s str) -> impl Iterator<Item = &'s Contact> {
        self.contacts.iter().filter(move |contact| {
            contact.name == name || contact.name == derive::NORMAL && name == "spring"
        })
    }
}
