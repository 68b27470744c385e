//! Sections of meshes: all nodes at a z, and the one of a turning mesh whose mean rotation is that of its frame, where
//! neither a drive nor the case names it.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};

use whirl_solver::body::Retained;

use super::at;
use crate::machine::plan::{BodyPlan, Turn};
use whirl_solver::mesh::Mesh;

/// Nodes are opposite if one is the mirror image of the other to this part of their distance from the axis.
const OPPOSITE: f64 = 1e-3;

/// Nodes stand in one section to this part of the body's length.
const FLAT: f64 = 1e-5;

/// First and last z of a mesh (m).
pub(super) fn ends(mesh: &Mesh) -> [f64; 2] {
    mesh.nodes().iter().fold([f64::INFINITY, f64::NEG_INFINITY], |ends, node| {
        [ends[0].min(node[2]), ends[1].max(node[2])]
    })
}

/// The nodes at `z` (m).
pub(super) fn nodes_at(mesh: &Mesh, z: f64) -> Vec<usize> {
    let [first, last] = ends(mesh);
    let flat = |node: &usize| (mesh.nodes()[*node][2] - z).abs() <= FLAT * (last - first);
    (0..mesh.placed()).filter(flat).collect()
}

/// Ties two opposite nodes: they move alike along the tangent, at the z at which the body is held.
pub(super) fn tie(plan: &mut BodyPlan, name: &Located, errors: &mut Diagnostics) {
    let last = plan.spec.retained.iter().rev().find_map(Retained::single);
    let z = plan.mesh.nodes()[last.unwrap_or(0) / 3][2];
    let Some([top, bottom]) = opposite(&plan.mesh.nodes()[..plan.mesh.placed()], z) else {
        let message = format!(
            "{} has no two nodes at opposite ends of a diameter by which its rotation could be told",
            plan.mesh.origin()
        );
        let help = "name a set of nodes around the axis, such as a journal: `section = \"JOURNAL\"`; or two of one node each, \
                    opposite to each other";
        errors.push(name.error_here(Code::BAD_VALUE, message).help(help));
        return;
    };
    let [x, y, _] = plan.mesh.nodes()[top];
    let radius = x.hypot(y);
    let mut terms = Vec::new();
    for (node, sign) in [(top, 1.0), (bottom, -1.0)] {
        let label = at(name, format!("node {}", plan.mesh.labels()[node]));
        for (axis, part) in [(0, -y / radius), (1, x / radius)] {
            if part.abs() > OPPOSITE {
                terms.push((plan.retain(&label, node, axis), sign * part));
            }
        }
    }
    terms.sort_by(|(_, a), (_, b)| b.abs().total_cmp(&a.abs()));
    plan.turns_with_frame(Turn { name: format!("torsion of {}", name.text()), terms });
}

/// Two opposite nodes, far from the axis, in the plane nearest to `z` that has some; along x if there are such.
fn opposite(nodes: &[[f64; 3]], z: f64) -> Option<[usize; 2]> {
    let farthest = nodes.iter().map(|[x, y, _]| x.hypot(*y)).fold(0.0, f64::max);
    let mut order: Vec<usize> = (0..nodes.len())
        .filter(|&node| {
            nodes[node][0] > 0.0 && nodes[node][0].hypot(nodes[node][1]) > 0.1 * farthest
        })
        .collect();
    // Nearest plane first, then along x, then far out; z to a thousandth of the radius, as planes are only flat to
    // the digits of meshes.
    let plane = |node: usize| ((nodes[node][2] - z).abs() / (OPPOSITE * farthest)).round();
    let slant = |node: usize| (nodes[node][1] / nodes[node][0]).abs();
    let radius = |node: usize| nodes[node][0].hypot(nodes[node][1]);
    order.sort_by(|&a, &b| {
        plane(a)
            .total_cmp(&plane(b))
            .then((slant(a) > OPPOSITE).cmp(&(slant(b) > OPPOSITE)))
            .then(radius(b).total_cmp(&radius(a)))
            .then(a.cmp(&b))
    });
    // A mesh without opposite nodes near the plane has none elsewhere, most likely.
    const TRIED: usize = 200;
    order.iter().take(TRIED).find_map(|&top| {
        let [x, y, z] = nodes[top];
        let allowed = OPPOSITE * radius(top);
        let near = |other: &[f64; 3]| {
            (other[0] + x).abs() <= allowed
                && (other[1] + y).abs() <= allowed
                && (other[2] - z).abs() <= allowed
        };
        Some([top, nodes.iter().position(near)?])
    })
}

#[cfg(test)]
mod tests {
    use super::opposite;

    #[test]
    fn opposite_nodes_stand_along_x_in_the_nearest_plane() {
        let nodes = [
            [0.0, 0.0, 0.1],
            [0.02, 0.02, 0.1],
            [-0.02, -0.02, 0.1],
            [0.03, 0.0, 0.1],
            [-0.03, 0.0, 0.1],
            [0.03, 0.0, 0.5],
            [-0.03, 0.0, 0.5],
        ];
        assert_eq!(opposite(&nodes, 0.12), Some([3, 4]));
        assert_eq!(opposite(&nodes, 0.5), Some([5, 6]));
        assert_eq!(opposite(&nodes[..3], 0.5), Some([1, 2]));
        assert_eq!(opposite(&nodes[..2], 0.5), None);
        assert_eq!(opposite(&[], 0.5), None);
    }
}
