//! Trilinear hexahedron with 2 × 2 × 2 Gauss points, with and without incompatible modes.

use super::isotropic::{Vector, cofactors, cross, dot, gram, isotropic, lame, tangents};

/// Corners in the order of Abaqus: the face ζ = −1 anticlockwise seen from ζ = 1, then ζ = 1.
pub(super) const NODES: [Vector; 8] = [
    [-1.0, -1.0, -1.0],
    [1.0, -1.0, -1.0],
    [1.0, 1.0, -1.0],
    [-1.0, 1.0, -1.0],
    [-1.0, -1.0, 1.0],
    [1.0, -1.0, 1.0],
    [1.0, 1.0, 1.0],
    [-1.0, 1.0, 1.0],
];

/// 1/√3.
const GAUSS: f64 = 0.577_350_269_189_625_8;

/// Gauss points, ξ fastest; all weights are 1.
const POINTS: [Vector; 8] = {
    let mut points = [[0.0; 3]; 8];
    let mut q = 0;
    while q < 8 {
        let mut k = 0;
        while k < 3 {
            points[q][k] = if q >> k & 1 == 0 { -GAUSS } else { GAUSS };
            k += 1;
        }
        q += 1;
    }
    points
};

/// Reference gradients of the shape functions at a point.
const fn gradients(point: Vector) -> [Vector; 8] {
    let mut gradients = [[0.0; 3]; 8];
    let mut a = 0;
    while a < 8 {
        let node = NODES[a];
        let factor = [1.0 + node[0] * point[0], 1.0 + node[1] * point[1], 1.0 + node[2] * point[2]];
        gradients[a] = [
            0.125 * node[0] * factor[1] * factor[2],
            0.125 * factor[0] * node[1] * factor[2],
            0.125 * factor[0] * factor[1] * node[2],
        ];
        a += 1;
    }
    gradients
}

const GRADIENTS: [[Vector; 8]; 8] = {
    let mut table = [[[0.0; 3]; 8]; 8];
    let mut q = 0;
    while q < 8 {
        table[q] = gradients(POINTS[q]);
        q += 1;
    }
    table
};

const CENTRE: [Vector; 8] = gradients([0.0; 3]);

/// Values of a packed upper triangle of 24 rows.
const PACKED: usize = 300;

/// Scaled gradients √det J ∇Nₐ of all points, and det J.
#[inline(always)]
fn scaled_gradients(x: &[f64], g: &mut [[f64; 24]; 8], det: &mut [f64; 8]) {
    for q in 0..8 {
        let (j, rows) = cofactors(&tangents(x, &GRADIENTS[q]));
        det[q] = j;
        let scale = 1.0 / j.abs().sqrt();
        let rows = rows.map(|row| row.map(|value| value * scale));
        for (gradient, n) in g[q].as_chunks_mut::<3>().0.iter_mut().zip(&GRADIENTS[q]) {
            for i in 0..3 {
                gradient[i] = n[0] * rows[0][i] + n[1] * rows[1][i] + n[2] * rows[2][i];
            }
        }
    }
}

fn smallest(det: &[f64; 8]) -> f64 {
    // A comparison with NaN is false, so that NaN stays.
    det.iter().fold(f64::INFINITY, |least, &j| if least <= j { least } else { j })
}

pub(super) fn stiffness(x: &[f64], material: &[f64], matrices: &mut [f64], jacobians: &mut [f64]) {
    let (lambda, mu) = lame(material);
    let (mut g, mut det) = ([[0.0; 24]; 8], [0.0; 8]);
    let cells = x.chunks_exact(24).zip(matrices.chunks_exact_mut(PACKED)).zip(jacobians);
    for ((x, matrix), jacobian) in cells {
        scaled_gradients(x, &mut g, &mut det);
        *jacobian = smallest(&det);
        gram(&g, matrix);
        isotropic::<24>(lambda, mu, matrix);
    }
}

/// Incompatible modes 1 − ξ², 1 − η², 1 − ζ² with gradients −2ξₖ (det J₀/det J) ∇₀ξₖ, condensed.
pub(super) fn incompatible_stiffness(
    x: &[f64],
    material: &[f64],
    matrices: &mut [f64],
    jacobians: &mut [f64],
) {
    let (lambda, mu) = lame(material);
    let (mut g, mut det) = ([[0.0; 24]; 8], [0.0; 8]);
    let cells = x.chunks_exact(24).zip(matrices.chunks_exact_mut(PACKED)).zip(jacobians);
    for ((x, matrix), jacobian) in cells {
        scaled_gradients(x, &mut g, &mut det);
        *jacobian = smallest(&det);
        gram(&g, matrix);
        isotropic::<24>(lambda, mu, matrix);
        let mut modes = Modes::new(x, &g, &det);
        modes.blocks(lambda, mu);
        modes.condense(matrix);
    }
}

