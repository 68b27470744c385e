//! What stands in space stays there: marches from the equilibrium of round rotors with discs.

use whirl_specs::{CLEARANCES, LAWS, MOTIONS};

use super::equilibrium;
use super::tests::{bearing, load};
use crate::attached::Disc;
use crate::bearing::Bearing;
use crate::dynamics::{BodyStart, Integrator, March, MarchOptions, NewtonOptions, SteadyRule};
use crate::gravity::weights;
use crate::loads::Frame;
use crate::machine::{Body, Machine, MachineParts, Rotation};
use crate::roundness::tests::{LENGTH, Prism};
use crate::support::Support;

/// rad/s.
const SPEED: f64 = 628.0;
/// Steps a revolution, about.
const DT: f64 = 5e-5;

/// A shaft of eight sides with a thick disc at its end, in bushings at its other end and its middle, under its weight and a
/// force at the disc; damping of its own.
fn overhung(rotation: Rotation) -> Machine {
    let mut plain = Prism::solid(8).shaft();
    if rotation == Rotation::Free {
        // Its damping would slow it down.
        plain.damping.data.fill(0.0);
    }
    let mean = plain.measures[2].clone();
    let all: Vec<usize> = (0..mean.rotation.cols).collect();
    let (tilt, twist) = (mean.rotation.select(&[0, 1], &all), mean.rotation.select(&[2], &all));
    let mut shaft = plain.with_disc(&Disc {
        mass: 4.0,
        polar_inertia: 0.032,
        diametral_inertia: 0.016,
        z: LENGTH,
        displacement: &mean.displacement,
        tilt: &tilt,
        twist: Some(&twist.data),
    });
    shaft.nodes = shaft.measures.iter().map(|own| own.node_at([0.0, 0.0, own.centre[2]])).collect();
    let force = load(&shaft.nodes[2], [300.0, 100.0, 0.0], Frame::Space);
    let bodies = vec![
        Body::turning("rotor", shaft, rotation),
        Body::standing("ground", Support::rigid(&[])),
    ];
    let mut loads = weights(&bodies, [-9.81, 0.0, 0.0]);
    loads.push(force);
    let law = LAWS.iter().find(|law| law.origin.name == "bushing").expect("is shipped");
    let at = |name: &str, node: usize| Bearing {
        journal: [node; 3],
        journal_radius: None,
        ..bearing(name, [0, 1], Vec::new(), 0.0)
    };
    Machine::new(MachineParts {
        bodies,
        motion: MOTIONS.iter().find(|own| own.origin.name == "consistent").expect("is shipped"),
        clearance: &CLEARANCES[0],
        laws: vec![Box::new(law)],
        bearings: vec![at("near", 0), at("middle", 1)],
        loads,
    })
    .expect("a machine")
}

fn options(initial: Vec<BodyStart>, dt: f64, steps: usize) -> MarchOptions {
    MarchOptions {
        time_step: dt,
        automatic: None,
        steps,
        integrator: Integrator::default(),
        newton: NewtonOptions { force_tolerance: 1e-9, ..NewtonOptions::default() },
        cycle: None,
        steady_rule: SteadyRule::default(),
        stop_when_steady: false,
        initial,
        laws_at_rest: false,
    }
}

/// The largest way of the disc in space within some steps, over its deflection.
fn drift(machine: &Machine, initial: Vec<BodyStart>, dt: f64, steps: usize) -> f64 {
    let mut march = March::new(machine, &options(initial, dt, steps)).expect("starts");
    let place = &machine.places()[0];
    let node = &machine.bodies[0].nodes()[2];
    let at = |q: &[f64]| {
        let u = node.shapes.apply(&q[place.flexible.clone()]);
        let (sin, cos) = q[place.rotation.expect("it turns")].sin_cos();
        [cos * u[0] - sin * u[1], sin * u[0] + cos * u[1]]
    };
    let first = at(&march.state().q);
    let mut farthest = 0.0;
    while !march.is_done() {
        march.advance().expect("the step converges");
        let now = at(&march.state().q);
        farthest = f64::max(farthest, (now[0] - first[0]).hypot(now[1] - first[1]));
    }
    farthest / first[0].hypot(first[1])
}

/// The discrete motion itself stands still, with rates by the warped speed.
#[test]
fn a_disc_on_a_flexible_shaft_stays_where_it_starts() {
    let machine = overhung(Rotation::Prescribed { speed: SPEED, acceleration: 0.0 });
    let found = equilibrium(&machine, &[None], Some(DT)).expect("is there");
    let warped = drift(&machine, found.bodies, DT, 2000);
    println!("{warped:.1e} of the deflection in 10 revolutions");
    // Rounding of 2000 steps.
    assert!(warped < 1e-9, "{warped}");
}

/// With the rates of the continuous motion what is left is the error of the steps.
#[test]
fn without_the_step_the_drift_falls_by_its_square() {
    let machine = overhung(Rotation::Prescribed { speed: SPEED, acceleration: 0.0 });
    let found = equilibrium(&machine, &[None], None).expect("is there");
    let [long, short] = [1, 2].map(|parts| {
        drift(&machine, found.bodies.clone(), DT / f64::from(parts), 400 * parts as usize)
    });
    println!("{long:.2e}, {short:.2e}: {:.2}", long / short);
    assert!((3.5..4.5).contains(&(long / short)), "{long} {short}");
}

/// All rows of the machine, the inertia of what stands included, are in balance.
#[test]
fn accelerations_at_the_start_are_those_of_what_stands() {
    for rotation in [Rotation::Prescribed { speed: SPEED, acceleration: 0.0 }, Rotation::Free] {
        let machine = overhung(rotation);
        let found = equilibrium(&machine, &[Some(SPEED)], None).expect("is there");
        let own = &found.bodies[0];
        let shaft = machine.bodies[0].shaft().expect("it turns");
        let s = shaft.roundness().expect("round").generator;
        let exact = s.apply(&s.apply(&own.position)).into_iter().map(|x| SPEED * SPEED * x);
        let march = March::new(&machine, &options(found.bodies.clone(), DT, 1)).expect("starts");
        let place = machine.places()[0].flexible.clone();
        let apart: Vec<f64> =
            march.state().a[place].iter().zip(exact).map(|(own, exact)| own - exact).collect();
        // As forces, over the largest that acts.
        let left = shaft.mass.apply(&apart);
        let worst = left.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
        println!("{worst:.1e} N");
        assert!(worst < 1e-9 * 316.0, "{worst}");
    }
}
