//! Meshes in Nastran's bulk data.
#![no_main]

use whirl_solver::mesh::bdf;
use whirl_solver::mesh::format::ReadOptions;

libfuzzer_sys::fuzz_target!(|text: &str| {
    let elements: Vec<_> = whirl_specs::ELEMENTS.iter().collect();
    let none = |_: &std::path::Path| Err(std::io::ErrorKind::NotFound.into());
    if let Err(errors) = bdf::read(text, "mesh.bdf", &ReadOptions::new(&elements), &none) {
        assert!(!errors.to_string().is_empty());
    }
});
