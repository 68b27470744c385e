//! Golden sections of a range in which something is largest or least.

/// 1 − 1/golden ratio.
const SHARE: f64 = 0.381_966_011_250_105_1;

/// How far from the best of three the next one is looked for: into the longer of both parts.
pub(super) fn golden_step([low, best, high]: [f64; 3]) -> f64 {
    SHARE * if best < 0.5 * (low + high) { high - best } else { low - best }
}
