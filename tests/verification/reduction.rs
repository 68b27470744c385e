//! Modes and Craig–Bampton reduction: against dense decompositions, closed forms and the full model.

use nalgebra::DMatrix;
use whirl_solver::body::{Coordinates, Rayleigh};
use whirl_solver::constraints::Constraints;
use whirl_solver::error::{FreeMotion, ReductionError};
use whirl_solver::linalg::{LowerTriangle, Matrix, congruence, symmetric_eigen};
use whirl_solver::reduction::{CraigBampton, Solid, hertz};
use whirl_solver::shaft::{Shaft, ShaftParts};
use whirl_solver::sparse::SparseMatrix;

use crate::block::{Block, lower, symmetric};

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
fn eigenvalues_of_high_multiplicity_are_found_whole() {
    // Cantilevers that know nothing of each other: with 12 of them bending has 24 modes a frequency,
    // three times as many as a block of the iteration has vectors.
    for (cells, count) in [([3, 3, 12], 4), ([1, 1, 8], 12)] {
        let one = Block::new(cells, [0.04, 0.04, 0.3], 0.3, [1.0, 1.0]);
        let (nodes, dofs) = (one.coordinates.len(), one.mass.size());
        let copies = |a: &SparseMatrix| {
            symmetric(count * dofs, |j| {
                let (copy, entries) = (j / dofs, lower(a).column(j % dofs).collect::<Vec<_>>());
                entries.into_iter().map(move |(i, value)| (copy * dofs + i, value))
            })
        };
        let coordinates: Vec<[f64; 3]> = (0..count * nodes)
            .map(|a| {
                let [x, y, z] = one.coordinates[a % nodes];
                [x + (a / nodes) as f64, y, z]
            })
            .collect();
        let all = Block { stiffness: copies(&one.stiffness), mass: copies(&one.mass), coordinates };
        let reduced = all.solid().craig_bampton(&all.end(), 30).unwrap();
        let single = oracle(&one.stiffness, &one.mass, &without(dofs, &one.end()));
        for (i, &got) in reduced.hertz.iter().enumerate() {
            close(got, hertz(single[i / count]), 1e-10);
        }
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

/// x, y or z of every node along a rigid motion, as values of the retained coordinates.
fn rigid_coordinates(
    reduced: &CraigBampton,
    positions: &[[f64; 3]],
    motion: impl Fn([f64; 3]) -> [f64; 3],
) -> Vec<f64> {
    let mut coordinates = vec![0.0; reduced.modes()];
    coordinates
        .extend(reduced.retained.iter().map(|row| motion(positions[row[0].0 / 3])[row[0].0 % 3]));
    coordinates
}

#[test]
fn a_shaft_turned_or_shifted_as_a_whole_has_the_inertia_of_a_rigid_body() {
    let mut beam = square_beam([1.0, 1.0]);
    for position in &mut beam.coordinates {
        position[0] -= 0.02;
        position[1] -= 0.03;
    }
    let scalar = LowerTriangle::from_columns(beam.coordinates.len(), |node| {
        let entries: Vec<_> = lower(&beam.mass).column(3 * node).collect();
        entries.into_iter().map(|(row, value)| (row / 3, value))
    });
    let pattern = |pattern| SparseMatrix::Kronecker { scalar: scalar.clone(), pattern };
    let spin_inertia = pattern([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.0]]);
    let spin_coupling = pattern([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]);
    let retained = [0, 1, 2, 9, 10, 11, 576, 577, 578];
    let reduction = beam.solid().craig_bampton(&retained, 5).unwrap();
    let names: Vec<String> = retained.iter().map(|dof| format!("dof {dof}")).collect();
    let active = Coordinates::new(&reduction, &Constraints::new().eliminate(9).unwrap(), &names);
    let damping = Rayleigh { alpha: 3.0, beta: 1e-4 };
    let shaft = Shaft::new(&ShaftParts {
        reduction: &reduction,
        mass: &pattern([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        spin_inertia: &spin_inertia,
        spin_coupling: &spin_coupling,
        spin_stiffening: None,
        positions: &beam.coordinates,
        active: &active,
        damping,
        nodes: &[7],
    });
    assert_eq!(shaft.size(), 14);
    assert_eq!(shaft.coordinates[5], "dof 0");
    assert!(shaft.coordinates[0].starts_with("mode 1 ("));

    // Square of side a, its centre at (5 mm, −5 mm): J0 = m (a²/6 + 5² + 5²).
    let (side, mass) = (0.05f64, 7860.0 * 0.05 * 0.05 * 0.4);
    let j0 = mass * (side * side / 6.0 + 0.005f64.powi(2) * 2.0);
    close(shaft.j0, j0, 1e-12);
    close(shaft.centre_of_mass.mass, mass, 1e-12);

    // {θ̇ = 1, η̇ = −image of the same turn} is motion without motion.
    let turn = rigid_coordinates(&reduction, &beam.coordinates, |[x, y, _]| [-y, x, 0.0]);
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    close(dot(&shaft.g0, &turn), j0, 1e-9);
    let momentum = shaft.mass.apply(&turn);
    for (g, p) in shaft.g0.iter().zip(&momentum) {
        assert!((g - p).abs() < 1e-9 * shaft.mass.norm_max() * side);
    }

    // Shifted by d: J = m (a²/6 + |centre + d|²).
    let d = [0.011, 0.004];
    let shift = rigid_coordinates(&reduction, &beam.coordinates, |_| [d[0], d[1], 0.7]);
    let moved =
        shaft.j0 + 2.0 * dot(&shaft.y0, &shift) + dot(&shift, &shaft.spin_inertia.apply(&shift));
    let away = (0.005 + d[0]).powi(2) + (-0.005 + d[1]).powi(2);
    close(moved, mass * (side * side / 6.0 + away), 1e-9);

    // Hη for a shift: −m d turned by a right angle, against another shift.
    let other = rigid_coordinates(&reduction, &beam.coordinates, |_| [0.3, -0.2, 0.0]);
    let coupling = dot(&other, &shaft.spin_coupling.apply(&shift));
    close(coupling, mass * (0.3 * d[1] + 0.2 * d[0]), 1e-9);

    let node = &shaft.nodes[0];
    assert_eq!(node.position, beam.coordinates[7]);
    let displacement = node.shapes.apply(&turn);
    let [x, y, _] = node.position;
    for (got, want) in displacement.iter().zip([-y, x, 0.0]) {
        assert!((got - want).abs() < 1e-9 * side);
    }
    close(shaft.damping[(0, 0)], 3.0 + 1e-4 * shaft.stiffness[(0, 0)], 1e-14);
    assert_eq!(shaft.tensor("H"), Some(&shaft.spin_coupling.data[..]));
    assert_eq!(shaft.tensor("J0"), Some(&[shaft.j0][..]));
    assert_eq!(shaft.tensor("Q"), None);
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
    assert!(node >= one.coordinates.len() as u64);
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
    assert!(message.contains("limit is 0.98 KiB"), "{message}");
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
