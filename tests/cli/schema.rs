//! `whirl schema`: the copies under schemas/ are what the command prints (WHIRL_RENEW_GOLDEN=1 writes them
//! anew), and every key that they show is read.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value, json};

use crate::workbench::Workbench;

const KINDS: [&str; 8] = ["law", "element", "form", "motion", "clearance", "film", "case", "sweep"];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn schema(kind: &str) -> Value {
    let outcome = Workbench::new().whirl(&["schema", kind]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    serde_json::from_str(&outcome.stdout).expect("JSON")
}

#[test]
fn the_committed_schemas_are_those_of_the_program() {
    let bench = Workbench::new();
    for kind in KINDS {
        let found = bench.whirl(&["schema", kind]).stdout;
        let path = root().join(format!("schemas/{kind}.json"));
        if std::env::var_os("WHIRL_RENEW_GOLDEN").is_some() {
            fs::write(&path, &found).expect("the schema can be written");
        }
        let committed = fs::read_to_string(&path).expect("the schema is there");
        assert!(committed == found, "{kind}: WHIRL_RENEW_GOLDEN=1 renews {}", path.display());
    }
    let files = fs::read_dir(root().join("schemas")).expect("the folder").count();
    assert_eq!(files, KINDS.len());
    let kinds = bench.whirl(&["schema"]).stdout;
    assert!(KINDS.iter().all(|kind| kinds.contains(kind)), "{kinds}");
}

/// docs/keys.md and docs/sweep-keys.md are printed, too.
#[test]
fn the_pages_of_keys_are_those_of_the_program() {
    let bench = Workbench::new();
    for (kind, page) in [("case", "keys"), ("sweep", "sweep-keys")] {
        let found = bench.whirl(&["schema", kind, "--page"]);
        assert_eq!((found.status, found.stderr.as_str()), (0, ""), "{kind}");
        let path = root().join(format!("docs/{page}.md"));
        if std::env::var_os("WHIRL_RENEW_GOLDEN").is_some() {
            fs::write(&path, &found.stdout).expect("the page can be written");
        }
        let committed = fs::read_to_string(&path).expect("the page is there");
        assert!(committed == found.stdout, "WHIRL_RENEW_GOLDEN=1 renews {}", path.display());
        // Every key of the schema has a line.
        let mut keys = BTreeSet::new();
        names(&schema(kind), &mut keys);
        assert!(keys.len() > 5, "{keys:?}");
        for key in keys {
            assert!(committed.contains(&format!("| `{key}`")), "{kind}: `{key}`");
        }
    }
}

/// Names of keys with their own description, at any depth.
fn names(schema: &Value, all: &mut BTreeSet<String>) {
    match schema {
        Value::Object(entries) => {
            let fixed = entries.get("additionalProperties") == Some(&json!(false))
                && !entries.contains_key("patternProperties");
            if let (Some(Value::Object(keys)), true) = (entries.get("properties"), fixed) {
                all.extend(keys.keys().cloned());
            }
            entries.values().for_each(|own| names(own, all));
        }
        Value::Array(items) => items.iter().for_each(|own| names(own, all)),
        _ => {}
    }
}

/// What is wrong with a value; the part of JSON schema that the schemas use.
fn wrong(schema: &Value, value: &Value, place: &str) -> Vec<String> {
    let known = [
        "$schema",
        "title",
        "description",
        "examples",
        "type",
        "enum",
        "minimum",
        "maximum",
        "exclusiveMinimum",
        "exclusiveMaximum",
        "items",
        "minItems",
        "maxItems",
        "anyOf",
        "properties",
        "patternProperties",
        "additionalProperties",
        "required",
    ];
    let rules = schema.as_object().expect("a schema");
    assert!(rules.keys().all(|rule| known.contains(&rule.as_str())), "{rules:?}");
    if let Some(shapes) = rules.get("anyOf") {
        let found: Vec<_> = shapes
            .as_array()
            .expect("shapes")
            .iter()
            .map(|shape| wrong(shape, value, place))
            .collect();
        // Of equals the last, which says most.
        let best = found.iter().rev().min_by_key(|errors| errors.len()).expect("a shape");
        return if found.iter().any(Vec::is_empty) { Vec::new() } else { best.clone() };
    }
    if let Some(words) = rules.get("enum") {
        let fine = words.as_array().expect("words").contains(value);
        return if fine { Vec::new() } else { vec![format!("{place} cannot be {value}")] };
    }
    let fine = match rules["type"].as_str().expect("a type") {
        "string" => value.is_string(),
        "number" => value.as_f64().is_some_and(|number| {
            let bound = |rule: &str| rules.get(rule).and_then(Value::as_f64);
            bound("exclusiveMinimum").is_none_or(|low| number > low)
                && bound("exclusiveMaximum").is_none_or(|high| number < high)
        }),
        "boolean" => value.is_boolean(),
        "integer" => value.as_u64().is_some_and(|n| {
            let bound = |rule: &str| rules[rule].as_u64().expect("a bound");
            (bound("minimum")..=bound("maximum")).contains(&n)
        }),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("{other}"),
    };
    if !fine {
        return vec![format!("{place} cannot be {value}")];
    }
    match value {
        Value::Array(items) => {
            let limit = |rule: &str| rules.get(rule).and_then(Value::as_u64);
            let count = items.len() as u64;
            let mut errors = Vec::new();
            if limit("minItems").is_some_and(|n| count < n)
                || limit("maxItems").is_some_and(|n| count > n)
            {
                errors.push(format!("{place} has {count} items"));
            }
            errors.extend(items.iter().flat_map(|item| wrong(&rules["items"], item, place)));
            errors
        }
        Value::Object(entries) => wrong_keys(rules, entries, place),
        _ => Vec::new(),
    }
}

fn wrong_keys(
    rules: &Map<String, Value>,
    entries: &Map<String, Value>,
    place: &str,
) -> Vec<String> {
    let mut errors = Vec::new();
    let needed = rules.get("required").and_then(Value::as_array).into_iter().flatten();
    for key in needed.filter_map(Value::as_str).filter(|key| !entries.contains_key(*key)) {
        errors.push(format!("{place} has no {key}"));
    }
    for (key, value) in entries {
        let named = rules.get("properties").and_then(|keys| keys.get(key));
        // The one pattern: other spellings than ASCII.
        let spelled =
            || rules.get("patternProperties").filter(|_| !key.is_ascii()).map(|p| &p["[^ -~]"]);
        let free = || rules.get("additionalProperties").filter(|shape| shape.is_object());
        match named.or_else(spelled).or_else(free) {
            Some(shape) => errors.extend(wrong(shape, value, &format!("{place}.{key}"))),
            None => errors.push(format!("{place} must not have {key}")),
        }
    }
    errors
}

fn toml_of(text: &str) -> Value {
    let table: toml::Table = text.parse().expect("TOML");
    serde_json::to_value(table).expect("a value")
}

/// Every file that is shipped, with its kind.
fn shipped() -> Vec<(String, Value)> {
    let mut files = Vec::new();
    for folder in ["laws", "elements", "forms", "motion", "cases"] {
        for entry in fs::read_dir(root().join("specs").join(folder)).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.extension().is_some_and(|extension| extension == "toml") {
                let value = toml_of(&fs::read_to_string(&path).expect("a text"));
                let kind = value.get("kind").and_then(Value::as_str).unwrap_or("case").to_string();
                files.push((kind, value));
            }
        }
    }
    assert!(files.len() > 20);
    files
}

