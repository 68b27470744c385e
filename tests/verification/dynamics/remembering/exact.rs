//! Against exact solutions.

use nalgebra::{Complex, Matrix3, Vector3};
use whirl_solver::bearing::{Hold, LawStates, SpringLaw};
use whirl_solver::dynamics::{Coefficients, Integrator, MarchOptions, Newmark};
use whirl_solver::equations::{Equations, State};
use whirl_solver::loads::TimeFunction;
use whirl_solver::machine::Rotation;

use super::super::options;
use super::{
    MASS, ON_MOUNT, RELAXING, SLOW, TAU, Taped, marched, mass_on, on_mount, shipped, with_states,
};

const PUSH: f64 = 500.0;

/// A mass that is pushed from rest: (q, q̇, z) by the matrix exponential. What a march misses falls as Δt², whatever its method
/// damps, of the state as of the motion.
#[test]
fn states_are_of_second_order_as_the_motion_is() {
    let machine = on_mount((PUSH, TimeFunction::Constant));
    let rates = Matrix3::from_row_slice(&ON_MOUNT);
    let rest = Vector3::new(PUSH / SLOW, 0.0, PUSH / SLOW);
    let errors = |integrator: Integrator, steps: usize| {
        let own = MarchOptions { integrator, ..options(0.02 / steps as f64, steps) };
        let mut worst = Vector3::zeros();
        marched(&machine, &own, |march| {
            let exact = rest - (rates * march.time()).exp() * rest;
            let state = march.state();
            let found = Vector3::new(state.q[1], state.v[1], state.laws.known[0]);
            worst = worst.zip_map(&(found - exact).abs(), f64::max);
        });
        worst
    };
    let methods = [1.0, 0.9, 0.5, 0.0].map(Integrator::generalized_alpha);
    for integrator in methods.into_iter().chain([Integrator::default()]) {
        let [coarse, fine] = [400, 800].map(|steps| errors(integrator, steps));
        for place in 0..3 {
            let ratio = coarse[place] / fine[place];
            assert!((3.9..4.15).contains(&ratio), "{integrator:?}, {place}: {coarse} {fine}");
        }
        assert!(fine[2] < 1e-4 * rest[2], "{fine}");
    }
    // γ = 0.6 is of first order, the states with the motion.
    let first = Integrator::from(Newmark { gamma: 0.6, beta: 0.3025 });
    let [coarse, fine] = [800, 1600].map(|steps| errors(first, steps));
    for place in 0..3 {
        let ratio = coarse[place] / fine[place];
        assert!((1.8..2.2).contains(&ratio), "{place}: {coarse} {fine}");
    }
}

/// Shaken at ω the mount has the stiffness K(ω) = k + k_m iωτ/(1 + iωτ): found from runs, with F + mω²q over q.
#[test]
fn the_dynamic_stiffness_is_that_of_the_closed_form() {
    for omega_tau in [0.1, 0.5, (2.0_f64 / 3.0).sqrt(), 2.0, 8.0] {
        let omega = omega_tau / TAU;
        let frequency = omega / std::f64::consts::TAU;
        let machine = on_mount((PUSH, TimeFunction::Sine { frequency, phase: 0.0 }));
        // What the mass does by itself dies at 37.9 1/s: to e^{−25} of it.
        let (per_period, periods) = (60, 5 + (25.0 / 37.9 * frequency).ceil() as usize);
        let dt = 1.0 / (frequency * per_period as f64);
        let mut sum = Complex::new(0.0, 0.0);
        let last = per_period * (periods - 1);
        let mut step = 0;
        marched(&machine, &options(dt, per_period * periods), |march| {
            step += 1;
            if step > last {
                let angle = omega * march.time();
                sum += Complex::from_polar(2.0 / per_period as f64, -angle) * march.state().q[1];
            }
        });
        // F = Im (F e^{iωt}), so q̂ = i sum.
        let stiffness = PUSH / (Complex::new(0.0, 1.0) * sum);
        // The trapezoidal rule has ω̃ = (2/Δt) tan(ωΔt/2) for ω, exactly, of the mass as of the state.
        let warped = 2.0 / dt * (0.5 * omega * dt).tan();
        let lag = Complex::new(0.0, warped * TAU);
        let exact = SLOW + RELAXING * lag / (1.0 + lag);
        let found = stiffness + MASS * warped * warped;
        let error = (found - exact).norm() / exact.norm();
        assert!(error < 1e-7, "ωτ = {omega_tau}: {found} for {exact}, {error}");
        // And against ω itself to the order of the rule.
        let lag = Complex::new(0.0, omega * TAU);
        let closed = SLOW + RELAXING * lag / (1.0 + lag);
        let rule = (omega * dt).powi(2) / 12.0;
        let mass = MASS * omega * omega;
        assert!((stiffness + mass - closed).norm() < 4.0 * rule * (closed.norm() + mass));
    }
}

/// What the law stores, and what its damper dissipates by itself, k_m/τ (e − z)² over time.
#[test]
fn what_is_stored_and_what_is_dissipated_balance() {
    let machine = on_mount((PUSH, TimeFunction::Constant));
    let errors = |steps: usize| {
        let (dt, mut dissipated, mut last) = (0.02 / steps as f64, 0.0, 0.0);
        let own = options(dt, steps);
        let mut march = whirl_solver::dynamics::March::new(&machine, &own).expect("starts");
        let mut apart = 0.0;
        while !march.is_done() {
            march.advance().expect("converges");
            apart = march.state().q[1] - march.state().laws.known[0];
            let power = RELAXING / TAU * apart * apart;
            dissipated += 0.5 * dt * (power + last);
            last = power;
        }
        let (energy, q) = (march.energy(), march.state().q[1]);
        let stored = 0.5 * (SLOW * q * q + RELAXING * apart * apart);
        assert!((energy.spring_stored - stored).abs() < 1e-12 * stored, "{energy:?} {stored}");
        assert!(energy.error_fraction() < 1e-6, "{energy:?}");
        (energy.spring_dissipated - dissipated).abs() / dissipated
    };
    let (coarse, fine) = (errors(500), errors(1000));
    assert!(fine < 1e-4 && (3.8..4.2).contains(&(coarse / fine)), "{coarse} {fine}");
}

