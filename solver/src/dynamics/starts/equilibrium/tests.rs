//! The tangent of the balance by differences, and what the search does where films and contacts are hard.

use whirl_specs::{CLEARANCES, LAWS, MOTIONS};

use super::balance::Balance;
use super::equilibrium;
use super::turning::{TurningStart, idle_speed};
use crate::bearing::{Bearing, Sides};
use crate::body::BodyNode;
use crate::centre_of_mass::CentreOfMass;
use crate::curve::Curve;
use crate::error::Error;
use crate::linalg::Matrix;
use crate::loads::{Frame, Load, TimeFunction};
use crate::machine::{Body, Machine, MachineParts, Rotation};
use crate::rigid::RigidBody;
use crate::shaft::Shaft;
use crate::support::Support;

/// A shaft whose tensors have every part: two sideways coordinates of a journal, and one of its own.
fn shaft() -> Shaft {
    let matrix = |values: [f64; 6]| {
        let [a, b, c, d, e, f] = values;
        Matrix { rows: 3, cols: 3, data: vec![a, b, c, b, d, e, c, e, f] }
    };
    let shapes =
        Matrix { rows: 3, cols: 3, data: vec![1.0, 0.1, 0.0, -0.2, 0.9, 0.0, 0.4, 0.3, 0.2] };
    let mut nodes = vec![BodyNode { position: [0.0; 3], shapes: shapes.clone() }];
    for k in 0..6 {
        let (sin, cos) = (std::f64::consts::PI * f64::from(k) / 3.0).sin_cos();
        nodes.push(BodyNode { position: [0.03 * cos, 0.03 * sin, 0.0], shapes: shapes.clone() });
    }
    Shaft {
        j0: 0.02,
        y0: vec![1e-4, -2e-4, 5e-3],
        g0: vec![1e-3, 2e-3, 0.0],
        mass: matrix([4.0, 0.3, 0.2, 5.0, 0.1, 2.0]),
        stiffness: matrix([9e6, -2e6, 1e6, 8e6, 5e5, 4e7]),
        damping: matrix([900.0, -200.0, 100.0, 800.0, 50.0, 4e3]),
        spin_inertia: matrix([3.9, 0.2, 0.1, 4.8, 0.1, 1.5]),
        spin_coupling: Matrix {
            rows: 3,
            cols: 3,
            data: vec![0.0, -3.8, -0.3, 3.8, 0.0, -0.2, 0.3, 0.2, 0.0],
        },
        spin_net: matrix([3.7, 0.2, 0.1, 4.5, 0.1, 1.1]),
        hertz: Vec::new(),
        coordinates: ["a", "b", "c"].map(str::to_owned).to_vec(),
        nodes,
        measures: Vec::new(),
        sections: Vec::new(),
        centre_of_mass: CentreOfMass::none(3),
    }
}

pub(super) fn bearing(name: &str, bodies: [usize; 2], bore: Vec<usize>, clearance: f64) -> Bearing {
    Bearing {
        others: Vec::new(),
        name: name.to_owned(),
        label: None,
        sides: Sides { bodies, ..Sides::default() },
        journal: [0; 3],
        bore: [Vec::new(), bore, Vec::new()],
        clearance,
        journal_radius: Some(0.025),
        stations: vec![0.5],
        angles: (0..24).map(|k| std::f64::consts::TAU * f64::from(k) / 24.0).collect(),
        law: 0,
    }
}

pub(super) fn load(node: &BodyNode, force: [f64; 3], frame: Frame) -> Load {
    Load::force(0, node.clone(), force, TimeFunction::Constant, frame)
}

/// A shaft in a film in a ring that turns freely, in a film in a housing that yields.
fn floating_ring() -> Machine {
    let ocvirk = LAWS.iter().find(|law| law.origin.name == "ocvirk").expect("is shipped");
    let around: Vec<[f64; 3]> = (0..6)
        .map(|k| (std::f64::consts::PI * f64::from(k) / 3.0).sin_cos())
        .map(|(sin, cos)| [0.04 * cos, 0.04 * sin, 0.0])
        .collect();
    let own = shaft();
    let loads = vec![
        load(&own.nodes[0], [30.0, -70.0, 0.0], Frame::Space),
        load(&own.nodes[1], [20.0, 10.0, 0.0], Frame::Body),
    ];
    let bodies = vec![
        Body::turning("shaft", own, Rotation::Free),
        Body::turning("ring", shaft(), Rotation::Free),
        Body::standing("housing", Support::lumped(3.0, [4e6, 9e6], [20.0, 30.0], &around)),
    ];
    Machine::new(MachineParts {
        bodies,
        motion: MOTIONS.iter().find(|own| own.origin.name == "consistent").expect("is shipped"),
        clearance: &CLEARANCES[0],
        laws: vec![Box::new(ocvirk)],
        bearings: vec![
            bearing("inner", [0, 1], (1..7).collect(), 5e-5),
            bearing("outer", [1, 2], (0..6).collect(), 5e-5),
        ],
        loads,
    })
    .expect("a machine")
}

/// A node of a mesh is on the axis but for the digits of its file, the middle of a surface but for rounding.
#[test]
fn a_journal_next_to_the_axis_turns_as_one_on_it() {
    let on_axis = shaft();
    let quarter_turn = |shaft: &Shaft| TurningStart::new(shaft, 0.0).expect("a start").quarter_turn;
    let exact = quarter_turn(&on_axis);
    for off in [1e-18, 1e-9, 1e-7] {
        let mut other = shaft();
        other.nodes[0].position = [off, -off, 0.0];
        assert_eq!(quarter_turn(&other), exact, "{off}");
    }
    // A crank pin is none.
    let mut pin = shaft();
    pin.nodes[0].position = [0.02, 0.0, 0.0];
    assert_ne!(quarter_turn(&pin), exact);
    let mut without = shaft();
    without.nodes.remove(0);
    assert_eq!(quarter_turn(&pin), quarter_turn(&without));
}

