//! A floating ring between a shaft that turns as prescribed and the ground.

use super::{march, run};

/// A ring on a shaft, its films of oil of these viscosities (mPa s).
pub(crate) fn ring(inner: f64, outer: f64, more: &str, march: &str) -> String {
    format!(
        r#"title = "a floating ring between two films"

[body.rotor]
turns = "prescribed"
speed = "9000 rpm"
mass = "0.2 kg"
polar_inertia = "2e-5 kg*m^2"

[body.ring]
turns = "free"
mass = "20 g"
polar_inertia = "1.2e-6 kg*m^2"

[joint.inner]
kind = "bearing"
journal = {{ body = "rotor" }}
bore = {{ body = "ring" }}
law = "ocvirk"
parameters = {{ mu = "{inner} mPa*s" }}
radial_clearance = "20 um"
journal_radius = "6 mm"
length = "6 mm"

[joint.outer]
kind = "bearing"
journal = {{ body = "ring" }}
law = "ocvirk"
parameters = {{ mu = "{outer} mPa*s" }}
radial_clearance = "40 um"
journal_radius = "9 mm"
length = "8 mm"

{more}
{march}"#
    )
}

/// ω_r/ω_s = 1/(1 + (μ_o/μ_i)(L_o/L_i)(R_o/R_i)³(c_i/c_o)), where Petroff's torques balance.
#[test]
fn a_centred_ring_turns_at_petroffs_ratio() {
    for (inner, outer) in [(10.0, 10.0), (25.0, 10.0)] {
        let done = run(&ring(inner, outer, "", &march("1e-4 s", 3000)), &[]);
        let ratio = |row: usize| {
            let [ring, shaft] =
                ["omega_ring_rad_s", "omega_rad_s"].map(|name| done.history.column(name)[row - 1]);
            ring / shaft
        };
        // The torques are linear in the speed, which nears its end as e^-t/τ: three instants give it. (Unloaded films whirl in
        // the end, from rounding on.)
        let [a, b, c] = [1000, 2000, 3000].map(ratio);
        let end = (a * c - b * b) / (a + c - 2.0 * b);
        let exact = 1.0 / (1.0 + outer / inner * (8.0 / 6.0) * 1.5_f64.powi(3) * 0.5);
        assert!((end / exact - 1.0).abs() < 1e-6, "{end} for {exact}");
    }
}

/// Forces on the rotor and on the ring hold the weight, once all is at rest but for turning.
#[test]
fn reactions_carry_the_weight_by_the_names_of_the_joints() {
    let weight = "[loads.weight]\nbody = \"rotor\"\nforce = \"-2 N\"\n";
    let done = run(&ring(10.0, 10.0, weight, &march("1e-4 s", 6000)), &[]);
    for joint in ["inner", "outer"] {
        assert!((done.last(&format!("RX_{joint}_N")) - 2.0).abs() < 1e-3);
        assert!(done.last(&format!("RY_{joint}_N")).abs() < 1e-3);
    }
    // The ring runs in the ground, and the rotor in the ring.
    let between = done.last("X_inner_um") - done.last("X_outer_um");
    assert!((between - done.last("EX_inner_um")).abs() < 1e-6);
    let summary = done.bench.summary("out");
    assert_eq!(summary["supports"][0]["joint"], "inner");
    assert_eq!(summary["supports"][1]["joint"], "outer");
    assert_eq!(summary["counts"]["active"], 5);
}

/// The film between two bodies brakes one as much as it turns the other.
#[test]
fn an_initial_speed_is_that_of_the_first_row() {
    let case = ring(10.0, 10.0, "", &march("1e-6 s", 5));
    let case = case.replace("turns = \"free\"", "turns = \"free\"\ninitial_speed = \"3000 rpm\"");
    let done = run(&case, &[]);
    let speed = done.history.column("omega_ring_rad_s")[0];
    assert!((speed - std::f64::consts::TAU * 50.0).abs() < 0.1, "{speed}");
}

#[test]
fn every_rotation_is_drawn() {
    let bench = crate::workbench::Workbench::new()
        .file("case.toml", &ring(10.0, 10.0, "", &march("1e-4 s", 600)));
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    let text =
        |name: &str| std::fs::read_to_string(bench.path("out").join(name)).expect("a figure");
    let rotation = text("rotation.svg");
    for title in ["Angle of rotation of rotor", "Speed of rotation of ring"] {
        assert!(rotation.contains(title), "{title}");
    }
    assert!(text("reactions.svg").contains(">outer<"));
}

#[test]
fn a_check_says_masses_and_joints() {
    let bench = crate::workbench::Workbench::new()
        .file("case.toml", &ring(10.0, 10.0, "", &march("1e-4 s", 600)));
    let said = bench.whirl(&["check", "case.toml"]).stdout;
    for words in [
        "rotor        0.2",
        "rotor: prescribed, 9000 rpm",
        "0.0000012",
        "5 active coordinates",
        "bearing inner: journal rotor, bore ring, law ocvirk (",
        "bearing outer: journal ring, bore ground, law ocvirk (",
    ] {
        assert!(said.contains(words), "{words}:\n{said}");
    }
}
