//! Structures in the compact protocol of Apache Thrift.

pub(super) const I32: u8 = 5;
pub(super) const I64: u8 = 6;
const BINARY: u8 = 8;
const LIST: u8 = 9;
const STRUCT: u8 = 12;

/// A structure in the compact protocol of Thrift.
#[derive(Default)]
pub(super) struct Compact {
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

    pub(super) fn number(&mut self, field: u8, kind: u8, value: i64) {
        self.field(field, kind);
        self.zigzag(value);
    }

    fn string(&mut self, text: &str) {
        self.varint(text.len() as u64);
        self.bytes.extend(text.bytes());
    }

    pub(super) fn text(&mut self, field: u8, text: &str) {
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

    pub(super) fn numbers(&mut self, field: u8, values: &[i64]) {
        self.list(field, values.len(), I32);
        values.iter().for_each(|value| self.zigzag(*value));
    }

    pub(super) fn texts(&mut self, field: u8, texts: &[&str]) {
        self.list(field, texts.len(), BINARY);
        texts.iter().for_each(|text| self.string(text));
    }

    pub(super) fn structure(&mut self, field: u8, fill: impl FnOnce(&mut Compact)) {
        self.field(field, STRUCT);
        let mut inner = Compact::default();
        fill(&mut inner);
        self.bytes.extend(inner.end());
    }

    pub(super) fn structures(
        &mut self,
        field: u8,
        count: usize,
        mut fill: impl FnMut(usize, &mut Compact),
    ) {
        self.list(field, count, STRUCT);
        for place in 0..count {
            let mut inner = Compact::default();
            fill(place, &mut inner);
            self.bytes.extend(inner.end());
        }
    }

    pub(super) fn end(mut self) -> Vec<u8> {
        self.bytes.push(0);
        self.bytes
    }
}
