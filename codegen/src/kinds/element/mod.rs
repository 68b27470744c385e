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
mod function;
mod kernels;
mod prove;
mod read;
mod schema;
mod spec;
mod table;

use std::sync::Arc;

pub use function::Function;
pub(super) use schema::KIND;
pub(crate) use spec::ModeJacobian;
pub use spec::{ElementSpec, Enhanced, ReferenceNode};
pub use table::{Products, Table};

use crate::diagnostic::{Diagnostics, Source};

impl ElementSpec {
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
}

#[cfg(test)]
mod tests;
