//! Files that are no meshes of the formats that are read: what they are, and what makes a mesh of them.

mod binary;
mod remedy;
#[cfg(test)]
mod tests;
mod text;

use std::path::Path;

use super::{bdf, unv};

/// What a file is, and what to do with it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Foreign {
    /// In words, such as `a STEP file`.
    pub what: &'static str,
    /// The remedy, with the file's own name in commands.
    pub help: String,
}

/// What a file is that is none of the formats that are read, by its content first; `None` of one that may be.
pub fn foreign(bytes: &[u8], path: &str) -> Option<Foreign> {
    let lower = |part: Option<&std::ffi::OsStr>| {
        part.map_or(String::new(), |own| own.to_string_lossy().to_lowercase())
    };
    let own = Path::new(path);
    let (name, extension) = (lower(own.file_name()), lower(own.extension()));
    let by_name = || {
        // An extension says nothing of a file that begins as one that is read.
        let start = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
        let is_read = start.starts_with(b"*")
            || start.starts_with(b"$")
            || unv::is_universal(start)
            || bdf::is_bulk_data(start);
        text::by_name(&name, &extension).filter(|_| !is_read)
    };
    let found = binary::named(bytes, path, &extension)
        .or_else(|| text::named(bytes, &extension))
        .or_else(by_name);
    found.map(|(what, remedy)| Foreign { what, help: remedy.text(path) })
}
