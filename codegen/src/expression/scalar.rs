//! Constructors of sums (of any shape), products, functions and choices, in canonical form.

use num_traits::{One, Signed, ToPrimitive, Zero};

use super::graph::{Graph, NUMBER_BITS};
use super::node::{Function, Id, Node, Rational, Relation, Shape};
use crate::operation::Parity;

impl Graph {
    /// Σ coefficient·term; the terms have one shape and there is at least one.
    pub(crate) fn sum(&mut self, terms: &[(Id, Rational)]) -> Id {
        let shape = self.shape(terms[0].0);
        self.spend(terms.len());
        if self.exceeded() {
            return self.zero(shape);
        }
        let one = self.integer(1);
        let mut gathered = 0;
        let mut parts: Vec<(Id, Rational)> = Vec::with_capacity(terms.len());
        let mut gather = |id: Id, coefficient: Rational| parts.push((id, coefficient));
        for (id, coefficient) in terms {
            debug_assert_eq!(self.shape(*id), shape);
            match self.node(*id) {
                Node::Number(value) => gather(one, coefficient * value),
                Node::Zero(_) => {}
                Node::Sum(inner) => {
                    gathered += inner.len();
                    inner.iter().for_each(|(id, c)| gather(*id, coefficient * c));
                }
                _ => gather(*id, coefficient.clone()),
            }
        }
        self.spend(gathered);
        merge(&mut parts);
        match &parts[..] {
            [] => self.zero(shape),
            [(id, coefficient)] if *id == one => self.number(coefficient.clone()),
            [(id, coefficient)] if coefficient.is_one() => *id,
            _ => self.bounded_sum(parts),
        }
    }

    fn bounded_sum(&mut self, terms: Vec<(Id, Rational)>) -> Id {
        // Passing each coefficient through `number` applies the bound on its size.
        terms.iter().for_each(|(_, coefficient)| {
            self.number(coefficient.clone());
        });
        self.intern(Node::Sum(terms))
    }

    /// a + b, of one shape.
    pub(crate) fn add(&mut self, a: Id, b: Id) -> Id {
        self.sum(&[(a, Rational::one()), (b, Rational::one())])
    }

    /// a − b, of one shape.
    pub fn sub(&mut self, a: Id, b: Id) -> Id {
        self.sum(&[(a, Rational::one()), (b, -Rational::one())])
    }

    /// −a, of any shape.
    pub(crate) fn neg(&mut self, a: Id) -> Id {
        self.times(-Rational::one(), a)
    }

    /// coefficient · a, of any shape.
    pub(crate) fn times(&mut self, coefficient: Rational, a: Id) -> Id {
        self.sum(&[(a, coefficient)])
    }

    /// The terms of a sum, or the node itself once.
    pub fn terms(&self, id: Id) -> Vec<(Id, Rational)> {
        match self.node(id) {
            Node::Sum(terms) => terms.clone(),
            _ => vec![(id, Rational::one())],
        }
    }

    /// coefficient and rest of a single-term sum; (1, node) of anything else.
    pub(super) fn split_coefficient(&self, id: Id) -> (Rational, Id) {
        match self.node(id) {
            Node::Sum(terms) if terms.len() == 1 => (terms[0].1.clone(), terms[0].0),
            _ => (Rational::one(), id),
        }
    }

