//! A reader of Parquet, of columns of doubles and texts in plain pages, after the format and not after the program.

use std::collections::BTreeMap;
use std::path::Path;

/// What a structure of Thrift holds, in the compact protocol.
#[derive(Debug, Clone)]
enum Held {
    Whole(i64),
    Bytes(Vec<u8>),
    List(Vec<Held>),
    Fields(BTreeMap<i64, Held>),
}

impl Held {
    fn whole(&self) -> i64 {
        let Held::Whole(own) = self else { panic!("{self:?}") };
        *own
    }

    fn text(&self) -> String {
        let Held::Bytes(own) = self else { panic!("{self:?}") };
        String::from_utf8(own.clone()).expect("UTF-8")
    }

    fn list(&self) -> &[Held] {
        let Held::List(own) = self else { panic!("{self:?}") };
        own
    }

    fn has(&self, field: i64) -> Option<&Held> {
        let Held::Fields(own) = self else { panic!("{self:?}") };
        own.get(&field)
    }

    fn field(&self, field: i64) -> &Held {
        self.has(field).unwrap_or_else(|| panic!("{field} of {self:?}"))
    }
}

/// Bytes that are read one after the other.
struct Bytes<'b>(&'b [u8]);

impl Bytes<'_> {
    fn take(&mut self, count: usize) -> &[u8] {
        let (own, left) = self.0.split_at(count);
        self.0 = left;
        own
    }

    fn byte(&mut self) -> u8 {
        self.take(1)[0]
    }

    fn varint(&mut self) -> u64 {
        let (mut value, mut shift) = (0, 0);
        loop {
            let byte = self.byte();
            value |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return value;
            }
            shift += 7;
        }
    }

    fn zigzag(&mut self) -> i64 {
        let value = self.varint();
        (value >> 1) as i64 ^ -((value & 1) as i64)
    }

    fn held(&mut self, kind: u8) -> Held {
        match kind {
            4..=6 => Held::Whole(self.zigzag()),
            8 => {
                let length = self.varint() as usize;
                Held::Bytes(self.take(length).to_vec())
            }
            9 => {
                let head = self.byte();
                let count = if head >> 4 == 15 { self.varint() } else { u64::from(head >> 4) };
                Held::List((0..count).map(|_| self.held(head & 15)).collect())
            }
            12 => self.fields(),
            other => panic!("nothing is of the type {other}"),
        }
    }

    fn fields(&mut self) -> Held {
        let (mut all, mut last) = (BTreeMap::new(), 0);
        loop {
            let head = self.byte();
            if head == 0 {
                return Held::Fields(all);
            }
            last = if head >> 4 == 0 { self.zigzag() } else { last + i64::from(head >> 4) };
            let value = self.held(head & 15);
            all.insert(last, value);
        }
    }
}

/// A column.
#[derive(Debug, PartialEq)]
pub(super) enum Column {
    Numbers(Vec<f64>),
    Texts(Vec<String>),
}

impl Column {
    pub(super) fn numbers(&self) -> &[f64] {
        let Column::Numbers(own) = self else { panic!("{self:?}") };
        own
    }
}

/// A table with what is said of it.
pub(super) struct Table {
    pub(super) names: Vec<String>,
    pub(super) columns: Vec<Column>,
    pub(super) facts: BTreeMap<String, String>,
}

impl Table {
    pub(super) fn read(path: &Path) -> Self {
        let bytes =
            std::fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        assert!(bytes.starts_with(b"PAR1") && bytes.ends_with(b"PAR1"));
        let end = bytes.len() - 8;
        let length = u32::from_le_bytes(bytes[end..end + 4].try_into().expect("four")) as usize;
        let about = Bytes(&bytes[end - length..end]).fields();
        let schema = &about.field(2).list()[1..];
        let names: Vec<String> = schema.iter().map(|own| own.field(4).text()).collect();
        let columns = (0..names.len()).map(|column| {
            let mut numbers = Vec::new();
            let mut texts = Vec::new();
            for group in about.field(4).list() {
                let chunk = group.field(1).list()[column].field(3);
                assert_eq!(chunk.field(3).list()[0].text(), names[column]);
                assert_eq!(chunk.field(4).whole(), 0, "not compressed");
                let mut page = Bytes(&bytes[chunk.field(9).whole() as usize..]);
                let head = page.fields();
                let data = head.field(5);
                assert_eq!(data.field(2).whole(), 0, "plain");
                let count = data.field(1).whole();
                assert_eq!([count, count], [chunk.field(5).whole(), group.field(3).whole()]);
                let before = page.0.len();
                for _ in 0..count {
                    match chunk.field(1).whole() {
                        5 => numbers.push(f64::from_le_bytes(page.take(8).try_into().expect("8"))),
                        6 => {
                            let length = u32::from_le_bytes(page.take(4).try_into().expect("4"));
                            let own = page.take(length as usize).to_vec();
                            texts.push(String::from_utf8(own).expect("UTF-8"));
                        }
                        other => panic!("a column of the type {other}"),
                    }
                }
                assert_eq!(head.field(3).whole() as usize, before - page.0.len());
            }
            let rows = about.field(3).whole() as usize;
            assert_eq!(numbers.len() + texts.len(), rows);
            if texts.is_empty() { Column::Numbers(numbers) } else { Column::Texts(texts) }
        });
        let columns = columns.collect();
        let pairs = about.has(5).map_or(&[][..], Held::list).iter();
        let facts = pairs.map(|own| (own.field(1).text(), own.field(2).text())).collect();
        Table { names, columns, facts }
    }
}
