//! Numbers that carry a bound of their rounding error, to tell a jump from rounding.

use super::{Function, Number};

/// A value and a first-order bound of its error, when inputs and every operation are rounded to f64.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rounded {
    /// The value computed.
    pub value: f64,
    /// Bound of |value − exact value|.
    pub error: f64,
}

impl Rounded {
    /// A value that is itself rounded.
    pub fn new(value: f64) -> Self {
        Rounded { value, error: f64::EPSILON * value.abs() }
    }

    fn result(value: f64, inherited: f64) -> Self {
        Rounded { value, error: inherited + f64::EPSILON * value.abs() }
    }

    fn chain(&self, value: f64, derivative: f64) -> Self {
        Rounded::result(value, (derivative * self.error).abs())
    }
}

impl Number for Rounded {
    fn near(value: f64) -> Self {
        Rounded::new(value)
    }
    fn value(&self) -> f64 {
        self.value
    }
    fn add(&self, other: &Self) -> Self {
        Rounded::result(self.value + other.value, self.error + other.error)
    }
    fn sub(&self, other: &Self) -> Self {
        Rounded::result(self.value - other.value, self.error + other.error)
    }
    fn mul(&self, other: &Self) -> Self {
        let inherited = self.value.abs() * other.error
            + other.value.abs() * self.error
            + self.error * other.error;
        Rounded::result(self.value * other.value, inherited)
    }
    fn div(&self, other: &Self) -> Self {
        let value = self.value / other.value;
        let inherited = (self.error + value.abs() * other.error) / other.value.abs();
        Rounded::result(value, inherited)
    }
    fn power(&self, exponent: &Self) -> Self {
        let value = libm::pow(self.value, exponent.value);
        let slope = exponent.value * libm::pow(self.value, exponent.value - 1.0);
        // Without an error of the base there is nothing to pass on, even where the slope is infinite.
        let base = if self.error == 0.0 { 0.0 } else { (slope * self.error).abs() };
        // Whole exponents are exact.
        let whole = exponent.value.fract() == 0.0;
        let varied = value * libm::log(self.value.abs()) * exponent.error;
        let power = if whole || value == 0.0 { 0.0 } else { varied.abs() };
        Rounded::result(value, base + power)
    }
    fn sqrt(&self) -> Self {
        let root = libm::sqrt(self.value);
        // Near zero the first-order bound fails; √error bounds the change there.
        let inherited = (0.5 * self.error / root).min(libm::sqrt(self.error));
        Rounded::result(root, if self.error == 0.0 { 0.0 } else { inherited })
    }
    fn function(&self, function: Function) -> Self {
        let value = function.value(self.value);
        match function {
            // Exact.
            Function::Abs => Rounded { value, error: self.error },
            _ => self.chain(value, function.slope(&self.value, &value)),
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::diagnostic::Located;
    use crate::formula::{Value, evaluate, parse};

    #[test]
    fn the_bound_holds_and_is_not_far_off() {
        // Values of each formula to 20 digits at the f64 nearest to 0.3.
        for (text, exact) in [
            ("388 - 18632*x/10 + 217550*x^2", 19408.54),
            ("(1 + x/1e8) - 1", 3e-9),
            ("sqrt(x)*x^1.5/x^2", 1.0),
            ("exp(log(x))/x", 1.0),
            ("sin(x)^2 + cos(x)^2", 1.0),
        ] {
            let formula = parse(&Located::alone("f", text)).unwrap();
            let names = BTreeMap::from([("x".to_owned(), Value::Scalar(Rounded::new(0.3)))]);
            let found = evaluate(&formula, &names).unwrap().scalar().unwrap();
            assert!((found.value - exact).abs() <= found.error, "{text}: {found:?}");
            assert!(found.error <= 1e-14 * exact.max(1.0), "{text}: {found:?}");
        }
    }
}
