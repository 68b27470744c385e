//! Machines that cannot be: sets, meshes, mounts, folders; each refused as any other bad input.

use std::fs;

use crate::bad_input::{case, refused};
use crate::workbench::Workbench;

#[test]
fn a_missing_set_names_the_nearest() {
    let bench = Workbench::new()
        .file("case.toml", &case("[support]\nmounts = \"MOUTNS\"\n[drive]\ntop = \"DRIVE_TPO\""));
    refused(
        &bench,
        &[
            "case.toml:4:11",
            "no node set `MOUTNS`",
            "did you mean `MOUNTS`?",
            "case.toml:6:8",
            "did you mean `DRIVE_TOP`?",
        ],
    );
}

#[test]
fn mounts_that_leave_a_mechanism_name_its_motion() {
    let bench = Workbench::new()
        .file("case.toml", &case("[support]\nground_spring = []\nmounts = \"MOUNTS\""));
    refused(
        &bench,
        &[
            "case.toml:5:11",
            "can still move freely",
            "turn about an axis along z",
            "add a spring `[[",
        ],
    );
}

/// The three mounts stand at one angle. Each of the rings that they stand for is reported, no other.
#[test]
fn a_bore_that_carries_no_spline_is_named_in_the_case() {
    let machine = include_str!("../../specs/cases/hu2003.machine.toml");
    let (before, after) = machine.split_once("bore = [").expect("a bore");
    let (_, after) = after.split_once(']').expect("the end of a list");
    let case = case("").replace("hu2003.machine", "m");
    let line = before.lines().count() + 1;
    let [left, middle, right] = ["LEFT", "MIDDLE", "RIGHT"].map(|ring| format!("BORE1_{ring}"));
    for (rings, wrong) in [
        ([left.as_str(), "MOUNTS", &right], &["middle"][..]),
        (["MOUNTS", &middle, "MOUNTS"], &["left", "right"]),
    ] {
        let machine = format!("{before}bore = {rings:?}{after}");
        let bench = Workbench::new().file("case.toml", &case).file("m.toml", &machine);
        let outcome = bench.whirl(&["run", "case.toml"]);
        assert_eq!(outcome.status, 2, "{}", outcome.stderr);
        assert_eq!(outcome.stderr.matches("error[").count(), wrong.len(), "{}", outcome.stderr);
        let text = format!("bore = {rings:?}");
        for (place, ring) in ["left", "middle", "right"].iter().enumerate() {
            let before: usize = rings[..place].iter().map(|set| set.len() + 4).sum();
            let column = "bore = [\"".len() + before + 1;
            assert!(text[column - 1..].starts_with(rings[place]), "{text}: {column}");
            let words = [
                format!("m.toml:{line}:{column}\n"),
                format!("bearing 1: the bore's 3 nodes on the {ring} must be at different angles"),
            ];
            let expected = wrong.contains(ring);
            for words in &words {
                assert_eq!(
                    outcome.stderr.contains(words),
                    expected,
                    "{words}:\n{}",
                    outcome.stderr
                );
            }
        }
    }
}

