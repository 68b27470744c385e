//! One plane of a bearing, with its springs.

use std::ops::Range;

use super::apart::Apart;
use super::gear::FlankPlane;
use super::other::MotionKind;

/// One plane in which a law acts: at every spring, or once.
pub(crate) struct Plane {
    /// Which law.
    pub(crate) law: usize,
    /// Which bearing, counted from 0.
    pub(crate) bearing: usize,
    /// What of its sides moves, where it is not their displacement in the plane.
    pub(crate) other: Option<MotionKind>,
    /// Its springs among those of the law; one if the law acts once a plane.
    pub(crate) springs: Range<usize>,
    /// The angle of the journal, or of its section, against the bore, and the displacement ε_x and ε_y of the journal in the frame of its
    /// body, as Σ coefficient · q; another motion in place of ε where it has one. Where the axes are apart the last terms of ε are of θ of the journal, and change.
    pub(crate) rows: [Vec<(usize, f64)>; 3],
    /// The axes of both bodies, where they are apart.
    pub(crate) apart: Option<Apart>,
    /// The flank of gears on which it acts.
    pub(super) flank: Option<FlankPlane>,
    /// ε0 in the plane (m).
    pub(super) run_out: [f64; 2],
    /// Speed with which the journal spins in its frame (rad/s), where it does.
    pub(crate) spin: Option<f64>,
    /// Radial clearance c (m).
    pub(crate) clearance: f64,
    /// Radius of the journal (m); of no effect where no law needs it and none is known.
    pub(super) radius: f64,
    /// What moments are divided by to compare them with forces (m).
    pub(super) arm: f64,
}
