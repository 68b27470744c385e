//! The functions of one scalar, as a table: a row holds all that is known of one.

/// What slopes of functions are made of: numbers, or the nodes of a graph.
pub trait Arithmetic: Clone {
    /// A number of this kind.
    fn number(&self, value: f64) -> Self;
    /// a + b
    fn plus(&self, other: &Self) -> Self;
    /// a − b
    fn minus(&self, other: &Self) -> Self;
    /// a·b
    fn times(&self, other: &Self) -> Self;
    /// a/b
    fn over(&self, other: &Self) -> Self;
    /// √a
    fn root(&self) -> Self;
    /// −1 below zero, else 1.
    fn sign(&self) -> Self;
    /// f(a)
    fn through(&self, function: Function) -> Self;
}

/// What f(−x) is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Parity {
    /// f(x)
    Even,
    /// −f(x)
    Odd,
    /// Neither.
    None,
}

/// What is known of a function besides its value and slope.
struct Row {
    name: &'static str,
    lane: &'static str,
    parity: Parity,
    exact: (i64, i64),
    divisor: Option<fn(f64) -> f64>,
    points: &'static [f64],
}

/// A row:
/// - `name` in formulas, and `lane`, the method that computes it over lanes (and what names of values begin with);
/// - `value`, of the pinned implementation that lanes use too;
/// - `slope` at x, where the function is f;
/// - `parity`, and a whole number whose value is exactly another (`exact`);
/// - `divisor`: what the function divides by, if it has poles;
/// - `points` at which it is tested, in its domain.
macro_rules! functions {
    ($(
        $(#[$about:meta])*
        $function:ident {
            name: $name:literal, lane: $lane:literal, value: $value:expr,
            slope: |$x:pat_param, $f:pat_param| $slope:expr,
            parity: $parity:ident, exact: $exact:expr, divisor: $divisor:expr, points: $points:expr,
        }
    )*) => {
        /// Functions of one scalar.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
        pub enum Function {
            $($(#[$about])* $function,)*
        }

        impl Function {
            /// All of them.
            pub const ALL: &[Function] = &[$(Function::$function),*];

            /// The function's value.
            pub fn value(self, x: f64) -> f64 {
                match self {
                    $(Function::$function => $value(x),)*
                }
            }

            /// The function's slope at x, where it has the value given; that of |x| at 0 is 1.
            pub fn slope<A: Arithmetic>(self, x: &A, value: &A) -> A {
                match self {
                    $(Function::$function => {
                        let ($x, $f) = (x, value);
                        $slope
                    })*
                }
            }

            fn row(self) -> &'static Row {
                match self {
                    $(Function::$function => &Row {
                        name: $name,
                        lane: $lane,
                        parity: Parity::$parity,
                        exact: $exact,
                        divisor: $divisor,
                        points: $points,
                    },)*
                }
            }
        }
    };
}

functions! {
    /// eˣ
    Exp {
        name: "exp", lane: "exp", value: libm::exp,
        slope: |_, f| f.clone(),
        parity: None, exact: (0, 1), divisor: None, points: &[-2.5, 0.0, 0.3, 3.0],
    }
    /// ln x
    Ln {
        name: "log", lane: "ln", value: libm::log,
        slope: |x, _| x.number(1.0).over(x),
        parity: None, exact: (1, 0), divisor: None, points: &[0.2, 1.0, 1.7, 40.0],
    }
    /// sin x
    Sin {
        name: "sin", lane: "sin", value: libm::sin,
        slope: |x, _| x.through(Function::Cos),
        parity: Odd, exact: (0, 0), divisor: None, points: &[-1.2, 0.0, 0.7, 4.0],
    }
    /// cos x
    Cos {
        name: "cos", lane: "cos", value: libm::cos,
        slope: |x, _| x.number(0.0).minus(&x.through(Function::Sin)),
        parity: Even, exact: (0, 1), divisor: None, points: &[-1.2, 0.0, 0.7, 4.0],
    }
    /// tan x
    Tan {
        name: "tan", lane: "tan", value: libm::tan,
        slope: |x, f| x.number(1.0).plus(&f.times(f)),
        parity: Odd, exact: (0, 0), divisor: Some(libm::cos), points: &[-1.2, 0.0, 0.7, 4.0],
    }
    /// arctan x
    Atan {
        name: "atan", lane: "atan", value: libm::atan,
        slope: |x, _| x.number(1.0).over(&x.number(1.0).plus(&x.times(x))),
        parity: Odd, exact: (0, 0), divisor: None, points: &[-3.0, 0.0, 0.4, 8.0],
    }
    /// tanh x
    Tanh {
        name: "tanh", lane: "tanh", value: libm::tanh,
        slope: |x, f| x.number(1.0).minus(&f.times(f)),
        parity: Odd, exact: (0, 0), divisor: None, points: &[-1.5, 0.0, 0.4, 3.0],
    }
    /// |x|
    Abs {
        name: "abs", lane: "abs", value: f64::abs,
        slope: |x, _| x.sign(),
        parity: Even, exact: (0, 0), divisor: None, points: &[-1.5, 0.4],
    }
    /// arsinh x
    Asinh {
        name: "asinh", lane: "asinh", value: libm::asinh,
        slope: |x, _| x.number(1.0).over(&x.number(1.0).plus(&x.times(x)).root()),
        parity: Odd, exact: (0, 0), divisor: None, points: &[-20.0, -0.6, 0.0, 1.3],
    }
    /// erf x = 2/√π ∫₀ˣ exp(−t²) dt
    Erf {
        name: "erf", lane: "erf", value: libm::erf,
        slope: |x, _| {
            let falling = x.number(0.0).minus(&x.times(x)).through(Function::Exp);
            x.number(std::f64::consts::FRAC_2_SQRT_PI).times(&falling)
        },
        parity: Odd, exact: (0, 0), divisor: None, points: &[-2.2, -0.4, 0.0, 1.1],
    }
}

impl Function {
    /// Its name in formulas.
    pub fn name(self) -> &'static str {
        self.row().name
    }

    /// The method of lanes that computes it.
    pub fn lane(self) -> &'static str {
        self.row().lane
    }

    /// Whether lanes compute it side by side; the others go one value after the other.
    pub(crate) fn is_side_by_side(self) -> bool {
        matches!(self, Function::Sin | Function::Cos | Function::Abs)
    }

    /// The function of this name in formulas.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|function| function.name() == name)
    }

    /// What it makes of a changed sign.
    pub(crate) fn parity(self) -> Parity {
        self.row().parity
    }

    /// A whole number, and the function's exact value there.
    pub(crate) fn exact(self) -> (i64, i64) {
        self.row().exact
    }

    /// What it divides by at x, if it has poles.
    pub(crate) fn divisor(self, x: f64) -> Option<f64> {
        self.row().divisor.map(|divisor| divisor(x))
    }

    /// Points of its domain at which it is tested.
    pub fn points(self) -> &'static [f64] {
        self.row().points
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::operation::{Dual, Number, Rounded};

    #[test]
    fn names_tell_functions_apart() {
        for function in Function::ALL {
            assert_eq!(Function::named(function.name()), Some(*function));
            assert_eq!(Function::ALL.iter().filter(|f| f.lane() == function.lane()).count(), 1);
        }
    }

    #[test]
    fn slopes_agree_with_differences() {
        for function in Function::ALL {
            for &x in function.points() {
                let value = function.value(x);
                assert!(value.is_finite(), "{function:?} at {x}");
                // f′ to the fourth order in the step.
                let central = |step: f64| {
                    (function.value(x + step) - function.value(x - step)) / (2.0 * step)
                };
                let step = 1e-3 * x.abs().max(0.5);
                let expected = (4.0 * central(step / 2.0) - central(step)) / 3.0;
                let found = function.slope(&x, &value);
                let scale = expected.abs().max(value.abs() / x.abs().max(1.0)).max(1e-3);
                assert!((found - expected).abs() <= 1e-9 * scale, "{function:?} at {x}: {found}");
                let dual = Dual::variable(x).function(*function);
                assert_eq!([dual.value, dual.slope], [value, found], "{function:?} at {x}");
                let rounded = Rounded { value: x, error: 1e-9 }.function(*function);
                let moved = (function.value(x + 1e-9) - value).abs();
                assert!(moved <= 2.0 * rounded.error, "{function:?} at {x}: {rounded:?}");
            }
        }
    }

    #[test]
    fn what_rows_say_of_signs_and_exact_values_holds() {
        for function in Function::ALL {
            let (at, exact) = function.exact();
            assert_eq!(function.value(at as f64), exact as f64, "{function:?}");
            for &x in function.points() {
                let (value, other) = (function.value(x), function.value(-x));
                match function.parity() {
                    Parity::Even => assert_eq!(other, value, "{function:?} at {x}"),
                    Parity::Odd => assert_eq!(other, -value, "{function:?} at {x}"),
                    Parity::None => {}
                }
            }
            // Neither: no value at −x where there is one at x, or another size.
            let apart = |x: &f64| {
                let [here, other] = [*x, -x].map(|x| function.value(x));
                assert!(here.is_finite(), "{function:?} at {x}");
                other.is_nan() || (here.abs() - other.abs()).abs() > 1e-3
            };
            let shown = function.points().iter().any(apart);
            assert_eq!(shown, function.parity() == Parity::None, "{function:?}");
        }
    }

    #[test]
    fn functions_with_divisors_have_poles_where_these_change_their_signs() {
        for function in Function::ALL {
            for x in (1..4000).map(|i| f64::from(i) * 1e-3) {
                let [here, next] = [x, x + 1e-3].map(|x| function.divisor(x));
                let (Some(here), Some(next)) = (here, next) else { continue };
                let size = function.value(x).abs().max(function.value(x + 1e-3).abs());
                assert!(here * next > 0.0 || size > 500.0, "{function:?} has no pole at {x}");
                let near = here.abs().min(next.abs()) < 0.01;
                assert!(near || size < 500.0, "{function:?} is large at {x}");
            }
        }
    }

    #[test]
    fn new_functions_have_the_values_of_tables() {
        // Abramowitz and Stegun, table 7.1; ln(x + √(1 + x²)) at 1.
        assert!((Function::Erf.value(0.5) - 0.520_499_877_8).abs() < 1e-10);
        assert!((Function::Erf.value(1.0) - 0.842_700_792_9).abs() < 1e-10);
        let expected = (1.0 + 2f64.sqrt()).ln();
        assert!((Function::Asinh.value(1.0) - expected).abs() < 1e-15);
    }
}
