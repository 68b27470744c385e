//! The built-in rotor under its weight with films in place of the closed form.

use std::fs;

use crate::analyses::{numbers, ran};
use crate::workbench::Workbench;

/// The rotor under its weight, in bearings of this length (mm) with a clearance of a thousandth of the radius: tables have the limit of
/// none, in which shear does not carry.
fn weight(length: f64, law: &str) -> String {
    let case = include_str!("../../specs/cases/weight.toml");
    let short = "law = \"ocvirk\"\nparameters = { mu = \"20 mPa*s\" }";
    assert_eq!((case.matches(short).count(), case.matches("length = \"30 mm\"").count()), (2, 2));
    let case = case.replace("\"150 um\"", "\"30 um\"");
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
        let turns = s * load / (0.02 * 0.06 * 1e-3 * length) * (30e-6_f64 / 0.03).powi(2);
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

/// Beyond the rows of its viscosity nothing is known of an oil: a run says so, and an analysis.
#[test]
fn a_film_beyond_the_rows_of_its_viscosity_is_told() {
    let start = "[start]\nkind = \"equilibrium\"\n";
    let case = warming("5e-4 s", 4, start)
        .replace("vogel = [\"178 K\", \"800 K\"]", "viscosity = \"oil.csv\"")
        .replace("mu_0 = \"30 mPa*s\", ", "");
    let rows = |last: &str| format!("temperature [K], viscosity [mPa*s]\n300, 40\n{last}\n");
    for (oil, words) in [(rows("310, 30"), true), (rows("700, 0.1"), false)] {
        let bench = Workbench::new().file("case.toml", &case).file("oil.csv", &oil);
        let outcome = bench.whirl(&["run", "case.toml", "--out", "out", "--no-figures"]);
        let said = outcome.stdout + &outcome.stderr;
        let what = "temperature of a film beyond the rows of its viscosity";
        assert_eq!(said.contains(what), words, "{oil}: {said}");
        let outcome = bench.whirl(&["modes", "case.toml"]);
        let said = outcome.stdout + &outcome.stderr;
        let what = "the temperature of the film, beyond the rows of its viscosity, ";
        assert_eq!(said.contains(what), words, "{oil}: {said}");
    }
}

/// A whole film pushes nothing aside by its pressure alone: K_xx + K_yy = 0, and the rotor whirls at half its speed at once. As the
/// last of a cavity fills, what was stable is not: a threshold over which the decrement jumps.
#[test]
fn a_film_that_fills_makes_the_rotor_unstable_at_once() {
    let case = |pressure: &str| {
        format!(
            "title = \"a rotor in a film under pressure\"\n[body.rotor]\nturns = \"prescribed\"\nspeed = \"3000 rpm\"\n\
             mass = \"60 kg\"\npolar_inertia = \"0.3 kg*m^2\"\n[joint.b]\nkind = \"bearing\"\njournal = {{ body = \"rotor\" }}\n\
             law = \"reynolds\"\nparameters = {{ mu_0 = \"20 mPa*s\", sigma = \"0.001 um\" }}\nradial_clearance = \"75 um\"\n\
             journal_radius = \"30 mm\"\nlength = \"30 mm\"\n[joint.b.film]\ngrid = [72, 7]\nleft = \"{pressure}\"\n\
             right = \"{pressure}\"\n[loads.w]\nbody = \"rotor\"\nforce = [\"-600 N\", \"0 N\", \"0 N\"]\n"
        )
    };
    let whole = Workbench::new().file("case.toml", &case("100 bar"));
    let speeds = ["--speeds", "1000 rpm .. 3000 rpm, 3", "--out", "out"];
    ran(&whole, &[&["coefficients", "case.toml"][..], &speeds].concat());
    let of = |name: &str| numbers(&whole, "out/coefficients.csv", name);
    for ((xx, yy), xy) in of("k_xx_N_m").iter().zip(of("k_yy_N_m")).zip(of("k_xy_N_m")) {
        assert!((xx + yy).abs() < 1e-5 * xy.abs(), "{xx} {yy} beside {xy}");
    }
    for attitude in of("attitude_deg") {
        assert!((attitude - 90.0).abs() < 1e-4, "{attitude} degrees");
    }
    let said = ran(&whole, &[&["stability", "case.toml"][..], &speeds].concat()).stdout;
    assert!(said.contains("UNSTABLE at all these speeds"), "{said}");
    let fills = Workbench::new().file("case.toml", &case("5 bar"));
    for kind in ["stability", "campbell"] {
        let speeds = ["--speeds", "1200 rpm .. 3000 rpm, 4", "--out", "out", "--no-figures"];
        let said = ran(&fills, &[&[kind, "case.toml"][..], &speeds].concat()).stdout;
        assert!(said.contains("UNSTABLE above "), "{said}");
        assert!(said.contains("its log decrement jumps between"), "{said}");
        assert!(!said.contains("too slow"), "{said}");
    }
}
