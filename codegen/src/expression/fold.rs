//! One walk over the scalars of a graph, whatever they become: numbers, polynomials, roots.

use rustc_hash::FxHashMap;

use super::graph::Graph;
use super::node::{Id, Node, Rational};
use crate::operation::Operation;

/// What a node becomes.
pub(crate) type Folded<A> = Result<<A as Algebra>::Value, <A as Algebra>::Error>;

/// What scalars of a graph become.
pub(crate) trait Algebra {
    /// What one is.
    type Value: Clone;
    /// Why one has none.
    type Error;

    /// A number.
    fn number(&mut self, value: &Rational) -> Self::Value;
    /// A symbol, a truth value, or what is no scalar.
    fn leaf(&mut self, id: Id, node: &Node) -> Folded<Self>;
    /// sum + factor·term
    fn add(&mut self, sum: Self::Value, term: &Self::Value, factor: &Rational) -> Folded<Self>;
    /// product·base^exponent
    fn multiply(
        &mut self,
        product: Self::Value,
        base: &Self::Value,
        exponent: &Rational,
    ) -> Folded<Self>;
    /// A function, a comparison, what joins them, or a choice.
    fn operation(&mut self, operation: Operation<&Self::Value>) -> Folded<Self>;
    /// What a node came to, if it may be as large.
    fn bounded(&mut self, value: Self::Value) -> Folded<Self> {
        Ok(value)
    }
}

impl Graph {
    /// What `root` becomes.
    pub(crate) fn fold<A: Algebra>(&self, root: Id, algebra: &mut A) -> Folded<A> {
        let mut values = self.fold_all(&[root], algebra)?;
        Ok(values.pop().expect("a value a root"))
    }

    /// What several roots become; every node below them is visited once.
    pub(crate) fn fold_all<A: Algebra>(
        &self,
        roots: &[Id],
        algebra: &mut A,
    ) -> Result<Vec<A::Value>, A::Error> {
        let mut known: FxHashMap<Id, A::Value> = FxHashMap::default();
        for id in self.reachable(roots) {
            let value = self.step(id, algebra, &|operand| Ok(&known[&operand]))?;
            known.insert(id, value);
        }
        Ok(roots.iter().map(|root| known[root].clone()).collect())
    }

    /// What a node becomes, from what its operands are.
    pub(crate) fn step<'v, A: Algebra>(
        &self,
        id: Id,
        algebra: &mut A,
        of: &dyn Fn(Id) -> Result<&'v A::Value, A::Error>,
    ) -> Folded<A>
    where
        A::Value: 'v,
    {
        let node = self.node(id);
        let value = match node {
            Node::Number(value) => algebra.number(value),
            Node::Sum(terms) => {
                let mut sum = algebra.number(&Rational::default());
                for (term, coefficient) in terms {
                    sum = algebra.add(sum, of(*term)?, coefficient)?;
                }
                sum
            }
            Node::Product(factors) => {
                let mut product = algebra.number(&Rational::from(1));
                for (base, exponent) in factors {
                    product = algebra.multiply(product, of(*base)?, exponent)?;
                }
                product
            }
            Node::Function(function, a) => {
                algebra.operation(Operation::Function(*function, of(*a)?))?
            }
            Node::Compare(relation, a, b) => {
                algebra.operation(Operation::Compare(*relation, of(*a)?, of(*b)?))?
            }
            Node::And(a, b) => algebra.operation(Operation::And(of(*a)?, of(*b)?))?,
            Node::Or(a, b) => algebra.operation(Operation::Or(of(*a)?, of(*b)?))?,
            Node::Not(a) => algebra.operation(Operation::Not(of(*a)?))?,
            Node::Select(mask, a, b) => {
                algebra.operation(Operation::Select(of(*mask)?, of(*a)?, of(*b)?))?
            }
            Node::Symbol(_)
            | Node::Truth(_)
            | Node::Zero(_)
            | Node::Identity
            | Node::Scale(..)
            | Node::Dot(..)
            | Node::Apply(..)
            | Node::Transpose(_)
            | Node::Outer(..) => algebra.leaf(id, node)?,
        };
        algebra.bounded(value)
    }
}
