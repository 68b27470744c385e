//! The residual and its tangent: differences, and states of motion that solve the equations exactly.

use whirl_solver::dynamics::{Coefficients, Newmark};
use whirl_solver::equations::{Equations, State};
use whirl_solver::linalg::generalised_symmetric_eigen;
use whirl_solver::loads::{Frame, Release, Target, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::support::Support;
use whirl_specs::Motion;

use super::{DISC, DISCS, FILM, INERTIA, bearing, bores, boxed, discs, force, motion, parts, wild};

/// Every kind of load, rate-dependent springs, vibrating bores.
fn busy(motion: &'static Motion) -> Machine {
    let mut parts = parts(discs(1e5), bores(), Rotation::Free);
    parts.motion = motion;
    parts.laws = vec![boxed(&FILM)];
    parts.bearings = vec![bearing(0)];
    let sine = TimeFunction::Sine { frequency: 30.0, phase: 0.4 };
    let mut driven = parts.bodies[0].nodes()[0].clone();
    driven.position[0] = 0.03;
    parts.loads = vec![
        force(&parts.bodies[0].nodes()[2], [100.0, -40.0, 7.0], sine, Frame::Space),
        force(&parts.bodies[0].nodes()[4], [10.0, 30.0, 0.0], TimeFunction::Constant, Frame::Space),
        force(
            &driven,
            [0.0, 60.0, 0.0],
            TimeFunction::UntilSpeed(Target {
                speed: 1e9,
                from_above: false,
                release: Release::AtStep,
            }),
            Frame::Body,
        ),
    ];
    Machine::new(parts).expect("a machine")
}

pub(crate) fn random_state(size: usize, seed: u64) -> State {
    let mut random = wild(seed);
    let mut state = State::new(size);
    for i in 0..size {
        let length = if i == 0 { 1.0 } else { 1e-3 };
        state.q[i] = length * random();
        state.v[i] = 100.0 * length * random();
        state.a[i] = 1e4 * length * random();
    }
    state
}

/// Largest difference between a column of the tangent and central differences of the residual, over the
/// largest entry of that column, for one step of the difference.
pub(crate) fn worst_column(machine: &Machine, state: &State, share: f64) -> Vec<f64> {
    let (t, size) = (0.013, machine.size());
    let (method, dt) = (Newmark { gamma: 0.55, beta: 0.3 }, 1e-3);
    let (a1, a2) = (method.gamma / (method.beta * dt), 1.0 / (method.beta * dt * dt));
    let step = Coefficients::new(method, dt);
    let mut equations = Equations::new(machine);
    let mut tangent = vec![0.0; size * size];
    equations.evaluate(t, state);
    equations.tangent(t, state, step.weights(), &mut tangent);
    let column = |j: usize| {
        let h = share * if j == 0 { 1.0 } else { 1e-3 };
        let mut side = |h: f64| {
            let mut moved = state.clone();
            moved.q[j] += h;
            moved.v[j] += a1 * h;
            moved.a[j] += a2 * h;
            equations.evaluate(t, &moved);
            equations.residual().to_vec()
        };
        let (above, below) = (side(h), side(-h));
        let exact = &tangent[j * size..(j + 1) * size];
        let scale = exact.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let errors = (0..size).map(|i| (exact[i] - (below[i] - above[i]) / (2.0 * h)).abs());
        errors.fold(0.0, f64::max) / scale
    };
    (0..size).map(column).collect()
}

#[test]
fn the_tangent_is_minus_the_derivative_of_the_residual() {
    for name in ["consistent", "hu2003"] {
        let machine = busy(motion(name));
        for seed in 1..4 {
            let state = random_state(machine.size(), seed);
            let (coarse, fine) =
                (worst_column(&machine, &state, 1e-2), worst_column(&machine, &state, 1e-3));
            for (j, (coarse, fine)) in coarse.iter().zip(&fine).enumerate() {
                // A third derivative of size 1 leaves 1e-6 at the finer step; a hundredth of the coarser
                // one's error, or rounding (eps over the step).
                assert!(*fine < 2e-5, "{name} {seed} column {j}: {fine}");
                assert!(*fine <= 0.02 * coarse + 1e-9, "{name} {seed} column {j}: {coarse} {fine}");
            }
        }
    }
}

/// State of a shaft that turns at `omega` and, seen from the fixed frame, has displacement u, velocity u̇
/// and acceleration ü (x and y of every disc).
fn seen_from_space(
    angle: f64,
    omega: f64,
    u: &[[f64; 2]],
    u_dot: &[[f64; 2]],
    u_ddot: &[[f64; 2]],
) -> State {
    let mut state = State::new(1 + 2 * u.len());
    (state.q[0], state.v[0]) = (angle, omega);
    let (sin, cos) = angle.sin_cos();
    let turn = |v: [f64; 2]| [cos * v[0] + sin * v[1], -sin * v[0] + cos * v[1]];
    for disc in 0..u.len() {
        // ε = Aᵀu, ε̇ = Aᵀu̇ − Ω ẑ×ε, ε̈ = Aᵀü − 2Ω ẑ×ε̇ + Ω² ε.
        let position = turn(u[disc]);
        let [vx, vy] = turn(u_dot[disc]);
        let velocity = [vx + omega * position[1], vy - omega * position[0]];
        let [ax, ay] = turn(u_ddot[disc]);
        let acceleration = [
            ax + 2.0 * omega * velocity[1] + omega * omega * position[0],
            ay - 2.0 * omega * velocity[0] + omega * omega * position[1],
        ];
        for axis in 0..2 {
            let place = 1 + 2 * disc + axis;
            state.q[place] = position[axis];
            state.v[place] = velocity[axis];
            state.a[place] = acceleration[axis];
        }
    }
    state
}

#[test]
fn a_shaft_held_still_off_centre_feels_nothing_unless_the_centrifugal_force_counts_twice() {
    let (omega, d) = (471.0, [3e-4, -5e-4]);
    let still = [[0.0; 2]; DISCS];
    for (name, extra) in [("consistent", 0.0), ("hu2003", 1.0)] {
        let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
        parts.motion = motion(name);
        let machine = Machine::new(parts).expect("a machine");
        let mut equations = Equations::new(&machine);
        let angle: f64 = 0.7;
        equations.evaluate(0.0, &seen_from_space(angle, omega, &[d; DISCS], &still, &still));
        let residual = equations.residual();
        let (sin, cos) = angle.sin_cos();
        let body = [cos * d[0] + sin * d[1], -sin * d[0] + cos * d[1]];
        let force = DISC * omega * omega;
        assert!(residual[0].abs() < 1e-10, "{name}: {}", residual[0]);
        for i in 0..2 * DISCS {
            let spurious = extra * force * body[i % 2];
            // Each of three terms of this size cancels to rounding.
            let error = (residual[1 + i] - spurious).abs();
            assert!(error < 1e-13 * force, "{name} {i}: {}", residual[1 + i]);
        }
    }
}

/// Discs on springs to the ground in every direction alike, through bores that do not move: the springs
/// of four planes act on the middle discs, so they are counted in the stiffness here.
#[test]
fn free_whirl_has_the_frequencies_of_rest_forward_and_backward_at_any_speed() {
    let mut shaft = discs(1e5);
    for i in 0..2 * DISCS {
        shaft.stiffness[(i, i)] += 4e4;
    }
    let rest = generalised_symmetric_eigen(&shaft.stiffness, &shaft.mass).expect("modes");
    let stiffness = shaft.stiffness.clone();
    // Isotropic supports are springs fixed in space; springs that turn with the shaft are the same, when
    // their stiffness is the same in all directions.
    let machine = Machine::new(parts(shaft, Support::rigid(&[]), Rotation::Held)).expect("machine");
    let mut equations = Equations::new(&machine);
    let (angle, omega) = (0.0, 300.0);
    for (mode, &square) in rest.values.iter().enumerate() {
        let shape = rest.vectors.col(mode);
        for sense in [1.0, -1.0] {
            let whirl = sense * square.sqrt();
            // u = shape turned by whirl·t, at t = 0.
            let along = |disc: usize| [shape[2 * disc], shape[2 * disc + 1]];
            let across = |disc: usize| [-shape[2 * disc + 1], shape[2 * disc]];
            let scaled = |v: [f64; 2], by: f64| [by * v[0], by * v[1]];
            let u: Vec<_> = (0..DISCS).map(along).collect();
            let u_dot: Vec<_> = (0..DISCS).map(|i| scaled(across(i), whirl)).collect();
            let u_ddot: Vec<_> = (0..DISCS).map(|i| scaled(along(i), -square)).collect();
            let state = seen_from_space(angle, omega, &u, &u_dot, &u_ddot);
            // In the turning frame the whirl has the frequency of rest less the speed.
            for i in 1..=2 * DISCS {
                let turning = -(whirl - omega).powi(2) * state.q[i];
                let size = (square + omega * omega) * 1.0;
                assert!((state.a[i] - turning).abs() < 1e-12 * size, "{mode} {sense}");
            }
            equations.evaluate(0.0, &state);
            let size = DISC * (omega + square.sqrt()).powi(2) + stiffness.norm_max();
            let worst = equations.residual()[1..].iter().fold(0.0, |m: f64, r| m.max(r.abs()));
            assert!(worst < 1e-12 * size, "mode {mode}, sense {sense}: {worst}");
        }
    }
}

/// Kinetic energy by the energy itself and by the mass matrix, which both motions share, and strain energy: of the
/// discs and of the oscillators under the bores, each on its own and all together.
#[test]
fn energies_are_those_of_the_parts() {
    for name in ["consistent", "hu2003"] {
        let machine = busy(motion(name));
        let mut equations = Equations::new(&machine);
        let (n, size) = (2 * DISCS, machine.size());
        for (on_shaft, on_support) in [(1.0, 0.0), (0.0, 1.0), (1.0, 1.0)] {
            let mut state = random_state(size, 7);
            for x in [&mut state.q, &mut state.v] {
                x[..=n].iter_mut().for_each(|x| *x *= on_shaft);
                x[1 + n..].iter_mut().for_each(|x| *x *= on_support);
            }
            let (q, v) = (&state.q, &state.v);
            // A disc at ε moves with ε̇ + θ̇ ẑ×ε.
            let speed = |disc: usize| {
                let [x, y] = [1 + 2 * disc, 2 + 2 * disc];
                (v[x] - v[0] * q[y]).powi(2) + (v[y] + v[0] * q[x]).powi(2)
            };
            let kinetic = 0.5 * INERTIA * v[0] * v[0]
                + 0.5 * DISC * (0..DISCS).map(speed).sum::<f64>()
                + 0.5 * v[1 + n..].iter().map(|v| v * v).sum::<f64>();
            let bends = |k: usize| (q[k - 2] - 2.0 * q[k] + q[k + 2]).powi(2);
            let springs =
                q[1 + n..].iter().zip(&machine.bodies[1].support().expect("it stands").stiffness);
            let strain = 0.5 * 1e5 * (3..=n - 2).map(bends).sum::<f64>()
                + 0.5 * springs.map(|(x, k)| k * x * x).sum::<f64>();
            let found = [equations.kinetic_energy(&state), equations.strain_energy(&state)];
            for (found, exact) in found.into_iter().zip([kinetic, strain]) {
                assert!((found / exact - 1.0).abs() < 1e-12, "{name}: {found} J for {exact} J");
            }
        }
    }
}
