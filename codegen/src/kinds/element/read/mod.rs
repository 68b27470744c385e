//! File → element.

mod formats;
mod reader;
mod rule;

use std::collections::BTreeMap;
use std::sync::Arc;

use num_traits::{One, ToPrimitive};

use self::reader::Reader;
use super::schema::{KIND, MOST_COMPLETE};
use super::{ElementSpec, Enhanced, Function, ModeJacobian, ReferenceNode, table};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source};
use crate::document::{Table, Value};
use crate::element::{Cell, Quadrature};
use crate::expression::{Graph, Id, Rational};
use crate::kinds::read::{self, Head};

pub(super) fn read(file: &Arc<Source>) -> Result<ElementSpec, Diagnostics> {
    read::spec(file, KIND.shape, |document, root, head| {
        let mut graph = Graph::new();
        let coordinates = ["xi", "eta", "zeta"].map(|name| graph.scalar(name));
        Reader { document, graph, coordinates }.element(file, root, head)
    })
}

impl<'d> Reader<'d> {
    fn element(mut self, file: &Arc<Source>, root: Table<'d>, head: Head) -> Option<ElementSpec> {
        let document = self.document;
        let fine = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_');
        let message = "an element's name is made of letters, digits, `-` and `_`";
        head.check(document, fine, message);
        let cell = root.word("cell").and_then(Cell::named);
        let nodes = self.nodes(&root);
        // Known even where the nodes, which it is read for, are wrong.
        root.has("shape");
        let shape = nodes.as_deref().and_then(|nodes| self.shape(&root, nodes, cell));
        let complete = self.complete(&root);
        let quadrature = root.table("quadrature");
        let (rule, rules) = match (&quadrature, cell) {
            (Some(table), Some(cell)) => (self.rule(table, cell), self.rules(table, cell)),
            _ => (None, BTreeMap::new()),
        };
        if let (Some(table), Some(_)) = (quadrature, cell) {
            table.finish();
        }
        let enhanced = root
            .optional_table("enhanced")
            .map(|table| cell.and_then(|cell| self.enhanced(table, cell)));
        let count = nodes.as_ref().map(Vec::len);
        let abaqus = root.table("abaqus").and_then(|table| self.abaqus(table, count));
        let nastran = root.optional_table("nastran").map(|table| self.nastran(table, count));
        let gmsh =
            root.optional_table("gmsh").map(|table| self.numbered(table, count, &formats::GMSH));
        let vtk = root.table("vtk").and_then(|table| self.numbered(table, count, &formats::VTK));
        root.finish();
        if document.has_errors() {
            return None;
        }
        let ((abaqus, abaqus_order), (vtk, vtk_order)) = (abaqus?, vtk?);
        let nastran = match nastran {
            Some(read) => Some(read?),
            None => None,
        };
        let enhanced = match enhanced {
            Some(enhanced) => Some(enhanced?),
            None => None,
        };
        let gmsh = match gmsh {
            Some(gmsh) => Some(gmsh?),
            None => None,
        };
        let (cell, shape, rule) = (cell?, shape?, rule?);
        let modes = enhanced.as_ref().map_or(&[][..], |enhanced: &Enhanced| &enhanced.modes);
        let table = |rule: &Quadrature| {
            let table = table::Table::new(cell, &shape, modes, rule);
            table.map_err(|error| document.push(*error)).ok()
        };
        let single: Option<BTreeMap<String, table::Table>> =
            rules.iter().map(|(form, rule)| Some((form.clone(), table(rule)?))).collect();
        let tables = (table(&rule)?, single?);
        let [name, title, reference] = head.texts()?;
        Some(ElementSpec {
            name,
            title,
            reference,
            file: file.clone(),
            cell,
            graph: self.graph,
            coordinates: self.coordinates,
            nodes: nodes?,
            shape,
            complete: complete?,
            enhanced,
            quadrature: rule,
            quadrature_of: rules,
            tables,
            abaqus,
            abaqus_order,
            gmsh_name: gmsh.as_ref().map(|(kind, _)| kind.to_string()),
            gmsh,
            nastran,
            vtk,
            vtk_order,
        })
    }

