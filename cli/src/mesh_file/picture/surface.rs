//! The surface of a mesh as plane polygons, with the sets to which its faces belong.

use std::collections::HashSet;

use whirl_solver::mesh::{Cell, Mesh, Selection};

use crate::mesh_file::named;
use crate::outside::{corners, outer_places};

/// A face of one cell only.
pub(super) struct OuterFace {
    /// Its corners (m), anticlockwise as seen from outside.
    pub(super) corners: Vec<[f64; 3]>,
    /// All of its nodes.
    nodes: Vec<usize>,
    cell: Cell,
    /// The set by which it is coloured, as a place among the sets that are shown.
    pub(super) set: Option<usize>,
}

/// A set that is shown.
pub(super) struct ShownSet {
    pub(super) name: String,
    /// Such as `124 nodes`.
    pub(super) count: String,
    /// Positions of the nodes of a set that has no face (m).
    pub(super) points: Vec<[f64; 3]>,
}

/// The faces that only one cell has.
pub(super) fn outer_faces(mesh: &Mesh) -> Vec<OuterFace> {
    let face = |(cell, face): (Cell, usize)| {
        let block = &mesh.blocks()[cell.block];
        let nodes = &block.connectivity[cell.cell * block.element.nodes..];
        let at = |place: usize| mesh.nodes()[nodes[place]];
        let own = &block.element.faces[face];
        OuterFace {
            corners: corners(block.element, own).into_iter().map(at).collect(),
            nodes: own.nodes.iter().map(|&place| nodes[place]).collect(),
            cell,
            set: None,
        }
    };
    outer_places(mesh).map(face).collect()
}

/// Gives faces the sets by which they are coloured: node sets of the mesh and its element sets, and without any the cylinders
/// about its axis. A face in several sets has the smallest one. The sets that there are, those with faces first.
pub(super) fn colour(mesh: &Mesh, faces: &mut [OuterFace]) -> Vec<ShownSet> {
    let mut found: Vec<(ShownSet, Vec<usize>)> = Vec::new();
    let mut add = |faces: &[OuterFace], name: &str, nodes: &[usize]| {
        let inside: HashSet<usize> = nodes.iter().copied().collect();
        let own = |face: &OuterFace| face.nodes.iter().all(|node| inside.contains(node));
        let own: Vec<usize> = (0..faces.len()).filter(|&place| own(&faces[place])).collect();
        let at = |&node: &usize| mesh.nodes()[node];
        let points = if own.is_empty() { nodes.iter().map(at).collect() } else { Vec::new() };
        let count = counted(nodes.len(), "node");
        found.push((ShownSet { name: name.to_owned(), count, points }, own));
    };
    mesh.node_sets().iter().for_each(|(name, nodes)| add(faces, name, nodes));
    if mesh.node_sets().is_empty() && mesh.element_sets().is_empty() {
        let centre = mesh.round_axis().unwrap_or_default();
        let cylinders = mesh.cylinders(centre);
        for (name, own) in named(&cylinders) {
            let (radius, z) = (own.radius, own.z);
            // As a case chooses them.
            let within = 0.01 * radius;
            add(faces, &name, &mesh.selected(&Selection::Cylinder { centre, radius, within, z }));
        }
    }
    for (name, cells) in mesh.element_sets() {
        // A set of all cells shows nothing.
        if cells.len() == mesh.cell_count() {
            continue;
        }
        let inside: HashSet<(usize, usize)> = cells.iter().map(|c| (c.block, c.cell)).collect();
        let own = |face: &OuterFace| inside.contains(&(face.cell.block, face.cell.cell));
        let own = (0..faces.len()).filter(|&place| own(&faces[place])).collect();
        let count = counted(cells.len(), "cell");
        found.push((ShownSet { name: name.clone(), count, points: Vec::new() }, own));
    }
    found.sort_by_key(|(_, own)| own.is_empty());
    let mut by_size: Vec<usize> = (0..found.len()).collect();
    by_size.sort_by_key(|&set| std::cmp::Reverse(found[set].1.len()));
    for set in by_size {
        found[set].1.iter().for_each(|&face| faces[face].set = Some(set));
    }
    found.into_iter().map(|(shown, _)| shown).collect()
}

fn counted(count: usize, what: &str) -> String {
    format!("{count} {what}{}", if count == 1 { "" } else { "s" })
}
