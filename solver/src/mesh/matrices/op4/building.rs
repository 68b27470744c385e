//! A matrix as it is read, column after column.

use super::super::entries::Entry;

/// Matrices with more rows have the heads of their strings in two numbers.
const BIG: i64 = 65536;

/// Why reading cannot go on.
pub(super) struct Stop {
    /// From 1; 0 in a binary file.
    pub(super) line: usize,
    pub(super) what: String,
}

/// A matrix as it is written.
pub(super) struct Matrix {
    pub(super) name: String,
    /// Of its head.
    pub(super) line: usize,
    pub(super) rows: usize,
    pub(super) columns: usize,
    pub(super) form: i64,
    pub(super) complex: bool,
    pub(super) list: Vec<Entry>,
}

/// What the head of a matrix says, and where its values go.
pub(super) struct Building {
    pub(super) matrix: Matrix,
    pub(super) big: bool,
    /// Words of a value.
    pub(super) words: i64,
    /// Last column and row that were written.
    pub(super) last: (usize, usize),
}

impl Building {
    /// By the numbers of a head; `words` of a real value in double precision.
    pub(super) fn new(
        [columns, rows, form, kind]: [i64; 4],
        name: &str,
        line: usize,
        words: i64,
    ) -> Result<Building, Stop> {
        // In words of eight bytes there are four characters, and blanks.
        let name = name.replace([' ', '\0'], "").to_ascii_uppercase();
        let size = |number: i64| usize::try_from(number).ok().filter(|own| *own > 0);
        let (Some(size_columns), Some(size_rows)) = (size(columns), size(rows.saturating_abs()))
        else {
            let what = format!("{name} has {rows} rows and {columns} columns");
            return Err(Stop { line, what });
        };
        if !(1..=4).contains(&kind) {
            let what = format!("{name} has values of type {kind}, and known are 1 to 4");
            return Err(Stop { line, what });
        }
        let matrix = Matrix {
            name,
            line,
            rows: size_rows,
            columns: size_columns,
            form,
            complex: kind > 2,
            list: Vec::new(),
        };
        let words = if kind % 2 == 0 { words } else { 1 };
        Ok(Building { matrix, big: !(0..BIG).contains(&rows), words, last: (0, 0) })
    }

    /// A column begins; none where it is behind the last one.
    pub(super) fn column(&mut self, column: i64, line: usize) -> Result<Option<usize>, Stop> {
        let own = usize::try_from(column).unwrap_or(0);
        if own == self.matrix.columns.saturating_add(1) {
            return Ok(None);
        }
        if own <= self.last.0 || own > self.matrix.columns {
            let (name, last) = (&self.matrix.name, self.last.0);
            let what = format!(
                "column {column} of {name} stands behind column {last} of {}",
                self.matrix.columns
            );
            return Err(Stop { line, what });
        }
        self.last = (own, 0);
        Ok(Some(own))
    }

    /// Length in words and first row of a string, by the number or the two numbers before it; how many words both take.
    pub(super) fn string(&self, first: i64, second: Option<i64>) -> (i64, i64, i64) {
        match second {
            Some(row) => (first.saturating_sub(1), row, first.saturating_add(1)),
            None => ((first >> 16) - 1, first & 0xffff, first >> 16),
        }
    }

    /// How many real numbers a string of so many words has.
    pub(super) fn count(&self, words: i64, line: usize) -> Result<usize, Stop> {
        let count = usize::try_from(words / self.words).ok().filter(|_| words % self.words == 0);
        count.filter(|own| *own > 0).ok_or_else(|| {
            let what = format!(
                "a string of column {} of {} has {words} words",
                self.last.0, self.matrix.name
            );
            Stop { line, what }
        })
    }

    /// The next values of the column, from a row on; their lines.
    pub(super) fn values(
        &mut self,
        row: i64,
        values: impl Iterator<Item = (f64, usize)>,
        line: usize,
    ) -> Result<(), Stop> {
        let (column, last) = self.last;
        let first = usize::try_from(row).ok().filter(|own| *own > last);
        let Some(first) = first else {
            let what = format!(
                "row {row} of column {column} of {} stands behind row {last}",
                self.matrix.name
            );
            return Err(Stop { line, what });
        };
        let parts = if self.matrix.complex { 2 } else { 1 };
        for (place, (value, line)) in values.enumerate() {
            let row = first + place / parts;
            if row > self.matrix.rows {
                let Matrix { name, rows, .. } = &self.matrix;
                let what = format!("column {column} of {name} goes beyond its {rows} rows");
                return Err(Stop { line, what });
            }
            if !value.is_finite() {
                let what = format!(
                    "row {row} of column {column} of {} is no finite number",
                    self.matrix.name
                );
                return Err(Stop { line, what });
            }
            self.last.1 = row;
            // Zeros within runs are no entries.
            if value != 0.0 && !self.matrix.complex {
                self.matrix.list.push(Entry { row: row - 1, column: column - 1, value, line });
            }
        }
        Ok(())
    }
}
