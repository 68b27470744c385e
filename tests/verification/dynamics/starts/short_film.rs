//! The short film in closed form, with the half that cavitates left out.
//!
//! Load and attitude: Ocvirk, NACA TN 2808 (1952). The eight coefficients by differences of an integral over the film, as
//! an independent program would find them, and in closed form: Smith, Journal Bearings in Turbomachinery (1969), as
//! printed in Friswell, Penny, Garvey and Lees, Dynamics of Rotating Machines (2010), section 5.5.

use std::f64::consts::PI;

use super::{C, L, MU, R};

/// The load (N) that a journal carries at an eccentricity ratio and a speed (rad/s).
pub(super) fn load(eps: f64, speed: f64) -> f64 {
    MU * speed * R * L.powi(3) / (C * C) * load_number(eps)
}

/// W c²/(μ ω R L³).
pub(super) fn load_number(eps: f64) -> f64 {
    let rest = 1.0 - eps * eps;
    eps / (4.0 * rest * rest) * (16.0 * eps * eps + PI * PI * rest).sqrt()
}

/// tan φ = π √(1 − ε²)/4ε.
pub(super) fn attitude(eps: f64) -> f64 {
    (PI * (1.0 - eps * eps).sqrt()).atan2(4.0 * eps)
}

/// K c/W, and C c ω/W, along the load (v) and across it (u): [[uu, uv], [vu, vv]].
pub(super) fn coefficients(eps: f64) -> [[[f64; 2]; 2]; 2] {
    let (e2, p2) = (eps * eps, PI * PI);
    let (rest, root) = (1.0 - e2, (1.0 - e2).sqrt());
    let h = (p2 * rest + 16.0 * e2).powf(-1.5);
    let stiffness = [
        [
            4.0 * (p2 * (2.0 - e2) + 16.0 * e2),
            PI * (p2 * rest * rest - 16.0 * e2 * e2) / (eps * root),
        ],
        [
            -PI * (p2 * rest * (1.0 + 2.0 * e2) + 32.0 * e2 * (1.0 + e2)) / (eps * root),
            4.0 * (p2 * (1.0 + 2.0 * e2) + 32.0 * e2 * (1.0 + e2) / rest),
        ],
    ];
    let cross = -8.0 * (p2 * (1.0 + 2.0 * e2) - 16.0 * e2);
    let damping = [
        [2.0 * PI * root * (p2 * (1.0 + 2.0 * e2) - 16.0 * e2) / eps, cross],
        [cross, 2.0 * PI * (p2 * rest * rest + 48.0 * e2) / (eps * root)],
    ];
    [stiffness, damping].map(|matrix| matrix.map(|row| row.map(|own| h * own)))
}

/// Force of the film on the journal over μ R L³/c² from its pressure, p = (6μ/h³)(dh/dt)(z² − L²/4), where that presses;
/// e and ė over c, in space.
fn integrated([x, y]: [f64; 2], [x_dot, y_dot]: [f64; 2], speed: f64) -> [f64; 2] {
    const POINTS: usize = 200_000;
    let mut force = [0.0; 2];
    for k in 0..POINTS {
        let (sin, cos) = (2.0 * PI * (k as f64 + 0.5) / POINTS as f64).sin_cos();
        let h = 1.0 - x * cos - y * sin;
        // ∂h/∂t + ω/2 ∂h/∂ψ.
        let squeeze = -x_dot * cos - y_dot * sin + 0.5 * speed * (x * sin - y * cos);
        let pressure = f64::max(0.0, -squeeze / h.powi(3)) * 2.0 * PI / POINTS as f64;
        force[0] -= pressure * cos;
        force[1] -= pressure * sin;
    }
    force
}

/// The journal of a load that points along −v stands at an angle φ from it.
#[test]
fn closed_forms_are_those_of_the_integrated_film() {
    for eps in [0.2, 0.5, 0.8] {
        let phi = attitude(eps);
        // u: across the load, v: against it. Rotation is from u to v.
        let [u, v] = [eps * phi.sin(), -eps * phi.cos()];
        let force = integrated([u, v], [0.0; 2], 1.0);
        let number = load_number(eps);
        assert!(force[0].abs() < 1e-6 * number, "{force:?}");
        assert!((force[1] / number - 1.0).abs() < 1e-6, "{force:?} for {number}");
        let [stiffness, damping] = coefficients(eps);
        let by = 1e-4;
        for column in 0..2 {
            let moved = |sign: f64| {
                let mut own = [0.0; 2];
                own[column] = sign * by;
                own
            };
            let at = |[du, dv]: [f64; 2]| integrated([u + du, v + dv], [0.0; 2], 1.0);
            let along = |rate: [f64; 2]| integrated([u, v], rate, 1.0);
            let ([a, b], [p, q]) =
                ([at(moved(1.0)), at(moved(-1.0))], [along(moved(1.0)), along(moved(-1.0))]);
            for row in 0..2 {
                let k = -(a[row] - b[row]) / (2.0 * by) / number;
                let c = -(p[row] - q[row]) / (2.0 * by) / number;
                println!(
                    "{eps} {row}{column}: K {k:.5} {:.5}, C {c:.5} {:.5}",
                    stiffness[row][column], damping[row][column]
                );
                assert!((k / stiffness[row][column] - 1.0).abs() < 1e-3);
                assert!((c / damping[row][column] - 1.0).abs() < 1e-3);
            }
        }
    }
}
