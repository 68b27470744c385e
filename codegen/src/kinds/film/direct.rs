//! Films by direct evaluation of the file's formulas: neither graph nor derivative is used. Tests compare kernels with
//! this.

use std::collections::BTreeMap;

use super::operators::{LENGTHS, TEST, named};
use super::rule::{Rule, shape};
use super::spec::{FilmSpec, Term};
use crate::formula::{Formula, Value, evaluate};
use crate::operation::Number;

/// What a cell is evaluated at: all SI.
#[derive(Debug, Clone)]
pub struct CellValues<N> {
    /// Unknowns and gap at the nodes of the cell, those around run fastest.
    pub nodes: [Vec<N>; 3],
    /// Lengths of the cell, speed and parameters, in the order of [`FilmSpec::uniform`].
    pub uniform: Vec<N>,
}

type Names<N> = BTreeMap<String, Value<N>>;

impl FilmSpec {
    /// Values of all fields of the nodes at one node, in the order of [`FilmSpec::fields`], then what the node holds.
    ///
    /// # Panics
    /// Never for a film that was read without errors.
    pub fn at_node<N: Number>(&self, unknowns_and_gap: [N; 3], uniform: &[N]) -> Vec<N> {
        let mut names = self.shared(uniform);
        let mut values = unknowns_and_gap.to_vec();
        let given = [&self.unknowns[0].name, &self.unknowns[1].name, &self.gap.name];
        for (name, value) in given.into_iter().zip(&values) {
            names.insert(name.clone(), Value::Scalar(value.clone()));
        }
        for field in &self.nodal {
            let value = number(&field.formula, &names);
            names.insert(field.name.clone(), Value::Scalar(value.clone()));
            values.push(value);
        }
        values.push(number(&self.stored.0, &names));
        values
    }

    /// The residual of a cell, one value a node.
    pub fn residual_of<N: Number>(&self, cell: &CellValues<N>) -> Vec<N> {
        let mut residual = vec![N::near(0.0); self.nodes[0] * self.nodes[1]];
        for term in &self.terms {
            for (a, value) in residual.iter_mut().enumerate() {
                *value = value.add(&self.integrated(term, cell, Some(a)));
            }
        }
        residual
    }

    /// Forces at the nodes of a cell, force by force, then the integrals of the outputs over it.
    pub fn surface_of<N: Number>(&self, cell: &CellValues<N>) -> Vec<N> {
        let mut values = Vec::new();
        let rules = self.nodes.map(Rule::nodes);
        for force in &self.forces {
            for z in &rules[1].points {
                for x in &rules[0].points {
                    let names = self.names(cell, [&x.0, &z.0], None);
                    let weight = N::exact(&(&x.1 * &z.1)).mul(&quarter(cell));
                    values.push(number(&force.formula, &names).mul(&weight));
                }
            }
        }
        for output in &self.outputs {
            let terms = output.terms.iter().map(|term| self.integrated(term, cell, None));
            values.push(terms.fold(N::near(0.0), |sum, term| sum.add(&term)));
        }
        values
    }

    fn integrated<N: Number>(&self, term: &Term, cell: &CellValues<N>, test: Option<usize>) -> N {
        let mut sum = N::near(0.0);
        for z in &term.rules[1].points {
            for x in &term.rules[0].points {
                let names = self.names(cell, [&x.0, &z.0], test);
                let weight = N::exact(&(&x.1 * &z.1));
                sum = sum.add(&number(&term.formula, &names).mul(&weight));
            }
        }
        sum.mul(&quarter(cell))
    }

    fn shared<N: Number>(&self, uniform: &[N]) -> Names<N> {
        let names = self.uniform().into_iter().map(|(name, _)| name.to_owned());
        names.zip(uniform.iter().cloned().map(Value::Scalar)).collect()
    }

    /// All names at a point, the definitions, too.
    fn names<N: Number>(
        &self,
        cell: &CellValues<N>,
        at: [&crate::rational::Rational; 2],
        test: Option<usize>,
    ) -> Names<N> {
        let mut names = self.shared(&cell.uniform);
        let functions = [shape(self.nodes[0], at[0]), shape(self.nodes[1], at[1])];
        let around = self.nodes[0];
        let function = |a: usize| {
            let ((x, by_x), (z, by_z)) = (&functions[0][a % around], &functions[1][a / around]);
            [x * z, by_x * z, x * by_z].map(|value| N::exact(&value))
        };
        let halves = [&cell.uniform[0], &cell.uniform[1]].map(|length| length.div(&N::near(2.0)));
        let speed = &cell.uniform[LENGTHS.len()];
        let sign = N::near(if speed.value() < 0.0 { -1.0 } else { 1.0 });
        let count = self.nodes[0] * self.nodes[1];
        let at_nodes: Vec<Vec<N>> = (0..count)
            .map(|a| {
                let own = [0, 1, 2].map(|field| cell.nodes[field][a].clone());
                self.at_node(own, &cell.uniform)
            })
            .collect();
        for (place, (_, name, _)) in self.fields().into_iter().enumerate() {
            let mut sums = [0.0; 3].map(N::near);
            for (a, fields) in at_nodes.iter().enumerate() {
                for (sum, function) in sums.iter_mut().zip(function(a)) {
                    *sum = sum.add(&fields[place].mul(&function));
                }
            }
            let [value, x, z] = sums;
            let upstream = value.sub(&sign.mul(&x));
            let mut take = |name: String, value: N| names.insert(name, Value::Scalar(value));
            take(named("ddx", name), x.div(&halves[0]));
            take(named("ddz", name), z.div(&halves[1]));
            take(named("upstream", name), upstream);
            take(name.to_owned(), value);
        }
        if let Some(a) = test {
            let [value, x, z] = function(a);
            names.insert(TEST.to_owned(), Value::Scalar(value));
            names.insert(named("ddx", TEST), Value::Scalar(x.div(&halves[0])));
            names.insert(named("ddz", TEST), Value::Scalar(z.div(&halves[1])));
        }
        for (name, formula, _) in &self.definitions {
            let value = number(formula, &names);
            names.insert(name.clone(), Value::Scalar(value));
        }
        names
    }
}

/// dx/2·dz/2
fn quarter<N: Number>(cell: &CellValues<N>) -> N {
    cell.uniform[0].mul(&cell.uniform[1]).div(&N::near(4.0))
}

fn number<N: Number>(formula: &Formula, names: &Names<N>) -> N {
    evaluate(formula, names).and_then(Value::scalar).expect("a checked formula over known names")
}
