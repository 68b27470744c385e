//! Tables that a case names: two columns of numbers in a file beside it, with a line of names and units above them.

use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Located, Source};
use whirl_codegen::document::Table;
use whirl_codegen::units::{Dimension, Unit};

use super::library::FileStore;

/// Most bytes of a file, and most rows.
const LONGEST: usize = 8 << 20;
const MOST_ROWS: usize = 100_000;
/// Errors of one file that are shown.
const MOST_ERRORS: usize = 8;

/// Two columns in SI; the first one rises.
#[derive(Debug, Clone)]
pub(crate) struct Columns {
    /// The file.
    pub(crate) source: Arc<Source>,
    /// Where the case names it.
    pub(crate) name: Located,
    /// What the columns measure: each one of those that were allowed.
    pub(crate) measures: [Dimension; 2],
    /// At least two.
    pub(crate) rows: Vec<[f64; 2]>,
    /// Where each value stands in the file.
    places: Vec<[Located; 2]>,
}

/// The file that a key names, if it is right; `allowed`: what each column may measure. What is wrong is noted.
pub(super) fn read(
    store: FileStore,
    table: &Table,
    key: &str,
    allowed: [&[Dimension]; 2],
) -> Option<Arc<Columns>> {
    let name = table.optional_string(key)?;
    let source = store.read_named(table, &name)?;
    match parse(&source, &name, allowed) {
        Ok(columns) => Some(Arc::new(columns)),
        Err(errors) => {
            errors.into_iter().for_each(|error| table.push(error));
            None
        }
    }
}

fn parse(
    source: &Arc<Source>,
    name: &Located,
    allowed: [&[Dimension]; 2],
) -> Result<Columns, Vec<Diagnostic>> {
    let shown = name.text();
    let refuse = |message: String| vec![Diagnostic::new(source, Code::LIMIT, None, message)];
    let lines = lines(source).map_err(|error| vec![*error])?;
    let example = example(allowed);
    let Some((heads, lines)) = lines.split_first() else {
        let message = format!("`{shown}` is empty");
        return Err(vec![name.error_here(Code::TABLE, message).help(example)]);
    };
    if lines.len() > MOST_ROWS {
        return Err(refuse(format!("a table has at most {MOST_ROWS} rows")));
    }
    let units = units(heads, allowed, &example).map_err(|error| vec![*error])?;
    let decimal = decimal(heads, lines, |_| true);
    let (mut rows, mut places) = (Vec::with_capacity(lines.len()), Vec::new());
    let mut errors: Vec<Diagnostic> = Vec::new();
    for line in lines {
        if errors.len() == MOST_ERRORS {
            break;
        }
        match row(line, &units, decimal) {
            Ok(row) => {
                let before: Option<&[f64; 2]> = rows.last();
                if before.is_some_and(|before| row[0] <= before[0]) {
                    let message = format!(
                        "the first column of a table rises from row to row, but {} follows {}",
                        line[0].text(),
                        places.last().map_or("", |place: &[Located; 2]| place[0].text())
                    );
                    let help = "sort the rows, and give each value once";
                    errors.push(line[0].error_here(Code::TABLE, message).help(help));
                }
                rows.push(row);
                places.push([line[0].clone(), line[1].clone()]);
            }
            Err(error) => errors.push(*error),
        }
    }
    if errors.is_empty() && rows.len() < 2 {
        let message = format!(
            "`{shown}` has {} of numbers, and a table has two at least",
            match rows.len() {
                0 => "no row".to_owned(),
                _ => "one row".to_owned(),
            }
        );
        errors.push(name.error_here(Code::TABLE, message).help(example));
    }
    let measures = units.map(|(_, dimension)| dimension);
    let columns = Columns { source: source.clone(), name: name.clone(), measures, rows, places };
    if errors.is_empty() { Ok(columns) } else { Err(errors) }
}

/// The cells of all lines that have some; what follows a `#` is left out.
pub(super) fn lines(source: &Arc<Source>) -> Result<Vec<Vec<Located>>, Box<Diagnostic>> {
    if source.text.len() > LONGEST {
        let message = format!("a table is at most {LONGEST} bytes long");
        return Err(Box::new(Diagnostic::new(source, Code::LIMIT, None, message)));
    }
    let mut lines = Vec::new();
    let mut start = 0;
    // What separates the names separates all numbers: in another line a comma may be a decimal one.
    let mut separator = None;
    for line in source.text.split_inclusive('\n') {
        let comment = outside_quotes(line).into_iter().find(|own| own.1 == '#');
        let text = line[..comment.map_or(line.len(), |own| own.0)].trim_end();
        start += line.len();
        // How a spreadsheet tells another one what separates the cells.
        let told = text.trim_matches(['\u{feff}', ' ', '"']).to_ascii_lowercase();
        if let (true, Some(told)) = (lines.is_empty(), told.strip_prefix("sep=")) {
            separator = told.chars().next();
            continue;
        }
        let places = outside_quotes(text);
        let stands = |c: &char| places.iter().any(|own| own.1 == *c);
        separator = separator.or_else(|| [';', '\t', ','].into_iter().find(stands));
        let line_of_cells = cells(source, (text, start - line.len()), (&places, separator));
        // A spreadsheet ends with lines of separators alone.
        if line_of_cells.iter().any(|cell| !cell.text().is_empty()) {
            lines.push(line_of_cells);
        }
    }
    Ok(lines)
}

