//! Blocks of cells under prescribed displacements and loads: patch test, order of convergence, locking.

use nalgebra::{DMatrix, DVector};
use whirl_specs::Element;

use super::{direct, element, generated, property};

/// Nodes and cells.
struct Block {
    nodes: Vec<[f64; 3]>,
    cells: Vec<Vec<usize>>,
    /// Nodes on the surface of the block.
    surface: Vec<bool>,
}

/// A box of `counts` hexahedra, or of twice as many wedges, whose nodes are moved by `moved`.
fn block(
    wedges: bool,
    side: [f64; 3],
    counts: [usize; 3],
    moved: impl Fn([f64; 3]) -> [f64; 3],
) -> Block {
    let [nx, ny, nz] = counts;
    let number = |i: usize, j: usize, k: usize| i + (nx + 1) * (j + (ny + 1) * k);
    let (mut nodes, mut surface, mut cells) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..=nz {
        for j in 0..=ny {
            for i in 0..=nx {
                let at = [(i, nx), (j, ny), (k, nz)];
                let x = std::array::from_fn(|a| side[a] * at[a].0 as f64 / at[a].1 as f64);
                nodes.push(moved(x));
                surface.push(at.iter().any(|(place, count)| *place == 0 || place == count));
                if i < nx && j < ny && k < nz {
                    let ring = |k| {
                        [
                            number(i, j, k),
                            number(i + 1, j, k),
                            number(i + 1, j + 1, k),
                            number(i, j + 1, k),
                        ]
                    };
                    let (low, high) = (ring(k), ring(k + 1));
                    if wedges {
                        for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
                            cells.push(vec![low[a], low[b], low[c], high[a], high[b], high[c]]);
                        }
                    } else {
                        cells.push([low, high].concat());
                    }
                }
            }
        }
    }
    Block { nodes, cells, surface }
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

/// Moves the inner nodes of a unit cube by up to a tenth, without order.
fn distorted(x: [f64; 3]) -> [f64; 3] {
    if x.iter().any(|x| *x == 0.0 || *x == 1.0) {
        return x;
    }
    let phase = 12.9898 * x[0] + 78.233 * x[1] + 37.719 * x[2];
    std::array::from_fn(|i| x[i] + 0.1 * (phase * (i + 3) as f64).sin())
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
    for name in ["hex8", "hex8i", "wedge6"] {
        let patch = block(name == "wedge6", [1.0; 3], [3; 3], distorted);
        let error = patch.error_inside(&by_kernel(element(name)), constant_strain);
        assert!(error < 1e-13, "{name}: {error:.1e}");
    }
}

/// Without the correction the modes do work against constant stress, and the patch test shows it.
#[test]
fn modes_without_their_correction_fail_the_patch_test() {
    let shipped = element("hex8i").origin.text;
    let patch = block(false, [1.0; 3], [3; 3], distorted);
    for (from, to) in [
        ("", ""),
        ("jacobian = \"centre\"\nscale = 'det0/det'", "jacobian = \"point\""),
        ("scale = 'det0/det'", "scale = '1'"),
    ] {
        assert!(shipped.contains(from));
        let text = shipped.replacen(from, to, 1);
        let error = patch.error_inside(&|x| direct(&text, "stiffness", x), constant_strain);
        if from.is_empty() {
            assert!(error < 1e-13, "{error:.1e}");
        } else {
            assert!(error > 1e-4, "{to}: {error:.1e}");
        }
    }
}

/// u = ∇φ with Δφ = 0 is in equilibrium without body forces: φ = exp(√2 x) sin y sin z.
fn harmonic([x, y, z]: [f64; 3]) -> [f64; 3] {
    let (root, growth) = (2f64.sqrt(), (2f64.sqrt() * x).exp());
    [root * growth * y.sin() * z.sin(), growth * y.cos() * z.sin(), growth * y.sin() * z.cos()]
}

#[test]
fn displacements_converge_with_second_order() {
    let bent = |x: [f64; 3]| {
        let bump: f64 = x.iter().map(|x| (std::f64::consts::PI * x).sin()).product();
        [x[0] + 0.04 * bump, x[1] - 0.03 * bump, x[2] + 0.025 * bump]
    };
    for name in ["hex8", "hex8i", "wedge6"] {
        let cell = by_kernel(element(name));
        let errors = [3, 6]
            .map(|n| block(name == "wedge6", [1.0; 3], [n; 3], bent).error_inside(&cell, harmonic));
        // On meshes this coarse the wedge is still on its way to 2.
        let order = (errors[0] / errors[1]).log2();
        assert!((1.7..2.3).contains(&order), "{name}: order {order:.2}, errors {errors:?}");
    }
}

/// Tip deflection of a cantilever under a shear force, one cell over the height, against Timoshenko's beam.
fn deflection(name: &str) -> f64 {
    let (length, height, width) = (1.0, 0.1, 0.1);
    let (e, nu, force) = (property("E"), property("nu"), 1000.0);
    let beam = block(false, [length, height, width], [10, 1, 1], |x| x);
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
