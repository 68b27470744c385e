//! Rationals from and to floating point, and to whole numbers.

use num_rational::BigRational;
use num_traits::ToPrimitive;

use super::{Kept, Rational, Small};

impl Rational {
    /// The number that an f64 is; `None` unless finite.
    pub fn from_float(value: f64) -> Option<Self> {
        BigRational::from_float(value).map(Rational::kept)
    }
}

/// The f64 nearest to a rational; infinite beyond the range of f64.
pub fn nearest(value: &Rational) -> f64 {
    match &value.0 {
        Kept::Small(small) => small.nearest(),
        Kept::Large(value) => value.to_f64().unwrap_or(f64::NAN),
    }
}

impl Small {
    fn nearest(self) -> f64 {
        /// Whole numbers up to here are exact as f64, so that their quotient is rounded once.
        const EXACT: u64 = 1 << f64::MANTISSA_DIGITS;
        let (n, d) = (self.n.unsigned_abs(), self.d.get());
        if n <= EXACT && d <= EXACT {
            return self.n as f64 / d as f64;
        }
        // 56 bits of the quotient or one more; a last bit, far below those kept, tells of a remainder.
        let shift = (56 + n.leading_zeros()).saturating_sub(d.leading_zeros());
        let n = u128::from(n) << shift;
        let (quotient, rest) = (n / u128::from(d), n % u128::from(d));
        let quotient = quotient as u64 | u64::from(rest != 0);
        let value = libm::scalbn(quotient as f64, -(shift as i32));
        if self.n < 0 { -value } else { value }
    }
}

/// To whole numbers: without what is behind the point.
impl ToPrimitive for Rational {
    fn to_i64(&self) -> Option<i64> {
        match &self.0 {
            Kept::Small(Small { n, d }) => Some(n / d.get() as i64),
            Kept::Large(value) => value.to_i64(),
        }
    }
    fn to_u64(&self) -> Option<u64> {
        match &self.0 {
            Kept::Small(Small { n, d }) => u64::try_from(n / d.get() as i64).ok(),
            Kept::Large(value) => value.to_u64(),
        }
    }
    fn to_f64(&self) -> Option<f64> {
        Some(nearest(self))
    }
}
