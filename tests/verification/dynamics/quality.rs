//! What a march measures of its steps, against closed forms; and the verdict.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use num_dual::DualNum;
use whirl_solver::dynamics::{Finding, March, NewtonOptions, Outcome, findings, march};
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::audit::{SOFT, STIFF, stop, strict};
use super::contacts::Formula;
use super::{force, parts, stops};

fn run(machine: &Machine, time_step: f64, steps: usize, start: [f64; 2]) -> Outcome {
    let mut options = strict(time_step, steps);
    [options.initial[0].position, options.initial[0].velocity] =
        [vec![start[0], 0.0], vec![start[1], 0.0]];
    let outcome = march(machine, &options, &mut |_| ControlFlow::Continue(()));
    outcome.unwrap_or_else(|failure| panic!("{}", failure.error))
}

fn verdict(outcome: &Outcome, time_step: f64) -> Vec<Finding> {
    findings(&outcome.quality, &outcome.energy, (time_step, None))
}

/// Steps that are solved exactly and far too long are not sound; with the step of the remedy they are.
#[test]
fn an_unresolved_stop_is_not_sound_and_its_remedy_is() {
    let machine = stop::machine();
    let outcome = run(&machine, 1e-3, 500, [0.0, -1.0]);
    let wrong = verdict(&outcome, 1e-3);
    assert!(!wrong.is_empty(), "{:?}", outcome.quality);
    assert!(outcome.quality.energy_made_share > 1.0, "{:?}", outcome.quality);
    // 0.28/√(k/m).
    let step = outcome.quality.resolving_step.expect("energy was made");
    assert!((step / (0.28 / 1e9_f64.sqrt()) - 1.0).abs() < 1e-6, "{step}");
    assert!(wrong[0].remedy.contains("8.8e-6 s"), "{}", wrong[0].remedy);
    let outcome = run(&machine, 8.8e-6, (0.5 / 8.8e-6) as usize, [0.0, -1.0]);
    assert_eq!(verdict(&outcome, 8.8e-6), [], "{:?}", outcome.quality);
}

/// Each step's trapezoid less the drop of the stops' potential.
#[test]
fn energy_made_is_that_of_the_potential() {
    let machine = stop::machine();
    for time_step in [3e-5, 1e-5, 3e-6] {
        let mut options = strict(time_step, (0.3 / time_step) as usize);
        [options.initial[0].position, options.initial[0].velocity] =
            [vec![0.0; 2], vec![-1.0, 0.0]];
        let mut march = March::new(&machine, &options).expect("starts");
        let depth = |x: f64| (x.abs() - stop::GAP).max(0.0);
        let (mut made, mut flowed, mut x) = ([0.0; 2], [0.0; 2], 0.0_f64);
        for _ in 0..options.steps {
            march.advance().unwrap_or_else(|error| panic!("{error}"));
            let end = march.state().q[1];
            let force = |x: f64| -stop::STIFFNESS * depth(x) * x.signum();
            let dropped = 0.5 * stop::STIFFNESS * (depth(x).powi(2) - depth(end).powi(2));
            let stop = usize::from(x + end < 0.0);
            made[stop] += (0.5 * (force(x) + force(end)) * (end - x) - dropped).abs();
            flowed[stop] += dropped.abs();
            x = end;
        }
        let quality = march.outcome().quality;
        // Lobatto's rule over a kink within the step: 3 % of the square of the depth at most.
        let stop = quality.bearing.expect("energy was made");
        let (found, exact) = (quality.energy_made, made[stop]);
        assert!((found / exact - 1.0).abs() < 0.1, "Δt = {time_step}: {found} for {exact} J");
        assert!((quality.energy_flowed / flowed[stop] - 1.0).abs() < 0.02, "Δt = {time_step}");
        // √(k/m) Δt is 0.95, 0.32 and 0.095: shares of 15 %, 1.7 % and 0.15 % on average.
        assert_eq!(found / quality.energy_flowed < 0.05, time_step < 2e-5);
    }
}

