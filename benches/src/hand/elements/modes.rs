//! Incompatible modes 1 − ξ², 1 − η², 1 − ζ² of a hexahedron with gradients −2ξₖ (det J₀/det J) ∇₀ξₖ, condensed.
//!
//! Every gradient of mode k is along r_k = det J₀ ∇₀ξₖ, so that Σ ∇Nₐ ⊗ ∇mode = tₐₖ ⊗ r_k and
//! Σ ∇mode_k ⊗ ∇mode_l = s_kl r_k ⊗ r_l.

#![allow(
    clippy::needless_range_loop,
    reason = "indices of points and components read as in the formulas"
)]

use whirl_specs::registers::Zeros;
use whirl_specs::{Lane, Matrix, Register};

use super::isotropic::{BLOCK_FLOPS, Isotropic};
use super::space::{Space, cross, trips};

/// 1/√3.
const GAUSS: f64 = 0.577_350_269_189_625_8;

/// The nine amplitudes 3k + i of the modes of one lane of cells.
pub(super) struct Modes<L> {
    r: [Space<L>; 3],
    /// tₐₖ = −2 Σ ξₖ ∇Nₐ, at [k][a].
    t: [[Space<L>; 8]; 3],
    s: [[L; 3]; 3],
    own: [[L; 9]; 9],
    /// Coupling of the 24 displacements, one row each, to the mode amplitudes.
    coupling: [[L; 9]; 24],
}

// SAFETY: lanes only.
unsafe impl<L: Zeros> Zeros for Modes<L> {}

impl<L: Register> Modes<L> {
    /// r, t and s from the tangents at the centre, √det J ∇Nₐ and 1/√det J.
    #[inline(always)]
    pub(super) fn fill(
        &mut self,
        centre: &[Space<L>; 3],
        gradients: &[[Space<L>; 8]; 8],
        inverse_roots: &[L; 8],
    ) {
        let [t0, t1, t2] = *centre;
        self.r = [cross(t1, t2), cross(t2, t0), cross(t0, t1)];
        let mut factors = [[L::splat(0.0); 8]; 3];
        for q in 0..8 {
            for k in 0..3 {
                let xi = if q >> k & 1 == 0 { -GAUSS } else { GAUSS };
                factors[k][q] = inverse_roots[q] * (-2.0 * xi);
            }
        }
        for k in 0..3 {
            for l in k..3 {
                let mut sum = L::splat(0.0);
                for q in 0..8 {
                    sum = factors[k][q].mul_add(factors[l][q], sum);
                }
                self.s[k][l] = sum;
            }
        }
        for a in 0..trips(8) {
            let mut t = [[L::splat(0.0); 3]; 3];
            for q in 0..trips(8) {
                for k in 0..3 {
                    for i in 0..3 {
                        t[k][i] = gradients[a][q][i].mul_add(factors[k][q], t[k][i]);
                    }
                }
            }
            for k in 0..3 {
                self.t[k][a] = t[k];
            }
        }
    }

    /// K − C S⁻¹Cᵀ with S = UᵀU: rows of W = C U⁻¹ stay in registers, then W Wᵀ is taken off the packed matrix
    /// by blocks of nodes.
    #[inline(always)]
    pub(super) fn take_off(&mut self, isotropic: &Isotropic<L>, matrix: &mut Matrix<L>) {
        for k in 0..3 {
            for l in k..3 {
                let block = isotropic.block(&outer(self.r[k], self.r[l], self.s[k][l]));
                for i in 0..3 {
                    for j in 0..3 {
                        self.own[3 * k + i][3 * l + j] = block[i][j];
                    }
                }
            }
            for a in 0..trips(8) {
                let block = isotropic.block(&outer(self.t[k][a], self.r[k], L::splat(1.0)));
                for i in 0..3 {
                    self.coupling[3 * a + i][3 * k..3 * k + 3].copy_from_slice(&block[i]);
                }
            }
        }
        for p in 0..9 {
            for q in p..9 {
                let mut sum = self.own[p][q];
                for m in 0..p {
                    sum = (-self.own[m][p]).mul_add(self.own[m][q], sum);
                }
                // The diagonal keeps 1/U_pp.
                let root = || L::splat(1.0) / sum.sqrt();
                self.own[p][q] = if p == q { root() } else { sum * self.own[p][p] };
            }
        }
        for p in 0..9 {
            for q in p + 1..9 {
                self.own[p][q] = -self.own[p][q];
            }
        }
        for row in self.coupling.iter_mut().take(trips(24)) {
            let mut w = *row;
            for p in 0..9 {
                w[p] = w[p] * self.own[p][p];
                for q in p + 1..9 {
                    w[q] = self.own[p][q].mul_add(w[p], w[q]);
                }
            }
            *row = w;
        }
        self.subtract_products(matrix);
    }

    #[inline(always)]
    fn subtract_products(&self, matrix: &mut Matrix<L>) {
        let rows = self.coupling.as_chunks::<3>().0;
        let mut row0 = 0;
        for a in 0..trips(8) {
            let width = 24 - 3 * a;
            let starts = [row0, row0 + width, row0 + 2 * width - 1];
            // Below the diagonal nothing is stored.
            let [g] = products(&rows[a], [&rows[a]]);
            for i in 0..3 {
                take_off(matrix, starts[i], &g[i][i..]);
            }
            let mut b = a + 1;
            while b < trips(8) {
                if L::MANY && b + 1 < 8 {
                    let [g, next] = products(&rows[a], [&rows[b], &rows[b + 1]]);
                    for i in 0..3 {
                        let [x, y, z] = g[i];
                        let [u, v, w] = next[i];
                        take_off(matrix, starts[i] + 3 * (b - a) - i, &[x, y, z, u, v, w]);
                    }
                    b += 2;
                } else {
                    let [g] = products(&rows[a], [&rows[b]]);
                    for i in 0..3 {
                        take_off(matrix, starts[i] + 3 * (b - a) - i, &g[i]);
                    }
                    b += 1;
                }
            }
            row0 += 3 * width - 3;
        }
    }
}

/// Takes values off entries from `start` on.
#[inline(always)]
fn take_off<L: Register>(matrix: &mut Matrix<L>, start: usize, values: &[L]) {
    for (entry, value) in (start..).zip(values) {
        matrix.set(entry, &[matrix.get(entry) - *value]);
    }
}

/// Three rows times each of some other three.
#[inline(always)]
fn products<L: Lane, const B: usize>(
    left: &[[L; 9]; 3],
    right: [&[[L; 9]; 3]; B],
) -> [[[L; 3]; 3]; B] {
    let mut g = [[[L::splat(0.0); 3]; 3]; B];
    for m in 0..trips(9) {
        for n in 0..B {
            for i in 0..3 {
                for j in 0..3 {
                    g[n][i][j] = left[i][m].mul_add(right[n][j][m], g[n][i][j]);
                }
            }
        }
    }
    g
}

/// scale · a ⊗ b.
#[inline(always)]
fn outer<L: Lane>(a: Space<L>, b: Space<L>, scale: L) -> [[L; 3]; 3] {
    let b = [b[0] * scale, b[1] * scale, b[2] * scale];
    let mut outer = [[L::splat(0.0); 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            outer[i][j] = a[i] * b[j];
        }
    }
    outer
}

/// Sums, blocks of 6 + 24 pairs, factor of S, triangular solution, rank-9 update.
pub(super) const FLOPS: usize =
    27 + 24 + 2 * 8 * (6 + 8 * 9) + 30 * (9 + BLOCK_FLOPS) + 9 * 9 * 9 / 3 + 24 * 81 + 2 * 9 * 300;
