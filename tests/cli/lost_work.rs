//! Nothing done is lost: histories on disk while they are computed, runs that are stopped, resumed, in each other's
//! way, or out of space.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::workbench::Workbench;

/// Steps of a run that takes a second or two.
pub(super) const MANY: usize = 150_000;

/// A mass that is thrown between two stops, in as many steps.
pub(super) fn case(steps: usize, more: &str) -> String {
    format!(
        "title = \"a mass between stops\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\n\
         velocity = \"1 m/s\"\nunbalance = {{ eccentricity = \"0.5 mm\", speed = \"110 rad/s\" }}\n\
         [[stop]]\nside = \"above\"\ngap = \"1 mm\"\nlaw = \"gap-linear-1e6\"\n\
         [[stop]]\nside = \"below\"\ngap = \"2 mm\"\nlaw = \"gap-linear-1e6\"\n\
         [output.speed]\nquantity = \"velocity\"\nbody = \"mass\"\n\
         [output.loss]\nquantity = \"power\"\njoint = \"1\"\n\
         [march]\ntime_step = \"1e-5 s\"\nsteps = {steps}\n{more}"
    )
}

/// `whirl` at work, ended when this is dropped.
pub(super) struct Running(Child);

impl Running {
    pub(super) fn start(bench: &Workbench, arguments: &[&str]) -> Self {
        let mut command = bench.command(arguments);
        command.stdout(Stdio::piped()).stderr(Stdio::piped());
        Running(command.spawn().expect("the binary runs"))
    }

    pub(super) fn signal(&self, name: &str) {
        let number = self.0.id().to_string();
        let sent = Command::new("kill").args([&format!("-{name}"), &number]).status();
        assert!(sent.expect("kill runs").success());
    }

