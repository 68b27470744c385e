//! Registers of x86-64 processors. Nothing but [`crate::registers`] may name the types, which hands them to a task
//! only where the processor has their instructions: that is what makes the calls below sound.

use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::register::{Register, Sums, Zeros};
use crate::sine::{Cosine, Sine};
use crate::{Lane, Shared};

/// A lane type by intrinsics. What is not to be inlined is compiled once, not for every kernel; the functions behind
/// it have the instructions of the registers. Arguments: vector, mask type, width, features; names of the operations;
/// the operations that differ between the sets of instructions.
macro_rules! register {
    (
        $(#[$about:meta])*
        $name:ident($vector:ty, $mask:ty, $width:literal, $features:literal);
        shared $shared:ident,
        single $single:ident($singles:ty, $many:literal; $to_all:ident, $load_single:ident, $store_single:ident, $times:ident, $plus:ident),
        splat $splat:ident, load $load:ident, store $store:ident, sqrt $sqrt:ident, fused $fused:ident, negative $negative:ident,
        operators [$($trait:ident $method:ident $intrinsic:ident),*];
        neg($n:ident) $neg:expr;
        abs($b:ident) $abs:expr;
        compare($x:ident, $y:ident) $less:expr, $at_most:expr;
        masks($p:ident, $q:ident) $and:expr, $or:expr, $not:expr;
        select($m:ident, $t:ident, $f:ident) $select:expr;
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, Copy)]
        #[repr(transparent)]
        pub(crate) struct $name($vector);

        $(
            impl $trait for $name {
                type Output = Self;
                #[inline(always)]
                fn $method(self, other: Self) -> Self {
                    // SAFETY: as the module says.
                    $name(unsafe { $intrinsic(self.0, other.0) })
                }
            }
            impl $trait<f64> for $name {
                type Output = Self;
                #[inline(always)]
                fn $method(self, other: f64) -> Self {
                    self.$method($name::splat(other))
                }
            }
        )*

        impl Neg for $name {
            type Output = Self;
            #[inline(always)]
            fn neg(self) -> Self {
                let $n = self.0;
                // SAFETY: as the module says.
                $name(unsafe { $neg })
            }
        }

        // SAFETY: numbers.
        unsafe impl Zeros for $name {}

        impl $name {
            #[inline(always)]
            fn from_array(values: [f64; $width]) -> Self {
                Self::load(&values)
            }

            /// Whether a mask holds anywhere.
            #[inline(always)]
            fn any(mask: $mask) -> bool {
                let [yes, no] = [Self::splat(1.0), Self::splat(0.0)];
                Self::select(mask, yes, no).to_array() != [0.0; $width]
            }

            #[inline(always)]
            fn to_array(self) -> [f64; $width] {
                let mut values = [0.0; $width];
                self.store(&mut values);
                values
            }
        }

        impl Lane for $name {
            type Mask = $mask;

            #[inline(always)]
            fn splat(value: f64) -> Self {
                // SAFETY: as the module says.
                $name(unsafe { $splat(value) })
            }
            #[inline(always)]
            fn mul_add(self, b: Self, c: Self) -> Self {
                // SAFETY: as the module says.
                $name(unsafe { $fused(self.0, b.0, c.0) })
            }
            #[inline(always)]
            fn neg_mul_add(self, b: Self, c: Self) -> Self {
                // SAFETY: as the module says.
                $name(unsafe { $negative(self.0, b.0, c.0) })
            }
            #[inline(always)]
            fn sqrt(self) -> Self {
                // SAFETY: as the module says.
                $name(unsafe { $sqrt(self.0) })
            }
            #[inline(always)]
            fn abs(self) -> Self {
                let $b = self.0;
                // SAFETY: as the module says.
                $name(unsafe { $abs })
            }
            #[inline(always)]
            fn each(self, function: fn(f64) -> f64) -> Self {
                let mut values = self.to_array();
                one_by_one(&mut values, function);
                Self::from_array(values)
            }
            #[inline(always)]
            fn sin(self) -> Self {
                let (value, left) = Self::shared(Sine(self));
                if Self::any(left) { self.each(libm::sin) } else { value }
            }
            #[inline(always)]
            fn cos(self) -> Self {
                let (value, left) = Self::shared(Cosine(self));
                if Self::any(left) { self.each(libm::cos) } else { value }
            }
            #[inline(always)]
            fn powf(self, exponent: Self) -> Self {
                let mut values = self.to_array();
                powers(&mut values, &exponent.to_array());
                Self::from_array(values)
            }
            #[inline(always)]
            fn lt(self, other: Self) -> $mask {
                let ($x, $y) = (self.0, other.0);
                // SAFETY: as the module says.
                unsafe { $less }
            }
            #[inline(always)]
            fn le(self, other: Self) -> $mask {
                let ($x, $y) = (self.0, other.0);
                // SAFETY: as the module says.
                unsafe { $at_most }
            }
            #[inline(always)]
            fn and($p: $mask, $q: $mask) -> $mask {
                #[allow(unused_unsafe, reason = "masks of some registers are plain integers")]
                // SAFETY: as the module says.
                unsafe { $and }
            }
            #[inline(always)]
            fn or($p: $mask, $q: $mask) -> $mask {
                #[allow(unused_unsafe, reason = "masks of some registers are plain integers")]
                // SAFETY: as the module says.
                unsafe { $or }
            }
            #[inline(always)]
            fn not($p: $mask) -> $mask {
                #[allow(unused_unsafe, reason = "masks of some registers are plain integers")]
                // SAFETY: as the module says.
                unsafe { $not }
            }
            #[inline(always)]
            fn select($m: $mask, a: Self, b: Self) -> Self {
                let ($t, $f) = (a.0, b.0);
                // SAFETY: as the module says.
                $name(unsafe { $select })
            }
            #[inline(never)]
            fn shared<T: Shared<Self>>(work: T) -> T::Output {
                // SAFETY: as the module says.
                unsafe { $shared(work) }
            }
        }

        #[target_feature(enable = $features)]
        fn $shared<T: Shared<$name>>(work: T) -> T::Output {
            work.run()
        }

        /// Numbers in single precision.
        #[derive(Debug, Clone, Copy)]
        #[repr(transparent)]
        pub(crate) struct $single($singles);

        impl Sums for $single {
            type Number = f32;
            const WIDTH: usize = $many;

            #[inline(always)]
            fn load_from(row: &[f32]) -> Self {
                // SAFETY: as the module says; the row has as many values as are read.
                $single(unsafe { $load_single(row[..$many].as_ptr()) })
            }
            #[inline(always)]
            fn store_to(self, row: &mut [f32]) {
                // SAFETY: as the module says; the row has as many values as are written.
                unsafe { $store_single(row[..$many].as_mut_ptr(), self.0) }
            }
            #[inline(always)]
            fn plus(self, a: f32, b: Self) -> Self {
                // SAFETY: as the module says.
                $single(unsafe { $plus(self.0, $times($to_all(a), b.0)) })
            }
        }

        impl Register for $name {
            const WIDTH: usize = $width;
            // AVX-512 has 32, the others 16.
            const MANY: bool = $width == 8;
            type Chunk = [f64; $width];
            type Single = $single;

            #[inline(always)]
            fn chunks(row: &[f64]) -> &[[f64; $width]] {
                row.as_chunks().0
            }
            #[inline(always)]
            fn chunks_mut(row: &mut [f64]) -> &mut [[f64; $width]] {
                row.as_chunks_mut().0
            }
            #[inline(always)]
            fn load(chunk: &[f64; $width]) -> Self {
                // SAFETY: as the module says; the chunk has as many values as are read.
                $name(unsafe { $load(chunk.as_ptr()) })
            }
            #[inline(always)]
            fn store(self, chunk: &mut [f64; $width]) {
                // SAFETY: as the module says; the chunk has as many values as are written.
                unsafe { $store(chunk.as_mut_ptr(), self.0) }
            }
            #[inline(always)]
            fn gather(rows: &[f64], values: &mut [Self]) {
                let columns = values.len();
                let last = rows.len() / columns - 1;
                // SAFETY: a lane is as many values without padding, so that this is all of them.
                let lanes: &mut [[f64; $width]] =
                    unsafe { std::slice::from_raw_parts_mut(values.as_mut_ptr().cast(), columns) };
                let mut first = 0;
                while first < $width {
                    let row = |c: usize| &rows[(first + c).min(last) * columns..][..columns];
                    let [a, b, c, d] = [row(0), row(1), row(2), row(3)];
                    let whole = columns - columns % 4;
                    let mut v = 0;
                    while v < whole {
                        // SAFETY: four values begin at v < whole in every row, and at `first` in a lane.
                        unsafe {
                            let turned = transposed([
                                _mm256_loadu_pd(a.as_ptr().add(v)),
                                _mm256_loadu_pd(b.as_ptr().add(v)),
                                _mm256_loadu_pd(c.as_ptr().add(v)),
                                _mm256_loadu_pd(d.as_ptr().add(v)),
                            ]);
                            let to = lanes.as_mut_ptr().add(v).cast::<f64>().add(first);
                            _mm256_storeu_pd(to, turned[0]);
                            _mm256_storeu_pd(to.add($width), turned[1]);
                            _mm256_storeu_pd(to.add(2 * $width), turned[2]);
                            _mm256_storeu_pd(to.add(3 * $width), turned[3]);
                        }
                        v += 4;
                    }
                    for v in whole..columns {
                        for (lane, row) in lanes[v][first..].iter_mut().zip([a, b, c, d]) {
                            *lane = row[v];
                        }
                    }
                    first += 4;
                }
            }
            #[inline(always)]
            fn scatter(values: &[Self], rows: &mut [f64]) {
                // SAFETY: a lane is as many values without padding, so that this is all of them.
                let lanes: &[[f64; $width]] =
                    unsafe { std::slice::from_raw_parts(values.as_ptr().cast(), values.len()) };
                for (c, row) in rows.chunks_exact_mut(lanes.len()).take($width).enumerate() {
                    for (value, lane) in row.iter_mut().zip(lanes) {
                        *value = lane[c];
                    }
                }
            }
        }
    };
}

