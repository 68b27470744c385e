//! Exact numbers with square roots: a tower of quadratic extensions of the rationals, in which sums over the
//! points of a rule are exact and cheap.

mod roots;

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

use crate::expression::{Algebra, Folded, Graph, Id, Node, Rational};
use crate::operation::Operation;

/// Bits behind the point of an approximation: far more than 53, so that rounding to f64 is nearest.
const BITS: u32 = 320;

/// Most roots of one field: numbers have up to 2^roots coefficients.
const ROOTS: usize = 8;

/// Most bits of a numerator or denominator of a number that is read, and most coefficients: what is done with
/// the points of a rule afterwards takes time that grows with both.
const NUMBER_BITS: u64 = 1024;
const TERMS: usize = 32;

/// Products of coefficients that all numbers of a field together may take to be read.
const WORK: u64 = 200_000;

/// Why a number cannot be read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ReadError {
    /// It is none, not made by square roots, or by more than there may be.
    Roots,
    /// It has too many digits or terms.
    Size,
}

/// ℚ(r₁)(r₂)…: each rᵢ is the positive square root of a number of the field below it.
#[derive(Debug, Clone, Default)]
pub struct Field {
    squares: Vec<Algebraic>,
    /// rᵢ·2^BITS.
    roots: Vec<BigInt>,
    /// Products of coefficients that reading took.
    work: u64,
}

/// Σ over sets S of c_S Π_{i ∈ S} rᵢ; a set is a bit mask, no coefficient is zero.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Algebraic(BTreeMap<u32, Rational>);

impl Algebraic {
    /// A rational number.
    pub(crate) fn rational(value: Rational) -> Self {
        Algebraic(BTreeMap::from([(0, value)]).into_iter().filter(|(_, c)| !c.is_zero()).collect())
    }

    /// Whether it is 0.
    pub(crate) fn is_zero(&self) -> bool {
        self.0.is_empty()
    }

    /// The number, if it is rational.
    pub(crate) fn as_rational(&self) -> Option<Rational> {
        match self.0.len() {
            0 => Some(Rational::zero()),
            1 => self.0.get(&0).cloned(),
            _ => None,
        }
    }

    /// Whether it is small enough to be worked with.
    fn is_moderate(&self) -> bool {
        self.0.len() <= TERMS && self.0.values().all(|c| c.bits() <= NUMBER_BITS)
    }

    /// Adds scale · other.
    pub(crate) fn add(&mut self, other: &Algebraic, scale: &Rational) {
        for (set, coefficient) in &other.0 {
            let sum = self.0.entry(*set).or_insert_with(Rational::zero);
            *sum += coefficient * scale;
            if sum.is_zero() {
                self.0.remove(set);
            }
        }
    }

    /// scale · self.
    pub(crate) fn times(&self, scale: &Rational) -> Self {
        let mut product = Algebraic::default();
        product.add(self, scale);
        product
    }

    /// self − other.
    pub(crate) fn minus(&self, other: &Algebraic) -> Self {
        let mut difference = self.clone();
        difference.add(other, &-Rational::one());
        difference
    }
}

/// p − q·r of p + q·r, r the last root in it.
fn conjugate(a: &Algebraic) -> Algebraic {
    let last = a.0.keys().max().map_or(0, |set| set.checked_ilog2().unwrap_or(0));
    let turned =
        |(set, c): (&u32, &Rational)| (*set, if set >> last & 1 == 1 { -c } else { c.clone() });
    Algebraic(a.0.iter().map(turned).collect())
}

impl Field {
    /// a·b.
    pub(crate) fn multiply(&self, a: &Algebraic, b: &Algebraic) -> Algebraic {
        self.product(a, b, &mut { u64::MAX }).expect("there is no end of work")
    }

    /// a·b; `None` where that takes more than `work` products of coefficients, which is less by them then.
    fn product(&self, a: &Algebraic, b: &Algebraic, work: &mut u64) -> Option<Algebraic> {
        let mut product = Algebraic::default();
        for (left, x) in &a.0 {
            for (right, y) in &b.0 {
                *work = work.checked_sub(1)?;
                let mut term = Algebraic(BTreeMap::from([(left ^ right, x * y)]));
                let common = left & right;
                for (place, square) in self.squares.iter().enumerate() {
                    if common >> place & 1 == 1 {
                        term = self.product(&term, square, work)?;
                    }
                }
                product.add(&term, &Rational::one());
            }
        }
        Some(product)
    }

    /// a·b while reading: of bounded size, and in bounded time.
    fn bounded_product(&mut self, a: &Algebraic, b: &Algebraic) -> Result<Algebraic, ReadError> {
        let mut left = WORK.saturating_sub(self.work);
        let product = self.product(a, b, &mut left);
        self.work = WORK - left;
        product.filter(Algebraic::is_moderate).ok_or(ReadError::Size)
    }

