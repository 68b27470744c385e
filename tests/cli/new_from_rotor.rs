//! `whirl new case --from FILE`: rotors that ROSS saved (`tests/data/ross/made.py`) as cases of solid bodies.

mod bad;

use std::fs;
use std::io::Read;
use std::path::Path;

use flate2::read::GzDecoder;

use crate::analyses::{numbers, ran};
use crate::workbench::{Outcome, Workbench};

/// Files of ROSS 2.3.0, all but the ending `.gz`.
const SAVED: [&str; 10] = [
    "example.toml",
    "example-6dof.json",
    "compressor.toml",
    "coaxial.toml",
    "damping.json",
    "tapered.toml",
    "film.toml",
    "supports.json",
    "train.toml",
    "soft.toml",
];

/// The text of such a file.
fn saved(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data/ross");
    let packed = fs::File::open(path.join(format!("{file}.gz"))).expect("a saved rotor");
    let mut text = String::new();
    GzDecoder::new(packed).read_to_string(&mut text).expect("a text");
    text
}

/// A folder with such a file, the case made from it, and what was said.
fn made(file: &str) -> (Workbench, Outcome) {
    let bench = Workbench::new().file(file, &saved(file));
    let outcome = bench.whirl(&["new", "case", "--from", file]);
    assert_eq!(outcome.status, 0, "{file}: {}", outcome.stderr);
    (bench, outcome)
}

fn text(bench: &Workbench, name: &str) -> String {
    fs::read_to_string(bench.path(name)).expect("a text")
}

/// A mode of ROSS.
struct Known {
    speed: f64,
    hertz: f64,
    ratio: f64,
}

/// The lateral modes of a rotor after ROSS, its elements cut into four, without those of a damping ratio above 0.9, which
/// `whirl modes` does not list.
fn known(rotor: &str) -> Vec<Known> {
    let text = include_str!("../data/ross/lateral.csv");
    let rows = text.lines().skip(1).map(|line| line.split(',').collect::<Vec<_>>());
    let own = rows.filter(|row| row[0] == rotor);
    let number = |cell: &str| cell.parse().expect("a number");
    let all = own.map(|row| Known {
        speed: number(row[1]),
        hertz: number(row[3]),
        ratio: number(row[4]),
    });
    all.filter(|own| own.ratio < 0.9).collect()
}

/// How far a solid may be from a beam: by which parts frequencies may be higher and lower, and the part by which damping ratios
/// above 1e-3 may differ.
struct Bounds<'r> {
    rotor: &'r str,
    stiffer: f64,
    softer: f64,
    ratio: f64,
}

/// Compares all modes of ROSS one by one with those of the case, which has others in between: torsion and motion along z.
/// How many were compared.
fn compare(bench: &Workbench, bounds: &Bounds) -> usize {
    let all = known(bounds.rotor);
    let mut speeds: Vec<f64> = all.iter().map(|own| own.speed).collect();
    speeds.dedup();
    for speed in &speeds {
        let at = format!("{speed:?} rad/s");
        let arguments = ["--speeds", &at, "--count", "24", "--out", "out", "--no-figures"];
        ran(bench, &[&["modes", "case.toml"][..], &arguments].concat());
        let hertz = numbers(bench, "out/modes.csv", "frequency_hz");
        let ratios = numbers(bench, "out/modes.csv", "damping_ratio");
        let mut next = 0;
        for own in all.iter().filter(|own| own.speed == *speed) {
            let fits = |hertz: &f64, ratio: &f64| {
                let apart = hertz / own.hertz - 1.0;
                let damped = own.ratio.abs() > 1e-3;
                (-bounds.softer..=bounds.stiffer).contains(&apart)
                    && !(damped && (ratio / own.ratio - 1.0).abs() > bounds.ratio)
            };
            let mut left = hertz[next..].iter().zip(&ratios[next..]);
            let place = left.position(|(hertz, ratio)| fits(hertz, ratio));
            let place = place.unwrap_or_else(|| {
                let all: Vec<_> = hertz.iter().zip(&ratios).collect();
                panic!(
                    "{} at {at}: no mode at {} Hz with {}: {all:#?}",
                    bounds.rotor, own.hertz, own.ratio
                )
            });
            next += place + 1;
        }
    }
    all.len()
}

