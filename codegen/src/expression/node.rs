//! What a node of the graph can be.

pub use crate::operation::{Function, Relation};
pub use crate::rational::Rational;

/// A node of a [`super::Graph`]. Operands always have smaller ids than the node that uses them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Id(pub(super) u32);

impl Id {
    /// Place of the node in the graph, counted from 0 in the order of creation.
    pub(crate) fn index(self) -> usize {
        self.0 as usize
    }
}

/// Shape of a node. Vectors have n entries, matrices n × n; n is known only at run time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Shape {
    /// One number.
    Scalar,
    /// n numbers.
    Vector,
    /// n × n numbers.
    Matrix,
    /// A truth value.
    Truth,
}

/// What is known of a matrix under transposition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Symmetry {
    /// Nothing.
    None,
    /// Aᵀ = A.
    Symmetric,
    /// Aᵀ = −A.
    Skew,
}

/// A named quantity.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Symbol {
    /// The spec's own name.
    pub name: String,
    /// Shape.
    pub shape: Shape,
    /// Symmetry; [`Symmetry::None`] unless a matrix.
    pub symmetry: Symmetry,
}

/// A node. The constructors of [`super::Graph`] keep these in canonical form, as said at each variant.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub enum Node {
    /// An exact number.
    Number(Rational),
    /// A vector or matrix of zeros. (The scalar zero is a number.)
    Zero(Shape),
    /// The unit matrix.
    Identity,
    /// A named quantity.
    Symbol(Symbol),
    /// Σ coefficient·term, of any one shape. Terms ascend, none is a sum or a zero, coefficients are not
    /// zero; a constant of a scalar sum is the term 1. A single term has a coefficient other than 1.
    Sum(Vec<(Id, Rational)>),
    /// Π base^exponent of scalars. Bases ascend, exponents are not zero; a number is a base only under an
    /// exponent that is not whole; a single base has an exponent other than 1.
    Product(Vec<(Id, Rational)>),
    /// A function of a scalar.
    Function(Function, Id),
    /// A comparison of two scalars.
    Compare(Relation, Id, Id),
    /// A truth value.
    Truth(bool),
    /// Both.
    And(Id, Id),
    /// Either.
    Or(Id, Id),
    /// Negation.
    Not(Id),
    /// The second where the first holds, else the third; both of one shape.
    Select(Id, Id, Id),
    /// scalar × vector, or scalar × matrix; the scalar is not a number.
    Scale(Id, Id),
    /// a·b, operands ascending.
    Dot(Id, Id),
    /// matrix × vector; the matrix is a symbol or the transpose of one.
    Apply(Id, Id),
    /// Aᵀ of a matrix symbol without symmetry.
    Transpose(Id),
    /// a bᵀ.
    Outer(Id, Id),
}

impl Node {
    /// Calls `visit` for every operand, in order.
    pub(crate) fn operands(&self, mut visit: impl FnMut(Id)) {
        match self {
            Node::Number(_) | Node::Zero(_) | Node::Identity | Node::Symbol(_) | Node::Truth(_) => {
            }
            Node::Sum(parts) | Node::Product(parts) => parts.iter().for_each(|(id, _)| visit(*id)),
            Node::Function(_, a) | Node::Not(a) | Node::Transpose(a) => visit(*a),
            Node::Compare(_, a, b)
            | Node::And(a, b)
            | Node::Or(a, b)
            | Node::Scale(a, b)
            | Node::Dot(a, b)
            | Node::Apply(a, b)
            | Node::Outer(a, b) => {
                visit(*a);
                visit(*b);
            }
            Node::Select(mask, a, b) => {
                visit(*mask);
                visit(*a);
                visit(*b);
            }
        }
    }
}
