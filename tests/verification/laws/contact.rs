//! Laws of contact without damping, against what their sources imply.

use std::f64::consts::PI;

use super::impact::{Body, strike};
use super::kernel::{Kernel, integral};

/// 1/E* = 2 (1 − ν²)/E of steel on steel, 200 GPa and 0.3, to the five digits of the files.
const CONTACT_MODULUS: f64 = 109.89e9;

#[test]
fn a_mass_leaves_the_linear_spring_after_half_a_period() {
    let (k, mass, speed, step) = (1e7, 2.0, 0.03, 1e-6);
    let law = Kernel::named("gap-linear");
    let found = strike(Body { mass, speed }, |h, _| law.value("Q", &[("h", h)]), step);
    // Half a sine, whatever the speed.
    assert!((found.duration - PI * f64::sqrt(mass / k)).abs() < 1e-8 * found.duration);
    // The peak is seen at steps, at most half a step away from where it is.
    let missed = 0.5 * k / mass * (step / 2.0).powi(2);
    assert!((found.peak - speed * f64::sqrt(k * mass)).abs() <= (missed + 1e-9) * found.peak);
    assert!((found.rebound - speed).abs() < 1e-9 * speed);
}

#[test]
fn the_force_of_the_cylinder_satisfies_johnsons_implicit_formula() {
    let (length, difference) = (0.025, 50e-6);
    let law = Kernel::named("hertz-cylinder");
    for indentation in [1e-7, 3e-7, 1e-6, 3e-6, 5e-6, 9e-6, 9.9e-6] {
        let at = [("h", -indentation)];
        let q = law.value("Q", &at) / length;
        let logarithm = f64::ln(4.0 * PI * CONTACT_MODULUS * difference / q);
        let expected = q / (PI * CONTACT_MODULUS) * (logarithm - 1.0);
        // 3e-8 of the force remain after the one step on Barry's formula; the root under which the law is
        // smooth at first touch adds half the square of 1 nm over the indentation.
        let smooth = 0.5 * (1e-9 / indentation).powi(2);
        assert!((expected - indentation).abs() <= (5e-8 + smooth) * indentation, "{indentation}");
        // dd/dq of the same formula.
        let compliance = (logarithm - 2.0) / (PI * CONTACT_MODULUS * length);
        let slope = -law.slope("Q", "h", &at);
        // The slope magnifies by 1/(−1 − W) ≤ 1 the error of the force, and its own is that of a fit.
        assert!((slope * compliance - 1.0).abs() <= 1e-6 + 4.0 * smooth, "{indentation}");
    }
}

#[test]
fn the_force_of_the_cylinder_is_smooth_at_first_touch_and_where_the_formula_ends() {
    let law = Kernel::named("hertz-cylinder");
    let slope = |h: f64| law.slope("Q", "h", &[("h", h)]);
    assert_eq!(law.value("Q", &[("h", 0.0)]), 0.0);
    assert_eq!(law.value("Q", &[("h", 1e-9)]), 0.0);
    // A fifth of the difference of the radii: the tangent goes on.
    let end = 10e-6;
    let (inside, outside) = (slope(-end * (1.0 - 1e-9)), slope(-end * (1.0 + 1e-9)));
    assert!((inside / outside - 1.0).abs() < 1e-7, "{inside} {outside}");
    assert!((slope(-1.5 * end) / outside - 1.0).abs() < 1e-7);
}

/// F₅⸝₂(H) = ∫ (s − H)^(5/2) exp(−s²/2) ds/√(2π) from H up.
fn asperity_integral(height: f64) -> f64 {
    let density = |s: f64| (s - height).powf(2.5) * f64::exp(-s * s / 2.0) / f64::sqrt(2.0 * PI);
    integral(height, height + 12.0, density)
}

#[test]
fn asperities_carry_what_greenwood_and_tripps_integral_says() {
    // Γ(7/4) = 0.9190625268: F₅⸝₂(0) = 2^(3/4) Γ(7/4)/√(2π).
    let at_zero = 2.0_f64.powf(0.75) * 0.919_062_526_8 / f64::sqrt(2.0 * PI);
    assert!((asperity_integral(0.0) / at_zero - 1.0).abs() < 1e-10);

    let law = Kernel::named("greenwood-tripp");
    let force = |height: f64| law.value("Q", &[("h", 1e-6 * height)]);
    let pressure = 16.0 * f64::sqrt(2.0) * PI / 15.0 * 0.055_f64.powi(2) * f64::sqrt(1e-3);
    let scale = pressure * CONTACT_MODULUS * 75e-6;
    // What a Gauss rule of six points leaves of the integral, which grows with the twelfth derivative of
    // exp(−Ht): from digits of the weights to parts in a thousand where one part in 1e5 of the force is left.
    for (height, bound) in
        [(0.0, 1e-11), (0.5, 1e-11), (1.0, 5e-9), (2.0, 6e-6), (3.0, 3e-4), (4.0, 3e-3)]
    {
        let error = force(height) / scale / asperity_integral(height) - 1.0;
        assert!(error.abs() < bound, "{height}: {error}");
        // The fit in common use, to its own accuracy in the middle of its range.
        if (0.5..=2.0).contains(&height) {
            let fit = 4.4086e-5 * (4.0 - height).powf(6.804);
            assert!((force(height) / scale / fit - 1.0).abs() < 0.11, "{height}");
        }
    }
    // dF₅⸝₂/dH = −5/2 F₃⸝₂, and F₃⸝₂(0) = 2^(1/4) Γ(5/4)/√(2π), on both sides of H = 0.
    let expected = 2.5 * 2.0_f64.powf(0.25) * 0.906_402_477_1 / f64::sqrt(2.0 * PI);
    for height in [-1.0, -1e-9, 0.0, 1e-9] {
        let slope = -1e-6 * law.slope("Q", "h", &[("h", 1e-6 * height)]) / scale;
        assert!((slope / expected - 1.0).abs() < 1e-8, "{height}: {slope} {expected}");
    }
}
