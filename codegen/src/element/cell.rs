//! Reference cells and the exact integrals of monomials over them.

use num_bigint::BigInt;
use num_traits::{One, Signed, Zero};

use crate::expression::Rational;

/// A reference cell with coordinates ξ, η, ζ.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    /// −1 ≤ ξ, η, ζ ≤ 1.
    Hexahedron,
    /// ξ, η ≥ 0, ξ + η ≤ 1, −1 ≤ ζ ≤ 1.
    Wedge,
    /// ξ, η, ζ ≥ 0, ξ + η + ζ ≤ 1.
    Tetrahedron,
    /// 0 ≤ ζ ≤ 1, |ξ|, |η| ≤ 1 − ζ.
    Pyramid,
}

impl Cell {
    /// The words of a spec.
    pub(crate) const NAMES: [&'static str; 4] = ["hexahedron", "wedge", "tetrahedron", "pyramid"];

    /// The cell behind one of [`Cell::NAMES`].
    pub(crate) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "hexahedron" => Cell::Hexahedron,
            "wedge" => Cell::Wedge,
            "tetrahedron" => Cell::Tetrahedron,
            "pyramid" => Cell::Pyramid,
            _ => return None,
        })
    }

    /// Its word in a spec.
    pub fn name(self) -> &'static str {
        Self::NAMES[self as usize]
    }

    /// What belongs to it, in words.
    pub(crate) fn domain(self) -> &'static str {
        match self {
            Cell::Hexahedron => "-1 ≤ xi, eta, zeta ≤ 1",
            Cell::Wedge => "xi, eta ≥ 0, xi + eta ≤ 1, -1 ≤ zeta ≤ 1",
            Cell::Tetrahedron => "xi, eta, zeta ≥ 0, xi + eta + zeta ≤ 1",
            Cell::Pyramid => "0 ≤ zeta ≤ 1, |xi|, |eta| ≤ 1 - zeta",
        }
    }

    /// Families of named rules whose product is a rule of this cell.
    pub(crate) fn families(self) -> &'static [&'static str] {
        match self {
            Cell::Hexahedron => &["gauss", "gauss", "gauss"],
            Cell::Wedge => &["triangle", "gauss"],
            Cell::Tetrahedron => &["tetrahedron"],
            Cell::Pyramid => &["pyramid"],
        }
    }

    /// Its centroid, where the centre Jacobian J₀ is taken.
    pub(crate) fn centre(self) -> [Rational; 3] {
        let ratio = |n: i64, d: i64| Rational::new(n, d);
        match self {
            Cell::Hexahedron => [ratio(0, 1), ratio(0, 1), ratio(0, 1)],
            Cell::Wedge => [ratio(1, 3), ratio(1, 3), ratio(0, 1)],
            Cell::Tetrahedron => [ratio(1, 4), ratio(1, 4), ratio(1, 4)],
            Cell::Pyramid => [ratio(0, 1), ratio(0, 1), ratio(1, 4)],
        }
    }

    /// Exponents of monomials that take one value at each corner, the lowest first; the sums of them over a hexahedron
    /// are its trilinear functions.
    pub(crate) fn linear(self) -> &'static [[u8; 3]] {
        const ALL: [[u8; 3]; 8] = [
            [0, 0, 0],
            [1, 0, 0],
            [0, 1, 0],
            [0, 0, 1],
            [1, 1, 0],
            [0, 1, 1],
            [1, 0, 1],
            [1, 1, 1],
        ];
        const WEDGE: [[u8; 3]; 6] =
            [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 1, 1], [1, 0, 1]];
        match self {
            Cell::Hexahedron => &ALL,
            Cell::Wedge => &WEDGE,
            Cell::Tetrahedron => &ALL[..4],
            Cell::Pyramid => &ALL[..5],
        }
    }

    /// Whether a point belongs to the cell, its boundary included.
    pub(crate) fn contains(self, [xi, eta, zeta]: &[Rational; 3]) -> bool {
        let one = Rational::one();
        let within = |x: &Rational| x.abs() <= one;
        match self {
            Cell::Hexahedron => within(xi) && within(eta) && within(zeta),
            Cell::Wedge => {
                !xi.is_negative() && !eta.is_negative() && xi + eta <= one && within(zeta)
            }
            Cell::Tetrahedron => {
                ![xi, eta, zeta].iter().any(|x| x.is_negative()) && xi + eta + zeta <= one
            }
            Cell::Pyramid => {
                let width = &one - zeta;
                !zeta.is_negative() && *zeta <= one && xi.abs() <= width && eta.abs() <= width
            }
        }
    }

    /// ξⁱ ηʲ ζᵏ as in a formula, such as `xi^2*eta`; over a pyramid the third variable is `(1 - zeta)`.
    pub(crate) fn power(self, exponents: [i32; 3]) -> String {
        let third = if self == Cell::Pyramid { "(1 - zeta)" } else { "zeta" };
        let (mut above, mut below) = (Vec::new(), String::new());
        for (name, exponent) in ["xi", "eta", third].into_iter().zip(exponents) {
            match exponent {
                0 => {}
                1 => above.push(name.to_owned()),
                2.. => above.push(format!("{name}^{exponent}")),
                -1 => below = format!("/{name}"),
                _ => below = format!("/{name}^{}", -exponent),
            }
        }
        let above = if above.is_empty() { "1".to_owned() } else { above.join("*") };
        above + &below
    }

    /// ∫ ξⁱ ηʲ ζᵏ over the cell; over a pyramid ∫ ξⁱ ηʲ (1 − ζ)ᵏ, where k may be negative. `None` where it
    /// does not exist.
    pub(crate) fn integral(self, exponents: [i32; 3]) -> Option<Rational> {
        let [i, j, k] = exponents;
        if self == Cell::Pyramid {
            let (i, j) = (u32::try_from(i).ok()?, u32::try_from(j).ok()?);
            let power = i64::from(i) + i64::from(j) + i64::from(k) + 3;
            return (power > 0).then(|| line(i) * line(j) / Rational::from(power));
        }
        let [Ok(i), Ok(j), Ok(k)] = [i, j, k].map(u32::try_from) else { return None };
        Some(self.monomial([i, j, k]))
    }

    /// ∫ ξⁱ ηʲ ζᵏ over the cell.
    pub fn monomial(self, [i, j, k]: [u32; 3]) -> Rational {
        match self {
            Cell::Hexahedron => line(i) * line(j) * line(k),
            Cell::Wedge => simplex(&[i, j]) * line(k),
            Cell::Tetrahedron => simplex(&[i, j, k]),
            // ∫ ζᵏ (1 − ζ)^{i+j+2} dζ is a beta function.
            Cell::Pyramid => {
                let width = i + j + 2;
                let beta = Rational::new(factorial(k) * factorial(width), factorial(k + width + 1));
                line(i) * line(j) * beta
            }
        }
    }
}

