//! Every element, in coordinate systems in coordinate systems, as pyNastran writes them (tests/data/bdf/make.py).

use std::fs;
use std::path::Path;

use whirl_solver::assembly::mass_properties;
use whirl_solver::mesh::bdf;
use whirl_solver::mesh::format::{ReadMesh, ReadOptions};
use whirl_specs::{ELEMENTS, Element};

fn data(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/bdf").join(name);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn read(text: &str) -> ReadMesh {
    let elements: Vec<&'static Element> = ELEMENTS.iter().collect();
    let read = bdf::read(text, "cells.bdf", &ReadOptions::new(&elements), &super::no_files);
    read.unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn nodes_are_where_pynastran_puts_them() {
    for form in ["small", "large", "double"] {
        let ReadMesh { mesh, masses, warnings } = read(&data(&format!("every-element-{form}.bdf")));
        let positions = data("every-element.csv");
        let mut compared = 0;
        for line in positions.lines() {
            let mut values = line.split(',');
            let label: u64 = values.next().unwrap().parse().unwrap();
            let Some(node) = mesh.labels().iter().position(|own| *own == label) else { continue };
            for (own, wanted) in mesh.nodes()[node].iter().zip(values) {
                let wanted: f64 = wanted.parse().unwrap();
                assert!(
                    (own - wanted).abs() < 2e-14 * 30.0,
                    "{form}, node {label}: {own} for {wanted}"
                );
            }
            compared += 1;
        }
        assert_eq!((compared, mesh.nodes().len()), (204, 204));
        let names: Vec<&str> = mesh.blocks().iter().map(|b| b.element.origin.name).collect();
        assert_eq!(names, ["tet4", "tet10", "pyramid5", "wedge6", "wedge15", "hex8i", "hex20"]);
        assert_eq!(mesh.element_set("every element").unwrap().len(), 21);
        // Whatever the order of its nodes, a cell that is turned inside out has no mass.
        assert!(mass_properties(&mesh).unwrap().volume > 0.1);
        assert_eq!(mesh.node_set("RBE2_51").unwrap().len(), 3);
        assert_eq!(mesh.node_set("RBE3_52").unwrap().len(), 8);
        assert_eq!((masses.len(), masses[0].mass, masses[0].inertia[1][2]), (1, 2.5, -0.0));
        assert_eq!(masses[0].inertia[0], [0.1, 0.0, -0.01]);
        assert_eq!(warnings.len(), 2, "{warnings:?}");
    }
}

/// Nodes on some of the edges, on all of those of a pyramid, and turned the other way.
#[test]
fn elements_of_other_nodes_are_refused() {
    let text = data("every-element-small.bdf");
    let elements: Vec<&'static Element> = ELEMENTS.iter().collect();
    let errors = |card: &str| {
        let text = format!("{text}{card}\n");
        let read = bdf::read(&text, "cells.bdf", &ReadOptions::new(&elements), &super::no_files);
        let error = read.unwrap_err().to_string();
        error.split_once(": ").unwrap().1.to_owned()
    };
    let help = "\n  help: give a node to every edge, or to none: elements that are quadratic on some of their edges are \
                not read";
    assert_eq!(
        errors("CHEXA,99,4,1,2,3,4,5,6\n,7,8,9,10,11,12,13,14\n,15,16,17,,19,20"),
        format!("CHEXA 99 has 19 of 20 nodes: G18 is missing on its edges{help}")
    );
    assert_eq!(
        errors("CPENTA,99,4,1,2,3,4,5,6\n,7,8,9,10,11,12,13"),
        format!("CPENTA 99 has 13 of 15 nodes: G14, G15 are missing on its edges{help}")
    );
    assert_eq!(
        errors("CPYRAM,99,4,1,2,3,4,5,6\n,7,8,9,10,11,12,13"),
        "no element is known for CPYRAM 99 with nodes on its edges\n  help: write CPYRAM with its 5 corners only, \
         or mesh this part with other elements"
    );
}

/// Edges in the order in which Nastran's cards list the nodes on them.
const EDGES: [(&str, usize, &[[usize; 2]]); 3] = [
    ("CTETRA", 4, &[[1, 2], [2, 3], [3, 1], [1, 4], [2, 4], [3, 4]]),
    ("CPENTA", 6, &[[1, 2], [2, 3], [3, 1], [1, 4], [2, 5], [3, 6], [4, 5], [5, 6], [6, 4]]),
    (
        "CHEXA",
        8,
        &[
            [1, 2],
            [2, 3],
            [3, 4],
            [4, 1],
            [1, 5],
            [2, 6],
            [3, 7],
            [4, 8],
            [5, 6],
            [6, 7],
            [7, 8],
            [8, 5],
        ],
    ),
];

#[test]
fn orders_of_nodes_are_those_of_nastran() {
    for element in ELEMENTS {
        let Some((card, order)) = element.nastran else { continue };
        let place = |at: usize| element.reference_nodes[order[at]];
        let Some((_, corners, edges)) = EDGES.iter().find(|(own, ..)| *own == card) else {
            assert!(order.iter().copied().eq(0..element.nodes));
            continue;
        };
        assert!(element.nodes == *corners || element.nodes == corners + edges.len());
        for (at, [a, b]) in edges.iter().enumerate().take(element.nodes - corners) {
            let middle: Vec<f64> =
                place(a - 1).iter().zip(place(b - 1)).map(|(a, b)| (a + b) / 2.0).collect();
            assert_eq!(
                place(corners + at).to_vec(),
                middle,
                "{}, edge {a}-{b}",
                element.origin.name
            );
        }
    }
}
