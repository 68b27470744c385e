//! Quadrature rules with exact points and weights, and the proof of their degree.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use num_traits::One;

use super::algebraic::{Algebraic, Field};
use super::cell::Cell;
use super::polynomial::{Exponents, Polynomial};
use crate::expression::Rational;

/// A point of a rule: reference coordinates and weight, numbers of the rule's field.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Point {
    /// ξ, η, ζ.
    pub at: [Algebraic; 3],
    /// Weight; the weights sum to the cell's volume.
    pub(crate) weight: Algebraic,
}

/// A rule over some of the coordinates; a rule of a cell is a product of such.
#[derive(Debug, Clone)]
pub(crate) struct Factor {
    /// The coordinates.
    pub(crate) axes: Range<usize>,
    /// For every point its coordinates and its weight.
    pub points: Vec<(Vec<Algebraic>, Algebraic)>,
}

/// A rule on a reference cell.
#[derive(Debug, Clone)]
pub struct Quadrature {
    /// The rule in words, such as `gauss(2) × gauss(2) × gauss(2)`.
    pub title: String,
    /// The field of all its numbers.
    pub field: Field,
    /// The rules whose product it is, in the order of the coordinates.
    pub(crate) factors: Vec<Factor>,
    /// The points; those of the first factor run fastest.
    pub points: Vec<Point>,
    /// Every monomial up to this total degree is integrated exactly.
    pub(crate) degree: u32,
    /// Whether it is meant to have fewer points than the products in its forms need.
    pub(crate) reduced: bool,
    /// Whether it is enough that affine images of the cell pass the patch test.
    pub affine: bool,
    /// Where it stands in the file.
    pub place: Range<usize>,
}

/// A monomial that a rule should integrate and does not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Failure {
    /// Exponents of the cell's variables.
    pub(crate) powers: Exponents,
    /// What the rule gives.
    pub(crate) found: String,
    /// The exact integral.
    pub(crate) exact: String,
}

impl Quadrature {
    /// The product of these rules; `None` unless their coordinates together are three.
    pub(crate) fn new(
        title: String,
        field: Field,
        factors: Vec<Factor>,
        degree: u32,
        place: Range<usize>,
    ) -> Option<Self> {
        let one = || Algebraic::rational(Rational::one());
        let mut points: Vec<(Vec<Algebraic>, Algebraic)> = vec![(Vec::new(), one())];
        for factor in &factors {
            let mut next = Vec::with_capacity(points.len() * factor.points.len());
            for (at, weight) in &factor.points {
                for (before, other) in &points {
                    let at = before.iter().chain(at).cloned().collect();
                    next.push((at, field.multiply(other, weight)));
                }
            }
            points = next;
        }
        let point =
            |(at, weight): (Vec<Algebraic>, _)| Some(Point { at: at.try_into().ok()?, weight });
        let points = points.into_iter().map(point).collect::<Option<_>>()?;
        Some(Quadrature {
            title,
            field,
            factors,
            points,
            degree,
            reduced: false,
            affine: false,
            place,
        })
    }

    /// Integrates every monomial up to `degree` and compares with the exact integral over the cell.
    ///
    /// # Errors
    /// The first monomial, by degree, that is not integrated exactly.
    pub(crate) fn prove(&self, cell: Cell) -> Result<(), Failure> {
        let mut integrals = Integrals::new(self, cell);
        for total in 0..=self.degree as i32 {
            for i in (0..=total).rev() {
                for j in (0..=total - i).rev() {
                    integrals.exact([i, j, total - i - j])?;
                }
            }
        }
        Ok(())
    }
}

/// What a rule makes of monomials in a cell's variables, each computed once.
pub(crate) struct Integrals<'r> {
    rule: &'r Quadrature,
    cell: Cell,
    /// By the number of the factor and the exponents of its coordinates; `None` where there is no such power.
    known: BTreeMap<(usize, Vec<i32>), Option<Known>>,
    /// Monomials that were found to be integrated exactly.
    exact: BTreeSet<Exponents>,
}

