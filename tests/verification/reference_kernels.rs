//! Elements written by hand against textbook integrals: BᵀDB with matrices, no structure used.

use nalgebra::{DMatrix, Matrix3, SMatrix, Vector3};
use proptest::prelude::*;
use whirl_benches::hand::elements::{HEX8, HEX8I, WEDGE6};
use whirl_specs::{Batch, CellMatrix, Element, Structure};

/// Value and reference gradient of every shape function at a point.
pub(crate) type Shapes = fn(Vector3<f64>) -> Vec<(f64, Vector3<f64>)>;

pub(crate) fn hexahedron(p: Vector3<f64>) -> Vec<(f64, Vector3<f64>)> {
    let shape = |node: &[f64; 3]| {
        let f = Vector3::from_fn(|i, _| 0.5 * (1.0 + node[i] * p[i]));
        let d = Vector3::from_fn(|i, _| 0.5 * node[i]);
        let gradient = Vector3::new(d[0] * f[1] * f[2], f[0] * d[1] * f[2], f[0] * f[1] * d[2]);
        (f[0] * f[1] * f[2], gradient)
    };
    HEX8.reference_nodes.iter().map(shape).collect()
}

pub(crate) fn wedge(p: Vector3<f64>) -> Vec<(f64, Vector3<f64>)> {
    let areas = [(1.0 - p[0] - p[1], [-1.0, -1.0]), (p[0], [1.0, 0.0]), (p[1], [0.0, 1.0])];
    let mut shapes = Vec::new();
    for end in [-1.0, 1.0] {
        for (l, d) in areas {
            let f = 0.5 * (1.0 + end * p[2]);
            shapes.push((l * f, Vector3::new(d[0] * f, d[1] * f, 0.5 * end * l)));
        }
    }
    shapes
}

fn gauss_2() -> [f64; 2] {
    [-1.0 / 3.0_f64.sqrt(), 1.0 / 3.0_f64.sqrt()]
}

/// Points with weights.
pub(crate) fn points(element: &Element) -> Vec<(Vector3<f64>, f64)> {
    let mut points = Vec::new();
    for z in gauss_2() {
        if element.nodes == 6 {
            let (a, b) = (1.0 / 6.0, 2.0 / 3.0);
            for (x, y) in [(a, a), (b, a), (a, b)] {
                points.push((Vector3::new(x, y, z), a));
            }
        } else {
            for (x, y) in gauss_2().into_iter().flat_map(|x| gauss_2().map(|y| (x, y))) {
                points.push((Vector3::new(x, y, z), 1.0));
            }
        }
    }
    points
}

/// ∂x/∂ξ: column k is the tangent along ξ_k.
pub(crate) fn jacobian(x: &[f64], shapes: &[(f64, Vector3<f64>)]) -> Matrix3<f64> {
    shapes.iter().zip(x.chunks_exact(3)).fold(Matrix3::zeros(), |sum, ((_, gradient), x)| {
        sum + Vector3::new(x[0], x[1], x[2]) * gradient.transpose()
    })
}

/// Six strains of the displacement gradient's three vectors u ⊗ g for u = e_x, e_y, e_z.
fn strain(g: Vector3<f64>) -> SMatrix<f64, 6, 3> {
    let [x, y, z] = [g[0], g[1], g[2]];
    SMatrix::<f64, 6, 3>::from_row_slice(&[
        x, 0.0, 0.0, 0.0, y, 0.0, 0.0, 0.0, z, y, x, 0.0, 0.0, z, y, z, 0.0, x,
    ])
}

pub(crate) fn stiffness(element: &Element, shapes: Shapes, modes: bool, x: &[f64]) -> DMatrix<f64> {
    let (e, nu) = (200e9, 0.3);
    let (lambda, mu) = (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)));
    let mut d = SMatrix::<f64, 6, 6>::zeros();
    for i in 0..3 {
        (0..3).for_each(|j| d[(i, j)] = lambda);
        d[(i, i)] += 2.0 * mu;
        d[(i + 3, i + 3)] = mu;
    }
    let n = 3 * element.nodes;
    let size = n + if modes { 9 } else { 0 };
    let mut k = DMatrix::<f64>::zeros(size, size);
    let centre = jacobian(x, &shapes(Vector3::zeros()));
    let centre_inverse = centre.try_inverse().unwrap().transpose();
    for (point, weight) in points(element) {
        let values = shapes(point);
        let j = jacobian(x, &values);
        let inverse = j.try_inverse().unwrap().transpose();
        let mut b = DMatrix::<f64>::zeros(6, size);
        for (a, (_, gradient)) in values.iter().enumerate() {
            b.view_mut((0, 3 * a), (6, 3)).copy_from(&strain(inverse * gradient));
        }
        for m in (0..3).filter(|_| modes) {
            let gradient = Vector3::ith(m, -2.0 * point[m]);
            let ratio = centre.determinant() / j.determinant();
            let strain = strain(centre_inverse * gradient * ratio);
            b.view_mut((0, n + 3 * m), (6, 3)).copy_from(&strain);
        }
        k += b.transpose() * d * &b * (weight * j.determinant());
    }
    if !modes {
        return k;
    }
    let inner = k.view((n, n), (9, 9)).into_owned().try_inverse().unwrap();
    let coupling = k.view((n, 0), (9, n)).into_owned();
    k.view((0, 0), (n, n)) - coupling.transpose() * inner * &coupling
}

