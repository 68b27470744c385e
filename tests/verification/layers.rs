//! Parts of a crate point one way: in no folder do two files or folders name each other, not even through others.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// The path of a module from the root of its crate.
type Place = Vec<String>;

/// The modules of a crate, a file each.
type Modules = BTreeMap<Place, Module>;

/// What each names.
type Names<T> = BTreeMap<T, BTreeSet<T>>;

/// What the text of a module names.
#[derive(Debug, Default)]
struct Module {
    uses: Vec<Use>,
    /// Paths outside of `use`.
    paths: Vec<Vec<String>>,
    /// Words outside of `use`.
    words: BTreeSet<String>,
}

/// One name of a `use`.
#[derive(Debug)]
struct Use {
    path: Vec<String>,
    name: String,
    /// Whether others may know the name from here.
    public: bool,
}

/// The words and marks of a text, `::` as one; without comments, literals, unit tests and the scope of `pub`.
fn flat(tokens: TokenStream, into: &mut Vec<String>) {
    let mut of_test = false;
    for token in tokens {
        let last = into.last().map_or("", String::as_str);
        match token {
            TokenTree::Group(group) => {
                let inner: String = group.stream().to_string().split_whitespace().collect();
                let scope = ["crate", "super", "self"].contains(&inner.as_str())
                    || inner.starts_with("incrate::");
                match group.delimiter() {
                    Delimiter::Bracket if last == "#" && inner == "cfg(test)" => of_test = true,
                    Delimiter::Brace if of_test => of_test = false,
                    Delimiter::Parenthesis if last == "pub" && scope => {}
                    _ => {
                        into.push("{".to_owned());
                        flat(group.stream(), into);
                        into.push("}".to_owned());
                    }
                }
            }
            TokenTree::Ident(word) => into.push(word.to_string()),
            TokenTree::Punct(mark) => match mark.as_char() {
                ':' if last == ":" => *into.last_mut().expect("it is there") = "::".to_owned(),
                letter => {
                    of_test &= letter != ';';
                    into.push(letter.to_string());
                }
            },
            TokenTree::Literal(_) => into.push("0".to_owned()),
        }
    }
}

fn is_word(text: &str) -> bool {
    text.starts_with(|c: char| c.is_alphabetic() || c == '_')
}

impl Module {
    fn of(text: &str) -> Self {
        let (mut tokens, mut own) = (Vec::new(), Module::default());
        flat(text.parse().expect("Rust"), &mut tokens);
        let mut rest = tokens.as_slice();
        let mut public = false;
        while let [first, after @ ..] = rest {
            rest = match (first.as_str(), after) {
                ("use", _) => own.tree(after, &[], public),
                ("mod", [_, end, after @ ..]) if end == ";" => after,
                (word, _) if is_word(word) => {
                    let mut path = vec![first.clone()];
                    let mut after = after;
                    while let [mark, next, behind @ ..] = after
                        && mark == "::"
                        && is_word(next)
                    {
                        path.push(next.clone());
                        after = behind;
                    }
                    own.words.insert(first.clone());
                    own.paths.push(path);
                    after
                }
                _ => after,
            };
            public = first == "pub";
        }
        own
    }

    /// Notes the names of a `use`, or of a part of one, and gives what follows it.
    fn tree<'t>(&mut self, tokens: &'t [String], above: &[String], public: bool) -> &'t [String] {
        let (mut path, mut rest) = (above.to_vec(), tokens);
        let mut alias = None;
        while let [first, after @ ..] = rest {
            match first.as_str() {
                "::" => {}
                "as" => alias = after.first().cloned(),
                "{" => {
                    rest = after;
                    while let [first, ..] = rest
                        && first != "}"
                    {
                        rest = self.tree(rest, &path, public);
                        if let [mark, after @ ..] = rest
                            && mark != "}"
                        {
                            rest = after;
                        }
                    }
                    return rest.get(1..).unwrap_or_default();
                }
                "," | "}" | ";" => break,
                word if is_word(word) && alias.is_none() && word != "self" => {
                    path.push(first.clone());
                }
                "self" if path.is_empty() => path.push(first.clone()),
                _ => {}
            }
            rest = after;
        }
        if let Some(name) = alias.or_else(|| path.last().cloned()) {
            self.uses.push(Use { path, name, public });
        }
        rest
    }
}

