//! Shape functions multiplied out: exact polynomials in a cell's own variables.

use std::collections::BTreeMap;
use std::fmt;

use num_traits::{One, Signed, ToPrimitive, Zero};

use super::cell::Cell;
use crate::expression::{Algebra, Folded, Graph, Id, Node, Rational};
use crate::operation::Operation;

/// Exponents of ξ, η and the cell's third variable: ζ, or ω = 1 − ζ over a pyramid, where they may be negative.
pub(crate) type Exponents = [i32; 3];

/// Highest exponent, and most terms, of a polynomial: far above any element in use.
const HIGHEST: i32 = 24;
const TERMS: usize = 512;

/// Most bits of a numerator or denominator.
const NUMBER_BITS: u64 = 1024;

/// Σ c ξⁱ ηʲ ζᵏ, or Σ c ξⁱ ηʲ ωᵏ over a pyramid; no coefficient is zero.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Polynomial {
    terms: BTreeMap<Exponents, Rational>,
}

impl Polynomial {
    fn constant(value: Rational) -> Self {
        Self::monomial([0; 3], value)
    }

    /// c ξⁱ ηʲ ζᵏ.
    pub(crate) fn monomial(exponents: Exponents, coefficient: Rational) -> Self {
        let mut monomial = Polynomial::default();
        monomial.insert(exponents, coefficient);
        monomial
    }

    fn insert(&mut self, exponents: Exponents, coefficient: Rational) {
        if coefficient.is_zero() {
            return;
        }
        let sum = self.terms.entry(exponents).or_insert_with(Rational::zero);
        *sum += coefficient;
        if sum.is_zero() {
            self.terms.remove(&exponents);
        }
    }

    /// ξ, η or ζ.
    pub(crate) fn coordinate(cell: Cell, axis: usize) -> Self {
        let mut exponents = [0; 3];
        exponents[axis] = 1;
        match (cell, axis) {
            (Cell::Pyramid, 2) => {
                let mut coordinate = Self::constant(Rational::one());
                coordinate.insert(exponents, -Rational::one());
                coordinate
            }
            _ => Self::monomial(exponents, Rational::one()),
        }
    }

    /// An expression over the coordinates, multiplied out; `None` if it is no polynomial with rational
    /// coefficients (over a pyramid divided by powers of 1 − ζ), or a very large one.
    pub(crate) fn read(graph: &Graph, id: Id, coordinates: &[Id; 3], cell: Cell) -> Option<Self> {
        graph.fold(id, &mut Over { coordinates, cell }).ok()
    }

    /// Adds scale · other.
    pub(crate) fn add(&mut self, other: &Polynomial, scale: &Rational) {
        other.terms.iter().for_each(|(exponents, c)| self.insert(*exponents, c * scale));
    }

    /// The product; `None` of a very large one.
    pub(crate) fn multiply(&self, other: &Polynomial) -> Option<Self> {
        if self.terms.len() * other.terms.len() > 4 * TERMS {
            return None;
        }
        let mut product = Polynomial::default();
        for (a, x) in &self.terms {
            for (b, y) in &other.terms {
                product.insert(std::array::from_fn(|axis| a[axis] + b[axis]), x * y);
            }
        }
        product.bounded()
    }

    fn bounded(self) -> Option<Self> {
        let small = |(exponents, c): (&Exponents, &Rational)| {
            exponents.iter().all(|exponent| exponent.abs() <= HIGHEST) && c.bits() <= NUMBER_BITS
        };
        (self.terms.len() <= TERMS && self.terms.iter().all(small)).then_some(self)
    }

    fn power(&self, exponent: i32, cell: Cell) -> Option<Self> {
        if exponent < 0 {
            // Only a number, or a power of ω, has an inverse.
            let (exponents, c) = self.terms.first_key_value().filter(|_| self.terms.len() == 1)?;
            let [0, 0, k] = *exponents else { return None };
            let invertible = k == 0 || cell == Cell::Pyramid;
            let inverse = Self::monomial([0, 0, -k], c.recip());
            return invertible.then(|| inverse.power(-exponent, cell))?;
        }
        if exponent > HIGHEST {
            return None;
        }
        let one = Some(Self::constant(Rational::one()));
        (0..exponent).fold(one, |power, _| power?.multiply(self))
    }

