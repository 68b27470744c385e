//! The built-in rotor under its weight with films in place of the closed form.

use std::fs;

use crate::workbench::Workbench;

/// The rotor under its weight, in bearings of this length (mm).
fn weight(length: f64, law: &str) -> String {
    let case = include_str!("../../specs/cases/weight.toml");
    let short = "law = \"ocvirk\"\nparameters = { mu = \"20 mPa*s\" }";
    assert_eq!((case.matches(short).count(), case.matches("length = \"30 mm\"").count()), (2, 2));
    case.replace(short, law).replace("length = \"30 mm\"", &format!("length = \"{length} mm\""))
}

/// Raimondi and Boyd, recomputed: length (mm) of bearings of 60 mm, ε, S.
const RAIMONDI_BOYD: [[f64; 3]; 4] = [
    [30.0, 0.4, 0.7853979240635097],
    [30.0, 0.6, 0.31930519865348933],
    [15.0, 0.6, 1.07786789363327],
    [15.0, 0.8, 0.26337181148126376],
];

/// The closed form takes a bearing for short: at half its diameter it carries 15 % too much at ε 0.4 and 28 % at 0.6, at a quarter 8 %.
#[test]
fn the_rotor_under_its_weight_sinks_deeper_into_films_than_into_short_bearings() {
    for [length, eps, s] in RAIMONDI_BOYD {
        // S = μ N D L/W (R/c)².
        let load = 30.0 * 9.81;
        let turns = s * load / (0.02 * 0.06 * 1e-3 * length) * (150e-6_f64 / 0.03).powi(2);
        let ratio = |law: &str| -> f64 {
            let bench = Workbench::new().file("case.toml", &weight(length, law));
            let speed = format!("{} rpm", 60.0 * turns);
            let arguments = ["coefficients", "case.toml", "--speeds", &speed, "--out", "out"];
            let outcome = bench.whirl(&arguments);
            assert_eq!(outcome.status, 0, "{}", outcome.stderr);
            let text = fs::read_to_string(bench.path("out/coefficients.csv")).expect("a table");
            let row = text.lines().nth(1).expect("a row");
            row.split(',').nth(2).expect("a ratio").parse().expect("a number")
        };
        let film = ratio(
            "law = \"reynolds\"\nparameters = { mu_0 = \"20 mPa*s\", sigma = \"0.01 um\" }\nfilm.grid = [96, 9]",
        );
        let short = ratio("law = \"ocvirk\"\nparameters = { mu = \"20 mPa*s\" }");
        let what = format!("{length} mm, {eps}: {film} {short}");
        assert!((film - eps).abs() < 6e-3, "{what}");
        // W c²/(μ ω R L³) of the closed form.
        let number = |eps: f64| {
            let square = eps * eps;
            let root = (std::f64::consts::PI.powi(2) * (1.0 - square) + 16.0 * square).sqrt();
            eps / (4.0 * (1.0 - square).powi(2)) * root
        };
        let own = 1.0 / (std::f64::consts::PI * s) * (30.0 / length).powi(2);
        assert!((number(short) / own - 1.0).abs() < 1e-3, "{what}");
        let more = number(eps) / own;
        assert!(short < film && more > 1.07 && more < 1.3, "{more} {what}");
    }
}
