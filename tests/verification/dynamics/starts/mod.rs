//! Machines that start in equilibrium at speed: journals in short films against closed forms, the threshold of oil whirl,
//! floating rings, what drifts after the start; and machines that start from the last state of another march.

mod drift;
mod equilibrium;
mod restart;
mod short_film;
mod whirl;

use whirl_solver::bearing::{Bearing, Sides};
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Body, Machine, MachineParts, Rotation};
use whirl_solver::rigid::RigidBody;
use whirl_solver::support::Support;
use whirl_specs::{CLEARANCES, LAWS, Law};

use super::{boxed, force, motion};

/// Of the film as its law has them: R, L, c (m), μ (Pa·s).
const R: f64 = 0.025;
const L: f64 = 0.02;
const C: f64 = 5e-5;
const MU: f64 = 0.02;
/// ω (rad/s).
const SPEED: f64 = 400.0;
/// z of the two journals (m).
const JOURNALS: [f64; 2] = [-0.15, 0.15];

fn ocvirk() -> &'static Law {
    LAWS.iter().find(|law| law.origin.name == "ocvirk").expect("is shipped")
}

/// A film at a journal of one node, in a rigid bore.
fn film(name: &str, journal: usize) -> Bearing {
    Bearing {
        others: Vec::new(),
        name: name.to_owned(),
        label: None,
        sides: Sides::default(),
        journal: [journal; 3],
        bore: [const { Vec::new() }; 3],
        clearance: C,
        journal_radius: Some(R),
        stations: vec![0.5],
        angles: Vec::new(),
        law: 0,
    }
}

/// A rigid rotor of a mass (kg) in two short films, with a force (N) along −x at z (m).
fn rigid_rotor(mass: f64, load: f64, z: f64, rotation: Rotation) -> Machine {
    tilting_rotor([mass, 0.015], load, z, rotation)
}

/// As [`rigid_rotor`]; `transverse`: I_d over the mass (m²), where I_p is 0.02 of it.
fn tilting_rotor([mass, transverse]: [f64; 2], load: f64, z: f64, rotation: Rotation) -> Machine {
    let body = RigidBody {
        along: false,
        rocks: false,
        mass,
        polar_inertia: 0.02 * mass,
        transverse_inertia: Some(transverse * mass),
        centre: [0.0; 3],
        stiffness: [0.0; 2],
        damping: [0.0; 2],
    };
    let nodes = [JOURNALS[0], JOURNALS[1], z].map(|z| [0.0, 0.0, z]);
    let rotor = body.turning(&nodes);
    let down = force(&rotor.nodes[2], [-load, 0.0, 0.0], TimeFunction::Constant, Frame::Space);
    Machine::new(MachineParts {
        bodies: vec![
            Body::turning("rotor", rotor, rotation),
            Body::standing("ground", Support::rigid(&[])),
        ],
        motion: motion("consistent"),
        clearance: &CLEARANCES[0],
        laws: vec![boxed(ocvirk())],
        bearings: vec![film("left", 0), film("right", 1)],
        loads: vec![down],
    })
    .expect("a machine")
}
