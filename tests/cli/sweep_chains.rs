//! Points of a sweep that go on from each other.

use std::fs;

use crate::sweeps::{NO_NUMBER, bench, bench_of, column, done, sweep_of, text};
use crate::sweeps_resumed::kill_at;
use crate::workbench::Workbench;

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
    let older = "continues from point 0, because the points between failed";
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
    let none = "starts as the case says, because the points before it failed";
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

/// A point whose own steps are good has what those before it got wrong in its state.
#[test]
fn points_that_go_on_from_unsound_ones_are_not_sound() {
    let rattler = |time_step: &str| {
        format!(
            "title = \"an unbalanced mass beside a stop\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\n\
             damping = \"8 N*s/m\"\nunbalance = {{ eccentricity = \"0.1 mm\", speed = \"600 rpm\" }}\n\
             [[stop]]\nside = \"above\"\ngap = \"0.3 mm\"\nlaw = \"gap-linear-1e6\"\n\
             [march]\ntime_step = \"{time_step}\"\nduration = \"1 s\"\n"
        )
    };
    let study = "case = \"rattler.toml\"\ncontinue = \"down\"\n[vary]\n\
                 mass.unbalance.speed = [\"600 rpm\", \"1000 rpm\"]\n";
    let verdicts = |study: &str, time_step: &str| {
        let bench = bench_of(study).file("rattler.toml", &rattler(time_step));
        let outcome = bench.whirl(&["sweep", "study.toml"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let found = text(&bench, "results/study/table.csv");
        let own = |name: &str| -> Vec<String> {
            column(&found, name).into_iter().map(str::to_owned).collect()
        };
        (own("verdict"), own("remark"))
    };
    let (alone, _) = verdicts(&study.replace("continue = \"down\"\n", ""), "8e-4 s");
    assert_eq!(alone, ["sound", "not sound"], "600 rpm does not reach the stop");
    let (chained, remarks) = verdicts(study, "8e-4 s");
    assert_eq!(chained, ["not sound", "not sound"]);
    assert!(remarks[1].contains("the point before this one"), "{remarks:?}");
    assert_eq!(verdicts(study, "1e-5 s").0, ["sound", "sound"]);
}

/// Times of fields are those of the first point, and count from the begin of every other one.
#[test]
fn fields_are_written_at_the_times_of_every_point_of_a_chain() {
    let case = "include = \"overhung-disc.toml\"\n[body.rotor]\nspeed = \"600 rpm\"\n\
                acceleration = \"0 rpm/s\"\n[fields]\ntimes = [\"5 ms\"]\n\
                [march]\ntime_step = \"5e-5 s\"\nduration = \"0.01 s\"\n";
    let study = "case = \"disc.toml\"\ncontinue = \"up\"\n[vary]\n\
                 body.rotor.unbalance.wheel.mass = \"2 g .. 4 g, 3\"\n";
    let bench = bench_of(study).file("disc.toml", case);
    done(&bench.whirl(&["sweep", "study.toml"]));
    let found = text(&bench, "results/study/table.csv");
    assert!(!column(&found, "verdict").contains(&"failed"), "{found}");
}

/// A state is one of certain bodies: points cannot continue along what changes them.
#[test]
fn points_do_not_continue_along_what_changes_bodies() {
    let study =
        "case = \"hu2003-5\"\ncontinue = \"up\"\n[vary]\nmarch.steps = [5]\nshaft.modes = [4, 6]\n";
    let bench = bench_of(study);
    for command in ["check", "sweep"] {
        let outcome = bench.whirl(&[command, "study.toml"]);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
        for words in ["study.toml:5:", "cannot continue along `shaft.modes`", "along = "] {
            assert!(outcome.stderr.contains(words), "`{words}` is not in {}", outcome.stderr);
        }
    }
    let along = study.replace("continue", "along = \"march.steps\"\ncontinue");
    done(&bench.file("study.toml", &along).whirl(&["sweep", "study.toml"]));
}