/// A function of every value.
#[inline(never)]
fn one_by_one(values: &mut [f64], function: fn(f64) -> f64) {
    for value in values {
        *value = function(*value);
    }
}

/// Every value to a power of its own.
#[inline(never)]
fn powers(values: &mut [f64], exponents: &[f64]) {
    for (value, exponent) in values.iter_mut().zip(exponents) {
        *value = libm::pow(*value, *exponent);
    }
}

/// Columns of a 4 × 4 matrix from its rows.
#[inline(always)]
fn transposed(rows: [__m256d; 4]) -> [__m256d; 4] {
    let [a, b, c, d] = rows;
    // SAFETY: as the module says.
    unsafe {
        let (ab0, ab1) = (_mm256_unpacklo_pd(a, b), _mm256_unpackhi_pd(a, b));
        let (cd0, cd1) = (_mm256_unpacklo_pd(c, d), _mm256_unpackhi_pd(c, d));
        [
            _mm256_permute2f128_pd::<0x20>(ab0, cd0),
            _mm256_permute2f128_pd::<0x20>(ab1, cd1),
            _mm256_permute2f128_pd::<0x31>(ab0, cd0),
            _mm256_permute2f128_pd::<0x31>(ab1, cd1),
        ]
    }
}

register! {
    /// Four values in a register of AVX2, with FMA.
    F64x4(__m256d, __m256d, 4, "avx2,fma");
    shared shared_4,
    single F32x8(__m256, 8; _mm256_set1_ps, _mm256_loadu_ps, _mm256_storeu_ps, _mm256_mul_ps, _mm256_add_ps),
    splat _mm256_set1_pd, load _mm256_loadu_pd, store _mm256_storeu_pd, sqrt _mm256_sqrt_pd,
    fused _mm256_fmadd_pd, negative _mm256_fnmadd_pd,
    operators [
        Add add _mm256_add_pd, Sub sub _mm256_sub_pd, Mul mul _mm256_mul_pd, Div div _mm256_div_pd
    ];
    neg(a) _mm256_xor_pd(a, _mm256_set1_pd(-0.0));
    abs(a) _mm256_andnot_pd(_mm256_set1_pd(-0.0), a);
    compare(a, b) _mm256_cmp_pd::<_CMP_LT_OQ>(a, b), _mm256_cmp_pd::<_CMP_LE_OQ>(a, b);
    masks(a, b) _mm256_and_pd(a, b), _mm256_or_pd(a, b),
        _mm256_xor_pd(a, _mm256_castsi256_pd(_mm256_set1_epi64x(-1)));
    select(mask, a, b) _mm256_blendv_pd(b, a, mask);
}

