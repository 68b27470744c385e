//! The schema of Apache Arrow that a file of Parquet may carry: there the unit of a column is metadata of its field.
//!
//! Source: Apache Arrow columnar format 1.5, Schema.fbs and Message.fbs; FlatBuffers, internals.

/// Under which the schema stands among the metadata of a file.
pub(super) const KEY: &str = "ARROW:schema";
/// What metadata of a field call its unit.
const UNIT: &str = "unit";

/// A schema of columns of doubles with these names and units, and metadata of the whole, as the message of Arrow in base 64.
pub(super) fn schema<'c>(
    columns: impl ExactSizeIterator<Item = (&'c str, &'c str)>,
    whole: &[(&str, String)],
) -> String {
    let message = message(columns, whole);
    let length = (message.len() as u32).to_le_bytes();
    let framed = [&[0xff; 4][..], &length, &message].concat();
    base64(&framed)
}

/// What stands in a place of a table.
#[derive(Clone, Copy)]
enum Slot {
    /// Its usual value.
    None,
    Byte(u8),
    Short(i16),
    /// Where something else begins; filled in once that is known.
    Offset,
}

impl Slot {
    fn size(self) -> usize {
        match self {
            Slot::None => 0,
            Slot::Byte(_) => 1,
            Slot::Short(_) => 2,
            Slot::Offset => 4,
        }
    }
}

/// Values of `Type`, of the version, and of the precision of doubles.
const FLOATING_POINT: u8 = 3;
const SCHEMA: u8 = 1;
const VERSION_5: i16 = 4;
const DOUBLE: i16 = 2;

fn message<'c>(
    columns: impl ExactSizeIterator<Item = (&'c str, &'c str)>,
    whole: &[(&str, String)],
) -> Vec<u8> {
    let mut flat = Flat(vec![0; 4]);
    let root = flat.table(&[Slot::Short(VERSION_5), Slot::Byte(SCHEMA), Slot::Offset]);
    flat.fill(0, root.start);
    // Order of bytes, fields, metadata.
    let schema = flat.table(&[Slot::None, Slot::Offset, Slot::Offset]);
    flat.fill(root.offsets[0], schema.start);
    flat.pairs(schema.offsets[1], whole.iter().map(|(name, text)| (*name, text.as_str())));
    let fields = flat.vector(columns.len());
    flat.fill(schema.offsets[0], fields.start);
    for (place, (name, unit)) in fields.offsets.into_iter().zip(columns) {
        // Name, whether values may be missing, type, dictionary, children, metadata.
        let kind = Slot::Byte(FLOATING_POINT);
        let (off, none) = (Slot::Offset, Slot::None);
        let field = flat.table(&[off, none, kind, off, none, off, off]);
        flat.fill(place, field.start);
        let [called, of_type, children, metadata] = field.offsets[..] else {
            unreachable!("four of them")
        };
        flat.text(called, name);
        let own = flat.table(&[Slot::Short(DOUBLE)]);
        flat.fill(of_type, own.start);
        let own = flat.vector(0);
        flat.fill(children, own.start);
        flat.pairs(metadata, [(UNIT, unit)].into_iter());
    }
    flat.align(8);
    flat.0
}

/// Something that was written: where it begins, and where its offsets stand.
struct Put {
    start: usize,
    offsets: Vec<usize>,
}

/// A buffer of FlatBuffers, from what is referred from to what is referred to.
struct Flat(Vec<u8>);

impl Flat {
    fn align(&mut self, to: usize) {
        self.0.resize(self.0.len().next_multiple_of(to), 0);
    }

    fn fill(&mut self, at: usize, start: usize) {
        self.0[at..at + 4].copy_from_slice(&((start - at) as u32).to_le_bytes());
    }

    /// Its list of places, and behind it the table.
    fn table(&mut self, slots: &[Slot]) -> Put {
        let mut length: usize = 4;
        let mut places = Vec::with_capacity(slots.len());
        for slot in slots {
            let size = slot.size();
            length = length.next_multiple_of(size.max(1));
            places.push(if size == 0 { 0 } else { length });
            length += size;
        }
        let list = 4 + 2 * slots.len();
        while !(self.0.len() + list).is_multiple_of(8) {
            self.0.push(0);
        }
        for value in [list, length].into_iter().chain(places.iter().copied()) {
            self.0.extend((value as u16).to_le_bytes());
        }
        let start = self.0.len();
        self.0.resize(start + length, 0);
        self.0[start..start + 4].copy_from_slice(&(list as i32).to_le_bytes());
        let mut offsets = Vec::new();
        for (slot, place) in slots.iter().zip(places) {
            let at = start + place;
            match slot {
                Slot::None => {}
                Slot::Byte(value) => self.0[at] = *value,
                Slot::Short(value) => self.0[at..at + 2].copy_from_slice(&value.to_le_bytes()),
                Slot::Offset => offsets.push(at),
            }
        }
        Put { start, offsets }
    }

    /// A list of offsets.
    fn vector(&mut self, count: usize) -> Put {
        self.align(4);
        let start = self.0.len();
        self.0.extend((count as u32).to_le_bytes());
        let offsets = (0..count).map(|k| start + 4 * (k + 1)).collect();
        self.0.resize(start + 4 * (count + 1), 0);
        Put { start, offsets }
    }

    /// Metadata: texts by names.
    fn pairs<'t>(&mut self, at: usize, pairs: impl ExactSizeIterator<Item = (&'t str, &'t str)>) {
        let own = self.vector(pairs.len());
        self.fill(at, own.start);
        for (place, (name, text)) in own.offsets.into_iter().zip(pairs) {
            let pair = self.table(&[Slot::Offset, Slot::Offset]);
            self.fill(place, pair.start);
            self.text(pair.offsets[0], name);
            self.text(pair.offsets[1], text);
        }
    }

    fn text(&mut self, at: usize, text: &str) {
        self.align(4);
        let start = self.0.len();
        self.fill(at, start);
        self.0.extend((text.len() as u32).to_le_bytes());
        self.0.extend(text.bytes());
        self.0.push(0);
    }
}

fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for part in bytes.chunks(3) {
        let all = part.iter().fold(0_u32, |all, byte| all << 8 | u32::from(*byte));
        let all = all << (8 * (3 - part.len()));
        for k in 0..4 {
            match k <= part.len() {
                true => text.push(char::from(DIGITS[(all >> (18 - 6 * k) & 63) as usize])),
                false => text.push('='),
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::base64;

    #[test]
    fn base_64_is_that_of_rfc_4648() {
        let all =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")];
        for (text, known) in all {
            assert_eq!(base64(text.as_bytes()), known);
        }
    }
}
