//! The shared library that runs a unit: built from the crate `whirl-fmu`, found beside the program.

use std::env::consts::{ARCH, DLL_PREFIX, DLL_SUFFIX, OS};
use std::fs;
use std::path::{Path, PathBuf};

use crate::errors::Failure;
use crate::version;

/// What to do where there is none.
const BUILD: &str = "cargo build --release -p whirl-fmu";

/// The library with what the standard calls its platform.
pub(super) struct Library {
    /// Its bytes.
    pub(super) content: Vec<u8>,
    /// `linux64` and so on.
    pub(super) platform: &'static str,
    /// `.so` and so on.
    pub(super) ending: &'static str,
}

impl Library {
    /// That of a path, or the one beside the program.
    ///
    /// # Errors
    /// There is none, or one of another version of the program; a platform that the standard has no name for.
    pub(super) fn find(given: Option<&Path>) -> Result<Library, Failure> {
        let Some(platform) = platform() else {
            return Err(Failure::Argument {
                message: format!("FMI 2.0 has no units for {OS} on {ARCH}"),
                help: "export on Linux, Windows or macOS on a processor of the x86-64 kind"
                    .to_owned(),
            });
        };
        let name = format!("{DLL_PREFIX}whirl_fmu{DLL_SUFFIX}");
        let path = match given {
            Some(path) => path.to_path_buf(),
            None => beside(&name),
        };
        let content = fs::read(&path).map_err(|error| Failure::Argument {
            message: format!("cannot read the library of units, `{}`: {error}", path.display()),
            help: format!(
                "build it from the sources of this version with `{BUILD}`; elsewhere than beside `whirl`, name it with \
                 `--library {}`",
                Path::new("target/release").join(&name).display()
            ),
        })?;
        let sources = version::SOURCES.as_bytes();
        if !content.windows(sources.len()).any(|own| own == sources) {
            return Err(Failure::Argument {
                message: format!(
                    "`{}` is no library of units, or one of another version of `whirl`",
                    path.display()
                ),
                help: format!(
                    "build both from the same sources: `{BUILD}` and `cargo build --release`"
                ),
            });
        }
        if is_cut(&content) {
            return Err(Failure::Argument {
                message: format!("`{}` ends before its tables do: it was cut off", path.display()),
                help: format!("build it again: `{BUILD}`"),
            });
        }
        Ok(Library { content, platform, ending: DLL_SUFFIX })
    }
}

/// Whether a file of the form ELF ends before its table of sections, which stands last.
fn is_cut(content: &[u8]) -> bool {
    let number = |at: usize, bytes: usize| {
        let own = content.get(at..at + bytes)?;
        Some(own.iter().rev().fold(0_u64, |all, byte| all << 8 | u64::from(*byte)))
    };
    // By the 64-bit header: place, size and number of its entries.
    let table = || Some((number(0x28, 8)?, number(0x3A, 2)?, number(0x3C, 2)?));
    if !content.starts_with(b"\x7fELF\x02\x01") {
        return false;
    }
    table().is_none_or(|(place, size, count)| {
        place.saturating_add(size * count) > content.len() as u64
    })
}

/// The path of a file beside the program, as far as that is known.
fn beside(name: &str) -> PathBuf {
    let program = std::env::current_exe().and_then(|own| own.canonicalize());
    program.map_or_else(|_| PathBuf::from(name), |own| own.with_file_name(name))
}

fn platform() -> Option<&'static str> {
    match (OS, ARCH) {
        ("linux", "x86_64") => Some("linux64"),
        ("windows", "x86_64") => Some("win64"),
        ("macos", "x86_64") => Some("darwin64"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_library_that_was_cut_off_is_seen() {
        let own = fs::read(std::env::current_exe().unwrap()).unwrap();
        assert!(!is_cut(&own));
        if own.starts_with(b"\x7fELF\x02\x01") {
            assert!(is_cut(&own[..own.len() / 2]) && is_cut(&own[..40]));
        }
        assert!(!is_cut(b"MZ"));
    }
}
