//! `whirl modes`, `campbell` and `analyse`: against other programs and closed forms, from case files.

use std::f64::consts::TAU;
use std::fs::{File, read_to_string};
use std::io::Read;
use std::path::Path;

use flate2::read::GzDecoder;

use crate::workbench::{Outcome, Workbench};

/// Machines of the reference; beams there, solids with discs by numbers here.
const CASES: [(&str, &str); 5] = [
    ("ross example", include_str!("analyses/ross-example.toml")),
    ("lalanne-ferraris", include_str!("analyses/lalanne-ferraris.toml")),
    ("ross damped bearings", include_str!("analyses/damped-bearings.toml")),
    ("jeffcott in films, steel shaft", include_str!("analyses/jeffcott.toml")),
    ("reference machine", "include = \"hu2003-2.toml\"\ntitle = \"at constant speed\"\n"),
];

/// A row of the reference.
struct Known {
    case: String,
    quantity: String,
    value: f64,
    tolerance: f64,
}

/// ROSS 2.3.0, own beams and closed forms; see the column `source` of the file.
fn reference() -> Vec<Known> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/data/linear.csv.gz");
    let file = File::open(path).expect("the reference");
    let mut text = String::new();
    GzDecoder::new(file).read_to_string(&mut text).expect("a text");
    text.lines().skip(1).filter_map(known).collect()
}

fn known(line: &str) -> Option<Known> {
    let mut cells: Vec<String> = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            c => cells.last_mut()?.push(c),
        }
    }
    let [case, quantity, value, _, tolerance, ..] = cells.as_slice() else { return None };
    Some(Known {
        case: case.clone(),
        quantity: quantity.clone(),
        value: value.parse().ok()?,
        tolerance: tolerance.parse().ok()?,
    })
}

/// A file of results: its rows by the names of their columns.
fn column(workbench: &Workbench, path: &str, name: &str) -> Vec<String> {
    let text = read_to_string(workbench.path(path)).expect("a file of results");
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let place = names.iter().position(|own| *own == name).expect("a column");
    lines.map(|line| line.split(',').nth(place).expect("a cell").to_owned()).collect()
}

fn numbers(workbench: &Workbench, path: &str, name: &str) -> Vec<f64> {
    let cells = column(workbench, path, name);
    cells.iter().map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()
}

fn ran(workbench: &Workbench, arguments: &[&str]) -> Outcome {
    let outcome = workbench.whirl(arguments);
    assert_eq!(outcome.status, 0, "{arguments:?}: {}", outcome.stderr);
    outcome
}

/// The modes of a case at a speed: frequencies (Hz) and damping ratios.
fn modes(case: &str, speed: &str) -> Vec<[f64; 2]> {
    let workbench = Workbench::new().file("case.toml", case);
    ran(&workbench, &["modes", "case.toml", "--speeds", speed, "--count", "16", "--out", "out"]);
    let frequencies = numbers(&workbench, "out/modes.csv", "frequency_hz");
    let ratios = numbers(&workbench, "out/modes.csv", "damping_ratio");
    frequencies.into_iter().zip(ratios).map(|(hertz, ratio)| [hertz, ratio]).collect()
}

#[test]
fn modes_are_those_of_other_programs() {
    let all = reference();
    let mut compared = 0;
    for (name, case) in CASES {
        let own = all.iter().filter(|known| known.case == name);
        let at: Vec<(&Known, &str, &str)> = own
            .filter_map(|known| {
                let (what, speed) = known.quantity.split_once(" at ")?;
                what.contains("mode ").then_some((known, what, speed))
            })
            .collect();
        let mut speeds: Vec<&str> = at.iter().map(|own| own.2).collect();
        speeds.dedup();
        for speed in speeds {
            let found = modes(case, speed);
            let of = |what: &str| {
                let own = at.iter().find(|own| own.1 == what && own.2 == speed);
                own.map(|own| (own.0.value, own.0.tolerance))
            };
            let mut next = 0;
            for number in 1.. {
                let Some((hertz, tolerance)) = of(&format!("mode {number}")) else { break };
                // Beams have neither axial nor torsional modes: each is the next one that fits.
                let fits = |mode: &[f64; 2]| (mode[0] / hertz - 1.0).abs() <= tolerance;
                let place = found[next..].iter().position(fits);
                let place = next
                    + place.unwrap_or_else(|| {
                        panic!("{name} at {speed}: no mode at {hertz} Hz: {found:?}")
                    });
                next = place + 1;
                compared += 1;
                let ratio = of(&format!("damping ratio of mode {number}"));
                if let Some((ratio, tolerance)) = ratio {
                    let apart = (found[place][1] / ratio - 1.0).abs();
                    assert!(apart <= tolerance, "{name} at {speed}, mode {number}: {apart:e}");
                    compared += 1;
                }
            }
        }
    }
    assert_eq!(compared, 24 + 35 + 20 + 20 + 16 + 24);
}

