//! Reading of spec files: every error with its place, numbers exactly.

use super::schema::needed;
use super::*;
use crate::diagnostic::Source;
use crate::rational::Rational;

/// Keys of the files below.
static SHAPE: Shape = Shape::Table(&[&[
    key("name", Shape::Text, ""),
    key("title", Shape::Text, ""),
    key("count", Shape::Count(0, 99), ""),
    key("engage", Shape::Words(&["root"]), ""),
    needed("source", Shape::Text, ""),
    key("inputs", Shape::Named(&Shape::Table(&[])), ""),
]]);
static NUMBERS: Shape = Shape::Table(&[&[
    key("a", Shape::Number, ""),
    key("b", Shape::Number, ""),
    key("c", Shape::Number, ""),
    key("d", Shape::Count(0, 99), ""),
]]);
static TEXTS: Shape = Shape::Named(&Shape::Text);

fn messages(text: &str, read: impl Fn(&Table<'_>)) -> Vec<String> {
    let source = Source::new("f.toml", text);
    let document = Document::parse(&source);
    let root = document.root(&SHAPE);
    read(&root);
    root.finish();
    let errors = document.into_result(Some(())).err().unwrap_or_default();
    errors.iter().map(ToString::to_string).collect()
}

#[test]
fn every_error_is_found_with_its_place() {
    let text = "\
name = 3
tilte = \"x\"
count = 1.5
engage = \"roof\"
[inputs]
h = 4
";
    let found = messages(text, |root| {
        assert!(root.string("name").is_none());
        assert!(root.optional_string("title").is_none());
        assert!(root.count("count").is_none());
        assert!(root.optional_word("engage").is_none());
        let inputs = root.table("inputs").unwrap();
        for name in inputs.names() {
            assert!(inputs.table(name.text()).is_none());
        }
    });
    let expected = [
        "f.toml:1:8: `name` must be a string, not a number (write for example `name = \"…\"`)",
        "f.toml:2:1: unknown key `tilte` (did you mean `title`?)",
        "f.toml:3:9: `count` must be a count such as 1 or 24",
        "f.toml:4:11: `engage` cannot be `roof` (did you mean `root`?)",
        "f.toml:6:5: `inputs.h` must be a table, not a number (write for example `h = { … }`)",
        // Declared as needed, whatever the reader asks for.
        "f.toml: `source` is missing (write `source = \"…\"`)",
    ];
    assert_eq!(found, expected);
}

#[test]
fn text_that_is_not_toml_is_reported() {
    let source = Source::new("f.toml", "a = = 3\nb = [\n");
    let document = Document::parse(&source);
    assert!(!document.is_toml());
    assert!(!document.into_result(Some(())).unwrap_err().is_empty());
}

#[test]
fn numbers_are_exact() {
    let source = Source::new("f.toml", "a = 0.035687\nb = -1_000\nc = inf\nd = 0x10\n");
    let document = Document::parse(&source);
    let root = document.root(&NUMBERS);
    let exact = Rational::new(35687, 1_000_000);
    assert_eq!(root.number("a").unwrap().0, exact);
    assert_eq!(root.number("b").unwrap().0, Rational::from(-1000));
    assert!(root.number("c").is_none());
    assert_eq!(root.count("d"), Some(16));
    root.finish();
}

#[test]
fn places_in_strings_are_places_in_the_file() {
    let source = Source::new("f.toml", "a = 'x + y'\nb = \"x\\u0020+ y\"\n");
    let document = Document::parse(&source);
    let root = document.root(&TEXTS);
    assert_eq!(root.string("a").unwrap().place(4..5), 9..10);
    assert_eq!(root.string("b").unwrap().place(4..5), 16..28);
    root.finish();
}