#[test]
fn sets_are_looked_for_in_a_machine_that_is_whole() {
    let machine = include_str!("../../specs/cases/hu2003.machine.toml");
    let machine = machine.replacen("JOURNAL1_LEFT", "JOURNAL1_LEFFT", 1);
    let machine = machine.replacen("BORE3_RIGHT", "BORE3_RIHGT", 1);
    let tables = |text: &str| -> Vec<String> {
        let heads = text.match_indices("\n[").map(|(start, _)| start + 1);
        let starts: Vec<usize> = heads.chain([text.len()]).collect();
        starts.windows(2).map(|ends| text[ends[0]..ends[1]].to_string()).collect()
    };
    let (journal, bore) = ("did you mean `JOURNAL1_LEFT`?", "did you mean `BORE3_RIGHT`?");
    for (head, missing, found) in [
        ("[drive]", "the table `[drive]` is missing", &[][..]),
        ("[shaft", "the table `[shaft]` is missing", &[]),
        ("[[support.", "", &[journal, bore]),
        ("[support", "the table `[support]` is missing", &[]),
        ("[springs]", "`law` is missing in `[bearing]`", &[]),
        ("march", "`steps` must be at least 1, not 0", &[journal, bore]),
    ] {
        let kept = tables(&machine).into_iter().filter(|table| !table.starts_with(head));
        let kept: String =
            kept.filter(|table| !(head == "[support" && table.contains("[[support"))).collect();
        let mut case = case("").replace("hu2003.machine", "m");
        if head == "march" {
            case = case.replace("steps = 3", "steps = 0");
        }
        let bench = Workbench::new().file("case.toml", &case).file("m.toml", &kept);
        let mut words = found.to_vec();
        words.push(missing);
        refused(&bench, &words);
        let said = bench.whirl(&["check", "case.toml"]).stderr;
        let count = if head == "[springs]" { 3 } else { usize::from(!missing.is_empty()) };
        assert_eq!(said.matches("error[").count(), found.len() + count, "{head}: {said}");
    }
}

#[test]
fn a_bad_law_is_reported_once_however_often_it_is_named() {
    let law = include_str!("messages/bad.law.toml");
    let lines = "[springs]\nlaw = \"bad.law.toml\"\n[figures]\nlaws = [\"bad.law.toml\"]";
    let machine = include_str!("../../specs/cases/hu2003.machine.toml");
    let machine = machine.replace("[[bearing]]\n", "[[bearing]]\nlaw = \"bad.law.toml\"\n");
    assert!(machine.matches("bad.law.toml").count() > 1);
    let bench = Workbench::new()
        .file("case.toml", &case(lines).replace("hu2003.machine", "m"))
        .file("m.toml", &machine)
        .file("bad.law.toml", law);
    refused(&bench, &["unknown name `stifness`"]);
    let said = bench.whirl(&["check", "case.toml"]).stderr;
    assert_eq!(said.matches("error[").count(), 1, "{said}");
}

#[test]
fn a_stop_takes_the_law_of_its_side() {
    let stop = |lines: &str| {
        format!(
            "title = \"a stop\"\n[mass]\nmass = \"1 kg\"\n[[stop]]\n{lines}\n\
             [march]\ntime_step = \"1e-4 s\"\nsteps = 2\n"
        )
    };
    let case = |lines: &str| Workbench::new().file("case.toml", &stop(lines));
    refused(
        &case("side = \"above\"\ngap = \"1 mm\"\nlaw = \"ocvirk\""),
        &["case.toml:7:8", "`ocvirk` is a law of a ring", "side = \"around\""],
    );
    refused(
        &case("side = \"around\"\nlaw = \"gap-linear\""),
        &["case.toml:6:8", "`gap-linear` is a law of a spring", "F_x and F_y"],
    );
    // A law that does not say which of its parameters is the gap.
    let ring = include_str!("../../specs/cases/annular-rub.law.toml");
    let silent = ring.replace("bearing = \"radial_clearance\"\n", "");
    assert_ne!(silent, ring);
    refused(
        &case("side = \"around\"\ngap = \"1 mm\"\nlaw = \"ring.toml\"").file("ring.toml", &silent),
        &["case.toml:6:7", "no `gap` of its own", "leave `gap` out", "radial_clearance"],
    );
}

#[test]
fn a_dimension_that_cannot_be_is_named() {
    let bench =
        Workbench::new().file("case.toml", &case("[shaft.dimensions]\nloads = [\"251.3 mm\"]"));
    refused(
        &bench,
        &[
            "case.toml:4:10",
            "`loads[0] = 251.3 mm` has no node",
            "no layer of cells ends there",
            "250 mm",
        ],
    );
}