/// How the numbers in these columns of a file are written: with a comma where some are, if no comma separates columns, none has a
/// point, and not all could be thousands.
pub(super) fn decimal(
    heads: &[Located],
    lines: &[Vec<Located>],
    is_number: impl Fn(usize) -> bool,
) -> char {
    let between = heads
        .first()
        .zip(heads.get(1))
        .map(|(first, second)| &first.source().text[first.span().end..second.span().start]);
    let cells = || {
        let places = lines.iter().flat_map(|line| line.iter().enumerate());
        places.filter(|own| is_number(own.0)).map(|(_, cell)| cell.text())
    };
    let with = |mark: char| {
        cells().filter(move |cell| cell.contains(mark) && number(cell, mark).is_some())
    };
    let thousands = |cell: &str| {
        let (whole, rest) = cell.split_once(',').unwrap_or((cell, ""));
        let whole = whole.trim_start_matches(['-', '+', '0']);
        !whole.is_empty() && rest.len() == 3 && rest.bytes().all(|own| own.is_ascii_digit())
    };
    let may = between.is_some_and(|own| !own.contains(','));
    if may && with('.').next().is_none() && !with(',').all(thousands) { ',' } else { '.' }
}

/// How a number is to be written.
pub(super) fn as_numbers_are(decimal: char) -> &'static str {
    match decimal {
        ',' => "write numbers with a decimal comma, as the others are, such as `0,035`",
        _ => "write numbers with a point, such as `0.035` or `3.5e-2`",
    }
}

/// The number in a cell; none that is not finite.
pub(super) fn number(cell: &str, decimal: char) -> Option<f64> {
    let number = match decimal {
        ',' if cell.contains('.') => return None,
        ',' => cell.replace(',', ".").parse::<f64>(),
        _ => cell.parse::<f64>(),
    };
    number.ok().filter(|number| number.is_finite())
}

/// How a file may begin.
fn example(allowed: [&[Dimension]; 2]) -> String {
    let head = |all: &[Dimension]| {
        let written = |dimension: &Dimension| match dimension {
            own if *own == Dimension::TIME => "time [s]",
            own if *own == Dimension::ANGLE => "angle [deg]",
            own if *own == Dimension::ANGULAR_SPEED => "speed [rpm]",
            own if *own == Dimension::FORCE => "force [N]",
            own if *own == Dimension::TORQUE => "couple [N*m]",
            own if *own == Dimension::TEMPERATURE => "temperature [K]",
            own if *own == Dimension::VISCOSITY => "viscosity [mPa*s]",
            own if *own == Dimension::LENGTH => "depth [um]",
            _ => "factor [1]",
        };
        all.iter().map(written).collect::<Vec<&str>>().join("` or `")
    };
    let [first, second] = allowed.map(head);
    format!("its first line names two columns with their units: `{first}`, and `{second}`")
}

/// The cells of a line that starts at a byte of the file. A cell in double quotes is one, whatever stands in it; a quote in it
/// is written twice.
fn cells(
    source: &Arc<Source>,
    (line, start): (&str, usize),
    (places, separator): (&[(usize, char)], Option<char>),
) -> Vec<Located> {
    let mut ends: Vec<usize> =
        places.iter().filter(|own| Some(own.1) == separator).map(|own| own.0).collect();
    // A separator at the end of a line begins no column.
    if ends.len() < 2 || ends.last().is_none_or(|last| !line[last + 1..].trim().is_empty()) {
        ends.push(line.len());
    }
    let mut first = 0;
    let pieces = ends.into_iter().map(|end| {
        let piece = &line[first..end];
        first = end + 1;
        piece
    });
    let located = |piece: &str| {
        let text = piece.trim_matches(|c: char| c.is_whitespace() || c == '"' || c == '\u{feff}');
        let at = start + (text.as_ptr() as usize - line.as_ptr() as usize);
        Located::new(source, at..at + text.len(), text.replace("\"\"", "\""))
    };
    pieces.map(located).collect()
}

