//! Sums over the points of a cell for pairs of basis functions: what kernels of forms call as [`crate::cells`].

#![allow(clippy::needless_range_loop, reason = "indices of parts read as in the formulas")]

use crate::Lane;
use crate::matrices::Matrix;
use crate::register::Register;

/// Σ_q a_iq b_jq at `[i][j]` for the parts i, j of function a and of each function b: with two of them at once a sum waits
/// less for the one before it, and a's values are read once.
#[inline(always)]
pub fn sums<L: Lane, const PARTS: usize, const B: usize>(
    of_a: &[[L; PARTS]],
    of_b: [&[[L; PARTS]]; B],
) -> [[[L; PARTS]; PARTS]; B] {
    let mut sums = [[[L::splat(0.0); PARTS]; PARTS]; B];
    let of_b = of_b.map(|of_b| &of_b[..of_a.len()]);
    for (q, a_q) in of_a.iter().enumerate() {
        for n in 0..B {
            let b_q = of_b[n][q];
            for i in 0..PARTS {
                for j in 0..PARTS {
                    sums[n][i][j] = a_q[i].mul_add(b_q[j], sums[n][i][j]);
                }
            }
        }
    }
    sums
}

/// The same for a function with itself, whose sums are symmetric.
#[inline(always)]
pub fn own_sums<L: Lane, const PARTS: usize>(of_a: &[[L; PARTS]]) -> [[L; PARTS]; PARTS] {
    let mut sums = [[L::splat(0.0); PARTS]; PARTS];
    for a_q in of_a {
        for i in 0..PARTS {
            for j in i..PARTS {
                sums[i][j] = a_q[i].mul_add(a_q[j], sums[i][j]);
            }
        }
    }
    for i in 0..PARTS {
        for j in 0..i {
            sums[i][j] = sums[j][i];
        }
    }
    sums
}

/// The two halves of what is given of a cell: positions and displacements of its nodes.
#[inline(always)]
pub fn halves<L, const NODES: usize, const BOTH: usize>(
    given: &[[L; 3]; BOTH],
) -> [&[[L; 3]; NODES]; 2] {
    const { assert!(BOTH == 2 * NODES) };
    let (halves, _) = given.as_chunks::<NODES>();
    [&halves[0], &halves[1]]
}

/// ∂w_j/∂x_l at `[j][l]` at point q, for the displacements w of all functions, first those of the nodes.
/// basis: functions × points, gradients times the root of their point.
#[inline(always)]
pub fn slopes<L: Lane, const POINTS: usize>(
    basis: &[[[L; 3]; POINTS]],
    roots: &[L; POINTS],
    displacement: [&[[L; 3]]; 2],
    q: usize,
) -> [[L; 3]; 3] {
    let mut slopes = [[L::splat(0.0); 3]; 3];
    let displacements = displacement[0].iter().chain(displacement[1]);
    for (function, w) in basis.iter().zip(displacements) {
        for j in 0..3 {
            for l in 0..3 {
                slopes[j][l] = w[j].mul_add(function[q][l], slopes[j][l]);
            }
        }
    }
    let inverse = L::splat(1.0) / roots[q];
    slopes.map(|row| row.map(|slope| slope * inverse))
}

/// Σ_q a_iq c_ijq b_jq for all functions a ≤ b, row by row.
#[inline(always)]
pub fn weighted_sums<L: Register, const POINTS: usize>(
    basis: &[[[L; 3]; POINTS]],
    coefficients: &[[[L; 3]; 3]; POINTS],
    mut matrix: Matrix<L>,
) {
    let mut entry = 0;
    for (a, of_a) in basis.iter().enumerate() {
        let mut weighted = [[L::splat(0.0); 3]; POINTS];
        for q in 0..POINTS {
            for i in 0..3 {
                for j in 0..3 {
                    weighted[q][j] = of_a[q][i].mul_add(coefficients[q][i][j], weighted[q][j]);
                }
            }
        }
        for of_b in &basis[a..] {
            let mut sum = L::splat(0.0);
            for q in 0..POINTS {
                for j in 0..3 {
                    sum = weighted[q][j].mul_add(of_b[q][j], sum);
                }
            }
            matrix.set(entry, &[sum]);
            entry += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrices::{Batch, CellMatrix};

    #[test]
    fn slopes_and_weighted_sums() {
        // Three functions at two points with the roots 2 and 4; the last is a mode's.
        let basis = [
            [[2.0, 0.0, 0.0], [4.0, 0.0, 0.0]],
            [[0.0, 2.0, 0.0], [0.0, 8.0, 0.0]],
            [[0.0, 0.0, 2.0], [0.0, 4.0, 0.0]],
        ];
        let (nodes, modes) = ([[1.0, 0.0, 0.0], [0.0, 3.0, 0.0]], [[0.0, 0.0, 5.0]]);
        let at = |q| slopes(&basis, &[2.0, 4.0], [&nodes, &modes], q);
        assert_eq!(at(0), [[1.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 5.0]]);
        assert_eq!(at(1), [[1.0, 0.0, 0.0], [0.0, 6.0, 0.0], [0.0, 5.0, 0.0]]);
        let coefficients = [[[1.0, 7.0, 0.0], [7.0, 2.0, 0.0], [0.0; 3]], [[0.0; 3]; 3]];
        let mut memory = Batch::storage(1, 3);
        weighted_sums(&basis[..2], &coefficients, Matrix::new(&mut memory, 0));
        let matrix: Vec<f64> = CellMatrix::new(&memory, 3, 0).values().collect();
        assert_eq!(matrix, [4.0, 28.0, 8.0]);
    }

    #[test]
    fn what_is_given_of_a_cell_is_halved() {
        let given = [[1.0; 3], [2.0; 3], [3.0; 3], [4.0; 3]];
        let [x, w] = halves::<f64, 2, 4>(&given);
        assert_eq!((x, w), (&[[1.0; 3], [2.0; 3]], &[[3.0; 3], [4.0; 3]]));
    }

    #[test]
    fn sums_of_products_over_the_points() {
        let (a, b) = ([[1.0, 2.0], [3.0, 4.0]], [[5.0, 6.0], [7.0, 8.0]]);
        let with_b = [[26.0, 30.0], [38.0, 44.0]];
        let with_a = [[10.0, 14.0], [14.0, 20.0]];
        assert_eq!(sums(&a, [&b]), [with_b]);
        assert_eq!(sums(&a, [&b, &a]), [with_b, with_a]);
        assert_eq!(own_sums(&a), with_a);
    }
}
