//! Verification: each layer against exact solutions, other methods, or its own definition.

mod assembly;
mod bearing_kernels;
mod block;
mod bodies;
mod cached_bodies;
mod constraints;
mod documents;
mod dynamics;
mod elements;
mod formulas;
mod invariants;
mod laws;
mod made_meshes;
mod mesh_input;
mod missed_modes;
mod newton;
mod reduction;
mod reference_modes;
mod small_shaft;
mod twins;
