//! Bearing laws as the marcher sees them: named inputs to named outputs, over rows of springs.

use std::sync::Arc;

use whirl_specs::{Contact, ContactVariable, Law};
use whirl_text::nearest_in_any_case;

use super::over_frequency::FrequencyTable;
use crate::film::Journal;

/// A law that can be evaluated over rows of springs, of rings, or of whole joints. Kinds are compiled ones of the
/// registry, those of a law file, evaluated without a compiler, and the latter with coefficients over the frequency beside them.
pub trait SpringLaw: Send + Sync {
    /// Name, as the case says it.
    fn name(&self) -> &str;
    /// Hash of the spec that it was made from.
    fn hash(&self) -> &str;
    /// Names of the inputs, in order.
    fn inputs(&self) -> Vec<&str>;
    /// Names of the outputs, in order.
    fn outputs(&self) -> Vec<&str>;
    /// Length of the workspace that [`SpringLaw::evaluate`] needs.
    fn workspace(&self) -> usize;
    /// Evaluates all springs; rows as in [`whirl_specs::LawKernel`]. Allocates nothing.
    fn evaluate(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], workspace: &mut [f64]);
    /// The outputs alone, to the same bits: one row of `springs` values an output, neither derivatives nor rates. What is given here
    /// takes them out of all; a law that is marched has its own, which is faster and allocates nothing.
    fn forces(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], workspace: &mut [f64]) {
        forces_of_all(self, (springs, inputs), outputs, workspace);
    }
    /// Where its results may be believed.
    fn valid(&self) -> Vec<Validity> {
        Vec::new()
    }
    /// What it remembers, in order: its kernel takes them after its inputs, and gives their rates after its outputs.
    fn states(&self) -> Vec<Remembered> {
        Vec::new()
    }
    /// Whether it says how much energy it stores.
    fn stores(&self) -> bool {
        false
    }
    /// Computes the energy that is stored (J): one row of `springs` values an input, then one a state. Allocates nothing.
    fn stored(&self, springs: usize, inputs: &[f64], energies: &mut [f64], workspace: &mut [f64]) {
        let _ = (springs, inputs, energies, workspace);
    }
    /// Computes the measures of [`SpringLaw::valid`]: one row of `springs` values an input, then one a state; one row a measure, SI.
    /// Allocates nothing.
    fn measure(&self, springs: usize, inputs: &[f64], measures: &mut [f64], workspace: &mut [f64]) {
        let _ = (springs, inputs, measures, workspace);
    }
    /// Its coefficients over the frequency of small motions, if it has such: [`SpringLaw::evaluate`] then has those of what
    /// stands still.
    fn over_frequency(&self) -> Option<&FrequencyTable> {
        None
    }
    /// The film that gives its outputs, in place of [`SpringLaw::evaluate`], if it is one.
    fn film(&self) -> Option<&Journal> {
        None
    }
}

/// A state of a law.
#[derive(Debug, Clone, PartialEq)]
pub struct Remembered {
    /// Name in the spec.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// The value at which it begins, SI; none where its rate is zero.
    pub start: Option<f64>,
    /// Between what values it usually is, SI, if the law says so.
    pub range: Option<[f64; 2]>,
}

/// A measure of a law's inputs, and the limits within which the law may be believed.
pub type Validity = whirl_specs::Validity<String>;

impl SpringLaw for &'static Law {
    fn name(&self) -> &str {
        self.origin.name
    }
    fn hash(&self) -> &str {
        self.origin.hash
    }
    fn inputs(&self) -> Vec<&str> {
        self.inputs.iter().map(|variable| variable.name).collect()
    }
    fn outputs(&self) -> Vec<&str> {
        self.outputs.iter().map(|variable| variable.name).collect()
    }
    fn workspace(&self) -> usize {
        0
    }
    fn evaluate(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], _: &mut [f64]) {
        (self.evaluate)(springs, inputs, outputs);
    }
    fn forces(&self, springs: usize, inputs: &[f64], outputs: &mut [f64], workspace: &mut [f64]) {
        match self.forces {
            Some(forces) => forces(springs, inputs, outputs),
            None => forces_of_all(self, (springs, inputs), outputs, workspace),
        }
    }
    fn valid(&self) -> Vec<Validity> {
        let own = |own: &whirl_specs::Validity| Validity {
            name: own.name.to_owned(),
            title: own.title.to_owned(),
            help: own.help.to_owned(),
            unit: own.unit.to_owned(),
            per_unit: own.per_unit,
            limits: own.limits,
        };
        self.valid.iter().map(own).collect()
    }
    fn measure(&self, springs: usize, inputs: &[f64], measures: &mut [f64], _: &mut [f64]) {
        (self.measure)(springs, inputs, measures);
    }
    fn states(&self) -> Vec<Remembered> {
        let own = self.states.iter().map(|own| Remembered {
            name: own.variable.name.to_owned(),
            unit: own.variable.unit.to_owned(),
            start: own.start,
            range: own.range,
        });
        own.collect()
    }
    fn stores(&self) -> bool {
        self.stored.is_some()
    }
    fn stored(&self, springs: usize, inputs: &[f64], energies: &mut [f64], _: &mut [f64]) {
        if let Some(stored) = self.stored {
            stored(springs, inputs, energies);
        }
    }
}

