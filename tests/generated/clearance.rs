//! The clearance as the formula says it, and the weights of the rings of a bearing.

use whirl_specs::CLEARANCES;
use whirl_specs::clearances::journal::{measures, value};

#[test]
fn the_first_measure_is_the_clearance() {
    let [psi, theta, eps_x, eps_y, delta, c] = [0.7, 2.1, 1.3e-5, -2.2e-5, 4e-6, 3.5e-5];
    let h = value(psi, theta, eps_x, eps_y, delta, c);
    let (sin, cos) = f64::sin_cos(theta);
    let u = [cos * eps_x - sin * eps_y, sin * eps_x + cos * eps_y];
    let exact = c - psi.cos() * u[0] - psi.sin() * u[1] + delta;
    assert!((h - exact).abs() <= 8.0 * f64::EPSILON * c);
    let [b_x, b_y, beta, b_z, g_x, g_y] = [2e-6, 3e-6, 0.1, 4e-6, 0.01, 0.02];
    let [gamma, s_z, a_x, a_y] = [0.2, 5e-6, 0.03, 0.04];
    let all = measures(
        psi, theta, eps_x, eps_y, delta, 1e-6, b_x, b_y, beta, b_z, g_x, g_y, gamma, s_z, a_x, a_y,
        6e-6, 7e-6, 8e-6, 9e-6, 0.4, 0.6, c, 0.03,
    );
    assert_eq!(all[0], h);
}

#[test]
fn axial_functions_interpolate_quadratics() {
    let axial = CLEARANCES[0].axial;
    for (place, s) in [0.0, 0.5, 1.0].into_iter().enumerate() {
        let weights = axial(s);
        assert_eq!(weights, std::array::from_fn(|i| f64::from(u8::from(i == place))));
    }
    let [a, b, c] = axial(0.3);
    let f = |s: f64| 1.0 - 2.0 * s + 5.0 * s * s;
    let value = a * f(0.0) + b * f(0.5) + c * f(1.0);
    assert!((value - f(0.3)).abs() <= 8.0 * f64::EPSILON * 4.0);
}
