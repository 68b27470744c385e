//! Units of a file of a mesh, and the system of units that its numbers look like.

/// SI units in one unit of the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshUnits {
    /// Metres.
    pub length: f64,
    /// Newtons.
    pub force: f64,
    /// Kilograms.
    pub mass: f64,
}

impl Default for MeshUnits {
    fn default() -> MeshUnits {
        MeshUnits { length: 1.0, force: 1.0, mass: 1.0 }
    }
}

/// Systems that programs use: as a case writes them, and in SI units. Of two that fit the first is the likelier one: steel in
/// mm, N, kg would be rubber in mm, mN, kg.
const SYSTEMS: [(&str, MeshUnits); 7] = [
    ("m, N, kg", MeshUnits { length: 1.0, force: 1.0, mass: 1.0 }),
    ("mm, N, t", MeshUnits { length: 1e-3, force: 1.0, mass: 1e3 }),
    ("mm, N, kg", MeshUnits { length: 1e-3, force: 1.0, mass: 1.0 }),
    ("mm, mN, kg", MeshUnits { length: 1e-3, force: 1e-3, mass: 1.0 }),
    ("mm, kN, kg", MeshUnits { length: 1e-3, force: 1e3, mass: 1.0 }),
    (
        "in, lbf, lbf*s^2/in",
        MeshUnits {
            length: 0.0254,
            force: 4.448_221_615_260_5,
            mass: 4.448_221_615_260_5 / 0.0254,
        },
    ),
    ("in, lbf, lb", MeshUnits { length: 0.0254, force: 4.448_221_615_260_5, mass: 0.453_592_37 }),
];

/// Densities of solids (kg/m³): from foams to osmium.
const DENSITY: std::ops::Range<f64> = 5.0..25e3;
/// √(E/ρ) of materials of machines (m/s): from elastomers to beryllium.
const SOUND: std::ops::Range<f64> = 30.0..15e3;
/// Density of metals heavier than titanium (kg/m³), and √(E/ρ) below which there is none (m/s): lead has 1200.
const METAL: f64 = 5e3;
const HARD: f64 = 700.0;
/// The lightest plastics (kg/m³): other units are not those in which something would be a foam.
const PLASTIC: f64 = 500.0;

impl MeshUnits {
    /// A length in m.
    pub(super) fn length(&self, value: f64) -> f64 {
        scaled(value, self.length)
    }

    /// A modulus in Pa.
    pub(super) fn modulus(&self, value: f64) -> f64 {
        value * (self.force / self.length / self.length)
    }

    /// A density in kg/m³.
    pub(super) fn density(&self, value: f64) -> f64 {
        value * (self.mass / (self.length * self.length * self.length))
    }

    /// What a file in these units has for a modulus in Pa.
    pub(super) fn written_modulus(&self, value: f64) -> String {
        written(value / self.modulus(1.0))
    }

    /// What a file in these units has for a density in kg/m³.
    pub(super) fn written_density(&self, value: f64) -> String {
        written(value / self.density(1.0))
    }

    /// Whether a material of this E and ρ in Pa and kg/m³ could be one.
    pub(super) fn is_material(e: f64, rho: f64) -> bool {
        let sound = (e / rho).sqrt();
        DENSITY.contains(&rho) && SOUND.contains(&sound) && (rho < METAL || sound >= HARD)
    }

    /// The usual system in which E and ρ, as these units make them, would be those of a material.
    pub(super) fn likely(&self, e: f64, rho: f64) -> Option<&'static str> {
        let (e, rho) = (e / self.modulus(1.0), rho / self.density(1.0));
        let fits = |units: &MeshUnits| {
            let (e, rho) = (units.modulus(e), units.density(rho));
            MeshUnits::is_material(e, rho) && rho >= PLASTIC && (e / rho).sqrt() >= HARD
        };
        SYSTEMS.iter().find(|(_, units)| fits(units)).map(|(name, _)| *name)
    }
}

/// A number of three digits as people write it into files.
fn written(value: f64) -> String {
    let short = format!("{value:.2e}").parse().unwrap_or(value);
    match (1e-3..1e5).contains(&short) {
        true => short.to_string(),
        false => format!("{short:e}"),
    }
}

/// Divided by 1000 rather than multiplied by 1e-3, so that 20 mm are 0.02 m to the last digit.
fn scaled(value: f64, factor: f64) -> f64 {
    let inverse = 1.0 / factor;
    match factor < 1.0 && inverse.fract() == 0.0 {
        true => value / inverse,
        false => value * factor,
    }
}

#[cfg(test)]
mod tests {
    use super::MeshUnits;

    #[test]
    fn steel_is_known_in_every_usual_system() {
        let si = MeshUnits::default();
        for (e, rho, system) in [
            (206e9, 7850.0, "m, N, kg"),
            (206e3, 7.85e-9, "mm, N, t"),
            (206e6, 7.85e-6, "mm, mN, kg"),
            (206e3, 7.85e-6, "mm, N, kg"),
            (29.9e6, 7.35e-4, "in, lbf, lbf*s^2/in"),
            (30e6, 0.283, "in, lbf, lb"),
        ] {
            assert_eq!(si.likely(e, rho), Some(system), "{e} {rho}");
        }
        // Nothing, E in GPa beside t/mm³, and N/mm² beside g/cm³.
        for (e, rho) in [(1.0, 1e30), (206.0, 7.85e-9), (206e3, 7.85)] {
            assert_eq!(si.likely(e, rho), None, "{e} {rho}");
        }
        assert!(!MeshUnits::is_material(206e6, 7850.0) && MeshUnits::is_material(5e6, 1100.0));
    }

    #[test]
    fn steel_is_written_as_in_files() {
        let si = MeshUnits::default();
        assert_eq!(
            (si.written_modulus(200e9), si.written_density(7860.0)),
            ("2e11".into(), "7860".into())
        );
        let mm = MeshUnits { length: 1e-3, force: 1.0, mass: 1e3 };
        assert_eq!(
            (mm.written_modulus(200e9), mm.written_density(7860.0)),
            ("2e5".into(), "7.86e-9".into())
        );
    }

    #[test]
    fn millimetres_are_divided() {
        let units = MeshUnits { length: 1e-3, force: 1.0, mass: 1e3 };
        assert_eq!(units.length(20.0), 0.02);
        assert_eq!(units.length(12.5), 0.0125);
        assert!((units.density(7.85e-9) / 7850.0 - 1.0).abs() < 1e-14);
        assert!((units.modulus(206e3) / 206e9 - 1.0).abs() < 1e-14);
    }
}
