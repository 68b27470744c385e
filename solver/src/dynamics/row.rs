//! The row of the history that a step gives.

use crate::equations::Equations;
use crate::equations::State;
use crate::loads::Position;

/// Places of the journals' displacements in a row of a machine with so many bearings.
pub(super) fn displacements(bearings: usize) -> std::ops::Range<usize> {
    3 + 2 * bearings..3 + 4 * bearings
}

/// Writes the row, without outputs by request, of the step that ends at `time` (s) at a state just evaluated, one value a column of
/// [`History::for_machine`](crate::history::History::for_machine).
// A phase of its own in tables of where the time goes.
#[inline(never)]
pub(super) fn write_row(
    equations: &Equations,
    state: &State,
    time: f64,
    iterations: usize,
    row: &mut [f64],
) {
    let (machine, springs) = (equations.machine, &equations.springs);
    let bearings = machine.monitors.len();
    let mut other = 3 + 6 * bearings;
    let turn = |body: usize| {
        let theta = machine.places()[body].rotation;
        machine.turn(body, time, theta.map_or([0.0; 2], |own| [state.q[own], state.v[own]]))
    };
    let mut turning = machine.turning().map(turn);
    let [theta, speed] = turning.next().unwrap_or_default();
    row[..3].copy_from_slice(&[time, theta, speed]);
    for (k, monitor) in machine.monitors.iter().enumerate() {
        let mut force = [0.0; 2];
        for [_, x, y] in monitor.planes.iter().map(|&plane| springs.plane_force(plane)) {
            force[0] += x;
            force[1] += y;
        }
        let places = monitor.bodies.map(|body| &machine.places()[body]);
        let [frame, of_bore] =
            places.map(|place| Position::new(place.rotation.map_or(0.0, |theta| state.q[theta])));
        let [coordinates, bore] = places.map(|place| &state.q[place.flexible.clone()]);
        let [journal, bore] = monitor.displacements(coordinates, bore);
        let reaction = frame.to_space(force);
        let displacement = frame.to_space(journal);
        let bore = of_bore.to_space([0, 1].map(|axis| bore[axis] + monitor.offset[axis]));
        // The run-out turns with the journal, in whatever frame its coordinates stand.
        let turned = Position::new(turn(monitor.bodies[0])[0]).to_space(monitor.run_out);
        for axis in 0..2 {
            let place = 3 + 2 * k + axis;
            let eccentricity = displacement[axis] + turned[axis] + monitor.apart[axis] - bore[axis];
            row[place] = reaction[axis];
            row[place + 2 * bearings] = 1e6 * displacement[axis];
            row[place + 4 * bearings] = 1e6 * eccentricity;
        }
        if monitor.torque {
            let torques =
                monitor.planes.iter().map(|&plane| springs.plane_torque(&machine.springs, plane));
            row[other] = torques.sum();
            other += 1;
        }
        if let Some(plane) = monitor.tilts {
            let moment = springs.tilting_moment(&machine.springs, plane);
            row[other..other + 2].copy_from_slice(&frame.to_space(moment));
            other += 2;
        }
        if let Some(plane) = monitor.along {
            row[other] = springs.axial_force(&machine.springs, plane);
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
