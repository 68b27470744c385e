//! Sums of many columns into one, which a step spends its time on between two solutions.

use whirl_specs::Registers;
use whirl_specs::columns::{self, Number};
use whirl_specs::registers::{Register, Task};

use super::Matrix;

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
    columns::add_columns(y, columns);
}

/// y += A x, as [`add_columns`].
pub(crate) fn add_product(y: &mut [f64], matrix: &Matrix, x: &[f64]) {
    debug_assert_eq!(y.len(), matrix.rows);
    columns::add_matrix(y, &matrix.data, x);
}

/// y += Aᵀx; the order of the sums is that of [`columns::add_products`].
pub(crate) fn add_transposed(y: &mut [f64], matrix: &Matrix, x: &[f64]) {
    debug_assert_eq!(x.len(), matrix.rows);
    columns::add_products(y, &matrix.data, x);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_those_of_one_column_after_the_other() {
        for rows in [0, 1, 3, 4, 5, 8, 23, 96, 97, 130, 201] {
            for cols in [0, 1, 2, 7, 16, 17, 35] {
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
