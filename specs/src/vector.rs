//! Sums over vectors and columns of matrices, as the kernels of motions use them.
//!
//! No operation is fused and the order of every sum is fixed, so that results do not depend on the
//! width of the machine's registers.

use crate::lane::{Lane, TOGETHER};

/// Columns that sums over lanes take at once.
pub const COLUMNS: usize = TOGETHER;

/// y += Σ_j column_j x_j, columns in their order, which follow one another in `columns`, each as long as y.
///
/// # Panics
/// If a column is cut.
#[inline(always)]
pub fn add_columns<L: Lane>(y: &mut [L], columns: &[f64], x: &[L]) {
    L::add_columns(y, columns, x);
}

/// At most [`COLUMNS`] numbers over lanes.
///
/// # Panics
/// If there are more.
pub fn lanes<L: Lane>(numbers: &[f64]) -> [L; COLUMNS] {
    let mut lanes = [L::splat(0.0); COLUMNS];
    for (lane, number) in lanes[..numbers.len()].iter_mut().zip(numbers) {
        *lane = L::splat(*number);
    }
    lanes
}

/// a·b over the length of a, in eight partial sums that are added pairwise.
///
/// # Panics
/// If b is shorter than a.
#[inline(always)]
pub fn dot<L: Lane>(a: &[L], b: &[L]) -> L {
    L::dot(a, b)
}

/// [`dot`] with plain numbers.
///
/// # Panics
/// If b is shorter than a.
#[inline(always)]
pub fn dot_numbers<L: Lane>(a: &[L], b: &[f64]) -> L {
    L::dot_numbers(a, b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_and_products_of_any_length() {
        for n in [0, 1, 2, 7, 8, 9, 77] {
            for count in [0, 1, 4, 7, 8, 9, 21] {
                let columns: Vec<f64> = (0..n * count).map(|k| k as f64 + 1.0).collect();
                let mut y = vec![1.0; n];
                let x: Vec<f64> = (0..count).map(|j| j as f64 - 1.5).collect();
                add_columns(&mut y, &columns, &x);
                if count <= COLUMNS {
                    assert_eq!(lanes::<f64>(&x)[..count], x);
                }
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
