//! What happens after the start: a machine in equilibrium stays there.

use whirl_solver::bearing::Bearing;
use whirl_solver::dynamics::{BodyStart, March, MarchOptions, equilibrium};
use whirl_solver::linalg::Matrix;
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::support::Support;

use super::super::{DISC, DISCS, boxed, discs, force, options, parts};
use super::short_film::load;
use super::{SPEED, film, ocvirk, tilting_rotor};

/// A flexible shaft of discs with damping of its own, under its weight and a force on the middle disc, in two films.
fn machine() -> Machine {
    let mut shaft = discs(2e6);
    shaft.damping =
        Matrix::from_fn(shaft.size(), shaft.size(), |i, j| 1e-5 * shaft.stiffness[(i, j)]);
    // It is a little wider at speed: a load that turns with it and moves the outer discs against the middle one.
    for (disc, share) in [(0, 1.0), (2, -2.0), (4, 1.0)] {
        shaft.y0[2 * disc] = share * 1e-6;
    }
    let mut parts = parts(shaft, Support::rigid(&[]), Rotation::Free);
    parts.laws = vec![boxed(ocvirk())];
    parts.bearings = vec![film("left", 0), Bearing { ..film("right", DISCS - 1) }];
    let nodes = parts.bodies[0].nodes();
    let weight = |disc: usize, more: f64| {
        force(&nodes[disc], [-9.81 * DISC - more, 0.0, 0.0], TimeFunction::Constant, Frame::Space)
    };
    parts.loads =
        (0..DISCS).map(|disc| weight(disc, if disc == 2 { 500.0 } else { 0.0 })).collect();
    Machine::new(parts).expect("a machine")
}

/// Largest change of a reaction within the first revolution (N).
fn drift(machine: &Machine, initial: Vec<BodyStart>) -> f64 {
    const STEPS: usize = 200;
    let dt = std::f64::consts::TAU / SPEED / STEPS as f64;
    let options = MarchOptions { initial, ..options(dt, STEPS) };
    let mut march = March::new(machine, &options).expect("starts");
    // RX and RY of both films.
    let mut ends = [[f64::INFINITY, f64::NEG_INFINITY]; 4];
    while !march.is_done() {
        march.advance().expect("the step converges");
        for (end, reaction) in ends.iter_mut().zip(&march.row()[3..7]) {
            *end = [end[0].min(*reaction), end[1].max(*reaction)];
        }
    }
    ends.iter().map(|[least, most]| most - least).fold(0.0, f64::max)
}

/// The speed falls a little by the friction of the films meanwhile.
#[test]
fn reactions_stay_where_a_machine_starts_in_equilibrium() {
    let machine = machine();
    let found = equilibrium(&machine, &[Some(SPEED)], None).expect("is there");
    let half = 0.5 * (500.0 + 9.81 * DISC * DISCS as f64);
    let own = drift(&machine, found.bodies) / half;
    let at_rest = BodyStart { speed: SPEED, ..BodyStart::default() };
    let rest = drift(&machine, vec![at_rest]) / half;
    println!("drift {:.3} % from equilibrium, {:.0} % from rest", 100.0 * own, 100.0 * rest);
    assert!(own < 0.01 && rest > 1.0, "{own} {rest}");
}

/// A load off the middle tilts the rotor. Y and H of a disc as thin as the last have nothing of its tilt, with that of the
/// others M and H would let the journals creep.
#[test]
fn a_rotor_that_stands_tilted_stays_so() {
    let total = 2.0 * load(0.6, SPEED);
    for transverse in [0.2, 0.015, 0.01] {
        let rotation = Rotation::Prescribed { speed: SPEED, acceleration: 0.0 };
        let machine = tilting_rotor([10.0, transverse], total, 0.06, rotation);
        let found = equilibrium(&machine, &[None], None).expect("is there");
        let own = drift(&machine, found.bodies) / (0.5 * total);
        println!("{transverse}: {own:.2e}");
        assert!(own < 1e-5, "{transverse}: {own}");
    }
}
