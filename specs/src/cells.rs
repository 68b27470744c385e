//! What kernels of cells share: the map from the reference cell, storage of symmetric matrices, static
//! condensation.

use std::array::from_fn;

use crate::Lane;

/// The Jacobian J = Σ x_a ⊗ ∇N_a of the map from the reference cell, by its cofactors: J⁻ᵀ = cof J / det J.
#[derive(Debug, Clone, Copy)]
pub struct Jacobian<L> {
    /// `cofactors[i][k]` belongs to Jᵢₖ = ∂x_i/∂ξ_k.
    pub cofactors: [[L; 3]; 3],
    /// det J.
    pub det: L,
}

impl<L: Lane> Jacobian<L> {
    /// The Jacobian where the shape functions of the N nodes at `x` have the reference gradients `slopes`.
    #[inline(always)]
    pub fn new<const N: usize>(x: &[[L; 3]; N], slopes: &[[f64; 3]; N]) -> Self {
        let mut j = [[L::splat(0.0); 3]; 3];
        for (x, slope) in x.iter().zip(slopes) {
            for i in 0..3 {
                for k in 0..3 {
                    j[i][k] = j[i][k] + x[i] * slope[k];
                }
            }
        }
        let cofactors: [[L; 3]; 3] = from_fn(|i| {
            from_fn(|k| {
                let (p, q, r, s) = ((i + 1) % 3, (i + 2) % 3, (k + 1) % 3, (k + 2) % 3);
                j[p][r] * j[q][s] - j[p][s] * j[q][r]
            })
        });
        let det = j[0][0] * cofactors[0][0] + j[0][1] * cofactors[0][1] + j[0][2] * cofactors[0][2];
        Jacobian { cofactors, det }
    }

    /// scale · cof J · slope: the gradient in space of a function with that reference gradient, times
    /// scale · det J.
    #[inline(always)]
    pub fn gradient(&self, slope: &[f64; 3], scale: L) -> [L; 3] {
        self.cofactors
            .map(|row| (row[0] * slope[0] + row[1] * slope[1] + row[2] * slope[2]) * scale)
    }
}

/// The smaller of two values.
#[inline(always)]
pub fn least<L: Lane>(a: L, b: L) -> L {
    L::select(L::lt(b, a), b, a)
}

/// Calls `cell` for every cell of a block with its nodes and its matrix; it gives the smallest det J.
/// Arguments as of [`crate::CellKernel`], for N nodes and LEN stored values.
#[inline(always)]
pub fn each_cell<const N: usize, const LEN: usize>(
    coordinates: &[f64],
    matrices: &mut [f64],
    jacobians: &mut [f64],
    cell: impl Fn(&[[f64; 3]; N], &mut [f64; LEN]) -> f64,
) {
    let nodes = coordinates.as_chunks::<3>().0.as_chunks::<N>().0;
    let matrices = matrices.as_chunks_mut::<LEN>().0;
    for ((nodes, matrix), det) in nodes.iter().zip(matrices).zip(jacobians) {
        *det = cell(nodes, matrix);
    }
}

/// Place of entry (row, row) in the upper triangle by rows of a symmetric matrix with `size` rows.
#[inline(always)]
const fn diagonal(size: usize, row: usize) -> usize {
    row * (2 * size + 1 - row) / 2
}

/// Stores the 3 × 3 block of basis functions a ≤ b in the upper triangle by rows of a symmetric matrix
/// with `size` rows.
#[inline(always)]
pub fn store_block<L: Lane>(matrix: &mut [L], size: usize, a: usize, b: usize, block: [[L; 3]; 3]) {
    for (i, entries) in block.iter().enumerate() {
        let row = 3 * a + i;
        let first = if a == b { i } else { 0 };
        let start = diagonal(size, row) + 3 * b + first - row;
        matrix[start..start + 3 - first].copy_from_slice(&entries[first..]);
    }
}

/// Stores the 3 × 3 block of basis functions a, b in a matrix by rows with `size` rows.
#[inline(always)]
pub fn store_full<L: Lane>(matrix: &mut [L], size: usize, a: usize, b: usize, block: [[L; 3]; 3]) {
    for (i, entries) in block.iter().enumerate() {
        let start = (3 * a + i) * size + 3 * b;
        matrix[start..start + 3].copy_from_slice(entries);
    }
}

