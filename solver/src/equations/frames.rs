//! How frames of bodies are turned in a state.

use super::state::State;
use crate::loads::Position;
use crate::machine::Machine;

/// Angle, speed and acceleration of the frame of a body.
pub(super) fn rotation(machine: &Machine, body: usize, state: &State) -> [f64; 3] {
    let theta = machine.places()[body].rotation;
    theta.map_or([0.0; 3], |own| [state.q[own], state.v[own], state.a[own]])
}

/// Angle and speed of a body, as people see it, at a time (s).
pub(crate) fn turn(machine: &Machine, body: usize, (state, time): (&State, f64)) -> [f64; 2] {
    let [angle, speed, _] = rotation(machine, body, state);
    machine.turn(body, time, [angle, speed])
}

/// How the frame of a body is turned.
pub(crate) fn frame_of(machine: &Machine, body: usize, q: &[f64]) -> Position {
    Position::new(machine.places()[body].rotation.map_or(0.0, |theta| q[theta]))
}

/// k × (x, y): what a unit of speed about z adds.
pub(super) fn across([x, y]: [f64; 2]) -> [f64; 2] {
    [-y, x]
}
