//! The bytes of a file of Gmsh, read one after the other: words of text, or binary numbers.

use super::super::raw::LinePosition;
use super::super::text::decode;

/// What may be the cause where numbers do not fit together.
pub(super) const DAMAGED: &str =
    "is the file cut off, or of another version than its header says? Export it again";

/// Why reading cannot go on.
#[derive(Debug)]
pub(super) struct Stop {
    pub(super) place: LinePosition,
    pub(super) what: String,
    pub(super) help: String,
}

/// What the bytes of a mesh hold between its words.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    Binary {
        /// Whether the most significant byte comes first.
        big_endian: bool,
        /// Bytes of labels and counts of version 4.
        wide: usize,
    },
}

/// A place in the file, and how to read on.
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    line: usize,
    line_start: usize,
    /// Where the last word of text begins.
    word: LinePosition,
    pub(super) encoding: Encoding,
    /// Name of the section, for messages.
    pub(super) section: String,
    /// What a count that the section gave is, for messages.
    pub(super) promised: String,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Cursor<'a> {
        let at = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
        Cursor {
            bytes,
            at,
            line: 1,
            line_start: at,
            word: LinePosition::default(),
            encoding: Encoding::Text,
            section: String::new(),
            promised: String::new(),
        }
    }

    pub(super) fn is_text(&self) -> bool {
        self.encoding == Encoding::Text
    }

    /// Line and column of the next byte of a text; binary files have none.
    pub(super) fn place(&self) -> LinePosition {
        match self.encoding {
            Encoding::Text => {
                LinePosition { file: 0, line: self.line, column: self.at - self.line_start + 1 }
            }
            Encoding::Binary { .. } => LinePosition::default(),
        }
    }

    /// Goes to the next word of a text, so that its place is known.
    pub(super) fn peek_text(&mut self) {
        if self.is_text() {
            self.skip_blanks();
        }
    }

    /// An error at the last word of a text, or the next byte of binary numbers.
    pub(super) fn stop(&self, what: impl Into<String>, help: impl Into<String>) -> Stop {
        let mut what = what.into();
        if !self.is_text() {
            what = format!("{what} (at byte {})", self.at);
        }
        let place = if self.is_text() { self.word } else { LinePosition::default() };
        Stop { place, what, help: help.into() }
    }

    /// An error where `expected` should stand.
    fn expected(&self, expected: &str, found: &[u8]) -> Stop {
        let found = match found {
            [] => "the file ends".to_owned(),
            _ => format!("found `{}`", short(found)),
        };
        let help = match self.promised.as_str() {
            "" => {
                "is the file cut off, or of another version than its header says? Export it again"
                    .into()
            }
            promised => format!(
                "${} says {promised}; is the file cut off, or of another version than its header says?",
                self.section
            ),
        };
        self.stop(format!("expected {expected}, {found}"), help)
    }

    fn skip_blanks(&mut self) {
        while let Some(byte) = self.bytes.get(self.at).filter(|byte| byte.is_ascii_whitespace()) {
            self.at += 1;
            if *byte == b'\n' {
                self.line += 1;
                self.line_start = self.at;
            }
        }
    }

    /// The next word, not yet taken; empty at the end of the file.
    pub(super) fn peek(&mut self) -> &'a [u8] {
        self.skip_blanks();
        self.word = self.place();
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        &rest[..end]
    }

    pub(super) fn take(&mut self, word: &[u8]) {
        self.at += word.len();
    }

    /// A whole number in text, also in binary files.
    pub(super) fn written(&mut self, of: &str) -> Result<i64, Stop> {
        let word = self.peek();
        let value = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        let value = value.ok_or_else(|| self.expected(of, word))?;
        self.take(word);
        Ok(value)
    }

    /// A number in text, also in binary files.
    pub(super) fn written_real(&mut self, of: &str) -> Result<f64, Stop> {
        let word = self.peek();
        let value = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        let value = value.filter(|value: &f64| value.is_finite());
        let value = value.ok_or_else(|| self.expected(of, word))?;
        self.take(word);
        Ok(value)
    }

    /// Passes over the rest of a line, which ends the text before binary numbers.
    pub(super) fn end_line(&mut self) {
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(|byte| *byte == b'\n').map_or(rest.len(), |end| end + 1);
        self.at += end;
        self.line += 1;
        self.line_start = self.at;
    }

    fn binary<const N: usize>(&mut self, of: &str) -> Result<[u8; N], Stop> {
        let rest = &self.bytes[self.at..];
        let Some(bytes) = rest.first_chunk::<N>() else {
            return Err(self.expected(of, &[]));
        };
        self.at += N;
        Ok(*bytes)
    }

    /// An `int`.
    pub(super) fn whole(&mut self, of: &str) -> Result<i64, Stop> {
        let Encoding::Binary { big_endian, .. } = self.encoding else { return self.written(of) };
        let bytes: [u8; 4] = self.binary(of)?;
        let value = if big_endian { i32::from_be_bytes(bytes) } else { i32::from_le_bytes(bytes) };
        Ok(i64::from(value))
    }

    /// A `size_t`.
    pub(super) fn size(&mut self, of: &str) -> Result<u64, Stop> {
        let Encoding::Binary { big_endian, wide } = self.encoding else {
            let word = self.peek();
            let value = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
            let value = value.ok_or_else(|| self.expected(of, word))?;
            self.take(word);
            return Ok(value);
        };
        if wide == 4 {
            let bytes: [u8; 4] = self.binary(of)?;
            let value =
                if big_endian { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) };
            return Ok(u64::from(value));
        }
        let bytes: [u8; 8] = self.binary(of)?;
        Ok(if big_endian { u64::from_be_bytes(bytes) } else { u64::from_le_bytes(bytes) })
    }

    /// A `double`, which must be finite.
    pub(super) fn real(&mut self, of: &str) -> Result<f64, Stop> {
        let Encoding::Binary { big_endian, .. } = self.encoding else {
            return self.written_real(of);
        };
        let bytes: [u8; 8] = self.binary(of)?;
        let value = if big_endian { f64::from_be_bytes(bytes) } else { f64::from_le_bytes(bytes) };
        match value.is_finite() {
            true => Ok(value),
            false => Err(self.expected(of, value.to_string().as_bytes())),
        }
    }

    /// A count of things of which each needs so many words of text, or so many bytes: more than the rest of the
    /// file can hold is an error, before anything is set aside for them.
    pub(super) fn room(
        &self,
        count: u64,
        of: &str,
        words: usize,
        bytes: usize,
    ) -> Result<usize, Stop> {
        let rest = self.bytes.len() - self.at;
        let each = if self.is_text() { 2 * words } else { bytes };
        let most = rest / each.max(1) + 1;
        match usize::try_from(count).ok().filter(|count| *count <= most) {
            Some(count) => Ok(count),
            None => {
                let what = format!(
                    "${} says {count} {of}, but what follows has room for {most} at most",
                    self.section
                );
                Err(self.stop(what, DAMAGED))
            }
        }
    }

    /// A count (`size_t`), as [`Cursor::room`].
    pub(super) fn count(&mut self, of: &str, words: usize, bytes: usize) -> Result<usize, Stop> {
        let count = self.size(&format!("the number of {of}"))?;
        self.room(count, of, words, bytes)
    }

    /// The end of the section.
    pub(super) fn end(&mut self) -> Result<(), Stop> {
        let end = format!("$End{}", self.section);
        let word = self.peek();
        if word != end.as_bytes() {
            return Err(self.expected(&format!("`{end}`"), word));
        }
        self.take(word);
        self.promised.clear();
        Ok(())
    }

    /// Passes over the section.
    pub(super) fn skip_section(&mut self) -> Result<(), Stop> {
        let end = format!("\n$End{}", self.section);
        let rest = &self.bytes[self.at..];
        let Some(found) = rest.windows(end.len()).position(|piece| piece == end.as_bytes()) else {
            let what = format!("${} has no end", self.section);
            return Err(self.stop(what, DAMAGED));
        };
        let (from, to) = (self.at, self.at + found + end.len());
        let skipped = &self.bytes[from..to];
        self.line += skipped.iter().filter(|byte| **byte == b'\n').count();
        self.line_start = from + found + 1;
        self.at = to;
        Ok(())
    }

    /// A text between quotation marks on this line.
    pub(super) fn quoted(&mut self) -> Result<String, Stop> {
        let word = self.peek();
        let rest = &self.bytes[self.at..];
        let line = &rest[..rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len())];
        let end = line.iter().skip(1).position(|byte| *byte == b'"');
        let (Some(b'"'), Some(end)) = (line.first(), end) else {
            return Err(self.expected("a name between quotation marks", word));
        };
        let text = decode(line[1..=end].to_vec());
        self.at += end + 2;
        Ok(text)
    }
}

/// The first letters of a word, for a message.
fn short(word: &[u8]) -> String {
    let text: String =
        String::from_utf8_lossy(&word[..word.len().min(60)]).chars().take(24).collect();
    text.escape_debug().to_string()
}
