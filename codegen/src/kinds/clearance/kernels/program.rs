//! One program for a kind of law: what the law takes, where its forces go, and their tangent.
//!
//! What is fixed once a spring goes to a table, what a ring shares is computed once a ring, and what a sum over
//! springs shares is multiplied after it.

use std::collections::BTreeSet;

use crate::expression::{Function, Graph, Id, Node, Symbol};
use crate::kinds::clearance::{ClearanceSpec, Contact, Derived, Place, RING};
use crate::schedule::{
    Input, Output, Program, Request, ScheduleError, Stage, schedule, schedule_as_written, take_out,
};

/// Once a machine, from the springs' angles.
pub(super) const TABLE: usize = 0;
/// Once a ring.
pub(super) const EACH_RING: usize = 1;
/// Once a spring.
pub(super) const EACH_SPRING: usize = 2;
/// Once a ring, after the sums over its springs.
pub(super) const AFTER_SUMS: usize = 3;

/// Springs a ring that hoisting reckons with.
const SPRINGS: f64 = 24.0;

/// Outputs of the program: what the law takes, and the measures beside that on which its forces work.
pub(super) fn taken(contact: &Contact) -> Vec<String> {
    let inputs = contact.inputs.iter().map(|input| format!("taken_{}_", input.name));
    let further = contact.further_measures().map(|force| format!("measure_of_{}_", force.name));
    inputs.chain(further).collect()
}
/// Generalised force i of a spring: on the ring's coordinates, then on the bore's motions.
pub(super) fn force(i: usize) -> String {
    format!("force_{i}_")
}
/// Entry (i, k) of its tangent.
pub(super) fn entry(i: usize, k: usize) -> String {
    format!("by_{i}_{k}_")
}
/// The same on the ring's coordinates, of all springs together.
pub(super) fn of_ring(name: &str) -> String {
    format!("ring_{name}")
}

/// A sum over the springs of a ring.
pub(super) struct Sum {
    /// The output that gives one spring's part.
    pub(super) part: String,
    /// The input that takes the sum.
    pub(super) total: String,
}

/// One program that computes everything, of which each kernel takes its part.
pub(super) fn program(
    spec: &ClearanceSpec,
    contact: &Contact,
    derived: Derived,
) -> Result<(Program, Vec<Sum>), ScheduleError> {
    let Derived { mut graph, rates, forces, slopes, a1, inputs: values, .. } = derived;
    let mut inputs = Vec::new();
    let mut take = |name: &str, symbol: Id, stage| {
        inputs.push(Input { name: name.to_owned(), symbol, stage });
    };
    take(&spec.spring.name, spec.spring.symbol, TABLE);
    let shared = spec.ring.iter().chain(&rates[..RING]).chain([&spec.constant]).chain(&spec.radius);
    shared.for_each(|own| take(&own.name, own.symbol, EACH_RING));
    take("a1_", a1, EACH_RING);
    let own = contact.bore.iter().map(|(_, own)| own).chain(&rates[RING..]);
    let own = own.map(|own| (own.name.clone(), own.symbol));
    let of_law: Vec<(String, Id)> =
        forces.into_iter().chain(slopes.into_iter().flatten()).collect();
    let given = of_law.len();
    let own: Vec<(String, Id)> = own.chain(of_law).collect();
    own.iter().for_each(|(name, symbol)| take(name, *symbol, EACH_SPRING));

    let mut outputs = Vec::new();
    let mut give = |name, expression| outputs.push(Output { name, expression });
    taken(contact).into_iter().zip(values).for_each(|(name, id)| give(name, id));
    // What is summed over the springs of a ring.
    let mut summed = Vec::new();
    for (i, expression) in derived.force.into_iter().enumerate() {
        match i < RING {
            true => summed.push((force(i), expression)),
            false => give(force(i), expression),
        }
    }
    for (i, row) in derived.tangent.into_iter().enumerate() {
        for (k, expression) in row.into_iter().enumerate() {
            match i < RING && k < RING {
                true => summed.push((entry(i, k), expression)),
                false => give(entry(i, k), expression),
            }
        }
    }
    let names = inputs.iter().map(|input| input.name.clone()).chain(taken(contact));
    let names = names.chain(spec.definitions.iter().map(|(name, _)| name.clone()));
    let varies = own.iter().map(|(_, symbol)| *symbol).chain([spec.spring.symbol]).collect();
    let mut sums =
        Sums { taken: names.collect(), varies, of_law: given, graph: &mut graph, sums: Vec::new() };
    let totals = sums.totals(&summed);
    let sums = sums.sums;
    for (sum, part, _) in &sums {
        give(sum.part.clone(), *part);
    }
    let totals = summed.iter().map(|(name, _)| of_ring(name)).zip(totals);
    totals.for_each(|(name, expression)| give(name, expression));
    for (sum, _, symbol) in &sums {
        inputs.push(Input { name: sum.total.clone(), symbol: *symbol, stage: AFTER_SUMS });
    }
    let stages = vec![
        Stage::new("table", &[], 1.0 / SPRINGS),
        Stage::new("ring", &[], 1.0),
        Stage::new("spring", &[TABLE, EACH_RING], SPRINGS),
        Stage::new("after", &[EACH_RING], 1.0),
    ];
    let mut names: Vec<(Id, String)> =
        spec.definitions.iter().map(|(name, id)| (*id, name.clone())).collect();
    let clearance = (contact.forces.iter().zip(&derived.gradients))
        .find(|(force, _)| force.measure == spec.value);
    for (coordinate, slope) in spec.ring.iter().zip(clearance.into_iter().flat_map(|(_, g)| g)) {
        names.push((*slope, format!("d{}_d{}", spec.clearance, coordinate.name)));
    }
    let request = Request { stages, inputs, outputs, names };
    let program = match contact.place {
        Place::Joint => schedule_as_written(&mut graph, &request),
        Place::Spring | Place::Ring => schedule(&mut graph, &request),
    }?;
    Ok((program, sums.into_iter().map(|(sum, ..)| sum).collect()))
}

