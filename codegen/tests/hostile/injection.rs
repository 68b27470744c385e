//! A spec puts no token of its own into generated code: names through `identifier`, all else in literals
//! and comments.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use whirl_codegen::emit::identifier;
use whirl_codegen::formula;
use whirl_codegen::generate::{GeneratedFile, SpecFile, folders, generate};
use whirl_codegen::operation::Function;

use crate::corpus;

/// Words of the names that schedules make, besides those of functions.
const MADE: &[&str] = &[
    "part",
    "value",
    "inverse",
    "per",
    "below",
    "above",
    "not",
    "minus",
    "sqrt",
    "dot",
    "row",
    "wide",
    "d",
    "total",
    "columns",
    "column",
    "of",
    "weight",
    "lane",
    "transposed",
    "spring",
];

/// Macros that kernels call.
const MACROS: &[&str] = &["include", "concat", "env", "wide"];

/// Words of kernels that no spec of this repository leads to, besides the functions of lanes: operations of lanes,
/// choices of numbers, and passes over some columns of matrices.
const UNUSED: &[&str] = &[
    "powf", "lt", "le", "and", "or", "not", "select", "if", "else", "start_", "end_", "step_by",
    "COLUMNS", "min", "lanes",
];

/// Identifiers of the text that is generated from the specs of this repository.
pub(crate) struct Vocabulary {
    words: BTreeSet<String>,
    parts: BTreeSet<String>,
}

static SHARED: LazyLock<Vocabulary> = LazyLock::new(Vocabulary::read);

impl Vocabulary {
    /// Read once.
    pub(crate) fn shared() -> &'static Self {
        &SHARED
    }

    fn read() -> Self {
        let mut files = Vec::new();
        for folder in folders() {
            for (path, text) in corpus::texts(&corpus::root().join("specs").join(folder)) {
                let name = path.file_name().expect("a name").to_string_lossy().into_owned();
                files.push(SpecFile { path: format!("{folder}/{name}"), text });
            }
        }
        let generated = generate(&files).unwrap_or_else(|errors| panic!("{errors}"));
        let mut words = BTreeSet::new();
        for file in &generated {
            collect(&tokens(file), &mut words);
        }
        words.extend(UNUSED.iter().map(|word| (*word).to_owned()));
        words.extend(Function::ALL.iter().map(|function| function.lane().to_owned()));
        let mut parts: BTreeSet<String> = words.iter().flat_map(|word| parts(word)).collect();
        parts.extend(MADE.iter().map(|part| (*part).to_owned()));
        Vocabulary { words, parts }
    }
}

fn tokens(file: &GeneratedFile) -> TokenStream {
    file.text.parse().unwrap_or_else(|error| panic!("{}: {error}", file.name))
}

fn collect(tokens: &TokenStream, words: &mut BTreeSet<String>) {
    for token in tokens.clone() {
        match token {
            TokenTree::Group(group) => collect(&group.stream(), words),
            TokenTree::Ident(ident) => {
                words.insert(ident.to_string());
            }
            _ => {}
        }
    }
}

/// What a name is joined from, without the numbers that tell equal names apart.
fn parts(word: &str) -> Vec<String> {
    let word = word.strip_prefix("r#").unwrap_or(word);
    let parts = word.split('_').map(|part| part.trim_end_matches(|c: char| c.is_ascii_digit()));
    parts.filter(|part| !part.is_empty()).map(str::to_owned).collect()
}

/// The names that a spec file declares or mentions, as they may stand in code.
fn declared(text: &str) -> BTreeSet<String> {
    let mut strings = vec![text.to_owned()];
    if let Ok(table) = text.parse::<toml::Table>() {
        strings_of(&toml::Value::Table(table), &mut strings);
    }
    let mut names = BTreeSet::new();
    for string in &strings {
        names.insert(identifier(string).to_string());
        let apart =
            |c: char| !(c.is_alphanumeric() || c == '_' || ('\u{300}'..'\u{370}').contains(&c));
        for run in string.split(apart) {
            names.insert(run.to_owned());
            // Signs that are not part of a name cut it short; what is left of it is one.
            names.extend(formula::name(run).ok());
        }
    }
    names
}

fn strings_of(value: &toml::Value, strings: &mut Vec<String>) {
    match value {
        toml::Value::String(text) => strings.push(text.clone()),
        toml::Value::Array(items) => items.iter().for_each(|item| strings_of(item, strings)),
        toml::Value::Table(table) => {
            for (key, value) in table {
                strings.push(key.clone());
                strings_of(value, strings);
            }
        }
        _ => {}
    }
}

/// Checks the text that was generated from one spec file.
///
/// # Panics
/// If it is no Rust, holds another item than kernels have, or a token that neither the generator nor a
/// declared name accounts for.
pub(crate) fn check(files: &[GeneratedFile], spec: &str, vocabulary: &Vocabulary) {
    let names = declared(spec);
    let mut known = vocabulary.parts.clone();
    // Only motions with a matrix times a constant vector call it, and no shipped one is of that kind.
    known.insert("lanes".to_owned());
    known.extend(names.iter().flat_map(|name| parts(name)));
    let check = Check { vocabulary, names: &names, known };
    for file in files {
        let parsed = syn::parse_file(&file.text)
            .unwrap_or_else(|error| panic!("{} is no Rust: {error}", file.name));
        assert!(parsed.attrs.is_empty() && parsed.shebang.is_none(), "{}", file.name);
        check.items(&parsed.items);
        check.tokens(&tokens(file));
        check.comments(&file.text);
    }
}