#[test]
fn every_file_that_is_shipped_or_begun_fits_its_schema() {
    let bench = Workbench::new();
    let mut files = shipped();
    for kind in ["law", "element", "case"] {
        assert_eq!(bench.whirl(&["new", kind, kind]).status, 0);
        let text = fs::read_to_string(bench.path(&format!("{kind}.toml"))).expect("a file");
        files.push((kind.to_string(), toml_of(&text)));
    }
    let schemas = KINDS.map(|kind| (kind, schema(kind)));
    for (kind, value) in files {
        let (_, schema) = schemas.iter().find(|(name, _)| *name == kind).expect("a schema");
        assert_eq!(wrong(schema, &value, &kind), [""; 0], "{}", value["title"]);
    }
}

/// A value that fits a schema as far as keys and types go, with every key that it knows.
fn sample(schema: &Value) -> Value {
    // Of several shapes the last: it says most.
    if let Some(shapes) = schema.get("anyOf").and_then(Value::as_array) {
        return sample(shapes.last().expect("a shape"));
    }
    if let Some(words) = schema.get("enum") {
        return words[0].clone();
    }
    match schema["type"].as_str().expect("a type") {
        "string" => schema.get("examples").map_or(json!("x"), |examples| examples[0].clone()),
        "number" => json!(0.25),
        "boolean" => json!(true),
        "integer" => schema["minimum"].clone(),
        "array" => {
            let count = schema.get("minItems").and_then(Value::as_u64).unwrap_or(1);
            (0..count).map(|_| sample(&schema["items"])).collect()
        }
        _ => {
            // Of names that are known, such as those of inputs, one stands for all.
            let most = if schema.get("patternProperties").is_some() { 1 } else { usize::MAX };
            let keys = schema.get("properties").and_then(Value::as_object);
            let keys = keys.into_iter().flatten().take(most);
            let mut table: Map<_, _> =
                keys.map(|(key, shape)| (key.clone(), sample(shape))).collect();
            if let Some(shape) =
                schema.get("additionalProperties").filter(|shape| shape.is_object())
            {
                table.insert("chosen".to_string(), sample(shape));
            }
            Value::Object(table)
        }
    }
}