/// Shafts of one diameter with discs by numbers are to one part in a thousand what they are as beams; in couplings, supports,
/// tables and between two shafts nothing is lost. Modes in which a heavy disc tilts are up to 0.5 % higher, of which a mesh
/// twice as fine takes a fifth.
#[test]
fn modes_of_even_shafts_are_those_of_ross() {
    for (file, stiffer, ratio, count) in [
        ("example.toml", 1e-3, 0.05, 16),
        ("coaxial.toml", 1e-3, 0.05, 16),
        // Its damping by mass has no counterpart.
        ("damping.json", 2.5e-3, f64::INFINITY, 8),
        ("film.toml", 6e-3, 0.02, 12),
        ("supports.json", 1e-3, 2e-3, 16),
        ("train.toml", 1.5e-3, 0.02, 16),
    ] {
        let (bench, _) = made(file);
        let rotor = file.split('.').next().expect("a name");
        let bounds = Bounds { rotor, stiffer, softer: 1e-4, ratio };
        assert_eq!(compare(&bench, &bounds), count, "{file}");
    }
}

/// Elements without stiffness, one of them conical and one as long as it is wide, keep their mass, their centre and their inertia.
#[test]
fn soft_elements_have_the_mass_and_the_inertia_of_ross() {
    let (bench, _) = made("soft.toml");
    let said = ran(&bench, &["check", "case.toml"]).stdout;
    let line = said.lines().find(|line| line.starts_with("rotor ")).expect("its mass");
    let found: Vec<f64> = line.split_whitespace().filter_map(|cell| cell.parse().ok()).collect();
    // `rotor.m`, `rotor.CG` and `rotor.Ip` of ROSS 2.3.0.
    for (found, known) in
        found.iter().zip([89.44223882948849, 1036.3008102831874, 0.4362696704033844])
    {
        assert!((found / known - 1.0).abs() < 1e-4, "{line}");
    }
    let bounds = Bounds { rotor: "soft", stiffer: 3e-3, softer: 3e-3, ratio: 0.05 };
    assert_eq!(compare(&bench, &bounds), 16);
}

/// Cones, layers and steps: beams are too stiff there. Of the compressor there are rows of mass without stiffness, a hub around
/// nothing, and coefficients between the rows of its tables, where splines and monotone cubics differ.
#[test]
fn stepped_rotors_are_softer_than_in_ross() {
    for (file, stiffer, softer, ratio, count) in
        [("tapered.toml", 1e-3, 0.01, 0.02, 16), ("compressor.toml", 8e-3, 0.03, 0.05, 8)]
    {
        let (bench, _) = made(file);
        let rotor = file.split('.').next().expect("a name");
        let bounds = Bounds { rotor, stiffer, softer, ratio };
        assert_eq!(compare(&bench, &bounds), count, "{file}");
    }
}

/// A thin shaft whose beams neither shear nor have rotary inertia.
#[test]
fn beams_without_shear_are_stiffer_and_said_to_be() {
    let (bench, outcome) = made("example-6dof.json");
    for off in ["shear_effects", "rotary_inertia"] {
        let note = format!(
            "Shaft Element 0, Shaft Element 1, Shaft Element 2 and 3 more: differs: {off} is off in ROSS"
        );
        assert!(outcome.stdout.contains(&note), "{}", outcome.stdout);
        assert!(text(&bench, "case.toml").contains(&format!("# - {note}")));
    }
    let bounds = Bounds { rotor: "example-6dof", stiffer: 0.0, softer: 0.01, ratio: 0.05 };
    assert_eq!(compare(&bench, &bounds), 16);
    // Both bearings act along z.
    assert_eq!(text(&bench, "case.toml").matches("axial_stiffness = \"100000 N/m\"").count(), 2);
}

