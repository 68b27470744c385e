//! Products of a dense matrix with a vector and of its transpose, written by hand: what a step with kept factors cannot do
//! without.

use std::array::from_fn;
use std::ops::{Add, Mul};

use whirl_specs::registers::{Register, Registers, Task};

/// Columns that are added together, and sums of one column that do not wait for each other.
const TOGETHER: usize = 8;
const CHAINS: usize = 32;

/// y = A x; A column after column.
pub fn product<T: Number>(a: &[T], x: &[T], y: &mut [T]) {
    Registers::current().run(Product { a, x, y });
}

/// y = Aᵀ x; A column after column.
pub fn transposed<T: Number>(a: &[T], x: &[T], y: &mut [T]) {
    Registers::current().run(Transposed { a, x, y });
}

/// In double or single precision.
pub trait Number: Copy + Default + Add<Output = Self> + Mul<Output = Self> {}

impl Number for f64 {}
impl Number for f32 {}

struct Product<'a, T> {
    a: &'a [T],
    x: &'a [T],
    y: &'a mut [T],
}

impl<T: Number> Task for Product<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let Product { a, x, y } = self;
        let n = y.len();
        y.fill(T::default());
        let whole = x.len() / TOGETHER * TOGETHER;
        for (columns, x) in a.chunks_exact(n * TOGETHER).zip(x.chunks_exact(TOGETHER)) {
            let own: [&[T]; TOGETHER] = from_fn(|j| &columns[j * n..(j + 1) * n]);
            for i in 0..n {
                let mut sum = y[i];
                for j in 0..TOGETHER {
                    sum = sum + own[j][i] * x[j];
                }
                y[i] = sum;
            }
        }
        for (column, x) in a[whole * n..].chunks_exact(n).zip(&x[whole..]) {
            y.iter_mut().zip(column).for_each(|(sum, entry)| *sum = *sum + *entry * *x);
        }
    }
}

struct Transposed<'a, T> {
    a: &'a [T],
    x: &'a [T],
    y: &'a mut [T],
}

impl<T: Number> Task for Transposed<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let Transposed { a, x, y } = self;
        for (column, y) in a.chunks_exact(x.len()).zip(y) {
            let mut sums = [T::default(); CHAINS];
            let (columns, xs) = (column.chunks_exact(CHAINS), x.chunks_exact(CHAINS));
            let rest = columns.remainder().iter().zip(xs.remainder());
            for (column, x) in columns.zip(xs) {
                for i in 0..CHAINS {
                    sums[i] = sums[i] + column[i] * x[i];
                }
            }
            let whole = sums.iter().fold(T::default(), |sum, own| sum + *own);
            *y = rest.fold(whole, |sum, (entry, x)| sum + *entry * *x);
        }
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{DMatrix, DVector};

    use super::*;

    #[test]
    fn products_are_those_of_nalgebra() {
        for (rows, columns) in [(1, 1), (7, 20), (64, 8), (100, 37)] {
            let a = DMatrix::from_fn(rows, columns, |i, j| (1.3 * (i + 5 * j) as f64).sin());
            let [x, z] =
                [columns, rows].map(|n| DVector::from_fn(n, |i, _| (0.7 * i as f64).cos()));
            let (mut y, mut t) = (vec![1.0; rows], vec![1.0; columns]);
            product(a.as_slice(), x.as_slice(), &mut y);
            transposed(a.as_slice(), z.as_slice(), &mut t);
            assert!((&a * &x - DVector::from_vec(y)).amax() < 1e-13);
            assert!((a.transpose() * &z - DVector::from_vec(t)).amax() < 1e-13);
        }
    }
}
