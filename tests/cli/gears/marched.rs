//! Marches against a Runge–Kutta integration of the equations.

use std::f64::consts::TAU;

use super::train::{PLAIN, RADII, RATIO, SIZE, Train};
use crate::analyses::ran;
use crate::workbench::Workbench;

/// Coordinates at the end of a march: angles (rad), displacements (m).
fn marched(train: &Train, couples: [f64; 2], step: &str, steps: usize) -> [f64; SIZE] {
    let march = format!("[march]\ntime_step = \"{step}\"\nsteps = {steps}\n");
    let bench = Workbench::new().file("case.toml", &train.case(couples, &march));
    ran(&bench, &["run", "case.toml", "--no-figures", "--out", "out"]);
    let history = bench.history("out");
    let last = |name: &str| history.last(name);
    [
        last("theta_rad"),
        last("theta_pinion_rad"),
        last("theta_wheel_rad"),
        last("theta_load_rad"),
        1e-6 * last("X_pinion_um"),
        1e-6 * last("Y_pinion_um"),
        1e-6 * last("X_wheel_um"),
        1e-6 * last("Y_wheel_um"),
    ]
}

/// Differences of two ends over the sizes of their kinds: angles less those of uniform turns, displacements.
fn apart(train: &Train, found: &[f64; SIZE], exact: &[f64; SIZE], t: f64) -> f64 {
    let speed = train.speed * TAU / 60.0 * t;
    let turned = [speed, speed, RATIO * speed, RATIO * speed];
    let angles = (0..4).map(|i| (exact[i] - turned[i]).abs()).fold(0.0, f64::max);
    let sides = (4..8).map(|i| exact[i].abs()).fold(0.0, f64::max);
    let sizes = [angles, angles, angles, angles, sides, sides, sides, sides];
    (0..SIZE).map(|i| (found[i] - exact[i]).abs() / sizes[i]).fold(0.0, f64::max)
}

/// Frames turn by many revolutions, while the equations in space are linear. The trapezoidal rule is of second order.
#[test]
fn a_march_is_the_solution_of_the_equations() {
    for train in [
        Train { turn: 90.0, ..PLAIN },
        Train { turn: -25.0, pressure: -20.0, damping: 2000.0, speed: -1200.0, ..PLAIN },
    ] {
        let couples = [100.0, 150.0];
        let exact = train.integrated(couples, 1e-6, 20_000);
        let errors = [("1e-5 s", 2000), ("5e-6 s", 4000)].map(|(step, steps)| {
            apart(&train, &marched(&train, couples, step, steps), &exact, 0.02)
        });
        assert!(errors[1] < 0.02, "{errors:?}");
        let ratio = errors[0] / errors[1];
        assert!((3.0..5.0).contains(&ratio), "{errors:?}");
    }
}

/// Teeth part and meet on both flanks; each has its own line of action.
#[test]
fn backlash_is_that_of_the_equations() {
    let train = Train { backlash: Some(20.0), damping: 500.0, turn: 60.0, ..PLAIN };
    // The couple of the load turns about: flanks change.
    for couples in [[100.0, 200.0], [-60.0, 400.0], [0.0, -100.0]] {
        let exact = train.integrated(couples, 1e-6, 8000);
        let errors = [("4e-6 s", 2000), ("2e-6 s", 4000)].map(|(step, steps)| {
            apart(&train, &marched(&train, couples, step, steps), &exact, 0.008)
        });
        assert!(errors[1] < 5e-3 && errors[1] < 0.5 * errors[0], "{couples:?}: {errors:?}");
    }
}

/// The start in equilibrium has the forces of statics, and stays.
#[test]
fn static_torque_is_carried_from_the_first_row_on() {
    for backlash in [None, Some(40.0)] {
        for sense in [1.0, -1.0] {
            // Without backlash the line of action is that of the flank which carries the couple.
            let pressure = if backlash.is_none() { 20.0 * sense } else { 20.0 };
            let train = Train { backlash, pressure, ..PLAIN };
            let rest =
                "[start]\nkind = \"equilibrium\"\n\n[march]\ntime_step = \"5e-6 s\"\nsteps = 400\n";
            let bench = Workbench::new()
                .file("case.toml", &train.case([100.0 * sense, 200.0 * sense], rest));
            ran(&bench, &["run", "case.toml", "--no-figures", "--out", "out"]);
            let history = bench.history("out");
            // The wheel stands towards y: its teeth push the pinion along x and towards −y, away from it.
            let across = 100.0 / RADII[0];
            for (name, expected) in
                [("RX_mesh_N", sense * across), ("RY_mesh_N", -across * 20_f64.to_radians().tan())]
            {
                for value in history.column(name) {
                    assert!((value / expected - 1.0).abs() < 1e-6, "{name}: {value} {expected}");
                }
            }
            let moment = history.last("MZ_mesh_Nm");
            assert!((moment / (-100.0 * sense) - 1.0).abs() < 1e-6, "{moment}");
            assert_eq!(bench.summary("out")["verdict"]["sound"], true);
        }
    }
}

/// A march that goes on from a state has the same rows.
#[test]
fn a_state_goes_on_with_teeth() {
    let train = Train { backlash: Some(20.0), ..PLAIN };
    let case = |steps: usize, start: &str| {
        train.case(
            [100.0, -50.0],
            &format!("{start}[march]\ntime_step = \"5e-6 s\"\nsteps = {steps}\n"),
        )
    };
    let from = "[start]\nfrom = \"half\"\n\n";
    let bench = Workbench::new()
        .file("whole.toml", &case(600, ""))
        .file("half.toml", &case(300, ""))
        .file("rest.toml", &case(300, from));
    for name in ["whole", "half", "rest"] {
        ran(&bench, &["run", &format!("{name}.toml"), "--no-figures", "--out", name]);
    }
    let [whole, rest] = ["whole", "rest"].map(|name| bench.history_text(name));
    let tail = |text: &str| text.lines().rev().take(299).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(tail(&whole), tail(&rest));
}
