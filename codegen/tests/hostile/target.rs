//! What is done with an input: everything that the generator would do with it.

use std::collections::BTreeMap;

use whirl_codegen::diagnostic::{Diagnostics, Located, Source};
use whirl_codegen::expression::{Graph, Id, Shape, Symmetry, display, normal};
use whirl_codegen::formula::{Value, dimension, evaluate, lower, parse};
use whirl_codegen::generate::{GeneratedFile, SpecFile, generate};
use whirl_codegen::kinds::law::LawSpec;
use whirl_codegen::operation::{Dual, Rounded};
use whirl_codegen::rational::Rational;
use whirl_codegen::schedule::{Request, schedule};
use whirl_codegen::tape::Tape;

/// Errors must be fit to be shown.
fn refused(errors: &Diagnostics) {
    assert!(!errors.is_empty());
    assert!(!errors.render().is_empty());
    assert!(errors.iter().take(50).all(|error| !error.to_string().is_empty()));
}

/// Parses, checks, lowers, differentiates, evaluates, schedules, runs and prints a formula. Whether it was
/// accepted.
pub(crate) fn formula(text: &str) -> bool {
    let formula = match parse(&Located::alone("formula", text)) {
        Ok(formula) => formula,
        Err(errors) => {
            refused(&errors);
            return false;
        }
    };
    if let Err(errors) = dimension(&formula, &BTreeMap::new()) {
        refused(&errors);
    }
    let mut graph = Graph::new();
    let scalars = ["h", "h_dot", "theta", "x", "c0"].map(|name| (name, graph.scalar(name)));
    let vectors = ["v", "eta", "eta_dot"].map(|name| (name, graph.vector(name)));
    let matrices = [("A", Symmetry::None), ("S", Symmetry::Symmetric), ("H", Symmetry::Skew)]
        .map(|(name, symmetry)| (name, graph.matrix(name, symmetry)));
    let constant = ("K", graph.number(Rational::new(3, 2)));
    let all = scalars.iter().chain(&vectors).chain(&matrices).chain([&constant]);
    let names: BTreeMap<String, Id> = all.map(|(name, id)| ((*name).to_owned(), *id)).collect();
    let root = match lower(&formula, &mut graph, &names) {
        Ok(root) => root,
        Err(errors) => {
            refused(&errors);
            return false;
        }
    };
    let is_number = graph.shape(root) == Shape::Scalar;
    let named = formula.names();
    let only_scalars = vectors.iter().chain(&matrices).all(|(name, _)| !named.contains_key(name));
    let mut outputs = vec![("value".to_owned(), root)];
    for (name, symbol) in scalars {
        if let Ok(derivative) = graph.differentiate(root, symbol) {
            outputs.push((format!("by_{name}"), derivative));
        }
    }
    if is_number && !only_scalars {
        for (_, symbol) in vectors {
            if let Ok(gradient) = graph.differentiate(root, symbol) {
                let _ = graph.differentiate(gradient, symbol);
            }
        }
    }
    assert!(!display(&graph, root).is_empty());
    let _ = normal::expand(&mut graph.clone(), root);
    if !only_scalars {
        return !graph.exceeded();
    }
    run_directly(&formula, |value| value);
    run_directly(&formula, Dual::variable);
    run_directly(&formula, Rounded::new);
    if !is_number {
        return !graph.exceeded();
    }
    let outputs: Vec<(&str, Id)> = outputs.iter().map(|(name, id)| (name.as_str(), *id)).collect();
    match schedule(&mut graph, &Request::flat(&scalars, &outputs)) {
        Ok(program) => {
            let tape = Tape::new(&program);
            let inputs = [0.3, -0.7, 2.0, 1e-5, 0.0];
            let mut results = vec![0.0; tape.outputs()];
            tape.evaluate(1, &inputs, &mut results, &mut vec![0.0; tape.workspace()]);
            true
        }
        Err(error) => {
            assert!(!error.to_string().contains("defect"), "{error}: {text}");
            false
        }
    }
}

fn run_directly<N: whirl_codegen::operation::Number>(
    formula: &whirl_codegen::formula::Formula,
    number: impl Fn(f64) -> N,
) {
    let values =
        [("h", 0.3), ("h_dot", -0.7), ("theta", 2.0), ("x", 1e-5), ("c0", 0.0), ("K", 1.5)];
    let names: BTreeMap<String, Value<N>> = values
        .into_iter()
        .map(|(name, value)| (name.to_owned(), Value::Scalar(number(value))))
        .collect();
    evaluate(formula, &names).expect("a formula of numbers that was checked has a value");
}

/// The folder in which a spec file belongs, by the kind that it says it is.
pub(crate) fn folder(text: &str) -> &'static str {
    let says = |kind: &str| text.contains(&format!("kind = \"{kind}\""));
    if says("element") {
        "elements"
    } else if says("form") {
        "forms"
    } else if says("motion") || says("clearance") {
        "motion"
    } else if says("film") {
        "films"
    } else {
        "laws"
    }
}

/// Reads a spec file of any kind and generates its kernels; a law is also run without a compiler.
/// The generated text, if the file was accepted.
///
/// What follows a line `%%%` is the file of a table, `rows.csv`.
pub(crate) fn spec(text: &str) -> Option<Vec<GeneratedFile>> {
    let path = format!("{}/hostile.toml", folder(text));
    let (text, rows) = text.split_once("\n%%%\n").unwrap_or((text, ""));
    let file = |path: &str, text: &str| SpecFile { path: path.to_owned(), text: text.to_owned() };
    let files = match generate(&[file(&path, text), file("laws/rows.csv", rows)]) {
        Ok(files) => files,
        Err(errors) => {
            refused(&errors);
            return None;
        }
    };
    if path.starts_with("laws/") {
        let law = LawSpec::read_with(&Source::new(path, text), &|name| match name {
            "rows.csv" => Ok(Source::new(name, rows)),
            other => Err(format!("there is no `{other}`")),
        });
        let law = law.expect("it was read before");
        assert!(!law.report.to_string().is_empty());
        let tape = Tape::new(&law.program().expect("it was scheduled before"));
        let inputs = vec![1e-5; tape.inputs() * 3];
        let mut results = vec![0.0; tape.outputs() * 3];
        tape.evaluate(3, &inputs, &mut results, &mut vec![0.0; tape.workspace()]);
    }
    Some(files)
}
