//! A value with its derivative along one direction, both with a bound of their rounding error: evaluating a
//! file's formulas over it differentiates them without any symbolic rule.

use whirl_codegen::expression::Function;
use whirl_codegen::operation::{Number, Rounded};

/// f and df.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slope {
    pub(super) value: Rounded,
    pub(super) slope: Rounded,
}

const EXACTLY_ZERO: Rounded = Rounded { value: 0.0, error: 0.0 };
const EXACTLY_ONE: Rounded = Rounded { value: 1.0, error: 0.0 };

impl Slope {
    /// An input, which varies or does not. The value is what it is: not rounded.
    pub(super) fn input(value: f64, varies: bool) -> Self {
        let slope = if varies { EXACTLY_ONE } else { EXACTLY_ZERO };
        Slope { value: Rounded { value, error: 0.0 }, slope }
    }

    fn varies(&self) -> bool {
        self.slope != EXACTLY_ZERO
    }

    /// f(a) with f′(a), where `derivative` may have no value as long as nothing varies.
    fn chain(&self, value: Rounded, derivative: impl FnOnce() -> Rounded) -> Self {
        let slope = if self.varies() { derivative().mul(&self.slope) } else { EXACTLY_ZERO };
        Slope { value, slope }
    }
}

fn one() -> Rounded {
    EXACTLY_ONE
}

impl Number for Slope {
    fn near(value: f64) -> Self {
        Slope { value: Rounded::near(value), slope: EXACTLY_ZERO }
    }
    fn value(&self) -> f64 {
        self.value.value
    }
    fn add(&self, other: &Self) -> Self {
        Slope { value: self.value.add(&other.value), slope: self.slope.add(&other.slope) }
    }
    fn sub(&self, other: &Self) -> Self {
        Slope { value: self.value.sub(&other.value), slope: self.slope.sub(&other.slope) }
    }
    fn mul(&self, other: &Self) -> Self {
        let (a, b) = (self.slope.mul(&other.value), self.value.mul(&other.slope));
        Slope { value: self.value.mul(&other.value), slope: a.add(&b) }
    }
    fn div(&self, other: &Self) -> Self {
        let value = self.value.div(&other.value);
        let slope = self.slope.sub(&value.mul(&other.slope)).div(&other.value);
        Slope { value, slope }
    }
    fn power(&self, exponent: &Self) -> Self {
        let value = self.value.power(&exponent.value);
        let along_base = self
            .chain(value, || exponent.value.mul(&self.value.power(&exponent.value.sub(&one()))));
        let along_exponent =
            exponent.chain(value, || value.mul(&self.value.function(Function::Ln)));
        Slope { value, slope: along_base.slope.add(&along_exponent.slope) }
    }
    fn sqrt(&self) -> Self {
        let root = self.value.sqrt();
        self.chain(root, || one().div(&root.add(&root)))
    }
    fn function(&self, function: Function) -> Self {
        let value = self.value.function(function);
        self.chain(value, || function.slope(&self.value, &value))
    }
}
