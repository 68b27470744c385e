//! Speeds of rotation.

use std::f64::consts::TAU;

use whirl_codegen::diagnostic::Code;
use whirl_codegen::document::Table;

/// Beyond any machine, but far below where numbers end (rad/s): ten million revolutions per minute.
pub(in crate::case) const MOST_SPEED: f64 = 1e7 * TAU / 60.0;

/// A speed of rotation (rad/s); one that no machine has is noted.
pub(in crate::case) fn speed(table: &Table, key: &str) -> Option<f64> {
    let speed = table.quantity(key)?;
    if speed.abs() > MOST_SPEED {
        let message = format!("`{key}` is faster than any machine turns");
        let help = format!("write at most `{key} = \"1e7 rpm\"`");
        table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
    }
    Some(speed)
}