struct Check<'a> {
    vocabulary: &'a Vocabulary,
    names: &'a BTreeSet<String>,
    known: BTreeSet<String>,
}

impl Check<'_> {
    /// Modules that hold functions, constants, statics and uses of the crate, nothing else.
    fn items(&self, items: &[syn::Item]) {
        for item in items {
            match item {
                syn::Item::Mod(module) => {
                    if let Some((_, items)) = &module.content {
                        self.items(items);
                    }
                }
                syn::Item::Fn(function) => {
                    let plain = matches!(function.sig.safety, syn::Safety::Default);
                    assert!(plain && function.sig.abi.is_none());
                }
                syn::Item::Use(import) => {
                    let syn::UseTree::Path(path) = &import.tree else { panic!("a use of no path") };
                    assert_eq!(path.ident, "crate");
                }
                syn::Item::Macro(call) => {
                    let name = call.mac.path.segments.last().expect("a name").ident.to_string();
                    assert!(MACROS.contains(&name.as_str()), "{name}!");
                }
                syn::Item::Const(_) | syn::Item::Static(_) => {}
                // The types that kernels of a law, of its measures and energy, and of films belong to, and the kernels.
                syn::Item::Enum(kernel) => {
                    let known = [
                        "Kernel",
                        "Forces",
                        "Skeleton",
                        "ForcesSkeleton",
                        "Measures",
                        "Energy",
                        "Nodal",
                        "Stored",
                        "Flow",
                        "Surface",
                    ];
                    assert!(known.iter().any(|known| kernel.ident == known), "{}", kernel.ident);
                    assert!(kernel.variants.is_empty());
                }
                syn::Item::Impl(kernel) => {
                    let (path, _) = kernel.trait_.as_ref().expect("a trait of the crate");
                    assert!(kernel.unsafety.is_none() && path.segments.len() == 1);
                    let own = &path.segments[0].ident;
                    let known = ["SpringKernel", "SkeletonKernel", "FilmKernel"];
                    assert!(known.iter().any(|known| own == known), "{own}");
                }
                _ => panic!("an item that kernels do not have"),
            }
        }
    }

    fn tokens(&self, tokens: &TokenStream) {
        let list: Vec<TokenTree> = tokens.clone().into_iter().collect();
        for (place, token) in list.iter().enumerate() {
            let next = list.get(place + 1);
            match token {
                TokenTree::Group(group) => self.tokens(&group.stream()),
                TokenTree::Ident(ident) => {
                    let word = ident.to_string();
                    let defined = place.checked_sub(1).and_then(|before| list.get(before));
                    let defined =
                        matches!(defined, Some(TokenTree::Ident(before)) if before == "fn");
                    self.word(&word);
                    match next {
                        Some(TokenTree::Punct(sign)) if sign.as_char() == '!' => {
                            let differs = matches!(
                                list.get(place + 2),
                                Some(TokenTree::Punct(sign)) if sign.as_char() == '='
                            );
                            assert!(differs || MACROS.contains(&word.as_str()), "{word}!");
                        }
                        Some(TokenTree::Group(group))
                            if group.delimiter() == Delimiter::Parenthesis && !defined =>
                        {
                            // Functions are the generator's, or called like a form of the file.
                            let fine =
                                self.vocabulary.words.contains(&word) || self.is_joined(&word);
                            assert!(fine, "{word}(…) is called");
                        }
                        _ => {}
                    }
                }
                TokenTree::Literal(literal) => {
                    let text = literal.to_string();
                    let fine =
                        text.starts_with('"') || text.starts_with(|c: char| c.is_ascii_digit());
                    assert!(fine, "a literal that kernels do not have: {text}");
                }
                TokenTree::Punct(_) => {}
            }
        }
    }

    fn word(&self, word: &str) {
        let plain = word.strip_prefix("r#").unwrap_or(word);
        assert!(plain.chars().all(|c| c.is_ascii_alphanumeric() || c == '_'), "{word}");
        let fine = self.vocabulary.words.contains(word)
            || self.names.contains(word)
            || self.is_joined(word);
        assert!(fine, "`{word}` is no name of the kernels or of the file");
    }

    /// Whether a name is joined from known ones, as `dQ_dh` and `sqrt_h2` are.
    fn is_joined(&self, word: &str) -> bool {
        parts(word).iter().all(|part| {
            self.known.contains(part)
                || part.strip_prefix('d').is_some_and(|rest| self.known.contains(rest))
                || part.strip_prefix('u').is_some_and(|code| u32::from_str_radix(code, 16).is_ok())
        })
    }

    /// Comments hold no sign that turns the direction of text, and no carriage return alone.
    fn comments(&self, text: &str) {
        let turns = |c: char| matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        assert!(!text.contains(turns), "signs that turn the direction of text");
        assert!(!text.contains('\r'), "a carriage return");
    }
}
