//! Motions: the rigid rotation θ of a shaft coupled to its flexible coordinates η, either by a kinetic
//! energy or by terms declared one by one, whose declared derivatives are then proved.
//!
//! ```toml
//! kind = "motion"
//! name = "consistent"
//! title = "…"
//! source = "paper and equation"
//! kinetic_energy = '1/2*theta_dot^2*J0 + …'
//!
//! [coordinates]
//! theta = "scalar"
//! eta = "vector"
//!
//! [tensors]                  # scalar, vector, matrix, symmetric or skew
//! J0 = "scalar"
//! Y = "symmetric"
//! ```
//!
//! In place of `kinetic_energy`: tables `mass`, `PF`, `B`, `P` with a formula a block (`theta.eta = '…'`)
//! and `quadratic_velocity` with a formula a row; what is left out is zero.

mod equations;
mod explain;
pub mod kernels;
pub(crate) mod lagrange;
mod schema;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::sync::Arc;

pub(super) use schema::KIND;

use crate::diagnostic::{Diagnostics, Source};
use crate::document::{Document, Table};
use crate::expression::{Graph, Id, Shape, Symmetry};
use crate::kinds::kind::About;
use crate::kinds::read::{self, Head};
use equations::Reader;
use lagrange::{Coordinate, Derivatives, Equations};

/// The coordinates that the solver marches, with their shapes.
pub(crate) const COORDINATES: &[(&str, Shape)] =
    &[("theta", Shape::Scalar), ("eta", Shape::Vector)];

/// A motion, ready to be emitted: see the module for the file.
#[derive(Debug, Clone)]
pub struct MotionSpec {
    /// Name by which cases refer to it.
    pub name: String,
    /// One-line description.
    pub title: String,
    /// Paper and equation.
    pub(crate) reference: String,
    /// The file.
    pub file: Arc<Source>,
    /// θ and η.
    pub(crate) coordinates: Vec<Coordinate>,
    /// The constant tensors, in the order of the file.
    pub tensors: Vec<Tensor>,
    /// The graph that holds all expressions.
    pub graph: Graph,
    /// T, p, M and Q_v.
    pub(crate) equations: Equations,
    /// PF, B and P.
    pub(crate) derivatives: Derivatives,
}

/// A constant of a motion.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tensor {
    /// Name in the spec.
    pub name: String,
    /// Its symbol.
    pub symbol: Id,
    /// Shape.
    pub shape: Shape,
    /// Symmetry of a matrix.
    pub symmetry: Symmetry,
}

const TENSORS: [(&str, Shape, Symmetry); 5] = [
    ("scalar", Shape::Scalar, Symmetry::None),
    ("vector", Shape::Vector, Symmetry::None),
    ("matrix", Shape::Matrix, Symmetry::None),
    ("symmetric", Shape::Matrix, Symmetry::Symmetric),
    ("skew", Shape::Matrix, Symmetry::Skew),
];

impl MotionSpec {
    /// What it says about itself.
    pub(crate) fn about(&self) -> About<'_> {
        let MotionSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: Vec::new() }
    }

    /// Reads a motion, derives its equations and proves what it declares.
    ///
    /// # Errors
    /// Everything wrong with the file, each with its place.
    pub fn read(file: &Arc<Source>) -> Result<Self, Diagnostics> {
        read::spec(file, KIND.shape, |document, root, head| read_motion(document, file, root, head))
    }
}

fn read_motion(
    document: &Document,
    file: &Arc<Source>,
    root: Table,
    head: Head,
) -> Option<MotionSpec> {
    let mut graph = Graph::new();
    let mut names = BTreeMap::new();
    let coordinates = coordinates(&root, &mut graph, &mut names);
    let tensors = tensors(&root, &mut graph, &mut names);
    let mut reader = Reader { document, graph, names, coordinates };
    let motion = match root.optional_string("kinetic_energy") {
        Some(energy) => reader.by_energy(&energy),
        None => reader.by_terms(&root),
    };
    root.finish();
    let (equations, derivatives) = motion?;
    if document.has_errors() {
        return None;
    }
    let [name, title, reference] = head.texts()?;
    Some(MotionSpec {
        name,
        title,
        reference,
        file: file.clone(),
        coordinates: reader.coordinates,
        tensors,
        graph: reader.graph,
        equations,
        derivatives,
    })
}

/// Reads `[coordinates]`, which must name just what the solver marches.
fn coordinates(
    root: &Table,
    graph: &mut Graph,
    names: &mut BTreeMap<String, Id>,
) -> Vec<Coordinate> {
    if let Some(table) = root.table("coordinates") {
        for (name, _) in COORDINATES {
            table.word(name);
        }
        table.finish();
    }
    let mut all = Vec::with_capacity(COORDINATES.len());
    for (name, shape) in COORDINATES {
        let coordinate = Coordinate::new(graph, name, *shape);
        names.insert(coordinate.name.clone(), coordinate.position);
        names.insert(format!("{name}_dot"), coordinate.velocity);
        names.insert(format!("{name}_ddot"), coordinate.acceleration);
        all.push(coordinate);
    }
    all
}

fn tensors(root: &Table, graph: &mut Graph, names: &mut BTreeMap<String, Id>) -> Vec<Tensor> {
    let Some(table) = root.table("tensors") else { return Vec::new() };
    let mut tensors = Vec::new();
    for key in table.names() {
        let word = table.word(key.text());
        let free = |name| match names.contains_key(&name) {
            true => Err(format!("`{name}` is already a coordinate, a rate or a tensor")),
            false => Ok(name),
        };
        let Some(name) = read::name(table.document(), &key, free) else { continue };
        let Some((_, shape, symmetry)) = TENSORS.into_iter().find(|t| Some(t.0) == word) else {
            continue;
        };
        let symbol = graph.symbol(&name, shape, symmetry);
        names.insert(name.clone(), symbol);
        tensors.push(Tensor { name, symbol, shape, symmetry });
    }
    table.finish();
    tensors
}
