//! What a machine keeps, and what must not matter to it: action and reaction, the order of its bodies, which side is
//! called the journal, where x points.

use whirl_solver::bearing::{Bearing, Sides};
use whirl_solver::dynamics::{BodyStart, March, MarchOptions};
use whirl_solver::equations::{Equations, State};
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Body, Machine, MachineParts, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::CLEARANCES;

use super::super::contacts::{Formula, laws};
use super::super::{force, motion, options};
use super::{DAMPED, around, everything};

/// A film that takes the speed: F = −k(e) e − d (ė − ½ ω ẑ×e), with half the couple of its force on either side.
static FILM: Formula = Formula {
    name: "film",
    inputs: &["e_x", "e_y", "e_x_dot", "e_y_dot", "omega"],
    outputs: &["F_x", "F_y", "M_z"],
    value: |z| {
        let [x, y, x_dot, y_dot, omega] = z else { panic!("five inputs") };
        let stiff = (*x * *x + *y * *y) * 1e12 + 3e4;
        let half = *omega * 0.5;
        let force_x = -stiff * x - (*x_dot + half * y) * 60.0;
        let force_y = -stiff * y - (*y_dot - half * x) * 60.0;
        let torque = -*omega * 2e-4;
        vec![force_x, force_y, torque - (*x * force_y - *y * force_x) * 0.5]
    },
};

/// Rigid bodies with nodes at their centre and all around.
fn rigid(mass: f64, inertia: f64) -> Shaft {
    let mut nodes = vec![[0.0; 3]];
    nodes.extend(around(0.04));
    super::rigid(mass, inertia, &nodes)
}

fn bearing(law: usize, bodies: [usize; 2]) -> Bearing {
    Bearing {
        others: Vec::new(),
        name: "joint".to_owned(),
        label: None,
        sides: Sides { bodies, ..Sides::default() },
        journal: [0; 3],
        bore: [Vec::new(), (1..9).collect(), Vec::new()],
        clearance: 1e-3,
        journal_radius: Some(0.03),
        stations: vec![0.5],
        angles: (0..5).map(|j| 0.3 + std::f64::consts::TAU * f64::from(j) / 5.0).collect(),
        law,
    }
}

fn machine(bodies: Vec<Body>, bearings: Vec<Bearing>) -> MachineParts {
    MachineParts {
        bodies,
        motion: motion("consistent"),
        clearance: &CLEARANCES[0],
        laws: laws(&[&FILM, &DAMPED]),
        bearings,
        loads: Vec::new(),
    }
}

fn start(speed: f64, position: [f64; 2], velocity: [f64; 2]) -> BodyStart {
    BodyStart { angle: 0.0, speed, position: position.to_vec(), velocity: velocity.to_vec() }
}

/// Marches to the end.
fn end(machine: &Machine, options: &MarchOptions) -> State {
    let mut march = March::new(machine, options).expect("starts");
    while !march.is_done() {
        march.advance().expect("the step converges");
    }
    march.state().clone()
}

/// Displacement and velocity of the centre of a rigid body in space, its angle and its speed.
fn seen(machine: &Machine, state: &State, body: usize) -> [f64; 6] {
    let place = &machine.places()[body];
    let [theta, speed] = place.rotation.map_or([0.0; 2], |own| [state.q[own], state.v[own]]);
    let first = place.flexible.start;
    let unit = match &machine.bodies[body] {
        Body::Turning { .. } => 1.0,
        Body::Standing { support, .. } => support.nodes[0].shapes[(0, 0)],
    };
    let ([x, y], [u, v]) = (
        [unit * state.q[first], unit * state.q[first + 1]],
        [unit * state.v[first], unit * state.v[first + 1]],
    );
    let turn =
        |x: f64, y: f64| [theta.cos() * x - theta.sin() * y, theta.sin() * x + theta.cos() * y];
    let ([x, y], [u, v]) = (turn(x, y), turn(u - speed * y, v + speed * x));
    [x, y, u, v, theta, speed]
}

