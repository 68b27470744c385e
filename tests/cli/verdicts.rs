//! Whether the results of a run can be believed, and whether it is steady.

use std::fs;

use crate::workbench::{SHORT, Workbench};

#[test]
fn shipped_masses_are_sound() {
    for case in ["sdnd101", "sdnd108", "annular-rub"] {
        let bench = Workbench::new();
        let outcome = bench.whirl(&["run", case, "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let verdict = &bench.summary(&format!("results/{case}"))["verdict"];
        assert_eq!(verdict["sound"], true, "{case}: {verdict}");
    }
}

/// The case of `steps` of a mass between two stops of 1e9 N/m at 50 mm.
fn between_stops(time_step: &str) -> String {
    let stop = |side: &str| {
        format!("[[stop]]\nside = \"{side}\"\ngap = \"50 mm\"\nlaw = \"stiff.toml\"\n")
    };
    format!(
        "title = \"a mass between stops\"\n[mass]\nmass = \"1 kg\"\nvelocity = \"-1 m/s\"\nforce = \"-10 N\"\n\
         {}{}[march]\ntime_step = \"{time_step}\"\nduration = \"0.2 s\"\n",
        stop("above"),
        stop("below")
    )
}

const STIFF: &str = "kind = \"law\"\nname = \"stiff\"\ntitle = \"A stiff stop\"\nsource = \"a test\"\n\
     [inputs.h]\nunit = \"mm\"\nrange = [-0.1, 1]\n[parameters.k]\nvalue = 1e9\nunit = \"N/m\"\n\
     [outputs.Q]\nunit = \"N\"\npieces = [{ when = 'h < 0', value = '-k*h' }, { value = '0' }]\n";

#[test]
fn a_stop_that_the_step_does_not_resolve_is_reported_with_a_remedy_that_serves() {
    let bench =
        Workbench::new().file("stiff.toml", STIFF).file("case.toml", &between_stops("1e-3 s"));
    let outcome = bench.whirl(&["run", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("verdict: NOT SOUND"), "{}", outcome.stdout);
    let verdict = &bench.summary("results/case")["verdict"];
    assert_eq!(verdict["sound"], false);
    let found = &verdict["findings"][0];
    let number = |key: &str| found[key].as_f64().expect("a number");
    assert!(number("value") > number("limit"), "{found}");
    assert!(found["what"].as_str().expect("a text").contains("energy"), "{found}");
    let svg = fs::read_to_string(bench.path("results/case/displacement.svg")).expect("a figure");
    assert!(svg.contains("NOT SOUND"));
    // The step that the remedy names.
    let remedy = found["remedy"].as_str().expect("a text");
    let step = remedy.split('"').nth(1).expect("a step");
    let bench = bench.file("case.toml", &between_stops(step));
    let outcome = bench.whirl(&["run", "case.toml"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stdout.contains("verdict: sound"), "{}", outcome.stdout);
    assert_eq!(bench.summary("results/case")["verdict"]["sound"], true);
    let svg = fs::read_to_string(bench.path("results/case/displacement.svg")).expect("a figure");
    assert!(!svg.contains("NOT SOUND"));
}

/// A cycle that never ends twice, by its own frequency or by the shortness of the steps, is not searched for: of its
/// forces, which would take terabytes, none are kept.
#[test]
fn a_run_shorter_than_two_cycles_is_not_checked_for_a_steady_state() {
    let mass = "title = \"a long cycle\"\n[mass]\nmass = \"1 kg\"\nstiffness = \"1e4 N/m\"\nforce = \"1 N\"\n\
                [[stop]]\nside = \"above\"\ngap = \"0.1 mm\"\nlaw = \"gap-linear-1e6\"\n\
                [march]\ntime_step = \"1e-4 s\"\nsteps = 20\ncycle_frequency = \"1e-9 Hz\"\n";
    let short = SHORT.replace("[march]", "[march]\ntime_step = \"1e-9 s\"");
    let bench = Workbench::new().file("mass.toml", mass).file("short.toml", &short);
    for name in ["mass", "short"] {
        let file = format!("{name}.toml");
        let outcome = bench.whirl(&["run", &file, "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        let words = "for a steady state: the run is shorter than two cycles";
        assert!(outcome.stdout.contains(words), "{}", outcome.stdout);
        let steady = &bench.summary(&format!("results/{name}"))["steady_state"];
        assert_eq!((&steady["checked"], &steady["reached"]), (&false.into(), &false.into()));
        let checked = bench.whirl(&["check", &file]).stdout;
        assert!(checked.contains("shorter than two cycles"), "{checked}");
    }
    // Two cycles can be compared.
    let two = mass.replace("1e-9 Hz", "1000 Hz").replace("steps = 20\n", "steps = 200\n");
    let two = two.replace("1e-4 s", "1e-5 s");
    let bench = bench.file("two.toml", &two);
    let outcome = bench.whirl(&["run", "two.toml", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert_eq!(bench.summary("results/two")["steady_state"]["checked"], true);
}
