//! `whirl sweep`: points, rows, and what is left of a sweep that is killed.

use std::fs;
use std::process::Stdio;
use std::time::{Duration, Instant};

use whirl_cli::simulate::{Quiet, in_memory};
use whirl_cli::sweep::{Sweep, points};
use whirl_cli::{CaseText, build, read_text};
use whirl_codegen::diagnostic::Source;

use crate::workbench::{Outcome, Workbench};

/// A mass that is thrown between two stops.
fn mass(steps: usize) -> String {
    format!(
        "title = \"a mass between stops\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\nvelocity = \"1 m/s\"\n\
         [[stop]]\nside = \"above\"\ngap = \"1 mm\"\nlaw = \"gap-linear-1e6\"\n\
         [[stop]]\nside = \"below\"\ngap = \"2 mm\"\nlaw = \"gap-linear-1e6\"\n\
         [march]\ntime_step = \"1e-5 s\"\nsteps = {steps}\n"
    )
}

/// Five gaps at three speeds.
const STUDY: &str = "title = \"gaps and speeds\"\ncase = \"mass.toml\"\n[vary]\n\
                     stop.1.gap = \"0.5 mm .. 1.5 mm, 5\"\nmass.velocity = [\"0.5 m/s\", \"1 m/s\", \"200 mm/s\"]\n";

fn bench(steps: usize, study: &str) -> Workbench {
    Workbench::new().file("mass.toml", &mass(steps)).file("study.toml", study)
}

fn done(outcome: &Outcome) {
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
}

/// A table without quoted cells: names, and rows of cells.
fn table(text: &str) -> (Vec<&str>, Vec<Vec<&str>>) {
    let mut lines = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    (lines.next().expect("names"), lines.collect())
}

fn text(bench: &Workbench, name: &str) -> String {
    fs::read_to_string(bench.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The cells of a column.
fn column<'a>(text: &'a str, name: &str) -> Vec<&'a str> {
    let (names, rows) = table(text);
    let place =
        names.iter().position(|own| *own == name).unwrap_or_else(|| panic!("{name}: {names:?}"));
    rows.iter().map(|row| row[place]).collect()
}

fn sweep_of(text: &str) -> Sweep {
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
        "sweep.journal",
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
        (&["sweep", "study.toml", "--vary", gaps], "says itself what varies"),
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
const NO_NUMBER: &str = "kind = \"law\"\nname = \"root\"\ntitle = \"root of the gap\"\nsource = \"none\"\n\
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
            &["study.toml:3:14", "backwards", "`1 mm .. 2 mm`"],
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
    assert_eq!(bench.listing_of(folder), ["history.csv", "state.bin", "summary.json"]);
    assert!(bench.history_text(folder) == bench.history_text("results/own"));
    let [point, own] = [folder, "results/own"].map(|folder| bench.summary(folder));
    assert_eq!(point["supports"], own["supports"]);
    assert_eq!(
        fs::read(bench.path(folder).join("state.bin")).unwrap(),
        fs::read(bench.path("results/own/state.bin")).unwrap()
    );
}

/// Kills a sweep as soon as it has so many bytes in its journal.
fn kill_at(bench: &Workbench, bytes: u64, more: &[&str]) {
    let mut command =
        bench.command(&[&["sweep", "study.toml", "--out", "cut", "--quiet"], more].concat());
    let mut child = command.stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("it runs");
    let start = Instant::now();
    let length = || fs::metadata(bench.path("cut/sweep.journal")).map_or(0, |file| file.len());
    while length() < bytes && child.try_wait().expect("a child").is_none() {
        assert!(start.elapsed() < Duration::from_secs(60), "{} of {bytes} bytes", length());
        std::thread::sleep(Duration::from_millis(1));
    }
    let _ = child.kill();
    child.wait().expect("it ends");
}

