//! What is to be reduced: meshes with the dofs to retain and to hold, and the output nodes, found by the sets
//! of the case.

mod body;
mod driven;
pub(super) mod geometry;
mod matrices;

use whirl_codegen::diagnostic::Located;

pub(crate) use self::body::BodyPlan;
pub(super) use self::body::HoldingWords;
pub(super) use self::driven::Turn;
use self::geometry::stations::Extent;
use crate::case;

/// Letters of the components of a dof.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// A bearing as far as a case says it.
pub(super) struct BearingOutline<'a> {
    /// Sets of the journal and of the bore.
    pub(super) sets: [&'a [Located]; 2],
    /// The bearing, if all that it must have is there.
    pub(super) whole: Option<&'a case::Bearing>,
    /// Names of the bodies of journal and bore, where the case names bodies.
    pub(super) bodies: Option<[&'a str; 2]>,
    /// Where its rings may stand, where its joint says more of that than its sets.
    pub(super) extent: Option<Extent>,
}