/// Where a path in a module leads, if it stays in the crate.
fn absolute(modules: &Modules, here: &Place, path: &[String]) -> Option<Place> {
    let up = path.iter().take_while(|word| *word == "super").count();
    let (from, rest) = match path.first()?.as_str() {
        "crate" => (Place::new(), &path[1..]),
        "self" => (here.clone(), &path[1..]),
        "super" => (here[..here.len().checked_sub(up)?].to_vec(), &path[up..]),
        _ => (here.clone(), path),
    };
    let child = [from.as_slice(), &rest[..rest.len().min(1)]].concat();
    let inside = up > 0 || path[0] == "crate" || path[0] == "self" || modules.contains_key(&child);
    inside.then(|| [from.as_slice(), rest].concat())
}

/// The module that defines what a path names: names that a module only passes on are followed, each once.
fn definer(modules: &Modules, path: &[String], seen: &mut BTreeSet<Place>) -> Option<Place> {
    let length = (0..=path.len()).rev().find(|length| modules.contains_key(&path[..*length]))?;
    let (here, rest) = (path[..length].to_vec(), &path[length..]);
    let Some(name) = rest.first().filter(|_| seen.insert(path[..=length].to_vec())) else {
        return Some(here);
    };
    let passed = modules[&here].uses.iter().filter(|own| own.name == *name).find_map(|own| {
        let whole = [absolute(modules, &here, &own.path)?.as_slice(), &rest[1..]].concat();
        definer(modules, &whole, seen)
    });
    passed.or(Some(here))
}

/// The modules that each names. To pass on a name is no use of it.
fn named(modules: &Modules) -> Names<Place> {
    let of = |here: &Place, own: &Module| -> BTreeSet<Place> {
        let used =
            own.uses.iter().filter(|own_use| !own_use.public || own.words.contains(&own_use.name));
        let several = own.paths.iter().filter(|path| path.len() > 1);
        let paths = used.map(|own| &own.path).chain(several);
        let found = paths.filter_map(|path| {
            definer(modules, &absolute(modules, here, path)?, &mut BTreeSet::new())
        });
        found.filter(|other| other != here).collect()
    };
    modules.iter().map(|(here, own)| (here.clone(), of(here, own))).collect()
}

/// The parts of a folder, with those that they name.
fn parts(named: &Names<Place>, folder: &[String]) -> Names<String> {
    let part = |place: &Place| match place.strip_prefix(folder)? {
        [] => Some(".".to_owned()),
        [first, ..] => Some(first.clone()),
    };
    let mut parts = Names::new();
    for (place, others) in named {
        let Some(own) = part(place) else { continue };
        let others = others.iter().filter_map(part).filter(|other| *other != own);
        parts.entry(own.clone()).or_insert_with(BTreeSet::new).extend(others);
    }
    parts
}

/// Parts that reach one another.
fn circles(parts: &Names<String>) -> BTreeSet<BTreeSet<String>> {
    let reached = |start: &String| {
        let (mut reached, mut open) = (BTreeSet::new(), vec![start]);
        while let Some(own) = open.pop() {
            open.extend(parts[own].iter().filter(|other| reached.insert((*other).clone())));
        }
        reached
    };
    let all: Names<String> = parts.keys().map(|own| (own.clone(), reached(own))).collect();
    let circle = |own: &String| -> BTreeSet<String> {
        all[own].iter().filter(|other| all[*other].contains(own)).cloned().collect()
    };
    parts.keys().map(circle).filter(|circle| !circle.is_empty()).collect()
}

