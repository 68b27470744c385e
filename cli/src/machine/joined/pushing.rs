//! Bushings that push away what moves.

use whirl_solver::bearing::MotionKind;
use whirl_text::rounded;

use crate::case::{Joint, JointKind, SetParameter};

/// Warnings of a bushing that pushes away what moves, as a magnetic pull does: the symmetric part of its stiffness or of
/// its damping has a negative eigenvalue.
pub(super) fn pushes_away(joint: &Joint) -> Vec<String> {
    if joint.kind != JointKind::Bushing {
        return Vec::new();
    }
    let mut warnings = of_coefficients(joint, &joint.bearing.parameters, "");
    for own in &joint.others {
        let called = if own.kind == MotionKind::Tilts { "tilting " } else { "axial " };
        warnings.extend(of_coefficients(joint, &own.parameters, called));
    }
    warnings
}

fn of_coefficients(joint: &Joint, parameters: &[SetParameter], called: &str) -> Vec<String> {
    let value = |name: String| {
        parameters.iter().find(|own| own.name() == name).map_or(0.0, SetParameter::value)
    };
    let units = if called == "tilting " { ["N m/rad", "N m s/rad"] } else { ["N/m", "N s/m"] };
    let mut warnings = Vec::new();
    for ((letter, what), unit) in [("k", "stiffness"), ("c", "damping")].into_iter().zip(units) {
        let [xx, xy, yx, yy] = ["xx", "xy", "yx", "yy"].map(|own| value(format!("{letter}_{own}")));
        let least = 0.5 * (xx + yy) - (0.5 * (xx - yy)).hypot(0.5 * (xy + yx));
        if least < -1e-9 * [xx, xy, yx, yy].map(f64::abs).into_iter().fold(0.0, f64::max) {
            let along = if called == "axial " { "" } else { " along one direction at least" };
            warnings.push(format!(
                "the {called}{what} of the bushing `{}` is negative{along} ({} {unit}): it drives the two sides apart",
                joint.name.text(),
                rounded(least, 6)
            ));
        }
    }
    warnings
}
