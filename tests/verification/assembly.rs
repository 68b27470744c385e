//! Assembled matrices against rigid motions, closed forms and an independent program.

use whirl_benches::hand::elements::ELEMENTS;
use whirl_solver::assembly::{assemble, mass_properties};
use whirl_solver::mesh::{Mesh, inp};
use whirl_solver::sparse::SparseMatrix;

use crate::bodies::reference;

/// The six rigid motions about the origin: shifts, then turns about x, y, z.
fn rigid(mesh: &Mesh) -> [Vec<f64>; 6] {
    let field = |u: &dyn Fn([f64; 3]) -> [f64; 3]| -> Vec<f64> {
        mesh.nodes().iter().flat_map(|&x| u(x)).collect()
    };
    [
        field(&|_| [1.0, 0.0, 0.0]),
        field(&|_| [0.0, 1.0, 0.0]),
        field(&|_| [0.0, 0.0, 1.0]),
        field(&|[_, y, z]| [0.0, -z, y]),
        field(&|[x, _, z]| [z, 0.0, -x]),
        field(&|[x, y, _]| [-y, x, 0.0]),
    ]
}

fn apply(a: &SparseMatrix, x: &[f64]) -> Vec<f64> {
    let mut y = vec![0.0; x.len()];
    a.multiply(x, &mut y);
    y
}

/// Largest absolute row sum over all rows: bounds |A x| for |x| ≤ 1.
fn norm(a: &SparseMatrix) -> f64 {
    let columns = a.to_columns();
    let sum = |j: usize| columns.column(j).map(|(_, value)| value.abs()).sum::<f64>();
    (0..a.size()).map(sum).fold(0.0, f64::max)
}

fn close(a: f64, b: f64, tolerance: f64) {
    assert!((a - b).abs() <= tolerance, "{a:e} against {b:e}, tolerance {tolerance:e}");
}

#[test]
fn rigid_motions_strain_nothing_and_carry_mass_and_inertia() {
    for name in ["shaft", "support"] {
        let mesh = reference(name);
        let motions = rigid(&mesh);
        let k = assemble(&mesh, "stiffness").unwrap();
        let m = assemble(&mesh, "mass").unwrap();
        let y = assemble(&mesh, "spin_inertia").unwrap();
        let h = assemble(&mesh, "spin_coupling").unwrap();
        assert!(matches!(k, SparseMatrix::Symmetric(_)));
        for scalar in [&m, &y, &h] {
            assert!(matches!(scalar, SparseMatrix::Kronecker { .. }));
        }
        let body = mass_properties(&mesh).unwrap();
        // Rounding: a row of K has about a hundred terms, each the sum of a hundred; the sums over a
        // whole body run over all pairs of nodes of all cells.
        let row = 1e4 * f64::EPSILON;
        let eps = 64.0 * mesh.cell_count() as f64 * f64::EPSILON;
        let scale = norm(&k);
        for motion in &motions {
            let reach = motion.iter().fold(0.0, |r: f64, u| r.max(u.abs()));
            for force in apply(&k, motion) {
                close(force, 0.0, row * scale * reach);
            }
        }
        let total = eps * body.mass;
        for motion in &motions[..3] {
            close(m.bilinear(motion, motion), body.mass, total);
        }
        let moments = [0, 1, 2].map(|i| body.second_moment[i][i]);
        for (i, motion) in motions[3..].iter().enumerate() {
            let inertia = moments[(i + 1) % 3] + moments[(i + 2) % 3];
            close(m.bilinear(motion, motion), inertia, eps * inertia);
        }
        // J0 = x0ᵀ Y x0, and Y sees lateral motion only.
        let x0: Vec<f64> = mesh.nodes().concat();
        let polar = moments[0] + moments[1];
        close(y.bilinear(&x0, &x0), polar, eps * polar);
        close(y.bilinear(&motions[5], &motions[5]), polar, eps * polar);
        close(y.bilinear(&motions[2], &motions[2]), 0.0, 0.0);
        close(y.bilinear(&motions[0], &motions[0]), body.mass, total);
        // H is skew, and uᵀ H v = ∫ρ (uₓ v_y − u_y vₓ) dV.
        close(h.bilinear(&motions[0], &motions[1]), body.mass, total);
        close(h.bilinear(&motions[1], &motions[0]), -body.mass, total);
        close(h.bilinear(&x0, &motions[5]), polar, eps * polar);
        let columns = h.to_columns();
        let mut negative = columns.transpose();
        negative.values.iter_mut().for_each(|value| *value = -*value);
        assert_eq!(columns, negative);
        assert!(h.lower().is_none());
    }
}

#[test]
fn bodies_have_the_mass_of_their_volume() {
    // The section is an octagon of circumradius a with area 2√2 a².
    let shaft = mass_properties(&reference("shaft")).unwrap();
    let corner: f64 = 0.0357914566453;
    let octagon = 2.0 * 2.0_f64.sqrt() * corner * corner;
    close(shaft.volume, octagon * 1.404, 1e-11 * shaft.volume);
    close(shaft.mass, 7860.0 * shaft.volume, 1e-11 * shaft.mass);
    close(shaft.centre[2], 0.702, 1e-11);
    close(shaft.centre[0], 0.0, 1e-13);
}

/// One cell of each element, distorted.
const DISTORTED: &str = "*NODE
1, 0.0, 0.1, 0.0
2, 1.1, 0.0, 0.1
3, 0.9, 1.2, -0.1
4, -0.1, 1.0, 0.0
5, 0.1, 0.0, 0.9
6, 1.0, 0.1, 1.2
7, 1.2, 0.9, 1.0
8, 0.0, 1.1, 1.1
*ELEMENT, TYPE=@, ELSET=ALL
1, #
*MATERIAL, NAME=M
*ELASTIC
70e9, 0.33
*DENSITY
2700
*SOLID SECTION, ELSET=ALL, MATERIAL=M
";

#[test]
fn inverted_cells_are_named_with_label_element_and_file() {
    let text = DISTORTED.replace('@', "C3D8I").replace('#', "5, 6, 7, 8, 1, 2, 3, 4");
    let mesh = inp::read(&text, "box.inp", &ELEMENTS).unwrap().mesh;
    let error = assemble(&mesh, "stiffness").unwrap_err().to_string();
    assert!(error.starts_with("box.inp: cell 1 (hex8i, smallest det J = -"), "{error}");
    assert!(error.contains("nodes listed in another order"), "{error}");
}
