//! Bushings: stiffness and damping in the plane, as numbers or over the speed, of tilts, and along the axis.

use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Located, Source};
use whirl_codegen::document::Table;
use whirl_codegen::kinds::law::LawSpec;
use whirl_codegen::units::Quantity;
use whirl_solver::bearing::MotionKind;

use super::over_frequency::{self, Read};
use super::parts::Parts;
use crate::case::joint::OtherLaw;
use crate::case::law::{self, FrequencyFile, GivenLaw, LawSource, NamedLaw};
use crate::case::library::FileStore;
use crate::case::names;
use crate::case::parameters::SetParameter;

/// Directions of force and motion, as keys of bushings and parameters of their law call them.
const DIRECTIONS: [&str; 4] = ["xx", "xy", "yx", "yy"];

/// The law whose coefficients are columns of a file, and that file.
const OVER_SPEED: (&str, &str) = ("bushing-over-speed", "bushing-over-speed.csv");

/// Stiffness and damping, as a case names them and as the law does.
const BOTH: [(&str, &str); 2] = [("stiffness", "k"), ("damping", "c")];

/// Stiffness and damping of a joint (SI), at most: beside more rounding hides slow motions.
const MOST: f64 = 1e16;

/// Keys of which one is enough.
const ANY: [&str; 7] = [
    "stiffness",
    "damping",
    "table",
    "tilting_stiffness",
    "tilting_damping",
    "axial_stiffness",
    "axial_damping",
];

pub(super) fn read(store: FileStore, table: &Table) -> Option<Parts> {
    if !ANY.into_iter().any(|key| table.has(key)) {
        let help = "add `stiffness = { xx = \"1e8 N/m\", yy = \"1e8 N/m\" }`";
        table.absent("stiffness", help);
    }
    let before = table.errors();
    let in_plane = coefficients(table, "");
    let tilting = coefficients(table, "tilting_");
    let along = axial(table);
    let file = over_speed(store, table);
    if table.errors() > before {
        return None;
    }
    let mut others = Vec::new();
    for (kind, prefix, set) in
        [(MotionKind::Tilts, "tilting_", tilting), (MotionKind::Along, "axial_", along)]
    {
        let keys = [format!("{prefix}stiffness"), format!("{prefix}damping")];
        let Some(key) = keys.iter().find(|key| table.has(key)) else { continue };
        let place = table.written(key);
        others.push(OtherLaw { kind, law: shipped(table, "bushing")?, parameters: set?, place });
    }
    let parts = match file {
        Some((name, law)) => Parts::of_law(law, Vec::new()).with(others, Some(name)),
        None => {
            let set = in_plane?;
            let all: Vec<SetParameter> =
                others.iter().flat_map(|own| own.parameters.clone()).chain(set.clone()).collect();
            if !acts(table, "bushing", &all) {
                return None;
            }
            Parts::of_law(shipped(table, "bushing")?, set).with(others, None)
        }
    };
    Some(parts)
}

/// Whether a joint acts along z.
pub(super) fn acts_along(joint: &Table) -> bool {
    ["axial_stiffness", "axial_damping"].into_iter().any(|key| joint.gives(key))
}

/// The coefficients of `stiffness` and `damping` with this prefix: those of the law, those left out zero.
fn coefficients(table: &Table, prefix: &str) -> Option<Vec<SetParameter>> {
    let mut set = Vec::with_capacity(8);
    for (called, letter) in BOTH {
        let key = format!("{prefix}{called}");
        let values = |own: &Table| {
            DIRECTIONS.map(|direction| {
                let value = own.exact_quantity(direction);
                limited(own, (table, &format!("{key}.{direction}")), direction, value.as_ref());
                (own.written(direction), value)
            })
        };
        let of_text = names::is_text(table, &key, |text| format!("{{ xx = {text}, yy = {text} }}"));
        let given = if of_text { None } else { table.in_table(&key, values) };
        for (place, direction) in DIRECTIONS.iter().enumerate() {
            let (at, value) =
                given.as_ref().map_or((table.written(&key), None), |own| own[place].clone());
            set.push(coefficient(&format!("{letter}_{direction}"), &at, value.as_ref(), letter)?);
        }
    }
    Some(set)
}

