//! Specs from strangers: nothing that they say makes the generator panic, run on, fill the memory or write
//! a token of theirs into code. `cargo run --release -p whirl-codegen --example hostile` does the same
//! with any number of inputs.

mod bombs;
mod corpus;
mod injection;
mod mutate;
mod random;
mod run;
mod target;

use std::time::Duration;

use corpus::{Corpus, texts};
use injection::Vocabulary;
use run::{Input, input, run};
use whirl_codegen::formula;
use whirl_codegen::generate::{SpecFile, generate};

/// Inputs of a test run; the example takes as many as asked for.
const INPUTS: u64 = 1500;

/// An input that takes longer hangs, in a build for tests on a busy machine.
const HANG: Duration = Duration::from_secs(120);

fn fine(input: &Input, vocabulary: &Vocabulary) -> bool {
    let outcome = run(input, vocabulary);
    assert_eq!(outcome.panic, None, "{}", input.text);
    assert!(outcome.time < HANG, "{:?}: {}", outcome.time, input.text);
    outcome.accepted
}

#[test]
fn mutants_do_no_harm() {
    let (corpus, vocabulary) = (Corpus::read(), Vocabulary::shared());
    let accepted = (0..INPUTS).filter(|number| fine(&input(&corpus, 1, *number), vocabulary));
    let accepted = accepted.count() as u64;
    // A fuzzer of which everything is refused at once tests nothing.
    assert!(accepted > INPUTS / 50, "{accepted} of {INPUTS} were accepted");
}

#[test]
fn what_was_found_stays_mended() {
    let vocabulary = Vocabulary::shared();
    for (folder, is_formula) in [("fuzz/corpus/formula", true), ("fuzz/corpus/spec", false)] {
        let found = texts(&corpus::root().join(folder));
        assert!(!found.is_empty(), "{folder}");
        for (_, text) in found {
            fine(&Input { is_formula, text }, vocabulary);
        }
    }
}

#[test]
fn bombs_do_not_go_off() {
    for (text, code) in bombs::refused() {
        let input = Input { is_formula: false, text };
        assert!(!fine(&input, Vocabulary::shared()));
        let path = format!("{}/bomb.toml", target::folder(&input.text));
        let shown: String = input.text.chars().take(400).collect();
        let file = SpecFile { path, text: input.text };
        let errors = generate(&[file]).expect_err("the file is too much");
        let codes: Vec<_> = errors.iter().filter_map(|error| error.code).collect();
        assert!(codes.iter().any(|found| found.0 == code), "{codes:?}: {shown}");
    }
}

/// Everything in which a text of the author's own choice may stand.
#[test]
fn texts_of_a_spec_stay_texts() {
    let vocabulary = Vocabulary::shared();
    let hostile = [
        "*/ fn injected() {} /*",
        "\\\"; panic!(); \\\"",
        "#[no_mangle]",
        "first\\nfn injected() {}",
        "first\\r\\nfn injected() {}",
        "first\\rfn injected() {}",
        "\\u202e\\u2066 turned \\u2069",
        "r#\\\"raw\\\"# \\\\",
        "\\u0000\\u007f\\u0085\\u2028\\u2029",
        "{} {0} {name} $crate #name",
        "/ // /// ! */",
        "\\t\\\"\\\"\\\"'''",
    ];
    for text in hostile {
        let spec = format!(
            "kind = \"law\"\nname = \"example\"\ntitle = \"{text}\"\nsource = \"{text}\"\n\n\
             [inputs.h]\nunit = \"mm\"\ntitle = \"{text}\"\n\n\
             [outputs.Q]\nunit = \"N\"\ntitle = \"{text}\"\nvalue = '2*h'\n"
        );
        assert!(fine(&Input { is_formula: false, text: spec }, vocabulary), "{text}");
    }
}

/// Names that Rust keeps for itself, or that no Rust name can be.
#[test]
fn names_of_a_spec_stay_names() {
    let vocabulary = Vocabulary::shared();
    let keywords =
        ["fn", "unsafe", "type", "self", "Self", "crate", "super", "async", "try", "gen", "_"];
    let others = [
        "r",
        "std",
        "panic",
        "L",
        "f64",
        "Lane",
        "include",
        "core",
        "None",
        "Some",
        "Ok",
        "Err",
        "n",
        "i",
        "a1",
        "out",
        "workspace",
        "once",
        "sums",
        "material",
        "matrix",
        "ENTRY",
        "Batch",
        "WEIGHTS",
    ];
    for name in keywords.iter().chain(&others) {
        // What is no name of a formula can still be that of a file.
        let own = formula::name(name).unwrap_or_else(|_| "p".to_owned());
        let law = format!(
            "kind = \"law\"\nname = \"{name}\"\ntitle = \"t\"\nsource = \"s\"\n[inputs.h]\nunit = \"mm\"\n\
             [parameters.{own}]\nvalue = 2\nunit = \"N/mm\"\n\
             [outputs.Q]\nunit = \"N\"\nvalue = '{own}*h'\n"
        );
        assert!(fine(&Input { is_formula: false, text: law }, vocabulary), "{name}");
        let name_of_form = own.to_lowercase();
        let form = format!(
            "kind = \"form\"\nname = \"{name}\"\ntitle = \"t\"\nsource = \"s\"\n\
             [material.{own}]\nunit = \"Pa\"\ntitle = \"t\"\n[forms]\n{name_of_form} = '{own}*dot(u, v)'\n"
        );
        assert!(fine(&Input { is_formula: false, text: form }, vocabulary), "{name}");
        let motion = format!(
            "kind = \"motion\"\nname = \"{name}\"\ntitle = \"t\"\nsource = \"s\"\n\
             kinetic_energy = '1/2*theta_dot^2*{own} + 1/2*dot(eta_dot, eta_dot)'\n\
             [coordinates]\ntheta = \"scalar\"\neta = \"vector\"\n[tensors]\n{own} = \"scalar\"\n"
        );
        assert!(fine(&Input { is_formula: false, text: motion }, vocabulary), "{name}");
    }
}

/// sinh a is made of eᵃ twice: what is nested n deep is written 2ⁿ times.
#[test]
fn what_repeats_itself_is_evaluated_once() {
    let vocabulary = Vocabulary::shared();
    for text in bombs::repeated() {
        let start = std::time::Instant::now();
        fine(&Input { is_formula: false, text }, vocabulary);
        // Milliseconds where each node is evaluated once, years where it is not.
        assert!(start.elapsed() < Duration::from_secs(60));
    }
}

/// The bounds of the graph are far above what the specs of the repository take.
#[test]
fn specs_of_the_repository_are_far_below_the_bounds() {
    use whirl_codegen::diagnostic::Source;
    use whirl_codegen::kinds::{element::ElementSpec, motion::MotionSpec};
    let mut most = (0, 0);
    for (path, text) in texts(&corpus::root().join("specs/elements")) {
        let element = ElementSpec::read(&Source::new(&path, text)).expect("an element");
        let spent = (element.graph.work(), element.graph.size());
        println!("{}: work {}, nodes {}", element.name, spent.0, spent.1);
        most = (spent.0.max(most.0), spent.1.max(most.1));
    }
    for (path, text) in texts(&corpus::root().join("specs/motion")) {
        let Ok(motion) = MotionSpec::read(&Source::new(&path, text)) else { continue };
        println!("{}: work {}, nodes {}", motion.name, motion.graph.work(), motion.graph.size());
        most = (motion.graph.work().max(most.0), motion.graph.size().max(most.1));
    }
    assert!(most.0 < 750_000 && most.1 < 100_000, "work {}, nodes {}", most.0, most.1);
}