/// Two cubes on top of each other, the second one listed upside down.
const INVERTED: &str = "*NODE, NSET=Nall
1, 0, 0, 0
2, 1, 0, 0
3, 1, 1, 0
4, 0, 1, 0
5, 0, 0, 1
6, 1, 0, 1
7, 1, 1, 1
8, 0, 1, 1
9, 0, 0, 2
10, 1, 0, 2
11, 1, 1, 2
12, 0, 1, 2
*ELEMENT, TYPE=C3D8I, ELSET=E
1, 1, 2, 3, 4, 5, 6, 7, 8
2, 9, 10, 11, 12, 5, 6, 7, 8
*NSET, NSET=J
1
*NSET, NSET=MIDDLE
5
*NSET, NSET=END
9
*NSET, NSET=TOP
2
*MATERIAL, NAME=STEEL
*ELASTIC
2e11, 0.3
*DENSITY
7860
*SOLID SECTION, ELSET=E, MATERIAL=STEEL
";

#[test]
fn an_inverted_element_is_named_with_its_line() {
    let lines = "[shaft]\nmesh = \"shaft.inp\"\nmodes = 1\n\
                 axial_restraint = \"J\"\n[support]\nmaterial = \"steel\"\nmodes = 1\n\
                 mounts = \"MOUNTS\"\n[support.dimensions]\nstart = \"0 mm\"\nlength = \"2 m\"\n\
                 height = \"200 mm\"\nwidth = \"200 mm\"\npedestal_height = \"100 mm\"\n\
                 rings = [\"1 m\"]\nring_length = \"2 m\"\nring_thickness = \"100 mm\"\n\
                 bore_radius = \"800 mm\"\nlayers_in_ring = 20\nlayers_between = 2\n\
                 [springs]\nlaw = \"hu2003-linear\"\nnumber = 8\nradial_clearance = \"35 um\"\n\
                 [[bearing]]\njournal = [\"J\", \"MIDDLE\", \"END\"]\n\
                 bore = [\"BORE1_LEFT\", \"BORE1_MIDDLE\", \"BORE1_RIGHT\"]\n\
                 [drive]\ntop = \"TOP\"\nbottom = \"J\"\ntorque = \"1 N*m\"\n\
                 target_speed = \"100 rpm\"\n[march]\nsteps = 1\ntime_step = \"1e-4 s\"\n\
                 [material.steel]\nyoungs_modulus = \"200 GPa\"\npoissons_ratio = 0.3\n\
                 density = \"7860 kg/m^3\"\n";
    let bench = Workbench::new()
        .file("case.toml", &format!("title = \"upside down\"\n{lines}"))
        .file("shaft.inp", INVERTED);
    refused(&bench, &["shaft.inp:16:1", "cell 2", "inverted", "node label"]);
}

#[test]
fn an_error_in_a_mesh_file_has_its_line() {
    let bench = Workbench::new()
        .file(
            "case.toml",
            &case("[support]\nmesh = \"support.inp\"\n").replace("hu2003.machine", "m"),
        )
        .file("support.inp", "*NODE\n1, 0, 0, zero\n");
    let machine = include_str!("../../specs/cases/hu2003.machine.toml");
    let start = machine.find("[support.dimensions]").expect("a table");
    let end = machine.find("[[support.ground_spring]]").expect("a table");
    let bench = bench.file("m.toml", &format!("{}{}", &machine[..start], &machine[end..]));
    refused(&bench, &["support.inp:2:", "zero"]);
}

#[test]
fn a_folder_that_cannot_be_written_is_reported_before_the_work() {
    let bench = Workbench::new().file("case.toml", &case("")).file("taken", "");
    let before = bench.listing();
    for folder in ["taken", "taken/inside"] {
        let outcome = bench.whirl(&["run", "case.toml", "--out", folder]);
        assert_eq!(outcome.status, 2, "{}", outcome.stderr);
        assert!(outcome.stderr.contains("cannot write `taken"), "{}", outcome.stderr);
        assert!(outcome.stderr.contains("--out DIR"), "{}", outcome.stderr);
        assert_eq!(bench.listing(), before);
    }
    assert_eq!(fs::read_to_string(bench.path("taken")).expect("a file"), "");
}
