//! Loads with sets of their own: what they move of a body with few modes.

use super::matrices::bar_with;
use super::{march, run};
use crate::workbench::Workbench;

/// A cantilever of steel, 20 × 20 × 200 mm, with a force along it and a couple about it on its end, in equilibrium.
fn cantilever(modes: usize, correction: &str) -> String {
    format!(
        r#"title = "x"
[body.beam]
turns = "no"
mesh = "bar.inp"
units = "m, N, kg"
modes = {modes}
damping = "1e-5 s"
held = ["BASE"]
{correction}
[body.beam.sets]
BASE = {{ plane = "0 mm" }}
END = {{ plane = "200 mm" }}
[joint.tip]
kind = "bushing"
first = {{ body = "beam", sets = "LEFT" }}
stiffness = {{ xx = "1e3 N/m", yy = "1e3 N/m" }}
[loads.pull]
body = "beam"
sets = ["END"]
spread = "mean"
force = ["0 N", "0 N", "100 N"]
[loads.twist]
body = "beam"
sets = ["END"]
couple = "10 N*m"
[output.end]
quantity = "displacement"
body = "beam"
set = "END"
components = ["z"]
[output.top]
quantity = "displacement"
body = "beam"
set = "CORNER"
components = ["x", "y"]
[body.beam.sets.CORNER]
point = ["10 mm", "0 mm", "200 mm"]
within = "1 mm"
[start]
kind = "equilibrium"
{}"#,
        march("1e-5 s", 3)
    )
}

/// With five modes, which are all of bending, an axial force and a couple about the axis move the end as the whole mesh yields:
/// F L / (E A), and M L / (G J) with J = a⁴/6 of a square whose two by two cells do not warp.
#[test]
fn few_modes_and_static_answers_move_where_loads_act() {
    let moved = |modes: usize, correction: &str| {
        let done = run(&cantilever(modes, correction), &[("bar.inp", &bar_with(|own| own, 0.0))]);
        [done.last("z_end_um"), done.last("y_top_um")]
    };
    let found = moved(3, "");
    let all = moved(200, "static_correction = false");
    for (found, all) in found.into_iter().zip(all) {
        // A static answer is exact but for the solution's rounding; 200 of 270 modes lack what is stiffest.
        assert!((found / all - 1.0).abs() < 2e-3, "{found} {all}");
    }
    let (e, a, l) = (200e9, 0.02_f64, 0.2);
    let along = 1e6 * 100.0 * l / (e * a * a);
    let twist = 1e6 * 0.01 * 10.0 * l / (e / 2.6 * a.powi(4) / 6.0);
    // The base is held across, too.
    assert!((found[0] / along - 1.0).abs() < 0.03, "{} {along}", found[0]);
    assert!((found[1] / twist - 1.0).abs() < 0.01, "{} {twist}", found[1]);
    let [none, _] = moved(3, "static_correction = false");
    assert!(none.abs() < 1e-6 * along, "{none}");
    // By reciprocity the answers to unit forces at what is asked for move these points as rightly under any load.
    let asked_for = moved(3, "static_correction = [\"outputs\"]");
    for (own, found) in asked_for.into_iter().zip(found) {
        assert!((own / found - 1.0).abs() < 1e-6, "{own} {found}");
    }
    let [listed, _] = moved(3, "static_correction = [\"loads\"]");
    assert_eq!(listed.to_bits(), found[0].to_bits());
}

/// A word that is none of those to which answers are kept is named, with these.
#[test]
fn what_answers_cannot_be_kept_to_is_refused() {
    let bench = Workbench::new()
        .file("bar.inp", &bar_with(|own| own, 0.0))
        .file("case.toml", &cantilever(3, "static_correction = [\"drives\"]"));
    let outcome = bench.whirl(&["check", "case.toml"]);
    assert_eq!(outcome.status, 2);
    let failed = outcome.stderr;
    assert!(failed.contains("`drives` is nothing to which static answers are kept"), "{failed}");
    assert!(failed.contains("name some of `loads`, `outputs`, `bores`"), "{failed}");
}

/// `whirl check` says of each load what a body lacks, without being asked.
#[test]
fn check_says_what_a_body_lacks_under_each_load() {
    let said = |correction: &str| {
        let bench = Workbench::new()
            .file("bar.inp", &bar_with(|own| own, 0.0))
            .file("case.toml", &cantilever(3, correction));
        bench.whirl(&["check", "case.toml"]).stdout
    };
    let (with, without) = (said(""), said("static_correction = false"));
    assert!(with.contains("(retained nodes held): pull 0.00 %, twist 0.00 %"), "{with}");
    assert!(with.contains("body.beam keeps 2 static answers beside 3 modes"), "{with}");
    assert!(!without.contains("static answers beside"), "{without}");
    assert!(without.contains("(retained nodes held): pull 100.00 %, twist 100.00 %"), "{without}");
    assert!(without.contains("remove `static_correction = false` from `[body.beam]`"), "{without}");
    assert!(!with.contains("remove `static_correction"), "{with}");
}

/// Of a load on what a joint retains nothing is lacking, though with it held nothing moves but by rounding.
#[test]
fn a_load_on_what_is_retained_lacks_nothing() {
    let case = cantilever(3, "static_correction = false")
        .replace("sets = [\"END\"]\nspread", "sets = [\"LEFT\"]\nspread");
    let case = case
        .replace("force = [\"0 N\", \"0 N\", \"100 N\"]", "force = [\"100 N\", \"0 N\", \"0 N\"]");
    let bench =
        Workbench::new().file("bar.inp", &bar_with(|own| own, 0.0)).file("case.toml", &case);
    let said = bench.whirl(&["check", "case.toml"]).stdout;
    assert!(said.contains("(retained nodes held): pull 0.00 %, twist 100.00 %"), "{said}");
}
