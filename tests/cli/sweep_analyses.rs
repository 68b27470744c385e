//! Sweeps whose points are analysed: their numbers are those of the analyses, a missing one is an empty cell, and what is true of
//! other sweeps is true of them.

use std::f64::consts::TAU;
use std::fs;

use crate::analyses::{column, numbers, ran};
use crate::sweeps::{done, text};
use crate::workbench::Workbench;

/// Film bearings of three clearances, of which the threshold is in the range, below it, and above it.
const FILMS: &str = "case = \"films.toml\"\nanalyse = \"whirl\"\n\
                     together = [[\"joint.left.radial_clearance\", \"joint.right.radial_clearance\"]]\n[vary]\n\
                     joint.left.radial_clearance = [\"120 um\", \"150 um\", \"60 um\"]\n\
                     joint.right.radial_clearance = [\"120 um\", \"150 um\", \"60 um\"]\n";

const CASE: &str = "include = \"weight.toml\"\ntitle = \"films\"\n\
                    [analysis.whirl]\nkind = \"stability\"\nspeeds = \"4000 rpm .. 7000 rpm, 7\"\n";

fn films() -> Workbench {
    Workbench::new().file("films.toml", CASE).file("study.toml", FILMS)
}

/// The last row of what an analysis of the case by itself writes.
fn alone(bench: &Workbench, clearance: &str) -> (Vec<f64>, Vec<f64>) {
    let own = format!(
        "include = \"films.toml\"\ntitle = \"alone\"\njoint.left.radial_clearance = \"{clearance}\"\n\
         joint.right.radial_clearance = \"{clearance}\"\n"
    );
    fs::write(bench.path("alone.toml"), own).unwrap();
    ran(bench, &["analyse", "alone.toml", "whirl", "--out", "alone", "--no-figures"]);
    let threshold = numbers(bench, "alone/whirl.thresholds.csv", "speed_rpm");
    (threshold, numbers(bench, "alone/whirl.csv", "least_log_decrement"))
}

#[test]
fn numbers_of_points_are_those_of_analyses_and_a_missing_one_is_an_empty_cell() {
    let bench = films();
    let outcome = bench.whirl(&["sweep", "study.toml", "--out", "out"]);
    done(&outcome);
    let table = "out/table.csv";
    let found = column(&bench, table, "whirl.threshold_rpm");
    let least = numbers(&bench, table, "whirl.least_log_decrement");
    let mut there = 0;
    for (place, clearance) in ["120 um", "150 um", "60 um"].into_iter().enumerate() {
        let (threshold, decrements) = alone(&bench, clearance);
        match threshold.first() {
            Some(own) => assert_eq!(found[place].parse(), Ok(*own)),
            None => assert_eq!(found[place], ""),
        }
        there += threshold.len();
        let own = decrements.into_iter().reduce(f64::min).unwrap();
        assert!(least[place] == own, "{} {own}", least[place]);
    }
    assert!((1..=2).contains(&there), "thresholds of all points or of none: {found:?}");
    let stable = numbers(&bench, table, "whirl.stable");
    for (stable, threshold) in stable.iter().zip(&found) {
        assert!(*stable == 0.0 || threshold.is_empty());
    }
    assert!(column(&bench, table, "verdict").iter().all(|own| own == "sound"));
    for stem in ["thresholds", "decrements"] {
        let drawn = fs::read_to_string(bench.path(&format!("out/{stem}.svg"))).unwrap();
        assert!(drawn.contains("radial_clearance (µm)") && drawn.contains("whirl"), "{stem}");
        assert!(!drawn.contains("NaN"), "{stem}");
    }
    // On any number of threads, and where a part was done before.
    for jobs in ["1", "3"] {
        fs::write(bench.path("study.toml"), FILMS.replace(", \"60 um\"", "")).unwrap();
        let command = ["sweep", "study.toml", "--out", jobs, "--jobs", jobs];
        done(&bench.whirl(&command));
        fs::write(bench.path("study.toml"), FILMS).unwrap();
        let resumed = bench.whirl(&[&command[..], &["--resume"]].concat());
        done(&resumed);
        assert!(resumed.stderr.contains("after 2 of 3 points"), "{}", resumed.stderr);
        for name in ["table.csv", "table.parquet", "thresholds.svg", "decrements.png"] {
            let [own, first] = [jobs, "out"].map(|own| fs::read(bench.path(own).join(name)));
            assert!(own.unwrap() == first.unwrap(), "other bytes of {name}");
        }
    }
}

