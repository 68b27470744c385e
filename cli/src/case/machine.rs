//! The tables that describe a rotating machine.

use std::collections::BTreeMap;

use whirl_codegen::diagnostic::{Code, Located, suggest};
use whirl_codegen::rational::nearest;
use whirl_codegen::units::Quantity;
use whirl_solver::mesh::Material;
use whirl_solver::mesh::shaft::{SectionCells, SolidShaft};
use whirl_solver::mesh::support::{RingSupport, SupportCells};
use whirl_specs::{MOTIONS, Motion};

use super::law::{self, NamedLaw};
use super::library::{Shelf, resolve};
use super::loads;
use super::parameters::{self, BearingFacts, Keys, SetParameter};
use super::reader::Reader;
use super::rotor::{
    Bearing, Drive, GroundSpring, Made, Mesh, MeshFile, Region, RotorDraft, Shaft, Support,
};
use super::schema::MOST_SPRINGS;

/// The materials of a case.
struct Materials {
    known: BTreeMap<String, Material>,
    /// Whether these are all that the case describes.
    all_read: bool,
}

/// The motion derived from the kinetic energy.
const DEFAULT_MOTION: &str = "consistent";

pub(super) fn read(shelf: Shelf, file: &Reader) -> RotorDraft {
    let before = file.errors();
    let tables = file.named_tables("material");
    // Of materials that are no tables, nothing more is said where they are named.
    let all_read = file.errors() == before;
    let known = tables.into_iter().map(|(name, table)| (name.clone(), material(&name, &table)));
    let materials = Materials { known: known.collect(), all_read };
    RotorDraft {
        shaft: shaft(shelf, file, &materials),
        support: support(shelf, file, &materials),
        bearings: bearings(shelf, file),
        drive: drive(file),
        loads: loads::read(file),
    }
}

fn material(name: &str, table: &Reader) -> Material {
    let before = table.errors();
    let values = [
        ("E", table.quantity_or_one("youngs_modulus")),
        ("nu", table.number_or_middle("poissons_ratio")),
        ("rho", table.quantity_or_one("density")),
    ];
    let properties = values.map(|(symbol, value)| (symbol.to_string(), value)).into();
    let material = Material { name: name.to_string(), properties };
    let keys = [("E", "youngs_modulus"), ("nu", "poissons_ratio"), ("rho", "density")];
    let whole = keys.iter().all(|(_, key)| table.has(key)) && table.errors() == before;
    for doubt in material.doubts().into_iter().filter(|_| whole) {
        let key = keys.iter().find(|(symbol, _)| *symbol == doubt.symbol).map(|(_, key)| *key);
        let place = key.and_then(|key| table.places().remove(key));
        let place = place.unwrap_or_else(|| table.place().text(""));
        table.push(place.error_here(Code::BAD_VALUE, doubt.what).help(doubt.help));
    }
    material
}

fn material_of(table: &Reader, materials: &Materials) -> Option<Material> {
    called_material(table, &table.text("material")?, materials)
}

/// Materials of parts of the mesh.
fn regions(table: &Reader, materials: &Materials) -> Vec<Region> {
    let named = table.named_texts("regions").into_iter();
    let region = |(set, name): (Located, Located)| {
        Some(Region { set, material: called_material(table, &name, materials)? })
    };
    named.filter_map(region).collect()
}

fn called_material(table: &Reader, name: &Located, materials: &Materials) -> Option<Material> {
    let found = materials.known.get(name.text());
    if found.is_none() && materials.all_read {
        let known: Vec<&str> = materials.known.keys().map(String::as_str).collect();
        let message = format!("there is no material `{}`", name.text());
        let help = suggest(name.text(), &known)
            .unwrap_or_else(|| format!("describe it in a table `[material.{}]`", name.text()));
        table.push(name.error_here(Code::BAD_VALUE, message).help(help));
    }
    found.cloned()
}

