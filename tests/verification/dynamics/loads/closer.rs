//! Rows of tables, ends of ramps and jumps that are closer than steps, wherever in a step they are.

use std::f64::consts::TAU;
use std::sync::Arc;

use whirl_solver::curve::Curve;
use whirl_solver::dynamics::{AutomaticStep, BodyStart, March, MarchOptions};
use whirl_solver::loads::{Frame, Load, Onset, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::schedule::Schedule;
use whirl_solver::support::Support;

use super::{end, rigid_turn};
use crate::dynamics::{DISCS, INERTIA, discs, force, options, parts};

/// Numbers from 0 to 1 in no order, the same every time.
fn random(count: usize) -> Vec<f64> {
    let mut seed = 7_u64;
    let mut next = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    (0..count).map(|_| next()).collect()
}

/// A rotor of one body under couples about its axis, one after the other.
fn rotor(couples: Vec<Load>, rotation: Rotation) -> Machine {
    let mut parts = parts(discs(1e5), Support::rigid(&[]), rotation);
    parts.loads = couples;
    Machine::new(parts).expect("a machine")
}

fn couple(time_function: TimeFunction) -> Load {
    Load::couple(0, rigid_turn(), [0.0, 0.0, 1.0], time_function, Frame::Body)
}

fn over_time(rows: &[[f64; 2]], periodic: bool) -> TimeFunction {
    TimeFunction::OverTime(Arc::new(Curve::linear(rows, periodic).expect("a curve")))
}

/// Errors of a state at a time that is reached in steps of three lengths, each half as long as the one before, against that of
/// much shorter ones, as parts of the largest coordinate.
fn errors(end_at: f64, steps: usize, state: impl Fn(f64, usize) -> Vec<f64>) -> [f64; 3] {
    let of = |steps: usize| state(end_at / steps as f64, steps);
    let exact = of(64 * steps);
    let size = exact.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    [1, 2, 4].map(|k| {
        let found = of(k * steps);
        found.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
    })
}

/// 1 N m s in 2 µs: between the ends of a step, across one, on one, and in one part of a step that the program chooses.
#[test]
fn a_pulse_shorter_than_a_step_has_its_impulse_where_it_is() {
    const WIDTH: f64 = 1e-6;
    let (dt, steps) = (1e-4, 1000);
    let at = random(12).into_iter().map(|x| 0.01 + 0.08 * x).chain([0.01, 0.010_000_4]);
    for at in at {
        let peak = 1.0 / WIDTH;
        let rows = [[at - WIDTH, 0.0], [at, peak], [at + WIDTH, 0.0]];
        let machine = rotor(vec![couple(over_time(&rows, false))], Rotation::Free);
        for automatic in [None, Some(AutomaticStep::default())] {
            let length = if automatic.is_some() { 10.0 * dt } else { dt };
            let steps = (dt * steps as f64 / length).round() as usize;
            let options = MarchOptions { automatic, ..options(length, steps) };
            let state = end(&machine, &options);
            let after = length * steps as f64 - at;
            // Rounding of times, of which a ten-thousandth part is the width of the pulse; and Δt² Δq̈/12 of its flanks.
            let checks = [
                (state.v[0], 1.0 / INERTIA, 1e-8),
                (state.q[0], after / INERTIA, WIDTH / 12.0 / after + 1e-8),
            ];
            for (found, exact, allowed) in checks {
                let error = (found / exact - 1.0).abs();
                assert!(error < allowed, "{at} {automatic:?}: {found} {exact}");
            }
        }
    }
}

/// Rows that are as good as a jump: at the same time but for rounding.
#[test]
fn rows_that_all_but_meet_are_a_jump() {
    for (at, apart) in [(0.010_03, 1e-13), (0.01, 1e-13), (0.010_03, 1e-8), (0.01 - 1e-12, 1e-12)] {
        let rows = [[0.0, 0.0], [at, 0.0], [at + apart, 5.0], [1.0, 5.0]];
        let machine = rotor(vec![couple(over_time(&rows, false))], Rotation::Free);
        let state = end(&machine, &options(1e-4, 200));
        let exact = 5.0 * (0.02 - at - 0.5 * apart) / INERTIA;
        assert!((state.v[0] / exact - 1.0).abs() < 1e-9, "{at} {apart}: {} {exact}", state.v[0]);
    }
}

/// On discs that bend: pulses of four rows at random times within a twentieth of a step; 23 waves in a period of 24 steps; ramps
/// shorter than a step, of a constant force and of one that varies. Rows that come closer than
/// the shortest of these steps are wrong by less than a sine that all of them resolve.
#[test]
fn what_rows_and_ramps_move_is_of_second_order() {
    let end_at = 0.04;
    let pulses = random(12).into_iter().enumerate().flat_map(|(k, x)| {
        let at = end_at * (k as f64 + x) / 12.0;
        let sizes = [0.0, 900.0 * (x - 0.3), 1200.0 * (0.6 - x), 0.0];
        (0..4).map(move |row| [at + 1e-5 * f64::from(row), sizes[row as usize]])
    });
    let pulses: Vec<[f64; 2]> = pulses.collect();
    let period = end_at / 4.0;
    let wave = |i: u32| {
        let u = f64::from(i) / 460.0;
        [period * u, 300.0 * (TAU * 23.0 * u).sin() + 20.0]
    };
    let mut waves: Vec<[f64; 2]> = (0..=460).map(wave).collect();
    waves[460][1] = waves[0][1];
    let ramp = Onset::Ramp(0.011_13, 0.011_19);
    let sine = TimeFunction::Sine { frequency: 60.0, phase: 0.3 };
    let of = |time_function: &TimeFunction, onset: Onset| {
        errors(end_at, 96, |dt, steps| {
            let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Held);
            let node = parts.bodies[0].nodes()[1].clone();
            let load = force(&node, [1.0, 0.0, 0.0], time_function.clone(), Frame::Space);
            parts.loads = vec![load.from(onset)];
            let machine = Machine::new(parts).expect("a machine");
            end(&machine, &options(dt, steps)).q
        })
    };
    let resolved = of(&sine, Onset::Start);
    println!("a sine: {resolved:?}");
    assert!((14.0..18.0).contains(&(resolved[0] / resolved[2])), "{resolved:?}");
    let cases: [(&str, TimeFunction, Onset); 4] = [
        ("pulses", over_time(&pulses, false), Onset::Start),
        ("waves", over_time(&waves, true), Onset::Start),
        ("ramp", TimeFunction::Constant, ramp),
        ("ramp of a sine", sine, ramp),
    ];
    for (what, time_function, onset) in cases {
        let found = of(&time_function, onset);
        println!("{what}: {found:?}");
        match onset {
            Onset::Start => {
                let least = found.iter().zip(&resolved).all(|(found, resolved)| found < resolved);
                assert!(least, "{what}: {found:?} {resolved:?}");
            }
            _ => assert!((12.0..20.0).contains(&(found[0] / found[2])), "{what}: {found:?}"),
        }
    }
}

