//! What the stiffness kernels share: Jacobians and the blocks of an isotropic material.

pub(super) type Vector = [f64; 3];

/// Lamé's λ and μ from E and ν.
pub(super) fn lame(material: &[f64]) -> (f64, f64) {
    let (e, nu) = (material[0], material[1]);
    (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)))
}

pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// ∂x/∂ξ, ∂x/∂η, ∂x/∂ζ from the nodes' positions (N × 3) and reference gradients.
#[inline(always)]
pub(super) fn tangents<const N: usize>(x: &[f64], gradients: &[Vector; N]) -> [Vector; 3] {
    let mut tangents = [[0.0; 3]; 3];
    for (x, gradient) in x.chunks_exact(3).zip(gradients) {
        for (tangent, g) in tangents.iter_mut().zip(gradient) {
            for (t, x) in tangent.iter_mut().zip(x) {
                *t += g * x;
            }
        }
    }
    tangents
}

/// det J and the cofactors det J · ∂ξ/∂x, det J · ∂η/∂x, det J · ∂ζ/∂x.
#[inline(always)]
pub(super) fn cofactors(tangents: &[Vector; 3]) -> (f64, [Vector; 3]) {
    let [t0, t1, t2] = *tangents;
    let cofactors = [cross(t1, t2), cross(t2, t0), cross(t0, t1)];
    (dot(t0, cofactors[0]), cofactors)
}

/// Σ over points of g gᵀ, upper triangle by rows; `g`: points × 3N scaled gradients √(w det J) ∇Nₐ.
#[inline(always)]
pub(super) fn gram<const P: usize, const D: usize>(g: &[[f64; D]; P], upper: &mut [f64]) {
    let mut start = 0;
    for r in 0..D {
        let row = &mut upper[start..start + D - r];
        row.fill(0.0);
        for point in g {
            let factor = point[r];
            for (sum, value) in row.iter_mut().zip(&point[r..]) {
                *sum += factor * value;
            }
        }
        start += D - r;
    }
}

/// Turns Σ ∇Nₐ ⊗ ∇N_b into λ Gᵢⱼ + μ Gⱼᵢ + μ tr G δᵢⱼ, block by block, in place.
#[inline(always)]
pub(super) fn isotropic<const D: usize>(lambda: f64, mu: f64, upper: &mut [f64]) {
    let row = |r: usize| r * (2 * D - r + 1) / 2;
    for a in (0..D).step_by(3) {
        let [r0, r1, r2] = [row(a), row(a + 1) - 1, row(a + 2) - 2];
        // Diagonal block: G is symmetric.
        let trace = mu * (upper[r0] + upper[r1 + 1] + upper[r2 + 2]);
        for (r, i) in [(r0, 0), (r1, 1), (r2, 2)] {
            upper[r + i] = (lambda + mu) * upper[r + i] + trace;
            for j in i + 1..3 {
                upper[r + j] *= lambda + mu;
            }
        }
        for b in (3..D - a).step_by(3) {
            let block = [r0 + b, r1 + b, r2 + b];
            let g: [Vector; 3] = block.map(|r| [upper[r], upper[r + 1], upper[r + 2]]);
            let trace = mu * (g[0][0] + g[1][1] + g[2][2]);
            for (i, r) in block.into_iter().enumerate() {
                for j in 0..3 {
                    upper[r + j] = lambda * g[i][j] + mu * g[j][i];
                }
                upper[r + i] += trace;
            }
        }
    }
}
