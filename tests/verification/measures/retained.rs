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
        let interface = Interface { corrections: &[], retained: &retained, held: &held };
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
    let interface = Interface { corrections: &[], retained: &retained, held: &[] };
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

/// The dof that weighs most in a retained row stands along z, and the body turns about z: without the rest of the row it is
/// loose.
#[test]
fn a_row_may_hold_the_body_by_what_weighs_less_in_it() {
    let mesh = beam([1, 2, 6], [0.03, 0.05, 0.4]);
    let matrices = Matrices::new(&mesh);
    let at = |place: [f64; 2], set: &str| {
        let nodes = mesh.node_set(set).unwrap().iter().copied();
        let far = |node: &usize| {
            let [x, y, _] = mesh.nodes()[*node];
            (x - place[0]).hypot(y - place[1])
        };
        nodes.min_by(|a, b| far(a).total_cmp(&far(b))).unwrap()
    };
    let (a, b, c) = (at([0.0; 2], "ROOT"), at([0.0; 2], "TIP"), at([0.03, 0.05], "TIP"));
    let mut retained: Vec<Row> =
        [3 * a, 3 * a + 1, 3 * a + 2, 3 * b, 3 * b + 1].map(|dof| vec![(dof, 1.0)]).into();
    retained.push(vec![(3 * c, 0.9), (3 * c + 2, 1.0)]);
    let interface = Interface { corrections: &[], retained: &retained, held: &[] };
    let all = frequencies(&matrices, &[], 1e8);
    let modes = mesh.dof_count() - 6;
    let reduced = matrices.solid(&mesh).reduce(&interface, modes).unwrap();
    retains(&reduced, &retained);
    let shifted = Matrix::from_fn(modes + 6, modes + 6, |i, j| {
        reduced.stiffness[(i, j)] + 1e8 * reduced.mass[(i, j)]
    });
    let eigen = generalised_symmetric_eigen(&shifted, &reduced.mass).unwrap();
    for (square, want) in eigen.values.iter().zip(&all).skip(6).take(10) {
        let found = hertz(square - 1e8);
        assert!((found / want - 1.0).abs() < 1e-9, "{found} Hz for {want}");
    }
}

/// A mean of very many dofs costs no more than they do: its pairs of rows stand beside the sparse factor.
#[test]
fn a_mean_of_all_nodes_is_reduced_as_that_of_a_few() {
    let mesh = beam([8, 8, 60], [0.04, 0.06, 0.4]);
    let matrices = Matrices::new(&mesh);
    let nodes: Vec<usize> = (0..mesh.nodes().len()).collect();
    let all = NodeSetMean::new(&mesh, &nodes).unwrap();
    let retained = rows(&[all]);
    assert!(retained[0].len() > 4000);
    let interface = Interface { corrections: &[], retained: &retained, held: &[] };
    let reduced = matrices.solid(&mesh).reduce(&interface, 6).unwrap();
    retains(&reduced, &retained);
    // Moving all of it costs nothing, and its modes are those of the free body but for what the mean weighs otherwise.
    let free = matrices.solid(&mesh).free_modes(12).unwrap().hertz();
    for (found, want) in reduced.hertz.iter().zip(&free[6..]) {
        assert!(found / want > 0.999 && found / want < 1.05, "{found} Hz for {want}");
    }
}

#[test]
fn a_rigid_motion_is_reproduced() {
    let mesh = beam([2, 2, 6], [0.03, 0.05, 0.4]);
    let matrices = Matrices::new(&mesh);
    let means = [mean(&mesh, "ROOT"), mean(&mesh, "TIP")];
    // Of the root all, of the tip the displacement alone.
    let retained = rows(&means)[..9].to_vec();
    let interface = Interface { corrections: &[], retained: &retained, held: &[] };
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
