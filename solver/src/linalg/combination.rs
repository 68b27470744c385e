//! Sums of many columns into one, which a step spends its time on between two solutions.

use std::ops::{Add, Mul};

use whirl_specs::Registers;
use whirl_specs::registers::{Register, Task};

use super::Matrix;

/// Columns that are added together: y is read and written once for all of them.
const TOGETHER: usize = 8;

/// A number in double or single precision.
pub(crate) trait Number:
    Copy + Default + PartialEq + Add<Output = Self> + Mul<Output = Self>
{
}

impl Number for f64 {}
impl Number for f32 {}

/// Does work on the widest registers: to be a loop over numbers that the compiler can see through.
#[inline(always)]
pub(crate) fn widely(work: impl FnOnce()) {
    Registers::current().run(Widely(work));
}

struct Widely<F>(F);

impl<F: FnOnce()> Task for Widely<F> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        (self.0)();
    }
}

/// y += Σ x_j a_j over pairs (a_j, x_j), in their order and without fused operations: the bits are those of
/// one column after the other. Columns with x_j = 0 are not read. Every column is as long as y.
pub(crate) fn add_columns<'a, T: Number + 'a>(
    y: &mut [T],
    columns: impl Iterator<Item = (&'a [T], T)>,
) {
    Registers::current().run(AddColumns { y, columns });
}

/// y += A x, as [`add_columns`].
pub(crate) fn add_product(y: &mut [f64], matrix: &Matrix, x: &[f64]) {
    add_columns(y, x.iter().enumerate().map(|(j, &x)| (matrix.col(j), x)));
}

/// y += A x for two pairs (y, x), to the same bits, with A read once.
pub(crate) fn add_both_products(matrix: &Matrix, mut pairs: [(&mut [f64], &[f64]); 2]) {
    let n = matrix.rows;
    for start in (0..matrix.cols).step_by(TOGETHER) {
        let end = matrix.cols.min(start + TOGETHER);
        for (y, x) in &mut pairs {
            add_columns(y, (start..end).map(|j| (&matrix.data[j * n..(j + 1) * n], x[j])));
        }
    }
}

struct AddColumns<'y, T, I> {
    y: &'y mut [T],
    columns: I,
}

impl<'a, T: Number + 'a, I: Iterator<Item = (&'a [T], T)>> Task for AddColumns<'_, T, I> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let y = self.y;
        let mut some: [(&[T], T); TOGETHER] = [(&[], T::default()); TOGETHER];
        let mut count = 0;
        for (column, x) in self.columns.filter(|(_, x)| *x != T::default()) {
            some[count] = (column, x);
            count += 1;
            if count == TOGETHER {
                let n = y.len();
                let columns = some.map(|(column, _)| &column[..n]);
                for i in 0..n {
                    let mut sum = y[i];
                    for j in 0..TOGETHER {
                        sum = sum + some[j].1 * columns[j][i];
                    }
                    y[i] = sum;
                }
                count = 0;
            }
        }
        for (column, x) in &some[..count] {
            y.iter_mut().zip(*column).for_each(|(sum, entry)| *sum = *sum + *x * *entry);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_those_of_one_column_after_the_other() {
        for rows in [0, 1, 3, 4, 5, 8, 23] {
            for cols in 0..11 {
                let matrix = Matrix::from_fn(rows, cols, |i, j| (1.3 * (i + 7 * j) as f64).sin());
                let x: Vec<f64> = (0..cols)
                    .map(|j| if j % 3 == 1 { 0.0 } else { (2.1 * j as f64 + 0.4).cos() })
                    .collect();
                let start: Vec<f64> = (0..rows).map(|i| 0.1 + i as f64).collect();
                let mut expected = start.clone();
                for j in 0..cols {
                    for (i, sum) in expected.iter_mut().enumerate() {
                        *sum += x[j] * matrix[(i, j)];
                    }
                }
                for registers in Registers::all() {
                    let (mut y, mut again) = (start.clone(), [start.clone(), start.clone()]);
                    registers.within(|| add_product(&mut y, &matrix, &x));
                    assert_eq!(y, expected, "{}", registers.name());
                    let [a, b] = &mut again;
                    registers.within(|| add_both_products(&matrix, [(a, &x), (b, &x)]));
                    assert_eq!(again, [y.clone(), y], "{}", registers.name());
                }
            }
        }
    }

    #[test]
    fn a_column_without_a_coefficient_is_not_read() {
        let matrix = Matrix { rows: 1, cols: 2, data: vec![f64::NAN, 2.0] };
        let mut y = [1.0];
        add_product(&mut y, &matrix, &[0.0, 3.0]);
        assert_eq!(y, [7.0]);
    }
}
