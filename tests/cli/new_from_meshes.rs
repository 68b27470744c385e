//! `whirl new case --shaft FILE --support FILE`: a case from two meshes.

use std::fs;

use crate::own_mesh::bench;
use crate::workbench::{Outcome, Workbench};

/// A command that is refused.
fn refused(bench: &Workbench, arguments: &[&str]) -> String {
    let before = bench.listing();
    let Outcome { status, stdout, stderr } = bench.whirl(arguments);
    assert_eq!((status, stdout.as_str()), (2, ""), "{stderr}");
    assert_eq!(bench.listing(), before, "nothing is written");
    stderr
}

#[test]
fn a_case_of_two_meshes_is_checked_and_runs() {
    let bench = bench();
    let outcome = bench.whirl(&["new", "case", "--shaft", "rotor.msh", "--support", "housing.msh"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    for wanted in [
        "case.toml\n",
        "bearing_1: JOURNAL_1 of rotor (radius 10 mm) in BORE_1 of housing (10.05 mm), z 0 to 20 mm",
        "bearing_2: JOURNAL_5 of rotor (radius 10 mm) in BORE_2 of housing (10.05 mm), z 80 to 100 mm",
        "guessed: rotor.msh is in \"mm, N, t\", by its size",
        "guessed: housing is of steel, where its mesh has no material",
        "guessed: housing is held at its end, z = -5 mm (FOOT)",
        "whirl check case.toml",
    ] {
        assert!(outcome.stdout.contains(wanted), "{wanted}\nin\n{}", outcome.stdout);
    }
    let text = fs::read_to_string(bench.path("case.toml")).expect("a case");
    let checked = bench.whirl(&["check", "case.toml"]);
    assert_eq!(checked.status, 0, "{}\nin\n{text}", checked.stderr);
    assert!(checked.stdout.contains("c = 50 µm from mesh"), "{}", checked.stdout);
    fs::write(bench.path("short.toml"), text.replace("\"0.2 s\"", "\"0.03 s\"")).expect("written");
    let run = bench.whirl(&["run", "short.toml", "--no-figures", "--out", "out"]);
    assert_eq!(run.status, 0, "{}", run.stderr);
    assert!(run.stdout.contains("verdict: sound"), "{}", run.stdout);
    // Weight along -x stands on both bearings.
    let history = bench.history("out");
    assert!(history.column("RX_bearing_1_N").iter().any(|force| *force > 1.0));
    // What is there stays as it is.
    let again =
        refused(&bench, &["new", "case", "--shaft", "rotor.msh", "--support", "housing.msh"]);
    assert!(again.contains("`case.toml` is there already and is left as it is"), "{again}");
    assert_eq!(fs::read_to_string(bench.path("case.toml")).expect("a case"), text);
}

#[test]
fn meshes_are_named_from_another_folder() {
    let bench = bench();
    let arguments = ["--shaft", "rotor.msh", "--support", "housing.msh", "--dir", "cases/a"];
    let outcome = bench.whirl(&[&["new", "case", "pump"], arguments.as_slice()].concat());
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let text = fs::read_to_string(bench.path("cases/a/pump.toml")).expect("a case");
    assert!(text.contains("mesh = \"../../rotor.msh\""), "{text}");
    let checked = bench.whirl(&["check", "cases/a/pump.toml"]);
    assert_eq!(checked.status, 0, "{}", checked.stderr);
}

#[test]
fn meshes_that_do_not_meet_make_no_case() {
    let bench = bench();
    let new = |more: &[&str]| refused(&bench, &[&["new", "case"], more].concat());
    let text = new(&["--shaft", "rotor.msh", "--support", "rotor.msh", "--dir", "deep/down"]);
    assert!(
        text.contains("no journal of `rotor.msh` meets a bore of `rotor.msh`, which has no bores"),
        "{text}"
    );
    let text = new(&["--shaft", "rotor.msh", "--support", "missing.msh"]);
    assert!(text.contains("cannot read `missing.msh`"), "{text}");
    let text = new(&["--shaft", "rotor.msh"]);
    assert!(text.contains("--support"), "{text}");
    let text = new(&["--shaft", "rotor.msh", "--support", "housing.msh", "--units", "mm"]);
    assert!(text.contains("are 1 unit") || text.contains("not three"), "{text}");
    let text = refused(
        &bench,
        &["new", "law", "mine", "--shaft", "rotor.msh", "--support", "housing.msh"],
    );
    assert!(text.contains("`--shaft` and `--support` are of `whirl new case`"), "{text}");
    let text = refused(&bench, &["new", "law"]);
    assert!(text.contains("NAME"), "{text}");
}