/// Stores the entry of nodes a ≤ b in the upper triangle by rows of a symmetric matrix with `size` rows.
#[inline(always)]
pub fn store_entry<L: Lane>(matrix: &mut [L], size: usize, a: usize, b: usize, entry: L) {
    matrix[diagonal(size, a) + b - a] = entry;
}

/// Condenses the last M of N + M degrees of freedom out of a symmetric matrix:
/// K_uu − K_ua K_aa⁻¹ K_au, by the Cholesky factor of K_aa. Both matrices are upper triangles by rows.
/// Not a number where K_aa is not positive definite.
#[inline(always)]
pub fn condense<L: Lane, const N: usize, const M: usize>(whole: &[L], condensed: &mut [L]) {
    let size = N + M;
    // K_aa = UᵀU.
    let mut factor = [[L::splat(0.0); M]; M];
    for p in 0..M {
        for q in p..M {
            let mut entry = whole[diagonal(size, N + p) + q - p];
            for row in &factor[..p] {
                entry = entry - row[p] * row[q];
            }
            factor[p][q] = if p == q { entry.sqrt() } else { entry / factor[p][p] };
        }
    }
    // UᵀW = K_au.
    let mut w = [[L::splat(0.0); N]; M];
    for p in 0..M {
        let (done, rest) = w.split_at_mut(p);
        let row = &mut rest[0];
        for (r, entry) in row.iter_mut().enumerate() {
            *entry = whole[diagonal(size, r) + N + p - r];
        }
        for (q, above) in done.iter().enumerate() {
            for (entry, above) in row.iter_mut().zip(above) {
                *entry = *entry - *above * factor[q][p];
            }
        }
        let inverse = L::splat(1.0) / factor[p][p];
        for entry in row.iter_mut() {
            *entry = *entry * inverse;
        }
    }
    for r in 0..N {
        let factors: [L; M] = from_fn(|p| w[p][r]);
        let from = &whole[diagonal(size, r)..][..N - r];
        let to = &mut condensed[diagonal(N, r)..][..N - r];
        for (c, (to, from)) in to.iter_mut().zip(from).enumerate() {
            let mut entry = *from;
            for (factor, w) in factors.iter().zip(&w) {
                entry = entry - *factor * w[r + c];
            }
            *to = entry;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn condensation_is_the_schur_complement() {
        // [[4, 1, 2], [1, 5, 1], [2, 1, 3]], the last row condensed.
        let whole = [4.0, 1.0, 2.0, 5.0, 1.0, 3.0];
        let mut condensed = [0.0; 3];
        condense::<f64, 2, 1>(&whole, &mut condensed);
        let expected = [4.0 - 4.0 / 3.0, 1.0 - 2.0 / 3.0, 5.0 - 1.0 / 3.0];
        for (found, expected) in condensed.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-15 * 5.0, "{found} {expected}");
        }
    }

    #[test]
    fn blocks_land_in_the_upper_triangle() {
        let mut matrix = [0.0; 21];
        let block = |start: f64| from_fn(|i| from_fn(|j| start + (3 * i + j) as f64));
        store_block(&mut matrix, 6, 0, 0, block(0.0));
        store_block(&mut matrix, 6, 0, 1, block(10.0));
        store_block(&mut matrix, 6, 1, 1, block(20.0));
        let rows = [
            &[0.0, 1.0, 2.0, 10.0, 11.0, 12.0][..],
            &[4.0, 5.0, 13.0, 14.0, 15.0],
            &[8.0, 16.0, 17.0, 18.0],
            &[20.0, 21.0, 22.0],
            &[24.0, 25.0],
            &[28.0],
        ];
        assert_eq!(matrix.to_vec(), rows.concat());
    }

    #[test]
    fn the_jacobian_of_a_box() {
        let corners: [[f64; 3]; 4] =
            [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]];
        let slopes = [[-1.0, -1.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let jacobian = Jacobian::new(&corners, &slopes);
        assert_eq!(jacobian.det, 24.0);
        assert_eq!(jacobian.gradient(&slopes[1], 1.0 / 24.0), [0.5, 0.0, 0.0]);
    }
}
