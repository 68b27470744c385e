//! Symbols replaced by expressions.

use std::collections::BTreeMap;

use super::graph::Graph;
use super::node::{Id, Node};

impl Graph {
    /// `id` with every key of `by` replaced by its value; what depends on a key is rebuilt by the
    /// constructors.
    pub(crate) fn substitute(&mut self, id: Id, by: &BTreeMap<Id, Id>) -> Id {
        self.substitute_all(&[id], by)[0]
    }

    /// The same of several nodes; what they share is rebuilt once.
    pub(crate) fn substitute_all(&mut self, roots: &[Id], by: &BTreeMap<Id, Id>) -> Vec<Id> {
        let nodes = self.reachable(roots);
        self.spend(nodes.len());
        // What a node becomes: itself, unless it is rebuilt.
        let count = nodes.last().map_or(0, |last| last.0 + 1);
        let mut of: Vec<Id> = (0..count).map(Id).collect();
        for next in nodes {
            let mut changed = false;
            self.node(next).operands(|operand| changed |= of[operand.index()] != operand);
            of[next.index()] = match by.get(&next) {
                Some(replacement) => *replacement,
                None if changed => self.rebuild(next, &|operand| of[operand.index()]),
                None => next,
            };
        }
        roots.iter().map(|root| of[root.index()]).collect()
    }

    /// A node by the constructors, from what its operands became.
    pub(crate) fn rebuild(&mut self, id: Id, of: &dyn Fn(Id) -> Id) -> Id {
        let of = |id: &Id| of(*id);
        match self.node(id).clone() {
            Node::Number(_) | Node::Zero(_) | Node::Identity | Node::Symbol(_) | Node::Truth(_) => {
                id
            }
            Node::Sum(terms) => {
                let terms: Vec<_> = terms.into_iter().map(|(term, c)| (of(&term), c)).collect();
                self.sum(&terms)
            }
            Node::Product(factors) => {
                let factors: Vec<_> = factors.into_iter().map(|(base, e)| (of(&base), e)).collect();
                self.product(&factors)
            }
            Node::Function(function, a) => self.function(function, of(&a)),
            Node::Compare(relation, a, b) => self.compare(relation, of(&a), of(&b)),
            Node::And(a, b) => self.and(of(&a), of(&b)),
            Node::Or(a, b) => self.or(of(&a), of(&b)),
            Node::Not(a) => self.not(of(&a)),
            Node::Select(mask, a, b) => self.select(of(&mask), of(&a), of(&b)),
            Node::Scale(scalar, x) => self.scale(of(&scalar), of(&x)),
            Node::Dot(a, b) => self.dot(of(&a), of(&b)),
            Node::Apply(matrix, x) => self.apply(of(&matrix), of(&x)),
            Node::Transpose(matrix) => self.transpose(of(&matrix)),
            Node::Outer(a, b) => self.outer(of(&a), of(&b)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_in_place_of_a_symbol_folds() {
        let mut g = Graph::new();
        let (x, y) = (g.scalar("x"), g.scalar("y"));
        let (sum, three) = (g.add(x, y), g.integer(3));
        let product = g.mul(sum, x);
        let by = BTreeMap::from([(x, three), (y, three)]);
        let value = g.substitute(product, &by);
        assert_eq!(value, g.integer(18));
    }
}
