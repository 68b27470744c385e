//! Every rule of differentiation against central differences, and the canonical forms by their meaning.

use std::collections::BTreeMap;

use super::*;
use crate::diagnostic::Located;
use crate::formula::{self, Value};
use crate::operation::Dual;

struct Bench {
    graph: Graph,
    names: BTreeMap<String, Id>,
}

impl Bench {
    fn new() -> Self {
        let mut graph = Graph::new();
        let mut names = BTreeMap::new();
        for name in ["a", "b", "c", "t"] {
            names.insert(name.to_owned(), graph.scalar(name));
        }
        for name in ["x", "y", "d"] {
            names.insert(name.to_owned(), graph.vector(name));
        }
        for (name, symmetry) in
            [("S", Symmetry::Symmetric), ("H", Symmetry::Skew), ("N", Symmetry::None)]
        {
            names.insert(name.to_owned(), graph.matrix(name, symmetry));
        }
        Bench { graph, names }
    }

    fn read(&mut self, text: &str) -> Id {
        let formula = formula::parse(&Located::alone("f", text)).expect(text);
        formula::lower(&formula, &mut self.graph, &self.names).expect(text)
    }

    /// Values at both points of the signature with a symbol moved by step·direction.
    fn moved(&mut self, id: Id, symbol: Id, direction: Id, step: Rational) -> Vec<f64> {
        let along = self.graph.times(step, direction);
        let by = BTreeMap::from([(symbol, self.graph.add(symbol, along))]);
        let moved = self.graph.substitute(id, &by);
        values(&self.graph, moved)
    }

    /// The derivative along a direction by central differences, extrapolated from two steps.
    fn difference(&mut self, id: Id, symbol: Id, direction: Id) -> Vec<f64> {
        let mut central = |numer: i64, denom: i64| -> Vec<f64> {
            let step = Rational::new(numer, denom);
            let ahead = self.moved(id, symbol, direction, step.clone());
            let behind = self.moved(id, symbol, direction, -step);
            let width = 2.0 * numer as f64 / denom as f64;
            ahead.iter().zip(&behind).map(|(p, m)| (p - m) / width).collect()
        };
        let (coarse, fine) = (central(1, 512), central(1, 1024));
        fine.iter().zip(&coarse).map(|(f, c)| (4.0 * f - c) / 3.0).collect()
    }

    /// Asserts that ∂(expression)/∂(symbol) along a direction agrees with central differences.
    fn check(&mut self, expression: Id, symbol: &str, what: &str) {
        let symbol = self.names[symbol];
        let by_vector = self.graph.shape(symbol) == Shape::Vector;
        let derivative = self.graph.differentiate(expression, symbol).expect(what);
        let direction = if by_vector { self.names["d"] } else { self.graph.integer(1) };
        let along = match (by_vector, self.graph.shape(expression)) {
            (false, _) => derivative,
            (true, Shape::Scalar) => self.graph.dot(derivative, direction),
            (true, _) => self.graph.apply(derivative, direction),
        };
        let (found, expected) =
            (values(&self.graph, along), self.difference(expression, symbol, direction));
        let scale = expected.iter().fold(1.0_f64, |m, v| m.max(v.abs()));
        assert_eq!(found.len(), expected.len(), "{what}");
        for (f, e) in found.iter().zip(&expected) {
            // Fourth order in the step of 1/1024, and rounding over it.
            assert!((f - e).abs() <= 1e-9 * scale, "{what}: {f} {e}");
        }
    }
}

fn values(graph: &Graph, id: Id) -> Vec<f64> {
    graph.signature(id).collect()
}

#[test]
fn derivatives_of_scalars_agree_with_central_differences() {
    for text in [
        "3",
        "b",
        "2*a - b/3 + 1",
        "a*b*c",
        "a^5 - 2*a^2",
        "1/a",
        "b/(a^3 + c)^2",
        "sqrt(a*b + 1)",
        "(a + b)^(7/3)",
        "a^(-2/3)",
        "a^b",
        "b^a",
        "exp(-a*b)",
        "log(a + a^2)",
        "sin(a*b)*cos(a/c)",
        "tan(a/2)",
        "atan(a^2 - b)",
        "sinh(a)/cosh(a*b)",
        "tanh(a - b)",
        "abs(a - 2)*abs(a + 2)",
        "min(a, 3)*max(a, b - 2)",
        "exp(sin(log(a)*tanh(a*a)))",
        "dot(x, S*y)*a^2",
    ] {
        let mut bench = Bench::new();
        let id = bench.read(text);
        bench.check(id, "a", text);
    }
}

