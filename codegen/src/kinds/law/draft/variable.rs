//! Inputs and outputs by their names, which the solver must know.

use super::super::acts::{self, Acts, Quantity as Known};
use crate::diagnostic::{Code, Diagnostic, Located, suggest};
use crate::document::{Document, Table, Value};
use crate::formula::{self, Formula};
use crate::kinds::read;
use crate::rational::Rational;
use crate::units::Unit;

/// An input, or the head of an output.
pub(in crate::kinds::law) struct Variable {
    pub(in crate::kinds::law) key: Located,
    pub(in crate::kinds::law) name: String,
    pub(in crate::kinds::law) title: String,
    /// The kind of law that tells itself by it, if there is one.
    pub(in crate::kinds::law) only: Option<Acts>,
    pub(in crate::kinds::law) unit: Unit,
    pub(in crate::kinds::law) unit_place: Located,
    pub(in crate::kinds::law) range: Option<[Rational; 2]>,
}

pub(super) fn parse(document: &Document<'_>, text: &Located) -> Option<Formula> {
    formula::parse(text).map_err(|errors| document.append(errors)).ok()
}

/// Reads unit, title and range of a variable that the solver must know.
pub(super) fn variable(
    table: &Table<'_>,
    key: &Located,
    name: String,
    list: fn(Acts) -> &'static [Known],
    role: &str,
) -> Option<Variable> {
    let document = table.document();
    let title = table.optional_string("title");
    let range = range(table);
    let unit_place = table.string("unit");
    let unit = unit_place.as_ref().and_then(|text| read::unit(document, text));
    let known = acts::known(list);
    let Some((quantity, only)) = known.iter().find(|(quantity, _)| quantity.name == name) else {
        let names: Vec<&str> = known.iter().map(|(quantity, _)| quantity.name).collect();
        let error = key.error_here(Code::UNKNOWN_NAME, format!("`{name}` is not {role} of laws"));
        document.push(error.maybe_help(suggest(&name, &names)));
        return None;
    };
    let (unit, unit_place) = (unit?, unit_place?);
    let dimension = &quantity.dimension;
    if !unit.dimension().fits(dimension) {
        let found = unit.dimension();
        let message = format!("`{name}` is {dimension}, but `{unit}` is the unit of {found}");
        let si = dimension.si_unit();
        let error = unit_place.error_here(Code::WRONG_UNIT, message);
        document.push(error.help(format!("write for example `unit = \"{si}\"`")));
        return None;
    }
    let title = title.map_or_else(|| quantity.title.to_owned(), |title| title.text().to_owned());
    Some(Variable { key: key.clone(), name, title, only: *only, unit, unit_place, range })
}

pub(super) fn range(table: &Table<'_>) -> Option<[Rational; 2]> {
    let items = table.optional_items("range")?;
    let ends: Vec<_> = items.iter().map(|item| item.value()).collect();
    match ends.as_slice() {
        [Value::Number(low, _), Value::Number(high, _)] if low < high => {
            Some([low.clone(), high.clone()])
        }
        _ => {
            let span = ends.first().map_or(table.span(), |end| end.span());
            let message = "`range` must be two numbers, the lower first";
            let error = Diagnostic::new(table.source(), Code::BAD_VALUE, span, message);
            table.document().push(error.help("write for example `range = [-0.1, 0.1]`"));
            None
        }
    }
}
