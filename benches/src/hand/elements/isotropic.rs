//! The stiffness of an isotropic material: its 3 × 3 blocks follow from Σ ∇Nₐ ⊗ ∇N_b.

#![allow(clippy::needless_range_loop, reason = "indices of components read as in the formulas")]

use whirl_specs::{Lane, Matrix, Register};

use super::space::{Space, trips};

/// Lamé's constants and what follows from them, the same for all cells.
#[derive(Clone, Copy)]
pub(super) struct Isotropic<L> {
    lambda: L,
    mu: L,
    /// λ + 2μ.
    normal: L,
    /// λ + μ.
    shear: L,
}

impl<L: Register> Isotropic<L> {
    /// From E and ν.
    #[inline(always)]
    pub(super) fn new(material: &[f64]) -> Self {
        let (e, nu) = (material[0], material[1]);
        let lambda = L::splat(e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)));
        let mu = L::splat(e / (2.0 * (1.0 + nu)));
        Isotropic { lambda, mu, normal: lambda + mu * 2.0, shear: lambda + mu }
    }

    /// λ Gᵢⱼ + μ Gⱼᵢ + μ tr G δᵢⱼ.
    #[inline(always)]
    pub(super) fn block(&self, g: &[[L; 3]; 3]) -> [[L; 3]; 3] {
        let (xx, yy, zz) = (g[0][0] * self.mu, g[1][1] * self.mu, g[2][2] * self.mu);
        let (l, m, n) = (self.lambda, self.mu, self.normal);
        [
            [
                g[0][0].mul_add(n, yy + zz),
                g[0][1].mul_add(l, g[1][0] * m),
                g[0][2].mul_add(l, g[2][0] * m),
            ],
            [
                g[1][0].mul_add(l, g[0][1] * m),
                g[1][1].mul_add(n, xx + zz),
                g[1][2].mul_add(l, g[2][1] * m),
            ],
            [
                g[2][0].mul_add(l, g[0][2] * m),
                g[2][1].mul_add(l, g[1][2] * m),
                g[2][2].mul_add(n, xx + yy),
            ],
        ]
    }

    /// The stiffness from √(w det J) ∇Nₐ at [a][q], packed.
    #[inline(always)]
    pub(super) fn fill<const N: usize, const P: usize>(
        &self,
        gradients: &[[Space<L>; P]; N],
        matrix: &mut Matrix<L>,
    ) {
        let mut row0 = 0;
        for a in 0..N {
            let width = 3 * (N - a);
            let (row1, row2) = (row0 + width, row0 + 2 * width - 1);

            let mut g = [L::splat(0.0); 6];
            for p in gradients[a].iter().take(trips(P)) {
                let products = [(0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2)];
                for n in 0..6 {
                    g[n] = p[products[n].0].mul_add(p[products[n].1], g[n]);
                }
            }
            let trace = (g[0] + g[3] + g[5]) * self.mu;
            let xx = g[0].mul_add(self.shear, trace);
            matrix.set(row0, &[xx, g[1] * self.shear, g[2] * self.shear]);
            matrix.set(row1, &[g[3].mul_add(self.shear, trace), g[4] * self.shear]);
            matrix.set(row2, &[g[5].mul_add(self.shear, trace)]);

            let mut b = a + 1;
            while b < N {
                if L::MANY && b + 1 < N {
                    let rest = [&gradients[b], &gradients[b + 1]];
                    let [block, next] = products(&gradients[a], rest);
                    self.store([row0, row1, row2], b - a, &block, matrix);
                    self.store([row0, row1, row2], b + 1 - a, &next, matrix);
                    b += 2;
                } else {
                    let [block] = products(&gradients[a], [&gradients[b]]);
                    self.store([row0, row1, row2], b - a, &block, matrix);
                    b += 1;
                }
            }
            row0 += 3 * width - 3;
        }
    }

    /// Stores the block that stands so many nodes behind the diagonal, in the rows that start there.
    #[inline(always)]
    fn store(&self, rows: [usize; 3], behind: usize, g: &[[L; 3]; 3], matrix: &mut Matrix<L>) {
        let block = self.block(g);
        for i in 0..3 {
            matrix.set(rows[i] + 3 * behind - i, &block[i]);
        }
    }
}

/// Σ_q p_q ⊗ r_q for each r.
#[inline(always)]
fn products<L: Lane, const P: usize, const B: usize>(
    p: &[Space<L>; P],
    r: [&[Space<L>; P]; B],
) -> [[[L; 3]; 3]; B] {
    let mut g = [[[L::splat(0.0); 3]; 3]; B];
    for q in 0..trips(P) {
        for n in 0..B {
            for i in 0..3 {
                for j in 0..3 {
                    g[n][i][j] = p[q][i].mul_add(r[n][q][j], g[n][i][j]);
                }
            }
        }
    }
    g
}

/// Operations of [`Isotropic::fill`]: a multiplication and an addition for every product of gradients at every
/// point, then the blocks.
pub(super) const fn fill_flops(nodes: usize, points: usize) -> usize {
    let pairs = nodes * (nodes - 1) / 2;
    2 * points * (9 * pairs + 6 * nodes) + pairs * BLOCK_FLOPS + nodes * 12
}

/// [`Isotropic::block`].
pub(super) const BLOCK_FLOPS: usize = 3 + 6 * 3 + 3 * 3;
