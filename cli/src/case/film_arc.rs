//! How far a film reaches that does not close.

use std::f64::consts::TAU;

use whirl_codegen::diagnostic::Code;
use whirl_codegen::document::Table;

/// Where a film that does not close begins, and how far it reaches (rad).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arc {
    pub(super) start: f64,
    pub(super) size: f64,
}

impl Arc {
    /// The key `arc` of the table `film`; none of a film that closes.
    pub(super) fn read(table: &Table) -> Option<Self> {
        let [start, end] = table.quantity_pair("arc")?;
        let size = end - start;
        // Across the axis x, such as from 330° to 30°.
        let size = if size < 0.0 { size + TAU } else { size };
        if !(size > 1e-9 && size < TAU * (1.0 - 1e-9)) {
            let degrees = whirl_text::rounded(size.to_degrees(), 4);
            let message = format!("`arc` reaches over {degrees}°: more than 0° and less than 360°");
            let help =
                "such as `arc = [\"240 deg\", \"300 deg\"]`; leave it out for a film that closes";
            table.push(table.written("arc").error_here(Code::BAD_VALUE, message).help(help));
            return None;
        }
        Some(Arc { start, size })
    }
}
