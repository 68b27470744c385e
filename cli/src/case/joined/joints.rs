//! The table `[joint.NAME]`.

use std::f64::consts::PI;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::kinds::law::{Acts, BearingValue};
use whirl_codegen::rational::nearest;
use whirl_codegen::units::Quantity;

use super::bushing;
use super::fit::Room;
use super::gear;
use super::parts::Parts;
use super::schema::{self, FROM_MESH};
use super::sensor;
use crate::case::joint::{Joint, JointKind, Side};
use crate::case::law;
use crate::case::library::FileStore;
use crate::case::names::{self, GROUND};
use crate::case::parameters::{self, BearingFacts, Keys, SetParameter};
use crate::case::rotor::Bearing;
use crate::case::shapes::MOST_SPRINGS;
use crate::case::stop;
use crate::case::supports::SupportName;

pub(super) fn read(
    store: FileStore,
    table: &Table,
    name: &Located,
    known: &[Located],
) -> Option<Joint> {
    let kind = match table.optional_word("kind") {
        Some("stop") => JointKind::Stop,
        Some("bushing") => JointKind::Bushing,
        Some("coupling") => JointKind::Coupling,
        Some("gear") => JointKind::Gear,
        Some(_) => JointKind::Bearing,
        None => {
            // Which keys are those of its kind, is open.
            schema::JOINT.iter().for_each(|key| table.pass_over(key.name));
            return None;
        }
    };
    let (called, [first, second]) = kind.words();
    let sides = [side(table, first, known), side(table, second, known)];
    let parts = match kind {
        JointKind::Bearing => bearing(store, table),
        JointKind::Stop => stop(store, table),
        JointKind::Bushing => bushing::read(store, table),
        JointKind::Coupling => coupling(table),
        JointKind::Gear => gear::read(table),
    };
    let of_bearing = matches!(kind, JointKind::Bearing | JointKind::Stop);
    let rings = |key: &str| if of_bearing { three(table, key) } else { Some(Vec::new()) };
    let (run_out, offset) = (rings("run_out"), rings("offset"));
    let sensor = if kind == JointKind::Bearing { sensor::read(table) } else { None };
    let [Some(journal), Some(bore)] = sides else { return None };
    if journal.body.is_none() {
        let message = format!("the ground is the `{second}` of a {called}, not its `{first}`");
        let help = format!("swap the two: forces on the `{first}` are what results show");
        table.push(journal.place.error_here(Code::BAD_VALUE, message).help(help));
        return None;
    }
    if journal.body == bore.body {
        let message = format!("both sides of this {called} are on `{}`", bore.place.text());
        let help = "a joint joins two bodies, or a body and the ground";
        table.push(bore.place.error_here(Code::BAD_VALUE, message).help(help));
        return None;
    }
    let parts = parts?;
    let Parts { springs, law, parameters, mut facts, clearance, stations, angle, gears, .. } =
        parts;
    let sets = |side: &Side| match side.sets.as_slice() {
        [one] => vec![one.clone(); 3],
        sets => sets.to_vec(),
    };
    let planes = [&journal, &bore].into_iter().any(|side| side.sets.len() == 3 || side.surface);
    let rings = if stations.is_empty() { 1 + 2 * usize::from(planes) } else { stations.len() };
    let (run_out, offset) = (run_out?, offset?);
    if let (Some(file), true) = (&parts.table, law.source.over_frequency().is_some() && rings > 1) {
        let message =
            format!("`{}` is over the frequency, which is for joints in one plane", file.text());
        let help = "name one set on each side, or write one joint for each plane";
        table.push(file.error_here(Code::BAD_VALUE, message).help(help));
        return None;
    }
    let radius = facts.journal_radius.as_ref().map(nearest);
    for (key, places) in [("run_out", &run_out), ("offset", &offset)] {
        if places.len() == 3 && rings == 1 && !planes {
            let message = format!("this {called} is in one plane, and has one `{key}`");
            let help = "write one place, or name three `sets` or two `stations` along the joint";
            table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
        }
        if let Some(room) = Room::of(kind, angle, clearance, radius) {
            room.check(table, key, places);
        }
    }
    let [run_out, offset] = [run_out, offset].map(|places| match places.as_slice() {
        [left, middle, right] => [*left, *middle, *right],
        places => [places.first().copied().unwrap_or_default(); 3],
    });
    facts.springs = Some(springs.saturating_mul(rings));
    if springs.saturating_mul(rings) > MOST_SPRINGS {
        let message = format!("this joint has more than {MOST_SPRINGS} springs in all its rings");
        let help = "lower `springs`, or list fewer `stations`";
        table.push(table.heading().error(Code::BAD_VALUE, message).help(help));
        return None;
    }
    let bearing = Bearing {
        journal: sets(&journal),
        bore: sets(&bore),
        springs,
        stations,
        radial_clearance: clearance,
        journal_radius: radius,
        law,
        parameters,
        facts,
        table: name.clone(),
        places: table.places(),
    };
    let acts = bearing.law.source.acts();
    let sensor = match kind {
        JointKind::Bearing => sensor::placed(table, sensor, acts, [&journal, &bore]),
        _ => None,
    };
    let (name, sides) = (name.clone(), [journal, bore]);
    let (others, table, clearance_from_mesh) = (parts.others, parts.table, parts.from_mesh);
    Some(Joint {
        called: SupportName::joint(name.text()),
        name,
        kind,
        sides,
        bearing,
        clearance_from_mesh,
        others,
        table,
        angle,
        run_out,
        offset,
        gears,
        sensor,
    })
}