/// The nine amplitudes 3k + i of the incompatible modes of one cell.
///
/// Every gradient of mode k is along r_k = det J₀ ∇₀ξₖ, so that Σ ∇Nₐ ⊗ ∇mode = tₐₖ ⊗ r_k and
/// Σ ∇mode_k ⊗ ∇mode_l = s_kl r_k ⊗ r_l.
struct Modes {
    r: [Vector; 3],
    /// tₐₖ = −2 Σ ξₖ ∇Nₐ, at [k][a].
    t: [[Vector; 8]; 3],
    s: [[f64; 3]; 3],
    own: [[f64; 9]; 9],
    /// Coupling to the 24 displacements, one row a mode amplitude.
    coupling: [[f64; 24]; 9],
}

impl Modes {
    #[inline(always)]
    fn new(x: &[f64], g: &[[f64; 24]; 8], det: &[f64; 8]) -> Modes {
        let (_, r) = cofactors(&tangents(x, &CENTRE));
        let (mut t, mut s) = ([[[0.0; 3]; 8]; 3], [[0.0; 3]; 3]);
        for q in 0..8 {
            let point = POINTS[q];
            let root = 1.0 / det[q].abs().sqrt();
            for k in 0..3 {
                // `g` carries √det J; t wants the bare gradient.
                let factor = -2.0 * point[k] * root;
                for (t, g) in t[k].as_flattened_mut().iter_mut().zip(&g[q]) {
                    *t += factor * g;
                }
                for l in 0..=k {
                    s[k][l] += 4.0 * point[k] * point[l] / det[q];
                }
            }
        }
        Modes { r, t, s, own: [[0.0; 9]; 9], coupling: [[0.0; 24]; 9] }
    }

    /// Isotropic blocks: λ Gᵢⱼ + μ Gⱼᵢ + μ tr G δᵢⱼ, with G of rank one.
    #[inline(always)]
    fn blocks(&mut self, lambda: f64, mu: f64) {
        for k in 0..3 {
            let rk = self.r[k];
            for l in 0..=k {
                let (s, rl) = (self.s[k][l], self.r[l]);
                let trace = mu * s * dot(rk, rl);
                for i in 0..3 {
                    for j in 0..3 {
                        self.own[3 * k + i][3 * l + j] =
                            s * (lambda * rk[i] * rl[j] + mu * rk[j] * rl[i]);
                    }
                    self.own[3 * k + i][3 * l + i] += trace;
                }
            }
            for a in 0..8 {
                let t = self.t[k][a];
                let trace = mu * dot(t, rk);
                for j in 0..3 {
                    let row = &mut self.coupling[3 * k + j][3 * a..3 * a + 3];
                    for i in 0..3 {
                        row[i] = lambda * t[i] * rk[j] + mu * t[j] * rk[i];
                    }
                    row[j] += trace;
                }
            }
        }
    }

    /// K − Cᵀ S⁻¹ C with S = L Lᵀ: each row of L⁻¹ C is taken off the packed matrix when it is ready.
    #[inline(always)]
    fn condense(&mut self, matrix: &mut [f64]) {
        for p in 0..9 {
            for q in 0..=p {
                let mut sum = self.own[p][q];
                for m in 0..q {
                    sum -= self.own[p][m] * self.own[q][m];
                }
                self.own[p][q] = if p == q { sum.sqrt() } else { sum / self.own[q][q] };
            }
            let (done, rest) = self.coupling.split_at_mut(p);
            let row = &mut rest[0];
            for (m, earlier) in done.iter().enumerate() {
                let factor = self.own[p][m];
                row.iter_mut().zip(earlier).for_each(|(value, e)| *value -= factor * e);
            }
            let scale = 1.0 / self.own[p][p];
            row.iter_mut().for_each(|value| *value *= scale);
        }
        let mut start = 0;
        for r in 0..24 {
            let packed = &mut matrix[start..start + 24 - r];
            for row in &self.coupling {
                let factor = row[r];
                packed.iter_mut().zip(&row[r..]).for_each(|(value, c)| *value -= factor * c);
            }
            start += 24 - r;
        }
    }
}

