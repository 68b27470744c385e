//! Measures of bodies: mean motions of node sets, as outputs and as retained coordinates, and held sets.

mod bands;
mod bores;
mod dimensions;
mod held;
mod means;
mod retained;
mod surfaces;

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};
use whirl_solver::assembly::assemble;
use whirl_solver::body::{BodySpec, Rayleigh};
use whirl_solver::constraints::Constraints;
use whirl_solver::mesh::{Block, Material, Mesh, MeshParts};
use whirl_solver::reduction::Solid;
use whirl_solver::sparse::SparseMatrix;
use whirl_specs::{ELEMENTS, Element};

const PLENTY: usize = 1 << 32;

fn element(name: &str) -> &'static Element {
    ELEMENTS.iter().find(|element| element.origin.name == name).expect("a shipped element")
}

/// One block of cells of steel, with node sets.
fn mesh(
    name: &str,
    nodes: Vec<[f64; 3]>,
    connectivity: Vec<usize>,
    sets: BTreeMap<String, Vec<usize>>,
) -> Mesh {
    let element = element(name);
    let cells = connectivity.len() / element.nodes;
    let block = Block { element, material: 0, labels: (1..=cells as u64).collect(), connectivity };
    Mesh::new(MeshParts {
        origin: "test".to_owned(),
        labels: (1..=nodes.len() as u64).collect(),
        nodes,
        blocks: vec![block],
        materials: vec![Material::isotropic("STEEL", 2e11, 0.3, 7860.0).expect("steel")],
        node_sets: sets,
        element_sets: BTreeMap::new(),
        ties: Vec::new(),
        matrices: None,
    })
    .expect("a mesh")
}

/// A beam of hex8i along z from 0, about the axis, with its faces ROOT and TIP.
fn beam(cells: [usize; 3], sides: [f64; 3]) -> Mesh {
    let [nx, ny, nz] = cells.map(|count| count + 1);
    let number = |x: usize, y: usize, z: usize| (z * ny + y) * nx + x;
    let mut nodes = Vec::new();
    for z in 0..nz {
        for y in 0..ny {
            for x in 0..nx {
                let at =
                    |place: usize, axis: usize| sides[axis] * place as f64 / cells[axis] as f64;
                nodes.push([at(x, 0) - 0.5 * sides[0], at(y, 1) - 0.5 * sides[1], at(z, 2)]);
            }
        }
    }
    let mut connectivity = Vec::new();
    for z in 0..cells[2] {
        for y in 0..cells[1] {
            for x in 0..cells[0] {
                for up in [z, z + 1] {
                    let ring = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)];
                    connectivity.extend(ring.map(|(x, y)| number(x, y, up)));
                }
            }
        }
    }
    let layer = nx * ny;
    let sets = BTreeMap::from([
        ("ROOT".to_owned(), (0..layer).collect()),
        ("TIP".to_owned(), (layer * (nz - 1)..layer * nz).collect()),
    ]);
    mesh("hex8i", nodes, connectivity, sets)
}

/// All dofs of a set.
fn dofs(mesh: &Mesh, set: &str) -> Vec<usize> {
    let nodes = mesh.node_set(set).expect("a set of the mesh");
    nodes.iter().flat_map(|node| [3 * node, 3 * node + 1, 3 * node + 2]).collect()
}

/// K and M of a mesh.
struct Matrices {
    stiffness: SparseMatrix,
    mass: SparseMatrix,
}

impl Matrices {
    fn new(mesh: &Mesh) -> Matrices {
        let [stiffness, mass] = ["stiffness", "mass"].map(|form| assemble(mesh, form).unwrap());
        Matrices { stiffness, mass }
    }

    fn solid<'a>(&'a self, mesh: &'a Mesh) -> Solid<'a> {
        Solid {
            stiffness: &self.stiffness,
            mass: &self.mass,
            coordinates: mesh.nodes(),
            slots: &[],
            ties: &[],
            memory: PLENTY,
        }
    }
}

fn dense(matrix: &SparseMatrix, dofs: &[usize]) -> DMatrix<f64> {
    let columns = matrix.to_columns();
    let mut full = DMatrix::zeros(matrix.size(), matrix.size());
    for j in 0..matrix.size() {
        columns.column(j).for_each(|(i, value)| full[(i, j)] = value);
    }
    DMatrix::from_fn(dofs.len(), dofs.len(), |i, j| full[(dofs[i], dofs[j])])
}

fn without(size: usize, held: &[usize]) -> Vec<usize> {
    (0..size).filter(|dof| !held.contains(dof)).collect()
}

/// u of K u = f with some dofs held, by a dense Cholesky factor.
fn statics(matrices: &Matrices, held: &[usize], force: &[f64]) -> Vec<f64> {
    let free = without(force.len(), held);
    let factor = dense(&matrices.stiffness, &free).cholesky().expect("K is positive definite");
    let solved = factor.solve(&DVector::from_fn(free.len(), |i, _| force[free[i]]));
    let mut u = vec![0.0; force.len()];
    free.iter().zip(solved.iter()).for_each(|(&dof, &value)| u[dof] = value);
    u
}

/// Frequencies (Hz) of the mesh with some dofs held, ascending; without any held K is shifted by M times `shift`.
fn frequencies(matrices: &Matrices, held: &[usize], shift: f64) -> Vec<f64> {
    let free = without(matrices.mass.size(), held);
    let mass = dense(&matrices.mass, &free);
    let shifted = dense(&matrices.stiffness, &free) + shift * &mass;
    let factor = shifted.cholesky().expect("K is positive definite").l();
    let mut c = mass;
    factor.solve_lower_triangular_mut(&mut c);
    c = c.transpose();
    factor.solve_lower_triangular_mut(&mut c);
    let inverse = ((&c + c.transpose()) * 0.5).symmetric_eigen().eigenvalues;
    let hertz = |t: &f64| (1.0 / t - shift).max(0.0).sqrt() / std::f64::consts::TAU;
    let mut all: Vec<f64> = inverse.iter().map(hertz).collect();
    all.sort_by(f64::total_cmp);
    all
}

/// u = d + ω × x at all nodes.
fn rigid(nodes: &[[f64; 3]], shift: [f64; 3], turn: [f64; 3]) -> Vec<f64> {
    let [a, b, c] = turn;
    let at = |[x, y, z]: &[f64; 3]| {
        [shift[0] + b * z - c * y, shift[1] + c * x - a * z, shift[2] + a * y - b * x]
    };
    nodes.iter().flat_map(at).collect()
}

fn applied(row: &[(usize, f64)], u: &[f64]) -> f64 {
    row.iter().map(|&(dof, c)| c * u[dof]).sum()
}

fn largest<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
    values.into_iter().fold(0.0, |most: f64, value| most.max(value.abs()))
}

fn near(got: &[f64], want: &[f64], part: f64) {
    assert_eq!(got.len(), want.len());
    let scale = largest(want);
    for (i, (got, want)) in got.iter().zip(want).enumerate() {
        assert!((got - want).abs() <= part * scale, "{i}: {got} instead of {want}, of {scale}");
    }
}

fn spec(modes: usize) -> BodySpec {
    BodySpec {
        corrections: Vec::new(),
        sections: Vec::new(),
        retained: Vec::new(),
        held: Vec::new(),
        modes,
        constraints: Constraints::new(),
        springs: Vec::new(),
        damping: Rayleigh::default(),
        nodes: Vec::new(),
        stiffening: false,
        means: Vec::new(),
        memory: PLENTY,
    }
}
