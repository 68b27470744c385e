//! Materials of the mesh, and the set and material of the elements of every property.

use std::collections::{BTreeMap, HashMap};

use super::super::raw::{MeshReport, RawMaterial, count, list};
use super::bulk::Bulk;

/// What the elements of a property have in common.
#[derive(Debug, Clone)]
pub(super) struct Region {
    /// Name of their set.
    pub(super) set: String,
    /// Index into the materials, where there is one.
    pub(super) material: Option<usize>,
}

/// Materials, and regions by property.
pub(super) struct Regions {
    pub(super) materials: Vec<RawMaterial>,
    pub(super) by_property: HashMap<u64, Region>,
}

pub(super) fn regions(bulk: &Bulk, open: bool, report: &mut MeshReport) -> Regions {
    let mut cells: BTreeMap<u64, Vec<usize>> = BTreeMap::new();
    for (index, cell) in bulk.cells.list.iter().enumerate() {
        cells.entry(cell.property).or_default().push(index);
    }
    let names = set_names(bulk, cells.keys().copied());
    let mut regions = HashMap::new();
    let index: HashMap<u64, usize> =
        bulk.properties.materials.keys().enumerate().map(|(at, label)| (*label, at)).collect();
    for (property, own) in cells {
        let material = material(bulk, property, &own, open, report);
        let material = material.map(|label| index[&label]);
        regions.insert(property, Region { set: names[&property].clone(), material });
    }
    let names = material_names(bulk);
    let materials = bulk.properties.materials.iter().map(|(label, raw)| {
        let mut own = RawMaterial::new(names[label].clone(), raw.place);
        own.broken = raw.broken;
        for (&symbol, &(value, place)) in &raw.values {
            let factor = if symbol == "rho" { bulk.mass_factor() } else { 1.0 };
            own.values.insert(symbol, (value * factor, place));
        }
        if let Some(place) = bulk.properties.temperatures.get(label) {
            let what = format!(
                "MAT1 {label} depends on temperature (MATT1): read are its own values, as they are without a temperature"
            );
            let help = "if the machine runs at another temperature, write the values there into MAT1";
            own.remarks.push((*place, what, help.to_owned()));
        }
        own
    });
    let materials = materials.collect();
    Regions { materials, by_property: regions }
}

/// The material of a property; `None` where it is open, or an error was noted.
fn material(
    bulk: &Bulk,
    property: u64,
    cells: &[usize],
    open: bool,
    report: &mut MeshReport,
) -> Option<u64> {
    let properties = &bulk.properties;
    let of_elements = || {
        let labels = list(cells.iter().map(|&cell| bulk.cells.list[cell].label));
        format!("{} ({labels})", count(cells.len(), "element"))
    };
    let or_case = "or give them a material in the case, by `regions` or `material`";
    let Some(own) = properties.properties.get(&property) else {
        if !open {
            let what = format!("property {property} of {} is not defined", of_elements());
            let help = format!("add PSOLID,{property} and its MAT1, {or_case}");
            report.error(bulk.cells.list[cells[0]].place, what, help);
        }
        return None;
    };
    if own.card != "PSOLID" {
        let what = format!("{} {property} of {} is not read", own.card, of_elements());
        match open {
            true => report.warn(own.place, what, "the material of the case holds"),
            false => report.error(own.place, what, format!("write PSOLID, {or_case}")),
        }
        return None;
    }
    let label = own.material?;
    if let Some(raw) = properties.materials.get(&label) {
        return Some(label).filter(|_| !raw.broken);
    }
    match properties.other_materials.get(&label) {
        Some((card, place)) => {
            let what = format!(
                "{card} {label} of {} is not read: only isotropic materials are",
                of_elements()
            );
            match open {
                true => report.warn(*place, what, "the material of the case holds"),
                false => report.error(*place, what, format!("write MAT1, {or_case}")),
            }
        }
        None => {
            let what = format!("PSOLID {property} has material {label}, which is not defined");
            match open {
                true => report.warn(own.place, what, "the material of the case holds"),
                false => report.error(own.place, what, format!("add MAT1,{label}, {or_case}")),
            }
        }
    }
    None
}

/// Names of properties, from comments or with their labels; those that two would have are not used.
fn set_names(bulk: &Bulk, properties: impl Iterator<Item = u64>) -> HashMap<u64, String> {
    let named = properties.map(|label| {
        let own = bulk.properties.properties.get(&label);
        let name = bulk.names.property(label).or(own.and_then(|own| own.name.as_deref()));
        let card = own.map_or("PSOLID", |own| own.card.as_str());
        (label, name.map(str::to_owned), format!("{card}_{label}"))
    });
    distinct(named)
}

fn material_names(bulk: &Bulk) -> HashMap<u64, String> {
    distinct(bulk.properties.materials.iter().map(|(&label, own)| {
        let name = bulk.names.material(label).map(str::to_owned).or_else(|| own.name.clone());
        (label, name, format!("MAT1_{label}"))
    }))
}

/// Each label's name, or its plain one where another label has that name, too.
pub(super) fn distinct(
    named: impl Iterator<Item = (u64, Option<String>, String)>,
) -> HashMap<u64, String> {
    let named: Vec<(u64, Option<String>, String)> = named.collect();
    let mut times: HashMap<String, usize> = HashMap::new();
    for (_, name, plain) in &named {
        for name in name.iter().chain([plain]) {
            *times.entry(name.to_uppercase()).or_default() += 1;
        }
    }
    let chosen = |(label, name, plain): (u64, Option<String>, String)| {
        let name = name.filter(|name| times[&name.to_uppercase()] == 1);
        (label, name.unwrap_or(plain))
    };
    named.into_iter().map(chosen).collect()
}
