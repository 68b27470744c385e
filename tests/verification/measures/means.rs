//! Weights of a mean, and the motion that it gives.

use std::collections::BTreeMap;

use whirl_solver::mesh::{MeanComponent, Mesh, NodeSetMean};
use whirl_specs::ELEMENTS;

use super::{applied, beam, element, mesh, near, rigid};

/// One cell whose nodes are moved.
fn cell(name: &str, moved: impl Fn([f64; 3]) -> [f64; 3]) -> Mesh {
    let own = element(name);
    let nodes = own.reference_nodes.iter().map(|&at| moved(at)).collect();
    mesh(name, nodes, (0..own.nodes).collect(), BTreeMap::new())
}

/// Mean of the nodes of a one-cell mesh that lie in the plane n·x = d.
fn plane(mesh: &Mesh, normal: [f64; 3], at: f64) -> Option<NodeSetMean> {
    let dot = |x: &[f64; 3]| normal.iter().zip(x).map(|(n, x)| n * x).sum::<f64>();
    let nodes = mesh.nodes().iter().enumerate();
    let nodes: Vec<usize> =
        nodes.filter(|(_, x)| (dot(x) - at).abs() < 1e-12).map(|(node, _)| node).collect();
    (nodes.len() > 2).then(|| NodeSetMean::new(mesh, &nodes).unwrap())
}

/// The consistent weights of flat faces, known in closed form for the four kinds of faces.
#[test]
fn nodes_of_flat_faces_have_their_consistent_weights() {
    let mut kinds = BTreeMap::new();
    for own in ELEMENTS {
        let (name, place) = (own.origin.name, |x: [f64; 3]| x);
        let mesh = cell(name, place);
        let sides = [
            ([0.0, 0.0, 1.0], [-1.0, 0.0]),
            ([1.0, 0.0, 0.0], [-1.0, 0.0]),
            ([0.0, 1.0, 0.0], [-1.0, 0.0]),
        ];
        for (normal, places) in sides {
            for at in places {
                let Some(mean) = plane(&mesh, normal, at) else { continue };
                let Some(area) = mean.area() else { continue };
                let weight = |node: usize| {
                    let place = mean.nodes().iter().position(|&known| known == node);
                    place.map_or(0.0, |place| mean.weights()[place])
                };
                let members: Vec<usize> = (0..own.nodes)
                    .filter(|&node| {
                        let x = own.reference_nodes[node];
                        (normal.iter().zip(x).map(|(n, x)| n * x).sum::<f64>() - at).abs() < 1e-12
                    })
                    .collect();
                let corner = |node: usize| {
                    let x = own.reference_nodes[node];
                    x.iter().all(|x| [-1.0, 0.0, 1.0].contains(x))
                        && (members.len() != 8 || x.iter().all(|x| x.abs() == 1.0))
                        && (members.len() != 6 || x.iter().all(|x| x.fract() == 0.0))
                };
                let (at_corner, between, exact) = match members.len() {
                    3 => (1.0 / 3.0, f64::NAN, 0.5),
                    4 => (0.25, f64::NAN, 4.0),
                    6 => (0.0, 1.0 / 3.0, 0.5),
                    8 => (-1.0 / 12.0, 1.0 / 3.0, 4.0),
                    // A side of a wedge has the length 1 in its triangle.
                    other => panic!("{name} has a face of {other} nodes"),
                };
                let exact = match (name, members.len()) {
                    ("wedge6" | "wedge15", 4 | 8) => 2.0,
                    _ => exact,
                };
                assert!((area - exact).abs() < 1e-14, "{name}: {area}");
                for &node in &members {
                    let x = own.reference_nodes[node];
                    let on_edge = own.origin.name == "wedge15" && members.len() == 8;
                    // Middles of a wedge's sides: halfway in the triangle, or halfway up.
                    let middle = match on_edge {
                        true => x[2] == 0.0 || x[0] == 0.5 || x[1] == 0.5,
                        false => !corner(node),
                    };
                    let want = if middle { between } else { at_corner };
                    assert!((weight(node) - want).abs() < 1e-14, "{name} {x:?}: {}", weight(node));
                }
                *kinds.entry(members.len()).or_insert(0) += 1;
            }
        }
    }
    assert_eq!(kinds.keys().copied().collect::<Vec<_>>(), [3, 4, 6, 8], "{kinds:?}");
}