/// One side; the second one is the ground if it is left out.
fn side(table: &Table, key: &'static str, known: &[Located]) -> Option<Side> {
    let second = matches!(key, "bore" | "second");
    if !second && !table.has(key) {
        table.absent(key, &format!("add `{key} = {{ body = \"NAME\" }}`"));
    }
    if names::is_text(table, key, |text| format!("{{ body = {text} }}")) {
        return None;
    }
    let Some(own) = table.optional_table(key) else {
        let place = table.heading().text(GROUND);
        let ground =
            Side { body: None, place, sets: Vec::new(), surface: false, z: None, at: None };
        return (second && !table.has(key)).then_some(ground);
    };
    own.read(|side| {
        let (mut sets, z) = (side.texts("sets"), side.quantity("z"));
        let of_faces = matches!(key, "journal" | "bore");
        let at = if key == "first" { side.quantity_pair("at") } else { None };
        let at = at.map(|place| (place, side.written("at")));
        let surface = if of_faces { side.optional_string("surface") } else { None };
        if surface.is_some() && side.gives("sets") {
            side.conflict("surface", "sets");
        }
        let place = side.optional_string("body")?;
        let ground = place.text() == GROUND;
        let body = if ground { None } else { Some(names::body(side, &place, known, second)?) };
        let given = if surface.is_some() { Some("surface") } else { Some("sets") };
        let given = given.filter(|key| side.has(key));
        if let Some(key) = given.filter(|_| ground) {
            let message = "the ground has no node sets: it is a rigid bore around the journal";
            let help = format!("leave `{key}` out");
            side.push(side.written(key).error_here(Code::BAD_VALUE, message).help(help));
        }
        if !matches!(sets.len(), 0 | 1 | 3) {
            let message = format!("a side has one set, or three, not {}", sets.len());
            let help = "name the sets at the left end, in the middle and at the right end, or one";
            side.push(side.written("sets").error_here(Code::BAD_VALUE, message).help(help));
        }
        sets.extend(surface.clone());
        Some(Side { body, place, sets, surface: surface.is_some(), z, at })
    })
}

/// A joint whose law is shipped.
fn shipped(table: &Table, name: &str, parameters: Vec<SetParameter>) -> Option<Parts> {
    Some(Parts::of_law(bushing::shipped(table, name)?, parameters))
}

/// What messages call the values of a bearing and of a stop.
const OF_BEARING: Keys = Keys { clearance: "radial_clearance" };
const OF_STOP: Keys = Keys { clearance: "gap" };

/// Whether the clearance is to be measured on the meshes.
fn is_from_mesh(table: &Table) -> bool {
    let key = "radial_clearance";
    let said = table.gives(key) && table.written(key).text().trim_matches(['"', '\'']) == FROM_MESH;
    if said {
        table.pass_over(key);
    }
    said
}

