//! Units and quantities: exact factors to SI, dimensions, and errors that name what was meant.

mod dimension;
mod error;
mod factor;
mod read;

use crate::rational::{Rational, nearest};

pub(crate) use dimension::BASES;
pub use dimension::{Dimension, Exponent};
pub use error::UnitError;
pub use factor::Factor;
pub(crate) use read::decimal;

use crate::diagnostic::Code;

/// A unit such as `N/mm`: an exact factor to SI, and a dimension.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unit {
    text: String,
    factor: Factor,
    /// The same exactly, if it is rational.
    rational: Option<Rational>,
    dimension: Dimension,
}

impl Unit {
    /// Reads a unit: names joined by `*` and `/`, with powers, such as `N*s/mm`, `kg/m^3`, `N/mm^1.5`,
    /// `1/s` or `1`.
    ///
    /// # Errors
    /// An unknown name (with the nearest known one), or text that is no unit.
    pub fn parse(text: &str) -> Result<Self, UnitError> {
        let (factor, dimension) = read::unit(text, 0)?;
        let rational = factor.to_rational();
        Ok(Unit { text: text.trim().to_owned(), factor, rational, dimension })
    }

    /// The unit as it was written.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// One of this unit in SI units.
    pub fn factor(&self) -> &Factor {
        &self.factor
    }

    /// One of this unit in SI units, if that is rational.
    pub fn rational(&self) -> Option<&Rational> {
        self.rational.as_ref()
    }

    /// What it measures.
    pub fn dimension(&self) -> &Dimension {
        &self.dimension
    }

    /// A value in this unit as a value in SI units, rounded once where the factor is rational.
    pub fn to_si(&self, value: f64) -> f64 {
        match (self.factor.to_rational(), Rational::from_float(value)) {
            (Some(factor), Some(value)) => nearest(&(value * factor)),
            _ => value * self.factor.to_f64(),
        }
    }
}

impl std::fmt::Display for Unit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

/// A number with a unit, such as `1404 mm`.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    text: String,
    /// The number as it was written, exactly.
    value: Rational,
    unit: Unit,
    si: f64,
}

impl Quantity {
    /// Reads a number followed by a unit; a number alone has the unit `1`.
    ///
    /// # Errors
    /// No number at the start, a number too large, or a unit that is not known.
    pub fn parse(text: &str) -> Result<Self, UnitError> {
        let (value, rest) = read::number(text)?;
        let written = text[rest..].trim();
        let (factor, dimension) = match written {
            "" => (Factor::one(), Dimension::NUMBER),
            _ => read::unit(&text[rest..], rest)?,
        };
        let rational = factor.to_rational();
        let si = match &rational {
            Some(factor) => nearest(&(&value * factor)),
            None => nearest(&value) * factor.to_f64(),
        };
        let unit_text = if written.is_empty() { "1" } else { written }.to_owned();
        let unit = Unit { text: unit_text, factor, rational, dimension };
        if !si.is_finite() {
            return Err(UnitError {
                span: 0..text.len(),
                message: "the number is too large".to_owned(),
                help: None,
                code: Code::BAD_VALUE,
            });
        }
        Ok(Quantity { text: text.trim().to_owned(), value, unit, si })
    }

    /// The value in SI units (rad for angles, rad/s for rotation).
    pub fn si(&self) -> f64 {
        self.si
    }

    /// The number as it was written, exactly.
    pub fn value(&self) -> &Rational {
        &self.value
    }

    /// The unit as it was written; `1` where there is none.
    pub fn unit(&self) -> &Unit {
        &self.unit
    }

    /// What it measures.
    pub fn dimension(&self) -> &Dimension {
        &self.unit.dimension
    }

    /// The value in SI units if this measures what is wanted.
    ///
    /// # Errors
    /// [`Code::WRONG_UNIT`], such as "expected a length, such as `1 mm`, found a force".
    pub fn expect(&self, wanted: &Dimension) -> Result<f64, UnitError> {
        let found = self.dimension();
        if found.fits(wanted) {
            return Ok(self.si);
        }
        let message = if *found == Dimension::NUMBER && !self.has_unit() {
            format!("expected {wanted}, but `{}` has no unit", self.text)
        } else {
            format!("expected {wanted}, but `{}` is {found}", self.text)
        };
        Err(UnitError {
            span: 0..self.text.len(),
            message,
            help: wanted.example().map(|e| format!("write for example `{e}`")),
            code: Code::WRONG_UNIT,
        })
    }

