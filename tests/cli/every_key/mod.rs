//! Cases that use every key, with values that are neither symmetric, zero nor default, against machines put
//! together here by hand: meshes, sets and numbers, in SI, as a reader of the case would take them.
//!
//! The cases are the files beside this one. A key that none of them has fails
//! [`no_key_is_left_out`]: add it there, and to the numbers here.

mod built;
mod by_hand;
mod films;
mod heated;
mod mass;
mod rotor;
mod rows;

use std::collections::BTreeSet;
use std::fs;

use serde_json::Value;
use whirl_tests::History;

use crate::workbench::Workbench;

/// Everything that the cases name, by its name.
const FILES: [(&str, &str); 29] = [
    ("sensor.toml", include_str!("sensor.toml")),
    ("heated.toml", include_str!("heated.toml")),
    ("oil.csv", include_str!("oil.csv")),
    ("bore.csv", include_str!("bore.csv")),
    ("films.toml", include_str!("films.toml")),
    ("pads.toml", include_str!("pads.toml")),
    ("quake.csv", include_str!("quake.csv")),
    ("generated.toml", include_str!("generated.toml")),
    ("base.toml", include_str!("base.toml")),
    ("read.toml", include_str!("read.toml")),
    ("mass.toml", include_str!("mass.toml")),
    ("named.toml", include_str!("named.toml")),
    ("forced.toml", include_str!("forced.toml")),
    ("tied.toml", include_str!("tied.toml")),
    ("geared.toml", include_str!("geared.toml")),
    ("gas.csv", include_str!("gas.csv")),
    ("coefficients.csv", include_str!("coefficients.csv")),
    ("motor.csv", include_str!("motor.csv")),
    ("run-up.csv", include_str!("run-up.csv")),
    ("goes-on.toml", include_str!("goes-on.toml")),
    ("film.toml", include_str!("film.toml")),
    ("wall.toml", include_str!("wall.toml")),
    ("buffer.toml", include_str!("buffer.toml")),
    ("skid.toml", include_str!("skid.toml")),
    ("ring.toml", include_str!("ring.toml")),
    ("stored.toml", include_str!("stored.toml")),
    ("punched.toml", include_str!("punched.toml")),
    ("chosen.toml", include_str!("chosen.toml")),
    ("rows.toml", include_str!("rows.toml")),
];

/// Those of them that are cases.
const CASES: [&str; 17] = [
    "sensor.toml",
    "films.toml",
    "heated.toml",
    "pads.toml",
    "generated.toml",
    "base.toml",
    "read.toml",
    "mass.toml",
    "named.toml",
    "goes-on.toml",
    "forced.toml",
    "tied.toml",
    "geared.toml",
    "stored.toml",
    "punched.toml",
    "chosen.toml",
    "rows.toml",
];

#[test]
fn no_key_is_left_out() {
    let bench = Workbench::new();
    let schema = serde_json::from_str(&bench.whirl(&["schema", "case"]).stdout).expect("JSON");
    let (mut known, mut used) = (BTreeSet::new(), BTreeSet::new());
    keys(&schema, "", &mut known);
    for (name, text) in FILES.iter().filter(|(name, _)| CASES.contains(name)) {
        let case: toml::Table = toml::from_str(text).expect(name);
        let case = serde_json::to_value(case).expect("a table");
        uses(&schema, &case, "", &mut used);
    }
    let unused: Vec<&String> = known.difference(&used).collect();
    assert!(unused.is_empty(), "no case under tests/cli/every_key has {unused:?}");
    assert!(known.len() > 80, "the schema has keys");
}

/// A mesh in m, whose first card is `*NODE`, in mm.
fn in_millimetres(text: &str) -> String {
    let (nodes, rest) = text.split_at(text[1..].find('*').expect("another card") + 1);
    let line = |line: &str| {
        let values = line.split(',').enumerate();
        let scaled = values.map(|(place, value)| match value.trim().parse::<f64>() {
            Ok(value) if place > 0 => (value * 1e3).to_string(),
            _ => value.to_owned(),
        });
        scaled.collect::<Vec<_>>().join(", ") + "\n"
    };
    nodes.lines().map(line).collect::<String>() + rest
}

