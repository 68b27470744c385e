//! The reference shaft and support through each format of Gmsh.

use std::time::{Duration, Instant};

use whirl_solver::mesh::format::{ReadOptions, read};
use whirl_solver::mesh::{Block, Mesh, MeshParts};

use crate::packed::data;
use crate::writer::{Kind, gmsh};
use crate::{elements, open, steel};

fn reference(name: &str) -> Mesh {
    let path = format!("{name}.inp");
    open(&data(&path), &path).unwrap_or_else(|errors| panic!("{errors}")).mesh
}

fn sorted(set: &[usize]) -> Vec<usize> {
    let mut set = set.to_vec();
    set.sort_unstable();
    set
}

#[test]
fn the_reference_bodies_are_the_same_through_every_format() {
    for name in ["shaft", "support"] {
        let known = reference(name);
        for (version, kind) in [
            (2, Kind::Text),
            (2, Kind::Little),
            (2, Kind::Big),
            (4, Kind::Text),
            (4, Kind::Little),
            (4, Kind::Big),
        ] {
            let read = open(&gmsh(&known, version, kind), "body.msh");
            let found = read.unwrap_or_else(|errors| panic!("{version} {kind:?}: {errors}")).mesh;
            assert_eq!(found.nodes(), known.nodes());
            assert_eq!(found.labels(), known.labels());
            assert_eq!(found.blocks().len(), known.blocks().len());
            for (place, (a, b)) in found.blocks().iter().zip(known.blocks()).enumerate() {
                assert_eq!(a.element.origin.name, b.element.origin.name);
                assert_eq!((&a.labels, &a.connectivity), (&b.labels, &b.connectivity));
                let set = found.element_set(&format!("block{}", place + 1)).unwrap();
                assert_eq!(set.len(), b.len());
            }
            for (set, members) in known.node_sets() {
                assert_eq!(found.node_set(set).unwrap(), sorted(members), "{set}");
            }
        }
    }
}

/// A cube of `cells` cells along each edge.
fn cube(cells: usize) -> Mesh {
    let side = cells + 1;
    let at = |i: usize, j: usize, k: usize| i + side * (j + side * k);
    let mut nodes = vec![[0.0; 3]; side.pow(3)];
    let mut connectivity = Vec::new();
    for (k, j, i) in (0..side.pow(3)).map(|n| (n / side / side, n / side % side, n % side)) {
        nodes[at(i, j, k)] = [i, j, k].map(|x| x as f64 / cells as f64);
        if i < cells && j < cells && k < cells {
            for k in [k, k + 1] {
                connectivity.extend([
                    at(i, j, k),
                    at(i + 1, j, k),
                    at(i + 1, j + 1, k),
                    at(i, j + 1, k),
                ]);
            }
        }
    }
    let element = elements().into_iter().find(|element| element.origin.name == "hex8i").unwrap();
    let block =
        Block { element, material: 0, labels: (1..=cells.pow(3) as u64).collect(), connectivity };
    Mesh::new(MeshParts {
        origin: "cube".into(),
        labels: (1..=nodes.len() as u64).collect(),
        nodes,
        blocks: vec![block],
        materials: vec![steel()],
        ..MeshParts::default()
    })
    .unwrap()
}

#[test]
fn a_mesh_of_three_hundred_thousand_dofs_is_read_at_once() {
    let known = cube(46);
    let elements = elements();
    let options = ReadOptions { open: true, ..ReadOptions::new(&elements) };
    for (version, kind) in [(2, Kind::Text), (4, Kind::Text), (4, Kind::Little)] {
        let bytes = gmsh(&known, version, kind);
        let start = Instant::now();
        let found = read(bytes, "cube.msh", &options).unwrap_or_else(|errors| panic!("{errors}"));
        let time = start.elapsed();
        println!("version {version}, {kind:?}: {} dofs in {time:?}", found.mesh.dof_count());
        assert_eq!(found.mesh.blocks()[0].connectivity, known.blocks()[0].connectivity);
        // About a second when optimised; a reader that is quadratic takes hours.
        assert!(time < Duration::from_secs(30), "{time:?}");
    }
}