/// A mesh by the file named as `mesh`, or made from the table `dimensions`.
fn mesh<D>(
    shelf: Shelf,
    table: &Reader,
    material: Option<&Material>,
    make: impl Fn(&Reader, Material) -> D,
) -> Option<Mesh<D>> {
    let before = table.errors();
    let dimensions = table.table("dimensions");
    match (table.text("mesh"), dimensions) {
        (Some(_), Some(dimensions)) => {
            table.conflict("mesh", "dimensions");
            // Read all the same, so that its keys are not unknown ones.
            make(&dimensions, no_material());
            None
        }
        (Some(name), None) => {
            let path = resolve(name.source(), name.text());
            if shelf == Shelf::Disk && !path.is_file() {
                let message = format!("there is no file `{}`", path.display());
                let error = name.error_here(Code::BAD_VALUE, message);
                table.push(error.help("paths are relative to the file that names them"));
                return None;
            }
            Some(Mesh::File(MeshFile { path, name }))
        }
        (None, Some(dimensions)) => {
            if !table.has("material") {
                table.absent("material", "a mesh made from dimensions needs `material = \"…\"`");
            }
            // Read without a material too, for the same reason.
            let made = make(&dimensions, material.cloned().unwrap_or_else(no_material));
            let (place, places) = (dimensions.place().text(""), dimensions.places());
            drop(dimensions);
            // Of dimensions that are wrong, nothing is made.
            let right = table.errors() == before && material.is_some();
            right.then_some(Mesh::Made(Made { dimensions: made, table: place, places }))
        }
        (None, None) => {
            if !table.has("mesh") && !table.has("dimensions") {
                let help = "add `mesh = \"body.inp\"`, or a table of `dimensions`";
                table.absent("mesh", help);
            }
            None
        }
    }
}

fn no_material() -> Material {
    Material { name: String::new(), properties: BTreeMap::new() }
}

fn solid_shaft(table: &Reader, material: Material) -> SolidShaft {
    let usual = SectionCells::default();
    let cells = table.table("cells");
    let count = |key, usual| cells.as_ref().and_then(|t| t.count(key)).unwrap_or(usual);
    SolidShaft {
        length: table.quantity_or_one("length"),
        diameter: table.quantity_or_one("diameter"),
        supports: table.quantities("supports"),
        support_length: table.quantity_or_one("support_length"),
        layers_in_support: table.count_or_one("layers_in_support"),
        layers_between: table.count_or_one("layers_between"),
        loads: table.quantities("loads"),
        section: SectionCells {
            sectors: count("sectors", usual.sectors),
            rings: count("rings", usual.rings),
        },
        material,
    }
}

fn ring_support(table: &Reader, material: Material) -> RingSupport {
    let usual = SupportCells::default();
    let cells = table.table("cells");
    let count = |key, usual| cells.as_ref().and_then(|t| t.count(key)).unwrap_or(usual);
    RingSupport {
        start: table.quantity_or_one("start"),
        length: table.quantity_or_one("length"),
        height: table.quantity_or_one("height"),
        width: table.quantity_or_one("width"),
        pedestal_height: table.quantity_or_one("pedestal_height"),
        rings: table.quantities("rings"),
        ring_length: table.quantity_or_one("ring_length"),
        ring_thickness: table.quantity_or_one("ring_thickness"),
        bore_radius: table.quantity_or_one("bore_radius"),
        layers_in_ring: table.count_or_one("layers_in_ring"),
        layers_between: table.count_or_one("layers_between"),
        section: SupportCells {
            height: count("height", usual.height),
            width: count("width", usual.width),
            pedestal: count("pedestal", usual.pedestal),
            around: count("around", usual.around),
            radial: count("radial", usual.radial),
        },
        material,
    }
}

fn shaft(shelf: Shelf, file: &Reader, materials: &Materials) -> Option<Shaft> {
    file.demand("shaft");
    let table = file.table("shaft")?;
    let material = material_of(&table, materials);
    let regions = regions(&table, materials);
    let mesh = mesh(shelf, &table, material.as_ref(), solid_shaft);
    let motion = motion(&table);
    let shaft = Shaft {
        modes: table.count_or_one("modes"),
        damping: table.quantity("damping").unwrap_or(0.0),
        axial_restraint: table.text_or_none("axial_restraint"),
        material,
        regions,
        motion: motion.or_else(default_motion)?,
        mesh: mesh?,
    };
    Some(shaft)
}

