//! An element's names and node orders in files of meshes.

use num_traits::ToPrimitive;

use super::Reader;
use crate::diagnostic::{Code, Located};
use crate::spec::read::{Table, Value};

impl Reader<'_> {
    pub(super) fn abaqus(
        &self,
        table: Table<'_>,
        nodes: Option<usize>,
    ) -> Option<(Vec<Located>, Vec<usize>)> {
        let types = table
            .items("types")
            .and_then(|items| self.texts(&items, "an element type such as \"C3D8\""));
        let order = self.order(&table, nodes);
        table.finish();
        Some((types?, order?))
    }

    pub(super) fn vtk(&self, table: Table<'_>, nodes: Option<usize>) -> Option<(u8, Vec<usize>)> {
        let kind = table.count("type").and_then(|kind| {
            let small = kind.to_u8();
            if small.is_none() {
                let span = table.place("type");
                self.error(Code::BAD_VALUE, span, "a VTK cell type is below 256".to_owned());
            }
            small
        });
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
