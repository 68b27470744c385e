//! Bodies without cells: reduced or whole matrices that another program wrote, with their dofs.
//!
//! A file is read (`market`, `op4`, `dmig`, `abaqus`, `calculix`) into entries by dof (`entries`); `build` places the dofs on the nodes
//! of a [`Mesh`](super::Mesh) without cells, which carries the matrices. What is assembled of any other mesh is then taken
//! from them.
//!
//! Three dofs a node, as everywhere: a dof that is no translation of a node with a place (a turn of a node, a modal
//! coordinate) is one of a further node behind those that have a place. Dofs that the matrices lack are held.

mod abaqus;
mod build;
mod calculix;
mod checks;
mod dmig;
mod entries;
mod kinds;
mod market;
mod modes;
mod op4;
mod read;
mod request;
mod rigid;
mod spin;
mod table;

use std::path::Path;

pub use self::kinds::file_and_name;
pub use self::read::{Load, ReadMatrices, read};
pub use self::request::{Files, Request};
pub use self::rigid::TurnAboutZ;
pub use super::body_matrices::{BodyMatrices, Slot};

/// The name of a file as messages show it.
fn shown(path: &Path) -> String {
    path.display().to_string()
}
