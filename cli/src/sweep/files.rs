//! Names of the files in the folder of a sweep, beside its journal.

/// The table.
pub(super) const CSV: &str = "table.csv";
/// The same for programs that read many rows.
pub(super) const PARQUET: &str = "table.parquet";
/// Folder of what is kept of points.
pub(super) const POINTS: &str = "points";
/// Names of all figures that a sweep may draw, without their endings.
pub(super) const FIGURES: [&str; 17] = [
    "reactions",
    "eccentricity",
    "displacement",
    "orders",
    "stresses",
    "bifurcation",
    "waterfall",
    "thresholds",
    "decrements",
    "critical-speeds",
    "frequencies",
    "amplitudes",
    "amplification",
    "coefficients",
    "margins",
    "separations",
    "moments",
];
