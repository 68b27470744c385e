//! The reference bodies, reduced: frequencies against those of an independent program.

use whirl_solver::assembly::assemble;
use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::constraints::{Constraints, GroundSpring, add_ground_springs};
use whirl_solver::error::{FreeMotion, ReductionError};
use whirl_solver::mesh::Mesh;
use whirl_solver::reduction::{CraigBampton, Solid};
use whirl_solver::shaft::Shaft;
use whirl_solver::sparse::SparseMatrix;
use whirl_solver::support::Support;

use crate::bodies::reference;

const PLENTY: usize = 1 << 32;

/// A list of frequencies among the test data (Hz).
fn listed(text: &str) -> Vec<f64> {
    text.lines().map(|line| line.parse().expect("one frequency a line")).collect()
}

fn compare(got: &[f64], want: &[f64]) {
    assert_eq!(got.len(), want.len());
    for (i, (got, want)) in got.iter().zip(want).enumerate() {
        assert!((got / want - 1.0).abs() < 1e-5, "mode {}: {got} Hz, listed {want}", i + 1);
    }
}

/// Dofs of the sets' nodes along the components named.
fn dofs(mesh: &Mesh, list: &[(&str, &str)]) -> Vec<Retained> {
    let mut dofs = Vec::new();
    for &(set, components) in list {
        for &node in mesh.node_set(set).unwrap() {
            for component in components.chars() {
                let dof = 3 * node + "xyz".find(component).unwrap();
                dofs.push(Retained::dof(dof, format!("{set} {component}")));
            }
        }
    }
    dofs
}

fn indices(retained: &[Retained]) -> Vec<usize> {
    retained.iter().filter_map(Retained::single).collect()
}

fn shaft_retained(mesh: &Mesh) -> Vec<Retained> {
    let journals: Vec<String> = (1..=4)
        .flat_map(|k| ["LEFT", "MIDDLE", "RIGHT"].map(|place| format!("JOURNAL{k}_{place}")))
        .collect();
    let mut list: Vec<(&str, &str)> = journals.iter().map(|name| (name.as_str(), "xy")).collect();
    list.extend([("JOURNAL3_MIDDLE", "z"), ("DRIVE_TOP", "y"), ("DRIVE_BOTTOM", "y")]);
    dofs(mesh, &list)
}

/// Springs of 1e8 N/m along y at the nodes set aside for them.
fn ground_springs(mesh: &Mesh) -> Vec<GroundSpring> {
    dofs(mesh, &[("GROUND_SPRINGS", "y")])
        .into_iter()
        .map(|spring| {
            let dof = spring.single().expect("a dof");
            GroundSpring { name: spring.name, dof, stiffness: 1e8 }
        })
        .collect()
}

fn first_elastic(solid: &Solid) -> f64 {
    let hertz = solid.free_modes(8).unwrap().hertz();
    assert!(hertz[5] < 1e-3 * hertz[6], "six rigid motions: {hertz:?}");
    hertz[6]
}

#[test]
fn reference_shaft() {
    let mesh = reference("shaft");
    let [stiffness, mass] = ["stiffness", "mass"].map(|form| assemble(&mesh, form).unwrap());
    let solid = Solid {
        stiffness: &stiffness,
        mass: &mass,
        coordinates: mesh.nodes(),
        slots: &[],
        ties: &[],
        memory: PLENTY,
    };
    let retained = shaft_retained(&mesh);
    assert_eq!((mesh.dof_count(), retained.len()), (5775, 27));
    let reduction = solid.craig_bampton(&indices(&retained), 50).unwrap();
    compare(&reduction.hertz, &listed(include_str!("../data/fixed-interface-hz-shaft.csv")));
    let free = first_elastic(&solid);
    assert!((free - 154.70).abs() < 0.005, "{free}");

    // Axial dof held, torsion tied to the frame: 75 active coordinates.
    let mut constraints = Constraints::new();
    constraints.fix("axial", 24);
    constraints.equation("torsion", [(25, 1.0), (26, -1.0)]);
    let spec = BodySpec {
        corrections: Vec::new(),
        sections: Vec::new(),
        retained,
        held: Vec::new(),
        modes: 50,
        constraints,
        springs: Vec::new(),
        damping: Rayleigh { alpha: 0.0, beta: 1e-4 },
        nodes: vec![mesh.single_node("DRIVE_TOP").unwrap()],
        stiffening: false,
        means: Vec::new(),
        memory: PLENTY,
    };
    let shaft = Shaft::from_mesh(&mesh, &spec).unwrap();
    assert_eq!(shaft.size(), 75);
    assert_eq!(shaft.hertz, reduction.hertz);
    assert_eq!(shaft.coordinates[0], "mode 1 (527.1 Hz)");
    assert_eq!(shaft.coordinates[50], "JOURNAL1_LEFT x");
    assert_eq!(shaft.coordinates[74], "DRIVE_BOTTOM y");
    // The octagon's radius is chosen for the radius of gyration of a circle of 34 mm (to four digits).
    let along_x: Vec<f64> = (0..5775).map(|dof| f64::from(u8::from(dof % 3 == 0))).collect();
    let kilograms = mass.bilinear(&along_x, &along_x);
    assert!((shaft.j0 / (kilograms * 0.034 * 0.034 / 2.0) - 1.0).abs() < 1e-4);
    assert!((shaft.nodes[0].shapes[(1, 74)] - 1.0).abs() < 1e-15);
}

