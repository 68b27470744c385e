//! Materials by the symbols that the forms use.

use std::collections::BTreeMap;

use crate::error::Error;

/// A material with its properties by the symbols that the forms use.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name in the source of the mesh.
    pub name: String,
    /// SI values by symbol: `E` (Pa), `nu` (1), `rho` (kg/m³).
    pub properties: BTreeMap<String, f64>,
}

impl Material {
    /// Linear elastic and isotropic: E (Pa), ν, ρ (kg/m³).
    ///
    /// # Errors
    /// [`Error::Dimension`]: E or ρ not positive, ν outside (−1, 0.5).
    pub fn isotropic(name: &str, e: f64, nu: f64, rho: f64) -> Result<Material, Error> {
        let wrong = |symbol: &str, value: f64, [what, help]: [&str; 2]| Error::Dimension {
            dimension: format!("{symbol} of {name}"),
            value: value.to_string(),
            what: what.to_owned(),
            help: help.to_owned(),
        };
        for (symbol, value) in [("E", e), ("rho", rho)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(wrong(symbol, value, ["is not positive", "give a positive number"]));
            }
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
}
