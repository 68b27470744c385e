//! Mass and inertia of what is turned about an axis.

use std::f64::consts::PI;

/// A piece of a body of revolution, as a rigid body on its axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Ring {
    /// z of its centre of mass, m.
    pub(crate) z: f64,
    /// kg.
    pub(crate) mass: f64,
    /// About the axis and about a diameter through its centre of mass, kg m².
    pub(crate) inertias: [f64; 2],
}

impl Ring {
    /// Between two z (m), of a density (kg/m³) and the difference r₂ⁿ − r₁ⁿ of its radii at a z, n 2 or 4: exact of cones.
    ///
    /// A mass of at most a billionth of `beside` counts as zero.
    pub(crate) fn new(
        between: [f64; 2],
        density: f64,
        beside: f64,
        radii: impl Fn(f64, i32) -> f64,
    ) -> Ring {
        let integral = |f: &dyn Fn(f64) -> f64| density * PI * gauss(between, f);
        let mass = integral(&|z| radii(z, 2));
        let polar = 0.5 * integral(&|z| radii(z, 4));
        if mass <= 1e-9 * beside {
            let z = 0.5 * (between[0] + between[1]);
            return Ring { z, mass: 0.0, inertias: [polar, 0.5 * polar] };
        }
        let z = (integral(&|z| z * radii(z, 2)) / mass).clamp(between[0], between[1]);
        let along = integral(&|own| (own - z).powi(2) * radii(own, 2)).max(0.0);
        Ring { z, mass, inertias: [polar, 0.5 * polar + along] }
    }
}

/// ∫ f dz by three points: exact of polynomials up to the fifth degree.
fn gauss([from, to]: [f64; 2], f: &dyn Fn(f64) -> f64) -> f64 {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let away = half * 0.6_f64.sqrt();
    half * (5.0 * f(middle - away) + 8.0 * f(middle) + 5.0 * f(middle + away)) / 9.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cone_is_that_of_its_closed_forms() {
        // From its base, 0.3 m wide and 0.9 m high.
        let (r, h, density) = (0.3, 0.9, 7000.0);
        let own = Ring::new([0.0, h], density, 0.0, |z, n| (r * (1.0 - z / h)).powi(n));
        let mass = density * PI * r * r * h / 3.0;
        let known = [h / 4.0, mass, 0.3 * mass * r * r, 0.15 * mass * (r * r + h * h / 4.0)];
        let found = [own.z, own.mass, own.inertias[0], own.inertias[1]];
        for (found, known) in found.into_iter().zip(known) {
            assert!((found / known - 1.0).abs() < 1e-13, "{found} for {known}");
        }
    }
}
