//! Modes and Craig–Bampton reduction: against dense decompositions, closed forms and the full model.

use nalgebra::DMatrix;
use whirl_solver::linalg::{LowerTriangle, Matrix, congruence, symmetric_eigen};
use whirl_solver::reduction::{CraigBampton, FreeMotion, ReductionError, Solid, hertz};
use whirl_solver::sparse::SparseMatrix;

const PLENTY: usize = 1 << 32;

/// A block of 8-node hexahedra, sides along x, y, z.
struct Block {
    coordinates: Vec<[f64; 3]>,
    stiffness: SparseMatrix,
    mass: SparseMatrix,
}

impl Block {
    /// `cells` cells along each axis over a block with sides `sides` (m) of steel, with K and M times
    /// `scale` and Poisson's ratio `nu`.
    fn new(cells: [usize; 3], sides: [f64; 3], nu: f64, scale: [f64; 2]) -> Self {
        let step: [f64; 3] = std::array::from_fn(|i| sides[i] / cells[i] as f64);
        let (k, m) = hexahedron(step, 2e11, nu, 7860.0);
        let across = [cells[0] + 1, cells[1] + 1, cells[2] + 1];
        let node = |i: usize, j: usize, k: usize| (k * across[1] + j) * across[0] + i;
        let mut coordinates = Vec::new();
        for z in 0..across[2] {
            for y in 0..across[1] {
                for x in 0..across[0] {
                    let place = [x, y, z];
                    coordinates.push(std::array::from_fn(|i| place[i] as f64 * step[i]));
                }
            }
        }
        let mut columns = vec![std::collections::BTreeMap::new(); 3 * coordinates.len()];
        for z in 0..cells[2] {
            for y in 0..cells[1] {
                for x in 0..cells[0] {
                    let corners: Vec<usize> =
                        CORNERS.iter().map(|c| node(x + c[0], y + c[1], z + c[2])).collect();
                    for a in 0..24 {
                        for b in 0..24 {
                            let (row, column) =
                                (3 * corners[a / 3] + a % 3, 3 * corners[b / 3] + b % 3);
                            let entry = columns[column].entry(row).or_insert([0.0; 2]);
                            entry[0] += scale[0] * k[a][b];
                            entry[1] += scale[1] * m[a][b];
                        }
                    }
                }
            }
        }
        let matrix = |which: usize| {
            symmetric(columns.len(), |j| {
                columns[j].iter().map(move |(&row, entry): (&usize, &[f64; 2])| (row, entry[which]))
            })
        };
        Block { stiffness: matrix(0), mass: matrix(1), coordinates }
    }

    fn solid(&self) -> Solid<'_> {
        Solid {
            stiffness: &self.stiffness,
            mass: &self.mass,
            coordinates: &self.coordinates,
            memory: PLENTY,
        }
    }

    /// Dofs of the nodes at the end z = 0.
    fn end(&self) -> Vec<usize> {
        let nodes = (0..self.coordinates.len()).filter(|&a| self.coordinates[a][2] == 0.0);
        nodes.flat_map(|a| [3 * a, 3 * a + 1, 3 * a + 2]).collect()
    }
}

const CORNERS: [[usize; 3]; 8] =
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];

