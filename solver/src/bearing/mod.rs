//! Springs between journals and bores: where they stand, how far the film is open there, what they push.

mod apart;
mod bore;
pub mod law;
mod measured;
mod mirrors;
mod other;
mod place;
mod projected;
mod rounding;
mod spin;
mod spline;
pub(crate) mod state;
mod valid;
pub(crate) mod work;

use std::ops::Range;

pub use law::{SpringLaw, Validity};
pub use other::{MotionKind, OtherMotion};
pub use spline::{periodic_spline, spline_passes};
pub use state::SpringState;
pub(crate) use state::TurnedRows;
pub use valid::{Measure, Worst};

pub(crate) use apart::Apart;
pub(crate) use bore::axis_motion;
use law::BoundLaw;
pub(crate) use mirrors::BlockMemory;
use mirrors::Blocks;
pub(crate) use rounding::SpringRounding;
use valid::Measures;

use crate::linalg::{Matrix, add_product};

/// A journal in its bore, as a case describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Bearing {
    /// Name in messages, such as `bearing 2`.
    pub name: String,
    /// What its columns in results are called by; its number, counted from 1, if there is none.
    pub label: Option<String>,
    /// The bodies that it joins.
    pub sides: Sides,
    /// Centre-line nodes at the left end, the middle and the right end, as places in the nodes of the journal's body.
    pub journal: [usize; 3],
    /// Bore nodes in the planes of the same three, as places in the nodes of the bore's body; all empty where it is
    /// rigid.
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
    /// Other motions of its sides, each with a law of its own.
    pub others: Vec<OtherMotion>,
}

/// The bodies that a bearing joins, and how they stand to each other undeformed.
#[derive(Debug, Clone, PartialEq)]
pub struct Sides {
    /// Bodies of the journal and of the bore, by their places in the machine.
    pub bodies: [usize; 2],
    /// Δ: axis of the journal's body less that of the bore (m), fixed in space and constant in z.
    pub apart: [f64; 2],
    /// Axis of the bore among the nodes of its body (m); zero on a body that turns.
    pub bore_axis: [f64; 2],
    /// ε0: run-out or bow of the journal at the left end, the middle and the right end (m), fixed in its body.
    pub run_out: [[f64; 2]; 3],
    /// b0: offset or tilt of the bore at the same three (m), fixed in its body.
    pub offset: [[f64; 2]; 3],
    /// Sections of both bodies whose turn against the frame of their body adds to the angle between them, as places in the
    /// measures of the bodies; the frames alone count where there is none.
    pub sections: [Option<usize>; 2],
    /// Section of the journal that turns with the torque on it, as a place in the measures of its body; the frame alone does
    /// where there is none.
    pub torque_section: Option<usize>,
    /// Where springs stand on the faces of a bore, in place of its rings of nodes.
    pub surface: Option<BoreSurface>,
}

/// A bore as faces of a mesh: every spring moves with the point of the face on which it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct BoreSurface {
    /// z of every station (m).
    pub stations: Vec<f64>,
    /// z of the middle (m).
    pub middle: f64,
    /// Of every station and every angle the point, as Σ c u over the nodes of the body, by place.
    pub points: Vec<Vec<Vec<(usize, f64)>>>,
    /// The mean motion of the whole bore, among the measures of the body.
    pub mean: usize,
}

impl Default for Sides {
    /// A journal on the first body in a bore of the second one, centred.
    fn default() -> Self {
        Sides {
            bodies: [0, 1],
            apart: [0.0; 2],
            bore_axis: [0.0; 2],
            run_out: [[0.0; 2]; 3],
            offset: [[0.0; 2]; 3],
            sections: [None; 2],
            torque_section: None,
            surface: None,
        }
    }
}

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
    /// ε0 in the plane (m).
    run_out: [f64; 2],
    /// Speed with which the journal spins in its frame (rad/s), where it does.
    spin: Option<f64>,
    /// Radial clearance c (m).
    pub(crate) clearance: f64,
    /// Radius of the journal (m); of no effect where no law needs it and none is known.
    radius: f64,
    /// What moments are divided by to compare them with forces (m).
    arm: f64,
}