/// The outputs alone, taken out of all that a law computes.
fn forces_of_all<L: SpringLaw + ?Sized>(
    law: &L,
    (springs, inputs): (usize, &[f64]),
    outputs: &mut [f64],
    workspace: &mut [f64],
) {
    let (count, states) = (law.outputs().len(), law.states().len());
    let rows = 1 + law.inputs().len() + states;
    let mut all = vec![0.0; springs * rows * (count + states)];
    law.evaluate(springs, inputs, &mut all, workspace);
    for output in 0..count {
        let own = &all[springs * rows * output..][..springs];
        outputs[springs * output..][..springs].copy_from_slice(own);
    }
}

/// A law with its inputs and outputs found by name.
#[derive(Clone)]
pub(crate) struct BoundLaw {
    pub(crate) law: Arc<dyn SpringLaw>,
    pub(crate) kind: &'static Contact,
    /// For every input of the law its place in [`Contact::inputs`].
    pub(crate) inputs: Vec<usize>,
    /// For every output of the law its place in [`Contact::forces`].
    pub(crate) forces: Vec<usize>,
    /// What it remembers.
    pub(crate) states: Vec<Remembered>,
}

/// What is wrong with a law, and how to fix it.
#[derive(Debug)]
pub(crate) struct WrongLaw {
    pub(crate) what: String,
    pub(crate) help: String,
}

/// Why no kind has all that a law takes and gives.
fn mismatch(law: &dyn SpringLaw, kinds: &'static [Contact]) -> WrongLaw {
    let has = |list: &[ContactVariable], name: &str| list.iter().any(|own| own.name == name);
    let within = |kind: &Contact, other: &Contact| {
        kind.place == other.place
            && kind.inputs.iter().all(|own| has(other.inputs, own.name))
            && kind.forces.iter().all(|own| has(other.forces, own.name))
    };
    // A kind that another has whole says nothing of its own.
    let own = kinds.iter().enumerate().filter(|&(place, kind)| {
        let mut others = kinds.iter().enumerate().filter(|(other, _)| *other != place);
        !others.any(|(other, own)| within(kind, own) && (other > place || !within(own, kind)))
    });
    let kinds: Vec<&'static Contact> = own.map(|(_, kind)| kind).collect();
    let names = |list: &[ContactVariable]| list.iter().map(|own| own.name).collect::<Vec<_>>();
    let all = |list: fn(&Contact) -> &[ContactVariable]| {
        let mut all: Vec<&str> = kinds.iter().flat_map(|kind| names(list(kind))).collect();
        all.sort_unstable();
        all.dedup();
        all
    };
    let known =
        |name: &str, known: Vec<&'static str>| match nearest_in_any_case(name, known.clone()) {
            Some(near) => format!("did you mean {near}?"),
            None => format!("there are {}", known.join(", ")),
        };
    let (inputs, outputs) = (law.inputs(), law.outputs());
    let Some(first) = outputs.first() else {
        let (what, help) = ("gives no force".to_owned(), "give it an output, such as Q".to_owned());
        return WrongLaw { what, help };
    };
    for name in &outputs {
        if !kinds.iter().any(|kind| has(kind.forces, name)) {
            let what = format!(
                "gives {name}, which is not a force of a spring, of a ring, of a joint or of a gear"
            );
            return WrongLaw { what, help: known(name, all(|kind| kind.forces)) };
        }
    }
    for name in &inputs {
        if !kinds.iter().any(|kind| has(kind.inputs, name)) {
            let what = format!(
                "takes the input {name}, which neither springs, rings, joints nor gears have"
            );
            return WrongLaw { what, help: known(name, all(|kind| kind.inputs)) };
        }
    }
    // Of the kinds that have the first, the one that has most.
    let lacks = |kind: &&&Contact| {
        outputs.iter().filter(|name| !has(kind.forces, name)).count()
            + inputs.iter().filter(|name| !has(kind.inputs, name)).count()
    };
    let of_first = kinds.iter().filter(|kind| has(kind.forces, first));
    let kind = of_first.min_by_key(lacks).expect("found above");
    let foreign = outputs.iter().find(|name| !has(kind.forces, name));
    let wrong_input = inputs.iter().find(|name| !has(kind.inputs, name));
    let mixed = match (foreign, wrong_input) {
        (Some(name), _) => Some(format!("gives {first}, a force of a {}, and {name}", kind.name)),
        (None, Some(name)) => {
            Some(format!("gives {first}, a force of a {}, but takes {name}", kind.name))
        }
        (None, None) => None,
    };
    if let Some(what) = mixed {
        let each = |kind: &&Contact| {
            let (inputs, forces) = (names(kind.inputs).join(", "), names(kind.forces).join(", "));
            format!("a law of a {} gives {forces} and takes {inputs}", kind.name)
        };
        let help = kinds.iter().map(each).collect::<Vec<_>>().join("; ");
        return WrongLaw { what, help };
    }
    let needed = kind.forces[0].name;
    let what = format!("gives {}, but a {} needs {needed}", outputs.join(", "), kind.name);
    WrongLaw { what, help: format!("give it the output {needed}") }
}

