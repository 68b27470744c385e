//! Blocks of cells under prescribed displacements and loads: patch test, order of convergence, locking.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use whirl_codegen::diagnostic::Source;
use whirl_codegen::element::Cell;
use whirl_codegen::kinds::element::ElementSpec;
use whirl_specs::{ELEMENTS, Element};

use super::{direct, element, generated, property, spec};

/// Nodes and cells.
pub(crate) struct Block {
    pub(crate) nodes: Vec<[f64; 3]>,
    pub(crate) cells: Vec<Vec<usize>>,
    /// Nodes on the surface of the block.
    surface: Vec<bool>,
}

/// An affine image of a reference cell: its origin and the images of the three unit vectors.
type Affine = [[f64; 3]; 4];

fn image([origin, axes @ ..]: &Affine, at: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| origin[i] + (0..3).map(|k| at[k] * axes[k][i]).sum::<f64>())
}

/// The unit cube by affine images of a cell, so that cubes side by side fit together.
fn unit_cube(cell: Cell) -> Vec<Affine> {
    let unit = |axis: usize, length: f64| {
        let mut vector = [0.0; 3];
        vector[axis] = length;
        vector
    };
    let half = [0, 1, 2].map(|axis| unit(axis, 0.5));
    match cell {
        Cell::Hexahedron => vec![[[0.5; 3], half[0], half[1], half[2]]],
        Cell::Wedge => vec![
            [[0.0, 0.0, 0.5], unit(0, 1.0), [1.0, 1.0, 0.0], half[2]],
            [[0.0, 0.0, 0.5], [1.0, 1.0, 0.0], unit(1, 1.0), half[2]],
        ],
        // One along every way from corner to opposite corner over three edges.
        Cell::Tetrahedron => {
            let ways = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]];
            let image = |(place, [a, b, _]): (usize, [usize; 3])| {
                let first = unit(a, 1.0);
                let mut second = first;
                second[b] = 1.0;
                // The last three ways are odd.
                let (first, second) = if place < 3 { (first, second) } else { (second, first) };
                [[0.0; 3], first, second, [1.0; 3]]
            };
            ways.into_iter().enumerate().map(image).collect()
        }
        // One on every face, with the apex in the middle.
        Cell::Pyramid => (0..6)
            .map(|face| {
                let (axis, inward) = (face % 3, if face < 3 { 0.5 } else { -0.5 });
                let mut origin = [0.5; 3];
                origin[axis] -= inward;
                let (first, second) = (half[(axis + 1) % 3], half[(axis + 2) % 3]);
                let (first, second) = if inward > 0.0 { (first, second) } else { (second, first) };
                [origin, first, second, unit(axis, inward)]
            })
            .collect(),
    }
}

/// A box of `counts` cubes of cells of an element, whose nodes are moved by `moved`.
pub(crate) fn block(
    element: &Element,
    side: [f64; 3],
    counts: [usize; 3],
    moved: impl Fn([f64; 3]) -> [f64; 3],
) -> Block {
    let images = unit_cube(spec(element).cell);
    // In units of cubes, where coordinates are quarters at the finest.
    let mut numbers: BTreeMap<[i64; 3], usize> = BTreeMap::new();
    let (mut nodes, mut surface, mut cells) = (Vec::new(), Vec::new(), Vec::new());
    let [nx, ny, nz] = counts;
    for cube in 0..nx * ny * nz {
        let corner = [cube % nx, cube / nx % ny, cube / (nx * ny)].map(|place| place as f64);
        for affine in &images {
            let mut cell = Vec::new();
            for reference in element.reference_nodes {
                let inside = image(affine, *reference);
                let at: [f64; 3] = std::array::from_fn(|i| corner[i] + inside[i]);
                let number =
                    *numbers.entry(at.map(|x| (x * 64.0).round() as i64)).or_insert_with(|| {
                        nodes.push(moved(std::array::from_fn(|i| {
                            side[i] * at[i] / counts[i] as f64
                        })));
                        let outside = |i: usize| at[i] == 0.0 || at[i] == counts[i] as f64;
                        surface.push((0..3).any(outside));
                        nodes.len() - 1
                    });
                cell.push(number);
            }
            cells.push(cell);
        }
    }
    Block { nodes, cells, surface }
}

