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
//! [bore.b_x]          # mean motion of the bore: two displacements and an angle; then one along z, and two tilts
//! unit = "m"
//! [section.gamma]     # the journal's section in its body: its turn; then a displacement along z, and two tilts
//! unit = "rad"
//! [sensor.t_x]        # the journal's body where a sensor looks at it: two displacements; then two of what it stands on
//! unit = "m"
//! [gear.phi]          # the second of two gears: the turn of its frame, and its own turn times the ratio of base radii
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
mod reader;
mod schema;
mod spec;
#[cfg(test)]
mod tests;

use std::sync::Arc;

pub use derive::Derived;
pub(super) use schema::KIND;
pub(crate) use spec::{Apart, BORE, BoreMotion, GEAR, Place, RINGS, SECTION, SENSOR};
pub use spec::{ClearanceSpec, Contact, ContactForce, ContactInput, Coordinate, RING, Taken};

use crate::diagnostic::{Diagnostics, Source};

impl ClearanceSpec {
    /// Reads a clearance file.
    ///
    /// # Errors
    /// Everything that is wrong with it, each with its place.
    pub fn read(file: &Arc<Source>) -> Result<Self, Diagnostics> {
        read::read(file)
    }
}
