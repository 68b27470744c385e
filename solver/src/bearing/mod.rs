//! Springs between journals and bores: where they stand, how far the film is open there, what they push.
//!
//! ```text
//! places     place ─▶ springs: planes (plane, placed_planes, section, on_section, other, gear), bores (bore, apart, spline, mirrors),
//!            placed_law: a law in all its planes
//! laws       law, over_frequency (frequency_law), film_law (films, filmed, film_shapes, film_tangent, film_shown); states (hold, remembered, memory)
//! instant    state: measured ─▶ laws ─▶ projected; its rounding
//! besides    work along a step, valid and observed for the verdict, beside for linear analyses, tied and spin for rotations
//! ```

mod apart;
mod beside;
mod bore;
mod bores;
mod film_law;
mod film_shapes;
mod film_shown;
mod film_tangent;
mod filmed;
mod films;
mod frequency_law;
mod gear;
mod hold;
mod joined;
pub mod law;
mod law_memory;
mod mark;
mod measured;
mod memory;
mod mirrors;
mod observed;
mod on_section;
mod other;
mod over_frequency;
mod part;
mod place;
mod placed_law;
mod placed_planes;
mod plane;
mod projected;
mod reach;
mod remembered;
mod rounding;
mod section;
mod spin;
mod spline;
mod springs;
pub(crate) mod state;
mod states;
mod tied;
mod valid;
pub(crate) mod work;

pub use film_law::FilmLaw;
pub use film_shown::FilmPlace;
pub use frequency_law::FrequencyLaw;
pub use gear::{Flank, Gear};
pub use hold::{Hold, LawStates};
pub use law::{Remembered, SpringLaw, Validity};
pub use other::{MotionKind, OtherMotion};
pub use over_frequency::{Coefficients, FrequencyTable, OverFrequency, OverWhat};
pub use spline::{periodic_spline, spline_passes};
pub use springs::Springs;
pub use state::SpringState;
pub use valid::{Measure, Worst};

pub(crate) use beside::Poses;
pub(crate) use bore::axis_motion;
pub(crate) use bores::Bores;
pub(crate) use hold::LONG;
pub(crate) use memory::Alike;
pub(crate) use mirrors::BlockMemory;
pub(crate) use on_section::OnJournal;
pub(crate) use plane::Plane;
pub(crate) use rounding::SpringRounding;
pub(crate) use state::TurnedRows;
pub(crate) use tied::Tied;

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
    /// Planes of springs by their distance from the left end over the length L_b; 0, ½ and 1 are the three. One of a law of
    /// the whole joint.
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
    /// Sections of both bodies whose displacement along z and whose tilts a law of the whole joint sees, as places in the
    /// measures of the bodies; none of a body that has no such motion.
    pub whole_sections: [Option<usize>; 2],
    /// Section of the journal that turns with the torque on it, as a place in the measures of its body; the frame alone does
    /// where there is none.
    pub torque_section: Option<usize>,
    /// Where a sensor looks at the journal's body, and what it stands on, as places in the nodes of both bodies; none on the
    /// ground, and none of a joint without a sensor.
    pub sensor: [Option<usize>; 2],
    /// Where springs stand on the faces of a bore, in place of its rings of nodes.
    pub surface: Option<BoreSurface>,
    /// Teeth, where both sides are gears: its law acts once a flank.
    pub gear: Option<Gear>,
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
    /// Of every node of a film, in the order of its grid, the mean of the bore around it ([`crate::film::Grid::samples`]), as those of
    /// `points`; none of a bore that is to stay round.
    pub film: Vec<Vec<(usize, f64)>>,
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
            whole_sections: [None; 2],
            torque_section: None,
            sensor: [None; 2],
            surface: None,
            gear: None,
        }
    }
}
