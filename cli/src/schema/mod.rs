//! `whirl schema`: what every kind of file may say, as JSON schema for editors and as a page. Both are printed from the
//! declarations through which the readers read; the readers check more (units, names, proofs).

mod json;
mod page;

use whirl_codegen::document::schema::Shape;

use crate::case::Case;
use crate::spec_file;
use crate::sweep::Sweep;

/// Kinds of files: word, title, and what they may say.
pub(crate) fn kinds() -> impl Iterator<Item = (&'static str, &'static str, &'static Shape)> {
    let specs = spec_file::kinds().map(|kind| (kind.name, kind.title, kind.shape));
    specs.chain([("case", Case::TITLE, Case::SHAPE), ("sweep", Sweep::TITLE, Sweep::SHAPE)])
}

/// The schema of a kind of file as text, for editors or as a page; without a kind, the kinds.
pub(crate) fn schema(kind: Option<&str>, as_page: bool) -> String {
    match kinds().find(|(name, ..)| Some(*name) == kind) {
        Some((name, title, shape)) if as_page => page::page(name, title, shape),
        Some((_, title, shape)) => format!("{:#}\n", json::document(title, shape)),
        None => {
            let names: Vec<&str> = kinds().map(|(name, ..)| name).collect();
            format!(
                "kinds: {}\n`whirl schema law > law.schema.json` writes a schema for editors\n",
                names.join(", ")
            )
        }
    }
}