    fn has_unit(&self) -> bool {
        self.text.contains(char::is_whitespace) || self.text.ends_with(char::is_alphabetic)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn si(text: &str) -> f64 {
        Quantity::parse(text).unwrap().si()
    }

    #[test]
    fn quantities_are_rounded_once() {
        assert_eq!(si("1404 mm"), 1.404);
        assert_eq!(si("34.035687 mm"), 0.034035687);
        assert_eq!(si("0.1mm"), 1e-4);
        assert_eq!(si("7860 kg/m^3"), 7860.0);
        assert_eq!(si("200 GPa"), 2e11);
        assert_eq!(si("-7.4e-5 s"), -7.4e-5);
        assert_eq!(si("12 um"), 12e-6);
        assert_eq!(si("12 µm"), 12e-6);
        assert_eq!(si("12 μm"), 12e-6);
        assert_eq!(si("1e4 N/mm"), 1e7);
        assert_eq!(si("1 N*s/mm"), 1e3);
        assert_eq!(si("0.3"), 0.3);
        assert_eq!(si("3 1/s"), 3.0);
    }

    /// By definition: 25.4 mm, 0.453 592 37 kg, and standard gravity.
    #[test]
    fn inches_and_pounds_are_exact() {
        assert_eq!(si("1 in"), 0.0254);
        assert_eq!(si("5 mil"), 5.0 * 25.4e-6);
        assert_eq!(si("2 ft"), 0.6096);
        assert_eq!(si("1 lb"), 0.45359237);
        assert_eq!(si("1 lbf"), 4.4482216152605);
        // 6894.757 293 168 361 336… Pa.
        assert_eq!(si("1 psi"), 6894.757293168362);
        for (text, known) in
            [("30 ksi", 30e3 * 6894.757293168362), ("1 lb/in^3", 0.45359237 / 0.0254_f64.powi(3))]
        {
            assert!((si(text) / known - 1.0).abs() < 1e-15, "{text}: {}", si(text));
        }
        assert_eq!(si("980.665 Gal"), 9.80665);
        let help = Unit::parse("inches").unwrap_err().help.expect("a help");
        assert!(help.contains("`in`"), "{help}");
    }

    #[test]
    fn angles_carry_pi() {
        use std::f64::consts::PI;
        assert_eq!(si("180 deg"), PI);
        assert!((si("4500 rpm") - 150.0 * PI).abs() <= 1e-15 * 150.0 * PI);
        assert_eq!(Unit::parse("rpm").unwrap().factor().to_rational(), None);
    }

    #[test]
    fn fractional_powers_have_factors() {
        let hertz = Unit::parse("N/mm^1.5").unwrap();
        let expected = 1e3f64.powf(1.5);
        assert!((hertz.factor().to_f64() - expected).abs() < 1e-9 * expected);
        let squared = hertz.factor().times(hertz.factor());
        assert_eq!(squared.to_f64(), 1e9);
    }

    #[test]
    fn the_wanted_dimension_is_named() {
        let force = Quantity::parse("3 N").unwrap();
        let error = force.expect(&Dimension::LENGTH).unwrap_err();
        assert_eq!(error.message, "expected a length, but `3 N` is a force");
        assert_eq!(error.help.unwrap(), "write for example `1 mm`");
        let bare = Quantity::parse("7860").unwrap();
        let error = bare.expect(&Dimension::DENSITY).unwrap_err();
        assert_eq!(error.message, "expected a density, but `7860` has no unit");
        assert_eq!(force.expect(&Dimension::FORCE), Ok(3.0));
        let odd = Quantity::parse("3 m^2*s").unwrap();
        let error = odd.expect(&Dimension::FORCE).unwrap_err();
        assert_eq!(error.message, "expected a force, but `3 m^2*s` is a quantity in m^2*s");
    }

    #[test]
    fn electric_units_go_with_mechanical_ones() {
        for (a, b) in
            [("1 V*A", "1 W"), ("1 H", "1 Ohm*s"), ("1 Wb", "1 T*m^2"), ("1 N", "1 T*A*m")]
        {
            let [a, b] = [a, b].map(|text| Quantity::parse(text).unwrap());
            assert_eq!((a.si(), a.dimension()), (b.si(), b.dimension()));
        }
        assert_eq!(si("250 mA"), 0.25);
        assert_eq!(Quantity::parse("3 N/A").unwrap().dimension().si_unit(), "N/A");
        assert_eq!(Quantity::parse("3 mV").unwrap().dimension().si_unit(), "V");
        let current = Quantity::parse("3 A").unwrap();
        let error = current.expect(&Dimension::FORCE).unwrap_err();
        assert_eq!(error.message, "expected a force, but `3 A` is a current");
    }

    #[test]
    fn rotation_and_frequency_are_not_mixed_up() {
        let speed = Quantity::parse("4500 rpm").unwrap();
        assert!(speed.expect(&Dimension::ANGULAR_SPEED).is_ok());
        assert_eq!(
            speed.expect(&Dimension::FREQUENCY).unwrap_err().message,
            "expected a frequency, but `4500 rpm` is an angular speed"
        );
        let torque = Quantity::parse("3 N*m/rad").unwrap();
        assert!(torque.expect(&Dimension::TORQUE).is_ok());
    }

    #[test]
    fn errors_name_the_unit_and_the_nearest_known() {
        let error = Quantity::parse("12 N/milimeter").unwrap_err();
        assert_eq!(error.message, "unknown unit `milimeter`");
        assert_eq!(error.span, 5..14);
        let error = Unit::parse("Gpa").unwrap_err();
        assert_eq!(error.message, "unknown unit `Gpa`");
        assert_eq!(error.help.unwrap(), "did you mean `GPa`?");
        for (text, message) in [
            ("", "expected a number"),
            ("mm", "expected a number"),
            ("1 mm^", "expected a power after `^`, such as `^2` or `^1.5`"),
            ("1 mm^99", "a power of a unit is at most 12"),
            ("1 N/", "expected a unit"),
            ("1 N//m", "expected a unit"),
            ("1 N m", "expected `*`, `/` or the end of the unit"),
            ("1e999 mm", "the number is too large or too long"),
            ("1e308 km", "the number is too large"),
        ] {
            assert_eq!(Quantity::parse(text).unwrap_err().message, message, "{text}");
        }
    }

    #[test]
    fn a_value_is_converted() {
        assert_eq!(Unit::parse("mm").unwrap().to_si(0.1), 1e-4);
    }
}
