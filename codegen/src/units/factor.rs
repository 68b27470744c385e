//! Exact factors between units: products of rational powers of primes and π.

use std::collections::BTreeMap;

use crate::rational::{Rational, nearest};
use num_traits::{CheckedAdd, CheckedMul, One, Zero};

use super::Exponent;

/// Highest power of a prime that is written out: far past the range of f64.
const HIGHEST_POWER: u32 = 8192;

/// What units that people use have.
const IN_USE: &str = "exponents of moderate size";

/// A positive number Π pᵢ^eᵢ · π^e with rational exponents: closed under products and rational powers,
/// and equal factors are equal values.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Factor {
    primes: BTreeMap<u32, Exponent>,
    pi: Exponent,
}

impl Factor {
    /// 1.
    pub(crate) fn one() -> Self {
        Self::default()
    }

    /// π.
    pub(crate) fn pi() -> Self {
        Factor { primes: BTreeMap::new(), pi: Exponent::one() }
    }

    /// The factor n/d.
    ///
    /// # Panics
    /// If either is zero.
    pub(crate) fn ratio(n: u32, d: u32) -> Self {
        Factor::integer(n).over(&Factor::integer(d))
    }

    /// 10ⁿ.
    pub(crate) fn ten(n: i32) -> Self {
        Factor::integer(10).power(Exponent::from_integer(n))
    }

    fn integer(mut n: u32) -> Self {
        assert!(n > 0, "a factor between units is positive");
        let mut primes = BTreeMap::new();
        let mut p = 2;
        while n > 1 {
            while n.is_multiple_of(p) {
                *primes.entry(p).or_insert_with(Exponent::zero) += Exponent::one();
                n /= p;
            }
            p += 1;
        }
        Factor { primes, pi: Exponent::zero() }
    }

    /// The product.
    pub(crate) fn times(&self, other: &Factor) -> Factor {
        self.checked_times(other).expect(IN_USE)
    }

    /// The product; `None` if its exponents are beyond all use.
    pub fn checked_times(&self, other: &Factor) -> Option<Factor> {
        let mut product = self.clone();
        for (p, e) in &other.primes {
            let sum = product.primes.entry(*p).or_insert_with(Exponent::zero);
            *sum = sum.checked_add(e)?;
        }
        product.primes.retain(|_, e| !e.is_zero());
        product.pi = product.pi.checked_add(&other.pi)?;
        Some(product)
    }

    /// The power; `None` if its exponents are beyond all use.
    pub fn checked_power(&self, exponent: Exponent) -> Option<Factor> {
        if exponent.is_zero() {
            return Some(Factor::one());
        }
        let power = |e: &Exponent| e.checked_mul(&exponent);
        let primes = self.primes.iter().map(|(p, e)| Some((*p, power(e)?)));
        Some(Factor { primes: primes.collect::<Option<_>>()?, pi: power(&self.pi)? })
    }

    /// The quotient.
    pub(crate) fn over(&self, other: &Factor) -> Factor {
        self.times(&other.power(-Exponent::one()))
    }

    /// The power.
    pub(crate) fn power(&self, exponent: Exponent) -> Factor {
        self.checked_power(exponent).expect(IN_USE)
    }

    /// Whether this is 1.
    pub(crate) fn is_one(&self) -> bool {
        self.primes.is_empty() && self.pi.is_zero()
    }

    /// The exact value, if it is rational.
    pub fn to_rational(&self) -> Option<Rational> {
        let integers = self.primes.values().all(|e| e.is_integer());
        (integers && self.pi.is_zero() && self.is_moderate()).then(|| self.whole_part())
    }

    /// The value: the integer powers exactly, then rounded, then what is left.
    pub fn to_f64(&self) -> f64 {
        if !self.is_moderate() {
            let powers = self.primes.iter().map(|(p, e)| libm::pow(f64::from(*p), as_f64(*e)));
            return powers.product::<f64>() * libm::pow(std::f64::consts::PI, as_f64(self.pi));
        }
        let mut value = nearest(&self.whole_part());
        for (p, e) in &self.primes {
            let rest = e.fract();
            if !rest.is_zero() {
                value *= libm::pow(f64::from(*p), as_f64(rest));
            }
        }
        if !self.pi.is_zero() {
            value *= libm::pow(std::f64::consts::PI, as_f64(self.pi));
        }
        value
    }

    /// Whether the powers can be written out.
    fn is_moderate(&self) -> bool {
        self.primes.values().all(|e| e.to_integer().unsigned_abs() <= HIGHEST_POWER)
    }

    fn whole_part(&self) -> Rational {
        let mut value = Rational::one();
        for (p, e) in &self.primes {
            let power = Rational::from(*p).pow(e.to_integer());
            value *= power;
        }
        value
    }
}

fn as_f64(exponent: Exponent) -> f64 {
    f64::from(*exponent.numer()) / f64::from(*exponent.denom())
}
