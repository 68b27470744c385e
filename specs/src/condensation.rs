//! Static condensation of the parameters of enhanced modes: what generated kernels of cells call as [`crate::cells`].

#![allow(
    clippy::needless_range_loop,
    reason = "indices of nodes, modes and components read as in the formulas"
)]

use crate::Lane;
use crate::matrices::Matrix;
use crate::register::Register;
use crate::triangle::{diagonal, looped, store_block, store_diagonal, upper_rows};

/// Condenses the last M of N + M degrees of freedom out of a symmetric matrix:
/// K_uu − K_ua K_aa⁻¹ K_au. Both matrices are upper triangles by rows; N is a multiple of three.
/// Not a number where K_aa is not positive definite.
#[inline(always)]
pub fn condense<L: Register, const N: usize, const M: usize>(
    whole: &Matrix<L>,
    mut condensed: Matrix<L>,
) {
    let size = N + M;
    let zero = L::splat(0.0);
    let (mut own, mut coupling) = ([[zero; M]; M], [[zero; M]; N]);
    for p in 0..M {
        for q in p..M {
            own[p][q] = whole.get(diagonal(size, N + p) + q - p);
        }
    }
    for r in 0..N {
        let row = diagonal(size, r) - r;
        for c in r..N {
            condensed.set(diagonal(N, r) + c - r, &[whole.get(row + c)]);
        }
        for p in 0..M {
            coupling[r][p] = whole.get(row + N + p);
        }
    }
    take_off(&mut own, &mut coupling, condensed);
}

/// The parameters α of the modes that follow the displacement of the nodes: K_aa α = −K_au u. `whole`: the upper triangle
/// by rows of the matrix of 3·NODES + M degrees of freedom, of which [`condense`] takes the last M; M = 3·MODES.
/// Not a number where K_aa is not positive definite.
#[inline(always)]
pub fn follow<L: Register, const NODES: usize, const M: usize, const MODES: usize>(
    whole: &Matrix<L>,
    displacement: &[[L; 3]; NODES],
) -> [[L; 3]; MODES] {
    const { assert!(M == 3 * MODES) };
    let (nodal, size) = (3 * NODES, 3 * NODES + M);
    let zero = L::splat(0.0);
    let (mut own, mut right) = ([[zero; M]; M], [zero; M]);
    for p in 0..M {
        for q in p..M {
            own[p][q] = whole.get(diagonal(size, nodal + p) + q - p);
        }
    }
    for (r, u) in displacement.as_flattened().iter().enumerate() {
        let row = diagonal(size, r) - r + nodal;
        for p in 0..M {
            right[p] = whole.get(row + p).neg_mul_add(*u, right[p]);
        }
    }
    // K_aa = UᵀU: forward, and then back.
    for p in 0..M {
        for before in 0..p {
            let above = own[before];
            for q in p..M {
                own[p][q] = above[p].neg_mul_add(above[q], own[p][q]);
            }
            right[p] = above[p].neg_mul_add(right[before], right[p]);
        }
        let inverse = L::splat(1.0) / own[p][p].sqrt();
        own[p][p] = inverse;
        for q in p + 1..M {
            own[p][q] = own[p][q] * inverse;
        }
        right[p] = right[p] * inverse;
    }
    for p in (0..M).rev() {
        for q in p + 1..M {
            right[p] = own[p][q].neg_mul_add(right[q], right[p]);
        }
        right[p] = right[p] * own[p][p];
    }
    let mut modes = [[zero; 3]; MODES];
    modes.as_flattened_mut().copy_from_slice(&right);
    modes
}

