//! Specs of motions: every sign of declared terms counts, and the text of a kernel.

use std::fs;
use std::path::{Path, PathBuf};

use whirl_codegen::generate::{SpecFile, generate};

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

fn spec(name: &str) -> SpecFile {
    let path = format!("motion/{name}.toml");
    let text = fs::read_to_string(folder("../specs").join(&path)).expect("the spec is there");
    SpecFile { path, text }
}

/// Places of the signs in the formulas of declared terms.
fn signs(text: &str) -> Vec<usize> {
    let mut signs = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        if let Some((key, formula)) = line.split_once("= '")
            && !key.contains(['#', '"'])
        {
            let offset = start + line.len() - formula.len();
            signs.extend(formula.match_indices(['+', '-']).map(|(place, _)| offset + place));
        }
        start += line.len();
    }
    signs
}

#[test]
fn every_sign_of_the_declared_terms_counts() {
    let original = spec("hu2003");
    generate(std::slice::from_ref(&original)).expect("the shipped spec holds");
    let signs = signs(&original.text);
    assert!(signs.len() >= 18, "{} signs", signs.len());
    for place in signs {
        let mut text = original.text.clone();
        let other = if &text[place..=place] == "+" { "-" } else { "+" };
        text.replace_range(place..=place, other);
        let line = text[..place].lines().count();
        let changed = SpecFile { path: original.path.clone(), text };
        let wrong = text_line(&changed.text, place);
        match generate(std::slice::from_ref(&changed)) {
            Ok(_) => panic!("line {line} passed with a changed sign: {wrong}"),
            Err(errors) => {
                let message = errors.to_string();
                assert!(message.contains("motion/hu2003.toml"), "{message}");
                assert!(
                    message.contains("derivative") || message.contains("symmetric"),
                    "{wrong}: {message}"
                );
            }
        }
    }
}

fn text_line(text: &str, place: usize) -> &str {
    let start = text[..place].rfind('\n').map_or(0, |newline| newline + 1);
    text[start..].lines().next().unwrap_or("")
}

#[test]
fn a_declared_derivative_that_is_wrong_is_shown_with_the_right_one() {
    let mut file = spec("hu2003");
    file.text = file.text.replace("eta.eta = '2*Y*theta_dot^2'", "eta.eta = 'Y*theta_dot^2'");
    let errors = generate(&[file]).expect_err("the extra term is missing").to_string();
    for part in [
        "`B.eta.eta` is not the derivative of the declared terms",
        "eta.eta = 'Y*theta_dot^2'",
        "declared theta_dot^2*Y, derived 2*theta_dot^2*Y",
    ] {
        assert!(errors.contains(part), "{part} is missing in:\n{errors}");
    }
}

#[test]
fn the_text_of_the_residual_kernel_is_as_committed() {
    let files = generate(&[spec("rotating-shaft")]).unwrap_or_else(|errors| panic!("{errors}"));
    let text =
        &files.iter().find(|file| file.name == "motions.rs").expect("a file of motions").text;
    let start = text.find("    /// Q_v − M q̈.").expect("the kernel is there");
    let end = text[start..].find("\n    }\n").expect("it ends") + start;
    let found = format!("{}\n    }}\n", &text[start..end]);
    whirl_tests::golden::is_as_committed(&folder("golden/motion-residual.rs"), &found);
}
