//! What the case says, before it is written.

use super::model::Material;

/// Rows of one diameter that follow each other are one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    /// m.
    pub(super) z: f64,
    pub(super) length: f64,
    pub(super) outer: [f64; 2],
    pub(super) inner: [f64; 2],
    /// Diameter up to which there is mass.
    pub(super) mass_outer: Option<f64>,
    /// Index of the material.
    pub(super) material: usize,
    /// The first and the last element.
    pub(super) elements: [String; 2],
}

/// What stands on a shaft by numbers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Carried {
    pub(super) name: String,
    /// As the file calls it.
    pub(super) tag: String,
    /// m.
    pub(super) z: f64,
    pub(super) mass: f64,
    /// Transverse and polar; none of a point.
    pub(super) inertias: Option<[f64; 2]>,
}

/// A body that turns.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Body {
    pub(super) name: String,
    pub(super) rows: Vec<Row>,
    pub(super) carried: Vec<Carried>,
    /// Damping by stiffness (s).
    pub(super) damping: f64,
    /// Whether its left end is held along z, as a joint acts along z without stiffness.
    pub(super) held_left: bool,
}

/// A mass on springs.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Support {
    pub(super) name: String,
    pub(super) tag: String,
    pub(super) mass: f64,
    pub(super) moves_along_z: bool,
}

/// Where a joint stands: on which body, and at which z (m) of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Side {
    pub(super) body: String,
    pub(super) z: f64,
    /// The set of all nodes there, where that is an end.
    pub(super) end: Option<&'static str>,
}

/// What a joint does.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Acts {
    /// Stiffness and damping: xx, xy, yx, yy.
    Springs([f64; 4], [f64; 4]),
    /// A table over the speed, as text.
    Table(String),
    /// Stiffness and damping of a law between bodies that both turn: along x and y, along z, about x and y.
    Law([f64; 3], [f64; 3]),
    /// Of a torsional coupling.
    Torsion(f64, f64),
}

/// A joint.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Joint {
    pub(super) name: String,
    pub(super) tag: String,
    pub(super) first: Side,
    /// The ground where it is none.
    pub(super) second: Option<Side>,
    pub(super) acts: Acts,
    /// Stiffness and damping along z of springs and tables.
    pub(super) along: [f64; 2],
}

/// All of it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Draft {
    pub(super) title: String,
    pub(super) version: Option<String>,
    pub(super) materials: Vec<(String, Material)>,
    pub(super) bodies: Vec<Body>,
    pub(super) supports: Vec<Support>,
    pub(super) joints: Vec<Joint>,
    /// rad/s, and whether the file says it.
    pub(super) speed: (f64, bool),
    /// Speeds of a Campbell diagram (rad/s).
    pub(super) range: [f64; 2],
}