    /// Π base^exponent of scalars.
    pub(crate) fn product(&mut self, factors: &[(Id, Rational)]) -> Id {
        if self.exceeded() {
            return self.integer(0);
        }
        let mut coefficient = Rational::one();
        let mut parts: Vec<(Id, Rational)> = factors.to_vec();
        let mut new = parts.len();
        // A base can fall apart (products, numbers) once its exponent becomes whole by merging.
        while new > 0 {
            self.spend(new);
            merge(&mut parts);
            let falling = |(base, exponent): &mut (Id, Rational)| self.falls_apart(*base, exponent);
            let splitting: Vec<(Id, Rational)> = parts.extract_if(.., falling).collect();
            let mut open = Vec::new();
            for (base, exponent) in splitting {
                match self.node(base).clone() {
                    Node::Number(value) => {
                        let (whole, rest) = self.split_power(&value, &exponent);
                        match self.number_power(&value, &whole) {
                            Some(power) => coefficient *= power,
                            None => {
                                self.overflow();
                                return self.integer(1);
                            }
                        }
                        open.extend((!rest.1.is_zero()).then_some(rest));
                    }
                    Node::Product(inner) => {
                        open.extend(inner.into_iter().map(|(b, e)| (b, e * &exponent)));
                    }
                    Node::Sum(terms) => {
                        let (term, factor) = terms.into_iter().next().expect("a single term");
                        let factor = self.number(factor);
                        open.push((factor, exponent.clone()));
                        open.push((term, exponent));
                    }
                    _ => unreachable!("only numbers, products and single-term sums fall apart"),
                }
            }
            new = open.len();
            parts.append(&mut open);
        }
        let product = match &parts[..] {
            [] => return self.number(coefficient),
            [(base, exponent)] if exponent.is_one() => *base,
            _ => self.intern(Node::Product(parts)),
        };
        self.times(coefficient, product)
    }

    fn falls_apart(&self, base: Id, exponent: &Rational) -> bool {
        match self.node(base) {
            Node::Number(value) => {
                let divides_by_zero = value.is_zero() && exponent.is_negative();
                let exact = exponent.is_integer()
                    || value.is_one()
                    || exponent.is_over(2) && value.root().is_some()
                    || value.is_positive() && !is_proper(exponent);
                exact && !divides_by_zero
            }
            Node::Product(_) => exponent.is_integer(),
            Node::Sum(terms) => {
                terms.len() == 1 && (exponent.is_integer() || terms[0].1.is_positive())
            }
            _ => false,
        }
    }

    /// The exponent that can be taken of a number exactly, and what is left as base and exponent, so that
    /// equal roots of a number are equal nodes: 3^(−1/2) = 3⁻¹·3^(1/2), 3^(3/2) = 3·3^(1/2).
    fn split_power(&mut self, value: &Rational, exponent: &Rational) -> (Rational, (Id, Rational)) {
        let one = self.integer(1);
        if exponent.is_integer() || value.is_one() || exponent.is_over(2) && value.root().is_some()
        {
            return (exponent.clone(), (one, Rational::zero()));
        }
        let whole = exponent.floor();
        let base = self.number(value.clone());
        (whole.clone(), (base, exponent - whole))
    }

    /// value^exponent where it is exact; `None` past the bounds.
    fn number_power(&self, value: &Rational, exponent: &Rational) -> Option<Rational> {
        if value.is_one() {
            return Some(Rational::one());
        }
        let (value, exponent) = if exponent.is_integer() {
            (value.clone(), exponent.to_i32()?)
        } else {
            (value.root()?, (exponent * Rational::from(2)).to_i32()?)
        };
        if value.bits().saturating_mul(u64::from(exponent.unsigned_abs())) > 2 * NUMBER_BITS {
            return None;
        }
        Some(value.pow(exponent))
    }

    /// baseᵉ of a scalar.
    pub(crate) fn power(&mut self, base: Id, exponent: Rational) -> Id {
        self.product(&[(base, exponent)])
    }

    /// √a of a scalar.
    pub(crate) fn sqrt(&mut self, a: Id) -> Id {
        self.power(a, Rational::half())
    }

    /// a·b: scalar with anything, or matrix with vector.
    pub(crate) fn mul(&mut self, a: Id, b: Id) -> Id {
        match (self.shape(a), self.shape(b)) {
            (Shape::Scalar, Shape::Scalar) => {
                self.product(&[(a, Rational::one()), (b, Rational::one())])
            }
            (Shape::Scalar, _) => self.scale(a, b),
            (_, Shape::Scalar) => self.scale(b, a),
            (Shape::Matrix, Shape::Vector) => self.apply(a, b),
            shapes => panic!("no product of {shapes:?}"),
        }
    }