/// Products of two linear shape functions at the Gauss points −, +: both at −1, one at each, both at 1.
const LINE: [[f64; 2]; 3] = {
    let (near, far) = (0.5 * (1.0 + GAUSS), 0.5 * (1.0 - GAUSS));
    [[near * near, far * far], [near * far, near * far], [far * far, near * near]]
};

/// Which of the 27 distinct values stands at each place of the packed upper triangle.
const PLACES: [u8; 36] = {
    let mut places = [0; 36];
    let (mut n, mut a) = (0, 0);
    while a < 8 {
        let mut b = a;
        while b < 8 {
            // 0, 1, 2 in each direction: both at −1, one at each end, both at 1.
            let mut k = 3;
            while k > 0 {
                k -= 1;
                let pair = (NODES[a][k] + NODES[b][k]) as i32 / 2 + 1;
                places[n] = 3 * places[n] + pair as u8;
            }
            n += 1;
            b += 1;
        }
        a += 1;
    }
    places
};

/// ∫ρ Nₐ N_b dV: 27 distinct values, summed one direction at a time.
pub(super) fn mass(x: &[f64], material: &[f64], matrices: &mut [f64], jacobians: &mut [f64]) {
    let rho = material[0];
    let cells = x.chunks_exact(24).zip(matrices.chunks_exact_mut(36)).zip(jacobians);
    for ((x, matrix), jacobian) in cells {
        let det = determinants(x);
        *jacobian = smallest(&det);
        let mut along_xi = [[0.0; 3]; 4];
        for (sums, d) in along_xi.iter_mut().zip(det.as_chunks::<2>().0) {
            *sums = LINE.map(|l| rho * (l[0] * d[0] + l[1] * d[1]));
        }
        let mut along_eta = [[[0.0; 3]; 3]; 2];
        for (sums, d) in along_eta.iter_mut().zip(along_xi.as_chunks::<2>().0) {
            *sums = LINE.map(|l| [0, 1, 2].map(|i| l[0] * d[0][i] + l[1] * d[1][i]));
        }
        let mut values = [[[0.0; 3]; 3]; 3];
        for (sums, l) in values.iter_mut().zip(&LINE) {
            for (j, sums) in sums.iter_mut().enumerate() {
                *sums = [0, 1, 2].map(|i| l[0] * along_eta[0][j][i] + l[1] * along_eta[1][j][i]);
            }
        }
        let values = values.as_flattened().as_flattened();
        for (entry, &place) in matrix.iter_mut().zip(&PLACES) {
            *entry = values[place as usize];
        }
    }
}

/// det J at the Gauss points. x = Σ c ξᵃηᵇζᶜ, so each tangent is bilinear in the other two coordinates.
#[inline(always)]
fn determinants(x: &[f64]) -> [f64; 8] {
    let mut nodes = [[0.0; 3]; 8];
    nodes.as_flattened_mut().copy_from_slice(x);
    // Sums and differences of neighbours along ξ, then η, then ζ give 8c.
    let [x0, x1, x2, x3, x4, x5, x6, x7] = nodes;
    let sum = |a: Vector, b: Vector| [0, 1, 2].map(|i| a[i] + b[i]);
    let less = |a: Vector, b: Vector| [0, 1, 2].map(|i| a[i] - b[i]);
    let along = |lower: [Vector; 2], upper: [Vector; 2]| {
        (
            [sum(lower[0], upper[0]), sum(lower[1], upper[1])],
            [less(upper[0], lower[0]), less(upper[1], lower[1])],
        )
    };
    let pair = |left: Vector, right: Vector| [sum(left, right), less(right, left)];
    let (near, near_eta) = along(pair(x0, x1), pair(x3, x2));
    let (far, far_eta) = along(pair(x4, x5), pair(x7, x6));
    let xi = sum(near[1], far[1]);
    let eta = sum(near_eta[0], far_eta[0]);
    let xi_eta = sum(near_eta[1], far_eta[1]);
    let zeta = less(far[0], near[0]);
    let xi_zeta = less(far[1], near[1]);
    let eta_zeta = less(far_eta[0], near_eta[0]);
    let all = less(far_eta[1], near_eta[1]);
    let at = |c: Vector, first: Vector, p: f64, second: Vector, q: f64| {
        [0, 1, 2].map(|i| c[i] + first[i] * p + second[i] * q + all[i] * (p * q))
    };
    POINTS.map(|[p, q, r]| {
        let t0 = at(xi, xi_eta, q, xi_zeta, r);
        let t1 = at(eta, xi_eta, p, eta_zeta, r);
        let t2 = at(zeta, xi_zeta, p, eta_zeta, q);
        dot(t0, cross(t1, t2)) / 512.0
    })
}
