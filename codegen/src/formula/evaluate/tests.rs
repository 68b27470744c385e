use super::*;
use crate::diagnostic::Located;
use crate::formula::parse;
use crate::operation::Dual;

fn value(text: &str) -> f64 {
    let formula = parse(&Located::alone("f", text)).unwrap();
    let x = BTreeMap::from([("x".to_owned(), Value::Scalar(2.0))]);
    evaluate(&formula, &x).unwrap().scalar().unwrap()
}

#[test]
fn precedence_is_that_of_mathematics() {
    assert_eq!(value("-2^2"), -4.0);
    assert_eq!(value("2^3^2"), 512.0);
    assert_eq!(value("2^-1"), 0.5);
    assert_eq!(value("2^-x^2"), 0.0625);
    assert_eq!(value("1 - 2 - 3"), -4.0);
    assert_eq!(value("8/4/2"), 1.0);
    assert_eq!(value("8/4*2"), 4.0);
    assert_eq!(value("1/2*x"), 1.0);
    assert_eq!(value("-x^2 + 3*-x"), -10.0);
    assert_eq!(value("2*(3 + 4)^2"), 98.0);
    assert_eq!(value("+x"), 2.0);
    assert_eq!(value("1e3 + 2.5E-1"), 1000.25);
}

#[test]
fn functions_have_their_values() {
    assert_eq!(value("sqrt(16) + abs(-3) + min(x, 1, 5) + max(x, 7)"), 15.0);
    assert_eq!(value("exp(0) + log(1) + sin(0) + cos(0) + tan(0) + atan(0) + tanh(0)"), 2.0);
    assert!((value("sinh(x)^2 - cosh(x)^2") + 1.0).abs() < 1e-14);
    assert_eq!(value("pi"), std::f64::consts::PI);
    for (y, x) in [(1.0, 2.0), (2.0, 1.0), (2.0, -1.0), (1.0, -2.0), (0.0, -1.0), (-1.0, -3.0)] {
        for sign in [1.0, -1.0] {
            let y: f64 = sign * y;
            let found = value(&format!("atan2({y}, {x})"));
            assert!((found - f64::atan2(y + 0.0, x)).abs() < 1e-15, "{y} {x}: {found}");
        }
    }
    assert_eq!(value("sum(j, 1, 4, j^x)"), 30.0);
    assert_eq!(value("sum(i, 0, x, sum(j, 0, i, i*j))"), 7.0);
    assert_eq!(value("sum(j, -1, 1, j)"), 0.0);
}

#[test]
fn vectors_and_matrices_multiply() {
    let names = BTreeMap::from([
        ("v".to_owned(), Value::Vector(vec![1.0, 2.0])),
        ("A".to_owned(), Value::Matrix(vec![vec![1.0, 2.0], vec![3.0, 4.0]])),
    ]);
    let at = |text: &str| evaluate(&parse(&Located::alone("f", text)).unwrap(), &names).unwrap();
    assert_eq!(at("2*A*A*v/4 - v"), Value::Vector(vec![12.5, 27.5]));
    assert_eq!(at("dot(v, transpose(A)*v)"), Value::Scalar(27.0));
    assert_eq!(at("outer(v, v)"), Value::Matrix(vec![vec![1.0, 2.0], vec![2.0, 4.0]]));
    assert_eq!(at("1 < 2 <= 2 and not 3 < 2"), Value::Truth(true));
}

#[test]
fn duals_differentiate_every_function() {
    for text in [
        "x^3 - 2/x",
        "sqrt(x)*exp(-x)",
        "log(x)^2 + x^1.5 + 2^x + x^x",
        "sin(x)*cos(x) + tan(x/3)",
        "atan(x) + tanh(x) + sinh(x)/cosh(x)",
        "abs(x - 3) + min(x, 3)*max(x, 1)",
        "atan2(x, 3) + atan2(x, -1) + atan2(1, x)*atan2(-x, x - 5)",
        "sum(j, 0, 5, sin(j*x)/(1 + j))",
    ] {
        let formula = parse(&Located::alone("f", text)).unwrap();
        let at = |x: f64| {
            let names = BTreeMap::from([("x".to_owned(), Value::Scalar(x))]);
            evaluate(&formula, &names).unwrap().scalar().unwrap()
        };
        let names = BTreeMap::from([("x".to_owned(), Value::Scalar(Dual::variable(1.7)))]);
        let dual = evaluate(&formula, &names).unwrap().scalar().unwrap();
        let step = 1e-5;
        let central = (at(1.7 + step) - at(1.7 - step)) / (2.0 * step);
        assert_eq!(dual.value, at(1.7), "{text}");
        // step² times a third derivative of order 10, and rounding over the step.
        assert!((dual.slope - central).abs() < 1e-8, "{text}: {} {central}", dual.slope);
    }
}
