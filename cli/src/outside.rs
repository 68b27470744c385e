//! The outside of a mesh: faces that only one cell has.

use whirl_solver::mesh::{Cell, Mesh};
use whirl_specs::{Element, Face};

/// The corners of the faces that only one cell has, as places of nodes, anticlockwise as seen from outside.
pub(crate) fn outer_corners(mesh: &Mesh) -> Vec<Vec<usize>> {
    let blocks = mesh.blocks();
    let of = |(cell, face): (Cell, usize)| {
        let block = &blocks[cell.block];
        let nodes = &block.connectivity[cell.cell * block.element.nodes..];
        let places = corners(block.element, &block.element.faces[face]);
        places.into_iter().map(|place| nodes[place]).collect()
    };
    outer_places(mesh).map(of).collect()
}

/// Cells and faces of them that no other cell has, in the order of the cells.
pub(crate) fn outer_places(mesh: &Mesh) -> impl Iterator<Item = (Cell, usize)> {
    let corners: Vec<Vec<Vec<usize>>> = mesh
        .blocks()
        .iter()
        .map(|own| own.element.faces.iter().map(|face| corners(own.element, face)).collect())
        .collect();
    let count =
        mesh.blocks().iter().zip(&corners).map(|(own, faces)| own.cells().len() * faces.len());
    let count = count.sum();
    let mut all: Vec<(Cell, usize)> = Vec::with_capacity(count);
    // The corners of a face name it: two cells that share them share the face.
    let mut names: Vec<(u128, usize)> = Vec::with_capacity(count);
    for (block, own) in mesh.blocks().iter().enumerate() {
        for (cell, nodes) in own.cells().enumerate() {
            for (face, places) in corners[block].iter().enumerate() {
                let mut own = [u32::MAX; 4];
                // Nodes that fit into memory are fewer.
                own.iter_mut().zip(places).for_each(|(own, &place)| *own = nodes[place] as u32);
                own.sort_unstable();
                let name = own.into_iter().fold(0, |name, own| name << 32 | u128::from(own));
                names.push((name, all.len()));
                all.push((Cell { block, cell }, face));
            }
        }
    }
    names.sort_unstable();
    let single = names.chunk_by(|a, b| a.0 == b.0).filter(|own| own.len() == 1);
    let mut outer: Vec<usize> = single.map(|own| own[0].1).collect();
    outer.sort_unstable();
    outer.into_iter().map(move |place| all[place])
}

/// The places of the corners of a face among the nodes of its element, around it.
pub(crate) fn corners(element: &Element, face: &Face) -> Vec<usize> {
    let around: &[[f64; 2]] = match face.corners {
        3 => &[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
        _ => &[[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]],
    };
    let at = |[s, t]: &[f64; 2]| {
        [0, 1, 2].map(|k| face.origin[k] + s * face.along[0][k] + t * face.along[1][k])
    };
    let nearest = |point: [f64; 3]| {
        let away = |place: usize| -> f64 {
            let node = element.reference_nodes[place];
            (0..3).map(|k| (node[k] - point[k]).powi(2)).sum()
        };
        face.nodes.iter().copied().min_by(|&a, &b| away(a).total_cmp(&away(b)))
    };
    around.iter().filter_map(|corner| nearest(at(corner))).collect()
}
