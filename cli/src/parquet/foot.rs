//! What stands at the end of a file: its columns, where everything is, and what is to be known of it.

use super::arrow;
use super::compact::{Compact, I32, I64};

/// What a file begins and ends with.
pub(crate) const MAGIC: &[u8] = b"PAR1";
/// Rows of a group.
pub(crate) const GROUP: usize = 8192;
/// `Type` of doubles, and of texts.
pub(super) const DOUBLE: i64 = 5;
pub(super) const BYTES: i64 = 6;

/// Where the columns of a group begin, and how many bytes they have.
pub(super) struct Group {
    pub(super) rows: i64,
    pub(super) columns: Vec<[i64; 2]>,
}

/// A column: its name and its `Type`.
pub(super) struct Column<'n> {
    pub(super) name: &'n str,
    pub(super) kind: i64,
}

/// What is to be known of a file of numbers.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Facts {
    /// Unit of each column.
    pub(crate) units: Vec<String>,
    /// Of the whole, by names.
    pub(crate) whole: Vec<(&'static str, String)>,
}

impl Facts {
    /// As metadata of a file: each by its name, the units together, all once more as pandas reads its `attrs`, and the
    /// schema by which readers that know Arrow give each column its unit.
    fn pairs(&self, columns: &[Column]) -> Vec<(&'static str, String)> {
        use serde_json::Value::{Object, String as Text};
        let names = columns.iter().map(|own| own.name.to_owned());
        let units = names.zip(self.units.iter().map(|own| Text(own.clone()))).collect();
        let units = Object(units);
        let mut pairs = self.whole.clone();
        pairs.push(("units", units.to_string()));
        let texts = self.whole.iter().map(|(name, own)| ((*name).to_owned(), Text(own.clone())));
        let all = texts.chain([("units".to_owned(), units)]).collect();
        pairs.push(("PANDAS_ATTRS", Object(all).to_string()));
        let fields = columns.iter().map(|own| own.name).zip(self.units.iter().map(String::as_str));
        let schema = arrow::schema(fields, &pairs);
        pairs.push((arrow::KEY, schema));
        pairs
    }
}

/// `FileMetaData` with its length, and how the file ends.
pub(super) fn foot(
    columns: &[Column],
    groups: impl ExactSizeIterator<Item = Group>,
    facts: Option<&Facts>,
    creator: &str,
) -> Vec<u8> {
    let mut foot = Compact::default();
    foot.number(1, I32, 1);
    foot.structures(2, 1 + columns.len(), |place, element| match place.checked_sub(1) {
        None => {
            element.text(4, "table");
            element.number(5, I32, columns.len() as i64);
        }
        Some(column) => {
            element.number(1, I32, columns[column].kind);
            element.number(3, I32, 0);
            element.text(4, columns[column].name);
            if columns[column].kind == BYTES {
                element.number(6, I32, 0);
            }
        }
    });
    let groups: Vec<Group> = groups.collect();
    foot.number(3, I64, groups.iter().map(|group| group.rows).sum());
    foot.structures(4, groups.len(), |place, group| {
        let own = &groups[place];
        group.structures(1, own.columns.len(), |column, chunk| {
            let [start, bytes] = own.columns[column];
            chunk.number(2, I64, start);
            chunk.structure(3, |data| {
                data.number(1, I32, columns[column].kind);
                data.numbers(2, &[0]);
                data.texts(3, &[columns[column].name]);
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
    if let Some(facts) = facts {
        let pairs = facts.pairs(columns);
        foot.structures(5, pairs.len(), |place, pair| {
            pair.text(1, pairs[place].0);
            pair.text(2, &pairs[place].1);
        });
    }
    foot.text(6, creator);
    let mut bytes = foot.end();
    bytes.extend((bytes.len() as u32).to_le_bytes());
    bytes.extend(MAGIC);
    bytes
}

/// What stands before the values of a column in a group.
pub(super) fn page_head(rows: usize, bytes: usize) -> Vec<u8> {
    let mut head = Compact::default();
    head.number(1, I32, 0);
    head.number(2, I32, bytes as i64);
    head.number(3, I32, bytes as i64);
    head.structure(5, |data| {
        data.number(1, I32, rows as i64);
        data.number(2, I32, 0);
        data.number(3, I32, 3);
        data.number(4, I32, 3);
    });
    head.end()
}
