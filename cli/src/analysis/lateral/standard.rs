//! Formulas of API 617 and API RP 684, in the units in which they are written there. Sources: `docs/lateral.md`.

/// From this amplification factor on a peak is a critical speed.
pub(super) const CRITICAL: f64 = 2.5;
/// Share of the least diametral clearance that the scaled response may take.
pub(super) const CLEARANCE: f64 = 0.75;
/// The least logarithmic decrement.
pub(super) const DECREMENT: f64 = 0.1;
/// Q₀/Q_A below which stability of level II is asked for, and below which it depends on the region.
pub(super) const RATIOS: [f64; 2] = [2.0, 10.0];

/// How many times the residual unbalance is applied.
pub(super) fn factor(edition: usize) -> f64 {
    if edition < 8 { 4.0 } else { 2.0 }
}

/// U_r (g·mm) by a load W (kg) and N_mc (rpm).
pub(super) fn residual_unbalance(load: f64, speed: f64) -> f64 {
    if speed < 25_000.0 { 6350.0 * load / speed } else { load / 3.937 }
}

/// A_vl (µm, peak to peak) by N_mc (rpm).
pub(super) fn vibration_limit(speed: f64) -> f64 {
    (25.4 * (12_000.0 / speed).sqrt()).min(25.4)
}

/// Required separation margin (%) of N_ma above a critical speed.
pub(super) fn margin_below(factor: f64) -> f64 {
    (17.0 * (1.0 - 1.0 / (factor - 1.5))).min(16.0)
}

/// Required separation margin (%) of a critical speed above N_mc.
pub(super) fn margin_above(factor: f64) -> f64 {
    (10.0 + 17.0 * (1.0 - 1.0 / (factor - 1.5))).min(26.0)
}

/// q_A (N/m) of an impeller: power (W), speed (rad/s), diameter and width (m), ρ_d/ρ_s; B_c = 3.
pub(super) fn of_impeller(power: f64, speed: f64, [diameter, width]: [f64; 2], ratio: f64) -> f64 {
    3.0 * power / speed * ratio / (diameter * width)
}

/// q_A (N/m) of a row of blades, by its pitch diameter and its height (m); B_t = 1.5.
pub(super) fn of_blades(power: f64, speed: f64, [diameter, height]: [f64; 2]) -> f64 {
    1.5 * power / speed / (diameter * height)
}

/// The critical speed ratio above which a machine is in region B, by the average density of its gas (kg/m³).
pub(super) fn region_boundary(density: f64) -> f64 {
    match density {
        own if own <= 16.53 => 2.5,
        own if own <= 60.0 => 2.5 - 0.5 * (own - 16.53) / (60.0 - 16.53),
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values worked out by hand.
    #[test]
    fn formulas_have_the_values_of_the_standard() {
        let near = |found: f64, exact: f64| assert!((found / exact - 1.0).abs() < 1e-12, "{found}");
        near(factor(9) * residual_unbalance(100.0, 12_700.0), 100.0);
        near(factor(7) * residual_unbalance(100.0, 12_700.0), 200.0);
        near(residual_unbalance(39.37, 30_000.0), 10.0);
        // Both formulas agree at 25 000 rpm to the digits of the second.
        assert!(
            (residual_unbalance(1.0, 24_999.999) / residual_unbalance(1.0, 25_000.0) - 1.0).abs()
                < 1e-4
        );
        near(vibration_limit(12_000.0), 25.4);
        near(vibration_limit(48_000.0), 12.7);
        near(vibration_limit(3000.0), 25.4);
        assert_eq!([margin_below(2.5), margin_above(2.5)], [0.0, 10.0]);
        near(margin_below(3.5), 8.5);
        near(margin_above(3.5), 18.5);
        assert_eq!([margin_below(1e9), margin_above(1e9)], [16.0, 26.0]);
        // 9.55 · 3 · 1e6 / (400 · 10 · 9550) · 1.5 kN/mm, as the standard writes it.
        let speed = 9550.0 * std::f64::consts::TAU / 60.0;
        assert!(
            (of_impeller(1e6, speed, [0.4, 0.01], 1.5)
                / (9.55 * 3.0 * 1e6 / (400.0 * 10.0 * 9550.0) * 1.5 * 1e6)
                - 1.0)
                .abs()
                < 1e-4
        );
        near(of_blades(1e6, 1000.0, [0.5, 0.1]), 3e4);
        near(region_boundary(60.0), 2.0);
        assert_eq!([region_boundary(10.0), region_boundary(61.0)], [2.5, 0.0]);
    }
}
