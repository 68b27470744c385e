//! Binary files: records of Fortran, with their lengths before and behind them.

use super::building::{Building, Matrix, Stop};

/// How numbers are written.
#[derive(Debug, Clone, Copy)]
pub(super) struct Order {
    big_endian: bool,
    /// Bytes of whole numbers, and of words: 4 or 8.
    width: usize,
}

/// How a binary file is written: its first record is the head of a matrix; none of another file.
pub(super) fn order(bytes: &[u8]) -> Option<Order> {
    let first: [u8; 4] = bytes.get(..4)?.try_into().ok()?;
    let [little, big] = [u32::from_le_bytes(first), u32::from_be_bytes(first)];
    [(little, false, 4), (big, true, 4)]
        .into_iter()
        .flat_map(|(length, big_endian, width)| {
            [(length, 24, big_endian, width), (length, 48, big_endian, 8)]
        })
        .find(|(length, wanted, ..)| length == wanted)
        .map(|(_, _, big_endian, width)| Order { big_endian, width })
}

struct Reader<'b> {
    bytes: &'b [u8],
    at: usize,
    order: Order,
}

impl Order {
    fn four(self, bytes: &[u8]) -> Option<u32> {
        let own: [u8; 4] = bytes.get(..4)?.try_into().ok()?;
        Some(if self.big_endian { u32::from_be_bytes(own) } else { u32::from_le_bytes(own) })
    }

    fn eight(self, bytes: &[u8]) -> Option<u64> {
        let own: [u8; 8] = bytes.get(..8)?.try_into().ok()?;
        Some(if self.big_endian { u64::from_be_bytes(own) } else { u64::from_le_bytes(own) })
    }

    /// The whole number at the start of some bytes, which go on behind it.
    fn whole(self, bytes: &mut &[u8]) -> Option<i64> {
        let value = match self.width {
            4 => i64::from(self.four(bytes)?.cast_signed()),
            _ => self.eight(bytes)?.cast_signed(),
        };
        *bytes = &bytes[self.width..];
        Some(value)
    }

    /// The reals of some bytes, of so many bytes each.
    fn real(self, bytes: &[u8]) -> f64 {
        let value = match bytes.len() {
            4 => self.four(bytes).map(|own| f64::from(f32::from_bits(own))),
            _ => self.eight(bytes).map(f64::from_bits),
        };
        value.unwrap_or(f64::NAN)
    }
}

fn cut(within: &str) -> Stop {
    Stop { line: 0, what: format!("the file ends or is damaged within {within}") }
}

impl<'b> Reader<'b> {
    /// The bytes of the next record.
    fn record(&mut self, within: &str) -> Result<&'b [u8], Stop> {
        let rest = &self.bytes[self.at..];
        let own = self.order.four(rest).and_then(|length| {
            let length = length as usize;
            let own = rest.get(4..length.checked_add(4)?)?;
            let behind = self.order.four(&rest[4 + length..])?;
            (behind as usize == length).then_some(own)
        });
        let own = own.ok_or_else(|| cut(within))?;
        self.at += own.len() + 8;
        Ok(own)
    }
}

/// All matrices of a file.
pub(super) fn matrices(bytes: &[u8], order: Order) -> Result<Vec<Matrix>, Stop> {
    let mut reader = Reader { bytes, at: 0, order };
    let mut all = Vec::new();
    while reader.at < bytes.len() {
        let mut head = reader.record("the head of a matrix")?;
        let mut next = || order.whole(&mut head).ok_or_else(|| cut("the head of a matrix"));
        let numbers = [next()?, next()?, next()?, next()?];
        let name = String::from_utf8_lossy(head);
        let words = if order.width == 4 { 2 } else { 1 };
        let mut own = Building::new(numbers, &name, 0, words)?;
        while column(&mut reader, &mut own)? {}
        all.push(own.matrix);
    }
    Ok(all)
}

/// Takes the next column; false where it is behind the last one.
fn column(reader: &mut Reader, own: &mut Building) -> Result<bool, Stop> {
    let order = reader.order;
    let within = format!("column {} of {}", own.last.0 + 1, own.matrix.name);
    let mut rest = reader.record(&within)?;
    let next = |rest: &mut &[u8]| order.whole(rest).ok_or_else(|| cut(&within));
    let (column, row, mut words) = (next(&mut rest)?, next(&mut rest)?, next(&mut rest)?);
    if own.column(column, 0)?.is_none() {
        return Ok(false);
    }
    let width = order.width * own.words.unsigned_abs() as usize;
    if row != 0 {
        run(own, &mut rest, row, words, width, order)?;
        return Ok(true);
    }
    while words > 0 {
        let first = next(&mut rest)?;
        let second = if own.big { Some(next(&mut rest)?) } else { None };
        let (length, row, taken) = own.string(first, second);
        words = words.saturating_sub(taken);
        if words < 0 || taken <= 0 {
            return Err(cut(&within));
        }
        run(own, &mut rest, row, length, width, order)?;
    }
    Ok(true)
}

/// Takes a run of values, of so many words.
fn run(
    own: &mut Building,
    rest: &mut &[u8],
    row: i64,
    words: i64,
    width: usize,
    order: Order,
) -> Result<(), Stop> {
    let count = own.count(words, 0)?;
    let length = count.checked_mul(width).filter(|length| *length <= rest.len());
    let Some(length) = length else {
        return Err(cut(&format!("column {} of {}", own.last.0, own.matrix.name)));
    };
    let (values, behind) = rest.split_at(length);
    *rest = behind;
    own.values(row, values.chunks_exact(width).map(|value| (order.real(value), 0)), 0)
}
