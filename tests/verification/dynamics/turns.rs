//! Turns of bodies that nothing holds: pendulums of a couple over the angle, run-ups, what spins by itself.

use std::sync::Arc;

use whirl_solver::curve::Curve;
use whirl_solver::dynamics::{
    AutomaticStep, BodyStart, Finding, Integrator, March, MarchOptions, Outcome, findings,
};
use whirl_solver::equations::State;
use whirl_solver::linalg::Matrix;
use whirl_solver::loads::{Frame, Load, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::support::Support;

use super::audit::strict;
use super::{DISCS, INERTIA, discs, parts};

/// ω of small swings (rad/s), and the speed at the lowest point (rad/s): it swings by 2 asin(v/2ω) = 1.67 rad.
const OMEGA: f64 = 9.44;
const SPEED: f64 = 14.0;

/// A rotor under a couple about its axis (N·m).
fn rotor(couple: f64, time_function: TimeFunction) -> Machine {
    let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
    let turn = Matrix::zeros(3, 2 * DISCS);
    parts.loads = vec![Load::couple(0, turn, [0.0, 0.0, couple], time_function, Frame::Body)];
    Machine::new(parts).expect("a machine")
}

/// θ̈ = −ω² sin θ.
fn pendulum() -> Machine {
    let order = TimeFunction::Order { body: 0, order: 1.0, phase: 0.0 };
    rotor(-INERTIA * OMEGA * OMEGA, order)
}

/// A motor that brings the rotor to 300 rad/s: J θ̈ = c (300 − θ̇).
fn motor(slope: f64) -> Machine {
    let rows = [[-1000.0, 1300.0 * slope], [1000.0, -700.0 * slope]];
    let curve = Curve::linear(&rows, false).expect("a curve");
    rotor(1.0, TimeFunction::OverSpeed(Arc::new(curve)))
}

fn options(dt: f64, steps: usize, speed: f64) -> MarchOptions {
    let initial = vec![BodyStart { speed, ..BodyStart::default() }];
    MarchOptions { initial, ..strict(dt, steps) }
}

fn run(machine: &Machine, options: &MarchOptions) -> (Outcome, State, Vec<Finding>) {
    let mut march = March::new(machine, options).expect("starts");
    while !march.is_done() {
        march.advance().expect("converges");
    }
    let state = march.state().clone();
    let outcome = march.outcome();
    let found = findings(&outcome.quality, &outcome.energy, (options.time_step, options.automatic));
    (outcome, state, found)
}

/// θ of the pendulum at a time, by the classical method of Runge and Kutta in steps that leave 1e-11 of it.
fn exact(t: f64) -> f64 {
    let steps = (t / 1e-4).ceil();
    let (h, rate) = (t / steps, |[x, v]: [f64; 2]| [v, -OMEGA * OMEGA * x.sin()]);
    let on = |y: [f64; 2], by: f64, k: [f64; 2]| [y[0] + by * k[0], y[1] + by * k[1]];
    let mut y = [0.0, SPEED];
    for _ in 0..steps as usize {
        let a = rate(y);
        let b = rate(on(y, 0.5 * h, a));
        let c = rate(on(y, 0.5 * h, b));
        let d = rate(on(y, h, c));
        let sum = [0, 1].map(|i| (a[i] + 2.0 * (b[i] + c[i]) + d[i]) / 6.0);
        y = on(y, h, sum);
    }
    y[0]
}

fn of_turn(found: &[Finding]) -> Vec<&Finding> {
    found.iter().filter(|own| own.part.is_some_and(|part| part.turns)).collect()
}

/// The limit is that of every oscillation, a period that is wrong by 1 %: (ωΔt)² = 0.12.
#[test]
fn a_pendulum_in_long_steps_is_not_sound_and_one_in_short_ones_is() {
    for integrator in [Integrator::default(), Integrator::generalized_alpha(0.9)] {
        for (dt, sound) in [(6e-2, false), (1e-3, true)] {
            let steps = (6.0 / dt) as usize;
            let options = MarchOptions { integrator, ..options(dt, steps, SPEED) };
            let (outcome, state, found) = run(&pendulum(), &options);
            let off = (state.q[0] - exact(steps as f64 * dt)).abs();
            println!("{dt}: off by {off} rad, {}", outcome.quality.local_error);
            assert_eq!(of_turn(&found).is_empty(), sound, "{found:?}");
            assert_eq!(off < 0.01, sound, "{off}");
        }
    }
}

/// (ωΔt)³/12 of a small swing in 19 of 20 steps, whatever the size of the swing.
#[test]
fn the_local_error_of_a_swing_is_as_on_paper() {
    for speed in [1e-3, 0.1] {
        let dt = 0.25 / OMEGA;
        let (outcome, ..) = run(&pendulum(), &options(dt, 1000, speed));
        let quality = outcome.quality;
        let limit = 0.25_f64.powi(3) / 12.0;
        // cos of phases in no order stays below 0.997 in 19 of 20 steps; classes of the histogram are 5 % wide, and steps shorten
        // what they integrate by (ωΔt)²/12 twice.
        let ratio = quality.local_error / limit;
        assert!((0.95..1.06).contains(&ratio), "{speed}: {ratio}");
        assert!(quality.local_error_of.is_some_and(|part| part.turns));
    }
}

#[test]
fn the_error_of_a_pendulum_falls_with_the_tolerance() {
    let error = |tolerance: f64| {
        let automatic = Some(AutomaticStep { tolerance, longest: f64::INFINITY });
        let options = MarchOptions { automatic, ..options(0.019, 316, SPEED) };
        let (outcome, state, found) = run(&pendulum(), &options);
        assert!(of_turn(&found).is_empty(), "{found:?}");
        let off = (state.q[0] - exact(316.0 * 0.019)).abs();
        println!("{tolerance}: off by {off} rad in {:?}", outcome.parts);
        off
    };
    // Steps have errors of Δt³, a run of Δt²: tolerance^(2/3), here 100 for 1000, on a ladder of halves.
    let [coarse, fine] = [1e-4, 1e-7].map(error);
    assert!(coarse < 0.1 && (20.0..500.0).contains(&(coarse / fine)), "{coarse} {fine}");
}

#[test]
fn a_pendulum_that_is_resumed_has_the_verdict_of_one_that_went_on() {
    let tolerance = 1e-5;
    for automatic in [None, Some(AutomaticStep { tolerance, ..AutomaticStep::default() })] {
        let (machine, options) =
            (pendulum(), MarchOptions { automatic, ..options(0.019, 300, SPEED) });
        let (whole, state, _) = run(&machine, &options);
        for cut in [7, 151] {
            let mut first = March::new(&machine, &options).expect("starts");
            (0..cut).for_each(|_| first.advance().expect("converges"));
            let mut second =
                March::resume(&machine, &options, first.checkpoint()).expect("resumes");
            while !second.is_done() {
                second.advance().expect("converges");
            }
            assert_eq!(second.state(), &state, "{cut}");
            assert_eq!(second.outcome(), whole, "{cut}");
        }
    }
}

/// Run-ups in as many steps as their time takes, what approaches a speed without any of its own, what spins by itself.
#[test]
fn ordinary_turns_are_sound() {
    for (slope, dt, start) in
        [(0.05, 0.02, 0.0), (0.05, 1e-3, 0.0), (5.0, 1e-3, 299.0), (0.0, 0.01, 500.0)]
    {
        let machine = motor(slope);
        let steps = 500;
        let (outcome, _, found) = run(&machine, &options(dt, steps, start));
        println!("{slope} {dt}: {}", outcome.quality.local_error);
        assert!(of_turn(&found).is_empty(), "{slope} {dt}: {found:?}");
    }
}

/// A couple of the time, of which no angle and no speed knows.
#[test]
fn a_couple_that_swings_faster_than_steps_show_is_not_sound() {
    for (frequency, sound) in [(100.0, false), (10.0, true)] {
        let machine = rotor(1.0, TimeFunction::Sine { frequency, phase: 0.0 });
        let (outcome, _, found) = run(&machine, &options(1e-3, 1000, 0.0));
        println!("{frequency} Hz: {}", outcome.quality.local_error);
        assert_eq!(of_turn(&found).is_empty(), sound, "{frequency} Hz: {found:?}");
    }
}

/// However long, however few, and wherever the swing begins; also where it goes over the top.
#[test]
fn a_pendulum_is_not_sound_in_any_steps_that_are_too_long() {
    for integrator in [Integrator::default(), Integrator::generalized_alpha(0.9)] {
        for ratio in [0.6, 1.0, 2.0, 4.0, 10.0, 60.0, 1e3] {
            for (angle, speed) in [(0.0, 0.1), (0.0, SPEED), (0.1, 0.0), (2.0, 0.0), (0.5, 3.0)] {
                for steps in [24, 200, 1000] {
                    let initial = vec![BodyStart { angle, speed, ..BodyStart::default() }];
                    let options =
                        MarchOptions { initial, integrator, ..strict(ratio / OMEGA, steps) };
                    let (outcome, _, found) = run(&pendulum(), &options);
                    let quality = outcome.quality;
                    assert!(!found.is_empty(), "{ratio} {angle} {speed} {steps}: {quality:?}");
                }
            }
        }
    }
}

/// A motor by which the speed falls far faster than steps show: what alternates is judged as that, and where the method damps it
/// the turn is sound.
#[test]
fn a_fall_of_the_speed_that_steps_do_not_resolve_is_no_local_error() {
    for ratio in [3.0, 100.0, 1e3] {
        let dt = 1e-3;
        let machine = motor(ratio * INERTIA / dt);
        for (radius, sound) in [(1.0, false), (0.9, true)] {
            let integrator = Integrator::generalized_alpha(radius);
            let options = MarchOptions { integrator, ..options(dt, 500, 299.5) };
            let (outcome, state, found) = run(&machine, &options);
            let quality = outcome.quality;
            assert!(quality.local_error < 1e-3, "{ratio} {radius}: {quality:?}");
            // A step of the trapezoidal rule leaves −0.2, −0.96 and nearly −1: the first dies before it counts as ringing.
            assert_eq!(found.is_empty(), sound || ratio == 3.0, "{ratio} {radius}: {found:?}");
            let rings = found.iter().all(|own| own.what.contains("alternates from step to step"));
            assert!(rings, "{ratio} {radius}: {found:?}");
            assert!(!sound || (state.v[0] - 300.0).abs() < 1e-9, "{ratio}: {}", state.v[0]);
        }
    }
}

/// A swing, and where it turns back ten trains of pulses of a microsecond, each within a step that is cut in a thousand parts:
/// these are short and together one step, and the accelerations in them say nothing of the swing.
#[test]
fn pulses_in_steps_that_are_cut_leave_the_local_error_of_a_swing() {
    let dt = 0.25 / OMEGA;
    // Half a period in steps, as the trapezoidal rule has it.
    let half = std::f64::consts::PI / (2.0 * 0.125_f64.atan());
    let mut rows = vec![[0.0, 0.0]];
    for train in 0..10 {
        let at = (half * (0.5 + 8.0 * f64::from(train))).floor() + 0.3;
        for place in 0..1000 {
            let couple = [0.0, 500.0, 0.0, -500.0][place % 4];
            rows.push([at * dt + 1e-6 * place as f64, couple]);
        }
        rows.push([at * dt + 1e-3, 0.0]);
    }
    rows.push([1000.0 * dt, 0.0]);
    let curve = Arc::new(Curve::linear(&rows, false).expect("a curve"));
    let machine = |pulse: f64| {
        let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
        let couple = |size: f64, time_function: TimeFunction| {
            let turn = Matrix::zeros(3, 2 * DISCS);
            Load::couple(0, turn, [0.0, 0.0, size], time_function, Frame::Body)
        };
        let order = TimeFunction::Order { body: 0, order: 1.0, phase: 0.0 };
        let pulses = TimeFunction::OverTime(curve.clone());
        parts.loads = vec![couple(-INERTIA * OMEGA * OMEGA, order), couple(pulse, pulses)];
        Machine::new(parts).expect("a machine")
    };
    let error = |machine: &Machine| run(machine, &options(dt, 1000, 0.1)).0.quality.local_error;
    let [alone, pulsed] = [0.0, 1.0].map(|pulse| error(&machine(pulse)));
    // Trains move the swing by 0.05 % each; classes are 5 % wide.
    assert!((pulsed / alone - 1.0).abs() < 0.06, "{pulsed} for {alone}");
}
