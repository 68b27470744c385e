//! A beam that stands out from the axis at right angles: its flapping along the axis. Euler–Bernoulli beam; frequencies
//! ω L² √(ρA/EI) against θ̇ L² √(ρA/EI), hub of no radius.

use std::collections::BTreeMap;

use whirl_solver::mesh::{Block, Mesh, MeshParts};
use whirl_solver::shaft::Shaft;

use super::{dense, elements, spec, steel};

const LENGTH: f64 = 1.0;
const SIDE: f64 = 0.01;
const CELLS: usize = 60;
const DENSITY: f64 = 7860.0;
const TABLE: [(f64, [f64; 2]); 4] = [
    (0.0, [3.5160, 22.0345]),
    (3.0, [4.7973, 23.3203]),
    (6.0, [7.3604, 26.8091]),
    (12.0, [13.1702, 37.6031]),
];

/// Along x from the axis, cells × 2 × 2.
fn beam() -> Mesh {
    let node = |i: usize, j: usize, k: usize| (3 * i + j) * 3 + k;
    let (mut nodes, mut connectivity) = (Vec::new(), Vec::new());
    for i in 0..=CELLS {
        for (j, k) in (0..9).map(|n| (n / 3, n % 3)) {
            let across = |n: usize| SIDE * (0.5 * n as f64 - 0.5);
            nodes.push([LENGTH * i as f64 / CELLS as f64, across(j), across(k)]);
        }
    }
    for (i, (j, k)) in (0..CELLS).flat_map(|i| (0..4).map(move |n| (i, (n / 2, n % 2)))) {
        let low = [(0, 0), (1, 0), (1, 1), (0, 1)];
        for k in [k, k + 1] {
            connectivity.extend(low.map(|(a, b)| node(i + a, j + b, k)));
        }
    }
    let element = elements().into_iter().find(|e| e.origin.name == "hex8i").expect("hex8i");
    let cells = connectivity.len() / 8;
    Mesh::new(MeshParts {
        origin: "beam".to_owned(),
        labels: (1..=nodes.len() as u64).collect(),
        nodes,
        blocks: vec![Block {
            element,
            material: 0,
            labels: (1..=cells as u64).collect(),
            connectivity,
        }],
        materials: vec![steel(DENSITY)],
        node_sets: BTreeMap::new(),
        element_sets: BTreeMap::new(),
        ties: Vec::new(),
        matrices: None,
    })
    .expect("a mesh")
}

#[test]
fn a_rotating_cantilever_flaps_as_the_table_says() {
    let mesh = beam();
    let root: Vec<usize> = (0..27).collect();
    let tip = mesh.nodes().len() - 5;
    let shaft = Shaft::from_mesh(&mesh, &spec(&root, 27, 40, vec![tip])).expect("a body");
    let unit = LENGTH.powi(2) * (DENSITY * 12.0 / (2e11 * SIDE.powi(2))).sqrt();
    let tip = dense(&shaft.nodes[0].shapes);
    for (turn, expected) in TABLE {
        let speed = turn / unit;
        let stiffness = dense(&shaft.stiffness) - dense(&shaft.spin_net) * speed.powi(2);
        // M is the identity for fixed-interface modes.
        let eigen = stiffness.symmetric_eigen();
        let mut flaps: Vec<f64> = Vec::new();
        for (value, vector) in eigen.eigenvalues.iter().zip(eigen.eigenvectors.column_iter()) {
            let motion = &tip * vector;
            if motion[2].abs() > 10.0 * motion[0].abs().max(motion[1].abs()) {
                flaps.push(value.sqrt() * unit);
            }
        }
        flaps.sort_by(f64::total_cmp);
        for (found, expected) in flaps.iter().zip(expected) {
            println!("{turn}: {found} {expected}");
            assert!((found / expected - 1.0).abs() < 5e-3, "{turn}: {found} {expected}");
        }
        // Among all modes, Coriolis forces included, which flapping does not know.
        let all = shaft.frequencies_at(speed).unwrap().expect("a stiff beam");
        for expected in expected {
            let near =
                |own: &f64| (own * std::f64::consts::TAU * unit / expected - 1.0).abs() < 5e-3;
            assert!(all.iter().any(near), "{turn}: {expected} is not in {all:?}");
        }
    }
}
