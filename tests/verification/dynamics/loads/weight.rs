//! Gravity on bodies that turn, and on a meshed shaft.

use whirl_solver::attached::{PointMass, Unbalance};
use whirl_solver::body::{BodySpec, Rayleigh, Retained};
use whirl_solver::constraints::Constraints;
use whirl_solver::dynamics::{BodyStart, March};
use whirl_solver::equations::{Equations, State};
use whirl_solver::gravity::weights;
use whirl_solver::linalg::Lu;
use whirl_solver::machine::{Body, Machine, Rotation};
use whirl_solver::mesh::MeanComponent;
use whirl_solver::rigid::RigidBody;
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::{SHAFT, section, uniform_shaft};
use crate::dynamics::{options, parts};

const GRAVITY: [f64; 3] = [-9.81, 1.5, 0.0];

fn rotor() -> Shaft {
    let shaft = plain();
    let node = shaft.nodes[1].clone();
    let turn = whirl_solver::linalg::Matrix::zeros(3, shaft.size());
    let heavier = shaft.with_point_mass(&PointMass { mass: 1.0, node: &node, turn: &turn });
    heavier.with_unbalance(&Unbalance { moment: [1e-3, 2e-3], node: &node })
}

fn plain() -> Shaft {
    let body = RigidBody {
        along: false,
        rocks: false,
        mass: 4.0,
        polar_inertia: 0.02,
        transverse_inertia: Some(0.03),
        centre: [0.0, 0.0, 0.2],
        stiffness: [0.0; 2],
        damping: [0.0; 2],
    };
    body.turning(&[[0.0, 0.0, 0.5], [0.02, -0.01, 0.1]])
}

fn machine(rotor: Shaft) -> Machine {
    let mut parts = parts(rotor, Support::rigid(&[]), Rotation::Free);
    parts.loads = weights(&parts.bodies, GRAVITY);
    assert_eq!(parts.loads.len(), 1, "the ground has no weight");
    Machine::new(parts).expect("a machine")
}

/// Whatever the angle: the weight along x and y of space, and its moment about the axis with the arm of the first moment.
#[test]
fn the_weight_of_a_body_stays_in_space_while_it_turns() {
    let machine = machine(rotor());
    let mut equations = Equations::new(&machine);
    for angle in [0.0_f64, 0.7, 2.0, 4.5] {
        let mut state = State::new(machine.size());
        state.q[0] = angle;
        equations.evaluate(0.0, &state);
        let r = equations.residual();
        let (sin, cos) = angle.sin_cos();
        let force = [cos * r[1] - sin * r[2], sin * r[1] + cos * r[2]];
        for (found, g) in force.iter().zip(GRAVITY) {
            assert!((found - 5.0 * g).abs() < 1e-12, "{found}");
        }
        // s0 of the point mass and of the unbalance.
        let [x, y] = [0.02 + 1e-3, -0.01 + 2e-3];
        let [x, y] = [cos * x - sin * y, sin * x + cos * y];
        let moment = x * GRAVITY[1] - y * GRAVITY[0];
        assert!((r[0] - moment).abs() < 1e-14, "{} for {moment}", r[0]);
    }
}

/// The centre of a free body falls by ½ g t², of second order in Δt in its turning frame, and its energy stays balanced.
#[test]
fn a_turning_body_falls_freely() {
    let machine = machine(plain());
    let errors = [400_usize, 800].map(|steps| {
        let mut options = options(0.2 / steps as f64, steps);
        options.initial = vec![BodyStart { speed: 30.0, ..BodyStart::default() }];
        let mut march = March::new(&machine, &options).expect("starts");
        while !march.is_done() {
            march.advance().expect("the step converges");
        }
        let state = march.state().clone();
        let (sin, cos) = state.q[0].sin_cos();
        let seen = [cos * state.q[1] - sin * state.q[2], sin * state.q[1] + cos * state.q[2]];
        let energy = march.energy();
        assert!(energy.error_fraction() < 1e-3, "{energy:?}");
        let fallen = [0, 1].map(|axis| 0.5 * GRAVITY[axis] * 0.04);
        (seen[0] - fallen[0]).hypot(seen[1] - fallen[1]) / fallen[0].hypot(fallen[1])
    });
    println!("fall: {errors:?}");
    assert!(errors[1] < 1e-4 && (3.5..4.5).contains(&(errors[0] / errors[1])), "{errors:?}");
}

/// A uniform shaft on two simple supports: sag in the middle by Timoshenko's beam, 5wL⁴/384EI + wL²/8κGA.
#[test]
fn a_shaft_sags_as_a_beam_with_shear_does() {
    let [length, diameter, modulus, poisson, density] = SHAFT;
    let mesh = uniform_shaft();
    let section = |z: f64| section(&mesh, z);
    let (mut retained, mut constraints) = (Vec::new(), Constraints::new());
    let ends = [section(0.0), section(length)];
    let displacement = MeanComponent::Displacement;
    for (end, motions) in [
        (
            &ends[0],
            vec![displacement(0), displacement(1), displacement(2), MeanComponent::Rotation(2)],
        ),
        (&ends[1], vec![displacement(0), displacement(1)]),
    ] {
        for motion in motions {
            constraints.fix(format!("{motion:?}"), retained.len());
            retained.push(Retained::mean(end, motion, format!("{motion:?}")));
        }
    }
    let spec = BodySpec {
        corrections: Vec::new(),
        sections: Vec::new(),
        retained,
        held: Vec::new(),
        modes: 12,
        constraints,
        springs: Vec::new(),
        damping: Rayleigh::default(),
        nodes: Vec::new(),
        stiffening: false,
        means: vec![section(0.5)],
        memory: 1 << 30,
    };
    let shaft = Shaft::from_mesh(&mesh, &spec).expect("a shaft");
    let area = std::f64::consts::PI * diameter * diameter / 4.0;
    let inertia = area * diameter * diameter / 16.0;
    let centre = shaft.centre_of_mass.clone();
    assert!((centre.node.position[2] / (0.5 * length) - 1.0).abs() < 1e-9);
    // The polygon of the mesh has the radius of gyration of the circle, not its area.
    let weight = centre.mass / length * 9.81;
    let polygon = centre.mass / (density * length) / area;
    let shear = 6.0 * (1.0 + poisson) / (7.0 + 6.0 * poisson) * modulus / (2.0 * (1.0 + poisson));
    let sag = 5.0 * weight * length.powi(4) / (384.0 * modulus * inertia * polygon)
        + weight * length.powi(2) / (8.0 * shear * area * polygon);
    let mut lu = Lu::new(shaft.size());
    lu.factor(&shaft.stiffness.data).expect("held");
    let bodies = [Body::turning("shaft", shaft, Rotation::Held)];
    let [load] = weights(&bodies, [-9.81, 0.0, 0.0]).try_into().expect("one weight");
    let mut parts = parts(rotor(), Support::rigid(&[]), Rotation::Held);
    parts.bodies = bodies.into();
    parts.loads = vec![load];
    let machine = Machine::new(parts).expect("a machine");
    let mut equations = Equations::new(&machine);
    equations.evaluate(0.0, &State::new(machine.size()));
    let mut eta = equations.residual()[1..].to_vec();
    lu.solve_in_place(&mut eta);
    let rows = &machine.bodies[0].measures()[0].displacement;
    let found: f64 = -(0..rows.cols).map(|j| rows[(0, j)] * eta[j]).sum::<f64>();
    println!("sag {found:e} m, beam {sag:e} m, ratio {}", found / sag);
    assert!((found / sag - 1.0).abs() < 5e-3, "{found:e} for {sag:e}");
}
