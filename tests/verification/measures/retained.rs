//! Means as coordinates of a reduced body.

use whirl_solver::body::Retained;
use whirl_solver::linalg::{Matrix, generalised_symmetric_eigen};
use whirl_solver::mesh::{MeanComponent, Mesh, NodeSetMean};
use whirl_solver::reduction::{CraigBampton, Interface, Row, hertz};
use whirl_solver::shaft::Shaft;

use super::{Matrices, applied, beam, dofs, frequencies, largest, near, rigid, spec, statics};

fn mean(mesh: &Mesh, set: &str) -> NodeSetMean {
    NodeSetMean::new(mesh, mesh.node_set(set).unwrap()).unwrap()
}

fn rows(means: &[NodeSetMean]) -> Vec<Row> {
    means.iter().flat_map(|mean| MeanComponent::ALL.map(|motion| mean.row(motion))).collect()
}

/// Every retained motion is 1 in its own column and 0 in all others.
fn retains(reduced: &CraigBampton, rows: &[Row]) {
    for (i, row) in rows.iter().enumerate() {
        for j in 0..reduced.coordinates() {
            let found = applied(row, reduced.shapes.col(j));
            let want = f64::from(u8::from(j == reduced.modes() + i));
            let scale: f64 = row.iter().map(|&(dof, c)| (c * reduced.shapes[(dof, j)]).abs()).sum();
            assert!((found - want).abs() <= 1e-12 * (1.0 + scale), "{i} {j}: {found}");
        }
    }
}

/// A force and a couple on the mean of the tip's face bend, stretch and twist the clamped beam as they do the mesh. A
/// corner of the tip is retained on its own as well, and another one is held.
#[test]
fn statics_under_forces_on_a_mean_are_those_of_the_mesh() {
    let mesh = beam([2, 3, 8], [0.04, 0.06, 0.4]);
    let matrices = Matrices::new(&mesh);
    let tip = mesh.node_set("TIP").unwrap();
    let (first, last) = (tip[0], tip[tip.len() - 1]);
    let root = dofs(&mesh, "ROOT");
    let corner = [vec![(3 * first, 1.0)], vec![(3 * first + 1, 1.0)]];
    for (retained, more) in
        [(&[][..], None), (&corner[..], None), (&corner[..1], Some(3 * last + 1))]
    {
        let retained = [&rows(&[mean(&mesh, "TIP")]), retained].concat();
        let held: Vec<usize> = root.iter().copied().chain(more).collect();
        let interface = Interface { retained: &retained, held: &held };
        let reduced = matrices.solid(&mesh).reduce(&interface, 5).unwrap();
        assert_eq!(reduced.coordinates(), 5 + retained.len());
        retains(&reduced, &retained);
        assert!(
            held.iter()
                .all(|&dof| (0..reduced.coordinates()).all(|j| reduced.shapes[(dof, j)] == 0.0))
        );
        let loads = [300.0, -200.0, 5e3, 40.0, 25.0, -60.0, 70.0, 90.0];
        let mut force = vec![0.0; mesh.dof_count()];
        for (row, load) in retained.iter().zip(loads) {
            row.iter().for_each(|&(dof, c)| force[dof] += load * c);
        }
        let u = statics(&matrices, &held, &force);
        // The modes are coupled with nothing, and feel no force on the retained motions.
        let n = retained.len();
        let k = nalgebra::DMatrix::from_fn(n, n, |i, j| reduced.stiffness[(5 + i, 5 + j)]);
        let q = k.cholesky().unwrap().solve(&nalgebra::DVector::from_column_slice(&loads[..n]));
        let means: Vec<f64> = retained.iter().map(|row| applied(row, &u)).collect();
        near(&q.as_slice()[..3], &means[..3], 1e-9);
        near(&q.as_slice()[3..6], &means[3..6], 1e-9);
        let mut found = vec![0.0; u.len()];
        for (j, q) in q.iter().enumerate() {
            found.iter_mut().zip(reduced.shapes.col(5 + j)).for_each(|(sum, x)| *sum += q * x);
        }
        near(&found, &u, 1e-9);
    }
}

