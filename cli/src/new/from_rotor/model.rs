//! The elements of a rotor as ROSS has them, in SI, each at its node `n`.

use std::ops::Range;

/// What an element is called, and where it stands in the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Named {
    /// Its tag.
    pub(super) tag: String,
    pub(super) place: Range<usize>,
}

/// An isotropic material.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Material {
    pub(super) name: String,
    pub(super) density: f64,
    pub(super) youngs_modulus: f64,
    pub(super) poissons_ratio: f64,
}

/// A cylinder or a cone from node `n` to the next one. Elements at one node are layers.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ShaftElement {
    pub(super) named: Named,
    pub(super) n: usize,
    pub(super) length: f64,
    /// Diameters at the left and the right end.
    pub(super) outer: [f64; 2],
    pub(super) inner: [f64; 2],
    /// Diameter up to which there is mass, where that is more than the outer one.
    pub(super) mass_outer: Option<f64>,
    pub(super) material: Material,
    pub(super) material_place: Range<usize>,
    /// Damping by stiffness (s).
    pub(super) beta: f64,
}

/// Springs between node `n` and the next one, with a disc at each.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Coupling {
    pub(super) named: Named,
    pub(super) n: usize,
    pub(super) length: f64,
    /// Mass, transverse and polar inertia at the left and the right node.
    pub(super) ends: [[f64; 3]; 2],
    /// Along x, y, z and about them.
    pub(super) stiffness: [f64; 6],
    pub(super) damping: [f64; 6],
}

/// A disc, or the body of a gear.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Disc {
    pub(super) named: Named,
    pub(super) n: usize,
    /// How far beyond the node it is (m).
    pub(super) beyond: f64,
    /// Mass, transverse and polar inertia.
    pub(super) inertias: [f64; 3],
    pub(super) gear: bool,
}

/// Indices of the coefficients of a bearing.
pub(super) const COEFFICIENTS: [&str; 15] = [
    "kxx", "kxy", "kyx", "kyy", "cxx", "cxy", "cyx", "cyy", "kzz", "czz", "mxx", "mxy", "myx",
    "myy", "mzz",
];

/// A bearing or a seal between node `n` and another one, or the ground.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bearing {
    pub(super) named: Named,
    pub(super) n: usize,
    pub(super) link: Option<usize>,
    /// Of [`COEFFICIENTS`], each with one value or one for each speed.
    pub(super) coefficients: Vec<Vec<f64>>,
    /// rad/s, ascending; fewer than two where nothing varies.
    pub(super) speeds: Vec<f64>,
}

impl Bearing {
    /// Whether a coefficient is the same at all speeds.
    pub(super) fn is_constant(&self, which: usize) -> bool {
        let own = &self.coefficients[which];
        own.iter().all(|value| *value == own[0])
    }

    /// A coefficient at a speed (rad/s), linear between those of the file and constant beyond.
    pub(super) fn at(&self, which: usize, speed: f64) -> f64 {
        let own = &self.coefficients[which];
        let next = self.speeds.partition_point(|own| *own < speed);
        if own.len() < 2 || next == 0 {
            return own[0];
        }
        if next == own.len() {
            return own[next - 1];
        }
        let [a, b] = [self.speeds[next - 1], self.speeds[next]];
        own[next - 1] + (own[next] - own[next - 1]) * (speed - a) / (b - a)
    }

    /// Whether a coefficient is not zero at some speed.
    pub(super) fn has(&self, which: usize) -> bool {
        self.coefficients[which].iter().any(|value| *value != 0.0)
    }
}

/// A mass at node `n`, of the shaft or of a support.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PointMass {
    pub(super) named: Named,
    pub(super) n: usize,
    /// Against motion along x, y and z.
    pub(super) mass: [f64; 3],
}

/// All of a file.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Model {
    pub(super) version: Option<String>,
    /// Lowest, highest and rated speed (rad/s), as far as they are given.
    pub(super) speeds: [Option<f64>; 3],
    pub(super) shaft: Vec<ShaftElement>,
    pub(super) couplings: Vec<Coupling>,
    pub(super) discs: Vec<Disc>,
    pub(super) bearings: Vec<Bearing>,
    pub(super) masses: Vec<PointMass>,
}
