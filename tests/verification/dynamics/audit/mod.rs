//! Every step that is accepted solves its equations, by an evaluation that shares nothing with the solver's;
//! and a mass between stops follows its closed form.

mod evaluation;
pub(super) mod stop;

use std::f64::consts::{PI, TAU};

use num_dual::{Dual64, DualNum};
use whirl_solver::bearing::Bearing;
use whirl_solver::dynamics::{Integrator, March, MarchOptions, NewtonOptions};
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Machine, MachineParts, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::contacts::Formula;
use super::{bearing, bores, discs, force, options, parts, stops, wild};
use crate::small_shaft;
pub(super) use evaluation::{Direct, without_bearings, worst_row};
use evaluation::{LawInputs, rows};

/// Steps in which no force may be missing at a spring.
pub(super) fn strict(time_step: f64, steps: usize) -> MarchOptions {
    let newton = NewtonOptions { force_tolerance: 0.0, ..NewtonOptions::default() };
    MarchOptions { newton, ..options(time_step, steps) }
}

/// Marches by Newmark's method and by generalized-α, which also balances what acts at the end of a step, and audits every
/// step; how many steps of both were halved.
pub(super) fn audit(
    name: &str,
    parts: MachineParts,
    laws: &[&Direct],
    options: &MarchOptions,
) -> usize {
    let bearings = parts.bearings.clone();
    let machine = Machine::new(parts).expect("a machine");
    let pairs: Vec<(&Bearing, &Direct)> =
        bearings.iter().map(|bearing| (bearing, laws[bearing.law])).collect();
    let both = [options.integrator, Integrator::generalized_alpha(0.8)];
    let halved = both.map(|integrator| {
        let options = MarchOptions { integrator, ..options.clone() };
        let mut march = March::new(&machine, &options).expect("starts");
        let mut before = rows(&machine, &pairs, 0.0, march.state());
        for step in 1..=options.steps {
            if let Err(error) = march.advance() {
                // A step that cannot be solved is reported, not accepted.
                panic!("{name}, {integrator:?}: {error}");
            }
            let t = step as f64 * options.time_step;
            let after = rows(&machine, &pairs, t, march.state());
            let worst = worst_row(&before, &after, machine.first_unknown());
            assert!(
                worst <= 1.0,
                "{name}, {integrator:?}, step {step}: a row is {worst} times what it may be"
            );
            before = after;
        }
        march.outcome().halved_steps
    });
    halved.iter().sum()
}

/// A linear stop of 1 N/m behind the gap, to be scaled; one that is Hertz-like; a film; dry friction; a ring.
pub(super) struct Pair {
    pub(super) law: &'static Formula,
    pub(super) direct: Direct,
}

macro_rules! springs_of {
    ($name:ident, $stiffness:expr) => {
        pub(in super::super) static $name: Formula = Formula {
            name: stringify!($name),
            inputs: &["h"],
            outputs: &["Q"],
            value: |z| vec![if z[0].re < 0.0 { z[0] * -$stiffness } else { Dual64::from_re(0.0) }],
        };
    };
}
springs_of!(SOFT, 1e3);
springs_of!(MIDDLE, 1e6);
springs_of!(STIFF, 1e9);

static HERTZ: Formula = Formula {
    name: "hertz",
    inputs: &["h", "h_dot"],
    outputs: &["Q"],
    value: |z| {
        let depth = -z[0];
        if depth.re <= 0.0 {
            return vec![Dual64::from_re(0.0)];
        }
        vec![depth * depth.sqrt() * 1e8 * (z[1] * -0.3 + 1.0)]
    },
};

static RUB: Formula = Formula {
    name: "rub",
    inputs: &["h", "v_t"],
    outputs: &["Q", "T"],
    value: |z| {
        let depth = -z[0];
        if depth.re <= 0.0 {
            return vec![Dual64::from_re(0.0); 2];
        }
        let q = depth * 2e6;
        vec![q, q * (z[1] / 0.05).tanh() * -0.3]
    },
};