/// A monomial over one factor: times the weight at every point, and the sum over the points.
struct Known {
    products: Vec<Algebraic>,
    sum: Algebraic,
}

impl<'r> Integrals<'r> {
    /// For a rule on a cell.
    pub(crate) fn new(rule: &'r Quadrature, cell: Cell) -> Self {
        Integrals { rule, cell, known: BTreeMap::new(), exact: BTreeSet::new() }
    }

    /// Compares with the exact integral over the cell.
    ///
    /// # Errors
    /// Both numbers, where they differ.
    pub(crate) fn exact(&mut self, powers: Exponents) -> Result<(), Failure> {
        if self.exact.contains(&powers) {
            return Ok(());
        }
        let (found, exact) = (self.of(powers), self.cell.integral(powers));
        if let (Some(found), Some(exact)) = (&found, &exact)
            && found.minus(&Algebraic::rational(exact.clone())).is_zero()
        {
            self.exact.insert(powers);
            return Ok(());
        }
        let none = || "no value".to_owned();
        Err(Failure {
            powers,
            found: found.map_or_else(none, |found| self.rule.field.display(&found)),
            exact: exact.map_or_else(none, |exact| exact.to_string()),
        })
    }

    /// Σ w ξⁱ ηʲ ζᵏ; `None` where a point has no such power.
    pub(crate) fn of(&mut self, powers: Exponents) -> Option<Algebraic> {
        let mut product = Algebraic::rational(Rational::one());
        for (place, factor) in self.rule.factors.iter().enumerate() {
            let key = (place, powers[factor.axes.clone()].to_vec());
            self.know(&key);
            let known = self.known[&key].as_ref()?;
            product = self.rule.field.multiply(&product, &known.sum);
        }
        Some(product)
    }

    /// Computes a monomial from the one with a power less.
    fn know(&mut self, key: &(usize, Vec<i32>)) {
        if self.known.contains_key(key) {
            return;
        }
        let (place, powers) = key;
        let (factor, field) = (&self.rule.factors[*place], &self.rule.field);
        let products: Option<Vec<Algebraic>> = match powers.iter().rposition(|power| *power != 0) {
            None => Some(factor.points.iter().map(|(_, weight)| weight.clone()).collect()),
            Some(last) => {
                let mut less = powers.clone();
                less[last] -= powers[last].signum();
                let less = (*place, less);
                self.know(&less);
                let axis = factor.axes.start + last;
                let next = |((at, _), before): (&(Vec<Algebraic>, _), &Algebraic)| {
                    let variable = variable(self.cell, axis, &at[last]);
                    let by = field.power(&variable, powers[last].signum())?;
                    Some(field.multiply(before, &by))
                };
                let before = self.known[&less].as_ref().map(|known| &known.products);
                before.and_then(|before| factor.points.iter().zip(before).map(next).collect())
            }
        };
        let integral = products.map(|products| {
            let mut sum = Algebraic::default();
            products.iter().for_each(|term| sum.add(term, &Rational::one()));
            Known { products, sum }
        });
        self.known.insert(key.clone(), integral);
    }

    /// Σ w p.
    pub(crate) fn of_polynomial(&mut self, polynomial: &Polynomial) -> Option<Algebraic> {
        let mut sum = Algebraic::default();
        for (powers, coefficient) in polynomial.terms() {
            sum.add(&self.of(*powers)?, coefficient);
        }
        Some(sum)
    }
}

/// The cell's variable on an axis at a coordinate: 1 − ζ on the third of a pyramid, else the coordinate.
pub(crate) fn variable(cell: Cell, axis: usize, coordinate: &Algebraic) -> Algebraic {
    match (cell, axis) {
        (Cell::Pyramid, 2) => Algebraic::rational(Rational::one()).minus(coordinate),
        _ => coordinate.clone(),
    }
}
