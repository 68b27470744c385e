//! Oil films: what flows between two surfaces and what it does to them, as a weak form over cells of the developed
//! bore, with two unknowns a node of which one is zero.
//!
//! ```toml
//! kind = "film"
//! name = "…"
//! title = "…"
//! source = "paper and equation"
//!
//! [cell]                    # nodes of a cell around (x) and along (z): 2 or 3
//! around = 2
//! along = 3
//!
//! [unknowns.p]              # at every node: both at least zero, one of them zero; the first is the pressure
//! unit = "Pa"
//! [unknowns.r]
//! unit = "1"
//! [gap.h]                   # given at every node by the motion of the surfaces
//! unit = "m"
//! [speed.u]                 # mean speed of the surfaces along x, in the frame of the bore
//! unit = "m/s"
//! [parameters.mu]           # numbers of a film, in SI in formulas
//! value = 20
//! unit = "mPa*s"
//!
//! [nodal]                   # fields at the nodes, interpolated over a cell as unknowns are
//! theta = '1 - r'
//! [definitions]             # names for parts of what follows
//! k = 'h^3/(12*mu)'
//! [stored]                  # oil a node holds, per area; its rate is in balance with the flows
//! value = 'theta*h'
//! [residual]                # linear in the test function v, each term at its own points
//! around = { value = 'k*ddx(p)*ddx(v)', points = ["midpoint", "lobatto(3)"] }
//! shear = { value = '-u*h*upstream(theta, u)*ddx(v)', points = ["midpoint", "lobatto(3)"] }
//! [forces]                  # per area, at the nodes, each on a measure of the clearance
//! Q = { on = "h", value = 'p' }
//! [edges]                   # what nodes on an edge or an opening may be
//! open = { given = ["p"], complementary = ["out", "r"] }
//! supply = { given = ["p", "r"] }
//! [outputs.loss]            # integrals over the bore
//! unit = "W"
//! terms.shear = { value = 'mu*(2*u)^2*theta/h', points = "nodes" }
//! ```
//!
//! `ddx` and `ddz` take a field of the nodes or `v`. `upstream(f, u)` is f − sgn(u)·dx/2·ddx(f); the sign is constant in
//! derivatives. dx and dz are the lengths of a cell.

mod derive;
mod direct;
mod explain;
mod kernels;
mod operators;
mod prove;
mod read;
mod rule;
mod schema;
mod spec;
#[cfg(test)]
mod tests;

use std::sync::Arc;

pub use derive::{CellSlope, Derived, Outcome};
pub use direct::CellValues;
pub(super) use schema::KIND;
pub use spec::{Edge, Field, FieldKind, FilmSpec, Force, Integral, Parameter, Term, Variable};

use crate::diagnostic::{Diagnostics, Source};

impl FilmSpec {
    /// Reads a film file.
    ///
    /// # Errors
    /// Everything that is wrong with it, each with its place.
    pub fn read(file: &Arc<Source>) -> Result<Self, Diagnostics> {
        let spec = read::read(file)?;
        prove::prove(&spec)?;
        Ok(spec)
    }
}