#[test]
fn every_function_has_the_derivative_of_its_differences_and_duals() {
    for function in Function::ALL {
        let text = format!("{}(a)", function.name());
        let formula = formula::parse(&Located::alone("f", &text)).expect("a formula");
        let mut bench = Bench::new();
        let points = BTreeMap::from([("a".to_owned(), function.points().to_vec())]);
        bench.graph.evaluate_at(Points::of(points));
        let id = bench.read(&text);
        bench.check(id, "a", &text);
        let derivative = bench.graph.differentiate(id, bench.names["a"]).expect("a derivative");
        let found = values(&bench.graph, derivative);
        for ((x, value), slope) in function.points().iter().zip(values(&bench.graph, id)).zip(found)
        {
            let names = BTreeMap::from([("a".to_owned(), Value::Scalar(Dual::variable(*x)))]);
            let dual = formula::evaluate(&formula, &names).expect("a value").scalar();
            let dual = dual.expect("a number");
            assert_eq!(dual.value, value, "{text} at {x}");
            let scale = slope.abs().max(1.0);
            assert!((dual.slope - slope).abs() <= 4.0 * f64::EPSILON * scale, "{text} at {x}");
        }
        let nested = format!("{}(0.3 + a*b/9)*b", function.name());
        let id = bench.read(&nested);
        bench.check(id, "b", &nested);
    }
}

#[test]
fn derivatives_of_choices_are_those_of_the_piece_that_holds() {
    for (low, high) in [("a", "3"), ("3", "a"), ("0", "a*b")] {
        let mut bench = Bench::new();
        let (low, high) = (bench.read(low), bench.read(high));
        let mask = bench.graph.compare(Relation::LessOrEqual, low, high);
        let (first, second) = (bench.read("a^3*x"), bench.read("sin(a)*y"));
        let choice = bench.graph.select(mask, first, second);
        bench.check(choice, "a", "a choice of vectors");
        let (first, second) = (bench.read("dot(x, S*x)"), bench.read("a*dot(x, y)"));
        let choice = bench.graph.select(mask, first, second);
        bench.check(choice, "x", "a choice of scalars by a vector");
    }
}

#[test]
fn derivatives_of_vectors_and_matrices_by_a_scalar() {
    for text in [
        "x",
        "a*x - a^2*y/b",
        "S*(a*x + y)*sin(a)",
        "transpose(N)*(x/a)",
        "a*S - exp(a)*H",
        "outer(a*x, y + a*x)",
        "transpose(a^2*N)",
        "dot(a*x + y, N*(x - a*y))*x",
    ] {
        let mut bench = Bench::new();
        let id = bench.read(text);
        bench.check(id, "a", text);
    }
}

#[test]
fn derivatives_by_a_vector() {
    for text in [
        "a",
        "dot(x, y)",
        "dot(x, x)",
        "dot(x, N*x)",
        "dot(N*x, H*x)",
        "dot(y, S*N*x)",
        "a*dot(x, x)^2/(1 + dot(y, x)^2)",
        "sqrt(dot(x, x) + 1)*exp(-dot(x, y)/5)",
        "sin(dot(x, H*y))*cos(dot(x, y))",
        "x",
        "y",
        "a*x + S*x - N*y",
        "transpose(N)*x",
        "dot(x, y)*y",
        "dot(x, S*x)*(N*x)",
        "x/dot(x, x)",
        "dot(x, y)*x + tanh(dot(x, x))*(H*x)",
        "S*(dot(x, y)*y)",
        // Vectors whose Jacobian is a product of matrices.
        "dot(y, S*N*x + x)",
        "dot(y, dot(x, y)*(S*N*x) + x)",
    ] {
        let mut bench = Bench::new();
        let id = bench.read(text);
        bench.check(id, "x", text);
    }
    let mut bench = Bench::new();
    for condition in ["0 < 1 + a^2", "1 + a^2 < 0"] {
        let [mask, product, other] = [condition, "S*N*x", "H*N*x"].map(|text| bench.read(text));
        let chosen = bench.graph.select(mask, product, other);
        let along = bench.graph.dot(bench.names["y"], chosen);
        bench.check(along, "x", condition);
    }
}

