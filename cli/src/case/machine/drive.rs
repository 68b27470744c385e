//! The couple that drives the shaft.

use std::f64::consts::TAU;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::units::Dimension;
use whirl_solver::loads::Release;

use super::super::columns;
use super::super::library::FileStore;
use super::super::rotor::Drive;

/// The table `[drive]`; `start`: the speed of the shaft at t = 0 (rad/s), where it is known.
pub(super) fn drive(store: FileStore, file: &Table, start: Option<f64>) -> Option<Drive> {
    let one = |table: Table| {
        table.read(|table| {
            needs_a_section(table);
            leads_to_its_target(table, start, "`speed` in `[start]`");
            read_one(store, table)
        })
    };
    file.table("drive").map(one)
}

/// The couple that a table describes.
pub(in crate::case) fn read_one(store: FileStore, table: &Table) -> Drive {
    super::speed(table, "target_speed");
    let measures: [&[Dimension]; 2] =
        [&[Dimension::TIME, Dimension::ANGULAR_SPEED], &[Dimension::TORQUE]];
    let curve = columns::read(store, table, "table", measures);
    let release = table.optional_word("release");
    match table.has("table") {
        true => {
            let own = ["torque", "target_speed", "release"].into_iter();
            for key in own.filter(|key| table.has(key)) {
                let message = format!("the couple is that of the table: `{key}` has no effect");
                let help = "leave it out, or the `table`";
                table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
            }
        }
        false => ["torque", "target_speed"].iter().for_each(|key| table.demand(key)),
    }
    if table.has("section") {
        for key in ["top", "bottom"].into_iter().filter(|key| table.has(key)) {
            table.conflict(key, "section");
        }
    }
    let acts = table.optional_boolean("acts").unwrap_or(true);
    let ends = ["top", "bottom"].map(|key| table.text_or_none(key));
    Drive {
        section: table.optional_string("section").map_or_else(|| ends.into(), |own| vec![own]),
        torque: if curve.is_some() { 0.0 } else { table.quantity_or_one("torque") },
        target_speed: if curve.is_some() { 0.0 } else { table.quantity_or_one("target_speed") },
        release: if release == Some("step") { Release::AtStep } else { Release::Located },
        table: curve,
        acts,
    }
}

/// Notes a mesh that has neither two driven nodes nor a driven section.
pub(in crate::case) fn needs_a_section(table: &Table) {
    if !table.has("section") {
        ["top", "bottom"].iter().for_each(|key| table.demand(key));
    }
}

/// Notes a couple that never brings the shaft from its speed at the `start` (rad/s) to the target speed; `key`: where the
/// case may give the former. A shaft that is beyond its target already, in the direction of the couple, is not driven.
pub(in crate::case) fn leads_to_its_target(table: &Table, start: Option<f64>, key: &str) {
    let (torque, target) = (table.quantity("torque"), table.quantity("target_speed"));
    let (Some(torque), Some(target), Some(start)) = (torque, target, start) else { return };
    let leads = torque * target > 0.0 || torque * (target - start) > 0.0;
    if leads || table.optional_boolean("acts") == Some(false) {
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
    let rpm = |speed: f64| whirl_text::shown(speed * 60.0 / TAU, 6, 1e-3..1e7);
    let (place, message, help) = if torque == 0.0 {
        let message = "a `torque` of zero turns nothing".to_owned();
        (&torque_text, message, "name a couple, or write `acts = false`".to_owned())
    } else if target == start {
        let message = match start == 0.0 {
            true => "a shaft that starts at rest is at this `target_speed` at once".to_owned(),
            false => format!(
                "a shaft that starts at {} rpm is at this `target_speed` at once",
                rpm(start)
            ),
        };
        (&target_text, message, "name the speed to reach, or write `acts = false`".to_owned())
    } else {
        let from = match start == 0.0 {
            true => "rest".to_owned(),
            false => format!("{} rpm", rpm(start)),
        };
        let message = format!(
            "a couple of {} leads away from a `target_speed` of {}: the shaft starts at {from}",
            bare(&torque_text),
            bare(&target_text)
        );
        let mut help = format!("write `torque = \"{}\"`", opposite(bare(&torque_text)));
        if torque * target < 0.0 && torque * (target + start) < 0.0 {
            let other = opposite(bare(&target_text));
            help = format!(
                "write `target_speed = \"{other}\"` to turn the shaft that way, or {}",
                help.trim_start_matches("write ")
            );
        }
        let side = if torque < 0.0 { "above" } else { "below" };
        help += &format!("; to brake to the target, give a start {side} it, by {key}");
        (&target_text, message, help)
    };
    table.push(place.error_here(Code::BAD_VALUE, message).help(help));
}
