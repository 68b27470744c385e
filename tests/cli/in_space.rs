//! Modes and orbits of the whole machine in space, as the page has them, compared with the tables of the same analyses.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::fs;

use serde_json::Value;

use crate::report::{numbers, page, ran};
use crate::workbench::Workbench;

/// By shapes, by points: a and b of a cos φ + b sin φ.
type Moved = Vec<Vec<[[f64; 3]; 2]>>;

/// The motions of an analysis.
fn motions<'a>(data: &'a Value, analysis: &str) -> &'a Value {
    let name = format!("{analysis}.motions.json");
    let all = data["motions"].as_array().expect("motions");
    &all.iter().find(|own| own["name"] == name).expect("of the analysis")["content"]
}

fn moved(content: &Value, motion: &Value) -> Moved {
    let largest = motion["largest"].as_f64().expect("a number");
    let shapes = content["shapes"]["bodies"].as_array().expect("shapes");
    let packed = motion["points"].as_array().expect("points");
    assert_eq!(shapes.len(), packed.len());
    let of = |(shape, packed): (&Value, &Value)| {
        let all: Vec<f64> =
            numbers(packed).iter().map(|own| (own - 32768.0) / 32767.0 * largest).collect();
        let count = numbers(&shape["points"]).len();
        assert_eq!(all.len(), 2 * count);
        let point =
            |k: usize| [0, 1].map(|half| [0, 1, 2].map(|axis| all[half * count + 3 * k + axis]));
        (0..count / 3).map(point).collect()
    };
    shapes.iter().zip(packed).map(of).collect()
}

fn shape(content: &Value, name: &str) -> usize {
    let all = content["shapes"]["bodies"].as_array().expect("shapes");
    all.iter().position(|own| own["name"] == name).expect("a shape")
}

/// The mean over points.
fn mean(all: &[[[f64; 3]; 2]]) -> [[f64; 3]; 2] {
    let sum = |half: usize, axis: usize| all.iter().map(|own| own[half][axis]).sum::<f64>();
    [0, 1].map(|half| [0, 1, 2].map(|axis| sum(half, axis) / all.len() as f64))
}

/// Of the points of a shape those at a z (m).
fn around(content: &Value, shape: usize, all: &[[[f64; 3]; 2]], z: f64) -> Vec<[[f64; 3]; 2]> {
    let places = numbers(&content["shapes"]["bodies"][shape]["points"]);
    let there = all.iter().zip(places.chunks_exact(3));
    there.filter(|own| (own.1[2] - z).abs() < 1e-6).map(|own| *own.0).collect()
}

/// Rows of a table by the names of its columns.
fn table(bench: &Workbench, name: &str) -> Vec<BTreeMap<String, String>> {
    let text = fs::read_to_string(bench.path(name)).expect("a table");
    let mut lines = text.lines().map(|own| own.split(',').map(str::to_owned));
    let head: Vec<String> = lines.next().expect("a head").collect();
    lines.map(|row| head.iter().cloned().zip(row).collect()).collect()
}

/// A machine that puts out the mean motion of all nodes of its faces, which are all on the outside.
const ENDS: &str = "include = \"unbalance.toml\"\ntitle = \"ends\"\n\
                    [body.rotor.sets]\nFIRST = { plane = \"0 mm\" }\nLAST = { plane = \"1 m\" }\n\
                    [output.first]\nquantity = \"displacement\"\nbody = \"rotor\"\nset = \"FIRST\"\ncomponents = [\"x\", \"y\"]\n\
                    [output.last]\nquantity = \"displacement\"\nbody = \"rotor\"\nset = \"LAST\"\ncomponents = [\"x\", \"y\"]\n";

#[test]
fn orbits_in_space_are_those_of_the_table() {
    compare_orbits(ENDS);
    // With coordinates that are there because something is put out.
    let answers = "[body.rotor.sets]";
    let own =
        ENDS.replace(answers, "[body.rotor]\nstatic_correction = \"outputs\"\n[body.rotor.sets]");
    assert_ne!(own, ENDS);
    compare_orbits(&own);
}

