//! `whirl modes`, `campbell` and `analyse`: against other programs and closed forms, from case files.

mod built_in;
mod by_angle;
mod closed_forms;
mod coarse;
mod coaxial;
mod coefficients;
mod driven;
mod figure_units;
mod figures;
mod forces;
mod integrating;
mod invariance;
mod lateral;
mod lateral_edges;
mod matrices;
mod not_round;
mod notes;
mod over_frequency;
mod peaks;
mod refused;
mod run_out;
mod sections;
mod unheld;

use std::f64::consts::TAU;
use std::fs::{File, read_to_string};
use std::io::Read;
use std::path::Path;

use flate2::read::GzDecoder;
use whirl_tests::validation::Section;

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
pub(super) struct Known {
    pub(super) case: String,
    pub(super) quantity: String,
    pub(super) value: f64,
    pub(super) unit: String,
    pub(super) tolerance: f64,
    pub(super) source: String,
}

impl Known {
    /// Holds a number against it, as a line of a page.
    pub(super) fn holds(&self, section: &mut Section, found: f64) {
        let unit = if self.unit == "1" { String::new() } else { format!(" ({})", self.unit) };
        section.compare(&format!("{}{unit}", self.quantity), self.value, found, self.tolerance);
    }
}

/// A section of the page of validations that a test of this program makes.
pub(super) fn section(title: &str, source: &str, test: &str) -> Section {
    Section::new(title, source, &format!("cargo test -p whirl-cli --test cli -- {test}"))
}

/// The source of all rows of a machine.
pub(super) fn source_of(case: &str) -> String {
    let own = reference().into_iter().find(|known| known.case == case);
    own.expect("a row of the reference").source
}

/// ROSS 2.3.0, own beams and closed forms; see the column `source` of the file.
pub(super) fn reference() -> Vec<Known> {
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
    let [case, quantity, value, unit, tolerance, source, ..] = cells.as_slice() else {
        return None;
    };
    Some(Known {
        case: case.clone(),
        quantity: quantity.clone(),
        value: value.parse().ok()?,
        unit: unit.clone(),
        tolerance: tolerance.parse().ok()?,
        source: source.clone(),
    })
}

/// A file of results: its rows by the names of their columns.
pub(super) fn column(workbench: &Workbench, path: &str, name: &str) -> Vec<String> {
    let text = read_to_string(workbench.path(path)).expect("a file of results");
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let place = names.iter().position(|own| *own == name).expect("a column");
    lines.map(|line| line.split(',').nth(place).expect("a cell").to_owned()).collect()
}

pub(super) fn numbers(workbench: &Workbench, path: &str, name: &str) -> Vec<f64> {
    let cells = column(workbench, path, name);
    cells.iter().map(|cell| cell.parse().unwrap_or(f64::NAN)).collect()
}

pub(super) fn ran(workbench: &Workbench, arguments: &[&str]) -> Outcome {
    let outcome = workbench.whirl(arguments);
    assert_eq!(outcome.status, 0, "{arguments:?}: {}", outcome.stderr);
    outcome
}

/// The modes of a case at a speed: frequencies (Hz) and damping ratios.
fn modes(case: &str, speed: &str) -> Vec<[f64; 2]> {
    let workbench = Workbench::new().file("case.toml", case);
    let arguments = ["--speeds", speed, "--count", "16", "--out", "out", "--no-figures"];
    ran(&workbench, &[&["modes", "case.toml"][..], &arguments].concat());
    let frequencies = numbers(&workbench, "out/modes.csv", "frequency_hz");
    let ratios = numbers(&workbench, "out/modes.csv", "damping_ratio");
    frequencies.into_iter().zip(ratios).map(|(hertz, ratio)| [hertz, ratio]).collect()
}

#[test]
fn modes_are_those_of_other_programs() {
    let compared = compare(&CASES, "solid", "modes_are_those_of_other_programs");
    assert_eq!(compared, 24 + 35 + 20 + 20 + 16 + 24);
}