/// Column by column: shapes, rates of standing deflections, centrifugal deflection, speed of the ring, loads.
#[test]
fn the_tangent_is_that_of_differences() {
    let machine = floating_ring();
    let mut balance = Balance::new(&machine, &[Some(700.0), None], None).expect("a balance");
    let n = balance.places.len();
    assert_eq!(n, 3 + 3 + 2 + 1);
    let mut z: Vec<f64> = (0..n).map(|i| 8e-6 * (1.3 * i as f64 + 0.4).sin()).collect();
    z[n - 1] = 310.0;
    balance.set(&z).expect("a state");
    let found = balance.unknowns();
    assert!(z.iter().zip(&found).all(|(a, b)| (a - b).abs() <= 1e-12 * a.abs().max(1e-6)));
    let tangent = balance.tangent();
    for column in 0..n {
        let step = if column < n - 1 { 1e-9 } else { 1e-2 };
        let force = |by: f64, balance: &mut Balance| {
            let mut moved = z.clone();
            moved[column] += by;
            balance.set(&moved).expect("a state");
            balance.force.clone()
        };
        let (more, less) = (force(step, &mut balance), force(-step, &mut balance));
        let largest = tangent.col(column).iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for row in 0..n {
            let exact = -(more[row] - less[row]) / (2.0 * step);
            let error = (tangent[(row, column)] - exact).abs();
            // Differences of forces of 100 N lose 1e-14 / 1e-9 · 100 N of 1e7 N/m, and the square of the step.
            assert!(error <= 1e-6 * largest, "{row} {column}: {} {exact}", tangent[(row, column)]);
        }
    }
}

/// With tensors that are no shaft's, too: the search asks for no symmetry.
#[test]
fn forces_and_couples_of_a_floating_ring_are_balanced() {
    let machine = floating_ring();
    let found = equilibrium(&machine, &[Some(700.0), None], None).expect("is there");
    assert!(found.left <= 1.0 && found.iterations < 60, "{found:?}");
    assert!((100.0..600.0).contains(&found.bodies[1].speed), "{found:?}");
}

/// A disc of 10 kg in dead-band springs.
fn in_clearance(weight: f64) -> Machine {
    let law = LAWS.iter().find(|law| law.origin.name == "hu2003-linear").expect("is shipped");
    let body = RigidBody {
        along: false,
        rocks: false,
        mass: 10.0,
        polar_inertia: 0.1,
        transverse_inertia: Some(0.06),
        centre: [0.0; 3],
        stiffness: [0.0; 2],
        damping: [0.0; 2],
    };
    let own = body.turning(&[[0.0, 0.0, -0.1], [0.0, 0.0, 0.1], [0.0; 3]]);
    let loads = vec![load(&own.nodes[2], [-weight, 0.0, 0.0], Frame::Space)];
    let at = |name: &str, node: usize| Bearing {
        journal: [node; 3],
        // Wider than where the springs begin to act.
        ..bearing(name, [0, 1], Vec::new(), 1e-4)
    };
    Machine::new(MachineParts {
        bodies: vec![
            Body::turning("rotor", own, Rotation::Free),
            Body::standing("ground", Support::rigid(&[])),
        ],
        motion: MOTIONS.iter().find(|own| own.origin.name == "consistent").expect("is shipped"),
        clearance: &CLEARANCES[0],
        laws: vec![Box::new(law)],
        bearings: vec![at("left", 0), at("right", 1)],
        loads,
    })
    .expect("a machine")
}

#[test]
fn a_journal_falls_through_its_clearance_until_springs_carry_it() {
    let machine = in_clearance(500.0);
    let found = equilibrium(&machine, &[Some(300.0)], None).expect("is there");
    // Springs act where less than 233/6517 mm are left of 0.1 mm.
    let fallen = -found.bodies[0].position[0];
    assert!((6.4e-5..1.2e-4).contains(&fallen), "{found:?}");
    assert!(found.eccentricities.iter().all(|(_, ratio)| ratio.is_some_and(|own| own > 0.6)));
}

#[test]
fn what_nothing_holds_is_an_error() {
    match equilibrium(&in_clearance(0.0), &[Some(300.0)], None) {
        Err(Error::Floating { coordinates }) => {
            assert!(!coordinates.is_empty() && coordinates[0].contains("rotor"), "{coordinates:?}");
        }
        other => panic!("{other:?}"),
    }
}

/// Two motors on one shaft, the stronger of which turns it backwards.
#[test]
fn of_two_idle_speeds_the_larger_in_size_counts() {
    let mut machine = in_clearance(0.0);
    let size = machine.places()[0].flexible.len();
    for idle in [-3000.0, 100.0] {
        let rows = [[idle - 10.0, 1.0], [idle + 10.0, -1.0]];
        let curve = Curve::linear(&rows, false).expect("a curve").into();
        let (turn, couple) = (Matrix::zeros(3, size), [0.0, 0.0, 5.0]);
        let motor = TimeFunction::OverSpeed(curve);
        machine.loads.push(Load::couple(0, turn, couple, motor, Frame::Space));
    }
    assert_eq!(idle_speed(&machine, machine.places()[0].rotation.expect("turns")), Some(-3000.0));
}