fn close(found: [f64; 6], exact: [f64; 6], scale: [f64; 3], share: f64, what: &str) {
    let sizes = [scale[0], scale[0], scale[1], scale[1], 1.0, scale[2]];
    for ((found, exact), size) in found.into_iter().zip(exact).zip(sizes) {
        assert!((found - exact).abs() < share * size, "{what}: {found} for {exact}");
    }
}

/// What a joint does to both of its bodies, as forces and as moments about one point of space: nothing in all.
#[test]
fn forces_of_a_joint_on_both_bodies_cancel() {
    let (offsets, apart) = ([[3e-5, -1e-5]; 3], [2e-4, -3e-4]);
    for law in [0, 1] {
        let joined = || {
            let own = bearing(law, [0, 1]);
            let sides = Sides { run_out: offsets, offset: offsets, apart, ..own.sides.clone() };
            vec![Bearing { sides, ..own }]
        };
        let bodies = || -> Vec<Body> {
            let body = |name| Body::turning(name, rigid(0.7, 1.3e-3), Rotation::Free);
            ["one", "other"].map(body).into()
        };
        let residual = |bearings: Vec<Bearing>, state: &State| {
            let machine = Machine::new(machine(bodies(), bearings)).expect("a machine");
            let mut equations = Equations::new(&machine);
            equations.evaluate(0.0, state);
            equations.residual().to_vec()
        };
        let mut state = State::new(6);
        state.q = vec![0.4, -1.1, 5e-5, -2e-5, 3e-5, 7e-5];
        state.v = vec![90.0, -30.0, 0.02, 0.05, -0.03, 0.04];
        let (with, without) = (residual(joined(), &state), residual(Vec::new(), &state));
        let forces: Vec<f64> = with.iter().zip(&without).map(|(a, b)| a - b).collect();
        // In space: force, moment about the own axis less that of the force, about the axis of the other.
        let mut sums = [0.0_f64; 3];
        for body in 0..2 {
            let (sin, cos) = state.q[body].sin_cos();
            let turn = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
            let force = turn([forces[2 + 2 * body], forces[3 + 2 * body]]);
            let axis = if body == 0 { apart } else { [0.0; 2] };
            sums[0] += force[0];
            sums[1] += force[1];
            sums[2] += forces[body] + axis[0] * force[1] - axis[1] * force[0];
        }
        let largest = forces[2..].iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        assert!(largest > 1.0, "{law}: {largest}");
        for (sum, size) in sums.into_iter().zip([1.0, 1.0, 1e-3]) {
            assert!(sum.abs() < 1e-10 * largest * size, "{law}: {sum} of {largest}");
        }
    }
}

/// The couple of a rotation that is prescribed does the work that films take.
#[test]
fn energy_balances_where_a_rotation_is_prescribed() {
    let (parts, options) = turned(0.3);
    let machine = Machine::new(parts).expect("a machine");
    let mut march = March::new(&machine, &options).expect("starts");
    while !march.is_done() {
        march.advance().expect("the step converges");
    }
    let energy = march.energy();
    assert!(energy.work_in.abs() > 1.0 && energy.spring_dissipated > 0.1, "{energy:?}");
    assert!(energy.error_fraction() < 1e-4, "{energy:?}: {}", energy.error_fraction());
}

