//! `whirl new`: a commented file to start from.

mod from_meshes;

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use whirl_codegen::diagnostic::{Code, Diagnostic, Source};

use crate::arguments::{NewArguments, NewKind};
use crate::created::CreatedFolders;
use crate::errors::Failure;

/// Stands in the templates where the name belongs.
const NAME: &str = "@NAME@";

/// The text of a new file, with [`NAME`] for its name.
fn template(kind: NewKind) -> &'static str {
    match kind {
        NewKind::Law => include_str!("law.toml"),
        NewKind::Element => include_str!("element.toml"),
        NewKind::Case => include_str!("case.toml"),
    }
}

/// Writes the file and says what to do with it.
///
/// # Errors
/// A name that cannot be one, a file of this name that is there already, a folder that cannot be written.
pub(crate) fn new(arguments: &NewArguments) -> Result<String, Failure> {
    let NewArguments { kind, dir, .. } = arguments;
    let name = arguments.name.as_deref().unwrap_or("case");
    check_name(*kind, name)?;
    let file = format!("{name}.toml");
    // Shown without the folder where there is none.
    let path = if dir == Path::new(".") { PathBuf::from(file) } else { dir.join(file) };
    let (text, decided) = match (&arguments.shaft, &arguments.support) {
        (Some(_), Some(_)) if *kind != NewKind::Case => {
            return Err(Failure::Argument {
                message: "`--shaft` and `--support` are of `whirl new case`".to_owned(),
                help: "leave them out, or write `whirl new case --shaft FILE --support FILE`"
                    .to_owned(),
            });
        }
        (Some(shaft), Some(support)) => {
            // What is there already is said before meshes are read.
            if path.exists() {
                return Err(taken(&path));
            }
            from_meshes::case([shaft, support], arguments.units.as_deref(), dir)?
        }
        _ => (template(*kind).replace(NAME, name), String::new()),
    };
    write(&path, dir, &text)?;
    Ok(format!("{}\n{decided}{}", path.display(), next(*kind, &path)))
}

/// Writes a file that is not there yet, all of it or nothing.
fn write(path: &Path, dir: &Path, text: &str) -> Result<(), Failure> {
    let failure = |reason: String| Failure::Output { path: path.to_path_buf(), reason };
    let mut created = CreatedFolders::missing(dir);
    std::fs::create_dir_all(dir).map_err(|error| failure(error.to_string()))?;
    // Made anew or not at all: an older file is never written over, not even by two commands at once.
    let mut file = match OpenOptions::new().write(true).create_new(true).open(path) {
        Ok(file) => file,
        Err(error) if error.kind() == ErrorKind::AlreadyExists => return Err(taken(path)),
        Err(error) => return Err(failure(error.to_string())),
    };
    if let Err(error) = file.write_all(text.as_bytes()) {
        let _ = std::fs::remove_file(path);
        return Err(failure(error.to_string()));
    }
    created.keep();
    Ok(())
}

/// What comes next.
fn next(kind: NewKind, path: &Path) -> String {
    let path = path.display();
    match kind {
        NewKind::Law => format!(
            "edit it, then: whirl check {path}, whirl explain {path}; a case names it by `law = \"{path}\"`\n"
        ),
        NewKind::Element => format!(
            "edit it, then: whirl check {path}; in `specs/elements` it is compiled at the next build\n"
        ),
        NewKind::Case => format!("edit it, then: whirl check {path}, whirl run {path}\n"),
    }
}

/// Names become names of files and of kernels.
fn check_name(kind: NewKind, name: &str) -> Result<(), Failure> {
    const LONGEST: usize = 60;
    // The name of an element is that of a type in mesh files too.
    let dots = kind != NewKind::Element;
    let fine = |c: char| c.is_ascii_alphanumeric() || matches!(c, '-' | '_') || dots && c == '.';
    let starts = name.starts_with(|c: char| c.is_ascii_alphabetic());
    if starts && name.len() <= LONGEST && name.chars().all(fine) && !name.ends_with(".toml") {
        return Ok(());
    }
    let bare = name.strip_suffix(".toml").filter(|bare| !bare.is_empty());
    let help = match bare {
        Some(bare) if check_name(kind, bare).is_ok() => format!("leave the ending out: `{bare}`"),
        _ => format!(
            "a letter, then letters, digits, `-` and `_`, {LONGEST} at most; the folder goes to `--dir`"
        ),
    };
    let source = Source::new(PathBuf::from("NAME"), "");
    let message = format!("`{name}` cannot be the name of a new file");
    Err(Failure::Input(Diagnostic::new(&source, Code::BAD_NAME, None, message).help(help).into()))
}

fn taken(path: &Path) -> Failure {
    let source = Source::new(path, "");
    let message = format!("`{}` already exists and is left unchanged", path.display());
    let error = Diagnostic::new(&source, Code::BAD_NAME, None, message);
    Failure::Input(error.help("choose another name, or another folder with `--dir DIR`").into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_checked() {
        for name in ["a", "my-law", "ball.bearing_2", "Hex8"] {
            assert!(check_name(NewKind::Law, name).is_ok(), "{name}");
        }
        let long = "x".repeat(61);
        for name in ["", "-law", "2law", ".", "..", "a/b", "a\\b", "a b", "ü", "law.toml", &long] {
            assert!(check_name(NewKind::Case, name).is_err(), "{name}");
        }
        assert!(check_name(NewKind::Element, "ball.bearing").is_err());
    }
}
