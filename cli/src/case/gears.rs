//! Two gears that mesh, as a joint describes them.
//!
//! The teeth of the first push those of the second along the line of action, which is inclined by the pressure angle α from the
//! common tangent of both pitch circles. With the x axis from the centre of the first to that of the second, the force on the
//! second is along (sin α, cos α) where the first pushes it from x to y, and along (sin α, −cos α) on the other flank.

use std::f64::consts::{FRAC_PI_2, PI};

use whirl_codegen::diagnostic::Located;
use whirl_solver::bearing::Flank;

/// Two gears that mesh.
#[derive(Debug, Clone)]
pub(crate) struct Gears {
    /// Numbers of teeth, if the case gives them.
    pub(crate) teeth: Option<[f64; 2]>,
    /// Pitch radii (m), if the case gives them.
    pub(crate) radii: Option<[f64; 2]>,
    /// Whether the larger one has its teeth inside.
    pub(crate) internal: bool,
    /// α (rad); below zero on the flank on which the first gear pushes the second from y to x.
    pub(crate) pressure_angle: f64,
    /// Whether there is backlash, so that both flanks count.
    pub(crate) backlash: bool,
    /// Where the case says the sizes.
    pub(crate) place: Located,
}

impl Gears {
    /// Size of the first over that of the second.
    fn sizes(&self) -> f64 {
        let [first, second] = self.teeth.or(self.radii).unwrap_or([1.0; 2]);
        first / second
    }

    /// Speed of the second over that of the first.
    pub(crate) fn ratio(&self) -> f64 {
        if self.internal { self.sizes() } else { -self.sizes() }
    }

    /// Pitch radii (m) of gears whose axes are so far apart.
    pub(crate) fn pitch_radii(&self, distance: f64) -> [f64; 2] {
        let sizes = self.sizes();
        let second = distance / if self.internal { (1.0 - sizes).abs() } else { 1.0 + sizes };
        [sizes * second, second]
    }

    /// Distance of the axes by the pitch radii (m), if the case gives these.
    pub(crate) fn distance(&self) -> Option<f64> {
        let [first, second] = self.radii?;
        Some(if self.internal { (first - second).abs() } else { first + second })
    }

    /// The flanks that may touch: the one by the sign of the pressure angle, and with backlash the other one. `apart`: axis of
    /// the second less that of the first (m).
    pub(crate) fn flanks(&self, apart: [f64; 2]) -> Vec<Flank> {
        let centres = apart[1].atan2(apart[0]);
        let radii = self.pitch_radii(apart[0].hypot(apart[1]));
        let cos = self.pressure_angle.cos();
        let [first, second] = radii.map(|radius| radius * cos);
        let flank = |alpha: f64, sense: f64| {
            // Where the first is inside, it pushes the second away from the centre of that.
            let inside = self.internal && radii[0] < radii[1];
            let along = if inside {
                -FRAC_PI_2 - alpha
            } else if self.internal {
                FRAC_PI_2 + alpha
            } else {
                FRAC_PI_2 - alpha
            };
            let (turned, second) =
                (if sense < 0.0 { PI } else { 0.0 }, if self.internal { -second } else { second });
            Flank { direction: centres + along + turned, radii: [sense * first, sense * second] }
        };
        let alpha = self.pressure_angle;
        match self.backlash {
            // Both flanks push, whichever of them the case names.
            true => vec![flank(alpha.abs(), 1.0), flank(-alpha.abs(), -1.0)],
            false => vec![flank(alpha, 1.0)],
        }
    }
}

#[cfg(test)]
mod tests {
    use whirl_codegen::diagnostic::Located;

    use super::*;

    fn gears(sizes: [f64; 2], internal: bool) -> Gears {
        Gears {
            teeth: Some(sizes),
            radii: None,
            internal,
            pressure_angle: 20_f64.to_radians(),
            backlash: true,
            place: Located::alone("case", "gear"),
        }
    }

    /// A force through the pitch point has the moments about both centres that the base radii say, and pushes the teeth apart.
    #[test]
    fn lines_of_action_pass_through_the_pitch_point() {
        for (sizes, internal) in [
            ([20.0, 30.0], false),
            ([30.0, 20.0], false),
            ([20.0, 60.0], true),
            ([60.0, 20.0], true),
        ] {
            let own = gears(sizes, internal);
            for turn in [0.0, 0.7, 2.9, -2.0] {
                let apart = [0.1 * f64::cos(turn), 0.1 * f64::sin(turn)];
                let radii = own.pitch_radii(0.1);
                // From the first centre to the pitch point, along the line of centres.
                let side = if internal && sizes[0] < sizes[1] { -1.0 } else { 1.0 };
                let pitch = apart.map(|x| side * x / 0.1 * radii[0]);
                for flank in own.flanks(apart) {
                    let (y, x) = flank.direction.sin_cos();
                    let moment =
                        |at: [f64; 2], force: [f64; 2]| at[0] * force[1] - at[1] * force[0];
                    let on_first = moment(pitch, [-x, -y]);
                    let on_second = moment([pitch[0] - apart[0], pitch[1] - apart[1]], [x, y]);
                    // Of F_n = −1 on e_n = n·(u₁ − u₂) + r₁θ₁ + r₂θ₂.
                    assert!((on_first + flank.radii[0]).abs() < 1e-15, "{flank:?}");
                    assert!((on_second + flank.radii[1]).abs() < 1e-15, "{flank:?}");
                    assert!((-flank.radii[0] / flank.radii[1] - own.ratio()).abs() < 1e-14);
                }
            }
        }
    }

    /// Both flanks push the gears apart along the line of centres; an internal one pushes its partner into the middle.
    #[test]
    fn flanks_push_outwards() {
        for (sizes, internal, outwards) in
            [([20.0, 30.0], false, 1.0), ([20.0, 60.0], true, -1.0), ([60.0, 20.0], true, -1.0)]
        {
            for sign in [1.0, -1.0] {
                let alpha = sign * 20_f64.to_radians();
                let own = Gears { pressure_angle: alpha, ..gears(sizes, internal) };
                for flank in own.flanks([0.1, 0.0]) {
                    let expected = outwards * alpha.abs().sin();
                    assert!(
                        (flank.direction.cos() - expected).abs() < 1e-15,
                        "{sizes:?} {flank:?}"
                    );
                }
            }
        }
    }
}
