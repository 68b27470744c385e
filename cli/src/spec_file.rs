//! Spec files of any kind: built in, by name, or on the disk, by path.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Source, suggest};
use whirl_codegen::document::Document;
use whirl_codegen::kinds::kind::{ByKind, Kind};
use whirl_codegen::kinds::list::{KINDS, Spec};
use whirl_specs::{Origin, TABLES, generated};

use crate::{case, text_file};

/// All kinds, in the order in which people are told of them.
pub(crate) fn kinds() -> impl Iterator<Item = Kind> {
    let ByKind { laws, elements, forms, motions, clearances, films } = KINDS;
    [laws, elements, forms, motions, clearances, films].into_iter()
}

/// Reads a spec file of the kind that it says.
///
/// # Errors
/// Everything wrong with it, each with its place.
pub(crate) fn read(source: &Arc<Source>) -> Result<Spec, Diagnostics> {
    let kinds: Vec<&str> = self::kinds().map(|kind| kind.name).collect();
    let document = Document::parse(source);
    if document.is_toml() && !document.has_kind() {
        let message = format!("`{}` is not a spec file: it has no `kind`", source.path.display());
        let error = Diagnostic::new(source, Code::MISSING_KEY, None, message);
        let kinds = kinds.join("`, `").replacen('`', "\"`", 1);
        let (most, last) = kinds.rsplit_once(", ").unwrap_or(("", &kinds));
        let help = format!(
            "a spec file has `kind = \"{most} or {last}`; for a case there is `whirl check`"
        );
        return Err(error.help(help).into());
    }
    Spec::read(source, &kinds, &|name| columns(source, name))
}

/// Whether `name` is the path of a TOML file that says its `kind`, as specs do and cases do not.
pub(crate) fn is_spec(name: &str) -> bool {
    if !Path::new(name).is_file() {
        return false;
    }
    let Ok(text) = fs::read_to_string(name) else { return false };
    let source = Source::new(name, text);
    let document = Document::parse(&source);
    document.has_kind()
}

/// All specs that are built in.
pub(crate) fn built_in() -> impl Iterator<Item = &'static Origin> {
    generated::registries().into_iter().flat_map(|(_, origins)| origins)
}

/// The file of columns called `name` beside a law: on the disk, or built in.
fn columns(law: &Source, name: &str) -> Result<Arc<Source>, String> {
    let path = law.path.with_file_name(name);
    if law.path.is_file() {
        // A pipe or a device would be read without end.
        if path.exists() && !path.is_file() {
            return Err(format!("`{}` is not a file", path.display()));
        }
        return text_file::read(&path).map(|text| Source::new(path, text));
    }
    let built_in = path.strip_prefix(FOLDER).unwrap_or(&path);
    let found = TABLES.iter().find(|(other, _)| Path::new(other) == built_in);
    let (_, text) = found.ok_or_else(|| format!("there is no built-in file `{name}`"))?;
    Ok(Source::new(path, *text))
}

/// Folder under which the built-in files are shown in messages.
const FOLDER: &str = "specs";

/// The text of a built-in spec under the path at which messages show it.
pub(crate) fn built_in_source(origin: &Origin) -> Arc<Source> {
    Source::new(Path::new(FOLDER).join(origin.spec), origin.text)
}

/// The spec file that the user called `name`: a path, or the name or path of a built-in spec; with the
/// entry of the registry where its text is built in.
///
/// # Errors
/// Nothing is called so, or several are; a file that cannot be read.
pub(crate) fn find(name: &str) -> Result<(Arc<Source>, Option<&'static Origin>), Diagnostics> {
    let path = Path::new(name);
    if path.is_file() {
        let text = text_file::read(path).map_err(|error| not_found(name, error, None))?;
        let built_in_file = built_in().find(|origin| origin.text == text);
        return Ok((Source::new(path, text), built_in_file));
    }
    let wanted = name.strip_prefix("specs/").unwrap_or(name);
    let called: Vec<&Origin> =
        built_in().filter(|origin| origin.name == name || origin.spec == wanted).collect();
    match called.as_slice() {
        [origin] => Ok((built_in_source(origin), Some(origin))),
        [] => {
            let message = if path.is_dir() {
                format!("`{name}` is a folder, not a spec file")
            } else {
                format!("there is no file `{name}` and no built-in spec of this name")
            };
            let names: Vec<&str> = built_in().map(|origin| origin.name).collect();
            let help = match case::embedded_cases().any(|own| own == name) {
                true => Some(format!("it is a case: `whirl check {name}` says what it would run")),
                false => suggest(name, &names),
            };
            Err(not_found(name, message, help))
        }
        several => {
            let paths: Vec<String> =
                several.iter().map(|origin| format!("`{}`", origin.spec)).collect();
            let help = format!("give its path: {}", paths.join(" or "));
            Err(not_found(name, format!("several specs are called `{name}`"), Some(help)))
        }
    }
}

fn not_found(name: &str, message: String, help: Option<String>) -> Diagnostics {
    let source = Source::new(name, "");
    Diagnostic::new(&source, Code::BAD_VALUE, None, message).maybe_help(help).into()
}
