//! Linear wedge: three points in the triangle times two Gauss points along the axis.

use super::isotropic::{Vector, cofactors, gram, isotropic, lame, tangents};

/// Corners in the order of Abaqus: triangle ζ = −1, then ζ = 1.
pub(super) const NODES: [Vector; 6] = [
    [0.0, 0.0, -1.0],
    [1.0, 0.0, -1.0],
    [0.0, 1.0, -1.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [0.0, 1.0, 1.0],
];

/// 1/√3.
const GAUSS: f64 = 0.577_350_269_189_625_8;

/// Area coordinates of the points in the triangle; each has a third of its area ½.
const TRIANGLE: [Vector; 3] = [
    [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
    [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
];
const WEIGHT: f64 = 1.0 / 6.0;

/// Reference gradients at the points, triangle points fastest.
const GRADIENTS: [[Vector; 6]; 6] = {
    let slope = [[-1.0, -1.0], [1.0, 0.0], [0.0, 1.0]];
    let mut table = [[[0.0; 3]; 6]; 6];
    let mut q = 0;
    while q < 6 {
        let zeta = if q < 3 { -GAUSS } else { GAUSS };
        let mut a = 0;
        while a < 6 {
            let end = if a < 3 { -1.0 } else { 1.0 };
            let along = 0.5 * (1.0 + end * zeta);
            table[q][a] = [
                slope[a % 3][0] * along,
                slope[a % 3][1] * along,
                TRIANGLE[q % 3][a % 3] * 0.5 * end,
            ];
            a += 1;
        }
        q += 1;
    }
    table
};

/// Values of a packed upper triangle of 18 rows.
const PACKED: usize = 171;

fn smallest(det: &[f64; 6]) -> f64 {
    // A comparison with NaN is false, so that NaN stays.
    det.iter().fold(f64::INFINITY, |least, &j| if least <= j { least } else { j })
}

pub(super) fn stiffness(x: &[f64], material: &[f64], matrices: &mut [f64], jacobians: &mut [f64]) {
    let (lambda, mu) = lame(material);
    let (mut g, mut det) = ([[0.0; 18]; 6], [0.0; 6]);
    let cells = x.chunks_exact(18).zip(matrices.chunks_exact_mut(PACKED)).zip(jacobians);
    for ((x, matrix), jacobian) in cells {
        for q in 0..6 {
            let (j, rows) = cofactors(&tangents(x, &GRADIENTS[q]));
            det[q] = j;
            let scale = WEIGHT.sqrt() / j.abs().sqrt();
            let rows = rows.map(|row| row.map(|value| value * scale));
            for (gradient, n) in g[q].as_chunks_mut::<3>().0.iter_mut().zip(&GRADIENTS[q]) {
                for i in 0..3 {
                    gradient[i] = n[0] * rows[0][i] + n[1] * rows[1][i] + n[2] * rows[2][i];
                }
            }
        }
        *jacobian = smallest(&det);
        gram(&g, matrix);
        isotropic::<18>(lambda, mu, matrix);
    }
}

/// The six products of two area coordinates, (0,0), (0,1), (0,2), (1,1), (1,2), (2,2), at the points.
const AREA: [Vector; 6] = {
    let mut products = [[0.0; 3]; 6];
    let pairs = [[0, 0], [0, 1], [0, 2], [1, 1], [1, 2], [2, 2]];
    let mut n = 0;
    while n < 6 {
        let mut q = 0;
        while q < 3 {
            products[n][q] = WEIGHT * TRIANGLE[q][pairs[n][0]] * TRIANGLE[q][pairs[n][1]];
            q += 1;
        }
        n += 1;
    }
    products
};

/// Place in [`AREA`] of the product of area coordinates a and b.
const PAIR: [[usize; 3]; 3] = [[0, 1, 2], [1, 3, 4], [2, 4, 5]];

/// ∫ρ Nₐ N_b dV: 18 distinct values, summed over the triangle, then along the axis.
pub(super) fn mass(x: &[f64], material: &[f64], matrices: &mut [f64], jacobians: &mut [f64]) {
    let rho = material[0];
    let (near, far) = (0.5 * (1.0 + GAUSS), 0.5 * (1.0 - GAUSS));
    let line = [[near * near, far * far], [near * far, near * far], [far * far, near * near]];
    let cells = x.chunks_exact(18).zip(matrices.chunks_exact_mut(21)).zip(jacobians);
    for ((x, matrix), jacobian) in cells {
        let mut det = [0.0; 6];
        for (det, gradients) in det.iter_mut().zip(&GRADIENTS) {
            *det = cofactors(&tangents(x, gradients)).0;
        }
        *jacobian = smallest(&det);
        let (lower, upper) = (&det[..3], &det[3..]);
        let mut values = [[0.0; 6]; 3];
        for (n, area) in AREA.iter().enumerate() {
            let sum = |det: &[f64]| rho * (area[0] * det[0] + area[1] * det[1] + area[2] * det[2]);
            let (below, above) = (sum(lower), sum(upper));
            for (values, l) in values.iter_mut().zip(&line) {
                values[n] = l[0] * below + l[1] * above;
            }
        }
        let mut n = 0;
        for a in 0..6 {
            for b in a..6 {
                matrix[n] = values[a / 3 + b / 3][PAIR[a % 3][b % 3]];
                n += 1;
            }
        }
    }
}
/// At a point: tangents, cofactors and det J, the scale, gradients; then their products and the blocks.
pub(super) const STIFFNESS_FLOPS: usize =
    6 * (2 * 9 * 6 + 32 + 12 + 6 * 15) + 2 * 6 * PACKED + 15 * 33 + 6 * 12;
/// Tangents and det J at a point; then sums of six products.
pub(super) const MASS_FLOPS: usize = 6 * (2 * 9 * 6 + 32) + 6 * (2 * 6 + 3 * 3);
