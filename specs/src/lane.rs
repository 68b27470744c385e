//! Lanes: the number type over which kernels are written, one value or several side by side.

use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::vector;

/// What many kernels do alike: compiled once for a lane type, not once a kernel.
pub trait Shared<L> {
    /// What it gives.
    type Output;

    /// Does the work. To be `#[inline(always)]`, like all that it calls over lanes: only then is it compiled
    /// for the instructions of L.
    fn run(self) -> Self::Output;
}

/// Defines a function whose work is [`Shared`]. All that it borrows has one lifetime.
macro_rules! shared {
    () => { () };
    ($result:ty) => { $result };
    (
        $(#[$about:meta])*
        $scope:vis fn $name:ident<$life:lifetime, $lane:ident: $bound:ident>(
            $($argument:ident: $type:ty),* $(,)?
        ) $(-> $result:ty)? $body:block
    ) => {
        $(#[$about])*
        #[inline(always)]
        $scope fn $name<$life, $lane: $bound>($($argument: $type),*) $(-> $result)? {
            struct Work<$life, $lane> {
                $($argument: $type),*
            }
            impl<$life, $lane: $bound> $crate::Shared<$lane> for Work<$life, $lane> {
                type Output = shared!($($result)?);

                #[inline(always)]
                fn run(self) -> Self::Output {
                    let Work { $($argument),* } = self;
                    $body
                }
            }
            $lane::shared(Work { $($argument),* })
        }
    };
}

pub(crate) use shared;

/// The functions that are computed one value after the other: `$macro!` of a list of documentation, name and value.
macro_rules! each_function {
    ($macro:ident) => {
        $macro! {
            "eᵃ.", exp = libm::exp;
            "ln a.", ln = libm::log;
            "sin a.", sin = libm::sin;
            "cos a.", cos = libm::cos;
            "tan a.", tan = libm::tan;
            "arctan a.", atan = libm::atan;
            "tanh a.", tanh = libm::tanh;
            "arsinh a.", asinh = libm::asinh;
            "erf a.", erf = libm::erf;
        }
    };
}
#[cfg(test)]
pub(crate) use each_function;

macro_rules! methods {
    ($($about:literal, $name:ident = $value:path;)*) => {
        $(
            #[doc = $about]
            #[inline(always)]
            fn $name(self) -> Self {
                self.each($value)
            }
        )*
    };
}

macro_rules! names {
    ($($about:literal, $name:ident = $value:path;)*) => {
        /// Names of the functions that lanes compute one value after the other.
        pub const FUNCTIONS: &[&str] = &[$(stringify!($name)),*];
    };
}
each_function!(names);

/// A lane of numbers. Kernels are generic over it: `f64` computes one cell or spring at a time, wider
/// lanes compute several, and a dual number differentiates the same text. An `f64` operand stands for
/// the same value in every lane.
///
/// No operator is fused: a formula of operators and functions gives the same bits on every lane type.
/// [`Lane::mul_add`] alone may round once or twice.
pub trait Lane:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// Result of a comparison, one truth value a lane.
    type Mask: Copy;

    /// The same value in every lane.
    fn splat(value: f64) -> Self;
    /// a·b + c, rounded once where the lane type has an instruction for it, else twice.
    #[inline(always)]
    fn mul_add(self, b: Self, c: Self) -> Self {
        self * b + c
    }
    /// −a·b + c, rounded as [`Lane::mul_add`].
    #[inline(always)]
    fn neg_mul_add(self, b: Self, c: Self) -> Self {
        c - self * b
    }
    /// √a.
    fn sqrt(self) -> Self;
    /// |a|.
    fn abs(self) -> Self;
    /// A function of every lane, one value after the other. Those below come from one pinned implementation, so
    /// that every lane type, the tape and every platform give the same bits.
    fn each(self, function: fn(f64) -> f64) -> Self;
    each_function!(methods);
    /// aᵇ for a real exponent b, a > 0.
    fn powf(self, exponent: Self) -> Self;
    /// a < b.
    fn lt(self, other: Self) -> Self::Mask;
    /// a ≤ b.
    fn le(self, other: Self) -> Self::Mask;
    /// Both.
    fn and(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Either.
    fn or(a: Self::Mask, b: Self::Mask) -> Self::Mask;
    /// Not.
    fn not(a: Self::Mask) -> Self::Mask;
    /// `a` where the mask holds, else `b`.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;

    /// Does the work in a function of its own, for the instructions of this lane type.
    fn shared<T: Shared<Self>>(work: T) -> T::Output {
        work.run()
    }
    /// See [`vector::add_columns`].
    fn add_columns(y: &mut [Self], columns: &[f64], x: &[Self]) {
        vector::sum_of_columns(y, columns, x);
    }
    /// See [`vector::dot`].
    fn dot(a: &[Self], b: &[Self]) -> Self {
        vector::sum_of_products(a, b)
    }
    /// See [`vector::dot_numbers`].
    fn dot_numbers(a: &[Self], b: &[f64]) -> Self {
        vector::sum_of_products(a, b)
    }
}

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
        vector::add_columns_of_numbers(y, columns, x);
    }
    fn dot(a: &[f64], b: &[f64]) -> f64 {
        vector::dot_of_numbers(a, b)
    }
    fn dot_numbers(a: &[f64], b: &[f64]) -> f64 {
        vector::dot_of_numbers(a, b)
    }
}
