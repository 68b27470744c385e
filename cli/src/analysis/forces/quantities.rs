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

/// How much there is of some quantities together: of two that are at right angles the major semi-axis.
pub(super) fn size(own: &[Complex64; 9], which: &[usize]) -> f64 {
    match *which {
        [x, y] => whirl_solver::linear::Orbit::new([own[x], own[y]]).major,
        _ => which.iter().map(|&k| own[k].norm()).fold(0.0, f64::max),
    }
}
