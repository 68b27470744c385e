//! Sums over vectors and columns of matrices, as the kernels of motions use them.
//!
//! No operation is fused and the order of every sum is fixed, so that results do not depend on the
//! width of the machine's registers.

use std::ops::Mul;

use crate::Lane;
use crate::columns;
use crate::wide::wide;

/// Columns that sums over lanes take at once: each entry of y is loaded and stored once for all of them.
pub const COLUMNS: usize = 8;

/// Partial sums of [`dot`].
const PARTS: usize = 8;

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

/// [`add_columns`] on any lane type.
#[inline(always)]
pub(crate) fn sum_of_columns<L: Lane>(y: &mut [L], columns: &[f64], x: &[L]) {
    let n = y.len();
    let (all, some) = x.as_chunks::<COLUMNS>();
    let (half, rest) = some.as_chunks::<{ COLUMNS / 2 }>();
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

/// [`dot`] on any lane type.
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

/// [`add_columns`] of numbers.
pub(crate) fn add_columns_of_numbers(y: &mut [f64], columns: &[f64], x: &[f64]) {
    columns::add_matrix(y, columns, x);
}

// What `f64` computes with: compiled once for each register, not once a kernel.
wide!(product_of_numbers as dot_of_numbers(a: &[f64], b: &[f64]) -> f64);

#[inline(always)]
fn product_of_numbers<L: Lane>(a: &[L], b: &[f64]) -> L {
    sum_of_products(a, b)
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
