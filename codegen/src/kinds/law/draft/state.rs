//! `[states.NAME]` of a law file, and the rates of its states.

use std::collections::BTreeMap;

use super::output::{Jumps, Output};
use super::variable::{Variable, parse, range};
use crate::diagnostic::{Code, Diagnostic, Located, suggest};
use crate::document::{Table, Value};
use crate::formula::Formula;
use crate::kinds::read;
use crate::rational::Rational;
use crate::units::Unit;

/// A state as it was written.
pub(in crate::kinds::law) struct StateDraft {
    pub(in crate::kinds::law) variable: Variable,
    /// The value at which it begins, in its unit; none where its rate is zero.
    pub(in crate::kinds::law) start: Option<Rational>,
}

/// Reads a state.
pub(super) fn read(table: &Table<'_>, key: &Located, name: String) -> Option<StateDraft> {
    let document = table.document();
    let title = table.optional_string("title").map_or(String::new(), |text| text.text().into());
    let range = range(table);
    let unit_place = table.string("unit");
    let unit = unit_place.as_ref().and_then(|text| read::unit(document, text));
    let start = match table.value("start") {
        Some(Value::Number(number, _)) => Some(Some(number)),
        Some(Value::String(text)) if text.text() == "rest" => Some(None),
        Some(other) => {
            let message = "`start` must be a number, or \"rest\"".to_owned();
            let error = Diagnostic::new(table.source(), Code::BAD_VALUE, other.span(), message);
            document.push(error.help("\"rest\" begins where the rate of the state is zero"));
            None
        }
        None => {
            let error =
                key.error_here(Code::MISSING_KEY, format!("`{name}` does not say how it begins"));
            let help =
                "write `start = 0`, in its unit, or `start = \"rest\"`, where its rate is zero";
            table.miss(&["start"], error.help(help));
            None
        }
    };
    let variable = Variable {
        key: key.clone(),
        name,
        title,
        only: None,
        unit: unit?,
        unit_place: unit_place?,
        range,
    };
    Some(StateDraft { variable, start: start? })
}

/// Reads the formulas of the rates: one for every state, as outputs that are called `NAME_dot`. `declared`: all states that have a
/// section, with those that could not be read.
pub(super) fn rates(
    table: Option<Table<'_>>,
    (states, declared): (&[StateDraft], &[String]),
    is_free: impl Fn(&str) -> bool,
    root: &Table<'_>,
) -> Vec<Output> {
    let mut formulas: BTreeMap<String, Formula> = BTreeMap::new();
    let mut named: Vec<String> = Vec::new();
    if let Some(table) = table {
        let known: Vec<&str> = declared.iter().map(String::as_str).collect();
        for key in table.names() {
            let name = crate::formula::name(key.text()).unwrap_or_else(|_| key.text().to_owned());
            let text = table.string(key.text());
            if !known.contains(&name.as_str()) {
                let message = format!("`{name}` is not a state of this law");
                let error = key.error_here(Code::UNKNOWN_NAME, message);
                let near = suggest(&name, &known);
                let help = format!("declare it by a section `[states.{name}]`");
                root.document().push(match near {
                    Some(_) => error.maybe_help(near),
                    None => error.help(help),
                });
                continue;
            }
            named.push(name.clone());
            if let Some(formula) = text.and_then(|text| parse(root.document(), &text)) {
                formulas.insert(name, formula);
            }
        }
        table.finish();
    }
    let mut rates = Vec::new();
    for StateDraft { variable, .. } in states {
        let name = &variable.name;
        if !named.contains(name) {
            let error = variable.key.error_here(Code::MISSING_KEY, format!("`{name}` has no rate"));
            let help =
                format!("write `{name} = '…'` in a section `[rates]`, its change per second");
            root.document().push(error.help(help));
        }
        let rate = format!("{name}_dot");
        if !is_free(&rate) {
            let message = format!("`{rate}` is the name of the rate of `{name}`");
            let error = variable.key.error_here(Code::BAD_NAME, message);
            root.document().push(error.help("choose another name for the state"));
        }
        // Of a unit that is too long the state's own has been found to be.
        let text = format!("{}/s", variable.unit.text());
        let (Some(formula), Ok(unit)) = (formulas.remove(name), Unit::parse(&text)) else {
            continue;
        };
        let variable = Variable {
            key: variable.key.clone(),
            name: rate,
            title: format!("rate of {name}"),
            only: None,
            unit,
            unit_place: variable.unit_place.clone(),
            range: None,
        };
        rates.push(Output {
            variable,
            pieces: vec![(None, formula)],
            jumps: Jumps::Refused,
            smooth: None,
        });
    }
    rates
}