    /// ∂/∂ξ, ∂/∂η or ∂/∂ζ.
    pub fn slope(&self, cell: Cell, axis: usize) -> Self {
        let sign = if (cell, axis) == (Cell::Pyramid, 2) { -1 } else { 1 };
        let mut slope = Polynomial::default();
        for (exponents, c) in &self.terms {
            let mut lower = *exponents;
            lower[axis] -= 1;
            slope.insert(lower, c * Rational::from(sign * exponents[axis]));
        }
        slope
    }

    /// Exponents and coefficients.
    pub fn terms(&self) -> impl ExactSizeIterator<Item = (&Exponents, &Rational)> {
        self.terms.iter()
    }

    /// Whether it is 0 everywhere.
    pub(crate) fn is_zero(&self) -> bool {
        self.terms.is_empty()
    }

    /// The value at a point (ξ, η, ζ) of the cell. At the apex of a pyramid, where ω and with it ξ and η
    /// vanish, it is the limit from within the cell; `None` if there is none.
    pub fn at(&self, cell: Cell, point: &[Rational; 3]) -> Option<Rational> {
        let mut point = point.clone();
        if cell == Cell::Pyramid {
            point[2] = Rational::one() - &point[2];
            if point[2].is_zero() {
                return self.at_apex();
            }
        }
        let mut sum = Rational::zero();
        for (exponents, c) in &self.terms {
            let mut term = c.clone();
            for (x, exponent) in point.iter().zip(exponents) {
                match exponent {
                    0 => {}
                    1 => term *= x,
                    _ => term *= x.pow(*exponent),
                }
            }
            sum += term;
        }
        Some(sum)
    }

    /// ξ and η are of the order of ω: what is of no order is constant or depends on the direction.
    fn at_apex(&self) -> Option<Rational> {
        let mut value = Rational::zero();
        for (exponents, c) in &self.terms {
            match (exponents.iter().sum::<i32>(), exponents) {
                (1.., _) => {}
                (0, [0, 0, 0]) => value = c.clone(),
                _ => return None,
            }
        }
        Some(value)
    }

    /// As a formula in the cell's variables.
    pub fn display(&self, cell: Cell) -> impl fmt::Display + '_ {
        Displayed { polynomial: self, cell }
    }
}

/// Polynomials over the coordinates of a cell.
struct Over<'c> {
    coordinates: &'c [Id; 3],
    cell: Cell,
}

/// An expression is no polynomial, or a very large one.
struct Refused;

impl Algebra for Over<'_> {
    type Value = Polynomial;
    type Error = Refused;

    fn number(&mut self, value: &Rational) -> Polynomial {
        Polynomial::constant(value.clone())
    }

    fn leaf(&mut self, id: Id, _: &Node) -> Folded<Self> {
        let axis = self.coordinates.iter().position(|coordinate| *coordinate == id);
        Ok(Polynomial::coordinate(self.cell, axis.ok_or(Refused)?))
    }

    fn add(&mut self, mut sum: Polynomial, term: &Polynomial, factor: &Rational) -> Folded<Self> {
        sum.add(term, factor);
        Ok(sum)
    }

    fn multiply(
        &mut self,
        product: Polynomial,
        base: &Polynomial,
        exponent: &Rational,
    ) -> Folded<Self> {
        let exponent = exponent.to_i32().filter(|_| exponent.is_integer()).ok_or(Refused)?;
        let power = base.power(exponent, self.cell).ok_or(Refused)?;
        product.multiply(&power).ok_or(Refused)
    }

    fn operation(&mut self, _: Operation<&Polynomial>) -> Folded<Self> {
        Err(Refused)
    }

    fn bounded(&mut self, value: Polynomial) -> Folded<Self> {
        value.bounded().ok_or(Refused)
    }
}

struct Displayed<'p> {
    polynomial: &'p Polynomial,
    cell: Cell,
}

