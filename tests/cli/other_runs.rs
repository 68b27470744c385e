//! Runs that are not resumed, as the history, the case, the start or a mesh is no longer that of the checkpoint.

use std::fs;

use crate::lost_work::{MANY, Running, begin, case, read, resumes, wait_until};
use crate::workbench::Workbench;

#[test]
fn another_run_is_not_resumed_and_loses_nothing() {
    let bench = Workbench::new().file("case.toml", &case(MANY, "output_step = \"1e-4 s\"\n"));
    let running = Running::start(&bench, &["run", "case.toml", "--out", "cut", "--no-figures"]);
    wait_until("a checkpoint", || bench.path("cut/checkpoint.bin").exists());
    running.signal("TERM");
    assert_eq!(running.end().0, Some(1));
    let before = read(bench.path("cut/history.csv"));
    let bench = bench.file("case.toml", &case(MANY, "output_step = \"2e-4 s\"\n"));
    let outcome = bench.whirl(&["run", "case.toml", "--out", "cut", "--resume"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    for words in ["cannot be resumed", "`case.toml`", "without `--resume`"] {
        assert!(outcome.stderr.contains(words), "`{words}` is not in: {}", outcome.stderr);
    }
    assert_eq!(read(bench.path("cut/history.csv")), before);
    // A history that is not the one of the checkpoint is no better.
    let bench = bench.file("case.toml", &case(MANY, "output_step = \"1e-4 s\"\n"));
    fs::write(bench.path("cut/history.csv"), "t_s\n").expect("it can be written");
    let outcome = bench.whirl(&["run", "case.toml", "--out", "cut", "--resume"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("history.csv"), "{}", outcome.stderr);
    // Nothing to go on from: from the start.
    let bench = bench.file("case.toml", &case(1500, ""));
    let outcome = bench.whirl(&["run", "case.toml", "--out", "new", "--resume", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("no checkpoint in new"), "{}", outcome.stderr);
    assert_eq!(read(bench.path("new/history.csv")).lines().count(), 1501);
}

/// Rows before the checkpoint that are not those that the run wrote: as many, but others.
#[test]
fn a_history_that_was_changed_is_not_resumed() {
    let bench = Workbench::new().file("case.toml", &case(MANY, ""));
    let running = begin(&bench, &["run", "case.toml", "--out", "cut", "--no-figures"]);
    running.signal("TERM");
    assert_eq!(running.end().0, Some(1));
    let before = read(bench.path("cut/history.csv"));
    let (head, rows) = before.split_once('\n').expect("rows");
    let place = rows.find(|c: char| ('1'..='8').contains(&c)).expect("a digit");
    let mut changed = rows.to_owned();
    changed.replace_range(place..place + 1, "9");
    fs::write(bench.path("cut/history.csv"), format!("{head}\n{changed}")).expect("written");
    let outcome = bench.whirl(&["run", "case.toml", "--out", "cut", "--resume"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    assert!(outcome.stderr.contains("changed: rows of `history.csv`"), "{}", outcome.stderr);
    fs::write(bench.path("cut/history.csv"), before).expect("written");
    resumes(&bench);
}

/// The state from which a run begins, and meshes of bodies that are not reduced, are part of what it is.
#[test]
fn a_run_whose_start_or_rigid_mesh_was_changed_is_not_resumed() {
    const CUBE: &str = "*NODE, NSET=ALL\n1, -1, -1, 0\n2, 1, -1, 0\n3, 1, 1, 0\n4, -1, 1, 0\n\
        5, -1, -1, 2\n6, 1, -1, 2\n7, 1, 1, 2\n8, -1, 1, 2\n*ELEMENT, TYPE=C3D8, ELSET=CUBE\n\
        1, 1, 2, 3, 4, 5, 6, 7, 8\n";
    let case = |steps: usize, start: &str| {
        format!(
            "title = \"a cube\"\n{start}[material.steel]\nyoungs_modulus = \"200 GPa\"\n\
             poissons_ratio = 0.3\ndensity = \"7860 kg/m^3\"\n[body.cube]\nturns = \"prescribed\"\n\
             speed = \"3000 rpm\"\nrigid = true\nmesh = \"cube.inp\"\nunits = \"cm, N, t\"\nmaterial = \"steel\"\n\
             [joint.mount]\nkind = \"bushing\"\nfirst = {{ body = \"cube\", sets = [\"ALL\"] }}\n\
             stiffness = {{ xx = \"1e5 N/m\", yy = \"1e5 N/m\" }}\n\
             tilting_stiffness = {{ xx = \"10 N*m/rad\", yy = \"10 N*m/rad\" }}\n\
             [loads.push]\nbody = \"cube\"\nsets = [\"ALL\"]\nforce = \"1 N\"\n\
             [march]\ntime_step = \"1e-4 s\"\nsteps = {steps}\n"
        )
    };
    let bench = Workbench::new()
        .file("cube.inp", CUBE)
        .file("first.toml", &case(40, ""))
        .file("other.toml", &case(60, ""))
        .file("case.toml", &case(MANY, "start = { from = \"first\" }\n"));
    for name in ["first", "other"] {
        let outcome = bench.whirl(&["run", &format!("{name}.toml"), "--out", name, "--no-figures"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    }
    let running = begin(&bench, &["run", "case.toml", "--out", "cut", "--no-figures"]);
    running.signal("TERM");
    let (status, said) = running.end();
    assert_eq!(status, Some(1), "{said}");
    let refused = |words: &str| {
        let outcome = bench.whirl(&["run", "case.toml", "--out", "cut", "--resume"]);
        assert_eq!(outcome.status, 2, "{}", outcome.stderr);
        assert!(outcome.stderr.contains(words), "`{words}` is not in: {}", outcome.stderr);
    };
    let first = fs::read(bench.path("first/state.bin")).expect("a state");
    fs::copy(bench.path("other/state.bin"), bench.path("first/state.bin")).expect("copied");
    refused("changed: the state in `first`");
    fs::write(bench.path("first/state.bin"), first).expect("written");
    // The same lengths in all but one direction.
    fs::write(bench.path("cube.inp"), CUBE.replace("1, 2\n", "1, 3\n")).expect("written");
    refused("changed: what the body `cube` is made of");
    fs::write(bench.path("cube.inp"), CUBE).expect("written");
    let outcome = bench.whirl(&["run", "case.toml", "--out", "cut", "--resume", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
}
