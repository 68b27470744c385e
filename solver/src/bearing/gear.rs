//! Two gears on bodies whose axes are apart.
//!
//! Along the line of action with the unit vector n, on which the first gear pushes the second, teeth overlap by
//! e_n = n·(u₁ − u₂) + r₁θ₁ + r₂θ₂, with the displacements u of the centres in space, base radii r (that of an internal gear
//! or its partner with the sign changed) and the rotations θ of the sections, which may be large. The axis x of the kernels
//! is n: the frames of both bodies are counted from its direction.

use whirl_specs::BoreMotion;

use crate::bodies::{Body, BodyPlace};

/// The teeth of two gears.
#[derive(Debug, Clone, PartialEq)]
pub struct Gear {
    /// The node of the second gear's centre, as a place among the nodes of its body.
    pub second: usize,
    /// Flanks that may touch.
    pub flanks: Vec<Flank>,
}

/// A flank of the teeth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flank {
    /// Angle of n from the axis x of space (rad).
    pub direction: f64,
    /// r₁ and r₂ (m): below zero where a turn about +z moves the teeth apart.
    pub radii: [f64; 2],
}

impl Flank {
    /// r₂/r₁.
    pub(super) fn radii_ratio(&self) -> f64 {
        self.radii[1] / self.radii[0]
    }

    /// Speed of the second gear over that of the first.
    pub(crate) fn speed_ratio(&self) -> f64 {
        -self.radii[0] / self.radii[1]
    }
}

/// What the plane of a flank knows beside its rows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FlankPlane {
    pub(super) flank: Flank,
    /// Places of θ₁ and θ₂ in q.
    pub(super) rotations: [usize; 2],
}

/// A motion of the second gear, or of the section of the first: a row over the coordinates of a body, what its frame's
/// rotation brings to it, and what is added (m, rad).
pub(super) struct GearRow {
    pub(super) side: usize,
    pub(super) row: Vec<f64>,
    pub(super) by_rotation: f64,
    pub(super) offset: f64,
}

impl GearRow {
    pub(super) fn new(
        sections: [Option<usize>; 2],
        (gear, flank): (&Gear, &Flank),
        bodies: [&Body; 2],
        motion: BoreMotion,
    ) -> Self {
        let node = &bodies[1].nodes()[gear.second];
        let shape = |axis: usize| node.shapes.row(axis);
        let turn = |side: usize, factor: f64| {
            let Some(section) = sections[side] else { return Vec::new() };
            let rotation = &bodies[side].measures()[section].rotation;
            (0..rotation.cols).map(|j| factor * rotation[(2, j)]).collect()
        };
        let own = |side, row| GearRow { side, row, by_rotation: 0.0, offset: 0.0 };
        match motion {
            BoreMotion::MeanX => own(1, shape(0)),
            BoreMotion::MeanY => own(1, shape(1)),
            BoreMotion::SectionTurn => own(0, turn(0, 1.0)),
            BoreMotion::SecondFrame => {
                GearRow { by_rotation: 1.0, offset: -flank.direction, ..own(1, Vec::new()) }
            }
            BoreMotion::SecondTurn => GearRow {
                by_rotation: flank.radii_ratio(),
                // What the frame of the first is counted from.
                offset: flank.direction,
                ..own(1, turn(1, flank.radii_ratio()))
            },
            _ => own(1, Vec::new()),
        }
    }
}

impl FlankPlane {
    /// Where the angle of its ring is counted from (rad).
    pub(super) fn first_angle(&self) -> f64 {
        -self.flank.direction
    }
}

/// The places of both rotations in q.
///
/// # Panics
/// If a body does not turn, which is checked before.
pub(super) fn rotations(places: [&BodyPlace; 2]) -> [usize; 2] {
    places.map(|own| own.rotation.expect("gears are on bodies that turn"))
}
