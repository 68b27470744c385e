//! Surfaces: shape functions at any point, springs on the faces of a bore, sets by where they are.

use std::f64::consts::{PI, TAU};

use whirl_solver::mesh::{Cylinder, Mesh, Selection, Surface};
use whirl_specs::{ELEMENTS, Element};

use super::{mesh, near};
use crate::elements::block;

pub(super) const INNER: f64 = 0.02;
pub(super) const OUTER: f64 = 0.03;
pub(super) const LENGTH: f64 = 0.04;

/// A ring of cells about (0.1, −0.2), open at angle 0 in its mesh but not in its shape.
pub(super) fn ring(element: &'static Element, counts: [usize; 3]) -> Mesh {
    bent_ring(element, counts, |[_, _, z]| z)
}

/// As [`ring`], with the part of the length at which nodes are.
pub(super) fn bent_ring(
    element: &'static Element,
    counts: [usize; 3],
    along: impl Fn([f64; 3]) -> f64,
) -> Mesh {
    let bent = |[x, y, z]: [f64; 3]| {
        let (radius, angle) = (INNER + (OUTER - INNER) * x, TAU * y);
        [0.1 + radius * angle.cos(), -0.2 + radius * angle.sin(), LENGTH * along([x, y, z])]
    };
    let block = block(element, [1.0; 3], counts, bent);
    mesh(element.origin.name, block.nodes, block.cells.concat(), Default::default())
}

fn bore() -> Selection {
    Selection::Cylinder {
        centre: [0.1, -0.2],
        radius: INNER,
        within: 1e-9,
        z: [f64::NEG_INFINITY, f64::INFINITY],
    }
}

#[test]
fn shape_functions_are_one_at_their_node_and_agree_with_the_faces() {
    for element in ELEMENTS.iter() {
        let count = element.nodes;
        let (mut values, mut slopes) = (vec![0.0; count], vec![[0.0; 3]; count]);
        let name = element.origin.name;
        for (a, &node) in element.reference_nodes.iter().enumerate() {
            // At the apex of a pyramid functions are limits.
            let at = if name.starts_with("pyramid") && node[2] == 1.0 { continue } else { node };
            (element.shape)(at, &mut values, &mut slopes);
            for (b, value) in values.iter().enumerate() {
                assert!((value - f64::from(u8::from(a == b))).abs() < 1e-14, "{name} {a} {b}");
            }
        }
        // At points within faces: partitions of unity, and slopes by differences of second order.
        for face in element.faces {
            let inside = |s: f64, t: f64| {
                [0, 1, 2].map(|k| face.origin[k] + s * face.along[0][k] + t * face.along[1][k])
            };
            let at = if face.corners == 3 { inside(0.3, 0.2) } else { inside(0.3, -0.4) };
            (element.shape)(at, &mut values, &mut slopes);
            assert!((values.iter().sum::<f64>() - 1.0).abs() < 1e-13, "{name}");
            let on_face: f64 = face.nodes.iter().map(|&node| values[node].abs()).sum();
            let all: f64 = values.iter().map(|value| value.abs()).sum();
            assert!((on_face - all).abs() < 1e-12, "{name}: only nodes of a face move it");
            let exact = slopes.clone();
            for axis in 0..3 {
                let step = 1e-5;
                let mut both = [vec![0.0; count], vec![0.0; count]];
                for (values, sign) in both.iter_mut().zip([-1.0, 1.0]) {
                    let mut moved = at;
                    moved[axis] += sign * step;
                    (element.shape)(moved, values, &mut slopes);
                }
                for a in 0..count {
                    let found = (both[1][a] - both[0][a]) / (2.0 * step);
                    assert!((found - exact[a][axis]).abs() < 1e-8, "{name} {a} {axis}");
                }
            }
        }
    }
}

