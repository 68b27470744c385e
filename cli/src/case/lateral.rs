//! What an analysis of the kind `lateral` says beside the others: speeds, probes, clearances, unbalance, stages and variants of
//! the analysis that standards ask for.

use std::f64::consts::FRAC_PI_4;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::units::{Dimension, Quantity};

use super::{JoinedMachine, names};

/// Trip speed over the maximum continuous one where a case does not say it.
const TRIP: f64 = 1.05;
/// The largest scale factor of a response where a case does not say it.
const SCALE: f64 = 6.0;

/// What standards ask for.
#[derive(Debug, Clone)]
pub(crate) struct Lateral {
    /// Edition of API 617.
    pub(crate) edition: usize,
    /// N_ma (rad/s).
    pub(crate) minimum: f64,
    /// N_mc (rad/s).
    pub(crate) maximum: f64,
    /// Of the trip (rad/s).
    pub(crate) trip: f64,
    /// Names of points; none given: the journals of the body.
    pub(crate) probes: Vec<Located>,
    /// Of the first of two probes from x (rad).
    pub(crate) probe_angle: f64,
    /// Points with the least diametral clearance (m), beside the joints that have one.
    pub(crate) clearances: Vec<(Located, f64)>,
    /// The largest scale factor.
    pub(crate) scale_limit: f64,
    /// Forward modes by whose shapes unbalance is placed, counted from 1.
    pub(crate) modes: Vec<usize>,
    /// Unbalance that the case places itself.
    pub(crate) unbalance: Vec<PlacedUnbalance>,
    /// By joint, where the case says it, the load that it carries (N).
    pub(crate) journal_loads: Vec<(usize, f64)>,
    /// Impellers or rows of blades.
    pub(crate) stages: Vec<Stage>,
    /// Where Q of all stages between the bearings acts (m); the middle between the journals if there is none.
    pub(crate) cross_coupling_z: Option<f64>,
    /// Average density of the gas (kg/m³).
    pub(crate) gas_density: Option<f64>,
    /// Joints left out of stability of level I, by their places.
    pub(crate) seals: Vec<usize>,
    /// Values of keys in place of those of the case.
    pub(crate) variants: Vec<Variant>,
}

/// Unbalance in planes of the body.
#[derive(Debug, Clone)]
pub(crate) struct PlacedUnbalance {
    pub(crate) name: String,
    pub(crate) planes: Vec<Plane>,
}

/// One of them.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plane {
    /// m.
    pub(crate) z: f64,
    /// W (kg).
    pub(crate) load: f64,
    /// rad.
    pub(crate) phase: f64,
}

/// An impeller, a row of blades, or a seal with known cross-coupled stiffness.
#[derive(Debug, Clone)]
pub(crate) struct Stage {
    pub(crate) name: String,
    /// Where (m), if the case says it.
    pub(crate) z: Option<f64>,
    pub(crate) source: StageSource,
}

/// From what its cross-coupled stiffness follows.
#[derive(Debug, Clone, Copy)]
pub(crate) enum StageSource {
    /// N/m.
    Given(f64),
    /// W, m, m, ρ_d/ρ_s.
    Impeller { power: f64, diameter: f64, width: f64, density_ratio: f64 },
    /// W, pitch diameter and height of the blades (m).
    Blades { power: f64, diameter: f64, height: f64 },
}

/// Other values of some keys, under a name.
#[derive(Debug, Clone)]
pub(crate) struct Variant {
    pub(crate) name: String,
    /// `KEY=VALUE`, as `whirl sweep --vary` takes them.
    pub(crate) set: Vec<Located>,
}

/// The edition whose formulas are taken where a case does not say one.
const NEWEST: usize = 9;
/// Words of a stage.
pub(super) const STAGES: &[&str] = &["impeller", "blades"];
/// Keys that other kinds of analysis have no use for.
const KEYS: [&str; 16] = [
    "edition",
    "minimum_speed",
    "maximum_speed",
    "trip_speed",
    "probes",
    "probe_angle",
    "clearances",
    "scale_limit",
    "unbalance_modes",
    "unbalance",
    "journal_loads",
    "stages",
    "cross_coupling_z",
    "gas_density",
    "seals",
    "variants",
];

/// Notes keys of a lateral analysis in a table of another kind, but for those that this one has as well.
pub(super) fn refuse(table: &Table, but: &[&str]) {
    for key in KEYS.into_iter().filter(|key| table.has(key) && !but.contains(key)) {
        let kinds = match key {
            "probe_angle" => "of the kinds `lateral` and `response`",
            _ => "of the kind `lateral`",
        };
        let message = format!("`{key}` is of an analysis {kinds}");
        let help = "write `kind = \"lateral\"`, or leave it out";
        table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
        table.pass_over(key);
    }
}

