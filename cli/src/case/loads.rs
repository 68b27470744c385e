//! Loads fixed in space.

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;

/// A force on sets of shaft nodes, fixed in space: F(t) = F, or F sin(2π f t + φ).
#[derive(Debug, Clone)]
pub(crate) struct Load {
    /// Sets of the shaft's mesh; every node of each carries the force.
    pub(crate) sets: Vec<Located>,
    /// 0 for x, 1 for y.
    pub(crate) direction: usize,
    /// F in N.
    pub(crate) force: f64,
    /// f in Hz; a static load has none.
    pub(crate) frequency: Option<f64>,
    /// φ in rad.
    pub(crate) phase: f64,
}

pub(super) fn read(file: &Table) -> Vec<Load> {
    file.tables("load").into_iter().map(|table| table.read(read_one)).collect()
}

/// The load that a table describes.
pub(super) fn read_one(load: &Table) -> Load {
    if load.has("phase") && !load.has("frequency") {
        let message = "a load without `frequency` is constant: its `phase` has no effect";
        let help = "add `frequency = \"37.5 Hz\"`, or leave `phase` out";
        load.push(load.written("phase").error_here(Code::BAD_VALUE, message).help(help));
    }
    Load {
        sets: load.texts("sets"),
        direction: usize::from(load.optional_word("direction") == Some("y")),
        force: load.quantity_or_one("force"),
        frequency: load.quantity("frequency"),
        phase: load.quantity("phase").unwrap_or(0.0),
    }
}
