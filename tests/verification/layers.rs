//! Modules of a crate point one way: no two of them name each other, not even through others.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Top modules of a crate, each with those that it names.
type Modules = BTreeMap<String, BTreeSet<String>>;

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        match path.is_dir() {
            true => files(&path, found),
            false if path.extension().is_some_and(|own| own == "rs") => found.push(path),
            false => {}
        }
    }
}

/// The text without comments, and without what follows the last unit tests begin with.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    text.lines()
        .map(|line| line.split("//").next().unwrap_or_default())
        .collect::<Vec<_>>()
        .join("\n")
}

/// Names that follow `crate::`, alone or in a list.
fn named(code: &str) -> BTreeSet<String> {
    let word = |text: &str| -> String {
        text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
    };
    let mut names = BTreeSet::new();
    for rest in code.split("crate::").skip(1) {
        match rest.strip_prefix('{') {
            // The first word of every part of the list.
            Some(list) => {
                let mut depth = 0;
                let mut start = true;
                for (place, letter) in list.char_indices() {
                    match letter {
                        '{' => depth += 1,
                        '}' if depth == 0 => break,
                        '}' => depth -= 1,
                        ',' if depth == 0 => start = true,
                        _ if start && !letter.is_whitespace() => {
                            names.insert(word(&list[place..]));
                            start = false;
                        }
                        _ => {}
                    }
                }
            }
            None => {
                names.insert(word(rest));
            }
        }
    }
    names
}

fn modules(source: &Path) -> Modules {
    let mut found = Vec::new();
    files(source, &mut found);
    let top = |path: &Path| {
        let first = path.strip_prefix(source).expect("below").components().next().expect("a name");
        first.as_os_str().to_string_lossy().trim_end_matches(".rs").to_owned()
    };
    let mut modules = Modules::new();
    for path in found.iter().filter(|path| path.file_stem().is_none_or(|stem| stem != "tests")) {
        let names = named(&code(&fs::read_to_string(path).expect("a file")));
        modules.entry(top(path)).or_default().extend(names);
    }
    modules.retain(|name, _| name != "lib" && name != "main");
    let all: BTreeSet<String> = modules.keys().cloned().collect();
    for (own, names) in &mut modules {
        names.retain(|name| all.contains(name) && name != own);
    }
    modules
}

/// Modules that are left when those are taken away, again and again, that name none of the others.
fn circles(mut modules: Modules) -> Modules {
    while let Some(free) = modules.iter().find(|(_, names)| names.is_empty()) {
        let free = free.0.clone();
        modules.remove(&free);
        modules.values_mut().for_each(|names| {
            names.remove(&free);
        });
    }
    modules
}

#[test]
fn modules_name_each_other_in_no_circle() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for (krate, some) in
        [("codegen", "expression"), ("specs", "cells"), ("solver", "dynamics"), ("cli", "run")]
    {
        let modules = modules(&root.join(krate).join("src"));
        assert!(modules.get(some).is_some_and(|names| !names.is_empty()), "{krate}: {modules:#?}");
        let left = circles(modules);
        assert!(left.is_empty(), "{krate}: {left:#?}");
    }
}

#[test]
fn a_circle_is_found() {
    let code = "use crate::b::X; // crate::d\nuse crate::{a::{Y, c}, b};\nfn f() { crate::e(); }";
    assert_eq!(named(&self::code(code)), ["a", "b", "e"].map(str::to_owned).into());
    let modules = |pairs: &[(&str, &[&str])]| -> Modules {
        let own = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
        pairs.iter().map(|(name, names)| ((*name).to_owned(), own(names))).collect()
    };
    assert!(circles(modules(&[("a", &["b", "c"]), ("b", &["c"]), ("c", &[])])).is_empty());
    let left = circles(modules(&[("a", &["b"]), ("b", &["c"]), ("c", &["b"]), ("d", &[])]));
    assert_eq!(left.keys().collect::<Vec<_>>(), ["a", "b", "c"]);
}
