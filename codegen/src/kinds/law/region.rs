//! What expressions of one input are in a region of it: polynomials, and conditions that hold or do not.

use num_traits::Signed;

use super::root::Polynomial;
use crate::expression::{Algebra, Folded, Function, Graph, Id, Node, Relation};
use crate::operation::Operation;
use crate::rational::Rational;

/// The region of `x` around `middle` in which no comparison changes; everywhere, where nothing is compared, if
/// there is none.
pub(super) struct Within<'r> {
    pub(super) x: Id,
    pub(super) middle: Option<&'r Rational>,
}

/// What an expression is there.
#[derive(Debug, Clone)]
pub(super) enum Chosen {
    Polynomial(Polynomial),
    Truth(bool),
}

/// It is neither.
#[derive(Debug, Clone, Copy)]
pub(super) struct Neither;

impl Polynomial {
    /// The expression as a polynomial in `x`, if it is one of a degree and with coefficients within the
    /// limits, and is built from such.
    pub(super) fn of(graph: &Graph, expression: Id, x: Id) -> Option<Self> {
        match graph.fold(expression, &mut Within { x, middle: None }) {
            Ok(Chosen::Polynomial(polynomial)) => Some(polynomial),
            _ => None,
        }
    }
}

impl Chosen {
    fn polynomial(&self) -> Result<&Polynomial, Neither> {
        match self {
            Chosen::Polynomial(polynomial) => Ok(polynomial),
            Chosen::Truth(_) => Err(Neither),
        }
    }

    pub(super) fn truth(&self) -> Result<bool, Neither> {
        match self {
            Chosen::Truth(truth) => Ok(*truth),
            Chosen::Polynomial(_) => Err(Neither),
        }
    }
}

impl Algebra for Within<'_> {
    type Value = Chosen;
    type Error = Neither;

    fn number(&mut self, value: &Rational) -> Chosen {
        Chosen::Polynomial(Polynomial::constant(value))
    }

    fn leaf(&mut self, id: Id, node: &Node) -> Folded<Self> {
        match node {
            _ if id == self.x => Ok(Chosen::Polynomial(Polynomial::variable())),
            Node::Truth(value) => Ok(Chosen::Truth(*value)),
            _ => Err(Neither),
        }
    }

    fn add(&mut self, sum: Chosen, term: &Chosen, factor: &Rational) -> Folded<Self> {
        let term = term.polynomial()?.times(&Polynomial::constant(factor)).ok_or(Neither)?;
        Ok(Chosen::Polynomial(sum.polynomial()?.plus(&term)))
    }

    fn multiply(&mut self, product: Chosen, base: &Chosen, exponent: &Rational) -> Folded<Self> {
        let power = base.polynomial()?.power(exponent).ok_or(Neither)?;
        let product = product.polynomial()?.times(&power).ok_or(Neither)?;
        Ok(Chosen::Polynomial(product))
    }

    fn operation(&mut self, operation: Operation<&Chosen>) -> Folded<Self> {
        let middle = self.middle.ok_or(Neither)?;
        Ok(match operation {
            Operation::Function(Function::Abs, a) => {
                let a = a.polynomial()?;
                let sign = if a.at(middle).is_negative() { -1 } else { 1 };
                let signed = a.times(&Polynomial::constant(&Rational::from(sign)));
                Chosen::Polynomial(signed.ok_or(Neither)?)
            }
            Operation::Compare(relation, a, b) => {
                let difference = a.polynomial()?.minus(b.polynomial()?).at(middle);
                Chosen::Truth(match relation {
                    Relation::Less => difference.is_negative(),
                    Relation::LessOrEqual => !difference.is_positive(),
                })
            }
            Operation::And(a, b) => Chosen::Truth(a.truth()? && b.truth()?),
            Operation::Or(a, b) => Chosen::Truth(a.truth()? || b.truth()?),
            Operation::Not(a) => Chosen::Truth(!a.truth()?),
            Operation::Select(mask, a, b) => if mask.truth()? { a } else { b }.clone(),
            _ => return Err(Neither),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_are_recognised() {
        let exact = |n: i64| Rational::from(n);
        let mut graph = Graph::new();
        let (x, y) = (graph.scalar("x"), graph.scalar("y"));
        let one = graph.integer(1);
        let sum = graph.add(x, one);
        let cube = graph.power(sum, exact(3));
        let linear = Polynomial::variable().plus(&Polynomial::constant(&exact(1)));
        let expected = linear.power(&exact(3)).unwrap();
        assert_eq!(Polynomial::of(&graph, cube, x), Some(expected));
        let mixed = graph.mul(x, y);
        assert_eq!(Polynomial::of(&graph, mixed, x), None);
        let tower = graph.power(cube, exact(100));
        assert_eq!(Polynomial::of(&graph, tower, x), None);
        let root = graph.sqrt(x);
        assert_eq!(Polynomial::of(&graph, root, x), None);
    }
}