/// A mass on a spring: (β − 1/6) Δt² (q̈_{n+1} − q̈_n) is of the size Δt²/6 · ω² sin(½ ω̂Δt), ω̂ = (2/Δt) atan(½ωΔt).
#[test]
fn the_local_error_of_an_oscillator_is_as_on_paper() {
    for ratio in [0.05, 0.3, 0.9] {
        let omega = 200.0_f64;
        let time_step = ratio / omega;
        let shaft = Shaft::lumped(2.0, [2.0 * omega * omega; 2], [0.0; 2], 0.0);
        let parts = parts(shaft, Support::rigid(&[]), Rotation::Held);
        let machine = Machine::new(parts).expect("a machine");
        let outcome = run(&machine, time_step, 5000, [1e-3, 0.0]);
        let largest = time_step.powi(2) / 6.0 * omega.powi(2) * (0.5 * ratio).atan().sin();
        let quality = &outcome.quality;
        assert!((quality.largest_local_error / largest - 1.0).abs() < 1e-3, "{quality:?}");
        // 95 % of |sin| lie below sin(0.475 π); found to a fiftieth of a decade.
        let share = largest * (0.475 * PI).sin();
        assert!((quality.local_error / share - 1.0).abs() < 0.05, "{quality:?} for {share}");
        let sound = verdict(&outcome, time_step).is_empty();
        assert_eq!(sound, ratio < 0.34, "{ratio}");
        assert_eq!((quality.energy_flowed, quality.unresolved_motion), (0.0, 0.0));
        assert_eq!(quality.resolving_step, None);
    }
}

/// A mass on a spring that is faster than the step: ringing is not sound, following a slow load is.
#[test]
fn what_rings_faster_than_the_step_is_not_sound() {
    for ratio in [1.1, 2.0, 50.0] {
        let omega = 200.0_f64;
        let time_step = ratio / omega;
        let shaft = || Shaft::lumped(2.0, [2.0 * omega * omega; 2], [0.0; 2], 0.0);
        let mass = parts(shaft(), Support::rigid(&[]), Rotation::Held);
        let outcome = run(&Machine::new(mass).expect("a machine"), time_step, 3000, [1e-3, 0.0]);
        let found = verdict(&outcome, time_step);
        assert!(found.iter().any(|found| found.what.contains("faster than the step")), "{found:?}");
        // 0.3/ω.
        assert!(found[0].remedy.contains("1.5e-3 s"), "{found:?}");
        let mut mass = parts(shaft(), Support::rigid(&[]), Rotation::Held);
        let slow = TimeFunction::Sine { frequency: 0.01 / time_step, phase: 0.0 };
        mass.loads = vec![force(&mass.bodies[0].nodes()[0], [1e3, 0.0, 0.0], slow, Frame::Space)];
        let outcome = run(&Machine::new(mass).expect("a machine"), time_step, 3000, [0.0; 2]);
        // It follows its load, which is found right; what the step does to it cannot be judged.
        let found = verdict(&outcome, time_step);
        assert!(found.len() == 1 && !outcome.quality.judged, "{found:?} {:?}", outcome.quality);
        assert!(found[0].what.contains("so that a local error can be judged"), "{found:?}");
    }
}

/// A mass that nothing holds where the march begins, and a stop of 1e9 N/m in all but its first step: it is judged as the
/// oscillator that it then is.
#[test]
fn what_holds_a_body_in_the_run_judges_it_not_what_did_at_the_start() {
    let outcome = |ratio: f64| {
        let shaft = Shaft::lumped(1.0, [0.0; 2], [0.0; 2], 0.0);
        let mut mass = parts(shaft, Support::rigid(&[]), Rotation::Held);
        mass.laws = vec![Box::new(&STIFF)];
        mass.bearings = vec![stops("above", 1e-12, &[0.0], 0)];
        let node = &mass.bodies[0].nodes()[0];
        mass.loads = vec![force(node, [1e3, 0.0, 0.0], TimeFunction::Constant, Frame::Space)];
        let time_step = ratio / 1e9_f64.sqrt();
        let outcome = run(&Machine::new(mass).expect("a machine"), time_step, 4000, [0.0; 2]);
        (verdict(&outcome, time_step), outcome.quality)
    };
    // Of the oscillator on paper above, over twice its amplitude.
    for ratio in [0.2, 0.5] {
        let (found, quality) = outcome(ratio);
        let largest = ratio.powi(2) / 12.0 * (0.5 * ratio).atan().sin();
        assert!((quality.largest_local_error / largest - 1.0).abs() < 0.01, "{quality:?}");
        assert_eq!(found.is_empty(), ratio < 0.3, "{found:?}");
    }
    let (found, quality) = outcome(2.0);
    let fast = found.iter().find(|own| own.what.contains("faster than the step"));
    // 0.3/ω.
    assert!(fast.is_some_and(|own| own.remedy.contains("9.4e-6 s")), "{found:?} {quality:?}");
}

