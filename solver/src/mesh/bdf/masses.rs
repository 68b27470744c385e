//! Masses on nodes, `CONM2`.

use super::super::raw::{LinePosition, MeshReport};
use super::fields::Card;

/// A mass as written.
#[derive(Debug, Clone)]
pub(super) struct RawMass {
    pub(super) label: u64,
    pub(super) node: u64,
    /// `None` for −1: its offset is the place of its centre in the basic system.
    pub(super) system: Option<u64>,
    pub(super) mass: f64,
    pub(super) offset: [f64; 3],
    /// About its centre, along the system's axes.
    pub(super) inertia: [[f64; 3]; 3],
    pub(super) place: LinePosition,
}

pub(super) fn read(card: &Card, report: &mut MeshReport) -> Option<RawMass> {
    let label = report.label(card, 0, "label of the element");
    let node = report.label(card, 1, "node");
    let system = match card.field(2).map(|field| field.text) {
        Some("-1") => Some(None),
        _ => report.count_or_zero(card, 2, "coordinate system").map(Some),
    };
    let mass = report.real_or_zero(card, 3, "mass");
    let mut offset = [0.0; 3];
    let mut moments = [0.0; 6];
    for (at, value) in offset.iter_mut().enumerate() {
        *value = report.real_or_zero(card, 4 + at, "offset").unwrap_or(0.0);
    }
    // A blank field stands between the offset and the moments.
    for (at, value) in moments.iter_mut().enumerate() {
        *value = report.real_or_zero(card, 8 + at, "moment of inertia").unwrap_or(0.0);
    }
    if let Some(field) = card.field(3).copied()
        && mass.is_some_and(|mass| mass < 0.0)
    {
        let what = format!("the mass of CONM2 {} is {}", label.unwrap_or(0), field.text);
        report.error(field.place, what, "it must not be negative");
    }
    let [xx, xy, yy, xz, yz, zz] = moments;
    let inertia = [[xx, -xy, -xz], [-xy, yy, -yz], [-xz, -yz, zz]];
    let place = card.place;
    Some(RawMass {
        label: label?,
        node: node?,
        system: system?,
        mass: mass?,
        offset,
        inertia,
        place,
    })
}