/// Compares the modes of cases with those of the reference; how many numbers were. `how` the bodies are given, in the test
/// called so.
pub(super) fn compare(cases: &[(&str, &str)], how: &str, test: &str) -> usize {
    let all = reference();
    let mut compared = 0;
    for &(name, case) in cases {
        let mut section = section(&format!("Modes: {name}, {how}"), &source_of(name), test);
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
                own.map(|own| own.0)
            };
            let mut next = 0;
            for number in 1.. {
                let Some(known) = of(&format!("mode {number}")) else { break };
                let hertz = known.value;
                // Beams have neither axial nor torsional modes: each is the next one that fits.
                let fits = |mode: &[f64; 2]| (mode[0] / hertz - 1.0).abs() <= known.tolerance;
                let place = found[next..].iter().position(fits);
                let place = next
                    + place.unwrap_or_else(|| {
                        panic!("{name} at {speed}: no mode at {hertz} Hz: {found:?}")
                    });
                next = place + 1;
                known.holds(&mut section, found[place][0]);
                if let Some(ratio) = of(&format!("damping ratio of mode {number}")) {
                    ratio.holds(&mut section, found[place][1]);
                }
            }
        }
        compared += section.count();
        section.finish();
    }
    compared
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
        ran(
            &workbench,
            &["campbell", "case.toml", "--speeds", speeds, "--out", "out", "--no-figures"],
        );
        let found = numbers(&workbench, "out/campbell.critical.csv", "speed_rpm");
        let known = |own: &&Known| own.case == name && own.quantity.starts_with("critical speed");
        let test = "critical_speeds_are_those_of_other_programs";
        let mut section = section(&format!("Critical speeds: {name}"), &source_of(name), test);
        let mut next = 0;
        for known in all.iter().filter(known) {
            let fits = |own: &f64| (own / (known.value * rpm) - 1.0).abs() <= known.tolerance;
            let place = found[next..].iter().position(fits);
            assert!(place.is_some(), "{name}, {}: {found:?}", known.quantity);
            next += place.unwrap_or(0) + 1;
            known.holds(&mut section, found[next - 1] / rpm);
        }
        assert!(next >= 6, "{name}");
        section.finish();
    }
}

/// Also where modes leave the list between two speeds, and where those of a shaft at rest come in pairs.
#[test]
fn a_critical_speed_is_where_a_mode_has_the_frequency_of_its_order() {
    let workbench = Workbench::new();
    for (case, least) in [("overhung-disc", 3), ("two-spool", 6)] {
        let arguments = ["campbell", case, "--orders", "1,2", "--out", "out", "--no-figures"];
        let said = ran(&workbench, &arguments).stdout;
        assert!(!said.contains("not clear"), "{said}");
        let of = |name: &str| numbers(&workbench, "out/campbell.critical.csv", name);
        let what = column(&workbench, "out/campbell.critical.csv", "what");
        let rows =
            what.iter().zip(of("order")).zip(of("speed_rpm").into_iter().zip(of("frequency_hz")));
        let mut found = 0;
        for ((_, order), (rpm, hertz)) in rows.filter(|own| own.0.0 == "critical speed") {
            assert!((60.0 * hertz / (order * rpm) - 1.0).abs() < 1e-5, "{case}: {rpm} {hertz}");
            found += 1;
        }
        assert!(found >= least, "{case}: {found}");
    }
}

/// The built-in rotor in films begins to whirl where the closed form says, and not where nothing tells the sign of a damping
/// that is none.
#[test]
fn thresholds_are_those_of_closed_forms() {
    let workbench =
        Workbench::new().file("jeffcott.toml", CASES[3].1).file("ross.toml", CASES[0].1);
    let mut section = section(
        "Thresholds of stability in oil films",
        "Closed form of the short film; of `jeffcott`, own beams in films",
        "thresholds_are_those_of_closed_forms",
    );
    for (case, speeds, threshold, hertz, tolerance) in [
        ("weight", "3000 rpm .. 9000 rpm, 5", 6183.27537, 0.520275575 * 6183.27537 / 60.0, 1e-5),
        ("jeffcott.toml", "1500 rpm .. 6000 rpm, 4", 4036.93044, 34.0630547, 1e-2),
    ] {
        ran(&workbench, &["campbell", case, "--speeds", speeds, "--out", "out", "--no-figures"]);
        let what = column(&workbench, "out/campbell.critical.csv", "what");
        let place = what.iter().position(|own| own == "unstable above").expect("a threshold");
        let of = |name: &str| numbers(&workbench, "out/campbell.critical.csv", name)[place];
        let name = case.trim_end_matches(".toml");
        section.compare(&format!("{name}: speed (rpm)"), threshold, of("speed_rpm"), tolerance);
        section.compare(&format!("{name}: whirl (Hz)"), hertz, of("frequency_hz"), tolerance);
    }
    section.finish();
    let all = ["campbell", "ross.toml", "--speeds", "0 rad/s .. 500 rad/s, 5", "--no-figures"];
    let said = ran(&workbench, &all).stdout;
    assert!(said.contains("stable at all these speeds"), "{said}");
}

/// A drum that floats in its clearances whirls with the shaft in it, the slower the longer it takes to grow: no speed is told for that.
#[test]
fn motions_too_slow_to_be_told_begin_at_no_threshold() {
    let workbench = Workbench::new();
    let all = ["stability", "two-spool", "--speeds", "0 rpm .. 12000 rpm, 5", "--out", "out"];
    let said = ran(&workbench, &all).stdout;
    let note = "a motion of high that grows is too slow below 1.2";
    assert!(said.contains(note) && said.contains("not known"), "{said}");
    let speeds = numbers(&workbench, "out/stability.thresholds.csv", "speed_rpm");
    assert!(matches!(speeds[..], [own] if (own / 11_296.545_5 - 1.0).abs() < 1e-6), "{speeds:?}");
}

