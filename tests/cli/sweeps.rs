//! `whirl sweep`: points, rows, and what is left of a sweep that is killed.

use std::fs;

use whirl_cli::simulate::{Quiet, in_memory};
use whirl_cli::sweep::{Sweep, points};
use whirl_cli::{CaseText, build, read_text};
use whirl_codegen::diagnostic::Source;

use crate::workbench::{Outcome, Workbench};

/// A mass that is thrown between two stops.
pub(super) fn mass(steps: usize) -> String {
    format!(
        "title = \"a mass between stops\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\nvelocity = \"1 m/s\"\n\
         [[stop]]\nside = \"above\"\ngap = \"1 mm\"\nlaw = \"gap-linear-1e6\"\n\
         [[stop]]\nside = \"below\"\ngap = \"2 mm\"\nlaw = \"gap-linear-1e6\"\n\
         [march]\ntime_step = \"1e-5 s\"\nsteps = {steps}\n"
    )
}

/// Five gaps at three speeds.
pub(super) const STUDY: &str = "title = \"gaps and speeds\"\ncase = \"mass.toml\"\n[vary]\n\
                     stop.1.gap = \"0.5 mm .. 1.5 mm, 5\"\nmass.velocity = [\"0.5 m/s\", \"1 m/s\", \"200 mm/s\"]\n";

pub(super) fn bench(steps: usize, study: &str) -> Workbench {
    Workbench::new().file("mass.toml", &mass(steps)).file("study.toml", study)
}

pub(super) fn done(outcome: &Outcome) {
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
}

/// A table without quoted cells: names, and rows of cells.
fn table(text: &str) -> (Vec<&str>, Vec<Vec<&str>>) {
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    (lines.next().expect("names"), lines.collect())
}

pub(super) fn text(bench: &Workbench, name: &str) -> String {
    fs::read_to_string(bench.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The cells of a column.
pub(super) fn column<'a>(text: &'a str, name: &str) -> Vec<&'a str> {
    let (names, rows) = table(text);
    let place =
        names.iter().position(|own| *own == name).unwrap_or_else(|| panic!("{name}: {names:?}"));
    rows.iter().map(|row| row[place]).collect()
}

pub(super) fn sweep_of(text: &str) -> Sweep {
    let source = Source::new("study.toml", text);
    Sweep::of_text(&source).unwrap_or_else(|failure| panic!("{}", failure.report()))
}

fn values(text: &str) -> Vec<String> {
    let text = format!("case = \"sdnd101\"\n{text}");
    sweep_of(&text).points().map(|own| own.lines().replace("\n", "; ")).collect()
}

#[test]
fn the_rows_of_a_sweep_are_those_of_runs_of_its_points() {
    let bench = bench(2000, STUDY);
    let outcome = bench.whirl(&["sweep", "study.toml"]);
    done(&outcome);
    assert!(outcome.stdout.contains("study: 15 points"), "{}", outcome.stdout);
    let files = [
        "displacement.png",
        "displacement.svg",
        "reactions.png",
        "reactions.svg",
        "report.html",
        "sweep.journal",
        "sweep.json",
        "table.csv",
        "table.parquet",
    ];
    assert_eq!(bench.listing_of("results/study"), files);
    let found = text(&bench, "results/study/table.csv");
    assert_eq!(column(&found, "stop.1.gap [mm]")[..4], ["0.5", "0.5", "0.5", "0.75"]);
    assert_eq!(column(&found, "mass.velocity [m/s]")[..4], ["0.5", "1", "0.2", "0.5"]);
    assert!(column(&found, "verdict").iter().all(|own| *own == "sound"));
    let all =
        points(&bench.path("study.toml")).unwrap_or_else(|failure| panic!("{}", failure.report()));
    assert_eq!(all.len(), 15);
    let (largest, energy) =
        (column(&found, "RX1_N.min"), column(&found, "energy_balance_j.kinetic"));
    for point in &all {
        let case =
            CaseText::new("mass", bench.path("").as_path(), mass(2000)).with_values(point.lines());
        let case = read_text(&case, &mut Vec::new())
            .unwrap_or_else(|failure| panic!("{}", failure.report()));
        let run = in_memory(&case, &build(&case, None, &mut Vec::new()).unwrap(), &Quiet).unwrap();
        // As the standard library reads it: a reader of JSON may be off by the last bit.
        let number = |keys: [&str; 2]| -> f64 {
            let rest = keys.iter().fold(run.summary.as_str(), |rest, key| {
                rest.split_once(&format!("\"{key}\": ")).expect("the key").1
            });
            rest[..rest.find([',', '\n']).expect("an end")].parse().expect("a number")
        };
        assert_eq!(largest[point.number()].parse(), Ok(number(["RX_N", "min"])));
        assert_eq!(energy[point.number()].parse(), Ok(number(["energy_balance_j", "kinetic"])));
    }
    // The speeds differ, and so do the forces.
    assert!(largest[0] != largest[1] && largest[1] != largest[4]);
    // As many workers as one likes, and the same bytes.
    for jobs in ["1", "3"] {
        done(&bench.whirl(&["sweep", "study.toml", "--out", jobs, "--jobs", jobs, "--quiet"]));
        for name in files.into_iter().filter(|name| *name != "sweep.journal") {
            let [own, first] =
                [jobs, "results/study"].map(|folder| fs::read(bench.path(folder).join(name)));
            assert!(own.unwrap() == first.unwrap(), "other bytes of {name}");
        }
    }
}