/// The sums over springs that all totals together need.
struct Sums<'a> {
    graph: &'a mut Graph,
    /// Names of other things.
    taken: BTreeSet<String>,
    varies: Vec<Id>,
    /// How many forces and slopes a law gives.
    of_law: usize,
    /// Each with the part of one spring and the symbol of the sum.
    sums: Vec<(Sum, Id, Id)>,
}

impl Sums<'_> {
    /// The totals of expressions with their names: by the sums that they share, if these are fewer; otherwise
    /// each is summed itself.
    fn totals(&mut self, summed: &[(String, Id)]) -> Vec<Id> {
        // Expressions are linear in what a law gives, and each of that needs a sum of its own at least.
        if self.of_law <= summed.len() {
            let before = self.taken.clone();
            let shared: Vec<Id> = summed.iter().map(|(_, id)| self.total(*id)).collect();
            if self.sums.len() <= summed.len() {
                return shared;
            }
            (self.taken, self.sums) = (before, Vec::new());
        }
        let mut whole = Vec::new();
        for (name, id) in summed {
            if self.graph.is_zero(*id) {
                whole.push(*id);
                continue;
            }
            let total = format!("total_{name}");
            let symbol = self.graph.scalar(&total);
            self.sums.push((Sum { part: name.clone(), total }, *id, symbol));
            whole.push(symbol);
        }
        whole
    }

    /// Σ of `expression` over the springs, in terms of what is summed and what all share.
    fn total(&mut self, expression: Id) -> Id {
        let mut total = self.graph.integer(0);
        for (shared, part) in take_out(self.graph, expression, &self.varies.clone()) {
            let sum = self.sum(part);
            let product = self.graph.mul(shared, sum);
            total = self.graph.add(total, product);
        }
        total
    }

    fn sum(&mut self, part: Id) -> Id {
        if let Some((.., total)) = self.sums.iter().find(|(_, known, _)| *known == part) {
            return *total;
        }
        let mut name =
            describe(self.graph, part).unwrap_or_else(|| format!("part{}", self.sums.len()));
        while [&name, &format!("total_{name}")].iter().any(|name| self.taken.contains(*name)) {
            name += "_of_spring";
        }
        let total = format!("total_{name}");
        self.taken.extend([name.clone(), total.clone()]);
        let symbol = self.graph.scalar(&total);
        self.sums.push((Sum { part: name, total }, part, symbol));
        symbol
    }
}

/// A name for a short product, such as `Q_cos_psi`.
fn describe(graph: &Graph, id: Id) -> Option<String> {
    let factor = |id: Id| match graph.node(id) {
        Node::Symbol(Symbol { name, .. }) => Some(name.clone()),
        Node::Function(function, argument) => {
            let Node::Symbol(Symbol { name, .. }) = graph.node(*argument) else { return None };
            let turns = matches!(function, Function::Sin | Function::Cos);
            turns.then(|| format!("{}_{name}", function.lane()))
        }
        _ => None,
    };
    match graph.node(id) {
        Node::Product(factors) => {
            let mut names = Vec::new();
            for (base, exponent) in factors {
                let name = factor(*base)?;
                let power = exponent.is_integer().then(|| exponent.to_integer().to_string())?;
                names.push(if power == "1" { name } else { format!("{name}_{power}") });
            }
            // Forces first.
            names.sort_by_key(|name| !name.starts_with(['Q', 'd']));
            (names.len() <= 4 && !names.iter().any(|name| name.contains('-')))
                .then(|| names.join("_"))
        }
        _ => factor(id),
    }
}
