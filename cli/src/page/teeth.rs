//! The normal force between the teeth of gears, from the force on the first of both.

use serde::{Deserialize, Serialize};

use super::contacts::Contact;
use crate::case::{Case, Joint};
use crate::case::{Gears, axes_apart};

/// Gears that mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Teeth {
    pub(super) title: String,
    /// Columns of the force on the first gear along x and y (N).
    pub(super) forces: [String; 2],
    /// The normal force is the force on the first gear by these, summed.
    pub(super) by: [f64; 2],
    /// Whether the teeth can part.
    pub(super) backlash: bool,
}

impl Teeth {
    /// Of every pair of gears of a case.
    pub(super) fn all(case: &Case) -> Vec<Self> {
        let supports = case.supports();
        let of = |(place, joint): (usize, &Joint)| {
            let gears = joint.gears.as_ref()?;
            let own = &supports[place];
            let [Some(first), Some(second)] = joint.sides.each_ref().map(|side| side.body) else {
                return None;
            };
            let apart = axes_apart([first, second].map(|own| &case.machine.bodies[own]));
            Some(Teeth {
                title: own.title.clone(),
                forces: ["RX", "RY"].map(|quantity| own.column(quantity, "N")),
                by: by(gears, apart),
                backlash: gears.backlash,
            })
        };
        case.machine.joints.iter().enumerate().filter_map(of).collect()
    }

    /// The normal force (N), above zero on the first of its flanks and below it on the other one; `force`: on the first gear.
    pub(super) fn normal(&self, force: [f64; 2]) -> f64 {
        self.by[0] * force[0] + self.by[1] * force[1]
    }
}

/// By what the force on the first gear is to be multiplied: along the common tangent, of which each flank has the same part.
fn by(gears: &Gears, apart: [f64; 2]) -> [f64; 2] {
    let flanks = gears.flanks(apart);
    let along = |own: usize| {
        let (sin, cos) = flanks[own].direction.sin_cos();
        [cos, sin]
    };
    let first = along(0);
    let tangent = match flanks.len() {
        1 => first,
        _ => [0, 1].map(|axis| first[axis] - along(1)[axis]),
    };
    let part = tangent[0] * first[0] + tangent[1] * first[1];
    tangent.map(|own| -own / part)
}

/// The teeth of a pair over the whole run, as a page has them.
#[derive(Debug, Serialize)]
pub(super) struct TeethRun {
    pub(super) title: String,
    pub(super) backlash: bool,
    /// While they were apart; none where they never were.
    pub(super) apart: Option<Contact>,
}

#[cfg(test)]
mod tests {
    use whirl_codegen::diagnostic::Located;

    use super::*;

    /// Each flank's own force is found whatever the angle, and has its sign.
    #[test]
    fn the_force_of_each_flank_is_found() {
        for (internal, alpha, backlash) in [
            (false, 20_f64, true),
            (false, 20.0, false),
            (false, -25.0, false),
            (true, 20.0, true),
            (false, 0.0, true),
        ] {
            let gears = Gears {
                teeth: Some([23.0, 67.0]),
                radii: None,
                internal,
                pressure_angle: alpha.to_radians(),
                backlash,
                place: Located::alone("case", "gear"),
            };
            let apart = [0.03, 0.17];
            let own = Teeth {
                title: String::new(),
                forces: [String::new(), String::new()],
                by: by(&gears, apart),
                backlash,
            };
            for (flank, sign) in gears.flanks(apart).iter().zip([1.0, -1.0]) {
                let (sin, cos) = flank.direction.sin_cos();
                let found = own.normal([-700.0 * cos, -700.0 * sin]);
                assert!((found - sign * 700.0).abs() < 1e-9, "{found} {alpha} {internal}");
            }
        }
    }
}