#[test]
fn points_come_in_the_order_of_the_file_with_values_as_written() {
    assert_eq!(
        values(
            "[vary]\nmass.velocity = [\"1 m/s\", \"2 m/s\"]\nmarch.duration = \"10 ms .. 0.1 s, 3, log\"\n"
        ),
        [
            "mass.velocity = \"1 m/s\"; march.duration = \"10 ms\"; ",
            "mass.velocity = \"1 m/s\"; march.duration = \"31.6227766017 ms\"; ",
            "mass.velocity = \"1 m/s\"; march.duration = \"0.1 s\"; ",
            "mass.velocity = \"2 m/s\"; march.duration = \"10 ms\"; ",
            "mass.velocity = \"2 m/s\"; march.duration = \"31.6227766017 ms\"; ",
            "mass.velocity = \"2 m/s\"; march.duration = \"0.1 s\"; ",
        ]
    );
    assert_eq!(
        values(
            "[vary]\nmarch.steps = \"10 .. 30, 3\"\nmarch.stop_when_steady = true\nmass.motion = 'hu2003'\n"
        ),
        [10, 20, 30].map(|steps| format!(
            "march.steps = {steps}; march.stop_when_steady = true; mass.motion = \"hu2003\"; "
        ))
    );
}

#[test]
fn keys_that_vary_together_are_one_axis() {
    let found = values(
        "together = [[\"mass.mass\", \"stop.1.gap\"]]\n[vary]\nstop.1.gap = \"3 mm .. 1 mm, 3\"\n\
         mass.velocity = [\"1 m/s\", \"2 m/s\"]\nmass.mass = \"1 kg .. 2 kg, 3\"\n",
    );
    let of = |gap: &str, velocity: u8, mass: &str| {
        format!(
            "stop.1.gap = \"{gap} mm\"; mass.velocity = \"{velocity} m/s\"; mass.mass = \"{mass} kg\"; "
        )
    };
    assert_eq!(
        found,
        [
            of("3", 1, "1"),
            of("3", 2, "1"),
            of("2", 1, "1.5"),
            of("2", 2, "1.5"),
            of("1", 1, "2"),
            of("1", 2, "2")
        ]
    );
}

#[test]
fn a_latin_hypercube_has_a_value_in_every_part_of_every_range() {
    let text = |seed: u32| {
        format!(
            "samples = 20\nseed = {seed}\n[vary]\nmass.velocity = \"1 m/s .. 3 m/s\"\nmass.mass = \"1 kg .. 100 kg, log\"\n\
             mass.stiffness = [\"1 N/m\", \"2 N/m\"]\n"
        )
    };
    let found = values(&text(7));
    assert_eq!(found, values(&text(7)));
    assert_ne!(found, values(&text(8)));
    assert_eq!(found.len(), 20);
    let numbers = |key: &str| -> Vec<f64> {
        let of = |line: &String| {
            let (_, rest) = line.split_once(&format!("{key} = \"")).expect("the key");
            rest.split_once(' ').expect("a unit").0.parse().expect("a number")
        };
        found.iter().map(of).collect()
    };
    let strata = |shares: Vec<f64>| {
        let mut strata: Vec<usize> =
            shares.into_iter().map(|share| (20.0 * share) as usize).collect();
        assert!(strata.windows(2).any(|pair| pair[0] > pair[1]), "drawn, not in order");
        strata.sort_unstable();
        assert_eq!(strata, (0..20).collect::<Vec<_>>());
    };
    strata(numbers("mass.velocity").into_iter().map(|own| (own - 1.0) / 2.0).collect());
    strata(numbers("mass.mass").into_iter().map(|own| own.log10() / 2.0).collect());
    let ones = numbers("mass.stiffness").into_iter().filter(|own| *own == 1.0).count();
    assert_eq!(ones, 10);
}

