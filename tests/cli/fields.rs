//! Motions of whole bodies as VTU files.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::report::{numbers, page};
use crate::workbench::Workbench;

const MACHINE: &str = include_str!("bodies/surfaces.toml");

const JOINTS: &str = r#"
[joint.left]
kind = "bushing"
first = { body = "rotor", sets = "JOURNAL1_MIDDLE" }
second = { body = "block", sets = "BORE1_MIDDLE" }
stiffness = { xx = "1e7 N/m", yy = "2e7 N/m" }

[joint.right]
kind = "bushing"
first = { body = "rotor", sets = "JOURNAL2_MIDDLE" }
second = { body = "block", sets = "BORE2_MIDDLE" }
stiffness = { xx = "1e7 N/m", yy = "2e7 N/m" }

[output.middle]
body = "rotor"
set = "DRIVE_TOP"
quantity = "displacement"

[output.foot]
body = "block"
set = "MOUNTS"
quantity = "displacement"
"#;

fn case(fields: &str) -> String {
    // A cycle of a hundred steps, where the run has five.
    let machine = MACHINE.replace("[march]", "[march]\ncycle_frequency = \"500 Hz\"");
    format!("{machine}{JOINTS}{fields}")
}

/// A VTU file: an array of it by name.
struct Vtu(Vec<u8>);

impl Vtu {
    fn read(path: &Path) -> Vtu {
        Vtu(fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display())))
    }

    fn head(&self) -> String {
        let end = self.0.windows(2).position(|pair| pair == b"\n_").expect("appended data");
        String::from_utf8(self.0[..end].to_vec()).expect("text")
    }

    fn array(&self, name: &str) -> &[u8] {
        let head = self.head();
        let line = head.lines().find(|line| line.contains(&format!("Name=\"{name}\"")));
        let line = line.expect("the array");
        let (_, offset) = line.split_once("offset=\"").expect("a place");
        let offset: usize = offset.split('"').next().unwrap().parse().expect("a number");
        let begin = head.len() + 2 + offset;
        let length = u64::from_le_bytes(self.0[begin..begin + 8].try_into().unwrap()) as usize;
        &self.0[begin + 8..begin + 8 + length]
    }

    fn vectors(&self, name: &str) -> Vec<[f64; 3]> {
        self.numbers(name).as_chunks::<3>().0.to_vec()
    }

    fn numbers(&self, name: &str) -> Vec<f64> {
        let values = self.array(name).chunks_exact(8);
        values.map(|own| f64::from_le_bytes(own.try_into().unwrap())).collect()
    }
}

/// Times and files of a collection.
fn listed(path: &Path) -> Vec<(f64, String)> {
    let text = fs::read_to_string(path).expect("a collection");
    let value = |line: &str, key: &str| {
        let (_, rest) = line.split_once(&format!("{key}=\"")).expect("an attribute");
        rest.split('"').next().unwrap().to_owned()
    };
    let lines = text.lines().filter(|line| line.contains("<DataSet"));
    lines.map(|line| (value(line, "timestep").parse().unwrap(), value(line, "file"))).collect()
}

#[test]
fn frames_hold_what_outputs_hold() {
    let bench = Workbench::new()
        .file("case.toml", &case("[fields]\nframes = 10\ntimes = [\"3 ms\", \"5 ms\"]\n"));
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(!bench.path("out/frames.bin").exists());
    let history = bench.history("out");
    let column = |name: &str| history.column(name).to_vec();
    let [x, y, theta] = ["x_middle_um", "y_middle_um", "theta_rad"].map(column);
    let files = listed(&bench.path("out/fields/rotor.pvd"));
    assert_eq!(files.len(), 12, "ten of the last cycle, and two before: {files:?}");
    assert_eq!(files.len(), listed(&bench.path("out/fields/block.pvd")).len());
    // Positions as they were, from the last file of a run that stood still.
    for (time, file) in files {
        let row = (time / 2e-5).round() as usize - 1;
        let vtu = Vtu::read(&bench.path("out/fields").join(file));
        let (points, moved) = (vtu.vectors("points"), vtu.vectors("deformation_m"));
        assert_eq!(points.len(), moved.len());
        // DRIVE_TOP turns with the rotor: at the radius of the section, at z = 0 or at its end.
        let (sin, cos) = theta[row].sin_cos();
        let near = (0..points.len()).filter(|&node| {
            let [a, b, _] = points[node];
            let [a, b] = [cos * a + sin * b, cos * b - sin * a];
            (a - 0.020256865).abs() < 1e-7 && b.abs() < 1e-7
        });
        let found = near.filter(|&node| {
            let [u, v, _] = moved[node];
            (1e6 * u - x[row]).abs() < 1e-6 * x[row].abs() + 1e-6
                && (1e6 * v - y[row]).abs() < 1e-6 * y[row].abs() + 1e-6
        });
        assert_eq!(found.count(), 1, "at {time} s: {} {}", x[row], y[row]);
    }
    // Every cell has as many nodes as its type.
    let vtu = Vtu::read(&bench.path("out/fields/block_0000.vtu"));
    let long = |name: &str| -> Vec<i64> {
        let values = vtu.array(name).chunks_exact(8);
        values.map(|own| i64::from_le_bytes(own.try_into().unwrap())).collect()
    };
    let (offsets, types, nodes) = (long("offsets"), vtu.array("types"), long("connectivity"));
    let mut begin = 0;
    for (end, kind) in offsets.iter().zip(types) {
        let count = match kind {
            12 => 8,
            13 => 6,
            other => panic!("a cell of type {other}"),
        };
        assert_eq!(end - begin, count);
        begin = *end;
    }
    assert_eq!(begin as usize, nodes.len());
    let count = vtu.vectors("points").len() as i64;
    assert!(nodes.iter().all(|&node| (0..count).contains(&node)));
}

