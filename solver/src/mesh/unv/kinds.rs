//! Elements of universal files by their descriptors.

use whirl_specs::Element;

/// What a descriptor stands for.
pub(super) enum Kind {
    /// Points, lines and faces, of which only the nodes count: 0 to 2.
    Flat(usize),
    /// Cells: the type that Gmsh has for them, and the node of the element at every place of the file.
    Solid(u8, &'static [usize]),
    /// Cells that no element stands for, in words.
    Other(&'static str),
}

const TET4: &[usize] = &[0, 1, 2, 3];
const WEDGE6: &[usize] = &[0, 1, 2, 3, 4, 5];
const HEX8: &[usize] = &[0, 1, 2, 3, 4, 5, 6, 7];
// Quadratic cells list corners and middles of the edges below, then the middles between, then those above.
const TET10: &[usize] = &[0, 4, 1, 5, 2, 6, 7, 8, 9, 3];
const WEDGE15: &[usize] = &[0, 6, 1, 7, 2, 8, 12, 13, 14, 3, 9, 4, 10, 5, 11];
const HEX20: &[usize] = &[0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15];

/// The kind of a descriptor.
pub(super) fn kind(descriptor: u64) -> Kind {
    match descriptor {
        111 => Kind::Solid(4, TET4),
        112 => Kind::Solid(6, WEDGE6),
        115 => Kind::Solid(5, HEX8),
        113 => Kind::Solid(18, WEDGE15),
        116 => Kind::Solid(17, HEX20),
        118 => Kind::Solid(11, TET10),
        114 => Kind::Other("cubic wedges"),
        117 => Kind::Other("cubic hexahedra"),
        101..=110 | 119 => Kind::Other("thick shells and cells of another order"),
        11..=40 | 121 | 122 => Kind::Flat(1),
        41..=99 => Kind::Flat(2),
        300..=399 => Kind::Other("cells of a program of its own"),
        _ => Kind::Flat(0),
    }
}

/// Whether a line with an orientation stands before the nodes of such an element.
pub(super) fn has_orientation(descriptor: u64) -> bool {
    matches!(descriptor, 11 | 21..=24 | 31 | 32)
}

/// The element that cells of a type of Gmsh are read as.
pub(super) fn element(kind: u8, elements: &[&'static Element]) -> Option<&'static Element> {
    let same = |own: &&&Element| own.gmsh.is_some_and(|(known, _)| known == kind);
    elements.iter().find(same).copied()
}