#[test]
fn the_command_line_varies_as_a_file_does() {
    let bench = bench(300, STUDY);
    done(&bench.whirl(&["sweep", "study.toml", "--out", "file"]));
    let gaps = "stop.1.gap=0.5 mm .. 1.5 mm, 5";
    let speeds = "mass.velocity = [\"0.5 m/s\", \"1 m/s\", \"200 mm/s\"]";
    let outcome = bench.whirl(&["sweep", "mass.toml", "--vary", gaps, "--vary", speeds]);
    done(&outcome);
    assert!(text(&bench, "file/table.csv") == text(&bench, "results/mass-sweep/table.csv"));
    for (arguments, words) in [
        (&["sweep", "mass.toml"][..], "nothing says what varies"),
        (&["sweep", "study.toml", "--vary", gaps], "`--vary` say what varies"),
        (&["sweep", "mass.toml", "--vary", "stop.1.gap"], "has no `=`"),
        (&["sweep", "mass.toml", "--vary", "stop.1.gup=1 mm"], "did you mean `gap`?"),
        (&["sweep", "nothing.toml"], "there is no file"),
        (
            &["sweep", "mass.toml", "--vary", "stop.1.gap=1 mm .. 2 mm, 1000000000"],
            "1000000000 points",
        ),
    ] {
        let outcome = bench.whirl(&[arguments, &["--out", "none"]].concat());
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
        assert!(outcome.stderr.contains(words), "{words}: {}", outcome.stderr);
        assert!(!bench.path("none").exists(), "nothing is written");
    }
}

/// √(h/1 mm) has no value beyond the gap.
pub(super) const NO_NUMBER: &str = "kind = \"law\"\nname = \"root\"\ntitle = \"root of the gap\"\nsource = \"none\"\n\
    [inputs.h]\nunit = \"mm\"\ntitle = \"clearance\"\nrange = [0.1, 3]\n\
    [parameters.k]\nvalue = 1\nunit = \"N\"\ntitle = \"force\"\n\
    [parameters.h_1]\nvalue = 1\nunit = \"mm\"\ntitle = \"one\"\n\
    [outputs.Q]\nunit = \"N\"\ntitle = \"normal force\"\nvalue = 'k*sqrt(h/h_1)'\n";

#[test]
fn points_that_fail_are_rows_and_the_others_go_on() {
    let study = "case = \"mass.toml\"\n[vary]\nstop.1.law = [\"gap-linear-1e6\", \"root.toml\"]\n\
                 march.time_step = [\"10 us\", \"5 ms\"]\n";
    let bench = bench(400, study).file("root.toml", NO_NUMBER);
    let outcome = bench.whirl(&["sweep", "study.toml"]);
    done(&outcome);
    for words in ["2 failed", "1 NOT SOUND"] {
        assert!(outcome.stdout.contains(words), "{}", outcome.stdout);
    }
    let found = text(&bench, "results/study/table.csv");
    assert_eq!(column(&found, "verdict"), ["sound", "not sound", "failed", "failed"], "{found}");
    assert_eq!(
        column(&found, "stop.1.law"),
        ["gap-linear-1e6", "gap-linear-1e6", "root.toml", "root.toml"]
    );
    let lines: Vec<&str> = found.lines().collect();
    assert!(lines[3].contains("has no value"), "{}", lines[3]);
    assert!(lines[2].contains("at stop"), "{}", lines[2]);
    assert!(lines[1].ends_with(','), "nothing is remarked");
}

