//! Gravity on all bodies.

use whirl_codegen::diagnostic::Located;
use whirl_codegen::document::Table;

/// Gravity, fixed in space.
#[derive(Debug, Clone)]
pub(crate) struct Gravity {
    /// m/s² along x, y and z.
    pub(crate) acceleration: [f64; 3],
    /// Where the case says it.
    pub(crate) place: Located,
}

pub(super) fn read(file: &Table) -> Option<Gravity> {
    let acceleration = file.quantity_triple("gravity")?;
    Some(Gravity { acceleration, place: file.written("gravity") })
}
