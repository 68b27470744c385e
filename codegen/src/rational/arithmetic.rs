//! Sums, products, powers: in two words as long as the result fits.

use std::iter::{Product, Sum};
use std::ops::{
    Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign,
};

use num_traits::{One, Pow, Zero};

use super::{Kept, Rational, Small};

/// The largest common divisor of two numbers, not both zero: Stein's algorithm.
fn gcd(mut a: u64, mut b: u64) -> u64 {
    if a == 1 || b == 1 {
        return 1;
    }
    if a == 0 || b == 0 {
        return a | b;
    }
    let twos = (a | b).trailing_zeros();
    a >>= a.trailing_zeros();
    while b != 0 {
        b >>= b.trailing_zeros();
        (a, b) = (a.min(b), a.abs_diff(b));
    }
    a << twos
}

fn sum(x: Small, y: Small) -> Rational {
    let (a, b, c, d) = (i128::from(x.n), x.d.get(), i128::from(y.n), y.d.get());
    let common = gcd(b, d);
    // Over the least common denominator; what is common with it now divides `common` (Knuth, 4.5.1).
    let rest = b / common;
    let n = a * i128::from(d / common) + c * i128::from(rest);
    let (n, d) = match common {
        1 => (n, d),
        _ => {
            let shared = match u64::try_from(n.unsigned_abs()) {
                Ok(n) => gcd(n % common, common),
                Err(_) => gcd((n.unsigned_abs() % u128::from(common)) as u64, common),
            };
            (n / i128::from(shared), d / shared)
        }
    };
    Rational::lowest(n, u128::from(rest) * u128::from(d))
}

fn product(x: Small, y: Small) -> Rational {
    let (a, b, c, d) = (x.n, x.d.get(), y.n, y.d.get());
    let (left, right) = (gcd(a.unsigned_abs(), d), gcd(c.unsigned_abs(), b));
    let n = i128::from(a / left as i64) * i128::from(c / right as i64);
    Rational::lowest(n, u128::from(b / right) * u128::from(d / left))
}

impl Add for &Rational {
    type Output = Rational;

    fn add(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (Kept::Small(x), Kept::Small(y)) => sum(*x, *y),
            _ => Rational::kept(self.large().as_ref() + other.large().as_ref()),
        }
    }
}

impl Sub for &Rational {
    type Output = Rational;

    fn sub(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (Kept::Small(x), Kept::Small(y)) => sum(*x, Small { n: -y.n, d: y.d }),
            _ => Rational::kept(self.large().as_ref() - other.large().as_ref()),
        }
    }
}

impl Mul for &Rational {
    type Output = Rational;

    fn mul(self, other: &Rational) -> Rational {
        match (&self.0, &other.0) {
            (Kept::Small(x), Kept::Small(y)) => product(*x, *y),
            _ => Rational::kept(self.large().as_ref() * other.large().as_ref()),
        }
    }
}

/// Panics where the divisor is zero.
impl Div for &Rational {
    type Output = Rational;

    fn div(self, other: &Rational) -> Rational {
        Mul::mul(self, &other.recip())
    }
}

/// What is left of self by whole multiples of the other, with the sign of self. Panics where that is zero.
impl Rem for &Rational {
    type Output = Rational;

    fn rem(self, other: &Rational) -> Rational {
        self - &(&Rational::from((self / other).to_integer()) * other)
    }
}

impl Neg for &Rational {
    type Output = Rational;

    fn neg(self) -> Rational {
        match &self.0 {
            Kept::Small(Small { n, d }) => Rational(Kept::Small(Small { n: -n, d: *d })),
            Kept::Large(value) => Rational(Kept::Large(Box::new(-value.as_ref()))),
        }
    }
}

impl Neg for Rational {
    type Output = Rational;

    fn neg(self) -> Rational {
        -&self
    }
}

macro_rules! operator {
    ($($operator:ident $method:ident $assign:ident $in_place:ident)*) => {$(
        impl $operator for Rational {
            type Output = Rational;

            fn $method(self, other: Rational) -> Rational {
                $operator::$method(&self, &other)
            }
        }

        impl $operator<&Rational> for Rational {
            type Output = Rational;

            fn $method(self, other: &Rational) -> Rational {
                $operator::$method(&self, other)
            }
        }

        impl $operator<Rational> for &Rational {
            type Output = Rational;

            fn $method(self, other: Rational) -> Rational {
                $operator::$method(self, &other)
            }
        }

        impl $assign for Rational {
            fn $in_place(&mut self, other: Rational) {
                *self = $operator::$method(&*self, &other);
            }
        }

        impl $assign<&Rational> for Rational {
            fn $in_place(&mut self, other: &Rational) {
                *self = $operator::$method(&*self, other);
            }
        }
    )*};
}

operator! {
    Add add AddAssign add_assign
    Sub sub SubAssign sub_assign
    Mul mul MulAssign mul_assign
    Div div DivAssign div_assign
    Rem rem RemAssign rem_assign
}

impl Rational {
    /// The power. Panics of a negative power of zero.
    pub(crate) fn pow(&self, exponent: i32) -> Rational {
        if exponent < 0 {
            return self.recip().pow_of(exponent.unsigned_abs());
        }
        self.pow_of(exponent.unsigned_abs())
    }

    fn pow_of(&self, exponent: u32) -> Rational {
        // Powers of what has no common divisor have none.
        if let Kept::Small(Small { n, d }) = &self.0
            && let (Some(n), Some(d)) = (n.checked_pow(exponent), d.get().checked_pow(exponent))
        {
            return Rational::lowest(n.into(), d.into());
        }
        Rational::kept(Pow::pow(self.large().as_ref(), exponent))
    }
}

impl Sum for Rational {
    fn sum<I: Iterator<Item = Rational>>(terms: I) -> Self {
        terms.fold(Rational::zero(), |sum, term| sum + term)
    }
}

impl<'a> Sum<&'a Rational> for Rational {
    fn sum<I: Iterator<Item = &'a Rational>>(terms: I) -> Self {
        terms.fold(Rational::zero(), |sum, term| sum + term)
    }
}

impl Product for Rational {
    fn product<I: Iterator<Item = Rational>>(factors: I) -> Self {
        factors.fold(Rational::one(), |product, factor| product * factor)
    }
}