/// The characters of a line that stand in no quotes, with their places; quotes begin where a cell does.
fn outside_quotes(line: &str) -> Vec<(usize, char)> {
    let (mut is_quoted, mut begins) = (false, true);
    let mut places = Vec::new();
    for (at, own) in line.char_indices() {
        match own {
            '"' if is_quoted => is_quoted = false,
            // The second of two quotes within a cell goes on with it.
            '"' if begins || line[..at].ends_with('"') => is_quoted = true,
            _ if !is_quoted => places.push((at, own)),
            _ => {}
        }
        let is_blank = own == ' ' || own == '\u{feff}';
        begins = if is_blank { begins } else { [';', '\t', ','].contains(&own) && !is_quoted };
    }
    places
}

/// The units of both columns, and what they measure.
fn units(
    heads: &[Located],
    allowed: [&[Dimension]; 2],
    example: &str,
) -> Result<[(Unit, Dimension); 2], Box<Diagnostic>> {
    let [first, second] = heads else {
        let what = match heads.len() {
            1 => "one column".to_owned(),
            many => format!("{many} columns"),
        };
        let message = format!("a table has two columns, and its line of names has {what}");
        return Err(Box::new(heads[0].error_here(Code::TABLE, message).help(example)));
    };
    Ok([unit(first, allowed[0], example)?, unit(second, allowed[1], example)?])
}

fn unit(
    head: &Located,
    allowed: &[Dimension],
    example: &str,
) -> Result<(Unit, Dimension), Box<Diagnostic>> {
    let inside = head.text().split_once('[').and_then(|(_, rest)| rest.split_once(']'));
    let Some((inside, _)) = inside else {
        let message = format!("the column `{}` has no unit in brackets", head.text());
        return Err(Box::new(head.error_here(Code::TABLE, message).help(example)));
    };
    let start = head.span().start + (inside.as_ptr() as usize - head.text().as_ptr() as usize);
    let unit = Unit::parse(inside).map_err(|error| error.at(head.source(), start))?;
    let found = allowed.iter().find(|wanted| unit.dimension().fits(wanted));
    let Some(dimension) = found else {
        let message = format!("the column `{}` measures {}", head.text(), unit.dimension());
        return Err(Box::new(head.error_here(Code::WRONG_UNIT, message).help(example)));
    };
    Ok((unit, *dimension))
}

fn row(
    line: &[Located],
    units: &[(Unit, Dimension); 2],
    decimal: char,
) -> Result<[f64; 2], Box<Diagnostic>> {
    let [first, second] = line else {
        let count = line.len();
        let message = format!(
            "a row has two values, this has {count}{}",
            if count == 1 { "" } else { ": write numbers with a point" }
        );
        let help = "separate the two values by a comma, a semicolon or a tab";
        return Err(Box::new(line[0].error_here(Code::TABLE, message).help(help)));
    };
    let mut values = [0.0; 2];
    for ((value, cell), (unit, _)) in values.iter_mut().zip([first, second]).zip(units) {
        let Some(number) = number(cell.text(), decimal) else {
            let shown = cell.text().escape_debug();
            let message = format!("expected a number, found `{shown}`");
            let help = as_numbers_are(decimal);
            return Err(Box::new(cell.error_here(Code::TABLE, message).help(help)));
        };
        *value = unit.to_si(number);
        if !value.is_finite() {
            let message = format!("`{}` is beyond all numbers in SI units", cell.text());
            return Err(Box::new(cell.error_here(Code::TABLE, message)));
        }
    }
    Ok(values)
}

/// Of two values the one that is farther from zero, the first of equal ones.
pub(crate) fn farther(first: f64, second: f64) -> f64 {
    if second.abs() > first.abs() { second } else { first }
}

impl Columns {
    /// The largest value of the second column, whatever its sign.
    pub(crate) fn largest(&self) -> f64 {
        self.rows.iter().fold(0.0, |most: f64, row| most.max(row[1].abs()))
    }

    /// The same of all that is there from x = 0 to `end`, on straight lines between rows, with its sign.
    pub(crate) fn farthest_upto(&self, end: f64) -> f64 {
        let within = self.rows.iter().filter(|row| (0.0..=end).contains(&row[0]));
        let ends = [0.0, end].map(|x| self.at(x));
        within.map(|row| row[1]).chain(ends).fold(0.0, farther)
    }

    /// The last value, where it is there from some x up to `end` on.
    pub(crate) fn constant_before(&self, end: f64) -> Option<f64> {
        let [.., last] = *self.rows.last()?;
        let same = self.rows.iter().rev().take_while(|row| row[1] == last);
        same.last().filter(|row| row[0] <= end).map(|_| last)
    }

