//! The text of every error: one or more bad files a code in `messages`, each with what is said of it.
//! WHIRL_RENEW_GOLDEN=1 writes the texts, and the page of errors in the documents, anew.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use whirl_codegen::diagnostic::{Code, Diagnostics};
use whirl_codegen::generate::{SpecFile, generate};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/messages")
}

/// The bad files, as (name without ending, text), in alphabetical order.
fn files(ending: &str) -> Vec<(String, String)> {
    let entries = fs::read_dir(folder()).expect("the folder of messages");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut files: Vec<(String, String)> = paths
        .filter(|path| path.extension().is_some_and(|found| found == ending))
        .map(|path| {
            let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
            (name, fs::read_to_string(&path).expect("a readable file"))
        })
        .collect();
    files.sort();
    files
}

/// Where a spec of this text belongs.
fn place(name: &str, text: &str) -> String {
    let kinds = [
        ("kind = \"element\"", "elements"),
        ("kind = \"form\"", "forms"),
        ("kind = \"motion\"", "motion"),
        ("kind = \"clearance\"", "motion"),
        ("kind = \"film\"", "films"),
    ];
    let folder = kinds.iter().find(|(kind, _)| text.contains(kind)).map_or("laws", |(_, f)| f);
    format!("{folder}/{name}.toml")
}

/// What is said of a bad file; columns of tables lie beside it.
fn errors(name: &str, text: &str) -> Diagnostics {
    let mut specs = vec![SpecFile { path: place(name, text), text: text.to_owned() }];
    specs.extend(
        files("csv")
            .into_iter()
            .map(|(name, text)| SpecFile { path: format!("laws/{name}.csv"), text }),
    );
    generate(&specs).expect_err("the file is bad")
}

fn code_of(name: &str) -> &str {
    name.split('-').next().expect("a code")
}

/// Compares a text with the committed one, or writes it anew.
fn compare(path: &Path, found: &str) -> Result<(), String> {
    if std::env::var_os("WHIRL_RENEW_GOLDEN").is_some() {
        fs::write(path, found).map_err(|error| format!("{}: {error}", path.display()))?;
    }
    let expected = fs::read_to_string(path).unwrap_or_default();
    if found == expected {
        return Ok(());
    }
    Err(format!("{}: expected\n{expected}\nfound\n{found}", path.display()))
}

#[test]
fn every_message_reads_as_committed() {
    let mut wrong = Vec::new();
    for (name, text) in files("toml") {
        let found = errors(&name, &text).render();
        wrong.extend(compare(&folder().join(format!("{name}.txt")), &found).err());
    }
    assert!(wrong.is_empty(), "{}\nWHIRL_RENEW_GOLDEN=1 renews them", wrong.join("\n"));
}

#[test]
fn every_code_is_raised_by_a_file_of_its_name() {
    let mut raised = BTreeSet::new();
    for (name, text) in files("toml") {
        let found = errors(&name, &text);
        let codes: BTreeSet<_> = found.iter().filter_map(|error| error.code).collect();
        assert!(codes.iter().any(|code| code.0 == code_of(&name)), "{name} raises {codes:?}");
        raised.extend(codes);
    }
    for known in Code::ALL {
        assert!(raised.contains(&known.code), "no file in messages raises {}", known.code);
    }
    let known: BTreeSet<_> = Code::ALL.iter().map(|known| known.code).collect();
    assert_eq!(raised.difference(&known).count(), 0, "{raised:?}");
    assert_eq!(known.len(), Code::ALL.len(), "a code has two meanings");
}

#[test]
fn every_text_belongs_to_a_file() {
    let (texts, specs) = (files("txt"), files("toml"));
    let names = |files: &[(String, String)]| -> Vec<String> {
        files.iter().map(|(name, _)| name.clone()).collect()
    };
    assert_eq!(names(&texts), names(&specs));
}

/// Every error has a code and a message of one line; and a place, unless it is about the whole file.
#[test]
fn every_error_says_what_and_where() {
    for (name, text) in files("toml") {
        for error in errors(&name, &text).iter() {
            assert!(error.code.is_some(), "{name}: {error}");
            assert!(!error.message.is_empty() && !error.message.contains('\n'), "{name}: {error}");
            assert!(!error.message.ends_with('.'), "{name}: {error}");
            if let Some(span) = &error.span {
                assert!(span.end <= error.source.text.len(), "{name}: {error}");
            }
        }
    }
}

#[test]
fn nothing_is_said_twice_of_one_place() {
    for (name, text) in files("toml") {
        let found = errors(&name, &text);
        let mut places = BTreeSet::new();
        for error in found.iter().filter(|error| error.span.is_some()) {
            let span = error.span.clone().expect("a place");
            let place = (error.path().to_owned(), span.start, span.end, error.message.clone());
            assert!(places.insert(place), "{name}: {error}");
        }
    }
}

/// The page of errors in the documents.
fn page() -> String {
    let mut text = "# Errors\n\n\
        Every error in a spec, a formula or a case has a permanent code, its position in the file, and usually a line on how to fix \
        it.\nAll errors of a file are reported at once, except those that only follow from another error. \
        `codegen/tests/messages` has a bad\nfile and its messages for every code.\n\n\
        | Code | What it means | How to fix it |\n|---|---|---|\n"
        .to_owned();
    for known in Code::ALL {
        let cell = |text: &str| text.replace('|', "\\|");
        let (meaning, remedy) = (cell(known.meaning), cell(known.remedy));
        text += &format!("| {} | {meaning} | {remedy} |\n", known.code);
    }
    text
}

#[test]
fn the_page_of_errors_lists_every_code() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/errors.md");
    let found = compare(&path, &page());
    assert_eq!(found, Ok(()), "WHIRL_RENEW_GOLDEN=1 renews it");
}