/// K and M of a box with 2 × 2 × 2 Gauss points.
fn hexahedron(side: [f64; 3], e: f64, nu: f64, rho: f64) -> ([[f64; 24]; 24], [[f64; 24]; 24]) {
    let sign = |a: usize, i: usize| 2.0 * CORNERS[a][i] as f64 - 1.0;
    let (lambda, mu) = (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)));
    let det = side.iter().product::<f64>() / 8.0;
    let (mut k, mut m) = ([[0.0; 24]; 24], [[0.0; 24]; 24]);
    for q in 0..8 {
        let factor = |a: usize, i: usize| 1.0 + sign(a, i) * sign(q, i) / 3f64.sqrt();
        let shape = |a: usize| factor(a, 0) * factor(a, 1) * factor(a, 2) / 8.0;
        let slope = |a: usize, i: usize| {
            sign(a, i) * factor(a, (i + 1) % 3) * factor(a, (i + 2) % 3) / (4.0 * side[i])
        };
        for a in 0..8 {
            for b in 0..8 {
                let dot: f64 = (0..3).map(|i| slope(a, i) * slope(b, i)).sum();
                for i in 0..3 {
                    for j in 0..3 {
                        let mut value =
                            lambda * slope(a, i) * slope(b, j) + mu * slope(a, j) * slope(b, i);
                        if i == j {
                            value += mu * dot;
                            m[3 * a + i][3 * b + j] += rho * shape(a) * shape(b) * det;
                        }
                        k[3 * a + i][3 * b + j] += value * det;
                    }
                }
            }
        }
    }
    (k, m)
}

fn symmetric<'a, C>(size: usize, column: impl Fn(usize) -> C) -> SparseMatrix
where
    C: Iterator<Item = (usize, f64)> + 'a,
{
    SparseMatrix::Symmetric(LowerTriangle::from_columns(size, column))
}

fn lower(a: &SparseMatrix) -> &LowerTriangle {
    let SparseMatrix::Symmetric(lower) = a else { panic!("blocks have symmetric matrices") };
    lower
}

fn dense(a: &SparseMatrix, dofs: &[usize]) -> DMatrix<f64> {
    let a = lower(a);
    let mut full = DMatrix::zeros(a.size, a.size);
    for j in 0..a.size {
        for (i, value) in a.column(j) {
            full[(i, j)] = value;
            full[(j, i)] = value;
        }
    }
    DMatrix::from_fn(dofs.len(), dofs.len(), |i, j| full[(dofs[i], dofs[j])])
}

/// ω² of K x = ω² M x over `dofs` by nalgebra, ascending, from the inverse so that the lowest are exact.
fn oracle(stiffness: &SparseMatrix, mass: &SparseMatrix, dofs: &[usize]) -> Vec<f64> {
    let factor = dense(stiffness, dofs).cholesky().expect("K is positive definite").l();
    let mut c = dense(mass, dofs);
    factor.solve_lower_triangular_mut(&mut c);
    c = c.transpose();
    factor.solve_lower_triangular_mut(&mut c);
    let c = (&c + c.transpose()) * 0.5;
    let mut values: Vec<f64> = c.symmetric_eigen().eigenvalues.iter().map(|t| 1.0 / t).collect();
    values.sort_by(f64::total_cmp);
    values
}

fn without(size: usize, held: &[usize]) -> Vec<usize> {
    (0..size).filter(|dof| !held.contains(dof)).collect()
}

fn close(got: f64, want: f64, relative: f64) {
    assert!((got - want).abs() <= relative * want.abs(), "{got} instead of {want}");
}

#[test]
fn dense_eigenvalues_agree_with_nalgebra_at_every_scale() {
    let n = 160;
    let mut state = 1u64;
    let mut random = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    };
    let raw = Matrix::from_fn(n, n, |_, _| random());
    for scale in [1e-12, 1.0, 1e12] {
        let a = Matrix::from_fn(n, n, |i, j| scale * (raw[(i, j)] + raw[(j, i)]));
        let got = symmetric_eigen(&a).unwrap();
        let mut want: Vec<f64> = DMatrix::from_column_slice(n, n, &a.data)
            .symmetric_eigen()
            .eigenvalues
            .iter()
            .copied()
            .collect();
        want.sort_by(f64::total_cmp);
        let norm = want[n - 1].abs().max(want[0].abs());
        for (got, want) in got.values.iter().zip(&want) {
            assert!((got - want).abs() <= n as f64 * f64::EPSILON * norm);
        }
    }
}

/// 576 inner dofs: above the size for which everything is decomposed densely.
fn square_beam(scale: [f64; 2]) -> Block {
    Block::new([3, 3, 12], [0.05, 0.05, 0.4], 0.3, scale)
}

