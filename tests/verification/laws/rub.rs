//! Rub: Coulomb's law away from rest, and the closed form of a rotor that rubs all around.

use super::kernel::Kernel;

#[test]
fn friction_opposes_slip_and_reaches_its_share_of_the_normal_force() {
    let law = Kernel::named("rub-coulomb");
    for depth in [1e-6, 2e-5] {
        let at = |v_t: f64| {
            let inputs = [("h", -depth), ("v_t", v_t)];
            (law.value("Q", &inputs), law.value("T", &inputs))
        };
        for v_t in [-1.0, -0.2, 0.2, 1.0] {
            let (q, t) = at(v_t);
            assert!((q - 1e7 * depth).abs() <= 1e-15 * q);
            // Twenty times the speed over which it turns: tanh is 1 to 2e^-40.
            assert!((t / q + 0.15 * v_t.signum()).abs() < 1e-15, "{q} {t}");
        }
        for v_t in [-0.02, -1e-4, 1e-4, 0.02] {
            let (q, t) = at(v_t);
            assert!(t * v_t < 0.0 && t.abs() < 0.15 * q, "power is lost at any slip");
        }
        assert_eq!(at(0.0).1, 0.0);
    }
    assert_eq!(law.value("T", &[("h", 1e-6), ("v_t", 1.0)]), 0.0);
}

#[test]
fn a_rotor_rubbing_all_around_turns_by_the_friction_angle() {
    // Synchronous full annular rub of a Jeffcott rotor (m = 1 kg, d = 20 N·s/m, k = 1e4 N/m, e = 0.5 mm,
    // c = 1 mm, Ω = 110 rad/s) in this law's wall, by fixed-point iteration on force and direction:
    // (k − mΩ² + iΩd) r + N + iT = m e Ω² e^{iφ}, with the slip speed ΩR of the journal.
    let law = Kernel::named("rub-coulomb");
    let (m, d, k, e, c, omega) = (1.0_f64, 20.0_f64, 1e4_f64, 0.5e-3_f64, 1e-3_f64, 110.0_f64);
    let inputs = |r: f64| [("h", c - r), ("v_t", omega * 0.05)];
    let size = |r: f64| {
        let along = (k - m * omega * omega) * r + law.value("Q", &inputs(r));
        let across = omega * d * r - law.value("T", &inputs(r));
        f64::hypot(along, across) - m * e * omega * omega
    };
    let (mut low, mut high) = (c, c + 1e-4);
    for _ in 0..80 {
        let middle = f64::midpoint(low, high);
        if size(middle) < 0.0 { low = middle } else { high = middle }
    }
    // The quadratic in r of the closed form: (A r − B)² + (D r − μB)² = F² with A = k + k_w − mΩ²,
    // B = k_w c, D = Ωd + μ k_w.
    let (k_w, mu) = (1e7, 0.15);
    let (a, b, across) = (k + k_w - m * omega * omega, k_w * c, omega * d + mu * k_w);
    let force = m * e * omega * omega;
    let (p, q, s) =
        (a * a + across * across, a * b + across * mu * b, b * b * (1.0 + mu * mu) - force * force);
    let expected = (q + f64::sqrt(q * q - p * s)) / p;
    assert!((low - expected).abs() < 1e-14, "{low} {expected}");
}
