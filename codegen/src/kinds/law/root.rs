//! Roots of polynomials with exact coefficients, to any precision.

mod sturm;

use crate::rational::Rational;
use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

/// Highest degree whose roots are searched for, and most bits of a coefficient, for low degrees and for
/// others: the numbers of Sturm's chain grow with both.
const HIGHEST_DEGREE: usize = 12;
const LOW_DEGREE: usize = 4;
const MOST_BITS: [u64; 2] = [1024, 256];

/// A polynomial Σ cᵢ xⁱ; the last coefficient is not zero.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Polynomial {
    coefficients: Vec<Rational>,
}

impl Polynomial {
    fn new(mut coefficients: Vec<Rational>) -> Self {
        while coefficients.last().is_some_and(Zero::is_zero) {
            coefficients.pop();
        }
        Polynomial { coefficients }
    }

    /// x
    pub(super) fn variable() -> Self {
        Polynomial::new(vec![Rational::zero(), Rational::one()])
    }

    pub(super) fn constant(value: &Rational) -> Self {
        Polynomial::new(vec![value.clone()])
    }

    pub(super) fn minus(&self, other: &Polynomial) -> Polynomial {
        self.plus(&Polynomial::new(other.coefficients.iter().map(|c| -c).collect()))
    }

    /// A power with a whole positive exponent, unless it is beyond the limits.
    pub(super) fn power(&self, exponent: &Rational) -> Option<Polynomial> {
        let whole = exponent.is_integer() && exponent.is_positive();
        let count = exponent.to_usize().filter(|n| whole && *n <= HIGHEST_DEGREE)?;
        let one = Polynomial::constant(&Rational::one());
        (0..count).try_fold(one, |product, _| product.times(self))
    }

    pub(super) fn plus(&self, other: &Polynomial) -> Polynomial {
        let length = self.coefficients.len().max(other.coefficients.len());
        let zero = Rational::zero();
        let at = |p: &Polynomial, i: usize| p.coefficients.get(i).unwrap_or(&zero).clone();
        Polynomial::new((0..length).map(|i| at(self, i) + at(other, i)).collect())
    }

    /// The product, unless it is beyond the limits.
    pub(super) fn times(&self, other: &Polynomial) -> Option<Polynomial> {
        if self.is_zero() || other.is_zero() {
            return Some(Polynomial::new(Vec::new()));
        }
        if self.degree() + other.degree() > HIGHEST_DEGREE {
            return None;
        }
        let mut product = vec![Rational::zero(); self.degree() + other.degree() + 1];
        for (i, a) in self.coefficients.iter().enumerate() {
            for (j, b) in other.coefficients.iter().enumerate() {
                product[i + j] += a * b;
            }
        }
        let bits = |c: &Rational| c.bits();
        let most = MOST_BITS[usize::from(product.len() > LOW_DEGREE + 1)];
        product.iter().all(|c| bits(c) <= most).then(|| Polynomial::new(product))
    }

    /// Slope and root of a polynomial of degree 1.
    pub(super) fn linear(&self) -> Option<(Rational, Rational)> {
        match self.coefficients.as_slice() {
            [constant, slope] => Some((slope.clone(), -constant / slope)),
            _ => None,
        }
    }

    fn degree(&self) -> usize {
        self.coefficients.len().saturating_sub(1)
    }

    fn is_zero(&self) -> bool {
        self.coefficients.is_empty()
    }

    /// p(x)
    pub(super) fn at(&self, x: &Rational) -> Rational {
        self.coefficients.iter().rev().fold(Rational::zero(), |sum, c| sum * x + c)
    }

    pub(super) fn derivative(&self) -> Polynomial {
        let slopes = self.coefficients.iter().enumerate().skip(1);
        Polynomial::new(slopes.map(|(i, c)| c * Rational::from(i)).collect())
    }