/// Films carry nothing at rest: that speed is left out of a range, and said.
#[test]
fn speeds_at_which_the_machine_does_not_stand_are_left_out() {
    let workbench = Workbench::new().file("film.toml", CASES[3].1);
    for command in ["campbell", "modes", "coefficients"] {
        let speeds = ["--speeds", "0 rpm .. 3000 rpm, 3", "--out", "out"];
        let said = ran(&workbench, &[&[command, "film.toml"][..], &speeds].concat()).stdout;
        assert!(said.contains("left out: 0 rpm, as no equilibrium"), "{command}: {said}");
        let file = format!("out/{command}.csv");
        let least = numbers(&workbench, &file, "speed_rpm").into_iter().fold(f64::MAX, f64::min);
        assert!((least - 1500.0).abs() < 1e-6, "{command}: {least}");
    }
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
        let test = "a_floating_ring_has_the_speed_and_the_whirl_of_its_own_equations";
        let title = format!("A floating ring at {speed} under 20 N");
        let mut section = section(&title, "Equations of its own, solved by hand", test);
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
                    section.compare(&known.quantity, known.value, ratio, 1e-5);
                    continue;
                }
            };
            known.holds(&mut section, found);
        }
        section.finish();
    }
}

/// Speeds and heights of the peaks of a disc with unbalance.
#[test]
fn peaks_of_unbalance_are_those_of_other_programs() {
    let all = reference();
    for (name, case, speeds, rpm) in [
        (
            "example_damped",
            include_str!("analyses/example-damped.toml"),
            "0 rad/s .. 400 rad/s, 21",
            60.0 / TAU,
        ),
        (
            "lalanne_ferraris",
            include_str!("analyses/lalanne-response.toml"),
            "0 rpm .. 14000 rpm, 21",
            1.0,
        ),
    ] {
        let workbench = Workbench::new().file("case.toml", case);
        ran(&workbench, &["response", "case.toml", "--speeds", speeds, "--out", "out"]);
        assert!(workbench.path("out/response.svg").is_file());
        let points = column(&workbench, "out/response.peaks.csv", "point");
        let of_disc = |name: &str| -> Vec<f64> {
            let values = numbers(&workbench, "out/response.peaks.csv", name);
            let own = points.iter().zip(values).filter(|own| own.0 == "output.disc");
            own.map(|own| own.1).collect()
        };
        let (speeds, heights) = (of_disc("speed_rpm"), of_disc("major_um"));
        let known: Vec<&Known> = all.iter().filter(|own| own.case == name).collect();
        assert!(known.len() >= 6, "{name}");
        let test = "peaks_of_unbalance_are_those_of_other_programs";
        let mut section = section(&format!("Peaks of unbalance: {name}"), &source_of(name), test);
        for pair in known.chunks(2) {
            let [speed, height] = pair else { panic!("{name}: a speed and a height") };
            let nearest = |own: &f64| (own / (speed.value * rpm) - 1.0).abs();
            let place = (0..speeds.len())
                .min_by(|a, b| nearest(&speeds[*a]).total_cmp(&nearest(&speeds[*b])))
                .expect("a peak");
            speed.holds(&mut section, speeds[place] / rpm);
            // Heights of the reference are in m or µm; those of the file are in µm.
            let per_um = if height.unit == "m" { 1e-6 } else { 1.0 };
            height.holds(&mut section, heights[place] * per_um);
        }
        section.finish();
    }
}

