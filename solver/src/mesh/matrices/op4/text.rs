//! Files of text: whole numbers in eight columns, values in fields of the format that the head of a matrix names.

use super::building::{Building, Matrix, Stop};

/// Whole numbers of a head, and of one with sizes of 16 digits.
const WIDTHS: [[usize; 4]; 2] = [[8, 8, 8, 8], [16, 16, 8, 8]];
/// Of a name.
const NAME: usize = 8;
/// The end of a head with sizes of 16 digits.
const WIDE: &str = "|I16";
/// Values of a line, and columns of a value, where the head names no format.
const USUAL: (usize, usize) = (5, 16);

/// What the line of a head says.
struct Head<'t> {
    numbers: [i64; 4],
    name: &'t str,
    /// Values of a line, columns of a value.
    format: (usize, usize),
}

/// Cuts off the first characters of a line.
fn cut<'t>(line: &mut &'t str, width: usize) -> &'t str {
    let at = width.min(line.len());
    let (own, rest) = if line.is_char_boundary(at) { line.split_at(at) } else { ("", *line) };
    *line = rest;
    own.trim()
}

fn head(line: &str) -> Option<Head<'_>> {
    let line = line.trim_end();
    let wide = line.strip_suffix(WIDE);
    let mut rest = wide.unwrap_or(line).trim_end();
    let widths = WIDTHS[usize::from(wide.is_some())];
    let mut numbers = [0; 4];
    for (number, width) in numbers.iter_mut().zip(widths) {
        *number = cut(&mut rest, width).parse().ok()?;
    }
    let name = cut(&mut rest, NAME);
    let letters = name.starts_with(|c: char| c.is_ascii_alphabetic());
    if !letters || !name.bytes().all(|c| c.is_ascii_alphanumeric() || c == b'_') {
        return None;
    }
    let format = match rest.trim() {
        "" => USUAL,
        words => {
            let words = words.to_ascii_uppercase();
            let words = words.trim_start_matches("1P").trim_start_matches(',').trim();
            let (count, rest) = words.split_once(['E', 'D'])?;
            let width = rest.split('.').next()?.trim().parse().ok()?;
            let count = if count.trim().is_empty() { 1 } else { count.trim().parse().ok()? };
            (count, width)
        }
    };
    let likely = (1..=100).contains(&format.0) && (3..=100).contains(&format.1);
    likely.then_some(Head { numbers, name, format })
}

/// Whether a text begins with the head of a matrix.
pub(super) fn is_head(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(200)];
    let line = start.split(|byte| *byte == b'\n').next().unwrap_or_default();
    std::str::from_utf8(line).is_ok_and(|line| head(line).is_some())
}

struct Lines<'t> {
    rest: &'t str,
    /// Of the last one, from 1.
    number: usize,
}

impl<'t> Lines<'t> {
    fn next(&mut self, what: &str) -> Result<&'t str, Stop> {
        if self.rest.is_empty() {
            let what = format!("the file ends where {what} should stand");
            return Err(Stop { line: self.number, what });
        }
        let (line, rest) = self.rest.split_once('\n').unwrap_or((self.rest, ""));
        self.rest = rest;
        self.number += 1;
        Ok(line.strip_suffix('\r').unwrap_or(line))
    }

    /// The whole numbers of the next line.
    fn whole<const N: usize>(&mut self, what: &str) -> Result<[i64; N], Stop> {
        let line = self.next(what)?;
        let words: Vec<&str> = line.split_whitespace().collect();
        let mut rest = line;
        // Numbers of eight digits have no blank between them.
        let words =
            if words.len() == N { words } else { (0..N).map(|_| cut(&mut rest, 8)).collect() };
        let numbers: Option<Vec<i64>> = words.iter().map(|own| own.parse().ok()).collect();
        numbers.and_then(|own| own.try_into().ok()).ok_or_else(|| self.expected(what, line))
    }

    fn expected(&self, what: &str, line: &str) -> Stop {
        let shown: String = line.trim().chars().take(40).collect();
        let what = format!("{what} should stand here, not `{}`", shown.escape_debug());
        Stop { line: self.number, what }
    }

    /// So many values in fields, with their lines.
    fn values(
        &mut self,
        count: usize,
        (of_line, width): (usize, usize),
    ) -> Result<Vec<(f64, usize)>, Stop> {
        // A file cannot have more values than characters.
        let mut values = Vec::with_capacity(count.min(self.rest.len()));
        while values.len() < count {
            let line = self.next("the values of a column")?;
            let mut rest = line;
            for _ in 0..of_line.min(count - values.len()) {
                let value = real(cut(&mut rest, width));
                let value = value.ok_or_else(|| self.expected("the values of a column", line))?;
                values.push((value, self.number));
            }
            if !rest.trim().is_empty() {
                return Err(self.expected("the rest of the values of a column", line));
            }
        }
        Ok(values)
    }
}

