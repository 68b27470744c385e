//! Meshes that Gmsh made (`tests/data/gmsh/make.py`).

use whirl_solver::assembly::mass_properties;
use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::format::{MeshUnits, ReadMesh, ReadOptions, read};

use crate::packed::data;
use crate::{elements, open, steel};

const VARIANTS: [&str; 4] = ["22-text", "22-binary", "41-text", "41-binary"];

/// The bodies that Gmsh made, their element, and their volume.
const BODIES: [(&str, &str, Option<f64>); 7] = [
    ("tet4", "tet4", None),
    ("tet10", "tet10", None),
    ("wedge6", "wedge6", Some(2.0)),
    ("wedge15", "wedge15", Some(2.0)),
    ("hex8", "hex8i", Some(2.0)),
    ("hex20", "hex20", Some(2.0)),
    ("pyramid5", "pyramid5", Some(8.0)),
];

fn made(name: &str, variant: &str) -> ReadMesh {
    let name = format!("{name}-{variant}.msh");
    open(&data(&format!("gmsh/{name}")), &name).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Largest distance of a node within an edge from the middle of the nodes at its ends, over the cell's extent.
fn off_middle(mesh: &Mesh) -> f64 {
    let mut worst: f64 = 0.0;
    for block in mesh.blocks() {
        let reference = block.element.reference_nodes;
        let middle = |a: usize, b: usize, i: usize| 0.5 * (reference[a][i] + reference[b][i]);
        for (node, at) in reference.iter().enumerate() {
            let before = (0..node).flat_map(|a| (0..a).map(move |b| (a, b)));
            let ends = before
                .filter(|&(a, b)| (0..3).all(|i| (middle(a, b, i) - at[i]).abs() < 1e-12))
                .min_by_key(|&(a, b)| a + b);
            let Some((a, b)) = ends.filter(|_| node >= 4 && reference.len() > 8) else { continue };
            for cell in block.cells() {
                let position = |node: usize| mesh.nodes()[cell[node]];
                for i in 0..3 {
                    let off = position(node)[i] - 0.5 * (position(a)[i] + position(b)[i]);
                    worst = worst.max(off.abs());
                }
            }
        }
    }
    worst
}

#[test]
fn every_version_and_kind_of_file_gives_the_same_mesh() {
    for (name, element, volume) in BODIES {
        let first = made(name, VARIANTS[0]).mesh;
        for variant in VARIANTS {
            let ReadMesh { mesh, warnings, .. } = made(name, variant);
            assert!(warnings.iter().all(|w| w.what.starts_with("left out: ")), "{warnings:?}");
            assert_eq!(mesh.blocks().len(), 1, "{name}");
            assert_eq!(mesh.blocks()[0].element.origin.name, element);
            assert_eq!(mesh.node_sets(), first.node_sets(), "{name} {variant}");
            assert_eq!(mesh.element_sets(), first.element_sets(), "{name} {variant}");
            assert_eq!(mesh.blocks()[0].connectivity, first.blocks()[0].connectivity);
            for (a, b) in mesh.nodes().iter().zip(first.nodes()) {
                assert!((0..3).all(|i| (a[i] - b[i]).abs() < 1e-15), "{a:?} {b:?}");
            }
            assert_eq!(mesh.element_set("body").unwrap().len(), mesh.cell_count());
            let found = mass_properties(&mesh.with_material(&steel(), |_| true).unwrap()).unwrap();
            if let Some(volume) = volume {
                assert!((found.volume / volume - 1.0).abs() < 1e-12, "{name}: {}", found.volume);
            }
        }
    }
}

#[test]
fn nodes_within_edges_are_in_the_order_of_the_element() {
    for name in ["wedge15", "hex20"] {
        assert!(off_middle(&made(name, "41-binary").mesh) < 1e-14, "{name}");
    }
    // Edges on the cylinder of radius 1 are curved; inscribed polygons are smaller than the circle.
    let volume = |name: &str| {
        let mesh = made(name, "41-text").mesh.with_material(&steel(), |_| true).unwrap();
        mass_properties(&mesh).unwrap().volume / std::f64::consts::TAU
    };
    assert!(off_middle(&made("tet10", "22-text").mesh) < 0.2);
    let (linear, quadratic) = (volume("tet4"), volume("tet10"));
    assert!(
        linear > 0.8 && linear < 0.95 && (quadratic - 1.0).abs() < 0.01,
        "{linear} {quadratic}"
    );
}

#[test]
fn physical_groups_are_sets() {
    let mesh = made("tet10", "41-binary").mesh;
    assert_eq!(mesh.element_sets().keys().collect::<Vec<_>>(), ["body"]);
    let names: Vec<&str> = mesh.node_sets().keys().map(String::as_str).collect();
    assert_eq!(names, ["SURFACE_7", "body", "corner", "edge", "low end"]);
    let z = |set: &str| mesh.node_set(set).unwrap().iter().map(|&node| mesh.nodes()[node][2]);
    assert!(z("low end").all(|z| z.abs() < 1e-12) && z("low end").len() > 12);
    assert!(z("surface_7").all(|z| (z - 2.0).abs() < 1e-12));
    assert_eq!(z("body").len(), mesh.nodes().len());
    mesh.single_node("corner").unwrap();
    let edge = mesh.node_set("edge").unwrap();
    let radius = |&node: &usize| mesh.nodes()[node][0].hypot(mesh.nodes()[node][1]);
    assert!(edge.iter().all(|node| (radius(node) - 1.0).abs() < 1e-12) && edge.len() > 6);
}

#[test]
fn a_volume_in_two_groups_has_its_cells_once() {
    for variant in VARIANTS {
        let mesh = made("pyramid5", variant).mesh;
        assert_eq!(mesh.cell_count(), 6);
        assert_eq!(mesh.element_set("body").unwrap(), mesh.element_set("volume_3").unwrap());
    }
}

#[test]
fn elements_that_are_not_known_are_named_in_words() {
    for variant in VARIANTS {
        let errors = open(&data(&format!("gmsh/pyramid13-{variant}.msh")), "p.msh").unwrap_err();
        assert_eq!(errors.0.len(), 1, "{errors}");
        let text = errors.to_string();
        assert!(text.contains("quadratic pyramids of 13 nodes are not read"), "{text}");
        assert!(text.contains("mesh without pyramids"), "{text}");
        assert!(text.contains("quadratic tetrahedra of 10 nodes (11)"), "{text}");
    }
    // A hexahedron of 27 nodes: only its type is looked at.
    let text = String::from_utf8(data("gmsh/hex20-41-text.msh")).unwrap();
    let nodes: Vec<String> = (1..=27).map(|node| node.to_string()).collect();
    let start = text.find("$Elements").unwrap();
    let cell = format!("$Elements\n1 1 1 1\n3 1 12 1\n1 {}\n$EndElements\n", nodes.join(" "));
    let errors = open((text[..start].to_owned() + &cell).as_bytes(), "h.msh").unwrap_err();
    assert!(errors.to_string().contains("`Mesh.SecondOrderIncomplete = 1`"), "{errors}");
}

#[test]
fn what_is_left_out_is_said_in_one_line() {
    let warnings = made("hex8", "22-binary").warnings;
    assert_eq!(warnings.len(), 1);
    let what = &warnings[0].what;
    assert!(what.starts_with("left out: 1 point, ") && what.contains(" lines and "), "{what}");
    assert!(what.ends_with(" faces; the nodes of their physical groups are node sets"), "{what}");
}

#[test]
fn units_scale_lengths_and_need_a_material() {
    let elements = elements();
    let units = MeshUnits { length: 1e-3, force: 1.0, mass: 1e3 };
    let options = ReadOptions { open: true, units, ..ReadOptions::new(&elements) };
    let found = read(data("gmsh/hex8-41-text.msh"), "h.msh", &options).unwrap().mesh;
    let there = made("hex8", "41-text").mesh;
    for (small, large) in found.nodes().iter().zip(there.nodes()) {
        assert!((0..3).all(|i| small[i] == large[i] / 1000.0));
    }
    let options = ReadOptions::new(&elements);
    let errors = read(data("gmsh/hex8-41-text.msh"), "h.msh", &options).unwrap_err().to_string();
    assert!(
        errors.contains("without a section") && errors.contains("write `material ="),
        "{errors}"
    );
}

/// Parts that Gmsh cuts a mesh into have entities of their own, in the groups of those that they are parts of.
#[test]
fn a_mesh_in_parts_is_the_whole() {
    // Gmsh counts the nodes anew: by their places.
    let sets = |mesh: &Mesh| -> Vec<(String, Vec<[i64; 3]>)> {
        let places = |nodes: &Vec<usize>| {
            let place = |&node: &usize| mesh.nodes()[node].map(|x| (x * 1e9).round() as i64);
            let mut places: Vec<[i64; 3]> = nodes.iter().map(place).collect();
            places.sort_unstable();
            places
        };
        mesh.node_sets().iter().map(|(name, nodes)| (name.clone(), places(nodes))).collect()
    };
    for variant in VARIANTS {
        let [whole, parts] = ["cut-whole", "cut-parts"].map(|name| made(name, variant).mesh);
        assert_eq!(whole.cell_count(), parts.cell_count(), "{variant}");
        assert!(whole.cell_count() > 20);
        assert_eq!(sets(&whole), sets(&parts), "{variant}");
        let [whole, parts] = [whole, parts].map(|mesh| {
            let steel = mesh.with_material(&steel(), |_| true).expect("a material");
            mass_properties(&steel).expect("a body")
        });
        assert!((whole.mass / parts.mass - 1.0).abs() < 1e-12, "{variant}");
        for (a, b) in whole.centre.iter().zip(parts.centre) {
            assert!((a - b).abs() < 1e-12, "{variant}");
        }
    }
}
