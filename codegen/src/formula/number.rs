//! The numbers over which a formula can be evaluated directly.

use crate::rational::Rational;

use crate::rational::nearest;

/// A field with the functions of the formula language.
pub trait Number: Clone {
    /// An exact number.
    fn exact(value: &Rational) -> Self;
    /// The value that comparisons look at.
    fn value(&self) -> f64;
    /// a + b
    fn add(&self, other: &Self) -> Self;
    /// a − b
    fn sub(&self, other: &Self) -> Self;
    /// a·b
    fn mul(&self, other: &Self) -> Self;
    /// a/b
    fn div(&self, other: &Self) -> Self;
    /// aᵇ
    fn power(&self, exponent: &Self) -> Self;
    /// √a
    fn sqrt(&self) -> Self;
    /// eᵃ
    fn exp(&self) -> Self;
    /// ln a
    fn ln(&self) -> Self;
    /// sin a
    fn sin(&self) -> Self;
    /// cos a
    fn cos(&self) -> Self;
    /// tan a
    fn tan(&self) -> Self;
    /// arctan a
    fn atan(&self) -> Self;
    /// tanh a
    fn tanh(&self) -> Self;
    /// |a|
    fn abs(&self) -> Self;
    /// This one, chosen among `all` by its value.
    fn chosen(&self, all: &[Self]) -> Self {
        let _ = all;
        self.clone()
    }
}

impl Number for f64 {
    fn exact(value: &Rational) -> Self {
        nearest(value)
    }
    fn value(&self) -> f64 {
        *self
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn sub(&self, other: &Self) -> Self {
        self - other
    }
    fn mul(&self, other: &Self) -> Self {
        self * other
    }
    fn div(&self, other: &Self) -> Self {
        self / other
    }
    fn power(&self, exponent: &Self) -> Self {
        libm::pow(*self, *exponent)
    }
    fn sqrt(&self) -> Self {
        libm::sqrt(*self)
    }
    fn exp(&self) -> Self {
        libm::exp(*self)
    }
    fn ln(&self) -> Self {
        libm::log(*self)
    }
    fn sin(&self) -> Self {
        libm::sin(*self)
    }
    fn cos(&self) -> Self {
        libm::cos(*self)
    }
    fn tan(&self) -> Self {
        libm::tan(*self)
    }
    fn atan(&self) -> Self {
        libm::atan(*self)
    }
    fn tanh(&self) -> Self {
        libm::tanh(*self)
    }
    fn abs(&self) -> Self {
        f64::abs(*self)
    }
}

/// A value with its derivative along one direction: evaluating a formula over duals differentiates it
/// without any symbolic rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual {
    /// f
    pub value: f64,
    /// df
    pub slope: f64,
}

impl Dual {
    /// A value that does not vary.
    pub fn constant(value: f64) -> Self {
        Dual { value, slope: 0.0 }
    }

    /// A value that varies with slope 1.
    pub fn variable(value: f64) -> Self {
        Dual { value, slope: 1.0 }
    }

    fn chain(&self, value: f64, derivative: f64) -> Self {
        // A derivative that is infinite where nothing varies (√0 of a constant) must not give NaN.
        let slope = if self.slope == 0.0 { 0.0 } else { derivative * self.slope };
        Dual { value, slope }
    }
}

impl Number for Dual {
    fn exact(value: &Rational) -> Self {
        Dual::constant(nearest(value))
    }
    fn value(&self) -> f64 {
        self.value
    }
    fn add(&self, other: &Self) -> Self {
        Dual { value: self.value + other.value, slope: self.slope + other.slope }
    }
    fn sub(&self, other: &Self) -> Self {
        Dual { value: self.value - other.value, slope: self.slope - other.slope }
    }
    fn mul(&self, other: &Self) -> Self {
        Dual {
            value: self.value * other.value,
            slope: self.slope * other.value + self.value * other.slope,
        }
    }
    fn div(&self, other: &Self) -> Self {
        let value = self.value / other.value;
        Dual { value, slope: (self.slope - value * other.slope) / other.value }
    }
    fn power(&self, exponent: &Self) -> Self {
        let b = exponent.value;
        let value = libm::pow(self.value, b);
        let along_base = self.chain(value, b * libm::pow(self.value, b - 1.0));
        let along_exponent = exponent.chain(value, value * libm::log(self.value));
        Dual { value, slope: along_base.slope + along_exponent.slope }
    }
    fn sqrt(&self) -> Self {
        let root = libm::sqrt(self.value);
        self.chain(root, 0.5 / root)
    }
    fn exp(&self) -> Self {
        let value = libm::exp(self.value);
        self.chain(value, value)
    }
    fn ln(&self) -> Self {
        self.chain(libm::log(self.value), 1.0 / self.value)
    }
    fn sin(&self) -> Self {
        self.chain(libm::sin(self.value), libm::cos(self.value))
    }
    fn cos(&self) -> Self {
        self.chain(libm::cos(self.value), -libm::sin(self.value))
    }
    fn tan(&self) -> Self {
        let value = libm::tan(self.value);
        self.chain(value, 1.0 + value * value)
    }
    fn atan(&self) -> Self {
        self.chain(libm::atan(self.value), 1.0 / (1.0 + self.value * self.value))
    }
    fn tanh(&self) -> Self {
        let value = libm::tanh(self.value);
        self.chain(value, 1.0 - value * value)
    }
    fn abs(&self) -> Self {
        let sign = if self.value < 0.0 { -1.0 } else { 1.0 };
        self.chain(f64::abs(self.value), sign)
    }
}