    /// The value at x, on straight lines between rows; beyond them that of the nearest.
    fn at(&self, x: f64) -> f64 {
        let after = self.rows.partition_point(|row| row[0] <= x);
        let (Some(from), Some(to)) = (self.rows[..after].last(), self.rows.get(after)) else {
            return self.rows[after.min(self.rows.len() - 1)][1];
        };
        from[1] + (to[1] - from[1]) * (x - from[0]) / (to[0] - from[0])
    }

    /// From the first row to the last one: the period of a table that is periodic.
    pub(crate) fn span(&self) -> f64 {
        self.rows[self.rows.len() - 1][0] - self.rows[0][0]
    }

    /// Notes rows that do not span one period, or that do not end with the value with which they begin.
    pub(super) fn closes(&self, table: &Table, period: f64, written: &Located) -> bool {
        let (first, last) = (0, self.rows.len() - 1);
        let [from, to] = [first, last].map(|row| &self.places[row]);
        if (self.span() / period - 1.0).abs() > 1e-9 {
            let message = format!(
                "the rows of `{}` go from {} to {}, which is not one `period`",
                self.name.text(),
                from[0].text(),
                to[0].text()
            );
            let help = "give the rows of one period, both ends included, or correct `period`";
            table.push(written.error_here(Code::TABLE, message).help(help));
            return false;
        }
        let [begins, ends] = [first, last].map(|row| self.rows[row][1]);
        if (ends - begins).abs() > 1e-9 * self.largest() {
            let message = format!(
                "a periodic table ends with the value with which it begins: {}, not {}",
                from[1].text(),
                to[1].text()
            );
            let help = "correct the last row, or leave `period` out";
            table.push(to[1].error_here(Code::TABLE, message).help(help));
            return false;
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use whirl_codegen::diagnostic::Source;

    use super::{decimal, lines, number};

    #[test]
    fn a_comma_is_a_decimal_one_where_nothing_else_can_be_meant() {
        let of = |text: &str| {
            let source = Source::new("rotor.csv", text);
            let found = lines(&source).expect("a table");
            decimal(&found[0], &found[1..], |column| column < 2)
        };
        assert_eq!(of("sep=;\nlength [mm];outer [mm]\n100,5;50\n"), ',');
        assert_eq!(of("length [mm]\touter [mm]\n100\t1,5e2\n"), ',');
        // Mixed, none, or thousands in quotes.
        assert_eq!(of("length [mm];outer [mm]\n100,5;50.5\n"), '.');
        assert_eq!(of("length [mm];outer [mm]\n100;50\n"), '.');
        assert_eq!(of("length [mm];outer [mm]\n1,200;50\n"), '.');
        assert_eq!(of("length [mm];outer [mm]\n1,200;0,050\n"), ',');
        // A comma is no separator where semicolons are.
        let cut = Source::new("rotor.csv", "time [s];speed [rad/s]\n0,5;300\n1,5\n");
        let found = lines(&cut).expect("a table");
        assert_eq!(found.iter().map(Vec::len).collect::<Vec<usize>>(), [2, 2, 1]);
        // The number of a material is none of the table.
        assert_eq!(of("length [mm];outer [mm];material\n100,5;50;1.4301\n"), ',');
        assert_eq!(of("length [mm],outer [mm]\n\"1,000\",50\n"), '.');
        let numbers = [("1,5", ','), ("1.5", ','), ("1,2,3", ','), ("1,5", '.'), ("inf", '.')];
        let found = numbers.map(|(cell, decimal)| number(cell, decimal));
        assert_eq!(found, [Some(1.5), None, None, None, None]);
    }

    #[test]
    fn a_cell_in_quotes_is_one_cell() {
        let text = "\u{feff}\"length [mm]\", outer [mm],name # of the drawing\n\
                    100, 50,\"a, b # 1; c\"\n400,60, \"3\"\" pipe\"\n5, 6, 3\" pipe\n7,8,\n\"\",1,2\n";
        let source = Source::new("rotor.csv", text);
        let found = lines(&source).expect("a table");
        let texts: Vec<Vec<&str>> =
            found.iter().map(|line| line.iter().map(|cell| cell.text()).collect()).collect();
        let expected: [&[&str]; 6] = [
            &["length [mm]", "outer [mm]", "name"],
            &["100", "50", "a, b # 1; c"],
            &["400", "60", "3\" pipe"],
            &["5", "6", "3\" pipe"],
            &["7", "8"],
            &["", "1", "2"],
        ];
        assert_eq!(texts, expected);
        // Places are those in the file.
        let cell = &found[2][1];
        assert_eq!(&text[cell.span()], "60");
    }
}
