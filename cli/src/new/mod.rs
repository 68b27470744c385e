//! `whirl new`: a commented file to start from.

mod from_meshes;
mod from_rotor;

use std::fs::OpenOptions;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use whirl_codegen::diagnostic::{Code, Diagnostic, Source, suggest};

use crate::arguments::{NewArguments, NewKind};
use crate::case::{embedded_case, embedded_cases};
use crate::created::CreatedFolders;
use crate::errors::Failure;
use crate::text_file;

pub use self::from_rotor::FromRotor;

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
    let like = arguments.like.as_deref();
    let name = arguments.name.as_deref().or(like).unwrap_or("case");
    check_name(*kind, name)?;
    let file = format!("{name}.toml");
    // Shown without the folder where there is none.
    let path = if dir == Path::new(".") { PathBuf::from(file) } else { dir.join(file) };
    let made_from = arguments.shaft.is_some() || arguments.from.is_some() || like.is_some();
    if made_from && *kind != NewKind::Case {
        return Err(Failure::Argument {
            message: "`--like`, `--from`, `--shaft` and `--support` are of `whirl new case`".to_owned(),
            help: "leave them out, or write `whirl new case --from FILE`, or `--shaft FILE --support FILE`"
                .to_owned(),
        });
    }
    if let Some(from) = &arguments.from {
        return of_rotor(from, (name, &path, dir));
    }
    let (text, decided) = match (&arguments.shaft, &arguments.support) {
        (Some(shaft), Some(support)) => {
            // What is there already is said before meshes are read.
            if path.exists() {
                return Err(taken(&path));
            }
            from_meshes::case([shaft, support], arguments.units.as_deref(), dir)?
        }
        _ if like.is_some() => (built_in(like.unwrap_or_default())?, String::new()),
        _ => (template(*kind).replace(NAME, name), String::new()),
    };
    write(dir, &[(&path, &text)])?;
    Ok(format!("{}\n{decided}{}", path.display(), next(*kind, &path)))
}

/// The text of a built-in case, to be changed.
fn built_in(name: &str) -> Result<String, Failure> {
    let known: Vec<&str> = embedded_cases().collect();
    let Some(text) = embedded_case(name) else {
        let message = format!("there is no built-in case `{}`", name.escape_debug());
        let others = known.iter().map(|own| format!("`{own}`")).collect::<Vec<_>>().join(", ");
        let help = suggest(name, &known).unwrap_or_else(|| format!("built-in cases are {others}"));
        return Err(Failure::Argument { message, help });
    };
    Ok(format!(
        "# As the built-in case `{name}`. Files that it names and that are not beside it are built in, too.\n{text}"
    ))
}

/// A case from a rotor that another program saved, with files beside it for tables over the speed.
fn of_rotor(from: &Path, (name, path, dir): (&str, &Path, &Path)) -> Result<String, Failure> {
    // What is there already is said before anything is read.
    if path.exists() {
        return Err(taken(path));
    }
    let made = rotor(from, name)?;
    let beside: Vec<PathBuf> = made.files.iter().map(|own| path.with_file_name(&own.0)).collect();
    let texts = beside.iter().zip(made.files.iter().map(|own| own.1.as_str()));
    let mut all: Vec<(&Path, &str)> = texts.map(|(path, text)| (path.as_path(), text)).collect();
    all.push((path, &made.text));
    write(dir, &all)?;
    let mut said = format!("{}\n", path.display());
    beside.iter().for_each(|own| said += &format!("{}\n", own.display()));
    made.notes.iter().for_each(|own| said += &format!("{own}\n"));
    let path = path.display();
    Ok(format!("{said}edit it, then: whirl check {path}, whirl analyse {path}\n"))
}

/// What [`of_rotor`] writes, for a case that will be called `name`.
///
/// # Errors
/// A file that is none of a rotor, and everything in it that no rotor has.
pub(crate) fn rotor(from: &Path, name: &str) -> Result<FromRotor, Failure> {
    let text = text_file::read(from).map_err(|message| Failure::Argument {
        message,
        help: "name a file that `rotor.save(\"rotor.toml\")` or `rotor.save(\"rotor.json\")` wrote"
            .to_owned(),
    })?;
    from_rotor::case(&Source::new(from, text), name)
}

/// Writes files that are not there yet, all of them or nothing.
fn write(dir: &Path, files: &[(&Path, &str)]) -> Result<(), Failure> {
    let first = files.first().map_or(dir, |own| own.0);
    let failure =
        |path: &Path, reason: String| Failure::Output { path: path.to_path_buf(), reason };
    let mut created = CreatedFolders::missing(dir);
    std::fs::create_dir_all(dir).map_err(|error| failure(first, error.to_string()))?;
    let mut written: Vec<&Path> = Vec::with_capacity(files.len());
    for (path, text) in files {
        // Made anew or not at all: an older file is never written over, not even by two commands at once.
        let file = OpenOptions::new().write(true).create_new(true).open(path);
        let done = match file {
            Ok(mut file) => {
                written.push(path);
                file.write_all(text.as_bytes()).map_err(|error| failure(path, error.to_string()))
            }
            Err(error) if error.kind() == ErrorKind::AlreadyExists => Err(taken(path)),
            Err(error) => Err(failure(path, error.to_string())),
        };
        if let Err(error) = done {
            written.iter().for_each(|own| drop(std::fs::remove_file(own)));
            return Err(error);
        }
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