#[test]
fn critical_speeds_are_those_of_other_programs() {
    let all = reference();
    for (name, speeds, rpm) in [
        ("ross example", "0 rad/s .. 1000 rad/s, 6", 60.0 / TAU),
        ("lalanne-ferraris", "0 rpm .. 30000 rpm, 7", 1.0),
    ] {
        let case = CASES.iter().find(|own| own.0 == name).expect("a case").1;
        let workbench = Workbench::new().file("case.toml", case);
        ran(&workbench, &["campbell", "case.toml", "--speeds", speeds, "--out", "out"]);
        let found = numbers(&workbench, "out/campbell.critical.csv", "speed_rpm");
        let known = |own: &&Known| own.case == name && own.quantity.starts_with("critical speed");
        let mut next = 0;
        for known in all.iter().filter(known) {
            let fits = |own: &f64| (own / (known.value * rpm) - 1.0).abs() <= known.tolerance;
            let place = found[next..].iter().position(fits);
            assert!(place.is_some(), "{name}, {}: {found:?}", known.quantity);
            next += place.unwrap_or(0) + 1;
        }
        assert!(next >= 6, "{name}");
    }
}

/// The built-in rotor in films begins to whirl where the closed form says, and not where nothing tells the sign of a damping
/// that is none.
#[test]
fn thresholds_are_those_of_closed_forms() {
    let workbench =
        Workbench::new().file("jeffcott.toml", CASES[3].1).file("ross.toml", CASES[0].1);
    for (case, speeds, threshold, hertz, tolerance) in [
        ("weight", "3000 rpm .. 9000 rpm, 5", 6183.27537, 0.520275575 * 6183.27537 / 60.0, 1e-5),
        ("jeffcott.toml", "1500 rpm .. 6000 rpm, 4", 4036.93044, 34.0630547, 1e-2),
    ] {
        ran(&workbench, &["campbell", case, "--speeds", speeds, "--out", "out", "--no-figures"]);
        let what = column(&workbench, "out/campbell.critical.csv", "what");
        let place = what.iter().position(|own| own == "unstable above").expect("a threshold");
        let of = |name: &str| numbers(&workbench, "out/campbell.critical.csv", name)[place];
        assert!((of("speed_rpm") / threshold - 1.0).abs() < tolerance, "{}", of("speed_rpm"));
        assert!((of("frequency_hz") / hertz - 1.0).abs() < tolerance, "{}", of("frequency_hz"));
    }
    let all = ["campbell", "ross.toml", "--speeds", "0 rad/s .. 500 rad/s, 5", "--no-figures"];
    let said = ran(&workbench, &all).stdout;
    assert!(said.contains("stable at all speeds of the range"), "{said}");
}

/// Its speed is found, and its angle takes part.
#[test]
fn a_floating_ring_has_the_speed_and_the_whirl_of_its_own_equations() {
    let workbench = Workbench::new().file("ring.toml", include_str!("analyses/floating-ring.toml"));
    for speed in ["2000 rad/s", "6000 rad/s"] {
        let said = ran(&workbench, &["modes", "ring.toml", "--speeds", speed, "--out", "out"]);
        let real = numbers(&workbench, "out/modes.csv", "real_1_s");
        let imaginary = numbers(&workbench, "out/modes.csv", "imaginary_1_s");
        let case = format!("floating ring {speed}, 20 N");
        let (mut re, mut im) = (real.iter(), imaginary.iter());
        for known in reference().iter().filter(|own| own.case == case) {
            let found = match known.quantity.as_str() {
                "whirl, imaginary part" => *im.next().expect("a mode"),
                "whirl, real part" => *re.next().expect("a mode"),
                _ => {
                    let ring = said.stdout.lines().find(|line| line.starts_with("ring at "));
                    let rpm = ring.and_then(|line| line.split(' ').nth(2)).expect("its speed");
                    let speed: f64 = speed.split(' ').next().unwrap_or("").parse().unwrap();
                    // It is shown with six digits.
                    let ratio = rpm.parse::<f64>().expect("a number") * TAU / 60.0 / speed;
                    assert!((ratio / known.value - 1.0).abs() < 1e-5, "{ratio}");
                    continue;
                }
            };
            let apart = (found / known.value - 1.0).abs();
            assert!(apart <= known.tolerance, "{case}, {}: {found}", known.quantity);
        }
    }
}

