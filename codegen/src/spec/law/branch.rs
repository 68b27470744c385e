//! Which side of every comparison inside a law's formulas a point lies on, by evaluating the graph.

use std::collections::BTreeMap;

use num_traits::ToPrimitive;

use super::{LawOutput, LawSpec};
use crate::expression::{Function, Graph, Id, Node, Relation};
use crate::rational::nearest;

/// The comparisons of an output's formulas, but for those between the rows of a table, where neither value
/// nor slope jumps.
pub(super) struct Branches {
    /// What to compute, operands before users.
    steps: Vec<Step>,
    /// Steps of the comparisons.
    compared: Vec<usize>,
}

/// Truth is 1 and 0; operands are places of steps.
enum Step {
    Input(usize),
    Number(f64),
    Sum(Vec<(usize, f64)>),
    Product(Vec<(usize, Power)>),
    Function(Function, usize),
    Compare(Relation, usize, usize),
    And(usize, usize),
    Or(usize, usize),
    Not(usize),
    Select(usize, usize, usize),
}

enum Power {
    Whole(i32),
    Other(f64),
}

impl Branches {
    pub(super) fn of(law: &LawSpec, output: &LawOutput) -> Self {
        let graph = &law.graph;
        let between: Vec<Id> = law.tables.iter().flat_map(|table| table.inner()).copied().collect();
        let compared: Vec<Id> = (graph.reachable(&[output.value]).into_iter())
            .filter(|id| match graph.node(*id) {
                Node::Compare(..) => !between.contains(id),
                Node::Function(Function::Abs, _) => true,
                _ => false,
            })
            .collect();
        let order = graph.reachable(&compared);
        let places: BTreeMap<Id, usize> =
            order.iter().enumerate().map(|(place, id)| (*id, place)).collect();
        let steps = order.iter().map(|id| step(law, graph, *id, &places)).collect();
        Branches { steps, compared: compared.iter().map(|id| places[id]).collect() }
    }

    /// The sides of all comparisons where the inputs (SI) have the given values.
    pub(super) fn sides(&self, inputs: &[f64]) -> Vec<bool> {
        let mut found: Vec<f64> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            found.push(step.value(inputs, &found));
        }
        let side = |place: &usize| match self.steps[*place] {
            Step::Function(_, argument) => found[argument] < 0.0,
            _ => found[*place] == 1.0,
        };
        self.compared.iter().map(side).collect()
    }
}

fn step(law: &LawSpec, graph: &Graph, id: Id, places: &BTreeMap<Id, usize>) -> Step {
    let at = |id: &Id| places[id];
    if let Some(input) = law.inputs.iter().position(|input| input.symbol == id) {
        return Step::Input(input);
    }
    match graph.node(id) {
        Node::Number(value) => Step::Number(nearest(value)),
        Node::Sum(terms) => {
            Step::Sum(terms.iter().map(|(term, c)| (at(term), nearest(c))).collect())
        }
        Node::Product(factors) => {
            let factors = factors.iter().map(|(base, exponent)| {
                let whole = exponent.to_i32().filter(|_| exponent.is_integer());
                let power = whole.map_or_else(|| Power::Other(nearest(exponent)), Power::Whole);
                (at(base), power)
            });
            Step::Product(factors.collect())
        }
        Node::Function(function, argument) => Step::Function(*function, at(argument)),
        Node::Compare(relation, a, b) => Step::Compare(*relation, at(a), at(b)),
        Node::Truth(value) => Step::Number(f64::from(*value)),
        Node::And(a, b) => Step::And(at(a), at(b)),
        Node::Or(a, b) => Step::Or(at(a), at(b)),
        Node::Not(a) => Step::Not(at(a)),
        Node::Select(mask, a, b) => Step::Select(at(mask), at(a), at(b)),
        // Laws are made of numbers, and of no symbols but their inputs.
        Node::Symbol(_)
        | Node::Zero(_)
        | Node::Identity
        | Node::Scale(..)
        | Node::Dot(..)
        | Node::Apply(..)
        | Node::Transpose(_)
        | Node::Outer(..) => Step::Number(f64::NAN),
    }
}

impl Step {
    fn value(&self, inputs: &[f64], of: &[f64]) -> f64 {
        let holds = |place: &usize| of[*place] == 1.0;
        match self {
            Step::Input(place) => inputs[*place],
            Step::Number(value) => *value,
            Step::Sum(terms) => terms.iter().map(|(term, c)| c * of[*term]).sum(),
            Step::Product(factors) => factors
                .iter()
                .map(|(base, power)| match power {
                    Power::Whole(exponent) => of[*base].powi(*exponent),
                    Power::Other(exponent) => libm::pow(of[*base], *exponent),
                })
                .product(),
            Step::Function(function, a) => function.value(of[*a]),
            Step::Compare(Relation::Less, a, b) => f64::from(of[*a] < of[*b]),
            Step::Compare(Relation::LessOrEqual, a, b) => f64::from(of[*a] <= of[*b]),
            Step::And(a, b) => f64::from(holds(a) && holds(b)),
            Step::Or(a, b) => f64::from(holds(a) || holds(b)),
            Step::Not(a) => f64::from(!holds(a)),
            Step::Select(mask, a, b) => of[if holds(mask) { *a } else { *b }],
        }
    }
}
