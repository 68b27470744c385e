//! Sums of many columns into one, which a step spends its time on between two solutions.

use whirl_specs::Registers;
use whirl_specs::registers::{Register, Task};

use super::Matrix;

/// Columns that are added together: y is read and written once for all of them.
const TOGETHER: usize = 4;

/// y += Σ x_j a_j over pairs (a_j, x_j), in their order and without fused operations: the bits are those of
/// one column after the other. Columns with x_j = 0 are not read. Every column is as long as y.
pub(crate) fn add_columns<'a>(y: &mut [f64], columns: impl Iterator<Item = (&'a [f64], f64)>) {
    Registers::current().run(AddColumns { y, columns });
}

/// y += A x, as [`add_columns`].
pub(crate) fn add_product(y: &mut [f64], matrix: &Matrix, x: &[f64]) {
    add_columns(y, x.iter().enumerate().map(|(j, &x)| (matrix.col(j), x)));
}

struct AddColumns<'y, I> {
    y: &'y mut [f64],
    columns: I,
}

impl<'a, I: Iterator<Item = (&'a [f64], f64)>> Task for AddColumns<'_, I> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let y = self.y;
        let mut some: [(&[f64], f64); TOGETHER] = [(&[], 0.0); TOGETHER];
        let mut count = 0;
        for (column, x) in self.columns.filter(|(_, x)| *x != 0.0) {
            some[count] = (column, x);
            count += 1;
            if count == TOGETHER {
                let n = y.len();
                let [(a, p), (b, q), (c, r), (d, s)] = some;
                let (a, b, c, d) = (&a[..n], &b[..n], &c[..n], &d[..n]);
                for i in 0..n {
                    y[i] = y[i] + p * a[i] + q * b[i] + r * c[i] + s * d[i];
                }
                count = 0;
            }
        }
        for (column, x) in &some[..count] {
            y.iter_mut().zip(*column).for_each(|(sum, entry)| *sum += x * entry);
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
                    let mut y = start.clone();
                    registers.within(|| add_product(&mut y, &matrix, &x));
                    assert_eq!(y, expected, "{}", registers.name());
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
