//! Springs between journals and bores: where they stand, how far the film is open there, what they push.

mod bore;
pub mod law;
mod place;
mod projected;
mod spin;
mod spline;
pub(crate) mod state;
mod valid;
pub(crate) mod work;

use std::ops::Range;

pub use law::{SpringLaw, Validity};
pub use spline::{periodic_spline, spline_passes};
pub use state::SpringState;
pub use valid::{Measure, Worst};

pub(crate) use bore::axis_motion;
use law::BoundLaw;
use valid::Measures;

use crate::linalg::Matrix;

/// A journal in its bore, as a case describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Bearing {
    /// Name in messages, such as `bearing 2`.
    pub name: String,
    /// Centre-line nodes at the left end, the middle and the right end, as places in `Shaft::nodes`.
    pub journal: [usize; 3],
    /// Bore nodes in the planes of the same three, as places in `Support::nodes`; all empty where the
    /// support is rigid.
    pub bore: [Vec<usize>; 3],
    /// Radial clearance c (m).
    pub clearance: f64,
    /// Radius of the journal (m), for laws that need it; without one the mean distance of the bore's nodes
    /// from the axis less c.
    pub journal_radius: Option<f64>,
    /// Planes of springs by their distance from the left end over the length L_b; 0, ½ and 1 are the three.
    pub stations: Vec<f64>,
    /// Fixed angles ψ_j of the springs of each plane (rad); of no effect on a law that acts once a plane.
    pub angles: Vec<f64>,
    /// Which of the laws given to `Springs::new`.
    pub law: usize,
}

/// One plane in which a law acts: at every spring, or once.
pub(crate) struct Plane {
    /// Which law.
    pub(crate) law: usize,
    /// Which bearing, counted from 0.
    pub(crate) bearing: usize,
    /// Its springs among those of the law; one if the law acts once a plane.
    pub(crate) springs: Range<usize>,
    /// ε_x and ε_y as Σ coefficient · η.
    pub(crate) eccentricity: [Vec<(usize, f64)>; 2],
    /// Radial clearance c (m).
    pub(crate) clearance: f64,
    /// Radius of the journal (m); of no effect where no law needs it and none is known.
    radius: f64,
    /// What moments are divided by to compare them with forces (m).
    arm: f64,
}

/// A law in all its planes, whose springs lie side by side in every row.
pub(crate) struct PlacedLaw {
    pub(crate) bound: BoundLaw,
    /// Its planes among all.
    pub(crate) planes: Range<usize>,
    /// Springs of all its planes.
    pub(crate) springs: usize,
    /// What the kernels of its kind keep of every spring.
    table: Vec<f64>,
    /// For every motion of the bore its first row in [`Springs::bore`]; none if the law does not need it.
    pub(crate) motions: Vec<Option<usize>>,
}

/// All springs of a machine, law after law.
pub struct Springs {
    /// Number of bearings and stops.
    pub(crate) bearings: usize,
    pub(crate) laws: Vec<PlacedLaw>,
    pub(crate) planes: Vec<Plane>,
    /// T_b: motions of the bores from the support's coordinates (rows × coordinates), eqs. (20) to (23).
    pub(crate) bore: Matrix,
    /// T_bᵀ: one column a row of T_b.
    pub(crate) bore_transposed: Matrix,
    /// Number of η.
    shaft_size: usize,
    /// √Σ of the squares of how far a unit of each coordinate moves the springs: θ (at the farthest node that is
    /// known), η, the support's. A force that is missing at every spring in its own way is missing as this many in
    /// the coordinate's row.
    pub(crate) reach: Vec<f64>,
    /// How far the journal moves in a plane by a unit of η_j, in the direction in which it does (planes × η).
    arms: Matrix,
    /// Where the laws may be believed.
    measures: Measures,
}

impl Springs {
    /// Number of springs; a law that acts once a plane has one there.
    pub fn count(&self) -> usize {
        self.laws.iter().map(|law| law.springs).sum()
    }

    /// Number of forces tested for convergence: every force that a law gives, at every spring.
    pub(crate) fn forces(&self) -> usize {
        self.laws.iter().map(|law| law.bound.forces.len() * law.springs).sum()
    }

    /// Values of the law that has the most, with so many rows a law and a value a spring.
    fn most(&self, rows: fn(&PlacedLaw) -> usize) -> usize {
        self.laws.iter().map(|law| rows(law) * law.springs).max().unwrap_or(0)
    }

    /// Whether any law depends on how fast a bore moves.
    fn needs_rates(&self) -> bool {
        self.laws.iter().any(|law| law.bound.needs_rates())
    }

    /// Whether the law of a plane turns or brakes the journal: by a moment, or by a force at its surface.
    pub(crate) fn gives_torque(&self, plane: usize) -> bool {
        let law = &self.laws[self.planes[plane].law].bound;
        let mut forces = law.forces.iter().map(|&place| &law.kind.forces[place]);
        forces.any(|force| force.radius || force.unit != "N")
    }
}
