//! The law of a spring: a built-in one by name, or a spec file by path.

use std::path::Path;
use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Located, Source, suggest};
use whirl_codegen::spec::law::{Acts, LawSpec};
use whirl_specs::{LAWS, Law, TABLES};

use super::library::Shelf;
use super::reader::Reader;

/// Where a law comes from.
#[derive(Debug, Clone)]
pub enum LawSource {
    /// Compiled into the program.
    BuiltIn(&'static Law),
    /// A spec file, evaluated at run time.
    File(Arc<LawSpec>),
}

/// A law, and where the case names it.
#[derive(Debug, Clone)]
pub struct NamedLaw {
    /// The law.
    pub source: LawSource,
    /// The value of the key `law`.
    pub name: Located,
}

impl LawSource {
    /// How results call the law: its name, or the path of its file.
    pub fn name(&self) -> String {
        match self {
            LawSource::BuiltIn(law) => law.origin.name.to_string(),
            LawSource::File(spec) => spec.file.path.display().to_string(),
        }
    }

    /// Whether the law is one of springs or of rings.
    pub fn acts(&self) -> Acts {
        match self {
            LawSource::BuiltIn(law) => {
                let gives = |acts: &Acts| {
                    let forces = acts.outputs().iter();
                    law.outputs.iter().any(|own| forces.clone().any(|force| force.name == own.name))
                };
                Acts::ALL.into_iter().find(gives).unwrap_or(Acts::Spring)
            }
            LawSource::File(spec) => spec.acts,
        }
    }

    /// The spec, read again for a built-in law.
    ///
    /// # Panics
    /// If a built-in law has errors: it was read without any when its kernel was generated.
    pub fn spec(&self) -> Arc<LawSpec> {
        match self {
            LawSource::BuiltIn(law) => {
                let source = Source::new(format!("specs/{}", law.origin.spec), law.origin.text);
                let spec = LawSpec::read_with(&source, &|name| built_in_table(law, name));
                Arc::new(spec.expect("built-in laws have no errors"))
            }
            LawSource::File(spec) => spec.clone(),
        }
    }
}

/// The file of columns called `name` beside a built-in law.
fn built_in_table(law: &Law, name: &str) -> Result<Arc<Source>, String> {
    let path = Path::new(law.origin.spec).with_file_name(name);
    let found = TABLES.iter().find(|(other, _)| Path::new(other) == path);
    let (_, text) = found.ok_or_else(|| format!("there is no file `{name}`"))?;
    Ok(Source::new(Path::new("specs").join(path), *text))
}

/// The law that `law` of a table names, and where it does, if the key is there.
pub(super) fn read(shelf: Shelf, table: &Reader) -> Option<NamedLaw> {
    let name = table.text("law")?;
    find(shelf, table, &name).map(|source| NamedLaw { source, name })
}

/// The law called `name`; what is wrong with it is noted in `table`.
pub(super) fn find(shelf: Shelf, table: &Reader, name: &Located) -> Option<LawSource> {
    if name.text().ends_with(".toml") {
        return read_file(shelf, table, name);
    }
    let law = LAWS.iter().find(|law| law.origin.name == name.text());
    if law.is_none() {
        let known: Vec<&str> = LAWS.iter().map(|law| law.origin.name).collect();
        let message = format!("there is no law `{}`", name.text());
        let error = name.error_here(Code::BAD_VALUE, message);
        table.push(error.maybe_help(suggest(name.text(), &known)));
    }
    law.map(LawSource::BuiltIn)
}

fn read_file(shelf: Shelf, table: &Reader, name: &Located) -> Option<LawSource> {
    let source = match shelf.read_beside(name.source(), name.text()) {
        Ok(source) => source,
        Err(message) => {
            let error = name.error_here(Code::BAD_VALUE, message);
            table.push(error.help("paths are relative to the file that names them"));
            return None;
        }
    };
    match LawSpec::read_with(&source, &|name| shelf.read_beside(&source, name)) {
        Ok(spec) => Some(LawSource::File(Arc::new(spec))),
        Err(errors) => {
            errors.into_iter().for_each(|error| table.push(error));
            None
        }
    }
}
