//! The materials of a case, and what is made of each.

use std::collections::BTreeMap;

use whirl_codegen::diagnostic::{Code, Located, suggest};
use whirl_codegen::document::Table;
use whirl_solver::mesh::Material;

use super::super::rotor::Region;

/// The materials of a case.
pub(in crate::case) struct Materials {
    known: BTreeMap<String, Material>,
    /// Whether these are all that the case describes.
    all_read: bool,
}

impl Materials {
    /// Reads the tables `[material.NAME]`.
    pub(in crate::case) fn read(file: &Table) -> Materials {
        let before = file.errors();
        let tables = file.named_tables("material");
        // Of materials that are no tables, nothing more is said where they are named.
        let all_read = file.errors() == before;
        let read = |(name, table): (String, Table)| {
            let material = table.read(|table| material(&name, table));
            (name, material)
        };
        Materials { known: tables.into_iter().map(read).collect(), all_read }
    }
}

/// A material in place of one with errors.
const STAND_IN: [(&str, f64); 3] = [("E", 2e11), ("nu", 0.3), ("rho", 7860.0)];

fn material(name: &str, table: &Table) -> Material {
    let before = table.errors();
    let values = [
        ("E", table.quantity_or_one("youngs_modulus")),
        ("nu", table.number_or_middle("poissons_ratio")),
        ("rho", table.quantity_or_one("density")),
    ];
    let keys = [("E", "youngs_modulus"), ("nu", "poissons_ratio"), ("rho", "density")];
    let whole = keys.iter().all(|(_, key)| table.has(key)) && table.errors() == before;
    // What stands for an error is no reason for doubts.
    let values = if whole { values } else { STAND_IN };
    let properties = values.map(|(symbol, value)| (symbol.to_string(), value)).into();
    let material = Material { name: name.to_string(), properties };
    let doubts = material.implausible_properties().into_iter();
    for doubt in doubts.filter(|doubt| doubt.refused) {
        let key = keys.iter().find(|(symbol, _)| *symbol == doubt.symbol).map(|(_, key)| *key);
        let place = key.map_or_else(|| table.heading().text(""), |key| table.written(key));
        table.push(place.error_here(Code::BAD_VALUE, doubt.what).help(doubt.help));
    }
    material
}

impl Materials {
    /// The material that a table names.
    pub(in crate::case) fn of(&self, table: &Table) -> Option<Material> {
        self.called(table, &table.optional_string("material")?)
    }

    /// Materials of parts of the mesh.
    pub(in crate::case) fn regions(&self, table: &Table) -> Vec<Region> {
        let named = table.named_texts("regions").into_iter();
        let region = |(set, name): (Located, Located)| {
            Some(Region { set, material: self.called(table, &name)? })
        };
        named.filter_map(region).collect()
    }

    /// The material of this name; another one is noted.
    pub(in crate::case) fn called(&self, table: &Table, name: &Located) -> Option<Material> {
        let found = self.known.get(name.text());
        if found.is_none() && self.all_read {
            let known: Vec<&str> = self.known.keys().map(String::as_str).collect();
            let message = format!("there is no material `{}`", name.text());
            let help = suggest(name.text(), &known)
                .unwrap_or_else(|| format!("describe it in a table `[material.{}]`", name.text()));
            table.push(name.error_here(Code::BAD_VALUE, message).help(help));
        }
        found.cloned()
    }
}