#[test]
fn fields_change_nothing_that_is_computed() {
    let plain = Workbench::new().file("case.toml", &case(""));
    let with = Workbench::new().file("case.toml", &case("[fields]\nbodies = [\"rotor\"]\n"));
    for bench in [&plain, &with] {
        let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    }
    let bytes = |bench: &Workbench| fs::read(bench.path("out/history.csv")).expect("a history");
    assert_eq!(bytes(&plain), bytes(&with));
    assert_eq!(
        listed(&with.path("out/fields/rotor.pvd")).len(),
        25,
        "every fourth step of a cycle"
    );
    assert!(!with.path("out/fields/block.pvd").exists());
    // The next run takes them away, and leaves what is not its own.
    fs::write(with.path("out/fields/notes.txt"), "mine").expect("a file");
    fs::write(with.path("case.toml"), case("")).expect("a file");
    let outcome = with.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(!with.path("out/fields/rotor.pvd").exists());
    assert!(with.path("out/fields/notes.txt").exists());
}

/// A shaft that turns under a hundred times its weight, in equilibrium: in space the bending stress stands still, while the
/// shaft turns through it.
#[test]
fn stresses_are_those_of_bending() {
    let bench = Workbench::new().file("case.toml", include_str!("fields-weight.toml"));
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    // The octagon with the area of the circle.
    let (sectors, radius) = (8.0_f64, 21.053798e-3_f64);
    let angle = 2.0 * PI / sectors;
    let inertia = sectors * radius.powi(4) / 24.0 * angle.sin() * (2.0 + angle.cos());
    let weight = 7860.0 * PI * 0.02_f64.powi(2) * 981.0;
    let moment = weight * (0.36_f64.powi(2) / 8.0 - 0.02_f64.powi(2) / 2.0);
    let largest = moment * radius / inertia;
    let mut angles = Vec::new();
    for (_, file) in listed(&bench.path("out/fields/rotor.pvd")) {
        let vtu = Vtu::read(&bench.path("out/fields").join(file));
        let stresses = vtu.numbers("stress_Pa");
        let middle = |[x, y, z]: [f64; 3]| {
            (z - 0.2).abs() < 1e-6 && (x.hypot(y) / radius - 1.0).abs() < 1e-6
        };
        let points = vtu.vectors("points").into_iter().zip(stresses.as_chunks::<6>().0);
        let middle: Vec<_> = points.filter(|(point, _)| middle(*point)).collect();
        assert_eq!(middle.len(), 8);
        for ([x, _, _], [xx, yy, zz, xy, yz, zx]) in &middle {
            // Tension at the lower side: weight acts along -x.
            let known = -moment * x / inertia;
            assert!((zz - known).abs() < 0.01 * largest, "{zz} {known}");
            let others = [xx, yy, xy, yz, zx].into_iter().all(|own| own.abs() < 0.03 * largest);
            assert!(others, "{xx} {yy} {xy} {yz} {zx}");
        }
        angles.push(middle[0].0[0].atan2(middle[0].0[1]));
    }
    angles.dedup_by(|a, b| (*a - *b).abs() < 0.1);
    assert_eq!(angles.len(), 8, "eight places of one node: {angles:?}");

    let summary = bench.summary("out");
    let found = &summary["stresses"]["rotor"];
    let size = found["von_mises_MPa"].as_f64().expect("a number");
    assert!((1e6 * size / largest - 1.0).abs() < 0.03, "{size} {largest}");
    assert_eq!(found["position_mm"][2].as_f64(), Some(200.0));
    assert!(outcome.stdout.contains("largest stress of rotor: "), "{}", outcome.stdout);
    let envelope = Vtu::read(&bench.path("out/fields/rotor_largest.vtu"));
    let sizes = envelope.numbers("von_mises_Pa");
    let most = sizes.iter().fold(0.0, |a: f64, b| a.max(*b));
    assert!((most / (1e6 * size) - 1.0).abs() < 1e-5);
    assert_eq!(sizes.len(), envelope.numbers("time_s").len());
}