#[test]
fn lanczos_finds_what_a_dense_decomposition_finds_pairs_included() {
    // A beam of square section: every bending mode is double.
    for scale in [[1.0, 1.0], [1e12, 1e-12], [1e-12, 1e12]] {
        let beam = square_beam(scale);
        let held = beam.end();
        let reduced = beam.solid().craig_bampton(&held, 24).unwrap();
        let dofs = without(3 * beam.coordinates.len(), &held);
        let want = oracle(&beam.stiffness, &beam.mass, &dofs);
        let double = |i: usize| (want[i + 1] - want[i]).abs() < 1e-8 * want[i];
        assert!(double(0) && (0..23).filter(|&i| double(i)).count() >= 6);
        for (i, &got) in reduced.hertz.iter().enumerate() {
            close(got, hertz(want[i]), 1e-10);
        }
    }
}

#[test]
fn modes_are_orthonormal_and_settled() {
    let beam = square_beam([1.0, 1.0]);
    let held = beam.end();
    let reduced = beam.solid().craig_bampton(&held, 24).unwrap();
    let mass = reduced.reduce(&beam.mass);
    let stiffness = reduced.reduce(&beam.stiffness);
    let highest = reduced.stiffness[(23, 23)];
    for i in 0..24 {
        for j in 0..24 {
            let one = if i == j { 1.0 } else { 0.0 };
            assert!((mass[(i, j)] - one).abs() < 1e-12);
            assert!((stiffness[(i, j)] - reduced.stiffness[(i, j)]).abs() < 1e-9 * highest);
        }
        for j in 24..reduced.coordinates() {
            // Modes and constraint modes are coupled by inertia alone.
            let scale = (highest * reduced.stiffness[(j, j)]).sqrt();
            assert!(stiffness[(i, j)].abs() < 1e-9 * scale);
        }
    }
    // The first pair bends along x, then along y.
    let motion = |mode: usize, component: usize| -> f64 {
        let shape = reduced.shapes.col(mode);
        shape.iter().skip(component).step_by(3).map(|u| u * u).sum()
    };
    assert!(motion(0, 1) < 1e-3 * motion(0, 0), "{} {}", motion(0, 1), motion(0, 0));
    close(motion(1, 1), motion(0, 0), 1e-6);
    close(motion(1, 0), motion(0, 1), 1e-6);
    for mode in 0..24 {
        let shape = reduced.shapes.col(mode);
        let largest = shape.iter().fold(0.0, |max: f64, u| max.max(u.abs()));
        let first = shape.iter().find(|u| u.abs() > (1.0 - 1e-5) * largest).unwrap();
        assert!(*first > 0.0);
    }
}

#[test]
fn the_same_body_gives_the_same_bits() {
    let beam = square_beam([1.0, 1.0]);
    let reduce = || beam.solid().craig_bampton(&beam.end(), 12).unwrap();
    assert_eq!(reduce(), reduce());
}

#[test]
fn a_quadruple_eigenvalue_is_found_whole() {
    // Four cantilevers that know nothing of each other: every eigenvalue is fourfold or eightfold.
    let one = Block::new([3, 3, 12], [0.04, 0.04, 0.3], 0.3, [1.0, 1.0]);
    let (nodes, dofs) = (one.coordinates.len(), one.mass.size());
    let copies = |a: &SparseMatrix| {
        symmetric(4 * dofs, |j| {
            let (copy, entries) = (j / dofs, lower(a).column(j % dofs).collect::<Vec<_>>());
            entries.into_iter().map(move |(i, value)| (copy * dofs + i, value))
        })
    };
    let coordinates: Vec<[f64; 3]> = (0..4 * nodes)
        .map(|a| {
            let [x, y, z] = one.coordinates[a % nodes];
            [x + (a / nodes) as f64, y, z]
        })
        .collect();
    let four = Block { stiffness: copies(&one.stiffness), mass: copies(&one.mass), coordinates };
    let reduced = four.solid().craig_bampton(&four.end(), 30).unwrap();
    let held = one.end();
    let single = oracle(&one.stiffness, &one.mass, &without(dofs, &held));
    for (i, &got) in reduced.hertz.iter().enumerate() {
        close(got, hertz(single[i / 4]), 1e-10);
    }
}

