//! A table of numbers and texts.

use std::io::{self, Write};
use std::ops::Range;

use super::foot::{BYTES, Column, DOUBLE, Group, MAGIC, foot, page_head};

/// Values of one column in a group of rows.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Values {
    /// Whole numbers.
    Whole(Vec<i64>),
    /// Numbers; what is missing is NaN.
    Numbers(Vec<f64>),
    /// UTF-8.
    Texts(Vec<String>),
}

impl Values {
    /// `Type` of the format.
    fn kind(&self) -> i64 {
        match self {
            Values::Whole(_) => 2,
            Values::Numbers(_) => DOUBLE,
            Values::Texts(_) => BYTES,
        }
    }

    /// Those of some rows.
    pub(crate) fn part(&self, rows: Range<usize>) -> Self {
        match self {
            Values::Whole(own) => Values::Whole(own[rows].to_vec()),
            Values::Numbers(own) => Values::Numbers(own[rows].to_vec()),
            Values::Texts(own) => Values::Texts(own[rows].to_vec()),
        }
    }

    /// How many.
    pub(crate) fn count(&self) -> usize {
        match self {
            Values::Whole(own) => own.len(),
            Values::Numbers(own) => own.len(),
            Values::Texts(own) => own.len(),
        }
    }

    /// The encoding `PLAIN`.
    fn plain(&self) -> Vec<u8> {
        match self {
            Values::Whole(own) => own.iter().flat_map(|value| value.to_le_bytes()).collect(),
            Values::Numbers(own) => own.iter().flat_map(|value| value.to_le_bytes()).collect(),
            Values::Texts(own) => {
                let text = |own: &String| {
                    let length = (own.len() as u32).to_le_bytes();
                    length.into_iter().chain(own.bytes()).collect::<Vec<u8>>()
                };
                own.iter().flat_map(text).collect()
            }
        }
    }
}

/// A file that is being written.
pub(crate) struct Parquet<W> {
    to: W,
    /// Bytes so far.
    at: i64,
    names: Vec<String>,
    /// `Type` of each column; that of the last group.
    kinds: Vec<i64>,
    groups: Vec<Group>,
}

impl<W: Write> Parquet<W> {
    /// Of columns with these names.
    ///
    /// # Errors
    /// It cannot be written, here and below.
    pub(crate) fn new(mut to: W, names: Vec<String>) -> io::Result<Self> {
        to.write_all(MAGIC)?;
        Ok(Parquet { to, at: MAGIC.len() as i64, names, kinds: Vec::new(), groups: Vec::new() })
    }

    /// Adds rows: the values of every column, as many of each, of the same kinds in every group.
    pub(crate) fn add(&mut self, columns: &[Values]) -> io::Result<()> {
        self.kinds = columns.iter().map(Values::kind).collect();
        let mut group = Group { rows: 0, columns: Vec::new() };
        for values in columns {
            group.rows = values.count() as i64;
            let page = values.plain();
            let head = page_head(values.count(), page.len());
            self.to.write_all(&head)?;
            self.to.write_all(&page)?;
            let bytes = (head.len() + page.len()) as i64;
            group.columns.push([self.at, bytes]);
            self.at += bytes;
        }
        self.groups.push(group);
        Ok(())
    }

    /// Writes what says where everything is.
    pub(crate) fn finish(mut self, creator: &str) -> io::Result<W> {
        let column = |(name, kind)| Column { name, kind };
        let names = self.names.iter().map(String::as_str);
        let columns: Vec<Column> = names.zip(self.kinds.iter().copied()).map(column).collect();
        self.to.write_all(&foot(&columns, self.groups.into_iter(), None, creator))?;
        self.to.flush()?;
        Ok(self.to)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bytes of a file that pyarrow 26 and DuckDB 2.0 read as written.
    #[test]
    fn a_small_table_has_the_bytes_that_other_programs_read() {
        let mut file =
            Parquet::new(Vec::new(), vec!["n".into(), "x [um]".into(), "word".into()]).unwrap();
        file.add(&[
            Values::Whole(vec![0, 1]),
            Values::Numbers(vec![0.5, f64::NAN]),
            Values::Texts(vec!["µ".into(), String::new()]),
        ])
        .unwrap();
        let bytes = file.finish("whirl").unwrap();
        let found: String = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(found, include_str!("small.parquet.hex").trim());
    }
}