#[test]
fn springs_on_faces_stand_where_they_should_with_forces_and_moments_exact() {
    for element in ELEMENTS.iter() {
        let ring = ring(element, [1, 12, 2]);
        let nodes = ring.selected(&bore());
        let surface = Surface::new(&ring, &nodes, [0.1, -0.2]);
        near(&surface.ends(), &[0.0, LENGTH], 1e-12);
        for k in 0..37 {
            // At no particular angle and z, at nodes, and at both ends.
            let angle = TAU * f64::from(k) / 36.0 - 0.4 * f64::from(k % 3);
            for z in [0.0, 0.0031, 0.5 * LENGTH, 0.0333, LENGTH] {
                let point = surface.at(angle, z);
                let point = point.unwrap_or_else(|| panic!("{} {angle} {z}", element.origin.name));
                let (mut sum, mut at) = (0.0, [0.0; 3]);
                for &(node, weight) in &point {
                    sum += weight;
                    for (sum, x) in at.iter_mut().zip(ring.nodes()[node]) {
                        *sum += weight * x;
                    }
                }
                // A force there has the same resultant and moment on the nodes.
                assert!((sum - 1.0).abs() < 1e-12);
                let (x, y) = (at[0] - 0.1, at[1] + 0.2);
                let radius = x.hypot(y);
                let across = (y * angle.cos() - x * angle.sin()).abs();
                assert!(across < 1e-12 && (at[2] - z).abs() < 1e-12, "{}", element.origin.name);
                // Straight edges of a polygon of twelve, or quadratic ones.
                let sagitta = INNER * (1.0 - (PI / 12.0).cos());
                let flat = if element.nodes > 8 { 0.02 * sagitta } else { 1.001 * sagitta };
                assert!((INNER - radius).abs() < flat, "{}: {radius}", element.origin.name);
            }
        }
        assert!(surface.at(0.0, -0.001).is_none() && surface.at(0.0, LENGTH + 0.001).is_none());
    }
}

#[test]
fn cylinders_and_sets_are_found_where_they_are() {
    for element in ELEMENTS.iter() {
        let ring = ring(element, [1, 16, 2]);
        let on = |node: usize, radius: f64| {
            let [x, y, _] = ring.nodes()[node];
            ((x - 0.1).hypot(y + 0.2) - radius).abs() < 1e-12
        };
        let nodes = ring.selected(&bore());
        // Nodes of the seam stand twice.
        let count = (0..ring.nodes().len()).filter(|&node| on(node, INNER)).count();
        assert!(nodes.len() == count && nodes.iter().all(|&node| on(node, INNER)));
        let half = Selection::Cylinder {
            centre: [0.1, -0.2],
            radius: OUTER,
            within: 1e-9,
            z: [0.5 * LENGTH, LENGTH],
        };
        let half = ring.selected(&half);
        assert!(half.iter().all(|&node| on(node, OUTER) && ring.nodes()[node][2] > 0.49 * LENGTH));
        let end = ring.selected(&Selection::Plane { across: 2, at: LENGTH, within: 1e-9 });
        let at_end = (0..ring.nodes().len()).filter(|&node| ring.nodes()[node][2] == LENGTH);
        assert_eq!(end, at_end.collect::<Vec<_>>(), "{}", element.origin.name);
        // Across x the ring has no flat side.
        let side = Selection::Plane { across: 0, at: 0.1 + OUTER, within: 1e-9 };
        assert!(ring.selected(&side).is_empty());
        // A section within is no surface.
        assert!(
            ring.selected(&Selection::Plane { across: 2, at: 0.5 * LENGTH, within: 1e-9 })
                .is_empty()
        );
        let at = ring.nodes()[7];
        assert!(ring.selected(&Selection::Point { at, within: 1e-9 }).contains(&7));
        let found = ring.cylinders([0.1, -0.2]);
        let [inside, outside] = found[..] else { panic!("{}: {found:?}", element.origin.name) };
        let Cylinder { radius, z, hollow } = inside;
        assert!(hollow && !outside.hollow);
        near(&[radius, z[0], z[1]], &[INNER, 0.0, LENGTH], 1e-9);
        near(&[outside.radius, outside.z[0], outside.z[1]], &[OUTER, 0.0, LENGTH], 1e-9);
    }
}

#[test]
fn a_plane_may_stand_across_any_axis() {
    let sides = [0.04, 0.06, 0.3];
    let mesh = super::beam([2, 3, 5], sides);
    for (across, side) in sides.into_iter().enumerate() {
        let low = if across == 2 { 0.0 } else { -0.5 * side };
        for at in [low, low + side] {
            let found = mesh.selected(&Selection::Plane { across, at, within: 1e-9 });
            let on = |node: &usize| (mesh.nodes()[*node][across] - at).abs() < 1e-9;
            let want: Vec<usize> = (0..mesh.nodes().len()).filter(on).collect();
            assert_eq!(found, want, "{across}");
        }
        let middle = low + 0.5 * side;
        assert!(mesh.selected(&Selection::Plane { across, at: middle, within: 1e-9 }).is_empty());
    }
}
