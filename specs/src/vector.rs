//! Sums over vectors and columns of matrices, as the kernels of motions use them.
//!
//! No operation is fused and the order of every sum is fixed, so that results do not depend on the
//! width of the machine's registers.

use std::ops::Mul;

use crate::Lane;

/// Columns that [`add_columns`] takes at once: each entry of y is loaded and stored once for all of them.
pub const COLUMNS: usize = 4;

/// Partial sums of [`dot`].
const PARTS: usize = 8;

/// y += Σ_j column_j x(j), columns in their order; they follow one another in `columns`, each as long as y.
///
/// # Panics
/// If the last column is cut.
#[inline(always)]
pub fn add_columns<L: Lane>(y: &mut [L], columns: &[f64], x: impl Fn(usize) -> L) {
    let n = y.len();
    if columns.len() == COLUMNS * n {
        let (ab, cd) = columns.split_at(2 * n);
        let ((a, b), (c, d)) = (ab.split_at(n), cd.split_at(n));
        let (a, b, c, d) = (&a[..n], &b[..n], &c[..n], &d[..n]);
        let x = [x(0), x(1), x(2), x(3)];
        for i in 0..n {
            y[i] = y[i] + x[0] * a[i] + x[1] * b[i] + x[2] * c[i] + x[3] * d[i];
        }
    } else {
        for (j, column) in columns.chunks(n.max(1)).enumerate() {
            let (column, x) = (&column[..n], x(j));
            for i in 0..n {
                y[i] = y[i] + x * column[i];
            }
        }
    }
}

/// a·b over the length of a, in eight partial sums that are added pairwise.
///
/// # Panics
/// If b is shorter than a.
#[inline(always)]
pub fn dot<L: Lane + Mul<A, Output = L>, A: Copy>(a: &[L], b: &[A]) -> L {
    let b = &b[..a.len()];
    let mut parts = [L::splat(0.0); PARTS];
    let (a, b) = (a.chunks(PARTS), b.chunks(PARTS));
    for (a, b) in a.zip(b) {
        for (part, (x, y)) in parts.iter_mut().zip(a.iter().zip(b)) {
            *part = *part + *x * *y;
        }
    }
    let [a, b, c, d, e, f, g, h] = parts;
    ((a + b) + (c + d)) + ((e + f) + (g + h))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_and_products_of_any_length() {
        for n in [0, 1, 2, 7, 8, 9, 77] {
            for count in 0..=COLUMNS {
                let columns: Vec<f64> = (0..n * count).map(|k| k as f64 + 1.0).collect();
                let mut y = vec![1.0; n];
                add_columns(&mut y, &columns, |j| j as f64 - 1.5);
                for i in 0..n {
                    let sum: f64 = (0..count).map(|j| columns[j * n + i] * (j as f64 - 1.5)).sum();
                    assert_eq!(y[i], 1.0 + sum, "{n} {count}");
                }
            }
            let a: Vec<f64> = (0..n).map(|k| k as f64).collect();
            let squares: f64 = a.iter().map(|x| x * x).sum();
            assert_eq!(dot(&a, &a), squares);
        }
    }
}
