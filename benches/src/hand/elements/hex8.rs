//! Trilinear hexahedron with 2 × 2 × 2 Gauss points, with and without incompatible modes: as many cells side by
//! side as a register holds.

#![allow(
    clippy::needless_range_loop,
    reason = "indices of points and components read as in the formulas"
)]

use whirl_specs::registers::{Register, Registers, Task, Zeros};
use whirl_specs::{Batch, Lane};

use super::isotropic::{Isotropic, fill_flops};
use super::modes::{self, Modes};
use super::space::{Cells, Space, Vector, cross, dot, minus, plus, times, trips};

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

/// N_a = ⅛ (1 + ξ ξ_a)(1 + η η_a)(1 + ζ ζ_a) and its gradient.
pub(super) fn shape(at: Vector, values: &mut [f64], slopes: &mut [Vector]) {
    for (a, node) in NODES.iter().enumerate() {
        let [x, y, z] = [0, 1, 2].map(|k| 1.0 + at[k] * node[k]);
        values[a] = 0.125 * x * y * z;
        slopes[a] = [0.125 * node[0] * y * z, 0.125 * x * node[1] * z, 0.125 * x * y * node[2]];
    }
}

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

/// Values of a packed upper triangle of 24 rows.
const PACKED: usize = 300;

/// ∂x/∂ξ, ∂x/∂η, ∂x/∂ζ at the Gauss points. x = Σ c ξᵃηᵇζᶜ, so that each tangent is bilinear in the other two
/// coordinates and takes four values.
struct Tangents<L> {
    /// `along[k]` at the four combinations of the other two coordinates, the lower of the two fastest.
    along: [[Space<L>; 4]; 3],
    /// At the centre.
    centre: [Space<L>; 3],
}

impl<L: Lane> Tangents<L> {
    #[inline(always)]
    fn new(x: &[Space<L>; 8]) -> Self {
        // Sums and differences of neighbours along ξ, then η, then ζ give 8c.
        let (s01, d01) = (plus(x[0], x[1]), minus(x[1], x[0]));
        let (s32, d32) = (plus(x[3], x[2]), minus(x[2], x[3]));
        let (s45, d45) = (plus(x[4], x[5]), minus(x[5], x[4]));
        let (s76, d76) = (plus(x[7], x[6]), minus(x[6], x[7]));
        let (near, near_eta) = (plus(s01, s32), minus(s32, s01));
        let (far, far_eta) = (plus(s45, s76), minus(s76, s45));
        let (near_xi, near_xi_eta) = (plus(d01, d32), minus(d32, d01));
        let (far_xi, far_xi_eta) = (plus(d45, d76), minus(d76, d45));
        let xi = times(plus(near_xi, far_xi), 0.125);
        let eta = times(plus(near_eta, far_eta), 0.125);
        let zeta = times(minus(far, near), 0.125);
        let xi_eta = times(plus(near_xi_eta, far_xi_eta), 0.125 * GAUSS);
        let xi_zeta = times(minus(far_xi, near_xi), 0.125 * GAUSS);
        let eta_zeta = times(minus(far_eta, near_eta), 0.125 * GAUSS);
        let all = times(minus(far_xi_eta, near_xi_eta), 0.125 * GAUSS * GAUSS);
        Tangents {
            along: [
                Self::bilinear(xi, xi_eta, xi_zeta, all),
                Self::bilinear(eta, xi_eta, eta_zeta, all),
                Self::bilinear(zeta, xi_zeta, eta_zeta, all),
            ],
            centre: [xi, eta, zeta],
        }
    }

    /// c ± first ± second ± both, the sign of `first` fastest.
    #[inline(always)]
    fn bilinear(c: Space<L>, first: Space<L>, second: Space<L>, both: Space<L>) -> [Space<L>; 4] {
        let (low, high) = (minus(c, second), plus(c, second));
        let (first_low, first_high) = (minus(first, both), plus(first, both));
        [
            minus(low, first_low),
            plus(low, first_low),
            minus(high, first_high),
            plus(high, first_high),
        ]
    }

    #[inline(always)]
    fn at(&self, q: usize) -> [Space<L>; 3] {
        let [t0, t1, t2] = &self.along;
        [t0[q >> 1], t1[(q & 1) | (q >> 2) << 1], t2[q & 3]]
    }
}

/// The stiffness from its gradients.
pub(super) const STIFFNESS_FLOPS: usize = POINT_FLOPS + fill_flops(8, 8);

/// Operations of [`Tangents::new`]: 20 sums and 7 factors, then 8 sums a direction, of 3 components.
const TANGENT_FLOPS: usize = 3 * (8 + 8 + 7 + 7 + 3 * 8);

/// What is known of a cell at its Gauss points.
struct Points<L> {
    /// `gradients[a][q]`: √det J ∇Nₐ.
    gradients: [[Space<L>; 8]; 8],
    /// 1/√det J.
    inverse_roots: [L; 8],
    least: L,
}

/// Tangents; then cofactors, det J, a root and a division, the scaled cofactors; then the gradients.
const POINT_FLOPS: usize = TANGENT_FLOPS + 8 * (27 + 5 + 2 + 9 + 8 * 15);

// SAFETY: lanes only.
unsafe impl<L: Zeros> Zeros for Points<L> {}