#[test]
fn constraint_modes_carry_rigid_motions() {
    let beam = square_beam([1.0, 1.0]);
    // Dofs of three nodes that do not lie on one line.
    let retained = [0, 1, 2, 9, 10, 11, 576, 577, 578];
    let reduced = beam.solid().craig_bampton(&retained, 5).unwrap();
    let motions: [fn([f64; 3]) -> [f64; 3]; 6] = [
        |_| [1.0, 0.0, 0.0],
        |_| [0.0, 1.0, 0.0],
        |_| [0.0, 0.0, 1.0],
        |[_, y, z]| [0.0, -z, y],
        |[x, _, z]| [z, 0.0, -x],
        |[x, y, _]| [-y, x, 0.0],
    ];
    for motion in motions {
        let displacement = |dof: usize| motion(beam.coordinates[dof / 3])[dof % 3];
        let mut coordinates = vec![0.0; 5];
        coordinates.extend(retained.iter().map(|&dof| displacement(dof)));
        let moved = reduced.shapes.apply(&coordinates);
        for (dof, &got) in moved.iter().enumerate() {
            assert!((got - displacement(dof)).abs() < 1e-9, "{dof}: {got}");
        }
        let force = reduced.stiffness.apply(&coordinates);
        assert!(force.iter().all(|f| f.abs() < 1e-9 * reduced.stiffness.norm_max()));
    }
}

/// The lowest elastic frequencies of the reduced body with its retained dofs free.
fn free_hertz(reduced: &CraigBampton, count: usize) -> Vec<f64> {
    let n = reduced.coordinates();
    // K + M is definite and has the same vectors.
    let shift = reduced.stiffness[(0, 0)];
    let definite =
        Matrix::from_fn(n, n, |i, j| reduced.stiffness[(i, j)] + shift * reduced.mass[(i, j)]);
    let eigen =
        whirl_solver::linalg::generalised_symmetric_eigen(&reduced.mass, &definite).unwrap();
    (0..count).map(|i| hertz(1.0 / eigen.values[n - 7 - i] - shift)).collect()
}

#[test]
fn the_reduced_body_converges_to_the_full_one_from_above() {
    let beam = square_beam([1.0, 1.0]);
    let full = beam.solid().free_modes(12).unwrap().hertz();
    assert!(full[5] < 1e-3 * full[6], "six rigid motions: {full:?}");
    let retained = [0, 1, 2, 9, 10, 11, 300, 301, 576, 577, 578];
    let mut before = f64::INFINITY;
    for modes in [4, 12, 36, 108] {
        let reduced = beam.solid().craig_bampton(&retained, modes).unwrap();
        let found = free_hertz(&reduced, 6);
        let error = (0..6).map(|i| found[i] / full[6 + i] - 1.0).fold(0.0, f64::max);
        // Rayleigh–Ritz on nested spaces: never below the full model, never worse with more modes.
        assert!((0..6).all(|i| found[i] > full[6 + i] * (1.0 - 1e-9)));
        assert!(error < before, "{modes} modes: {error}, before {before}");
        before = error;
    }
    assert!(before < 1e-3, "{before}");
}

#[test]
fn an_axial_bar_has_its_exact_frequency() {
    // With ν = 0 the axial modes of a clamped bar are those of a chain of n linear bar elements with
    // consistent mass: ω² = (6E/ρh²)(1 − cos kh)/(2 + cos kh), kh = π/2n for the first.
    let n = 16;
    let bar = Block::new([2, 2, n], [0.01, 0.01, 1.0], 0.0, [1.0, 1.0]);
    let reduced = bar.solid().craig_bampton(&bar.end(), 20).unwrap();
    let (h, phase) = (1.0 / n as f64, std::f64::consts::FRAC_PI_2 / n as f64);
    let square = 6.0 * 2e11 / (7860.0 * h * h) * (1.0 - phase.cos()) / (2.0 + phase.cos());
    let nearest = reduced.hertz.iter().map(|f| (f / hertz(square) - 1.0).abs()).fold(1.0, f64::min);
    assert!(nearest < 1e-9, "{nearest}: {:?}", reduced.hertz);
}