    /// Its status, none if a signal has ended it, and what it said on stderr.
    pub(super) fn end(mut self) -> (Option<i32>, String) {
        let mut said = String::new();
        self.0.stderr.take().expect("piped").read_to_string(&mut said).expect("UTF-8");
        (self.0.wait().expect("it ends").code(), said)
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Waits for something that a run does by itself.
pub(super) fn wait_until(what: &str, happens: impl Fn() -> bool) {
    let start = Instant::now();
    while !happens() {
        assert!(start.elapsed() < Duration::from_secs(60), "{what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

pub(super) fn read(path: PathBuf) -> String {
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The summary without what every run has of its own.
fn numbers(bench: &Workbench, folder: &str) -> serde_json::Value {
    let mut summary = bench.summary(folder);
    summary.as_object_mut().expect("a table").remove("time");
    summary
}

/// Begins the run and waits until it has a checkpoint and rows after it.
pub(super) fn begin(bench: &Workbench, arguments: &[&str]) -> Running {
    let running = Running::start(bench, arguments);
    let folder = bench.path("cut");
    wait_until("a checkpoint", || folder.join("checkpoint.bin").exists());
    let length = || fs::metadata(folder.join("history.csv")).map_or(0, |file| file.len());
    let first = length();
    wait_until("rows after it", || length() > first + 400_000);
    running
}

/// Begins the run of `case.toml` in `cut`, and kills it in the midst.
pub(super) fn begin_and_kill(bench: &Workbench) {
    let mut running = begin(bench, &["run", "case.toml", "--out", "cut"]);
    running.0.kill().expect("it is there");
    let (status, _) = running.end();
    assert_eq!(status, None, "ended by a signal");
}

/// Resumes the run in `cut`, and compares what it leaves with a run that was never interrupted.
pub(super) fn resumes(bench: &Workbench) {
    let outcome = bench.whirl(&["run", "case.toml", "--out", "cut", "--resume"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("resuming after step "), "{}", outcome.stderr);
    let outcome = bench.whirl(&["run", "case.toml", "--out", "whole"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let [cut, whole] = ["cut", "whole"].map(|folder| read(bench.path(folder).join("history.csv")));
    assert!(cut == whole, "other bytes: {} and {}", cut.len(), whole.len());
    let states = ["cut", "whole"].map(|folder| fs::read(bench.path(folder).join("state.bin")));
    assert!(matches!(&states, [Ok(cut), Ok(whole)] if cut == whole), "other last states");
    assert_eq!(numbers(bench, "cut"), numbers(bench, "whole"));
    assert_eq!(numbers(bench, "cut")["march"]["complete"], true);
    let names = bench.listing_of("whole");
    assert_eq!(bench.listing_of("cut"), names);
    // Nothing of the way there is left.
    let known =
        ["about.json", "history.csv", "report.html", "shapes.json", "state.bin", "summary.json"];
    let is_known = |name: &&String| {
        known.contains(&name.as_str()) || name.contains(".svg") || name.contains(".png")
    };
    assert!(names.iter().all(|name| is_known(&name)), "{names:?}");
    assert!(names.len() >= known.len() - 1, "{names:?}");
}

#[cfg(unix)]
#[test]
fn a_killed_run_leaves_its_history_and_is_resumed_with_the_same_bytes() {
    let bench = Workbench::new().file("case.toml", &case(MANY, ""));
    begin_and_kill(&bench);
    let history = read(bench.path("cut/history.csv"));
    let rows = history.lines().count() - 2;
    assert!((1000..MANY).contains(&rows), "{rows}");
    // A killed process may leave a torn line, and what is not yet written; all before is whole.
    let columns = history.lines().next().expect("names").split(',').count();
    let whole = history.lines().take(rows + 1);
    assert!(whole.skip(1).all(|line| line.split(',').count() == columns));
    resumes(&bench);
}

/// One speed of a machine that is not round takes seconds: a signal ends it within it, and analyses before it are kept.
#[cfg(unix)]
#[test]
fn an_analysis_is_interrupted_within_a_costly_speed() {
    // The two analyses of the built-in case, as other ones.
    let analyses = "include = \"crank.toml\"\ntitle = \"a crank\"\n[analysis.campbell]\nkind = \"coefficients\"\n\
                    [analysis.response]\nkind = \"modes\"\ncount = 80\n";
    let bench = Workbench::new().file("case.toml", analyses);
    let quick =
        bench.whirl(&["analyse", "case.toml", "campbell", "--out", "quick", "--no-figures"]);
    assert_eq!(quick.status, 0, "{}", quick.stderr);
    for (arguments, words, kept) in [
        (
            &["modes", "case.toml", "--speed", "2000 rpm", "--count", "80", "--out", "one"][..],
            "interrupted before anything was found",
            false,
        ),
        (
            &["analyse", "case.toml", "--out", "both", "--no-figures"],
            "`response` was interrupted before anything was found",
            true,
        ),
    ] {
        let mut running = Running::start(&bench, arguments);
        let mut lines = BufReader::new(running.0.stdout.take().expect("piped")).lines();
        if kept {
            let is_told = |line: &String| line.contains("main2");
            assert!(lines.by_ref().map_while(Result::ok).any(|line| is_told(&line)), "a table");
        }
        std::thread::sleep(Duration::from_millis(1500));
        let start = Instant::now();
        running.signal("TERM");
        let (status, said) = running.end();
        let took = start.elapsed();
        assert!(took < Duration::from_secs(4), "{took:?}: {said}");
        assert_eq!(status, Some(1), "{said}");
        assert!(said.contains(words), "{said}");
        assert_eq!(bench.path("both/campbell.csv").is_file(), kept);
        assert!(!bench.path("both/response.csv").exists());
    }
}

/// Steps that are chosen go on as they were chosen; and the same case twice has the same bytes.
#[cfg(unix)]
#[test]
fn a_killed_run_with_chosen_steps_is_resumed_with_the_same_bytes() {
    let case = case(1, "").replace("steps = 1\n", "duration = \"3 s\"\noutput_step = \"20 us\"\n");
    let case =
        case.replace("time_step = \"1e-5 s\"", "time_step = \"auto\"\nstep_tolerance = 1e-6");
    let bench = Workbench::new().file("case.toml", &case);
    let mut running = begin(&bench, &["run", "case.toml", "--out", "cut"]);
    running.0.kill().expect("it is there");
    assert_eq!(running.end().0, None, "ended by a signal");
    resumes(&bench);
    let facts = &numbers(&bench, "whole")["march"];
    assert!(facts["automatic"]["rejected_steps"].as_u64().expect("a count") > 10, "{facts}");
    let outcome = bench.whirl(&["run", "case.toml", "--out", "again", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let words = "more repeated in halves";
    assert!(outcome.stdout.contains(words), "{}", outcome.stdout);
    let both = ["whole", "again"].map(|folder| read(bench.path(folder).join("history.csv")));
    assert!(both[0] == both[1], "other bytes");
    assert_eq!(numbers(&bench, "whole"), numbers(&bench, "again"));
}

#[cfg(unix)]
#[test]
fn interrupted_runs_end_cleanly_and_are_resumed() {
    for (signal, more) in [("INT", ""), ("TERM", "output_step = \"7e-5 s\"\n")] {
        let bench = Workbench::new().file("case.toml", &case(MANY * 2, more));
        let running = begin(&bench, &["run", "case.toml", "--out", "cut"]);
        // `timeout` signals a process, and its group once more.
        running.signal(signal);
        running.signal(signal);
        let (status, said) = running.end();
        assert_eq!(status, Some(1), "{said}");
        for words in ["interrupted after step", "so far are in cut", "--resume"] {
            assert!(said.contains(words), "`{words}` is not in: {said}");
        }
        let summary = bench.summary("cut");
        assert_eq!(summary["march"]["complete"], false);
        assert_eq!(summary["march"]["converged"], true);
        assert!(summary["error"].as_str().expect("words").contains("interrupted"));
        let every = if more.is_empty() { 1 } else { 7 };
        let steps = summary["march"]["steps"].as_u64().expect("a count") as usize;
        let history = read(bench.path("cut/history.csv"));
        assert!(history.ends_with('\n'));
        assert_eq!(history.lines().count() - 1, steps / every, "all that is done, whole");
        let names = bench.listing_of("cut");
        for file in ["displacement.png", "displacement.svg", "checkpoint.bin", "reactions.png"] {
            assert!(names.iter().any(|name| name == file), "{file} is not in {names:?}");
        }
        resumes(&bench);
    }
}

/// What others do to the results of a run that is at work ends it, and what is said of it is true.
#[cfg(unix)]
#[test]
fn results_that_others_take_away_end_the_run() {
    let empty = |bench: &Workbench| {
        drop(fs::File::create(bench.path("cut/history.csv")).expect("emptied"));
    };
    let remove = |bench: &Workbench| {
        // A checkpoint may come into the folder meanwhile.
        wait_until("no folder", || fs::remove_dir_all(bench.path("cut")).is_ok());
    };
    let harms: [(&dyn Fn(&Workbench), &str); 2] = [
        (&empty, "cannot write `history.csv` after step"),
        (&remove, "it was removed while the run wrote it"),
    ];
    for (harm, words) in harms {
        let bench = Workbench::new().file("case.toml", &case(MANY * 20, ""));
        let running = begin(&bench, &["run", "case.toml", "--out", "cut", "--no-figures"]);
        harm(&bench);
        let (status, said) = running.end();
        assert_eq!(status, Some(1), "{said}");
        assert!(said.contains(words), "`{words}` is not in: {said}");
        for untrue in ["panicked", "are kept in", "--resume"] {
            assert!(!said.contains(untrue), "`{untrue}` is in: {said}");
        }
    }
}

/// No step is waited for while meshes are read and bodies reduced.
#[cfg(unix)]
#[test]
fn a_run_is_interrupted_while_its_bodies_are_reduced() {
    let case = "include = \"hu2003-5.toml\"\ntitle = \"a fine mesh\"\n\
                [support.dimensions]\nlayers_between = 150\n";
    for signal in ["TERM", "INT"] {
        let bench = Workbench::new().file("case.toml", case);
        let running = Running::start(&bench, &["run", "case.toml", "--out", "cut", "--no-cache"]);
        wait_until("a lock", || bench.path("cut/.lock").exists());
        // Handlers are there right after the lock.
        std::thread::sleep(Duration::from_millis(300));
        running.signal(signal);
        let (status, said) = running.end();
        assert_eq!(status, Some(1), "{said}");
        assert!(said.contains("interrupted before the first step"), "{said}");
        assert!(!bench.path("cut").exists(), "nothing is written");
    }
}

#[cfg(unix)]
#[test]
fn a_folder_in_use_is_refused() {
    let bench = Workbench::new().file("case.toml", &case(MANY, ""));
    let running = begin(&bench, &["run", "case.toml", "--out", "cut"]);
    for more in [&["run", "sdnd101"][..], &["run", "case.toml", "--resume"]] {
        let outcome = bench.whirl(&[more, &["--out", "cut"]].concat());
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
        assert!(outcome.stderr.contains("another run is writing"), "{}", outcome.stderr);
        assert!(
            outcome.stderr.contains(&format!("process {}", running.0.id())),
            "{}",
            outcome.stderr
        );
    }
    running.signal("TERM");
    let (status, said) = running.end();
    assert_eq!(status, Some(1), "{said}");
    let outcome = bench.whirl(&["run", "sdnd101", "--out", "cut"]);
    assert_eq!(outcome.status, 0, "it is free again: {}", outcome.stderr);
}

#[test]
fn nothing_of_an_earlier_run_stays_and_bad_input_takes_nothing() {
    let bench = Workbench::new().file("bad.toml", "title = 1\n");
    fs::create_dir(bench.path("out")).expect("a folder");
    // The last one is of a run that was killed as it wrote.
    let old = [
        "rotation.svg",
        "eccentricity.png",
        "checkpoint.bin",
        "summary.json",
        "notes.txt",
        ".whirl-4f2a6c.part",
    ];
    old.iter().for_each(|name| fs::write(bench.path("out").join(name), "old").expect("written"));
    let outcome = bench.whirl(&["run", "bad.toml", "--out", "out"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    let mut all = old.map(String::from).to_vec();
    all.sort();
    assert_eq!(bench.listing_of("out"), all);
    assert_eq!(read(bench.path("out/summary.json")), "old");
    let outcome = bench.whirl(&["run", "sdnd101", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert_eq!(
        bench.listing_of("out"),
        ["about.json", "history.csv", "notes.txt", "report.html", "state.bin", "summary.json",]
    );
}

#[test]
fn a_result_whose_name_a_folder_has_is_refused_at_once() {
    for name in ["history.csv", "summary.json", "reactions.png"] {
        let bench = Workbench::new();
        fs::create_dir_all(bench.path("out").join(name)).expect("a folder");
        let outcome = bench.whirl(&["run", "sdnd101", "--out", "out"]);
        assert_eq!((outcome.status, outcome.stdout.as_str()), (2, ""), "{}", outcome.stderr);
        for words in [name, "a folder has the name of a result", "--out DIR"] {
            assert!(outcome.stderr.contains(words), "`{words}` is not in: {}", outcome.stderr);
        }
        assert_eq!(bench.listing_of("out"), [name]);
    }
}

/// Runs the case where no file may be larger than as many blocks; status, and what it said.
#[cfg(unix)]
fn limited(bench: &Workbench, blocks: usize) -> (Option<i32>, String) {
    let line = format!("ulimit -f {blocks}; exec \"$0\" run case.toml --out cut");
    let mut shell = bench.shell();
    let output = shell.args(["-c", &line, env!("CARGO_BIN_EXE_whirl")]).output().expect("a shell");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

/// A limit on the size of files stands for a disk that is full; it needs no rights.
#[cfg(unix)]
#[test]
fn a_full_disk_keeps_what_fits_and_is_resumed() {
    let bench = Workbench::new().file("case.toml", &case(40_000, ""));
    // Blocks of 512 or 1024 bytes, as the shell has them: some thousands of rows.
    let (status, said) = limited(&bench, 1500);
    assert_eq!(status, Some(1), "{said}");
    for words in ["cannot write `history.csv`", "so far are in cut", "--resume"] {
        assert!(said.contains(words), "`{words}` is not in: {said}");
    }
    let history = read(bench.path("cut/history.csv"));
    assert!(
        history.ends_with('\n') && history.lines().count() > 2000,
        "{}",
        history.lines().count()
    );
    assert_eq!(bench.summary("cut")["march"]["complete"], false);
    resumes(&bench);

    // Space for the numbers, none for a figure.
    let bench = Workbench::new().file("case.toml", &case(20, ""));
    let (status, said) = limited(&bench, 16);
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("cannot write `cut/") && said.contains(".png`"), "{said}");
    assert_eq!(read(bench.path("cut/history.csv")).lines().count(), 21);
    assert_eq!(bench.summary("cut")["march"]["complete"], true);
}

#[test]
fn output_step_thins_the_history_and_changes_nothing_else() {
    let bench = Workbench::new()
        .file("all.toml", &case(2500, ""))
        .file("some.toml", &case(2500, "output_step = \"0.04 ms\"\n"));
    for name in ["all", "some"] {
        let outcome = bench.whirl(&["run", &format!("{name}.toml"), "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    }
    let [all, some] =
        ["all", "some"].map(|name| read(bench.path(&format!("results/{name}/history.csv"))));
    let expected = all.lines().enumerate().filter(|(place, _)| place % 4 == 0);
    assert!(some.lines().eq(expected.map(|(_, line)| line)));
    let [all, some] = ["results/all", "results/some"].map(|folder| numbers(&bench, folder));
    assert_eq!(all["march"], some["march"]);
    assert_eq!(all["energy_balance_j"], some["energy_balance_j"]);

    for (step, words) in [
        ("2.5e-5 s", "2.5 steps of `time_step`"),
        ("5e-6 s", "`output_step = \"1e-5 s\"`"),
        ("1 s", "longer than the run"),
    ] {
        let bench =
            Workbench::new().file("bad.toml", &case(2500, &format!("output_step = \"{step}\"\n")));
        let outcome = bench.whirl(&["run", "bad.toml"]);
        assert_eq!(outcome.status, 2, "{}", outcome.stderr);
        assert!(outcome.stderr.contains(words), "`{words}` is not in: {}", outcome.stderr);
        assert_eq!(bench.listing(), ["bad.toml"]);
    }
}

#[cfg(unix)]
#[test]
fn progress_is_shown_without_a_terminal_unless_it_is_not_wanted() {
    let bench = Workbench::new().file("case.toml", &case(10_000_000, "output_step = \"1 ms\"\n"));
    for (quiet, shown) in [(&[][..], true), (&["--quiet"], false)] {
        let arguments = [&["run", "case.toml", "--no-figures", "--out", "cut"], quiet].concat();
        let mut running = Running::start(&bench, &arguments);
        let mut said = String::new();
        if shown {
            let stderr = running.0.stderr.take().expect("piped");
            let mut lines = BufReader::new(stderr);
            lines.read_line(&mut said).expect("UTF-8");
            running.0.stderr = Some(lines.into_inner());
        } else {
            wait_until("rows", || bench.path("cut/history.csv").exists());
            std::thread::sleep(Duration::from_millis(1500));
        }
        running.signal("TERM");
        let (status, rest) = running.end();
        assert_eq!(status, Some(1), "{said}{rest}");
        assert!(rest.contains("interrupted after step"), "{rest}");
        let lines = said + &rest;
        assert_eq!(lines.contains(" of 10000000 ("), shown, "{lines}");
    }
    let bench = Workbench::new();
    let outcome = bench.whirl(&["run", "sdnd101", "--quiet"]);
    assert_eq!((outcome.status, outcome.stdout.as_str(), outcome.stderr.as_str()), (0, "", ""));
}

#[cfg(unix)]
#[test]
fn a_sweep_is_interrupted_while_its_points_are_read() {
    let vary =
        "title = \"x\"\ncase = \"case.toml\"\n[vary]\nmass.mass = \"1 kg .. 2 kg, 200000\"\n";
    let bench = Workbench::new().file("case.toml", &case(1000, "")).file("masses.toml", vary);
    let running = Running::start(&bench, &["sweep", "masses.toml"]);
    std::thread::sleep(Duration::from_millis(500));
    running.signal("TERM");
    let (status, said) = running.end();
    assert_eq!(status, Some(1), "{said}");
    assert!(said.contains("interrupted while the cases of the points were read"), "{said}");
    assert!(!bench.path("results").exists(), "{:?}", bench.listing());
}