impl<L: Lane> Points<L> {
    #[inline(always)]
    fn fill(&mut self, tangents: &Tangents<L>) {
        let mut maps = [[[L::splat(0.0); 3]; 3]; 8];
        let mut least = L::splat(f64::INFINITY);
        for q in 0..trips(8) {
            let [t0, t1, t2] = tangents.at(q);
            let rows = [cross(t1, t2), cross(t2, t0), cross(t0, t1)];
            let det = dot(t0, rows[0]);
            least = L::select(L::lt(det, least), det, least);
            let inverse_root = L::splat(1.0) / det.sqrt();
            self.inverse_roots[q] = inverse_root;
            for k in 0..3 {
                for i in 0..3 {
                    maps[q][k][i] = rows[k][i] * inverse_root;
                }
            }
        }
        self.least = least;
        for q in 0..trips(8) {
            let [m0, m1, m2] = maps[q];
            for a in 0..trips(8) {
                let [xi, eta, zeta] = GRADIENTS[q][a];
                let (xi, eta, zeta) = (L::splat(xi), L::splat(eta), L::splat(zeta));
                for i in 0..3 {
                    let sum = m1[i].mul_add(eta, m0[i] * xi);
                    self.gradients[a][q][i] = m2[i].mul_add(zeta, sum);
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
        stiffnesses::<L>(self.0, None);
    }
}

struct Incompatible<'a>(Cells<'a>);

impl Task for Incompatible<'_> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        stiffnesses(self.0, Some(&mut Modes::<L>::zeros()));
    }
}

#[inline(always)]
fn stiffnesses<L: Register>(mut cells: Cells, mut modes: Option<&mut Modes<L>>) {
    let isotropic = Isotropic::<L>::new(cells.material);
    let mut x = [[L::splat(0.0); 3]; 8];
    let mut points = Points::<L>::zeros();
    for cell in (0..cells.jacobians.len()).step_by(L::WIDTH) {
        L::gather(&cells.coordinates[24 * cell..], x.as_flattened_mut());
        let tangents = Tangents::new(&x);
        points.fill(&tangents);
        let mut matrix = cells.matrix(cell, PACKED);
        isotropic.fill(&points.gradients, &mut matrix);
        if let Some(modes) = &mut modes {
            modes.fill(&tangents.centre, &points.gradients, &points.inverse_roots);
            modes.take_off(&isotropic, &mut matrix);
        }
        L::scatter(&[points.least], &mut cells.jacobians[cell..]);
    }
}

pub(super) fn stiffness(
    coordinates: &[f64],
    material: &[f64],
    matrices: &mut [Batch],
    jacobians: &mut [f64],
) {
    let cells = Cells { coordinates, material, matrices, jacobians };
    Registers::current().run(Stiffness(cells));
}

pub(super) fn incompatible_stiffness(
    coordinates: &[f64],
    material: &[f64],
    matrices: &mut [Batch],
    jacobians: &mut [f64],
) {
    let cells = Cells { coordinates, material, matrices, jacobians };
    Registers::current().run(Incompatible(cells));
}

/// The stiffness, then the modes.
pub(super) const INCOMPATIBLE_FLOPS: usize = STIFFNESS_FLOPS + modes::FLOPS;

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

/// Products of shape functions along one direction at the two Gauss points: near at −, both at both, near at +.
#[inline(always)]
pub(super) fn along<L: Lane>(low: L, high: L) -> [L; 3] {
    let [[near, far], [mixed, _], _] = LINE;
    [
        low.mul_add(L::splat(near), high * far),
        (low + high) * mixed,
        high.mul_add(L::splat(near), low * far),
    ]
}

struct Mass<'a>(Cells<'a>);

impl Task for Mass<'_> {
    type Output = ();

    /// ∫ρ Nₐ N_b dV: 27 distinct values, summed one direction at a time.
    #[inline(always)]
    fn run<L: Register>(self) {
        let Mass(mut cells) = self;
        let rho = L::splat(cells.material[0]);
        let mut x = [[L::splat(0.0); 3]; 8];
        for cell in (0..cells.jacobians.len()).step_by(L::WIDTH) {
            L::gather(&cells.coordinates[24 * cell..], x.as_flattened_mut());
            let tangents = Tangents::new(&x);
            let mut det = [L::splat(0.0); 8];
            let mut least = L::splat(f64::INFINITY);
            for q in 0..8 {
                let [t0, t1, t2] = tangents.at(q);
                det[q] = dot(t0, cross(t1, t2));
                least = L::select(L::lt(det[q], least), det[q], least);
                det[q] = det[q] * rho;
            }
            let mut by_xi = [[L::splat(0.0); 3]; 4];
            for n in 0..4 {
                by_xi[n] = along(det[2 * n], det[2 * n + 1]);
            }
            let mut by_eta = [[[L::splat(0.0); 3]; 3]; 2];
            for n in 0..2 {
                for i in 0..3 {
                    let sums = along(by_xi[2 * n][i], by_xi[2 * n + 1][i]);
                    for j in 0..3 {
                        by_eta[n][j][i] = sums[j];
                    }
                }
            }
            let mut values = [L::splat(0.0); 27];
            for j in 0..3 {
                for i in 0..3 {
                    let sums = along(by_eta[0][j][i], by_eta[1][j][i]);
                    for k in 0..3 {
                        values[9 * k + 3 * j + i] = sums[k];
                    }
                }
            }
            let mut matrix = cells.matrix(cell, PLACES.len());
            for (entry, place) in PLACES.iter().enumerate() {
                matrix.set(entry, &[values[*place as usize]]);
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

/// Tangents, det J, and 8 operations for every call of [`along`].
pub(super) const MASS_FLOPS: usize = TANGENT_FLOPS + 8 * 15 + 8 * (4 + 6 + 9);