/// ∫ xⁿ over −1 ≤ x ≤ 1.
fn line(n: u32) -> Rational {
    if n % 2 == 1 { Rational::zero() } else { Rational::new(2, n + 1) }
}

/// ∫ Π xᵢ^nᵢ over the unit simplex: Π nᵢ! / (Σ nᵢ + d)!.
fn simplex(powers: &[u32]) -> Rational {
    let numerator: BigInt = powers.iter().map(|n| factorial(*n)).product();
    Rational::new(numerator, factorial(powers.iter().sum::<u32>() + powers.len() as u32))
}

fn factorial(n: u32) -> BigInt {
    (1..=n).map(BigInt::from).product()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn volumes_and_centroids_agree_with_the_monomials() {
        for (name, volume) in Cell::NAMES.iter().zip([(8, 1), (1, 1), (1, 6), (4, 3)]) {
            let cell = Cell::named(name).expect("a known cell");
            assert_eq!(cell.name(), *name);
            let exact = Rational::new(volume.0, volume.1);
            assert_eq!(cell.monomial([0; 3]), exact, "{name}");
            for (axis, centre) in cell.centre().into_iter().enumerate() {
                let mut powers = [0; 3];
                powers[axis] = 1;
                assert_eq!(cell.monomial(powers), &exact * centre, "{name}");
            }
            assert!(cell.contains(&cell.centre()));
            let outside = [Rational::one(), Rational::one(), Rational::new(1001, 1000)];
            assert!(!cell.contains(&outside), "{name}");
        }
    }
}
