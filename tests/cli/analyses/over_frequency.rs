//! Bushings whose table is over speed and frequency: against closed forms, equations with states, and tables over the speed.

use std::f64::consts::TAU;
use std::fmt::Write;

use num_complex::Complex64;

use super::{column, numbers, ran};
use crate::workbench::Workbench;

/// k_xx, k_xy, k_yx, k_yy, c_xx, c_xy, c_yx, c_yy.
type Row = [f64; 8];

const HEAD: &str = "k_xx [N/m],k_xy [N/m],k_yx [N/m],k_yy [N/m],c_xx [N*s/m],c_xy [N*s/m],c_yx [N*s/m],c_yy [N*s/m]";

/// A file over speeds and frequencies (rad/s).
fn grid(speeds: &[f64], frequencies: &[f64], of: &dyn Fn(f64, f64) -> Row) -> String {
    let mut text = format!("speed [rad/s],frequency [rad/s],{HEAD}\n");
    for (speed, frequency) in
        speeds.iter().flat_map(|speed| frequencies.iter().map(move |own| (*speed, *own)))
    {
        let row = of(speed, frequency).map(|own| format!("{own:?}")).join(",");
        writeln!(text, "{speed:?},{frequency:?},{row}").expect("text can be written");
    }
    text
}

/// A file over speeds (rad/s).
fn over_speed(speeds: &[f64], of: &dyn Fn(f64) -> Row) -> String {
    let mut text = format!("speed [rad/s],{HEAD}\n");
    for speed in speeds {
        let row = of(*speed).map(|own| format!("{own:?}")).join(",");
        writeln!(text, "{speed:?},{row}").expect("text can be written");
    }
    text
}

/// Alike all round: k, k_c across, c.
fn round(k: f64, across: f64, c: f64) -> Row {
    [k, across, -across, k, c, 0.0, 0.0, c]
}

/// Even steps.
fn steps(from: f64, to: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| from + (to - from) * k as f64 / (count - 1) as f64).collect()
}

const MASS: f64 = 10.0;

/// A rigid mass in a seal.
const CASE: &str = r#"title = "a mass in a seal"
[body.rotor]
turns = "prescribed"
speed = "1000 rad/s"
mass = "10 kg"
polar_inertia = "1e-3 kg*m^2"
[body.rotor.unbalance.one]
mass = "1 g"
radius = "10 mm"
angle = "0 deg"
[joint.seal]
kind = "bushing"
first = { body = "rotor" }
table = "seal.csv"
"#;

/// A spring beside a spring with a dashpot in series (Maxwell's element), and a small dashpot.
const STIFF: f64 = 4e5;
const SERIES: f64 = 6e5;
const TIME: f64 = 4e-3;
const DASHPOT: f64 = 5.0;
/// Stiffness across by the speed (N·s/m).
const ACROSS: f64 = 40.0;

fn maxwell(speed: f64, frequency: f64) -> Row {
    let x = (frequency * TIME).powi(2);
    let k = STIFF + SERIES * x / (1.0 + x);
    round(k, ACROSS * speed, DASHPOT + SERIES * TIME / (1.0 + x))
}

/// λ of the modes of a case at one speed (rad/s), and how they whirl.
fn modes(workbench: &Workbench, case: &str, speed: f64) -> Vec<(Complex64, String)> {
    let speeds = format!("{speed:?} rad/s");
    ran(workbench, &["modes", case, "--speeds", &speeds, "--out", "modes", "--no-figures"]);
    let of = |name: &str| numbers(workbench, "modes/modes.csv", name);
    let values = of("real_1_s").into_iter().zip(of("imaginary_1_s"));
    let values = values.map(|(re, im)| Complex64::new(re, im));
    values.zip(column(workbench, "modes/modes.csv", "whirl")).collect()
}

/// λ of m λ² + λ (c) + k − i s k_c with Im λ = s ν, s = 1 forward.
fn circling(row: Row, sense: f64) -> Complex64 {
    let [k, across, _, _, c, ..] = row;
    let i = Complex64::i();
    let root = (Complex64::from(c * c) - 4.0 * MASS * (k - i * sense * across)).sqrt();
    let roots = [root, -root].map(|root| (root - c) / (2.0 * MASS));
    let wanted = roots.into_iter().max_by(|a, b| (sense * a.im).total_cmp(&(sense * b.im)));
    wanted.expect("two")
}

