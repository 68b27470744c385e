//! Quadratic tetrahedron, serendipity wedge and hexahedron: slopes and products of the functions at the points come from
//! tables that are the same for all cells; as many cells side by side as a register holds.

#![allow(
    clippy::needless_range_loop,
    reason = "indices of points and components read as in the formulas"
)]

mod functions;
mod rules;

use std::array::from_fn;
use std::sync::LazyLock;

use whirl_specs::registers::{Register, Registers, Task, Zeros};
use whirl_specs::{Batch, Element, Lane};

pub use self::rules::{Point, hex_27, tet_4, tet_15, wedge_18};

use self::functions::{HEX20_NODES, TET10_NODES, WEDGE15_NODES, hex20, tet10, wedge15};
use super::isotropic::{Isotropic, fill_flops};
use super::space::{Cells, Space, Vector, cross, dot, trips};
use super::{DOT, origin, scalar};

/// Value and slope of each function at a point.
type Shape = fn(Vector, &mut [f64], &mut [Vector]);

/// What is known of N functions at P points before any cell.
struct Table<const N: usize, const P: usize> {
    slopes: [[Vector; N]; P],
    weights: [f64; P],
    /// N_a N_b of the upper triangle, row after row.
    products: Vec<[f64; P]>,
}

impl<const N: usize, const P: usize> Table<N, P> {
    fn new(shape: Shape, points: &[Point]) -> Self {
        let mut values = [[0.0; N]; P];
        let mut slopes = [[[0.0; 3]; N]; P];
        for p in 0..P {
            shape(points[p].0, &mut values[p], &mut slopes[p]);
        }
        let pairs = (0..N).flat_map(|a| (a..N).map(move |b| (a, b)));
        let products = pairs.map(|(a, b)| from_fn(|p| values[p][a] * values[p][b])).collect();
        Table { slopes, weights: from_fn(|p| points[p].1), products }
    }
}

/// √(w det J) ∇Nₐ at [a][p].
struct Gradients<L, const N: usize, const P: usize>([[Space<L>; P]; N]);

// SAFETY: lanes only.
unsafe impl<L: Zeros, const N: usize, const P: usize> Zeros for Gradients<L, N, P> {}

/// The columns of ∂x/∂ξ at a point.
#[inline(always)]
fn tangents<L: Lane, const N: usize>(x: &[Space<L>; N], slopes: &[Vector; N]) -> [Space<L>; 3] {
    let mut sums = [[L::splat(0.0); 3]; 3];
    for a in 0..N {
        for k in 0..3 {
            let slope = L::splat(slopes[a][k]);
            for i in 0..3 {
                sums[k][i] = x[a][i].mul_add(slope, sums[k][i]);
            }
        }
    }
    sums
}

/// Operations of [`tangents`].
const fn tangent_flops(nodes: usize) -> usize {
    2 * 9 * nodes
}

struct Stiffness<'a, const N: usize, const P: usize>(Cells<'a>, &'a Table<N, P>);

impl<const N: usize, const P: usize> Task for Stiffness<'_, N, P> {
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let Stiffness(mut cells, table) = self;
        let isotropic = Isotropic::<L>::new(cells.material);
        let mut x = [[L::splat(0.0); 3]; N];
        let mut gradients = Gradients::<L, N, P>::zeros();
        for cell in (0..cells.jacobians.len()).step_by(L::WIDTH) {
            L::gather(&cells.coordinates[3 * N * cell..], x.as_flattened_mut());
            let mut least = L::splat(f64::INFINITY);
            for p in 0..trips(P) {
                let slopes = &table.slopes[p];
                let [xi, eta, zeta] = tangents(&x, slopes);
                let cofactors = [cross(eta, zeta), cross(zeta, xi), cross(xi, eta)];
                let det = dot(xi, cofactors[0]);
                least = L::select(L::lt(det, least), det, least);
                let scale = (L::splat(table.weights[p]) / det).sqrt();
                let scaled = cofactors.map(|own| own.map(|own| own * scale));
                for a in 0..N {
                    let [by_xi, by_eta, by_zeta] = slopes[a].map(L::splat);
                    gradients.0[a][p] = from_fn(|i| {
                        let flat = scaled[1][i].mul_add(by_eta, scaled[0][i] * by_xi);
                        scaled[2][i].mul_add(by_zeta, flat)
                    });
                }
            }
            isotropic.fill(&gradients.0, &mut cells.matrix(cell, 3 * N * (3 * N + 1) / 2));
            L::scatter(&[least], &mut cells.jacobians[cell..]);
        }
    }
}

/// Tangents, cofactors, det J, scale, scaled cofactors, gradients; then the stiffness from them.
const fn stiffness_flops(nodes: usize, points: usize) -> usize {
    points * (tangent_flops(nodes) + 27 + 5 + 2 + 9 + nodes * 3 * 5) + fill_flops(nodes, points)
}

struct Mass<'a, const N: usize, const P: usize>(Cells<'a>, &'a Table<N, P>);