/// Stiffness and damping along z, as those along x of the law.
fn axial(table: &Table) -> Option<Vec<SetParameter>> {
    let mut set = Vec::with_capacity(8);
    for (called, letter) in BOTH {
        let key = format!("axial_{called}");
        let (at, value) = (table.written(&key), table.exact_quantity(&key));
        limited(table, (table, &key), &key, value.as_ref());
        for direction in DIRECTIONS {
            let own = value.as_ref().filter(|_| direction == "xx");
            set.push(coefficient(&format!("{letter}_{direction}"), &at, own, letter)?);
        }
    }
    Some(set)
}

/// Notes a value of `table` that no joint has, as `called` of the table of a joint.
pub(super) fn limited(
    table: &Table,
    (joint, called): (&Table, &str),
    key: &str,
    value: Option<&Quantity>,
) {
    if value.is_none_or(|own| own.si().abs() <= MOST) {
        return;
    }
    let at = table.written(key);
    let message = format!(
        "`{called}` of the joint `{}` is {}: beside it rounding hides how the machine moves",
        joint.heading().written().text(),
        at.text().trim_matches(['"', '\''])
    );
    let help = format!(
        "write {MOST:e} in SI units at most; what is a thousand times as stiff as the bodies that it joins already holds them"
    );
    table.push(at.error_here(Code::BAD_VALUE, message).help(help));
}

/// A coefficient in the units of the law: a moment for 1 rad is the force for 1 m at an arm of 1 m.
fn coefficient(
    name: &str,
    at: &Located,
    value: Option<&Quantity>,
    letter: &str,
) -> Option<SetParameter> {
    let unit = if letter == "k" { "N/m" } else { "N*s/m" };
    let own = Quantity::parse(&format!("0 {unit}")).ok()?;
    let value = match value {
        Some(value) if value.dimension() == own.dimension() => value.clone(),
        Some(value) => Quantity::parse(&format!("{:e} {unit}", value.si())).ok()?,
        None => own,
    };
    Some(SetParameter::new(name, at, value))
}

/// The law with the coefficients of the file that the case names, and where it does.
fn over_speed(store: FileStore, table: &Table) -> Option<(Located, NamedLaw)> {
    let name = table.optional_string("table")?;
    for (key, _) in BOTH {
        if table.has(key) {
            table.conflict(key, "table");
        }
    }
    let file = store.read_named(table, &name)?;
    if !has_columns(table, &name, &file) || !has_units(table, &name, &file) {
        return None;
    }
    let mut rows = file.clone();
    let mut frequencies = None;
    if over_frequency::is_meant(&|wanted| has(&file, wanted)) {
        match over_frequency::read(&file, &name) {
            Ok(Read { table: own, still }) => {
                rows = Source::new(&file.path, still);
                frequencies = Some(FrequencyFile { table: own, file: file.clone() });
            }
            Err(errors) => {
                errors.into_iter().for_each(|error| table.push(error));
                return None;
            }
        }
    }
    let shipped = shipped(table, OVER_SPEED.0)?;
    let law = shipped.source.spec()?.file.clone();
    let named = name.text().replace('\\', "\\\\").replace('"', "\\\"");
    let law = Source::new(&law.path, law.text.replace(OVER_SPEED.1, &named));
    match LawSpec::read_with(&law, &|_| Ok(rows.clone())) {
        Ok(mut spec) => {
            for own in &mut spec.valid {
                own.help = format!(
                    "add rows to `{}` for the speeds that the run reaches, or keep the run within its rows",
                    name.text()
                );
            }
            let called = format!("{} ({})", OVER_SPEED.0, file.path.display());
            let (spec, given) = (Arc::new(spec), Vec::new());
            let law = GivenLaw { spec, given, name: called, over_frequency: frequencies };
            let source = LawSource::Given(Arc::new(law));
            Some((name, NamedLaw { source, name: shipped.name }))
        }
        Err(errors) => {
            errors.into_iter().for_each(|error| table.push(error));
            None
        }
    }
}

