//! Meshes in every format.
#![no_main]

use whirl_solver::mesh::format::{ReadOptions, read};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let elements: Vec<_> = whirl_specs::ELEMENTS.iter().collect();
    let options = ReadOptions { open: true, ..ReadOptions::new(&elements) };
    if let Err(errors) = read(bytes.to_vec(), "mesh", &options) {
        assert!(!errors.to_string().is_empty());
    }
});
