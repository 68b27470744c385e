//! The values of outputs by request, at the end of a step.

use crate::body::BodyNode;
use crate::equations::Equations;
use crate::equations::State;
use crate::loads::{Frame, Position};
use crate::machine::Machine;
use crate::output::{JointQuantity, Motion, Wanted};

/// Writes the values of all outputs of a machine at a state just evaluated at `time` (s), one a column.
pub(super) fn write_outputs(equations: &mut Equations, state: &State, time: f64, out: &mut [f64]) {
    let machine = equations.machine;
    let mut place = 0;
    let mut write = |value: f64| {
        out[place] = value;
        place += 1;
    };
    for output in &machine.outputs {
        match &output.what {
            Wanted::Motion { body, point, motion, frame, components } => {
                let (values, scale) = (of_point((machine, *body), point, state, *frame), *motion);
                let (order, scale) = match scale {
                    Motion::Displacement => (0, 1e6),
                    Motion::Velocity => (1, 1e3),
                    Motion::Acceleration => (2, 1.0),
                };
                components.iter().for_each(|&axis| write(scale * values[order][axis]));
            }
            Wanted::Joint { joint, quantity, frame } => {
                let (values, count) = of_joint(equations, *joint, *quantity, (state, time), *frame);
                values[..count].iter().for_each(|&value| write(value));
            }
            Wanted::Energy { body } => {
                equations.energies(*body, state).into_iter().for_each(&mut write)
            }
            Wanted::Power { body } => {
                power(equations, *body, state).into_iter().for_each(&mut write)
            }
            Wanted::JointPower { joint } => write(joint_power(equations, *joint, state)),
            Wanted::Film { joint, .. } => {
                let planes = &machine.monitors[*joint].planes;
                let film = planes.first().map(|own| equations.springs.film(&machine.springs, *own));
                film.into_iter().for_each(|own| own.write(&mut write));
            }
        }
    }
}

/// Angle, speed and acceleration of the frame of a body.
fn rotation(machine: &Machine, body: usize, state: &State) -> [f64; 3] {
    let theta = machine.places()[body].rotation;
    theta.map_or([0.0; 3], |own| [state.q[own], state.v[own], state.a[own]])
}

/// k × (x, y): what a unit of speed about z adds.
fn across([x, y]: [f64; 2]) -> [f64; 2] {
    [-y, x]
}

/// Displacement, velocity and acceleration of a point along x, y, z (m, m/s, m/s²).
///
/// u = φη in the frame of the body; in space A u, A(u̇ + θ̇ k×u) and A(ü + 2θ̇ k×u̇ + θ̈ k×u − θ̇² u).
fn of_point(
    (machine, body): (&Machine, usize),
    point: &BodyNode,
    state: &State,
    frame: Frame,
) -> [[f64; 3]; 3] {
    let flexible = machine.places()[body].flexible.clone();
    let mut motion = [&state.q, &state.v, &state.a].map(|values| {
        let mut sum = [0.0; 3];
        for (j, value) in values[flexible.clone()].iter().enumerate() {
            let shape = point.shapes.col(j);
            (0..3).for_each(|axis| sum[axis] += shape[axis] * value);
        }
        sum
    });
    if frame == Frame::Body {
        return motion;
    }
    let [theta, speed, rate] = rotation(machine, body, state);
    let turned = Position::new(theta);
    let [u, v, a] = motion.map(|[x, y, _]| [x, y]);
    let (of_u, of_v) = (across(u), across(v));
    for axis in 0..2 {
        motion[1][axis] = v[axis] + speed * of_u[axis];
        motion[2][axis] =
            a[axis] + 2.0 * speed * of_v[axis] + rate * of_u[axis] - speed * speed * u[axis];
    }
    motion.map(|[x, y, z]| {
        let [x, y] = turned.to_space([x, y]);
        [x, y, z]
    })
}

/// Values of a joint, and how many of them there are.
fn of_joint(
    equations: &Equations,
    joint: usize,
    quantity: JointQuantity,
    (state, time): (&State, f64),
    frame: Frame,
) -> ([f64; 2], usize) {
    let (machine, springs) = (equations.machine, &equations.springs);
    let monitor = &machine.monitors[joint];
    let [journal, bore] = monitor.bodies;
    let turn = |body: usize| {
        let [angle, speed, _] = rotation(machine, body, state);
        machine.turn(body, time, [angle, speed])
    };
    let [angle, speed, _] = rotation(machine, journal, state);
    let own = Position::new(angle);
    let planes = || monitor.planes.iter().map(|&plane| springs.plane_force(plane));
    let about_axis = |value: f64| ([value, 0.0], 1);
    let in_plane = |value: [f64; 2], scale: f64| (value.map(|own| scale * own), 2);
    match quantity {
        JointQuantity::Torque => {
            let torques =
                monitor.planes.iter().map(|&plane| springs.plane_torque(&machine.springs, plane));
            about_axis(torques.sum())
        }
        JointQuantity::Twist => {
            about_axis(turn(journal)[0] - turn(bore)[0] + of_sections(equations, joint, &state.q))
        }
        JointQuantity::TwistRate => {
            about_axis(turn(journal)[1] - turn(bore)[1] + of_sections(equations, joint, &state.v))
        }
        JointQuantity::Moment => {
            let plane = monitor.tilts;
            let moment =
                plane.map_or([0.0; 2], |own| springs.tilting_moment(&machine.springs, own));
            in_plane(if frame == Frame::Body { moment } else { own.to_space(moment) }, 1.0)
        }
        JointQuantity::Tilt => {
            let tilt = monitor.tilts.map_or([0.0; 2], |own| springs.tilt(&machine.springs, own));
            // Tilts are along the axes of the bore.
            let tilt = Position::new(rotation(machine, bore, state)[0]).to_space(tilt);
            let back = Position { sin: -own.sin, cos: own.cos };
            in_plane(if frame == Frame::Body { back.to_space(tilt) } else { tilt }, 1.0)
        }
        JointQuantity::AxialForce => {
            about_axis(monitor.along.map_or(0.0, |own| springs.axial_force(&machine.springs, own)))
        }
        JointQuantity::AxialDeformation => {
            let moved = monitor.along.map_or(0.0, |own| springs.axial(&machine.springs, own));
            about_axis(1e6 * moved)
        }
        JointQuantity::Force => {
            let force = planes().fold([0.0; 2], |sum, [_, x, y]| [sum[0] + x, sum[1] + y]);
            // Forces of planes are in the frame of the journal's body.
            in_plane(if frame == Frame::Body { force } else { own.to_space(force) }, 1.0)
        }
        JointQuantity::Deformation | JointQuantity::Rate => {
            let [e, rate] = deformation(machine, joint, state, turn);
            let rate = match frame {
                Frame::Space => rate,
                Frame::Body => {
                    let carried = across(e);
                    [0, 1].map(|axis| rate[axis] - speed * carried[axis])
                }
            };
            let back = Position { sin: -own.sin, cos: own.cos };
            let shown = |own: [f64; 2]| if frame == Frame::Body { back.to_space(own) } else { own };
            match quantity {
                JointQuantity::Deformation => in_plane(shown(e), 1e6),
                _ => in_plane(shown(rate), 1e3),
            }
        }
    }
}