#[test]
fn a_sweep_that_is_wrong_says_where_and_writes_nothing() {
    let head = "case = \"mass.toml\"\n";
    for (text, words) in [
        ("[vary]\nstop.1.gup = [\"1 mm\"]\n", &["study.toml:3:8", "did you mean `gap`?"][..]),
        ("[vary]\nstop.1.gap = [\"1 mm\", \"1 N\"]\n", &["study.toml:3:24", "is a force"]),
        (
            "[vary]\nstop.1.gap = \"2 mm .. 1 mm, 3\"\n",
            &["study.toml:3:14", "is descending", "`1 mm .. 2 mm`"],
        ),
        ("[vary]\nstop.1.gap = []\n", &["study.toml:3:14", "has no values"]),
        ("[vary]\nstop.1.gap = [\"1 mm\", \"1 mm\"]\n", &["study.toml:3:23", "stands twice"]),
        (
            "[vary]\nstop.1.gap = [\"0.3 mm\", \"300 um\"]\n",
            &["study.toml:3:25", "\"300 um\" is \"0.3 mm\" once more"],
        ),
        ("[vary]\nstop.1.gap = \"1 mm .. 2 mm\"\n", &["1 mm .. 2 mm, 9", "how many"]),
        (
            "[vary]\nstop.1.gap = \"1 mm .. 2 mm, 1000\"\nstop.2.gap = \"1 mm .. 2 mm, 1000000\"\n",
            &["1000 × 1000000 = 1000000000 points", "samples"],
        ),
        ("[vary]\nmass.mass = \"0 kg .. 1 kg, 3\"\n", &["must be greater than zero"]),
        ("[vary]\ninclude = [\"a.toml\"]\n", &["`include` cannot vary"]),
        ("[vary]\n", &["`[vary]` has no key"]),
        ("", &["nothing says what varies"]),
        ("seed = 3\n[vary]\nstop.1.gap = [\"1 mm\"]\n", &["Latin hypercube"]),
        ("samples = 3\n[vary]\nstop.1.gap = \"1 mm .. 2 mm, 3\"\n", &["and so does `samples`"]),
        (
            "together = [[\"stop.1.gap\", \"mass.mass\"]]\n[vary]\nstop.1.gap = [\"1 mm\"]\nmass.mass = \"1 kg .. 2 kg, 3\"\n",
            &["has 3 values"],
        ),
        ("keep = \"all\"\n[vary]\nstop.1.gap = [\"1 mm\"]\n", &["`keep` cannot be `all`"]),
        (
            "kep = \"histories\"\n[vary]\nstop.1.gap = [\"1 mm\"]\n",
            &["a sweep has no key `kep`", "did you mean `keep`?"],
        ),
        ("[vary]\nstop.1.gap = 1979-05-27\n", &["a date"]),
        ("[vary]\nstop.1.gap = \"1 mm .. inf mm, 3\"\n", &["study.toml:3:23", "expected a number"]),
        ("[vary]\nmarch.steps = [nan]\n", &["study.toml:3:16", "a finite number"]),
        ("[vary]\nstop.3.gap = [\"1 mm\"]\n", &["there is no `stop.3`", "up to `stop.2`"]),
    ] {
        let bench = bench(100, &format!("{head}{text}"));
        let before = bench.listing();
        let outcome = bench.whirl(&["sweep", "study.toml"]);
        assert_eq!(
            (outcome.status, outcome.stdout.as_str()),
            (2, ""),
            "{text}: {}",
            outcome.stderr
        );
        for word in words {
            assert!(outcome.stderr.contains(word), "`{word}` is not in {}", outcome.stderr);
        }
        assert_eq!(outcome.stderr.matches("error").count(), 1, "{}", outcome.stderr);
        assert_eq!(bench.listing(), before, "nothing is written");
    }
    // A sweep of a sweep, be it itself.
    let bench = bench(100, "case = \"study.toml\"\n[vary]\nstop.1.gap = [\"1 mm\"]\n");
    let outcome = bench.whirl(&["sweep", "study.toml"]);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("`study.toml` is a sweep, not a case"), "{}", outcome.stderr);
    // None of the points can be built.
    let bench = Workbench::new()
        .file("study.toml", "case = \"hu2003-5\"\n[vary]\nshaft.mesh = [\"no.msh\"]\n");
    let outcome = bench.whirl(&["sweep", "study.toml"]);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("no.msh"), "{}", outcome.stderr);
    assert_eq!(bench.listing(), ["study.toml"]);
}