/// Where the element neither grows nor dies out its coefficients at that frequency are exact, as are those of a response: the
/// equations with a state more, m z̈ + c ż + k z + κ (z − w) − i k_c z = 0, T ẇ = z − w, z = x + iy.
#[test]
fn a_maxwell_element_has_the_threshold_and_the_response_of_its_state() {
    // The whirl at the threshold is at a row, so that nothing lies between rows.
    let whirl = {
        let off = |own: f64| maxwell(0.0, own)[0] - MASS * own * own;
        let (mut low, mut high) = (100.0, 400.0);
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if off(middle) > 0.0 { low = middle } else { high = middle }
        }
        low
    };
    let mut rows = steps(0.0, 1000.0, 41);
    rows.push(whirl);
    rows.extend([333.0, 444.0]);
    rows.sort_by(f64::total_cmp);
    let speeds = steps(0.0, 24_000.0, 4);
    let workbench =
        Workbench::new().file("case.toml", CASE).file("seal.csv", &grid(&speeds, &rows, &maxwell));
    let threshold = whirl * maxwell(0.0, whirl)[4] / ACROSS;
    let range = "5000 rad/s .. 10000 rad/s, 5";
    ran(&workbench, &["campbell", "case.toml", "--speeds", range, "--out", "out", "--no-figures"]);
    let what = column(&workbench, "out/campbell.critical.csv", "what");
    let place = what.iter().position(|own| own == "unstable above").expect("a threshold");
    let of = |name: &str| numbers(&workbench, "out/campbell.critical.csv", name)[place];
    let [speed, found] = [of("speed_rpm") / 60.0, of("frequency_hz")].map(|own| TAU * own);
    // With the state: λ = iν is an eigenvalue of it there.
    let lambda = Complex64::new(0.0, found);
    let state = SERIES * (1.0 - 1.0 / (1.0 + lambda * TIME));
    let left =
        MASS * lambda * lambda + DASHPOT * lambda + STIFF + state - Complex64::i() * ACROSS * speed;
    assert!(left.norm() < 1e-7 * STIFF, "{left}");
    assert!((speed / threshold - 1.0).abs() < 1e-8, "{speed} {threshold}");
    assert!((found / whirl - 1.0).abs() < 1e-8, "{found} {whirl}");
    // The response at rows.
    let range = "333 rad/s .. 444 rad/s, 2";
    ran(&workbench, &["response", "case.toml", "--speeds", range, "--out", "out", "--no-figures"]);
    let amplitudes = numbers(&workbench, "out/response.csv", "major_um");
    for (speed, found) in [333.0_f64, 444.0].into_iter().zip(amplitudes) {
        let lambda = Complex64::new(0.0, speed);
        let state = SERIES * (1.0 - 1.0 / (1.0 + lambda * TIME));
        let dynamic = MASS * lambda * lambda + DASHPOT * lambda + STIFF + state
            - Complex64::i() * ACROSS * speed;
        let known = 1e6 * 1e-5 * speed * speed / dynamic.norm();
        assert!((found / known - 1.0).abs() < 1e-9, "{speed}: {found} {known}");
    }
}

/// Coefficients on straight lines, which the cubics meet: every λ solves the equation with those of its own frequency.
#[test]
fn every_mode_has_the_coefficients_of_its_own_frequency() {
    let line =
        |speed: f64, own: f64| round(6e5 + 900.0 * own, 3e4 + 10.0 * speed, 900.0 - 0.8 * own);
    let file = grid(&steps(0.0, 2000.0, 5), &steps(0.0, 900.0, 7), &line);
    let workbench = Workbench::new().file("case.toml", CASE).file("seal.csv", &file);
    for speed in [0.0, 300.0, 1000.0, 1777.0] {
        let found = modes(&workbench, "case.toml", speed);
        assert_eq!(found.len(), 2, "{speed}");
        for sense in [1.0, -1.0] {
            let mut known = Complex64::new(0.0, 250.0);
            for _ in 0..200 {
                known = circling(line(speed, known.im.abs()), sense);
            }
            known.im = known.im.abs();
            let apart = |own: &Complex64| (own - known).norm() / known.norm();
            let nearest = found.iter().map(|own| apart(&own.0)).fold(1.0, f64::min);
            assert!(nearest < 1e-9, "{speed}, {sense}: {nearest:e} {found:?}");
        }
        if speed > 0.0 {
            let mut whirls: Vec<&str> = found.iter().map(|own| own.1.as_str()).collect();
            whirls.sort_unstable();
            assert_eq!(whirls, ["backward", "forward"], "{speed}");
        }
    }
}