impl BoundLaw {
    /// Finds what the law takes and gives, in the first kind that has it all.
    ///
    /// # Errors
    /// An input or an output that no kind of law has, or inputs and outputs of different kinds.
    pub(crate) fn new(
        law: Arc<dyn SpringLaw>,
        kinds: &'static [Contact],
    ) -> Result<Self, WrongLaw> {
        let place =
            |name: &str, list: &[ContactVariable]| list.iter().position(|own| own.name == name);
        let bound = kinds.iter().find_map(|kind| {
            let inputs = law.inputs().into_iter().map(|name| place(name, kind.inputs));
            let forces = law.outputs().into_iter().map(|name| place(name, kind.forces));
            let inputs = inputs.collect::<Option<Vec<usize>>>()?;
            let forces = forces.collect::<Option<Vec<usize>>>()?;
            forces.contains(&0).then_some((kind, inputs, forces))
        });
        match bound {
            Some((kind, inputs, forces)) => {
                let states = law.states();
                Ok(BoundLaw { inputs, forces, states, kind, law })
            }
            None => Err(mismatch(law.as_ref(), kinds)),
        }
    }

    /// Rows that its kernel takes: inputs and states.
    pub(crate) fn rows_in(&self) -> usize {
        self.inputs.len() + self.states.len()
    }

    /// Rows that its kernel gives: forces and rates, each before its derivatives.
    pub(crate) fn rows_out(&self) -> usize {
        (self.forces.len() + self.states.len()) * (1 + self.rows_in())
    }

    /// What the law takes.
    fn taken(&self) -> impl Iterator<Item = &'static ContactVariable> {
        self.inputs.iter().map(|&place| &self.kind.inputs[place])
    }

    /// What the law takes and gives.
    fn variables(&self) -> impl Iterator<Item = &'static ContactVariable> {
        self.taken().chain(self.forces.iter().map(|&place| &self.kind.forces[place]))
    }

    /// For every motion of the bore of the kind whether the law needs it.
    pub(crate) fn motions(&self) -> Vec<bool> {
        let needs = |place: usize| self.variables().any(|own| own.bore.contains(&place));
        (0..self.kind.bore.len()).map(needs).collect()
    }

    /// What of the law needs the journal's radius, if anything does.
    pub(crate) fn needs_radius(&self) -> Option<&'static str> {
        self.variables().find(|own| own.radius).map(|own| own.name)
    }

    /// Whether it depends on how fast the bore moves.
    pub(crate) fn needs_rates(&self) -> bool {
        self.taken().any(|own| own.rate && !own.bore.is_empty())
    }

    /// Whether it depends on any rate.
    pub(crate) fn takes_rates(&self) -> bool {
        self.taken().any(|own| own.rate)
    }
}

#[cfg(test)]
mod tests {
    use whirl_specs::LAWS;

    use super::*;

    #[test]
    fn a_compiled_law_has_the_name_and_text_of_its_spec() {
        for law in LAWS {
            let own: &dyn SpringLaw = &law;
            assert_eq!((own.name(), own.hash()), (law.origin.name, law.origin.hash));
        }
    }
}
