//! Loads that begin at once, and told speeds with kinks, in the middle of a step, elsewhere in it and at its end.

use std::sync::Arc;

use whirl_solver::curve::Curve;
use whirl_solver::dynamics::{BodyStart, March, MarchOptions};
use whirl_solver::loads::{Frame, Load, Onset, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::schedule::Schedule;
use whirl_solver::support::Support;

use super::{end, rigid_turn};
use crate::dynamics::{DISCS, INERTIA, discs, force, options, parts};

/// Where in a step a jump is, as a part of it; at 1 it is at its end.
const PLACES: [f64; 4] = [0.25, 0.5, 0.8, 1.0];
/// s.
const JUMP: f64 = 0.05;

/// Errors with steps of which so many and a part end at the jump.
fn errors(place: f64, error: impl Fn(f64) -> f64) -> [f64; 3] {
    [40.0, 80.0, 160.0].map(|steps| error(JUMP / (steps - 1.0 + place)))
}

fn second_order(errors: [f64; 3], what: &str) {
    println!("{what}: {errors:?}");
    for pair in errors.windows(2) {
        assert!((3.5..4.6).contains(&(pair[0] / pair[1])), "{what}: {errors:?}");
    }
}

/// A couple that begins at once on a rotor that a drag slows down.
#[test]
fn theta_is_of_second_order_where_a_load_begins() {
    const SPEED: f64 = 100.0;
    let (torque, drag) = (40.0, 0.1);
    for place in PLACES {
        let error = |dt: f64| {
            let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
            let slow = Curve::linear(&[[-1e3, drag * 1e3], [1e3, -drag * 1e3]], false);
            let over = TimeFunction::OverSpeed(Arc::new(slow.expect("a curve")));
            let couple = |size: f64, time_function: TimeFunction| {
                Load::couple(0, rigid_turn(), [0.0, 0.0, size], time_function, Frame::Body)
            };
            parts.loads = vec![
                couple(torque, TimeFunction::Constant).from(Onset::Step(JUMP)),
                couple(1.0, over),
            ];
            let machine = Machine::new(parts).expect("a machine");
            let mut options = options(dt, (2.0 * JUMP / dt) as usize);
            options.initial[0].speed = SPEED;
            let state = end(&machine, &options);
            let (rate, most) = (drag / INERTIA, torque / drag);
            let slowed = |speed: f64, t: f64| speed / rate * (1.0 - (-rate * t).exp());
            let after = options.steps as f64 * dt - JUMP;
            let exact = slowed(SPEED, JUMP)
                + slowed(SPEED * (-rate * JUMP).exp() - most, after)
                + most * after;
            (state.q[0] - exact).abs()
        };
        second_order(errors(place, error), &format!("θ, {place} of a step"));
    }
}

/// A shaft that nothing holds flies straight on, however the frame turns in which it is seen.
#[test]
fn flight_is_of_second_order_where_a_told_speed_has_a_kink() {
    const FLIGHT: f64 = 2.0;
    for place in PLACES {
        let error = |dt: f64| {
            let rows = [[0.0, 20.0], [JUMP, 20.0], [2.0 * JUMP, 60.0]];
            let schedule = Arc::new(Schedule::of_speeds(&rows).expect("rises"));
            let parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Scheduled(schedule));
            let machine = Machine::new(parts).expect("a machine");
            let velocity = [FLIGHT, 0.0].repeat(DISCS);
            let start = BodyStart { velocity, ..BodyStart::default() };
            let steps = (1.8 * JUMP / dt) as usize;
            let options = MarchOptions { initial: vec![start], ..options(dt, steps) };
            let state = end(&machine, &options);
            let (sin, cos) = state.q[0].sin_cos();
            let [x, y] = [state.q[1], state.q[2]];
            let flown = [cos * x - sin * y, sin * x + cos * y];
            (flown[0] - FLIGHT * steps as f64 * dt).hypot(flown[1])
        };
        second_order(errors(place, error), &format!("flight, {place} of a step"));
    }
}

/// Cut before a jump, in the step after which it is, and after it.
#[test]
fn a_march_cut_at_a_jump_has_the_bits_of_the_whole_one() {
    const STEPS: usize = 60;
    for place in PLACES {
        let rows = [[0.0, 20.0], [JUMP, 20.0], [2.0 * JUMP, 60.0]];
        let schedule = Arc::new(Schedule::of_speeds(&rows).expect("rises"));
        let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Scheduled(schedule));
        let node = parts.bodies[0].nodes()[1].clone();
        let push = force(&node, [30.0, 0.0, 0.0], TimeFunction::Constant, Frame::Space);
        parts.loads = vec![push.from(Onset::Step(JUMP))];
        let machine = Machine::new(parts).expect("a machine");
        let options = options(JUMP / (39.0 + place), STEPS);
        let rest = |march: &mut March| {
            let mut rows = Vec::new();
            while !march.is_done() {
                march.advance().expect("converges");
                rows.push(march.row().iter().map(|x| x.to_bits()).collect::<Vec<u64>>());
            }
            rows
        };
        let whole = rest(&mut March::new(&machine, &options).expect("starts"));
        for cut in [39, 40, 41] {
            let mut first = March::new(&machine, &options).expect("starts");
            (0..cut).for_each(|_| first.advance().expect("converges"));
            let left = MarchOptions { steps: STEPS - cut, ..options.clone() };
            let mut second =
                March::from_last(&machine, &left, &first.last_state()).expect("the same bodies");
            assert!(rest(&mut second) == whole[cut..], "restarted after {cut}, {place}");
            let mut second =
                March::resume(&machine, &options, first.checkpoint()).expect("resumes");
            assert!(rest(&mut second) == whole[cut..], "resumed after {cut}, {place}");
        }
    }
}