    /// Σ |cᵢ xⁱ|
    pub(super) fn size_at(&self, x: &Rational) -> Rational {
        let x = x.abs();
        self.coefficients.iter().rev().fold(Rational::zero(), |sum, c| sum * &x + c.abs())
    }

    /// p(x), or zero where it is no more than a fraction of the size of its terms.
    pub(super) fn rounded_at(&self, x: &Rational, fraction: &Rational) -> Rational {
        let value = self.at(x);
        if value.abs() <= self.size_at(x) * fraction { Rational::zero() } else { value }
    }

    /// The different roots in the open interval, ascending, to 2⁻¹²⁰ of its width (exactly, for degree 1).
    pub(super) fn roots_between(&self, low: &Rational, high: &Rational) -> Vec<Rational> {
        let inside = |root: &Rational| low < root && root < high;
        match self.degree() {
            0 => return Vec::new(),
            1 => {
                let root = -&self.coefficients[0] / &self.coefficients[1];
                return Some(root).filter(inside).into_iter().collect();
            }
            _ if self.keeps_its_sign(low, high) => return Vec::new(),
            _ => {}
        }
        let chain = self.sturm_chain();
        let mut roots = Vec::new();
        let finest = (high - low) / Rational::from(BigInt::one() << 120);
        let two = Rational::from(2);
        // Intervals (start, end] that hold roots, the leftmost on top.
        let mut open = vec![(low.clone(), high.clone())];
        while let Some((start, end)) = open.pop() {
            let count = chain.changes(&start) - chain.changes(&end);
            if count == 0 {
                continue;
            }
            let middle = (&start + &end) / &two;
            if &end - &start <= finest {
                roots.push(if self.at(&end).is_zero() { end } else { middle });
                continue;
            }
            open.push((middle.clone(), end));
            open.push((start, middle));
        }
        roots.retain(inside);
        roots
    }

    /// Whether all coefficients in Bernstein's basis over the interval have one sign, so that the polynomial
    /// has no root inside.
    fn keeps_its_sign(&self, low: &Rational, high: &Rational) -> bool {
        let n = self.degree();
        // Coefficients in t, x = low + (high − low)·t.
        let mut shifted = self.coefficients.clone();
        for i in 0..n {
            for k in (i..n).rev() {
                let carried = &shifted[k + 1] * low;
                shifted[k] += carried;
            }
        }
        let mut width = Rational::one();
        for c in &mut shifted {
            *c *= &width;
            width *= high - low;
        }
        // bᵢ = Σⱼ C(i, j)/C(n, j) aⱼ
        let signs = (0..=n).map(|i| {
            let mut ratio = Rational::one();
            let mut sum = Rational::zero();
            for (j, a) in shifted.iter().enumerate().take(i + 1) {
                sum += &ratio * a;
                ratio *= Rational::new(i - j, (n - j).max(1));
            }
            sum
        });
        let signs: Vec<Rational> = signs.collect();
        signs.iter().all(|b| !b.is_negative()) || signs.iter().all(|b| !b.is_positive())
    }

    /// The root nearest to `place` to a relative accuracy of 2⁻¹²⁰ (exactly, for degree 1), and of two
    /// equally near ones the lower; `None` if there is no real root.
    pub(super) fn root_nearest(&self, place: &Rational) -> Option<Rational> {
        match self.degree() {
            0 => None,
            1 => Some(-&self.coefficients[0] / &self.coefficients[1]),
            _ => self.isolated_root(place),
        }
    }

