//! The values of outputs by request, at a state.

use super::Equations;
use super::frames::{across, frame_of, rotation, turn};
use super::joints::{deformation_rate, displaced};
use super::state::State;
use crate::body::BodyNode;
use crate::loads::{Frame, Position};
use crate::machine::Machine;
use crate::monitor::Monitor;
use crate::output::{JointQuantity, Motion, Wanted};

impl Equations<'_> {
    /// Writes the values of all outputs of a machine at a state just evaluated at `time` (s), one a column.
    pub(crate) fn write_outputs(&mut self, state: &State, time: f64, out: &mut [f64]) {
        let machine = self.machine;
        let mut place = 0;
        let mut write = |value: f64| {
            out[place] = value;
            place += 1;
        };
        for output in &machine.outputs {
            match &output.what {
                Wanted::Motion { body, point, motion, frame, components } => {
                    let (values, scale) =
                        (of_point((machine, *body), point, state, *frame), *motion);
                    let (order, scale) = match scale {
                        Motion::Displacement => (0, 1e6),
                        Motion::Velocity => (1, 1e3),
                        Motion::Acceleration => (2, 1.0),
                    };
                    components.iter().for_each(|&axis| write(scale * values[order][axis]));
                }
                Wanted::Joint { joint, quantity, frame } => {
                    let (values, count) =
                        of_joint(self, &machine.monitors[*joint], *quantity, (state, time), *frame);
                    values[..count].iter().for_each(|&value| write(value));
                }
                Wanted::Energy { body } => {
                    self.energies(*body, state).into_iter().for_each(&mut write)
                }
                Wanted::Power { body } => {
                    power(self, *body, state).into_iter().for_each(&mut write)
                }
                Wanted::States { joint, states, .. } => {
                    for &plane in &machine.monitors[*joint].planes {
                        let all = self.springs.states_in(&machine.springs, plane);
                        all.for_each(|(state, value)| write(states[state].shown().1 * value));
                    }
                }
                Wanted::JointPower { joint } => {
                    write(joint_power(self, &machine.monitors[*joint], state))
                }
                Wanted::Film { joint, .. } => {
                    let planes = &machine.monitors[*joint].planes;
                    let film = planes.first().map(|own| self.springs.film(&machine.springs, *own));
                    film.into_iter().for_each(|own| own.write(&mut write));
                }
            }
        }
    }
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
    joint: &Monitor,
    quantity: JointQuantity,
    (state, time): (&State, f64),
    frame: Frame,
) -> ([f64; 2], usize) {
    let machine = equations.machine;
    let [journal, bore] = joint.bodies;
    let turn = |body: usize| turn(machine, body, (state, time));
    let own = frame_of(machine, journal, &state.q);
    let about_axis = |value: f64| ([value, 0.0], 1);
    let in_plane = |value: [f64; 2], scale: f64| (value.map(|own| scale * own), 2);
    let to_space = |value: [f64; 2]| if frame == Frame::Body { value } else { own.to_space(value) };
    let from_space = |value: [f64; 2]| match frame {
        Frame::Body => Position { sin: -own.sin, cos: own.cos }.to_space(value),
        Frame::Space => value,
    };
    match quantity {
        JointQuantity::Torque => about_axis(equations.joint_torque(joint)),
        JointQuantity::Twist => {
            about_axis(turn(journal)[0] - turn(bore)[0] + of_sections(equations, joint, &state.q))
        }
        JointQuantity::TwistRate => {
            about_axis(turn(journal)[1] - turn(bore)[1] + of_sections(equations, joint, &state.v))
        }
        JointQuantity::Moment => {
            in_plane(to_space(equations.joint_moment(joint).unwrap_or_default()), 1.0)
        }
        JointQuantity::Tilt => {
            let tilt = equations.joint_tilt(joint).unwrap_or_default();
            // Tilts are along the axes of the bore.
            in_plane(from_space(frame_of(machine, bore, &state.q).to_space(tilt)), 1.0)
        }
        JointQuantity::AxialForce => about_axis(equations.axial_force(joint).unwrap_or(0.0)),
        JointQuantity::AxialDeformation => {
            about_axis(1e6 * equations.axial_deformation(joint).unwrap_or(0.0))
        }
        // Forces of planes are in the frame of the journal's body.
        JointQuantity::Force => in_plane(to_space(equations.joint_force(joint)), 1.0),
        JointQuantity::Deformation => {
            in_plane(from_space(displaced(machine, joint, (state, time)).deformation), 1e6)
        }
        JointQuantity::Rate => {
            let rate = deformation_rate(machine, joint, (state, time));
            let rate = match frame {
                Frame::Space => rate,
                Frame::Body => {
                    let carried = across(displaced(machine, joint, (state, time)).deformation);
                    let [_, speed, _] = rotation(machine, journal, state);
                    [0, 1].map(|axis| rate[axis] - speed * carried[axis])
                }
            };
            in_plane(from_space(rate), 1e3)
        }
    }
}

/// What the sections on which a joint acts turn against each other by `values` of the coordinates, beside the frames of
/// their bodies.
fn of_sections(equations: &Equations, joint: &Monitor, values: &[f64]) -> f64 {
    let Some(&plane) = joint.planes.first() else { return 0.0 };
    let [angle, ..] = equations.springs.rows(plane);
    let first = equations.machine.rotations();
    let sections = angle.iter().filter(|(place, _)| *place >= first);
    sections.map(|&(place, coefficient)| coefficient * values[place]).sum()
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
fn joint_power(equations: &Equations, joint: &Monitor, state: &State) -> f64 {
    let place = &equations.machine.places()[joint.bodies[0]];
    let is_own = |i: usize| place.rotation == Some(i) || place.flexible.contains(&i);
    let mut power = 0.0;
    for plane in joint.all_planes() {
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
