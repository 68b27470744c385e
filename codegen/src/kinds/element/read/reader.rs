//! Numbers, formulas and lists of an element's file.

use std::collections::BTreeMap;
use std::ops::Range;

use super::super::schema::MOST;
use crate::diagnostic::{Code, Located};
use crate::document::{Document, Item, Table, Value};
use crate::element::{Cell, Polynomial};
use crate::expression::{Graph, Id, Shape};
use crate::formula::{lower, parse};
use crate::kinds::element::Function;

pub(super) struct Reader<'d> {
    pub(super) document: &'d Document<'d>,
    pub(super) graph: Graph,
    pub(super) coordinates: [Id; 3],
}

impl Reader<'_> {
    /// Adds a formula over `names` to the graph.
    pub(super) fn formula(&mut self, text: &Located, names: &BTreeMap<String, Id>) -> Option<Id> {
        let lowered = parse(text).and_then(|formula| lower(&formula, &mut self.graph, names));
        let id = lowered.map_err(|errors| self.document.append(errors)).ok()?;
        if self.graph.shape(id) != Shape::Scalar {
            let message = "expected a number, found a condition";
            self.document.push(text.error_here(Code::SHAPE, message));
            return None;
        }
        Some(id)
    }

    /// An exact number: a literal, or a formula without names.
    pub(super) fn constant(&mut self, value: &Value<'_>) -> Option<Id> {
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

    pub(super) fn error(&self, code: Code, span: Range<usize>, message: String) {
        self.document.error(code, span, message);
    }

    /// The elements of an array of `count` values; another type or length is an error that says `wanted`.
    pub(super) fn array<'i>(
        &self,
        item: &Item<'i>,
        count: usize,
        wanted: &str,
    ) -> Option<Vec<Value<'i>>> {
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

    pub(super) fn bounded<'i>(
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
    pub(super) fn names(&self) -> BTreeMap<String, Id> {
        let names = ["xi", "eta", "zeta"].map(str::to_owned);
        names.into_iter().zip(self.coordinates).collect()
    }

    pub(super) fn function(
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

    pub(super) fn texts(&self, items: &[Item<'_>], wanted: &str) -> Option<Vec<Located>> {
        let texts = items.iter().map(|item| match item.value() {
            Value::String(text) => Some(text),
            other => {
                self.error(Code::BAD_VALUE, other.span(), format!("expected {wanted}"));
                None
            }
        });
        texts.collect()
    }
}
