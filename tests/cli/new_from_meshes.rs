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
        "guessed: housing is held at its lower side, x = -30 mm (FOOT)",
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
    assert!(again.contains("`case.toml` already exists and is left unchanged"), "{again}");
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

/// Tubes about x = 3 mm, y = -2 mm, in mm: inner and outer radius, and z of both ends, with the cards behind them. `rough`:
/// how far every other node of their insides is off its circle.
fn tubes(all: &[[f64; 4]], rough: f64, cards: &str) -> String {
    const AROUND: usize = 24;
    let (mut nodes, mut cells) =
        ("*NODE\n".to_owned(), "*ELEMENT, TYPE=C3D8, ELSET=ALL\n".to_owned());
    let label = |tube: usize, place: [usize; 3]| {
        let [around, out, along] = place;
        1 + around % AROUND + AROUND * (out + 3 * (along + 5 * tube))
    };
    for (tube, [inner, outer, low, high]) in all.iter().enumerate() {
        for along in 0..5 {
            for out in 0..3 {
                for around in 0..AROUND {
                    let (sin, cos) =
                        (std::f64::consts::TAU * around as f64 / AROUND as f64).sin_cos();
                    let off = if out == 0 && around % 2 == 0 { rough } else { 0.0 };
                    let radius = inner + off + (outer - inner) * out as f64 / 2.0;
                    let z = low + (high - low) * along as f64 / 4.0;
                    let own = label(tube, [around, out, along]);
                    nodes +=
                        &format!("{own}, {}, {}, {z}\n", 3.0 + radius * cos, radius * sin - 2.0);
                }
            }
        }
        for along in 0..4 {
            for out in 0..2 {
                for around in 0..AROUND {
                    let corners = [
                        [0, 0, 0],
                        [0, 1, 0],
                        [1, 1, 0],
                        [1, 0, 0],
                        [0, 0, 1],
                        [0, 1, 1],
                        [1, 1, 1],
                        [1, 0, 1],
                    ];
                    let corners = corners
                        .map(|[a, b, c]| label(tube, [around + a, out + b, along + c]).to_string());
                    let own = 1 + around + AROUND * (out + 2 * (along + 4 * tube));
                    cells += &format!("{own}, {}\n", corners.join(", "));
                }
            }
        }
    }
    nodes + &cells + cards
}

/// Steel in mm, N, t, for all cells.
const STEEL: &str = "*MATERIAL, NAME=STEEL\n*ELASTIC\n206000, 0.3\n*DENSITY\n7.85e-9\n*SOLID SECTION, ELSET=ALL, MATERIAL=STEEL\n";

const NEW: [&str; 6] = ["new", "case", "--shaft", "shaft.inp", "--support", "block.inp"];

#[test]
fn axes_materials_and_sets_of_the_meshes_are_used() {
    let feet = "*NSET, NSET=BOLTS, GENERATE\n49, 72, 1\n";
    let bench = Workbench::new()
        .file("shaft.inp", &tubes(&[[5.0, 10.0, 0.0, 60.0]], 0.0, STEEL))
        .file("block.inp", &tubes(&[[10.03, 20.0, 10.0, 40.0]], 0.0, &(STEEL.to_owned() + feet)));
    let outcome = bench.whirl(&NEW);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    assert!(
        outcome.stdout.contains("guessed: block is held at its set BOLTS"),
        "{}",
        outcome.stdout
    );
    assert!(!outcome.stdout.contains("steel"), "{}", outcome.stdout);
    let text = fs::read_to_string(bench.path("case.toml")).expect("a case");
    assert!(text.contains("axis = [\"3 mm\", \"-2 mm\"]") && !text.contains("material"), "{text}");
    let checked = bench.whirl(&["check", "case.toml"]);
    assert_eq!(checked.status, 0, "{}\nin\n{text}", checked.stderr);
    assert!(checked.stdout.contains("c = 30 µm from mesh"), "{}", checked.stdout);
}

#[test]
fn what_is_open_stands_behind_a_hash() {
    // The only ends of the block are those of its bores.
    let all = [[10.03, 20.0, 10.0, 20.0], [12.0, 20.0, 25.0, 35.0], [9.9, 20.0, 40.0, 50.0]];
    let bench = Workbench::new()
        .file("shaft.inp", &tubes(&[[5.0, 10.0, 0.0, 45.0]], 0.0, STEEL))
        .file("block.inp", &tubes(&all[..2], 0.0, STEEL))
        .file("tight.inp", &tubes(&all[2..], 0.0, STEEL));
    let outcome = bench.whirl(&NEW);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    for wanted in [
        "no bearing: JOURNAL_1 (radius 10 mm) in BORE_2 (12 mm) leaves 2 mm, which is much for a bearing",
        "guessed: block is held at its end, z = 35 mm (FOOT)",
    ] {
        assert!(outcome.stdout.contains(wanted), "{wanted}\nin\n{}", outcome.stdout);
    }
    let single = Workbench::new()
        .file("shaft.inp", &tubes(&[[5.0, 10.0, 0.0, 45.0]], 0.0, STEEL))
        .file("block.inp", &tubes(&all[..1], 0.0, STEEL));
    let outcome = single.whirl(&NEW);
    let wanted = "to fill in: `held` of block, the sets at which it is fixed";
    assert!(outcome.stdout.contains(wanted), "{}", outcome.stdout);
    let text = fs::read_to_string(single.path("case.toml")).expect("a case");
    assert!(text.contains("\n# held = [\"SET\"]"), "{text}");
    let tight =
        refused(&bench, &["new", "case", "a", "--shaft", "shaft.inp", "--support", "tight.inp"]);
    let wanted = "JOURNAL_1 (radius 10 mm) in BORE_1 (9.9 mm) is not the smaller one";
    assert!(tight.contains(wanted), "{tight}");
}

#[test]
fn a_rough_bore_is_warned_of() {
    let bench = Workbench::new()
        .file("shaft.inp", &tubes(&[[5.0, 10.0, 0.0, 60.0]], 0.0, STEEL))
        .file("block.inp", &tubes(&[[10.03, 20.0, 10.0, 40.0]], 0.05, STEEL));
    let outcome = bench.whirl(&NEW);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let text = fs::read_to_string(bench.path("case.toml")).expect("a case");
    let held = text.replace("# held = [\"SET\"]", "held = [\"END\"]");
    let end = "[body.block.sets.END]\nplane = \"10 mm\"\n";
    fs::write(bench.path("case.toml"), format!("{held}\n{end}")).expect("written");
    let checked = bench.whirl(&["check", "case.toml"]);
    assert_eq!(checked.status, 0, "{}\nin\n{held}", checked.stderr);
    // 25 µm are less than half of 55 µm, and more than half of 35 µm.
    assert!(!checked.stderr.contains("off their circle"), "{}", checked.stderr);
    assert!(checked.stdout.contains("(out of round by 25"), "{}", checked.stdout);
    let bench = bench.file("block.inp", &tubes(&[[10.01, 20.0, 10.0, 40.0]], 0.05, STEEL));
    let checked = bench.whirl(&["check", "case.toml"]);
    for wanted in [
        "the nodes of the bore of the joint `bearing_1` are up to 0.025",
        "off their circle, and the clearance between the mean radii is 0.035",
    ] {
        assert!(checked.stderr.contains(wanted), "{}", checked.stderr);
    }
}
