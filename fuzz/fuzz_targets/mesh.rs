//! Meshes in Abaqus and CalculiX input.
#![no_main]

libfuzzer_sys::fuzz_target!(|text: &str| {
    let elements: Vec<_> = whirl_specs::ELEMENTS.iter().collect();
    if let Err(errors) = whirl_solver::mesh::inp::read(text, "mesh.inp", &elements) {
        assert!(!errors.to_string().is_empty());
    }
});
