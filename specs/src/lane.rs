//! Lanes: the number type over which kernels are written, one value or several side by side.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Columns that sums over lanes take at once: each entry of y is loaded and stored once for all of them.
pub(crate) const TOGETHER: usize = 8;

/// Partial sums of a product.
const PARTS: usize = 8;

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
    /// See [`crate::vector::add_columns`].
    fn add_columns(y: &mut [Self], columns: &[f64], x: &[Self]) {
        sum_of_columns(y, columns, x);
    }
    /// See [`crate::vector::dot`].
    fn dot(a: &[Self], b: &[Self]) -> Self {
        sum_of_products(a, b)
    }
    /// See [`crate::vector::dot_numbers`].
    fn dot_numbers(a: &[Self], b: &[f64]) -> Self {
        sum_of_products(a, b)
    }
}

/// [`Lane::add_columns`] on any lane type.
#[inline(always)]
fn sum_of_columns<L: Lane>(y: &mut [L], columns: &[f64], x: &[L]) {
    let n = y.len();
    let (all, some) = x.as_chunks::<TOGETHER>();
    let (half, rest) = some.as_chunks::<{ TOGETHER / 2 }>();
    let mut columns = columns;
    for x in all {
        columns = sum_of_some(y, columns, x);
    }
    for x in half {
        columns = sum_of_some(y, columns, x);
    }
    for (column, x) in columns.chunks(n.max(1)).zip(rest) {
        let column = &column[..n];
        for i in 0..n {
            y[i] = y[i] + *x * column[i];
        }
    }
}

/// Adds as many columns as there are factors; the columns after them.
#[inline(always)]
fn sum_of_some<'c, L: Lane, const N: usize>(
    y: &mut [L],
    columns: &'c [f64],
    x: &[L; N],
) -> &'c [f64] {
    let n = y.len();
    let (own, rest) = columns.split_at(N * n);
    let own: [&[f64]; N] = std::array::from_fn(|j| &own[j * n..(j + 1) * n]);
    for i in 0..n {
        let mut sum = y[i];
        for j in 0..N {
            sum = sum + x[j] * own[j][i];
        }
        y[i] = sum;
    }
    rest
}

/// [`Lane::dot`] and [`Lane::dot_numbers`] on any lane type.
#[inline(always)]
pub(crate) fn sum_of_products<L: Lane + Mul<A, Output = L>, A: Copy>(a: &[L], b: &[A]) -> L {
    let b = &b[..a.len()];
    let mut parts = [L::splat(0.0); PARTS];
    let ((a, last), (b, rest)) = (a.as_chunks::<PARTS>(), b.as_chunks::<PARTS>());
    for (a, b) in a.iter().zip(b) {
        for i in 0..PARTS {
            parts[i] = parts[i] + a[i] * b[i];
        }
    }
    // Of a length that is known the partial sums stay in registers.
    match last.len() {
        0 => {}
        1 => add_last::<L, A, 1>(&mut parts, last, rest),
        2 => add_last::<L, A, 2>(&mut parts, last, rest),
        3 => add_last::<L, A, 3>(&mut parts, last, rest),
        4 => add_last::<L, A, 4>(&mut parts, last, rest),
        5 => add_last::<L, A, 5>(&mut parts, last, rest),
        6 => add_last::<L, A, 6>(&mut parts, last, rest),
        _ => add_last::<L, A, 7>(&mut parts, last, rest),
    }
    let [a, b, c, d, e, f, g, h] = parts;
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}

/// Adds the products of the last N terms to as many partial sums.
#[inline(always)]
fn add_last<L: Lane + Mul<A, Output = L>, A: Copy, const N: usize>(
    parts: &mut [L; PARTS],
    a: &[L],
    b: &[A],
) {
    let (a, b) = (&a[..N], &b[..N]);
    for i in 0..N {
        parts[i] = parts[i] + a[i] * b[i];
    }
}
