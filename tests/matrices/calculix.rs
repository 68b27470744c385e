//! What CalculiX 2.20 wrote of two small bars (tests/data/calculix), against our assembly of their meshes.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use whirl_solver::assembly::mass_properties;
use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::format::{self, MeshUnits, ReadOptions};
use whirl_solver::mesh::matrices::{Files, read};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::ELEMENTS;
use whirl_tests::matrices as written;

use super::{request, shafts_agree, spec};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data/calculix")
}

/// The bytes of a file, or of the packed one in its place.
fn load(path: &Path) -> std::io::Result<Vec<u8>> {
    let mut packed = path.as_os_str().to_owned();
    packed.push(".gz");
    match fs::File::open(&packed) {
        Ok(file) => {
            let mut bytes = Vec::new();
            flate2::read::GzDecoder::new(file).read_to_end(&mut bytes)?;
            Ok(bytes)
        }
        Err(_) => fs::read(path),
    }
}

const UNITS: MeshUnits = MeshUnits { length: 1e-3, force: 1.0, mass: 1e3 };

#[test]
fn stored_matrices_are_those_of_our_elements() {
    for name in ["bar20", "bar10"] {
        let nodes = folder().join(format!("{name}.inp"));
        let mut request =
            request(Files::Calculix { job: folder().join(name), nodes: nodes.clone() });
        request.units = UNITS;
        let stored = match read(&request, &load) {
            Ok(read) => read.mesh,
            Err(errors) => panic!("{errors}"),
        };
        let elements: Vec<_> = ELEMENTS.iter().collect();
        let options = ReadOptions { units: UNITS, ..ReadOptions::new(&elements) };
        let path = nodes.display().to_string();
        let mesh = format::read(fs::read(&nodes).expect("the input"), &path, &options)
            .expect("a mesh")
            .mesh;
        assert_eq!(stored.nodes().len(), mesh.nodes().len());
        let own = stored.matrices().expect("matrices");
        assert_eq!(
            (own.lacks_to_be_free("rigid"), own.lacks_to_turn(false)),
            (None, None),
            "{name}"
        );

        // The entries, by the labels of the nodes: CalculiX writes fourteen digits.
        let place =
            |label: u64| mesh.labels().iter().position(|&own| own == label).expect("a node");
        // It takes four points for the mass of C3D10, too, which are exact for rigid motions only; ours has fifteen.
        let exact = if name == "bar20" { 2 } else { 1 };
        let pairs = written::of_mesh(&stored).into_iter().zip(written::of_mesh(&mesh));
        for (matrix, ours) in pairs.take(exact) {
            let largest = ours.values.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            let mut sum = 0.0;
            for j in 0..matrix.width() {
                let column = 3 * place(stored.labels()[j / 3]) + j % 3;
                for (i, value) in matrix.column(j) {
                    let row = 3 * place(stored.labels()[i / 3]) + i % 3;
                    let known =
                        ours.column(column).find(|(own, _)| *own == row).map_or(0.0, |(_, v)| v);
                    assert!(
                        (value - known).abs() < 1e-11 * largest,
                        "{name}: {value} {known} of {largest}"
                    );
                    sum += value.abs();
                }
            }
            let whole: f64 = ours.values.iter().map(|x| x.abs()).sum();
            assert!((sum / whole - 1.0).abs() < 1e-10, "{name}: nothing is missing");
        }
        let [made, found] = [&mesh, &stored].map(|own| mass_properties(own).expect("a mass"));
        assert!((made.mass / found.mass - 1.0).abs() < 1e-12);
        for i in 0..3 {
            assert!((made.centre[i] - found.centre[i]).abs() < 1e-13);
            for j in 0..3 {
                let (a, b) = (made.second_moment[i][j], found.second_moment[i][j]);
                assert!((a - b).abs() < 1e-11 * made.second_moment[2][2], "{a} {b}");
            }
        }

        if name == "bar10" {
            continue;
        }
        // And the bodies: held at three nodes of an end, and turning with them retained.
        let end = |own: &Mesh| {
            let mut nodes = own.node_set("END").expect("a set").to_vec();
            nodes.sort_by_key(|&node| own.labels()[node]);
            nodes[..3].to_vec()
        };
        let [made, found] = [&mesh, &stored].map(|own| {
            let mut spec = spec(own, &[], 8);
            spec.held
                .extend(end(own).iter().flat_map(|node| [3 * node, 3 * node + 1, 3 * node + 2]));
            Support::from_mesh(own, &spec).expect("a body").hertz
        });
        for (a, b) in made.iter().zip(&found) {
            assert!((a / b - 1.0).abs() < 1e-9, "{name}: {a} {b} Hz");
        }
        let turning =
            |own: &Mesh| Shaft::from_mesh(own, &spec(own, &end(own), 0)).expect("a shaft");
        shafts_agree(&turning(&mesh), &turning(&stored), 1e-9);
    }
}
