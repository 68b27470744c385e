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
        &["case.toml:5:11", "can still move freely", "turn about an axis along z", "add a spring"],
    );
}

#[test]
fn a_bore_that_carries_no_spline_is_named_in_the_case() {
    let machine = include_str!("../../specs/cases/hu2003.machine.toml");
    let (before, after) = machine.split_once("bore = [").expect("a bore");
    let (_, after) = after.split_once(']').expect("the end of a list");
    let machine = format!("{before}bore = [\"MOUNTS\", \"MOUNTS\", \"MOUNTS\"]{after}");
    let place = format!("m.toml:{}:", before.lines().count() + 1);
    let case = case("").replace("hu2003.machine", "m");
    let bench = Workbench::new().file("case.toml", &case).file("m.toml", &machine);
    let outcome = bench.whirl(&["run", "case.toml"]);
    assert_eq!(outcome.status, 2, "{}", outcome.stderr);
    for words in [place.as_str(), "bearing 1", "give no spline", "at least three"] {
        assert!(outcome.stderr.contains(words), "`{words}` is not in:\n{}", outcome.stderr);
    }
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
    refused(
        &case("side = \"around\"\ngap = \"1 mm\"\nlaw = \"ocvirk\""),
        &["case.toml:4:", "has its gap in its law", "leave `gap` out"],
    );
}

#[test]
fn a_dimension_that_cannot_be_is_named() {
    let bench =
        Workbench::new().file("case.toml", &case("[shaft.dimensions]\nloads = [\"251.3 mm\"]"));
    refused(&bench, &["case.toml:4:9", "loads[0] = 0.2513", "no layer of cells ends there"]);
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
*NSET, NSET=TOP
2
*NSET, NSET=BOTTOM
4
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
                 mounts = \"MOUNTS\"\n[support.dimensions]\nstart = \"0 mm\"\nlength = \"100 mm\"\n\
                 height = \"20 mm\"\nwidth = \"20 mm\"\npedestal_height = \"10 mm\"\n\
                 rings = [\"50 mm\"]\nring_length = \"20 mm\"\nring_thickness = \"10 mm\"\n\
                 bore_radius = \"20 mm\"\nlayers_in_ring = 2\nlayers_between = 2\n\
                 [springs]\nlaw = \"hu2003-linear\"\nnumber = 8\nradial_clearance = \"35 um\"\n\
                 [[bearing]]\njournal = [\"J\", \"TOP\", \"BOTTOM\"]\n\
                 bore = [\"BORE1_LEFT\", \"BORE1_MIDDLE\", \"BORE1_RIGHT\"]\n\
                 [drive]\ntop = \"TOP\"\nbottom = \"BOTTOM\"\ntorque = \"1 N*m\"\n\
                 target_speed = \"100 rpm\"\n[march]\nsteps = 1\ntime_step = \"1e-4 s\"\n\
                 [material.steel]\nyoungs_modulus = \"200 GPa\"\npoissons_ratio = 0.3\n\
                 density = \"7860 kg/m^3\"\n";
    let bench = Workbench::new()
        .file("case.toml", &format!("title = \"upside down\"\n{lines}"))
        .file("shaft.inp", INVERTED);
    refused(&bench, &["shaft.inp:16:1", "cell 2", "turned inside out", "node label"]);
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
fn a_folder_that_cannot_be_written_is_told_before_the_work() {
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
