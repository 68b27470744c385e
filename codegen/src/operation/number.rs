//! The numbers over which a formula can be evaluated directly.

use super::{Arithmetic, Function};
use crate::rational::{Rational, nearest};

impl<N: Number> Arithmetic for N {
    fn number(&self, value: f64) -> Self {
        N::near(value)
    }
    fn plus(&self, other: &Self) -> Self {
        self.add(other)
    }
    fn minus(&self, other: &Self) -> Self {
        self.sub(other)
    }
    fn times(&self, other: &Self) -> Self {
        self.mul(other)
    }
    fn over(&self, other: &Self) -> Self {
        self.div(other)
    }
    fn root(&self) -> Self {
        self.sqrt()
    }
    fn sign(&self) -> Self {
        N::near(if self.value() < 0.0 { -1.0 } else { 1.0 })
    }
    fn through(&self, function: Function) -> Self {
        self.function(function)
    }
}

/// A field with the functions of the formula language.
pub trait Number: Clone {
    /// The f64 nearest to an exact number.
    fn near(value: f64) -> Self;
    /// An exact number.
    fn exact(value: &Rational) -> Self {
        Self::near(nearest(value))
    }
    /// The value that comparisons compare.
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
    /// A function of one number.
    fn function(&self, function: Function) -> Self;
    /// The first or the second.
    fn chosen(first: bool, a: Self, b: Self) -> Self {
        if first { a } else { b }
    }
}

impl Number for f64 {
    fn near(value: f64) -> Self {
        value
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
    fn function(&self, function: Function) -> Self {
        function.value(*self)
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
    fn near(value: f64) -> Self {
        Dual::constant(value)
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
    fn function(&self, function: Function) -> Self {
        let value = function.value(self.value);
        self.chain(value, function.slope(&self.value, &value))
    }
}