/// A rigid rotor with its middle at the middle of two springs, without `[march]`.
fn rigid(more: &str) -> String {
    let joint = |name: &str, z: &str| {
        format!(
            "[joint.{name}]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", z = \"{z}\" }}\n\
             stiffness = {{ xx = \"1e6 N/m\", yy = \"1e6 N/m\" }}\ndamping = {{ xx = \"30 N*s/m\", yy = \"30 N*s/m\" }}\n"
        )
    };
    format!(
        "title = \"a rigid rotor\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"8000 rpm\"\nmass = \"12 kg\"\n\
         z = \"0 m\"\npolar_inertia = \"0.05 kg*m^2\"\ntransverse_inertia = \"0.4 kg*m^2\"\n\
         unbalance.disc = {{ mass = \"1 g\", radius = \"50 mm\", z = \"0 m\" }}\n{}{}{more}",
        joint("left", "-0.3 m"),
        joint("right", "0.3 m")
    )
}

/// Two stiffnesses, of which a map is made.
const STIFFNESS: &str = "case = \"rotor.toml\"\ntogether = [[\"joint.left.stiffness.xx\", \"joint.left.stiffness.yy\", \"joint.right.stiffness.xx\", \"joint.right.stiffness.yy\"]]\n\
                         analyse = [\"campbell\", \"modes\", \"coefficients\", \"response\"]\n[vary]\n\
                         joint.left.stiffness.xx = [\"1e6 N/m\", \"2e6 N/m\", \"4e6 N/m\"]\n\
                         joint.left.stiffness.yy = [\"1e6 N/m\", \"2e6 N/m\", \"4e6 N/m\"]\n\
                         joint.right.stiffness.xx = [\"1e6 N/m\", \"2e6 N/m\", \"4e6 N/m\"]\n\
                         joint.right.stiffness.yy = [\"1e6 N/m\", \"2e6 N/m\", \"4e6 N/m\"]\n\
                         body.rotor.mass = \"10 kg .. 12 kg, 3\"\n";

/// Its first forward critical speed is √(2k/m), but for the damping: ζ = c/√(2km) < 1 % shifts it by ζ²/2 < 5e-5. The response
/// has its peak 1 + ζ² there, by the same order.
#[test]
fn critical_speeds_over_stiffness_and_mass_are_those_of_the_closed_form() {
    let more = "[output.disc]\nbody = \"rotor\"\nz = \"0 m\"\nquantity = \"displacement\"\n";
    let bench = Workbench::new().file("rotor.toml", &rigid(more)).file("study.toml", STIFFNESS);
    let check = ran(&bench, &["check", "study.toml"]).stdout;
    assert!(check.contains("each is analysed: `campbell`, `modes`"), "{check}");
    ran(&bench, &["sweep", "study.toml", "--out", "out"]);
    let table = "out/table.csv";
    let masses = numbers(&bench, table, "body.rotor.mass [kg]");
    let stiffness = numbers(&bench, table, "joint.left.stiffness.xx [N/m]");
    let criticals = numbers(&bench, table, "campbell.forward_critical_rpm.1");
    let least = numbers(&bench, table, "campbell.critical_rpm.1");
    let hertz = numbers(&bench, table, "modes.frequency_hz.1");
    let k_xx = numbers(&bench, table, "coefficients.left.k_xx_N_m");
    let peaks = numbers(&bench, table, "response.output.disc.peak_rpm.1");
    assert_eq!(criticals.len(), 9);
    for place in 0..9 {
        let omega = (2.0 * stiffness[place] / masses[place]).sqrt();
        let rpm = omega * 60.0 / TAU;
        assert!((criticals[place] / rpm - 1.0).abs() < 1e-4, "{} {rpm}", criticals[place]);
        assert!((peaks[place] / rpm - 1.0).abs() < 3e-4, "{} {rpm}", peaks[place]);
        assert!(least[place] <= criticals[place]);
        assert!((hertz[place] / (omega / TAU) - 1.0).abs() < 1e-4, "{}", hertz[place]);
        assert!((k_xx[place] / stiffness[place] - 1.0).abs() < 1e-12);
    }
    // Nothing of it grows: there is no threshold.
    assert!(column(&bench, table, "campbell.threshold_rpm").iter().all(String::is_empty));
    let stems = ["amplitudes", "amplification", "coefficients", "critical-speeds", "frequencies"];
    for stem in stems {
        assert!(bench.path(&format!("out/{stem}.png")).is_file(), "{stem}");
    }
    // No point has one.
    assert!(!bench.path("out/thresholds.png").is_file());
    // Over one key there are curves.
    let vary = ["--vary", "body.rotor.mass=10 kg .. 12 kg, 3", "--analyse", "campbell,modes"];
    ran(&bench, &[&["sweep", "rotor.toml", "--out", "line"][..], &vary].concat());
    let line = numbers(&bench, "line/table.csv", "campbell.forward_critical_rpm.1");
    assert_eq!(line, criticals[..3]);
    assert!(bench.path("line/critical-speeds.svg").is_file());
}

