//! Poles, found by the signs of everything that a formula divides by.

use crate::expression::Function;
use crate::formula::Number;

/// A value, and a digest of the signs of all divisors met on the way to it: two points between which the
/// digest changes have a pole between them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Signed {
    pub(super) value: f64,
    pub(super) signs: u64,
}

impl Signed {
    pub(super) fn new(value: f64) -> Self {
        Signed { value, signs: 0 }
    }

    fn join(&self, other: &Self, value: f64) -> Self {
        Signed { value, signs: mixed(self.signs, other.signs) }
    }

    fn map(&self, value: f64) -> Self {
        Signed { value, signs: self.signs }
    }

    fn divisor(&self) -> Self {
        let sign = u64::from(self.value.is_sign_negative());
        Signed { value: self.value, signs: mixed(self.signs, 1 + sign) }
    }
}

/// Not commutative; 0, the digest of a value without divisors, changes nothing.
fn mixed(a: u64, b: u64) -> u64 {
    match (a, b) {
        (a, 0) => a,
        (0, b) => b,
        (a, b) => (a.rotate_left(5) ^ b).wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1 << 63,
    }
}

impl Number for Signed {
    fn near(value: f64) -> Self {
        Signed::new(value)
    }
    fn value(&self) -> f64 {
        self.value
    }
    fn add(&self, other: &Self) -> Self {
        self.join(other, self.value + other.value)
    }
    fn sub(&self, other: &Self) -> Self {
        self.join(other, self.value - other.value)
    }
    fn mul(&self, other: &Self) -> Self {
        self.join(other, self.value * other.value)
    }
    fn div(&self, other: &Self) -> Self {
        self.join(&other.divisor(), self.value / other.value)
    }
    fn power(&self, exponent: &Self) -> Self {
        let base = if exponent.value < 0.0 { self.divisor() } else { *self };
        base.join(exponent, Number::power(&self.value, &exponent.value))
    }
    fn sqrt(&self) -> Self {
        self.map(Number::sqrt(&self.value))
    }
    fn function(&self, function: Function) -> Self {
        let value = function.value(self.value);
        match function {
            // tan a = sin a/cos a
            Function::Tan => {
                let sign = u64::from(Function::Cos.value(self.value).is_sign_negative());
                Signed { value, signs: mixed(self.signs, 1 + sign) }
            }
            _ => self.map(value),
        }
    }
    /// With the divisors of all, whichever is chosen: a choice between values with and without a divisor is
    /// no pole.
    fn chosen(&self, all: &[Self]) -> Self {
        let signs = all.iter().fold(0, |signs, value| mixed(signs, value.signs));
        Signed { value: self.value, signs }
    }
}