impl<const N: usize, const P: usize> Task for Mass<'_, N, P> {
    type Output = ();

    /// Σ w ρ det J Nₐ N_b.
    #[inline(always)]
    fn run<L: Register>(self) {
        let Mass(mut cells, table) = self;
        let density = cells.material[0];
        let mut x = [[L::splat(0.0); 3]; N];
        let mut d = [L::splat(0.0); P];
        for cell in (0..cells.jacobians.len()).step_by(L::WIDTH) {
            L::gather(&cells.coordinates[3 * N * cell..], x.as_flattened_mut());
            let mut least = L::splat(f64::INFINITY);
            for p in 0..trips(P) {
                let [xi, eta, zeta] = tangents(&x, &table.slopes[p]);
                let det = dot(xi, cross(eta, zeta));
                least = L::select(L::lt(det, least), det, least);
                d[p] = det * (density * table.weights[p]);
            }
            let mut matrix = cells.matrix(cell, N * (N + 1) / 2);
            for (place, products) in table.products.iter().enumerate() {
                // Two sums, so that additions do not wait for each other.
                let mut sums = [L::splat(0.0); 2];
                for p in 0..P {
                    sums[p % 2] = d[p].mul_add(L::splat(products[p]), sums[p % 2]);
                }
                matrix.set(place, &[sums[0] + sums[1]]);
            }
            L::scatter(&[least], &mut cells.jacobians[cell..]);
        }
    }
}

/// Tangents, det J and its weight; then the sums.
const fn mass_flops(nodes: usize, points: usize) -> usize {
    points * (tangent_flops(nodes) + 9 + 5 + 1) + nodes * (nodes + 1) / 2 * (2 * points + 1)
}

/// The kernels of an element, and their operations a cell.
macro_rules! kernels {
    ($name:ident, $shape:ident, $nodes:literal, $stiffness:ident, $mass:ident) => {
        mod $name {
            use super::*;

            static STIFFNESS: LazyLock<Table<$nodes, { rules::$stiffness::POINTS }>> =
                LazyLock::new(|| Table::new($shape, &rules::$stiffness::points()));
            static MASS: LazyLock<Table<$nodes, { rules::$mass::POINTS }>> =
                LazyLock::new(|| Table::new($shape, &rules::$mass::points()));

            pub(super) const STIFFNESS_FLOPS: usize =
                stiffness_flops($nodes, rules::$stiffness::POINTS);
            pub(super) const MASS_FLOPS: usize = mass_flops($nodes, rules::$mass::POINTS);

            pub(super) fn stiffness(
                coordinates: &[f64],
                material: &[f64],
                matrices: &mut [Batch],
                jacobians: &mut [f64],
            ) {
                let cells = Cells { coordinates, material, matrices, jacobians };
                Registers::current().run(Stiffness(cells, &*STIFFNESS));
            }

            pub(super) fn mass(
                coordinates: &[f64],
                material: &[f64],
                matrices: &mut [Batch],
                jacobians: &mut [f64],
            ) {
                let cells = Cells { coordinates, material, matrices, jacobians };
                Registers::current().run(Mass(cells, &*MASS));
            }
        }
    };
}

kernels!(of_tet10, tet10, 10, tet_4, tet_15);
kernels!(of_wedge15, wedge15, 15, wedge_18, wedge_18);
kernels!(of_hex20, hex20, 20, hex_27, hex_27);

/// Quadratic tetrahedron, 4 points, 15 for the mass.
pub static TET10: Element = Element {
    forms: &[
        super::stiffness(of_tet10::stiffness, of_tet10::STIFFNESS_FLOPS),
        scalar("mass", DOT, of_tet10::mass, of_tet10::MASS_FLOPS),
    ],
    ..quadratic("tet10", "quadratic tetrahedron", &TET10_NODES, tet10)
};

/// Serendipity wedge, 6 × 3 points.
pub static WEDGE15: Element = Element {
    forms: &[
        super::stiffness(of_wedge15::stiffness, of_wedge15::STIFFNESS_FLOPS),
        scalar("mass", DOT, of_wedge15::mass, of_wedge15::MASS_FLOPS),
    ],
    ..quadratic("wedge15", "serendipity wedge", &WEDGE15_NODES, wedge15)
};

/// Serendipity hexahedron, 3 × 3 × 3 Gauss points.
pub static HEX20: Element = Element {
    forms: &[
        super::stiffness(of_hex20::stiffness, of_hex20::STIFFNESS_FLOPS),
        scalar("mass", DOT, of_hex20::mass, of_hex20::MASS_FLOPS),
    ],
    ..quadratic("hex20", "serendipity hexahedron", &HEX20_NODES, hex20)
};

/// All of them: kernels only, for none of them says how files order its nodes.
pub static ELEMENTS: [&Element; 3] = [&TET10, &WEDGE15, &HEX20];

const fn quadratic(
    name: &'static str,
    title: &'static str,
    nodes: &'static [Vector],
    shape: Shape,
) -> Element {
    Element {
        origin: origin(name, title),
        nodes: nodes.len(),
        reference_nodes: nodes,
        abaqus: &[],
        abaqus_order: &[],
        gmsh: None,
        nastran: None,
        vtk: 0,
        vtk_order: &[],
        shape,
        faces: &[],
        forms: &[],
        stresses: &[],
    }
}