/// Films carry nothing at rest.
#[test]
fn a_point_at_which_nothing_stands_has_failed_and_the_others_go_on() {
    let study = "case = \"films.toml\"\nanalyse = [\"once\"]\n[vary]\nanalysis.once.speeds = [\"0 rpm\", \"3000 rpm\"]\n";
    let case = format!("{CASE}[analysis.once]\nkind = \"modes\"\n");
    let bench = Workbench::new().file("films.toml", &case).file("study.toml", study);
    let outcome = ran(&bench, &["sweep", "study.toml", "--out", "out"]);
    assert!(outcome.stdout.contains("1 failed"), "{}", outcome.stdout);
    let table = "out/table.csv";
    assert_eq!(column(&bench, table, "verdict"), ["failed", "sound"]);
    let hertz = column(&bench, table, "once.frequency_hz.1");
    assert!(hertz[0].is_empty() && hertz[1].parse::<f64>().is_ok(), "{hertz:?}");
    let whole = text(&bench, table);
    let first = whole.lines().nth(1).expect("a row");
    assert!(first.contains("equilibrium") || first.contains("balance"), "{first}");
    assert!(bench.path("out/frequencies.svg").is_file());
}

/// A run and an analysis of each point have the numbers that each has by itself.
#[test]
fn points_are_run_and_analysed_where_both_are_wanted() {
    let march = "[march]\ntime_step = \"1e-4 s\"\nduration = \"0.2 s\"\n";
    let study = |head: &str| {
        format!("case = \"rotor.toml\"\n{head}[vary]\nbody.rotor.mass = [\"10 kg\", \"12 kg\"]\n")
    };
    let bench = Workbench::new()
        .file("rotor.toml", &rigid(march))
        .file("both.toml", &study("analyse = \"modes\"\nmarch = true\n"))
        .file("modes.toml", &study("analyse = \"modes\"\n"))
        .file("run.toml", &study(""));
    for name in ["both", "modes", "run"] {
        ran(&bench, &["sweep", &format!("{name}.toml"), "--out", name]);
    }
    let of = |folder: &str, name: &str| column(&bench, &format!("{folder}/table.csv"), name);
    for (name, other) in
        [("modes.frequency_hz.1", "modes"), ("modes.stable", "modes"), ("X_left_um.max", "run")]
    {
        let both = of("both", name);
        assert!(both == of(other, name) && !both[0].is_empty(), "{name}");
    }
    assert!(bench.path("both/frequencies.svg").is_file());
    assert!(bench.path("both/bifurcation.svg").is_file());
    assert!(!bench.path("modes/bifurcation.svg").is_file());
}

