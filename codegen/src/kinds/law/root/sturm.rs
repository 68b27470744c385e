//! Sturm's chain of a polynomial, whose changes of sign count the different roots between two places.

use crate::rational::Rational;
use num_bigint::{BigInt, Sign};
use num_traits::{One, Signed, Zero};

use super::Polynomial;

impl Polynomial {
    /// The remainder of the division by `divisor`, which is not zero.
    fn remainder(&self, divisor: &Polynomial) -> Polynomial {
        let mut rest = self.coefficients.clone();
        let lead = &divisor.coefficients[divisor.degree()];
        while rest.len() > divisor.degree() && !rest.is_empty() {
            let factor = &rest[rest.len() - 1] / lead;
            let shift = rest.len() - 1 - divisor.degree();
            for (i, c) in divisor.coefficients.iter().enumerate() {
                rest[shift + i] -= &factor * c;
            }
            rest.pop();
        }
        Polynomial::new(rest)
    }

    /// p, p′, and the negated remainders of the Euclidean algorithm on them, each scaled to a leading
    /// coefficient of ±1 to keep the numbers short.
    pub(super) fn sturm_chain(&self) -> Chain {
        let mut chain = vec![self.scaled(), self.derivative().scaled()];
        while chain[chain.len() - 1].degree() > 0 {
            let last = chain.len() - 1;
            let rest = chain[last - 1].remainder(&chain[last]);
            if rest.is_zero() {
                break;
            }
            let negated = rest.coefficients.iter().map(|c| -c).collect();
            chain.push(Polynomial::new(negated).scaled());
        }
        // The last divides all others; without it multiple roots are simple, so that the chain counts them
        // wherever an interval ends.
        let last = chain[chain.len() - 1].clone();
        if last.degree() > 0 {
            chain = chain.iter().map(|p| p.quotient(&last)).collect();
        }
        Chain(chain.iter().map(Polynomial::whole).collect())
    }

    /// The coefficients times a positive number that makes them whole.
    fn whole(&self) -> Vec<BigInt> {
        let common = self.coefficients.iter().fold(Rational::one(), |common, c| {
            let left = (c * &common).denom();
            common * Rational::from(left)
        });
        self.coefficients.iter().map(|c| (c * &common).numer()).collect()
    }

    /// The quotient of a division that leaves no remainder.
    fn quotient(&self, divisor: &Polynomial) -> Polynomial {
        let mut rest = self.coefficients.clone();
        let lead = &divisor.coefficients[divisor.degree()];
        let mut quotient = Vec::new();
        while rest.len() > divisor.degree() {
            let factor = &rest[rest.len() - 1] / lead;
            let shift = rest.len() - 1 - divisor.degree();
            for (i, c) in divisor.coefficients.iter().enumerate() {
                rest[shift + i] -= &factor * c;
            }
            rest.pop();
            quotient.push(factor);
        }
        quotient.reverse();
        Polynomial::new(quotient)
    }

    fn scaled(&self) -> Polynomial {
        let Some(lead) = self.coefficients.last() else {
            return self.clone();
        };
        let lead = lead.abs();
        Polynomial::new(self.coefficients.iter().map(|c| c / &lead).collect())
    }
}

/// The whole coefficients of the polynomials of a Sturm chain.
pub(super) struct Chain(Vec<Vec<BigInt>>);

impl Chain {
    /// Changes of sign along the chain.
    pub(super) fn changes(&self, x: &Rational) -> usize {
        let (n, d) = (x.numer(), x.denom());
        let signs = self.0.iter().map(|p| sign_at(p, &n, &d)).filter(|sign| *sign != Sign::NoSign);
        let signs: Vec<Sign> = signs.collect();
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }
}

/// The sign of p(n/d), which for a positive d is that of Σ cᵢ nⁱ dᵏ⁻ⁱ, k the degree: whole numbers need no
/// common divisors.
fn sign_at(coefficients: &[BigInt], n: &BigInt, d: &BigInt) -> Sign {
    let (mut sum, mut power) = (BigInt::zero(), BigInt::one());
    for c in coefficients.iter().rev() {
        sum = sum * n + c * &power;
        power *= d;
    }
    sum.sign()
}
