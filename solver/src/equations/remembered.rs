//! States of laws in small motions: ṡ = A s + B x + D ẋ, with the forces P s on the coordinates.
//!
//! What a law's measure does to the machine is known as the force along it and as the tangent of such forces. With a slope of
//! one force alone, ∂ṡ/∂x in the place of ∂Q/∂x, the tangent is d ⊗ (B + a1 D), d being the generalised forces of a unit of
//! that force.

use super::Equations;
use super::RATE;
use super::state::State;
use crate::linalg::{FirstOrder, Matrix, dot};

impl Equations<'_> {
    /// That of all states over the unknown coordinates, at a state just evaluated in which they are known; none without states.
    pub(crate) fn first_order(&mut self, state: &State) -> Option<FirstOrder> {
        let (machine, time) = (self.machine, self.time);
        let springs = &machine.springs;
        let (m, size, first) = (springs.states(), machine.size(), machine.first_unknown());
        if m == 0 {
            return None;
        }
        let zeros = |rows: usize, cols: usize| Matrix::zeros(rows, cols);
        let mut found = FirstOrder {
            rates: zeros(m, m),
            by_position: zeros(m, size - first),
            by_rate: zeros(m, size - first),
            forces: zeros(size - first, m),
        };
        let mut tangent = vec![0.0; size * size];
        let mut before = 0;
        for (place, law) in springs.laws.iter().enumerate() {
            let count = law.bound.states.len();
            if count == 0 {
                continue;
            }
            self.evaluate(time, state);
            for own in self.springs.states_of(springs, place) {
                let at = (place, own.spring);
                let row = |k: usize| before + k * law.springs + own.spring;
                self.springs.pretend(springs, at, &[1.0], &[]);
                let mut along = vec![0.0; size];
                self.springs.add_forces(springs, &mut along);
                let square = dot(&along, &along);
                for k in 0..count {
                    for l in 0..count {
                        found.rates[(row(k), row(l))] = own.rates[k * count + l];
                    }
                    self.springs.pretend(springs, at, &own.forces[k], &[]);
                    let mut pushed = vec![0.0; size];
                    self.springs.add_forces(springs, &mut pushed);
                    found.forces.col_mut(row(k)).copy_from_slice(&pushed[first..]);
                    if square == 0.0 {
                        continue;
                    }
                    self.springs.pretend(springs, at, &[], &own.by_inputs[k]);
                    for weight in [0.0, RATE] {
                        tangent.fill(0.0);
                        self.spring_tangent.subtract(
                            springs,
                            &self.springs,
                            weight,
                            size,
                            &mut tangent,
                        );
                        for j in first..size {
                            let by = -dot(&along, &tangent[j * size..][..size]) / square;
                            let place = (row(k), j - first);
                            match weight == 0.0 {
                                true => found.by_position[place] = by,
                                false => {
                                    found.by_rate[place] = (by - found.by_position[place]) / RATE;
                                }
                            }
                        }
                    }
                }
            }
            before += count * law.springs;
        }
        self.evaluate(time, state);
        Some(found)
    }
}
