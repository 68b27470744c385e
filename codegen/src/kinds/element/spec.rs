//! An element as it is read.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::function::Function;
use super::table::Table;
use crate::diagnostic::{Located, Source};
use crate::element::{Cell, Quadrature};
use crate::expression::{Graph, Id, Rational};
use crate::kinds::kind::About;

/// An element, ready to be emitted: see [`crate::kinds::element`] for the file.
#[derive(Debug, Clone)]
pub struct ElementSpec {
    /// Name by which the solver refers to it.
    pub name: String,
    /// One-line description.
    pub title: String,
    /// Book or paper.
    pub(crate) reference: String,
    /// The file.
    pub file: Arc<Source>,
    /// Reference cell.
    pub cell: Cell,
    /// The graph that holds all expressions.
    pub graph: Graph,
    /// The symbols ξ, η, ζ.
    pub(crate) coordinates: [Id; 3],
    /// Reference nodes.
    pub nodes: Vec<ReferenceNode>,
    /// One shape function a node.
    pub shape: Vec<Function>,
    /// Degree up to which the shape functions reproduce polynomials.
    pub complete: u32,
    /// Modes of the cell's own.
    pub(crate) enhanced: Option<Enhanced>,
    /// The rule of every form that has none of its own.
    pub(crate) quadrature: Quadrature,
    /// Rules of single forms.
    pub(crate) quadrature_of: BTreeMap<String, Quadrature>,
    /// What functions and rules give together: of the common rule, and of those of single forms.
    pub(super) tables: (Table, BTreeMap<String, Table>),
    /// Element types of Abaqus and CalculiX.
    pub(crate) abaqus: Vec<Located>,
    /// Node of this element, from 0, at each place of an Abaqus line.
    pub(crate) abaqus_order: Vec<usize>,
    /// Element type of Gmsh, with the node of this element, from 0, at each place of an element of Gmsh.
    pub(crate) gmsh: Option<(u8, Vec<usize>)>,
    /// That type in digits.
    pub(super) gmsh_name: Option<String>,
    /// The card of Nastran, with the node of this element, from 0, at each place of that card.
    pub(crate) nastran: Option<(Located, Vec<usize>)>,
    /// VTK cell type.
    pub(crate) vtk: u8,
    /// Node of this element, from 0, at each place of a VTK cell.
    pub(crate) vtk_order: Vec<usize>,
}

/// A node of the reference cell.
#[derive(Debug, Clone)]
pub struct ReferenceNode {
    /// ξ, η, ζ.
    pub at: [Rational; 3],
    /// Where it stands in the file.
    pub place: std::ops::Range<usize>,
}

/// Which Jacobian turns reference gradients of enhanced modes into physical ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ModeJacobian {
    /// That of the cell's centre.
    Centre,
    /// That of the point itself.
    Point,
}

/// Enhanced (incompatible) modes: three parameters a mode, which add Σ αₘ ⊗ ∇Mₘ to ∇u and are condensed
/// out of the cell's matrix.
#[derive(Debug, Clone)]
pub struct Enhanced {
    /// The modes.
    pub modes: Vec<Function>,
    /// Jacobian of their gradients.
    pub(crate) jacobian: ModeJacobian,
    /// Factor of their gradients, a function of `det` and `det0`.
    pub(crate) scale: Id,
    /// The formula of the factor, or the table where there is none.
    pub(crate) scale_place: std::ops::Range<usize>,
    /// The symbol `det`, det J at the point.
    pub(crate) det: Id,
    /// The symbol `det0`, det J at the centre.
    pub(crate) det0: Id,
    /// The forms they take part in.
    pub forms: Vec<Located>,
}

impl ElementSpec {
    /// What it says about itself.
    pub(crate) fn about(&self) -> About<'_> {
        let ElementSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: Vec::new() }
    }

    /// Its name, and the types of Abaqus and Gmsh that are read as it.
    pub(in crate::kinds) fn names(&self) -> Vec<(&'static str, &str)> {
        let types = self.abaqus.iter().map(|name| ("Abaqus type", name.text()));
        let gmsh = self.gmsh_name.iter().map(|name| ("Gmsh type", name.as_str()));
        std::iter::once(("element", self.name.as_str())).chain(types).chain(gmsh).collect()
    }

    /// The rule with which a form is integrated.
    pub fn rule(&self, form: &str) -> &Quadrature {
        self.quadrature_of.get(form).unwrap_or(&self.quadrature)
    }

    /// Weights and functions at the points of that rule.
    pub fn table(&self, form: &str) -> &Table {
        let (common, single) = &self.tables;
        single.get(form).unwrap_or(common)
    }

    /// Whether a form is the same sums over the same points as on another element, so that one kernel does for both.
    pub(crate) fn integrates_as(&self, other: &ElementSpec, form: &str) -> bool {
        let (own, theirs) = (self.table(form), other.table(form));
        self.enhanced_in(form).is_none()
            && other.enhanced_in(form).is_none()
            && own.weights == theirs.weights
            && own.values == theirs.values
            && own.slopes == theirs.slopes
    }

    /// The enhanced modes, if they take part in a form.
    pub fn enhanced_in(&self, form: &str) -> Option<&Enhanced> {
        self.enhanced.as_ref().filter(|e| e.forms.iter().any(|name| name.text() == form))
    }
}
