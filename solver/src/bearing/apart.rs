//! Journal and bore on axes that are apart: Δ, the distance of their axes (fixed in space), as the body of the journal
//! sees it, which turns by θ.

use whirl_specs::Clearance;

/// The axes of the bodies of a journal and of its bore.
#[derive(Clone, Copy)]
pub(crate) struct Apart {
    pub(super) kernels: &'static Clearance,
    /// Place of θ of the journal's body in q; none if it does not turn.
    pub(crate) theta: Option<usize>,
    /// Δ (m).
    pub(super) delta: [f64; 2],
}

/// What Δ adds to ε at one instant, with its rates.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Seen {
    /// What it adds (m), and ∂²/∂θ² of it.
    pub(crate) value: [f64; 2],
    pub(crate) curvature: [f64; 2],
    /// ∂/∂θ of it (m).
    pub(crate) slope: [f64; 2],
    /// ∂(its rate)/∂θ (m/s).
    pub(crate) rate_slope: [f64; 2],
}

impl Apart {
    /// At θ (rad) and θ̇ (rad/s), those in q and q̇.
    pub(super) fn seen(&self, q: &[f64], v: &[f64]) -> Seen {
        let [theta, speed] = self.theta.map_or([0.0; 2], |place| [q[place], v[place]]);
        let [value, slope, curvature] = (self.kernels.apart)(theta, self.delta);
        Seen { value, slope, curvature, rate_slope: curvature.map(|part| part * speed) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_are_those_of_differences() {
        let apart =
            Apart { kernels: &whirl_specs::CLEARANCES[0], theta: Some(0), delta: [0.3, -0.7] };
        let (theta, speed, step) = (0.4, 2.5, 1e-6);
        let at = |theta: f64| apart.seen(&[theta], &[speed]);
        let (own, before, after) = (at(theta), at(theta - step), at(theta + step));
        for axis in 0..2 {
            let slope = (after.value[axis] - before.value[axis]) / (2.0 * step);
            assert!((own.slope[axis] - slope).abs() < 1e-9);
            let rate = |seen: Seen| seen.slope[axis] * speed;
            let slope = (rate(after) - rate(before)) / (2.0 * step);
            assert!((own.rate_slope[axis] - slope).abs() < 1e-9);
        }
        // A journal that stays where it is in space is seen to turn back.
        assert!((own.value[0].hypot(own.value[1]) - 0.3_f64.hypot(0.7)).abs() < 1e-15);
        assert_eq!(Apart { theta: None, ..apart }.seen(&[9.0], &[9.0]).value, [0.3, -0.7]);
    }
}
