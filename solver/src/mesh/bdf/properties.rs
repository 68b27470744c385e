//! Materials and the properties of solid elements.

use std::collections::{BTreeMap, HashMap};

use super::super::raw::{LinePosition, MeshReport};
use super::fields::Card;

/// E, G and ν of a material may differ by this from E = 2 G (1 + ν), since files hold few digits.
const INCONSISTENT: f64 = 0.01;

/// `MAT1` as written.
#[derive(Debug, Clone)]
pub(super) struct RawMaterial {
    pub(super) name: Option<String>,
    pub(super) place: LinePosition,
    /// E, ν, ρ with their places, as far as they are there.
    pub(super) values: BTreeMap<&'static str, (f64, LinePosition)>,
    /// Whether something in it was refused, so that what is missing is no further error.
    pub(super) broken: bool,
}

/// `PSOLID` as written.
#[derive(Debug, Clone)]
pub(super) struct RawProperty {
    pub(super) name: Option<String>,
    /// The card, such as `PSOLID`.
    pub(super) card: String,
    pub(super) place: LinePosition,
    pub(super) material: Option<u64>,
}

/// Materials and properties by label.
#[derive(Debug, Default)]
pub(super) struct Properties {
    pub(super) materials: BTreeMap<u64, RawMaterial>,
    /// Materials of other kinds, by their cards.
    pub(super) other_materials: HashMap<u64, (String, LinePosition)>,
    pub(super) properties: BTreeMap<u64, RawProperty>,
    /// Where materials depend on temperature, by their labels.
    pub(super) temperatures: BTreeMap<u64, LinePosition>,
}

impl Properties {
    pub(super) fn read_material(
        &mut self,
        card: &Card,
        name: Option<String>,
        report: &mut MeshReport,
    ) {
        let before = report.error_count();
        let Some(label) = report.label(card, 0, "label of the material") else { return };
        if let Some(first) = self.materials.get(&label) {
            let line = report.line(first.place, card.place);
            let what = format!("material {label} is defined twice");
            report.error(
                card.place,
                what,
                format!("{line} has the first; give this one another label"),
            );
            return;
        }
        let titles = ["Young's modulus E", "shear modulus G", "Poisson's ratio ν", "density ρ"];
        let mut read = |at: usize| {
            let value = report.real(card, at + 1, titles[at])?;
            let place = card.field(at + 1).map_or(card.place, |field| field.place);
            let help = match at {
                2 if !(value > -1.0 && value < 0.5) => "it lies between −1 and 0.5, both excluded",
                0 | 1 if value < 0.0 => "it must be positive",
                3 if value < 0.0 => "it must be positive, or 0 of a part without mass",
                // Nastran takes 0 for a blank field.
                0 | 1 if value == 0.0 => return None,
                _ => return Some((value, place)),
            };
            report.error(place, format!("the {} of MAT1 {label} is {value}", titles[at]), help);
            None
        };
        let [e, g, nu, rho] = [0, 1, 2, 3].map(&mut read);
        let mut values = BTreeMap::new();
        let mut broken = report.error_count() > before;
        match (e, g, nu) {
            (Some(e), Some(g), Some(nu)) => {
                let wanted = e.0 / (2.0 * (1.0 + nu.0));
                if (g.0 / wanted - 1.0).abs() > INCONSISTENT {
                    let what = format!(
                        "MAT1 {label} contradicts itself: G = {}, but E/(2 (1 + ν)) = {wanted:.5e}",
                        g.0
                    );
                    report.error(g.1, what, "leave one of E, G and ν blank");
                }
                values.extend([("E", e), ("nu", nu)]);
            }
            (Some(e), None, Some(nu)) => values.extend([("E", e), ("nu", nu)]),
            (None, Some(g), Some(nu)) => {
                values.extend([("E", (2.0 * g.0 * (1.0 + nu.0), g.1)), ("nu", nu)]);
            }
            (Some(e), Some(g), None) => {
                let nu = e.0 / (2.0 * g.0) - 1.0;
                if nu > -1.0 && nu < 0.5 {
                    values.extend([("E", e), ("nu", (nu, g.1))]);
                } else {
                    let what = format!("E and G of MAT1 {label} make Poisson's ratio {nu:.4}");
                    report.error(g.1, what, "it lies between −1 and 0.5: correct E or G");
                    broken = true;
                }
            }
            _ if !broken => {
                let what = format!("MAT1 {label} has fewer than two of E, G and ν");
                report.error(card.place, what, "write E and ν into its fields 3 and 5");
                broken = true;
            }
            _ => {}
        }
        values.extend(rho.map(|rho| ("rho", rho)));
        self.materials.insert(label, RawMaterial { name, place: card.place, values, broken });
    }

    /// Notes that a material depends on temperature.
    pub(super) fn read_temperatures(&mut self, card: &Card, report: &mut MeshReport) {
        if let Some(label) = report.label(card, 0, "label of the material") {
            self.temperatures.entry(label).or_insert(card.place);
        }
    }

    /// Notes a material that is not isotropic.
    pub(super) fn read_other_material(&mut self, card: &Card, report: &mut MeshReport) {
        if let Some(label) = report.label(card, 0, "label of the material") {
            self.other_materials.insert(label, (card.name.to_string(), card.place));
        }
    }

    pub(super) fn read_solid(
        &mut self,
        card: &Card,
        name: Option<String>,
        report: &mut MeshReport,
    ) {
        let Some(label) = report.label(card, 0, "label of the property") else { return };
        let material = match card.name.as_ref() {
            "PSOLID" => report.label(card, 1, "material"),
            _ => None,
        };
        if let Some(&field) = card.field(6)
            && card.name == "PSOLID"
            && !["SMECH"].contains(&field.text.to_ascii_uppercase().as_str())
        {
            let what = format!("PSOLID {label} is a fluid ({})", field.text);
            report.error(field.place, what, "take the fluid's elements out of the file");
        }
        if let Some(first) = self.properties.get(&label) {
            let line = report.line(first.place, card.place);
            let what = format!("property {label} is defined twice");
            report.error(
                card.place,
                what,
                format!("{line} has the first; give this one another label"),
            );
            return;
        }
        let card_name = card.name.to_string();
        let property = RawProperty { name, card: card_name, place: card.place, material };
        self.properties.insert(label, property);
    }
}
