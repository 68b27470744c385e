//! Symbolic derivatives.

use std::cell::RefCell;
use std::collections::BTreeMap;

use num_traits::One;

use super::graph::Graph;
use super::node::{Function, Id, Node, Rational, Relation, Shape};
use crate::operation::Arithmetic;

/// Why a derivative has no form that the graph can hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum DifferentiateError {
    /// A derivative that needs the product of two stored matrices.
    #[error("the derivative needs the product of two matrices; declare that product as a tensor")]
    MatrixProduct,
    /// The derivative of a matrix by a vector has three indices.
    #[error(
        "the derivative of a matrix by a vector has three indices; write it applied to a vector"
    )]
    ThirdOrder,
}

/// Derivatives of the nodes below an expression, where they have a form.
type Derivatives = BTreeMap<Id, Result<Id, DifferentiateError>>;

impl Graph {
    /// ∂(expression)/∂(symbol). By a scalar the shape stays; a scalar by a vector is its gradient, a
    /// vector by a vector its Jacobian Jᵢⱼ = ∂a_i/∂x_j.
    pub fn differentiate(&mut self, expression: Id, symbol: Id) -> Result<Id, DifferentiateError> {
        let by_vector = self.shape(symbol) == Shape::Vector;
        // A vector whose Jacobian has no form may still stand in a dot product, which needs none.
        let mut derivatives = Derivatives::new();
        for id in self.reachable(&[expression]) {
            let derivative = if id == symbol {
                Ok(if by_vector { self.identity() } else { self.integer(1) })
            } else {
                self.rule(id, by_vector, &derivatives)
            };
            derivatives.insert(id, derivative);
            if self.exceeded() {
                return self.derivative_zero(self.shape(expression), by_vector);
            }
        }
        derivatives[&expression]
    }

    /// Whether a node is known not to depend on the symbol.
    fn is_constant(&self, id: Id, of: &Derivatives) -> bool {
        self.shape(id) == Shape::Truth || of[&id].is_ok_and(|derivative| self.is_zero(derivative))
    }

    /// Jᵀ c for the Jacobian J of a vector, without forming J.
    fn pull(&mut self, vector: Id, c: Id, of: &Derivatives) -> Result<Id, DifferentiateError> {
        if self.is_constant(vector, of) || self.is_zero(c) {
            return Ok(self.zero(Shape::Vector));
        }
        match self.node(vector).clone() {
            Node::Sum(terms) => {
                let mut parts = Vec::with_capacity(terms.len());
                for (term, coefficient) in terms {
                    parts.push((self.pull(term, c, of)?, coefficient));
                }
                Ok(self.sum(&parts))
            }
            Node::Scale(scalar, x) => {
                let along = self.dot(x, c);
                let along = self.scale(along, of[&scalar]?);
                let scaled = self.scale(scalar, c);
                let rest = self.pull(x, scaled, of)?;
                Ok(self.add(along, rest))
            }
            Node::Apply(matrix, x) if self.is_constant(matrix, of) => {
                let transposed = self.transpose(matrix);
                let c = self.apply(transposed, c);
                self.pull(x, c, of)
            }
            Node::Select(mask, a, b) => {
                let (a, b) = (self.pull(a, c, of)?, self.pull(b, c, of)?);
                Ok(self.select(mask, a, b))
            }
            _ => {
                let transposed = self.transpose(of[&vector]?);
                Ok(self.apply(transposed, c))
            }
        }
    }

    /// Shape of the derivative of something of shape `shape`.
    fn derivative_zero(&mut self, shape: Shape, by_vector: bool) -> Result<Id, DifferentiateError> {
        Ok(match (shape, by_vector) {
            (Shape::Scalar, true) => self.zero(Shape::Vector),
            (Shape::Vector, true) => self.zero(Shape::Matrix),
            // The derivative of a constant matrix by a vector is only ever used as "nothing".
            (shape, _) => self.zero(shape),
        })
    }

