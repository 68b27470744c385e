//! One system of units for all formulas of a file, so that a product of quantities in any units is right.

use crate::rational::Rational;
use num_traits::{CheckedMul, CheckedSub, One, Zero};

use crate::units::{BASES, Dimension, Exponent, Factor, Unit};

/// Scales of the base quantities (m, kg, s, K, A) in SI, such that every unit given to [`System::of`] is a
/// product of powers of them: with h in mm and Q in N, lengths are in mm, and masses in N·s²/mm.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct System {
    scales: [Factor; BASES],
}

/// A unit that does not go with others, by its place among them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Misfit {
    /// It contradicts those before it.
    Contradicts(usize),
    /// Its powers are of too many different fractions.
    Unwieldy(usize),
}

/// Bases in the order in which they are solved for: what is left open keeps its SI unit, time first.
const ORDER: [usize; BASES] = [0, 1, 3, 4, 2];

struct Row {
    exponents: [Exponent; BASES],
    factor: Factor,
}

impl System {
    /// The system in which all `units` have scale 1.
    ///
    /// # Errors
    /// The first unit that does not go with those before it.
    pub(super) fn of<'u>(units: impl IntoIterator<Item = &'u Unit>) -> Result<Self, Misfit> {
        let mut solved: Vec<(usize, Row)> = Vec::new();
        for (place, unit) in units.into_iter().enumerate() {
            let mut row =
                Row { exponents: unit.dimension().bases(), factor: unit.factor().clone() };
            for (base, known) in &solved {
                row.eliminate(*base, known).ok_or(Misfit::Unwieldy(place))?;
            }
            let Some(base) = ORDER.into_iter().find(|base| !row.exponents[*base].is_zero()) else {
                if row.factor.is_one() {
                    continue;
                }
                return Err(Misfit::Contradicts(place));
            };
            row.scale_to_one(base).ok_or(Misfit::Unwieldy(place))?;
            for (_, known) in &mut solved {
                known.eliminate(base, &row).ok_or(Misfit::Unwieldy(place))?;
            }
            solved.push((base, row));
        }
        // Bases that no unit fixes are 1, so that each row gives its own base.
        let mut scales: [Factor; BASES] = Default::default();
        for (base, row) in solved {
            scales[base] = row.factor;
        }
        Ok(System { scales })
    }

    /// A unit in SI over the same in this system.
    fn ratio(&self, unit: &Unit) -> Option<Factor> {
        let mut ratio = unit.factor().clone();
        for (scale, e) in self.scales.iter().zip(unit.dimension().bases()) {
            ratio = ratio.checked_times(&scale.checked_power(-e)?)?;
        }
        Some(ratio)
    }

    /// The same, rounded, whatever its exponents are.
    fn ratio_f64(&self, unit: &Unit) -> f64 {
        let scales = self.scales.iter().zip(unit.dimension().bases());
        let power = |e: Exponent| f64::from(*e.numer()) / f64::from(*e.denom());
        let scale = scales.map(|(scale, e)| libm::pow(scale.to_f64(), power(e)));
        unit.factor().to_f64() / scale.product::<f64>()
    }

    /// One of what this system measures a dimension in, in SI: exact if that is rational, else the nearest f64.
    pub(super) fn in_si(&self, dimension: &Dimension) -> Rational {
        let powers = || self.scales.iter().zip(dimension.bases());
        let exact = powers().try_fold(Factor::one(), |product, (scale, e)| {
            product.checked_times(&scale.checked_power(e)?)
        });
        let power = |e: Exponent| f64::from(*e.numer()) / f64::from(*e.denom());
        let rounded = || match &exact {
            Some(scale) => scale.to_f64(),
            None => powers().map(|(scale, e)| libm::pow(scale.to_f64(), power(e))).product(),
        };
        let inexact = || Rational::from_float(rounded()).unwrap_or_else(Rational::one);
        exact.as_ref().and_then(Factor::to_rational).unwrap_or_else(inexact)
    }

    /// A value in `unit` as a value in this system: exact if the ratio of the units is rational, else the
    /// nearest f64.
    pub(super) fn convert(&self, value: &Rational, unit: &Unit) -> Rational {
        let factor = self.ratio(unit);
        let ratio = factor.as_ref().and_then(Factor::to_rational);
        let rounded = || factor.as_ref().map_or_else(|| self.ratio_f64(unit), Factor::to_f64);
        let ratio = ratio.or_else(|| Rational::from_float(rounded()));
        value * ratio.unwrap_or_else(Rational::one)
    }
}

impl Row {
    /// Takes the power of the row whose exponent of `base` is 1; `None` where numbers grow too large.
    fn scale_to_one(&mut self, base: usize) -> Option<()> {
        let inverse = self.exponents[base].recip();
        for e in &mut self.exponents {
            *e = e.checked_mul(&inverse)?;
        }
        self.factor = self.factor.checked_power(inverse)?;
        Some(())
    }

    /// Takes `known`, whose exponent of `base` is 1, off this row until that exponent is 0; `None` where numbers
    /// grow too large.
    fn eliminate(&mut self, base: usize, known: &Row) -> Option<()> {
        let times = self.exponents[base];
        for (e, other) in self.exponents.iter_mut().zip(&known.exponents) {
            *e = e.checked_sub(&other.checked_mul(&times)?)?;
        }
        self.factor = self.factor.checked_times(&known.factor.checked_power(-times)?)?;
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn system(units: &[&str]) -> Result<System, Misfit> {
        let units: Vec<Unit> = units.iter().map(|unit| Unit::parse(unit).unwrap()).collect();
        System::of(&units)
    }

    fn converted(system: &System, value: i64, unit: &str) -> Rational {
        system.convert(&Rational::from(value), &Unit::parse(unit).unwrap())
    }

    #[test]
    fn parameters_are_converted_to_the_units_of_inputs_and_outputs() {
        let mm_n = system(&["mm", "N"]).unwrap();
        let exact = |n: i64, d: i64| Rational::new(n, d);
        assert_eq!(converted(&mm_n, 35, "um"), exact(35, 1000));
        assert_eq!(converted(&mm_n, 5, "N/m"), exact(5, 1000));
        assert_eq!(converted(&mm_n, 200, "GPa"), exact(200_000, 1));
        assert_eq!(converted(&mm_n, 7, "N*s/m"), exact(7, 1000));
        assert_eq!(converted(&mm_n, 7, "N/mm^1.5"), exact(7, 1));
        assert_eq!(converted(&mm_n, 3, "rad"), exact(3, 1));
        assert_eq!(converted(&system(&["m", "m/s", "N"]).unwrap(), 1, "N/mm"), exact(1000, 1));
    }

    #[test]
    fn contradictions_are_found() {
        assert_eq!(system(&["mm", "N", "m"]), Err(Misfit::Contradicts(2)));
        assert_eq!(system(&["mm", "mm/s", "N", "N/m"]), Err(Misfit::Contradicts(3)));
        assert_eq!(system(&["m", "N", "A", "mA"]), Err(Misfit::Contradicts(3)));
        assert!(system(&["mm", "m/s", "N"]).is_ok());
        assert_eq!(system(&["mm", "m/s", "s"]), Err(Misfit::Contradicts(2)));
    }
}
