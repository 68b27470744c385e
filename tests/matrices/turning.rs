//! Bodies that turn.

use whirl_solver::assembly::assemble;
use whirl_solver::body::BodySpec;
use whirl_solver::mesh::Mesh;
use whirl_solver::shaft::Shaft;
use whirl_tests::matrices as written;

use super::formats::{as_calculix, as_market};
use super::{bar, calculix, market, shafts_agree, spec};

/// Nodes of both journals on the centre line retained, and one away from it.
pub(super) fn turning(mesh: &Mesh, modes: usize) -> BodySpec {
    let away = |node: &[f64; 3]| node[0] > 0.01;
    let away = mesh.nodes().iter().position(away).expect("a node away from the axis");
    let ends: Vec<usize> = ["JOURNAL1_MIDDLE", "JOURNAL2_MIDDLE"]
        .iter()
        .flat_map(|set| mesh.node_set(set).expect("a set").to_vec())
        .chain([away])
        .collect();
    spec(mesh, &ends, modes)
}

/// M of a solid is m ⊗ 1, from which Y, H and all that follow.
#[test]
fn a_shaft_turns_by_its_stiffness_and_mass_alone() {
    let mesh = bar();
    let made = Shaft::from_mesh(&mesh, &turning(&mesh, 10)).expect("a shaft");
    let read = as_calculix(&mesh).mesh(&calculix());
    let found = Shaft::from_mesh(&read, &turning(&read, 10)).expect("a shaft");
    shafts_agree(&made, &found, 1e-9);
    let own = read.matrices().expect("matrices");
    assert_eq!(own.lacks_to_be_free("that turns"), None);
    assert_eq!(own.lacks_to_turn(false), None);
    let (what, help) = own.lacks_to_turn(true).expect("no cells, no stress");
    assert!(what.contains("no cells") && help.contains("`stiffening = false`"), "{what}; {help}");
}

/// Y, H, the load and G that are given give the shaft that the mesh has with its stiffening.
#[test]
fn matrices_that_are_given_turn_a_shaft_as_its_mesh() {
    let mesh = bar();
    let mut wanted = turning(&mesh, 10);
    let stiff = BodySpec { stiffening: true, ..wanted.clone() };
    let made = Shaft::from_mesh(&mesh, &stiff).expect("a shaft");
    let (y, h) =
        (assemble(&mesh, "spin_inertia").expect("Y"), assemble(&mesh, "spin_coupling").expect("H"));
    let mut load = vec![0.0; mesh.dof_count()];
    y.multiply(mesh.nodes().as_flattened(), &mut load);
    let mut column = format!("%%MatrixMarket matrix array real general\n{} 1\n", load.len());
    load.iter().for_each(|value| column += &format!("{value:e}\n"));
    // G by another way than the reduction takes: the stress under the load on the held body does not count here, any
    // symmetric matrix shows whether it arrives.
    let g = assemble(&mesh, "spin_inertia").expect("G");
    let texts = as_market(&mesh)
        .with("Y.mtx", written::market(&y.to_columns(), "symmetric"))
        .with("H.mtx", written::market(&h.to_columns(), "general"))
        .with("load.mtx", column)
        .with("G.mtx", written::market(&g.to_columns(), "symmetric"));
    let mut request = market();
    request.spin_inertia = Some("Y.mtx".to_owned());
    request.spin_coupling = Some("H.mtx".to_owned());
    request.spin_load = Some("load.mtx".to_owned());
    request.stiffening = Some("G.mtx".to_owned());
    let mut read = texts.mesh(&request);
    for (name, nodes) in mesh.node_sets() {
        read = read.with_node_set(name, nodes.clone());
    }
    wanted = turning(&read, 10);
    let own = read.matrices().expect("matrices");
    assert_eq!(own.wrong_spin_load(&read), None);
    // About another axis this load is wrong, as M has its centre elsewhere.
    let moved = read.clone().moved([1e-3, 0.0]).expect("a mesh");
    let (what, _) = own.wrong_spin_load(&moved).expect("a centre off the axis");
    assert!(what.contains("at x = 0 mm, y = 0 mm from") && what.contains("at x = 1 mm"), "{what}");
    let plain = Shaft::from_mesh(&read, &wanted).expect("a shaft");
    let without = Shaft::from_mesh(&mesh, &turning(&mesh, 10)).expect("a shaft");
    shafts_agree(&without, &plain, 1e-9);
    // W = Y − G is zero here, as G is Y.
    let found = Shaft::from_mesh(&read, &BodySpec { stiffening: true, ..wanted }).expect("a shaft");
    let largest = |own: &[f64]| own.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    assert!(largest(&found.spin_net.data) <= 1e-12 * largest(&made.spin_net.data));
}
