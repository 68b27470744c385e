//! The average acceleration in N equal steps is harmonic balance at N instants, with rates of its own: q̇_k = iω̃_k q_k,
//! ω̃_k = (2/Δt) tan(πk/N), of bodies in their own frames.

use std::f64::consts::TAU;
use std::ops::ControlFlow;

use whirl_specs::{CLEARANCES, LAWS, MOTIONS};

use super::balance::Balance;
use super::series::{Series, resized};
use super::solve::{Equilibrating, Motion};
use super::{balanced, beginning};
use crate::bearing::{Bearing, Sides};
use crate::dynamics::{BodyStart, NewtonOptions};
use crate::gravity::weights;
use crate::machine::{Body, Machine, MachineParts, Rotation};
use crate::periodic::in_space::InSpace;
use crate::periodic::metric::Metric;
use crate::periodic::{Cycle, CycleMap, CycleProgress, Method, PeriodicOptions, periodic};
use crate::roundness::tests::Prism;
use crate::support::Support;

/// rad/s.
const SPEED: f64 = 700.0;

/// A shaft of eight sides under its weight, in two rings of springs that push beyond their clearance.
fn machine() -> Machine {
    let mut shaft = Prism::solid(8).shaft();
    shaft.nodes = shaft.measures.iter().map(|own| own.node_at([0.0, 0.0, own.centre[2]])).collect();
    let rotation = Rotation::Prescribed { speed: SPEED, acceleration: 0.0 };
    let bodies = vec![
        Body::turning("rotor", shaft, rotation),
        Body::standing("ground", Support::rigid(&[])),
    ];
    let loads = weights(&bodies, [-9.81, 0.0, 0.0]);
    let law = LAWS.iter().find(|law| law.origin.name == "hu2003-nonlinear").expect("is shipped");
    let at = |name: &str, node: usize| Bearing {
        others: Vec::new(),
        name: name.to_owned(),
        label: None,
        sides: Sides { bodies: [0, 1], ..Sides::default() },
        journal: [node; 3],
        bore: [Vec::new(), Vec::new(), Vec::new()],
        clearance: 20e-6,
        journal_radius: None,
        stations: vec![0.5],
        angles: (0..24).map(|k| TAU * f64::from(k) / 24.0).collect(),
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

fn goes_on(_: &CycleProgress) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

fn start(machine: &Machine) -> Vec<BodyStart> {
    machine.bodies.iter().map(|_| BodyStart::default()).collect()
}

#[test]
fn steps_are_harmonics_with_rates_of_their_own() {
    let machine = machine();
    let cycle = Cycle { start: 0.0, period: TAU / SPEED, steps: 31 };
    let options = PeriodicOptions { judged: false, ..PeriodicOptions::of(cycle) };
    let found = periodic(&machine, &options, &start(&machine), &mut goes_on).expect("a motion");
    let mut map = CycleMap::new(&machine, cycle, NewtonOptions::default()).expect("a cycle");
    let x = map.beginning(&start(&machine), false);
    let metric = Metric::new(&mut map, &x).expect("a metric");
    let own = InSpace::none();
    let from = resized(&beginning(&mut map, &options, &x, &own).expect("a beginning"), 15);
    let mut balance = Balance::new(&machine, cycle, (map.speeds(), own));
    let series = |period: f64, harmonics: usize, _: usize| Series::of_steps(period, harmonics, 31);
    let mut equilibrating =
        Equilibrating { balance: &mut balance, metric: &metric, series, reference: None };
    let from = Motion { coefficients: from, period: cycle.period };
    let solved = equilibrating.solve(from, (1e-12, 0), &mut goes_on).expect("no interruption");
    let series = series(cycle.period, 15, 31);
    let [q, v, _] = series.sampled(&solved.expect("a motion").motion.coefficients);
    let state = [q.col(0), v.col(0)].concat();
    let [own, marched] = [&state, &found.state].map(|own| metric.weighed(own));
    let size = marched.iter().map(|x| x * x).sum::<f64>().sqrt();
    let apart = own.iter().zip(&marched).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    // What shooting leaves, and the rounding of accelerations.
    assert!(apart < 1e-9 * size, "{:e}", apart / size);
    // Springs begin and end to push, so that most harmonics take part.
    let far = series.coefficients(&q).col(20).iter().fold(0.0_f64, |most, own| most.max(own.abs()));
    assert!(far > 0.0);
}

/// Steps that halve approach the harmonics to second order, whatever the way in which corrections are found.
#[test]
fn the_march_approaches_the_harmonics() {
    let machine = machine();
    let with = |steps: usize, method: Method| {
        let cycle = Cycle { start: 0.0, period: TAU / SPEED, steps };
        let usual = PeriodicOptions::of(cycle);
        let options = PeriodicOptions { method: Some(method), judged: false, ..usual };
        periodic(&machine, &options, &start(&machine), &mut goes_on).expect("a motion")
    };
    let exact = with(96, Method::Harmonic);
    let harmonics = exact.harmonics.expect("harmonics");
    assert_eq!((harmonics.count, harmonics.instants), (21, 168));
    let mut map = CycleMap::new(&machine, exact.cycle, NewtonOptions::default()).expect("a cycle");
    let metric = Metric::new(&mut map, &exact.state).expect("a metric");
    let apart = [96, 192, 384].map(|steps| {
        let own = with(steps, Method::Shooting).state;
        let [own, exact] = [&own, &exact.state].map(|own| metric.weighed(own));
        let size = exact.iter().map(|x| x * x).sum::<f64>().sqrt();
        own.iter().zip(&exact).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt() / size
    });
    let ratios = [apart[0] / apart[1], apart[1] / apart[2]];
    assert!(ratios.iter().all(|own| (3.0..5.0).contains(own)), "{apart:?}");
    // Twice as many harmonics are the same motion.
    let options =
        PeriodicOptions { harmonics: Some(42), judged: false, ..PeriodicOptions::of(exact.cycle) };
    let more = balanced(&mut map, &options, &exact.state, &mut goes_on).expect("a motion");
    let [own, more] = [&exact.state, &more.state].map(|own| metric.weighed(own));
    let change = own.iter().zip(&more).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(change < 1e-3 * own.iter().fold(0.0_f64, |most, own| most.max(own.abs())), "{change}");
}