    /// a/b for a scalar b.
    pub(crate) fn div(&mut self, a: Id, b: Id) -> Id {
        let inverse = self.power(b, -Rational::one());
        self.mul(inverse, a)
    }

    /// A function of a scalar.
    pub(crate) fn function(&mut self, function: Function, a: Id) -> Id {
        if let Some(value) = self.as_number(a).cloned() {
            let (at, exact) = function.exact();
            if function == Function::Abs {
                return self.number(value.abs());
            } else if value == Rational::from(at) {
                return self.integer(exact);
            }
        }
        let negative = match self.node(a) {
            Node::Number(value) => value.is_negative(),
            Node::Sum(terms) => terms.len() == 1 && terms[0].1.is_negative(),
            _ => false,
        };
        if !negative || function.parity() == Parity::None {
            return self.intern(Node::Function(function, a));
        }
        let positive = self.neg(a);
        let value = self.intern(Node::Function(function, positive));
        if function.parity() == Parity::Odd { self.neg(value) } else { value }
    }

    /// A comparison of scalars.
    pub fn compare(&mut self, relation: Relation, a: Id, b: Id) -> Id {
        let known = match (self.as_number(a), self.as_number(b)) {
            (Some(a), Some(b)) => Some(relation.holds(a, b)),
            _ if a == b => Some(relation == Relation::LessOrEqual),
            _ => None,
        };
        match known {
            Some(value) => self.intern(Node::Truth(value)),
            None => self.intern(Node::Compare(relation, a, b)),
        }
    }

    /// Both.
    pub(crate) fn and(&mut self, a: Id, b: Id) -> Id {
        match (self.node(a), self.node(b)) {
            (Node::Truth(false), _) | (_, Node::Truth(true)) => a,
            (_, Node::Truth(false)) | (Node::Truth(true), _) => b,
            _ if a == b => a,
            _ => self.intern(Node::And(a.min(b), a.max(b))),
        }
    }

    /// Either.
    pub(crate) fn or(&mut self, a: Id, b: Id) -> Id {
        match (self.node(a), self.node(b)) {
            (Node::Truth(true), _) | (_, Node::Truth(false)) => a,
            (_, Node::Truth(true)) | (Node::Truth(false), _) => b,
            _ if a == b => a,
            _ => self.intern(Node::Or(a.min(b), a.max(b))),
        }
    }

    /// Negation.
    pub(crate) fn not(&mut self, a: Id) -> Id {
        match *self.node(a) {
            Node::Truth(value) => self.intern(Node::Truth(!value)),
            Node::Not(inner) => inner,
            _ => self.intern(Node::Not(a)),
        }
    }

    /// `a` where `mask` holds, else `b`.
    pub fn select(&mut self, mask: Id, a: Id, b: Id) -> Id {
        match *self.node(mask) {
            Node::Truth(value) => return if value { a } else { b },
            Node::Not(inner) => return self.select(inner, b, a),
            _ => {}
        }
        if a == b { a } else { self.intern(Node::Select(mask, a, b)) }
    }
}

/// By ascending ids, each once, without those whose numbers cancel.
fn merge(parts: &mut Vec<(Id, Rational)>) {
    parts.sort_by_key(|(id, _)| *id);
    parts.dedup_by(|next, kept| {
        let same = next.0 == kept.0;
        if same {
            kept.1 += &next.1;
        }
        same
    });
    parts.retain(|(_, number)| !number.is_zero());
}

/// Between 0 and 1.
fn is_proper(exponent: &Rational) -> bool {
    exponent.is_positive() && *exponent < Rational::one()
}
