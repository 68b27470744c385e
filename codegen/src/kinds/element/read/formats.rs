//! An element's names and node orders in files of meshes.

use num_traits::ToPrimitive;

use super::reader::Reader;
use crate::diagnostic::{Code, Located};
use crate::document::{Table, Value};

/// A program that numbers its types of cells.
pub(super) struct Numbered {
    /// What it calls the number, with its article.
    called: &'static str,
    /// Nodes of its solid cells.
    nodes: fn(u8) -> Option<usize>,
}

pub(super) const VTK: Numbered = Numbered { called: "a VTK cell type", nodes: vtk_nodes };
pub(super) const GMSH: Numbered = Numbered { called: "a Gmsh element type", nodes: gmsh_nodes };

impl Reader<'_> {
    pub(super) fn abaqus(
        &self,
        table: Table<'_>,
        nodes: Option<usize>,
    ) -> Option<(Vec<Located>, Vec<usize>)> {
        let types = table
            .items("types")
            .and_then(|items| self.texts(&items, "an element type such as \"C3D8\""));
        for name in types.iter().flatten() {
            let wanted = abaqus_nodes(name.text());
            self.has_nodes(nodes, wanted, name, &format!("{} of Abaqus", name.text()));
        }
        let order = self.order(&table, nodes);
        table.finish();
        Some((types?, order?))
    }

    /// Notes an element of another number of nodes than the cells that it is to stand for, where that is known.
    fn has_nodes(&self, nodes: Option<usize>, wanted: Option<usize>, at: &Located, called: &str) {
        let (Some(nodes), Some(wanted)) = (nodes, wanted) else { return };
        if nodes != wanted {
            let message = format!("{called} has {wanted} nodes, this element has {nodes}");
            let help = "name a type of as many nodes, or correct the list of nodes";
            self.document.push(at.error_here(Code::BAD_VALUE, message).help(help));
        }
    }

    pub(super) fn nastran(
        &self,
        table: Table<'_>,
        nodes: Option<usize>,
    ) -> Option<(Located, Vec<usize>)> {
        let card = table.string("card");
        if let Some(card) = &card {
            let known = nastran_nodes(card.text());
            if let (Some(nodes), Some(known)) = (nodes, known)
                && !known.contains(&nodes)
            {
                let [few, many] = known;
                let card_name = card.text();
                let message = format!(
                    "{card_name} of Nastran has {few} or {many} nodes, this element has {nodes}"
                );
                let help = "name a card of as many nodes, or correct the list of nodes";
                self.document.push(card.error_here(Code::BAD_VALUE, message).help(help));
            }
        }
        let order = self.order(&table, nodes);
        table.finish();
        Some((card?, order?))
    }

    pub(super) fn numbered(
        &self,
        table: Table<'_>,
        nodes: Option<usize>,
        format: &Numbered,
    ) -> Option<(u8, Vec<usize>)> {
        let called = format.called;
        let kind = table.count("type").and_then(|kind| {
            let small = kind.to_u8();
            if small.is_none() {
                let span = table.place("type");
                self.error(Code::BAD_VALUE, span, format!("{called} is below 256"));
            }
            small
        });
        if let Some(kind) = kind {
            let (span, written) = (table.place("type"), kind.to_string());
            let at = Located::new(table.source(), span, written);
            let called = format!("the {} {kind}", called.trim_start_matches("a "));
            self.has_nodes(nodes, (format.nodes)(kind), &at, &called);
        }
        let order = self.order(&table, nodes);
        table.finish();
        Some((kind?, order?))
    }

    /// A permutation of the nodes, from 1 in the file and from 0 here; the identity if there is none.
    /// `nodes`: their number, if they are right.
    fn order(&self, table: &Table<'_>, nodes: Option<usize>) -> Option<Vec<usize>> {
        let given = table.has("order");
        let nodes = nodes?;
        if !given {
            return Some((0..nodes).collect());
        }
        let items = table.optional_items("order")?;
        let mut order = Vec::with_capacity(nodes);
        for item in &items {
            match item.value() {
                Value::Number(number, _) if number.is_integer() => {
                    order.extend(number.to_usize().and_then(|place| place.checked_sub(1)));
                }
                _ => {}
            }
        }
        let mut sorted = order.clone();
        sorted.sort_unstable();
        if items.len() == nodes && sorted.into_iter().eq(0..nodes) {
            return Some(order);
        }
        let span = table.place("order");
        let message = format!("`order` must name every node from 1 to {nodes} once");
        self.error(Code::BAD_VALUE, span, message);
        None
    }
}

/// Nodes of a continuum element by its name, such as 8 of `C3D8I`.
fn abaqus_nodes(name: &str) -> Option<usize> {
    let number = name.to_ascii_uppercase();
    let number = number.strip_prefix("C3D")?;
    let digits = number.find(|c: char| !c.is_ascii_digit()).unwrap_or(number.len());
    number[..digits].parse().ok()
}

/// Nodes of Nastran's solid elements, without and with nodes on their edges.
fn nastran_nodes(card: &str) -> Option<[usize; 2]> {
    match card.to_ascii_uppercase().as_str() {
        "CTETRA" => Some([4, 10]),
        "CPYRAM" => Some([5, 13]),
        "CPENTA" => Some([6, 15]),
        "CHEXA" => Some([8, 20]),
        _ => None,
    }
}

/// Nodes of VTK's solid cells (vtkCellType.h).
fn vtk_nodes(kind: u8) -> Option<usize> {
    match kind {
        10 => Some(4),
        11 | 12 => Some(8),
        13 => Some(6),
        14 => Some(5),
        24 => Some(10),
        25 => Some(20),
        26 => Some(15),
        27 => Some(13),
        29 => Some(27),
        32 => Some(18),
        33 => Some(24),
        37 => Some(19),
        _ => None,
    }
}

/// Nodes of Gmsh's solid elements (GmshDefines.h).
fn gmsh_nodes(kind: u8) -> Option<usize> {
    match kind {
        4 => Some(4),
        5 => Some(8),
        6 => Some(6),
        7 => Some(5),
        11 => Some(10),
        12 => Some(27),
        13 => Some(18),
        14 => Some(14),
        17 | 29 => Some(20),
        18 => Some(15),
        19 => Some(13),
        _ => None,
    }
}
