//! Friction at springs and rings: drag in proportion to the slip, and dry friction.

use num_dual::{Dual64, DualNum};
use whirl_solver::bearing::Bearing;
use whirl_solver::dynamics::{March, march};
use whirl_solver::equations::{Equations, State};
use whirl_solver::history::History;
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Machine, MachineParts, Rotation};
use whirl_solver::support::Support;

use super::contacts::{Formula, RADIUS, RUB, laws};
use super::newton::converges_quadratically;
use super::{DISCS, INERTIA, bearing, bores, discs, force, options, parts};

#[test]
fn full_newton_converges_quadratically_with_friction() {
    converges_quadratically(Box::new(&RUB), Some(RADIUS));
}

const STIFF: f64 = 3e4;
const DAMP: f64 = 20.0;
const DRAG: f64 = 15.0;
/// Springs of a plane of `bearing`.
const SPRINGS: f64 = 11.0;

static LINEAR_SPRINGS: Formula = Formula {
    name: "linear springs",
    inputs: &["h", "h_dot", "v_t"],
    outputs: &["Q", "T"],
    value: |z| {
        let [h, h_dot, v_t] = z else { panic!("three inputs") };
        vec![(-*h + 1e-3) * STIFF - *h_dot * DAMP, *v_t * -DRAG]
    },
};

/// What the linear springs sum up to: Σ n nᵀ = Σ t tᵀ = N/2.
static LINEAR_RING: Formula = Formula {
    name: "linear ring",
    inputs: &["e_x", "e_y", "e_x_dot", "e_y_dot", "omega"],
    outputs: &["F_x", "F_y", "M_z"],
    value: |z| {
        let [x, y, x_dot, y_dot, omega] = z else { panic!("five inputs") };
        let half = 0.5 * SPRINGS;
        let force =
            |e: &Dual64, e_dot: &Dual64| *e * (-half * STIFF) - *e_dot * (half * (DAMP + DRAG));
        vec![force(x, x_dot), force(y, y_dot), *omega * (-SPRINGS * DRAG * RADIUS * RADIUS)]
    },
};

fn run(parts: MachineParts, time_step: f64, steps: usize, speed: f64) -> History {
    let machine = Machine::new(parts).expect("a machine");
    let mut options = options(time_step, steps);
    options.initial[0].speed = speed;
    let outcome = march(&machine, &options, &mut |_| std::ops::ControlFlow::Continue(()));
    outcome.unwrap_or_else(|failure| panic!("{}", failure.error)).history
}

#[test]
fn a_ring_does_what_its_springs_do_together() {
    let with = |law: &'static Formula| {
        let positions: Vec<[f64; 3]> = bores().nodes.iter().map(|node| node.position).collect();
        let support = Support::lumped(3.0, [2e5, 1e5], [50.0, 20.0], &positions);
        let mut parts = parts(discs(1e5), support, Rotation::Free);
        parts.laws = laws(&[law]);
        parts.bearings = vec![Bearing { journal_radius: Some(RADIUS), ..bearing(0) }];
        let sine = TimeFunction::Sine { frequency: 40.0, phase: 0.3 };
        parts.loads = vec![
            force(&parts.bodies[0].nodes()[2], [80.0, -30.0, 0.0], sine, Frame::Space),
            force(
                &parts.bodies[0].nodes()[0],
                [0.0, 20.0, 0.0],
                TimeFunction::Constant,
                Frame::Body,
            ),
        ];
        run(parts, 2e-4, 300, 60.0)
    };
    let (springs, ring) = (with(&LINEAR_SPRINGS), with(&LINEAR_RING));
    for name in ["omega_rad_s", "RX1_N", "RY1_N", "X1_um", "EY1_um"] {
        let column = |history: &History| history.column(name).expect("a column");
        let (a, b) = (column(&springs), column(&ring));
        let size = a.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let worst = a.iter().zip(&b).fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
        // Both solve their steps to a residual of 1e-10 of the forces, 300 times.
        assert!(worst <= 3e-8 * size, "{name}: {worst:e} of {size:e}");
        assert!(size > 0.0, "{name}");
    }
}

