//! The law of a spring: a built-in one by name, or a spec file by path.

use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Located, Source, suggest};
use whirl_specs::{LAWS, Law};

use super::library::{Shelf, resolve};
use super::reader::Reader;

/// Where a law comes from.
#[derive(Debug, Clone)]
pub enum LawSpec {
    /// Compiled into the program.
    BuiltIn(&'static Law),
    /// A spec file, read and evaluated at run time.
    File(Arc<Source>),
}

impl LawSpec {
    /// How results call the law: its name, or the path of its file.
    pub fn name(&self) -> String {
        match self {
            LawSpec::BuiltIn(law) => law.origin.name.to_string(),
            LawSpec::File(source) => source.path.display().to_string(),
        }
    }
}

/// The law that `law` of a table names, if the key is there.
pub(super) fn read(shelf: Shelf, table: &Reader) -> Option<LawSpec> {
    let name = table.text("law")?;
    if name.text().ends_with(".toml") {
        return read_file(shelf, table, &name);
    }
    let law = LAWS.iter().find(|law| law.origin.name == name.text());
    if law.is_none() {
        let known: Vec<&str> = LAWS.iter().map(|law| law.origin.name).collect();
        let message = format!("there is no law `{}`", name.text());
        let error = name.error_here(Code::BAD_VALUE, message);
        table.push(error.maybe_help(suggest(name.text(), &known)));
    }
    law.map(LawSpec::BuiltIn)
}

fn read_file(shelf: Shelf, table: &Reader, name: &Located) -> Option<LawSpec> {
    match shelf.read(&resolve(name.source(), name.text())) {
        Ok(source) => Some(LawSpec::File(source)),
        Err(message) => {
            let error = name.error_here(Code::BAD_VALUE, message);
            table.push(error.help("paths are relative to the file that names them"));
            None
        }
    }
}
