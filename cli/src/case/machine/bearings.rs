//! Bearings: what `[springs]` says of all and `[[bearing]]` of one.

use std::collections::BTreeMap;

use whirl_codegen::diagnostic::{Code, Located};
use whirl_codegen::document::Table;
use whirl_codegen::rational::nearest;
use whirl_codegen::units::Quantity;

use super::super::joint::{Joint, JointKind, Side};
use super::super::law::{self, NamedLaw};
use super::super::library::FileStore;
use super::super::parameters::{self, BearingFacts, Keys, SetParameter};
use super::super::rotor::Bearing;
use super::super::shapes::MOST_SPRINGS;
use super::super::supports::SupportName;
use super::places::{SHAFT, SUPPORT};

/// What the bearings share stands in `[springs]`; a `[[bearing]]` may say otherwise.
pub(super) fn joints(store: FileStore, file: &Table) -> Option<Vec<Joint>> {
    let shared = file.optional_table("springs");
    let shared_springs = shared.as_ref().map(|table| springs(store, table)).unwrap_or_default();
    let tables = file.tables("bearing");
    if tables.is_empty() && !file.has("bearing") {
        file.absent("bearing", "add a table `[[bearing]]` for each place where the shaft runs");
    }
    for key in ["number", "radial_clearance", "law"] {
        if !shared.as_ref().is_some_and(|table| table.has(key)) {
            demand_of_each(&tables, key);
        }
    }
    if let (Some(table), Some(law)) = (&shared, &shared_springs.law) {
        // Of the bearings' own values nothing is known here: only names and units are checked.
        let set = &shared_springs.parameters;
        parameters::check(table, law, set, KEYS, &mut BearingFacts::default());
    }
    let one = |(place, table): (usize, &Table)| {
        let sets = [table.texts("journal"), table.texts("bore")];
        let stations = table.quantities("stations");
        let own = springs(store, table);
        let mut places = shared.as_ref().map(Table::places).unwrap_or_default();
        places.extend(table.places());
        let bearing = bearing(table, &sets, stations, own.or(&shared_springs), places);
        let bearing = bearing.filter(|bearing| bounded(table, bearing))?;
        Some(joint(table, place + 1, bearing))
    };
    let joints: Vec<Option<Joint>> = tables.iter().enumerate().map(one).collect();
    shared.into_iter().chain(tables).for_each(Table::finish);
    joints.into_iter().collect()
}

/// A bearing of the shaft in the support as a joint, by its number.
fn joint(table: &Table, number: usize, bearing: Bearing) -> Joint {
    let side = |body: usize, name: &str, sets: &[Located]| {
        Side::of(Some(body), table.heading().text(name), sets.to_vec())
    };
    let sides = [side(SHAFT, "shaft", &bearing.journal), side(SUPPORT, "support", &bearing.bore)];
    let names =
        (table.heading().text(&number.to_string()), SupportName::numbered("Bearing", number));
    Joint::of(names, JointKind::Bearing, sides, bearing)
}

/// Notes the bearings that do not say `key`; once where none does.
fn demand_of_each(tables: &[Table], key: &'static str) {
    let silent: Vec<&Table> = tables.iter().filter(|table| !table.has(key)).collect();
    let noted = if silent.len() == tables.len() { 1 } else { silent.len() };
    for table in &silent[..noted.min(silent.len())] {
        let example = table.example(key);
        let help = format!("add `{key} = {example}` here, or to `[springs]` for all bearings");
        table.absent(key, &help);
    }
}

/// What `[springs]` and `[[bearing]]` both may say.
#[derive(Default)]
struct SpringKeys {
    law: Option<NamedLaw>,
    number: Option<usize>,
    radial_clearance: Option<Quantity>,
    journal_radius: Option<Quantity>,
    length: Option<Quantity>,
    parameters: Vec<SetParameter>,
}

/// What messages call the values of a bearing.
const KEYS: Keys = Keys { clearance: "radial_clearance" };

fn springs(store: FileStore, table: &Table) -> SpringKeys {
    SpringKeys {
        law: law::read(store, table),
        number: table.optional_count("number"),
        radial_clearance: table.exact_quantity("radial_clearance"),
        journal_radius: table.exact_quantity("journal_radius"),
        length: table.exact_quantity("length"),
        parameters: parameters::read(table),
    }
}

impl SpringKeys {
    /// What these do not say, `shared` does.
    fn or(self, shared: &SpringKeys) -> SpringKeys {
        let or = |own: Option<Quantity>, shared: &Option<Quantity>| own.or_else(|| shared.clone());
        // Parameters belong to the law beside them, if one is named there.
        let name = |law: &NamedLaw| law.source.name();
        let (own, other) = (self.law.as_ref().map(name), shared.law.as_ref().map(name));
        let alike = own.is_none() || other.is_none() || own == other;
        let parameters = if alike { shared.parameters.as_slice() } else { &[] };
        SpringKeys {
            parameters: parameters::over(&self.parameters, parameters),
            law: self.law.or_else(|| shared.law.clone()),
            number: self.number.or(shared.number),
            radial_clearance: or(self.radial_clearance, &shared.radial_clearance),
            journal_radius: or(self.journal_radius, &shared.journal_radius),
            length: or(self.length, &shared.length),
        }
    }
}

/// The bearing, if all that it must have is there.
fn bearing(
    table: &Table,
    sets: &[Vec<Located>; 2],
    stations: Vec<f64>,
    springs: SpringKeys,
    places: BTreeMap<String, Located>,
) -> Option<Bearing> {
    let [journal, bore] = sets.clone();
    if sets.iter().any(|own| own.len() != 3) {
        return None;
    }
    let exactly = |quantity: &Option<Quantity>| quantity.as_ref().map(parameters::exactly);
    let mut facts = BearingFacts {
        radial_clearance: exactly(&springs.radial_clearance),
        journal_radius: exactly(&springs.journal_radius),
        bore_radius: None,
        length: exactly(&springs.length),
        springs: None,
    };
    if let Some(law) = &springs.law {
        parameters::check(table, law, &springs.parameters, KEYS, &mut facts);
    }
    let mut bearing = Bearing {
        journal,
        bore,
        stations,
        springs: springs.number?,
        radial_clearance: springs.radial_clearance?.si(),
        journal_radius: facts.journal_radius.as_ref().map(nearest),
        law: springs.law?,
        parameters: springs.parameters,
        facts,
        table: table.heading().written(),
        places,
    };
    bearing.facts.springs = Some(bearing.springs.saturating_mul(bearing.rings()));
    Some(bearing)
}

/// Whether a bearing has no more springs than are allowed, which is noted otherwise.
fn bounded(table: &Table, bearing: &Bearing) -> bool {
    let springs = bearing.springs.saturating_mul(bearing.stations.len().max(3));
    if springs > MOST_SPRINGS {
        let message = format!(
            "this bearing has {springs} springs in all its rings, at most {MOST_SPRINGS} are allowed"
        );
        let error = table.heading().error(Code::BAD_VALUE, message);
        table.push(error.help("lower `number`, or list fewer `stations`"));
    }
    springs <= MOST_SPRINGS
}