#[test]
fn reference_support() {
    let mesh = reference("support");
    let elastic = assemble(&mesh, "stiffness").unwrap();
    let mass = assemble(&mesh, "mass").unwrap();
    let stiffness = add_ground_springs(elastic.clone(), &ground_springs(&mesh)).unwrap();
    let solid = Solid {
        stiffness: &stiffness,
        mass: &mass,
        coordinates: mesh.nodes(),
        slots: &[],
        ties: &[],
        memory: PLENTY,
    };
    let retained = dofs(&mesh, &[("MOUNTS", "xyz")]);
    assert_eq!((mesh.dof_count(), retained.len()), (12807, 9));
    let reduction = solid.craig_bampton(&indices(&retained), 150).unwrap();
    compare(&reduction.hertz, &listed(include_str!("../data/fixed-interface-hz-support.csv")));
    orthonormal(&reduction, &mass);

    let alone = Solid { stiffness: &elastic, ..solid };
    let free = first_elastic(&alone);
    assert!((free - 120.08).abs() < 0.005, "{free}");
    // Without the ground springs the support swings about the line of its mounts.
    let Err(ReductionError::Mechanism { motions }) = alone.craig_bampton(&indices(&retained), 5)
    else {
        panic!("a mechanism is an error");
    };
    let [FreeMotion::Rotation { direction, .. }] = motions[..] else { panic!("{motions:?}") };
    assert!((direction[2] - 1.0).abs() < 1e-9);

    // All mounts held: the modes themselves are the active coordinates.
    let mut mounts = Constraints::new();
    retained.iter().enumerate().for_each(|(i, mount)| mounts.fix(&*mount.name, i));
    let bore = mesh.node_set("BORE1_LEFT").unwrap();
    let spec = BodySpec {
        corrections: Vec::new(),
        sections: Vec::new(),
        retained,
        held: Vec::new(),
        modes: 150,
        constraints: mounts,
        springs: ground_springs(&mesh),
        damping: Rayleigh { alpha: 0.0, beta: 1e-4 },
        nodes: bore.to_vec(),
        stiffening: false,
        means: Vec::new(),
        memory: PLENTY,
    };
    let support = Support::from_mesh(&mesh, &spec).unwrap();
    assert_eq!((support.size(), support.nodes.len()), (150, bore.len()));
    assert_eq!(support.coordinates[0], "mode 1 (285.5 Hz)");
    for i in 0..150 {
        assert_eq!(support.stiffness[i], reduction.stiffness[(i, i)]);
        assert_eq!(support.damping[i], 1e-4 * support.stiffness[i]);
    }
}

#[test]
fn a_dof_retained_twice_is_named() {
    let mesh = reference("shaft");
    let mut retained = dofs(&mesh, &[("JOURNAL1_LEFT", "xy"), ("DRIVE_TOP", "y")]);
    let mut again = retained[1].clone();
    again.name = "LEFT_END y".to_owned();
    retained.push(again);
    let spec = BodySpec {
        corrections: Vec::new(),
        sections: Vec::new(),
        retained,
        held: Vec::new(),
        modes: 1,
        constraints: Constraints::new(),
        springs: Vec::new(),
        damping: Rayleigh::default(),
        nodes: Vec::new(),
        stiffening: false,
        means: Vec::new(),
        memory: PLENTY,
    };
    let message = Shaft::from_mesh(&mesh, &spec).unwrap_err().to_string();
    assert!(message.contains("LEFT_END y is retained already, as JOURNAL1_LEFT y"), "{message}");
}

fn orthonormal(reduction: &CraigBampton, mass: &SparseMatrix) {
    let gram = reduction.reduce(mass);
    for i in 0..reduction.modes() {
        for j in 0..reduction.modes() {
            let one = if i == j { 1.0 } else { 0.0 };
            assert!((gram[(i, j)] - one).abs() < 1e-11, "{i} {j}: {}", gram[(i, j)]);
        }
    }
}
