//! What is seen at a section, in the units of files.

use num_complex::Complex64;
use whirl_solver::linear::Along;

/// What is seen at a section: the name of its columns, and their unit, and that in SI.
pub(super) const QUANTITIES: [(&str, &str, f64); 9] = [
    ("ux", "um", 1e6),
    ("uy", "um", 1e6),
    ("uz", "um", 1e6),
    ("shear_x", "N", 1.0),
    ("shear_y", "N", 1.0),
    ("axial", "N", 1.0),
    ("moment_x", "Nm", 1.0),
    ("moment_y", "Nm", 1.0),
    ("torque", "Nm", 1.0),
];

/// The values of a section in the units of files.
pub(super) fn values(own: &Along) -> [Complex64; 9] {
    let all = [own.displacement, own.force, own.moment].concat();
    std::array::from_fn(|k| all[k] * QUANTITIES[k].2)
}
