//! Hyper-dual numbers as lanes: two first derivatives and the mixed second one of any primal kernel.

use std::ops::{Add, Div, Mul, Neg, Sub};

use num_dual::{DualNum, HyperDual64};
use whirl_specs::Lane;

/// value + first ε₁ + second ε₂ + mixed ε₁ε₂.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hyper(pub(crate) HyperDual64);

impl Hyper {
    pub(crate) fn new(value: f64, first: f64, second: f64) -> Self {
        Hyper(HyperDual64::new(value, first, second, 0.0))
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident) => {
        impl $trait for Hyper {
            type Output = Self;
            fn $method(self, other: Self) -> Self {
                Hyper(self.0.$method(other.0))
            }
        }
        impl $trait<f64> for Hyper {
            type Output = Self;
            fn $method(self, other: f64) -> Self {
                Hyper(self.0.$method(other))
            }
        }
    };
}

operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for Hyper {
    type Output = Self;
    fn neg(self) -> Self {
        Hyper(-self.0)
    }
}

impl Lane for Hyper {
    type Mask = bool;

    fn splat(value: f64) -> Self {
        Hyper::new(value, 0.0, 0.0)
    }
    fn sqrt(self) -> Self {
        Hyper(self.0.sqrt())
    }
    fn abs(self) -> Self {
        if self.0.re < 0.0 { -self } else { self }
    }
    /// Of constants only: what varies has the derivatives of the functions below.
    fn each(self, function: fn(f64) -> f64) -> Self {
        assert_eq!(self.0, HyperDual64::from_re(self.0.re), "a function without derivatives");
        Hyper::new(function(self.0.re), 0.0, 0.0)
    }
    fn exp(self) -> Self {
        Hyper(self.0.exp())
    }
    fn ln(self) -> Self {
        Hyper(self.0.ln())
    }
    fn sin(self) -> Self {
        Hyper(self.0.sin())
    }
    fn cos(self) -> Self {
        Hyper(self.0.cos())
    }
    fn tan(self) -> Self {
        Hyper(self.0.tan())
    }
    fn atan(self) -> Self {
        Hyper(self.0.atan())
    }
    fn tanh(self) -> Self {
        Hyper(self.0.tanh())
    }
    fn powf(self, exponent: Self) -> Self {
        Hyper(self.0.powd(exponent.0))
    }
    fn lt(self, other: Self) -> bool {
        self.0.re < other.0.re
    }
    fn le(self, other: Self) -> bool {
        self.0.re <= other.0.re
    }
    fn and(a: bool, b: bool) -> bool {
        a & b
    }
    fn or(a: bool, b: bool) -> bool {
        a | b
    }
    fn not(a: bool) -> bool {
        !a
    }
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
}
