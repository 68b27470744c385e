//! Element types of Gmsh: how many nodes they have, and what they are called in words.

use whirl_specs::Element;

use super::super::raw::FACE_MIDDLES;

/// An element type.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Kind {
    /// Gmsh's number of it.
    pub(super) number: u8,
    /// 0 for points to 3 for solids.
    pub(super) dimension: usize,
    pub(super) nodes: usize,
    /// What it is, of solids.
    words: &'static str,
}

/// Types of points, lines and faces: number, dimension, nodes (GmshDefines.h).
const FLAT: [(u8, usize, usize); 26] = [
    (15, 0, 1),
    (1, 1, 2),
    (8, 1, 3),
    (26, 1, 4),
    (27, 1, 5),
    (28, 1, 6),
    (62, 1, 7),
    (63, 1, 8),
    (64, 1, 9),
    (65, 1, 10),
    (66, 1, 11),
    (2, 2, 3),
    (3, 2, 4),
    (9, 2, 6),
    (10, 2, 9),
    (16, 2, 8),
    (20, 2, 9),
    (21, 2, 10),
    (22, 2, 12),
    (23, 2, 15),
    (24, 2, 15),
    (25, 2, 21),
    (36, 2, 16),
    (37, 2, 25),
    (39, 2, 12),
    (40, 2, 16),
];

/// Types of solids: number, nodes, words.
const SOLID: [(u8, usize, &str); 20] = [
    (4, 4, "linear tetrahedra"),
    (5, 8, "linear hexahedra"),
    (6, 6, "linear wedges"),
    (7, 5, "linear pyramids"),
    (11, 10, "quadratic tetrahedra of 10 nodes"),
    (12, 27, "quadratic hexahedra of 27 nodes"),
    (13, 18, "quadratic wedges of 18 nodes"),
    (14, 14, "quadratic pyramids of 14 nodes"),
    (17, 20, "quadratic hexahedra of 20 nodes"),
    (18, 15, "quadratic wedges of 15 nodes"),
    (19, 13, "quadratic pyramids of 13 nodes"),
    (29, 20, "cubic tetrahedra"),
    (30, 35, "tetrahedra of order 4"),
    (31, 56, "tetrahedra of order 5"),
    (90, 40, "cubic wedges"),
    (91, 75, "wedges of order 4"),
    (92, 64, "cubic hexahedra"),
    (93, 125, "hexahedra of order 4"),
    (118, 30, "cubic pyramids"),
    (119, 55, "pyramids of order 4"),
];

/// The type of this number, if it is known how many nodes it has.
pub(super) fn kind(number: i64) -> Option<Kind> {
    let flat = FLAT.iter().find(|(known, _, _)| i64::from(*known) == number);
    let solid = SOLID.iter().find(|(known, _, _)| i64::from(*known) == number);
    let flat = flat.map(|&(number, dimension, nodes)| Kind { number, dimension, nodes, words: "" });
    flat.or_else(|| {
        solid.map(|&(number, nodes, words)| Kind { number, dimension: 3, nodes, words })
    })
}

impl Kind {
    /// The element that its cells are read as.
    pub(super) fn element(&self, elements: &[&'static Element]) -> Option<&'static Element> {
        let same = |element: &&&Element| element.gmsh.is_some_and(|(kind, _)| kind == self.number);
        elements.iter().find(same).copied()
    }

    /// What it is in words, and what to do instead, for a solid that no element stands for.
    pub(super) fn refusal(&self, elements: &[&'static Element]) -> (String, String) {
        let what = format!("{} are not read (element type {} of Gmsh)", self.words, self.number);
        let remedy = match self.number {
            12 | 13 => FACE_MIDDLES,
            7 | 14 | 19 | 118 | 119 => {
                "mesh without pyramids: tetrahedra alone, or hexahedra alone; linear ones \
                 (`Mesh.ElementOrder = 1`) are read if they are among the types below"
            }
            _ => {
                "set `Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1` in Gmsh before meshing"
            }
        };
        let read: Vec<String> = SOLID
            .iter()
            .filter(|(number, _, _)| {
                elements.iter().any(|element| element.gmsh.is_some_and(|(kind, _)| kind == *number))
            })
            .map(|(number, _, words)| format!("{words} ({number})"))
            .collect();
        (what, format!("{remedy}; read are {}", read.join(", ")))
    }
}
