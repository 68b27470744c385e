//! Quadratic cells with nodes in the middles of their faces, which are read in no format.

/// What to do with a file that has them.
pub(crate) const FACE_MIDDLES: &str = "cells with nodes in the middles of their faces are not read, hexahedra of 27 nodes and wedges of 18: export those of 20 and \
     15 nodes. In Gmsh set `Mesh.SecondOrderIncomplete = 1` before meshing; of a mesh that there is, make them by a script: \
     `Merge \"mesh.msh\"; Mesh.SecondOrderIncomplete = 1; SetOrder 1; SetOrder 2; Save \"new.msh\";`";

/// Whether cells with so many nodes are such.
pub(crate) fn has_face_middles(nodes: usize) -> bool {
    matches!(nodes, 18 | 27)
}
