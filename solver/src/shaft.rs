//! The reduced shaft: constant tensors of its motion in active coordinates η.

use serde::{Deserialize, Serialize};

use crate::body::{BodyNode, BodySpec, Coordinates, Rayleigh};
use crate::centre_of_mass::CentreOfMass;
use crate::error::Error;
use crate::linalg::{Matrix, congruence};
use crate::measure::MeanMotion;
use crate::mesh::Mesh;
use crate::reduced::{BodyKind, Reduced, SpinTensors, Undeformed, Weight};
use crate::reduction::CraigBampton;
use crate::section::{self, Section};
use crate::sparse::SparseMatrix;

/// A flexible shaft in the frame that turns with it by θ (about z), reduced to n coordinates η.
///
/// Its kinetic energy is T = ½ θ̇² (J0 + 2 y0·η + ηᵀWη) + θ̇ (g0 − Hη)·η̇ + ½ η̇ᵀMη̇.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Shaft {
    /// J0 = x0ᵀY x0 (kg·m²): moment of inertia of the undeformed shaft about z.
    pub j0: f64,
    /// y0 = φᵀY x0, n values.
    pub y0: Vec<f64>,
    /// g0 = (x0ᵀHφ)ᵀ, n values.
    pub g0: Vec<f64>,
    /// M = φᵀMφ, n × n.
    pub mass: Matrix,
    /// K = φᵀKφ, n × n.
    pub stiffness: Matrix,
    /// C, n × n.
    pub damping: Matrix,
    /// Y = φᵀYφ, n × n, symmetric.
    pub spin_inertia: Matrix,
    /// H = φᵀHφ, n × n, skew.
    pub spin_coupling: Matrix,
    /// W = Y − G, n × n, symmetric, with G = φᵀGφ the stiffness by the centrifugal stress at θ̇ = 1; Y where that is left
    /// out.
    pub spin_net: Matrix,
    /// Frequencies of the fixed-interface modes (Hz), in a frame at rest.
    pub hertz: Vec<f64>,
    /// What each coordinate is, such as `mode 1 (527.1 Hz)` or `JOURNAL1_LEFT x`; n names.
    pub coordinates: Vec<String>,
    /// The nodes asked for, in that order.
    pub nodes: Vec<BodyNode>,
    /// The means asked for, in that order.
    pub measures: Vec<MeanMotion>,
    /// Sections, by z.
    pub sections: Vec<Section>,
    /// Its mass, and where that is.
    pub centre_of_mass: CentreOfMass,
}

/// What a [`Shaft`] is made from.
#[derive(Debug, Clone, Copy)]
pub struct ShaftParts<'a> {
    /// The reduction, before constraints.
    pub reduction: &'a CraigBampton,
    /// M, 3·nodes.
    pub mass: &'a SparseMatrix,
    /// Y = ∫ρ Nᵀ diag(1,1,0) N dV, 3·nodes.
    pub spin_inertia: &'a SparseMatrix,
    /// H = ∫ρ Nᵀ A_θᵀA N dV, 3·nodes.
    pub spin_coupling: &'a SparseMatrix,
    /// G = ∫ σ⁰_ij ∂_i N · ∂_j N dV, 3·nodes, if rotation stiffens.
    pub spin_stiffening: Option<&'a SparseMatrix>,
    /// Node coordinates (m) about the axis of rotation, x = y = 0.
    pub positions: &'a [[f64; 3]],
    /// Active coordinates after elimination of constraints.
    pub active: &'a Coordinates,
    /// Damping of the body.
    pub damping: Rayleigh,
    /// Nodes whose motion is wanted, by index.
    pub nodes: &'a [usize],
}

impl Reduced {
    /// The shaft, with the constraints, names, damping and nodes of the spec.
    ///
    /// # Errors
    /// Constraints that contradict each other.
    ///
    /// # Panics
    /// If this is no [`BodyKind::Shaft`], or the spec outputs a node that this has no shapes of.
    pub fn shaft(&self, spec: &BodySpec) -> Result<Shaft, Error> {
        let spin = self.spin.as_ref().expect("a shaft is reduced with its spin");
        let active = spec.active(&self.reduction)?;
        let nodes = self.places(spec).map(|node| self.node(&active, node)).collect();
        let measures = self.measures(&active, spec);
        let weight = self.weight.centre_of_mass(&active);
        let shaft = Shaft::from_spin(&self.reduction, spin, &active, spec.damping, nodes, weight);
        let sections = section::active(&self.sections, &active, spec.damping);
        Ok(Shaft { measures, sections, ..shaft })
    }
}

impl Shaft {
    /// Names of the tensors, for messages.
    pub(crate) const TENSORS: &str = "J0, y0, g0, M, Y, W and H";

    /// Reduces the mesh of a shaft.
    ///
    /// # Errors
    /// As [`Reduced::new`] and [`Reduced::shaft`].
    pub fn from_mesh(mesh: &Mesh, spec: &BodySpec) -> Result<Shaft, Error> {
        Reduced::new(BodyKind::Shaft, mesh, spec)?.shaft(spec)
    }

