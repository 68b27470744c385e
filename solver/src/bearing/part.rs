//! The laws of bearings, one by one.

use whirl_specs::{BoreMotion, Contact, ContactPlace};

use super::Bearing;
use super::other::OtherMotion;
use crate::bodies::Body;

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

    /// Why a law of this kind cannot act there, and what to do.
    pub(super) fn misplaced(&self, kind: &Contact, bodies: &[Body]) -> Option<(String, String)> {
        let journal = &bodies[self.bearing.sides.bodies[0]];
        let spins = journal.rotation().and_then(|own| own.spin()).is_some();
        let of_gears = kind.bore.contains(&BoreMotion::SecondTurn);
        let (what, help) = match (kind.place, self.other) {
            _ if of_gears != self.bearing.sides.gear.is_some() => (
                "acts on the teeth of gears, or is to act there and does not",
                "give two gears a law with F_n, and what has no teeth another one",
            ),
            _ if kind.bore.contains(&BoreMotion::SeenX)
                && self.bearing.sides.sensor[0].is_none() =>
            {
                (
                    "reads a sensor, but the joint has none",
                    "say where it looks at the journal's body, or take a law of a ring",
                )
            }
            (ContactPlace::Spring, Some(_)) => (
                "acts at springs, but tilts and displacements along z have none",
                "give it the forces of a ring, F_x and F_y",
            ),
            (ContactPlace::Joint, Some(_)) => (
                "acts on a whole joint, but is to act on its tilts or along z alone",
                "give it the forces of a ring, F_x and F_y",
            ),
            (ContactPlace::Joint, None) if self.bearing.stations.len() != 1 => (
                "acts once a joint, but is to act in several planes",
                "give the bearing one station",
            ),
            (ContactPlace::Joint, None) if spins => (
                "sees the section or a sensor of the journal's body, but the journal spins in a frame at rest and has none",
                "take a body whose frame turns, or a law of a ring",
            ),
            _ => return None,
        };
        Some((what.to_owned(), help.to_owned()))
    }
}
