//! A floating ring between two films. Source of the speed ratio: torques of Petroff's films in balance.

use std::f64::consts::PI;

use num_dual::Dual64;
use whirl_solver::bearing::{Bearing, Sides};
use whirl_solver::dynamics::{March, equilibrium};
use whirl_solver::machine::{Body, Machine, MachineParts, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;
use whirl_specs::CLEARANCES;

use super::super::contacts::{Formula, laws};
use super::super::{motion, options};

/// R, L, c (m) and μ (Pa·s) of the films.
const INNER: [f64; 4] = [0.010, 0.008, 20e-6, 0.010];
const OUTER: [f64; 4] = [0.016, 0.012, 40e-6, 0.016];
const RING_INPUTS: &[&str] = &["e_x", "e_y", "e_x_dot", "e_y_dot", "omega"];

/// The short full film at small eccentricity, π μ R L³/c³ · (ė − ½ ω ẑ×e), with Petroff's torque and half the couple
/// of its force.
fn film([radius, length, c, mu]: [f64; 4], z: &[Dual64]) -> Vec<Dual64> {
    let [x, y, x_dot, y_dot, omega] = z else { panic!("five inputs") };
    let damping = PI * mu * radius * length.powi(3) / c.powi(3);
    let half = *omega * 0.5;
    let force_x = -(*x_dot + half * y) * damping;
    let force_y = -(*y_dot - half * x) * damping;
    let torque = -*omega * (2.0 * PI * mu * radius.powi(3) * length / c);
    vec![force_x, force_y, torque - (*x * force_y - *y * force_x) * 0.5]
}

pub(super) static INNER_FILM: Formula = Formula {
    name: "inner film",
    inputs: RING_INPUTS,
    outputs: &["F_x", "F_y", "M_z"],
    value: |z| film(INNER, z),
};
static OUTER_FILM: Formula =
    Formula { name: "outer film", value: |z| film(OUTER, z), ..INNER_FILM };

const SPEED: f64 = 3000.0;

/// A journal at given speed in a floating ring in a rigid housing, each held laterally by as many N/m.
fn machine([journal, ring]: [f64; 2], held: f64) -> Machine {
    let nodes = |radius: f64| {
        let mut nodes = vec![[0.0; 3]];
        let angles = (0..6).map(|k| PI * f64::from(k) / 3.0);
        nodes.extend(angles.map(|angle| [radius * angle.cos(), radius * angle.sin(), 0.0]));
        nodes
    };
    let body = |mass: f64, inertia: f64, radius: f64| Shaft {
        stiffness: whirl_solver::linalg::Matrix::from_diagonal(&[held; 2]),
        ..super::rigid(mass, inertia, &nodes(radius))
    };
    let driven = Rotation::Prescribed { speed: SPEED, acceleration: 0.0 };
    let bearing =
        |law: usize, bodies: [usize; 2], bore: Vec<usize>, [radius, _, c, _]: [f64; 4]| Bearing {
            others: Vec::new(),
            name: format!("film {law}"),
            label: None,
            sides: Sides { bodies, ..Sides::default() },
            journal: [0; 3],
            bore: [Vec::new(), bore, Vec::new()],
            clearance: c,
            journal_radius: Some(radius),
            stations: vec![0.5],
            angles: Vec::new(),
            law,
        };
    Machine::new(MachineParts {
        bodies: vec![
            Body::turning("journal", body(journal, 1e-5, INNER[0]), driven),
            Body::turning("ring", body(ring, 4e-6, INNER[0] + INNER[2]), Rotation::Free),
            Body::standing("housing", Support::rigid(&[])),
        ],
        motion: motion("consistent"),
        clearance: &CLEARANCES[0],
        laws: laws(&[&INNER_FILM, &OUTER_FILM]),
        bearings: vec![
            bearing(0, [0, 1], (1..7).collect(), INNER),
            bearing(1, [1, 2], Vec::new(), OUTER),
        ],
        loads: Vec::new(),
    })
    .expect("a machine")
}

/// ω_r/ω_s = 1/(1 + (μ_o/μ_i)(L_o/L_i)(R_o/R_i)³(c_i/c_o)).
fn ratio() -> f64 {
    let part = |k: usize| OUTER[k] / INNER[k];
    1.0 / (1.0 + part(3) * part(1) * part(0).powi(3) / part(2))
}

#[test]
fn a_ring_that_is_held_centred_turns_at_the_ratio_of_its_torques() {
    let machine = machine([0.1, 0.05], 1e9);
    let mut march = March::new(&machine, &options(1e-4, 4000)).expect("starts");
    while !march.is_done() {
        march.advance().expect("the step converges");
    }
    let theta = machine.places()[1].rotation.expect("the ring turns");
    let found = march.state().v[theta] / SPEED;
    assert!((found / ratio() - 1.0).abs() < 1e-6, "{found} for {}", ratio());
}

#[test]
fn a_centred_ring_in_equilibrium_turns_at_the_ratio_of_its_torques() {
    let found = equilibrium(&machine([0.1, 0.05], 1e9), &[], None).expect("is there");
    let speed = found.bodies[1].speed / SPEED;
    assert!((speed / ratio() - 1.0).abs() < 1e-9, "{speed} for {}", ratio());
}

/// Angle of an eccentricity in space at the end of each step.
fn whirls(march: &mut March, machine: &Machine, steps: usize) -> [f64; 2] {
    let mut before = [0.0_f64; 2];
    let mut sums = [0.0; 2];
    for step in 0..steps {
        march.advance().expect("the step converges");
        let q = &march.state().q;
        let at = |body: usize| {
            let place = &machine.places()[body];
            let theta = q[place.rotation.expect("it turns")];
            let [x, y] = [q[place.flexible.start], q[place.flexible.start + 1]];
            [theta.cos() * x - theta.sin() * y, theta.sin() * x + theta.cos() * y]
        };
        let (journal, ring) = (at(0), at(1));
        let angles = [(journal[1] - ring[1]).atan2(journal[0] - ring[0]), ring[1].atan2(ring[0])];
        for (k, angle) in angles.into_iter().enumerate() {
            if step > 0 {
                let moved = angle - before[k];
                sums[k] += moved - 2.0 * PI * (moved / (2.0 * PI)).round();
            }
            before[k] = angle;
        }
    }
    sums
}

/// Films without load carry nothing: the journal whirls in the ring at the mean of both speeds, the ring at half its
/// own.
#[test]
fn films_without_load_whirl_at_the_mean_of_the_speeds_of_their_sides() {
    let machine = machine([1e-3, 5e-4], 0.0);
    let mut options = options(1e-5, 6000);
    let turning = ratio() * SPEED;
    options.initial = vec![Default::default(); 2];
    options.initial[0].position = vec![4e-6, 1e-6];
    options.initial[1].position = vec![2e-6, -1e-6];
    options.initial[1].speed = turning;
    let mut march = March::new(&machine, &options).expect("starts");
    // What is left of how it began dies within a few steps.
    whirls(&mut march, &machine, 200);
    let steps = 1000;
    let rates = whirls(&mut march, &machine, steps).map(|sum| sum / ((steps - 1) as f64 * 1e-5));
    let exact = [0.5 * (SPEED + turning), 0.5 * turning];
    for (found, exact) in rates.into_iter().zip(exact) {
        assert!((found / exact - 1.0).abs() < 0.05, "{found} for {exact} rad/s");
    }
}
