//! The names of a law: nodes and meanings, and formulas lowered over them.

use std::collections::BTreeMap;

use super::super::system::System;
use super::super::table::{LawTable, TableDraft};
use crate::diagnostic::{Code, Diagnostics};
use crate::expression::{Graph, Id, Shape};
use crate::formula::{Formula, Meaning, dimension, lower};
use crate::rational::Rational;
use crate::units::{Dimension, Unit};

/// Names of a law, with what they stand for.
#[derive(Default)]
pub(in crate::kinds::law) struct Names {
    pub(in crate::kinds::law) ids: BTreeMap<String, Id>,
    pub(in crate::kinds::law) meanings: BTreeMap<String, Meaning>,
}

impl Names {
    pub(super) fn add(&mut self, name: &str, id: Id, unit: &Unit, value: Option<Rational>) {
        self.ids.insert(name.to_owned(), id);
        let meaning = Meaning { dimension: *unit.dimension(), value };
        self.meanings.insert(name.to_owned(), meaning);
    }

    /// Lowers a table and declares it.
    pub(super) fn table(
        &mut self,
        graph: &mut Graph,
        draft: TableDraft,
        system: &System,
        after: usize,
        errors: &mut Diagnostics,
    ) -> Option<LawTable> {
        let name = draft.name.clone();
        let input = match self.lower(graph, &draft.input, Shape::Scalar) {
            Ok((id, found)) => {
                let wanted = draft.input_unit().dimension().without_angle();
                match found.filter(|found| *found != wanted) {
                    None => Ok(id),
                    Some(found) => {
                        let unit = draft.input_unit();
                        let message =
                            format!("this is {found}, but its column is {wanted}, in `{unit}`");
                        Err(draft.input.text.error_here(Code::DIMENSION, message).into())
                    }
                }
            }
            Err(found) => Err(found),
        };
        match input {
            Ok(input) => {
                let unit = draft.unit().clone();
                let mut table = draft.build(system, after);
                let id = table.lower(graph, input);
                self.add(&name, id, &unit, None);
                Some(table)
            }
            Err(found) => {
                errors.append(found);
                // Its name counts as declared, so that its users are not reported too.
                let unknown = graph.scalar(&name);
                self.ids.insert(name, unknown);
                None
            }
        }
    }

    /// Lowers a formula of the given shape, in the units of the file, and finds what it measures.
    pub(in crate::kinds::law) fn lower(
        &self,
        graph: &mut Graph,
        formula: &Formula,
        wanted: Shape,
    ) -> Result<(Id, Option<Dimension>), Diagnostics> {
        let id = lower(formula, graph, &self.ids)?;
        let dimension = dimension(formula, &self.meanings)?;
        if graph.shape(id) != wanted {
            let (message, help) = match wanted {
                Shape::Truth => (
                    "expected a condition such as `h < c0`, found a number",
                    "compare it with another number",
                ),
                _ => (
                    "expected a number, found a condition",
                    "conditions stand in `when`, numbers in `value`",
                ),
            };
            return Err(formula.text.error_here(Code::SHAPE, message).help(help).into());
        }
        Ok((id, dimension))
    }
}
