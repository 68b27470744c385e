//! Bearings whose law reads a sensor apart from where it acts, against state spaces put together here.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, DVector};
use whirl_tests::History;

use crate::analyses::{column, numbers, ran};
use crate::workbench::Workbench;

/// A rotor that tilts, in two magnetic bearings of a housing that tilts on two feet.
const RIGID: &str = include_str!("sensors.toml");
/// Mass, polar and transverse inertia, and z of the centre, of the rotor; of the housing without the polar inertia (kg, kg m², m).
const ROTOR: [f64; 4] = [6.0, 0.012, 0.09, 0.17];
const HOUSING: [f64; 3] = [20.0, 0.6, 0.23];
/// z of the magnets and of the sensors, and of the feet (m), with their stiffness and damping (N/m, N s/m).
const BEARINGS: [[f64; 2]; 2] = [[0.05, 0.02], [0.33, 0.39]];
const FEET: [f64; 2] = [0.0, 0.4];
const FOOT: [f64; 2] = [3e6, 2e3];
/// F_0 (N), s_0 (m), P (1/m), I (1/(m·s)), D (s/m), tau_d, tau_a (s) and leak (1/s) of the law.
const MAGNET: [f64; 2] = [200.0, 0.5e-3];
const GAINS: [f64; 3] = [5e3, 2e4, 5.0];
const LAGS: [f64; 2] = [1e-4, 2e-4];
const LEAK: f64 = 0.2;
const STATES: usize = 14;

/// Rates of x + iy of both bodies, of their tilts, of the rates of all four, and of q, d and c of both bearings, at a speed (rad/s).
fn rates(speed: f64) -> DMatrix<Complex<f64>> {
    let [mass, polar, across, centre] = ROTOR;
    let [carried, tilting, middle] = HOUSING;
    let inertia = [mass, across, carried, tilting];
    // Displacement of the rotor against the housing.
    let relative = |z: f64| [1.0, z - centre, -1.0, middle - z];
    let mut rates = DMatrix::zeros(STATES, STATES);
    let real = |value: f64| Complex::new(value, 0.0);
    let push = |rates: &mut DMatrix<Complex<f64>>, row: [f64; 4], column: usize, force: f64| {
        for (k, (arm, inertia)) in row.iter().zip(inertia).enumerate() {
            rates[(4 + k, column)] += real(arm * force / inertia);
        }
    };
    (0..4).for_each(|k| rates[(k, 4 + k)] = real(1.0));
    rates[(5, 5)] += Complex::new(0.0, speed * polar / across);
    for z in FEET {
        let row = [0.0, 0.0, 1.0, z - middle];
        for (k, arm) in row.iter().enumerate() {
            push(&mut rates, row, k, -FOOT[0] * arm);
            push(&mut rates, row, 4 + k, -FOOT[1] * arm);
        }
    }
    let ([force, gap], [p, i, d], [filter, amplifier]) = (MAGNET, GAINS, LAGS);
    for (bearing, [magnet, sensor]) in BEARINGS.into_iter().enumerate() {
        let (acts, seen, first) = (relative(magnet), relative(sensor), 8 + 3 * bearing);
        for k in 0..4 {
            push(&mut rates, acts, k, 4.0 * force / gap * acts[k]);
            rates[(first, k)] += real(seen[k]);
            rates[(first + 1, k)] += real(seen[k] / filter);
            rates[(first + 2, k)] -= real((p + d / filter) * seen[k] / amplifier);
        }
        push(&mut rates, acts, first + 2, 4.0 * force);
        rates[(first, first)] = real(-LEAK);
        rates[(first + 1, first + 1)] = real(-1.0 / filter);
        rates[(first + 2, first)] = real(-i / amplifier);
        rates[(first + 2, first + 1)] = real(d / filter / amplifier);
        rates[(first + 2, first + 2)] = real(-1.0 / amplifier);
    }
    rates
}

/// λ of a complex matrix, and their conjugates.
fn eigenvalues(rates: &DMatrix<Complex<f64>>) -> Vec<Complex<f64>> {
    let n = rates.nrows();
    let real = DMatrix::from_fn(2 * n, 2 * n, |i, j| {
        let own = rates[(i % n, j % n)];
        match (i < n, j < n) {
            (true, false) => -own.im,
            (false, true) => own.im,
            _ => own.re,
        }
    });
    real.complex_eigenvalues().iter().copied().collect()
}

