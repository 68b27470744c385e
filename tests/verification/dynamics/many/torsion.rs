//! Two shafts whose ends are coupled in torsion, against the rods of the closed form.

use nalgebra::{Cholesky, DMatrix, SymmetricEigen};
use whirl_solver::bearing::{Bearing, Sides};
use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::constraints::Constraints;
use whirl_solver::dynamics::{Coefficients, Newmark};
use whirl_solver::equations::{Equations, State};
use whirl_solver::machine::{Body, Machine, MachineParts, Rotation};
use whirl_solver::mesh::shaft::{SectionCells, SolidShaft};
use whirl_solver::mesh::{Material, MeanComponent, NodeSetMean};
use whirl_solver::shaft::Shaft;
use whirl_specs::{CLEARANCES, ELEMENTS};

use super::super::contacts::{Formula, laws};
use super::super::motion;

const LENGTH: f64 = 0.4;
const DENSITY: f64 = 7860.0;
const SHEAR: f64 = 200e9 / 2.6;
/// N·m/rad.
const STIFFNESS: f64 = 1e5;

static TORSION: Formula = Formula {
    name: "torsion",
    inputs: &["theta", "omega"],
    outputs: &["F_x", "F_y", "M_z"],
    value: |z| vec![z[0] * 0.0, z[0] * 0.0, z[0] * -STIFFNESS],
};

/// A shaft whose middle turns with its frame; the turn of its end is retained and measured.
fn shaft() -> Shaft {
    let shaft = SolidShaft {
        length: LENGTH,
        diameter: 0.05,
        supports: vec![0.05, 0.35],
        support_length: 0.02,
        layers_in_support: 2,
        layers_between: 8,
        loads: vec![0.2],
        sections: Vec::new(),
        section: SectionCells { sectors: 16, rings: 2, order: 1 },
        material: Material::isotropic("STEEL", 200e9, 0.3, DENSITY).expect("steel"),
    };
    let mesh = shaft.mesh(&ELEMENTS.iter().collect::<Vec<_>>()).expect("a mesh");
    let section = |z: f64| -> Vec<usize> {
        let near = |node: &usize| (mesh.nodes()[*node][2] - z).abs() < 1e-9;
        (0..mesh.nodes().len()).filter(near).collect()
    };
    let means = [0.0, 0.2].map(|z| NodeSetMean::new(&mesh, &section(z)).expect("a section"));
    let mut retained = vec![
        Retained::mean(&means[1], MeanComponent::Rotation(2), "turn of the middle"),
        Retained::mean(&means[0], MeanComponent::Rotation(2), "turn of the end"),
    ];
    for place in ["LEFT", "MIDDLE"] {
        let node = mesh.single_node(&format!("JOURNAL1_{place}")).expect("a node");
        retained.extend(
            [0, 1, 2].map(|axis| Retained::dof(3 * node + axis, format!("{place} {axis}"))),
        );
    }
    let mut constraints = Constraints::new();
    constraints.fix("frame", 0);
    let spec = BodySpec {
        corrections: Vec::new(),
        sections: Vec::new(),
        retained,
        held: Vec::new(),
        modes: 12,
        constraints,
        springs: Vec::new(),
        damping: Rayleigh::default(),
        nodes: vec![0],
        means: means.to_vec(),
        stiffening: false,
        memory: 1 << 30,
    };
    Shaft::from_mesh(&mesh, &spec).expect("a shaft")
}

fn machine(shaft: &Shaft, sections: [Option<usize>; 2]) -> Machine {
    let coupling = Bearing {
        others: Vec::new(),
        name: "coupling".to_owned(),
        label: None,
        sides: Sides { sections, ..Sides::default() },
        journal: [0; 3],
        bore: [const { Vec::new() }; 3],
        clearance: 0.0,
        journal_radius: None,
        stations: vec![0.5],
        angles: Vec::new(),
        law: 0,
    };
    let body = |name: &str| Body::turning(name, shaft.clone(), Rotation::Free);
    Machine::new(MachineParts {
        bodies: vec![body("first"), body("second")],
        motion: motion("consistent"),
        clearance: &CLEARANCES[0],
        laws: laws(&[&TORSION]),
        bearings: vec![coupling],
        loads: Vec::new(),
    })
    .expect("a machine")
}

/// Lowest angular frequency at rest of those modes in which the frames turn against each other (rad/s).
fn counter_rotating(machine: &Machine) -> f64 {
    let inertia = machine.bodies[0].shaft().expect("turns").j0;
    let size = machine.size();
    let mut equations = Equations::new(machine);
    let state = State::new(size);
    equations.evaluate(0.0, &state);
    let mut tangent = |dt: f64| {
        let mut tangent = vec![0.0; size * size];
        equations.tangent(
            0.0,
            &state,
            Coefficients::new(Newmark::default(), dt).weights(),
            &mut tangent,
        );
        (4.0 / (dt * dt), DMatrix::from_vec(size, size, tangent))
    };
    let ((a, first), (b, second)) = (tangent(1e-4), tangent(2e-4));
    let mass = (&first - &second) / (a - b);
    let stiffness = first - &mass * a;
    let factor = Cholesky::new(mass).expect("a mass").l().try_inverse().expect("a factor");
    let own = &factor * stiffness * factor.transpose();
    let eigen = SymmetricEigen::new((&own + own.transpose()) * 0.5);
    let shapes = factor.transpose() * eigen.eigenvectors;
    let [theta, other] = [0, 1].map(|body| machine.places()[body].rotation.expect("turns"));
    let turns = |mode: &usize| (shapes[(theta, *mode)] - shapes[(other, *mode)]).abs();
    // Of mass 1, torsion has J (θ − θ')² near one, bending none.
    let torsion =
        |mode: &usize| eigen.eigenvalues[*mode] > 1e4 && inertia * turns(mode).powi(2) > 0.1;
    let all = (0..size).filter(torsion).map(|mode| eigen.eigenvalues[mode].sqrt());
    all.fold(f64::INFINITY, f64::min)
}

/// x of x tan x = `ratio`.
fn root(ratio: f64) -> f64 {
    let (mut low, mut high) = (0.0, std::f64::consts::FRAC_PI_2);
    for _ in 0..60 {
        let middle: f64 = 0.5 * (low + high);
        *(if middle * middle.tan() < ratio { &mut low } else { &mut high }) = middle;
    }
    low
}

/// A rod that turns against its mirror image is held by a spring of twice the stiffness: βl tan βl = 2 k l/(G I_p),
/// ω = β √(G/ρ), with its whole length where the spring is at its end, and halves of it, and of the spring, where it is in
/// the middle, which turns with the frame.
#[test]
fn coupled_shafts_have_the_torsional_frequencies_of_rods() {
    let shaft = shaft();
    let polar = shaft.j0 / (DENSITY * LENGTH);
    let ratio = 2.0 * STIFFNESS * LENGTH / (SHEAR * polar);
    let speed = (SHEAR / DENSITY).sqrt() / LENGTH;
    let cases = [(Some(0), speed * root(ratio)), (None, 2.0 * speed * root(0.25 * ratio))];
    for (section, exact) in cases {
        let found = counter_rotating(&machine(&shaft, [section; 2]));
        assert!((found / exact - 1.0).abs() < 0.01, "{section:?}: {found} for {exact}");
    }
}
