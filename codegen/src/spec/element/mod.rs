//! Elements: reference nodes, shape functions, enhanced modes, quadrature, and the orders of other
//! programs; read, then proved.
//!
//! ```toml
//! kind = "element"
//! name = "hex8"
//! title = "…"
//! source = "book and section"
//! cell = "hexahedron"        # wedge, tetrahedron, pyramid
//! nodes = [[-1, -1, -1], …]  # exact: whole numbers, decimals, or formulas such as '1/3'
//! shape = '(1 + xi_a*xi)*(1 + eta_a*eta)*(1 + zeta_a*zeta)/8'   # or a list, one a node
//!
//! complete = 1               # degree of the polynomials that the functions reproduce; 1 if left out
//!
//! [quadrature]
//! rule = ["gauss(2)", "gauss(2)", "gauss(2)"]   # or points = [['xi', 'eta', 'zeta', 'weight'], …]
//! degree = 3                                    # of the monomials integrated exactly
//! reduced = false                               # true: fewer points than the form's products need
//! patch_test = "any"                            # "affine": only affine images of the cell must pass
//! [quadrature.forms.mass]                       # where a form wants another rule
//!
//! [enhanced]                                    # incompatible modes
//! forms = ["stiffness"]
//! modes = ['1 - xi^2', …]
//! jacobian = "centre"                           # or "point"
//! scale = 'det0/det'
//!
//! [abaqus]
//! types = ["C3D8"]
//! order = [1, 2, 3, …]       # the element's nodes in the order of the other program; left out if equal
//! [gmsh]                     # of the element that cells of Gmsh are read as; with `order` as above
//! type = 5
//! [nastran]                   # left out where no card of Nastran is read as this element
//! card = "CHEXA"
//! order = [1, 2, 3, …]
//! [vtk]
//! type = 12
//! ```

pub(crate) mod demand;
pub mod direct;
mod explain;
mod kernels;
mod prove;
mod read;
mod schema;
mod table;

use std::collections::BTreeMap;
use std::sync::Arc;

pub(super) use schema::KIND;
pub use table::{Products, Table};

use crate::diagnostic::{Diagnostics, Located, Source};
use crate::element::{Cell, Polynomial, Quadrature};
use crate::expression::{Graph, Id, Rational};
use crate::spec::kind::About;

/// An element, ready to be emitted: see the module for the file.
#[derive(Debug, Clone)]
pub struct ElementSpec {
    /// Name by which the solver refers to it.
    pub name: String,
    /// One line for people.
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
    tables: (Table, BTreeMap<String, Table>),
    /// Element types of Abaqus and CalculiX.
    pub(crate) abaqus: Vec<Located>,
    /// Node of this element, from 0, at each place of an Abaqus line.
    pub(crate) abaqus_order: Vec<usize>,
    /// Element type of Gmsh, with the node of this element, from 0, at each place of an element of Gmsh.
    pub(crate) gmsh: Option<(u8, Vec<usize>)>,
    /// That type in digits.
    gmsh_name: Option<String>,
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

/// A function of ξ, η, ζ.
#[derive(Debug, Clone)]
pub struct Function {
    /// Its value.
    pub value: Id,
    /// ∂/∂ξ, ∂/∂η, ∂/∂ζ.
    pub(crate) gradient: [Id; 3],
    /// The value multiplied out.
    pub(crate) polynomial: Polynomial,
    /// The gradient multiplied out.
    pub slopes: [Polynomial; 3],
    /// The formula.
    pub text: Located,
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
    pub(in crate::spec) fn names(&self) -> Vec<(&'static str, &str)> {
        let types = self.abaqus.iter().map(|name| ("Abaqus type", name.text()));
        let gmsh = self.gmsh_name.iter().map(|name| ("Gmsh type", name.as_str()));
        std::iter::once(("element", self.name.as_str())).chain(types).chain(gmsh).collect()
    }

    /// Reads an element and proves that it is sound.
    ///
    /// # Errors
    /// Everything wrong with the file, each with its place; every proof that fails, with the node, point
    /// or mode and the numbers.
    pub fn read(file: &Arc<Source>) -> Result<Self, Diagnostics> {
        let element = Self::read_unproved(file)?;
        prove::prove(&element)?;
        Ok(element)
    }

    /// Reads an element without the proofs: for what shows that they are needed.
    ///
    /// # Errors
    /// Everything wrong with the file, each with its place.
    pub fn read_unproved(file: &Arc<Source>) -> Result<Self, Diagnostics> {
        read::read(file)
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

#[cfg(test)]
mod tests;
