//! The springs of laws with states.

use super::hold::{Hold, LawStates};
use super::law::Remembered;
use super::placed_law::PlacedLaw;
use super::plane::Plane;
use super::springs::Springs;
use super::state::SpringState;
use super::states::InStep;

/// What the states of a law do at one spring.
pub(crate) struct StatesAt {
    pub(crate) spring: usize,
    /// ∂ṡ/∂s, row after row.
    pub(crate) rates: Vec<f64>,
    /// By states ∂ṡ/∂x, one an input of the law, and ∂Q/∂s, one a force that it gives.
    pub(crate) by_inputs: Vec<Vec<f64>>,
    pub(crate) forces: Vec<Vec<f64>>,
}

impl Springs {
    /// The values at which states begin, in their order; 0 of those that begin where their rates are zero.
    pub(crate) fn starts(&self) -> Vec<f64> {
        let mut starts = Vec::new();
        for law in &self.laws {
            for state in &law.bound.states {
                starts.resize(starts.len() + law.springs, state.start.unwrap_or(0.0));
            }
        }
        starts
    }

    /// The plane of a state by its place among all, and the state with the name of its law.
    pub(crate) fn named_state(&self, place: usize) -> Option<(&Plane, &str, &Remembered)> {
        let mut first = 0;
        for (number, law) in self.laws.iter().enumerate() {
            let count = law.bound.states.len() * law.springs;
            if place < first + count {
                let (state, spring) =
                    ((place - first) / law.springs, (place - first) % law.springs);
                let of = |own: &&Plane| own.law == number && own.springs.contains(&spring);
                let plane = self.planes.iter().find(of)?;
                return Some((plane, law.bound.law.name(), &law.bound.states[state]));
            }
            first += count;
        }
        None
    }
}

impl SpringState {
    /// Evaluates a law with states at all its springs.
    pub(super) fn evaluate_remembering(&mut self, law: &PlacedLaw, place: usize) {
        self.gather(law, place);
        let SpringState { laws, memory, remembering, .. } = self;
        remembering.find(law, place, memory);
        let own = &mut laws[place];
        let own = InStep {
            states: &mut own.states,
            rates: &mut own.rates,
            relaxes: &mut own.relaxes,
            forces: &mut own.forces,
            slopes: &mut own.slopes,
        };
        remembering.condense(law, place, memory, own);
    }

    /// The rates at which states come to rest by themselves where the laws were evaluated last (1/s), in the order of the states.
    pub(crate) fn relaxing(&self) -> impl Iterator<Item = f64> {
        self.laws.iter().flat_map(|own| own.relaxes.iter().copied())
    }

    /// The states of a plane where the laws were evaluated last, each by its place among those of the law: spring after spring.
    pub(crate) fn states_in<'s>(
        &'s self,
        springs: &'s Springs,
        plane: usize,
    ) -> impl Iterator<Item = (usize, f64)> + 's {
        let plane = &springs.planes[plane];
        let (law, own) = (&springs.laws[plane.law], &self.laws[plane.law]);
        let states = 0..law.bound.states.len();
        plane.springs.clone().flat_map(move |spring| {
            states.clone().map(move |state| (state, own.states[state * law.springs + spring]))
        })
    }

    /// What the states of the law at `place` do where the springs were evaluated last, spring after spring.
    pub(crate) fn states_of(&mut self, springs: &Springs, place: usize) -> Vec<StatesAt> {
        let law = &springs.laws[place];
        let (bound, n) = (&law.bound, law.springs);
        let (forces, inputs, states) = (bound.forces.len(), bound.inputs.len(), bound.states.len());
        self.gather(law, place);
        let outputs = self.memory.evaluate(law);
        let at = |output: usize, by: usize, j: usize| {
            outputs[(output * (1 + inputs + states) + by) * n + j]
        };
        let of_spring = |spring: usize| StatesAt {
            spring,
            rates: (0..states * states)
                .map(|k| at(forces + k / states, 1 + inputs + k % states, spring))
                .collect(),
            by_inputs: (0..states)
                .map(|k| (0..inputs).map(|by| at(forces + k, 1 + by, spring)).collect())
                .collect(),
            forces: (0..states)
                .map(|k| (0..forces).map(|own| at(own, 1 + inputs + k, spring)).collect())
                .collect(),
        };
        (0..n).map(of_spring).collect()
    }

    /// Has no law give forces or slopes but the one at `place`: at one spring `forces`, one a force that it gives, or `slopes` of its
    /// first force, one an input.
    pub(crate) fn pretend(
        &mut self,
        springs: &Springs,
        (place, spring): (usize, usize),
        forces: &[f64],
        slopes: &[f64],
    ) {
        for own in &mut self.laws {
            own.forces.fill(0.0);
            own.slopes.fill(0.0);
        }
        let (law, own) = (&springs.laws[place], &mut self.laws[place]);
        let (bound, n) = (&law.bound, law.springs);
        for (&force, value) in bound.forces.iter().zip(forces) {
            own.forces[force * n + spring] = *value;
        }
        let first = bound.forces[0] * bound.kind.inputs.len();
        for (&input, value) in bound.inputs.iter().zip(slopes) {
            own.slopes[(first + input) * n + spring] = *value;
        }
        for place in 0..springs.laws.len() {
            self.push(springs, place);
        }
        for (law, own) in springs.laws.iter().zip(&self.laws) {
            let bores = &mut self.bores[law.bores];
            for (row, rows) in law.bore_rows() {
                bores.force[rows].copy_from_slice(&own.bore_force[row]);
            }
        }
    }

    /// Keeps the states and their rates where they were evaluated last, as known.
    pub(crate) fn keep_states(&self, laws: &mut LawStates) {
        laws.step = 0.0;
        self.keep_films(laws);
        let count = self.laws.iter().map(|own| own.states.len()).sum();
        if count == 0 {
            return;
        }
        for all in [&mut laws.known, &mut laws.rates, &mut laws.lag] {
            all.resize(count, 0.0);
        }
        for (own, first) in self.laws.iter().zip(&self.remembering.first) {
            laws.known[*first..][..own.states.len()].copy_from_slice(&own.states);
            laws.rates[*first..][..own.rates.len()].copy_from_slice(&own.rates);
        }
        laws.hold = Hold::Implicit(0.0);
    }
}