#[test]
fn modes_with_sensors_beside_magnets_are_those_of_a_state_space() {
    for rpm in [9000.0, -4000.0, 0.0] {
        let bench = Workbench::new().file("case.toml", RIGID);
        let speeds = format!("{rpm} rpm");
        let call = ["modes", "case.toml", "--speeds", &speeds, "--count", "16", "--out", "out"];
        ran(&bench, &[&call[..], &["--no-figures", "--no-report"]].concat());
        let [re, im] =
            ["real_1_s", "imaginary_1_s"].map(|name| numbers(&bench, "out/modes.csv", name));
        let exact = eigenvalues(&rates(rpm / 60.0 * TAU));
        // Eight oscillate with a damping ratio below 0.9.
        assert_eq!(re.len(), 8, "{re:?}");
        for (re, im) in re.into_iter().zip(im) {
            let own = Complex::new(re, im);
            let far = exact.iter().map(|exact| (own - exact).norm()).fold(f64::INFINITY, f64::min);
            assert!(far < 1e-8 * own.norm(), "{rpm} rpm: {own} of {exact:?}");
        }
        let ways = column(&bench, "out/modes.csv", "motion");
        assert!(ways.iter().all(|own| own == "lateral"), "{ways:?}");
    }
}

/// A law of a file with the forces about the centre alone, of which the exact motion is a matrix exponential.
fn linear_law() -> String {
    let ([force, gap], [p, i, d], [filter, amplifier]) = (MAGNET, GAINS, LAGS);
    let mut text = String::from(
        "kind = \"law\"\nname = \"sensed\"\ntitle = \"linear bearing with a sensor\"\nsource = \"this test\"\n",
    );
    for own in ["e_x", "e_y", "y_x", "y_y"] {
        text += &format!("[inputs.{own}]\nunit = \"m\"\nrange = [-3e-4, 3e-4]\n");
    }
    for axis in ["x", "y"] {
        for (state, unit, most) in [("q", "m*s", 2e-5), ("d", "m", 3e-4), ("c", "1", 1.0)] {
            text += &format!(
                "[states.{state}_{axis}]\nunit = \"{unit}\"\nstart = \"rest\"\nrange = [{}, {most}]\n",
                -most
            );
        }
    }
    for (name, unit, value) in [
        ("P", "1/m", p),
        ("I", "1/m/s", i),
        ("D", "s/m", d),
        ("tau_d", "s", filter),
        ("tau_a", "s", amplifier),
        ("leak", "1/s", LEAK),
        ("k", "N/m", 4.0 * force / gap),
        ("k_i", "N", 4.0 * force),
    ] {
        text += &format!("[parameters.{name}]\nvalue = {value}\nunit = \"{unit}\"\n");
    }
    text += "[rates]\n";
    for axis in ["x", "y"] {
        text += &format!(
            "q_{axis} = 'y_{axis} - leak*q_{axis}'\nd_{axis} = '(y_{axis} - d_{axis})/tau_d'\n\
             c_{axis} = '(-(P*y_{axis} + I*q_{axis} + D*(y_{axis} - d_{axis})/tau_d) - c_{axis})/tau_a'\n"
        );
    }
    for axis in ["x", "y"] {
        text += &format!("[outputs.F_{axis}]\nunit = \"N\"\nvalue = 'k*e_{axis} + k_i*c_{axis}'\n");
    }
    text
}

/// From rest under a force that begins at once: the largest distance from the exact motion falls with the square of the step.
#[test]
fn marches_with_sensors_are_of_second_order() {
    let steps = [2e-5, 1e-5, 5e-6];
    let mut errors = Vec::new();
    for step in steps {
        let case =
            RIGID.replace("magnetic-bearing-sensor", "sensed.toml").replace("9000 rpm", "0 rpm");
        let case = format!(
            "{case}\n[loads.push]\nbody = \"rotor\"\nz = \"300 mm\"\nforce = [\"40 N\", \"0 N\", \"0 N\"]\n\
             [march]\ntime_step = \"{step} s\"\nduration = \"20 ms\"\n"
        );
        let bench = Workbench::new().file("case.toml", &case).file("sensed.toml", &linear_law());
        ran(&bench, &["run", "case.toml", "--out", "out", "--no-figures", "--no-report"]);
        let found: History = bench.history("out");
        let rates = rates(0.0).map(|own| own.re);
        let [mass, _, across, centre] = ROTOR;
        let mut load = DVector::zeros(STATES);
        (load[4], load[5]) = (40.0 / mass, 40.0 * (0.3 - centre) / across);
        let held = -rates.clone().lu().solve(&load).expect("a state in which it stands");
        let (times, places) = (found.column("t_s"), found.column("EX_rear_um"));
        let mut far = 0.0_f64;
        for (time, place) in times.iter().zip(places).step_by((1e-3 / step) as usize) {
            let own = &held - (rates.clone() * *time).exp() * &held;
            let z = BEARINGS[1][0];
            let exact = own[0] + (z - centre) * own[1] - own[2] - (z - HOUSING[2]) * own[3];
            far = far.max((1e6 * exact - place).abs());
        }
        errors.push(far);
    }
    let orders: Vec<f64> = errors.windows(2).map(|own| (own[0] / own[1]).log2()).collect();
    assert!(orders.iter().all(|own| (own - 2.0).abs() < 0.1), "{errors:?}");
    assert!(errors[2] < 0.01, "{errors:?}");
}