/// What is wrong is said before anything is done, where it stands.
#[test]
fn what_cannot_be_a_table_is_refused() {
    let vary = "[vary]\nbody.rotor.mass = [\"10 kg\", \"12 kg\"]\n";
    let wrong = [
        ("analyse = \"campbel\"\n", "has no analysis `campbel`", "campbell"),
        ("analyse = [\"matrices\"]\n", "has no analysis `matrices`", "study.toml:2"),
        ("analyse = [\"written\"]\n", "gives matrices", "modes"),
        ("analyse = [\"many\"]\n", "is of 5 speeds", "give one of `speeds`"),
        ("analyse = [\"map\"]\n", "has no analysis `map`", "study.toml:2"),
        ("analyse = [\"modes\", \"modes\"]\n", "`modes` stands twice", "leave it out"),
        ("analyse = \"modes\"\nkeep = \"histories\"\n", "have no histories", "march = true"),
        ("analyse = \"modes\"\ncontinue = \"up\"\n", "only runs can start", "march = true"),
        ("march = false\n", "neither run nor analysed", "analyse"),
        ("analyse = \"modes\"\nmarch = true\n", "[march]", "time_step"),
        ("", "[march]", "time_step"),
    ];
    let more = "[analysis.many]\nkind = \"coefficients\"\nspeeds = \"0 rpm .. 100 rpm, 5\"\n\
                [analysis.written]\nkind = \"matrices\"\n";
    for (head, message, help) in wrong {
        let study = format!("case = \"rotor.toml\"\n{head}{vary}");
        let bench = Workbench::new().file("rotor.toml", &rigid(more)).file("study.toml", &study);
        let outcome = bench.whirl(&["sweep", "study.toml", "--out", "out"]);
        assert_eq!(outcome.status, 2, "{head}: {}", outcome.stderr);
        assert!(
            outcome.stderr.contains(message) && outcome.stderr.contains(help),
            "{head}: {}",
            outcome.stderr
        );
        assert!(!bench.path("out").exists(), "{head}");
    }
    let bench = Workbench::new()
        .file("rotor.toml", &rigid(""))
        .file("study.toml", &format!("case = \"rotor.toml\"\nanalyse = \"modes\"\n{vary}"));
    let outcome = bench.whirl(&["sweep", "study.toml", "--analyse", "campbell"]);
    assert_eq!(outcome.status, 2);
    assert!(outcome.stderr.contains("says itself"), "{}", outcome.stderr);
    // Other analyses are other numbers.
    ran(&bench, &["sweep", "study.toml", "--out", "out", "--quiet"]);
    let other = format!("case = \"rotor.toml\"\nanalyse = \"stability\"\n{vary}");
    fs::write(bench.path("study.toml"), other).unwrap();
    let outcome = bench.whirl(&["sweep", "study.toml", "--out", "out", "--resume"]);
    assert_eq!(outcome.status, 2);
    assert!(outcome.stderr.contains("`analyse`"), "{}", outcome.stderr);
}

/// A sweep that is killed has its rows up to there.
#[cfg(unix)]
#[test]
fn a_killed_sweep_of_analyses_is_resumed_with_the_same_bytes() {
    let study = "case = \"rotor.toml\"\nanalyse = \"campbell\"\n[vary]\nbody.rotor.mass = \"10 kg .. 12 kg, 40\"\n";
    let bench = Workbench::new().file("rotor.toml", &rigid("")).file("study.toml", study);
    done(&bench.whirl(&["sweep", "study.toml", "--out", "whole"]));
    let length = fs::metadata(bench.path("whole/sweep.journal")).unwrap().len();
    crate::sweeps_resumed::kill_at(&bench, length / 3, &[]);
    done(&bench.whirl(&["sweep", "study.toml", "--out", "cut", "--resume"]));
    assert!(text(&bench, "cut/table.csv") == text(&bench, "whole/table.csv"), "other bytes");
}
