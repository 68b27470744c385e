//! What a file of Gmsh holds, alike for its versions.

use std::collections::{BTreeMap, HashMap};

use super::super::raw::{LinePosition, MeshReport, NodeTable};
use super::cursor::{Cursor, DAMAGED, Stop};
use super::kinds::{Kind, kind};

/// Elements of one type that stand one after the other and belong to the same groups.
pub(super) struct Run {
    pub(super) kind: Kind,
    /// The geometric entity that they mesh.
    pub(super) entity: i64,
    /// Tags of their physical groups.
    pub(super) groups: Vec<i64>,
    pub(super) labels: Vec<u64>,
    pub(super) places: Vec<LinePosition>,
    /// Labels of the nodes, in Gmsh's order.
    pub(super) nodes: Vec<u64>,
}

impl Run {
    pub(super) fn new(kind: Kind, entity: i64, groups: Vec<i64>) -> Run {
        let (labels, places, nodes) = (Vec::new(), Vec::new(), Vec::new());
        Run { kind, entity, groups, labels, places, nodes }
    }
}

/// All of it.
pub(super) struct Contents {
    pub(super) nodes: NodeTable,
    pub(super) runs: Vec<Run>,
    /// Names of physical groups by dimension and tag.
    pub(super) names: BTreeMap<(usize, i64), String>,
    /// Physical groups of geometric entities by dimension and tag.
    pub(super) groups_of: HashMap<(usize, i64), Vec<i64>>,
}

impl Contents {
    pub(super) fn new() -> Contents {
        let (nodes, runs) = (NodeTable::new(), Vec::new());
        Contents { nodes, runs, names: BTreeMap::new(), groups_of: HashMap::new() }
    }

    /// Adds a node; one whose label is taken is an error.
    pub(super) fn node(
        &mut self,
        label: u64,
        position: [f64; 3],
        place: LinePosition,
        report: &mut MeshReport,
    ) {
        if self.nodes.named.add(label, place, report).is_some() {
            self.nodes.positions.push(position);
        }
    }

    /// `$PhysicalNames`, which is text in all files.
    pub(super) fn physical_names(&mut self, cursor: &mut Cursor) -> Result<(), Stop> {
        let count = cursor.written("the number of names")?;
        cursor.promised = format!("{count} names");
        for _ in 0..count {
            let dimension =
                dimension(cursor.written("the dimension of a physical group")?, cursor)?;
            let tag = cursor.written("the tag of a physical group")?;
            let name = cursor.quoted()?;
            self.names.insert((dimension, tag.abs()), name);
        }
        cursor.end()
    }
}

/// 0 to 3.
pub(super) fn dimension(value: i64, cursor: &Cursor) -> Result<usize, Stop> {
    usize::try_from(value).ok().filter(|dimension| *dimension <= 3).ok_or_else(|| {
        let help = DAMAGED;
        cursor.stop(format!("the dimension {value} is none from 0 to 3"), help)
    })
}

/// An element type by its number.
pub(super) fn element_type(number: i64, cursor: &Cursor) -> Result<Kind, Stop> {
    kind(number).ok_or_else(|| {
        let help = "mesh with points, lines, triangles, quadrangles, tetrahedra, hexahedra, wedges and pyramids \
                    of order 1 or 2 (`Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1`); or is the file of \
                    another version than its header says?";
        cursor.stop(format!("element type {number} of Gmsh is not known"), help)
    })
}

/// A label of a node or an element: from 1.
pub(super) fn label(value: u64, of: &str, cursor: &Cursor) -> Result<u64, Stop> {
    match value {
        0 => Err(cursor.stop(
            format!("{of} is 0"),
            "labels are whole numbers from 1: is the file of another version than its header says?",
        )),
        _ => Ok(value),
    }
}
