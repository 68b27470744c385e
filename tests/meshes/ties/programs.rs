//! Files with ties that CalculiX has solved, and one that pyNastran wrote (`tests/data/calculix/ties.py`).

use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::format::{ReadOptions, read};
use whirl_solver::support::Support;

use super::reduced::spec;
use crate::elements;
use crate::packed::data;

fn hertz(mesh: &Mesh, base: &str) -> Vec<f64> {
    let base = mesh.node_set(base).expect("the clamped end");
    let held = base.iter().flat_map(|node| (0..3).map(move |i| 3 * node + i)).collect();
    let mut spec = spec(Vec::new(), held);
    spec.modes = 8;
    Support::from_mesh(mesh, &spec).expect("a body").hertz
}

fn mesh(path: &str) -> (Mesh, String) {
    let bytes = data(&format!("calculix/{path}"));
    let text = String::from_utf8(bytes.clone()).expect("text");
    let elements = elements();
    let read = read(bytes, path, &ReadOptions::new(&elements));
    (read.unwrap_or_else(|errors| panic!("{errors}")).mesh, text)
}

fn printed(text: &str) -> Vec<f64> {
    let numbers = text.lines().filter_map(|line| line.strip_prefix("**HERTZ "));
    numbers.map(|own| own.parse().expect("a number")).collect()
}

/// Largest difference (relative).
fn apart(own: &[f64], known: &[f64]) -> f64 {
    assert_eq!((own.len(), known.len()), (8, 8));
    own.iter().zip(known).map(|(own, known)| (own / known - 1.0).abs()).fold(0.0, f64::max)
}

#[test]
fn frequencies_are_those_of_calculix() {
    for name in ["equations", "faces", "nested", "rigid", "both"] {
        let (mesh, text) = mesh(&format!("ties-{name}.inp"));
        let apart = apart(&hertz(&mesh, "BASE"), &printed(&text));
        println!("{name}: {apart:.1e}");
        // Half a unit of the seventh digit of 0.1.
        assert!(apart < 5e-7, "{name}: {apart}");
    }
}

#[test]
fn bulk_data_of_pynastran_have_the_same_frequencies() {
    let (_, text) = mesh("ties-both.inp");
    let (mesh, _) = mesh("ties-both.bdf");
    let names: Vec<&str> = mesh.ties().iter().map(|tie| tie.name.as_str()).collect();
    assert_eq!(names, ["RBE2 9001", "MPC 7"]);
    let apart = apart(&hertz(&mesh, "SET1_3"), &printed(&text));
    assert!(apart < 5e-7, "{apart}");
}
