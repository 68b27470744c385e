//! A table of sections in a file: a line of names with their units, and a line for each row.

use std::collections::BTreeMap;

use whirl_codegen::diagnostic::{Code, Diagnostic, Located, suggest};
use whirl_codegen::document::Table;
use whirl_codegen::units::{Dimension, Unit};

use super::row::{LENGTHS, RowDraft, TEXTS};
use crate::case::columns;
use crate::case::library::FileStore;

const EXAMPLE: &str = "its first line names the columns, lengths with their units: \
                       `length [mm], outer [mm], inner [mm], material`";
/// Errors of one file that are shown.
const MOST_ERRORS: usize = 8;

/// What a column has.
#[derive(Clone)]
enum Column {
    Length(&'static str, Unit),
    Text(&'static str),
}

/// The rows of the file; none where it has none that can be read. What is wrong is noted.
pub(super) fn read(store: FileStore, table: &Table, name: &Located) -> Option<Vec<RowDraft>> {
    let source = store.read_named(table, name)?;
    let lines = match columns::lines(&source) {
        Ok(lines) => lines,
        Err(error) => {
            table.push(*error);
            return None;
        }
    };
    let Some((heads, lines)) = lines.split_first() else {
        let message = format!("`{}` is empty", name.text());
        table.push(name.error_here(Code::TABLE, message).help(EXAMPLE));
        return None;
    };
    let columns = columns_of(upto_last(heads, 1), table)?;
    if lines.is_empty() {
        let message = format!("`{}` has no row", name.text());
        table.push(name.error_here(Code::TABLE, message).help("add a line for each section"));
        return None;
    }
    let is_number = |at: usize| matches!(columns.get(at), Some(Column::Length(..)));
    let decimal = columns::decimal(heads, lines, is_number);
    let (mut rows, mut wrong) = (Vec::with_capacity(lines.len()), 0);
    for line in lines {
        match row(upto_last(line, columns.len()), &columns, decimal) {
            Ok(own) => rows.push(own),
            Err(error) => {
                table.push(*error);
                wrong += 1;
                if wrong == MOST_ERRORS {
                    break;
                }
            }
        }
    }
    (wrong == 0).then_some(rows)
}

/// A line without the empty cells at its end that a spreadsheet adds, of so many cells at least.
fn upto_last(line: &[Located], least: usize) -> &[Located] {
    let last = line.iter().rposition(|cell| !cell.text().is_empty()).map_or(0, |last| last + 1);
    &line[..last.max(least).min(line.len())]
}

/// The columns by their names; none if one is wrong.
fn columns_of(heads: &[Located], table: &Table) -> Option<Vec<Column>> {
    let before = table.errors();
    let mut columns = Vec::with_capacity(heads.len());
    let mut known: Vec<String> = Vec::new();
    for head in heads {
        match column(head) {
            Ok((own, name)) => {
                if known.contains(&name) {
                    let message = format!("the column `{name}` stands twice");
                    table.push(head.error_here(Code::TABLE, message).help("keep one of them"));
                }
                known.push(name);
                columns.push(own);
            }
            Err(error) => table.push(*error),
        }
    }
    (table.errors() == before).then_some(columns)
}

fn column(head: &Located) -> Result<(Column, String), Box<Diagnostic>> {
    let brackets = [('[', ']'), ('(', ')')].into_iter().find_map(|(open, close)| {
        let (name, rest) = head.text().split_once(open)?;
        Some((name.trim(), rest.split_once(close).map(|own| own.0)))
    });
    let (name, unit) = brackets.unwrap_or((head.text().trim(), None));
    let name = &name.to_ascii_lowercase();
    if let Some(text) = TEXTS.into_iter().find(|known| *known == name) {
        return match brackets.is_some() {
            false => Ok((Column::Text(text), name.to_owned())),
            true => {
                let message = format!("the column `{name}` has names, which have no unit");
                Err(Box::new(head.error_here(Code::TABLE, message).help(format!("write `{name}`"))))
            }
        };
    }
    let Some(length) = LENGTHS.into_iter().find(|known| *known == name) else {
        let known: Vec<&str> = LENGTHS.into_iter().chain(TEXTS).collect();
        let message = format!("a table of sections has no column `{}`", name.escape_debug());
        let help = suggest(name, &known).unwrap_or_else(|| {
            format!(
                "columns are {}",
                known.iter().map(|own| format!("`{own}`")).collect::<Vec<_>>().join(", ")
            )
        });
        return Err(Box::new(head.error_here(Code::TABLE, message).help(help)));
    };
    let Some(inside) = unit else {
        let message = format!("the column `{name}` has no unit in brackets");
        return Err(Box::new(head.error_here(Code::TABLE, message).help(EXAMPLE)));
    };
    let start = head.span().start + (inside.as_ptr() as usize - head.text().as_ptr() as usize);
    let unit = Unit::parse(inside).map_err(|error| error.at(head.source(), start))?;
    if !unit.dimension().fits(&Dimension::LENGTH) {
        let message = format!("the column `{name}` measures {}", unit.dimension());
        let help = "all columns with units are lengths, such as `[mm]`";
        return Err(Box::new(head.error_here(Code::WRONG_UNIT, message).help(help)));
    }
    Ok((Column::Length(length, unit), name.to_owned()))
}

fn row(line: &[Located], columns: &[Column], decimal: char) -> Result<RowDraft, Box<Diagnostic>> {
    if line.len() > columns.len() {
        let message = format!("a row has {} cells, and this has {}", columns.len(), line.len());
        let help =
            "separate cells by a comma, a semicolon or a tab, and write numbers with a point";
        return Err(Box::new(line[columns.len()].error_here(Code::TABLE, message).help(help)));
    }
    let (lengths, texts) = (BTreeMap::new(), BTreeMap::new());
    let mut own = RowDraft { place: whole(line), lengths, texts, is_read: true };
    for (cell, column) in line.iter().zip(columns).filter(|(cell, _)| !cell.text().is_empty()) {
        match column {
            Column::Text(name) => {
                own.texts.insert(name, cell.clone());
            }
            Column::Length(name, unit) => {
                let Some(number) = columns::number(cell.text(), decimal) else {
                    let message =
                        format!("expected a number, found `{}`", cell.text().escape_debug());
                    let help = columns::as_numbers_are(decimal);
                    return Err(Box::new(cell.error_here(Code::TABLE, message).help(help)));
                };
                own.lengths.insert(name, (unit.to_si(number), cell.clone()));
            }
        }
    }
    Ok(own)
}

/// The whole line.
fn whole(line: &[Located]) -> Located {
    let (first, last) = (&line[0], &line[line.len() - 1]);
    let span = first.span().start..last.span().end;
    let text = first.source().text[span.clone()].to_owned();
    Located::new(first.source(), span, text)
}
