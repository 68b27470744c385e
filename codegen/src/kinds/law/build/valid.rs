//! Sections `[valid.NAME]` checked and lowered; and the ends of tables.

use super::super::draft::{Limit, ValidityDraft};
use super::super::valid::Validity;
use super::names::Names;
use crate::diagnostic::{Code, Diagnostics, Located};
use crate::expression::{Graph, Shape};
use crate::formula::{Formula, bytecode, check, dimension};
use crate::kinds::law::system::System;
use crate::kinds::law::{LawInput, LawTable, Parameter};
use crate::operation::{Bytecode, Operand};
use crate::rational::{Rational, nearest};
use crate::units::Dimension;

/// Everything that the measures of a law refer to.
pub(super) struct Scope<'s> {
    pub(super) names: &'s Names,
    pub(super) system: &'s System,
    pub(super) inputs: &'s [LawInput],
    pub(super) parameters: &'s [Parameter],
    /// What is known after the inputs, in the order in which it becomes known.
    pub(super) derived: Vec<&'s str>,
}

/// The measures of the sections, then those of tables that end.
pub(super) fn build(
    drafts: &[ValidityDraft],
    tables: &[LawTable],
    scope: &Scope<'_>,
    graph: &mut Graph,
) -> Result<Vec<Validity>, Diagnostics> {
    let mut errors = Diagnostics::new();
    let mut valid = Vec::new();
    for draft in drafts {
        match scope.validity(draft, graph) {
            Ok(own) => valid.push(own),
            Err(found) => errors.append(found),
        }
    }
    for table in tables {
        match scope.end_of(table, graph) {
            Ok(own) => valid.extend(own),
            Err(found) => errors.append(found),
        }
    }
    errors.into_result(valid)
}

impl Scope<'_> {
    fn validity(&self, draft: &ValidityDraft, graph: &mut Graph) -> Result<Validity, Diagnostics> {
        let wanted = draft.unit.dimension().without_angle();
        let (id, found) = self.names.lower(graph, &draft.value, Shape::Scalar)?;
        fits(&draft.value, found, &wanted, &draft.key)?;
        let mut limits = [f64::NEG_INFINITY, f64::INFINITY];
        for (limit, own) in limits.iter_mut().zip(&draft.limits) {
            match own {
                None => {}
                Some(Limit::Number(number)) => *limit = draft.unit.to_si(nearest(number)),
                Some(Limit::Formula(formula)) => *limit = self.constant(formula, draft, &wanted)?,
            }
        }
        if limits[0] > limits[1] {
            let error = draft.key.error_here(Code::BAD_VALUE, "`min` is above `max`");
            return Err(error.help("nothing lies between them: exchange them").into());
        }
        let in_si = self.system.in_si(&wanted);
        Ok(Validity {
            name: draft.name.clone(),
            title: draft.title.clone(),
            help: draft.help.clone(),
            unit: draft.unit.clone(),
            text: draft.value.text.text().to_owned(),
            limits,
            value: graph.times(in_si.clone(), id),
            code: self.code(&draft.value)?,
            in_si,
        })
    }

    /// A limit that is a formula of parameters, SI.
    fn constant(
        &self,
        formula: &Formula,
        draft: &ValidityDraft,
        wanted: &Dimension,
    ) -> Result<f64, Diagnostics> {
        for (name, span) in formula.names() {
            if self.inputs.iter().any(|input| input.name == *name) || self.derived.contains(&name) {
                let message = format!("a limit is made of numbers and parameters, not of `{name}`");
                let error = formula.text.error(Code::BAD_VALUE, span, message);
                return Err(error.help("measure the quotient, and limit it by a number").into());
            }
        }
        fits(formula, dimension(formula, &self.names.meanings)?, wanted, &draft.key)?;
        let code = self.code(formula)?;
        let scope = self.parameters.iter().map(|own| (own.name.as_str(), Shape::Scalar)).collect();
        let limit = match check(formula, &scope)? {
            Shape::Scalar => code.value::<f64>(&[]) * nearest(&self.system.in_si(wanted)),
            _ => f64::NAN,
        };
        if !limit.is_finite() {
            let error =
                formula.text.error_here(Code::UNDEFINED, "this limit is not a finite number");
            return Err(error.help("write a number, such as `max = 0.99`").into());
        }
        Ok(limit)
    }

    /// The input of a table, within its rows where it is not meant to go on beyond them.
    fn end_of(&self, table: &LawTable, graph: &mut Graph) -> Result<Option<Validity>, Diagnostics> {
        let Some([first, last]) = table.trusted() else { return Ok(None) };
        let (id, _) = self.names.lower(graph, &table.input, Shape::Scalar)?;
        let in_si = self.system.in_si(&table.input_unit.dimension().without_angle());
        let si =
            |end: Option<Rational>, open: f64| end.map_or(open, |end| nearest(&(end * &in_si)));
        let text = table.input.text.text();
        Ok(Some(Validity {
            name: table.name.clone(),
            title: format!("`{text}`, by which the table `{}` is looked up", table.name),
            help: format!(
                "add the rows that are missing to `{}`; where the table is meant to go on beyond its rows, say \
                 `valid_beyond = \"below\"`, `\"above\"` or `\"both\"` in `[tables.{}]`",
                table.path, table.name
            ),
            unit: table.input_unit.clone(),
            text: text.to_owned(),
            limits: [si(first, f64::NEG_INFINITY), si(last, f64::INFINITY)],
            value: graph.times(in_si.clone(), id),
            code: self.code(&table.input)?,
            in_si,
        }))
    }

    fn code(&self, formula: &Formula) -> Result<Bytecode, Diagnostics> {
        let places = self.inputs.iter().map(|input| input.name.as_str());
        let places: Vec<&str> = places.chain(self.derived.iter().copied()).collect();
        let constant = |name: &str| {
            let parameter = self.parameters.iter().find(|parameter| parameter.name == name)?;
            Some(Operand::Constant(nearest(&parameter.value)))
        };
        let place = |name: &str| places.iter().position(|own| *own == name).map(Operand::Input);
        bytecode(formula, &|name| place(name).or_else(|| constant(name)))
    }
}

/// Whether a formula measures what the unit of its section does.
fn fits(
    formula: &Formula,
    found: Option<Dimension>,
    wanted: &Dimension,
    key: &Located,
) -> Result<(), Diagnostics> {
    let Some(found) = found.filter(|found| found.without_angle() != *wanted) else { return Ok(()) };
    let message =
        format!("this is {found}, but the `unit` of `{}` is that of {wanted}", key.text());
    let error = formula.text.error_here(Code::DIMENSION, message);
    Err(error.help(format!("write for example `unit = \"{}\"`", found.si_unit())).into())
}
