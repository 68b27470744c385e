//! From the tree of a file to the elements that it has.

use super::fields::{Fields, File, Sign};
use super::model::{
    Bearing, COEFFICIENTS, Coupling, Disc, Material, Model, Named, PointMass, ShaftElement,
};
use super::notes::Notes;
use super::value::{Entry, Value, What};

/// Keys of elements that say nothing of mechanics.
const LOOKS: [&str; 10] = [
    "tag",
    "color",
    "scale_factor",
    "n_l",
    "n_r",
    "name",
    "specific_heat",
    "thermal_conductivity",
    "o_d",
    "_note",
];
/// Classes of bearings that are their coefficients and nothing else.
const PLAIN: [&str; 2] = ["BearingElement", "SealElement"];

/// All elements; what is wrong is noted in the file, what has no counterpart in the notes.
pub(super) fn read(file: &File, root: &Value, notes: &mut Notes) -> Model {
    let mut model = Model::default();
    for entry in root.entries() {
        match (entry.name.as_str(), &entry.value.what) {
            ("ross_version", What::Text(version)) => model.version = Some(version.clone()),
            ("parameters", What::Table(_)) => model.speeds = speeds(file, entry),
            (_, What::Table(_)) => element(file, entry, &mut model, notes),
            _ => {}
        }
    }
    model
}

/// Lowest, highest and rated speed.
fn speeds(file: &File, entry: &Entry) -> [Option<f64>; 3] {
    let own = Fields::new(file, "parameters".to_owned(), entry);
    ["min_w", "max_w", "rated_w"].map(|key| own.optional(key, Sign::NotNegative))
}

/// One element, by its class, which is the first word of its key.
fn element(file: &File, entry: &Entry, model: &mut Model, notes: &mut Notes) {
    let (class, tag) = entry.name.split_once('_').unwrap_or((&entry.name, ""));
    let given = entry.value.entries().iter().find(|own| own.name == "tag");
    let tag = match given.map(|own| &own.value.what) {
        Some(What::Text(tag)) if !tag.trim().is_empty() => tag.clone(),
        _ if tag.is_empty() => class.to_owned(),
        _ => tag.to_owned(),
    };
    let own = Fields::new(file, tag.clone(), entry);
    let has = |key: &str| entry.value.entries().iter().any(|own| own.name == key);
    if class.starts_with("CouplingElement") {
        model.couplings.extend(coupling(&own));
    } else if class.starts_with("ShaftElement") {
        model.shaft.extend(shaft(file, &own, notes));
    } else if class.starts_with("DiskElement") || class.starts_with("GearElement") {
        model.discs.extend(disc(&own, class, notes));
        return;
    } else if class == "PointMass" {
        model.masses.extend(mass(&own));
    } else if has("kxx") || class.ends_with("BearingElement") || class.ends_with("SealElement") {
        model.bearings.extend(bearing(&own, class, notes));
        return;
    } else {
        notes.of(&tag, format!("has no counterpart: an element of the class {class}"));
        return;
    }
    unread(&own, notes);
}

/// Notes keys that mean nothing here.
fn unread(own: &Fields, notes: &mut Notes) {
    let keys: Vec<&str> = own.others().into_iter().filter(|key| !LOOKS.contains(key)).collect();
    if !keys.is_empty() {
        notes.of(&own.tag, format!("left out: {}", keys.join(", ")));
    }
}

fn named(own: &Fields) -> Named {
    Named { tag: own.tag.clone(), place: own.place() }
}

fn shaft(file: &File, own: &Fields, notes: &mut Notes) -> Option<ShaftElement> {
    let n = own.node("n");
    let length = own.number("L", Sign::Positive);
    let [outer, inner] = [("odl", "odr", Sign::Positive), ("idl", "idr", Sign::NotNegative)].map(
        |(left, right, sign)| {
            let left = own.number(left, sign);
            [left, own.optional(right, sign).unwrap_or(left)]
        },
    );
    for (end, key) in [(0, "idl"), (1, "idr")] {
        if inner[end] >= outer[end] {
            let what = format!(
                "its bore of {} m is not smaller than its outer diameter of {} m",
                inner[end], outer[end]
            );
            own.refuse(
                key,
                what,
                "both are diameters: correct them in Python and save the rotor again",
            );
        }
    }
    if (inner[0] == 0.0) != (inner[1] == 0.0) {
        let help = "give both ends of the bore a diameter above zero, or none";
        own.refuse("idr", "its bore ends in a point".to_owned(), help);
    }
    for (key, what) in [
        ("shear_effects", "solids always give way to shear"),
        ("rotary_inertia", "solids always have rotary inertia"),
        ("gyroscopic", "solids always have gyroscopic couples"),
    ] {
        if own.flag(key) == Some(false) {
            notes.of(&own.tag, format!("differs: {key} is off in ROSS, but {what}"));
        }
    }
    for (key, what) in [
        ("axial_force", "the axial force is left out: a body has no such stiffness"),
        ("torque", "the torque along the shaft is left out: a body has no such stiffness"),
        ("alpha", "the damping alpha by mass is left out; bodies have damping by stiffness"),
    ] {
        if own.optional(key, Sign::Any).is_some_and(|own| own != 0.0) {
            notes.of(&own.tag, what);
        }
    }
    let beta = own.optional("beta", Sign::NotNegative).unwrap_or(0.0);
    // Solids need no coefficient of shear.
    own.text("shear_method_calc");
    let material = material(file, own);
    let material_place = own.entry("material").map_or(own.place(), |entry| entry.place.clone());
    let named = named(own);
    Some(ShaftElement {
        named,
        n: n?,
        length,
        outer,
        inner,
        mass_outer: None,
        material: material?,
        material_place,
        beta,
    })
}

