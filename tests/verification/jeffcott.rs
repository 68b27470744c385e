//! A meshed rotor with unbalance on soft bearings: stiff against them, it is Jeffcott's rotor.

use std::ops::ControlFlow;

use whirl_solver::attached::Unbalance;
use whirl_solver::bearing::{Bearing, Sides, SpringLaw};
use whirl_solver::dynamics::{MarchOptions, Outcome, march};
use whirl_solver::machine::{Body, Machine, MachineParts, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::CLEARANCES;

use whirl_tests::validation::Section;

use crate::small_shaft::{journal, mesh, motion, options, shaft, translation};

/// Natural frequency (rad/s) and damping ratio on the bearings.
const OMEGA: f64 = 300.0;
const ZETA: f64 = 0.1;
/// U = m e (kg·m) and its angle in the frame of the rotor (rad).
const UNBALANCE: f64 = 1e-4;
const ANGLE: f64 = 0.7;

/// F = −k e − d ė.
struct Spring {
    k: f64,
    d: f64,
}

impl SpringLaw for Spring {
    fn name(&self) -> &str {
        "spring"
    }
    fn hash(&self) -> &str {
        ""
    }
    fn inputs(&self) -> Vec<&str> {
        vec!["e_x", "e_y", "e_x_dot", "e_y_dot"]
    }
    fn outputs(&self) -> Vec<&str> {
        vec!["F_x", "F_y"]
    }
    fn workspace(&self) -> usize {
        0
    }
    fn evaluate(&self, n: usize, inputs: &[f64], outputs: &mut [f64], _: &mut [f64]) {
        outputs.fill(0.0);
        for axis in 0..2 {
            for j in 0..n {
                let (e, e_dot) = (inputs[axis * n + j], inputs[(2 + axis) * n + j]);
                let rows = &mut outputs[5 * axis * n..];
                rows[j] = -self.k * e - self.d * e_dot;
                rows[(1 + axis) * n + j] = -self.k;
                rows[(3 + axis) * n + j] = -self.d;
            }
        }
    }
}

/// The rotor with its unbalance in the middle, and its mass (kg).
fn rotor() -> (Shaft, f64) {
    let plain = shaft(&mesh());
    let moved = translation(&plain, [1.0, 0.0]);
    let n = plain.size();
    let mass = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let mass: f64 = mass.map(|(i, j)| moved[i] * plain.mass[(i, j)] * moved[j]).sum();
    let node = plain.measures[0].node_at([0.0, 0.0, 0.2]);
    let moment = [UNBALANCE * ANGLE.cos(), UNBALANCE * ANGLE.sin()];
    (plain.with_unbalance(&Unbalance { moment, node: &node }), mass)
}

/// The rotor turning as prescribed, marched; its mass.
fn run(rotation: Rotation, options: &MarchOptions) -> (Outcome, f64) {
    let (shaft, mass) = rotor();
    let spring = Spring { k: 0.5 * mass * OMEGA * OMEGA, d: ZETA * mass * OMEGA };
    let bearing = |number: usize| Bearing {
        others: Vec::new(),
        name: format!("bearing {}", number + 1),
        label: None,
        sides: Sides::default(),
        journal: [journal(number)[1]; 3],
        bore: [const { Vec::new() }; 3],
        clearance: 1e-3,
        journal_radius: None,
        stations: vec![0.5],
        angles: Vec::new(),
        law: 0,
    };
    let machine = Machine::new(MachineParts {
        bodies: vec![
            Body::turning("rotor", shaft, rotation),
            Body::standing("ground", Support::rigid(&[])),
        ],
        motion: motion("consistent"),
        clearance: &CLEARANCES[0],
        laws: vec![Box::new(spring)],
        bearings: vec![bearing(0), bearing(1)],
        loads: Vec::new(),
    });
    let machine = machine.expect("a machine");
    let outcome = march(&machine, options, &mut |_| ControlFlow::Continue(()));
    (outcome.unwrap_or_else(|failure| panic!("{}", failure.error)), mass)
}

/// Amplitude within 0.5 % and phase within half a degree, below the critical speed, at it and above.
#[test]
fn at_constant_speed_it_whirls_as_the_closed_form_says() {
    let mut section = Section::new(
        "A meshed rotor with unbalance, marched at constant speed",
        "Jeffcott's rotor, closed form; phases in rad, differences in rad",
        "cargo test -p whirl-tests --test verification -- at_constant_speed_it_whirls",
    );
    for ratio in [0.5, 1.0, 2.0_f64] {
        let rotation = Rotation::Prescribed { speed: ratio * OMEGA, acceleration: 0.0 };
        let (outcome, mass) = run(rotation, &options(1e-4, 4000));
        let last = |name: &str| *outcome.history.column(name).expect("a column").last().unwrap();
        let theta = last("theta_rad");
        let stiff = 1.0 - ratio * ratio;
        let amplitude = UNBALANCE / mass * ratio * ratio / stiff.hypot(2.0 * ZETA * ratio);
        let phase = ANGLE - (2.0 * ZETA * ratio).atan2(stiff);
        for bearing in [1, 2] {
            let [x, y] = ["X", "Y"].map(|axis| 1e-6 * last(&format!("{axis}{bearing}_um")));
            let found = x.hypot(y);
            let what =
                |what: &str| format!("bearing {bearing} at {ratio} of the critical speed: {what}");
            section.compare(&what("amplitude (m)"), amplitude, found, 5e-3);
            let turned = y.atan2(x) - theta - phase;
            let away = turned - std::f64::consts::TAU * (turned / std::f64::consts::TAU).round();
            section.compare(&what("error of the phase (rad)"), 0.0, away, 8.7e-3);
        }
    }
    section.finish();
}

/// Amplitudes of Jeffcott's equation ü + 2ζω u̇ + ω² u = (U/m)(θ̇² − iθ̈) e^{i(θ + angle)} from rest, by the classical
/// Runge–Kutta method, at the ends of `steps` steps of `dt` in ten parts each.
fn integrated(mass: f64, acceleration: f64, dt: f64, steps: usize) -> Vec<f64> {
    let rate = |t: f64, [x, y, u, v]: [f64; 4]| {
        let (speed, angle) = (acceleration * t, 0.5 * acceleration * t * t + ANGLE);
        let (sin, cos) = angle.sin_cos();
        let e = UNBALANCE / mass;
        let along = e * (speed * speed * cos + acceleration * sin);
        let across = e * (speed * speed * sin - acceleration * cos);
        let own = |x: f64, u: f64| -2.0 * ZETA * OMEGA * u - OMEGA * OMEGA * x;
        [u, v, own(x, u) + along, own(y, v) + across]
    };
    let step = dt / 10.0;
    let add = |a: [f64; 4], b: [f64; 4], by: f64| [0, 1, 2, 3].map(|i| a[i] + by * b[i]);
    let (mut state, mut amplitudes) = ([0.0; 4], Vec::with_capacity(steps));
    for part in 0..10 * steps {
        let t = part as f64 * step;
        let a = rate(t, state);
        let b = rate(t + 0.5 * step, add(state, a, 0.5 * step));
        let c = rate(t + 0.5 * step, add(state, b, 0.5 * step));
        let d = rate(t + step, add(state, c, step));
        let sum = [0, 1, 2, 3].map(|i| (a[i] + 2.0 * (b[i] + c[i]) + d[i]) / 6.0);
        state = add(state, sum, step);
        if part % 10 == 9 {
            amplitudes.push(state[0].hypot(state[1]));
        }
    }
    amplitudes
}

/// From rest through the critical speed in a second.
#[test]
fn a_run_up_is_that_of_jeffcotts_equation() {
    let (acceleration, dt, steps) = (600.0, 1e-4, 10_000);
    let rotation = Rotation::Prescribed { speed: 0.0, acceleration };
    let (outcome, mass) = run(rotation, &options(dt, steps));
    let column = |name: &str| outcome.history.column(name).expect("a column");
    let (x, y) = (column("X1_um"), column("Y1_um"));
    let exact = integrated(mass, acceleration, dt, steps);
    let peak = exact.iter().copied().fold(0.0, f64::max);
    let worst =
        x.iter().zip(&y).zip(&exact).map(|((x, y), exact)| (1e-6 * x.hypot(*y) - exact).abs());
    let worst = worst.fold(0.0, f64::max);
    assert!(worst < 1e-2 * peak, "{worst} of {peak}");
}
