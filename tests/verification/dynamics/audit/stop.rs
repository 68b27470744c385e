//! A mass of 1 kg between two stops of 1e9 N/m at ±50 mm, thrown at 1 m/s and pushed by 10 N. The equations of
//! a Newmark step are linear in pieces: each step has a closed form.

use std::f64::consts::PI;

use whirl_solver::dynamics::March;
use whirl_solver::loads::{Frame, TimeFunction};
use whirl_solver::machine::{Machine, Rotation};
use whirl_solver::shaft::Shaft;
use whirl_solver::support::Support;

use super::super::{force, parts, stops};
use super::{STIFF, strict};

pub(in super::super) const STIFFNESS: f64 = 1e9;
pub(in super::super) const GAP: f64 = 0.05;
const PUSH: f64 = -10.0;

pub(in super::super) fn machine() -> Machine {
    let shaft = Shaft::lumped(1.0, [0.0; 2], [0.0; 2], 0.0);
    let mut parts = parts(shaft, Support::rigid(&[]), Rotation::Held);
    parts.laws = vec![Box::new(&STIFF)];
    parts.bearings = vec![stops("above", GAP, &[0.0], 0), stops("below", GAP, &[PI], 0)];
    let node = &parts.bodies[0].nodes()[0];
    parts.loads = vec![force(node, [PUSH, 0.0, 0.0], TimeFunction::Constant, Frame::Space)];
    Machine::new(parts).expect("a machine")
}

/// Position, velocity and acceleration after one step: a + a2 (x' − x̂) = F + Q(x'), solved in each of the three
/// pieces; the one in which its own solution lies is right, since F + Q falls with x'.
fn closed_form([x, v, a]: [f64; 3], dt: f64) -> [f64; 3] {
    let a2 = 4.0 / (dt * dt);
    let predicted = x + dt * v + 0.5 * dt * dt * a;
    let moved = (PUSH - a) / a2;
    let between = predicted + moved;
    // x' = x̂ + c, with c from the depth so that nothing cancels.
    let correction = if between > GAP {
        (PUSH - a - STIFFNESS * (predicted - GAP)) / (a2 + STIFFNESS)
    } else if between < -GAP {
        (PUSH - a - STIFFNESS * (predicted + GAP)) / (a2 + STIFFNESS)
    } else {
        moved
    };
    [predicted + correction, v + dt * a + 2.0 / dt * correction, a + a2 * correction]
}

#[test]
fn a_mass_between_stiff_stops_follows_its_closed_form() {
    let machine = machine();
    for (time_step, steps) in [(1e-3, 500), (1e-4, 5000), (1e-5, 50_000)] {
        let mut options = strict(time_step, steps);
        [options.initial[0].position, options.initial[0].velocity] =
            [vec![0.0; 2], vec![-1.0, 0.0]];
        let mut march = March::new(&machine, &options).expect("starts");
        let mut last = [0.0, -1.0, PUSH];
        let mut farthest = 0.0_f64;
        for step in 1..=steps {
            march.advance().unwrap_or_else(|error| panic!("{error}"));
            let state = march.state();
            let found = [state.q[1], state.v[1], state.a[1]];
            let [x, v, a] = closed_form(last, time_step);
            // Each from the solver's own state before: what differs is what is left of a row, 1e-6 of its
            // largest term, over a2 + k, and rounding of the place.
            let largest = a.abs().max(last[2].abs()).max(PUSH.abs());
            let stiff = 4.0 / (time_step * time_step);
            let allowed = 1e-6 * largest / stiff + 4.0 * f64::EPSILON * GAP;
            let wrong = (found[0] - x).abs();
            assert!(wrong <= allowed, "Δt = {time_step}, step {step}: {} for {x}", found[0]);
            assert!((found[1] - v).abs() <= 2.0 / time_step * allowed, "step {step}");
            farthest = farthest.max(found[0].abs());
            last = found;
        }
        // Where the stop is resolved the mass goes as far as its energy presses, not as the longer steps make it.
        let energy = 0.5 + PUSH.abs() * 2.0 * GAP;
        let deepest = GAP + (2.0 * energy / STIFFNESS).sqrt();
        assert!(time_step > 1e-5 || farthest < 1.001 * deepest, "{farthest} m");
    }
}