/// Bodies about an axis of their own stand there in their files, at every instant and with their largest stresses.
#[test]
fn fields_stand_about_the_axis_of_the_body() {
    let text = include_str!("fields-weight.toml").replace("0.2 s", "0.1 s");
    let aside = text.replace(
        "turns = \"prescribed\"",
        "turns = \"prescribed\"\naxis = [\"30 mm\", \"-20 mm\"]",
    );
    let points = |text: &str| {
        let bench = Workbench::new().file("case.toml", text);
        let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        ["rotor_0003.vtu", "rotor_largest.vtu"]
            .map(|name| Vtu::read(&bench.path("out/fields").join(name)).vectors("points"))
    };
    for (here, there) in points(&text).iter().flatten().zip(points(&aside).iter().flatten()) {
        for ((here, there), by) in here.iter().zip(there).zip([0.03, -0.02, 0.0]) {
            // The rotor is turned by the same steps; its equilibrium does not depend on where it is.
            assert!((there - here - by).abs() < 1e-9, "{here} {there}");
        }
    }
}

/// A rotor in a film that carries its fill, and on a pad of one that does not.
const FILMS: &str = r#"
title = "films"
[body.r]
turns = "prescribed"
speed = "3000 rpm"
mass = "30 kg"
polar_inertia = "0.1 kg*m^2"
unbalance.u = { mass = "20 g", radius = "30 mm" }
[loads.w]
body = "r"
force = ["-600 N", "90 N", "0 N"]
[joint.oil]
kind = "bearing"
journal = { body = "r" }
law = "jfo"
radial_clearance = "60 um"
journal_radius = "25 mm"
length = "25 mm"
film = { grid = [24, 5], left = "1 bar", right = "1 bar" }
[joint.pad]
kind = "bearing"
journal = { body = "r" }
law = "reynolds"
radial_clearance = "70 um"
journal_radius = "25 mm"
length = "20 mm"
film = { arc = ["150 deg", "210 deg"], grid = [13, 5] }
[output.oil]
joint = "oil"
quantity = "film"
[output.pad]
joint = "pad"
quantity = "film"
[start]
kind = "equilibrium"
[march]
time_step = "0.25 ms"
steps = 80
cycle_frequency = "50 Hz"
"#;

/// A map of the page has, frame by frame, the numbers of a file in another unit, to a 65535th of what they span.
fn hold(levels: &Value, frame: usize, known: &[f64], factor: f64) {
    let [least, most] = ["least", "most"].map(|end| levels[end].as_f64().expect("a number"));
    let parts = numbers(&levels["parts"]);
    for (part, known) in parts[frame * known.len()..].iter().zip(known) {
        let own = least + part / 65535.0 * (most - least);
        assert!((own - factor * known).abs() <= 1e-5 * (most - least), "{own} {known}");
    }
}