/// With all modes the reduced body is the mesh in other coordinates; with some of them its frequencies are higher, and the
/// lowest hardly so.
#[test]
fn modes_with_means_retained_are_those_of_the_free_mesh() {
    let mesh = beam([1, 2, 6], [0.03, 0.05, 0.4]);
    let matrices = Matrices::new(&mesh);
    let retained = rows(&[mean(&mesh, "ROOT"), mean(&mesh, "TIP")]);
    let interface = Interface { retained: &retained, held: &[] };
    let all = frequencies(&matrices, &[], 1e8);
    let elastic = all.iter().position(|&f| f > 100.0).unwrap();
    assert_eq!(elastic, 6);
    for modes in [20, mesh.dof_count() - 12] {
        let reduced = matrices.solid(&mesh).reduce(&interface, modes).unwrap();
        let shifted = Matrix::from_fn(modes + 12, modes + 12, |i, j| {
            reduced.stiffness[(i, j)] + 1e8 * reduced.mass[(i, j)]
        });
        let eigen = generalised_symmetric_eigen(&shifted, &reduced.mass).unwrap();
        for (i, (square, want)) in eigen.values.iter().zip(&all).enumerate().skip(6).take(10) {
            let (found, part) = (hertz(square - 1e8), if modes == 20 { 1e-3 } else { 1e-9 });
            assert!(found > want * (1.0 - 1e-9), "{i}: {found} Hz below {want}");
            assert!(found < want * (1.0 + part), "{i}: {found} Hz above {want}");
        }
    }
}

#[test]
fn a_rigid_motion_is_reproduced() {
    let mesh = beam([2, 2, 6], [0.03, 0.05, 0.4]);
    let matrices = Matrices::new(&mesh);
    let means = [mean(&mesh, "ROOT"), mean(&mesh, "TIP")];
    // Of the root all, of the tip the displacement alone.
    let retained = rows(&means)[..9].to_vec();
    let interface = Interface { retained: &retained, held: &[] };
    let reduced = matrices.solid(&mesh).reduce(&interface, 4).unwrap();
    retains(&reduced, &retained);
    let u = rigid(mesh.nodes(), [1.0, -2.0, 0.5], [3.0, 7.0, -11.0]);
    let q: Vec<f64> = retained.iter().map(|row| applied(row, &u)).collect();
    let mut found = vec![0.0; u.len()];
    for (j, q) in q.iter().enumerate() {
        found.iter_mut().zip(reduced.shapes.col(4 + j)).for_each(|(sum, x)| *sum += q * x);
    }
    near(&found, &u, 1e-9);
    // It costs nothing.
    let products: Vec<Vec<f64>> = (0..9)
        .map(|i| (0..9).map(|j| reduced.stiffness[(4 + i, 4 + j)] * q[i] * q[j]).collect())
        .collect();
    let scale = largest(products.iter().flatten());
    for (i, products) in products.iter().enumerate() {
        assert!(products.iter().sum::<f64>().abs() < 1e-9 * scale, "{i}: {products:?}");
    }
}

/// Means that are retained, and measures of the same sets, through the spec of a turning body.
#[test]
fn a_measure_of_a_retained_mean_is_its_coordinate() {
    let mesh = beam([2, 2, 6], [0.03, 0.05, 0.4]);
    let means = vec![mean(&mesh, "ROOT"), mean(&mesh, "TIP")];
    let retain = |mean: &NodeSetMean, end: &str| {
        MeanComponent::ALL.map(|motion| Retained::mean(mean, motion, format!("{end} {motion:?}")))
    };
    let mut own = spec(6);
    own.retained = [retain(&means[0], "ROOT"), retain(&means[1], "TIP")].concat();
    own.constraints.fix("turn", 5);
    own.means = means;
    let shaft = Shaft::from_mesh(&mesh, &own).unwrap();
    assert_eq!((shaft.size(), shaft.measures.len()), (17, 2));
    let coordinate = |name: &str| shaft.coordinates.iter().position(|known| known == name);
    for (measure, end) in shaft.measures.iter().zip(["ROOT", "TIP"]) {
        for (rows, what) in
            [(&measure.displacement, "Displacement"), (&measure.rotation, "Rotation")]
        {
            for axis in 0..3 {
                let own = coordinate(&format!("{end} {what}({axis})"));
                for j in 0..shaft.size() {
                    let want = f64::from(u8::from(own == Some(j)));
                    assert!((rows[(axis, j)] - want).abs() < 1e-9, "{end} {what} {axis} {j}");
                }
            }
        }
    }
    assert_eq!(shaft.measures[1].centre, own.means[1].centre());

    own.retained.push(Retained::mean(&own.means[1], MeanComponent::ALL[0], "AGAIN x"));
    let error = Shaft::from_mesh(&mesh, &own).unwrap_err().to_string();
    assert!(error.contains("AGAIN x follows from what else is retained or held"), "{error}");
}
