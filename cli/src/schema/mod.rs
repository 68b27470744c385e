//! `whirl schema`: what every kind of file may say, as JSON schema for editors. The readers check more
//! (units, names, proofs); a test holds the keys of both together.

mod case;
mod shape;
mod specs;

use crate::arguments::SchemaKind;

/// The schema of a kind of file as text; without a kind, the kinds.
pub(crate) fn schema(kind: Option<SchemaKind>) -> String {
    let Some(kind) = kind else {
        return "kinds: law, element, form, motion, clearance, case\n\
                `whirl schema law > law.schema.json` writes a schema for editors\n"
            .to_string();
    };
    let (shape, title) = match kind {
        SchemaKind::Law => (specs::law(), "whirl: bearing law"),
        SchemaKind::Element => (specs::element(), "whirl: finite element"),
        SchemaKind::Form => (specs::form(), "whirl: bilinear forms"),
        SchemaKind::Motion => (specs::motion(), "whirl: motion of a shaft"),
        SchemaKind::Clearance => (specs::clearance(), "whirl: clearance of springs"),
        SchemaKind::Case => (case::case(), "whirl: case or machine"),
    };
    format!("{:#}\n", shape.document(title))
}