/// Of the short film, by its closed form; and a bushing with the file of a film has its modes.
#[test]
fn coefficients_are_those_of_the_closed_form() {
    // So fast that the slowest squeezing that the law tells from none is nothing beside it.
    let (mu, omega, radius, length, gap): (f64, f64, f64, f64, f64) =
        (0.02, 6000.0, 0.03, 0.03, 60e-6);
    let all = reference();
    let mut compared = 0;
    for epsilon in [0.05, 0.1, 0.2, 0.4, 0.5, 0.6, 0.8, 0.9, 0.95_f64] {
        let rest = 1.0 - epsilon * epsilon;
        let root = (16.0 * epsilon * epsilon + std::f64::consts::PI.powi(2) * rest).sqrt();
        let load = mu * omega * radius * length.powi(3) / (4.0 * gap * gap) * epsilon
            / (rest * rest)
            * root;
        let rotor = "[body.rotor]\nturns = \"prescribed\"\nspeed = \"6000 rad/s\"\nmass = \"1 kg\"\n\
                     polar_inertia = \"1e-3 kg*m^2\"\n";
        let film = format!(
            "title = \"a film\"\n{rotor}[joint.film]\nkind = \"bearing\"\njournal = {{ body = \"rotor\" }}\n\
             law = \"ocvirk\"\nparameters = {{ mu = \"20 mPa*s\" }}\nradial_clearance = \"60 um\"\n\
             journal_radius = \"30 mm\"\nlength = \"30 mm\"\n[loads.weight]\nbody = \"rotor\"\n\
             direction = \"x\"\nforce = \"-{load} N\"\n"
        );
        let bushing = format!(
            "title = \"a bushing\"\n{rotor}[joint.film]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\" }}\n\
             table = \"out/coefficients.film.csv\"\n"
        );
        let workbench = Workbench::new().file("case.toml", &film).file("bushing.toml", &bushing);
        let speeds = ["--speeds", "4000 rad/s .. 6000 rad/s, 2", "--out", "out"];
        ran(&workbench, &[&["coefficients", "case.toml"][..], &speeds].concat());
        let last =
            |name: &str| *numbers(&workbench, "out/coefficients.csv", name).last().expect("a row");
        assert!((last("eccentricity_ratio") / epsilon - 1.0).abs() < 1e-6, "{epsilon}");
        // tan φ = π √(1 − ε²)/(4ε), from the load to the eccentricity as the journal turns.
        let attitude = (std::f64::consts::PI * rest.sqrt()).atan2(4.0 * epsilon).to_degrees();
        assert!((last("attitude_deg") / attitude - 1.0).abs() < 1e-5, "{}", last("attitude_deg"));
        let case = format!("ocvirk eps {epsilon}");
        let test = "coefficients_are_those_of_the_closed_form";
        let title = format!("Coefficients of a short film at eccentricity {epsilon}");
        let mut section = section(&title, &source_of(&case), test);
        for known in all.iter().filter(|own| own.case == case) {
            let Some((what, axes)) = known.quantity.rsplit_once(' ') else { continue };
            let (found, scale) = match what {
                "K c/W" => (last(&format!("k_{axes}_N_m")), gap / load),
                "C c omega/W" => (last(&format!("c_{axes}_Ns_m")), gap * omega / load),
                _ => continue,
            };
            known.holds(&mut section, found * scale);
        }
        compared += section.count();
        section.finish();
        let of = |case: &str| {
            let arguments = ["modes", case, "--speeds", "6000 rad/s", "--out", "modes"];
            ran(&workbench, &arguments);
            numbers(&workbench, "modes/modes.csv", "imaginary_1_s")
        };
        let (film, bushing) = (of("case.toml"), of("bushing.toml"));
        assert_eq!(film.len(), bushing.len(), "{epsilon}");
        for (a, b) in film.iter().zip(&bushing) {
            assert!((a / b - 1.0).abs() < 1e-9, "{epsilon}: {a} {b}");
        }
    }
    assert_eq!(compared, 72);
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
    let checked = ran(&workbench, &["check", "bare.toml"]).stdout;
    assert!(checked.contains("no `[march]`, which `whirl run` needs"), "{checked}");
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
    let workbench = Workbench::new().file("film.toml", CASES[3].1);
    for (arguments, message) in [
        (vec!["campbell", "sdnd101"], "nothing turns in `sdnd101`"),
        (vec!["modes", "weight", "--of", "rotr"], "there is no body `rotr` that turns"),
        (vec!["modes", "weight", "--speeds", "300 mm"], "speeds are angular speeds"),
        (vec!["modes", "weight", "--speeds", "fast"], "expected"),
        (vec!["modes", "weight", "--speeds", "0 rpm .. 5 mm, 3"], "a range from"),
        (vec!["campbell", "weight", "--orders", "1,-2"], "is no order of a rotation"),
        (vec!["modes", "weight", "--speeds", "-1 m"], "speeds are angular speeds"),
        (vec!["modes", "weight", "--count", "0"], "no modes are asked for"),
        (vec!["response", "film.toml"], "no body of `film` has an unbalance"),
        (vec!["analyse", "sdnd101"], "`sdnd101` has no analysis"),
        (
            vec!["modes", "film.toml", "--speeds", "0 rpm"],
            "no equilibrium was found with rotor at 0 rpm",
        ),
    ] {
        let outcome = workbench.whirl(&arguments);
        assert_eq!(outcome.status, 2, "{arguments:?}: {}", outcome.stderr);
        assert!(outcome.stderr.contains(message), "{arguments:?}: {}", outcome.stderr);
    }
    assert!(
        workbench.listing().iter().all(|name| name == "film.toml"),
        "{:?}",
        workbench.listing()
    );
}