/// The patch for an element: small, with nodes inside that are moved without order. Where the spec says
/// that only affine cells pass, the nodes of a tetrahedron stay in the middle of its edges, and other cells
/// are not moved.
pub(super) fn patch(element: &Element) -> Block {
    let many = element.nodes > 8 || spec(element).cell == Cell::Pyramid;
    let count = if many { 2 } else { 3 };
    if !spec(element).rule("stiffness").affine {
        let apart = 1.0 / count as f64 / if many { 2.0 } else { 1.0 };
        return block(element, [1.0; 3], [count; 3], |x| distorted(x, 0.12 * apart));
    }
    let mut patch = block(element, [1.0; 3], [count; 3], |x| x);
    if spec(element).cell == Cell::Tetrahedron {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let place = |corner: &[f64; 3]| {
            element.reference_nodes.iter().position(|node| node == corner).expect("a corner")
        };
        let places = corners.each_ref().map(place);
        let before = patch.nodes.clone();
        for cell in &patch.cells {
            let corners = places.map(|place| distorted(before[cell[place]], 0.05 / count as f64));
            for (node, [xi, eta, zeta]) in cell.iter().zip(element.reference_nodes) {
                let shares = [1.0 - xi - eta - zeta, *xi, *eta, *zeta];
                patch.nodes[*node] =
                    std::array::from_fn(|i| (0..4).map(|k| shares[k] * corners[k][i]).sum());
            }
        }
    }
    patch
}

type CellStiffness<'a> = &'a dyn Fn(&[[f64; 3]]) -> DMatrix<f64>;

impl Block {
    fn stiffness(&self, cell: CellStiffness) -> DMatrix<f64> {
        let size = 3 * self.nodes.len();
        let mut k = DMatrix::zeros(size, size);
        for nodes in &self.cells {
            let x: Vec<[f64; 3]> = nodes.iter().map(|&node| self.nodes[node]).collect();
            let matrix = cell(&x);
            for (a, &node_a) in nodes.iter().enumerate() {
                for (b, &node_b) in nodes.iter().enumerate() {
                    let mut place = k.view_mut((3 * node_a, 3 * node_b), (3, 3));
                    place += matrix.view((3 * a, 3 * b), (3, 3));
                }
            }
        }
        k
    }

    /// Solves for the nodes that are not `held`, those have the displacements of `u`; `f` loads the others.
    fn solve(
        &self,
        k: &DMatrix<f64>,
        held: impl Fn(usize) -> bool,
        mut u: DVector<f64>,
        f: &DVector<f64>,
    ) -> DVector<f64> {
        let free: Vec<usize> = (0..u.len()).filter(|dof| !held(dof / 3)).collect();
        free.iter().for_each(|&dof| u[dof] = 0.0);
        let right = f - k * &u;
        let inner = k.select_rows(&free).select_columns(&free);
        let right = DVector::from_iterator(free.len(), free.iter().map(|&dof| right[dof]));
        let solution = inner.cholesky().expect("positive definite").solve(&right);
        free.iter().zip(&solution).for_each(|(&dof, value)| u[dof] = *value);
        u
    }

    /// Error of the displacements where the surface follows `exact`: its norm with every inner node standing
    /// for one cell's volume, relative to the largest displacement.
    fn error_inside(&self, cell: CellStiffness, exact: impl Fn([f64; 3]) -> [f64; 3]) -> f64 {
        let exact = DVector::from_vec(self.nodes.iter().flat_map(|x| exact(*x)).collect());
        let k = self.stiffness(cell);
        let u =
            self.solve(&k, |node| self.surface[node], exact.clone(), &DVector::zeros(exact.len()));
        (u - &exact).norm() / (self.cells.len() as f64).sqrt() / exact.amax()
    }
}

fn by_kernel(element: &Element) -> impl Fn(&[[f64; 3]]) -> DMatrix<f64> {
    move |x| generated(element, "stiffness", x).0
}

/// Moves the inner nodes of a unit cube by up to `most` along each axis, without order.
fn distorted(x: [f64; 3], most: f64) -> [f64; 3] {
    if x.iter().any(|x| *x == 0.0 || *x == 1.0) {
        return x;
    }
    let phase = 12.9898 * x[0] + 78.233 * x[1] + 37.719 * x[2];
    std::array::from_fn(|i| x[i] + most * (phase * (i + 3) as f64).sin())
}

fn constant_strain([x, y, z]: [f64; 3]) -> [f64; 3] {
    [
        0.01 + 1e-3 * x + 2e-4 * y - 3e-4 * z,
        -0.02 + 5e-4 * x - 7e-4 * y + 1e-4 * z,
        0.03 - 2e-4 * x + 4e-4 * y + 6e-4 * z,
    ]
}

#[test]
fn distorted_patches_reproduce_constant_strain() {
    for element in ELEMENTS {
        let name = element.origin.name;
        let error = patch(element).error_inside(&by_kernel(element), constant_strain);
        // Rounding of some hundred terms, times what the solution makes of it.
        assert!(error < 1e-12, "{name}: {error:.1e}");
    }
}