impl fmt::Display for Displayed<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.polynomial.is_zero() {
            return f.write_str("0");
        }
        for (place, (exponents, c)) in self.polynomial.terms.iter().enumerate() {
            match (place, c.is_negative()) {
                (0, true) => f.write_str("-")?,
                (0, false) => {}
                (_, true) => f.write_str(" - ")?,
                (_, false) => f.write_str(" + ")?,
            }
            let (c, powers) = (c.abs(), self.cell.power(*exponents));
            match (c.is_one(), powers.as_str()) {
                (_, "1") => write!(f, "{c}")?,
                (true, powers) => f.write_str(powers)?,
                (false, powers) => write!(f, "{c}*{powers}")?,
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Located;
    use crate::formula::{lower, parse};

    fn read(cell: Cell, text: &str) -> Option<Polynomial> {
        let mut graph = Graph::new();
        let coordinates = ["xi", "eta", "zeta"].map(|name| graph.scalar(name));
        let names = ["xi", "eta", "zeta"].map(str::to_owned).into_iter().zip(coordinates).collect();
        let formula = parse(&Located::alone("test", text)).expect("a formula");
        let id = lower(&formula, &mut graph, &names).expect("an expression");
        Polynomial::read(&graph, id, &coordinates, cell)
    }

    fn point(at: [(i64, i64); 3]) -> [Rational; 3] {
        at.map(|(n, d)| Rational::new(n, d))
    }

    #[test]
    fn products_multiply_out_and_have_slopes() {
        let cell = Cell::Hexahedron;
        let p = read(cell, "(1 - xi)*(1 + xi)*(eta/2 + zeta)^2").expect("a polynomial");
        let expanded =
            read(cell, "eta^2/4 + eta*zeta + zeta^2 - xi^2*eta^2/4 - xi^2*eta*zeta - xi^2*zeta^2");
        assert_eq!(Some(p.clone()), expanded);
        assert_eq!(Some(p.slope(cell, 0)), read(cell, "-2*xi*(eta/2 + zeta)^2"));
        assert_eq!(Some(p.slope(cell, 1)), read(cell, "(1 - xi^2)*(eta/2 + zeta)"));
        let at = point([(1, 2), (1, 3), (-1, 1)]);
        assert_eq!(p.at(cell, &at), Some(Rational::new(25, 48)));
        assert_eq!(
            read(cell, "1 - 3*xi^2*zeta/2 + eta").expect("a polynomial").display(cell).to_string(),
            "1 + eta - 3/2*xi^2*zeta"
        );
    }

    #[test]
    fn over_a_pyramid_functions_are_divided_by_the_height_left() {
        let cell = Cell::Pyramid;
        let text = "(1 + xi - zeta)*(1 + eta - zeta)/(4*(1 - zeta))";
        assert_eq!(read(Cell::Hexahedron, text), None);
        let p = read(cell, text).expect("a rational function");
        assert_eq!(
            p.display(cell).to_string(),
            "1/4*(1 - zeta) + 1/4*eta + 1/4*xi + 1/4*xi*eta/(1 - zeta)"
        );
        let corner = point([(1, 1), (1, 1), (0, 1)]);
        assert_eq!(p.at(cell, &corner), Some(Rational::one()));
        let apex = point([(0, 1), (0, 1), (1, 1)]);
        assert_eq!(p.at(cell, &apex), Some(Rational::zero()));
        // Its slope at the apex depends on the direction from which one comes.
        assert_eq!(p.slope(cell, 0).at(cell, &apex), None);
        assert_eq!(Some(p.slope(cell, 2)), read(cell, "xi*eta/(4*(1 - zeta)^2) - 1/4"));
    }

    #[test]
    fn what_is_no_polynomial_or_very_large_is_refused() {
        for text in [
            "sin(xi)",
            "1/(2 + xi)",
            "sqrt(1 + xi)",
            "abs(eta)",
            "xi^30",
            "(1 + xi + eta + zeta)^8^2",
        ] {
            assert_eq!(read(Cell::Hexahedron, text), None, "{text}");
        }
        let long = ["(1 + xi + eta + zeta)^8"; 4].join("*");
        assert_eq!(read(Cell::Hexahedron, &long), None);
    }
}
