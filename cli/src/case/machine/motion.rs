//! How rotation is coupled to deformation.

use whirl_codegen::diagnostic::{Code, suggest};
use whirl_codegen::document::Table;
use whirl_specs::{MOTIONS, Motion};

/// The motion derived from the kinetic energy.
const DEFAULT_MOTION: &str = "consistent";

/// The motion that a table names, or the default one.
pub(in crate::case) fn motion(table: &Table) -> Option<&'static Motion> {
    let name = table.optional_string("motion");
    let wanted = name.as_ref().map_or(DEFAULT_MOTION, |name| name.text()).to_string();
    let found = called(&wanted);
    if found.is_none() {
        let known: Vec<&str> = MOTIONS.iter().map(|motion| motion.origin.name).collect();
        let place = name.unwrap_or_else(|| table.heading().text(""));
        let error = place.error_here(Code::BAD_VALUE, format!("there is no motion `{wanted}`"));
        table.push(error.maybe_help(suggest(&wanted, &known)));
    }
    found
}

fn called(name: &str) -> Option<&'static Motion> {
    MOTIONS.iter().find(|motion| motion.origin.name == name)
}

/// In place of one that is not there, which has been noted.
pub(in crate::case) fn default_motion() -> Option<&'static Motion> {
    called(DEFAULT_MOTION)
}
