//! The text of files.

/// The text of a file in UTF-8, without a byte order mark, or else in Latin-1, in which older programs write names and
/// comments.
pub fn decode(mut bytes: Vec<u8>) -> String {
    if bytes.starts_with(b"\xef\xbb\xbf") {
        bytes.drain(..3);
    }
    // Lines of old Macintosh computers.
    if bytes.contains(&b'\r') && !bytes.contains(&b'\n') {
        bytes.iter_mut().filter(|byte| **byte == b'\r').for_each(|byte| *byte = b'\n');
    }
    match String::from_utf8(bytes) {
        Ok(text) => text,
        // Latin-1 is the first 256 characters of Unicode.
        Err(error) => error.into_bytes().into_iter().map(char::from).collect(),
    }
}
