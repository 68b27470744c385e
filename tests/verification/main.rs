//! Verification: each layer against exact solutions, other methods, or its own definition.

mod assembly;
mod bearing_kernels;
mod block;
mod bodies;
mod bulk_data;
mod cached_bodies;
mod constraints;
mod documents;
mod dynamics;
mod elements;
mod formulas;
mod generated_meshes;
mod invariants;
mod jeffcott;
mod laws;
mod layers;
mod massless;
mod measures;
mod mesh_input;
mod missed_modes;
mod newton_convergence;
mod reduction;
mod reference_kernels;
mod reference_modes;
mod small_shaft;
mod stiffening;
