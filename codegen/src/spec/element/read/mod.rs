//! File → element.

mod formats;
pub(super) mod rule;

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use num_traits::{One, ToPrimitive};

use super::{ElementSpec, Enhanced, Function, KIND, ModeJacobian, ReferenceNode, table};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source};
use crate::document::{Document, Item, Table, Value};
use crate::element::{Cell, Polynomial, Quadrature};
use crate::expression::{Graph, Id, Rational};
use crate::formula::{lower, parse};
use crate::spec::read::{self, Head};

/// Most nodes of an element, points of a rule, and modes: far above any element in use.
pub(super) const MOST: usize = 64;

/// Highest degree of completeness.
pub(super) const MOST_COMPLETE: usize = 4;

pub(super) fn read(file: &Arc<Source>) -> Result<ElementSpec, Diagnostics> {
    read::spec(file, KIND.shape, |document, root, head| {
        let mut graph = Graph::new();
        let coordinates = ["xi", "eta", "zeta"].map(|name| graph.scalar(name));
        Reader { document, graph, coordinates }.element(file, root, head)
    })
}

struct Reader<'d> {
    document: &'d Document<'d>,
    graph: Graph,
    coordinates: [Id; 3],
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

    /// Adds a formula over `names` to the graph.
    fn formula(&mut self, text: &Located, names: &BTreeMap<String, Id>) -> Option<Id> {
        let lowered = parse(text).and_then(|formula| lower(&formula, &mut self.graph, names));
        let id = lowered.map_err(|errors| self.document.append(errors)).ok()?;
        if self.graph.shape(id) != crate::expression::Shape::Scalar {
            let message = "expected a number, found a condition";
            self.document.push(text.error_here(Code::SHAPE, message));
            return None;
        }
        Some(id)
    }

    /// An exact number: a literal, or a formula without names.
    fn constant(&mut self, value: &Value<'_>) -> Option<Id> {
        match value {
            Value::Number(number, _) => Some(self.graph.number(number.clone())),
            Value::String(text) => self.formula(text, &BTreeMap::new()),
            other => {
                let message = "expected a number or a formula such as '1/sqrt(3)'";
                self.error(Code::BAD_VALUE, other.span(), message.to_owned());
                None
            }
        }
    }

    fn error(&self, code: Code, span: Range<usize>, message: String) {
        self.document.error(code, span, message);
    }

    /// The elements of an array of `count` values; another type or length is an error that says `wanted`.
    fn array<'i>(&self, item: &Item<'i>, count: usize, wanted: &str) -> Option<Vec<Value<'i>>> {
        match item.value() {
            Value::Array(items, _) if items.len() == count => {
                Some(items.iter().map(Item::value).collect())
            }
            other => {
                self.error(Code::BAD_VALUE, other.span(), format!("expected {wanted}"));
                None
            }
        }
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

    fn bounded<'i>(
        &self,
        table: &Table<'_>,
        key: &str,
        items: Vec<Item<'i>>,
    ) -> Option<Vec<Item<'i>>> {
        if items.is_empty() || items.len() > MOST {
            let span = table.place(key);
            let message = format!("`{key}` must have 1 to {MOST} entries, not {}", items.len());
            self.error(Code::BAD_VALUE, span, message);
            return None;
        }
        Some(items)
    }

    /// The names of a formula over ξ, η, ζ.
    fn names(&self) -> BTreeMap<String, Id> {
        let names = ["xi", "eta", "zeta"].map(str::to_owned);
        names.into_iter().zip(self.coordinates).collect()
    }

    fn function(
        &mut self,
        text: &Located,
        names: &BTreeMap<String, Id>,
        cell: Cell,
    ) -> Option<Function> {
        let value = self.formula(text, names)?;
        let polynomial = Polynomial::read(&self.graph, value, &self.coordinates, cell);
        let Some(polynomial) = polynomial else {
            let divided = match cell {
                Cell::Pyramid => ", divided by powers of 1 - zeta if need be",
                _ => "",
            };
            let message = format!(
                "expected a polynomial in xi, eta and zeta of moderate size with rational \
                 coefficients{divided}"
            );
            self.document.push(text.error_here(Code::SHAPE_FUNCTION, message));
            return None;
        };
        let slopes = [0, 1, 2].map(|axis| polynomial.slope(cell, axis));
        let mut gradient = [value; 3];
        for (slope, coordinate) in gradient.iter_mut().zip(self.coordinates) {
            match self.graph.differentiate(value, coordinate) {
                Ok(derivative) => *slope = derivative,
                Err(error) => {
                    self.document.push(text.error_here(Code::DERIVATIVE, error.to_string()));
                    return None;
                }
            }
        }
        Some(Function { value, gradient, polynomial, slopes, text: text.clone() })
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

    fn texts(&self, items: &[Item<'_>], wanted: &str) -> Option<Vec<Located>> {
        let texts = items.iter().map(|item| match item.value() {
            Value::String(text) => Some(text),
            other => {
                self.error(Code::BAD_VALUE, other.span(), format!("expected {wanted}"));
                None
            }
        });
        texts.collect()
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
