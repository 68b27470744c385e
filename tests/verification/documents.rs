//! The documents at the root stay true: paths exist, examples are read.

use std::path::{Path, PathBuf};

use whirl_codegen::diagnostic::Source;
use whirl_codegen::kinds::law::{Acts, LawSpec};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace").to_path_buf()
}

fn document(name: &str) -> String {
    std::fs::read_to_string(root().join(name)).expect(name)
}

/// Texts between single backquotes.
fn quoted(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2).filter(|part| !part.contains('\n'))
}

/// Contents of fenced blocks with a language.
fn fenced<'t>(text: &'t str, language: &str) -> Vec<&'t str> {
    let opening = format!("```{language}\n");
    text.split(opening.as_str()).skip(1).filter_map(|rest| rest.split("\n```").next()).collect()
}

#[test]
fn every_path_named_in_the_architecture_exists() {
    let text = document("ARCHITECTURE.md");
    let folders =
        ["codegen/", "specs/", "solver/", "cli/", "fmu/", "tests/", "benches/", "python/", ".ci/"];
    let paths: Vec<&str> =
        quoted(&text).filter(|path| folders.iter().any(|f| path.starts_with(f))).collect();
    assert!(paths.len() > 20, "only {} paths found", paths.len());
    for path in paths {
        assert!(root().join(path).exists(), "ARCHITECTURE.md names {path}");
    }
}

#[test]
fn the_law_in_the_readme_is_a_law() {
    let text = document("README.md");
    let laws: Vec<&str> = fenced(&text, "toml")
        .into_iter()
        .filter(|block| block.contains("kind = \"law\""))
        .collect();
    assert_eq!(laws.len(), 1);
    if let Err(errors) = LawSpec::read(&Source::new("README.md", laws[0])) {
        panic!("{}", errors.render());
    }
}

#[test]
fn the_law_in_the_page_on_laws_is_a_law() {
    let text = document("docs/laws.md");
    let mut laws =
        fenced(&text, "toml").into_iter().filter(|block| block.contains("kind = \"law\""));
    let law = laws.next().expect("a law");
    let law = LawSpec::read(&Source::new("docs/laws.md", law));
    let law = law.unwrap_or_else(|errors| panic!("{}", errors.render()));
    // What the page says of names is what the language has.
    for acts in Acts::ALL {
        for quantity in acts.inputs().iter().chain(acts.outputs()) {
            assert!(text.contains(&format!("`{}`", quantity.name)), "{}", quantity.name);
        }
    }
    assert_eq!(law.acts, Acts::Spring);
}