#[cfg(unix)]
#[test]
fn a_killed_sweep_is_resumed_with_the_same_bytes() {
    let bench = bench(20_000, &format!("keep = \"histories\"\n{STUDY}"));
    done(&bench.whirl(&["sweep", "study.toml", "--out", "whole"]));
    let length = fs::metadata(bench.path("whole/sweep.journal")).unwrap().len();
    kill_at(&bench, 1, &[]);
    for part in [20, 45, 70, 95] {
        kill_at(&bench, length * part / 100, &["--resume"]);
        // What is on disk is there once: a row for a point.
        assert!(!bench.path("cut/table.csv").exists() || part == 95);
    }
    let outcome = bench.whirl(&["sweep", "study.toml", "--out", "cut", "--resume"]);
    done(&outcome);
    assert!(outcome.stderr.contains("going on after "), "{}", outcome.stderr);
    assert!(text(&bench, "cut/table.csv") == text(&bench, "whole/table.csv"), "other bytes");
    let names = bench.listing_of("whole/points");
    assert_eq!(bench.listing_of("cut/points"), names);
    for name in names {
        let [cut, whole] =
            ["cut", "whole"].map(|own| bench.history_text(&format!("{own}/points/{name}")));
        assert!(cut == whole, "point {name}");
    }
    // All is done: nothing is done again.
    let before =
        fs::metadata(bench.path("cut/points/00003/history.csv")).unwrap().modified().unwrap();
    let outcome = bench.whirl(&["sweep", "study.toml", "--out", "cut", "--resume"]);
    done(&outcome);
    assert!(outcome.stderr.contains("after 15 of 15 points"), "{}", outcome.stderr);
    let after =
        fs::metadata(bench.path("cut/points/00003/history.csv")).unwrap().modified().unwrap();
    assert_eq!(before, after);
}

/// A journal that is torn or damaged anywhere is good up to there; one of which the beginning cannot be read is left alone.
#[test]
fn a_damaged_journal_is_good_up_to_the_damage() {
    let bench = bench(100, STUDY);
    done(&bench.whirl(&["sweep", "study.toml", "--out", "cut"]));
    let (table, journal) =
        (text(&bench, "cut/table.csv"), fs::read(bench.path("cut/sweep.journal")).unwrap());
    let length: [u8; 4] = journal[..4].try_into().unwrap();
    let beginning = 4 + u32::from_le_bytes(length) as usize;
    for place in [0, 3, 40, 1000, 2000, journal.len() / 2, journal.len() - 1] {
        for torn in [true, false] {
            let mut bytes = journal.clone();
            match torn {
                true => bytes.truncate(place),
                false => bytes[place] ^= 0x40,
            }
            fs::write(bench.path("cut/sweep.journal"), &bytes).unwrap();
            if !torn && place < beginning {
                let command = ["sweep", "study.toml", "--out", "cut", "--resume", "--quiet"];
                let outcome = bench.whirl(&command);
                assert_eq!(outcome.status, 2, "at {place}: {}", outcome.stderr);
                assert!(
                    outcome.stderr.contains("damaged from its beginning"),
                    "{}",
                    outcome.stderr
                );
                assert!(fs::read(bench.path("cut/sweep.journal")).unwrap() == bytes, "at {place}");
                assert!(text(&bench, "cut/table.csv") == table, "at {place}");
                continue;
            }
            fs::remove_file(bench.path("cut/table.csv")).unwrap();
            done(&bench.whirl(&["sweep", "study.toml", "--out", "cut", "--resume", "--quiet"]));
            assert!(text(&bench, "cut/table.csv") == table, "at {place}");
        }
    }
}