fn material(file: &File, own: &Fields) -> Option<Material> {
    own.demand("material");
    let entry = own.entry("material")?;
    if entry.value.entries().is_empty() {
        let help = "save the rotor with the current release of ROSS, which writes materials out";
        own.refuse("material", "its material is no table".to_owned(), help);
        return None;
    }
    let of = Fields::new(file, format!("{} material", own.tag), entry);
    let name = of.text("name").unwrap_or("material").to_owned();
    let density = of.number("rho", Sign::NotNegative);
    let [e, g] = ["E", "G_s"].map(|key| of.optional(key, Sign::Positive));
    let nu = of.optional("Poisson", Sign::Any);
    let (youngs_modulus, poissons_ratio) = match (e, g, nu) {
        (Some(e), Some(g), _) => (e, 0.5 * e / g - 1.0),
        (Some(e), None, Some(nu)) => (e, nu),
        (None, Some(g), Some(nu)) => (2.0 * g * (1.0 + nu), nu),
        _ => {
            of.demand("E");
            of.demand("G_s");
            return None;
        }
    };
    Some(Material { name, density, youngs_modulus, poissons_ratio })
}

fn coupling(own: &Fields) -> Option<Coupling> {
    let n = own.node("n");
    let length = own.number("L", Sign::Positive);
    let ends = [["m_l", "Id_l", "Ip_l"], ["m_r", "Id_r", "Ip_r"]]
        .map(|keys| keys.map(|key| own.number(key, Sign::NotNegative)));
    let six = |keys: [&'static str; 6]| {
        keys.map(|key| own.optional(key, Sign::NotNegative).unwrap_or(0.0))
    };
    let stiffness = six(["kt_x", "kt_y", "kt_z", "kr_x", "kr_y", "kr_z"]);
    let damping = six(["ct_x", "ct_y", "ct_z", "cr_x", "cr_y", "cr_z"]);
    Some(Coupling { named: named(own), n: n?, length, ends, stiffness, damping })
}

fn disc(own: &Fields, class: &str, notes: &mut Notes) -> Option<Disc> {
    let n = own.node("n");
    let inertias = ["m", "Id", "Ip"].map(|key| own.number(key, Sign::NotNegative));
    let gear = class.starts_with("GearElement");
    match gear {
        true => notes.of(
            &own.tag,
            "is a disc here: the file does not say with which gear it meshes; a `[joint.NAME]` with `kind = \"gear\"` does",
        ),
        false => unread(own, notes),
    }
    Some(Disc { named: named(own), n: n?, beyond: 0.0, inertias, gear })
}

fn mass(own: &Fields) -> Option<PointMass> {
    let n = own.node("n");
    let whole = own.optional("m", Sign::NotNegative);
    let mass = ["mx", "my", "mz"].map(|key| own.optional(key, Sign::NotNegative).or(whole));
    if mass.iter().all(Option::is_none) {
        own.demand("m");
    }
    Some(PointMass { named: named(own), n: n?, mass: mass.map(|own| own.unwrap_or(0.0)) })
}

fn bearing(own: &Fields, class: &str, notes: &mut Notes) -> Option<Bearing> {
    let n = own.node("n");
    let link = own.optional_node("n_link");
    let mut speeds = own.list("frequency", Sign::NotNegative).unwrap_or_default();
    let mut coefficients = Vec::with_capacity(COEFFICIENTS.len());
    for key in COEFFICIENTS {
        let needed = matches!(key, "kxx" | "cxx");
        if needed {
            own.demand(key);
        }
        let like = match key {
            "kyy" | "cyy" | "myy" => coefficients.get(match key {
                "kyy" => 0,
                "cyy" => 4,
                _ => 10,
            }),
            _ => None,
        };
        let usual = like.cloned().unwrap_or_else(|| vec![0.0]);
        let values: Vec<f64> = own.list(key, Sign::Any).unwrap_or(usual);
        if values.len() != 1 && values.len() != speeds.len() {
            let what = format!("`{key}` has {} values for {} speeds", values.len(), speeds.len());
            own.refuse(key, what, "a coefficient has one value, or one for each `frequency`");
            return None;
        }
        coefficients.push(values);
    }
    if speeds.len() > 1 {
        let mut order: Vec<usize> = (0..speeds.len()).collect();
        order.sort_by(|a, b| speeds[*a].total_cmp(&speeds[*b]));
        for values in coefficients.iter_mut().filter(|own| own.len() > 1) {
            *values = order.iter().map(|place| values[*place]).collect();
        }
        speeds = order.iter().map(|place| speeds[*place]).collect();
        if let Some(twice) = speeds.windows(2).find(|own| own[0] == own[1]) {
            let what = format!("`frequency` has {:?} rad/s twice", twice[0]);
            own.refuse("frequency", what, "give each speed once");
            return None;
        }
    }
    if !PLAIN.contains(&class) {
        notes.of(
            &own.tag,
            format!("only the coefficients of this {class} are taken, not how they were computed"),
        );
    }
    Some(Bearing { named: named(own), n: n?, link, coefficients, speeds })
}
