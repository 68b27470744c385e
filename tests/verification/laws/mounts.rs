//! Bump foils and rubber mounts, against energies, cycles and exact motions.

use std::f64::consts::PI;

use super::impact::{Body, strike};
use super::kernel::{Kernel, integral};

/// The complete elliptic integral K of modulus k by the arithmetic–geometric mean.
fn elliptic(modulus: f64) -> f64 {
    let (mut a, mut b) = (1.0, f64::sqrt(1.0 - modulus * modulus));
    for _ in 0..10 {
        (a, b) = ((a + b) / 2.0, f64::sqrt(a * b));
    }
    PI / (2.0 * a)
}

#[test]
fn a_mass_on_the_foil_moves_as_duffings_oscillator() {
    let law = Kernel::named("foil-cubic");
    let k_1 = -law.slope("Q", "h", &[("h", -1e-12)]);
    // A free bump as a strip of twice its half length, simply supported and loaded in the middle, by virtual
    // work: a unit load a width bends it by 2 ∫ (x/2)² dx/D. One bump a pitch.
    let (thickness, half_length, pitch, area): (f64, f64, f64, f64) =
        (0.102e-3, 1.778e-3, 4.572e-3, 190e-6);
    let bending = 214e9 * thickness.powi(3) / (12.0 * (1.0 - 0.29 * 0.29));
    let flexibility = 2.0 * integral(0.0, half_length, |x| 0.25 * x * x / bending);
    assert!((k_1 / area * pitch * flexibility - 1.0).abs() < 1e-12, "{k_1}");
    let (mass, hardening) = (0.5, 60e-6);
    for speed in [0.02, 0.1] {
        let found = strike(Body { mass, speed }, |h, _| law.value("Q", &[("h", h)]), 1e-7);
        // m v² = k₁ (X² + X⁴/(2 d₃²)), x = X cn(ωt, κ): the time in contact is half a period, 2K/ω.
        let energy = mass * speed * speed / k_1;
        let half = hardening * hardening;
        let square = half * (f64::sqrt(1.0 + 2.0 * energy / half) - 1.0);
        let omega = f64::sqrt(k_1 / mass * (1.0 + square / half));
        let modulus = f64::sqrt(k_1 / mass * square / half / 2.0) / omega;
        let expected = 2.0 * elliptic(modulus) / omega;
        // The fourth order of the method, at two thousand steps a contact.
        assert!((found.duration / expected - 1.0).abs() < 1e-9, "{found:?} {expected}");
        assert!((found.deepest / square.sqrt() - 1.0).abs() < 1e-6, "{found:?}");
    }
}

#[test]
fn friction_of_the_foil_takes_its_share_of_the_work() {
    let law = Kernel::named("foil-cubic");
    let depth = 40e-6;
    let work =
        |speed: f64| integral(-depth, 0.0, |h| law.value("Q", &[("h", h), ("h_dot", speed)]));
    let (elastic, speed) = (work(0.0), 0.05);
    // A hundred times the speed over which friction turns: tanh is 1 to e^-100.
    let lost = work(-speed) - work(speed);
    assert!((lost / (2.0 * 0.15 * elastic) - 1.0).abs() < 1e-12);
    // Less work back than in, at any speed.
    assert!(work(-1e-4) > elastic && elastic > work(1e-4));
}

#[test]
fn rubber_stores_the_energy_of_a_neo_hookean_block_and_loses_its_share() {
    let law = Kernel::named("elastomer-mount");
    let (thickness, area) = (0.015, PI * 0.015 * 0.015);
    // Lindley's apparent modulus of a disc of shape factor 1/2 at 65 IRHD.
    let modulus = 5.72e6 * (1.0 + 2.0 * 0.54 * 0.25);
    let force = |h: f64, v: f64| law.value("Q", &[("h", h), ("h_dot", v)]);
    for stretch in [0.55, 0.8, 1.2] {
        let end = thickness * (stretch - 1.0);
        let work = -integral(0.0, end, |h| force(h, 0.0));
        // W = G/2 (λ² + 2/λ − 3) a volume, E = 3G: what the force is the derivative of.
        let density = modulus / 6.0 * (stretch * stretch + 2.0 / stretch - 3.0);
        assert!((work / (density * area * thickness) - 1.0).abs() < 1e-10, "{stretch}");
    }
    // Over a cycle at 50 Hz: loss factor = energy lost/(2π · energy stored at the peak).
    let (amplitude, omega) = (1e-4, 2.0 * PI * 50.0);
    let lost = -integral(0.0, 2.0 * PI, |angle| {
        let v = amplitude * omega * angle.cos();
        force(amplitude * angle.sin(), v) * v / omega
    });
    let stored = -integral(0.0, amplitude, |h| force(h, 0.0));
    // The peak energies in and out differ by the amplitude's share of the thickness.
    let factor = lost / (2.0 * PI * stored);
    assert!((factor - 0.1).abs() < 0.1 * amplitude / thickness, "{factor}");
    // Beyond half the thickness the tangent goes on.
    let slope = |share: f64| law.slope("Q", "h", &[("h", -share * thickness)]);
    assert!((slope(0.5 + 1e-9) / slope(0.5 - 1e-9) - 1.0).abs() < 1e-7);
    assert_eq!(slope(0.55), slope(0.6));
}
