//! A file of doubles whose groups have as many rows as each other, but for the last one: where anything stands follows from
//! its number, so that groups can be added while a run is at work, and read again without what stands at the end.

use super::foot::{Column, DOUBLE, Facts, GROUP, Group, MAGIC, foot, page_head};

/// Bytes of a value.
const VALUE: usize = 8;

/// Such a file of so many columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Numbers(pub(crate) usize);

impl Numbers {
    /// Bytes of a column in a group of so many rows.
    fn column(rows: usize) -> usize {
        page_head(rows, VALUE * rows).len() + VALUE * rows
    }

    /// Bytes of a group of so many rows.
    pub(crate) fn length(self, rows: usize) -> u64 {
        (self.0 * Self::column(rows)) as u64
    }

    /// Where a group begins in the file.
    pub(crate) fn start(self, group: u64) -> u64 {
        MAGIC.len() as u64 + group * self.length(GROUP)
    }

    /// Where the values of a column begin in a whole group.
    pub(crate) fn values(column: usize) -> u64 {
        ((column + 1) * Self::column(GROUP) - VALUE * GROUP) as u64
    }

    /// A group of rows that stand one after the other.
    pub(crate) fn group(self, rows: &[f64]) -> Vec<u8> {
        let count = rows.len() / self.0;
        let mut bytes = Vec::with_capacity(self.length(count) as usize);
        for column in 0..self.0 {
            bytes.extend(page_head(count, VALUE * count));
            let values = rows.iter().skip(column).step_by(self.0);
            bytes.extend(values.flat_map(|value| value.to_le_bytes()));
        }
        bytes
    }

    /// What stands behind so many whole groups and one of the rows that are left.
    pub(crate) fn foot(
        self,
        names: &[String],
        (whole, left): (u64, usize),
        facts: &Facts,
        creator: &str,
    ) -> Vec<u8> {
        let columns: Vec<Column> = names.iter().map(|name| Column { name, kind: DOUBLE }).collect();
        let count = whole + u64::from(left > 0);
        let groups = (0..count as usize).map(|number| {
            let rows = if number as u64 == whole { left } else { GROUP };
            let (start, bytes) = (self.start(number as u64) as i64, Self::column(rows) as i64);
            let columns = (0..self.0 as i64).map(|own| [start + own * bytes, bytes]).collect();
            Group { rows: rows as i64, columns }
        });
        foot(&columns, groups, Some(facts), creator)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_stand_where_they_are_said_to() {
        let numbers = Numbers(3);
        let rows: Vec<f64> = (0..3 * GROUP).map(|own| own as f64).collect();
        let bytes = numbers.group(&rows);
        assert_eq!(bytes.len() as u64, numbers.length(GROUP));
        for column in 0..3 {
            let at = Numbers::values(column) as usize;
            for row in [0, 1, GROUP - 1] {
                let own = bytes[at + 8 * row..][..8].try_into().expect("eight bytes");
                assert_eq!(f64::from_le_bytes(own), (3 * row + column) as f64);
            }
        }
        assert_eq!((numbers.length(0), numbers.start(0)), (numbers.group(&[]).len() as u64, 4));
    }
}
