//! Random formulas: the graph, its derivatives and the tape against direct evaluation; random text
//! against the parser.

use std::collections::BTreeMap;

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};
use whirl_codegen::diagnostic::Located;
use whirl_codegen::expression::Graph;
use whirl_codegen::formula::{Value, evaluate, lower, parse};
use whirl_codegen::operation::{Dual, Rounded};
use whirl_codegen::schedule::{Request, schedule};
use whirl_codegen::tape::Tape;

fn runner(cases: u32) -> TestRunner {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let rng = proptest::test_runner::TestRng::deterministic_rng(config.rng_algorithm);
    TestRunner::new_with_rng(config, rng)
}

/// Text of a smooth formula in x and y that is defined for positive x and y.
fn formula() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![
        Just("x".to_owned()),
        Just("y".to_owned()),
        (1..20_u32).prop_map(|n| n.to_string()),
        (1..99_u32).prop_map(|n| format!("0.{n:02}")),
    ];
    leaf.prop_recursive(5, 40, 3, |inner| {
        let pair = (inner.clone(), inner.clone());
        prop_oneof![
            pair.clone().prop_map(|(a, b)| format!("({a} + {b})")),
            pair.clone().prop_map(|(a, b)| format!("({a} - {b})")),
            pair.clone().prop_map(|(a, b)| format!("{a}*{b}")),
            pair.clone().prop_map(|(a, b)| format!("{a}/(1 + ({b})^2)")),
            inner.clone().prop_map(|a| format!("-{a}")),
            (inner.clone(), 2..5_u32).prop_map(|(a, n)| format!("({a})^{n}")),
            inner.clone().prop_map(|a| format!("(1 + ({a})^2)^(3/2)")),
            inner.clone().prop_map(|a| format!("sqrt(1 + abs({a}))")),
            inner.clone().prop_map(|a| format!("sin({a})")),
            inner.clone().prop_map(|a| format!("cos({a})")),
            inner.clone().prop_map(|a| format!("tanh({a})")),
            inner.clone().prop_map(|a| format!("atan({a})")),
            inner.clone().prop_map(|a| format!("exp(sin({a}))")),
            inner.clone().prop_map(|a| format!("log(1 + ({a})^2)")),
            pair.clone().prop_map(|(a, b)| format!("max({a}, {b})")),
            pair.prop_map(|(a, b)| format!("min({a}, {b})")),
        ]
    })
}

#[test]
fn graph_derivatives_and_tape_agree_with_direct_evaluation() {
    let point = [0.37, 1.21];
    let compared = std::cell::Cell::new(0);
    runner(400)
        .run(&formula(), |text| {
            let formula = parse(&Located::alone("formula", &text)).expect("a formula");
            let names = |values: [Value<Rounded>; 2]| -> BTreeMap<String, Value<Rounded>> {
                ["x", "y"].map(str::to_owned).into_iter().zip(values).collect()
            };
            let rounded = names(point.map(|x| Value::Scalar(Rounded::new(x))));
            let direct = evaluate(&formula, &rounded).expect("a value").scalar().expect("a number");
            let mut graph = Graph::new();
            let symbols = [graph.scalar("x"), graph.scalar("y")];
            let ids = ["x", "y"].map(str::to_owned).into_iter().zip(symbols).collect();
            // Towers of powers of constants may pass the bound on exact numbers, which is an error.
            let Ok(value) = lower(&formula, &mut graph, &ids) else { return Ok(()) };
            let slopes = symbols.map(|symbol| graph.differentiate(value, symbol).expect("scalars"));
            if graph.exceeded() || direct.error > 1e-6 * direct.value.abs().max(1.0) {
                return Ok(());
            }
            let request = Request::flat(
                &[("x", symbols[0]), ("y", symbols[1])],
                &[("f", value), ("fx", slopes[0]), ("fy", slopes[1])],
            );
            let program = schedule(&mut graph, &request).expect("a schedule");
            let tape = Tape::new(&program);
            let (mut rows, mut workspace) = ([0.0; 3], vec![0.0; tape.workspace()]);
            tape.evaluate(1, &point, &mut rows, &mut workspace);
            // Both are within the bound of the exact value, up to reordered sums.
            let allowed = 16.0 * direct.error + 1e-15;
            prop_assert!((rows[0] - direct.value).abs() <= allowed, "{text}: {rows:?} {direct:?}");
            for (place, slope) in rows[1..].iter().enumerate() {
                let duals = [0, 1].map(|i| {
                    let slope = f64::from(i == place);
                    Value::Scalar(Dual { value: point[i], slope })
                });
                let names = ["x", "y"].map(str::to_owned).into_iter().zip(duals).collect();
                let dual = evaluate(&formula, &names).expect("a value").scalar().expect("a number");
                if dual.slope.is_finite() {
                    // A derivative of terms far larger than itself loses the digits they cancel.
                    let scale = dual.slope.abs().max(direct.error / f64::EPSILON).max(1.0);
                    prop_assert!(
                        (slope - dual.slope).abs() <= 1e-9 * scale,
                        "{text}: {slope} {dual:?}"
                    );
                    compared.set(compared.get() + 1);
                }
            }
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{error}"));
    assert!(compared.get() > 500, "only {} comparisons", compared.get());
}

#[test]
fn no_text_makes_the_parser_panic() {
    let pieces = [
        "x",
        "y_dot",
        "θ̇",
        "1",
        "0.5",
        "1e308",
        "1e-308",
        "+",
        "-",
        "*",
        "/",
        "^",
        "(",
        ")",
        ",",
        "<",
        "<=",
        ">",
        "and",
        "or",
        "not",
        "sin",
        "max",
        "sqrt",
        "log",
        " ",
        "²",
        "\u{0}",
        "\u{307}",
        "é",
        "\"",
        "'",
        "#",
        "99999999999999999999999999999999",
        "0",
        "pi",
        "e",
    ];
    let soup = prop::collection::vec(prop::sample::select(pieces.to_vec()), 0..60);
    let text = prop_oneof![soup.prop_map(|parts| parts.concat()), any::<String>()];
    runner(4000)
        .run(&text, |text| {
            match parse(&Located::alone("formula", &text)) {
                Ok(formula) => {
                    let mut graph = Graph::new();
                    let names: BTreeMap<_, _> = ["x", "y_dot", "theta_dot"]
                        .map(|name| (name.to_owned(), graph.scalar(name)))
                        .into_iter()
                        .collect();
                    if let Err(errors) = lower(&formula, &mut graph, &names) {
                        prop_assert!(!errors.render().is_empty());
                    }
                }
                Err(errors) => prop_assert!(!errors.render().is_empty()),
            }
            Ok(())
        })
        .unwrap_or_else(|error| panic!("{error}"));
}
