//! Exact rational numbers: two machine words where they fit, which nearly all numbers of a spec do, else
//! two numbers of any length.

mod arithmetic;
mod float;
#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::cmp::Ordering;
use std::fmt;
use std::hash::{Hash, Hasher};
use std::num::NonZeroU64;

pub use float::nearest;
use num_bigint::BigInt;
use num_rational::BigRational;

use num_traits::{Num, One, Signed, ToPrimitive, Zero};

/// Largest numerator and denominator that are kept in a word: negation, absolute value and reciprocal of a
/// small number are small.
const LARGEST: u64 = i64::MAX as u64;

/// An exact rational number in lowest terms. A number that fits in two words is always kept in them, so
/// that equal numbers are kept alike.
#[derive(Clone)]
pub struct Rational(Kept);

#[derive(Clone)]
enum Kept {
    Small(Small),
    Large(Box<BigRational>),
}

/// n/d in lowest terms; |n| and d are at most [`LARGEST`].
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
struct Small {
    n: i64,
    d: NonZeroU64,
}

impl Rational {
    /// n/d.
    ///
    /// # Panics
    /// If d is zero.
    pub fn new(n: impl Into<Rational>, d: impl Into<Rational>) -> Self {
        n.into() / d.into()
    }

    /// ½.
    pub(crate) fn half() -> Self {
        Rational::lowest(1, 2)
    }

    /// 10ⁿ.
    pub(crate) fn ten(n: i32) -> Self {
        Rational::from(10).pow(n)
    }

    /// n/d, which are in lowest terms.
    fn lowest(n: i128, d: u128) -> Self {
        match (i64::try_from(n), NonZeroU64::new(d as u64)) {
            (Ok(n), Some(word)) if n != i64::MIN && d <= u128::from(LARGEST) => {
                Rational(Kept::Small(Small { n, d: word }))
            }
            _ => Rational(Kept::Large(Box::new(BigRational::new_raw(n.into(), d.into())))),
        }
    }

    /// The same number in two words if they hold it.
    fn kept(value: BigRational) -> Self {
        match (value.numer().to_i64(), value.denom().to_u64().and_then(NonZeroU64::new)) {
            (Some(n), Some(d)) if n != i64::MIN && d.get() <= LARGEST => {
                Rational(Kept::Small(Small { n, d }))
            }
            _ => Rational(Kept::Large(Box::new(value))),
        }
    }

    /// The same number as two numbers of any length.
    fn large(&self) -> Cow<'_, BigRational> {
        match &self.0 {
            Kept::Small(Small { n, d }) => {
                Cow::Owned(BigRational::new_raw((*n).into(), d.get().into()))
            }
            Kept::Large(value) => Cow::Borrowed(value),
        }
    }

    /// The numerator; it carries the sign.
    pub fn numer(&self) -> BigInt {
        match &self.0 {
            Kept::Small(small) => small.n.into(),
            Kept::Large(value) => value.numer().clone(),
        }
    }

    /// The denominator; it is positive.
    pub fn denom(&self) -> BigInt {
        match &self.0 {
            Kept::Small(small) => small.d.get().into(),
            Kept::Large(value) => value.denom().clone(),
        }
    }

    /// Bits of the numerator or of the denominator, whichever are more.
    pub(crate) fn bits(&self) -> u64 {
        match &self.0 {
            Kept::Small(Small { n, d }) => {
                (64 - (n.unsigned_abs() | d.get()).leading_zeros()).into()
            }
            Kept::Large(value) => value.numer().bits().max(value.denom().bits()),
        }
    }

    /// Whether it is a whole number.
    pub(crate) fn is_integer(&self) -> bool {
        self.is_over(1)
    }

    /// Whether the denominator is `d`.
    pub(crate) fn is_over(&self, d: u32) -> bool {
        match &self.0 {
            Kept::Small(small) => small.d.get() == u64::from(d),
            Kept::Large(value) => *value.denom() == d.into(),
        }
    }

    /// The number, if it is whole and of moderate size.
    pub fn whole(&self) -> Option<i64> {
        match &self.0 {
            Kept::Small(Small { n, d }) => (d.get() == 1).then_some(*n),
            Kept::Large(_) => None,
        }
    }

    /// The number without what is behind the point.
    pub(crate) fn to_integer(&self) -> BigInt {
        match &self.0 {
            Kept::Small(Small { n, d }) => (n / d.get() as i64).into(),
            Kept::Large(value) => value.to_integer(),
        }
    }

    /// The largest whole number that is not above it.
    pub(crate) fn floor(&self) -> Self {
        match &self.0 {
            Kept::Small(Small { n, d }) => Rational::from(n.div_euclid(d.get() as i64)),
            Kept::Large(value) => Rational::kept(value.floor()),
        }
    }

    /// 1/self.
    ///
    /// # Panics
    /// Of zero.
    pub(crate) fn recip(&self) -> Self {
        match &self.0 {
            Kept::Small(Small { n, d }) => {
                let word = NonZeroU64::new(n.unsigned_abs()).expect("zero has no reciprocal");
                Rational(Kept::Small(Small { n: n.signum() * d.get() as i64, d: word }))
            }
            Kept::Large(value) => Rational::kept(value.recip()),
        }
    }

    /// √self, if it is rational.
    pub(crate) fn root(&self) -> Option<Self> {
        if self.is_negative() {
            return None;
        }
        if let Kept::Small(Small { n, d }) = &self.0 {
            let (n, d) = (n.unsigned_abs(), d.get());
            let (p, q) = (n.isqrt(), d.isqrt());
            return (p * p == n && q * q == d).then(|| Rational::lowest(p.into(), q.into()));
        }
        let (n, d) = (self.numer(), self.denom());
        let (p, q) = (n.sqrt(), d.sqrt());
        (&p * &p == n && &q * &q == d).then(|| Rational::kept(BigRational::new_raw(p, q)))
    }
}