/// The energy that a rotor gains is the area under the couple over its angle, however fast it passes it and in whichever
/// direction; and under that over its speed it takes its time.
#[test]
fn what_is_narrow_over_an_angle_or_a_speed_is_passed_in_parts() {
    // Between these rows cubics have no slope at either end, and the area of straight lines.
    let width = 2e-3;
    let area = 1.5;
    let pulse = |at: f64| [[at - width, 0.0], [at, area / width], [at + width, 0.0]];
    let mut rows = vec![[0.0, 0.0]];
    rows.extend([0.9, 2.0, 4.123].map(pulse).concat());
    rows.push([TAU, 0.0]);
    for (periodic, speed, passed) in [(true, 80.0, 9), (false, 80.0, 3), (true, -80.0, -6)] {
        let curve = Arc::new(Curve::smooth(&rows, periodic).expect("a curve"));
        let load = couple(TimeFunction::OverAngle { body: 0, curve });
        let machine = rotor(vec![load], Rotation::Free);
        let mut options = options(5e-4, 600);
        options.initial[0].speed = speed;
        let mut march = March::new(&machine, &options).expect("starts");
        while !march.is_done() && march.state().q[0].abs() < TAU * f64::from(passed).abs() / 3.0 {
            march.advance().expect("converges");
        }
        let found = 0.5 * INERTIA * march.state().v[0].powi(2);
        let gained = found - 0.5 * INERTIA * speed.powi(2);
        let exact = f64::from(passed) * area;
        // A row is missed by M τ²/(6 J) = area/(6 J ω²) of the width, where the couple acts in the part before it.
        let missed = area / (6.0 * INERTIA * speed.powi(2));
        assert!((gained / exact - 1.0).abs() < missed, "{periodic} {speed}: {gained} for {exact}");
    }
}

/// A couple that all but vanishes between two speeds: the rotor takes its time there.
#[test]
fn a_rotor_is_held_up_where_its_couple_has_a_dip_over_the_speed() {
    let (full, low) = (20.0, 0.4);
    let (from, to, flank) = (50.0, 50.2, 0.01);
    let rows = [
        [0.0, full],
        [from - flank, full],
        [from, low],
        [to, low],
        [to + flank, full],
        [900.0, full],
    ];
    let curve = Arc::new(Curve::linear(&rows, false).expect("a curve"));
    let machine = rotor(vec![couple(TimeFunction::OverSpeed(curve))], Rotation::Free);
    let flanks = 2.0 * flank * (full / low).ln() / (full - low);
    let time = 0.05 + INERTIA * ((from - flank) / full + flanks + (to - from) / low);
    let steps = 400;
    let state = end(&machine, &options(time / f64::from(steps), steps as usize));
    let exact = to + flank + 0.05 * full / INERTIA;
    // By no more than what the couple gives in the time of a flank, which parts of a step pass at a time.
    let allowed = full * flanks;
    println!("{} for {exact}, {allowed}", state.v[0]);
    assert!((state.v[0] - exact).abs() < allowed, "{} for {exact}", state.v[0]);
}

