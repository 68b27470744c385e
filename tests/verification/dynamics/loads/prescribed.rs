//! Rotations that are told over time, and the couples that they take.

use std::sync::Arc;

use whirl_solver::bearing::Bearing;
use whirl_solver::dynamics::{March, MarchOptions, NewtonOptions};
use whirl_solver::history::History;
use whirl_solver::loads::{Frame, Load, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::schedule::Schedule;

use super::rigid_turn;
use crate::dynamics::{FILM, bearing, bores, boxed, discs, force, options, parts};

const TORQUE: f64 = 17.0;

/// A shaft in films under a load that turns with it and one fixed in space, driven by a couple or as told.
fn machine(rotation: Rotation) -> Machine {
    let driven = matches!(rotation, Rotation::Free);
    let mut parts = parts(discs(1e6), bores(), rotation);
    parts.laws = vec![boxed(&FILM)];
    parts.bearings = vec![Bearing { clearance: 5e-4, ..bearing(0) }];
    let node = |place: usize| parts.bodies[0].nodes()[place].clone();
    parts.loads = vec![
        force(&node(2), [60.0, 20.0, 0.0], TimeFunction::Constant, Frame::Space),
        force(&node(1), [0.0, 30.0, 0.0], TimeFunction::Constant, Frame::Body),
    ];
    if driven {
        let couple = [0.0, 0.0, TORQUE];
        let constant = TimeFunction::Constant;
        parts.loads.push(Load::couple(0, rigid_turn(), couple, constant, Frame::Body));
    }
    Machine::new(parts).expect("a machine")
}

#[test]
fn a_free_run_that_is_told_again_is_the_same_and_takes_the_same_couple() {
    let free = machine(Rotation::Free);
    let options = MarchOptions {
        newton: NewtonOptions {
            force_tolerance: 1e-9,
            residual_tolerance: 1e-12,
            ..NewtonOptions::default()
        },
        ..options(1e-4, 1000)
    };
    let mut march = March::new(&free, &options).expect("starts");
    let (mut rows, mut states) = (Vec::new(), Vec::new());
    for step in 0..=options.steps {
        let state = march.state();
        rows.push([step as f64 * options.time_step, state.q[0], state.v[0], state.a[0]]);
        states.push(state.clone());
        if step < options.steps {
            march.advance().expect("the step converges");
        }
    }
    let schedule = Schedule::of_motion(&rows).expect("rows");
    let told = machine(Rotation::Scheduled(Arc::new(schedule)));
    let mut march = March::new(&told, &options).expect("starts");
    let names = History::for_machine(&told).names().to_vec();
    let couple = names.iter().position(|name| name == "M_shaft_Nm").expect("a column");
    let largest = |of: &dyn Fn(usize) -> f64| (0..states[0].q.len()).map(of).fold(0.0, f64::max);
    let size = states.iter().map(|own| largest(&|i| if i == 0 { 0.0 } else { own.q[i].abs() }));
    let size = size.fold(0.0, f64::max);
    let (mut worst, mut off) = (0.0_f64, 0.0_f64);
    for own in &states[1..] {
        march.advance().expect("the step converges");
        let state = march.state();
        worst = worst.max(largest(&|i| (state.q[i] - own.q[i]).abs()) / size);
        off = off.max((march.row()[couple] / TORQUE - 1.0).abs());
    }
    println!("told again: motion to {worst:e}, couple to {off:e}");
    assert!(worst < 1e-9 && off < 1e-6, "motion {worst:e}, couple {off:e}");
    // The work of that couple is counted as the work of the loads is.
    let energy = march.energy();
    assert!(energy.error_fraction() < 1e-3, "{energy:?}");
}

#[test]
fn speeds_in_a_table_are_kept_and_columns_have_their_couples() {
    let rows = [[0.0, 0.0], [0.02, 50.0], [0.05, 20.0]];
    let schedule = Schedule::of_speeds(&rows).expect("rows");
    let machine = machine(Rotation::Scheduled(Arc::new(schedule)));
    let mut march = March::new(&machine, &options(1e-4, 500)).expect("starts");
    while !march.is_done() {
        march.advance().expect("the step converges");
    }
    let [_, theta, omega, ..] = march.row()[..] else { panic!("columns") };
    assert!((theta - (0.5 + 1.05)).abs() < 1e-12 && (omega - 20.0).abs() < 1e-9);
}
