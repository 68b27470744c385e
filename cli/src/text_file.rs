//! Text files that the user names: cases, specs, tables.

use std::fs;
use std::path::Path;

/// The text of a file in UTF-8; a byte order mark stays, and means nothing to what reads it. Where carriage returns alone end
/// lines, as spreadsheets for old Macintoshes write them, line feeds do.
///
/// # Errors
/// Why it cannot be read, for people.
pub(crate) fn read(path: &Path) -> Result<String, String> {
    let bytes =
        fs::read(path).map_err(|error| format!("cannot read `{}`: {error}", path.display()))?;
    let text = String::from_utf8(bytes).map_err(|error| {
        let bytes = error.as_bytes();
        let encoding = match bytes {
            [0xff, 0xfe, ..] | [0xfe, 0xff, ..] => "in UTF-16",
            _ if bytes.contains(&0) => "no text",
            _ => "not in UTF-8",
        };
        format!("cannot read `{}`: it is {encoding}: save it as text in UTF-8", path.display())
    })?;
    let ends_by_returns = text.contains('\r') && !text.contains('\n');
    Ok(if ends_by_returns { text.replace('\r', "\n") } else { text })
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::read;

    #[test]
    fn the_encoding_of_a_file_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("case.toml");
        for (bytes, known) in [
            (&b"\xff\xfet\0i\0"[..], "it is in UTF-16: save it as text in UTF-8"),
            (b"\xfe\xff\0t", "it is in UTF-16"),
            (b"title = \"f\xfcr\"", "it is not in UTF-8"),
            (b"\x1f\x8b\x08\0", "it is no text"),
        ] {
            fs::write(&path, bytes).unwrap();
            let found = read(&path).unwrap_err();
            assert!(found.contains(known), "{found}");
        }
        fs::write(&path, "\u{feff}title = 1").unwrap();
        assert!(read(&path).unwrap().ends_with("title = 1"));
    }

    #[test]
    fn carriage_returns_alone_end_lines() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.csv");
        for (written, read_as) in [("a\rb\r", "a\nb\n"), ("a\r\nb\r\n", "a\r\nb\r\n"), ("a", "a")] {
            fs::write(&path, written).unwrap();
            assert_eq!(read(&path).unwrap(), read_as);
        }
    }
}
