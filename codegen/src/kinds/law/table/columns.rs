//! Files of columns: numbers separated by commas, semicolons, tabs or blanks, with an optional line of names.

use std::ops::Range;
use std::sync::Arc;

use crate::rational::Rational;

use crate::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source, suggest};
use crate::units::{Unit, decimal};

/// Most bytes of a file, and most rows: every row costs a comparison and five choices in the kernel.
const LONGEST: usize = 32 * 1024;
pub(super) const MOST_ROWS: usize = 128;
/// How to fix a line of too many values.
const POINTS: &str =
    "write numbers with a point, as `0.5`; commas separate columns, unless `;` does";
/// Errors of one column that are shown.
const MOST_ERRORS: usize = 8;

/// A file of columns, split into cells.
pub struct Columns {
    source: Arc<Source>,
    heads: Option<Vec<Head>>,
    rows: Vec<Vec<Range<usize>>>,
    /// Whether numbers are written with a decimal comma.
    comma: bool,
}

/// A cell of the line of names, such as `gap [um]`.
struct Head {
    name: String,
    /// Between the brackets.
    unit: Option<Located>,
    span: Range<usize>,
}

/// A column that a law or a case names.
pub struct Wanted {
    /// Which.
    pub column: Which,
    /// Where it is named.
    pub place: Located,
    /// The unit that is named with it.
    pub unit: Option<Unit>,
}

/// How a column is named.
pub enum Which {
    /// By what stands above it.
    Named(String),
    /// From 0.
    Numbered(usize),
}

/// A column that was read.
pub struct Column {
    /// Its unit.
    pub unit: Unit,
    /// What stands above it, if anything does.
    pub head: Option<Range<usize>>,
    /// Values with their places, in the unit of the column.
    pub values: Vec<(Rational, Range<usize>)>,
}

impl Columns {
    /// The file of a table of a law.
    pub(super) fn read(source: &Arc<Source>) -> Result<Self, Diagnostics> {
        Columns::read_as((MOST_ROWS, LONGEST), false, source)
    }

    /// A file of so many rows and bytes at most, as instruments and spreadsheets write them: with decimal commas, too, where no comma
    /// separates columns.
    ///
    /// # Errors
    /// One that is longer, has fewer than two rows, or a line with more values than columns.
    pub fn read_at_most(source: &Arc<Source>, limits: (usize, usize)) -> Result<Self, Diagnostics> {
        Columns::read_as(limits, true, source)
    }

    /// `commas`: whether numbers may have decimal commas.
    fn read_as(
        (rows, longest): (usize, usize),
        commas: bool,
        source: &Arc<Source>,
    ) -> Result<Self, Diagnostics> {
        let refuse = |message: String| Diagnostic::new(source, Code::LIMIT, None, message);
        if source.text.len() > longest {
            return Err(refuse(format!("a table is at most {longest} bytes long")).into());
        }
        let mut lines = Vec::new();
        let mut start = 0;
        for line in source.text.split_inclusive('\n') {
            let text = line.trim_start_matches('\u{feff}');
            let offset = start + line.len() - text.len();
            start += line.len();
            let text = without_comment(text).trim_end();
            let line = cells(text, offset);
            // A spreadsheet ends with lines of separators alone.
            if line.iter().any(|cell| !cell.is_empty()) {
                lines.push(line);
            }
        }
        let cells = lines.iter().flatten().map(|cell| &source.text[cell.clone()]);
        let comma = commas && has_decimal_commas(cells);
        let is_number = |cell: &Range<usize>| written(&source.text[cell.clone()], comma).is_some();
        let headed = lines.first().is_some_and(|first| !first.iter().any(is_number));
        let heads = headed.then(|| {
            let first = lines.remove(0);
            first.into_iter().map(|span| Head::read(source, span)).collect()
        });
        if !(2..=rows).contains(&lines.len()) {
            let count = lines.len();
            let message = format!("a table has 2 to {rows} rows of numbers, this has {count}");
            let help = "what stays the same takes two rows with equal values";
            return Err(refuse(message).maybe_help((count < 2).then(|| help.to_owned())).into());
        }
        let columns = Columns { source: source.clone(), heads, rows: lines, comma };
        columns.check_lengths()?;
        columns.check_names()?;
        Ok(columns)
    }

    fn error(&self, span: Range<usize>, message: String) -> Diagnostic {
        Diagnostic::new(&self.source, Code::TABLE, span, message)
    }

    /// A value without a column would be read as that of another, as those of `0,0, 230,5` are.
    fn check_lengths(&self) -> Result<(), Diagnostics> {
        let (most, named) = match &self.heads {
            Some(heads) => (heads.len(), true),
            None => (self.rows.first().map_or(0, Vec::len), false),
        };
        let mut errors = Diagnostics::new();
        for row in self.rows.iter().filter(|row| row.len() > most).take(MOST_ERRORS) {
            let span = row[0].start..row[row.len() - 1].end;
            let s = if most == 1 { "" } else { "s" };
            let says = match named {
                true => format!("the line of names has {most} column{s}"),
                false => format!("the first line has {most}"),
            };
            let message = format!("this line has {} values, but {says}", row.len());
            errors.push(self.error(span, message).help(POINTS));
        }
        errors.into_result(())
    }