/// Histories are those of runs, byte by byte.
#[test]
fn histories_are_kept_where_they_are_wanted() {
    let bench = bench(400, &format!("keep = \"histories\"\n{STUDY}"));
    done(&bench.whirl(&["sweep", "study.toml", "--quiet"]));
    let names: Vec<String> = (0..15).map(|number| format!("{number:05}")).collect();
    assert_eq!(bench.listing_of("results/study/points"), names);
    let case = "include = \"mass.toml\"\n[mass]\nvelocity = \"200 mm/s\"\n";
    let bench = bench.file("own.toml", case);
    done(&bench.whirl(&["run", "own.toml", "--no-figures"]));
    // Of the gap as the case has it.
    let folder = "results/study/points/00008";
    assert_eq!(
        bench.listing_of(folder),
        ["history.csv", "point.toml", "state.bin", "summary.json"]
    );
    assert!(bench.history_text(folder) == bench.history_text("results/own"));
    let [point, own] = [folder, "results/own"].map(|folder| bench.summary(folder));
    assert_eq!(point["supports"], own["supports"]);
    assert_eq!(
        fs::read(bench.path(folder).join("state.bin")).unwrap(),
        fs::read(bench.path("results/own/state.bin")).unwrap()
    );
}

/// One reduction for all points, whichever begin it together; two where a dimension has two values.
#[test]
fn bodies_that_points_share_are_reduced_once() {
    let study = |vary: &str| {
        format!("case = \"hu2003-5\"\n[vary]\nmarch.steps = [5]\nspringsradial = 0\n{vary}")
            .replace(
                "springsradial = 0\n",
                "springs.radial_clearance = [\"20 um\", \"30 um\", \"40 um\"]\n",
            )
    };
    for (vary, bodies) in
        [("", 2), ("support.dimensions.ring_thickness = [\"20 mm\", \"21 mm\"]\n", 3)]
    {
        let bench = Workbench::new().file("study.toml", &study(vary));
        let outcome = bench.whirl(&["sweep", "study.toml", "--cache", "cache", "--jobs", "3"]);
        done(&outcome);
        assert_eq!(bench.listing_of("cache").len(), bodies, "{:?}", bench.listing_of("cache"));
        let found = text(&bench, "results/study/table.csv");
        let forces = column(&found, "RX1_N.max");
        assert_eq!(forces.len(), 3 * (bodies - 1));
        assert_ne!(forces[0], forces[1]);
    }
}

pub(super) fn bench_of(study: &str) -> Workbench {
    Workbench::new().file("study.toml", study)
}

#[test]
fn a_check_says_what_a_sweep_takes() {
    let study = "title = \"clearance and load\"\ncase = \"hu2003-5\"\nkeep = \"histories\"\n[vary]\nmarch.steps = [10]\n\
                 springs.radial_clearance = \"20 um .. 60 um, 5\"\nsupport.dimensions.ring_thickness = [\"20 mm\", \"21 mm\"]\n";
    let bench = bench_of(study);
    let outcome = bench.whirl(&["check", "study.toml", "--cache", "cache"]);
    done(&outcome);
    for words in [
        "study: clearance and load",
        "10 points (5 × 2):",
        "springs.radial_clearance [um]: 20 .. 60",
        "support.dimensions.ring_thickness [mm]: 20, 21",
        "3 bodies are reduced, each once (1 + 2 of the bodies of a point)\n",
        "on disk",
    ] {
        assert!(outcome.stdout.contains(words), "`{words}` is not in {}", outcome.stdout);
    }
    // The first point is built: its bodies are there.
    let outcome = bench.whirl(&["check", "study.toml", "--cache", "cache"]);
    assert!(outcome.stdout.contains("2 of them are in the cache"), "{}", outcome.stdout);
    assert_eq!(bench.listing(), ["cache", "study.toml"], "nothing else is written");
    done(&bench.whirl(&["sweep", "study.toml", "--cache", "cache"]));
    assert_eq!(bench.listing_of("cache").len(), 3, "as it was said");
    // What is wrong is said as a sweep says it.
    let bench = bench.file("study.toml", &study.replace("60 um", "60 N"));
    let [checked, run] =
        ["check", "sweep"].map(|command| bench.whirl(&[command, "study.toml"]).stderr);
    assert_eq!(checked, run);
}
