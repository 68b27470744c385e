//! What bores of reduced bodies lack of the compliance of their meshes, and the correction of it.

use crate::workbench::Workbench;

const MACHINE: &str = include_str!("bodies/surfaces.toml");

const JOINTS: &str = r#"
[joint.left]
kind = "bearing"
journal = { body = "rotor", sets = ["JOURNAL1_LEFT", "JOURNAL1_MIDDLE", "JOURNAL1_RIGHT"] }
bore = { body = "block", sets = ["BORE1_LEFT", "BORE1_MIDDLE", "BORE1_RIGHT"] }
law = "gap-linear"
springs = 24
radial_clearance = "50 um"

[joint.right]
kind = "bearing"
journal = { body = "rotor", sets = ["JOURNAL2_LEFT", "JOURNAL2_MIDDLE", "JOURNAL2_RIGHT"] }
bore = { body = "block", sets = ["BORE2_LEFT", "BORE2_MIDDLE", "BORE2_RIGHT"] }
law = "gap-linear"
springs = 24
radial_clearance = "50 um"
"#;

/// Percentages of the line of a joint.
fn lacking(said: &str, joint: &str) -> Vec<f64> {
    let table = said.split_once("n = 4").expect("the table").1;
    let line = table.lines().find(|line| line.starts_with(joint)).expect("a line of it");
    let cells = line.split_whitespace().filter_map(|cell| cell.parse().ok());
    cells.collect()
}

#[test]
fn a_check_says_what_modes_lack_and_the_correction_brings_it() {
    let modes = "modes = 60\n";
    let corrected = MACHINE.replace(modes, "modes = 60\nstatic_correction = true\n");
    let bench = Workbench::new()
        .file("few.toml", &format!("{MACHINE}{JOINTS}"))
        .file("corrected.toml", &format!("{corrected}{JOINTS}"));
    let said = |case: &str| {
        let outcome = bench.whirl(&["check", case, "--contacts"]);
        assert_eq!(outcome.status, 0, "{}", outcome.stderr);
        outcome.stdout
    };
    let (few, all) = (said("few.toml"), said("corrected.toml"));
    for joint in ["left", "right"] {
        let (few, all) = (lacking(&few, joint), lacking(&all, joint));
        assert_eq!((few.len(), all.len()), (5, 5));
        assert!(few[2..].iter().all(|part| *part > 5.0), "{few:?}");
        assert!(all.iter().all(|part| *part == 0.0), "{all:?}");
    }
    assert!(few.contains("`static_correction = true` in `[body.block]`"), "{few}");
    assert!(!all.contains("`static_correction = true`"), "{all}");
    assert!(!bench.whirl(&["check", "few.toml"]).stdout.contains("n = 4"));
}

#[test]
fn a_body_without_bores_has_nothing_to_correct() {
    let case = MACHINE.replace("modes = 20\n", "modes = 20\nstatic_correction = true\n");
    let bench = Workbench::new().file("case.toml", &format!("{case}{JOINTS}"));
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 2);
    let said = "`static_correction` keeps the answers to loads on bores, and the shaft made from its dimensions has none";
    assert!(outcome.stderr.contains(said), "{}", outcome.stderr);
}
