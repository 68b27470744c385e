//! Marches that choose the parts of their steps, against closed forms.

use std::f64::consts::{FRAC_PI_2, TAU};

use whirl_solver::dynamics::{AutomaticStep, March, MarchOptions, Outcome, findings};
use whirl_solver::loads::{Frame, Load, Onset, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::audit::{stop, strict};
use super::{force, parts};

/// The push on the mass between its stops, towards the lower one (N).
const PUSH: f64 = 10.0;

/// Rows that a march foresees where it begins.
const FORESEEN: usize = 16;

/// Parts of the first row where all is calm: two of the shortest, and each of the others twice as long as the one before.
const BEGINNING: usize = 15;

fn automatic(time_step: f64, steps: usize, tolerance: f64) -> MarchOptions {
    MarchOptions {
        automatic: Some(AutomaticStep { tolerance, longest: f64::INFINITY }),
        ..strict(time_step, steps)
    }
}

/// x and v after every step.
fn marched(
    machine: &Machine,
    mut options: MarchOptions,
    start: [f64; 2],
) -> (Vec<[f64; 2]>, Outcome) {
    [options.initial[0].position, options.initial[0].velocity] =
        [vec![start[0], 0.0], vec![start[1], 0.0]];
    let mut march = March::new(machine, &options).expect("starts");
    let mut path = Vec::new();
    while !march.is_done() {
        march.advance().unwrap_or_else(|error| panic!("{error}"));
        path.push([march.state().q[1], march.state().v[1]]);
    }
    (path, march.outcome())
}

/// The mass between its stops a time after it was thrown from the middle, exactly: parabolas, and sines in the stops.
fn between_stops(thrown: f64, t: f64) -> [f64; 2] {
    let (gap, push) = (stop::GAP, -PUSH);
    let omega = stop::STIFFNESS.sqrt();
    let (mut x, mut v, mut left) = (0.0, thrown, t);
    loop {
        // Flight: x + v τ + ½ a τ² = ±gap, whichever is met first.
        let meets = |wall: f64, from_wall: bool| -> f64 {
            let root = (v * v + 2.0 * push * (wall - x)).sqrt();
            let times = [(-v - root) / push, (-v + root) / push];
            let least = if from_wall { 1e-9 } else { 0.0 };
            times.into_iter().filter(|time| *time > least).fold(f64::INFINITY, f64::min)
        };
        let (below, above) = (meets(-gap, x == -gap), meets(gap, x == gap));
        let flight = below.min(above);
        if left <= flight {
            return [x + v * left + 0.5 * push * left * left, v + push * left];
        }
        left -= flight;
        let side = if below < above { -1.0 } else { 1.0 };
        (x, v) = (side * gap, v + push * flight);
        // Contact, outwards positive: u = c (1 − cos φ) + s sin φ, zero again where tan ½φ = −s/c.
        let (c, s) = (side * push / omega.powi(2), side * v / omega);
        let end = 2.0 * s.atan2(-c);
        let phase = omega * left;
        if phase <= end {
            let u = c * (1.0 - phase.cos()) + s * phase.sin();
            let rate = omega * (c * phase.sin() + s * phase.cos());
            return [side * (gap + u), side * rate];
        }
        left -= end / omega;
        v = -v;
    }
}

/// Of the mass between its stops (J).
fn energy([x, v]: [f64; 2]) -> f64 {
    let depth = (x.abs() - stop::GAP).max(0.0);
    0.5 * v * v + 0.5 * stop::STIFFNESS * depth * depth + PUSH * x
}

/// Largest errors of the energy and of the position (of the mass that was thrown from the middle) at the ends of all steps.
fn errors(path: &[[f64; 2]], thrown: f64, dt: f64) -> [f64; 2] {
    let mut errors = [0.0_f64; 2];
    for (step, own) in path.iter().enumerate() {
        let exact = between_stops(thrown, (step + 1) as f64 * dt);
        errors[0] = errors[0].max((energy(*own) - 0.5 * thrown * thrown).abs());
        errors[1] = errors[1].max((own[0] - exact[0]).abs());
    }
    errors
}

/// Thrown between both stops, and bouncing on the lower one.
#[test]
fn impacts_are_as_exact_as_with_many_more_fixed_steps() {
    let (machine, duration) = (stop::machine(), 0.5);
    for thrown in [-2.0, 0.0] {
        let fixed = 2e-6_f64;
        let many = (duration / fixed).round() as usize;
        let (path, _) = marched(&machine, strict(fixed, many), [0.0, thrown]);
        let by_fixed = errors(&path, thrown, fixed);
        for (dt, steps) in [(1e-2, 50), (1e-3, 500)] {
            for tolerance in [1e-3, 1e-4, 1e-5] {
                let options = automatic(dt, steps, tolerance);
                let (path, outcome) = marched(&machine, options, [0.0, thrown]);
                let [energy_error, place_error] = errors(&path, thrown, dt);
                let taken = outcome.parts.expect("chosen");
                println!(
                    "{thrown} m/s, {dt} s, {tolerance}: {energy_error:e} J {place_error:e} m {taken:?}; fixed {by_fixed:?}"
                );
                // In each contact the parts in which it begins and ends make energy, each ten times the tolerance of what
                // is in play there: what flowed and the kinetic energy, each that at the lower stop at most. A pass
                // between the stops, or up and down again, takes 44 ms at least.
                let in_play = 2.0 * (0.5 * thrown * thrown + PUSH * stop::GAP);
                let contacts = duration / 0.044;
                let made = 2.0 * contacts * 10.0 * tolerance * in_play;
                assert!(energy_error <= made, "{energy_error} J for {made} J");
                // Δv = ΔE/v, v at least 1 m/s where it is struck, over the whole run; and every part that was shortened
                // may be misplaced by its local error.
                let shortened = (taken.parts - steps + taken.rejected) as f64;
                let allowed = made * duration + shortened * tolerance * stop::GAP;
                assert!(place_error <= allowed, "{place_error} m for {allowed} m");
                assert_eq!(findings(&outcome.quality, &outcome.energy, (dt, None)), []);
                if tolerance <= 1e-5 {
                    assert!(energy_error <= by_fixed[0], "{energy_error} J for {} J", by_fixed[0]);
                    assert!(place_error <= by_fixed[1], "{place_error} m for {} m", by_fixed[1]);
                    assert!(100 * (taken.parts + taken.rejected) < many, "{taken:?}");
                }
            }
        }
    }
}

/// Set into the upper stop so that Newmark's step over a whole row ends where it began, with its acceleration and its energy:
/// by what is measured of it nothing is wrong, and yet the mass has left the stop before.
#[test]
fn a_part_at_whose_end_all_is_as_at_its_start_is_not_taken_for_exact() {
    let (machine, thrown) = (stop::machine(), 2.0);
    let state = |t: f64| -> ([f64; 2], f64) {
        let [x, v] = between_stops(thrown, t);
        ([x, v], -stop::STIFFNESS * (x - stop::GAP) - PUSH)
    };
    let row = |t: f64| {
        let ([_, v], a) = state(t);
        -2.0 * v / a
    };
    // Where the row would be less than half a period of the contact, and far from resolving it.
    let omega = stop::STIFFNESS.sqrt();
    let times = (0..).map(|k| 1e-7 * f64::from(k));
    let began = times.skip_while(|t| state(*t).0[0] <= stop::GAP || omega * row(*t) > 2.4);
    let began = began.into_iter().next().expect("it is struck");
    let (dt, rows, tolerance) = (row(began), 100, 1e-5);
    let (path, outcome) = marched(&machine, automatic(dt, rows, tolerance), state(began).0);
    let exact = |k: usize| between_stops(thrown, began + (k + 1) as f64 * dt)[0];
    let errors = path.iter().enumerate().map(|(k, own)| (own[0] - exact(k)).abs());
    let (error, taken) = (errors.fold(0.0, f64::max), outcome.parts.expect("chosen"));
    // One step over the first row is late by Δt and twice the time to the deepest point.
    let phase = 2.0 * (FRAC_PI_2 - (omega * row(began) / 2.0).recip().atan());
    let late = thrown * (dt - phase / omega);
    println!("{error:e} m, {late:e} m where the first row is one part; {taken:?}");
    let shortened = (taken.parts - rows + taken.rejected) as f64;
    assert!(error <= shortened * tolerance * stop::GAP, "{error} m, {taken:?}");
    assert!(10.0 * error <= late, "{error} m for {late} m");
}

/// In flight nothing is wrong with parts as long as a row, at both ends of which the mass is clear of a stop that it strikes
/// between them.
#[test]
fn a_contact_within_a_part_is_not_passed_over() {
    let (machine, thrown, dt) = (stop::machine(), 1.05_f64, 0.14);
    let flight = |t: f64| thrown * t - 0.5 * PUSH * t * t;
    let highest = 0.5 * thrown * thrown / PUSH;
    assert!(flight(0.5 * dt) < stop::GAP && flight(dt) < stop::GAP && highest > stop::GAP);
    let (path, outcome) = marched(&machine, automatic(dt, 1, 1e-5), [0.0, thrown]);
    let exact = between_stops(thrown, dt)[0];
    let (error, missed) = ((path[0][0] - exact).abs(), (flight(dt) - exact).abs());
    println!("{error:e} m, {missed:e} m of flight; {:?}", outcome.parts);
    // The parts in which the contact begins and ends make ten times the tolerance of the energy in play there, which is
    // at most twice that of the throw: ΔE/v in speed, of what is left of it, until the end.
    let left = (thrown * thrown - 2.0 * PUSH * stop::GAP).sqrt();
    let allowed = 2.0 * 10.0 * 1e-5 * thrown * thrown / left * dt;
    assert!(error <= allowed, "{error} m for {allowed} m");
    assert!(100.0 * error <= missed, "{error} m for {missed} m");
}

/// A mass on a spring that a harmonic load drives from rest: its displacement begins as t³, so that what a part errs is much of
/// what has moved yet, and nothing of what is to come. Over four periods of the load the steps that are chosen, those by which
/// the first rows are foreseen included, are no worse than twice what equal ones are for as much work.
#[test]
fn a_start_from_rest_takes_no_more_steps_than_the_motion_that_follows() {
    let (omega, driven, a) = (200.0_f64, 120.0_f64, 3.0_f64);
    let shaft = Shaft::lumped(2.0, [2.0 * omega * omega; 2], [0.0; 2], 0.0);
    let mut parts = parts(shaft, Support::rigid(&[]), Rotation::Held);
    let node = parts.bodies[0].nodes()[0].clone();
    let sine = TimeFunction::Sine { frequency: driven / TAU, phase: 0.0 };
    parts.loads = vec![force(&node, [2.0 * a, 0.0, 0.0], sine, Frame::Space)];
    let machine = Machine::new(parts).expect("a machine");
    let exact = |t: f64| {
        let sines = (driven * t).sin() - driven / omega * (omega * t).sin();
        a / (omega * omega - driven * driven) * sines
    };
    let (rows, all) = (100, 4.0 * TAU / driven);
    let row = all / rows as f64;
    let error = |path: &[[f64; 2]], every: usize| {
        let rows = path.iter().skip(every - 1).step_by(every).enumerate();
        rows.map(|(k, own)| (own[0] - exact((k + 1) as f64 * row)).powi(2)).sum::<f64>().sqrt()
    };
    let mut last = f64::INFINITY;
    for tolerance in [1e-4, 1e-5, 1e-6] {
        let (path, outcome) = marched(&machine, automatic(row, rows, tolerance), [0.0; 2]);
        let taken = outcome.parts.expect("chosen");
        let work = FORESEEN + taken.parts + taken.rejected;
        let every = work.div_ceil(rows);
        let (equal, _) = marched(&machine, strict(row / every as f64, every * rows), [0.0; 2]);
        // Of second order.
        let as_much = error(&equal, every) * ((every * rows) as f64 / work as f64).powi(2);
        let own = error(&path, 1);
        println!("{tolerance}: {own:e} m, {as_much:e} m by {work} equal steps; {taken:?}");
        assert!(own <= 2.0 * as_much, "{own} m for {as_much} m: {taken:?}");
        // A part errs by as much as Δt³, the whole by Δt².
        assert!(own < 0.5 * last, "{own} m after {last} m");
        last = own;
    }
}

/// A mass on a spring: what is wrong at its end is the phase, as every step keeps the energy.
#[test]
fn the_error_of_an_oscillator_falls_with_the_tolerance() {
    let omega = 200.0_f64;
    let shaft = Shaft::lumped(2.0, [2.0 * omega * omega; 2], [0.0; 2], 0.0);
    let parts = parts(shaft, Support::rigid(&[]), Rotation::Held);
    let machine = Machine::new(parts).expect("a machine");
    let (dt, steps) = (TAU / omega / 4.0, 80);
    let mut last = f64::INFINITY;
    for tolerance in [1e-2, 1e-3, 1e-4, 1e-5, 1e-6] {
        let (path, outcome) = marched(&machine, automatic(dt, steps, tolerance), [1e-3, 0.0]);
        let exact = |step: usize| 1e-3 * (omega * (step + 1) as f64 * dt).cos();
        let errors = path.iter().enumerate().map(|(step, own)| (own[0] - exact(step)).abs() / 1e-3);
        let error = errors.fold(0.0, f64::max);
        // A part with r = ωΔt has the error r²/6 sin(atan ½r)/(1 + ¼r²), and the phase is late by r − 2 atan ½r in it.
        let error_of = |r: f64| r * r / 6.0 * (0.5 * r).atan().sin() / (1.0 + 0.25 * r * r);
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let r = 0.5 * (low + high);
            if error_of(r) < tolerance { low = r } else { high = r }
        }
        let late = (1.0 - 2.0 * (0.5 * low).atan() / low) * omega * dt * steps as f64;
        println!("{tolerance}: {error:e} for {late:e}, {:?}", outcome.parts);
        assert!(error <= late, "{tolerance}: {error} for {late}");
        assert!(error < 0.5 * last, "{tolerance}: {error} after {last}");
        last = error;
        let taken = outcome.parts.expect("chosen");
        let [_, most] = taken.halvings.expect("parts");
        // Behind those with which it begins no part is shorter than half of what the tolerance asks for.
        let most_parts = omega * dt * steps as f64 / (0.5 * low);
        assert!((taken.parts - BEGINNING) as f64 <= most_parts, "{taken:?} for {low}");
        // A matrix is factored for every length on the way down, and then but now and then, where rounding keeps the
        // iteration from contracting; not with every change of the length.
        let factored = outcome.factorisations;
        println!("{factored} factorisations");
        assert!(factored <= 1 + most as usize + taken.rejected / 8, "{factored}: {taken:?}");
    }
}