fn bearing(store: FileStore, table: &Table) -> Option<Parts> {
    table.demand("law");
    let law = law::read_of_joint(store, table);
    let parameters = parameters::read(table);
    let springs = table.optional_count("springs");
    let from_mesh = is_from_mesh(table);
    let clearance = if from_mesh { None } else { table.exact_quantity("radial_clearance") };
    let exactly = |quantity: Option<Quantity>| quantity.as_ref().map(parameters::exactly);
    let mut facts = BearingFacts {
        radial_clearance: clearance.as_ref().map(parameters::exactly),
        journal_radius: exactly(table.exact_quantity("journal_radius")),
        length: exactly(table.exact_quantity("length")),
        ..BearingFacts::default()
    };
    let stations = table.quantities("stations");
    let law = law?;
    let each = law.source.acts() == Acts::Spring;
    if law.source.acts() == Acts::Gear {
        let message = format!("`{}` is a law of the teeth of gears", law.name.text());
        let help = "write `kind = \"gear\"`, or take a law of a spring, of a ring or of a joint";
        table.push(law.name.error_here(Code::BAD_VALUE, message).help(help));
        return None;
    }
    if each {
        table.demand("springs");
    }
    if matches!(law.source.acts(), Acts::Joint | Acts::Sensor) && stations.len() > 1 {
        let message = format!("`{}` acts once a joint, not in several planes", law.name.text());
        let help = "leave `stations` out, or write one joint for each";
        table.push(table.written("stations").error_here(Code::BAD_VALUE, message).help(help));
    }
    let of_clearance = |value: BearingValue| {
        matches!(value, BearingValue::RadialClearance | BearingValue::DiametralClearance)
    };
    let known = law.source.parameters();
    if each || known.iter().any(|own| own.bearing.is_some_and(of_clearance)) {
        table.demand("radial_clearance");
    }
    let before = table.errors();
    parameters::check(table, &law, &parameters, OF_BEARING, &mut facts);
    if from_mesh && facts.radial_clearance.is_some() {
        let message = "the `parameters` say the clearance of this bearing, which is to be measured on the meshes";
        let help = "leave that parameter out: the law takes it from the bearing; or leave `radial_clearance` out";
        table.push(table.written("parameters").error_here(Code::BAD_VALUE, message).help(help));
    }
    (table.errors() == before).then(|| Parts {
        springs: springs.unwrap_or(1),
        facts,
        clearance: clearance.map_or(0.0, |clearance| clearance.si()),
        from_mesh,
        stations,
        ..Parts::of_law(law, parameters)
    })
}

/// What a stop has.
pub(in crate::case) fn stop(store: FileStore, table: &Table) -> Option<Parts> {
    let side = stop::side(table);
    table.demand("law");
    let law = law::read(store, table);
    let parameters = parameters::read(table);
    let exactly = |key| table.exact_quantity(key).as_ref().map(parameters::exactly);
    let mut facts = BearingFacts {
        journal_radius: exactly("journal_radius"),
        length: exactly("length"),
        ..BearingFacts::default()
    };
    let gap = table.exact_quantity("gap");
    let before = table.errors();
    match (side, &law) {
        (stop::Side::Around, Some(law)) => {
            facts.radial_clearance = stop::around(table, law, gap.as_ref());
        }
        (stop::Side::Around, None) => {}
        _ => table.demand("gap"),
    }
    let law = law?;
    stop::fits(table, side, &law);
    parameters::check(table, &law, &parameters, OF_STOP, &mut facts);
    let around = facts.radial_clearance.as_ref().map_or(0.0, nearest);
    (table.errors() == before).then(|| Parts {
        facts,
        clearance: match side {
            stop::Side::Around => around,
            _ => gap.map_or(1.0, |gap| gap.si()),
        },
        angle: match side {
            stop::Side::Above => Some(0.0),
            stop::Side::Below => Some(PI),
            stop::Side::Around => None,
        },
        ..Parts::of_law(law, parameters)
    })
}

fn coupling(table: &Table) -> Option<Parts> {
    if !table.has("stiffness") {
        table.absent("stiffness", "add `stiffness = \"1e4 N*m/rad\"`");
    }
    let (mut set, mut right) = (Vec::with_capacity(2), true);
    for (key, name, zero) in [("stiffness", "k", "0 N*m/rad"), ("damping", "c", "0 N*m*s/rad")] {
        let before = table.errors();
        let value = table.exact_quantity(key);
        bushing::limited(table, (table, key), key, value.as_ref());
        right &= table.errors() == before;
        let value = value.map_or_else(|| Quantity::parse(zero), Ok).ok()?;
        set.push(SetParameter::new(name, &table.written(key), value));
    }
    right = right && bushing::acts(table, "coupling", &set);
    right.then(|| shipped(table, "coupling", set)).flatten()
}

/// No place, one for all rings, or one each.
fn three(table: &Table, key: &str) -> Option<Vec<[f64; 2]>> {
    if !table.has(key) {
        return Some(Vec::new());
    }
    let places = table.quantity_pairs(key)?;
    match places.len() {
        1 | 3 => Some(places),
        other => {
            let message = format!("`{key}` has one place, or three, not {other}");
            let help = format!(
                "such as `{key} = [\"0 mm\", \"0.1 mm\"]`, or a list of three of these: left, middle, right"
            );
            table.push(table.written(key).error_here(Code::BAD_VALUE, message).help(help));
            None
        }
    }
}
