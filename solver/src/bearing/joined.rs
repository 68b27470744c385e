//! The bodies that a law joins, and the motions of bores that it sees while its springs are placed: rows of T_b.

use std::ops::Range;

use super::bores::Bores;
use super::part::Part;
use crate::bodies::{Body, BodyPlace};
use crate::linalg::Matrix;

/// The bodies on whose coordinates a row of T_b is: that of the bore, and that of the journal where its section moves in its
/// frame, or a sensor looks at it.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Joined {
    pub(super) bore: usize,
    twisted: Option<usize>,
    /// θ of the body of the bore by its place in q, where it is unknown and rows of gears have it.
    pub(super) turned: Option<usize>,
}

impl Joined {
    pub(super) fn of(part: &Part, bodies: &[Body], places: &[BodyPlace]) -> Self {
        let [journal, bore] = part.bearing.sides.bodies;
        let sides = &part.bearing.sides;
        let twists = part.other.is_none()
            && [sides.torque_section, sides.whole_sections[0], sides.sensor[0]]
                .iter()
                .any(Option::is_some);
        let twists = twists || sides.gear.is_some() && sides.sections[0].is_some();
        let turned =
            places[bore].rotation.filter(|_| sides.gear.is_some() && is_free(&bodies[bore]));
        Joined { bore, twisted: twists.then_some(journal), turned }
    }

    /// All coordinates between the first and the last of both in q.
    pub(super) fn place(self, places: &[BodyPlace]) -> Range<usize> {
        let mut own = places[self.bore].flexible.clone();
        own.start = self.turned.unwrap_or(own.start);
        let Some(other) = self.twisted.map(|body| places[body].flexible.clone()) else {
            return own;
        };
        match (own.is_empty(), other.is_empty()) {
            (true, _) => other,
            (_, true) => own,
            _ => own.start.min(other.start)..own.end.max(other.end),
        }
    }
}

/// Whether θ of a body is unknown.
fn is_free(body: &Body) -> bool {
    body.rotation().is_some_and(|own| own.given(0.0, false).is_none())
}

/// Rows of T_b so far, and b0 in them.
pub(super) struct PlacingBores {
    pub(super) joined: Joined,
    pub(super) rows: Vec<Vec<f64>>,
    pub(super) offset: Vec<f64>,
    pub(super) given: Vec<(usize, usize, f64)>,
}

impl PlacingBores {
    pub(super) fn placed(self, places: &[BodyPlace]) -> Bores {
        let place = self.joined.place(places);
        let rows = Matrix::from_fn(self.rows.len(), place.len(), |i, j| self.rows[i][j]);
        let offset = self.offset.iter().any(|b0| *b0 != 0.0).then_some(self.offset);
        Bores::new(place, rows, offset, self.given)
    }
}

/// A motion of all bores of a law: rows of T_b, and b0 in them.
#[derive(Clone, Default)]
pub(super) struct MotionRows {
    pub(super) rows: Vec<Vec<f64>>,
    pub(super) offset: Vec<f64>,
}

impl MotionRows {
    /// Whether nothing moves so.
    pub(super) fn are_zero(&self) -> bool {
        self.rows.iter().flatten().chain(&self.offset).all(|value| *value == 0.0)
    }
}