/// What the sections on which a joint acts turn against each other by `values` of the coordinates, beside the frames of
/// their bodies.
fn of_sections(equations: &Equations, joint: usize, values: &[f64]) -> f64 {
    let machine = equations.machine;
    let Some(&plane) = machine.monitors[joint].planes.first() else { return 0.0 };
    let [angle, ..] = equations.springs.rows(plane);
    let sections = angle.iter().filter(|(place, _)| *place >= machine.rotations());
    sections.map(|&(place, coefficient)| coefficient * values[place]).sum()
}

/// Displacement of the journal against the bore in the middle of a joint (m), and its rate (m/s); in space.
fn deformation(
    machine: &Machine,
    joint: usize,
    state: &State,
    turn: impl Fn(usize) -> [f64; 2],
) -> [[f64; 2]; 2] {
    let monitor = &machine.monitors[joint];
    let [journal, bore] = monitor.bodies;
    let coordinates = |values: &[f64]| {
        let own = |body: usize| &values[machine.places()[body].flexible.clone()];
        monitor.displacements(own(journal), own(bore))
    };
    let ([u, b], [u_rate, b_rate]) = (coordinates(&state.q), coordinates(&state.v));
    let b = [0, 1].map(|axis| b[axis] + monitor.offset[axis]);
    let [angle, speed, _] = rotation(machine, journal, state);
    let [of_bore, bore_speed, _] = rotation(machine, bore, state);
    // What is fixed in a frame that turns: its place in space, and its speed there.
    let moved = |[angle, speed]: [f64; 2], x: [f64; 2], rate: [f64; 2]| {
        let (turned, carried) = (Position::new(angle), across(x));
        let rate = [0, 1].map(|axis| rate[axis] + speed * carried[axis]);
        [turned.to_space(x), turned.to_space(rate)]
    };
    let [x, v] = moved([angle, speed], u, u_rate);
    let [run_out, run_out_rate] = moved(turn(journal), monitor.run_out, [0.0; 2]);
    let [y, w] = moved([of_bore, bore_speed], b, b_rate);
    let e = [0, 1].map(|axis| x[axis] + run_out[axis] + monitor.apart[axis] - y[axis]);
    [e, [0, 1].map(|axis| v[axis] + run_out_rate[axis] - w[axis])]
}

/// Power of loads and of the couple of a prescribed rotation on a body, and power that its damping takes (W).
fn power(equations: &Equations, body: usize, state: &State) -> [f64; 2] {
    let (machine, place) = (equations.machine, &equations.machine.places()[body]);
    let theta = place.rotation.into_iter();
    let [mut brought, mut taken] = [0.0; 2];
    for i in theta.clone().chain(place.flexible.clone()) {
        brought += equations.load[i] * state.v[i];
        taken += equations.damper[i] * state.v[i];
    }
    // The residual of a rotation that is given is its drive's couple with the sign changed.
    let given = theta.filter(|&theta| theta < machine.first_unknown());
    brought -= given.map(|theta| equations.residual[theta] * state.v[theta]).sum::<f64>();
    [brought, taken]
}

/// Power of a joint's forces on the body of the journal (W).
fn joint_power(equations: &Equations, joint: usize, state: &State) -> f64 {
    let monitor = &equations.machine.monitors[joint];
    let place = &equations.machine.places()[monitor.bodies[0]];
    let is_own = |i: usize| place.rotation == Some(i) || place.flexible.contains(&i);
    let mut power = 0.0;
    for plane in monitor.all_planes() {
        for (row, force) in
            equations.springs.rows(plane).iter().zip(equations.springs.plane_force(plane))
        {
            let own = row.iter().filter(|(i, _)| is_own(*i));
            power += force * own.map(|&(i, coefficient)| coefficient * state.v[i]).sum::<f64>();
        }
        power += equations.springs.power_on_section(&equations.machine.springs, plane, &state.v);
    }
    power
}

#[cfg(test)]
mod tests {
    use super::super::row::write_row;
    use super::super::small::{FORCE, machine, state};
    use super::*;
    use crate::history::History;
    use crate::machine::Rotation;
    use crate::output::Output;

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
        write_outputs(&mut equations, state, 0.0, asked);
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