#[test]
fn derivatives_without_a_form_are_refused_by_name() {
    for (text, expected) in [
        ("S*N*x", DifferentiateError::MatrixProduct),
        ("dot(x, y)*S", DifferentiateError::ThirdOrder),
        ("outer(x, y)", DifferentiateError::ThirdOrder),
    ] {
        let mut bench = Bench::new();
        let (id, x) = (bench.read(text), bench.names["x"]);
        assert_eq!(bench.graph.differentiate(id, x), Err(expected), "{text}");
    }
}

#[test]
fn what_does_not_vary_has_a_zero_derivative_of_the_right_shape() {
    let mut bench = Bench::new();
    for (text, by, shape) in [
        ("b", "a", Shape::Scalar),
        ("b*y", "a", Shape::Vector),
        ("b*S", "a", Shape::Matrix),
        ("b", "x", Shape::Vector),
        ("b*y", "x", Shape::Matrix),
    ] {
        let (id, symbol) = (bench.read(text), bench.names[by]);
        let derivative = bench.graph.differentiate(id, symbol).expect("a zero");
        assert!(bench.graph.is_zero(derivative), "{text} by {by}");
        assert_eq!(bench.graph.shape(derivative), shape, "{text} by {by}");
    }
}

/// Texts that mean the same, and must be one node by construction.
#[test]
fn equal_texts_are_one_node() {
    for (a, b) in [
        ("a + b - a", "b"),
        ("2*(a + b) - b - 2*a", "b"),
        ("a*b/a", "b"),
        ("(2*a)^3", "8*a^3"),
        ("(a*b)^2/b", "a^2*b"),
        ("sqrt(a)*sqrt(a)", "a"),
        ("sqrt(4*a)", "2*sqrt(a)"),
        ("a^(1/3)*a^(2/3)", "a"),
        ("1/(1/a)", "a"),
        ("(a + b)*(a + b)", "(a + b)^2"),
        ("sin(-a) + sin(a)", "0"),
        ("cos(-a)", "cos(a)"),
        ("tanh(-2*a)", "-tanh(2*a)"),
        ("abs(-a)", "abs(a)"),
        ("exp(0) + cos(0) + log(1)", "2"),
        ("sqrt(9/4)", "3/2"),
        ("x + y - x", "y"),
        ("a*(b*x)", "(a*b)*x"),
        ("S*(2*a*x)", "2*a*(S*x)"),
        ("dot(2*x, a*y)", "2*a*dot(y, x)"),
        ("transpose(S)*x", "S*x"),
        ("transpose(H)*x", "-H*x"),
        ("transpose(transpose(N))*x", "N*x"),
        ("transpose(outer(x, y))", "outer(y, x)"),
        ("outer(x, y)*x", "dot(x, y)*x"),
        ("outer(2*x, a*y)", "2*a*outer(x, y)"),
        ("(S + 2*H)*x", "S*x + 2*(H*x)"),
        ("0*x + y", "y"),
    ] {
        let mut bench = Bench::new();
        let (x, y) = (bench.read(a), bench.read(b));
        assert_eq!(
            x,
            y,
            "{a} and {b}: {} and {}",
            display(&bench.graph, x),
            display(&bench.graph, y)
        );
    }
}

/// Numbers are exact or left alone, and growth without bound is noticed.
#[test]
fn numbers_stay_exact_and_bounded() {
    let mut bench = Bench::new();
    let (half, two) = (Rational::new(1, 2), bench.graph.integer(2));
    let root = bench.graph.power(two, half.clone());
    assert!(bench.graph.as_number(root).is_none());
    let square = bench.graph.mul(root, root);
    assert_eq!(square, two);
    let zero = bench.graph.integer(0);
    let inverse = bench.graph.power(zero, -Rational::from(1));
    assert!(bench.graph.as_number(inverse).is_none());
    assert!(!bench.graph.exceeded());
    let mut huge = bench.graph.integer(7);
    for _ in 0..20 {
        huge = bench.graph.mul(huge, huge);
    }
    assert!(bench.graph.exceeded());
}

