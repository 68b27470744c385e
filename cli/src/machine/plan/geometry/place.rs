//! Where sets stand, and how messages say it.

use whirl_codegen::diagnostic::Located;
use whirl_solver::mesh::Mesh;

/// Nodes of a set that is there and has some.
pub(in crate::machine) fn nodes_of<'a>(mesh: &'a Mesh, set: &Located) -> Option<&'a [usize]> {
    mesh.node_set(set.text()).ok().filter(|nodes| !nodes.is_empty())
}

/// The node of a set of one.
pub(super) fn single(mesh: &Mesh, set: &Located) -> Option<usize> {
    match nodes_of(mesh, set)? {
        [node] => Some(*node),
        _ => None,
    }
}

/// How far a coordinate may be off by its digits: meshes come from programs that keep single precision.
pub(super) fn digits(mesh: &Mesh) -> f64 {
    let extent = mesh.nodes().iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    f64::from(f32::EPSILON) * extent
}

/// Names as a list of a case.
pub(super) fn list<'a>(names: impl IntoIterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.into_iter().map(|name| format!("{name:?}")).collect();
    format!("[{}]", names.join(", "))
}