/// Drag alone: J ω̇ = −N d R² ω in every plane.
#[test]
fn drag_slows_a_centred_shaft_exponentially() {
    for law in [&LINEAR_SPRINGS, &LINEAR_RING] {
        let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
        parts.laws = laws(&[law]);
        parts.bearings =
            vec![Bearing { bore: Default::default(), journal_radius: Some(RADIUS), ..bearing(0) }];
        let (dt, steps, planes) = (1e-3, 200, 4.0);
        let history = run(parts, dt, steps, 50.0);
        let rate = planes * SPRINGS * DRAG * RADIUS * RADIUS / INERTIA;
        // Average acceleration: the factor a step is (1 − z)/(1 + z), z half a step's decay.
        let z = 0.5 * rate * dt;
        let omega = *history.column("omega_rad_s").expect("speeds").last().expect("rows");
        let marched = 50.0 * ((1.0 - z) / (1.0 + z)).powi(steps as i32);
        assert!((omega / marched - 1.0).abs() < 1e-8, "{}: {omega} {marched}", law.name);
        let exact = 50.0 * (-rate * dt * steps as f64).exp();
        assert!((omega / exact - 1.0).abs() < z * z * 2.0 * z * steps as f64, "{omega} {exact}");
    }
}

/// Dry friction under a constant push all around: Q stores nothing, so that whatever the springs take is
/// lost.
static BRAKE: Formula = Formula {
    name: "brake",
    inputs: &["v_t"],
    outputs: &["Q", "T"],
    value: |z| vec![Dual64::from_re(200.0), (z[0] / 0.05).tanh() * -40.0],
};

#[test]
fn friction_only_takes_energy_and_the_balance_closes() {
    let errors = [2e-4, 1e-4].map(|time_step: f64| {
        let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
        parts.laws = laws(&[&BRAKE]);
        parts.bearings =
            vec![Bearing { bore: Default::default(), journal_radius: Some(RADIUS), ..bearing(0) }];
        let machine = Machine::new(parts).expect("a machine");
        let steps = (0.02 / time_step).round() as usize;
        let mut options = options(time_step, steps);
        options.initial[0].speed = 40.0;
        [options.initial[0].position, options.initial[0].velocity] =
            [vec![0.0; 2 * DISCS], (0..2 * DISCS).map(|i| 0.3 * (i as f64).sin()).collect()];
        let mut march = March::new(&machine, &options).expect("starts");
        let (mut last, mut worst) = (0.0, 0.0_f64);
        for _ in 0..steps {
            march.advance().expect("converges");
            let energy = march.energy();
            assert!(energy.spring_dissipated >= last, "{energy:?} after {last}");
            last = energy.spring_dissipated;
            worst = worst.max(energy.error().abs());
        }
        assert!(last > 1.0, "friction took {last} J");
        worst
    });
    // The mass matrix varies with the bending: the balance closes to second order.
    let ratio = errors[0] / errors[1];
    assert!(errors[0] < 1e-3 && (3.0..5.0).contains(&ratio), "{errors:?}, ratio {ratio}");
}

/// Dry contact of a ring with a journal of 30 mm: the contact point slips by R ω and by the whirl.
static DRY: Formula = Formula {
    name: "dry",
    inputs: &["e_x", "e_y", "e_x_dot", "e_y_dot", "omega"],
    outputs: &["F_x", "F_y", "M_z"],
    value: |z| {
        let [x, y, x_dot, y_dot, omega] = z else { panic!("five inputs") };
        let r = (*x * *x + *y * *y).sqrt();
        let depth = if r.re > 1e-3 { r - 1e-3 } else { Dual64::from_re(0.0) };
        let normal = depth * 1e6;
        let (cos, sin) = (*x / r, *y / r);
        let slip = *omega * RADIUS + cos * y_dot - sin * x_dot;
        let drag = normal * (slip / 0.02).tanh() * -0.2;
        vec![-normal * cos - drag * sin, -normal * sin + drag * cos, drag * RADIUS]
    },
};

