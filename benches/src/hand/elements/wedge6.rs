//! Linear wedge: three points in the triangle times two Gauss points along the axis; as many cells side by side as
//! a register holds.
//!
//! ∂x/∂ξ and ∂x/∂η change along the axis only, ∂x/∂ζ in the triangle only, and ∇N of a node is that of its corner
//! in the triangle and a share of ∇ζ.

#![allow(
    clippy::needless_range_loop,
    reason = "indices of points and components read as in the formulas"
)]

use whirl_specs::registers::{Register, Registers, Task, Zeros};
use whirl_specs::{Batch, Lane};

use super::hex8::along;
use super::isotropic::{Isotropic, fill_flops};
use super::space::{Cells, Space, Vector, cross, dot, minus, plus, times};

/// Corners in the order of Abaqus: triangle ζ = −1, then ζ = 1.
pub(super) const NODES: [Vector; 6] = [
    [0.0, 0.0, -1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
];

/// N_a = ½ L_a (1 + ζ ζ_a) and its gradient, with L = (1 − ξ − η, ξ, η).
pub(super) fn shape([xi, eta, zeta]: Vector, values: &mut [f64], slopes: &mut [Vector]) {
    const ALONG: [[f64; 2]; 3] = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
    let areas = [1.0 - xi - eta, xi, eta];
    for (a, node) in NODES.iter().enumerate() {
        let (area, [by_xi, by_eta]) = (areas[a % 3], ALONG[a % 3]);
        let half = 0.5 * (1.0 + zeta * node[2]);
        values[a] = area * half;
        slopes[a] = [by_xi * half, by_eta * half, 0.5 * area * node[2]];
    }
}

/// ½(1 ± 1/√3): a linear function along the axis at the Gauss point near its node, and at the other.
const NEAR: f64 = 0.788_675_134_594_812_9;
const FAR: f64 = 0.211_324_865_405_187_1;

/// Each point in the triangle has a third of its area ½; there one area coordinate is 2/3, the others 1/6.
const WEIGHT: f64 = 1.0 / 6.0;

/// Values of a packed upper triangle of 18 rows.
const PACKED: usize = 171;

/// ∂x/∂ξ, ∂x/∂η and their cross product in both layers of points, and ∂x/∂ζ at the three points of a layer.
struct Tangents<L> {
    xi: [Space<L>; 2],
    eta: [Space<L>; 2],
    normal: [Space<L>; 2],
    zeta: [Space<L>; 3],
}

impl<L: Lane> Tangents<L> {
    #[inline(always)]
    fn new(x: &[Space<L>; 6]) -> Self {
        let xi = layers(minus(x[1], x[0]), minus(x[4], x[3]));
        let eta = layers(minus(x[2], x[0]), minus(x[5], x[3]));
        let up = [minus(x[3], x[0]), minus(x[4], x[1]), minus(x[5], x[2])];
        // ½ Σ Lₐ upₐ with Lₐ = 1/6, and ½ more at the own corner.
        let mean = times(plus(plus(up[0], up[1]), up[2]), 1.0 / 12.0);
        Tangents {
            xi,
            eta,
            normal: [cross(xi[0], eta[0]), cross(xi[1], eta[1])],
            zeta: [
                add_scaled(mean, up[0], 0.25),
                add_scaled(mean, up[1], 0.25),
                add_scaled(mean, up[2], 0.25),
            ],
        }
    }
}

/// Linear between the ends, at the lower and the upper Gauss point.
#[inline(always)]
fn layers<L: Lane>(low: Space<L>, high: Space<L>) -> [Space<L>; 2] {
    [add_scaled(times(low, NEAR), high, FAR), add_scaled(times(low, FAR), high, NEAR)]
}

#[inline(always)]
fn add_scaled<L: Lane>(a: Space<L>, b: Space<L>, factor: f64) -> Space<L> {
    let factor = L::splat(factor);
    [b[0].mul_add(factor, a[0]), b[1].mul_add(factor, a[1]), b[2].mul_add(factor, a[2])]
}

#[inline(always)]
fn smaller<L: Lane>(det: L, least: L) -> L {
    L::select(L::lt(det, least), det, least)
}

/// Operations of [`Tangents::new`]: seven differences, two edges in two layers, ∂x/∂ζ, two normals.
const TANGENT_FLOPS: usize = 3 * (7 + 2 * 2 * 3 + 3 + 3 * 2) + 2 * 9;

/// √(w det J) ∇Nₐ at [a][q], triangle points fastest, and the least det J.
struct Points<L> {
    gradients: [[Space<L>; 6]; 6],
    least: L,
}

/// Cofactors, det J, root and quotient, the scaled cofactors; then the gradients.
const POINT_FLOPS: usize = TANGENT_FLOPS + 6 * (18 + 5 + 2 + 9 + 3 * (2 + 2 + 6 * 2));

// SAFETY: lanes only.
unsafe impl<L: Zeros> Zeros for Points<L> {}

impl<L: Lane> Points<L> {
    #[inline(always)]
    fn fill(&mut self, tangents: &Tangents<L>) {
        self.least = L::splat(f64::INFINITY);
        for layer in 0..2 {
            let (xi, eta) = (tangents.xi[layer], tangents.eta[layer]);
            let shares = [[NEAR, FAR], [FAR, NEAR]][layer];
            for corner in 0..3 {
                let zeta = tangents.zeta[corner];
                let det = dot(zeta, tangents.normal[layer]);
                self.least = smaller(det, self.least);
                let scale = L::splat(WEIGHT.sqrt()) / det.sqrt();
                let (to_xi, to_eta) = (cross(eta, zeta), cross(zeta, xi));
                let normal = tangents.normal[layer];
                for i in 0..3 {
                    let (xi, eta) = (to_xi[i] * scale, to_eta[i] * scale);
                    let along = normal[i] * scale;
                    let slopes = [-xi - eta, xi, eta];
                    // ½ Lₐ ∂ζ/∂x.
                    let (own, other) = (along * (1.0 / 3.0), along * (1.0 / 12.0));
                    for a in 0..3 {
                        let rise = if a == corner { own } else { other };
                        let q = 3 * layer + corner;
                        self.gradients[a][q][i] = slopes[a].mul_add(L::splat(shares[0]), -rise);
                        self.gradients[a + 3][q][i] = slopes[a].mul_add(L::splat(shares[1]), rise);
                    }
                }
            }
        }
    }
}

struct Stiffness<'a>(Cells<'a>);

