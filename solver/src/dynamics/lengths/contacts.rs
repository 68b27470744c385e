//! Contacts that begin and end within one part of a step: at its ends nothing is seen of them.

use crate::bearing::SpringState;
use crate::equations::{Equations, State};
use crate::machine::Machine;

/// Where within a part is looked, as fractions of it.
const PLACES: [f64; 3] = [0.25, 0.5, 0.75];

/// Looks for contacts within parts that the march chooses.
pub(in crate::dynamics) struct Contacts {
    springs: SpringState,
    within: State,
    /// Forces that are none at both ends of the part.
    free: Vec<usize>,
}

impl Contacts {
    pub(in crate::dynamics) fn new(machine: &Machine) -> Self {
        Contacts {
            springs: SpringState::new(&machine.springs),
            within: State::new(machine.size()),
            free: Vec::new(),
        }
    }

    /// Whether a force that is none at both ends of a part, from `t` on for `dt` s, acts between them. The system was
    /// evaluated at the end. Between the ends every coordinate moves along the cubic that has their places and rates, as it
    /// does exactly where nothing but constant forces act.
    pub(in crate::dynamics) fn are_within(
        &mut self,
        equations: &Equations,
        (t, dt): (f64, f64),
        [start, end]: [&State; 2],
    ) -> bool {
        let Contacts { springs, within, free } = self;
        let all = &equations.machine.springs;
        free.clear();
        free.extend(
            (0..equations.springs.forces.len()).filter(|at| equations.springs.forces[*at] == 0.0),
        );
        if free.is_empty() {
            return false;
        }
        springs.update(all, t, [&start.q, &start.v], &start.laws);
        free.retain(|at| springs.forces[*at] == 0.0);
        PLACES.iter().any(|&s| {
            let moved = s * s * (3.0 - 2.0 * s);
            let [by_start, by_end] = [s * (1.0 - s) * (1.0 - s) * dt, -s * s * (1.0 - s) * dt];
            let [rate, rate_of_start, rate_of_end] =
                [6.0 * s * (1.0 - s) / dt, (1.0 - s) * (1.0 - 3.0 * s), s * (3.0 * s - 2.0)];
            for i in 0..start.q.len() {
                let whole = end.q[i] - start.q[i];
                within.q[i] =
                    start.q[i] + moved * whole + by_start * start.v[i] + by_end * end.v[i];
                within.v[i] = rate * whole + rate_of_start * start.v[i] + rate_of_end * end.v[i];
            }
            springs.update(all, t + s * dt, [&within.q, &within.v], &end.laws);
            free.iter().any(|at| springs.forces[*at] != 0.0)
        })
    }
}