/// K_uu − K_ua K_aa⁻¹ K_au by the Cholesky factor of K_aa. `own`: the upper triangle of K_aa; `coupling`: K_ua by
/// rows, whose number is a multiple of three; `matrix`: the upper triangle by rows of K_uu. Not a number where
/// K_aa is not positive definite.
#[inline(always)]
pub fn take_off<L: Register, const N: usize, const M: usize>(
    own: &mut [[L; M]; M],
    coupling: &mut [[L; M]; N],
    mut matrix: Matrix<L>,
) {
    // K_aa = UᵀU, row after row; what is kept are U above the diagonal and 1/U_pp on it.
    for p in 0..M {
        let (above, rest) = own.split_at_mut(p);
        let row = &mut rest[0];
        for above in above.iter() {
            for q in p..M {
                row[q] = above[p].neg_mul_add(above[q], row[q]);
            }
        }
        let inverse = L::splat(1.0) / row[p].sqrt();
        row[p] = inverse;
        for entry in &mut row[p + 1..] {
            *entry = *entry * inverse;
        }
    }
    // W U = K_ua: a row of W stays in registers.
    for row in coupling.iter_mut().take(looped(N)) {
        let mut w = *row;
        for p in 0..M {
            w[p] = w[p] * own[p][p];
            for q in p + 1..M {
                w[q] = own[p][q].neg_mul_add(w[p], w[q]);
            }
        }
        *row = w;
    }
    // K_uu − W Wᵀ by blocks of three rows: two blocks at a time where there are registers for them.
    let rows = coupling.as_chunks::<3>().0;
    for a in 0..looped(N / 3) {
        let starts = upper_rows(N, a);
        let mut own = [[L::splat(0.0); 3]; 3];
        for i in 0..3 {
            for j in i..3 {
                own[i][j] = matrix.get(starts[i] + 3 * a + j);
            }
        }
        let [own] = less_products([own], &rows[a], [&rows[a]]);
        store_diagonal(&mut matrix, starts, a, own);
        let mut b = a + 1;
        while L::MANY && b + 1 < looped(N / 3) {
            let blocks = [block(&matrix, starts, b), block(&matrix, starts, b + 1)];
            let [first, next] = less_products(blocks, &rows[a], [&rows[b], &rows[b + 1]]);
            store_block(&mut matrix, starts, b, first);
            store_block(&mut matrix, starts, b + 1, next);
            b += 2;
        }
        while b < looped(N / 3) {
            let blocks = [block(&matrix, starts, b)];
            let [first] = less_products(blocks, &rows[a], [&rows[b]]);
            store_block(&mut matrix, starts, b, first);
            b += 1;
        }
    }
}

/// Blocks less Σ_p left_ip right_jp for their rows on the right.
#[inline(always)]
fn less_products<L: Lane, const M: usize, const BLOCKS: usize>(
    mut blocks: [[[L; 3]; 3]; BLOCKS],
    left: &[[L; M]; 3],
    right: [&[[L; M]; 3]; BLOCKS],
) -> [[[L; 3]; 3]; BLOCKS] {
    for p in 0..looped(M) {
        for (block, right) in blocks.iter_mut().zip(right) {
            for i in 0..3 {
                for j in 0..3 {
                    block[i][j] = left[i][p].neg_mul_add(right[j][p], block[i][j]);
                }
            }
        }
    }
    blocks
}

/// The block of basis function b in three rows.
#[inline(always)]
fn block<L: Register>(matrix: &Matrix<L>, rows: [usize; 3], b: usize) -> [[L; 3]; 3] {
    let mut block = [[L::splat(0.0); 3]; 3];
    for (entries, row) in block.iter_mut().zip(rows) {
        *entries = matrix.three(row + 3 * b);
    }
    block
}

/// Σ_q g_q f_mq for every mode m: what a function's gradients have in common with modes whose gradients all
/// lie along one vector.
#[inline(always)]
pub fn along_modes<L: Lane, const POINTS: usize, const MODES: usize>(
    gradients: &[[L; 3]; POINTS],
    factors: &[[L; MODES]; POINTS],
) -> [[L; 3]; MODES] {
    let mut sums = [[L::splat(0.0); 3]; MODES];
    for (gradient, factors) in gradients.iter().zip(factors).take(looped(POINTS)) {
        for m in 0..MODES {
            for i in 0..3 {
                sums[m][i] = gradient[i].mul_add(factors[m], sums[m][i]);
            }
        }
    }
    sums
}

/// Σ_q f_mq f_nq · direction.
#[inline(always)]
pub fn between_modes<L: Lane, const POINTS: usize, const MODES: usize>(
    factors: &[[L; MODES]; POINTS],
    [m, n]: [usize; 2],
    direction: &[L; 3],
) -> [L; 3] {
    let mut sum = L::splat(0.0);
    for factors in factors {
        sum = factors[m].mul_add(factors[n], sum);
    }
    [direction[0] * sum, direction[1] * sum, direction[2] * sum]
}

