//! Materials of a file: linear elastic, isotropic, with a density.

use std::collections::BTreeMap;

use whirl_text::rounded;

use super::super::Material;
use super::super::units::MeshUnits;
use super::report::{LinePosition, MeshReport};

/// A material as written.
#[derive(Debug)]
pub(crate) struct RawMaterial {
    pub(crate) name: String,
    pub(crate) place: LinePosition,
    /// Values by symbol (`E`, `nu`, `rho`), with their places.
    pub(crate) values: BTreeMap<&'static str, (f64, LinePosition)>,
    /// Whether something in it was refused, so that what is missing is no further error.
    pub(crate) broken: bool,
    /// What in it is not read, with the remedy: an error where cells need it.
    pub(crate) unread: Vec<(LinePosition, String, String)>,
    /// What is to be said of its values where cells have them.
    pub(crate) remarks: Vec<(LinePosition, String, String)>,
}

impl RawMaterial {
    pub(crate) fn new(name: String, place: LinePosition) -> RawMaterial {
        let values = BTreeMap::new();
        let (unread, remarks) = (Vec::new(), Vec::new());
        RawMaterial { name, place, values, broken: false, unread, remarks }
    }

    /// Without places.
    pub(crate) fn material(&self) -> Material {
        let values = self.values.iter();
        Material {
            name: self.name.clone(),
            properties: values.map(|(name, &(value, _))| (name.to_string(), value)).collect(),
        }
    }

    /// Takes a value, or says why it cannot be one; `title` is what the file's format calls it.
    pub(crate) fn set(
        &mut self,
        symbol: &'static str,
        title: &str,
        value: f64,
        at: LinePosition,
        report: &mut MeshReport,
    ) {
        let name = self.name.as_str();
        match symbol {
            "nu" if !(value > -1.0 && value < 0.5) => {
                let what = format!("Poisson's ratio of {name} is {value}");
                report.error(at, what, "it lies between −1 and 0.5, both excluded");
                self.broken = true;
            }
            "E" if !(value > 0.0 && value.is_finite()) => {
                let what = format!("the {title} of {name} is {value}");
                report.error(at, what, "it must be positive");
                self.broken = true;
            }
            "rho" if !(value >= 0.0 && value.is_finite()) => {
                let what = format!("the {title} of {name} is {value}");
                report.error(at, what, "it must be positive, or 0 of a part without mass");
                self.broken = true;
            }
            _ => match self.values.insert(symbol, (value, at)) {
                Some((first, place)) if first != value => {
                    let what = format!("the {title} of {name} is given twice: {first} and {value}");
                    let help = format!("{} has the first: keep one", report.line(place, at));
                    report.error(at, what, help);
                    self.broken = true;
                }
                _ => {}
            },
        }
    }

    /// Values in SI units.
    pub(super) fn convert(&mut self, units: &MeshUnits) {
        for (symbol, (value, _)) in &mut self.values {
            match *symbol {
                "E" => *value = units.modulus(*value),
                "rho" => *value = units.density(*value),
                _ => {}
            }
        }
    }

    /// Notes values with which nothing can be computed or that are of other units, and warns of those that no solid has.
    pub(super) fn judge(&self, units: &MeshUnits, report: &mut MeshReport) {
        if self.broken {
            return;
        }
        let value = |symbol: &str| self.values.get(symbol).copied();
        let odd = match (value("E"), value("rho")) {
            (Some((e, _)), Some((rho, place))) if rho > 0.0 && !MeshUnits::is_material(e, rho) => {
                Some((e, rho, place))
            }
            _ => None,
        };
        let likely = odd
            .and_then(|(e, rho, place)| units.likely(e, rho).map(|system| (system, e, rho, place)));
        let line = |system: &str| format!("write `units = \"{system}\"` beside `mesh` in the case");
        let doubts = self.material().implausible_properties();
        for doubt in &doubts {
            if let Some((_, place)) = value(doubt.symbol) {
                let help = match likely.filter(|_| doubt.symbol == "E") {
                    Some((system, ..)) => {
                        format!(
                            "{}, if it is meant in these units; or: {}",
                            line(system),
                            in_units(units, doubt.help)
                        )
                    }
                    None if doubt.symbol == "nu" => doubt.help.to_owned(),
                    None => in_units(units, doubt.help),
                };
                // Another system in which it is an ordinary material is what was meant.
                match doubt.refused || doubt.symbol == "E" && likely.is_some() {
                    true => report.error(place, doubt.what.clone(), help),
                    false => report.warn(place, doubt.what.clone(), help),
                }
            }
        }
        let Some((e, rho, place)) = odd.filter(|_| doubts.is_empty()) else { return };
        let numbers = format!(
            "material {} has E = {} Pa and ρ = {} kg/m³",
            self.name,
            rounded(e, 6),
            rounded(rho, 6)
        );
        let (what, help) = match likely {
            Some((system, ..)) => {
                (format!("{numbers}, which looks like other units"), line(system))
            }
            None => {
                let help = "look whether E is in GPa, or ρ in g/cm³, among other units of the file";
                (format!("{numbers}, which no solid has together"), help.to_owned())
            }
        };
        report.warn(place, what, help);
    }
}

/// What E and ρ of steel are in a file; `in_si` where it is in SI units.
fn in_units(units: &MeshUnits, in_si: &str) -> String {
    if *units == MeshUnits::default() {
        return in_si.to_owned();
    }
    let (e, rho) = (units.written_modulus(200e9), units.written_density(7860.0));
    format!("if that is meant, leave it; in the units of this file steel is {e} and {rho}")
}