/// Reads what the kind `lateral` asks for.
pub(super) fn read(table: &Table, joined: Option<&JoinedMachine>) -> Option<Lateral> {
    let before = table.errors();
    let edition = table.optional_count("edition").unwrap_or(NEWEST);
    for (key, what) in [
        ("minimum_speed", "N_ma, the minimum allowable"),
        ("maximum_speed", "N_mc, the maximum continuous"),
    ] {
        if !table.has(key) {
            table.absent(key, &format!("add `{key} = \"9000 rpm\"`: {what} speed"));
        }
    }
    let [minimum, maximum, trip] =
        ["minimum_speed", "maximum_speed", "trip_speed"].map(|key| table.quantity(key));
    for (key, own, least) in [
        ("minimum_speed", minimum, 0.0),
        ("maximum_speed", maximum, f64::MIN_POSITIVE),
        ("trip_speed", trip, f64::MIN_POSITIVE),
    ] {
        if own.is_some_and(|own| own < least) {
            let message = format!("`{key}` is not above zero");
            let help = "write it without a sign: the sense is that of the `speed` of the body";
            let place = table.written(key);
            table.push(place.error_here(Code::BAD_VALUE, message).help(help));
        }
    }
    let are_right = table.errors() == before;
    let (minimum, maximum) = (minimum.unwrap_or(1.0), maximum.unwrap_or(f64::INFINITY));
    let trip_speed = trip.unwrap_or(TRIP * maximum);
    let above = |key: &str, message: &str, help: &str| {
        table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help.to_owned()));
    };
    if are_right && minimum > maximum {
        let help =
            "N_ma, the minimum allowable speed, is at most N_mc, the maximum continuous speed";
        above("minimum_speed", "`minimum_speed` is above `maximum_speed`", help);
    }
    if are_right && trip.is_some_and(|trip| trip < maximum) {
        let help = "leave it out for 105 % of `maximum_speed`";
        above("trip_speed", "`trip_speed` is below `maximum_speed`", help);
    }
    let scale_limit =
        if table.has("scale_limit") { table.number_or_middle("scale_limit") } else { SCALE };
    let lateral = Lateral {
        edition,
        minimum,
        maximum,
        trip: trip_speed,
        probes: table.texts("probes"),
        probe_angle: table.quantity("probe_angle").unwrap_or(FRAC_PI_4),
        clearances: named(table, "clearances", (&Dimension::LENGTH, "a length"), "200 um"),
        scale_limit,
        modes: modes(table),
        unbalance: table.named_tables("unbalance").into_iter().filter_map(placed).collect(),
        journal_loads: named(table, "journal_loads", (&Dimension::FORCE, "a force"), "450 N")
            .into_iter()
            .filter_map(|(name, load)| Some((joint(table, joined?, &name)?, load)))
            .collect(),
        stages: table.named_tables("stages").into_iter().filter_map(stage).collect(),
        cross_coupling_z: table.quantity("cross_coupling_z"),
        gas_density: table.quantity("gas_density"),
        seals: table.texts("seals").iter().filter_map(|name| joint(table, joined?, name)).collect(),
        variants: table.named_tables("variants").into_iter().map(variant).collect(),
    };
    (table.errors() == before).then_some(lateral)
}

/// Numbers of forward modes.
fn modes(table: &Table) -> Vec<usize> {
    let mut all = Vec::new();
    for own in table.positive_numbers("unbalance_modes") {
        if own.fract() == 0.0 && own < 100.0 {
            all.push(own as usize);
        } else {
            let message = format!("`{own}` is no number of a mode");
            let help = "count forward modes from the slowest one, such as `[1, 2]`";
            table.push(
                table.written("unbalance_modes").error_here(Code::BAD_VALUE, message).help(help),
            );
        }
    }
    all
}

/// Planes of unbalance.
fn placed((name, table): (String, Table)) -> Option<PlacedUnbalance> {
    table.read(|table| {
        table.demand("z");
        table.demand("load");
        let (z, loads) = (table.quantities("z"), table.quantities("load"));
        let mut phases = table.quantities("phase");
        if !table.has("phase") {
            phases = vec![0.0; z.len()];
        }
        for (key, count) in [("load", loads.len()), ("phase", phases.len())] {
            if count != z.len() && table.has(key) && table.has("z") {
                let message = format!("`{key}` has {count} values, and `z` {}", z.len());
                let help = "write one for each plane of unbalance";
                table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
                return None;
            }
        }
        let planes = z.iter().zip(&loads).zip(&phases);
        let planes: Vec<Plane> =
            planes.map(|((&z, &load), &phase)| Plane { z, load, phase }).collect();
        (!planes.is_empty()).then_some(PlacedUnbalance { name, planes })
    })
}

