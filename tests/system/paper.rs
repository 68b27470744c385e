//! What the paper says of its results, and what its extra term would do.

use whirl_tests::History;

use crate::run::{root, run, shipped};

const SUPPORTS: std::ops::RangeInclusive<usize> = 1..=4;
/// Period of the loads and of two revolutions, in s.
const CYCLE: f64 = 1.0 / 37.5;
const ROWS_OF_A_CYCLE: usize = 361;

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn peak(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| largest.max(value.abs()))
}

fn spread(values: &[f64]) -> f64 {
    let (low, high) = values.iter().fold((f64::MAX, f64::MIN), |(l, h), v| (l.min(*v), h.max(*v)));
    high - low
}

/// Mean over the last cycle of the sum of all reactions in one direction, N.
fn mean_sum(history: &History, direction: &str) -> f64 {
    SUPPORTS.map(|k| mean(history.tail(&format!("R{direction}{k}_N"), ROWS_OF_A_CYCLE))).sum()
}

#[test]
fn static_reactions_are_constant_symmetric_and_carry_the_loads() {
    let history = &shipped("hu2003-1").history;
    let last = |k: usize| *history.column(&format!("RX{k}_N")).last().expect("rows");
    let sum: f64 = SUPPORTS.map(last).sum();
    assert!((sum + 3000.0).abs() <= 0.01, "the X reactions sum to {sum} N");
    for (k, mirror) in [(1, 4), (2, 3)] {
        assert!((last(k) - last(mirror)).abs() <= 1e-3, "supports {k} and {mirror}");
    }
    for k in SUPPORTS {
        let tail = history.tail(&format!("RX{k}_N"), ROWS_OF_A_CYCLE);
        // What is left of the transient after 0.27 s of damping.
        assert!(spread(tail) <= 1e-3, "support {k} still moves by {} N", spread(tail));
    }
}

#[test]
fn without_rotation_there_is_no_lateral_force() {
    for case in ["hu2003-1", "hu2003-3"] {
        let history = &shipped(case).history;
        for k in SUPPORTS {
            let lateral = peak(history.column(&format!("RY{k}_N")));
            assert!(lateral <= 1e-6, "{case}: RY{k} reaches {lateral} N");
        }
    }
}

#[test]
fn with_rotation_there_is_a_small_lateral_force() {
    let history = &shipped("hu2003-2").history;
    let sum = mean_sum(history, "X");
    assert!((sum + 3000.0).abs() <= 0.5, "the mean X reactions sum to {sum} N");
    for k in SUPPORTS {
        let lateral = mean(history.tail(&format!("RY{k}_N"), ROWS_OF_A_CYCLE)).abs();
        assert!((0.5..10.0).contains(&lateral), "mean RY{k} is {lateral} N");
    }
}

#[test]
fn the_lateral_force_comes_from_the_shafts_damping() {
    let case = root().join("tests/system/cases/undamped-shaft.toml");
    let undamped = run(case.to_str().expect("a UTF-8 path")).history;
    let damped = &shipped("hu2003-2").history;
    for k in SUPPORTS {
        let column = format!("RY{k}_N");
        // Undamped vibration of the run-up remains; its mean over many cycles does not.
        let rows = 5 * ROWS_OF_A_CYCLE;
        let without = mean(undamped.tail(&column, rows)).abs();
        let with = mean(damped.tail(&column, rows)).abs();
        assert!(without <= 0.05 * with, "mean RY{k}: {without} N without damping, {with} N with");
    }
}

#[test]
fn the_papers_extra_term_adds_a_force_from_nowhere() {
    let case = root().join("tests/system/cases/extra-term.toml");
    let history = run(case.to_str().expect("a UTF-8 path")).history;
    let sum = mean_sum(&history, "X");
    assert!((sum + 3187.0).abs() <= 1.0, "the mean X reactions sum to {sum} N under 3000 N");
}

#[test]
fn sinusoidal_amplitudes_equal_the_static_reactions() {
    let still = &shipped("hu2003-1").history;
    for case in ["hu2003-3", "hu2003-4", "hu2003-5"] {
        let history = &shipped(case).history;
        for k in SUPPORTS {
            let column = format!("RX{k}_N");
            let amplitude = peak(history.tail(&column, ROWS_OF_A_CYCLE));
            let constant = still.column(&column).last().expect("rows").abs();
            let ratio = amplitude / constant;
            assert!((ratio - 1.0).abs() <= 0.02, "{case}: amplitude/static of RX{k} is {ratio}");
        }
    }
}

#[test]
fn orbits_close_over_one_load_period() {
    for case in ["hu2003-4", "hu2003-5"] {
        let history = &shipped(case).history;
        let end = *history.column("t_s").last().expect("rows");
        for k in SUPPORTS {
            let (x, y) = (format!("EX{k}_um"), format!("EY{k}_um"));
            let size = spread(history.tail(&x, ROWS_OF_A_CYCLE));
            let gap = [&x, &y]
                .map(|name| history.at(name, end) - history.at(name, end - CYCLE))
                .map(f64::abs);
            assert!(
                peak(&gap) <= 0.01 * size,
                "{case}: orbit {k} of {size} µm opens by {gap:?} µm"
            );
        }
    }
}

#[test]
fn the_speed_rises_linearly_then_stays() {
    let history = &shipped("hu2003-2").history;
    let (time, speed) = (history.column("t_s"), history.column("omega_rad_s"));
    let target = 4500.0 * std::f64::consts::TAU / 60.0;
    let reached = speed.iter().position(|omega| *omega >= target).expect("the target speed");
    let slope = speed[reached] / time[reached];
    for row in (0..reached).step_by(50) {
        let line = slope * time[row];
        assert!((speed[row] - line).abs() <= 0.01 * target, "row {row}: {} rad/s", speed[row]);
    }
    let after = history.tail("omega_rad_s", speed.len() - reached - 1);
    assert!(after.iter().all(|omega| (omega - target).abs() <= 0.01 * target));
    let (theta, rows) = (history.column("theta_rad"), ROWS_OF_A_CYCLE);
    let turned = theta[theta.len() - 1] - theta[theta.len() - 1 - rows];
    let expected = target * (time[time.len() - 1] - time[time.len() - 1 - rows]);
    assert!((turned / expected - 1.0).abs() <= 0.005, "{turned} rad in a cycle");
}