pub(crate) fn mass(element: &Element, shapes: Shapes, x: &[f64]) -> DMatrix<f64> {
    let mut m = DMatrix::zeros(element.nodes, element.nodes);
    for (point, weight) in points(element) {
        let values = shapes(point);
        let volume = jacobian(x, &values).determinant() * weight;
        let n = DMatrix::from_iterator(element.nodes, 1, values.iter().map(|&(n, _)| n));
        m += &n * n.transpose() * (7860.0 * volume);
    }
    m
}

/// The kernel of one cell as a full matrix: all dofs, or the nodes of a Kronecker structure.
pub(crate) fn kernel(
    element: &Element,
    form: &str,
    material: &[f64],
    x: &[f64],
) -> (DMatrix<f64>, f64) {
    let kernel = element.form(form).unwrap();
    let size = match kernel.structure {
        Structure::Kronecker { .. } => element.nodes,
        _ => 3 * element.nodes,
    };
    // Two cells, so that the second is found where it should be.
    let stored = kernel.structure.len(element.nodes);
    let mut values = Batch::storage(2, stored);
    values.fill(Batch([f64::NAN; Batch::CELLS]));
    let mut jacobians = [f64::NAN; 2];
    let both = [x, x].concat();
    (kernel.evaluate)(&both, material, &mut values, &mut jacobians);
    let [first, second] =
        [0, 1].map(|cell| CellMatrix::new(&values, stored, cell).values().collect::<Vec<_>>());
    assert_eq!(first, second);
    let mut matrix = DMatrix::zeros(size, size);
    let mut packed = first.iter();
    for r in 0..size {
        for c in r..size {
            matrix[(r, c)] = *packed.next().unwrap();
            matrix[(c, r)] = matrix[(r, c)];
        }
    }
    (matrix, jacobians[0])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 32, ..ProptestConfig::default() })]

    /// Distorted cells: every corner of a 1 × 1.5 × 2 cm cell moves by up to 1 mm.
    #[test]
    fn hand_kernels_equal_textbook_integrals(
        shifts in prop::array::uniform24(-1e-3..1e-3_f64),
    ) {
        let elements: [(&Element, Shapes, bool); 3] =
            [(&HEX8, hexahedron, false), (&HEX8I, hexahedron, true), (&WEDGE6, wedge, false)];
        for (element, shapes, modes) in elements {
            let corners = element.reference_nodes.iter().flatten().zip([0.01, 0.015, 0.02].iter().cycle());
            let x: Vec<f64> =
                corners.zip(&shifts).map(|((corner, size), shift)| corner * size + shift).collect();
            let (k, smallest) = kernel(element, "stiffness", &[200e9, 0.3], &x);
            let textbook = stiffness(element, shapes, modes, &x);
            // A few hundred terms, and the condensation, at rounding level.
            let tolerance = 1e-12 * textbook.amax();
            prop_assert!((&k - &textbook).amax() < tolerance, "{}", element.origin.name);
            let determinants =
                points(element).into_iter().map(|(p, _)| jacobian(&x, &shapes(p)).determinant());
            let expected = determinants.fold(f64::INFINITY, f64::min);
            prop_assert!((smallest / expected - 1.0).abs() < 1e-12);

            let textbook = mass(element, shapes, &x);
            for form in ["mass", "spin_inertia", "spin_coupling"] {
                let (m, smallest) = kernel(element, form, &[7860.0], &x);
                prop_assert!((&m - &textbook).amax() < 1e-13 * textbook.amax());
                prop_assert!((smallest / expected - 1.0).abs() < 1e-12);
            }
        }
    }
}