/// Two free rotors that nothing but a film joins keep momentum and angular momentum but for what steps make of them.
#[test]
fn free_rotors_keep_their_momenta_as_the_step_shrinks() {
    let masses = [(0.7, 1.3e-3), (2.0, 4e-3)];
    let bodies = || {
        let body = |(mass, inertia)| Body::turning("body", rigid(mass, inertia), Rotation::Free);
        masses.map(body).into()
    };
    let mut options = options(4e-5, 2000);
    options.initial =
        vec![start(300.0, [5e-5, -2e-5], [0.02, 0.05]), start(-40.0, [0.0, 3e-5], [-0.01, 0.0])];
    let momenta = |machine: &Machine, state: &State| {
        let mut sums = [0.0; 3];
        for (body, (mass, inertia)) in masses.into_iter().enumerate() {
            let [x, y, u, v, _, speed] = seen(machine, state, body);
            sums[0] += mass * u;
            sums[1] += mass * v;
            sums[2] += inertia * speed + mass * (x * v - y * u);
        }
        sums
    };
    let drift = |steps: usize| {
        let machine = Machine::new(machine(bodies(), vec![bearing(0, [0, 1])])).expect("a machine");
        let options = MarchOptions { time_step: 0.08 / steps as f64, steps, ..options.clone() };
        let march = March::new(&machine, &options).expect("starts");
        let before = momenta(&machine, march.state());
        let after = momenta(&machine, &end(&machine, &options));
        let part = |k: usize| (after[k] - before[k]).abs();
        [part(0).hypot(part(1)) / 0.02, part(2) / before[2].abs()]
    };
    let (coarse, fine) = (drift(4000), drift(8000));
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert!(coarse < 1e-3, "{coarse}");
        assert!((3.5..4.5).contains(&(coarse / fine)), "{coarse} {fine}");
    }
}

#[test]
fn journal_and_bore_may_change_places() {
    let driven = Rotation::Prescribed { speed: 200.0, acceleration: -900.0 };
    let run = |bodies: [usize; 2]| {
        let own = vec![
            Body::turning("one", rigid(0.7, 1.3e-3), Rotation::Free),
            Body::turning("other", rigid(2.0, 4e-3), driven.clone()),
        ];
        let machine = Machine::new(machine(own, vec![bearing(0, bodies)])).expect("a machine");
        let mut options = options(2e-5, 1500);
        options.initial =
            vec![start(-50.0, [5e-5, -2e-5], [0.02, 0.05]), start(0.0, [0.0; 2], [0.0; 2])];
        let state = end(&machine, &options);
        [0, 1].map(|body| seen(&machine, &state, body))
    };
    for (swapped, exact) in run([1, 0]).into_iter().zip(run([0, 1])) {
        close(swapped, exact, [1e-4, 0.05, 100.0], 1e-8, "swapped");
    }
}

#[test]
fn a_body_that_stands_is_one_whose_rotation_is_held() {
    let (mass, stiffness, damping) = (3.0, [4e5, 7e5], [20.0, 30.0]);
    let mut nodes = vec![[0.0; 3]];
    nodes.extend(around(0.04));
    let standing = Body::standing("body", Support::lumped(mass, stiffness, damping, &nodes));
    let held = Shaft {
        stiffness: whirl_solver::linalg::Matrix::from_diagonal(&stiffness),
        damping: whirl_solver::linalg::Matrix::from_diagonal(&damping),
        ..rigid(mass, 1.0)
    };
    let held = Body::turning("body", held, Rotation::Held);
    let run = |body: Body| {
        let driven = Rotation::Prescribed { speed: 300.0, acceleration: 0.0 };
        let other = Body::turning("rotor", rigid(0.7, 1e-3), driven);
        let joints = vec![bearing(0, [1, 0]), bearing(1, [0, 1])];
        let machine = Machine::new(machine(vec![body, other], joints)).expect("a machine");
        let mut options = options(2e-5, 1500);
        options.initial = vec![BodyStart::default(), start(0.0, [8e-5, -2e-5], [0.02, 0.05])];
        let state = end(&machine, &options);
        [0, 1].map(|body| seen(&machine, &state, body))
    };
    for (held, exact) in run(held).into_iter().zip(run(standing)) {
        close(held, exact, [1e-4, 0.05, 100.0], 1e-8, "held");
    }
}