#[test]
fn what_has_no_counterpart_is_named_in_the_case_and_on_the_terminal() {
    for (file, notes) in [
        (
            "damping.json",
            &[
                "the damping alpha by mass is left out",
                "differs: the damping beta = 1e-5 s of the shaft acts in the frame that turns",
            ][..],
        ),
        ("film.toml", &["between the rows monotone cubics, where ROSS has splines"]),
        ("coaxial.toml", &["all shafts turn at one speed"]),
        ("train.toml", &["couplings have no length"]),
        (
            "compressor.toml",
            &[
                "ShaftElement 9, ShaftElement 11, ShaftElement 13 and 33 more: has mass and no stiffness to speak of",
                "a bore of 140.995 mm and a shaft of 80 mm do not touch",
            ],
        ),
        ("example.toml", &[]),
    ] {
        let (bench, outcome) = made(file);
        let case = text(&bench, "case.toml");
        let lines: Vec<&str> = case.lines().filter(|line| line.starts_with("# - ")).collect();
        assert!(
            case.starts_with("# Made by `whirl new case` from a rotor of ROSS 2.3.0."),
            "{case}"
        );
        assert!(lines.len() >= notes.len() && (notes.is_empty() == lines.is_empty()), "{lines:?}");
        for line in &lines {
            assert!(outcome.stdout.contains(&line[4..]), "{line} in {}", outcome.stdout);
        }
        for note in notes {
            assert!(lines.iter().any(|line| line.contains(note)), "{note} in {lines:?}");
        }
    }
}

#[test]
fn elements_without_a_counterpart_are_named() {
    for (from, to, note, written) in [
        (
            "[\"DiskElement_Disk 0\"]",
            "[\"GearElement_Disk 0\"]",
            "Disk 0: is a disc here: the file does not say",
            "[body.rotor.disc.disk_0]",
        ),
        (
            "axial_force = 0\n",
            "axial_force = 100.0\n",
            "Shaft Element 5: the axial force is left out",
            "sections",
        ),
        (
            "torque = 0\n",
            "torque = 5\n",
            "Shaft Element 5: the torque along the shaft is left out",
            "sections",
        ),
        (
            "[\"DiskElement_Disk 0\"]",
            "[\"ThermalElement_Hot\"]\nq = 1\n[\"DiskElement_Disk 0\"]",
            "Hot: has no counterpart: an element of the class ThermalElement",
            "disk_0",
        ),
        (
            "[\"DiskElement_Disk 0\"]",
            "[\"DiskElement_Disk 0\"]\nwobble = 1",
            "Disk 0: left out: wobble",
            "disk_0",
        ),
        (
            "mxx = [ 0,]\nmxy = [ 0,]\nmyx = [ 0,]\nmyy = [ 0,]",
            "mxx = [ 5,]\nmxy = [ 0,]\nmyx = [ 0,]\nmyy = [ 5,]",
            "its inertia mxx = myy is a mass on the shaft",
            "[body.rotor.added.bearing_1_fluid]   # Bearing 1 fluid\nz = \"1500 mm\"\nmass = \"5 kg\"",
        ),
        (
            "mxy = [ 0,]",
            "mxy = [ 5,]",
            "left out: its coefficients of inertia (mxx, mxy, myx, myy, mzz)",
            "bearing_1",
        ),
        ("czz = [ 0,]", "czz = [ 5,]", "left out: its damping along z (czz)", "bearing_1"),
        (
            "Id = 0.17808928257067666",
            "Id = 0.1",
            "no body has a polar inertia of more than twice the transverse one",
            "transverse_inertia = \"0.164781810446 kg*m^2\"",
        ),
        (
            "Ip = 0.32956362089137037",
            "Ip = 0.0",
            "it has no polar inertia in ROSS",
            "polar_inertia = \"1.78089282571e-7 kg*m^2\"",
        ),
        ("m = 32.58972765304033", "m = 0.0", "it has no mass in ROSS", "mass = \"1e-6 kg\""),
        (
            "ross_version = \"2.3.0\"",
            "ross_version = \"1.6.0\"",
            "written by ROSS 1.6.0, and read as if by 2.3",
            "bearing_0",
        ),
    ] {
        let text = saved("example.toml");
        // The last one of those that are alike.
        let place = text.rfind(from).unwrap_or_else(|| panic!("{from}"));
        let text = format!("{}{to}{}", &text[..place], &text[place + from.len()..]);
        let bench = Workbench::new().file("rotor.toml", &text);
        let outcome = bench.whirl(&["new", "case", "--from", "rotor.toml"]);
        assert_eq!(outcome.status, 0, "{to}: {}", outcome.stderr);
        let case = fs::read_to_string(bench.path("case.toml")).expect("a case");
        assert!(outcome.stdout.contains(note), "{note} in {}", outcome.stdout);
        assert!(case.contains(note) && case.contains(written), "{note}, {written} in {case}");
    }
}