static RING: Formula = Formula {
    name: "ring",
    inputs: &["e_x", "e_y", "e_x_dot", "e_y_dot", "omega"],
    outputs: &["F_x", "F_y", "M_z"],
    value: |z| {
        let [x, y, x_dot, y_dot, omega] = z else { panic!("five inputs") };
        let stiff = (*x * *x + *y * *y) * 1e6 * 2e5 + 2e5;
        let cross = *omega * 30.0;
        vec![
            -stiff * x - cross * y - *x_dot * 40.0,
            -stiff * y + cross * x - *y_dot * 40.0,
            *omega * -1e-2,
        ]
    },
};

fn linear(inputs: &LawInputs, stiffness: f64) -> [f64; 2] {
    [if inputs.h < 0.0 { -stiffness * inputs.h } else { 0.0 }, 0.0]
}

static PAIRS: [Pair; 6] = [
    Pair { law: &SOFT, direct: Direct::Spring(|inputs| linear(inputs, 1e3)) },
    Pair { law: &MIDDLE, direct: Direct::Spring(|inputs| linear(inputs, 1e6)) },
    Pair { law: &STIFF, direct: Direct::Spring(|inputs| linear(inputs, 1e9)) },
    Pair {
        law: &HERTZ,
        direct: Direct::Spring(|inputs| {
            let depth = f64::max(-inputs.h, 0.0);
            [1e8 * depth * depth.sqrt() * (1.0 - 0.3 * inputs.h_dot), 0.0]
        }),
    },
    Pair {
        law: &RUB,
        direct: Direct::Spring(|inputs| {
            let q = 2e6 * f64::max(-inputs.h, 0.0);
            [q, -0.3 * q * (inputs.slip / 0.05).tanh()]
        }),
    },
    Pair {
        law: &RING,
        direct: Direct::Ring(|inputs| {
            let ([x, y], [x_dot, y_dot]) = (inputs.e, inputs.e_dot);
            let stiff = 2e5 + 2e11 * (x * x + y * y);
            let cross = 30.0 * inputs.omega;
            [
                -stiff * x - cross * y - 40.0 * x_dot,
                -stiff * y + cross * x - 40.0 * y_dot,
                -1e-2 * inputs.omega,
            ]
        }),
    },
];

/// All laws with their closed forms.
pub(super) fn pairs() -> &'static [Pair] {
    &PAIRS
}

/// Point masses between stops, Δt√(k/m) from 0.01 to 100, thrown, pushed, and shaken.
#[test]
fn every_step_of_a_mass_between_stops_is_solved() {
    let mut halved = 0;
    for seed in 0..60 {
        let mut random = wild(100 + seed);
        let mut unit = || 0.5 * (1.0 + random());
        let mass = 10.0_f64.powf(4.0 * unit() - 2.0);
        // Linear stops and the rate-dependent one, whose stiffness is of the order of 1e6 N/m here.
        let place = (4.0 * unit()) as usize;
        let stiffness = [1e3, 1e6, 1e9, 1e6][place];
        let ratio = 10.0_f64.powf(4.0 * unit() - 2.0);
        let time_step = ratio * f64::sqrt(mass / stiffness);
        let gap = 10.0_f64.powf(4.0 * unit() - 5.0);
        let ground = if unit() < 0.5 { 0.0 } else { stiffness * 1e-4 * unit() };
        let shaft = Shaft::lumped(mass, [ground; 2], [ground * time_step * unit(); 2], 0.0);
        let mut parts = parts(shaft, Support::rigid(&[]), Rotation::Held);
        parts.laws = vec![Box::new(PAIRS[place].law)];
        parts.bearings =
            vec![stops("above", gap, &[0.0], 0), stops("below", 0.7 * gap, &[PI, 0.5 * PI], 0)];
        // As fast as to cross the gap in a few steps, or to fly for many.
        let speed = gap / time_step * 10.0_f64.powf(2.0 * unit() - 1.5);
        let weight = mass * speed / time_step * 1e-2 * unit();
        let node = &parts.bodies[0].nodes()[0];
        let shake = TimeFunction::Sine { frequency: 0.02 / time_step, phase: unit() };
        parts.loads = vec![
            force(node, [-weight, 0.0, 0.0], TimeFunction::Constant, Frame::Space),
            force(node, [weight * unit(), weight, 0.0], shake, Frame::Space),
        ];
        let mut options = strict(time_step, 400);
        [options.initial[0].position, options.initial[0].velocity] =
            [vec![0.0; 2], vec![-speed, speed * unit()]];
        let name = format!("mass {seed}: Δt√(k/m) = {ratio:.3}, law {}", PAIRS[place].law.name);
        halved += audit(&name, parts, &[&PAIRS[place].direct], &options);
    }
    assert!(halved > 0, "some steps cannot be solved in one");
}

