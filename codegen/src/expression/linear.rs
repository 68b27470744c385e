//! Constructors of vector and matrix nodes, in canonical form: coefficients and scalar factors move to
//! the outside, so that each matrix–vector product is one node however often it is used.

use super::graph::Graph;
use super::node::{Id, Node, Shape, Symmetry};

impl Graph {
    /// scalar × (vector or matrix).
    pub(crate) fn scale(&mut self, scalar: Id, x: Id) -> Id {
        debug_assert_eq!(self.shape(scalar), Shape::Scalar);
        if let Some(value) = self.as_number(scalar).cloned() {
            return self.times(value, x);
        }
        if self.is_zero(x) {
            return x;
        }
        let (outer, scalar) = self.split_coefficient(scalar);
        let (inner, x) = self.split_coefficient(x);
        let scaled = match *self.node(x) {
            Node::Scale(other, rest) => {
                let both = self.mul(scalar, other);
                return self.scale_by(outer * inner, both, rest);
            }
            _ => self.intern(Node::Scale(scalar, x)),
        };
        self.times(outer * inner, scaled)
    }

    fn scale_by(&mut self, coefficient: super::Rational, scalar: Id, x: Id) -> Id {
        let scaled = self.scale(scalar, x);
        self.times(coefficient, scaled)
    }

    /// Takes coefficient and scalar factor off a vector or matrix: (scalar node, rest).
    pub(super) fn split_scale(&mut self, x: Id) -> (Id, Id) {
        let (coefficient, rest) = self.split_coefficient(x);
        let (scalar, rest) = match *self.node(rest) {
            Node::Scale(scalar, rest) => (scalar, rest),
            _ => (self.integer(1), rest),
        };
        (self.times(coefficient, scalar), rest)
    }

    /// a·b of vectors.
    pub(crate) fn dot(&mut self, a: Id, b: Id) -> Id {
        debug_assert_eq!((self.shape(a), self.shape(b)), (Shape::Vector, Shape::Vector));
        if self.is_zero(a) || self.is_zero(b) {
            return self.integer(0);
        }
        let ((sa, a), (sb, b)) = (self.split_scale(a), self.split_scale(b));
        let dot = self.intern(Node::Dot(a.min(b), a.max(b)));
        let factor = self.mul(sa, sb);
        self.mul(factor, dot)
    }

    /// matrix × vector.
    pub(crate) fn apply(&mut self, matrix: Id, x: Id) -> Id {
        debug_assert_eq!((self.shape(matrix), self.shape(x)), (Shape::Matrix, Shape::Vector));
        if self.is_zero(matrix) || self.is_zero(x) {
            return self.zero(Shape::Vector);
        }
        let (factor, x) = self.split_scale(x);
        let product = match self.node(matrix).clone() {
            Node::Identity => x,
            Node::Outer(a, b) => {
                let along = self.dot(b, x);
                self.scale(along, a)
            }
            Node::Scale(scalar, inner) => {
                let applied = self.apply(inner, x);
                self.scale(scalar, applied)
            }
            Node::Sum(terms) => {
                let parts: Vec<_> =
                    terms.into_iter().map(|(term, c)| (self.apply(term, x), c)).collect();
                self.sum(&parts)
            }
            _ => self.intern(Node::Apply(matrix, x)),
        };
        self.scale(factor, product)
    }

    /// a bᵀ.
    pub(crate) fn outer(&mut self, a: Id, b: Id) -> Id {
        debug_assert_eq!((self.shape(a), self.shape(b)), (Shape::Vector, Shape::Vector));
        if self.is_zero(a) || self.is_zero(b) {
            return self.zero(Shape::Matrix);
        }
        let ((sa, a), (sb, b)) = (self.split_scale(a), self.split_scale(b));
        let outer = self.intern(Node::Outer(a, b));
        let factor = self.mul(sa, sb);
        self.scale(factor, outer)
    }

    /// Aᵀ.
    pub(crate) fn transpose(&mut self, matrix: Id) -> Id {
        debug_assert_eq!(self.shape(matrix), Shape::Matrix);
        match self.node(matrix).clone() {
            Node::Zero(_) | Node::Identity => matrix,
            Node::Symbol(symbol) => match symbol.symmetry {
                Symmetry::Symmetric => matrix,
                Symmetry::Skew => self.neg(matrix),
                Symmetry::None => self.intern(Node::Transpose(matrix)),
            },
            Node::Transpose(inner) => inner,
            Node::Outer(a, b) => self.outer(b, a),
            Node::Scale(scalar, inner) => {
                let inner = self.transpose(inner);
                self.scale(scalar, inner)
            }
            Node::Sum(terms) => {
                let parts: Vec<_> =
                    terms.into_iter().map(|(term, c)| (self.transpose(term), c)).collect();
                self.sum(&parts)
            }
            Node::Select(mask, a, b) => {
                let (a, b) = (self.transpose(a), self.transpose(b));
                self.select(mask, a, b)
            }
            other => unreachable!("{other:?} is no matrix"),
        }
    }

    /// A·B of matrices, where B is built from the unit matrix and outer products; `None` where two stored
    /// matrices would have to be multiplied.
    pub(super) fn compose(&mut self, a: Id, b: Id) -> Option<Id> {
        if self.is_zero(a) || self.is_zero(b) {
            return Some(self.zero(Shape::Matrix));
        }
        match self.node(b).clone() {
            Node::Identity => Some(a),
            Node::Outer(x, y) => {
                let x = self.apply(a, x);
                Some(self.outer(x, y))
            }
            Node::Scale(scalar, inner) => {
                let inner = self.compose(a, inner)?;
                Some(self.scale(scalar, inner))
            }
            Node::Sum(terms) => {
                let mut parts = Vec::with_capacity(terms.len());
                for (term, c) in terms {
                    parts.push((self.compose(a, term)?, c));
                }
                Some(self.sum(&parts))
            }
            _ if *self.node(a) == Node::Identity => Some(b),
            _ => None,
        }
    }
}