/// Σ w x = ∫x dA / A on a trapezium, whose area and centroid are known.
#[test]
fn the_centre_is_the_centroid_of_the_faces() {
    for name in ["hex8", "hex20"] {
        // The face ζ = 1 becomes a trapezium: width 2 at y = −1, 1 at y = 1.
        let mesh = cell(name, |[x, y, z]| [x * (0.75 - 0.25 * y), y, z]);
        let mean = plane(&mesh, [0.0, 0.0, 1.0], 1.0).unwrap();
        let (a, b, height) = (2.0, 1.0, 2.0);
        assert!((mean.area().unwrap() - 0.5 * (a + b) * height).abs() < 1e-13, "{name}");
        let centroid = -1.0 + height * (a + 2.0 * b) / (3.0 * (a + b));
        near(&mean.centre(), &[0.0, centroid, 1.0], 1e-13);
    }
}

/// A face shared by two cells counts once, and a set that has no whole face has equal weights.
#[test]
fn sections_count_once_and_lines_have_equal_weights() {
    let mesh = beam([2, 2, 4], [0.1, 0.2, 1.0]);
    let section: Vec<usize> = (18..27).collect();
    let mean = NodeSetMean::new(&mesh, &section).unwrap();
    assert!((mean.area().unwrap() - 0.02).abs() < 1e-15);
    assert_eq!(mean.weights().len(), 9);
    assert!((mean.weights()[4] - 0.25).abs() < 1e-14 && (mean.weights()[0] - 0.0625).abs() < 1e-14);
    // Beside the section a loose node weighs nothing.
    let more = NodeSetMean::new(&mesh, &[&section[..], &[40]].concat()).unwrap();
    assert_eq!(more, mean);
    let line = NodeSetMean::new(&mesh, &[4, 13, 40]).unwrap();
    assert_eq!((line.area(), line.weights()), (None, &[1.0 / 3.0; 3][..]));
    assert_eq!([0, 1, 2].map(|axis| line.turns_about(axis)), [true, true, false]);
    assert_eq!(line.row(MeanComponent::Rotation(2)), []);
    let one = NodeSetMean::new(&mesh, &[7]).unwrap();
    assert_eq!(one.row(MeanComponent::Displacement(1)), [(22, 1.0)]);
    assert!(!one.turns_about(0));
    assert!(NodeSetMean::new(&mesh, &[]).is_err() && NodeSetMean::new(&mesh, &[45]).is_err());
}

#[test]
fn a_rigid_motion_is_its_own_mean() {
    let mesh = beam([2, 3, 4], [0.1, 0.2, 1.0]);
    let (shift, turn) = ([1.0, -2.0, 0.5], [0.3, 0.7, -1.1]);
    let u = rigid(mesh.nodes(), shift, turn);
    let tip = mesh.node_set("TIP").unwrap();
    let line: Vec<usize> =
        tip.iter().copied().filter(|&node| mesh.nodes()[node][0] == 0.0).collect();
    for (nodes, axes) in
        [(tip.to_vec(), &[0, 1, 2][..]), (vec![0, 17, 58], &[0, 1, 2]), (line, &[0, 2])]
    {
        let mean = NodeSetMean::new(&mesh, &nodes).unwrap();
        let expected = rigid(&[mean.centre()], shift, turn);
        let found = [0, 1, 2].map(|axis| applied(&mean.row(MeanComponent::Displacement(axis)), &u));
        near(&found, &expected, 1e-14);
        for &axis in axes {
            let found = applied(&mean.row(MeanComponent::Rotation(axis)), &u);
            assert!((found - turn[axis]).abs() < 1e-12, "{axis}: {found}");
        }
    }
}

/// Of a motion that is not rigid the mean is what makes Σ w |u − d − ω × r|² least: no other is better.
#[test]
fn no_other_rigid_motion_fits_better() {
    let mesh = beam([2, 3, 4], [0.1, 0.2, 1.0]);
    let mean = NodeSetMean::new(&mesh, mesh.node_set("TIP").unwrap()).unwrap();
    let u: Vec<f64> = (0..mesh.dof_count()).map(|i| ((i * i * 7) % 23) as f64 - 11.0).collect();
    let fit = MeanComponent::ALL.map(|motion| applied(&mean.row(motion), &u));
    let centre = mean.centre();
    let arms: Vec<[f64; 3]> =
        (mesh.nodes().iter()).map(|x| [0, 1, 2].map(|axis| x[axis] - centre[axis])).collect();
    let misfit = |[a, b, c, d, e, f]: [f64; 6]| -> f64 {
        let other = rigid(&arms, [a, b, c], [d, e, f]);
        let nodes = mean.nodes().iter().zip(mean.weights());
        nodes
            .map(|(&n, w)| {
                w * (0..3).map(|i| (u[3 * n + i] - other[3 * n + i]).powi(2)).sum::<f64>()
            })
            .sum()
    };
    let least = misfit(fit);
    for k in 0..6 {
        for step in [-1e-2, 1e-2] {
            let mut other = fit;
            other[k] += step;
            assert!(misfit(other) > least, "{k}");
        }
    }
}