    /// Of two columns of one name either could be meant.
    fn check_names(&self) -> Result<(), Diagnostics> {
        let heads = self.heads.as_deref().unwrap_or_default();
        let mut errors = Diagnostics::new();
        for (place, head) in heads.iter().enumerate() {
            if !head.name.is_empty() && heads[..place].iter().any(|other| other.name == head.name) {
                let message = format!("two columns are called `{}`", head.name);
                let help = "give each column a name of its own";
                errors.push(self.error(head.span.clone(), message).help(help));
            }
        }
        errors.into_result(())
    }

    /// Columns, if there are no names above them.
    pub(super) fn unnamed(&self) -> Option<usize> {
        self.heads.is_none().then(|| self.rows.iter().map(Vec::len).max().unwrap_or(0))
    }

    /// Whether a line of names stands above the numbers.
    pub fn is_named(&self) -> bool {
        self.heads.is_some()
    }

    /// Whether a column is called so.
    pub fn has(&self, name: &str) -> bool {
        self.heads.iter().flatten().any(|head| head.name == name)
    }

    /// A column with its values.
    ///
    /// # Errors
    /// There is none; it has no unit; or a cell is no number.
    pub fn column(&self, wanted: &Wanted) -> Result<Column, Diagnostics> {
        let place = self.place(wanted)?;
        let unit = self.unit(wanted, place)?;
        let mut errors = Diagnostics::new();
        let mut values = Vec::with_capacity(self.rows.len());
        for row in &self.rows {
            let Some(cell) = row.get(place) else {
                let span = row[0].start..row[row.len() - 1].end;
                let (count, column) = (row.len(), place + 1);
                let s = if count == 1 { "" } else { "s" };
                let message =
                    format!("this line has {count} value{s}, but column {column} is read");
                let help = "write a value for each column, with commas between";
                errors.push(self.error(span, message).help(help));
                continue;
            };
            match written(&self.source.text[cell.clone()], self.comma) {
                Some(value) => values.push((value, cell.clone())),
                None => {
                    let text = self.source.text[cell.clone()].escape_debug().to_string();
                    let message = format!("expected a number, found `{text}`");
                    let error = self.error(cell.clone(), message);
                    errors.push(error.help(match self.comma {
                        true => {
                            "write numbers with a decimal comma, as the others are, such as `0,035`"
                        }
                        false => "write numbers with a point, such as `0.035` or `3.5e-2`",
                    }));
                }
            }
            if errors.len() == MOST_ERRORS {
                break;
            }
        }
        let head = self.heads.as_ref().and_then(|heads| heads.get(place));
        let head = head.map(|head| head.span.clone());
        errors.into_result(Column { unit, head, values })
    }

    fn place(&self, wanted: &Wanted) -> Result<usize, Diagnostics> {
        let shown = self.source.path.display();
        match &wanted.column {
            Which::Numbered(place) => {
                if self.rows.iter().any(|row| *place < row.len()) {
                    return Ok(*place);
                }
                let message = format!("`{shown}` has no column {}", place + 1);
                Err(wanted.place.error_here(Code::TABLE, message).into())
            }
            Which::Named(name) => {
                let Some(heads) = &self.heads else {
                    let message = format!("`{shown}` has no header line");
                    let error = wanted.place.error_here(Code::TABLE, message);
                    let help = "give the number of the column, or write names above the numbers";
                    return Err(error.help(help).into());
                };
                heads.iter().position(|head| head.name == *name).ok_or_else(|| {
                    let known: Vec<&str> = heads.iter().map(|head| head.name.as_str()).collect();
                    let message = format!("`{shown}` has no column `{name}`");
                    let error = wanted.place.error_here(Code::TABLE, message);
                    error.maybe_help(suggest(name, &known)).into()
                })
            }
        }
    }

    fn unit(&self, wanted: &Wanted, place: usize) -> Result<Unit, Diagnostics> {
        let head = self.heads.as_ref().and_then(|heads| heads.get(place));
        let written = head.and_then(|head| head.unit.as_ref());
        match (&wanted.unit, written, head) {
            (Some(unit), Some(text), Some(head)) => match Unit::parse(text.text()) {
                // One of both is wrong, and nobody can tell which.
                Ok(own) if !same(&own, unit) => {
                    let message = format!(
                        "the column `{}` is in `{}` by its name, and in `{}` where it is named",
                        head.name,
                        text.text(),
                        unit.text()
                    );
                    let error = wanted.place.error_here(Code::TABLE, message);
                    Err(error
                        .help("leave the `unit` out, or take it from the line of names")
                        .into())
                }
                _ => Ok(unit.clone()),
            },
            (Some(unit), ..) => Ok(unit.clone()),
            (None, Some(text), _) => Unit::parse(text.text()).map_err(|error| {
                text.error(error.code, error.span, error.message).maybe_help(error.help).into()
            }),
            (None, None, Some(head)) => {
                let message = format!("the column `{}` has no unit", head.name);
                let error = self.error(head.span.clone(), message);
                let help = "write it behind the name, as in `time [s]` or `h [mm]`; a pure number has the unit `[1]`";
                Err(error.help(help).into())
            }
            (None, None, None) => {
                let message = format!("column {} has no unit", place + 1);
                let error = wanted.place.error_here(Code::TABLE, message);
                let help = format!("write `{{ column = {}, unit = \"mm\" }}`", place + 1);
                Err(error.help(help).into())
            }
        }
    }
}

