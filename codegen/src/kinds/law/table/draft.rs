//! `[tables.NAME]` of a law file.

use crate::rational::{Rational, nearest};

use super::columns::{Column, Columns, Wanted, Which};
use super::{Extend, LawTable, check_rows};
use crate::diagnostic::{Code, Diagnostics, Located};
use crate::document::{Table, Value};
use crate::formula::{Formula, parse};
use crate::kinds::law::system::System;
use crate::kinds::read;
use crate::kinds::read::FindFile;
use crate::units::Unit;

/// A table as the law file and the file of its columns give it.
pub(in crate::kinds::law) struct TableDraft {
    pub(in crate::kinds::law) key: Located,
    pub(in crate::kinds::law) name: String,
    pub(in crate::kinds::law) input: Formula,
    x: Column,
    y: Column,
    empty: LawTable,
}

impl TableDraft {
    /// The unit of what it is looked up by.
    pub(in crate::kinds::law) fn input_unit(&self) -> &Unit {
        &self.x.unit
    }

    /// The unit of its values.
    pub(in crate::kinds::law) fn unit(&self) -> &Unit {
        &self.y.unit
    }

    /// The table in a system of units, after the first `after` definitions.
    pub(in crate::kinds::law) fn build(self, system: &System, after: usize) -> LawTable {
        let converted = |column: &Column| -> Vec<Rational> {
            let values = column.values.iter();
            values.map(|(value, _)| system.convert(value, &column.unit)).collect()
        };
        let (x, y) = (converted(&self.x), converted(&self.y));
        let written = self.x.values.iter().map(|(value, _)| nearest(value));
        let ends = written
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
        let mut table = LawTable { after, ends, ..self.empty };
        table.fill(x, &y);
        table
    }
}

/// Reads a section and the file that it names.
pub(in crate::kinds::law) fn read(
    section: &Table<'_>,
    key: &Located,
    name: Option<String>,
    beside: &FindFile<'_>,
) -> Option<TableDraft> {
    let document = section.document();
    let file = section.string("file");
    let input = section.string("input");
    let input = input.and_then(|text| parse(&text).map_err(|e| document.append(e)).ok());
    let (x, y) = (wanted(section, key, "x", 0), wanted(section, key, "y", 1));
    let extend = match section.optional_word("extend") {
        Some("constant") => Extend::Constant,
        Some("linear") => Extend::Linear,
        Some("periodic") => Extend::Periodic,
        _ => Extend::Refuse,
    };
    let valid_beyond = match section.optional_word("valid_beyond") {
        Some("below") => [true, false],
        Some("above") => [false, true],
        Some(_) => [true; 2],
        None => [false; 2],
    };
    let path = file?;
    let source = match beside(path.text()) {
        Ok(source) => source,
        Err(message) => {
            let error = path.error_here(Code::BAD_VALUE, message);
            document.push(error.help("the file stands beside that of the law"));
            return None;
        }
    };
    let (x, y) = (x?, y?);
    let columns = Columns::read(&source).map_err(|errors| document.append(errors)).ok()?;
    if let Some(count) = columns.unnamed().filter(|count| *count > 2)
        && !(section.has("x") && section.has("y"))
    {
        let shown = path.text();
        let message = format!("`{shown}` has {count} columns and no line of names");
        let error = path.error_here(Code::TABLE, message);
        document.push(error.help(
            "say which to read, as `x = 1` and `y = 2`; numbers are written with a point, not a comma",
        ));
        return None;
    }
    let read = |wanted| columns.column(wanted).map_err(|errors| document.append(errors)).ok();
    let (x, y) = (read(&x), read(&y));
    let (input, name, x, y) = (input?, name?, x?, y?);
    let empty = LawTable {
        name: name.clone(),
        file: source,
        path: path.text().to_owned(),
        input: input.clone(),
        input_unit: x.unit.clone(),
        unit: y.unit.clone(),
        extend,
        valid_beyond,
        knots: Vec::new(),
        pieces: Vec::new(),
        splits: Vec::new(),
        ends: Default::default(),
        bounds: Default::default(),
        inner: Vec::new(),
        after: 0,
    };
    let fine: Result<(), Diagnostics> = check_rows(&empty, &x, &y);
    fine.map_err(|errors| document.append(errors)).ok()?;
    Some(TableDraft { key: key.clone(), name, input, x, y, empty })
}

/// `x = "gap"`, `x = 1`, or `x = { column = …, unit = "um" }`; without the key, the column at `place`.
fn wanted(section: &Table<'_>, key: &Located, axis: &str, place: usize) -> Option<Wanted> {
    let document = section.document();
    let (value, unit) = match section.value(axis) {
        None => {
            let column = Which::Numbered(place);
            return Some(Wanted { column, place: key.clone(), unit: None });
        }
        Some(Value::Table(_)) => {
            let table = section.table(axis)?;
            let value = table.value("column");
            let unit = table.optional_string("unit");
            table.finish();
            (value?, unit)
        }
        Some(value) => (value, None),
    };
    let unit = match unit {
        Some(text) => Some(read::unit(document, &text)?),
        None => None,
    };
    let span = value.span();
    let place = Located::new(section.source(), span.clone(), &section.source().text[span]);
    let column = match value {
        Value::String(name) => {
            return Some(Wanted {
                column: Which::Named(name.text().to_owned()),
                place: name,
                unit,
            });
        }
        Value::Number(number, _) => crate::formula::whole(&number)
            .and_then(|number| usize::try_from(number - 1).ok())
            .map(Which::Numbered),
        _ => None,
    };
    let Some(column) = column else {
        let message = format!("`{axis}` must be the name of a column, or its number from 1");
        document.push(place.error_here(Code::BAD_VALUE, message));
        return None;
    };
    Some(Wanted { column, place, unit })
}
