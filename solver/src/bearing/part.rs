//! The laws of bearings, one by one.

use super::Bearing;
use super::other::OtherMotion;

/// A law in a bearing: on the displacement in its planes, or on another motion.
#[derive(Clone, Copy)]
pub(super) struct Part<'a> {
    /// Number of the bearing.
    pub(super) number: usize,
    pub(super) bearing: &'a Bearing,
    pub(super) law: usize,
    /// The other motion; none for the displacement.
    pub(super) other: Option<&'a OtherMotion>,
}

impl<'a> Part<'a> {
    /// All laws of bearings, those on displacements first in each.
    pub(super) fn all(bearings: &'a [Bearing]) -> Vec<Part<'a>> {
        let of = |(number, bearing): (usize, &'a Bearing)| {
            let others = bearing.others.iter().map(move |other| Part {
                number,
                bearing,
                law: other.law,
                other: Some(other),
            });
            let own = Part { number, bearing, law: bearing.law, other: None };
            std::iter::once(own).chain(others)
        };
        bearings.iter().enumerate().flat_map(of).collect()
    }
}