/// The built-in rotor of sections in magnetic bearings, by laws that read sensors where the magnets are, named by z and by a set.
#[test]
fn a_sensor_at_the_magnets_is_a_bearing_without_one() {
    let bench = Workbench::new();
    let shown = bench.whirl(&["new", "case", "plain", "--like", "magnetic"]);
    assert_eq!(shown.status, 0, "{}", shown.stderr);
    let plain = std::fs::read_to_string(bench.path("plain.toml")).expect("a case");
    let sensed = |front: &str, rear: &str| {
        let text = plain.replace("law = \"magnetic-bearing\"", "law = \"magnetic-bearing-sensor\"");
        [("90 mm", front), ("390 mm", rear)].into_iter().fold(text, |text, (z, sensor)| {
            let side = format!("journal = {{ body = \"rotor\", z = \"{z}\" }}\n");
            text.replace(&side, &format!("{side}sensor = {sensor}\n"))
        })
    };
    let at = [
        ("z.toml", "{ z = \"90 mm\" }", "{ z = \"390 mm\" }"),
        ("set.toml", "{ set = \"FRONT\" }", "{ set = \"REAR\" }"),
    ];
    let bench =
        at.iter().fold(bench, |bench, (name, front, rear)| bench.file(name, &sensed(front, rear)));
    let run = |case: &str| {
        ran(
            &bench,
            &["run", case, "--out", case.trim_end_matches(".toml"), "--no-figures", "--no-report"],
        );
        bench.history(case.trim_end_matches(".toml"))
    };
    let (plain, by_z, by_set) = (run("plain.toml"), run("z.toml"), run("set.toml"));
    for column in ["EX_front_um", "EY_rear_um", "RX_rear_N", "RY_front_N"] {
        let [own, by_z, by_set] = [&plain, &by_z, &by_set].map(|all| all.column(column));
        let largest = own.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
        let far = |other: &[f64]| {
            own.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / largest
        };
        assert!(largest > 0.0 && far(by_z) < 1e-7, "{column}: {}", far(by_z));
        // The mean of the surface from 60 to 120 mm is that of its middle but for what the section bends.
        assert!(far(by_set) > 1e-9 && far(by_set) < 0.05, "{column}: {}", far(by_set));
    }
}

#[test]
fn sensors_that_see_nothing_are_refused() {
    let refused = |case: &str, words: &str| {
        let bench = Workbench::new().file("case.toml", case);
        let outcome = bench.whirl(&["check", "case.toml"]);
        assert_eq!(outcome.status, 2, "{}", outcome.stdout);
        assert!(outcome.stderr.contains(words), "{}", outcome.stderr);
    };
    let front = "sensor = { z = \"20 mm\" }";
    refused(&RIGID.replace(front, ""), "the table `[joint.front.sensor]` is missing");
    refused(&RIGID.replace(front, "sensor = {}"), "the sensor has no place on `rotor`");
    refused(
        &RIGID.replace(front, "sensor = { set = \"A\" }"),
        "`rotor` has no mesh, and no node sets",
    );
    refused(
        &RIGID.replace(front, "sensor = { z = \"20 mm\", set = \"A\" }"),
        "`rotor` has no mesh, and no node sets",
    );
    refused(
        &RIGID.replace(front, "sensor = { z = \"20 mm\", base = \"A\" }"),
        "`housing` has no mesh, and no node sets",
    );
    refused(
        &RIGID.replacen("magnetic-bearing-sensor", "magnetic-bearing", 1),
        "the law of this bearing reads no sensor",
    );
    let grounded = RIGID.replace("bore = { body = \"housing\" }\n", "");
    refused(
        &grounded.replace(front, "sensor = { z = \"20 mm\", base = \"A\" }"),
        "the bore is on the ground, on which this sensor stands, too",
    );
}