/// Takes out every key of one of the names; of those with a slash, the one there, or sets it to a word.
fn without(value: &mut Value, names: &[&str]) {
    for name in names.iter().filter(|name| name.starts_with('/')) {
        let (path, word) = name.split_once('=').map_or((*name, None), |(path, w)| (path, Some(w)));
        let (table, key) = path.rsplit_once('/').expect("a slash");
        let Some(table) = value.pointer_mut(table).and_then(Value::as_object_mut) else { continue };
        match word {
            Some(word) => table.insert(key.to_string(), json!(word)),
            None => table.remove(key),
        };
    }
    let names: Vec<&str> = names.iter().filter(|name| !name.starts_with('/')).copied().collect();
    without_all(value, &names);
}

fn without_all(value: &mut Value, names: &[&str]) {
    match value {
        Value::Object(table) => {
            names.iter().for_each(|name| drop(table.remove(*name)));
            table.values_mut().for_each(|value| without_all(value, names));
        }
        Value::Array(items) => items.iter_mut().for_each(|value| without_all(value, names)),
        _ => {}
    }
}

/// Names of the keys that the reader says it does not know.
fn unknown(bench: &Workbench, value: &Value) -> Vec<String> {
    let text = toml::to_string(value).expect("TOML");
    fs::write(bench.path("file.toml"), text).expect("written");
    let outcome = bench.whirl(&["check", "file.toml"]);
    assert!(!outcome.stderr.contains(" more errors"), "not all are shown: {}", outcome.stderr);
    let said = |line: &str| {
        let key = line.split_once("unknown key `").or_else(|| line.split_once(" has no key `"))?.1;
        Some(key.split('`').next()?.to_string())
    };
    outcome.stderr.lines().filter_map(said).collect()
}

/// What files of named bodies have not, and keys whose errors would take the place of others.
const SHORT: &str = "include /start/kind /march/duration /march/stop_when_steady /march/step_tolerance /march/spectral_radius \
    /figures/laws /fields/bodies /shaft /support /springs /bearing /drive /load /mass /stop";

