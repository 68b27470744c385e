//! Parquet, as far as a table of numbers and texts needs it: plain values without compression, every one of them there, in
//! groups of rows. (The `parquet` crate would take longer to compile than the rest of the command.)
//!
//! Source: Apache Parquet format 2.10, parquet.thrift; the compact protocol of Apache Thrift.

use std::io::{self, Write};

/// What a file begins and ends with.
const MAGIC: &[u8] = b"PAR1";
/// Rows of a group.
pub(super) const GROUP: usize = 8192;

/// Values of one column in a group of rows.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Values {
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
            Values::Numbers(_) => 5,
            Values::Texts(_) => 6,
        }
    }

    fn count(&self) -> usize {
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
pub(super) struct Parquet<W> {
    to: W,
    /// Bytes so far.
    at: i64,
    names: Vec<String>,
    /// `Type` of each column; that of the first group.
    kinds: Vec<i64>,
    groups: Vec<Group>,
}

/// Where the columns of a group begin, and how many bytes they have.
struct Group {
    rows: i64,
    columns: Vec<[i64; 2]>,
}

impl<W: Write> Parquet<W> {
    /// Of columns with these names.
    ///
    /// # Errors
    /// It cannot be written, here and below.
    pub(super) fn new(mut to: W, names: Vec<String>) -> io::Result<Self> {
        to.write_all(MAGIC)?;
        Ok(Parquet { to, at: MAGIC.len() as i64, names, kinds: Vec::new(), groups: Vec::new() })
    }

    /// Adds rows: the values of every column, as many of each, of the same kinds in every group.
    pub(super) fn add(&mut self, columns: &[Values]) -> io::Result<()> {
        self.kinds = columns.iter().map(Values::kind).collect();
        let mut group = Group { rows: 0, columns: Vec::new() };
        for values in columns {
            group.rows = values.count() as i64;
            let page = values.plain();
            let mut head = Compact::default();
            head.number(1, I32, 0);
            head.number(2, I32, page.len() as i64);
            head.number(3, I32, page.len() as i64);
            head.structure(5, |data| {
                data.number(1, I32, values.count() as i64);
                data.number(2, I32, 0);
                data.number(3, I32, 3);
                data.number(4, I32, 3);
            });
            let head = head.end();
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
    pub(super) fn finish(mut self, creator: &str) -> io::Result<W> {
        let foot = self.foot(creator);
        self.to.write_all(&foot)?;
        self.to.write_all(&(foot.len() as u32).to_le_bytes())?;
        self.to.write_all(MAGIC)?;
        self.to.flush()?;
        Ok(self.to)
    }

    /// `FileMetaData`.
    fn foot(&self, creator: &str) -> Vec<u8> {
        let mut foot = Compact::default();
        foot.number(1, I32, 1);
        foot.structures(2, 1 + self.kinds.len(), |place, element| match place.checked_sub(1) {
            None => {
                element.text(4, "table");
                element.number(5, I32, self.kinds.len() as i64);
            }
            Some(column) => {
                element.number(1, I32, self.kinds[column]);
                element.number(3, I32, 0);
                element.text(4, &self.names[column]);
                if self.kinds[column] == 6 {
                    element.number(6, I32, 0);
                }
            }
        });
        foot.number(3, I64, self.groups.iter().map(|group| group.rows).sum());
        foot.structures(4, self.groups.len(), |place, group| {
            let own = &self.groups[place];
            group.structures(1, own.columns.len(), |column, chunk| {
                let [start, bytes] = own.columns[column];
                chunk.number(2, I64, start);
                chunk.structure(3, |data| {
                    data.number(1, I32, self.kinds[column]);
                    data.numbers(2, &[0]);
                    data.texts(3, &[&self.names[column]]);
                    data.number(4, I32, 0);
                    data.number(5, I64, own.rows);
                    data.number(6, I64, bytes);
                    data.number(7, I64, bytes);
                    data.number(9, I64, start);
                });
            });
            group.number(2, I64, own.columns.iter().map(|[_, bytes]| bytes).sum());
            group.number(3, I64, own.rows);
        });
        foot.text(6, creator);
        foot.end()
    }
}

const I32: u8 = 5;
const I64: u8 = 6;
const BINARY: u8 = 8;
const LIST: u8 = 9;
const STRUCT: u8 = 12;

/// A structure in the compact protocol of Thrift.
#[derive(Default)]
struct Compact {
    bytes: Vec<u8>,
    last: u8,
}

impl Compact {
    /// Fields rise, by less than sixteen from one to the next.
    fn field(&mut self, field: u8, kind: u8) {
        debug_assert!(field > self.last && field - self.last < 16, "fields rise");
        self.bytes.push((field - self.last) << 4 | kind);
        self.last = field;
    }

    fn varint(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.bytes.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.bytes.push(value as u8);
    }

    fn zigzag(&mut self, value: i64) {
        self.varint((value << 1 ^ value >> 63) as u64);
    }

    fn number(&mut self, field: u8, kind: u8, value: i64) {
        self.field(field, kind);
        self.zigzag(value);
    }

    fn string(&mut self, text: &str) {
        self.varint(text.len() as u64);
        self.bytes.extend(text.bytes());
    }

    fn text(&mut self, field: u8, text: &str) {
        self.field(field, BINARY);
        self.string(text);
    }

    fn list(&mut self, field: u8, count: usize, kind: u8) {
        self.field(field, LIST);
        match count {
            0..15 => self.bytes.push((count as u8) << 4 | kind),
            _ => {
                self.bytes.push(0xf0 | kind);
                self.varint(count as u64);
            }
        }
    }

    fn numbers(&mut self, field: u8, values: &[i64]) {
        self.list(field, values.len(), I32);
        values.iter().for_each(|value| self.zigzag(*value));
    }

    fn texts(&mut self, field: u8, texts: &[&str]) {
        self.list(field, texts.len(), BINARY);
        texts.iter().for_each(|text| self.string(text));
    }

    fn structure(&mut self, field: u8, fill: impl FnOnce(&mut Compact)) {
        self.field(field, STRUCT);
        let mut inner = Compact::default();
        fill(&mut inner);
        self.bytes.extend(inner.end());
    }

    fn structures(&mut self, field: u8, count: usize, mut fill: impl FnMut(usize, &mut Compact)) {
        self.list(field, count, STRUCT);
        for place in 0..count {
            let mut inner = Compact::default();
            fill(place, &mut inner);
            self.bytes.extend(inner.end());
        }
    }

    fn end(mut self) -> Vec<u8> {
        self.bytes.push(0);
        self.bytes
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