register! {
    /// Eight values in a register of AVX-512.
    F64x8(__m512d, __mmask8, 8, "avx512f,avx2,fma");
    shared shared_8,
    single F32x16(__m512, 16; _mm512_set1_ps, _mm512_loadu_ps, _mm512_storeu_ps, _mm512_mul_ps, _mm512_add_ps),
    splat _mm512_set1_pd, load _mm512_loadu_pd, store _mm512_storeu_pd, sqrt _mm512_sqrt_pd,
    fused _mm512_fmadd_pd, negative _mm512_fnmadd_pd,
    operators [
        Add add _mm512_add_pd, Sub sub _mm512_sub_pd, Mul mul _mm512_mul_pd, Div div _mm512_div_pd
    ];
    // Bitwise operations on numbers are not part of the foundation set; those on integers are.
    neg(a) _mm512_castsi512_pd(
        _mm512_xor_si512(_mm512_castpd_si512(a), _mm512_set1_epi64(i64::MIN))
    );
    abs(a) _mm512_abs_pd(a);
    compare(a, b) _mm512_cmp_pd_mask::<_CMP_LT_OQ>(a, b), _mm512_cmp_pd_mask::<_CMP_LE_OQ>(a, b);
    masks(a, b) a & b, a | b, !a;
    select(mask, a, b) _mm512_mask_blend_pd(mask, b, a);
}
