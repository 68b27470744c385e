//! Materials of a file: linear elastic, isotropic, with a density.

use std::collections::BTreeMap;

use super::super::Material;
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
}

impl RawMaterial {
    pub(crate) fn new(name: String, place: LinePosition) -> RawMaterial {
        RawMaterial { name, place, values: BTreeMap::new(), broken: false }
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
            "E" | "rho" if value <= 0.0 => {
                let what = format!("the {title} of {name} is {value}");
                report.error(at, what, "it must be positive");
                self.broken = true;
            }
            _ => {
                self.values.insert(symbol, (value, at));
            }
        }
    }

    /// Notes values that cannot be meant.
    pub(super) fn judge(&self, report: &mut MeshReport) {
        if self.broken {
            return;
        }
        for doubt in self.material().implausible_properties() {
            if let Some(&(_, place)) = self.values.get(doubt.symbol) {
                report.error(place, doubt.what, doubt.help);
            }
        }
    }
}
