//! File → forms.

use std::collections::BTreeMap;
use std::sync::Arc;

use num_traits::One;

use super::expand::{Names, expand};
use super::stress::{self, Named};
use super::structure::structure;
use super::{Coefficient, Form, FormSpec, KIND, Property};
use crate::diagnostic::{Code, Diagnostics, Located, Source};
use crate::document::{Document, Item, Table, Value};
use crate::expression::{Graph, Rational, Shape};
use crate::formula::{Meaning, dimension, lower, parse};
use crate::kinds::read::{self, Head};
use crate::units::Unit;

impl FormSpec {
    /// Reads, expands and analyses forms.
    ///
    /// # Errors
    /// Everything wrong with the file, each with its place.
    pub fn read(file: &Arc<Source>) -> Result<Self, Diagnostics> {
        read::spec(file, KIND.shape, |document, root, head| {
            let (graph, names, meanings) = (Graph::new(), Names::default(), BTreeMap::new());
            Reader { document, graph, names, meanings }.spec(file, root, head)
        })
    }
}

struct Reader<'d> {
    document: &'d Document<'d>,
    graph: Graph,
    names: Names,
    meanings: BTreeMap<String, Meaning>,
}

impl Reader<'_> {
    fn spec(mut self, file: &Arc<Source>, root: Table<'_>, head: Head) -> Option<FormSpec> {
        let material = root.table("material").map(|table| self.material(table));
        let coefficients = root.optional_table("coefficients").map(|t| self.coefficients(t));
        if let Some(table) = root.optional_table("matrices") {
            self.matrices(table);
        }
        let named = root.optional_table("stresses").map(|table| self.stresses(table));
        let named = named.unwrap_or_default();
        let forms = root.table("forms").map(|table| self.forms(table, &named));
        root.finish();
        if self.document.has_errors() {
            return None;
        }
        let [name, title, reference] = head.texts()?;
        let (forms, stresses) = forms?;
        Some(FormSpec {
            name,
            title,
            reference,
            file: file.clone(),
            graph: self.graph,
            material: material?,
            coefficients: coefficients.unwrap_or_default(),
            forms,
            stresses,
        })
    }

    /// A name that is free and belongs to the grammar.
    fn take(&self, key: &Located) -> Option<String> {
        let taken = |name: &str| {
            matches!(name, "u" | "v")
                || self.names.scalars.contains_key(name)
                || self.names.matrices.contains_key(name)
                || self.names.stresses.contains_key(name)
        };
        read::name(self.document, key, |name| match taken(&name) {
            true => Err(format!("the name `{name}` is taken")),
            false => Ok(name),
        })
    }

    fn material(&mut self, table: Table<'_>) -> Vec<Property> {
        let mut material = Vec::new();
        for key in table.names() {
            let Some(entry) = table.table(key.text()) else { continue };
            let (text, title) = (entry.string("unit"), entry.string("title"));
            entry.finish();
            let Some(name) = self.take(&key) else { continue };
            let symbol = self.graph.scalar(&name);
            self.names.scalars.insert(name.clone(), symbol);
            let unit = text.as_ref().and_then(|text| self.unit(text));
            if let (Some(unit), Some(title)) = (unit, title) {
                let meaning = Meaning { dimension: *unit.dimension(), value: None };
                self.meanings.insert(name.clone(), meaning);
                material.push(Property { name, title: title.text().to_owned(), unit, symbol });
            }
        }
        table.finish();
        material
    }

    fn unit(&self, text: &Located) -> Option<Unit> {
        let unit = read::unit(self.document, text)?;
        if unit.factor().to_rational().is_none_or(|factor| !factor.is_one()) {
            let message = format!("forms are written in SI units, `{unit}` is none");
            let error = text.error_here(Code::WRONG_UNIT, message);
            let si = unit.dimension().si_unit();
            self.document.push(error.help(format!("write `unit = \"{si}\"`")));
            return None;
        }
        Some(unit)
    }

    fn coefficients(&mut self, table: Table<'_>) -> Vec<Coefficient> {
        let mut coefficients: Vec<Coefficient> = Vec::new();
        // Coefficients before count with their values, so that every value is over the material.
        let mut values = self.names.scalars.clone();
        for key in table.names() {
            let (name, text) = (self.take(&key), table.string(key.text()));
            let (Some(name), Some(text)) = (name, text) else { continue };
            let symbol = self.graph.scalar(&name);
            self.names.scalars.insert(name.clone(), symbol);
            let read = parse(&text).and_then(|formula| {
                let value = lower(&formula, &mut self.graph, &values)?;
                Ok((value, dimension(&formula, &self.meanings)?))
            });
            match read {
                Ok((value, measured)) if self.graph.shape(value) == Shape::Scalar => {
                    if let Some(dimension) = measured {
                        self.meanings.insert(name.clone(), Meaning { dimension, value: None });
                    }
                    values.insert(name.clone(), value);
                    self.names.coefficients.insert(symbol, value);
                    coefficients.push(Coefficient { name, symbol, value, text });
                }
                Ok(_) => {
                    let message = "expected a number, found a condition";
                    self.document.push(text.error_here(Code::SHAPE, message));
                }
                Err(errors) => {
                    self.document.append(errors);
                    values.insert(name, symbol);
                }
            }
        }
        table.finish();
        coefficients
    }

    fn matrices(&mut self, table: Table<'_>) {
        for key in table.names() {
            let Some(name) = self.take(&key) else { continue };
            let rows = table.items(key.text()).and_then(|items| matrix(&items));
            match rows {
                Some(rows) => {
                    self.names.matrices.insert(name, rows);
                }
                None => {
                    let span = table.place(key.text());
                    let message = format!("`{name}` must be three rows of three numbers");
                    table.error(Code::BAD_VALUE, span, message);
                }
            }
        }
        table.finish();
    }

    /// Names of stresses, and of the forms that they are of.
    fn stresses(&mut self, table: Table<'_>) -> Vec<Named> {
        let mut stresses = Vec::new();
        for key in table.names() {
            let (name, form) = (self.take(&key), table.string(key.text()));
            let (Some(name), Some(form)) = (name, form) else { continue };
            let symbols = stress::symbols(&mut self.graph, &name);
            self.names.stresses.insert(name.clone(), symbols);
            stresses.push(Named { name, form, symbols });
        }
        table.finish();
        stresses
    }

    /// The forms, and the stresses at points.
    fn forms(&mut self, table: Table<'_>, stresses: &[Named]) -> (Vec<Form>, Vec<Form>) {
        let mut forms = Vec::new();
        for key in table.names() {
            let Some(text) = table.string(key.text()) else { continue };
            let stresses = &self.names.stresses;
            let free = |name| form_name(name).and_then(|name| apart(name, stresses));
            let Some(name) = read::name(self.document, &key, free) else { continue };
            let expanded = parse(&text).and_then(|formula| {
                expand(&formula, &mut self.graph, &self.names).map_err(|error| (*error).into())
            });
            match expanded {
                Ok(_) if self.graph.exceeded() => {
                    let message =
                        "multiplied out, this form has too many terms or digits to be worked with";
                    let error = text.error_here(Code::LIMIT, message);
                    self.document.push(error.help(
                        "use lower powers, fewer products of sums, or numbers of fewer digits",
                    ));
                    return (forms, Vec::new());
                }
                Ok(bilinear) if bilinear.is_empty() => {
                    let message = format!("`{name}` is zero whatever u and v are");
                    let error = text.error_here(Code::FORM, message);
                    self.document.push(error.help("leave it out, or look for a wrong sign"));
                }
                Ok(bilinear) => {
                    let structure = structure(&mut self.graph, &bilinear);
                    forms.push(Form { name, text, bilinear, structure, stress: None });
                }
                Err(errors) => self.document.append(errors),
            }
        }
        if table.names().is_empty() {
            let message = "there is no form, such as `mass = 'rho*dot(u, v)'`".to_owned();
            table.error(Code::MISSING_KEY, table.span(), message);
        }
        table.finish();
        // A form that is wrong is missing, which has been noted.
        if self.document.has_errors() {
            return (forms, Vec::new());
        }
        match stress::resolve(&mut self.graph, stresses, &mut forms) {
            Ok(at_points) => (forms, at_points),
            Err(errors) => {
                self.document.append(errors);
                (forms, Vec::new())
            }
        }
    }
}

/// Forms and stresses have kernels by their names.
fn apart<T>(name: String, stresses: &BTreeMap<String, T>) -> Result<String, String> {
    match stresses.contains_key(&name) {
        true => Err(format!("the name `{name}` is taken")),
        false => Ok(name),
    }
}

/// Functions get the names of forms, beside tables in capitals.
fn form_name(name: String) -> Result<String, String> {
    if name.chars().any(|c| c.is_ascii_uppercase()) {
        let wanted = "lower-case letters, digits and `_`";
        return Err(format!("`{name}` cannot be a form's name, which is made of {wanted}"));
    }
    Ok(name)
}

fn matrix(items: &[Item<'_>]) -> Option<[[Rational; 3]; 3]> {
    let rows: Option<Vec<[Rational; 3]>> = items
        .iter()
        .map(|item| match item.value() {
            Value::Array(entries, _) => {
                let numbers: Option<Vec<Rational>> = entries
                    .iter()
                    .map(|entry| match entry.value() {
                        Value::Number(number, _) => Some(number),
                        _ => None,
                    })
                    .collect();
                numbers?.try_into().ok()
            }
            _ => None,
        })
        .collect();
    rows?.try_into().ok()
}