impl Head {
    fn read(source: &Arc<Source>, span: Range<usize>) -> Self {
        let text = &source.text[span.clone()];
        let brackets = [('[', ']'), ('(', ')')].into_iter().find_map(|(open, close)| {
            let start = text.find(open)?;
            let length = text[start + 1..].find(close)?;
            Some((start, start + 1..start + 1 + length))
        });
        let (name, unit) = match brackets {
            Some((end, inside)) => {
                let place = span.start + inside.start..span.start + inside.end;
                (&text[..end], Some(Located::new(source, place, &text[inside])))
            }
            None => (text, None),
        };
        Head { name: name.trim().to_owned(), unit, span }
    }
}

/// Whether two units are one, however they are written.
fn same(one: &Unit, other: &Unit) -> bool {
    one.dimension() == other.dimension()
        && [0.0, 1.0].iter().all(|value| {
            let [a, b] = [one, other].map(|own| own.to_si(*value));
            (a - b).abs() <= 1e-12 * a.abs().max(b.abs())
        })
}

/// The cells of a line that starts at byte `offset`, without the blanks and quotes around them.
fn cells(line: &str, offset: usize) -> Vec<Range<usize>> {
    // Where `;` separates columns, commas stand in numbers, which are refused then.
    let separator = [';', '\t', ','].into_iter().find(|c| line.contains(*c));
    let mut pieces: Vec<&str> = match separator {
        Some(separator) => line.split(separator).collect(),
        None => line.split_whitespace().collect(),
    };
    // A unit in brackets belongs to the name before it.
    if separator.is_none() {
        let joined = |i: usize| pieces.get(i).is_some_and(|next| next.starts_with(['[', '(']));
        let ends: Vec<usize> = (0..pieces.len()).filter(|i| !joined(i + 1)).collect();
        let mut first = 0;
        let mut whole = Vec::new();
        for end in ends {
            let start = part(line, pieces[first]).start;
            whole.push(&line[start..part(line, pieces[end]).end]);
            first = end + 1;
        }
        pieces = whole;
    }
    // A separator at the end of a line begins no column.
    if pieces.len() > 1 && pieces.last().is_some_and(|last| last.trim().is_empty()) {
        pieces.pop();
    }
    let trimmed = pieces.into_iter().map(|piece| {
        let piece = piece.trim().trim_matches('"').trim();
        let Range { start, end } = part(line, piece);
        offset + start..offset + end
    });
    trimmed.collect()
}

/// A line up to a `#` that stands in no quotes.
fn without_comment(line: &str) -> &str {
    let mut quoted = false;
    let comment = line.char_indices().find(|(_, c)| {
        quoted ^= *c == '"';
        *c == '#' && !quoted
    });
    comment.map_or(line, |(at, _)| &line[..at])
}

/// Where a slice of `line` stands in it.
fn part(line: &str, piece: &str) -> Range<usize> {
    let start = piece.as_ptr() as usize - line.as_ptr() as usize;
    start..start + piece.len()
}

/// Whether these cells have decimal commas: numbers with a comma, not all of which could be thousands, and none with a point.
fn has_decimal_commas<'s>(cells: impl Iterator<Item = &'s str> + Clone) -> bool {
    let numbers = |comma: bool, mark: char| {
        cells.clone().filter(move |own| own.contains(mark) && written(own, comma).is_some())
    };
    let thousands = |cell: &str| {
        let (whole, rest) = cell.split_once(',').unwrap_or((cell, ""));
        let whole = whole.trim_start_matches(['-', '+', '0']);
        !whole.is_empty() && rest.len() == 3 && rest.bytes().all(|own| own.is_ascii_digit())
    };
    numbers(false, '.').next().is_none() && !numbers(true, ',').all(thousands)
}

/// The number in a cell, which may have a decimal comma.
fn written(text: &str, comma: bool) -> Option<Rational> {
    match comma {
        true if text.contains('.') => None,
        true => number(&text.replace(',', ".")),
        false => number(text),
    }
}

/// A decimal number with an optional sign; programs write `.5` and `2.`, too.
fn number(text: &str) -> Option<Rational> {
    let unsigned = text.strip_prefix(['-', '+']).unwrap_or(text);
    let are_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let unsigned = &match unsigned.split_once('.') {
        Some(("", rest)) => format!("0.{rest}"),
        Some((whole, rest))
            if are_digits(whole) && (rest.is_empty() || rest.starts_with(['e', 'E'])) =>
        {
            format!("{whole}{rest}")
        }
        _ => unsigned.to_owned(),
    };
    let (value, length) = decimal(unsigned)?;
    let value = value.filter(|_| length == unsigned.len())?;
    Some(if text.starts_with('-') { -value } else { value })
}