/// States that hang on each other and on rates, by bends, with a saturation.
const BENT: &str = "[rates]
z = '(e_x - z*(1 + (z/a)^2))/tau + e_y_dot*tanh(w/(k*a))'
w = '(k*(e_y + z) - w - c*e_x_dot)/(tau*sqrt(1 + (e_y/a)^2))'
[outputs]
F_x = { unit = \"N\", value = '-k*e_x*(1 + (z/a)^2) - c*e_x_dot - w' }
F_y = { unit = \"N\", value = '-k*(e_y + z) - w*e_y/a - c*e_y_dot' }
";

fn bent() -> Box<dyn SpringLaw> {
    Box::new(Taped::new(&with_states("0.1", BENT)))
}

/// The tangent of a step holds what the states do in it: ∂Q/∂x + ∂Q/∂s ds/dx, of the rates as well; at rest, too.
#[test]
fn the_tangent_with_states_is_minus_the_derivative_of_the_residual() {
    let machine = mass_on(bent(), (PUSH, TimeFunction::Constant), Rotation::Held);
    let step = Coefficients::new(Newmark::default(), 2e-3);
    let (a1, a2) = (step.weights().rate, step.weights().acceleration);
    let at = |hold: Hold| {
        let mut state = State::new(machine.size());
        state.q[1..].copy_from_slice(&[3e-4, -2e-4]);
        state.v[1..].copy_from_slice(&[0.05, -0.08]);
        state.laws = LawStates {
            known: vec![2e-4, 30.0],
            rates: vec![0.01, -500.0],
            lag: vec![0.0; 2],
            hold,
            ..LawStates::default()
        };
        state
    };
    for hold in [Hold::Implicit(1e-3), Hold::Implicit(0.0), Hold::Rest, Hold::Start] {
        let mut equations = Equations::new(&machine);
        let (state, size) = (at(hold), machine.size());
        let mut tangent = vec![0.0; size * size];
        equations.evaluate(0.0, &state);
        equations.tangent(0.0, &state, step.weights(), &mut tangent);
        for j in 1..size {
            let mut side = |h: f64| {
                let mut moved = state.clone();
                moved.q[j] += h;
                moved.v[j] += a1 * h;
                moved.a[j] += a2 * h;
                equations.evaluate(0.0, &moved);
                equations.residual().to_vec()
            };
            let mut difference = |h: f64| -> Vec<f64> {
                let (above, below) = (side(h), side(-h));
                below.iter().zip(&above).map(|(below, above)| (below - above) / (2.0 * h)).collect()
            };
            // Richardson's: of fourth order.
            let (coarse, fine) = (difference(2e-6), difference(1e-6));
            for i in 1..size {
                let (exact, found) = (tangent[j * size + i], (4.0 * fine[i] - coarse[i]) / 3.0);
                let scale = tangent[j * size + j].abs();
                assert!((exact - found).abs() < 1e-8 * scale, "{hold:?} {i} {j}: {exact} {found}");
            }
        }
    }
}

/// With it a linear machine is solved at once, and one with bends in a few iterations.
#[test]
fn steps_with_states_take_no_more_iterations() {
    let sine = || (PUSH, TimeFunction::Sine { frequency: 60.0, phase: 0.0 });
    for (law, most) in [(shipped("zener-mount"), 2.1), (bent(), 5.0)] {
        let machine = mass_on(law, sine(), Rotation::Held);
        let mut iterations = 0;
        marched(&machine, &options(1e-4, 1000), |march| iterations += march.progress().iterations);
        assert!((iterations as f64) < most * 1000.0, "{iterations}");
    }
}

/// A mass in a magnetic bearing, pushed from rest, by the matrix exponential of its own state space.
#[test]
fn a_magnetic_bearing_is_marched_as_its_state_space() {
    let push = 50.0;
    let law = shipped("magnetic-bearing-linear");
    let machine = mass_on(law, (push, TimeFunction::Constant), Rotation::Held);
    let rates = super::linear::magnetic();
    let forced = nalgebra::DVector::from_fn(5, |i, _| if i == 1 { push / MASS } else { 0.0 });
    let rest = -rates.clone().lu().solve(&forced).expect("has a rest");
    let errors = |steps: usize| {
        let mut worst = [0.0_f64; 2];
        marched(&machine, &options(0.02 / steps as f64, steps), |march| {
            let exact = &rest - (&rates * march.time()).exp() * &rest;
            let (state, laws) = (march.state(), &march.state().laws.known);
            // States stand in the order of the file: q, d and c of x, then those of y.
            worst[0] = worst[0].max((state.q[1] - exact[0]).abs() / rest[0].abs());
            worst[1] = worst[1].max((laws[2] - exact[4]).abs() / rest[4].abs());
        });
        worst
    };
    let (coarse, fine) = (errors(2000), errors(4000));
    for place in 0..2 {
        let ratio = coarse[place] / fine[place];
        assert!((3.7..4.3).contains(&ratio), "{coarse:?} {fine:?}");
        assert!(fine[place] < 1e-2, "{fine:?}");
    }
}
