//! A couple at another section than that which turns with the frame.

use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::constraints::Constraints;
use whirl_solver::equations::{Equations, State};
use whirl_solver::linalg::Lu;
use whirl_solver::loads::{Frame, Load, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::mesh::MeanComponent;
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::{SHAFT, section, uniform_shaft};
use crate::dynamics::parts;

/// N·m about x, y and z.
const COUPLE: [f64; 3] = [0.0, 30.0, 50.0];

/// A shaft whose first section is held to its frame, under a couple on its last one: twist ML/GJ, slope ML/EI, and the whole
/// couple about z on θ.
#[test]
fn a_couple_twists_and_bends_a_shaft_and_turns_its_frame() {
    let [length, diameter, modulus, poisson, density] = SHAFT;
    let mesh = uniform_shaft();
    let (first, last) = (section(&mesh, 0.0), section(&mesh, length));
    let (mut retained, mut constraints) = (Vec::new(), Constraints::new());
    for motion in MeanComponent::ALL {
        constraints.fix(format!("{motion:?}"), retained.len());
        retained.push(Retained::mean(&first, motion, format!("{motion:?}")));
    }
    for motion in [MeanComponent::Rotation(1), MeanComponent::Rotation(2)] {
        retained.push(Retained::mean(&last, motion, format!("last {motion:?}")));
    }
    let spec = BodySpec {
        corrections: Vec::new(),
        sections: Vec::new(),
        retained,
        held: Vec::new(),
        modes: 10,
        constraints,
        springs: Vec::new(),
        damping: Rayleigh::default(),
        nodes: Vec::new(),
        stiffening: false,
        means: vec![first, last],
        memory: 1 << 30,
    };
    let shaft = Shaft::from_mesh(&mesh, &spec).expect("a shaft");
    let turns = shaft.measures[1].rotation.clone();
    assert!(shaft.measures[0].rotation.norm_max() < 1e-9, "the first section stays");
    let polygon = shaft.centre_of_mass.mass / density / length;
    let polygon = polygon / (std::f64::consts::PI * diameter * diameter / 4.0);
    let mut lu = Lu::new(shaft.size());
    lu.factor(&shaft.stiffness.data).expect("held");
    let mut parts = parts(shaft, Support::rigid(&[]), Rotation::Free);
    let constant = TimeFunction::Constant;
    parts.loads = vec![Load::couple(0, turns.clone(), COUPLE, constant, Frame::Body)];
    let machine = Machine::new(parts).expect("a machine");
    let mut equations = Equations::new(&machine);
    equations.evaluate(0.0, &State::new(machine.size()));
    assert!((equations.residual()[0] - COUPLE[2]).abs() < 1e-12, "{}", equations.residual()[0]);
    let mut eta = equations.residual()[1..].to_vec();
    lu.solve_in_place(&mut eta);
    let turned = |axis: usize| (0..turns.cols).map(|j| turns[(axis, j)] * eta[j]).sum::<f64>();
    let inertia = polygon * std::f64::consts::PI * diameter.powi(4) / 64.0;
    let shear = modulus / (2.0 * (1.0 + poisson));
    let [twist, slope] =
        [COUPLE[2] * length / (shear * 2.0 * inertia), COUPLE[1] * length / (modulus * inertia)];
    println!("twist {}, slope {}", turned(2) / twist, turned(1) / slope);
    // Corners of a polygon add to its polar moment and not to its stiffness against torsion.
    assert!((turned(2) / twist - 1.0).abs() < 0.02, "{} for {twist}", turned(2));
    assert!((turned(1) / slope - 1.0).abs() < 5e-3, "{} for {slope}", turned(1));
}
