//! A bearing as far as a case says it.

use whirl_codegen::diagnostic::Located;

use super::stations::Extent;
use crate::case;

/// A bearing as far as a case says it.
pub(in crate::machine) struct BearingOutline<'a> {
    /// Sets of the journal and of the bore.
    pub(in crate::machine) sets: [&'a [Located]; 2],
    /// The bearing, if all that it must have is there.
    pub(in crate::machine) whole: Option<&'a case::Bearing>,
    /// Names of the bodies of journal and bore, where the case names bodies.
    pub(in crate::machine) bodies: Option<[&'a str; 2]>,
    /// Where its rings may stand, where its joint says more of that than its sets.
    pub(in crate::machine) extent: Option<Extent>,
}
