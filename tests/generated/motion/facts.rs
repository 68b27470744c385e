//! Values against the formulas of the paper written with dense matrices, and what must hold of them.

use nalgebra::DVector;

use super::sample::{LENGTHS, Shaft, State, error, motion};

/// Rounding of sums over 77 terms of size 1, with a margin for cancellation: n² eps.
const ROUNDING: f64 = 1e-12;

/// Q_v by eq. (27) over dense matrices; `extra` times its last term.
fn quadratic_velocity(shaft: &Shaft, at: &State, extra: f64) -> DVector<f64> {
    let (eta, eta_dot) = (at.q.rows(1, shaft.n), at.v.rows(1, shaft.n));
    let theta_dot = at.v[0];
    let arm = &shaft.y0 + &shaft.y * eta;
    let mut q_v = DVector::zeros(shaft.n + 1);
    q_v[0] = -2.0 * arm.dot(&eta_dot) * theta_dot;
    let force = arm * theta_dot.powi(2)
        + &shaft.h * eta_dot * (2.0 * theta_dot)
        + &shaft.y * eta * (extra * theta_dot.powi(2));
    q_v.rows_mut(1, shaft.n).copy_from(&force);
    q_v
}

#[test]
fn quadratic_velocity_forces_are_those_of_eq_27_and_differ_in_its_last_term() {
    for n in LENGTHS {
        let (shaft, at) = (Shaft::new(n), State::new(n, 1));
        for (name, extra) in [("consistent", 0.0), ("hu2003", 1.0)] {
            let motion = motion(name);
            let found = shaft.rows(motion, motion.quadratic_velocity, &at);
            let expected = quadratic_velocity(&shaft, &at, extra);
            assert!(error(&found, &expected) < ROUNDING, "{name} {n}");
        }
    }
}

#[test]
fn the_mass_matrix_is_that_of_section_2_and_gives_the_energy() {
    for n in LENGTHS {
        let (shaft, at) = (Shaft::new(n), State::new(n, 2));
        let eta = at.q.rows(1, n);
        let j = shaft.j0 + 2.0 * shaft.y0.dot(&eta) + eta.dot(&(&shaft.y * eta));
        let g = &shaft.g0 - &shaft.h * eta;
        for name in ["consistent", "hu2003"] {
            let motion = motion(name);
            let mass = shaft.blocks(motion, motion.mass, &at);
            assert!((mass[(0, 0)] - j).abs() < ROUNDING * j.abs().max(1.0));
            assert!(error(&mass.view((1, 0), (n, 1)).into_owned(), &g) < ROUNDING);
            assert_eq!(mass.view((1, 1), (n, n)), shaft.m);
            assert_eq!(mass, mass.transpose());
        }
        let motion = motion("consistent");
        let mass = shaft.blocks(motion, motion.mass, &at);
        let mut workspace = vec![f64::NAN; (motion.workspace)(n)];
        let energy = motion.kinetic_energy.expect("it has an energy");
        let energy = energy(&shaft.tensors(motion), &at.view(), &mut workspace);
        let quadratic = 0.5 * at.v.dot(&(&mass * &at.v));
        assert!((energy - quadratic).abs() < ROUNDING * quadratic.abs().max(1.0));
        let momentum = shaft.rows(motion, motion.momentum.expect("it has momenta"), &at);
        assert!(error(&momentum, &(&mass * &at.v)) < ROUNDING);
    }
}

#[test]
fn inertia_force_and_tangent_are_the_sums_of_their_parts() {
    for n in LENGTHS {
        let (shaft, at) = (Shaft::new(n), State::new(n, 3));
        for name in ["consistent", "hu2003"] {
            let motion = motion(name);
            let mass = shaft.blocks(motion, motion.mass, &at);
            let q_v = shaft.rows(motion, motion.quadratic_velocity, &at);
            let force = shaft.rows(motion, motion.inertia_force, &at);
            assert!(error(&force, &(q_v - &mass * &at.a)) < ROUNDING, "{name} {n}");

            let (a1, a2) = (27.0, 365.0);
            let [pf, b, p] =
                [motion.pf, motion.b, motion.p].map(|kernel| shaft.blocks(motion, kernel, &at));
            let sum = mass * a2 + pf - p * a1 - b;
            let mut workspace = vec![f64::NAN; (motion.workspace)(n)];
            let mut out = vec![f64::NAN; (n + 1) * (n + 1)];
            let tensors = shaft.tensors(motion);
            (motion.tangent)(&tensors, &at.view(), a1, a2, &mut workspace, &mut out);
            let tangent = nalgebra::DMatrix::from_vec(n + 1, n + 1, out);
            assert!(error(&tangent, &sum) < ROUNDING, "{name} {n}");
        }
    }
}

#[test]
fn blocks_are_symmetric_skew_or_zero_as_eqs_40_to_42_say() {
    let n = 77;
    let (shaft, at) = (Shaft::new(n), State::new(n, 4));
    for name in ["consistent", "hu2003"] {
        let motion = motion(name);
        let [pf, b, p] =
            [motion.pf, motion.b, motion.p].map(|kernel| shaft.blocks(motion, kernel, &at));
        let block = |matrix: &nalgebra::DMatrix<f64>| matrix.view((1, 1), (n, n)).into_owned();
        assert_eq!(block(&pf), -block(&pf).transpose());
        assert_eq!(block(&b), block(&b).transpose());
        assert_eq!(block(&p), -block(&p).transpose());
        // Nothing depends on θ itself.
        assert!(pf.column(0).iter().chain(b.column(0).iter()).all(|value| *value == 0.0));
    }
}

/// Without forces M q̈ = Q_v, so that dT/dt = q̇·Q_v + ½ q̇·Ṁq̇ and dp_θ/dt = Q_vθ + (Ṁq̇)_θ; both must
/// vanish. The paper's extra term feeds the shaft with θ̇² η̇·Ȳη instead.
#[test]
fn free_motion_keeps_energy_and_angular_momentum() {
    let n = 77;
    let (shaft, at) = (Shaft::new(n), State::new(n, 5));
    let motions = [("consistent", 0.0), ("hu2003", 1.0)];
    for (name, extra) in motions {
        let motion = motion(name);
        let nothing = DVector::zeros(n + 1);
        // M is quadratic in q: its central difference along q̇ is exact.
        let ahead = shaft.blocks(motion, motion.mass, &at.moved(0.5, &at.v, &nothing));
        let behind = shaft.blocks(motion, motion.mass, &at.moved(-0.5, &at.v, &nothing));
        let mass_rate = (ahead - behind) * &at.v;
        let q_v = shaft.rows(motion, motion.quadratic_velocity, &at);
        let power = at.v.dot(&q_v) + 0.5 * at.v.dot(&mass_rate);
        let (eta, eta_dot) = (at.q.rows(1, n), at.v.rows(1, n));
        let expected = extra * at.v[0].powi(2) * eta_dot.dot(&(&shaft.y * eta));
        let scale = at.v.norm() * q_v.norm();
        assert!((power - expected).abs() < ROUNDING * scale, "{name}: {power} {expected}");
        assert!(extra == 0.0 || expected.abs() > 1e-3 * scale);
        let torque = q_v[0] + mass_rate[0];
        assert!(torque.abs() < ROUNDING * mass_rate.norm(), "{name}: {torque}");
    }
}