fn support(shelf: Shelf, file: &Reader, materials: &Materials) -> Option<Support> {
    file.demand("support");
    let table = file.table("support")?;
    let material = material_of(&table, materials);
    let regions = regions(&table, materials);
    let mesh = mesh(shelf, &table, material.as_ref(), ring_support);
    let ground_spring = |spring: Reader| GroundSpring {
        set: spring.text_or_none("set"),
        direction: match spring.word("direction") {
            Some("z") => 2,
            Some("y") => 1,
            _ => 0,
        },
        stiffness: spring.quantity_or_one("stiffness"),
    };
    let support = Support {
        modes: table.count_or_one("modes"),
        damping: table.quantity("damping").unwrap_or(0.0),
        mounts: table.text_or_none("mounts"),
        ground_springs: table.tables("ground_spring").into_iter().map(ground_spring).collect(),
        material,
        regions,
        mesh: mesh?,
    };
    Some(support)
}

/// What the bearings share stands in `[springs]`; a `[[bearing]]` may say otherwise.
fn bearings(shelf: Shelf, file: &Reader) -> Vec<([Vec<Located>; 2], Option<Bearing>)> {
    let shared = file.table("springs");
    let shared_springs = shared.as_ref().map(|table| springs(shelf, table)).unwrap_or_default();
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
        // Of the bearings' own values nothing is known here: only names and units are looked at.
        let set = &shared_springs.parameters;
        parameters::check(table, law, set, KEYS, &mut BearingFacts::default());
    }
    let one = |table: &Reader| {
        let sets = [table.names("journal"), table.names("bore")];
        let stations = table.quantities("stations");
        let own = springs(shelf, table);
        let mut places = shared.as_ref().map(Reader::places).unwrap_or_default();
        places.extend(table.places());
        let bearing = bearing(table, &sets, stations, own.or(&shared_springs), places);
        (sets, bearing.filter(|bearing| bounded(table, bearing)))
    };
    tables.iter().map(one).collect()
}

/// Notes the bearings that do not say `key`; once where none does.
fn demand_of_each(tables: &[Reader], key: &'static str) {
    let silent: Vec<&Reader> = tables.iter().filter(|table| !table.has(key)).collect();
    let told = if silent.len() == tables.len() { 1 } else { silent.len() };
    for table in &silent[..told.min(silent.len())] {
        let example = table.example(key);
        let help = format!("add `{key} = {example}` here, or to `[springs]` for all bearings");
        table.absent(key, &help);
    }
}

/// What `[springs]` and `[[bearing]]` both may say.
#[derive(Default)]
struct Springs {
    law: Option<NamedLaw>,
    number: Option<usize>,
    radial_clearance: Option<Quantity>,
    journal_radius: Option<Quantity>,
    length: Option<Quantity>,
    parameters: Vec<SetParameter>,
}

/// What messages call the values of a bearing.
const KEYS: Keys = Keys { clearance: "radial_clearance" };

fn springs(shelf: Shelf, table: &Reader) -> Springs {
    Springs {
        law: law::read(shelf, table),
        number: table.count("number"),
        radial_clearance: table.exact("radial_clearance"),
        journal_radius: table.exact("journal_radius"),
        length: table.exact("length"),
        parameters: parameters::read(table),
    }
}