/// A told speed with seven kinks in one step, and five loads that begin in one.
#[test]
fn many_jumps_in_a_step_are_of_second_order() {
    let end_at = 0.04;
    let kinks: Vec<f64> = random(7).into_iter().map(|x| 0.02 + 2e-4 * x).collect();
    let state = |dt: f64, steps: usize| {
        let mut times = kinks.clone();
        times.sort_by(f64::total_cmp);
        let mut rows = vec![[0.0, 20.0]];
        rows.extend(times.iter().zip(random(8)).map(|(t, x)| [*t, 20.0 + 0.3 * x]));
        rows.push([0.06, 60.0]);
        let schedule = Arc::new(Schedule::of_speeds(&rows).expect("rises"));
        let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Scheduled(schedule));
        let node = parts.bodies[0].nodes()[1].clone();
        let pushes = kinks.iter().take(5).zip([1.0, -1.0, 2.0, -1.5, 0.3]).map(|(t, size)| {
            let push = [30.0 * size, 10.0, 0.0];
            force(&node, push, TimeFunction::Constant, Frame::Space).from(Onset::Step(t + 1e-5))
        });
        parts.loads = pushes.collect();
        let machine = Machine::new(parts).expect("a machine");
        let velocity = [2.0, 0.0].repeat(DISCS);
        let start = BodyStart { velocity, ..BodyStart::default() };
        end(&machine, &MarchOptions { initial: vec![start], ..options(dt, steps) }).q
    };
    let found = errors(end_at, 96, state);
    println!("jumps: {found:?}");
    assert!(found[0] / found[2] > 12.0 && found[0] / found[2] < 20.0, "{found:?}");
}

/// Cut where steps are cut: within a pulse, and at its peak; by time and by angle.
#[test]
fn a_march_cut_within_a_pulse_has_the_bits_of_the_whole_one() {
    const STEPS: usize = 60;
    let dt = 1e-3;
    let pulse = [[0.0, 0.0], [0.029_2, 0.0], [0.030, 900.0], [0.030_1, 0.0], [0.031_4, 50.0]];
    let narrow = [[0.0, 0.0], [0.5, 0.0], [0.51, 40.0], [0.52, 0.0], [1.0, 0.0]];
    let over_angle = |body: usize| TimeFunction::OverAngle {
        body,
        curve: Arc::new(Curve::smooth(&narrow, true).expect("a curve")),
    };
    for automatic in [None, Some(AutomaticStep::default())] {
        let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
        let node = parts.bodies[0].nodes()[1].clone();
        let push = force(&node, [30.0, 0.0, 0.0], over_angle(0), Frame::Space);
        parts.loads = vec![push, couple(over_time(&pulse, false)), couple(over_angle(0))];
        let machine = Machine::new(parts).expect("a machine");
        let mut options = MarchOptions { automatic, ..options(dt, STEPS) };
        options.initial[0].speed = 150.0;
        let rest = |march: &mut March| {
            let mut rows = Vec::new();
            while !march.is_done() {
                march.advance().expect("converges");
                rows.push(march.row().iter().map(|x| x.to_bits()).collect::<Vec<u64>>());
            }
            rows
        };
        let whole = rest(&mut March::new(&machine, &options).expect("starts"));
        for cut in [29, 30, 31, 40] {
            let mut first = March::new(&machine, &options).expect("starts");
            (0..cut).for_each(|_| first.advance().expect("converges"));
            let left = MarchOptions { steps: STEPS - cut, ..options.clone() };
            let mut second =
                March::from_last(&machine, &left, &first.last_state()).expect("the same bodies");
            assert!(rest(&mut second) == whole[cut..], "restarted after {cut}, {automatic:?}");
            let mut second =
                March::resume(&machine, &options, first.checkpoint()).expect("resumes");
            assert!(rest(&mut second) == whole[cut..], "resumed after {cut}, {automatic:?}");
        }
    }
}

/// What cannot be known before: a free rotor that outruns an order, and the steps that the program chooses for it.
#[test]
fn orders_have_23_steps_in_a_period_or_the_run_says_so() {
    for (order, speed, fewest) in [(40.0, 100.0, 15.7), (-40.0, -60.0, 26.2), (0.0, 100.0, 0.0)] {
        let order = TimeFunction::Order { body: 0, order, phase: 0.0 };
        let machine = rotor(vec![couple(order)], Rotation::Free);
        let mut options = options(1e-4, 50);
        options.initial[0].speed = speed;
        let mut march = March::new(&machine, &options).expect("starts");
        while !march.is_done() {
            march.advance().expect("converges");
        }
        let found = march.outcome().quality.fewest_steps;
        match found {
            Some(own) => assert!((own.steps / fewest - 1.0).abs() < 0.01, "{own:?}"),
            None => assert_eq!(fewest, 0.0),
        }
        options.automatic = Some(AutomaticStep { tolerance: 1e3, ..AutomaticStep::default() });
        (options.time_step, options.steps) = (2e-3, 5);
        let mut march = March::new(&machine, &options).expect("starts");
        while !march.is_done() {
            march.advance().expect("converges");
        }
        let chosen = march.outcome().quality.fewest_steps;
        assert!(chosen.is_none_or(|own| own.steps >= 23.0), "{chosen:?}");
    }
}
