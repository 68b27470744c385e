//! Words of messages for lengths and directions.

/// Letters of the components of a dof.
pub(super) const AXES: [&str; 3] = ["x", "y", "z"];

/// A length in mm, to the nanometre.
pub(super) fn mm(metres: f64) -> String {
    // Adding zero takes the sign off what rounds to it.
    format!("{} mm", (1e9 * metres).round() / 1e6 + 0.0)
}
