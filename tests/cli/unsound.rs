//! What does not deserve trust says so, in every way in which a run can end; and what is there is not lost by
//! asking to go on with it.

use std::fs;

use crate::workbench::Workbench;

/// A mass between stops, with a part to be added.
fn case(time_step: &str, steps: usize, law: &str, more: &str) -> String {
    format!(
        "title = \"a mass between stops\"\n[mass]\nmass = \"1 kg\"\nvelocity = \"1 m/s\"\n{more}\n\
         [[stop]]\nside = \"above\"\ngap = \"1 mm\"\nlaw = \"{law}\"\n\
         [[stop]]\nside = \"below\"\ngap = \"2 mm\"\nlaw = \"{law}\"\n\
         [march]\ntime_step = \"{time_step}\"\nsteps = {steps}\n"
    )
}

fn verdict(bench: &Workbench) -> serde_json::Value {
    let text = fs::read_to_string(bench.path("out/summary.json")).expect("a summary");
    let summary: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    summary["verdict"].clone()
}

#[test]
fn quiet_runs_still_say_that_they_are_not_sound() {
    let bench = Workbench::new().file("case.toml", &case("5e-3 s", 100, "gap-linear-1e6", ""));
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--quiet", "--no-figures"]);
    assert_eq!((outcome.status, outcome.stdout.as_str()), (0, ""), "{}", outcome.stderr);
    for words in ["NOT SOUND", "(at stop ", "remedy: set `time_step"] {
        assert!(outcome.stderr.contains(words), "`{words}` is not in: {}", outcome.stderr);
    }
    let bench = bench.file("case.toml", &case("1e-5 s", 100, "gap-linear-1e6", ""));
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--quiet", "--no-figures"]);
    assert_eq!((outcome.stdout.as_str(), outcome.stderr.as_str()), ("", ""));
    assert_eq!(verdict(&bench)["sound"], true);
}

/// √(h/1 mm) has no value beyond the gap.
const NO_NUMBER: &str = "kind = \"law\"\nname = \"root\"\ntitle = \"root of the gap\"\nsource = \"none\"\n\
    [inputs.h]\nunit = \"mm\"\ntitle = \"clearance\"\nrange = [0.1, 3]\n\
    [parameters.k]\nvalue = 1\nunit = \"N\"\ntitle = \"force\"\n\
    [parameters.h_1]\nvalue = 1\nunit = \"mm\"\ntitle = \"one\"\n\
    [outputs.Q]\nunit = \"N\"\ntitle = \"normal force\"\nvalue = 'k*sqrt(h/h_1)'\n";

#[test]
fn a_run_that_diverges_is_not_sound() {
    let bench = Workbench::new()
        .file("case.toml", &case("1e-4 s", 100, "root.law.toml", ""))
        .file("root.law.toml", NO_NUMBER);
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 1, "{}", outcome.stderr);
    let verdict = verdict(&bench);
    assert_eq!(verdict["sound"], false, "{verdict}");
    let found = &verdict["findings"][0];
    assert_eq!(found["limit"], 100.0, "{found}");
    assert!(found["what"].as_str().expect("words").contains("does not converge"), "{found}");
}

#[test]
fn a_run_that_is_over_is_not_begun_again_by_resuming_it() {
    let bench = Workbench::new().file("case.toml", &case("1e-5 s", 2000, "gap-linear-1e6", ""));
    assert_eq!(bench.whirl(&["run", "case.toml", "--out", "out", "--no-figures"]).status, 0);
    let read = || fs::read(bench.path("out/history.csv")).expect("a history");
    let before = read();
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--resume"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    for words in ["`out` cannot be resumed", "came to its end", "without `--resume`"] {
        assert!(outcome.stderr.contains(words), "`{words}` is not in: {}", outcome.stderr);
    }
    assert!(read() == before);
    // A point that nobody can read is no reason to throw the history away either.
    fs::write(bench.path("out/checkpoint.bin"), b"no such thing").expect("it can be written");
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--resume"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("`checkpoint.bin` is damaged"), "{}", outcome.stderr);
    assert!(read() == before);
    assert!(bench.path("out/summary.json").exists());
}

#[test]
fn turning_faster_than_the_steps_show_is_refused_whatever_the_cycle_is() {
    let unbalance = "unbalance = { eccentricity = \"1 mm\", speed = \"62831.853 rad/s\" }";
    let text = case("1e-4 s", 5000, "gap-linear-1e6", unbalance) + "cycle_frequency = \"10 Hz\"\n";
    let bench = Workbench::new().file("case.toml", &text);
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("a revolution of the unbalance"), "{}", outcome.stderr);
}