/// A number of Fortran: with an exponent of E or D, or of a sign alone.
fn real(text: &str) -> Option<f64> {
    let plain = text.bytes().all(|c| c.is_ascii_digit() || b"+-.eEdD".contains(&c));
    if !plain || text.is_empty() {
        return None;
    }
    let text = text.replace(['D', 'd'], "E");
    if let Ok(value) = text.parse() {
        return Some(value);
    }
    let sign = text.rfind(['+', '-']).filter(|at| *at > 0)?;
    format!("{}E{}", &text[..sign], &text[sign..]).parse().ok()
}

/// All matrices of a file.
pub(super) fn matrices(bytes: &[u8]) -> Result<Vec<Matrix>, Stop> {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = Lines { rest: &text, number: 0 };
    let mut all = Vec::new();
    while !lines.rest.trim().is_empty() {
        let line = lines.next("the head of a matrix")?;
        if line.trim().is_empty() {
            continue;
        }
        let Some(Head { numbers, name, format }) = head(line) else {
            return Err(lines.expected("the head of a matrix", line));
        };
        let mut own = Building::new(numbers, name, lines.number, 2)?;
        while column(&mut lines, &mut own, format)? {}
        all.push(own.matrix);
    }
    Ok(all)
}

/// Takes the next column; false where it is behind the last one.
fn column(lines: &mut Lines, own: &mut Building, format: (usize, usize)) -> Result<bool, Stop> {
    let [column, row, mut words] = lines.whole("the head of a column")?;
    if own.column(column, lines.number)?.is_none() {
        // Its value says nothing.
        lines.next("the last value of a matrix")?;
        return Ok(false);
    }
    if row != 0 {
        // Of runs Nastran counts the values, not the words.
        let at = lines.number;
        let count = usize::try_from(words).ok().filter(|own| *own > 0).ok_or_else(|| Stop {
            line: at,
            what: format!("column {column} of {} has {words} values", own.matrix.name),
        })?;
        let values = lines.values(count, format)?;
        own.values(row, values.into_iter(), at)?;
        return Ok(true);
    }
    while words > 0 {
        let (first, second) = match own.big {
            true => {
                let [length, row] = lines.whole("length and row of a string")?;
                (length, Some(row))
            }
            false => {
                let [packed] = lines.whole("the packed length and row of a string")?;
                (packed, None)
            }
        };
        let at = lines.number;
        let (length, row, taken) = own.string(first, second);
        words = words.saturating_sub(taken);
        if words < 0 || taken <= 0 {
            let what = format!(
                "a string of column {column} of {} is longer than the column",
                own.matrix.name
            );
            return Err(Stop { line: at, what });
        }
        let count = own.count(length, at)?;
        let values = lines.values(count, format)?;
        own.values(row, values.into_iter(), at)?;
    }
    Ok(true)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_fortran_have_many_exponents() {
        assert_eq!(real("1.5D+03"), Some(1500.0));
        assert_eq!(real("-1.5-103"), Some(-1.5e-103));
        assert_eq!(real("2.5+2"), Some(250.0));
        for bad in ["", "nan", "inf", "x", "1.0 2", "-", "1e", "--1"] {
            assert_eq!(real(bad), None, "{bad}");
        }
    }

    #[test]
    fn heads_name_sizes_and_formats() {
        let own = head("      31     -25       2       2RMAT    1P,5E16.9").expect("a head");
        assert_eq!((own.numbers, own.name, own.format), ([31, -25, 2, 2], "RMAT", (5, 16)));
        let own = head("              31             -25       6       2KAA     1P,3D23.16|I16")
            .expect("a head");
        assert_eq!((own.numbers, own.name, own.format), ([31, -25, 6, 2], "KAA", (3, 23)));
        for bad in [
            "",
            "1 1 1",
            "       1       1       1       1",
            "1, 1, 1, 1, 2.5",
            "%%MatrixMarket matrix array real general",
        ] {
            assert!(head(bad).is_none(), "{bad}");
        }
    }
}