/// The line of a file that names its columns.
fn heads(file: &Source) -> String {
    let text = |line: &str| line.split('#').next().unwrap_or("").trim().to_owned();
    let heads = file.text.trim_start_matches('\u{feff}').lines().map(text);
    heads.into_iter().find(|line| !line.is_empty()).unwrap_or_default()
}

/// Whether the columns of stiffness and damping have such units; those that have not are noted.
fn has_units(table: &Table, name: &Located, file: &Source) -> bool {
    let before = table.errors();
    let heads = heads(file);
    for cell in heads.split([',', ';', '\t']) {
        let Some((called, rest)) = cell.trim().split_once('[') else { continue };
        let (called, unit) = (called.trim(), rest.trim_end_matches(']').trim());
        let expected = match called.split_once('_') {
            Some(("k", axes)) if DIRECTIONS.contains(&axes) => "N/m",
            Some(("c", axes)) if DIRECTIONS.contains(&axes) => "N*s/m",
            _ => continue,
        };
        let of = |unit: &str| Quantity::parse(&format!("0 {unit}"));
        let (Ok(own), Ok(wanted)) = (of(unit), of(expected)) else { continue };
        if own.dimension() != wanted.dimension() {
            let message = format!("`{called}` of `{}` is in {unit}", name.text());
            let help = format!("give it a unit such as `{called} [{expected}]`");
            table.push(name.error_here(Code::WRONG_UNIT, message).help(help));
        }
    }
    table.errors() == before
}

/// Whether the first line of a file names a column.
fn has(file: &Source, wanted: &str) -> bool {
    let heads = heads(file);
    heads.split(|c: char| !(c.is_alphanumeric() || c == '_')).any(|head| head == wanted)
}

/// Whether the file has the columns of the law; those that it has not are noted.
fn has_columns(table: &Table, name: &Located, file: &Source) -> bool {
    let columns = ["k", "c"]
        .into_iter()
        .flat_map(|letter| DIRECTIONS.map(|direction| format!("{letter}_{direction}")));
    let columns: Vec<String> = std::iter::once("speed".to_owned()).chain(columns).collect();
    let missing: Vec<&str> =
        columns.iter().map(String::as_str).filter(|column| !has(file, column)).collect();
    if missing.is_empty() {
        return true;
    }
    let message = format!("`{}` has no column {}", name.text(), missing.join(", "));
    let help = "its first line is such as `speed [rpm], k_xx [N/m], k_xy [N/m], k_yx [N/m], k_yy [N/m], c_xx [N*s/m], \
                c_xy [N*s/m], c_yx [N*s/m], c_yy [N*s/m]`";
    table.push(name.error_here(Code::TABLE, message).help(help));
    false
}

/// A law that is shipped, named at the heading of the table.
pub(super) fn shipped(table: &Table, name: &str) -> Option<NamedLaw> {
    let name = table.heading().text(name);
    Some(NamedLaw { source: law::find(FileStore::Embedded, table, &name)?, name })
}

/// Notes a joint that gives no force at all, unless it lacks its stiffness, which is noted.
pub(super) fn acts(table: &Table, called: &str, set: &[SetParameter]) -> bool {
    let key = ANY.into_iter().find(|key| table.gives(key));
    let Some(key) = key.filter(|_| set.iter().all(|own| own.value() == 0.0)) else { return true };
    let message = format!("this {called} has neither stiffness nor damping: it joins nothing");
    let help = format!(
        "such as `{key} = {}`, or take the {called} out",
        match (called, key) {
            ("bushing", "axial_stiffness") => "\"1e8 N/m\"",
            ("bushing", "axial_damping") => "\"1e4 N*s/m\"",
            ("bushing", "tilting_stiffness") => "{ xx = \"1e4 N*m/rad\", yy = \"1e4 N*m/rad\" }",
            ("bushing", "tilting_damping") => "{ xx = \"10 N*m*s/rad\", yy = \"10 N*m*s/rad\" }",
            ("bushing", "damping") => "{ xx = \"1e4 N*s/m\", yy = \"1e4 N*s/m\" }",
            ("bushing", _) => "{ xx = \"1e8 N/m\", yy = \"1e8 N/m\" }",
            _ => "\"1e4 N*m/rad\"",
        }
    );
    table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
    false
}