fn stage((name, table): (String, Table)) -> Option<Stage> {
    table.read(|table| {
        let kind = table.optional_word("kind").unwrap_or(STAGES[0]);
        let z = table.quantity("z");
        let across = table.quantity("stiffness");
        let [power, diameter, width] = ["power", "diameter", "width"].map(|key| table.quantity(key));
        let density_ratio = table.has("density_ratio").then(|| table.number_or_middle("density_ratio"));
        let source = match across {
            Some(across) => {
                for key in ["power", "diameter", "width", "density_ratio", "kind"] {
                    if table.has(key) {
                        table.conflict("stiffness", key);
                    }
                }
                if across == 0.0 {
                    let message = "a `stiffness` of 0 N/m is none";
                    let help = "write its q, or leave the stage out";
                    let place = table.written("stiffness");
                    table.push(place.error_here(Code::BAD_VALUE, message).help(help));
                }
                StageSource::Given(across)
            }
            None => {
                for (key, what) in [
                    ("power", "`power = \"1200 kW\"` of the stage, or its `stiffness` across"),
                    ("diameter", "`diameter = \"400 mm\"`: of the impeller, or the pitch diameter of the blades"),
                    ("width", "`width = \"12 mm\"`: the smaller of impeller and diffuser at its outlet, or the height of blades"),
                ] {
                    if !table.has(key) {
                        table.absent(key, &format!("add {what}"));
                    }
                }
                let (power, diameter, width) = (power?, diameter?, width?);
                match kind {
                    "blades" => {
                        if table.has("density_ratio") {
                            let help = "leave it out: the formula of blades has none";
                            let place = table.written("density_ratio");
                            let message = "`density_ratio` is of an impeller";
                            table.push(place.error_here(Code::BAD_VALUE, message).help(help));
                        }
                        StageSource::Blades { power, diameter, height: width }
                    }
                    _ => {
                        if density_ratio.is_none() {
                            let help = "add `density_ratio = 1.6`: the density at discharge over that at suction";
                            table.absent("density_ratio", help);
                        }
                        StageSource::Impeller { power, diameter, width, density_ratio: density_ratio? }
                    }
                }
            }
        };
        Some(Stage { name, z, source })
    })
}

fn variant((name, table): (String, Table)) -> Variant {
    table.read(|table| {
        let set = table.texts("set");
        if set.is_empty() {
            let help = "add `set = [\"joint.left.radial_clearance = 90 um\"]`: keys of the case with their values";
            table.absent("set", help);
        }
        for own in set.iter().filter(|own| !own.text().contains('=')) {
            let message = format!("`{}` has no `=`", own.text());
            let help = "write a key of the case and its value: \"joint.left.radial_clearance = 90 um\"";
            table.push(own.error_here(Code::BAD_VALUE, message).help(help));
        }
        for own in set.iter().filter(|own| own.text().trim_start().starts_with("analysis.")) {
            let message = format!(
                "`{}` is a key of an analysis, and variants are of the machine",
                own.text().split('=').next().unwrap_or_default().trim()
            );
            let help = "write another `[analysis.NAME]` with that value";
            table.push(own.error_here(Code::BAD_VALUE, message).help(help));
        }
        Variant { name, set }
    })
}

/// The place of a joint that the case has; one that it has not is noted.
fn joint(table: &Table, joined: &JoinedMachine, name: &Located) -> Option<usize> {
    let known: Vec<&str> = joined.joints.iter().map(|own| own.name.text()).collect();
    let message = format!("there is no joint `{}`", name.text());
    let help = || match known.is_empty() {
        true => "this machine has no joint".to_owned(),
        false => format!("name one of `{}`", known.join("`, `")),
    };
    names::place(table, name, &known, message, help)
}

/// Quantities above zero by names.
fn named(
    table: &Table,
    key: &str,
    (dimension, what): (&Dimension, &str),
    example: &str,
) -> Vec<(Located, f64)> {
    let read = |(name, value): (Located, Located)| {
        let wrong = |code: Code, message: String| {
            let help = format!("write {what} above zero, such as \"{example}\"");
            table.push(value.error_here(code, message).help(help));
            None
        };
        match Quantity::parse(value.text()) {
            Ok(own) if !own.dimension().fits(dimension) => {
                wrong(Code::WRONG_UNIT, format!("`{}` is {}", value.text(), own.dimension()))
            }
            Ok(own) if own.si() > 0.0 => Some((name, own.si())),
            Ok(_) => wrong(Code::BAD_VALUE, format!("`{}` is not above zero", value.text())),
            Err(error) => wrong(error.code, error.message),
        }
    };
    table.named_values(key).into_iter().filter_map(read).collect()
}
