//! Equations of motion: derived from an energy, or declared term by term and proved.

use std::collections::BTreeMap;

use super::lagrange::{Blocks, Coordinate, Derivatives, Equations, derivatives, lagrange};
use crate::diagnostic::{Code, Diagnostic, Located};
use crate::document::{Document, Table};
use crate::expression::{Graph, Id, Shape, display, normal};
use crate::formula::{lower, parse};

/// Reads the terms of a motion into a graph.
pub(super) struct Reader<'d> {
    pub(super) document: &'d Document<'d>,
    pub(super) graph: Graph,
    pub(super) names: BTreeMap<String, Id>,
    pub(super) coordinates: Vec<Coordinate>,
}

/// A formula of the file with its place.
struct Declared {
    text: Option<Located>,
    value: Id,
}

impl Reader<'_> {
    /// A formula of a given shape, in the graph.
    fn formula(&mut self, text: &Located, wanted: Shape) -> Option<Id> {
        let value = parse(text)
            .and_then(|formula| lower(&formula, &mut self.graph, &self.names))
            .map_err(|errors| self.document.append(errors))
            .ok()?;
        let shape = self.graph.shape(value);
        // The number 0 stands for a zero of any shape.
        if shape != wanted && self.graph.is_zero(value) {
            return Some(self.graph.zero(wanted));
        }
        if shape != wanted {
            let message = format!("this is {}, but its place wants {}", word(shape), word(wanted));
            self.document.push(text.error_here(Code::SHAPE, message));
            return None;
        }
        Some(value)
    }

    pub(super) fn by_energy(&mut self, text: &Located) -> Option<(Equations, Derivatives)> {
        let energy = self.formula(text, Shape::Scalar)?;
        let coordinates = self.coordinates.clone();
        self.refuse_rates(energy, "kinetic_energy", Some(text), false);
        let both = lagrange(&mut self.graph, energy, &coordinates).and_then(|equations| {
            let derivatives = derivatives(&mut self.graph, &equations, &coordinates)?;
            Ok((equations, derivatives))
        });
        both.map_err(|error| {
            let message = format!("no equations of motion follow from this: {error}");
            self.document.push(text.error_here(Code::DERIVATIVE, message));
        })
        .ok()
        .inspect(|(equations, _)| {
            for (i, row) in equations.mass.iter().enumerate() {
                for (j, block) in row.iter().enumerate() {
                    let place = format!("mass.{}.{}", coordinates[i].name, coordinates[j].name);
                    self.refuse_rates(*block, &place, Some(text), true);
                }
            }
            if self.graph.exceeded() {
                let message =
                    "the derivatives of this energy have too many terms to be worked with";
                let error = text.error_here(Code::LIMIT, message);
                self.document.push(
                    error.help(
                        "use lower powers, fewer products of sums, or numbers of fewer digits",
                    ),
                );
            }
        })
    }

    /// Reports a term that depends on an acceleration, or where `velocities` says so on a rate.
    fn refuse_rates(&mut self, term: Id, place: &str, text: Option<&Located>, velocities: bool) {
        let expanded = normal::expand(&mut self.graph, term);
        for coordinate in &self.coordinates {
            let rates = [
                (coordinate.acceleration, "_ddot", true),
                (coordinate.velocity, "_dot", velocities),
            ];
            for (rate, suffix, _) in rates.into_iter().filter(|(.., refused)| *refused) {
                let (true, Some(text)) = (self.graph.depends(expanded, rate), text) else {
                    continue;
                };
                let message = format!("`{place}` depends on `{}{suffix}`", coordinate.name);
                let error = text.error_here(Code::DERIVATIVE, message);
                self.document.push(error.help(if velocities {
                    "a kinetic energy is quadratic in the rates, a mass matrix free of them"
                } else {
                    "accelerations stand only in M q̈"
                }));
            }
        }
    }

    pub(super) fn by_terms(&mut self, root: &Table) -> Option<(Equations, Derivatives)> {
        if !root.has("mass") && !root.has("quadratic_velocity") {
            let message = "a motion needs `kinetic_energy`, or the tables `mass`, \
                           `quadratic_velocity`, `PF`, `B` and `P`";
            root.error(Code::MISSING_KEY, None, message.into());
            return None;
        }
        let mass = self.blocks(root, "mass");
        let q_v = self.rows(root, "quadratic_velocity");
        let declared = [("PF", "M q̈", "q"), ("B", "Q_v", "q"), ("P", "Q_v", "q̇")]
            .map(|(key, of, by)| (key, of, by, self.blocks(root, key)));
        if self.document.has_errors() {
            return None;
        }
        let symmetric = self.check_symmetry(&mass);
        if self.grown(root) {
            return None;
        }
        for (i, row) in mass.iter().enumerate() {
            for (j, block) in row.iter().enumerate() {
                let names = [i, j].map(|place| self.coordinates[place].name.clone());
                let place = format!("mass.{}", names.join("."));
                self.refuse_rates(block.value, &place, block.text.as_ref(), true);
            }
            let place = format!("quadratic_velocity.{}", self.coordinates[i].name);
            self.refuse_rates(q_v[i].value, &place, q_v[i].text.as_ref(), false);
        }
        let equations = Equations {
            kinetic_energy: None,
            momentum: None,
            mass: values(&mass),
            quadratic_velocity: q_v.iter().map(|row| row.value).collect(),
        };
        let coordinates = self.coordinates.clone();
        let derived = match derivatives(&mut self.graph, &equations, &coordinates) {
            Ok(derived) => derived,
            Err(error) => {
                let message = format!("these terms have no usable derivatives: {error}");
                root.error(Code::DERIVATIVE, None, message);
                return None;
            }
        };
        let blocks = [&derived.pf, &derived.b, &derived.p];
        if self.grown(root) {
            return None;
        }
        for ((key, of, by, declared), derived) in declared.iter().zip(blocks) {
            // What follows from a mass matrix that is wrong says nothing.
            if *key == "PF" && !symmetric {
                continue;
            }
            self.prove(root, &format!("{key} = ∂({of})/∂{by}"), key, declared, derived);
            if self.grown(root) {
                return None;
            }
        }
        (!self.document.has_errors()).then_some((equations, derived))
    }

    /// Reports that the terms grew past the bounds of the graph, where nothing can be proved any more.
    fn grown(&mut self, root: &Table) -> bool {
        let grown = self.graph.exceeded();
        if grown {
            let message =
                "multiplied out, this motion has too many terms or digits to be worked with";
            root.error(Code::LIMIT, None, message.to_owned());
        }
        grown
    }

    /// The rows of a table, one formula a coordinate.
    fn rows(&mut self, root: &Table, key: &str) -> Vec<Declared> {
        let table = root.table(key);
        let coordinates = self.coordinates.clone();
        let rows = coordinates
            .iter()
            .map(|row| {
                let text = table.as_ref().and_then(|table| table.optional_string(&row.name));
                let shape = self.graph.shape(row.position);
                self.declared(text, shape)
            })
            .collect();
        if let Some(table) = table {
            table.finish();
        }
        rows
    }

    /// The blocks of a table, one formula a pair of coordinates.
    fn blocks(&mut self, root: &Table, key: &str) -> Vec<Vec<Declared>> {
        let table = root.table(key);
        let coordinates = self.coordinates.clone();
        let mut blocks = Vec::new();
        for row in &coordinates {
            let inner = table.as_ref().and_then(|table| table.optional_table(&row.name));
            let mut declared = Vec::new();
            for column in &coordinates {
                let text = inner.as_ref().and_then(|table| table.optional_string(&column.name));
                let both = (self.graph.shape(row.position), self.graph.shape(column.position));
                let shape = match both {
                    (Shape::Scalar, Shape::Scalar) => Shape::Scalar,
                    (Shape::Vector, Shape::Vector) => Shape::Matrix,
                    _ => Shape::Vector,
                };
                declared.push(self.declared(text, shape));
            }
            if let Some(inner) = inner {
                inner.finish();
            }
            blocks.push(declared);
        }
        if let Some(table) = table {
            table.finish();
        }
        blocks
    }

    fn declared(&mut self, text: Option<Located>, shape: Shape) -> Declared {
        let value = text.as_ref().and_then(|text| self.formula(text, shape));
        Declared { value: value.unwrap_or_else(|| self.graph.zero(shape)), text }
    }

    /// M must be symmetric: block ij the transpose of block ji.
    fn check_symmetry(&mut self, mass: &[Vec<Declared>]) -> bool {
        let mut symmetric = true;
        for (i, row) in mass.iter().enumerate() {
            for (j, block) in row.iter().enumerate().skip(i) {
                let mirror = match self.graph.shape(block.value) {
                    Shape::Matrix => self.graph.transpose(mass[j][i].value),
                    _ => mass[j][i].value,
                };
                let equal = normal::equal(&mut self.graph, block.value, mirror);
                if !equal && !self.graph.exceeded() {
                    let (a, b) = (&self.coordinates[i].name, &self.coordinates[j].name);
                    let message = format!("the mass matrix is not symmetric in {a} and {b}");
                    let place = block.text.as_ref().or(mass[j][i].text.as_ref());
                    if let Some(place) = place {
                        self.document.push(place.error_here(Code::PROOF, message));
                    }
                    symmetric = false;
                }
            }
        }
        symmetric
    }

    fn prove(
        &mut self,
        root: &Table,
        what: &str,
        key: &str,
        declared: &[Vec<Declared>],
        derived: &Blocks,
    ) {
        for (i, row) in declared.iter().enumerate() {
            for (j, block) in row.iter().enumerate() {
                let expected = derived[i][j];
                let equal = normal::equal(&mut self.graph, block.value, expected);
                if equal || self.graph.exceeded() {
                    continue;
                }
                let place =
                    format!("{key}.{}.{}", self.coordinates[i].name, self.coordinates[j].name);
                let message = format!("`{place}` is not the derivative of the declared terms");
                let help = format!(
                    "{what}; declared {}, derived {}",
                    display(&self.graph, block.value),
                    display(&self.graph, expected)
                );
                let error = match &block.text {
                    Some(text) => text.error_here(Code::PROOF, message),
                    None => Diagnostic::new(root.source(), Code::PROOF, None, message),
                };
                self.document.push(error.help(help));
            }
        }
    }
}

fn values(blocks: &[Vec<Declared>]) -> Blocks {
    blocks.iter().map(|row| row.iter().map(|block| block.value).collect()).collect()
}

fn word(shape: Shape) -> &'static str {
    match shape {
        Shape::Scalar => "a number",
        Shape::Vector => "a vector",
        Shape::Matrix => "a matrix",
        Shape::Truth => "a condition",
    }
}
