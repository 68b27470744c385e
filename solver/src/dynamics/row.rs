//! The row of the history that a step gives.

use super::newmark::State;
use super::system::System;
use crate::linalg::dot;
use crate::loads::Position;

/// Places of the journals' displacements in a row of a machine with so many bearings.
pub(super) fn displacements(bearings: usize) -> std::ops::Range<usize> {
    3 + 2 * bearings..3 + 4 * bearings
}

/// Writes the row of the step that ends at `time` (s) at a state just evaluated, one value a column of
/// [`History::for_machine`](crate::history::History::for_machine).
pub(super) fn write_row(
    system: &System,
    state: &State,
    time: f64,
    iterations: usize,
    row: &mut [f64],
) {
    let (machine, springs) = (system.machine, &system.springs);
    let first = 1 + machine.shaft.size();
    let (eta, support) = (&state.q[1..first], &state.q[first..]);
    let position = Position::new(state.q[0]);
    let bearings = machine.monitors.len();
    let mut torque_column = 3 + 6 * bearings;
    let [theta, speed] = machine.spin(time).unwrap_or([state.q[0], state.v[0]]);
    row[..3].copy_from_slice(&[time, theta, speed]);
    for (k, monitor) in machine.monitors.iter().enumerate() {
        let mut force = [0.0; 2];
        for [_, x, y] in monitor.planes.iter().map(|&plane| springs.plane_force(plane)) {
            force[0] += x;
            force[1] += y;
        }
        let reaction = position.to_space(force);
        let journal =
            position.to_space([dot(&monitor.journal[0], eta), dot(&monitor.journal[1], eta)]);
        for axis in 0..2 {
            let place = 3 + 2 * k + axis;
            let bore = dot(&monitor.bore[axis], support);
            row[place] = reaction[axis];
            row[place + 2 * bearings] = 1e6 * journal[axis];
            row[place + 4 * bearings] = 1e6 * (journal[axis] - bore);
        }
        if monitor.torque {
            let torques = monitor.planes.iter().map(|&plane| springs.plane_torque(plane));
            row[torque_column] = torques.sum();
            torque_column += 1;
        }
    }
    *row.last_mut().expect("columns") = iterations as f64;
}