/// What stands still is not taken for moving: after the first row the steps are as long as they may be.
#[test]
fn what_stands_still_takes_long_steps() {
    let machine = stop::machine();
    let rest = -stop::GAP - PUSH / stop::STIFFNESS;
    let (_, outcome) = marched(&machine, automatic(1e-2, 100, 1e-6), [rest, 0.0]);
    let taken = outcome.parts.expect("chosen");
    assert_eq!((taken.parts, taken.rejected), (99 + BEGINNING, 0), "{taken:?}");
}

/// Loads that begin at once, more of them in a step than are located in one part: parabolas, exactly.
#[test]
fn parts_end_where_loads_begin() {
    let shaft = Shaft::lumped(2.0, [0.0; 2], [0.0; 2], 0.0);
    let mut parts = parts(shaft, Support::rigid(&[]), Rotation::Held);
    let node = parts.bodies[0].nodes()[0].clone();
    let starts = [1.1e-3, 2.3e-3, 2.4e-3, 4.7e-3, 7.9e-3];
    parts.loads = starts
        .map(|start| Load {
            onset: Onset::Step(start),
            ..force(&node, [3.0, 0.0, 0.0], TimeFunction::Constant, Frame::Space)
        })
        .into();
    let machine = Machine::new(parts).expect("a machine");
    let (path, outcome) = marched(&machine, automatic(1e-2, 1, 1e-2), [0.0; 2]);
    let exact: f64 = starts.iter().map(|start| 0.5 * 1.5 * (1e-2 - start).powi(2)).sum();
    // Nothing is left but rounding of q̈ Δt² and of the residuals, 1e-10 of the force.
    assert!(
        (path[0][0] / exact - 1.0).abs() < 1e-9,
        "{} for {exact}: {:?}",
        path[0][0],
        outcome.parts
    );
}

/// A load that is faster than the rows is followed: parts are no longer than they may be.
#[test]
fn parts_are_no_longer_than_what_acts() {
    let machine = stop::machine();
    let mut options = automatic(1e-2, 3, 1e-2);
    options.automatic = Some(AutomaticStep { tolerance: 1e-2, longest: 3e-4 });
    let (_, outcome) = marched(&machine, options, [0.0, 0.0]);
    let taken = outcome.parts.expect("chosen");
    // The first of 64 parts of the first row takes one for each halving beyond, and one.
    let parts = 3 * 64 - 1 + BEGINNING - 6;
    assert_eq!((taken.parts, taken.rejected, taken.halvings), (parts, 0, Some([6, 14])));
}
