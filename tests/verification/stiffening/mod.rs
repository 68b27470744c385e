//! Stiffening by rotation: the theorem of the virial, discs, a rotating cantilever, a rotor with point discs.

mod cantilever;
mod discs;
mod point_discs;

use nalgebra::{DMatrix, DVector};
use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::constraints::Constraints;
use whirl_solver::linalg::Matrix;
use whirl_solver::mesh::Material;
use whirl_solver::shaft::Shaft;
use whirl_specs::{ELEMENTS, Element};

fn elements() -> Vec<&'static Element> {
    ELEMENTS.iter().collect()
}

fn steel(density: f64) -> Material {
    Material::isotropic("STEEL", 2e11, 0.3, density).expect("steel")
}

/// A body that is stiffened, with these dofs retained, of which the first `held` are held.
fn spec(dofs: &[usize], held: usize, modes: usize, nodes: Vec<usize>) -> BodySpec {
    let mut constraints = Constraints::new();
    (0..held).for_each(|place| constraints.fix(format!("hold {place}"), place));
    BodySpec {
        corrections: Vec::new(),
        sections: Vec::new(),
        retained: dofs.iter().map(|&dof| Retained::dof(dof, format!("dof {dof}"))).collect(),
        held: Vec::new(),
        means: Vec::new(),
        modes,
        constraints,
        springs: Vec::new(),
        damping: Rayleigh::default(),
        nodes,
        stiffening: true,
        memory: 1 << 31,
    }
}

fn dense(matrix: &Matrix) -> DMatrix<f64> {
    DMatrix::from_column_slice(matrix.rows, matrix.cols, &matrix.data)
}

fn sparse(matrix: &DMatrix<f64>) -> Matrix {
    Matrix { rows: matrix.nrows(), cols: matrix.ncols(), data: matrix.as_slice().to_vec() }
}

/// Frequencies (rad/s, ascending, above zero) of M q̈ + B q̇ + A q = 0.
fn frequencies(m: &DMatrix<f64>, b: &DMatrix<f64>, a: &DMatrix<f64>) -> Vec<f64> {
    let n = m.nrows();
    let inverse = m.clone().cholesky().expect("a mass matrix").inverse();
    let mut state = DMatrix::zeros(2 * n, 2 * n);
    // Scaled by a speed, so that both halves are alike.
    let scale = 1e3;
    state.view_mut((0, n), (n, n)).fill_with_identity();
    state.view_mut((0, n), (n, n)).scale_mut(scale);
    state.view_mut((n, 0), (n, n)).copy_from(&(-(&inverse * a) / scale));
    state.view_mut((n, n), (n, n)).copy_from(&-(&inverse * b));
    let values = state.complex_eigenvalues();
    let mut found: Vec<f64> = values.iter().map(|value| value.im).filter(|w| *w > 1e-3).collect();
    found.sort_by(f64::total_cmp);
    found
}

/// Frequencies of a shaft without bearings in the frame that turns with it (rad/s).
fn turning(shaft: &Shaft, speed: f64) -> Vec<f64> {
    let [m, k, w, h] =
        [&shaft.mass, &shaft.stiffness, &shaft.spin_net, &shaft.spin_coupling].map(dense);
    frequencies(&m, &(h * (-2.0 * speed)), &(k - w * (speed * speed)))
}

/// Rows of the mean motion of nodes (places in the shaft's): x, y, z, and the turns about x, y and z.
fn mean_motion(shaft: &Shaft, places: &[usize]) -> [DVector<f64>; 6] {
    let mut rows = [0; 6].map(|_| DVector::zeros(shaft.size()));
    let mut squares = [0.0; 2];
    for &place in places {
        let node = &shaft.nodes[place];
        let shapes = dense(&node.shapes);
        let [x, y, _] = node.position;
        for (axis, row) in rows[..3].iter_mut().enumerate() {
            *row += shapes.row(axis).transpose() / places.len() as f64;
        }
        // w = α y − β x.
        rows[3] += shapes.row(2).transpose() * y;
        rows[4] -= shapes.row(2).transpose() * x;
        rows[5] += shapes.row(1).transpose() * x - shapes.row(0).transpose() * y;
        squares[0] += y * y;
        squares[1] += x * x;
    }
    rows[3] /= squares[0];
    rows[4] /= squares[1];
    rows[5] /= squares[0] + squares[1];
    rows
}