macro_rules! whole {
    ($($int:ty)*) => {$(
        impl From<$int> for Rational {
            fn from(n: $int) -> Self {
                Rational::lowest(n.into(), 1)
            }
        }
    )*};
}

whole!(i8 i16 i32 i64 u8 u16 u32 u64);

impl From<usize> for Rational {
    fn from(n: usize) -> Self {
        Rational::lowest(n as i128, 1)
    }
}

impl From<BigInt> for Rational {
    fn from(n: BigInt) -> Self {
        Rational::kept(n.into())
    }
}

impl PartialEq for Rational {
    fn eq(&self, other: &Self) -> bool {
        match (&self.0, &other.0) {
            (Kept::Small(a), Kept::Small(b)) => a == b,
            (Kept::Large(a), Kept::Large(b)) => a.numer() == b.numer() && a.denom() == b.denom(),
            _ => false,
        }
    }
}

impl Eq for Rational {}

impl Hash for Rational {
    fn hash<H: Hasher>(&self, state: &mut H) {
        match &self.0 {
            Kept::Small(small) => small.hash(state),
            Kept::Large(value) => (value.numer(), value.denom()).hash(state),
        }
    }
}

impl Ord for Rational {
    fn cmp(&self, other: &Self) -> Ordering {
        match (&self.0, &other.0) {
            (Kept::Small(a), Kept::Small(b)) if a.d == b.d => a.n.cmp(&b.n),
            (Kept::Small(a), Kept::Small(b)) => {
                let cross = |n: i64, d: NonZeroU64| i128::from(n) * i128::from(d.get());
                cross(a.n, b.d).cmp(&cross(b.n, a.d))
            }
            _ => (self.numer() * other.denom()).cmp(&(other.numer() * self.denom())),
        }
    }
}

impl PartialOrd for Rational {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// `3/2`, or `3`.
impl fmt::Display for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Kept::Small(Small { n, d }) if d.get() == 1 => write!(f, "{n}"),
            Kept::Small(Small { n, d }) => write!(f, "{n}/{d}"),
            Kept::Large(value) => write!(f, "{value}"),
        }
    }
}

impl fmt::Debug for Rational {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl Zero for Rational {
    fn zero() -> Self {
        Rational::lowest(0, 1)
    }
    fn is_zero(&self) -> bool {
        matches!(&self.0, Kept::Small(Small { n: 0, .. }))
    }
}

impl Default for Rational {
    fn default() -> Self {
        Rational::zero()
    }
}

impl One for Rational {
    fn one() -> Self {
        Rational::lowest(1, 1)
    }
    fn is_one(&self) -> bool {
        matches!(&self.0, Kept::Small(Small { n: 1, d: NonZeroU64::MIN }))
    }
}

impl Num for Rational {
    type FromStrRadixErr = num_rational::ParseRatioError;

    fn from_str_radix(text: &str, radix: u32) -> Result<Self, Self::FromStrRadixErr> {
        let whole = if text.contains('/') { "" } else { "/1" };
        BigRational::from_str_radix(&format!("{text}{whole}"), radix).map(Rational::kept)
    }
}

impl Signed for Rational {
    fn abs(&self) -> Self {
        if self.is_negative() { -self } else { self.clone() }
    }
    fn abs_sub(&self, other: &Self) -> Self {
        if self <= other { Rational::zero() } else { self - other }
    }
    fn signum(&self) -> Self {
        match self.cmp(&Rational::zero()) {
            Ordering::Less => -Rational::one(),
            Ordering::Equal => Rational::zero(),
            Ordering::Greater => Rational::one(),
        }
    }
    fn is_positive(&self) -> bool {
        match &self.0 {
            Kept::Small(small) => small.n > 0,
            Kept::Large(value) => value.is_positive(),
        }
    }
    fn is_negative(&self) -> bool {
        match &self.0 {
            Kept::Small(small) => small.n < 0,
            Kept::Large(value) => value.is_negative(),
        }
    }
}
