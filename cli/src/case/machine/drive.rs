//! The couple that drives the shaft.

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;

use super::super::rotor::Drive;

/// The table `[drive]`.
pub(super) fn drive(file: &Table) -> Option<Drive> {
    file.table("drive").map(|table| table.read(read_one))
}

/// The couple that a table describes.
pub(in crate::case) fn read_one(table: &Table) -> Drive {
    leads_to_its_target(table);
    Drive {
        top: table.text_or_none("top"),
        bottom: table.text_or_none("bottom"),
        torque: table.quantity_or_one("torque"),
        target_speed: table.quantity_or_one("target_speed"),
        acts: table.optional_boolean("acts").unwrap_or(true),
    }
}

/// Notes a couple that never brings the shaft to the target speed: it starts at rest.
fn leads_to_its_target(table: &Table) {
    let (torque, target) = (table.quantity("torque"), table.quantity("target_speed"));
    let (Some(torque), Some(target)) = (torque, target) else { return };
    if torque * target > 0.0 || table.optional_boolean("acts") == Some(false) {
        return;
    }
    // What stands there is a string, with its quotes.
    let written = |key: &str| {
        let place = table.written(key);
        let bare = place.text().trim_matches(['"', '\'']).to_owned();
        Located::new(place.source(), place.span(), bare)
    };
    let (torque_text, target_text) = (written("torque"), written("target_speed"));
    let bare = |located: &Located| located.text().trim_matches(['"', '\'']).trim().to_owned();
    let opposite = |text: String| match text.strip_prefix('-') {
        Some(rest) => rest.trim_start().to_owned(),
        None => format!("-{}", text.trim_start_matches('+')),
    };
    let (place, message, help) = if target == 0.0 {
        let message = "a shaft that starts at rest is at this `target_speed` at once".to_owned();
        (&target_text, message, "name the speed to reach, or write `acts = false`".to_owned())
    } else if torque == 0.0 {
        let message = "a `torque` of zero turns nothing".to_owned();
        (&torque_text, message, "name a couple, or write `acts = false`".to_owned())
    } else {
        let message = format!(
            "a couple of {} leads away from a `target_speed` of {}",
            bare(&torque_text),
            bare(&target_text)
        );
        let help = format!(
            "write `target_speed = \"{}\"` to turn the shaft that way, or `torque = \"{}\"`",
            opposite(bare(&target_text)),
            opposite(bare(&torque_text))
        );
        (&target_text, message, help)
    };
    table.push(place.error_here(Code::BAD_VALUE, message).help(help));
}