#[test]
fn what_has_changed_is_not_resumed_and_what_is_new_is_done() {
    let law = include_str!("../../specs/laws/gap-linear-1e6.toml");
    let study = STUDY.replace("[vary]\n", "[vary]\nstop.2.law = [\"own.toml\"]\n");
    let bench = bench(100, &study).file("own.toml", law);
    done(&bench.whirl(&["sweep", "study.toml", "--out", "cut"]));
    let table_before = text(&bench, "cut/table.csv");
    let resume =
        |bench: &Workbench| bench.whirl(&["sweep", "study.toml", "--out", "cut", "--resume"]);
    let refused = |bench: &Workbench, what: &str| {
        let outcome = resume(bench);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
        for words in ["cannot be resumed", what, "without `--resume`"] {
            assert!(outcome.stderr.contains(words), "`{words}` is not in {}", outcome.stderr);
        }
        assert!(text(bench, "cut/table.csv") == table_before, "nothing is lost");
    };
    let bench = bench.file("mass.toml", &mass(101));
    refused(&bench, "mass.toml");
    let bench = bench.file("mass.toml", &mass(100)).file("own.toml", &format!("{law}\n# changed"));
    refused(&bench, "own.toml");
    let bench =
        bench.file("own.toml", law).file("study.toml", &study.replace("1.5 mm, 5", "1.5 mm, 4"));
    refused(&bench, "9 that are done are no longer asked for");
    let bench = bench.file("study.toml", &format!("keep = \"histories\"\n{study}"));
    refused(&bench, "`keep`");
    // More values: the points that are there are done.
    let more = study.replace("\"200 mm/s\"]", "\"200 mm/s\", \"2 m/s\"]");
    let bench = bench.file("study.toml", &more);
    let outcome = resume(&bench);
    done(&outcome);
    assert!(outcome.stderr.contains("15 of 20 points"), "{}", outcome.stderr);
    done(&bench.whirl(&["sweep", "study.toml", "--out", "whole"]));
    assert!(text(&bench, "cut/table.csv") == text(&bench, "whole/table.csv"));
}

/// Points that go on from a run are those of the state in which it ended.
#[test]
fn a_sweep_from_another_state_is_not_resumed() {
    let first = |steps: usize| format!("include = \"hu2003-5.toml\"\n[march]\nsteps = {steps}\n");
    let from = format!("{}[start]\nfrom = \"results/first\"\n", first(10));
    let study = "case = \"from.toml\"\n[vary]\nsprings.radial_clearance = [\"20 um\", \"40 um\"]\n";
    let bench = bench_of(study).file("from.toml", &from);
    let run = |bench: &Workbench| done(&bench.whirl(&["run", "first.toml", "--no-figures"]));
    let resume = |bench: &Workbench| bench.whirl(&["sweep", "study.toml", "--resume"]);
    let bench = bench.file("first.toml", &first(10));
    run(&bench);
    done(&bench.whirl(&["sweep", "study.toml"]));
    done(&resume(&bench));
    let bench = bench.file("first.toml", &first(11));
    run(&bench);
    let outcome = resume(&bench);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("state.bin"), "{}", outcome.stderr);
}

#[cfg(unix)]
#[test]
fn an_interrupted_sweep_ends_cleanly_and_two_do_not_share_a_folder() {
    let bench = bench(400_000, STUDY);
    let mut command = bench.command(&["sweep", "study.toml", "--out", "cut", "--jobs", "2"]);
    let child = command.stderr(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("it runs");
    let start = Instant::now();
    while !bench.path("cut/sweep.journal").exists() {
        assert!(start.elapsed() < Duration::from_secs(60));
        std::thread::sleep(Duration::from_millis(5));
    }
    let outcome = bench.whirl(&["sweep", "study.toml", "--out", "cut", "--resume"]);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
    assert!(outcome.stderr.contains("another run is writing"), "{}", outcome.stderr);
    let sent = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(sent.expect("kill runs").success());
    let output = child.wait_with_output().expect("it ends");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(1), "{said}");
    for words in ["interrupted", "of 15 points are kept in cut", "--resume"] {
        assert!(said.contains(words), "`{words}` is not in: {said}");
    }
    let rows = text(&bench, "cut/table.csv").lines().count() - 1;
    assert!(rows < 15, "{rows}");
    assert!(said.contains(&format!("{rows} of 15 points")), "{said}");
}