/// What named bodies do is held to other machines and to formulas in `bodies`; here all of their keys stand together.
#[test]
fn every_key_of_named_bodies_runs() {
    let cup = in_millimetres(&crate::bodies::meshes::cup([0, 0]));
    let found = Results::of("named", &[("cup.inp", cup)]);
    assert_eq!(found.history.rows(), 500);
    let speed = std::f64::consts::TAU / 60.0 * (120.0 + 600.0 * 0.01);
    assert!((found.history.last("omega_motor_rad_s") / speed - 1.0).abs() < 1e-9);
    let joints = found.summary["supports"].as_array().expect("a list");
    let names: Vec<&str> = joints.iter().filter_map(|joint| joint["joint"].as_str()).collect();
    assert_eq!(names[..3], ["left", "right", "cup-near"]);
    let fan = found.history.last("theta_fan_rad");
    let exact = std::f64::consts::TAU / 60.0 * (0.5 * 5e-3 * 300.0 + 5e-3 * (300.0 + 0.5 * 100.0));
    assert!((fan / exact - 1.0).abs() < 1e-9, "{fan} for {exact}");
    assert!(found.history.last("M_fan_Nm").abs() > 0.0);
    assert!(found.figure("rotation").contains("Speed of rotation of cup"));
    let outcome = found.bench.whirl(&["run", "goes-on.toml", "--no-figures", "--out", "more"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let more = found.bench.history("more");
    let time = more.column("t_s");
    assert_eq!(time.len(), 50);
    assert!((time[0] - 501.0 * 2e-5).abs() < 1e-12, "{}", time[0]);
    let speed = std::f64::consts::TAU / 60.0 * (120.0 + 600.0 * 0.011);
    assert!((more.last("omega_motor_rad_s") / speed - 1.0).abs() < 1e-9);
}

/// What sensors do is held to state spaces in `sensors`; here all of their keys stand together.
#[test]
fn every_key_of_sensors_runs() {
    let found = Results::of("sensor", &[]);
    assert_eq!(found.summary["verdict"]["sound"], true);
    assert_eq!(found.history.rows(), 400);
    let outcome = found.bench.whirl(&["check", "sensor.toml"]);
    let said = "its sensor sees rotor at PROBE, from holder at EYE_BORE";
    assert!(outcome.stdout.contains(said), "{}", outcome.stdout);
    let said = "its sensor sees rotor at z = 170 mm, from holder at z = 170 mm";
    assert!(outcome.stdout.contains(said), "{}", outcome.stdout);
}

/// What gears do is held to equations in `gears`; here all of their keys stand together. The pinion pushes the ring outwards: the
/// line from its centre to that of the ring is 36.87° from x.
#[test]
fn every_key_of_gears_runs() {
    let found = Results::of("geared", &[]);
    assert_eq!(found.summary["verdict"]["sound"], true);
    let speed = found.history.last("omega_ring_rad_s") / found.history.last("omega_rad_s");
    assert!((speed - 1.0 / 3.0).abs() < 1e-9, "{speed}");
    // Across the line of centres 30 N·m over 30 mm, along it tan 25° of that, towards the centre of the ring.
    let (across, along) = (1000.0, 1000.0 * 25_f64.to_radians().tan());
    let [cos, sin] = [0.8, 0.6];
    for (name, expected) in [
        ("RX_mesh_N", cos * along - sin * across),
        ("RY_mesh_N", sin * along + cos * across),
        ("MZ_mesh_Nm", -30.0),
    ] {
        let value = found.history.last(name);
        assert!((value / expected - 1.0).abs() < 1e-6, "{name}: {value} for {expected}");
    }
    let outcome = found.bench.whirl(&["analyse", "geared.toml", "--out", "torsion"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("2.5 × pinion"), "{}", outcome.stdout);
    assert!(outcome.stdout.contains("in operation 1400 to 1600 rpm"), "{}", outcome.stdout);
}

/// What loads and drives do is held to exact solutions elsewhere; here all of their keys stand together.
#[test]
fn every_key_of_loads_and_drives_runs() {
    let found = Results::of("forced", &[]);
    assert_eq!(found.history.rows(), 260);
    assert!(found.history.last("omega_rad_s") > 0.0);
    let cup = crate::bodies::meshes::cup([0, 0]);
    let found = Results::of("tied", &[("cup.inp", cup)]);
    // A couple of 10 N·m at rest that falls by 10 N·m over 1500 rpm.
    let speed = found.history.last("omega_rad_s");
    assert!(speed > 1.0, "{speed}");
}

/// What bodies of matrices do is held to their meshes in `bodies`; here all of their keys stand together.
#[test]
fn every_key_of_matrices_runs() {
    let dofs = "node, direction, x, y, z\n1, x, 0, 0, 0\n1, y\n2, x, 0, 0, 50\n2, y\n3, x, 0, 0, 100\n3, y\n";
    let head = |symmetry: &str, count: usize| {
        format!("%%MatrixMarket matrix coordinate real {symmetry}\n6 6 {count}\n")
    };
    // Three masses of 1 kg on a massless beam, in t and mm: what bends it is 100 N/mm · (1, −2, 1).
    let rows = (1..=6).map(|i| format!("{i} {i} 1e-3\n"));
    let mass = head("symmetric", 6) + &rows.collect::<String>();
    let bend = [1.0, -2.0, 1.0];
    let mut stiffness = head("symmetric", 12);
    for (i, j) in (0..3).flat_map(|i| (0..=i).map(move |j| (i, j))) {
        let value = 100.0 * bend[i] * bend[j];
        stiffness += &format!("{} {} {value}\n", 2 * i + 1, 2 * j + 1);
        stiffness += &format!("{} {} {value}\n", 2 * i + 2, 2 * j + 2);
    }
    let skew = head("skew-symmetric", 3) + "2 1 -1e-3\n4 3 -1e-3\n6 5 -1e-3\n";
    let load = "%%MatrixMarket matrix array real general\n6 1\n0\n0\n0\n0\n0\n0\n";
    let none = head("symmetric", 1) + "1 1 1e-30\n";
    let punch = "DMIG,KAAX,0,6,2,0\nDMIG,KAAX,1,1,,1,1,1.+6\nDMIG,KAAX,1,2,,1,2,1.+6\nDMIG,KAAX,1,3,,1,3,1.+6\n\
                 DMIG,MAAX,0,6,2,0\nDMIG,MAAX,1,1,,1,1,1.\nDMIG,MAAX,1,2,,1,2,1.\nDMIG,MAAX,1,3,,1,3,1.\n";
    let job = "1 1 1e9\n2 2 1e9\n3 3 1e9\n".to_owned();
    let files: [(&str, String); 13] = [
        ("job.dof", "1.1\n1.2\n1.3\n".to_owned()),
        ("job.sti", job.clone()),
        ("job.mas", job),
        ("job.inp", "*NODE, NSET=N\n1, 0, 0, 0\n".to_owned()),
        ("dofs.csv", dofs.to_owned()),
        ("K.mtx", stiffness),
        ("M.mtx", mass.clone()),
        ("Y.mtx", mass),
        ("H.mtx", skew),
        ("load.mtx", load.to_owned()),
        ("G.mtx", none),
        ("body.pch", punch.to_owned()),
        ("body.bdf", "GRID,1,,0.,0.,0.\n".to_owned()),
    ];
    let found = Results::of("stored", &files);
    // At last the force stands on the far spring of 10⁵ N/m and, through the masses, on the near one.
    let (near, far) = (found.history.last("RX_near_N"), found.history.last("RX_far_N"));
    assert!((near + far + 10.0).abs() < 0.05, "{near} {far}");
    let found = Results::of("punched", &files);
    // 10 N on a spring of 10⁶ N/m.
    assert!(
        (found.history.last("X_far_um") - 10.0).abs() < 0.5,
        "{}",
        found.history.last("X_far_um")
    );
}

/// The schemas one level down, each with what it adds to the path of a key.
fn below(schema: &Value) -> Vec<(String, &Value)> {
    let mut found = Vec::new();
    if let Some(properties) = schema["properties"].as_object() {
        found.extend(properties.iter().map(|(key, inner)| (format!(".{key}"), inner)));
    }
    if let Some(patterns) = schema["patternProperties"].as_object() {
        found.extend(patterns.values().map(|inner| (".NAME".to_owned(), inner)));
    }
    if schema["additionalProperties"].is_object() {
        found.push((".NAME".to_owned(), &schema["additionalProperties"]));
    }
    if schema["items"].is_object() {
        found.push((String::new(), &schema["items"]));
    }
    if let Some(shapes) = schema["anyOf"].as_array() {
        found.extend(shapes.iter().map(|inner| (String::new(), inner)));
    }
    found
}

/// Paths of all keys of a schema, such as `.bearing.stations`; lists add nothing to them.
fn keys(schema: &Value, path: &str, found: &mut BTreeSet<String>) {
    for (step, inner) in below(schema) {
        let path = format!("{path}{step}");
        if !step.is_empty() {
            found.insert(path.clone());
        }
        keys(inner, &path, found);
    }
}

/// Paths of all keys of a schema that a value has.
fn uses(schema: &Value, value: &Value, path: &str, found: &mut BTreeSet<String>) {
    for (step, inner) in below(schema) {
        let path = format!("{path}{step}");
        let values: Vec<&Value> = match (step.as_str(), value) {
            ("", Value::Array(items)) if schema["items"].is_object() => items.iter().collect(),
            ("", Value::Array(_)) => vec![value],
            ("", _) if schema["anyOf"].is_array() => vec![value],
            (".NAME", Value::Object(entries)) => entries.values().collect(),
            (step, Value::Object(entries)) if !step.is_empty() => {
                entries.get(&step[1..]).into_iter().collect()
            }
            _ => Vec::new(),
        };
        if !step.is_empty() && !values.is_empty() {
            found.insert(path.clone());
        }
        values.into_iter().for_each(|value| uses(inner, value, &path, found));
    }
}

/// What a run left behind.
struct Results {
    history: History,
    summary: Value,
    bench: Workbench,
}

impl Results {
    /// Runs a case with all files beside it, and with `more` of them.
    fn of(case: &str, more: &[(&str, String)]) -> Results {
        let mut bench = Workbench::new();
        for (name, text) in FILES {
            bench = bench.file(name, text);
        }
        for (name, text) in more {
            bench = bench.file(name, text);
        }
        let outcome = bench.whirl(&["run", &format!("{case}.toml"), "--out", "out"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let (history, summary) = (bench.history("out"), bench.summary("out"));
        Results { history, summary, bench }
    }

    /// The text of a figure.
    fn figure(&self, name: &str) -> String {
        let path = self.bench.path("out").join(format!("{name}.svg"));
        fs::read_to_string(path).expect("a figure")
    }

    /// Least, mean and largest values over the last `cycle` seconds of the history, against those of
    /// summary.json.
    fn sums_up(&self, cycle: f64) {
        assert!((self.summary["cycle_s"].as_f64().expect("s") / cycle - 1.0).abs() < 1e-12);
        let time = self.history.column("t_s");
        let end = time[time.len() - 1];
        // To a rounding error: steps are not thinner than 1e-3 of the cycles here.
        let rows = time.iter().filter(|&&t| t >= end - cycle * (1.0 + 1e-9)).count();
        assert!(10 < rows && rows < time.len() - 10, "a cycle is a part of the run");
        for (place, support) in
            self.summary["supports"].as_array().expect("a list").iter().enumerate()
        {
            for name in ["RX_N", "RY_N", "X_um", "Y_um", "EX_um", "EY_um"] {
                let (letters, unit) = name.split_once('_').expect("a unit");
                let values = self.history.column(&format!("{letters}{}_{unit}", place + 1));
                let values = &values[values.len() - rows..];
                let least = values.iter().copied().fold(f64::INFINITY, f64::min);
                let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                // Trapezoids between rows, and one from the last row to the first of the next cycle.
                let times = &time[time.len() - rows..];
                let covered = end - times[0];
                let pairs = times.windows(2).zip(values.windows(2));
                let areas = pairs.map(|(t, v)| 0.5 * (v[0] + v[1]) * (t[1] - t[0]));
                let closing = 0.5 * (values[0] + values[rows - 1]) * (cycle - covered);
                let mean = (areas.sum::<f64>() + closing) / cycle;
                // The history has ten digits.
                let rounding = 1e-8 * least.abs().max(most.abs());
                for (what, value) in [("min", least), ("mean", mean), ("max", most)] {
                    let said = support[name][what].as_f64().expect("a number");
                    let wrong = (said - value).abs();
                    assert!(wrong <= rounding, "{what} of {name} at {place}: {said}, not {value}");
                }
            }
        }
    }
}