#[test]
fn cases_are_checked_and_name_their_files() {
    for file in SAVED {
        let (bench, outcome) = made(file);
        let checked = bench.whirl(&["check", "case.toml"]);
        assert_eq!(checked.status, 0, "{file}: {}", checked.stderr);
        let tables: Vec<String> =
            bench.listing().into_iter().filter(|own| own.ends_with(".csv")).collect();
        tables.iter().for_each(|own| assert!(outcome.stdout.contains(own.as_str()), "{own}"));
        match file {
            "film.toml" => assert_eq!(tables, ["case.bearing_0.csv", "case.bearing_1.csv"]),
            "compressor.toml" => assert!(!tables.is_empty()),
            _ => assert!(tables.is_empty(), "{file}: {tables:?}"),
        }
        let again = bench.whirl(&["new", "case", "--from", file]);
        assert_eq!(again.status, 2);
        assert!(again.stderr.contains("already exists and is left unchanged"), "{}", again.stderr);
    }
}

/// Neither a case without its tables nor tables without their case are left.
#[test]
fn nothing_is_written_where_a_file_of_a_table_is_there() {
    let bench =
        Workbench::new().file("film.toml", &saved("film.toml")).file("b.bearing_1.csv", "mine");
    let outcome = bench.whirl(&["new", "case", "b", "--from", "film.toml"]);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("`b.bearing_1.csv` already exists"), "{}", outcome.stderr);
    assert_eq!(bench.listing(), ["b.bearing_1.csv", "film.toml"]);
    assert_eq!(text(&bench, "b.bearing_1.csv"), "mine");
}

/// In a folder of its own, under a name: marched, in response to an unbalance, and with the speed of the file.
#[test]
fn a_rotor_on_supports_is_analysed_and_marched() {
    let bench = Workbench::new().file("supports.json", &saved("supports.json"));
    let from = ["--from", "supports.json", "--dir", "cases"];
    let outcome = bench.whirl(&[&["new", "case", "pump"], from.as_slice()].concat());
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let case = text(&bench, "cases/pump.toml");
    for wanted in [
        "speed = \"4774.64829276 rpm\"\n",
        "[body.point_mass_0]   # Point Mass 0\nturns = \"no\"\nmass = \"12 kg\"\nmoves_along_z = true",
        "first = { body = \"rotor\", z = \"960 mm\" }\nsecond = { body = \"point_mass_1\", z = \"960 mm\" }",
        "{ z = \"0 mm\", length = \"1200 mm\", outer = \"50 mm\" },   # Shaft Element 0 to Shaft Element 9",
        "speeds = \"0 rpm .. 9549.29658551 rpm, 31\"",
    ] {
        assert!(case.contains(wanted), "{wanted}\nin\n{case}");
    }
    let rest = "[body.rotor.unbalance.one]\nz = \"480 mm\"\nmass = \"1 g\"\nradius = \"100 mm\"\n\
                [march]\ntime_step = \"0.1 ms\"\nduration = \"20 ms\"\n";
    fs::write(bench.path("cases/run.toml"), format!("{case}{rest}")).expect("written");
    ran(&bench, &["analyse", "cases/pump.toml", "--out", "analysed", "--no-figures"]);
    assert!(bench.path("analysed/campbell.critical.csv").exists());
    ran(&bench, &["response", "cases/run.toml", "--out", "response", "--no-figures"]);
    let run = ran(&bench, &["run", "cases/run.toml", "--no-figures", "--out", "run"]);
    assert!(run.stdout.contains("verdict: sound"), "{}", run.stdout);
}