/// Stiffness that rises so steeply that one mass has three frequencies along x: each is found, and once.
#[test]
fn modes_that_come_by_the_frequency_are_found() {
    // √(k/m) = 150 up to 200 rad/s, 350 from 300 on: beside both the frequency where it passes.
    let (rows, values) = ([0.0, 200.0, 300.0, 900.0], [150.0, 150.0, 350.0, 350.0]);
    let k = |own: f64| {
        let place = rows.iter().position(|row| *row == own).expect("a row");
        MASS * f64::powi(values[place], 2)
    };
    let of = |_, own: f64| [k(own), 0.0, 0.0, 9e6, 0.0, 0.0, 0.0, 0.0];
    let file = grid(&[0.0, 2000.0], &rows, &of);
    let workbench = Workbench::new().file("case.toml", CASE).file("seal.csv", &file);
    let found = modes(&workbench, "case.toml", 1000.0);
    let hertz: Vec<f64> = found.iter().map(|own| own.0.im).collect();
    let [first, middle, last, across] = hertz[..] else { panic!("{hertz:?}") };
    assert!((first / 150.0 - 1.0).abs() < 1e-10, "{hertz:?}");
    assert!((last / 350.0 - 1.0).abs() < 1e-10, "{hertz:?}");
    assert!((across / 9e5_f64.sqrt() - 1.0).abs() < 1e-10, "{hertz:?}");
    // Level at both ends, the cubic of k is t²(3 − 2t) of the step.
    let t = (middle - 200.0) / 100.0;
    let k = MASS
        * (150.0_f64.powi(2) + (350.0_f64.powi(2) - 150.0_f64.powi(2)) * t * t * (3.0 - 2.0 * t));
    assert!((MASS * middle * middle / k - 1.0).abs() < 1e-9, "{hertz:?}");
}

/// A file whose values do not depend on the frequency, written in several ways, has the modes of one over the speed alone.
#[test]
fn a_table_without_dependence_is_one_over_the_speed() {
    let speeds = steps(0.0, 300.0, 4);
    let of = |speed: f64| {
        let own = [4.4e5 + 200.0 * speed, 3e4 + speed, -2e4 - speed, 4.6e5 - speed * speed];
        [own[0], own[1], own[2], own[3], 300.0 - 0.5 * speed, 20.0, 15.0, 250.0 + 0.1 * speed]
    };
    let base = include_str!("damped-bearings.toml");
    let (rotor, _) = base.split_once("[joint.left]").expect("joints");
    let case = |left: &str| {
        format!(
            "{rotor}[joint.left]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", sets = \"LEFT\" }}\ntable = \"{left}\"\n\
             [joint.right]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", sets = \"RIGHT\" }}\ntable = \"{left}\"\n"
        )
    };
    // Columns and rows in another order, semicolons, a byte order mark, comments, Hz and rpm.
    let mut other = String::from("\u{feff}# of a program\n# two lines\n");
    other.push_str("frequency [Hz];c_xx [N*s/m];c_xy [N*s/m];c_yx [N*s/m];c_yy [N*s/m];k_xx [kN/m];k_xy [N/m];k_yx [N/m];k_yy [N/m];speed [rad/s]\n");
    for frequency in [80.0, 0.0, 20.0] {
        for speed in speeds.iter().rev() {
            let [a, b, c, d, e, f, g, h] = of(*speed);
            writeln!(
                other,
                "{frequency};{e};{f};{g};{h};{:?};{b};{c};{d};{speed:?} # row",
                1e-3 * a
            )
            .expect("text can be written");
        }
    }
    let mut ratio = format!("speed [rad/s],frequency_ratio [1],{HEAD}\n");
    for (speed, own) in speeds.iter().flat_map(|speed| [0.0, 0.5, 1.5].map(|own| (*speed, own))) {
        let row = of(speed).map(|own| format!("{own:?}")).join(",");
        writeln!(ratio, "{speed:?},{own},{row}").expect("text can be written");
    }
    let workbench = Workbench::new()
        .file("speed.csv", &over_speed(&speeds, &of))
        .file("grid.csv", &grid(&speeds, &[0.0, 100.0, 400.0], &|speed, _| of(speed)))
        .file("other.csv", &other)
        .file("ratio.csv", &ratio);
    let names = ["speed", "grid", "other", "ratio"];
    let workbench = names.into_iter().fold(workbench, |bench, name| {
        bench.file(&format!("{name}.toml"), &case(&format!("{name}.csv")))
    });
    for speed in [0.0, 137.0, 300.0] {
        let known = modes(&workbench, "speed.toml", speed);
        assert_eq!(known.len(), 10, "{speed}");
        for name in &names[1..] {
            let found = modes(&workbench, &format!("{name}.toml"), speed);
            assert_eq!(found.len(), known.len(), "{name}, {speed}");
            for (own, known) in found.iter().zip(&known) {
                let apart = (own.0 - known.0).norm() / known.0.norm();
                assert!(apart < 1e-10, "{name}, {speed}: {own:?} {known:?} {apart:e}");
                assert_eq!(own.1, known.1, "{name}, {speed}");
            }
        }
    }
}