    fn nodes(&mut self, root: &Table<'_>) -> Option<Vec<ReferenceNode>> {
        let items = self.bounded(root, "nodes", root.items("nodes")?)?;
        let mut nodes = Vec::with_capacity(items.len());
        for item in &items {
            let Some(values) = self.array(item, 3, "three coordinates, such as [-1, 0, 1]") else {
                continue;
            };
            let numbers: Option<Vec<Id>> =
                values.iter().map(|value| self.constant(value)).collect();
            let Some(numbers) = numbers else { continue };
            let exact: Vec<Rational> =
                numbers.iter().filter_map(|id| self.graph.as_number(*id).cloned()).collect();
            match <[Rational; 3]>::try_from(exact) {
                Ok(at) => nodes.push(ReferenceNode { at, place: item.value().span() }),
                Err(_) => {
                    let message =
                        "coordinates of nodes are whole numbers or fractions such as '1/3'"
                            .to_owned();
                    self.error(Code::BAD_VALUE, item.value().span(), message);
                }
            }
        }
        (nodes.len() == items.len()).then_some(nodes)
    }

    fn complete(&self, root: &Table<'_>) -> Option<u32> {
        let complete = root.optional_count("complete").unwrap_or(1);
        if complete > MOST_COMPLETE {
            let span = root.place("complete");
            let message = format!("completeness is proved up to degree {MOST_COMPLETE}");
            self.error(Code::BAD_VALUE, span, message);
            return None;
        }
        complete.to_u32()
    }

    fn shape(
        &mut self,
        root: &Table<'_>,
        nodes: &[ReferenceNode],
        cell: Option<Cell>,
    ) -> Option<Vec<Function>> {
        let texts = match root.value("shape") {
            Some(Value::String(text)) => vec![text; nodes.len()],
            Some(Value::Array(items, span)) => {
                let texts = self.texts(&items, "a formula in a string")?;
                if texts.len() != nodes.len() {
                    let message =
                        format!("`shape` has {} formulas for {} nodes", texts.len(), nodes.len());
                    let error =
                        Diagnostic::new(self.document.source, Code::SHAPE_FUNCTION, span, message);
                    self.document.push(error.help("write one a node, in the order of `nodes`"));
                    return None;
                }
                texts
            }
            _ => {
                root.string("shape");
                return None;
            }
        };
        let mut functions = Vec::with_capacity(nodes.len());
        for (node, text) in nodes.iter().zip(&texts) {
            let mut names = self.names();
            for (name, at) in ["xi_a", "eta_a", "zeta_a"].iter().zip(&node.at) {
                names.insert((*name).to_owned(), self.graph.number(at.clone()));
            }
            let function = match cell {
                Some(cell) => self.function(text, &names, cell),
                // Without its cell a formula has no meaning, but may have mistakes.
                None => self.formula(text, &names).and(None),
            };
            // A formula for all nodes that is wrong is reported once.
            if function.is_none() && texts.iter().all(|other| other.span() == text.span()) {
                return None;
            }
            functions.push(function);
        }
        functions.into_iter().collect()
    }

    fn enhanced(&mut self, table: Table<'_>, cell: Cell) -> Option<Enhanced> {
        let forms =
            table.items("forms").and_then(|items| self.texts(&items, "a form's name in a string"));
        let modes = table.items("modes").and_then(|items| self.bounded(&table, "modes", items));
        let modes = modes.and_then(|items| self.texts(&items, "a formula in a string"));
        let names = self.names();
        let modes: Option<Vec<Function>> = modes
            .and_then(|texts| texts.iter().map(|text| self.function(text, &names, cell)).collect());
        let jacobian = match table.word("jacobian") {
            Some("centre") => Some(ModeJacobian::Centre),
            Some(_) => Some(ModeJacobian::Point),
            None => None,
        };
        let (det, det0) = (self.graph.scalar("det"), self.graph.scalar("det0"));
        let names = BTreeMap::from([("det".to_owned(), det), ("det0".to_owned(), det0)]);
        let text = table.optional_string("scale");
        let scale_place =
            text.as_ref().map_or(table.span(), |text| text.place(0..text.text().len()));
        let scale = match &text {
            Some(text) => self.formula(text, &names),
            None => Some(self.graph.number(Rational::one())),
        };
        table.finish();
        let (forms, modes, jacobian, scale) = (forms?, modes?, jacobian?, scale?);
        Some(Enhanced { modes, jacobian, scale, scale_place, det, det0, forms })
    }
}
