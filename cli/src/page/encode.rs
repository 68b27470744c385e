//! Numbers as a page carries them: little-endian bytes in base64, which take a third of their digits.

use serde::Serialize;

/// Letters of base64.
const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Numbers in base64, with what they are: `f32`, `f64`, `u32` or `u16`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct Packed {
    r#type: &'static str,
    base64: String,
}

impl Packed {
    /// To seven digits.
    pub(super) fn single(values: impl IntoIterator<Item = f64>) -> Self {
        let bytes = values.into_iter().flat_map(|own| (own as f32).to_le_bytes());
        Packed { r#type: "f32", base64: base64(bytes) }
    }

    /// With all digits.
    pub(super) fn double(values: impl IntoIterator<Item = f64>) -> Self {
        let bytes = values.into_iter().flat_map(f64::to_le_bytes);
        Packed { r#type: "f64", base64: base64(bytes) }
    }

    /// Whole numbers.
    pub(super) fn whole(values: impl IntoIterator<Item = u32>) -> Self {
        let bytes = values.into_iter().flat_map(u32::to_le_bytes);
        Packed { r#type: "u32", base64: base64(bytes) }
    }

    /// Whole numbers from 0 to 65535.
    pub(super) fn short(values: impl IntoIterator<Item = u16>) -> Self {
        let bytes = values.into_iter().flat_map(u16::to_le_bytes);
        Packed { r#type: "u16", base64: base64(bytes) }
    }
}

pub(super) fn base64(bytes: impl IntoIterator<Item = u8>) -> String {
    let (mut text, mut bytes) = (String::new(), bytes.into_iter().peekable());
    while bytes.peek().is_some() {
        let three: [Option<u8>; 3] = std::array::from_fn(|_| bytes.next());
        let whole = three.iter().fold(0, |sum, own| sum << 8 | u32::from(own.unwrap_or(0)));
        let count = 1 + three.iter().flatten().count();
        for place in 0..4 {
            let letter = LETTERS[(whole >> (18 - 6 * place) & 63) as usize];
            text.push(if place < count { char::from(letter) } else { '=' });
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The examples of RFC 4648, section 10.
    #[test]
    fn bytes_are_those_of_the_standard() {
        let known = ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"];
        for (length, known) in known.into_iter().enumerate() {
            assert_eq!(base64(b"foobar"[..length].iter().copied()), known);
        }
        assert_eq!(Packed::single([1.0]).base64, "AACAPw==");
        assert_eq!(Packed::double([1.0]).base64, "AAAAAAAA8D8=");
        assert_eq!(Packed::short([0x4241]).base64, "QUI=");
    }
}