/// A limit on the size of files stands for a disk that is full.
#[cfg(unix)]
#[test]
fn a_full_disk_keeps_what_fits_and_is_resumed() {
    let study = "case = \"mass.toml\"\n[vary]\nstop.1.gap = \"0.5 mm .. 1.5 mm, 60\"\n";
    let bench = bench(50, study);
    let line = "ulimit -f 24; exec \"$0\" sweep study.toml --out cut --jobs 1";
    let output =
        bench.shell().args(["-c", line, env!("CARGO_BIN_EXE_whirl")]).output().expect("a shell");
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{said}");
    for words in ["cannot write `cut/", "of 60 points are kept in cut", "--resume"] {
        assert!(said.contains(words), "`{words}` is not in: {said}");
    }
    let outcome = bench.whirl(&["sweep", "study.toml", "--out", "cut", "--resume"]);
    done(&outcome);
    let first = outcome.stderr.split("going on after ").nth(1).expect("words").split(' ').next();
    let first: usize = first.and_then(|own| own.parse().ok()).expect("a number");
    assert!((5..60).contains(&first), "{}", outcome.stderr);
    done(&bench.whirl(&["sweep", "study.toml", "--out", "whole"]));
    assert!(text(&bench, "cut/table.csv") == text(&bench, "whole/table.csv"));
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

/// Points that go on from each other are runs that start from each other's state.
#[test]
fn continued_points_start_as_the_one_before_ended() {
    let study = "case = \"hu2003-5\"\ncontinue = \"both\"\nkeep = \"histories\"\n[vary]\nmarch.steps = [20]\n\
                 springs.radial_clearance = [\"20 um\", \"40 um\"]\n";
    let bench = Workbench::new().file("study.toml", study);
    done(&bench.whirl(&["sweep", "study.toml"]));
    let found = text(&bench, "results/study/table.csv");
    assert_eq!(column(&found, "springs.radial_clearance [um]"), ["20", "40", "40", "20"]);
    assert_eq!(column(&found, "direction"), ["up", "up", "down", "down"]);
    let case = |clearance: u32, before: u32| {
        format!(
            "include = \"hu2003-5.toml\"\n[springs]\nradial_clearance = \"{clearance} um\"\n[march]\nsteps = 20\n\
             [start]\nfrom = \"results/study/points/0000{before}\"\n"
        )
    };
    let bench = bench.file("second.toml", &case(40, 0)).file("last.toml", &case(20, 2));
    for (name, point) in [("second", 1), ("last", 3)] {
        done(&bench.whirl(&["run", &format!("{name}.toml"), "--no-figures"]));
        let own = bench.history_text(&format!("results/{name}"));
        assert!(own == bench.history_text(&format!("results/study/points/0000{point}")), "{name}");
    }
    let refused = [
        ("[\"40 um\", \"20 um\"]", "do not rise"),
        ("[\"20 um\", \"40 um\"]\nsprings.law = [\"hu2003-linear\"]", "do not rise"),
    ];
    for (values, words) in refused {
        let bench = bench_of(&study.replace("[\"20 um\", \"40 um\"]", values));
        let outcome = bench.whirl(&["sweep", "study.toml"]);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
        assert!(outcome.stderr.contains(words), "{}", outcome.stderr);
    }
    let along = study.replace("continue", "along = \"springs.radial_clearance\"\ncontinue");
    let along = along
        .replace("[vary]\n", "[vary]\nsprings.law = [\"hu2003-linear\", \"hu2003-nonlinear\"]\n");
    let sweep = sweep_of(&along);
    let chain: Vec<String> = sweep.points().take(5).map(|own| own.lines()).collect();
    assert!(chain[..4].iter().all(|own| own.contains("hu2003-linear")), "{chain:?}");
    assert!(chain[4].contains("hu2003-nonlinear"), "{chain:?}");
}

fn bench_of(study: &str) -> Workbench {
    Workbench::new().file("study.toml", study)
}

/// States from which points go on survive a kill, and none is left in the end.
#[cfg(unix)]
#[test]
fn a_killed_sweep_that_is_continued_goes_on_within_its_chains() {
    let study = "case = \"mass.toml\"\ncontinue = \"both\"\n[vary]\nmass.damping = [\"0 N*s/m\", \"1 N*s/m\"]\n\
                 stop.1.gap = \"0.5 mm .. 1.5 mm, 8\"\n";
    let bench = bench(20_000, study);
    done(&bench.whirl(&["sweep", "study.toml", "--out", "whole"]));
    let length = fs::metadata(bench.path("whole/sweep.journal")).unwrap().len();
    kill_at(&bench, length / 10, &[]);
    for part in [3, 6, 8] {
        kill_at(&bench, length * part / 10, &["--resume"]);
        assert!(bench.path("cut/chains").exists());
    }
    done(&bench.whirl(&["sweep", "study.toml", "--out", "cut", "--resume"]));
    let found = text(&bench, "cut/table.csv");
    assert!(found == text(&bench, "whole/table.csv"), "other bytes");
    for folder in ["cut", "whole"] {
        assert!(!bench.path(folder).join("chains").exists());
    }
    // A chain is not many runs from the start.
    let alone = study.replace("continue = \"both\"\n", "");
    let bench = bench.file("study.toml", &alone);
    done(&bench.whirl(&["sweep", "study.toml", "--out", "alone"]));
    let alone = text(&bench, "alone/table.csv");
    let (alone, chain) = (column(&alone, "X1_um.mean"), column(&found, "X1_um.mean"));
    assert_eq!(alone[0], chain[0]);
    assert_ne!(alone[1], chain[1]);
}

/// A state that is damaged, or of another point, is none.
#[cfg(unix)]
#[test]
fn states_that_are_not_what_they_were_do_not_change_a_sweep() {
    let study = "case = \"mass.toml\"\ncontinue = \"up\"\n[vary]\nmass.damping = [\"0 N*s/m\", \"1 N*s/m\"]\n\
                 stop.1.gap = \"0.5 mm .. 1.5 mm, 8\"\n";
    let bench = bench(20_000, study);
    done(&bench.whirl(&["sweep", "study.toml", "--out", "whole"]));
    let whole = text(&bench, "whole/table.csv");
    let length = fs::metadata(bench.path("whole/sweep.journal")).unwrap().len();
    let damages: [fn(&mut Vec<u8>); 5] = [
        |own| own.truncate(0),
        |own| own.truncate(100),
        |own| own[70] ^= 1,
        |own| own.extend([0, 0]),
        |own| own.fill(0),
    ];
    let cut = || {
        let _ = fs::remove_dir_all(bench.path("cut"));
        kill_at(&bench, length / 2, &[]);
    };
    let states = || {
        let names = bench.listing_of("cut/chains").into_iter();
        let paths = names.map(|name| bench.path(&format!("cut/chains/{name}")));
        paths.filter(|path| path.extension().is_some_and(|own| own == "bin")).collect::<Vec<_>>()
    };
    for damage in damages {
        cut();
        let found = states();
        assert!(!found.is_empty(), "no state is left by the kill");
        for path in found {
            let mut bytes = fs::read(&path).unwrap();
            damage(&mut bytes);
            fs::write(&path, bytes).unwrap();
        }
        done(&bench.whirl(&["sweep", "study.toml", "--out", "cut", "--resume"]));
        assert!(text(&bench, "cut/table.csv") == whole, "other bytes");
    }
    // The state behind another point, whole as it is.
    cut();
    let found = states();
    let other = fs::read(&found[0]).unwrap();
    found[1..].iter().for_each(|path| fs::write(path, &other).unwrap());
    let number = |path: &std::path::Path| path.file_stem().unwrap().to_str().unwrap().to_owned();
    let last: usize = number(&found[0]).parse().unwrap();
    fs::write(bench.path(&format!("cut/chains/{:05}.bin", last + 1)), &other).unwrap();
    done(&bench.whirl(&["sweep", "study.toml", "--out", "cut", "--resume"]));
    assert!(text(&bench, "cut/table.csv") == whole, "other bytes");
}

/// A point behind one that fails goes on from an older state, or from none: it says so.
#[test]
fn points_behind_one_that_fails_say_from_where_they_go_on() {
    let study = |laws: &str| {
        format!(
            "case = \"mass.toml\"\ncontinue = \"up\"\nalong = \"stop.1.gap\"\n\
             together = [[\"stop.1.gap\", \"stop.1.law\"]]\n[vary]\n\
             stop.1.gap = [\"1 mm\", \"1.1 mm\", \"1.2 mm\", \"1.3 mm\"]\nstop.1.law = [{laws}]\n"
        )
    };
    let (fine, fails) = ("\"gap-linear-1e6\"", "\"root.toml\"");
    let bench = bench(2_000, &study(&[fine, fails, fine, fine].join(", ")))
        .file("root.toml", NO_NUMBER)
        .file("first.toml", &study(&[fails, fine, fine, fine].join(", ")));
    let outcome = bench.whirl(&["sweep", "study.toml"]);
    done(&outcome);
    let older = "goes on from point 0, as the points between failed";
    let found = text(&bench, "results/study/table.csv");
    let said = |found: &str, words: &str| -> Vec<bool> {
        found.lines().skip(1).map(|line| line.contains(words)).collect()
    };
    assert_eq!(said(&found, older), [false, false, true, false], "{found}");
    assert!(outcome.stderr.contains(&format!("warning: point 2 {older}")), "{}", outcome.stderr);
    // So does the point behind it where there is none that fails.
    let alone = study(&[fine; 3].join(", ")).replace("\"1.1 mm\", ", "");
    let bench = bench.file("alone.toml", &alone);
    done(&bench.whirl(&["sweep", "alone.toml"]));
    let alone = text(&bench, "results/alone/table.csv");
    for name in ["X1_um.mean", "X1_um.max"] {
        let [behind, beside] = [(&found, 2), (&alone, 1)].map(|(own, row)| column(own, name)[row]);
        assert_eq!(behind, beside, "{name}");
    }
    let outcome = bench.whirl(&["sweep", "first.toml"]);
    done(&outcome);
    let none = "begins as the case says, as the points before it failed";
    let found = text(&bench, "results/first/table.csv");
    assert_eq!(said(&found, none), [false, true, false, false], "{found}");
}

/// Points that fail before any of a chain has a state are not run again.
#[cfg(unix)]
#[test]
fn a_chain_that_begins_with_points_that_fail_is_resumed_behind_them() {
    let study = "case = \"mass.toml\"\ncontinue = \"up\"\n[vary]\nstop.1.law = [\"root.toml\"]\n\
                 stop.1.gap = \"4 mm .. 16 mm, 4\"\n";
    let bench = bench(200_000, study).file("root.toml", NO_NUMBER);
    let length = |name: &str| {
        fs::metadata(bench.path(&format!("{name}/sweep.journal"))).expect("a journal").len()
    };
    done(&bench.whirl(&["sweep", "study.toml", "--out", "whole"]));
    let found = text(&bench, "whole/table.csv");
    assert_eq!(column(&found, "verdict")[..2], ["failed", "failed"], "{found}");
    // Whoever goes on is noted, and nothing else is there twice.
    let all = length("whole");
    done(&bench.whirl(&["sweep", "study.toml", "--out", "whole", "--resume"]));
    let begun = length("whole") - all;
    kill_at(&bench, begun + 1, &[]);
    let outcome = bench.whirl(&["sweep", "study.toml", "--out", "cut", "--resume"]);
    done(&outcome);
    assert!(!outcome.stderr.contains("after 0 of"), "{}", outcome.stderr);
    assert!(text(&bench, "cut/table.csv") == found, "other bytes");
    assert_eq!(length("cut"), all + begun);
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
    assert!(outcome.stdout.contains("2 of them are kept from before"), "{}", outcome.stdout);
    assert_eq!(bench.listing(), ["cache", "study.toml"], "nothing else is written");
    done(&bench.whirl(&["sweep", "study.toml", "--cache", "cache"]));
    assert_eq!(bench.listing_of("cache").len(), 3, "as it was said");
    // What is wrong is said as a sweep says it.
    let bench = bench.file("study.toml", &study.replace("60 um", "60 N"));
    let [checked, run] =
        ["check", "sweep"].map(|command| bench.whirl(&[command, "study.toml"]).stderr);
    assert_eq!(checked, run);
}
