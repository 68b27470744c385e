//! Materials by the symbols that the forms use.

use std::collections::BTreeMap;

use crate::error::Error;

/// √(E/ρ) of solids lies between 20 m/s (soft rubber) and 18 000 m/s (diamond); what is this far outside
/// is a part made stiff or light on purpose, or was written in other units than Pa and kg/m³.
const SOUND: std::ops::Range<f64> = 10.0..1e5;

/// Stiffness against change of volume and against shear, one over the other, at most. Sums of both lose as
/// many digits as the quotient has; beyond it a body looks as if nothing held it.
const MODULI: f64 = 1e6;

/// A property that no solid has.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ImplausibleProperty {
    /// Symbol of the property, such as `nu`.
    pub symbol: &'static str,
    /// What is wrong.
    pub what: String,
    /// What would do.
    pub help: &'static str,
    /// Whether nothing can be computed with it; else it may be meant.
    pub refused: bool,
}

/// A material with its properties by the symbols that the forms use.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name in the source of the mesh.
    pub name: String,
    /// SI values by symbol: `E` (Pa), `nu` (1), `rho` (kg/m³).
    pub properties: BTreeMap<String, f64>,
}

/// What cells need of their material: symbols of the forms, and what people call them.
pub(super) const NEEDED: [(&str, &str); 3] =
    [("E", "Young's modulus"), ("nu", "Poisson's ratio"), ("rho", "density")];

impl Material {
    /// What cells need and the material has not, such as `density`.
    pub fn lacks(&self) -> Option<&'static str> {
        NEEDED
            .iter()
            .find(|(symbol, _)| !self.properties.contains_key(*symbol))
            .map(|(_, name)| *name)
    }

    /// Linear elastic and isotropic: E (Pa), ν, ρ (kg/m³).
    ///
    /// # Errors
    /// [`Error::Dimension`]: E not positive, ρ negative, ν outside (−1, 0.5).
    pub fn isotropic(name: &str, e: f64, nu: f64, rho: f64) -> Result<Material, Error> {
        let wrong = |symbol: &str, value: f64, [what, help]: [&str; 2]| Error::Dimension {
            dimension: format!("{symbol} of {name}"),
            value: value.to_string(),
            what: what.to_owned(),
            help: help.to_owned(),
        };
        if !(e > 0.0 && e.is_finite()) {
            return Err(wrong("E", e, ["is not positive", "give a positive number"]));
        }
        if !(rho >= 0.0 && rho.is_finite()) {
            return Err(wrong("rho", rho, ["is negative", "give 0 or a positive number"]));
        }
        if !(nu > -1.0 && nu < 0.5) {
            let what = ["is not between −1 and 0.5", "give a number between these, such as 0.3"];
            return Err(wrong("nu", nu, what));
        }
        let properties = [("E", e), ("nu", nu), ("rho", rho)];
        Ok(Material {
            name: name.to_owned(),
            properties: properties.map(|(symbol, value)| (symbol.to_owned(), value)).into(),
        })
    }

    /// Whether cells of it have mass; those of a material whose density is not known do.
    pub fn has_mass(&self) -> bool {
        self.properties.get("rho") != Some(&0.0)
    }

    /// What of E, ν and ρ no solid has, as far as they are there.
    pub fn implausible_properties(&self) -> Vec<ImplausibleProperty> {
        let name = &self.name;
        let value = |symbol: &str| self.properties.get(symbol).copied();
        let mut implausible_properties = Vec::new();
        if let (Some(e), Some(rho)) = (value("E"), value("rho")) {
            let sound = (e / rho).sqrt();
            if rho == 0.0 {
                let what = format!("material {name} has no mass: its density is 0");
                let help = "if that is meant, leave it; units are m, Pa and kg/m³: steel is 200e9 and 7860";
                let symbol = "rho";
                let doubt = ImplausibleProperty { symbol, what, help, refused: false };
                implausible_properties.push(doubt);
            } else if !SOUND.contains(&sound) {
                let what = format!(
                    "in material {name} (E = {e} Pa, ρ = {rho} kg/m³) sound would travel at {sound:.3e} m/s"
                );
                let help = "if that is meant, leave it; units are m, Pa and kg/m³: steel is 200e9 and 7860";
                let symbol = "E";
                let doubt = ImplausibleProperty { symbol, what, help, refused: false };
                implausible_properties.push(doubt);
            }
        }
        if let Some(nu) = value("nu") {
            // K/G of an isotropic material.
            let moduli = 2.0 * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu));
            if moduli > MODULI {
                let what = format!(
                    "material {name} is nearly incompressible: with ν = {nu} it is {moduli:.1e} times as stiff \
                     against change of volume as against shear"
                );
                implausible_properties.push(ImplausibleProperty {
                    symbol: "nu",
                    what,
                    help: "write 0.4999 or less",
                    refused: true,
                });
            } else if moduli < 1.0 / MODULI {
                let what = format!(
                    "material {name} hardly shears: with ν = {nu} it is {:.1e} times as stiff against shear as \
                     against change of volume",
                    1.0 / moduli
                );
                implausible_properties.push(ImplausibleProperty {
                    symbol: "nu",
                    what,
                    help: "write -0.9999 or more",
                    refused: true,
                });
            }
        }
        implausible_properties
    }
}
