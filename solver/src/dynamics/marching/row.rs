//! The row of the history that a step gives.

use crate::equations::{Equations, State, displaced, frame_of, turn};
use crate::monitor::Displaced;

/// Places of the journals' displacements in a row of a machine with so many bearings.
pub(super) fn displacements(bearings: usize) -> std::ops::Range<usize> {
    3 + 2 * bearings..3 + 4 * bearings
}

/// Writes the row, without outputs by request, of the step that ends at `time` (s) at a state just evaluated, one value a column of
/// [`History::for_machine`](crate::history::History::for_machine).
// A phase of its own in tables of where the time goes.
#[inline(never)]
pub(crate) fn write_row(
    equations: &Equations,
    state: &State,
    time: f64,
    iterations: usize,
    row: &mut [f64],
) {
    let machine = equations.machine;
    let bearings = machine.monitors.len();
    let mut other = 3 + 6 * bearings;
    let mut turning = machine.turning().map(|body| turn(machine, body, (state, time)));
    let [theta, speed] = turning.next().unwrap_or_default();
    row[..3].copy_from_slice(&[time, theta, speed]);
    for (k, joint) in machine.monitors.iter().enumerate() {
        let frame = frame_of(machine, joint.bodies[0], &state.q);
        let reaction = frame.to_space(equations.joint_force(joint));
        let Displaced { journal, deformation } = displaced(machine, joint, (state, time));
        for axis in 0..2 {
            let place = 3 + 2 * k + axis;
            row[place] = reaction[axis];
            row[place + 2 * bearings] = 1e6 * journal[axis];
            row[place + 4 * bearings] = 1e6 * deformation[axis];
        }
        if joint.torque {
            row[other] = equations.joint_torque(joint);
            other += 1;
        }
        if let Some(moment) = equations.joint_moment(joint) {
            row[other..other + 2].copy_from_slice(&frame.to_space(moment));
            other += 2;
        }
        if let Some(force) = equations.axial_force(joint) {
            row[other] = force;
            other += 1;
        }
    }
    for own in turning {
        row[other..other + 2].copy_from_slice(&own);
        other += 2;
    }
    for body in machine.driven() {
        let theta = machine.places()[body].rotation.expect("it turns");
        // What is left in its row is what the couple has to bring, with the sign changed.
        row[other] = -equations.residual[theta];
        other += 1;
    }
    *row.last_mut().expect("columns") = iterations as f64;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamics::small::{FORCE, machine, state};
    use crate::history::History;
    use crate::loads::Frame;
    use crate::machine::{Machine, Rotation};
    use crate::output::{JointQuantity, Motion, Output, Wanted};

    fn output(name: &str, what: Wanted) -> Output {
        Output { name: name.to_owned(), what }
    }

    /// Every kind of output of the small machine, and their columns by name.
    fn with_all() -> Machine {
        let machine = machine(Rotation::Free);
        let point = machine.bodies[0].nodes()[0].clone();
        let mut all = Vec::new();
        for (frame, own) in [(Frame::Space, "space"), (Frame::Body, "body")] {
            for motion in [Motion::Displacement, Motion::Velocity, Motion::Acceleration] {
                let (point, components) = (point.clone(), vec![0, 1, 2]);
                let what = Wanted::Motion { body: 0, point, motion, frame, components };
                all.push(output(own, what));
            }
            for quantity in [JointQuantity::Force, JointQuantity::Deformation, JointQuantity::Rate]
            {
                all.push(output(own, Wanted::Joint { joint: 2, quantity, frame }));
            }
        }
        for quantity in [JointQuantity::Torque, JointQuantity::Twist, JointQuantity::TwistRate] {
            all.push(output("ring", Wanted::Joint { joint: 2, quantity, frame: Frame::Space }));
        }
        for (body, name) in [(0, "shaft"), (1, "support")] {
            all.push(output(name, Wanted::Energy { body }));
            all.push(output(name, Wanted::Power { body }));
        }
        let joints = (0..3).map(|k| output(&format!("j{k}"), Wanted::JointPower { joint: k }));
        machine.with_outputs(all.into_iter().chain(joints).collect()).expect("outputs")
    }

    /// The state a little later or earlier, with θ = 0.7 rad at t = 0: all frames differ.
    fn at(t: f64) -> State {
        let mut state = state(5);
        state.q[0] = 0.7;
        for i in 0..5 {
            let (v, a) = (state.v[i], state.a[i]);
            state.q[i] += t * (v + 0.5 * t * a);
            state.v[i] += t * a;
        }
        state
    }

    fn values(machine: &Machine, state: &State) -> impl Fn(&str) -> f64 + use<> {
        let history = History::for_machine(machine);
        let names = history.names().to_vec();
        let usual = names.iter().position(|name| name == "iterations").expect("a column") + 1;
        let mut row = vec![f64::NAN; names.len()];
        let mut equations = Equations::new(machine);
        equations.evaluate(0.0, state);
        let (first, asked) = row.split_at_mut(usual);
        write_row(&equations, state, 0.0, 3, first);
        equations.write_outputs(state, 0.0, asked);
        assert!(row.iter().all(|value| value.is_finite()), "{row:?}");
        move |name| {
            row[names.iter().position(|own| own == name).unwrap_or_else(|| panic!("{name}"))]
        }
    }

    /// Velocities and accelerations are the differences of what they are the rates of.
    #[test]
    fn rates_are_differences() {
        const STEP: f64 = 1e-5;
        let machine = with_all();
        let [before, now, after] = [-STEP, 0.0, STEP].map(|t| values(&machine, &at(t)));
        let mut pairs = Vec::new();
        for frame in ["space", "body"] {
            for axis in ["x", "y", "z"] {
                let named = |letter: &str, unit: &str| format!("{letter}{axis}_{frame}_{unit}");
                pairs.push((named("", "um"), named("v", "mm_s"), 1e-3));
                pairs.push((named("v", "mm_s"), named("a", "m_s2"), 1e-3));
                if axis != "z" {
                    pairs.push((named("d", "um"), named("dv", "mm_s"), 1e-3));
                }
            }
        }
        pairs.push(("twist_ring_rad".into(), "twist_rate_ring_rad_s".into(), 1.0));
        for (value, rate, scale) in pairs {
            let found = scale * (after(&value) - before(&value)) / (2.0 * STEP);
            let expected = now(&rate);
            assert!(
                (found - expected).abs() <= 1e-6 * expected.abs().max(1.0),
                "{rate}: {found} {expected}"
            );
        }
    }

    /// Direct values from the state: the node moves by (3, 4) and (5, −12) for a unit of η.
    #[test]
    fn columns_are_what_the_state_says() {
        let (machine, state) = (with_all(), at(0.0));
        let found = values(&machine, &state);
        let near = |name: &str, expected: f64| {
            let found = found(name);
            assert!(
                (found - expected).abs() <= 1e-9 * expected.abs().max(1e-3),
                "{name}: {found} {expected}"
            );
        };
        let (sin, cos) = 0.7_f64.sin_cos();
        let of = |eta: &[f64]| [3.0 * eta[0] + 5.0 * eta[1], 4.0 * eta[0] - 12.0 * eta[1]];
        let ([x, y], [vx, vy]) = (of(&state.q[1..3]), of(&state.v[1..3]));
        near("x_body_um", 1e6 * x);
        near("y_space_um", 1e6 * (sin * x + cos * y));
        near("vx_body_mm_s", 1e3 * vx);
        let speed = state.v[0];
        near("vx_space_mm_s", 1e3 * (cos * (vx - speed * y) - sin * (vy + speed * x)));
        near("x_space_um", found("X3_um"));
        near("fx_space_N", found("RX3_N"));
        near("fy_space_N", found("RY3_N"));
        near("dx_space_um", found("EX3_um"));
        near("fx_body_N", cos * found("RX3_N") + sin * found("RY3_N"));
        near("mz_ring_Nm", found("MZ3_Nm"));
        near("twist_ring_rad", 0.7);
        // The load turns with the body: F·(u̇ + θ̇ k×(x0 + u)).
        let arm = [0.3 + x, 0.4 + y];
        let moved = [vx - speed * arm[1], vy + speed * arm[0]];
        near("power_shaft_W", FORCE[0] * moved[0] + FORCE[1] * moved[1]);
        near("power_support_W", 0.0);
    }

    #[test]
    fn energies_and_powers_sum_to_those_of_the_machine() {
        let (machine, state) = (with_all(), at(0.0));
        let found = values(&machine, &state);
        let mut equations = Equations::new(&machine);
        equations.evaluate(0.0, &state);
        let near = |found: f64, expected: f64| {
            assert!((found - expected).abs() <= 1e-12 * expected.abs(), "{found} {expected}");
        };
        let sum = |kind: &str, unit: &str| {
            ["shaft", "support"].map(|own| found(&format!("{kind}_{own}_{unit}"))).iter().sum()
        };
        near(sum("kinetic", "J"), equations.kinetic_energy(&state));
        near(sum("strain", "J"), equations.strain_energy(&state));
        let dot = |force: &[f64], first, last| -> f64 {
            (first..last).map(|i: usize| force[i] * state.v[i]).sum()
        };
        near(sum("power", "W"), dot(&equations.load, 0, 5));
        near(sum("damping", "W"), dot(&equations.damper, 0, 5));
        let joints: f64 = (0..3).map(|k| found(&format!("power_j{k}_W"))).sum();
        // Coordinates 0 to 2 are those of the shaft, on which all journals are.
        near(joints, dot(&equations.spring, 0, 3));
    }

    #[test]
    fn a_prescribed_rotation_has_the_power_of_its_couple() {
        let turning = Rotation::Prescribed { speed: 3.0, acceleration: -2.0 };
        let power = vec![output("shaft", Wanted::Power { body: 0 })];
        let machine = machine(turning).with_outputs(power).expect("outputs");
        let (found, state) = (values(&machine, &at(0.0)), at(0.0));
        let mut equations = Equations::new(&machine);
        equations.evaluate(0.0, &state);
        let load: f64 = (0..3).map(|i| equations.load[i] * state.v[i]).sum();
        let expected = load - equations.residual()[0] * state.v[0];
        assert!((found("power_shaft_W") - expected).abs() < 1e-12 * expected.abs());
    }

    #[test]
    fn outputs_of_nothing_and_columns_twice_are_refused() {
        let refused = |what: Vec<Output>| {
            machine(Rotation::Free).with_outputs(what).err().expect("an error").to_string()
        };
        let energy = |body| output("a", Wanted::Energy { body });
        assert!(refused(vec![energy(7)]).contains("no such body"));
        assert!(refused(vec![output("a", Wanted::JointPower { joint: 3 })]).contains("joint"));
        assert!(refused(vec![energy(0), energy(1)]).contains("kinetic_a_J"));
    }
}
