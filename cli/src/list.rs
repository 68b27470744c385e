//! `whirl list`: what is built in, and what can be done with it.

use std::fmt::Write;

use whirl_specs::generated;

use crate::case::{self, embedded_cases};

/// Cases and specs by their kinds, one a line with its title.
pub(crate) fn list() -> String {
    let mut text = String::new();
    let cases = embedded_cases()
        .map(|name| (name, case::read(name).map_or(String::new(), |case| case.title)));
    section(&mut text, "Cases", cases);
    for (kind, origins) in generated::registries() {
        let heading = kind[..1].to_uppercase() + &kind[1..];
        let facts = origins.into_iter().map(|origin| (origin.name, origin.title.to_string()));
        section(&mut text, &heading, facts);
    }
    text.push_str(NEXT);
    text
}

const NEXT: &str = "
Run a case: whirl run NAME. See its machine: whirl check NAME. See a law or an element: whirl explain NAME.
Begin a case of your own with one of these: whirl new case FILE --like NAME.
";

fn section<'a>(text: &mut String, heading: &str, entries: impl Iterator<Item = (&'a str, String)>) {
    let entries: Vec<_> = entries.collect();
    let widest = entries.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
    if !text.is_empty() {
        text.push('\n');
    }
    writeln!(text, "{heading}").expect("text can be written");
    for (name, title) in entries {
        writeln!(text, "  {name:widest$}  {title}").expect("text can be written");
    }
}