fn compare_orbits(case: &str) {
    let bench = Workbench::new().file("case.toml", case);
    let asked = ["--speeds", "2000 rpm .. 3000 rpm, 3", "--no-figures", "--out", "out"];
    ran(&bench, &[&["response", "case.toml"], &asked[..]].concat());
    let (_, data) = page(&bench, "out");
    let content = motions(&data, "response");
    let rows = table(&bench, "out/response.csv");
    let mut compared = 0;
    for motion in content["motions"].as_array().expect("motions") {
        let rpm = motion["rpm"].as_f64().expect("a speed");
        let all = moved(content, motion);
        let largest = motion["largest"].as_f64().expect("a number");
        let furthest = motion["metres"].as_f64().expect("a size");
        assert!(furthest >= largest && furthest < 2.0 * largest, "{furthest} {largest}");
        for (name, z) in [("first", 0.0), ("last", 1.0)] {
            let point = format!("output.{name}");
            let near = |own: &&BTreeMap<String, String>| {
                let own_rpm: f64 = own["speed_rpm"].parse().expect("a number");
                own["point"] == point && (own_rpm - rpm).abs() < 1e-6 * rpm
            };
            // Peaks are no rows of the table.
            let Some(row) = rows.iter().find(near) else { continue };
            let number = |name: &str| row[name].parse::<f64>().expect("a number");
            let rotor = shape(content, "rotor");
            let own = mean(&around(content, rotor, &all[rotor], z));
            for (axis, name) in ["x", "y"].iter().enumerate() {
                let size = 1e-6 * number(&format!("{name}_um"));
                let (sin, cos) = number(&format!("{name}_phase_deg")).to_radians().sin_cos();
                for (found, known) in [(own[0][axis], size * cos), (own[1][axis], -size * sin)] {
                    // Half of a part in 32767 of the largest.
                    let bound = 0.5 * largest / 32767.0 + 1e-9 * size;
                    assert!((found - known).abs() <= bound, "{rpm} {found} {known}");
                    compared += 1;
                }
            }
        }
        assert!(motion["words"].as_str().expect("words").starts_with("Forward whirl"), "{motion}");
    }
    assert_eq!(compared, 3 * 2 * 2 * 2);
    // A disc moves as the section that carries it.
    let motion = &content["motions"][0];
    let all = moved(content, motion);
    let [disc, rotor] = ["left", "rotor"].map(|name| shape(content, name));
    let own = mean(&around(content, rotor, &all[rotor], 0.35));
    let disc = mean(&all[disc]);
    for half in 0..2 {
        let apart = (disc[half][0] - own[half][0]).hypot(disc[half][1] - own[half][1]);
        assert!(apart < 1e-3 * motion["largest"].as_f64().expect("a number"), "{apart}");
    }
    let peaks = table(&bench, "out/response.peaks.csv");
    let of_peaks: Vec<&Value> = content["motions"]
        .as_array()
        .expect("motions")
        .iter()
        .filter(|own| own["name"].as_str().is_some_and(|own| own.starts_with("peak")))
        .collect();
    assert!(!of_peaks.is_empty());
    for own in of_peaks {
        let rpm = own["rpm"].as_f64().expect("a speed");
        assert!(peaks.iter().any(|row| {
            row["speed_rpm"].parse::<f64>().is_ok_and(|peak| (peak - rpm).abs() < 1e-9 * rpm)
        }));
    }
}

/// Modes go round as the table says, and the point that gets furthest is there at φ = 0.
#[test]
fn modes_in_space_whirl_as_the_table_says() {
    let bench = Workbench::new();
    let asked = ["--speeds", "3000 rpm", "--count", "6", "--no-figures", "--out", "out"];
    ran(&bench, &[&["modes", "overhung-disc"], &asked[..]].concat());
    let (_, data) = page(&bench, "out");
    let content = motions(&data, "modes");
    let rows = table(&bench, "out/modes.csv");
    let all = content["motions"].as_array().expect("motions");
    assert_eq!(all.len(), rows.len());
    let mut senses = Vec::new();
    for (motion, row) in all.iter().zip(&rows) {
        assert!(motion["metres"].is_null());
        let hertz: f64 = row["frequency_hz"].parse().expect("a number");
        assert_eq!(motion["hertz"].as_f64(), Some(hertz));
        let points: Vec<[[f64; 3]; 2]> = moved(content, motion).concat();
        let length = |own: &[f64; 3]| own.iter().map(|x| x * x).sum::<f64>().sqrt();
        let at_first = points.iter().map(|own| length(&own[0])).fold(0.0, f64::max);
        assert!((at_first - 1.0).abs() < 1e-4, "{at_first}");
        for turn in (0..12).map(|k| TAU * f64::from(k) / 12.0) {
            let (sin, cos) = turn.sin_cos();
            let there = |[a, b]: &[[f64; 3]; 2]| {
                length(&[0, 1, 2].map(|axis| cos * a[axis] + sin * b[axis]))
            };
            assert!(points.iter().map(there).fold(0.0, f64::max) < 1.0 + 1e-4);
        }
        let round: f64 = points.iter().map(|[a, b]| a[0] * b[1] - a[1] * b[0]).sum();
        let whole: f64 = points.iter().flatten().map(|own| own[0] * own[0] + own[1] * own[1]).sum();
        let words = motion["words"].as_str().expect("words");
        match row["whirl"].as_str() {
            "forward" => assert!(round > 0.1 * whole && words.starts_with("Forward"), "{words}"),
            "backward" => assert!(round < -0.1 * whole && words.starts_with("Backward"), "{words}"),
            _ => {}
        }
        senses.push(row["whirl"].clone());
    }
    assert!(["forward", "backward"].iter().all(|own| senses.iter().any(|other| other == own)));
}

/// What turns freely about its axis moves along circles about it.
#[test]
fn bodies_that_swing_about_their_axis_are_seen_to_twist() {
    let bench = Workbench::new();
    ran(&bench, &["modes", "geared", "--count", "12", "--no-figures", "--out", "out"]);
    let (_, data) = page(&bench, "out");
    let content = motions(&data, "modes");
    let motor = shape(content, "motor");
    let places = numbers(&content["shapes"]["bodies"][motor]["points"]);
    let twists = content["motions"].as_array().expect("motions").iter().filter(|motion| {
        let all = &moved(content, motion)[motor];
        let parts = all.iter().enumerate().map(|(k, own)| {
            let [x, y] = [places[3 * k], places[3 * k + 1]];
            let radius = x.hypot(y).max(1e-9);
            let around = (x * own[0][1] - y * own[0][0]) / radius;
            let outward = (x * own[0][0] + y * own[0][1]) / radius;
            [around, outward].map(|own| own * own)
        });
        let [around, outward] = parts.fold([0.0; 2], |sum, own| [0, 1].map(|k| sum[k] + own[k]));
        around > 1e-3 && outward < 1e-4 * around
    });
    assert!(twists.count() > 0);
}
