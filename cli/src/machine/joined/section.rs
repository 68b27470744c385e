//! Sections of meshes: all nodes at a z, and the one of a turning mesh whose mean rotation is that of its frame, where
//! neither a drive nor the case names it. It follows from where nodes are, whatever their order and however the machine is
//! turned about its axis.

use whirl_codegen::diagnostic::{Code, Diagnostics, Located};
use whirl_solver::mesh::{MeanComponent, Mesh, NodeSetMean};

use crate::machine::plan::{BodyPlan, Turn};
use crate::machine::wording::mm;

/// The centre of a section is off the axis by at most this part of how far its nodes reach.
const CENTRED: f64 = 0.1;

/// Nodes stand in one section to this part of the body's length.
const FLAT: f64 = 1e-5;

/// A plane of nodes is at most this part of the body's length away from where a section is looked for; in a body without cells
/// at most so far.
const CLOSE: f64 = 1e-4;
const NEAR: f64 = 0.01;
/// The nodes at `z` (m).
pub(super) fn nodes_at(mesh: &Mesh, z: f64) -> Vec<usize> {
    let [first, last] = mesh.ends();
    let flat = |node: &usize| (mesh.nodes()[*node][2] - z).abs() <= FLAT * (last - first);
    (0..mesh.placed()).filter(flat).collect()
}

/// Ties a turning mesh to its frame by the mean rotation of the section of its `axial_restraint`; a body without such a
/// section, and one that turns freely, by that of the whole body.
pub(super) fn tie(
    plan: &mut BodyPlan,
    name: &Located,
    restraint: Option<&Located>,
    errors: &mut Diagnostics,
) {
    let restraint = restraint.filter(|_| !plan.mean_frame);
    if let Some((set, nodes)) = restraint.and_then(|set| Some((set, of_set(&plan.mesh, set)?))) {
        let (mean, component) = (plan.mean(&nodes), MeanComponent::Rotation(2));
        let terms = vec![(plan.retain_mean(set, mean, component), 1.0)];
        plan.frame = Some(format!(
            "the section of its `axial_restraint` {}, {} nodes at z = {}",
            set.text(),
            nodes.len(),
            mm(plan.spec.means[mean].centre()[2])
        ));
        plan.turns_with_frame(Turn { name: format!("torsion of {}", name.text()), terms });
        return;
    }
    let Some(nodes) = whole(&plan.mesh) else {
        let message = format!(
            "all nodes of {} are on one line along its axis: they define no rotation",
            plan.mesh.origin()
        );
        let help =
            "name a set of nodes around the axis, such as a journal: `section = \"JOURNAL\"`";
        errors.push(name.error_here(Code::BAD_VALUE, message).help(help));
        return;
    };
    plan.mean_frame = true;
    plan.frame = Some("the mean rotation of the whole body".to_owned());
    let mean = plan.mean(&nodes);
    let terms = vec![(plan.retain_mean(name, mean, MeanComponent::Rotation(2)), 1.0)];
    plan.turns_with_frame(Turn { name: format!("torsion of {}", name.text()), terms });
}

/// Nodes whose mean rotation is that of a body: all of a mesh; of matrices those that have displacements across the axis, or
/// else those that turn by dofs of their own.
fn whole(mesh: &Mesh) -> Option<Vec<usize>> {
    let all: Vec<usize> = (0..mesh.placed()).collect();
    let moves = |dof: usize| mesh.matrices().is_none_or(|own| own.has(dof));
    let across = |node: &&usize| moves(3 * **node) && moves(3 * **node + 1);
    let across: Vec<usize> = all.iter().filter(across).copied().collect();
    let turned =
        |node: &&usize| NodeSetMean::new(mesh, &[**node]).is_ok_and(|mean| mean.turns_about(2));
    let shows =
        |nodes: &Vec<usize>| NodeSetMean::new(mesh, nodes).is_ok_and(|mean| mean.turns_about(2));
    Some(across).filter(shows).or_else(|| {
        let turned: Vec<usize> = all.iter().filter(turned).copied().collect();
        Some(turned).filter(shows)
    })
}

/// The nodes of the section that a set stands for: its own, or of one node those at its z. None where these show no rotation
/// about the axis: they stand on it, on one side of it, or are fewer than three.
pub(super) fn of_set(mesh: &Mesh, set: &Located) -> Option<Vec<usize>> {
    let nodes = match mesh.node_set(set.text()).ok()? {
        [one] => nodes_at(mesh, mesh.nodes()[*one][2]),
        nodes => nodes.to_vec(),
    };
    let mean = NodeSetMean::new(mesh, &nodes).ok()?;
    let reach = |node: &usize| mesh.nodes()[*node][0].hypot(mesh.nodes()[*node][1]);
    let farthest = nodes.iter().map(reach).fold(0.0, f64::max);
    let [x, y, _] = mean.centre();
    let around = nodes.len() > 2 && x.hypot(y) <= CENTRED * farthest;
    (mean.turns_about(2) && (around || mean.has_turns())).then_some(nodes)
}

/// That there is no section, and what to do.
pub(super) struct NoSection {
    pub(super) message: String,
    pub(super) help: String,
}

/// The mean motion of the section nearest to `z` (m).
pub(super) fn section_at(plan: &mut BodyPlan, z: f64) -> Result<usize, NoSection> {
    let nodes = plan.mesh.nodes();
    let ends = plan.mesh.ends();
    let length = ends[1] - ends[0];
    let away = |node: &[f64; 3]| (node[2] - z).abs();
    let nearest = nodes.iter().min_by(|a, b| away(a).total_cmp(&away(b))).copied();
    let near = nearest.filter(|node| away(node) <= NEAR * length).map(|node| node[2]);
    section_near(plan, z, near).ok_or_else(|| NoSection {
        message: format!(
            "no section of {} is at z = {}; it has nodes from {} to {}",
            plan.mesh.origin(),
            mm(z),
            mm(ends[0]),
            mm(ends[1])
        ),
        help: match nearest {
            Some(node) => format!("the nearest nodes are at `z = \"{}\"`", mm(node[2])),
            None => "the mesh has no nodes".to_owned(),
        },
    })
}

/// The mean motion of the nodes at the z that is near, where they are a plane of nodes; else of the section of the cells at
/// `z` (m). None where there is no section.
fn section_near(plan: &mut BodyPlan, z: f64, near: Option<f64>) -> Option<usize> {
    /// Faces in a plane of nodes have this part of the section's area at least.
    const WHOLE: f64 = 0.98;
    let section = |z: f64| NodeSetMean::of_section(&plan.mesh, z).ok().flatten();
    let area = |own: &NodeSetMean| own.area().unwrap_or(0.0);
    let close = CLOSE * (plan.mesh.ends()[1] - plan.mesh.ends()[0]);
    let is_plane = |near: &f64| (near - z).abs() <= close || section(z).is_none();
    if let Some(near) = near.filter(is_plane) {
        let found = nodes_at(&plan.mesh, near);
        let [first, last] = plan.mesh.ends();
        let cut = section(near).or_else(|| section(near + NEAR * NEAR * (last - first)));
        let own = NodeSetMean::new(&plan.mesh, &found);
        // Matrices have no cells.
        if cut.is_none_or(|cut| own.is_ok_and(|own| area(&own) >= WHOLE * area(&cut))) {
            return Some(plan.mean(&found));
        }
    }
    let cut = section(z).or_else(|| section(near?))?;
    plan.spec.means.push(cut);
    Some(plan.spec.means.len() - 1)
}