/// a ⊗ b.
#[inline(always)]
pub fn outer<L: Lane>(a: [L; 3], b: [L; 3]) -> [[L; 3]; 3] {
    let mut outer = [[L::splat(0.0); 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            outer[i][j] = a[i] * b[j];
        }
    }
    outer
}

/// Stores the block of basis function a and mode m.
#[inline(always)]
pub fn store_coupling<L: Lane, const N: usize, const M: usize>(
    coupling: &mut [[L; M]; N],
    a: usize,
    m: usize,
    block: [[L; 3]; 3],
) {
    for i in 0..3 {
        coupling[3 * a + i][3 * m..3 * m + 3].copy_from_slice(&block[i]);
    }
}

/// Stores the block of modes m ≤ n.
#[inline(always)]
pub fn store_own<L: Lane, const M: usize>(
    own: &mut [[L; M]; M],
    m: usize,
    n: usize,
    block: [[L; 3]; 3],
) {
    for i in 0..3 {
        own[3 * m + i][3 * n..3 * n + 3].copy_from_slice(&block[i]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrices::{Batch, CellMatrix};

    fn condensed<const N: usize, const M: usize>(whole: &[f64], stored: usize) -> Vec<f64> {
        let [mut from, mut to] = [whole.len(), stored].map(|stored| Batch::storage(1, stored));
        let mut matrix = Matrix::new(&mut from, 0);
        matrix.set(0, whole);
        condense::<f64, N, M>(&matrix, Matrix::new(&mut to, 0));
        CellMatrix::new(&to, stored, 0).values().collect()
    }

    #[test]
    fn condensation_is_the_schur_complement() {
        // Twelve unknowns, of which five are condensed: a diagonally dominant matrix.
        let entry = |i: usize, j: usize| match i == j {
            true => 12.0,
            false => ((3 * i.min(j) + i.max(j)) as f64).sin(),
        };
        let whole: Vec<f64> = (0..17).flat_map(|i| (i..17).map(move |j| entry(i, j))).collect();
        let condensed = condensed::<12, 5>(&whole, 78);
        // The same by Gauss' elimination of one unknown after the other, the last first.
        let mut full: Vec<Vec<f64>> =
            (0..17).map(|i| (0..17).map(|j| entry(i, j)).collect()).collect();
        for p in (12..17).rev() {
            for i in 0..p {
                for j in 0..p {
                    full[i][j] -= full[i][p] * full[p][j] / full[p][p];
                }
            }
        }
        let expected = (0..12).flat_map(|i| (i..12).map(move |j| (i, j)));
        for (found, (i, j)) in condensed.iter().zip(expected) {
            // Some dozens of roundings of numbers up to 12.
            assert!((found - full[i][j]).abs() < 12.0 * 64.0 * f64::EPSILON, "{i} {j}: {found}");
        }
    }

    #[test]
    fn modes_follow_the_nodes() {
        // Two nodes and two modes.
        let entry = |i: usize, j: usize| match i == j {
            true => 12.0,
            false => ((3 * i.min(j) + i.max(j)) as f64).sin(),
        };
        let stored: Vec<f64> = (0..12).flat_map(|i| (i..12).map(move |j| entry(i, j))).collect();
        let mut memory = Batch::storage(1, stored.len());
        let mut whole = Matrix::new(&mut memory, 0);
        whole.set(0, &stored);
        let u = [[1.0, -2.0, 3.0], [0.5, 4.0, -1.0]];
        let modes = follow::<f64, 2, 6, 2>(&whole, &u);
        // No force on the parameters.
        let all: Vec<f64> = u.as_flattened().iter().chain(modes.as_flattened()).copied().collect();
        for p in 6..12 {
            let force: f64 = (0..12).map(|j| entry(p, j) * all[j]).sum();
            assert!(force.abs() < 12.0 * 64.0 * f64::EPSILON, "{p}: {force}");
        }
    }

    #[test]
    fn what_is_not_positive_definite_is_not_a_number() {
        // [[I, 1], [1, −1]].
        let whole = [1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, -1.0];
        let condensed = condensed::<3, 1>(&whole, 6);
        assert!(condensed.iter().all(|entry| entry.is_nan()));
    }
}
