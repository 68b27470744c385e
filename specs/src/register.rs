//! Lanes that fill a register: what memory is read into and written from.

use std::mem::MaybeUninit;

use crate::Lane;

/// Numbers and nothing else: clearing memory makes zeros of them, and what memory holds is always a value.
///
/// # Safety
/// Any bits must be a value of the type.
pub unsafe trait Zeros: Sized {
    /// Zeros.
    #[inline(always)]
    fn zeros() -> Self {
        // SAFETY: the implementor's.
        unsafe { MaybeUninit::zeroed().assume_init() }
    }
}

// SAFETY: no bits.
unsafe impl Zeros for () {}
// SAFETY: a number.
unsafe impl Zeros for f64 {}
// SAFETY: nothing but its elements.
unsafe impl<T: Zeros, const N: usize> Zeros for [T; N] {}

/// A lane type that memory is read into and written from, WIDTH values at a time.
pub trait Register: Lane + Zeros {
    /// Values side by side.
    const WIDTH: usize;
    /// Whether there are so many registers (32) that the sums of two pairs of functions are kept at once.
    const MANY: bool;
    /// [`Register::WIDTH`] values in memory.
    type Chunk: Copy + Zeros;
    /// As many numbers in single precision as fill the register.
    type Single: Sums<Number = f32>;

    /// The whole chunks of a row; fewer than WIDTH values are left over.
    fn chunks(row: &[f64]) -> &[Self::Chunk];
    /// The whole chunks of a row, to be written.
    fn chunks_mut(row: &mut [f64]) -> &mut [Self::Chunk];
    /// The values of a chunk.
    fn load(chunk: &Self::Chunk) -> Self;
    /// Writes a chunk.
    fn store(self, chunk: &mut Self::Chunk);
    /// Lane c takes row min(c, last row) of `rows`, row after row of `values.len()` values each: value v
    /// of that row goes to `values[v]`.
    ///
    /// # Panics
    /// If `rows` does not hold one row at least.
    fn gather(rows: &[f64], values: &mut [Self]);
    /// Writes lane c to row c of `rows`, row after row of `values.len()` values each, for as many rows as
    /// there are, at most WIDTH.
    fn scatter(values: &[Self], rows: &mut [f64]);
}

/// Numbers side by side that are multiplied and added up.
pub trait Sums: Copy {
    /// One of them.
    type Number: Copy;
    /// How many.
    const WIDTH: usize;

    /// The first numbers of a row.
    ///
    /// # Panics
    /// If it has fewer.
    fn load_from(row: &[Self::Number]) -> Self;
    /// Writes the first numbers of a row.
    ///
    /// # Panics
    /// If it has fewer.
    fn store_to(self, row: &mut [Self::Number]);
    /// self + a·b, not fused.
    fn plus(self, a: Self::Number, b: Self) -> Self;
}

/// Those of a register of numbers in double precision.
#[derive(Debug, Clone, Copy)]
pub struct Double<L>(L);

impl<L: Register> Sums for Double<L> {
    type Number = f64;
    const WIDTH: usize = L::WIDTH;

    #[inline(always)]
    fn load_from(row: &[f64]) -> Self {
        Double(L::load(&L::chunks(row)[0]))
    }
    #[inline(always)]
    fn store_to(self, row: &mut [f64]) {
        self.0.store(&mut L::chunks_mut(row)[0]);
    }
    #[inline(always)]
    fn plus(self, a: f64, b: Self) -> Self {
        Double(self.0 + L::splat(a) * b.0)
    }
}

impl Sums for f32 {
    type Number = f32;
    const WIDTH: usize = 1;

    #[inline(always)]
    fn load_from(row: &[f32]) -> Self {
        row[0]
    }
    #[inline(always)]
    fn store_to(self, row: &mut [f32]) {
        row[0] = self;
    }
    #[inline(always)]
    fn plus(self, a: f32, b: Self) -> Self {
        self + a * b
    }
}

impl Register for f64 {
    const WIDTH: usize = 1;
    const MANY: bool = false;
    type Chunk = [f64; 1];
    type Single = f32;

    #[inline(always)]
    fn chunks(row: &[f64]) -> &[[f64; 1]] {
        row.as_chunks().0
    }
    #[inline(always)]
    fn chunks_mut(row: &mut [f64]) -> &mut [[f64; 1]] {
        row.as_chunks_mut().0
    }
    #[inline(always)]
    fn load(chunk: &[f64; 1]) -> Self {
        chunk[0]
    }
    #[inline(always)]
    fn store(self, chunk: &mut [f64; 1]) {
        chunk[0] = self;
    }
    #[inline(always)]
    fn gather(rows: &[f64], values: &mut [f64]) {
        values.copy_from_slice(&rows[..values.len()]);
    }
    #[inline(always)]
    fn scatter(values: &[f64], rows: &mut [f64]) {
        rows[..values.len()].copy_from_slice(values);
    }
}
