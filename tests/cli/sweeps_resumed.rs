//! Sweeps that are killed, interrupted or damaged, and go on.

use std::fs;
use std::process::Stdio;
use std::time::{Duration, Instant};

use crate::sweeps::{STUDY, bench, bench_of, done, mass, text};
use crate::workbench::Workbench;

/// Kills a sweep as soon as it has so many bytes in its journal.
pub(super) fn kill_at(bench: &Workbench, bytes: u64, more: &[&str]) {
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
    assert!(outcome.stderr.contains("resuming after "), "{}", outcome.stderr);
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
    refused(&bench, "9 finished ones are no longer part of the sweep");
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
    let first = outcome.stderr.split("resuming after ").nth(1).expect("words").split(' ').next();
    let first: usize = first.and_then(|own| own.parse().ok()).expect("a number");
    assert!((5..60).contains(&first), "{}", outcome.stderr);
    done(&bench.whirl(&["sweep", "study.toml", "--out", "whole"]));
    assert!(text(&bench, "cut/table.csv") == text(&bench, "whole/table.csv"));
}

/// A body that is not reduced has its numbers from files all the same.
#[test]
fn a_sweep_whose_rigid_matrices_were_changed_is_not_resumed() {
    let corner =
        |number: usize| [number & 1, number >> 1 & 1, number >> 2].map(|at| 2.0 * at as f64);
    let mut dofs = "node, direction, x [cm], y [cm], z [cm]\n".to_owned();
    // Springs from each corner to each other one leave the cube free.
    let mut stiffness = [[0.0; 24]; 24];
    for near in 0..8 {
        let [x, y, z] = corner(near);
        for (place, direction) in ["x", "y", "z"].into_iter().enumerate() {
            dofs += &format!("{}, {direction}, {}, {}, {z}\n", near + 1, x - 1.0, y - 1.0);
            for far in (0..8).filter(|far| *far != near) {
                let along: [f64; 3] = std::array::from_fn(|at| corner(far)[at] - corner(near)[at]);
                let square: f64 = along.iter().map(|own| own * own).sum();
                for (other, own) in along.iter().enumerate() {
                    let value = 1e8 * along[place] * own / square;
                    stiffness[3 * near + place][3 * near + other] += value;
                    stiffness[3 * near + place][3 * far + other] -= value;
                }
            }
        }
    }
    let rows = stiffness.iter().enumerate();
    let entries = rows.flat_map(|(i, row)| {
        row.iter()
            .take(i + 1)
            .enumerate()
            .map(move |(j, own)| format!("{} {} {own:e}\n", i + 1, j + 1))
    });
    let head = "%%MatrixMarket matrix coordinate real symmetric\n24 24";
    let stiffness = format!("{head} 300\n{}", entries.collect::<String>());
    let mass = |value: f64| {
        (1..=24).fold(format!("{head} 24\n"), |text, row| text + &format!("{row} {row} {value}\n"))
    };
    let case = "title = \"a cube\"\n[body.cube]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\nrigid = true\n\
        matrices = { stiffness = \"K.mtx\", mass = \"M.mtx\", dofs = \"dofs.csv\" }\n\
        [body.cube.sets.ALL]\npoint = [\"0 cm\", \"0 cm\", \"1 cm\"]\nwithin = \"5 cm\"\n\
        [joint.mount]\nkind = \"bushing\"\nfirst = { body = \"cube\", sets = [\"ALL\"] }\n\
        stiffness = { xx = \"1e5 N/m\", yy = \"1e5 N/m\" }\n\
        tilting_stiffness = { xx = \"10 N*m/rad\", yy = \"10 N*m/rad\" }\n\
        [loads.push]\nbody = \"cube\"\nsets = [\"ALL\"]\nforce = [\"1 N\", \"0 N\", \"0 N\"]\n\
        [march]\ntime_step = \"1e-4 s\"\nsteps = 200\n";
    let study = "case = \"cube.toml\"\n[vary]\nloads.push.start = \"1 ms .. 9 ms, 3\"\n";
    let bench = bench_of(study)
        .file("cube.toml", case)
        .file("dofs.csv", &dofs)
        .file("K.mtx", &stiffness)
        .file("M.mtx", &mass(0.1));
    done(&bench.whirl(&["sweep", "study.toml"]));
    let bench = bench.file("M.mtx", &mass(0.3));
    let outcome = bench.whirl(&["sweep", "study.toml", "--resume"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("M.mtx"), "{}", outcome.stderr);
}

/// Histories stay with their points where further ones come between them, and those that are gone are made again.
#[test]
fn histories_follow_their_points() {
    let study = |values: &str| {
        format!(
            "case = \"mass.toml\"\nkeep = \"histories\"\n[vary]\nstop.1.gap = [{values}]\n\
             mass.damping = [\"1 N*s/m\", \"0 N*s/m\"]\n"
        )
    };
    let bench = bench(100, &study("\"1 mm\", \"2 mm\""));
    done(&bench.whirl(&["sweep", "study.toml", "--out", "cut"]));
    let is_whole = |bench: &Workbench| {
        for number in 0..6 {
            let [cut, whole] = ["cut", "whole"]
                .map(|own| bench.history_text(&format!("{own}/points/0000{number}")));
            assert!(cut == whole, "point {number}");
        }
        assert_eq!(bench.listing_of("cut/points").len(), 6);
        assert!(text(bench, "cut/table.csv") == text(bench, "whole/table.csv"));
    };
    // One more value in the middle, in another order: 0 and 1 become 2 and 3, 2 and 3 become 0 and 1.
    let bench = bench.file("study.toml", &study("\"2 mm\", \"1 mm\", \"1.5 mm\""));
    let resume = |bench: &Workbench| {
        let outcome = bench.whirl(&["sweep", "study.toml", "--out", "cut", "--resume"]);
        done(&outcome);
        outcome.stderr
    };
    let modified = |bench: &Workbench, point: &str| {
        fs::metadata(bench.path(&format!("cut/points/{point}/history.csv")))
            .unwrap()
            .modified()
            .unwrap()
    };
    let before = modified(&bench, "00000");
    assert!(resume(&bench).contains("resuming after 4 of 6 points\n"));
    assert_eq!(modified(&bench, "00002"), before, "nothing is done again");
    done(&bench.whirl(&["sweep", "study.toml", "--out", "whole"]));
    is_whole(&bench);
    // What was being moved when the power failed, what is gone, and what is of nobody.
    let at = |name: &str| bench.path(&format!("cut/points/{name}"));
    fs::rename(at("00004"), at(".00003.moved")).unwrap();
    fs::remove_dir_all(at("00001")).unwrap();
    fs::write(at("00005/point.toml"), "# point 0\n").unwrap();
    let said = resume(&bench);
    assert!(
        said.contains("4 of 6 points; 2 are run again, because their histories are missing"),
        "{said}"
    );
    is_whole(&bench);
}

/// An interrupted sweep has a page of what is done.
#[cfg(unix)]
#[test]
fn an_interrupted_sweep_has_a_page() {
    let bench = bench(200_000, STUDY);
    let mut command =
        bench.command(&["sweep", "study.toml", "--out", "cut", "--quiet", "--jobs", "1"]);
    let mut child = command.stderr(Stdio::null()).stdout(Stdio::null()).spawn().expect("it runs");
    let start = Instant::now();
    while fs::metadata(bench.path("cut/sweep.journal")).map_or(0, |file| file.len()) < 4000 {
        assert!(start.elapsed() < Duration::from_secs(60));
        std::thread::sleep(Duration::from_millis(5));
    }
    let id = child.id().to_string();
    std::process::Command::new("kill").args(["-INT", &id]).status().expect("it is told");
    assert_eq!(child.wait().expect("it ends").code(), Some(1));
    let page = text(&bench, "cut/report.html");
    assert!(page.contains(" of 15 points are done"));
    assert!(bench.path("cut/sweep.json").exists());
}