    /// The shaft of a reduction, in active coordinates.
    pub fn new(parts: &ShaftParts) -> Shaft {
        let spin = SpinTensors::new(
            parts.reduction,
            parts.spin_inertia,
            parts.spin_coupling,
            parts.spin_stiffening,
            &Undeformed::new(parts.spin_inertia, parts.spin_coupling, parts.positions),
        );
        let nodes = parts
            .nodes
            .iter()
            .map(|&node| BodyNode::new(parts.reduction, parts.active, parts.positions, node));
        let weight = Weight::new(parts.reduction, parts.mass, parts.positions);
        let weight = weight.centre_of_mass(parts.active);
        let (active, damping) = (parts.active, parts.damping);
        Shaft::from_spin(parts.reduction, &spin, active, damping, nodes.collect(), weight)
    }

    /// The shaft of a reduction whose spin is reduced, too.
    pub(crate) fn from_spin(
        reduction: &CraigBampton,
        spin: &SpinTensors,
        active: &Coordinates,
        damping: Rayleigh,
        nodes: Vec<BodyNode>,
        centre_of_mass: CentreOfMass,
    ) -> Shaft {
        let to_active = |forces: &[f64]| active.transform.apply_transpose(forces);
        let mass = congruence(&reduction.mass, &active.transform).symmetric_part();
        let stiffness = congruence(&reduction.stiffness, &active.transform).symmetric_part();
        let spin_inertia = congruence(&spin.inertia, &active.transform).symmetric_part();
        let stiffening = congruence(&spin.stiffening, &active.transform).symmetric_part();
        Shaft {
            j0: spin.j0,
            y0: to_active(&spin.y0),
            // x0ᵀH = −(H x0)ᵀ, because H is skew.
            g0: to_active(&spin.h0).iter().map(|value| -value).collect(),
            damping: damping.matrix(&mass, &stiffness),
            mass,
            stiffness,
            spin_net: difference(&spin_inertia, &stiffening),
            spin_inertia,
            spin_coupling: congruence(&spin.coupling, &active.transform).skew_part(),
            hertz: reduction.hertz.clone(),
            coordinates: active.names.clone(),
            nodes,
            measures: Vec::new(),
            sections: Vec::new(),
            centre_of_mass,
        }
    }

    /// A point mass on the axis, held by a spring and a damper a direction (x, y of the turning frame):
    /// coordinates are its displacements x and y. Its moment of inertia about the axis is zero at rest,
    /// so θ must be prescribed.
    ///
    /// `mass`: kg; `stiffness`: N/m; `damping`: N·s/m; `position`: z on the axis, m. Its one node is the
    /// point.
    pub fn lumped(mass: f64, stiffness: [f64; 2], damping: [f64; 2], position: f64) -> Shaft {
        let mut shapes = Matrix::zeros(3, 2);
        shapes[(0, 0)] = 1.0;
        shapes[(1, 1)] = 1.0;
        let node = BodyNode { position: [0.0, 0.0, position], shapes };
        Shaft {
            j0: 0.0,
            y0: vec![0.0; 2],
            g0: vec![0.0; 2],
            mass: Matrix::from_diagonal(&[mass, mass]),
            stiffness: Matrix::from_diagonal(&stiffness),
            damping: Matrix::from_diagonal(&damping),
            spin_inertia: Matrix::from_diagonal(&[mass, mass]),
            spin_coupling: Matrix { rows: 2, cols: 2, data: vec![0.0, -mass, mass, 0.0] },
            spin_net: Matrix::from_diagonal(&[mass, mass]),
            hertz: Vec::new(),
            coordinates: vec!["mass x".to_owned(), "mass y".to_owned()],
            nodes: vec![node.clone()],
            measures: Vec::new(),
            sections: Vec::new(),
            centre_of_mass: CentreOfMass { mass, node },
        }
    }

    /// G = Y − W, n × n: the stiffness by the centrifugal stress at θ̇ = 1.
    pub fn spin_stiffening(&self) -> Matrix {
        difference(&self.spin_inertia, &self.spin_net)
    }

    /// Number of coordinates n.
    pub fn size(&self) -> usize {
        self.coordinates.len()
    }

    /// The constant tensor called `name` in the motion specs (`J0`, `y0`, `g0`, `M`, `Y`, `W`, `H`),
    /// matrices
    /// column after column; `None` for another name.
    pub fn tensor(&self, name: &str) -> Option<&[f64]> {
        Some(match name {
            "J0" => std::slice::from_ref(&self.j0),
            "y0" => &self.y0,
            "g0" => &self.g0,
            "M" => &self.mass.data,
            "Y" => &self.spin_inertia.data,
            "W" => &self.spin_net.data,
            "H" => &self.spin_coupling.data,
            _ => return None,
        })
    }
}

fn difference(a: &Matrix, b: &Matrix) -> Matrix {
    Matrix::from_fn(a.rows, a.cols, |i, j| a[(i, j)] - b[(i, j)])
}
