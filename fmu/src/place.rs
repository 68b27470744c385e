//! The folder of resources, as an importer names it: a URI.

use std::path::PathBuf;

/// The folder of a `file:` URI, or of a path that some importers give in its place; none of another scheme.
pub(crate) fn folder(location: &str) -> Option<PathBuf> {
    let Some(rest) = location.strip_prefix("file:") else {
        return (!location.is_empty() && !location.contains("://")).then(|| location.into());
    };
    let path = match rest.strip_prefix("//") {
        // `file://host/path`: the host is this one.
        Some(rest) => &rest[rest.find('/')?..],
        None => rest,
    };
    let path = decoded(path)?;
    // `/C:/…` on Windows.
    let drive = cfg!(windows) && path.as_bytes().get(2) == Some(&b':');
    Some(PathBuf::from(if drive { &path[1..] } else { &path }))
}

/// A text with its `%20` and the like as what they stand for.
fn decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        if byte != b'%' {
            bytes.push(byte);
            continue;
        }
        let digit = |own: u8| char::from(own).to_digit(16);
        let value = 16 * digit(rest.next()?)? + digit(rest.next()?)?;
        bytes.push(u8::try_from(value).ok()?);
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn folders_are_read_from_uris() {
        let pairs = [
            ("file:///tmp/a%20b/resources", Some("/tmp/a b/resources")),
            ("file:/tmp/x", Some("/tmp/x")),
            ("file://localhost/tmp/x", Some("/tmp/x")),
            ("file:///tmp/%C3%A4", Some("/tmp/ä")),
            ("/tmp/x", Some("/tmp/x")),
            ("file:///tmp/%4", None),
            ("file://nowhere", None),
            ("http://x/y", None),
            ("", None),
        ];
        for (location, expected) in pairs {
            assert_eq!(folder(location), expected.map(PathBuf::from), "{location}");
        }
    }
}