#[test]
fn mechanisms_are_named() {
    let beam = square_beam([1.0, 1.0]);
    // Two nodes on the line x = y = 0: the beam can turn about it.
    let last = 12 * 16;
    let retained = [0, 1, 2, 3 * last, 3 * last + 1, 3 * last + 2];
    let Err(ReductionError::Mechanism { motions }) = beam.solid().craig_bampton(&retained, 5)
    else {
        panic!("a mechanism is an error");
    };
    assert_eq!(motions.len(), 1);
    let FreeMotion::Rotation { direction, through } = &motions[0] else {
        panic!("{motions:?}");
    };
    assert!((direction[2] - 1.0).abs() < 1e-9);
    assert!(through[0].abs() < 1e-9 && through[1].abs() < 1e-9);

    // Two blocks side by side that share no node.
    let one = Block::new([1, 1, 4], [0.1, 0.1, 0.4], 0.3, [1.0, 1.0]);
    let dofs = one.mass.size();
    let double = |a: &SparseMatrix| {
        symmetric(2 * dofs, |j| {
            let entries: Vec<_> = lower(a).column(j % dofs).collect();
            entries.into_iter().map(move |(i, value)| (i + (j / dofs) * dofs, value))
        })
    };
    let mut coordinates = one.coordinates.clone();
    coordinates.extend(one.coordinates.iter().map(|[x, y, z]| [x + 0.1, *y, *z]));
    let two = Block { stiffness: double(&one.stiffness), mass: double(&one.mass), coordinates };
    let error = two.solid().craig_bampton(&one.end(), 5).unwrap_err();
    let ReductionError::Mechanism { motions } = &error else { panic!("{error}") };
    let [FreeMotion::Part { node }] = motions[..] else { panic!("{error}") };
    assert!(node >= one.coordinates.len());
}

#[test]
fn what_cannot_be_asked_is_an_error() {
    let block = Block::new([1, 1, 2], [0.1, 0.1, 0.2], 0.3, [1.0, 1.0]);
    let held = block.end();
    let solid = block.solid();
    assert!(matches!(
        solid.craig_bampton(&held, 25),
        Err(ReductionError::TooManyModes { asked: 25, available: 24 })
    ));
    assert_eq!(solid.craig_bampton(&held, 24).unwrap().modes(), 24);
    for bad in [[0, 1, 1], [0, 1, 36]] {
        assert!(matches!(
            solid.craig_bampton(&bad, 2),
            Err(ReductionError::Retained { dof, .. }) if dof == bad[2]
        ));
    }
    let poor = Solid { memory: 1000, ..solid };
    let message = poor.craig_bampton(&held, 2).unwrap_err().to_string();
    assert!(message.contains("limit is 1000"), "{message}");
}

#[test]
fn further_matrices_reduce_by_congruence() {
    let block = Block::new([1, 1, 2], [0.1, 0.1, 0.2], 0.3, [1.0, 1.0]);
    let reduced = block.solid().craig_bampton(&block.end(), 4).unwrap();
    let all: Vec<usize> = (0..block.mass.size()).collect();
    let whole = dense(&block.mass, &all);
    let whole = Matrix { rows: all.len(), cols: all.len(), data: whole.as_slice().to_vec() };
    let want = congruence(&whole, &reduced.shapes);
    let got = reduced.reduce(&block.mass);
    for (got, want) in got.data.iter().zip(&want.data) {
        assert!((got - want).abs() < 1e-12 * want.abs().max(1.0));
    }
}