impl Task for Stiffness<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let Stiffness(mut cells) = self;
        let isotropic = Isotropic::<L>::new(cells.material);
        let zero = L::splat(0.0);
        let mut x = [[zero; 3]; 6];
        let mut points = Points::<L>::zeros();
        for cell in (0..cells.jacobians.len()).step_by(L::WIDTH) {
            L::gather(&cells.coordinates[18 * cell..], x.as_flattened_mut());
            points.fill(&Tangents::new(&x));
            isotropic.fill(&points.gradients, &mut cells.matrix(cell, PACKED));
            L::scatter(&[points.least], &mut cells.jacobians[cell..]);
        }
    }
}

pub(super) fn stiffness(
    coordinates: &[f64],
    material: &[f64],
    matrices: &mut [Batch],
    jacobians: &mut [f64],
) {
    Registers::current().run(Stiffness(Cells { coordinates, material, matrices, jacobians }));
}

/// The stiffness from its gradients.
pub(super) const STIFFNESS_FLOPS: usize = POINT_FLOPS + fill_flops(6, 6);

/// Place of the product of area coordinates a and b: (0,0), (1,1), (2,2), then those without 0, 1, 2.
const PAIR: [[usize; 3]; 3] = [[0, 5, 4], [5, 1, 3], [4, 3, 2]];

struct Mass<'a>(Cells<'a>);

impl Task for Mass<'_> {
    type Output = ();

    /// ∫ρ Nₐ N_b dV: 18 distinct values, summed over the triangle, then along the axis.
    #[inline(always)]
    fn run<L: Register>(self) {
        let Mass(mut cells) = self;
        let density = L::splat(WEIGHT * cells.material[0]);
        let zero = L::splat(0.0);
        let mut x = [[zero; 3]; 6];
        for cell in (0..cells.jacobians.len()).step_by(L::WIDTH) {
            L::gather(&cells.coordinates[18 * cell..], x.as_flattened_mut());
            let tangents = Tangents::new(&x);
            let mut least = L::splat(f64::INFINITY);
            let mut sums = [[zero; 6]; 2];
            for layer in 0..2 {
                let mut d = [zero; 3];
                for corner in 0..3 {
                    let det = dot(tangents.zeta[corner], tangents.normal[layer]);
                    least = smaller(det, least);
                    d[corner] = det * density;
                }
                // Lₐ² is 4/9 at the own point, 1/36 at the others; Lₐ L_b is 1/9 at both, 1/36 at the third.
                let mean = (d[0] + d[1] + d[2]) * (1.0 / 36.0);
                let both = mean * 4.0;
                for corner in 0..3 {
                    sums[layer][corner] = d[corner].mul_add(L::splat(15.0 / 36.0), mean);
                    sums[layer][3 + corner] = d[corner].mul_add(L::splat(-1.0 / 12.0), both);
                }
            }
            let mut values = [[zero; 6]; 3];
            for pair in 0..6 {
                let ends = along(sums[0][pair], sums[1][pair]);
                for k in 0..3 {
                    values[k][pair] = ends[k];
                }
            }
            let mut matrix = cells.matrix(cell, 21);
            let mut n = 0;
            for a in 0..6 {
                for b in a..6 {
                    matrix.set(n, &[values[a / 3 + b / 3][PAIR[a % 3][b % 3]]]);
                    n += 1;
                }
            }
            L::scatter(&[least], &mut cells.jacobians[cell..]);
        }
    }
}

pub(super) fn mass(
    coordinates: &[f64],
    material: &[f64],
    matrices: &mut [Batch],
    jacobians: &mut [f64],
) {
    Registers::current().run(Mass(Cells { coordinates, material, matrices, jacobians }));
}

/// Tangents and det J, two layers, then 8 operations for every call of [`along`].
pub(super) const MASS_FLOPS: usize = TANGENT_FLOPS + 6 * 5 + 2 * (3 + 2 + 1 + 1 + 6 * 2) + 6 * 8;
