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

/// A journal in the middle of a film under no pressure, whose housing takes the heat.
fn warming(step: &str, steps: usize, start: &str) -> String {
    format!(
        r#"title = "a film warms up"
[body.rotor]
turns = "prescribed"
speed = "6000 rpm"
mass = "3 kg"
polar_inertia = "0.01 kg*m^2"
[joint.b]
kind = "bearing"
journal = {{ body = "rotor" }}
law = "jfo"
parameters = {{ mu_0 = "30 mPa*s", sigma = "0.01 um" }}
radial_clearance = "50 um"
journal_radius = "20 mm"
length = "20 mm"
[joint.b.film]
grid = [24, 3]
left = "0 bar"
right = "0 bar"
heat = {{ inlet = "310 K", vogel = ["178 K", "800 K"], housing = "2 W/K", metal = "0.5 J/K" }}
[output.f]
quantity = "film"
joint = "b"
[march]
time_step = "{step}"
steps = {steps}
{start}"#
    )
}

/// (ρ c V + C) dT/dt = 2π μ(T) ω² R³ L/c − G (T − T_h) by Runge and Kutta's method; the film follows it to first order in its steps.
#[test]
fn a_film_warms_up_as_its_heat_balances() {
    let (radius, length, clearance, omega): (f64, f64, f64, f64) =
        (0.02, 0.02, 50e-6, 628.318_530_717_958_6);
    let held = 870.0 * 1950.0 * std::f64::consts::TAU * radius * length * clearance + 0.5;
    let rate = |t: f64| {
        let mu = 0.03 * (800.0 / (t - 178.0) - 800.0 / 132.0).exp();
        let loss = std::f64::consts::TAU * mu * omega * omega * radius.powi(3) * length / clearance;
        (loss - 2.0 * (t - 310.0)) / held
    };
    let mut exact: f64 = 310.0;
    for _ in 0..2000 {
        let h = 0.2 / 2000.0;
        let a = rate(exact);
        let b = rate(exact + 0.5 * h * a);
        let c = rate(exact + 0.5 * h * b);
        let d = rate(exact + h * c);
        exact += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    let found = |step: &str, steps: usize, start: &str| -> f64 {
        let bench = Workbench::new().file("case.toml", &warming(step, steps, start));
        let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--no-figures"]);
        assert!(outcome.status < 2, "{}", outcome.stderr);
        bench.history("out").last("temperature_f_K")
    };
    let errors = [found("5e-4 s", 400, "") - exact, found("2.5e-4 s", 800, "") - exact];
    assert!(exact > 320.0 && errors[1].abs() < 2e-3 * (exact - 310.0), "{errors:?} at {exact}");
    assert!((errors[0] / errors[1] - 2.0).abs() < 0.1, "{errors:?}");
    // In equilibrium nothing warms up any more.
    let mut still: f64 = 330.0;
    for _ in 0..200 {
        still -= rate(still) / ((rate(still + 1e-4) - rate(still - 1e-4)) / 2e-4);
    }
    let start = "[start]\nkind = \"equilibrium\"\n";
    for steps in [1, 50] {
        let found = found("5e-4 s", steps, start);
        assert!((found - still).abs() < 1e-6 * still, "{found} K for {still}");
    }
}

/// An equilibrium is sought from where the journal is in the middle, and no oil passes through an adiabatic film.
#[test]
fn adiabatic_films_are_cooled_by_what_passes_through_them() {
    for (law, ends) in [("reynolds", ""), ("jfo", "left = \"1 bar\"\nright = \"1 bar\"\n")] {
        let case = warming("5e-4 s", 2, "[start]\nkind = \"equilibrium\"\n")
            .replace("\"jfo\"", &format!("{law:?}"))
            .replace("left = \"0 bar\"\nright = \"0 bar\"\n", ends)
            .replace(", housing = \"2 W/K\", metal = \"0.5 J/K\"", "")
            + "[loads.pull]\nbody = \"rotor\"\nforce = [\"0 N\", \"-600 N\", \"0 N\"]\n";
        let bench = Workbench::new().file("case.toml", &case);
        let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--no-figures"]);
        assert!(outcome.status < 2, "{law}: {}", outcome.stderr);
        let history = bench.history("out");
        let last = |name: &str| history.last(name);
        let temperature = last("temperature_f_K");
        assert!(temperature > 311.0 && temperature < 1000.0, "{law}: {temperature} K");
        if law == "reynolds" {
            // What leaves at its ends takes all of the loss away; nothing comes in where there is no pressure.
            let left = -1e-6 * (last("q_left_f_mL_s") + last("q_right_f_mL_s"));
            let taken = 870.0 * 1950.0 * left * (temperature - 310.0);
            let loss = last("loss_f_W");
            assert!((taken / loss - 1.0).abs() < 1e-4, "{taken} of {loss} W");
        }
    }
}

/// In the middle of its bearing nothing passes through a film: what is shown is no temperature that oil lasts.
#[test]
fn a_film_that_nothing_cools_is_not_sound() {
    let case = warming("5e-4 s", 4, "[start]\nkind = \"equilibrium\"\n")
        .replace("\"jfo\"", "\"reynolds\"")
        .replace("left = \"0 bar\"\nright = \"0 bar\"\n", "")
        .replace(", housing = \"2 W/K\", metal = \"0.5 J/K\"", "");
    let bench = Workbench::new().file("case.toml", &case);
    let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--no-figures"]);
    assert_eq!(outcome.status, 0, "{}", outcome.stderr);
    for words in ["temperature of a film", "give `housing`", "joint b"] {
        let said = outcome.stdout.clone() + &outcome.stderr;
        assert!(said.contains(words), "{words}: {said}");
    }
    let outcome = bench.whirl(&["modes", "case.toml"]);
    let said = outcome.stdout + &outcome.stderr;
    assert!(said.contains("the temperature of the film") && said.contains("700 K"), "{said}");
}
