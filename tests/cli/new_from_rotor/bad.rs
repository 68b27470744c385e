//! Files that are no rotors, or rotors that cannot be.

use std::fs;

use super::saved;
use crate::workbench::{Outcome, Workbench};

/// What is said of a file, of which nothing is made.
fn refused(name: &str, text: &str) -> String {
    let bench = Workbench::new().file(name, text);
    let Outcome { status, stdout, stderr } = bench.whirl(&["new", "case", "--from", name]);
    assert_eq!((status, stdout.as_str()), (2, ""), "{name}: {stderr}");
    assert_eq!(bench.listing(), [name], "nothing is written");
    assert!(stderr.contains("help"), "{stderr}");
    stderr
}

/// The example with one text replaced where it stands first behind another one.
fn changed(behind: &str, old: &str, new: &str) -> String {
    let text = saved("example.toml");
    let (before, after) = text.split_once(behind).expect("a place");
    assert!(after.contains(old), "{old}");
    format!("{before}{behind}{}", after.replacen(old, new, 1))
}

#[test]
fn files_that_are_no_rotors_are_told_so() {
    let no_rotor = "is no rotor of ROSS: it has no shaft element";
    for (name, text, wanted) in [
        ("empty.toml", "", no_rotor),
        ("other.toml", "[package]\nname = \"x\"\n", no_rotor),
        ("other.json", "{\"a\": [1, 2]}", no_rotor),
        (
            "case.toml.toml",
            "title = \"x\"\n[body.rotor]\nturns = \"no\"\n",
            "looks like a case of whirl",
        ),
        ("list.json", "[1, 2]", no_rotor),
        ("words.toml", "a rotor", "this is no valid TOML"),
        ("bad.json", "{\"a\": 1,, }", "this is no valid JSON"),
    ] {
        let said = refused(name, text);
        assert!(said.contains(wanted), "{said}");
    }
    let bench = Workbench::new();
    fs::write(bench.path("packed.toml"), b"\x1f\x8b\x08\0\0").expect("written");
    let said = bench.whirl(&["new", "case", "--from", "packed.toml"]).stderr;
    assert!(said.contains("it is no text"), "{said}");
    let said = bench.whirl(&["new", "case", "--from", "missing.toml"]).stderr;
    assert!(said.contains("cannot read `missing.toml`"), "{said}");
    let said = bench.whirl(&["new", "law", "mine", "--from", "packed.toml"]).stderr;
    assert!(said.contains("`--from`, `--shaft` and `--support` are of `whirl new case`"), "{said}");
    let both = ["new", "case", "--from", "a.toml", "--shaft", "b.msh", "--support", "c.msh"];
    assert!(bench.whirl(&both).stderr.contains("cannot be used with"));
}