/// A law in all its planes in the bores of one body; their springs lie side by side in every row.
pub(crate) struct PlacedLaw {
    pub(crate) bound: BoundLaw,
    /// Its planes among all.
    pub(crate) planes: Range<usize>,
    /// Springs of all its planes.
    pub(crate) springs: usize,
    /// What the kernels of its kind keep of every spring.
    table: Vec<f64>,
    /// The body of its bores, by its place in [`Springs::bores`].
    pub(crate) bores: usize,
    /// For every motion of the bore its first row in [`Bores::rows`]; none if the law does not need it.
    pub(crate) motions: Vec<Option<usize>>,
}

/// How the bores of a body move at all springs, and the sections of journals that turn in them.
pub(crate) struct Bores {
    /// Where the coordinates on which they depend stand in q.
    pub(crate) place: Range<usize>,
    /// T_b: motions of the bores from these coordinates (rows × coordinates), eqs. (20) to (23).
    pub(crate) rows: Matrix,
    /// T_bᵀ: one column a row of T_b.
    pub(crate) transposed: Matrix,
    /// Both in blocks, where mirrors map the bores onto themselves.
    blocks: Option<Blocks>,
    /// b0 in the same rows, where any is not zero.
    offset: Option<Vec<f64>>,
}

impl Bores {
    fn new(place: Range<usize>, mut rows: Matrix, offset: Option<Vec<f64>>) -> Self {
        let blocks = Blocks::of(&mut rows);
        Bores { place, transposed: rows.transpose(), rows, blocks, offset }
    }

    /// Memory for products with T_b and its transpose.
    pub(crate) fn memory(&self) -> BlockMemory {
        self.blocks.as_ref().map(Blocks::memory).unwrap_or_default()
    }

    /// Adds T_b x.
    pub(crate) fn add_motion(&self, x: &[f64], out: &mut [f64], memory: &mut BlockMemory) {
        match &self.blocks {
            Some(blocks) => blocks.add_motion(x, out, memory),
            None => add_product(out, &self.rows, x),
        }
    }

    /// Adds T_bᵀ f.
    pub(crate) fn add_force(&self, f: &[f64], out: &mut [f64], memory: &mut BlockMemory) {
        match &self.blocks {
            Some(blocks) => blocks.add_force(f, out, memory),
            None => add_product(out, &self.transposed, f),
        }
    }
}

/// All springs of a machine, law after law.
pub struct Springs {
    /// Number of bearings and stops.
    pub(crate) bearings: usize,
    pub(crate) laws: Vec<PlacedLaw>,
    pub(crate) planes: Vec<Plane>,
    /// The bores of every body that has some.
    pub(crate) bores: Vec<Bores>,
    /// √Σ of the squares of how far a unit of each coordinate of q moves the springs (a rotation: at the farthest
    /// node of its body that is known). A force that is missing at every spring in its own way is missing as this many
    /// in the coordinate's row.
    pub(crate) reach: Vec<f64>,
    /// How far the journal moves in a plane by a unit of a coordinate, in the direction in which it does (planes ×
    /// q; rotations have none).
    arms: Matrix,
    /// Where the laws may be believed.
    measures: Measures,
}

impl Springs {
    /// Number of springs; a law that acts once a plane has one there.
    pub fn count(&self) -> usize {
        self.laws.iter().map(|law| law.springs).sum()
    }

    /// The bearing of a force among those tested for convergence.
    pub(crate) fn bearing_of(&self, force: usize) -> Option<usize> {
        let mut first = 0;
        let law = self.laws.iter().position(|law| {
            let count = law.bound.forces.len() * law.springs;
            let found = force < first + count;
            first += if found { 0 } else { count };
            found
        })?;
        let spring = (force - first) % self.laws[law].springs;
        let own = &self.planes[self.laws[law].planes.clone()];
        own.iter().find(|plane| plane.springs.contains(&spring)).map(|plane| plane.bearing)
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

    /// Whether the law of a plane gives a moment by the angle between both sides.
    pub(crate) fn may_twist(&self, plane: usize) -> bool {
        let law = &self.laws[self.planes[plane].law].bound;
        let angle = law.inputs.iter().any(|&place| law.kind.inputs[place].name == "theta");
        angle && self.gives_torque(plane)
    }
}