    /// aⁿ while reading.
    fn bounded_power(&mut self, a: &Algebraic, exponent: i32) -> Result<Algebraic, ReadError> {
        let base = match exponent {
            ..0 if a.is_zero() => return Err(ReadError::Roots),
            ..0 => self.reciprocal(a)?,
            _ => a.clone(),
        };
        let one = Algebraic::rational(Rational::one());
        (0..exponent.unsigned_abs()).try_fold(one, |power, _| self.bounded_product(&power, &base))
    }

    /// aⁿ; `None` of a negative power of zero.
    pub(crate) fn power(&self, a: &Algebraic, exponent: i32) -> Option<Algebraic> {
        let base = if exponent < 0 { self.inverse(a)? } else { a.clone() };
        let one = Algebraic::rational(Rational::one());
        Some((0..exponent.unsigned_abs()).fold(one, |power, _| self.multiply(&power, &base)))
    }

    /// 1/a while reading, of a number that is not zero.
    fn reciprocal(&mut self, a: &Algebraic) -> Result<Algebraic, ReadError> {
        if let Some(value) = a.as_rational() {
            return Ok(Algebraic::rational(value.recip()));
        }
        let conjugate = conjugate(a);
        let norm = self.bounded_product(a, &conjugate)?;
        let inverse = self.reciprocal(&norm)?;
        self.bounded_product(&conjugate, &inverse)
    }

    /// 1/a: with a = p + q·r, r the last root in it, it is (p − q·r)/(p² − q²r²). `None` of zero.
    pub(crate) fn inverse(&self, a: &Algebraic) -> Option<Algebraic> {
        if let Some(value) = a.as_rational() {
            return (!value.is_zero()).then(|| Algebraic::rational(value.recip()));
        }
        let conjugate = conjugate(a);
        let norm = self.multiply(a, &conjugate);
        Some(self.multiply(&conjugate, &self.inverse(&norm)?))
    }

    /// A number of a graph.
    ///
    /// # Errors
    /// If it is none, not made by square roots, or too large.
    pub(crate) fn read(&mut self, graph: &Graph, id: Id) -> Result<Algebraic, ReadError> {
        graph.fold(id, self)
    }

    /// A power whose exponent is whole or half.
    fn power_of(&mut self, base: &Algebraic, exponent: &Rational) -> Result<Algebraic, ReadError> {
        let whole =
            |exponent: &Rational| exponent.is_integer().then(|| exponent.to_i32()).flatten();
        let (base, exponent) = match exponent.is_integer() {
            true => (base.clone(), whole(exponent)),
            false => (self.bounded_root(base)?, whole(&(exponent * Rational::from(2)))),
        };
        match exponent {
            Some(exponent) if exponent.abs() <= 64 => self.bounded_power(&base, exponent),
            Some(_) => Err(ReadError::Size),
            None => Err(ReadError::Roots),
        }
    }

    /// The number times 2^BITS, with an error of a few units.
    pub(crate) fn fixed(&self, a: &Algebraic) -> BigInt {
        let mut sum = BigInt::zero();
        for (set, coefficient) in &a.0 {
            let mut term = (coefficient.numer() << BITS) / coefficient.denom();
            for (place, root) in self.roots.iter().enumerate() {
                if set >> place & 1 == 1 {
                    term = (term * root) >> BITS;
                }
            }
            sum += term;
        }
        sum
    }

    /// The nearest f64.
    pub fn to_f64(&self, a: &Algebraic) -> f64 {
        rounded(&self.fixed(a))
    }

    /// The number as people write it: `3/8`, else six digits.
    pub fn display(&self, a: &Algebraic) -> String {
        match a.as_rational() {
            Some(value) if value.denom().bits() + value.numer().bits() < 40 => value.to_string(),
            _ => format!("{:.6}", self.to_f64(a)),
        }
    }
}

impl Algebra for Field {
    type Value = Algebraic;
    type Error = ReadError;

    fn number(&mut self, value: &Rational) -> Algebraic {
        Algebraic::rational(value.clone())
    }

    fn leaf(&mut self, _: Id, _: &Node) -> Folded<Self> {
        Err(ReadError::Roots)
    }

    fn add(&mut self, mut sum: Algebraic, term: &Algebraic, factor: &Rational) -> Folded<Self> {
        sum.add(term, factor);
        Ok(sum)
    }

    fn multiply(
        &mut self,
        product: Algebraic,
        base: &Algebraic,
        exponent: &Rational,
    ) -> Folded<Self> {
        let power = self.power_of(base, exponent)?;
        self.bounded_product(&product, &power)
    }

    fn operation(&mut self, _: Operation<&Algebraic>) -> Folded<Self> {
        Err(ReadError::Roots)
    }

    fn bounded(&mut self, value: Algebraic) -> Folded<Self> {
        if value.is_moderate() { Ok(value) } else { Err(ReadError::Size) }
    }
}

/// The product of two numbers times 2^BITS.
pub(crate) fn product(a: &BigInt, b: &BigInt) -> BigInt {
    (a * b) >> BITS
}