/// Displacements, offsets, axes, loads and springs turned by `by`.
fn turned(by: f64) -> (MachineParts, MarchOptions) {
    let turn = |[x, y]: [f64; 2]| [by.cos() * x - by.sin() * y, by.sin() * x + by.cos() * y];
    let driven = Rotation::Prescribed { speed: 150.0, acceleration: 400.0 };
    let bodies = vec![
        Body::turning("one", rigid(0.7, 1.3e-3), Rotation::Free),
        Body::turning("other", rigid(2.0, 4e-3), driven),
        Body::standing("ground", Support::rigid(&[])),
    ];
    let joint = |law: usize, bodies: [usize; 2], apart: [f64; 2]| {
        let own = bearing(law, bodies);
        let sides = Sides {
            apart: turn(apart),
            run_out: [turn([3e-5, -1e-5]); 3],
            offset: [turn([-2e-5, 4e-5]); 3],
            ..own.sides.clone()
        };
        let bore = if bodies[1] == 2 { Vec::new() } else { (1..9).collect() };
        let angles = own.angles.iter().map(|angle| angle + by).collect();
        Bearing { sides, angles, bore: [Vec::new(), bore, Vec::new()], ..own }
    };
    let bearings = vec![
        joint(0, [0, 1], [1e-4, 2e-4]),
        joint(1, [0, 2], [0.0; 2]),
        joint(1, [1, 2], [0.0, -1e-4]),
        joint(1, [0, 1], [1e-4, 2e-4]),
    ];
    let mut parts = machine(bodies, bearings);
    let [x, y] = turn([20.0, 5.0]);
    let node = parts.bodies[0].nodes()[0].clone();
    parts.loads = vec![force(&node, [x, y, 0.0], TimeFunction::Constant, Frame::Space)];
    let mut options = options(2e-5, 1500);
    options.initial = vec![
        start(-50.0, turn([5e-5, -2e-5]), turn([0.02, 0.05])),
        start(0.0, turn([0.0, 1e-5]), turn([0.0, 0.01])),
    ];
    (parts, options)
}

#[test]
fn a_machine_that_is_turned_moves_as_before_and_turned() {
    let run = |by: f64| {
        let (parts, options) = turned(by);
        let machine = Machine::new(parts).expect("a machine");
        let state = end(&machine, &options);
        [0, 1].map(|body| seen(&machine, &state, body))
    };
    let by = 1.1_f64;
    for (turned, [x, y, u, v, theta, speed]) in run(by).into_iter().zip(run(0.0)) {
        let turn = |x: f64, y: f64| [by.cos() * x - by.sin() * y, by.sin() * x + by.cos() * y];
        let ([x, y], [u, v]) = (turn(x, y), turn(u, v));
        close(turned, [x, y, u, v, theta, speed], [1e-4, 0.05, 100.0], 1e-7, "turned");
    }
}

/// The machine of everything, its bodies in another order.
#[test]
fn the_order_of_bodies_does_not_matter() {
    let order = [3, 1, 4, 0, 2];
    let place_of = |body: usize| order.iter().position(|own| *own == body).expect("a body");
    let mut options = options(2e-5, 300);
    options.initial =
        (0..5).map(|body| start(10.0 * body as f64, [1e-5, 3e-5], [0.01, 0.0])).collect();
    let exact = Machine::new(everything()).expect("a machine");
    let state = end(&exact, &options);
    let mut parts = everything();
    let bodies = std::mem::take(&mut parts.bodies);
    parts.bodies = order.iter().map(|&body| bodies[body].clone()).collect();
    for own in &mut parts.bearings {
        own.sides.bodies = own.sides.bodies.map(place_of);
    }
    parts.loads.iter_mut().for_each(|load| load.body = place_of(load.body));
    let initial = order.iter().map(|&body| options.initial[body].clone()).collect();
    let other = Machine::new(parts).expect("a machine");
    let found = end(&other, &MarchOptions { initial, ..options });
    for body in 0..5 {
        let [own, known] = [&other.places()[place_of(body)], &exact.places()[body]];
        let angle = own.rotation.zip(known.rotation).map(|pair| (pair, 1.0));
        let rest = own.flexible.clone().zip(known.flexible.clone()).map(|pair| (pair, 1e-4));
        for ((own, known), size) in angle.into_iter().chain(rest) {
            let (found, exact) = (found.q[own], state.q[known]);
            assert!((found - exact).abs() < 1e-8 * size, "{body}: {found} for {exact}");
        }
    }
}