#[test]
fn dry_friction_brakes_the_shaft_and_drives_it_backward() {
    // Pressed on the bore at ψ = 0 and turning forward: friction points along −y and slows.
    static SPRING: Formula = Formula {
        name: "dry spring",
        inputs: &["h", "v_t"],
        outputs: &["Q", "T"],
        value: |z| {
            let q = if z[0].re < 0.0 { z[0] * -1e6 } else { Dual64::from_re(0.0) };
            vec![q, q * (z[1] / 0.02).tanh() * -0.2]
        },
    };
    for law in [&SPRING, &DRY] {
        let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
        parts.laws = laws(&[law]);
        parts.bearings = vec![Bearing {
            angles: vec![0.0],
            stations: vec![0.5],
            bore: Default::default(),
            journal_radius: Some(RADIUS),
            ..bearing(0)
        }];
        let machine = Machine::new(parts).expect("a machine");
        let mut state = State::new(machine.size());
        (0..DISCS).for_each(|disc| state.q[1 + 2 * disc] = 1.2e-3);
        // Still in the fixed frame while the shaft turns: ε̇ = −Ω ẑ×ε, ε̈ = −Ω² ε.
        state.v[0] = 50.0;
        for disc in 0..DISCS {
            state.v[2 + 2 * disc] = -50.0 * 1.2e-3;
            state.a[1 + 2 * disc] = -2500.0 * 1.2e-3;
        }
        let mut equations = Equations::new(&machine);
        equations.evaluate(0.0, &state);
        let r = equations.residual();
        let (push, drag) = (200.0, 40.0);
        let close = |a: f64, b: f64| (a - b).abs() < 1e-9 * push;
        // The middle disc carries the contact; the residual is the force on it.
        assert!(close(r[1 + 4], -push) && close(r[2 + 4], -drag), "{}: {r:?}", law.name);
        // Torque about the axis: friction at the arm R + e.
        assert!(close(r[0], -drag * (RADIUS + 1.2e-3)), "{}: {}", law.name, r[0]);
    }

    let mut shaft = discs(1e5);
    (0..2 * DISCS).for_each(|i| shaft.stiffness[(i, i)] += 1e4);
    let mut parts = parts(shaft, Support::rigid(&[]), Rotation::Free);
    parts.laws = laws(&[&DRY]);
    parts.bearings = vec![Bearing { stations: vec![0.5], bore: Default::default(), ..bearing(0) }];
    let machine = Machine::new(parts).expect("a machine");
    let mut options = options(2e-5, 4000);
    options.initial[0].speed = 50.0;
    options.initial[0].position = (0..2 * DISCS).map(|i| [1.2e-3, 0.0][i % 2]).collect();
    options.initial[0].velocity = (0..2 * DISCS).map(|i| [0.0, -50.0 * 1.2e-3][i % 2]).collect();
    let outcome = march(&machine, &options, &mut |_| std::ops::ControlFlow::Continue(()));
    let history = outcome.unwrap_or_else(|failure| panic!("{}", failure.error)).history;
    let column = |name| history.column(name).expect("a column");
    let (x, y, omega) = (column("X1_um"), column("Y1_um"), column("omega_rad_s"));
    // Area swept by the journal: negative for a whirl against the rotation.
    let swept: f64 = (1..x.len()).map(|i| x[i - 1] * y[i] - y[i - 1] * x[i]).sum();
    assert!(swept < 0.0, "{swept}");
    assert!(*omega.last().expect("rows") < 50.0);
}