/// Keys of lateral analyses, which others refuse.
const LATERAL: &str = "/analysis/chosen/edition /analysis/chosen/minimum_speed /analysis/chosen/maximum_speed \
    /analysis/chosen/trip_speed /analysis/chosen/probes /analysis/chosen/probe_angle \
    /analysis/chosen/clearances /analysis/chosen/scale_limit /analysis/chosen/unbalance_modes \
    /analysis/chosen/unbalance /analysis/chosen/journal_loads /analysis/chosen/stages \
    /analysis/chosen/cross_coupling_z /analysis/chosen/gas_density /analysis/chosen/seals \
    /analysis/chosen/variants";

/// Of a file with such an analysis, what other files show.
const FOR_LATERAL: [&str; 7] = [
    "/analysis/chosen/kind=lateral",
    "/march/step_tolerance",
    "/march/spectral_radius",
    "/march/stop_when_steady",
    "/march/duration",
    "/shaft/sets",
    "/support/sets",
];

/// Keys of periodic analyses, which others refuse.
const PERIODIC: &str = "/analysis/chosen/steps /analysis/chosen/method /analysis/chosen/marched /analysis/chosen/periods \
    /analysis/chosen/begin /analysis/chosen/cycles /analysis/chosen/vary /analysis/chosen/points";

/// Of files of named bodies: each of the ways in which one turns, with each kind of joint.
const NAMED: [&str; 8] = [
    "/body/chosen/turns=free /output/chosen/joint /fields/bodies matrices rigid moves_along_z static_correction dimensions /body/chosen/mass polar_inertia transverse_inertia /body/chosen/z \
     /body/chosen/stiffness /body/chosen/damping /body/chosen/speed /body/chosen/table acceleration held ground_spring \
     /joint/chosen/kind=bearing first second side gap /joint/chosen/stiffness /joint/chosen/damping \
     /joint/chosen/table tilting_stiffness tilting_damping axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=prescribed /output/chosen/joint /fields/bodies mesh matrices units merge dimensions rigid /body/chosen/material regions /body/chosen/sets modes \
     /body/chosen/stiffness /body/chosen/damping initial_speed held ground_spring axial_restraint section \
     stiffening /joint/chosen/kind=stop film first second /joint/chosen/springs radial_clearance stations \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=no /output/chosen/joint /fields/bodies mesh matrices units merge rigid moves_along_z diameter throw pin_diameter pin_length web_width web_thickness supports support_length layers_in_support \
     /body/chosen/dimensions/loads sectors /body/chosen/dimensions/cells/rings tolerance /body/chosen/mass \
     polar_inertia transverse_inertia /body/chosen/z /body/chosen/stiffness /body/chosen/damping \
     /body/chosen/speed /body/chosen/table acceleration initial_speed section stiffening /joint/chosen/kind=bushing film journal bore /joint/chosen/table \
     /joint/chosen/law parameters /joint/chosen/springs radial_clearance journal_radius \
     /joint/chosen/length stations run_out offset side gap /march/duration /loads/chosen/couple /loads/chosen/order \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=prescribed /output/chosen/joint /fields/bodies mesh merge dimensions rigid moves_along_z static_correction /body/chosen/material regions /body/chosen/mass polar_inertia transverse_inertia /body/chosen/z \
     dmig calculix nodes drives loads /body/chosen/damping /body/chosen/stiffness initial_speed ground_spring /body/chosen/table /joint/chosen/kind=stop film first second /joint/chosen/springs radial_clearance stations \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=prescribed /output/chosen/joint /fields/bodies mesh merge dimensions rigid moves_along_z static_correction /body/chosen/material regions /body/chosen/mass polar_inertia transverse_inertia /body/chosen/z \
     /body/chosen/matrices/dofs calculix drives loads /body/chosen/damping /body/chosen/stiffness initial_speed ground_spring /body/chosen/table /joint/chosen/kind=stop film first second /joint/chosen/springs radial_clearance stations \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=prescribed /output/chosen/joint /fields/bodies mesh merge dimensions rigid moves_along_z static_correction /body/chosen/material regions /body/chosen/mass polar_inertia transverse_inertia /body/chosen/z \
     /body/chosen/matrices/dofs /body/chosen/matrices/stiffness /body/chosen/matrices/mass dmig drives loads /body/chosen/damping /body/chosen/stiffness initial_speed ground_spring /body/chosen/table /joint/chosen/kind=stop film first second /joint/chosen/springs radial_clearance stations \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=no /output/chosen/joint /fields/bodies mesh matrices units merge dimensions rigid /body/chosen/material regions /body/chosen/sets modes static_correction held ground_spring \
     axial_restraint section stiffening polar_inertia /body/chosen/speed /body/chosen/table acceleration initial_speed \
     /joint/chosen/kind=coupling film journal bore /joint/chosen/law parameters /joint/chosen/springs \
     radial_clearance journal_radius /joint/chosen/length stations run_out offset side gap \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash",
    "/body/chosen/turns=no /output/chosen/joint /fields/bodies mesh matrices units merge dimensions rigid /body/chosen/material regions /body/chosen/sets modes static_correction held ground_spring \
     axial_restraint section stiffening polar_inertia /body/chosen/speed /body/chosen/table acceleration initial_speed \
     /joint/chosen/kind=gear film journal bore /joint/chosen/law parameters /joint/chosen/springs \
     radial_clearance journal_radius /joint/chosen/length stations run_out offset side gap \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping",
];

