//! One number as a lane.

use std::cell::Cell;

use crate::columns;
use crate::lane::{Lane, Shared, sum_of_products};
use crate::wide::wide;

thread_local! {
    /// The bits of angles, the last one first, and the function of them: rings of one machine ask for the same two angles, of
    /// the shaft and of the bore, one after the other.
    static SIN: Cell<[(u64, f64); 2]> = const { Cell::new([(0, 0.0); 2]) };
    static COS: Cell<[(u64, f64); 2]> = const { Cell::new([(0, 1.0); 2]) };
}

#[inline(always)]
fn remembered(known: &Cell<[(u64, f64); 2]>, angle: f64, function: fn(f64) -> f64) -> f64 {
    let [last, older] = known.get();
    let bits = angle.to_bits();
    if last.0 == bits {
        return last.1;
    }
    let value = if older.0 == bits { older.1 } else { function(angle) };
    known.set([(bits, value), last]);
    value
}

impl Lane for f64 {
    type Mask = bool;

    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn each(self, function: fn(f64) -> f64) -> Self {
        function(self)
    }
    #[inline(always)]
    fn sin(self) -> Self {
        SIN.with(|last| remembered(last, self, libm::sin))
    }
    #[inline(always)]
    fn cos(self) -> Self {
        COS.with(|last| remembered(last, self, libm::cos))
    }
    #[inline(always)]
    fn powf(self, exponent: Self) -> Self {
        libm::pow(self, exponent)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> bool {
        self < other
    }
    #[inline(always)]
    fn le(self, other: Self) -> bool {
        self <= other
    }
    #[inline(always)]
    fn and(a: bool, b: bool) -> bool {
        a & b
    }
    #[inline(always)]
    fn or(a: bool, b: bool) -> bool {
        a | b
    }
    #[inline(always)]
    fn not(a: bool) -> bool {
        !a
    }
    #[inline(always)]
    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }
    #[inline(never)]
    fn shared<T: Shared<f64>>(work: T) -> T::Output {
        work.run()
    }
    fn add_columns(y: &mut [f64], columns: &[f64], x: &[f64]) {
        columns::add_matrix(y, columns, x);
    }
    fn dot(a: &[f64], b: &[f64]) -> f64 {
        dot_of_numbers(a, b)
    }
    fn dot_numbers(a: &[f64], b: &[f64]) -> f64 {
        dot_of_numbers(a, b)
    }
}

// What `f64` computes with: compiled once for each register, not once a kernel.
wide!(product_of_numbers as dot_of_numbers(a: &[f64], b: &[f64]) -> f64);

#[inline(always)]
fn product_of_numbers<L: Lane>(a: &[L], b: &[f64]) -> L {
    sum_of_products(a, b)
}