/// Pairs that only multiplying out shows to be equal, and ones that differ in a sign or an order.
#[test]
fn the_normal_form_decides_equality() {
    for (a, b, equal) in [
        ("(a + b)^3", "a^3 + 3*a^2*b + 3*a*b^2 + b^3", true),
        ("(a + b)^3", "a^3 + 3*a^2*b + 3*a*b^2 - b^3", false),
        ("dot(x + y, x - y)", "dot(x, x) - dot(y, y)", true),
        ("dot(x, S*y)", "dot(y, S*x)", true),
        ("dot(x, N*y)", "dot(y, transpose(N)*x)", true),
        ("dot(x, N*y)", "dot(y, N*x)", false),
        ("dot(x, H*y) + dot(y, H*x)", "0", true),
        ("dot(x, H*S*H*y)", "-dot(H*y, S*H*x)", true),
        ("dot(x, H*S*H*y)", "-dot(H*x, S*H*y)", true),
        ("dot(x, S*H*S*x)", "0", true),
        ("S*(x + a*y) - a*(S*y)", "S*x", true),
        ("outer(x + y, x)", "outer(x, x) + outer(y, x)", true),
        ("outer(x, y)", "outer(y, x)", false),
        ("(a*S + H)*(x - y)", "a*(S*x) - a*(S*y) + H*x - H*y", true),
        ("sin(a*(b + c))", "sin(a*b + a*c)", true),
        ("(a + b)*x/(a + b)", "x", true),
    ] {
        let mut bench = Bench::new();
        let (x, y) = (bench.read(a), bench.read(b));
        let (x, y) = match (bench.graph.shape(x), bench.graph.is_zero(y)) {
            (shape, true) => (x, bench.graph.zero(shape)),
            _ => (x, y),
        };
        assert_eq!(normal::equal(&mut bench.graph, x, y), equal, "{a} and {b}");
        assert_eq!(bench.graph.same_signature(x, y), equal, "{a} and {b}");
        for id in [x, y] {
            let once = normal::expand(&mut bench.graph, id);
            assert!(bench.graph.same_signature(id, once), "{a} and {b}");
            assert_eq!(normal::expand(&mut bench.graph, once), once, "{a} and {b}");
        }
    }
}

/// What passes put in the place of a node without a node of their own.
#[test]
fn sums_and_dot_products_in_the_place_of_a_node_are_compared_with_it() {
    let one = || Rational::from(1);
    for (expression, parts, kept) in [
        ("a*b*S*x - c*H*x", [(1, "a*b", "S*x"), (-1, "c", "H*x")], true),
        ("a*b*S*x - c*H*x", [(1, "a*b", "S*x"), (1, "c", "H*x")], false),
        ("a*b*S*x - c*H*x", [(1, "a", "S*x"), (-1, "c", "H*x")], false),
        ("a*sin(b) + 2*c", [(1, "a", "sin(b)"), (2, "c", "1")], true),
        ("a*sin(b) + 2*c", [(1, "a", "sin(b)"), (2, "c", "b")], false),
    ] {
        let mut bench = Bench::new();
        let id = bench.read(expression);
        let parts = parts
            .map(|(f, scalar, rest)| (Rational::from(f), bench.read(scalar), bench.read(rest)));
        bench.graph.keep_sum(id, &parts);
        assert_eq!(bench.graph.changed().is_none(), kept, "{expression}");
    }
    for (a, b, factor, kept) in [
        ("x", "H*y", one(), true),
        ("H*x", "y", -one(), true),
        ("H*x", "y", one(), false),
        ("x", "S*y", one(), false),
    ] {
        let mut bench = Bench::new();
        let id = bench.read("dot(x, H*y)");
        let vectors = [a, b].map(|text| bench.read(text));
        bench.graph.keep_dot(id, &factor, vectors);
        assert_eq!(bench.graph.changed().is_none(), kept, "{a} and {b}");
    }
}

#[test]
fn signatures_tell_apart_what_differs_slightly() {
    let mut bench = Bench::new();
    let (x, y) = (bench.read("a + b"), bench.read("a + b + 0.000001"));
    assert!(!bench.graph.same_signature(x, y));
    // Relative to what there is: small numbers are told apart as large ones are.
    let (x, y) = (bench.read("a*1e-9"), bench.read("a*1.0000000001e-9"));
    assert!(!bench.graph.same_signature(x, y));
    // What is lost by rounding is no difference.
    let (x, y) = (bench.read("(a + 1e9)^3"), bench.read("a^3 + 3e9*a^2 + 3e18*a + 1e27"));
    assert!(bench.graph.same_signature(x, y));
    let (x, y) = (bench.read("(1e9*a + b)^2 - 1e18*a^2"), bench.read("2e9*a*b + b^2"));
    assert!(bench.graph.same_signature(x, y));
    let (x, y) = (bench.read("S*x"), bench.read("H*x"));
    assert!(!bench.graph.same_signature(x, y));
}
