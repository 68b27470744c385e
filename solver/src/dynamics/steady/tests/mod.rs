//! The paper's rule, and what both rules have in common.

use super::samples::{LEAST_SAMPLES, MOST_NUMBERS, MOST_SAMPLES};
use super::*;

mod remaining;

fn reached(force: impl Fn(f64) -> f64) -> Option<f64> {
    reached_in_steps(0.013, force)
}

fn reached_in_steps(dt: f64, force: impl Fn(f64) -> f64) -> Option<f64> {
    let mut test = SteadyTest::new(SteadyRule::OneCycle, [2, 0], 1.0, dt);
    let memory = test.samples.memory();
    for step in 1..(26.0 / dt) as usize {
        let t = step as f64 * dt;
        test.add(t, [force(t), 100.0].iter());
    }
    assert!(memory <= 2 * (MOST_SAMPLES + 3) && test.samples.memory() == memory, "{memory}");
    test.reached.map(|steady| steady.time)
}

#[test]
fn cycles_of_many_steps_are_tested_alike_in_bounded_memory() {
    let wave = |t: f64| 50.0 + 10.0 * (std::f64::consts::TAU * t).sin() + 20.0 * (-t).exp();
    let (step, steps) = (1e-3, 1e-5);
    let coarse = reached_in_steps(step, wave).expect("steady at last");
    let fine = reached_in_steps(steps, wave).expect("steady at last");
    // The change of 20 (e − 1) e^−t, at its limit, is off by the interpolation between 4096 samples, the
    // time by a step of either.
    assert!((fine - coarse).abs() < 2.0 * step, "{fine} {coarse}");
}

#[test]
fn no_cycle_is_too_long_for_the_memory() {
    for (springs, cycle) in [(1, 1e9), (10_000, 1e9), (50_000, 1.0), (3, f64::MAX)] {
        let samples = Samples::new([springs, 0], cycle, 1e-9);
        assert!(samples.capacity <= MOST_SAMPLES + 3, "{springs} {cycle}");
        let most = MOST_NUMBERS.max(LEAST_SAMPLES * springs);
        assert!(samples.capacity * springs <= most + 3 * springs, "{springs} {cycle}");
    }
}

#[test]
fn a_decaying_transient_ends_when_a_cycle_changes_it_by_one_per_cent() {
    let wave = |t: f64| 50.0 + 10.0 * (std::f64::consts::TAU * t).sin();
    let time = reached(|t| wave(t) + 20.0 * (-t).exp()).expect("steady at last");
    // The change over a cycle, 20 (e − 1) e^−t, falls below 1 % of the peak of 60 N at t = 4.05 s; then a
    // whole cycle must pass.
    assert!((4.9..5.2).contains(&time), "{time}");
}

#[test]
fn a_force_that_passes_through_zero_can_be_steady() {
    // Interpolation between steps leaves (2π 0.013)²/8 = 0.08 % of the peak.
    assert!(reached(|t| 50.0 * (std::f64::consts::TAU * t).sin()).is_some());
}

#[test]
fn forces_are_compared_between_steps() {
    // 40.5 steps a cycle: interpolated to (2π/40.5)²/8 = 0.3 %, where half a step off is 8 %.
    let wave = |t: f64| 50.0 * (std::f64::consts::TAU * t).sin();
    assert!(reached_in_steps(1.0 / 40.5, wave).is_some());
}

#[test]
fn forces_near_zero_are_held_against_the_floor() {
    assert!(reached(|t| 5e-3 * (40.0 * t).sin()).is_some());
    assert!(reached(|t| 5.0 * (40.0 * t).sin()).is_none());
}

/// When steady, and at the end; of a force of a constant 100 N and a displacement.
fn with_displacement(end: f64, displacement: impl Fn(f64) -> f64) -> Option<f64> {
    let mut test = SteadyTest::new(SteadyRule::OneCycle, [1, 1], 1.0, 0.013);
    for step in 1..(end / 0.013) as usize {
        let t = step as f64 * 0.013;
        test.add(t, [100.0, displacement(t)].iter());
    }
    test.reached.map(|steady| steady.time)
}

#[test]
fn displacements_are_steady_too_or_nothing_is() {
    let wave = |t: f64| 1e-3 * (std::f64::consts::TAU * t).sin();
    assert!(with_displacement(26.0, wave).is_some());
    // A resonance without damping, and a journal that creeps.
    assert_eq!(with_displacement(26.0, |t| t * wave(t)), None);
    assert_eq!(with_displacement(26.0, |t| 1e-3 * t), None);
}

#[test]
fn what_changes_again_was_not_steady() {
    let wave = |t: f64| 1e-3 * (std::f64::consts::TAU * t).sin();
    let early = with_displacement(10.0, wave).expect("steady");
    let late = with_displacement(26.0, |t| if t < 10.5 { wave(t) } else { 2.0 * wave(t) });
    assert!(early < 3.0 && late.is_some_and(|late| late > 11.0), "{early} {late:?}");
    // So slow a beat that no cycle differs by 1 % from the one before.
    let beat = |t: f64| wave(t) * (1.0 + 0.3 * (0.02 * t).sin());
    assert!(with_displacement(26.0, beat).is_none_or(|time| time > 20.0));
}