/// The circles of a crate, their parts in a row, of which `.` is the `mod.rs` of the folder, with the folders in which they stand.
fn circles_of(modules: &Modules) -> Vec<(String, String)> {
    let named = named(modules);
    let folders: BTreeSet<&[String]> =
        modules.keys().flat_map(|place| (0..place.len()).map(|length| &place[..length])).collect();
    let of = |folder: &&[String]| {
        let found = circles(&parts(&named, folder)).into_iter();
        let row = |circle: BTreeSet<String>| circle.into_iter().collect::<Vec<_>>().join(" ");
        found.map(|circle| (folder.join("/"), row(circle))).collect::<Vec<_>>()
    };
    folders.iter().flat_map(of).collect()
}

/// The modules in a folder of sources, unit tests left out.
fn read(folder: &Path, place: &Place, into: &mut Modules) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let stem = path.file_stem().expect("a name").to_string_lossy().into_owned();
        let inner = [place.as_slice(), std::slice::from_ref(&stem)].concat();
        if stem == "tests" {
            continue;
        }
        if path.is_dir() {
            read(&path, &inner, into);
        } else if path.extension().is_some_and(|own| own == "rs") && stem != "main" {
            let own = ["mod", "lib"].contains(&stem.as_str());
            let module = Module::of(&fs::read_to_string(&path).expect("a file"));
            into.insert(if own { place.clone() } else { inner }, module);
        }
    }
}

#[test]
fn modules_name_each_other_in_no_circle() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let mut found = Vec::new();
    for krate in ["cli", "codegen", "solver", "specs"] {
        let mut modules = Modules::new();
        read(&root.join(krate).join("src"), &Place::new(), &mut modules);
        let names: usize = named(&modules).values().map(BTreeSet::len).sum();
        assert!(names > modules.len(), "{krate}: {names} names of {} modules", modules.len());
        found.extend(circles_of(&modules).into_iter().map(|(folder, circle)| {
            let folder = format!("{krate}/src/{folder}");
            format!("{}: {circle}", folder.trim_end_matches('/'))
        }));
    }
    assert!(found.is_empty(), "circles, to be broken:\n{}", found.join("\n"));
}

#[test]
fn a_circle_is_found() {
    let circles = |files: &[(&str, &str)]| -> Vec<(String, String)> {
        let place =
            |path: &str| path.split('/').filter(|w| !w.is_empty()).map(str::to_owned).collect();
        circles_of(&files.iter().map(|(path, text)| (place(path), Module::of(text))).collect())
    };
    let found = |files: &[(&str, &str)], folder: &str, circle: &str| {
        assert_eq!(circles(files), [(folder.to_owned(), circle.to_owned())]);
    };
    let (root, none) = (("", "pub mod a; mod b; mod c;"), ("c", ""));
    // A list of a `use`, and a path in the text; through a third; of files in different folders.
    found(
        &[root, ("a", "use crate::{b::{X, Y}, c};"), ("b", "fn f() { crate::a::g(); }"), none],
        "",
        "a b",
    );
    let through =
        [root, ("a", "use super::b::X;"), ("b", "use super::c as d;"), ("c", "use crate::a;")];
    found(&through, "", "a b c");
    let deep =
        [root, ("a", ""), ("a/x", "use crate::b::y::Z;"), ("b", ""), ("b/y", "use crate::a::x;")];
    found(&deep, "", "a b");
    // What a module passes on is not its own; what it defines is.
    let passed =
        [root, ("a", "mod x; mod y; pub use x::X;"), ("a/x", ""), ("a/y", "use super::X;")];
    assert!(circles(&passed).is_empty());
    let own = [root, ("a", "mod x; pub struct A; fn f() { x::g(); }"), ("a/x", "use super::A;")];
    found(&own, "a", ". x");
    let both = [root, ("a", "mod x; pub use x::X; struct A(X);"), ("a/x", "use super::A;")];
    found(&both, "a", ". x");
    // Neither comments, texts, scopes nor unit tests name anything.
    let quiet = "// crate::a\n/// crate::a\npub(in crate::a) const B: &str = \"crate::a\";\n\
                 #[cfg(test)]\nmod tests { use crate::a; }\n#[cfg(test)] mod more;";
    assert!(circles(&[root, ("a", "use crate::b::B;"), ("b", quiet), none]).is_empty());
}