#[test]
fn what_no_rotor_has_is_shown_where_it_stands() {
    let first = "[\"ShaftElement_Shaft Element 0\"]";
    let third = "[\"ShaftElement_Shaft Element 2\"]";
    let bearing = "[\"BearingElement_Bearing 0\"]";
    for (text, wanted) in [
        (
            changed(first, "L = 0.25", "L = -0.25"),
            "`Shaft Element 0`: `L` = -0.25 is not above zero",
        ),
        (changed(first, "L = 0.25", "L = 0"), "`L` = 0.0 is not above zero"),
        (changed(first, "odl = 0.05", "odl = nan"), "`odl` = NaN is not finite"),
        (changed(first, "idl = 0.0", "idl = -0.01"), "`idl` = -0.01 is negative"),
        (
            changed(first, "idl = 0.0", "idl = 0.06"),
            "its bore of 0.06 m is not smaller than its outer diameter of 0.05 m",
        ),
        (changed(first, "idr = 0.0", "idr = 0.01"), "its bore ends in a point"),
        (changed(first, "L = 0.25", "L = \"250 mm\""), "`L` is no number but \"250 mm\""),
        (changed(first, "L = 0.25\n", ""), "`Shaft Element 0`: `L` is missing"),
        (changed(first, "n = 0", "n = 0.5"), "`n` = 0.5 is no number of a node"),
        (changed(first, "n = 0", "n = -1"), "`n` = -1.0 is negative"),
        (
            changed(first, "E = 211000000000.0", "E = 211.0"),
            "a Young's modulus of 211.0 Pa is that of no solid",
        ),
        (
            changed(first, "rho = 7810.0", "rho = 7.81e6"),
            "a density of 7810000.0 kg/m^3 is that of no solid",
        ),
        (changed(first, "G_s = 81200000000.0", "G_s = 40e9"), "give a Poisson's ratio of 1.6375"),
        (changed(first, "G_s = 81200000000.0\n", ""), "`G_s` is missing"),
        // Two more elements leave no way through the rotor.
        (changed(third, "n = 2", "n = 20"), "no element leads from node"),
        (changed(third, "n = 2", "n = 1"), "overlap between nodes 1 and 2"),
        (
            changed(third, "n = 2\n", "n = 1\nL = 0.3\n").replacen(
                "L = 0.25\nidl = 0.0\nodl = 0.05\nidr = 0.0\nodr = 0.05\nn = 1\nL = 0.3",
                "L = 0.3\nidl = 0.0\nodl = 0.05\nidr = 0.0\nodr = 0.05\nn = 1",
                1,
            ),
            "another element at its node 1 is 0.25 m long",
        ),
        (changed("[\"DiskElement_Disk 0\"]", "n = 2", "n = 99"), "no shaft has a node 99"),
        (changed("[\"DiskElement_Disk 0\"]", "m = 32", "m = -32"), "is negative"),
        (changed(bearing, "n = 0", "n = 99"), "neither a shaft nor a point mass has its node 99"),
        (
            changed(bearing, "kxx = [ 1000000.0,]", "kxx = [ 1.0, 2.0,]"),
            "`kxx` has 2 values for 0 speeds",
        ),
        (changed(bearing, "kxx = [ 1000000.0,]", "kxx = [ inf,]"), "`kxx` = inf is not finite"),
        (changed(bearing, "kxx = [ 1000000.0,]", "kxx = []"), "`kxx` is an empty list"),
    ] {
        let said = refused("rotor.toml", &text);
        assert!(said.contains(wanted), "{wanted}\nin\n{said}");
    }
    // All of what is wrong is told at once, each with its line.
    let text = changed(first, "L = 0.25", "L = -0.25").replace("odl = 0.05", "odl = nan");
    let said = refused("rotor.toml", &text);
    assert_eq!(said.matches("error").count(), 7, "{said}");
    assert!(said.contains("rotor.toml:11:"), "{said}");
}

#[test]
fn lengths_in_other_units_are_noticed() {
    let in_mm =
        saved("example.toml").replace("L = 0.25", "L = 250.0").replace("odl = 0.05", "odl = 50.0");
    let in_mm = in_mm.replace("odr = 0.05", "odr = 50.0");
    let said = refused("rotor.toml", &in_mm);
    assert!(said.contains("is 1500.000000 m long and 50.000000 m in diameter"), "{said}");
    assert!(said.contains("Q_(250, \"mm\")"), "{said}");
}

#[test]
fn files_that_are_cut_off_are_refused() {
    let text = saved("example.toml");
    let bearings = text.find("[\"BearingElement").expect("bearings");
    let said = refused("rotor.toml", &text[..bearings]);
    assert!(said.contains("the rotor has no bearings"), "{said}");
    let said = refused("rotor.toml", &text[..bearings + 40]);
    assert!(said.contains("is missing") || said.contains("no valid TOML"), "{said}");
    let text = saved("supports.json");
    for part in [3, 40, 75, 99] {
        let said = refused("rotor.json", &text[..text.len() * part / 100]);
        assert!(said.contains("this is no valid JSON: the file ends in the middle"), "{said}");
    }
}

/// Whatever a file says, it is a case or refused: nothing panics.
#[test]
fn damaged_files_are_cases_or_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("rotor.toml");
    let text = saved("train.toml");
    let bytes = text.as_bytes();
    // A generator of its own keeps the damages the same everywhere.
    let mut state: u64 = 7;
    let mut next = |below: usize| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let mut refused = 0;
    for _ in 0..400 {
        let mut own = bytes.to_vec();
        match next(4) {
            0 => own.truncate(next(bytes.len())),
            1 => drop(own.splice(next(bytes.len())..bytes.len(), *b"\"")),
            2 => {
                let digits: Vec<usize> =
                    (0..own.len()).filter(|at| own[*at].is_ascii_digit()).collect();
                own[digits[next(digits.len())]] = b"-0e9."[next(5)];
            }
            _ => {
                let lines: Vec<&str> = text.lines().collect();
                let (from, to) = (next(lines.len()), next(lines.len()));
                let mut lines: Vec<&str> = lines.clone();
                lines.swap(from, to);
                own = lines.join("\n").into_bytes();
            }
        }
        fs::write(&file, &own).expect("written");
        refused += usize::from(whirl_cli::case_of_rotor(&file, "case").is_err());
    }
    assert!(refused > 100, "{refused}");
}