/// Maps have the extremes that the columns of the history have, at their places, and the least and most over the frames.
#[test]
fn maps_of_films_hold_what_their_columns_hold() {
    let fields = "[fields]\nframes = 4\ntimes = [\"2 ms\"]\n";
    let bench = Workbench::new().file("case.toml", &format!("{FILMS}{fields}"));
    let outcome = bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let folder = bench.path("out/fields");
    let history = fs::read_to_string(bench.path("out/history.csv")).expect("a history");
    let heads: Vec<&str> = history.lines().next().expect("a head").split(',').collect();
    let cell = |row: usize, name: &str| -> f64 {
        let place = heads.iter().position(|own| *own == name).expect("a column");
        let line = history.lines().nth(row).expect("a row");
        line.split(',').nth(place).expect("a cell").parse().expect("a number")
    };
    let (_, data) = page(&bench, "out");
    for (name, nodes, cells, filled) in [("oil", 120, 96, true), ("pad", 65, 48, false)] {
        let all = data["films"]["films"].as_array().expect("films");
        let shown = all.iter().find(|own| own["name"] == name).expect("the film");
        let frames = listed(&folder.join(format!("film_{name}.pvd")));
        assert_eq!(frames.len(), 5, "{name}");
        let (mut most, mut least) = (vec![f64::NEG_INFINITY; nodes], vec![f64::INFINITY; nodes]);
        for (time, file) in &frames {
            let row = (time / 0.25e-3).round() as usize;
            let vtu = Vtu::read(&folder.join(file));
            assert!(
                vtu.head()
                    .contains(&format!("NumberOfPoints=\"{nodes}\" NumberOfCells=\"{cells}\""))
            );
            assert_eq!(vtu.head().contains("\"fill\""), filled, "{name}");
            let (pressure, gap) = (vtu.numbers("pressure_Pa"), vtu.numbers("gap_m"));
            let points = vtu.vectors("points");
            let largest = (0..nodes).max_by(|&a, &b| pressure[a].total_cmp(&pressure[b])).unwrap();
            let smallest = (0..nodes).min_by(|&a, &b| gap[a].total_cmp(&gap[b])).unwrap();
            let pairs = [
                (1e-6 * pressure[largest], format!("pmax_{name}_MPa")),
                (1e6 * gap[smallest], format!("hmin_{name}_um")),
            ];
            for (own, column) in pairs {
                let shown = cell(row, &column);
                assert!((own - shown).abs() < 1e-7 * shown, "{column} at {time}: {own}, {shown}");
            }
            let [x, y, z] = points[largest];
            let angle = y.atan2(x).to_degrees().rem_euclid(360.0);
            assert!((angle - cell(row, &format!("pmax_angle_{name}_deg"))).abs() < 1e-4, "{name}");
            assert!((1e3 * z - cell(row, &format!("pmax_z_{name}_mm"))).abs() < 1e-6, "{name}");
            assert!((x.hypot(y) - 25e-3).abs() < 2e-4, "{name}: {x} {y}");
            if filled {
                let fill = vtu.numbers("fill");
                assert!(fill.iter().all(|own| (0.0..=1.0).contains(own)));
                // Where the gap is part empty, the pressure is that of the cavity.
                let parted = fill.iter().zip(&pressure).filter(|own| *own.0 < 1.0);
                assert!(parted.clone().count() > 10 && parted.into_iter().all(|own| *own.1 == 0.0));
            }
            most.iter_mut().zip(&pressure).for_each(|(most, own)| *most = most.max(*own));
            least.iter_mut().zip(&gap).for_each(|(least, own)| *least = least.min(*own));
        }
        let largest = Vtu::read(&folder.join(format!("film_{name}_largest.vtu")));
        assert_eq!(largest.numbers("largest_pressure_Pa"), most, "{name}");
        assert_eq!(largest.numbers("smallest_gap_m"), least, "{name}");
        hold(&shown["largest_pressure_mpa"], 0, &most, 1e-6);
        hold(&shown["smallest_gap_um"], 0, &least, 1e6);
        for (place, (time, file)) in frames.iter().enumerate() {
            let vtu = Vtu::read(&folder.join(file));
            assert!((shown["time"][place].as_f64().expect("a time") - time).abs() < 1e-9);
            hold(&shown["pressure_mpa"], place, &vtu.numbers("pressure_Pa"), 1e-6);
            hold(&shown["gap_um"], place, &vtu.numbers("gap_m"), 1e6);
            if filled {
                hold(&shown["fill"], place, &vtu.numbers("fill"), 1.0);
            }
        }
        assert_eq!(shown["fill"].is_null(), !filled, "{name}");
    }
    let one = FILMS.replace("[start]", "[fields]\nframes = 2\nfilms = [\"pad\"]\n[start]");
    let bench = Workbench::new().file("case.toml", &one);
    assert_eq!(bench.whirl(&["run", "case.toml", "--no-figures", "--out", "out"]).status, 0);
    assert!(bench.path("out/fields/film_pad.pvd").exists());
    assert!(!bench.path("out/fields/film_oil.pvd").exists());
    let wrong = FILMS.replace("[start]", "[fields]\nfilms = [\"pat\"]\n[start]");
    let bench = Workbench::new().file("case.toml", &wrong);
    let outcome = bench.whirl(&["run", "case.toml"]);
    assert_eq!(outcome.status, 2);
    assert!(outcome.stderr.contains("there is no joint `pat` with a film"), "{}", outcome.stderr);
}