/// The f64 nearest to a number times 2^BITS whose error is far below one part in 2^64. What is smaller than
/// 2^−200 is zero: numbers with the few roots and small numerators of a rule are not that small otherwise.
pub(crate) fn rounded(fixed: &BigInt) -> f64 {
    let bits = u32::try_from(fixed.bits()).unwrap_or(u32::MAX);
    if bits < BITS - 200 {
        return 0.0;
    }
    // 64 leading bits, the last of which tells whether anything follows.
    let (shift, magnitude) = (bits.saturating_sub(64), fixed.magnitude());
    let leading = magnitude >> shift;
    let follows = &leading << shift != *magnitude;
    let leading = leading.to_u64().unwrap_or(u64::MAX) | u64::from(follows);
    let value = libm::scalbn(leading as f64, shift as i32 - BITS as i32);
    if fixed.is_negative() { -value } else { value }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::diagnostic::Located;
    use crate::formula::{lower, parse};

    fn read(field: &mut Field, text: &str) -> Algebraic {
        let mut graph = Graph::new();
        let formula = parse(&Located::alone("test", text)).expect("a formula");
        let id = lower(&formula, &mut graph, &BTreeMap::new()).expect("a number");
        field.read(&graph, id).expect("made by square roots")
    }

    #[test]
    fn equal_numbers_are_equal_however_written() {
        for (a, b) in [
            ("sqrt(2/5)", "sqrt(10)/5"),
            ("1/sqrt(3)", "sqrt(3)/3"),
            ("sqrt(12)*sqrt(3)", "6"),
            ("1/(1 + sqrt(2))", "sqrt(2) - 1"),
            // The root of a square of the field, and of such a square times one of its roots.
            ("sqrt(3 + 2*sqrt(2))", "1 + sqrt(2)"),
            ("1/(sqrt(3 + 2*sqrt(2)) + 1 + sqrt(2))", "(sqrt(2) - 1)/2"),
            ("sqrt(5 + 2*sqrt(6))", "sqrt(2) + sqrt(3)"),
            ("sqrt(5 - 2*sqrt(6))", "sqrt(3) - sqrt(2)"),
            ("sqrt(3 - 2*sqrt(2))*(1 + sqrt(2))", "1"),
            ("sqrt(sqrt(2) + 1)*sqrt(sqrt(2) - 1)", "1"),
            ("sqrt(1022117)", "sqrt(1009)*sqrt(1013)"),
            ("1/(sqrt(2 + sqrt(3)) - sqrt(6)/2)", "sqrt(2)"),
            ("sqrt(3/7 - 2*sqrt(30)/35)*sqrt(35)", "sqrt(15 - 2*sqrt(30))"),
            ("1/sqrt(15 - 2*sqrt(30))", "sqrt(15 - 2*sqrt(30))*(15 + 2*sqrt(30))/105"),
        ] {
            let mut field = Field::default();
            let (a, b) = (read(&mut field, a), read(&mut field, b));
            assert!(a.minus(&b).is_zero(), "{a:?} {b:?}");
        }
    }

    #[test]
    fn approximations_are_the_nearest_numbers() {
        let mut field = Field::default();
        for (text, value) in [
            ("1/sqrt(3)", 0.577_350_269_189_625_7),
            ("-sqrt(15)/5", -0.774_596_669_241_483_4),
            ("1/3", 1.0 / 3.0),
            ("sqrt(2)*sqrt(3) - sqrt(6)", 0.0),
            ("1e-12/7", 1.428_571_428_571_428_6e-13),
            ("1e20/3", 1e20 / 3.0),
        ] {
            let number = read(&mut field, text);
            assert_eq!(field.to_f64(&number), value, "{text}");
        }
    }

    #[test]
    fn what_would_grow_beyond_all_use_is_refused() {
        let mut field = Field::default();
        let mut read = |text: &str| {
            let mut graph = Graph::new();
            let formula = parse(&Located::alone("test", text)).expect("a formula");
            let id = lower(&formula, &mut graph, &BTreeMap::new()).expect("a number");
            field.read(&graph, id)
        };
        assert_eq!(read("(((sqrt(2)+sqrt(3)+1)^64+1)^64+1)^64"), Err(ReadError::Size));
        assert_eq!(
            read("(sqrt(2)+1)*(sqrt(3)+1)*(sqrt(5)+1)*(sqrt(7)+1)*(sqrt(11)+1)*(sqrt(13)+1)"),
            Err(ReadError::Size)
        );
        assert_eq!(read("exp(1)"), Err(ReadError::Roots));
    }

    #[test]
    fn what_has_no_root_is_refused() {
        let mut field = Field::default();
        let minus = Algebraic::rational(-Rational::one());
        assert_eq!(field.bounded_root(&minus), Err(ReadError::Roots));
        assert_eq!(field.inverse(&Algebraic::default()), None);
    }
}
