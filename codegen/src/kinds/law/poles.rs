//! Poles, found by the signs of everything that a formula divides by.

use crate::operation::{Function, Number};

/// A value, the signs of its own factors, and those of all factors of divisors met on the way to it: two points
/// between which the latter change have a pole between them.
///
/// Of (h − c)² the factor h − c counts, which changes its sign where the square does not: so that poles of
/// even order are found, too.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WithSigns {
    pub(super) value: f64,
    /// Of the divisors.
    pub(super) signs: Signs,
    /// Of the value.
    factors: Signs,
}

/// A digest of signs, each at a place of its own: the places are the same at all points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Signs {
    /// Σ Kⁱ over the places i of negative signs, modulo 2⁶⁴.
    digest: u64,
    /// K^(number of places).
    end: u64,
}

/// K: odd, so that its powers are all different for long.
const BASE: u64 = 0x9e37_79b9_7f4a_7c15;

impl Signs {
    const NONE: Signs = Signs { digest: 0, end: 1 };

    fn of(value: f64) -> Self {
        Signs { digest: u64::from(value < 0.0), end: BASE }
    }

    fn then(self, other: Signs) -> Self {
        let digest = self.digest.wrapping_add(other.digest.wrapping_mul(self.end));
        Signs { digest, end: self.end.wrapping_mul(other.end) }
    }

    /// All positive, unless `they_count`.
    fn if_so(self, they_count: bool) -> Self {
        if they_count { self } else { Signs { digest: 0, ..self } }
    }
}

impl WithSigns {
    pub(super) fn new(value: f64) -> Self {
        WithSigns { value, signs: Signs::NONE, factors: Signs::of(value) }
    }

    /// A value of its own sign, from others.
    fn from(value: f64, signs: Signs) -> Self {
        WithSigns { value, signs, factors: Signs::of(value) }
    }
}

impl Number for WithSigns {
    fn near(value: f64) -> Self {
        WithSigns::new(value)
    }
    fn value(&self) -> f64 {
        self.value
    }
    fn add(&self, other: &Self) -> Self {
        WithSigns::from(self.value + other.value, self.signs.then(other.signs))
    }
    fn sub(&self, other: &Self) -> Self {
        WithSigns::from(self.value - other.value, self.signs.then(other.signs))
    }
    fn mul(&self, other: &Self) -> Self {
        let (signs, factors) = (self.signs.then(other.signs), self.factors.then(other.factors));
        WithSigns { value: self.value * other.value, signs, factors }
    }
    fn div(&self, other: &Self) -> Self {
        let signs = self.signs.then(other.signs).then(other.factors);
        WithSigns {
            value: self.value / other.value,
            signs,
            factors: self.factors.then(other.factors),
        }
    }
    fn power(&self, exponent: &Self) -> Self {
        // 2^(h/l) divides by 2 below zero, which changes no sign.
        let below = self.factors.if_so(exponent.value < 0.0);
        let signs = self.signs.then(exponent.signs).then(below);
        let factors = self.factors.if_so(exponent.value != 0.0);
        WithSigns { value: Number::power(&self.value, &exponent.value), signs, factors }
    }
    fn sqrt(&self) -> Self {
        WithSigns { value: Number::sqrt(&self.value), ..*self }
    }
    fn function(&self, function: Function) -> Self {
        let value = function.value(self.value);
        match (function, function.divisor(self.value)) {
            // It is zero where its argument is.
            (Function::Abs, _) => WithSigns { value, ..*self },
            (_, Some(divisor)) => WithSigns::from(value, self.signs.then(Signs::of(divisor))),
            (_, None) => WithSigns::from(value, self.signs),
        }
    }
    /// With the divisors of both, whichever is chosen: a choice between values with and without a divisor is
    /// no pole.
    fn chosen(first: bool, a: Self, b: Self) -> Self {
        WithSigns::from(if first { a.value } else { b.value }, a.signs.then(b.signs))
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::diagnostic::Located;
    use crate::formula::{Value, evaluate, parse};

    /// Whether a pole is found between two values of h.
    fn crosses_pole(text: &str, [low, high]: [f64; 2]) -> bool {
        let formula = parse(&Located::alone("f", text)).expect("a formula");
        let signs = |h: f64| {
            let names = BTreeMap::from([("h".to_owned(), Value::Scalar(WithSigns::new(h)))]);
            evaluate(&formula, &names).expect("a value").scalar().expect("a number").signs
        };
        signs(low) != signs(high)
    }

    #[test]
    fn poles_of_any_order_are_found() {
        for text in [
            "1/(h - 1)",
            "1/(h - 1)^2",
            "1/((h - 1)*(h - 1))",
            "((h - 1)^2)^(-3/2)",
            "(h - 1)^(-2)",
            "1/abs(h - 1)",
            "1/sqrt((h - 1)^2)",
            "3 - h/(2*(h - 1)^4) + h^2",
            "exp(-1/(1 - h)^2)",
            "max(h, 1/(h - 1)^2)",
            "tan(h*pi/2)",
        ] {
            assert!(crosses_pole(text, [0.5, 1.5]), "{text}");
        }
    }

    #[test]
    fn what_only_passes_through_zero_is_no_pole() {
        for text in [
            "2^(h - 1)",
            "(1 + h^2)^(1 - h)",
            "exp(h - 1)/(1 + (h - 1)^2)",
            "(h - 1)^2",
            "(h - 1)^2/(h + 1)",
            "1/(h - 1)^0",
            "1/exp(1 - h)",
            "max(h - 1, 1/(h + 1))",
            "tan(h - 1)",
        ] {
            assert!(!crosses_pole(text, [0.5, 1.5]), "{text}");
        }
    }
}
