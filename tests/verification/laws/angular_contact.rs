//! The angular contact ball bearing, against its potential and the closed form of thrust; the linear joint.

use super::kernel::Kernel;

/// The bearing as shipped, SI.
const BALLS: usize = 10;
const ALPHA: f64 = 0.4363323;
const APART: f64 = 0.27e-3;
const RADIUS: f64 = 14.25e-3;
const PRELOAD: f64 = 10e-6;

const MOTIONS: [&str; 5] = ["e_x", "e_y", "e_z", "alpha_x", "alpha_y"];
const FORCES: [&str; 5] = ["F_x", "F_y", "F_z", "M_x", "M_y"];

fn stiffness() -> f64 {
    2.9e5 * 1e3_f64.powf(1.5)
}

/// 0.4 K Σ δ^2.5.
fn potential(u: [f64; 5]) -> f64 {
    let ball = |ball: usize| {
        let (sin, cos) = (std::f64::consts::TAU * ball as f64 / BALLS as f64).sin_cos();
        let r = APART * ALPHA.cos() + u[0] * cos + u[1] * sin;
        let z = APART * ALPHA.sin() + PRELOAD + u[2] + RADIUS * (u[3] * sin - u[4] * cos);
        0.4 * stiffness() * (r.hypot(z) - APART).max(0.0).powf(2.5)
    };
    (0..BALLS).map(ball).sum()
}

/// Displacements (m) and tilts (rad) at which some balls are pressed and some are not, and all are.
const STATES: [[f64; 5]; 4] = [
    [0.0; 5],
    [12e-6, -7e-6, 9e-6, 2e-4, -3e-4],
    [-20e-6, 15e-6, -25e-6, -6e-4, 4e-4],
    [3e-6, 1e-6, 40e-6, 1e-4, 1e-4],
];

fn inputs(u: [f64; 5]) -> Vec<(&'static str, f64)> {
    MOTIONS.into_iter().zip(u).collect()
}

#[test]
fn forces_and_moments_are_minus_the_gradient_of_the_potential() {
    let law = Kernel::named("angular-contact-ball");
    for u in STATES {
        let size = |i: usize| if i > 2 { 1e-5 / RADIUS } else { 1e-5 };
        for (i, force) in FORCES.into_iter().enumerate() {
            // Central differences of two steps, extrapolated.
            let slope = |step: f64| {
                let at = |sign: f64| {
                    let mut moved = u;
                    moved[i] += sign * step * size(i);
                    potential(moved)
                };
                (at(1.0) - at(-1.0)) / (2.0 * step * size(i))
            };
            let exact = -(4.0 * slope(0.01) - slope(0.02)) / 3.0;
            let found = law.value(force, &inputs(u));
            let scale = if i > 2 { 1000.0 * RADIUS } else { 1000.0 };
            assert!((found - exact).abs() < 1e-6 * scale, "{u:?} {force}: {found} for {exact}");
        }
    }
}

#[test]
fn the_stiffness_is_symmetric_and_holds() {
    let law = Kernel::named("angular-contact-ball");
    for u in STATES {
        let slope = |i: usize, j: usize| law.slope(FORCES[i], MOTIONS[j], &inputs(u));
        for i in 0..5 {
            for j in 0..i {
                let size = f64::sqrt(slope(i, i) * slope(j, j));
                let apart = (slope(i, j) - slope(j, i)).abs();
                assert!(apart < 1e-13 * size, "{u:?} {i} {j}: {apart} of {size}");
            }
            assert!(slope(i, i) < 0.0, "{u:?} {i}");
        }
        // All five motions are coupled where it is not centred.
        let coupled = u != [0.0; 5];
        let size = |i: usize, j: usize| f64::sqrt(slope(i, i) * slope(j, j));
        let weak = (0..5).flat_map(|i| (0..i).map(move |j| (i, j)));
        let weak = weak.filter(|&(i, j)| slope(i, j).abs() < 1e-6 * size(i, j)).count();
        assert_eq!(weak == 0, coupled, "{u:?}: {weak}");
    }
}

/// F_z = Z K δ^1.5 sin α with cos α = A cos α₀/(A + δ), and the stiffness of a centred bearing by that.
#[test]
fn thrust_presses_all_balls_at_a_steeper_angle() {
    let law = Kernel::named("angular-contact-ball");
    for along in [-5e-6, 0.0, 20e-6, 45e-6] {
        let (r, z) = (APART * ALPHA.cos(), APART * ALPHA.sin() + PRELOAD + along);
        let pressed = r.hypot(z) - APART;
        let angle = f64::acos(APART * ALPHA.cos() / (APART + pressed));
        assert!(angle > ALPHA);
        let (count, k) = (BALLS as f64, stiffness());
        let load = k * pressed.powf(1.5);
        let at = [("e_z", along)];
        let found = law.value("F_z", &at);
        let exact = -count * load * angle.sin();
        assert!((found - exact).abs() < 1e-10 * exact.abs(), "{along}: {found} for {exact}");
        assert!(law.value("F_x", &at).abs() < 1e-10 * exact.abs());
        // Along the contact it is 1.5 K √δ, across it the load over the distance of both centres.
        let (with, across) = (1.5 * k * pressed.sqrt(), load / (APART + pressed));
        let (sin, cos) = angle.sin_cos();
        let axial = count * (with * sin * sin + across * cos * cos);
        let radial = 0.5 * count * (with * cos * cos + across * sin * sin);
        let tilting = 0.5 * axial * RADIUS * RADIUS;
        let coupled = 0.5 * count * RADIUS * (with - across) * sin * cos;
        for (force, motion, exact) in [
            ("F_z", "e_z", axial),
            ("F_x", "e_x", radial),
            ("F_y", "e_y", radial),
            ("M_x", "alpha_x", tilting),
            ("M_y", "alpha_y", tilting),
            ("F_y", "alpha_x", coupled),
            ("F_x", "alpha_y", -coupled),
            ("M_y", "e_x", -coupled),
        ] {
            let found = -law.slope(force, motion, &at);
            assert!(
                (found - exact).abs() < 1e-9 * exact.abs(),
                "{force} {motion}: {found} {exact}"
            );
        }
    }
    // With end play nothing is pressed within it.
    assert_eq!(law.value("F_z", &[("e_z", -2.0 * PRELOAD)]), 0.0);
}

#[test]
fn damping_is_shared_by_the_balls() {
    let law = Kernel::named("angular-contact-ball");
    for (force, motion, exact) in [
        ("F_x", "e_x_dot", 500.0),
        ("F_y", "e_y_dot", 500.0),
        ("F_z", "e_z_dot", 500.0),
        ("M_x", "alpha_x_dot", 0.5 * 500.0 * RADIUS * RADIUS),
        ("M_y", "alpha_y_dot", 0.5 * 500.0 * RADIUS * RADIUS),
    ] {
        let found = -law.slope(force, motion, &[]);
        assert!((found - exact).abs() < 1e-12 * exact, "{force}: {found}");
    }
}