/// Of files of named bodies, too: one that is made from sections.
const SECTIONS: &str = "/body/chosen/turns=prescribed /output/chosen/joint /fields/bodies mesh matrices units merge dimensions rigid moves_along_z static_correction \
     outer_left outer_right inner_left inner_right mass_outer \
     /body/chosen/mass polar_inertia transverse_inertia /body/chosen/z /body/chosen/sets /body/chosen/regions material drives loads disc added \
     /body/chosen/stiffness /body/chosen/damping initial_speed held ground_spring /body/chosen/table \
     /joint/chosen/kind=stop film first second /joint/chosen/springs radial_clearance stations \
     /joint/chosen/stiffness /joint/chosen/damping /joint/chosen/table tilting_stiffness tilting_damping \
     axial_stiffness axial_damping \
     teeth pitch_radii internal pressure_angle mesh_stiffness mesh_damping backlash";

/// Keys that exclude each other, so that a file with both would leave tables of one unread.
fn variants(kind: &str) -> Vec<Vec<&'static str>> {
    let plain: &[&[&str]] = match kind {
        "law" => &[&["value"], &["pieces"]],
        "element" => &[&["points"], &["rule"]],
        "motion" => &[&["kinetic_energy"], &["mass", "quadratic_velocity", "PF", "B", "P"]],
        "case" => &[
            &[
                "include",
                "mass",
                "stop",
                "/fields/bodies",
                "/drive/table",
                "/load/0/table",
                "mesh",
                "units",
                "merge",
                "body",
                "/output/chosen/joint",
                "joint",
                "drives",
                "loads",
            ],
            &[
                "include",
                "mass",
                "stop",
                "/fields/bodies",
                "/drive/table",
                "/load/0/table",
                "dimensions",
                "body",
                "/output/chosen/joint",
                "joint",
                "drives",
                "loads",
            ],
            &[
                "include", "shaft", "support", "springs", "bearing", "drive", "load", "material",
                "body", "joint", "drives", "loads",
            ],
        ],
        _ => &[&[]],
    };
    let named = if kind == "case" { NAMED.as_slice() } else { &[] };
    let words = |text: &'static str| SHORT.split(' ').chain(text.split_whitespace());
    let named = named
        .iter()
        .map(|text| words(text).chain(["/body/chosen/sections", "/body/chosen/cells"]).collect());
    let mut all: Vec<Vec<&'static str>> =
        plain.iter().map(|keys| keys.to_vec()).chain(named).collect();
    if kind == "case" {
        all.push(words(SECTIONS).collect());
        let lateral = all.first().map(|keys| [&keys[..], &FOR_LATERAL].concat());
        all.iter_mut().for_each(|keys| keys.extend(LATERAL.split_whitespace()));
        let periodic = all.first().map(|keys| {
            [&keys[..], &["/analysis/chosen/kind=periodic"], &FOR_LATERAL[1..]].concat()
        });
        all.extend(lateral);
        all.iter_mut().for_each(|keys| keys.extend(PERIODIC.split_whitespace()));
        all.extend(periodic);
    }
    all
}