/// A spinning line of discs in a bore that moves as one mass, with every kind of law.
#[test]
fn every_step_of_discs_in_a_moving_bore_is_solved() {
    let positions: Vec<[f64; 3]> = bores().nodes.iter().map(|node| node.position).collect();
    for (place, pair) in PAIRS.iter().enumerate().filter(|(place, _)| *place != 2) {
        for seed in 0..4 {
            let mut random = wild(7 + seed);
            let mut unit = || 0.5 * (1.0 + random());
            let support = Support::lumped(
                1.0 + 5.0 * unit(),
                [1e5 * unit(), 1e5 * unit()],
                [50.0 * unit(), 20.0],
                &positions,
            );
            let mut parts = parts(discs(1e5), support, Rotation::Free);
            parts.laws = vec![Box::new(pair.law)];
            let radius = Some(0.03);
            parts.bearings =
                vec![Bearing { clearance: 1e-4, journal_radius: radius, ..bearing(0) }];
            let sine = TimeFunction::Sine { frequency: 40.0 + 100.0 * unit(), phase: unit() };
            let node = |k: usize| &parts.bodies[0].nodes()[k];
            parts.loads = vec![
                force(node(2), [300.0 * unit(), -130.0, 0.0], sine, Frame::Space),
                force(node(0), [5.0, 20.0 * unit(), 0.0], TimeFunction::Constant, Frame::Body),
                force(node(3), [-200.0, 0.0, 0.0], TimeFunction::Constant, Frame::Space),
            ];
            let mut options = strict(10.0_f64.powf(-3.0 - 1.5 * unit()), 300);
            options.initial[0].speed = 300.0 * unit();
            let name = format!("discs, law {place}, {seed}");
            audit(&name, parts, &[&pair.direct], &options);
        }
    }
}

/// A meshed shaft, free but for its bearings, spun and struck.
#[test]
fn every_step_of_a_meshed_shaft_is_solved() {
    let shaft = small_shaft::shaft(&small_shaft::mesh());
    for (place, time_step) in [(1, 2e-5), (3, 1e-4), (4, 5e-5), (5, 5e-5)] {
        let pair = &PAIRS[place];
        let shaft = shaft.clone();
        let node = |k: usize| shaft.nodes[k].clone();
        let pulse = TimeFunction::Sine { frequency: 120.0, phase: 0.2 };
        let loads = vec![
            force(&node(1), [2e3, -3e2, 0.0], pulse, Frame::Space),
            force(&node(4), [-1e3, 0.0, 0.0], TimeFunction::Constant, Frame::Space),
            force(&node(2), [0.0, 40.0, 0.0], TimeFunction::Constant, Frame::Body),
        ];
        let free = small_shaft::free(shaft, small_shaft::motion("consistent"));
        let rigid = [const { [Vec::new(), Vec::new(), Vec::new()] }; 2];
        let mut bearings = small_shaft::bearings(&small_shaft::ring(), rigid);
        bearings.iter_mut().for_each(|bearing| {
            (bearing.clearance, bearing.journal_radius) = (5e-5, Some(0.025));
        });
        let parts = MachineParts { laws: vec![Box::new(pair.law)], bearings, loads, ..free };
        let mut options = strict(time_step, 400);
        options.initial[0].speed = TAU * 50.0;
        let name = format!("meshed shaft, law {}", pair.law.name);
        audit(&name, parts, &[&pair.direct], &options);
    }
}
