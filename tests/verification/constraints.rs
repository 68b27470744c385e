//! Mounts and ground springs of the reference support.

use whirl_solver::assembly::assemble;
use whirl_solver::constraints::{Constraints, GroundSpring, add_ground_springs, free_motions};
use whirl_solver::error::Error;
use whirl_solver::error::FreeMotion;

use crate::bodies::reference;

#[test]
fn mounts_on_one_line_leave_a_swing_that_ground_springs_stop() {
    let mesh = reference("support");
    let k = assemble(&mesh, "stiffness").unwrap();
    let mut mounts = Constraints::new();
    for &node in mesh.node_set("MOUNTS").unwrap() {
        for i in 0..3 {
            mounts.fix(
                format!("mount at node {}, {}", mesh.labels()[node], "xyz".get(i..=i).unwrap()),
                3 * node + i,
            );
        }
    }
    assert_eq!(mounts.eliminate(mesh.dof_count()).unwrap().free.len(), 12_798);
    let swing = free_motions(mesh.nodes(), &k, &mounts).unwrap();
    let [FreeMotion::Rotation { direction, through }] = swing[..] else { panic!("{swing:?}") };
    assert!((direction[2] - 1.0).abs() < 1e-9, "{direction:?}");
    // The line of the mounts: the top of the beam, half way across.
    assert!((through[0] - 0.114035687).abs() < 1e-9 && through[1].abs() < 1e-9, "{through:?}");

    let spring = |&node: &usize| GroundSpring {
        name: "ground spring".into(),
        dof: 3 * node + 1,
        stiffness: 1e8,
    };
    let springs: Vec<GroundSpring> =
        mesh.node_set("GROUND_SPRINGS").unwrap().iter().map(spring).collect();
    let held = add_ground_springs(k.clone(), &springs).unwrap();
    assert_eq!(free_motions(mesh.nodes(), &held, &mounts).unwrap(), []);
    // Springs without mounts leave the motions that they do not stretch: all but y and the turns that
    // move their line along y.
    let free = free_motions(mesh.nodes(), &held, &Constraints::new()).unwrap();
    assert_eq!(free.len(), 4, "{free:?}");
}

#[test]
fn a_turn_held_by_one_equation_is_no_mechanism() {
    let mesh = reference("shaft");
    let k = assemble(&mesh, "stiffness").unwrap();
    let node = |name| mesh.single_node(name).unwrap();
    let mut constraints = Constraints::new();
    for end in ["JOURNAL1_MIDDLE", "JOURNAL4_MIDDLE"] {
        constraints.fix(format!("{end} x"), 3 * node(end));
        constraints.fix(format!("{end} y"), 3 * node(end) + 1);
    }
    constraints.fix("axial", 3 * node("JOURNAL3_MIDDLE") + 2);
    let free = free_motions(mesh.nodes(), &k, &constraints).unwrap();
    assert_eq!(free.len(), 1);
    assert_eq!(
        free[0].to_string(),
        "turn about an axis along z through (0.0000, 0.0000, 0.7020) m"
    );
    let ends = [(3 * node("DRIVE_TOP") + 1, 1.0), (3 * node("DRIVE_BOTTOM") + 1, -1.0)];
    constraints.equation("torsion", ends);
    assert_eq!(free_motions(mesh.nodes(), &k, &constraints).unwrap(), []);
    let elimination = constraints.eliminate(mesh.dof_count()).unwrap();
    assert_eq!(elimination.free.len(), 5775 - 6);
}

/// Beside a spring of more than a million times its stiffness a body has no digits left.
#[test]
fn a_spring_that_swamps_the_body_is_refused() {
    let mesh = reference("support");
    let k = assemble(&mesh, "stiffness").unwrap();
    let stiffest = k.lower().unwrap().diagonal().into_iter().fold(0.0, f64::max);
    let spring = |stiffness: f64| {
        let soft = GroundSpring { name: "soft".to_owned(), dof: 3, stiffness: 1.0 };
        let own = GroundSpring { name: "stiff".to_owned(), dof: 7, stiffness };
        add_ground_springs(k.clone(), &[soft, own])
    };
    assert!(spring(0.99e6 * stiffest).is_ok());
    match spring(1.01e6 * stiffest) {
        Err(Error::StiffSpring { place: 1, name, body, .. }) => {
            assert_eq!((name.as_str(), body), ("stiff", stiffest));
        }
        other => panic!("{other:?}"),
    }
}
