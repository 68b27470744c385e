//! Square roots in a field, which grows only by those that it does not have.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use super::{Algebraic, BITS, Field, ROOTS, ReadError, conjugate};
use crate::expression::Rational;

/// Largest prime that is taken out of a square root; a larger square is kept as it is.
const PRIMES: u32 = 1000;

impl Field {
    /// √a, in a field that grows where it must; an error of a negative number, or past `ROOTS`.
    pub(super) fn bounded_root(&mut self, a: &Algebraic) -> Result<Algebraic, ReadError> {
        if a.is_zero() {
            return Ok(Algebraic::default());
        }
        if self.fixed(a).is_negative() {
            return Err(ReadError::Roots);
        }
        // a = (n/d)·b, where b has whole coefficients without a common divisor.
        let divisor = |f: fn(&BigInt, &BigInt) -> BigInt, part: fn(&Rational) -> BigInt| {
            a.0.values().map(part).fold(None, |common: Option<BigInt>, next| {
                Some(common.map_or(next.abs(), |common| f(&common, &next)))
            })
        };
        let numerator = divisor(gcd, Rational::numer).ok_or(ReadError::Roots)?;
        let denominator =
            divisor(|a, b| a / gcd(a, b) * b, Rational::denom).ok_or(ReadError::Roots)?;
        let content = Rational::new(numerator.clone(), denominator.clone());
        let mut root = self.root_of_whole(numerator * &denominator)?;
        root = root.times(&Rational::new(BigInt::one(), denominator));
        if a.as_rational().is_none() {
            let adjoined = self.adjoin(a.times(&content.recip()))?;
            root = self.bounded_product(&root, &adjoined)?;
        }
        Ok(root)
    }

    /// √n by the roots of its primes, which are independent of each other.
    fn root_of_whole(&mut self, mut n: BigInt) -> Result<Algebraic, ReadError> {
        let mut root = Algebraic::rational(Rational::one());
        let whole = |n: BigInt| Algebraic::rational(Rational::from(n));
        let mut prime = 2;
        while prime < PRIMES && BigInt::from(prime * prime) <= n {
            let p = BigInt::from(prime);
            while (&n % (&p * &p)).is_zero() {
                n /= &p * &p;
                root = root.times(&Rational::from(p.clone()));
            }
            if (&n % &p).is_zero() {
                n /= &p;
                let factor = self.adjoin(whole(p))?;
                root = self.bounded_product(&root, &factor)?;
            }
            prime += 1;
        }
        let exact = n.sqrt();
        let rest = if &exact * &exact == n { whole(exact) } else { self.adjoin(whole(n))? };
        self.bounded_product(&root, &rest)
    }

    /// The root of this square, which is in the field already or is added to it.
    fn adjoin(&mut self, square: Algebraic) -> Result<Algebraic, ReadError> {
        if let Some(root) = self.root_within(&square, self.squares.len())? {
            let negative = self.fixed(&root).is_negative();
            return Ok(root.times(&Rational::from(if negative { -1 } else { 1 })));
        }
        if self.squares.len() == ROOTS {
            return Err(ReadError::Roots);
        }
        if !square.is_moderate() {
            return Err(ReadError::Size);
        }
        self.roots.push((self.fixed(&square) << BITS).sqrt());
        self.squares.push(square);
        Ok(root_at(self.squares.len() - 1))
    }

    /// A root of a that is in the field of the first `count` roots, if there is one: without it numbers of a field that
    /// has two roots of one square would not be unique, and some that are not zero would have no reciprocal.
    ///
    /// With r the last root, a = p + q·r is the square of s + t·r where p = s² + t²r² and q = 2st: of q = 0 either p or
    /// p/r² is a square below, else p² − q²r² is one, n², and s² one of (p ± n)/2.
    fn root_within(&mut self, a: &Algebraic, count: usize) -> Result<Option<Algebraic>, ReadError> {
        if a.is_zero() {
            return Ok(Some(Algebraic::default()));
        }
        let Some(last) = count.checked_sub(1) else {
            return Ok(a.as_rational().and_then(|a| a.root()).map(Algebraic::rational));
        };
        let (below, above): (BTreeMap<_, _>, BTreeMap<_, _>) =
            a.0.iter().map(|(set, c)| (*set, c.clone())).partition(|(set, _)| set >> last & 1 == 0);
        let above = above.into_iter().map(|(set, c)| (set ^ 1 << last, c)).collect();
        let (p, q) = (Algebraic(below), Algebraic(above));
        let (r, square) = (root_at(last), self.squares[last].clone());
        if q.is_zero() {
            if let Some(root) = self.root_within(&p, last)? {
                return Ok(Some(root));
            }
            let inverse = self.reciprocal(&square)?;
            let ratio = self.bounded_product(&p, &inverse)?;
            let root = self.root_within(&ratio, last)?;
            return root.map(|root| self.bounded_product(&root, &r)).transpose();
        }
        let norm = self.bounded_product(a, &conjugate(a))?;
        let Some(n) = self.root_within(&norm, last)? else { return Ok(None) };
        for sign in [1, -1] {
            let mut half = p.times(&Rational::half());
            half.add(&n, &Rational::new(sign, 2));
            if half.is_zero() {
                continue;
            }
            let Some(s) = self.root_within(&half, last)? else { continue };
            let inverse = self.reciprocal(&s.times(&Rational::from(2)))?;
            let t = self.bounded_product(&q, &inverse)?;
            let mut root = self.bounded_product(&t, &r)?;
            root.add(&s, &Rational::one());
            return Ok(Some(root));
        }
        Ok(None)
    }
}

/// The root at a place of the tower.
fn root_at(place: usize) -> Algebraic {
    Algebraic(BTreeMap::from([(1 << place, Rational::one())]))
}

fn gcd(a: &BigInt, b: &BigInt) -> BigInt {
    let (mut a, mut b) = (a.abs(), b.abs());
    while !b.is_zero() {
        (a, b) = (b.clone(), a % b);
    }
    a
}