/// Files with every key of a schema, one for each of its variants.
fn samples(kind: &str, schema: &Value) -> Vec<Value> {
    let samples = variants(kind).into_iter().map(|dropped| {
        let mut value = sample(schema);
        if kind == "element" {
            // Shape functions are read when there are nodes.
            value["nodes"] = json!([[0, 0, 0]]);
        }
        if kind == "law" {
            // States and parameters have names of their own.
            for table in ["states", "rates"] {
                let table = value[table].as_object_mut().expect("a table");
                let own = table.remove("chosen").expect("a name");
                table.insert("kept".to_owned(), own);
            }
        }
        without(&mut value, &dropped);
        value
    });
    samples.collect()
}

#[test]
fn readers_know_every_key_of_the_schemas() {
    let bench = Workbench::new();
    for kind in KINDS {
        for value in samples(kind, &schema(kind)) {
            assert_eq!(unknown(&bench, &value), [""; 0], "{kind}: {value:#}");
        }
    }
}

/// Pointers to every table with fixed keys inside a value, by the schema.
fn closed(schema: &Value, value: &Value, place: String, found: &mut BTreeSet<String>) {
    if let Some(shapes) = schema.get("anyOf").and_then(Value::as_array) {
        for shape in shapes.iter().filter(|shape| wrong(shape, value, "").is_empty()) {
            closed(shape, value, place.clone(), found);
        }
        return;
    }
    match value {
        Value::Object(table) => {
            if schema["additionalProperties"] == json!(false) {
                found.insert(place.clone());
            }
            for (key, inner) in table {
                let shape =
                    schema["properties"].get(key).unwrap_or(&schema["additionalProperties"]);
                if shape.is_object() {
                    closed(shape, inner, format!("{place}/{key}"), found);
                }
            }
        }
        Value::Array(items) => {
            for (i, item) in items.iter().enumerate().take(1) {
                closed(&schema["items"], item, format!("{place}/{i}"), found);
            }
        }
        _ => {}
    }
}

/// A key that nothing knows is refused by both, in every table with fixed keys.
#[test]
fn schemas_and_readers_refuse_the_same_keys() {
    const STRAY: &str = "no_such_key";
    let bench = Workbench::new();
    for kind in KINDS {
        let schema = schema(kind);
        for sample in samples(kind, &schema) {
            let mut places = BTreeSet::new();
            closed(&schema, &sample, String::new(), &mut places);
            // A few tables at once, as a reader shows no more than twenty errors.
            let places: Vec<String> = places.into_iter().collect();
            for places in places.chunks(8) {
                let mut value = sample.clone();
                for place in places {
                    let table = value.pointer_mut(place).and_then(Value::as_object_mut);
                    table.expect("a table").insert(STRAY.to_string(), json!(1));
                }
                let strays = wrong(&schema, &value, kind);
                let strays = strays.iter().filter(|error| error.ends_with(STRAY)).count();
                assert!(strays >= places.len(), "{kind}: {strays} of {places:?}");
                let refused = unknown(&bench, &value);
                let refused: Vec<_> = refused.iter().filter(|key| key.ends_with(STRAY)).collect();
                // Names of inputs and outputs are refused as such.
                let named = |place: &&String| matches!(place.as_str(), "/inputs" | "/outputs");
                let names = places.iter().filter(named).count();
                let found = refused.len() + names;
                assert_eq!(found, places.len(), "{kind}: {refused:?} of {places:?}");
            }
        }
    }
}