/// Tables of a case do what the command line does, and need no march.
#[test]
fn tables_of_a_case_are_analyses() {
    let table = "[analysis.lateral]\nkind = \"campbell\"\nspeeds = \"0 rpm .. 60 rpm, 3\"\n\n\
                 [analysis.at_speed]\nkind = \"modes\"\nof = \"rotor\"\nspeeds = \"60 rpm\"\ncount = 4\n";
    let case = format!("{}\n{table}", CASES[0].1);
    let workbench = Workbench::new().file("case.toml", &case).file("bare.toml", CASES[0].1);
    let said = ran(&workbench, &["analyse", "case.toml"]);
    assert!(said.stdout.contains("modes over the speed of rotor, 0 to 60 rpm"), "{}", said.stdout);
    for file in
        ["lateral.csv", "lateral.critical.csv", "lateral.svg", "lateral.png", "at_speed.csv"]
    {
        assert!(workbench.path(&format!("results/case/{file}")).is_file(), "{file}");
    }
    let both = ["at_speed.csv", "lateral.csv"].map(|file| {
        let path = format!("results/case/{file}");
        let speeds = numbers(&workbench, &path, "speed_rpm");
        let values = numbers(&workbench, &path, "frequency_hz");
        let last = speeds.into_iter().zip(values).filter(|own| (own.0 - 60.0).abs() < 1e-9);
        last.map(|own| own.1).take(4).collect::<Vec<_>>()
    });
    let apart = |pair: (&f64, &f64)| (pair.0 / pair.1 - 1.0).abs();
    assert!(both[0].iter().zip(&both[1]).map(apart).all(|own| own < 1e-12), "{both:?}");
    ran(&workbench, &["check", "case.toml"]);
    let one = ran(&workbench, &["analyse", "case.toml", "at_speed"]).stdout;
    assert!(one.contains("mode") && !one.contains("critical"), "{one}");
    // Without either it is for analyses only.
    let run = workbench.whirl(&["run", "bare.toml"]);
    assert!(run.status == 2 && run.stderr.contains("`[march]` is missing"), "{}", run.stderr);
    let run = workbench.whirl(&["run", "case.toml"]);
    assert!(
        run.status == 2 && run.stderr.contains("it can be analysed, not run"),
        "{}",
        run.stderr
    );
}

#[test]
fn what_has_no_modes_at_a_speed_is_refused() {
    let workbench = Workbench::new().file("case.toml", CASES[0].1);
    for (arguments, message) in [
        (vec!["modes", "crank"], "crank is not round: its rigid motions"),
        (vec!["campbell", "sdnd101"], "nothing turns in `sdnd101`"),
        (vec!["modes", "weight", "--of", "rotr"], "there is no body `rotr` that turns"),
        (vec!["modes", "weight", "--speeds", "300 mm"], "speeds are angular speeds"),
        (vec!["modes", "weight", "--speeds", "fast"], "expected"),
        (vec!["modes", "weight", "--speeds", "0 rpm .. 5 mm, 3"], "a range from"),
        (vec!["campbell", "weight", "--orders", "1,-2"], "is no order of a rotation"),
        (vec!["modes", "weight", "--count", "0"], "no modes are asked for"),
        (vec!["analyse", "weight"], "`weight` has no analysis"),
    ] {
        let outcome = workbench.whirl(&arguments);
        assert_eq!(outcome.status, 2, "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{arguments:?}: {}", outcome.stderr);
    }
    assert!(
        workbench.listing().iter().all(|name| name == "case.toml"),
        "{:?}",
        workbench.listing()
    );
}