/// Two spools of analyses on one file: what goes over speeds follows the modes of single speeds, in a machine that is large
/// enough for a basis of slow motions.
#[test]
fn modes_over_speeds_are_those_at_each_speed() {
    let of = |speed: f64, own: f64| {
        let k = 4e5 * (1.0 + 0.5 * (own / 500.0).tanh());
        [k, 50.0 * speed, -50.0 * speed, 1.1 * k, 300.0 / (1.0 + own / 400.0), 0.0, 0.0, 200.0]
    };
    let base = include_str!("damped-bearings.toml");
    let (rotor, _) = base.split_once("[joint.left]").expect("joints");
    let case = format!(
        "{rotor}[joint.left]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", sets = \"LEFT\" }}\ntable = \"seal.csv\"\n\
         [joint.right]\nkind = \"bushing\"\nfirst = {{ body = \"rotor\", sets = \"RIGHT\" }}\ntable = \"seal.csv\"\n"
    );
    let file = grid(&steps(0.0, 400.0, 5), &steps(0.0, 800.0, 9), &of);
    let workbench = Workbench::new().file("case.toml", &case).file("seal.csv", &file);
    let range = "40 rad/s .. 360 rad/s, 9";
    ran(
        &workbench,
        &[
            "campbell",
            "case.toml",
            "--speeds",
            range,
            "--count",
            "6",
            "--out",
            "out",
            "--no-figures",
        ],
    );
    let of = |name: &str| numbers(&workbench, "out/campbell.csv", name);
    let rows: Vec<(f64, Complex64)> = of("speed_rpm")
        .into_iter()
        .zip(of("real_1_s").into_iter().zip(of("imaginary_1_s")))
        .map(|(rpm, (re, im))| (rpm * TAU / 60.0, Complex64::new(re, im)))
        .collect();
    let mut compared = 0;
    for speed in [40.0, 200.0, 360.0] {
        for (own, _) in modes(&workbench, "case.toml", speed).iter().take(6) {
            let same = rows.iter().filter(|row| (row.0 - speed).abs() < 1e-6);
            let apart = same.map(|row| (row.1 - own).norm() / own.norm()).fold(1.0, f64::min);
            assert!(apart < 2e-6, "{speed}: {own} {apart:e}");
            compared += 1;
        }
    }
    assert_eq!(compared, 18);
}

/// Matrices and coefficients are those at the frequency of the rotation, with a note, and read back as a table over the speed;
/// a march refuses the file where the case names it.
#[test]
fn what_has_no_frequency_has_that_of_the_rotation_or_is_refused() {
    let speeds = steps(0.0, 1000.0, 5);
    let file = grid(&speeds, &speeds, &maxwell);
    let march = "[march]\ntime_step = \"1e-5 s\"\nsteps = 10\n";
    let workbench = Workbench::new()
        .file("case.toml", CASE)
        .file("seal.csv", &file)
        .file("run.toml", &format!("{CASE}{march}"))
        .file("back.toml", &CASE.replace("seal.csv", "out/coefficients.seal.csv"));
    let range = "0 rad/s .. 1000 rad/s, 5";
    let said = ran(&workbench, &["coefficients", "case.toml", "--speeds", range, "--out", "out"]);
    assert!(said.stdout.contains("depend on the frequency"), "{}", said.stdout);
    let found = numbers(&workbench, "out/coefficients.csv", "k_xx_N_m");
    for (own, speed) in found.iter().zip(&speeds) {
        assert!((own / maxwell(*speed, *speed)[0] - 1.0).abs() < 1e-12, "{speed}: {own}");
    }
    let known = circling(maxwell(750.0, 750.0), 1.0);
    let back = modes(&workbench, "back.toml", 750.0);
    let nearest = back.iter().map(|own| (own.0 - known).norm() / known.norm()).fold(1.0, f64::min);
    assert!(nearest < 1e-9, "{back:?} {known}");
    let said = ran(&workbench, &["matrices", "case.toml", "--out", "out"]);
    assert!(said.stdout.contains("depend on the frequency"), "{}", said.stdout);
    let refused = workbench.whirl(&["run", "run.toml"]);
    assert_eq!(refused.status, 2, "{}", refused.stderr);
    for part in ["`seal` depend on the frequency", "run.toml:14", "whirl coefficients"] {
        assert!(refused.stderr.contains(part), "{}", refused.stderr);
    }
    assert!(!workbench.path("results").exists());
    let modes = ran(&workbench, &["modes", "run.toml", "--out", "out"]);
    assert!(!modes.stdout.contains("beyond"), "{}", modes.stdout);
}