impl Springs {
    /// What these do not say, `shared` does.
    fn or(self, shared: &Springs) -> Springs {
        let or = |own: Option<Quantity>, shared: &Option<Quantity>| own.or_else(|| shared.clone());
        // Parameters belong to the law beside them, if one is named there.
        let name = |law: &NamedLaw| law.source.name();
        let (own, other) = (self.law.as_ref().map(name), shared.law.as_ref().map(name));
        let alike = own.is_none() || other.is_none() || own == other;
        let parameters = if alike { shared.parameters.as_slice() } else { &[] };
        Springs {
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
    table: &Reader,
    sets: &[Vec<Located>; 2],
    stations: Vec<f64>,
    springs: Springs,
    places: BTreeMap<String, Located>,
) -> Option<Bearing> {
    let [journal, bore] = sets.clone();
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
        table: table.place().written(),
        places,
    };
    bearing.facts.springs = Some(bearing.springs.saturating_mul(bearing.rings()));
    Some(bearing)
}

/// Whether a bearing has no more springs than are allowed, which is noted otherwise.
fn bounded(table: &Reader, bearing: &Bearing) -> bool {
    let springs = bearing.springs.saturating_mul(bearing.stations.len().max(3));
    if springs > MOST_SPRINGS {
        let message = format!(
            "this bearing has {springs} springs in all its rings, at most {MOST_SPRINGS} are allowed"
        );
        let help = Some("lower `number`, or list fewer `stations`".to_string());
        table.note(table.place(), Code::BAD_VALUE, message, help);
    }
    springs <= MOST_SPRINGS
}

fn drive(file: &Reader) -> Option<Drive> {
    file.demand("drive");
    let table = file.table("drive")?;
    leads_to_its_target(&table);
    Some(Drive {
        top: table.text_or_none("top"),
        bottom: table.text_or_none("bottom"),
        torque: table.quantity_or_one("torque"),
        target_speed: table.quantity_or_one("target_speed"),
        acts: table.flag("acts").unwrap_or(true),
    })
}

/// Notes a couple that never brings the shaft to the target speed: it starts at rest.
fn leads_to_its_target(table: &Reader) {
    let (torque, target) = (table.quantity("torque"), table.quantity("target_speed"));
    let (Some(torque), Some(target)) = (torque, target) else { return };
    if torque * target > 0.0 || table.flag("acts") == Some(false) {
        return;
    }
    let mut places = table.places();
    // What stands there is a string, with its quotes.
    let mut written = |key: &str| {
        let place = places.remove(key).unwrap_or_else(|| table.place().text(""));
        let bare = place.text().trim_matches(['"', '\'']).to_owned();
        Located::new(place.source(), place.span(), bare)
    };
    let (torque_text, target_text) = (written("torque"), written("target_speed"));
    let bare = |located: &Located| located.text().trim_matches(['"', '\'']).trim().to_owned();
    let opposite = |text: String| match text.strip_prefix('-') {
        Some(rest) => rest.trim_start().to_owned(),
        None => format!("-{}", text.trim_start_matches('+')),
    };
    let (place, message, help) = if target == 0.0 {
        let message = "a shaft that starts at rest is at this `target_speed` at once".to_owned();
        (&target_text, message, "name the speed to reach, or say `acts = false`".to_owned())
    } else if torque == 0.0 {
        let message = "a `torque` of zero turns nothing".to_owned();
        (&torque_text, message, "name a couple, or say `acts = false`".to_owned())
    } else {
        let message = format!(
            "a couple of {} leads away from a `target_speed` of {}",
            bare(&torque_text),
            bare(&target_text)
        );
        let help = format!(
            "write `target_speed = \"{}\"` to turn the shaft that way, or `torque = \"{}\"`",
            opposite(bare(&target_text)),
            opposite(bare(&torque_text))
        );
        (&target_text, message, help)
    };
    table.push(place.error_here(Code::BAD_VALUE, message).help(help));
}

/// The motion that a table names, or the default one.
pub(super) fn motion(table: &Reader) -> Option<&'static Motion> {
    let name = table.text("motion");
    let wanted = name.as_ref().map_or(DEFAULT_MOTION, |name| name.text()).to_string();
    let found = called(&wanted);
    if found.is_none() {
        let known: Vec<&str> = MOTIONS.iter().map(|motion| motion.origin.name).collect();
        let place = name.unwrap_or_else(|| table.place().text(""));
        let error = place.error_here(Code::BAD_VALUE, format!("there is no motion `{wanted}`"));
        table.push(error.maybe_help(suggest(&wanted, &known)));
    }
    found
}

fn called(name: &str) -> Option<&'static Motion> {
    MOTIONS.iter().find(|motion| motion.origin.name == name)
}

/// In place of one that is not there, which has been noted.
fn default_motion() -> Option<&'static Motion> {
    called(DEFAULT_MOTION)
}
