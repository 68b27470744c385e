//! Files of meshes in every format: what other programs wrote, the reference bodies through each format, and files
//! that are damaged.

mod assemblies;
mod calculix;
mod continued;
mod corpus;
mod damaged;
mod forms;
mod gmsh;
mod input;
mod packed;
mod seams;
mod temperatures;
mod through;
mod ties;
mod universal;
mod writer;

use whirl_solver::error::InputErrors;
use whirl_solver::mesh::Material;
use whirl_solver::mesh::format::{ReadMesh, ReadOptions, read};
use whirl_specs::{ELEMENTS, Element};

fn elements() -> Vec<&'static Element> {
    ELEMENTS.iter().collect()
}

/// A mesh whose material is ambiguous.
fn open(bytes: &[u8], path: &str) -> Result<ReadMesh, InputErrors> {
    let elements = elements();
    let options = ReadOptions { open: true, ..ReadOptions::new(&elements) };
    read(bytes.to_vec(), path, &options)
}

fn steel() -> Material {
    Material::isotropic("steel", 206e9, 0.3, 7850.0).unwrap()
}
