//! Frames: what is constant, and that all of them have the same motions.

use std::sync::atomic::{AtomicUsize, Ordering};

use whirl_specs::{CLEARANCES, LAWS, MOTIONS};

use super::linearised::Linearised;
use super::range::Range;
use super::round::LinearMachine;
use crate::bearing::{Bearing, Sides};
use crate::error::Error;
use crate::gravity::weights;
use crate::linalg::Matrix;
use crate::machine::{Body, Machine, MachineParts, Rotation};
use crate::roundness::tests::Prism;
use crate::shaft::Shaft;
use crate::support::Support;

/// rad/s.
const SPEED: f64 = 700.0;

/// A shaft of eight sides in two bushings on the ground, under its weight or not.
fn machine(gravity: f64) -> Machine {
    machine_of(&Prism::solid(8), "bushing", gravity)
}

/// A prism in two joints with a law.
fn machine_of(prism: &Prism, law: &str, gravity: f64) -> Machine {
    let mut shaft = prism.shaft();
    shaft.nodes = shaft.measures.iter().map(|own| own.node_at([0.0, 0.0, own.centre[2]])).collect();
    let bodies = vec![
        Body::turning("rotor", shaft, Rotation::Prescribed { speed: SPEED, acceleration: 0.0 }),
        Body::standing("ground", Support::rigid(&[])),
    ];
    let loads = weights(&bodies, [-gravity, 0.0, 0.0]);
    let law = LAWS.iter().find(|own| own.origin.name == law).expect("is shipped");
    let at = |name: &str, node: usize| Bearing {
        others: Vec::new(),
        name: name.to_owned(),
        label: None,
        sides: Sides { bodies: [0, 1], ..Sides::default() },
        journal: [node; 3],
        bore: [Vec::new(), Vec::new(), Vec::new()],
        clearance: 0.0,
        journal_radius: None,
        stations: vec![0.5],
        angles: (0..24).map(|k| std::f64::consts::TAU * f64::from(k) / 24.0).collect(),
        law: 0,
    };
    Machine::new(MachineParts {
        bodies,
        motion: MOTIONS.iter().find(|own| own.origin.name == "consistent").expect("is shipped"),
        clearance: &CLEARANCES[0],
        laws: vec![Box::new(law)],
        bearings: vec![at("near", 0), at("far", 2)],
        loads,
    })
    .expect("a machine")
}

/// A body that turns, without a node, a section or a mass that is seen to move sideways, has no S.
#[test]
fn a_body_of_which_nothing_shows_how_it_turns_is_named() {
    let mut shaft = Shaft::lumped(2.0, [1e6; 2], [0.0; 2], 0.0);
    shaft.nodes.clear();
    shaft.centre_of_mass.node.shapes = Matrix::zeros(3, 2);
    let rotation = Rotation::Prescribed { speed: SPEED, acceleration: 0.0 };
    let machine = Machine::new(MachineParts {
        bodies: vec![Body::turning("impeller", shaft, rotation)],
        motion: MOTIONS.iter().find(|own| own.origin.name == "consistent").expect("is shipped"),
        clearance: &CLEARANCES[0],
        laws: Vec::new(),
        bearings: Vec::new(),
        loads: Vec::new(),
    });
    let refused = LinearMachine::new(machine.expect("a machine")).err().expect("an error");
    let said = refused.to_string();
    for word in ["impeller cannot be seen from space", "shows its motion", "a set of nodes around"]
    {
        assert!(said.contains(word), "{word}: {said}");
    }
}

/// At times of which no symmetry knows, seen from space.
#[test]
fn equations_of_round_bodies_do_not_vary() {
    let linear = LinearMachine::new(machine(9.81)).expect("round");
    let at = linear.standing(&[Some(SPEED), None], None).expect("stands");
    let varies = linear.varies(&at);
    assert!(varies < 1e-11, "{varies:e}");
}

/// Also of forward and backward motions, of which the one has its frequency less Ω there and the other with Ω.
#[test]
fn the_frame_of_the_rotor_has_the_motions_of_space() {
    let linear = LinearMachine::new(machine(0.0)).expect("round");
    let at = linear.standing(&[Some(SPEED), None], None).expect("stands");
    let space = linear.linearised(&at).expect("round");
    let [mass, damping, stiffness] = linear.sample((&at, linear.machine(), 0), [0.0, 0.0], true);
    let rotor = Linearised { mass, damping, stiffness, frame: SPEED, ..space.clone() };
    let [space, rotor] = [space, rotor].map(|own| linear.modes(&own, 12).expect("modes"));
    assert_eq!(space.oscillating.len(), 12);
    for own in &space.oscillating {
        let apart = |other: &super::Mode| (other.value - own.value).norm() / own.value.norm();
        let nearest = rotor.oscillating.iter().min_by(|a, b| apart(a).total_cmp(&apart(b)));
        let nearest = nearest.expect("a mode");
        assert!(apart(nearest) < 1e-9, "{}: {}", own.value, nearest.value);
    }
}

/// An interruption within a speed of a body that is not round, in films: what was found at the speeds before is kept.
#[test]
fn an_interruption_within_a_speed_keeps_the_speeds_before() {
    let mut flat = Prism::solid(8);
    flat.shape = |[x, y, z]| [0.8 * x, y, z];
    let linear = LinearMachine::new(machine_of(&flat, "ocvirk", 9.81)).expect("a machine");
    let at = linear.standing(&[Some(SPEED), None], None).expect("stands");
    let equations = linear.linearised(&at).expect("equations");
    assert!(equations.varying.is_some() && equations.mass.rows > 24, "{}", equations.mass.rows);
    assert_eq!(linear.modes_while(&equations, 4, &|| false), Err(Error::Interrupted));
    let followed = |speeds: &[f64], most: usize| {
        let asked = AtomicUsize::new(0);
        let goes_on = || asked.fetch_add(1, Ordering::Relaxed) < most;
        let (ratios, orders) = (Vec::new(), Vec::new());
        let range = Range { of: 0, speeds: speeds.to_vec(), ratios, count: 4, orders };
        (linear.campbell(&range, &goes_on).expect("modes"), asked.into_inner())
    };
    let (first, asked) = followed(&[SPEED], usize::MAX);
    let (all, interrupted) = (first.speeds, first.interrupted);
    assert!(all == [SPEED] && !interrupted && asked > 3, "{all:?}, asked {asked} times");
    // Asked once before the second speed, then among its motions.
    let (cut, _) = followed(&[SPEED, 1.1 * SPEED], asked + 2);
    assert_eq!((cut.speeds, cut.interrupted), (vec![SPEED], true));
    assert_eq!(cut.branches, first.branches);
}