    fn isolated_root(&self, place: &Rational) -> Option<Rational> {
        if self.at(place).is_zero() {
            return Some(place.clone());
        }
        let chain = self.sturm_chain();
        // Number of different roots in (low, high].
        let count = |low: &Rational, high: &Rational| chain.changes(low) - chain.changes(high);
        let lead = self.coefficients[self.degree()].abs();
        let others = self.coefficients.iter().map(|c| c.abs() / &lead);
        let bound = others.fold(Rational::one(), |sum, c| sum + c);
        // Distances from the place: no root nearer than `near`, one within `far`.
        let (mut near, mut far) = (Rational::zero(), bound + place.abs());
        let within = |d: &Rational| count(&(place - d), &(place + d)) > 0;
        if !within(&far) {
            return None;
        }
        let two = Rational::from(2);
        let smallest = |d: &Rational| {
            let scale = place.abs().max(d.clone());
            scale / Rational::from(BigInt::one() << 124)
        };
        while &far - &near > smallest(&far) {
            let middle = (&near + &far) / &two;
            if within(&middle) { far = middle } else { near = middle }
        }
        let middle = (near + &far) / &two;
        let below = count(&(place - &far), place) > 0;
        Some(if below { place - middle } else { place + middle })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::nearest;

    #[test]
    fn all_roots_of_an_interval_are_found() {
        let between = |p: &Polynomial, low, high| -> Vec<f64> {
            p.roots_between(&exact(low, 1), &exact(high, 1)).iter().map(nearest).collect()
        };
        let cubic = polynomial(&[-6, 11, -6, 1]);
        assert_eq!(between(&cubic, 0, 5), [1.0, 2.0, 3.0]);
        assert_eq!(between(&cubic, 1, 3), [2.0]);
        assert!(between(&cubic, 4, 9).is_empty());
        assert_eq!(
            between(&polynomial(&[4, 0, -4, 0, 1]), -2, 2),
            [-1.0, 1.0].map(|s| s * 2f64.sqrt())
        );
        assert!(between(&polynomial(&[1, 0, 1]), -9, 9).is_empty());
        assert_eq!(between(&polynomial(&[-7, 2]), -9, 9), [3.5]);
    }

    fn polynomial(coefficients: &[i64]) -> Polynomial {
        Polynomial::new(coefficients.iter().map(|c| Rational::from(*c)).collect())
    }

    fn exact(n: i64, d: i64) -> Rational {
        Rational::new(n, d)
    }

    #[test]
    fn the_papers_polynomials_have_their_roots() {
        let c0 = exact(35687, 1_000_000);
        let linear = polynomial(&[233, -6517]).root_nearest(&c0).unwrap();
        assert_eq!(linear, exact(233, 6517));
        let root = polynomial(&[388, -18632, 217_550]).root_nearest(&c0).unwrap();
        // (18632 − √(18632² − 4·388·217550))/(2·217550) in 29 digits.
        let digits = "35733282612761347904256322711";
        let expected = Rational::new(digits.parse::<BigInt>().unwrap(), BigInt::from(10).pow(30));
        assert_eq!(nearest(&root), nearest(&expected));
        let other = polynomial(&[388, -18632, 217_550]).root_nearest(&exact(1, 20)).unwrap();
        assert!((nearest(&other) - 0.04991).abs() < 1e-5);
    }

    #[test]
    fn roots_are_found_wherever_they_lie() {
        let cubic = polynomial(&[-6, 11, -6, 1]);
        for (place, root) in [(exact(9, 10), 1.0), (exact(21, 10), 2.0), (exact(1000, 1), 3.0)] {
            assert_eq!(nearest(&cubic.root_nearest(&place).unwrap()), root);
        }
        assert_eq!(cubic.root_nearest(&exact(2, 1)), Some(exact(2, 1)));
        let double = polynomial(&[1, -2, 1]).root_nearest(&exact(3, 1)).unwrap();
        assert_eq!(nearest(&double), 1.0);
        assert_eq!(polynomial(&[1, 0, 1]).root_nearest(&exact(3, 1)), None);
        assert_eq!(polynomial(&[5]).root_nearest(&exact(3, 1)), None);
        let root_two = polynomial(&[-2, 0, 1]).root_nearest(&exact(1, 1)).unwrap();
        assert_eq!(nearest(&root_two), std::f64::consts::SQRT_2);
    }
}
