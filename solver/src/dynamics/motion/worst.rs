//! What is worse than something else, and by how much.

/// The larger of two; what is no number is larger than any, and stays it.
pub(in crate::dynamics) fn larger(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}

/// The larger of two that are told apart by where they are, in the same way.
pub(in crate::dynamics) fn worse<T>(a: (f64, T), b: (f64, T)) -> (f64, T) {
    if b.0 <= a.0 || a.0.is_nan() { a } else { b }
}

/// A value over what it may be: nothing over nothing is nothing.
pub(in crate::dynamics) fn ratio(value: f64, limit: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value / limit }
}
