//! A couple that ends at a speed: θ against the exact solution.

use std::sync::Arc;

use whirl_solver::curve::Curve;
use whirl_solver::dynamics::{March, MarchOptions, NewtonOptions};
use whirl_solver::loads::{Frame, Load, Release, Target, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::support::Support;

use super::{end, rigid_turn};
use crate::dynamics::{INERTIA, discs, options, parts};

/// N·m, N·m·s, and rad/s.
const TORQUE: f64 = 40.0;
const DRAG: f64 = 0.1;
const TARGET: f64 = 150.0;
const END: f64 = 0.5;

/// A rotor that a couple turns against a drag in proportion to its speed, until it is at its target.
fn machine(sign: f64, release: Release) -> Machine {
    let mut parts = parts(discs(1e5), Support::rigid(&[]), Rotation::Free);
    let drag = Curve::linear(&[[-1e3, DRAG * 1e3], [1e3, -DRAG * 1e3]], false).expect("a curve");
    let until =
        TimeFunction::UntilSpeed(Target { speed: sign * TARGET, from_above: sign < 0.0, release });
    parts.loads = vec![
        Load::couple(0, rigid_turn(), [0.0, 0.0, sign * TORQUE], until, Frame::Body),
        Load::couple(
            0,
            rigid_turn(),
            [0.0, 0.0, 1.0],
            TimeFunction::OverSpeed(Arc::new(drag)),
            Frame::Body,
        ),
    ];
    Machine::new(parts).expect("a machine")
}

/// When it is at its target (s), and θ at the end (rad).
fn exact() -> [f64; 2] {
    let (rate, most) = (DRAG / INERTIA, TORQUE / DRAG);
    let at = -(1.0 - TARGET / most).ln() / rate;
    let up = most * (at - TARGET / most / rate);
    [at, up + TARGET / rate * (1.0 - (-rate * (END - at)).exp())]
}

/// |error of θ| at the end with steps of which the target is reached in the middle of one.
fn error(sign: f64, release: Release, steps: f64) -> f64 {
    let [at, theta] = exact();
    let dt = at / (steps + 0.5);
    let whole = (END / dt).floor();
    // θ at the end of the last step, carried on exactly.
    let machine = machine(sign, release);
    let state = end(&machine, &options(dt, whole as usize));
    let (rate, rest) = (DRAG / INERTIA, END - whole * dt);
    let carried = state.q[0] + state.v[0] / rate * (1.0 - (-rate * rest).exp());
    (sign * carried - theta).abs()
}

#[test]
fn theta_is_of_second_order_where_the_release_is_located() {
    for sign in [1.0, -1.0] {
        let errors = |release| [50.0, 101.0, 203.0].map(|steps| error(sign, release, steps));
        let (located, at_step) = (errors(Release::Located), errors(Release::AtStep));
        println!("θ: located {located:?}, at a step {at_step:?}");
        for pair in located.windows(2) {
            assert!((3.6..4.4).contains(&(pair[0] / pair[1])), "{located:?}");
        }
        for pair in at_step.windows(2) {
            assert!((1.8..2.3).contains(&(pair[0] / pair[1])), "{at_step:?}");
        }
        assert!(at_step[2] > 20.0 * located[2], "{at_step:?} {located:?}");
    }
}

/// From 200 rad/s a couple the other way brakes to the target, which is above zero, zero or below it.
#[test]
fn a_couple_brakes_to_a_target_below_the_start() {
    const START: f64 = 200.0;
    let (rate, most) = (DRAG / INERTIA, TORQUE / DRAG);
    for (sign, target) in
        [(1.0, 150.0), (-1.0, 150.0), (1.0, 0.0), (1.0, -50.0), (-1.0, 0.0), (-1.0, -50.0)]
    {
        let at = ((START + most) / (target + most)).ln() / rate;
        let down = (START + most) / rate * (1.0 - (-rate * at).exp()) - most * at;
        let rest = 0.01;
        let theta = down + target / rate * (1.0 - (-rate * rest).exp());
        let errors = [50.0, 101.0, 203.0].map(|steps| {
            let dt = at / (steps + 0.5);
            let whole = ((at + rest) / dt).floor();
            let mut machine = machine(-sign, Release::Located);
            let until = TimeFunction::UntilSpeed(Target {
                speed: sign * target,
                from_above: sign > 0.0,
                release: Release::Located,
            });
            machine.loads[0].time_function = until;
            let mut options = options(dt, whole as usize);
            options.initial[0].speed = sign * START;
            let state = end(&machine, &options);
            let left = at + rest - whole * dt;
            let carried = state.q[0] + state.v[0] / rate * (1.0 - (-rate * left).exp());
            let speed = sign * target * (-rate * (whole * dt - at)).exp();
            assert!((state.v[0] - speed).abs() < 1e-4 * START, "{} for {speed}", state.v[0]);
            (sign * carried - theta).abs()
        });
        println!("from {START} to {target} rad/s, {sign}: {errors:?}");
        for pair in errors.windows(2) {
            assert!((3.6..4.4).contains(&(pair[0] / pair[1])), "{errors:?}");
        }
    }
}

/// The speed is met, not passed; the energy stays balanced through the split step, and all its rows are solved.
#[test]
fn a_split_step_is_as_good_as_any() {
    let machine = machine(1.0, Release::Located);
    let options = options(7e-4, 600);
    let mut march = March::new(&machine, &options).expect("starts");
    let mut fastest: f64 = 0.0;
    while !march.is_done() {
        march.advance().expect("the step converges");
        fastest = fastest.max(march.row()[2]);
        if (march.row()[2] - fastest).abs() > 0.0 {
            break;
        }
    }
    assert!(fastest <= TARGET && fastest > TARGET - 1.0, "{fastest}");
    while !march.is_done() {
        march.advance().expect("the step converges");
    }
    let outcome = march.outcome();
    assert!(outcome.energy.error_fraction() < 1e-9, "{:?}", outcome.energy);
    assert!(outcome.quality.row_error <= 1.0, "{:?}", outcome.quality);
    assert_eq!(outcome.halved_steps, 0);
}

/// A body that starts beyond the target is not driven at all.
#[test]
fn a_target_that_is_passed_at_the_start_ends_the_couple_there() {
    let machine = machine(1.0, Release::Located);
    let mut options = MarchOptions { newton: NewtonOptions::default(), ..options(1e-3, 200) };
    options.initial[0].speed = 200.0;
    let state = end(&machine, &options);
    let slowed = 200.0 * (-DRAG / INERTIA * 0.2).exp();
    assert!((state.v[0] / slowed - 1.0).abs() < 1e-5, "{} for {slowed}", state.v[0]);
}