/// Gradients of harmonic functions of the third degree: quadratic, and in equilibrium without body forces.
fn quadratic([x, y, z]: [f64; 3]) -> [f64; 3] {
    [
        3.0 * (x * x - y * y) + 2.0 * x * z + y * z,
        -6.0 * x * y - 2.0 * y * z + x * z,
        x * x - y * y + x * y,
    ]
}

/// Elements that claim completeness of the second degree are exact on affine cells.
#[test]
fn quadratic_elements_reproduce_quadratic_displacements() {
    let complete = ELEMENTS.iter().filter(|element| spec(element).complete > 1);
    let mut names = Vec::new();
    for element in complete {
        names.push(element.origin.name);
        let block = block(element, [1.0, 0.8, 0.9], [2; 3], |x| x);
        let error = block.error_inside(&by_kernel(element), quadratic);
        assert!(error < 1e-12, "{}: {error:.1e}", element.origin.name);
    }
    assert!(["hex20", "wedge15", "tet10"].iter().all(|name| names.contains(name)), "{names:?}");
}

/// The volume of a patch is that of its box, however the cells within are shaped.
#[test]
fn a_distorted_patch_has_the_mass_of_its_box() {
    for element in ELEMENTS {
        let patch = patch(element);
        for (form, expected) in [("mass", 3.0), ("spin_inertia", 2.0), ("spin_coupling", 0.0)] {
            let mut sum = 0.0;
            for cell in &patch.cells {
                let nodes: Vec<[f64; 3]> = cell.iter().map(|&node| patch.nodes[node]).collect();
                sum += generated(element, form, &nodes).0.sum();
            }
            let error = sum / property("rho") - expected;
            assert!(error.abs() < 1e-12, "{} {form}: {error:.1e}", element.origin.name);
        }
    }
}

/// Without the correction the modes do work against constant stress, and the patch test shows it.
#[test]
fn modes_without_their_correction_fail_the_patch_test() {
    let shipped = element("hex8i").origin.text;
    let patch = block(element("hex8i"), [1.0; 3], [3; 3], |x| distorted(x, 0.1));
    for (from, to) in [
        ("", ""),
        ("jacobian = \"centre\"\nscale = 'det0/det'", "jacobian = \"point\""),
        ("scale = 'det0/det'", "scale = '1'"),
    ] {
        assert!(shipped.contains(from));
        let text = Source::new("element.toml", shipped.replacen(from, to, 1));
        let spec = ElementSpec::read_unproved(&text).unwrap();
        let error = patch.error_inside(&|x| direct(&spec, "stiffness", x), constant_strain);
        if from.is_empty() {
            assert!(error < 1e-13, "{error:.1e}");
        } else {
            assert!(error > 1e-4, "{to}: {error:.1e}");
        }
    }
}

/// Tip deflection of a cantilever under a shear force, one cell over the height, against Timoshenko's beam.
fn deflection(name: &str) -> f64 {
    let (length, height, width) = (1.0, 0.1, 0.1);
    let (e, nu, force) = (property("E"), property("nu"), 1000.0);
    let beam = block(element(name), [length, height, width], [10, 1, 1], |x| x);
    let k = beam.stiffness(&by_kernel(element(name)));
    let tip: Vec<usize> = (0..beam.nodes.len()).filter(|&n| beam.nodes[n][0] == length).collect();
    let mut f = DVector::zeros(3 * beam.nodes.len());
    tip.iter().for_each(|node| f[3 * node + 1] = force / tip.len() as f64);
    let held = |node: usize| beam.nodes[node][0] == 0.0;
    let u = beam.solve(&k, held, DVector::zeros(f.len()), &f);
    let found = tip.iter().map(|node| u[3 * node + 1]).sum::<f64>() / tip.len() as f64;
    let (area, inertia) = (height * width, width * height.powi(3) / 12.0);
    let shear = e / (2.0 * (1.0 + nu)) * area * 5.0 / 6.0;
    found / (force * length.powi(3) / (3.0 * e * inertia) + force * length / shear)
}

#[test]
fn incompatible_modes_do_not_lock_in_bending() {
    let (plain, enhanced) = (deflection("hex8"), deflection("hex8i"));
    // A square cell without the modes has 2/3 of the flexibility in plane strain, less in the third
    // direction; the root section is held stiffer than a beam's, for less than 2 % of the deflection.
    assert!(plain < 0.75, "hex8: {plain:.3}");
    assert!((enhanced - 1.0).abs() < 0.02, "hex8i: {enhanced:.3}");
}
