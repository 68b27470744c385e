//! Values and slopes of the functions of one scalar, from the pinned implementation.

use super::node::Function;

impl Function {
    /// The function's value.
    pub fn value(self, x: f64) -> f64 {
        match self {
            Function::Exp => libm::exp(x),
            Function::Ln => libm::log(x),
            Function::Sin => libm::sin(x),
            Function::Cos => libm::cos(x),
            Function::Tan => libm::tan(x),
            Function::Atan => libm::atan(x),
            Function::Tanh => libm::tanh(x),
            Function::Abs => x.abs(),
        }
    }

    /// The function's slope at x, where it has the value given; that of |x| at 0 is 1.
    pub fn slope(self, x: f64, value: f64) -> f64 {
        match self {
            Function::Exp => value,
            Function::Ln => 1.0 / x,
            Function::Sin => libm::cos(x),
            Function::Cos => -libm::sin(x),
            Function::Tan => 1.0 + value * value,
            Function::Atan => 1.0 / (1.0 + x * x),
            Function::Tanh => 1.0 - value * value,
            Function::Abs if x < 0.0 => -1.0,
            Function::Abs => 1.0,
        }
    }
}
