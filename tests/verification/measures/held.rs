//! Held sets: no coordinates, no constraint modes, and the same body.

use std::f64::consts::TAU;

use whirl_solver::body::Retained;
use whirl_solver::cache::{pack, unpack};
use whirl_solver::error::{Error, ReductionError};
use whirl_solver::mesh::NodeSetMean;
use whirl_solver::reduced::{BodyKind, Reduced};
use whirl_solver::reduction::Interface;
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::{Matrices, beam, dofs, frequencies, near, spec};

#[test]
fn a_cantilever_held_at_its_root_has_the_frequencies_of_the_mesh() {
    let (side, length) = (0.02, 0.6);
    let mesh = beam([2, 2, 20], [side, side, length]);
    let matrices = Matrices::new(&mesh);
    let held = dofs(&mesh, "ROOT");
    let interface = Interface { corrections: &[], retained: &[], held: &held };
    let reduced = matrices.solid(&mesh).reduce(&interface, 9).unwrap();
    assert_eq!((reduced.shapes.cols, reduced.coordinates()), (9, 9));
    let all = frequencies(&matrices, &held, 0.0);
    near(&reduced.hertz, &all[..9], 1e-9);
    // Euler and Bernoulli, who leave out 0.1 % for shear, and know nothing of the root's stiffening by ν.
    let bending = 1.875_104_f64.powi(2) / TAU * (2e11 * side * side / (12.0 * 7860.0)).sqrt();
    let hertz = bending / (length * length);
    assert!((reduced.hertz[0] / hertz - 1.0).abs() < 0.01, "{} {hertz}", reduced.hertz[0]);
}

/// On a turning body, and on one that stands.
#[test]
fn held_dofs_are_those_retained_and_fixed() {
    let mesh = beam([2, 2, 8], [0.03, 0.05, 0.4]);
    let root = dofs(&mesh, "ROOT");
    let tip = mesh.node_set("TIP").unwrap().to_vec();
    let mut own = spec(8);
    own.stiffening = true;
    own.retained = vec![Retained::dof(3 * tip[0], "tip x"), Retained::dof(3 * tip[4] + 1, "tip y")];
    own.nodes = vec![0, tip[0], tip[4]];
    own.means = vec![NodeSetMean::new(&mesh, &tip).unwrap()];
    let mut fixed = own.clone();
    own.held = root.clone();
    for (place, &dof) in root.iter().enumerate() {
        fixed.retained.push(Retained::dof(dof, format!("root {dof}")));
        fixed.constraints.fix(format!("root {dof}"), 2 + place);
    }
    let [held, fixed_shaft] = [&own, &fixed].map(|spec| Shaft::from_mesh(&mesh, spec).unwrap());
    assert_eq!((held.size(), &held.coordinates), (10, &fixed_shaft.coordinates));
    assert_eq!(held.j0, fixed_shaft.j0);
    near(&held.spin_stiffening().data, &fixed_shaft.spin_stiffening().data, 1e-9);
    for (name, tensor) in
        ["y0", "g0", "M", "Y", "W", "H"].map(|name| (name, held.tensor(name).unwrap()))
    {
        let want = fixed_shaft.tensor(name).unwrap();
        near(tensor, want, 1e-9);
        // Of the root's own mass only J0 knows.
        assert!(want.iter().any(|value| value.abs() > 1e-6), "{name}");
    }
    near(&held.stiffness.data, &fixed_shaft.stiffness.data, 1e-9);
    for (node, other) in held.nodes.iter().zip(&fixed_shaft.nodes) {
        near(&node.shapes.data, &other.shapes.data, 1e-9);
    }
    assert!(held.nodes[0].shapes.data.iter().all(|&value| value == 0.0));
    near(&held.measures[0].rotation.data, &fixed_shaft.measures[0].rotation.data, 1e-9);

    let [held, fixed] = [&own, &fixed].map(|spec| Support::from_mesh(&mesh, spec).unwrap());
    near(&held.stiffness, &fixed.stiffness, 1e-9);
    near(&held.measures[0].displacement.data, &fixed.measures[0].displacement.data, 1e-8);
}