/// The other way: a stop that no step resolves holds the mass where it begins, and lets it go onto a soft spring.
#[test]
fn what_held_a_body_at_the_start_only_hides_nothing_after_it() {
    let (omega, ratio, damping) = (100.0, 0.5, 0.05);
    let shaft = Shaft::lumped(1.0, [0.0; 2], [2.0 * damping * omega; 2], 0.0);
    let mut mass = parts(shaft, Support::rigid(&[]), Rotation::Held);
    mass.laws = vec![Box::new(&STIFF), Box::new(&GENTLE)];
    mass.bearings = vec![stops("above", 1e-12, &[0.0], 0), stops("below", 1e-12, &[PI], 1)];
    let node = &mass.bodies[0].nodes()[0];
    mass.loads = vec![force(node, [-10.0, 0.0, 0.0], TimeFunction::Constant, Frame::Space)];
    let machine = Machine::new(mass).expect("a machine");
    let quality = run(&machine, ratio / omega, 100, [2e-12, 0.0]).quality;
    // Within the damping of half a swing, 15 %, that of the oscillator on paper over twice its amplitude.
    let largest = ratio.powi(2) / 12.0 * (0.5 * ratio).atan().sin();
    assert!((quality.largest_local_error / largest - 1.0).abs() < 0.15, "{quality:?}");
}

/// A stop of 1e4 N/m.
static GENTLE: Formula = Formula {
    name: "gentle",
    inputs: &["h"],
    outputs: &["Q"],
    value: |z| vec![if z[0].re < 0.0 { z[0] * -1e4 } else { z[0] * 0.0 }],
};

static PRESSED: Formula = Formula {
    name: "pressed",
    inputs: &["h"],
    outputs: &["Q"],
    value: |z| vec![z[0] * -1.0 + 1e5],
};

/// Forces that hold each other, and a long quiet time, hide no bad impact.
#[test]
fn an_unresolved_stop_stays_unsound_beside_what_is_resolved() {
    for (pressed, duration) in [(false, 0.5), (true, 0.5), (false, 20.0)] {
        let shaft =
            Shaft::lumped(1.0, [if duration > 1.0 { 1e4 } else { 0.0 }; 2], [0.0, 0.0], 0.0);
        let mut mass = parts(shaft, Support::rigid(&[]), Rotation::Held);
        mass.laws = vec![Box::new(&STIFF), Box::new(&PRESSED)];
        mass.bearings = vec![stops("above", 0.005, &[0.0], 0), stops("below", 0.05, &[PI], 0)];
        if pressed {
            mass.bearings.push(stops("pressed up", 0.0, &[0.0], 1));
            mass.bearings.push(stops("pressed down", 0.0, &[PI], 1));
        }
        let machine = Machine::new(mass).expect("a machine");
        let time_step = 4e-5;
        let outcome = run(&machine, time_step, (duration / time_step) as usize, [0.0, 1.0]);
        let found = verdict(&outcome, time_step);
        assert!(
            found.iter().any(|found| found.bearing.is_some_and(|bearing| bearing < 2)),
            "{:?}",
            outcome.quality
        );
    }
}

/// Small forces are solved as well as large ones, whatever tolerance is allowed.
#[test]
fn the_scale_of_forces_changes_no_motion() {
    let path = |law: &'static Formula, mass: f64, force_tolerance: f64| -> Vec<f64> {
        let shaft = Shaft::lumped(mass, [0.0; 2], [0.0; 2], 0.0);
        let mut parts = parts(shaft, Support::rigid(&[]), Rotation::Held);
        parts.laws = vec![Box::new(law)];
        parts.bearings = vec![stops("above", 5e-4, &[0.0], 0), stops("below", 5e-4, &[PI], 0)];
        let node = &parts.bodies[0].nodes()[0];
        parts.loads =
            vec![force(node, [-0.1 * mass, 0.0, 0.0], TimeFunction::Constant, Frame::Space)];
        let machine = Machine::new(parts).expect("a machine");
        let mut options = strict(9.4e-6, 20_000);
        options.newton = NewtonOptions { force_tolerance, ..NewtonOptions::default() };
        [options.initial[0].position, options.initial[0].velocity] =
            [vec![0.0; 2], vec![-0.01, 0.0]];
        let mut march = March::new(&machine, &options).expect("starts");
        let mut path = Vec::new();
        while !march.is_done() {
            march.advance().unwrap_or_else(|error| panic!("{error}"));
            path.push(march.state().q[1]);
        }
        path
    };
    let exact = path(&STIFF, 1.0, 0.0);
    for (law, mass, force_tolerance) in
        [(&SOFT, 1e-6, 1e-3), (&SOFT, 1e-6, 1e9), (&STIFF, 1.0, 1e-3), (&STIFF, 1.0, 1e9)]
    {
        let path = path(law, mass, force_tolerance);
        let worst = exact.iter().zip(&path).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // Some ten contacts, each solved to 1e-5 of its force.
        assert!(worst < 1e-4 * 5e-4, "{mass} kg, {force_tolerance} N: {worst} m");
    }
}

