//! Every element, in coordinate systems in coordinate systems, as pyNastran writes them (tests/data/bdf/make.py).

use std::fs;
use std::path::Path;

use whirl_solver::assembly::mass_properties;
use whirl_solver::mesh::format::{ReadMesh, ReadOptions};
use whirl_solver::mesh::{Mesh, bdf};
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
        // The cells of the file touch anywhere, which is told beside what is left out.
        let touches = ["at one place", "hang on faces", "quadratic"];
        let told =
            warnings.iter().filter(|own| !touches.iter().any(|word| own.what.contains(word)));
        assert_eq!(told.count(), 1, "{warnings:?}");
    }
}

/// The file with another card, or why it is refused.
fn with(card: &str) -> Result<ReadMesh, String> {
    let text = format!("{}{card}\n", data("every-element-small.bdf"));
    let elements: Vec<&'static Element> = ELEMENTS.iter().collect();
    let read = bdf::read(&text, "cells.bdf", &ReadOptions::new(&elements), &super::no_files);
    read.map_err(|errors| errors.to_string().split_once(": ").unwrap().1.to_owned())
}

#[test]
fn pyramids_with_nodes_on_edges_are_refused() {
    assert_eq!(
        with("CPYRAM,99,4,1,2,3,4,5,6\n,7,8,9,10,11,12,13").unwrap_err(),
        "no element is known for CPYRAM 99 with nodes on its edges\n  help: write CPYRAM with its 5 corners only, \
         or mesh this part with other elements"
    );
}

/// A node on an edge that has none: that of the neighbour, where it has one, else a new one in the middle.
#[test]
fn edges_without_a_node_get_one_in_their_middle() {
    let whole = read(&data("every-element-small.bdf")).mesh;
    let quadratic = |mesh: &Mesh| -> Vec<(u64, Vec<u64>)> {
        let blocks = mesh.blocks().iter().filter(|block| block.element.nodes > 8);
        let cells = blocks.flat_map(|block| block.labels.iter().zip(block.cells()));
        cells
            .map(|(label, nodes)| (*label, nodes.iter().map(|&node| mesh.labels()[node]).collect()))
            .collect()
    };
    let cards = quadratic(&whole);
    assert!(cards.len() > 5);
    // Every card once, without the last node on an edge; a node that no other cell has is then gone.
    for (label, nodes) in &cards {
        let text = data("every-element-large.bdf");
        let start = text.lines().position(|line| {
            let mut words = line.split_whitespace();
            line.starts_with('C') && words.nth(1) == Some(&label.to_string())
        });
        let Some(start) = start else { panic!("no card of {label}") };
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        let mut end = start + 1;
        while lines[end].starts_with(' ') {
            end += 1;
        }
        let last = lines[end - 1].trim_end().to_owned();
        let cut = last.rfind(char::is_whitespace).expect("fields");
        let removed: u64 = last[cut..].trim().parse().expect("a label");
        lines[end - 1] = last[..cut].to_owned();
        let found = read(&(lines.join("\n") + "\n"));
        assert!(
            found.warnings.iter().any(|own| own.what.starts_with(&format!(
                "1 quadratic element without a node on each edge ({label}): "
            ))),
            "{:?}",
            found.warnings
        );
        let now = quadratic(&found.mesh);
        let (_, own) = now.iter().find(|(own, _)| own == label).expect("the cell");
        let at = nodes.iter().position(|node| *node == removed).expect("its node");
        for (place, (own, before)) in own.iter().zip(nodes).enumerate() {
            assert!(place == at || own == before, "{label}: {own} for {before}");
        }
        // In the middle of the corners between which it stands in the element.
        let position = |label: &u64| {
            let mesh = &found.mesh;
            mesh.nodes()[mesh.labels().iter().position(|own| own == label).expect("a node")]
        };
        let element = ELEMENTS.iter().find(|element| {
            element.nodes == own.len() && element.nastran.is_some() && element.nodes > 8
        });
        let place = |node: usize| element.expect("an element").reference_nodes[node];
        let is_edge = |&(a, b): &(usize, usize)| {
            a < b && (0..3).all(|i| place(a)[i] + place(b)[i] == 2.0 * place(at)[i])
        };
        let pairs = (0..own.len()).flat_map(|a| (0..own.len()).map(move |b| (a, b)));
        let edge = pairs.filter(is_edge).find(|(a, b)| *a != at && *b != at).expect("an edge");
        let ends = [position(&own[edge.0]), position(&own[edge.1])];
        assert_eq!(position(&own[at]), [0, 1, 2].map(|i| (ends[0][i] + ends[1][i]) / 2.0));
    }
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
