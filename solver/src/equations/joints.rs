//! What joints measure, and what they do to their journals, at a state.

use super::Equations;
use super::frames::{across, frame_of, rotation, turn};
use super::state::State;
use crate::loads::Position;
use crate::machine::Machine;
use crate::monitor::{Displaced, Monitor, Turned};

impl Equations<'_> {
    /// Force on the journal (N, along axes of its body) at the state that was evaluated last.
    pub(crate) fn joint_force(&self, joint: &Monitor) -> [f64; 2] {
        let planes = joint.planes.iter().map(|&plane| self.springs.plane_force(plane));
        planes.fold([0.0; 2], |sum, [_, x, y]| [sum[0] + x, sum[1] + y])
    }

    /// Torque on the journal about its own centre (N·m) there.
    pub(crate) fn joint_torque(&self, joint: &Monitor) -> f64 {
        let springs = &self.machine.springs;
        joint.planes.iter().map(|&plane| self.springs.plane_torque(springs, plane)).sum()
    }

    /// Moments on the journal's section (N·m, about axes of its body) there, of a joint that acts on tilts.
    pub(crate) fn joint_moment(&self, joint: &Monitor) -> Option<[f64; 2]> {
        joint.tilts.map(|own| self.springs.tilting_moment(&self.machine.springs, own))
    }

    /// Tilts of the journal's section against the bore's (rad, about axes of the body of the bore) there, of the same.
    pub(crate) fn joint_tilt(&self, joint: &Monitor) -> Option<[f64; 2]> {
        joint.tilts.map(|own| self.springs.tilt(&self.machine.springs, own))
    }

    /// Force on the journal's section along z (N) there, of a joint that acts along it.
    pub(crate) fn axial_force(&self, joint: &Monitor) -> Option<f64> {
        joint.along.map(|own| self.springs.axial_force(&self.machine.springs, own))
    }

    /// Displacement of the journal's section against the bore's along z (m) there, of the same.
    pub(crate) fn axial_deformation(&self, joint: &Monitor) -> Option<f64> {
        joint.along.map(|own| self.springs.axial(&self.machine.springs, own))
    }
}

/// Displacements in the middle of a joint, at a time (s).
pub(crate) fn displaced(
    machine: &Machine,
    joint: &Monitor,
    (state, time): (&State, f64),
) -> Displaced {
    let [journal, bore] = joint.bodies.map(|body| frame_of(machine, body, &state.q));
    // The run-out turns with the journal, in whatever frame its coordinates stand.
    let run_out = Position::new(turn(machine, joint.bodies[0], (state, time))[0]);
    joint.displaced(machine.places(), &state.q, &Turned { journal, run_out, bore })
}

/// The rate of the deformation (m/s, along x and y of space).
pub(super) fn deformation_rate(
    machine: &Machine,
    joint: &Monitor,
    (state, time): (&State, f64),
) -> [f64; 2] {
    let [u, b] = joint.displacements(machine.places(), &state.q);
    let [u_rate, b_rate] = joint.displacements(machine.places(), &state.v);
    let b = [0, 1].map(|axis| b[axis] + joint.offset[axis]);
    // The speed in space of what moves in a frame that turns.
    let moved = |[angle, speed]: [f64; 2], x: [f64; 2], rate: [f64; 2]| {
        let carried = across(x);
        Position::new(angle).to_space([0, 1].map(|axis| rate[axis] + speed * carried[axis]))
    };
    let [[angle, speed, _], [of_bore, bore_speed, _]] =
        joint.bodies.map(|body| rotation(machine, body, state));
    let v = moved([angle, speed], u, u_rate);
    let turned = turn(machine, joint.bodies[0], (state, time));
    let run_out = moved(turned, joint.run_out(), [0.0; 2]);
    let w = moved([of_bore, bore_speed], b, b_rate);
    [0, 1].map(|axis| v[axis] + run_out[axis] - w[axis])
}
