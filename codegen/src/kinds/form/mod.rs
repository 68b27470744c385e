//! Bilinear forms: what is integrated over a cell.
//!
//! ```toml
//! kind = "form"
//! name = "elasticity"
//! title = "…"
//! source = "book and section"
//!
//! [material.E]               # in SI units, as the kernels take them
//! unit = "Pa"
//! title = "Young's modulus"
//!
//! [coefficients]             # formulas over the material and the coefficients before
//! mu = 'E/(2*(1 + nu))'
//!
//! [matrices]                 # constant, 3 × 3
//! D = [[0, -1, 0], [1, 0, 0], [0, 0, 0]]
//!
//! [stresses]                 # what a form makes of a displacement that the kernel is given
//! sigma = "stiffness"
//!
//! [forms]                    # u: trial (columns), v: test (rows)
//! stiffness = 'lambda*div(u)*div(v) + 2*mu*inner(eps(u), eps(v))'
//! stiffening = 'inner(sigma, transpose(grad(u))*grad(v))'
//! ```
//!
//! A form is made of numbers, material, coefficients, `u`, `v`, constant matrices times them, `div`,
//! `grad`, `eps` (the symmetric part of `grad`), `trace`, `transpose`, products of matrices, `inner` of matrices and
//! `dot` of vectors.
//!
//! The stress of a form a(u, v) is the matrix σ with a(w, v) = ∫ σ : grad(v) dV for all v: derived from the form, not
//! declared. w is the displacement of the cell's nodes, and of the cell's own modes as they follow it in that form.

mod expand;
mod explain;
pub(super) mod kernels;
mod read;
mod schema;
mod spec;
mod stress;
mod structure;

pub use expand::{Bilinear, Place};
pub(crate) use kernels::FormKernels;
pub(super) use schema::KIND;
pub(crate) use spec::Coefficient;
pub use spec::{BasisPart, Form, FormSpec, Property, Stress};
pub use structure::{Pattern, Structure};

#[cfg(test)]
mod tests;
