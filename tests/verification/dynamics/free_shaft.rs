//! A free, undamped, spinning and bending shaft keeps its energy and angular momentum, as far as the time
//! integration lets it.

use whirl_solver::dynamics::{BodyStart, March, MarchOptions};
use whirl_solver::linalg::generalised_symmetric_eigen;
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::support::Support;
use whirl_specs::MotionState;

use super::{DISCS, discs, options, parts, wild};

const SPEED: f64 = 60.0;

/// Spin with bending and translation large enough (20 mm, the inertia about the axis is that of 70 mm) that J and
/// g vary.
fn thrown(time_step: f64, steps: usize) -> MarchOptions {
    let mut random = wild(3);
    let mut throw = |size: f64| (0..2 * DISCS).map(|_| size * random()).collect();
    let [position, velocity] = [throw(2e-2), throw(2.0)];
    let initial = vec![BodyStart { angle: 0.0, speed: SPEED, position, velocity }];
    MarchOptions { initial, ..options(time_step, steps) }
}

/// Angular momentum about the axis.
pub(crate) fn momentum(machine: &Machine, march: &March) -> f64 {
    let state = march.state();
    let n = machine.bodies[0].shaft().expect("it turns").size();
    let mut tensors = Vec::new();
    for tensor in machine.motion.tensors {
        tensors.push(
            machine.bodies[0]
                .shaft()
                .expect("it turns")
                .tensor(tensor.name)
                .expect("a tensor of the shaft"),
        );
    }
    let motion = MotionState {
        theta: state.q[0],
        theta_dot: state.v[0],
        theta_ddot: state.a[0],
        eta: &state.q[1..],
        eta_dot: &state.v[1..],
        eta_ddot: &state.a[1..],
    };
    let mut out = vec![0.0; 1 + n];
    let mut workspace = vec![0.0; (machine.motion.workspace)(n)];
    machine.motion.momentum.expect("it has an energy")(&tensors, &motion, &mut workspace, &mut out);
    out[0]
}

/// Root mean square deviation of energy and angular momentum from their values at the start, over 40 ms.
fn drifts(time_step: f64) -> [f64; 2] {
    let steps = (0.04 / time_step).round() as usize;
    // Springs between the discs and the turning frame, softer one way than the other: without them the
    // discs would leave the rotation alone, and the method is exact for what would be a linear system.
    let mut shaft = discs(2e4);
    for i in 0..2 * DISCS {
        shaft.stiffness[(i, i)] += [1e4, 3e4][i % 2];
    }
    let machine =
        Machine::new(parts(shaft, Support::rigid(&[]), Rotation::Free)).expect("a machine");
    let mut march = March::new(&machine, &thrown(time_step, steps)).expect("starts");
    let at_start = momentum(&machine, &march);
    let mut sums = [0.0; 2];
    for _ in 0..steps {
        march.advance().expect("converges");
        let deviations = [march.energy().error(), momentum(&machine, &march) - at_start];
        for (sum, deviation) in sums.iter_mut().zip(deviations) {
            *sum += deviation * deviation / steps as f64;
        }
    }
    sums.map(f64::sqrt)
}

#[test]
fn drifts_of_energy_and_angular_momentum_fall_as_the_square_of_the_step() {
    let (coarse, fine) = (drifts(4e-4), drifts(2e-4));
    // A quarter, but for terms of the fourth order: (ω Δt)² of the fastest mode is about 0.03.
    for (name, coarse, fine) in [("energy", coarse[0], fine[0]), ("momentum", coarse[1], fine[1])] {
        let ratio = coarse / fine;
        assert!((3.8..4.2).contains(&ratio), "{name}: {coarse:e}, {fine:e}, ratio {ratio}");
        assert!(fine > 1e-6, "{name}: {fine:e}: more than rounding");
    }
}

#[test]
fn a_whirling_shaft_on_springs_turns_at_rest_frequency_less_speed_when_marched() {
    let mut shaft = discs(1e5);
    for i in 0..2 * DISCS {
        shaft.stiffness[(i, i)] += 4e4;
    }
    let rest = generalised_symmetric_eigen(&shaft.stiffness, &shaft.mass).expect("modes");
    let (square, shape) = (rest.values[0], rest.vectors.col(0).to_vec());
    let machine =
        Machine::new(parts(shaft, Support::rigid(&[]), Rotation::Free)).expect("a machine");
    for sense in [1.0, -1.0] {
        // A whirl of a nanometre: the speed stays.
        let (size, whirl) = (1e-9, sense * square.sqrt());
        let eta: Vec<f64> = shape.iter().map(|v| size * v).collect();
        let turn = |i: usize| if i.is_multiple_of(2) { -eta[i + 1] } else { eta[i - 1] };
        let eta_dot: Vec<f64> = (0..eta.len()).map(|i| (whirl - SPEED) * turn(i)).collect();
        let (dt, steps) = (2e-5, 20_000);
        let mut options = options(dt, steps);
        [options.initial[0].position, options.initial[0].velocity] = [eta.clone(), eta_dot];
        options.initial[0].speed = SPEED;
        let mut march = March::new(&machine, &options).expect("starts");
        let place = 1 + 2 * (DISCS / 2);
        let start = eta[place].atan2(eta[place - 1]);
        let (mut angle, mut last) = (0.0, start);
        for _ in 0..steps {
            march.advance().expect("converges");
            let q = &march.state().q;
            let now = q[1 + place].atan2(q[place]);
            let tau = std::f64::consts::TAU;
            angle += (now - last + 0.5 * tau).rem_euclid(tau) - 0.5 * tau;
            last = now;
        }
        let measured = angle / (dt * steps as f64);
        let expected = whirl - SPEED;
        // Average acceleration turns a frequency ω into 2/Δt · atan(ω Δt/2).
        let marched = 2.0 / dt * (0.5 * dt * expected).atan();
        let error = (measured / marched - 1.0).abs();
        assert!(
            error < 1e-8 && (measured / expected - 1.0).abs() < 1e-5,
            "sense {sense}: {measured} against {expected}"
        );
    }
}
