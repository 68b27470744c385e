//! Bilinear forms: what is integrated over a cell.
//!
//! ```toml
//! kind = "form"
//! name = "elasticity"
//! title = "…"
//! source = "book and section"
//!
//! [material.E]               # in SI units, as the kernels take them
//! unit = "Pa"
//! title = "Young's modulus"
//!
//! [coefficients]             # formulas over the material and the coefficients before
//! mu = 'E/(2*(1 + nu))'
//!
//! [matrices]                 # constant, 3 × 3
//! D = [[0, -1, 0], [1, 0, 0], [0, 0, 0]]
//!
//! [stresses]                 # what a form makes of a displacement that the kernel is given
//! sigma = "stiffness"
//!
//! [forms]                    # u: trial (columns), v: test (rows)
//! stiffness = 'lambda*div(u)*div(v) + 2*mu*inner(eps(u), eps(v))'
//! stiffening = 'inner(sigma, transpose(grad(u))*grad(v))'
//! ```
//!
//! A form is made of numbers, material, coefficients, `u`, `v`, constant matrices times them, `div`,
//! `grad`, `eps` (the symmetric part of `grad`), `trace`, `transpose`, products of matrices, `inner` of matrices and
//! `dot` of vectors.
//!
//! The stress of a form a(u, v) is the matrix σ with a(w, v) = ∫ σ : grad(v) dV for all v: derived from the form, not
//! declared. w is the displacement of the cell's nodes, and of the cell's own modes as they follow it in that form.

mod expand;
mod explain;
pub(super) mod kernels;
mod schema;
mod stress;
mod structure;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

pub use expand::{Bilinear, Names, Place};
pub(crate) use kernels::FormKernels;
pub(super) use schema::KIND;
pub use stress::Stress;
pub use structure::{Pattern, Structure};

use num_traits::One;

use crate::diagnostic::{Code, Diagnostics, Located, Source};
use crate::document::{Document, Item, Table, Value};
use crate::expression::{Graph, Id, Rational, Shape};
use crate::formula::{Meaning, dimension, lower, parse};
use crate::spec::kind::About;
use crate::spec::read::{self, Head};
use crate::units::Unit;
use expand::expand;
use stress::Named;
use structure::structure;

/// Forms over one material, ready to be emitted: see the module for the file.
#[derive(Debug, Clone)]
pub struct FormSpec {
    /// Name.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// Book or paper.
    pub(crate) reference: String,
    /// The file.
    pub file: Arc<Source>,
    /// The graph that holds all expressions.
    pub graph: Graph,
    /// Properties of the material, in the order of the file.
    pub material: Vec<Property>,
    /// Coefficients with their symbols and what these stand for, over the material's symbols.
    pub(crate) coefficients: Vec<Coefficient>,
    /// The forms, in the order of the file.
    pub forms: Vec<Form>,
    /// The stresses, each at the points of the form that gives it.
    pub stresses: Vec<Form>,
}

/// A property of the material.
#[derive(Debug, Clone)]
pub struct Property {
    /// Name in the spec.
    pub name: String,
    /// One line for people.
    pub title: String,
    /// SI unit.
    pub unit: Unit,
    /// Its symbol.
    pub symbol: Id,
}

/// A named coefficient.
#[derive(Debug, Clone)]
pub(crate) struct Coefficient {
    /// Name in the spec.
    pub name: String,
    /// The symbol that stands for it in the forms.
    pub symbol: Id,
    /// Its value over the material's symbols.
    pub value: Id,
    /// The formula.
    pub text: Located,
}

/// A bilinear form.
#[derive(Debug, Clone)]
pub struct Form {
    /// Name, such as `stiffness`.
    pub name: String,
    /// The formula.
    pub text: Located,
    /// Its coefficients, over the symbols of material and coefficients.
    pub(crate) bilinear: Bilinear,
    /// What was found in them.
    pub(crate) structure: Structure,
    /// The stress in it, if there is one.
    pub stress: Option<Stress>,
}

/// Which part of a basis function occurs in a product.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum BasisPart {
    /// N.
    Value,
    /// ∇N.
    Gradient,
}

impl Form {
    /// The parts of test and trial function that are multiplied.
    pub fn products(&self) -> BTreeSet<(BasisPart, BasisPart)> {
        let part = |place: usize| if place == 0 { BasisPart::Value } else { BasisPart::Gradient };
        self.bilinear.keys().map(|place| (part(place.test), part(place.trial))).collect()
    }

    /// The form at whose points, and with whose modes, it is integrated: itself, or the one that gives its stress, so that
    /// stress and load balance.
    pub fn integrated_as(&self) -> &str {
        self.stress.as_ref().map_or(&self.name, |stress| &stress.form)
    }
}

impl FormSpec {
    /// What it says about itself.
    pub(crate) fn about(&self) -> About<'_> {
        let FormSpec { name, title, reference, file, .. } = self;
        About { name, title, reference, file, beside: Vec::new() }
    }

    /// The name of the set of forms, and those of the forms and stresses.
    pub(in crate::spec) fn names(&self) -> Vec<(&'static str, &str)> {
        let forms = self.kernels().map(|form| ("form", form.name.as_str()));
        std::iter::once(("set of forms", self.name.as_str())).chain(forms).collect()
    }

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

    /// All that has a kernel of its own: the forms, then the stresses.
    pub(crate) fn kernels(&self) -> impl Iterator<Item = &Form> {
        self.forms.iter().chain(&self.stresses)
    }

    /// Properties that a form uses, in the order of the file.
    pub(crate) fn material_of(&self, form: &Form) -> Vec<&Property> {
        let of_stress = form.stress.iter().flat_map(|stress| stress.components.iter().flatten());
        let ids: Vec<Id> = form.bilinear.values().chain(of_stress).copied().collect();
        let uses = |symbol: Id| {
            ids.iter().any(|id| {
                self.graph.depends(*id, symbol)
                    || self.coefficients.iter().any(|c| {
                        self.graph.depends(*id, c.symbol) && self.graph.depends(c.value, symbol)
                    })
            })
        };
        self.material.iter().filter(|property| uses(property.symbol)).collect()
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

#[cfg(test)]
mod tests;
