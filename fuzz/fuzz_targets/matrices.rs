//! Bodies of matrices in every format: the first byte says which, the rest are its files, parted by a byte of zero.
#![no_main]

use std::io;
use std::path::{Path, PathBuf};

use whirl_solver::mesh::format::MeshUnits;
use whirl_solver::mesh::matrices::{Files, Request, read};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Some((kind, rest)) = bytes.split_first() else { return };
    let path = |name: &str| PathBuf::from(name);
    let files = match kind % 4 {
        0 => Files::Market { stiffness: path("0"), mass: path("1"), dofs: path("2") },
        1 => Files::Dmig {
            file: path("0"),
            nodes: path("1"),
            stiffness: "KAAX".to_owned(),
            mass: "MAAX".to_owned(),
        },
        2 => Files::Calculix { job: path("j"), nodes: path("0") },
        _ => Files::Abaqus { stiffness: path("0"), mass: path("1"), nodes: path("2") },
    };
    let texts: Vec<&[u8]> = rest.split(|byte| *byte == 0).collect();
    let load = |path: &Path| -> io::Result<Vec<u8>> {
        let name = path.to_str().unwrap_or_default();
        let place = match name {
            "j.dof" => 1,
            "j.sti" => 2,
            "j.mas" => 3,
            name => name.parse().unwrap_or(usize::MAX),
        };
        texts.get(place).map(|text| text.to_vec()).ok_or_else(|| io::ErrorKind::NotFound.into())
    };
    let request = Request {
        files,
        spin_inertia: None,
        spin_coupling: None,
        spin_load: None,
        stiffening: None,
        folder: PathBuf::new(),
        units: MeshUnits::default(),
    };
    if let Err(errors) = read(&request, &load) {
        assert!(!errors.to_string().is_empty());
    }
});