    fn rule(
        &mut self,
        id: Id,
        by_vector: bool,
        of: &Derivatives,
    ) -> Result<Id, DifferentiateError> {
        let shape = self.shape(id);
        if shape == Shape::Truth {
            // What a truth value chooses has the derivative of the choice; it has none itself.
            return Ok(self.zero(shape));
        }
        let node = self.node(id).clone();
        let mut constant = true;
        node.operands(|operand| constant &= self.is_constant(operand, of));
        if constant {
            return self.derivative_zero(shape, by_vector);
        }
        if shape == Shape::Matrix && by_vector {
            return Err(DifferentiateError::ThirdOrder);
        }
        Ok(match node.clone() {
            Node::Sum(terms) => {
                let mut parts = Vec::with_capacity(terms.len());
                for (term, c) in terms {
                    parts.push((of[&term]?, c));
                }
                self.sum(&parts)
            }
            Node::Product(factors) => {
                let mut parts = Vec::with_capacity(factors.len());
                for (place, (base, exponent)) in factors.iter().enumerate() {
                    if self.is_zero(of[base]?) {
                        continue;
                    }
                    if self.exceeded() {
                        break;
                    }
                    let mut rest = factors.clone();
                    rest[place].1 = exponent - Rational::one();
                    let rest = self.product(&rest);
                    parts.push((self.mul(rest, of[base]?), exponent.clone()));
                }
                if self.exceeded() {
                    return self.derivative_zero(shape, by_vector);
                }
                self.sum(&parts)
            }
            Node::Function(function, a) => {
                let slope = self.slope(function, a, id);
                self.mul(slope, of[&a]?)
            }
            Node::Select(mask, a, b) => self.select(mask, of[&a]?, of[&b]?),
            Node::Scale(scalar, x) => {
                let rest = self.scale(scalar, of[&x]?);
                let along = if by_vector {
                    self.outer(x, of[&scalar]?)
                } else {
                    self.scale(of[&scalar]?, x)
                };
                self.add(along, rest)
            }
            Node::Dot(a, b) => {
                let (left, right) = if by_vector {
                    (self.pull(a, b, of)?, self.pull(b, a, of)?)
                } else {
                    (self.dot(of[&a]?, b), self.dot(a, of[&b]?))
                };
                self.add(left, right)
            }
            Node::Apply(matrix, x) if by_vector => {
                if !self.is_zero(of[&matrix]?) {
                    return Err(DifferentiateError::ThirdOrder);
                }
                self.compose(matrix, of[&x]?).ok_or(DifferentiateError::MatrixProduct)?
            }
            Node::Apply(matrix, x) => {
                let (left, right) = (self.apply(of[&matrix]?, x), self.apply(matrix, of[&x]?));
                self.add(left, right)
            }
            Node::Transpose(matrix) => self.transpose(of[&matrix]?),
            Node::Outer(a, b) => {
                let (left, right) = (self.outer(of[&a]?, b), self.outer(a, of[&b]?));
                self.add(left, right)
            }
            Node::Number(_)
            | Node::Zero(_)
            | Node::Identity
            | Node::Symbol(_)
            | Node::Compare(..)
            | Node::Truth(_)
            | Node::And(..)
            | Node::Or(..)
            | Node::Not(_) => unreachable!("{node:?} has no operand that varies"),
        })
    }

    /// f′(a), where f(a) is `value`.
    fn slope(&mut self, function: Function, a: Id, value: Id) -> Id {
        let graph = &RefCell::new(self);
        function.slope(&Term { graph, id: a }, &Term { graph, id: value }).id
    }
}

/// A scalar of a graph that slopes are written to.
#[derive(Clone)]
struct Term<'g> {
    graph: &'g RefCell<&'g mut Graph>,
    id: Id,
}

impl Term<'_> {
    fn with(&self, make: impl FnOnce(&mut Graph, Id) -> Id) -> Self {
        let id = make(&mut self.graph.borrow_mut(), self.id);
        Term { graph: self.graph, id }
    }
}

impl Arithmetic for Term<'_> {
    fn number(&self, value: f64) -> Self {
        let value = Rational::from_float(value).expect("a finite number");
        self.with(|graph, _| graph.number(value))
    }
    fn plus(&self, other: &Self) -> Self {
        self.with(|graph, id| graph.add(id, other.id))
    }
    fn minus(&self, other: &Self) -> Self {
        self.with(|graph, id| graph.sub(id, other.id))
    }
    fn times(&self, other: &Self) -> Self {
        self.with(|graph, id| graph.mul(id, other.id))
    }
    fn over(&self, other: &Self) -> Self {
        self.with(|graph, id| graph.div(id, other.id))
    }
    fn root(&self) -> Self {
        self.with(Graph::sqrt)
    }
    fn sign(&self) -> Self {
        self.with(|graph, id| {
            let [one, zero, minus] = [1, 0, -1].map(|value| graph.integer(value));
            let below = graph.compare(Relation::Less, id, zero);
            graph.select(below, minus, one)
        })
    }
    fn through(&self, function: Function) -> Self {
        self.with(|graph, id| graph.function(function, id))
    }
}