static LOST: Formula = Formula {
    name: "lost",
    inputs: &["e_x", "e_y", "omega"],
    outputs: &["F_x", "F_y", "M_z"],
    value: |z| vec![z[0] * -1e4, z[1] * -1e4, (z[2] - 1.0).sqrt()],
};

/// A force that is no number, on a rotation that is given, ends the march.
#[test]
fn a_force_that_is_no_number_is_not_accepted() {
    let shaft = Shaft::lumped(1.0, [0.0; 2], [0.0; 2], 0.0);
    let mut mass = parts(shaft, Support::rigid(&[]), Rotation::Held);
    mass.laws = vec![Box::new(&LOST)];
    mass.bearings = vec![stops("around", 1e-3, &[], 0)];
    let machine = Machine::new(mass).expect("a machine");
    let mut options = strict(1e-4, 10);
    options.newton = NewtonOptions::default();
    [options.initial[0].position, options.initial[0].velocity] = [vec![0.0; 2], vec![0.1, 0.0]];
    let error = March::new(&machine, &options).expect("starts").advance();
    assert!(matches!(error, Err(whirl_solver::Error::NoForce { bearing: 1, .. })), "{error:?}");
}

/// One of two that face each other.
static DASHPOT: Formula = Formula {
    name: "spring and dashpot",
    inputs: &["h", "h_dot"],
    outputs: &["Q"],
    value: |z| vec![z[0] * -1.5e4 - z[1] * 20.0],
};

pub(super) static MOUNT: Formula = Formula {
    name: "spring and dashpot all around",
    inputs: &["e_x", "e_y", "e_x_dot", "e_y_dot"],
    outputs: &["F_x", "F_y"],
    value: |z| vec![z[0] * -3e4 - z[2] * 40.0, z[1] * -3e4 - z[3] * 40.0],
};

/// What a spring holds and what its dashpot turned into heat, as two numbers; by both kinds of law.
#[test]
fn stored_and_dissipated_energy_are_distinguished() {
    for (law, around) in [(&DASHPOT, false), (&MOUNT, true)] {
        let shaft = Shaft::lumped(2.0, [0.0; 2], [0.0; 2], 0.0);
        let mut parts = parts(shaft, Support::rigid(&[]), Rotation::Held);
        parts.laws = vec![Box::new(law)];
        parts.bearings = vec![stops("mount", 0.0, if around { &[] } else { &[0.0, PI] }, 0)];
        let machine = Machine::new(parts).expect("a machine");
        let (time_step, steps) = (1e-4, 300);
        let outcome = run(&machine, time_step, steps, [1e-3, 0.5]);
        // m ẍ + d ẋ + k x = 0 in closed form.
        let (k, d, m) = (3e4, 40.0, 2.0);
        let (decay, t) = (0.5 * d / m, time_step * steps as f64);
        let omega = f64::sqrt(k / m - decay * decay);
        let (a, b) = (1e-3, (0.5 + decay * 1e-3) / omega);
        let x = (-decay * t).exp() * (a * (omega * t).cos() + b * (omega * t).sin());
        let v = (-decay * t).exp()
            * ((b * omega - a * decay) * (omega * t).cos()
                - (a * omega + b * decay) * (omega * t).sin());
        let stored = 0.5 * k * (x * x - 1e-6);
        let lost = 0.5 * m * (0.25 - v * v) - stored;
        let energy = outcome.energy;
        // The period is wrong by (ωΔt)²/12 = 1e-5, 0.4 cycles long.
        let scale = 0.5 * m * 0.25;
        assert!((energy.spring_stored - stored).abs() < 1e-4 * scale, "{energy:?} for {stored}");
        assert!((energy.spring_dissipated - lost).abs() < 1e-4 * scale, "{energy:?} for {lost}");
        assert!(energy.error().abs() < 1e-9 * scale, "{energy:?}");
    }
}
