//! The measures of laws, observed as steps are accepted.

use super::springs::Springs;
use super::state::SpringState;
use super::valid::Worst;

impl SpringState {
    /// Keeps the worst value of every measure; to be called once for every step that is accepted, while the state is
    /// that of its end at `time` (s). Costs nothing where no law has measures, and allocates nothing.
    pub(crate) fn observe(&mut self, springs: &Springs, time: f64) {
        let measures = &springs.measures;
        for observed in &measures.observed {
            let law = &springs.laws[observed.law];
            self.gather(law, observed.law);
            let inputs = &self.memory.inputs[..law.bound.rows_in() * observed.springs];
            let values = &mut self.monitor.values[..observed.count * observed.springs];
            law.bound.law.measure(observed.springs, inputs, values, &mut self.memory.workspace);
            self.monitor.take(&measures.all, observed, time);
        }
    }

    /// The worst values so far, in the order of [`Springs::measures`]; none before the first step.
    pub fn worst(&self) -> &[Option<Worst>] {
        &self.monitor.worst
    }

    /// Goes on from worst values that were kept; those of another machine are left alone.
    pub(crate) fn resume(&mut self, worst: &[Option<Worst>]) {
        if worst.len() == self.monitor.worst.len() {
            self.monitor.worst.copy_from_slice(worst);
        }
    }
}
