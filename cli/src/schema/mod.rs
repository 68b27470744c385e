//! `whirl schema`: what every kind of file may say, as JSON schema for editors. It is printed from the
//! declarations through which the readers read; the readers check more (units, names, proofs).

mod json;

use whirl_codegen::spec::clearance::ClearanceSpec;
use whirl_codegen::spec::element::ElementSpec;
use whirl_codegen::spec::form::FormSpec;
use whirl_codegen::spec::law::LawSpec;
use whirl_codegen::spec::motion::MotionSpec;

use crate::arguments::SchemaKind;
use crate::case::Case;

/// The schema of a kind of file as text; without a kind, the kinds.
pub(crate) fn schema(kind: Option<SchemaKind>) -> String {
    let Some(kind) = kind else {
        return "kinds: law, element, form, motion, clearance, case\n\
                `whirl schema law > law.schema.json` writes a schema for editors\n"
            .to_string();
    };
    let schema = match kind {
        SchemaKind::Law => json::document::<LawSpec>(),
        SchemaKind::Element => json::document::<ElementSpec>(),
        SchemaKind::Form => json::document::<FormSpec>(),
        SchemaKind::Motion => json::document::<MotionSpec>(),
        SchemaKind::Clearance => json::document::<ClearanceSpec>(),
        SchemaKind::Case => json::document::<Case>(),
    };
    format!("{schema:#}\n")
}
