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
        ["codegen/", "specs/", "solver/", "cli/", "tests/", "benches/", "python/", ".ci/"];
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

/// Every section of the page of validations is of a test that is there: it would go stale unseen.
#[test]
fn every_validation_is_of_a_test() {
    fn sources(folder: &Path, all: &mut String) {
        let entries = std::fs::read_dir(folder).expect("a folder");
        for path in entries.map(|entry| entry.expect("an entry").path()) {
            if path.is_dir() {
                sources(&path, all);
            } else if path.extension().is_some_and(|own| own == "rs") {
                all.push_str(&std::fs::read_to_string(&path).expect("a source"));
            }
        }
    }
    let mut tests = String::new();
    sources(&root().join("tests"), &mut tests);
    let page = document("docs/validation.md");
    let sections: Vec<&str> = page.split("\n## ").skip(1).collect();
    assert!(sections.len() >= 20, "{}", sections.len());
    for section in sections {
        let title = section.lines().next().unwrap_or_default();
        let command = quoted(section).find(|own| own.starts_with("cargo test -p "));
        let name = command.and_then(|own| own.rsplit([' ', ':']).next());
        let name = name.unwrap_or_else(|| panic!("`{title}` has no command"));
        assert!(tests.contains(&format!("fn {name}")), "`{title}`: there is no test `{name}`");
    }
}

/// The book has every page, and its links lead somewhere.
#[test]
fn every_page_is_in_the_book_and_every_link_leads_somewhere() {
    let summary = document("docs/SUMMARY.md");
    let folder = root().join("docs");
    let pages = std::fs::read_dir(&folder).expect("docs").map(|own| own.expect("an entry").path());
    let pages: Vec<PathBuf> =
        pages.filter(|own| own.extension().is_some_and(|own| own == "md")).collect();
    assert!(pages.len() > 20, "{}", pages.len());
    for page in pages {
        let name = page.file_name().expect("a name").to_string_lossy().into_owned();
        assert!(name == "SUMMARY.md" || summary.contains(&format!("({name})")), "{name}");
        let text = std::fs::read_to_string(&page).expect("a page");
        let targets = text.split("](").skip(1).filter_map(|rest| rest.split([')', ' ']).next());
        for target in targets.filter(|own| !own.contains("://")) {
            let (file, place) = target.split_once('#').unwrap_or((target, ""));
            let path = if file.is_empty() { page.clone() } else { folder.join(file) };
            assert!(path.exists(), "{name}: there is no `{target}`");
            if !place.is_empty() {
                let text = std::fs::read_to_string(&path).expect("a page");
                let headings = text.lines().filter(|line| line.starts_with('#'));
                let is_there = headings.into_iter().any(|line| anchor(line) == place);
                assert!(is_there, "{name}: `{file}` has no heading `#{place}`");
            }
        }
    }
}

/// The anchor of a heading: lower case, blanks as hyphens, no other punctuation.
fn anchor(heading: &str) -> String {
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = text.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}