/// A flange of 1681 nodes: its 5043 dofs are no columns of the shapes.
#[test]
fn a_set_of_thousands_of_nodes_costs_no_constraint_modes() {
    let mesh = beam([40, 40, 2], [0.4, 0.4, 0.05]);
    let mut own = spec(3);
    own.held = dofs(&mesh, "ROOT");
    assert_eq!(own.held.len(), 5043);
    own.retained = vec![Retained::dof(mesh.dof_count() - 1, "corner z")];
    let support = Support::from_mesh(&mesh, &own).unwrap();
    assert_eq!(support.size(), 4);
    let matrices = Matrices::new(&mesh);
    let retained = [own.retained[0].terms.clone()];
    let interface = Interface { corrections: &[], retained: &retained, held: &own.held };
    assert_eq!(matrices.solid(&mesh).reduce(&interface, 3).unwrap().shapes.cols, 4);
}

#[test]
fn what_is_held_stops_rigid_motions_or_not() {
    let mesh = beam([2, 2, 4], [0.03, 0.05, 0.4]);
    let mut own = spec(2);
    let motions = |spec: &_| match Support::from_mesh(&mesh, spec).unwrap_err() {
        Error::Reduction(ReductionError::Mechanism { motions }) => motions,
        other => panic!("{other}"),
    };
    assert_eq!(motions(&own).len(), 6);
    own.held = dofs(&mesh, "ROOT").into_iter().filter(|dof| dof % 3 != 2).collect();
    // The root slides along z and tilts about x and y.
    assert_eq!(motions(&own).len(), 3);
    own.held.extend([2, 3 * 2 + 2]);
    assert_eq!(motions(&own).len(), 1);
    own.held.push(3 * 6 + 2);
    assert_eq!(Support::from_mesh(&mesh, &own).unwrap().size(), 2);

    own.retained = vec![Retained::dof(2, "ROOT z")];
    let error = Support::from_mesh(&mesh, &own).unwrap_err().to_string();
    assert!(error.contains("ROOT z is retained and held"), "{error}");
    own.retained.clear();
    own.held.push(mesh.dof_count());
    assert!(Support::from_mesh(&mesh, &own).is_err());
}

/// What is held and which mean is retained is in the key; which means are measured is not, as long as the mesh has their
/// nodes in sets, and the body from the cache gives them.
#[test]
fn means_come_from_the_cache() {
    let mesh = beam([2, 2, 6], [0.03, 0.05, 0.4]);
    let mean = |set: &str| NodeSetMean::new(&mesh, mesh.node_set(set).unwrap()).unwrap();
    let mut own = spec(4);
    own.held = dofs(&mesh, "ROOT");
    let motion = whirl_solver::mesh::MeanComponent::Displacement(0);
    own.retained = vec![Retained::mean(&mean("TIP"), motion, "TIP x")];
    let key = Reduced::key(BodyKind::Shaft, &mesh, &own);
    let reduced = Reduced::new(BodyKind::Shaft, &mesh, &own).unwrap();
    let stored: Reduced = unpack(&key, &pack(&key, &reduced).unwrap()).unwrap();
    let mut measured = own.clone();
    measured.means = vec![mean("TIP"), mean("ROOT")];
    measured.held.reverse();
    assert_eq!(Reduced::key(BodyKind::Shaft, &mesh, &measured), key);
    assert_eq!(stored.shaft(&measured).unwrap(), Shaft::from_mesh(&mesh, &measured).unwrap());
    let mut fewer = own.clone();
    fewer.held.pop();
    let mut other = own.clone();
    other.retained[0].terms[3].1 *= 1.0 + f64::EPSILON;
    for changed in [&fewer, &other] {
        assert_ne!(Reduced::key(BodyKind::Shaft, &mesh, changed), key);
    }
}
