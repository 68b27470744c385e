//! Identifiers: only characters that make a Rust identifier reach generated code.
//!
//! No name of a spec ends in `_` ([`crate::formula::name`]). The generator's own variables in functions that
//! hold names of specs, too, and what is made from a word that cannot be a variable, do: so neither hides the
//! other, whatever a spec calls its things.

use proc_macro2::{Ident, Span};

/// Rust's keywords of all editions, those kept for later too.
const KEYWORDS: [&str; 48] = [
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "do", "dyn",
    "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let",
    "loop", "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return",
    "static", "struct", "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use",
    "virtual", "where", "while", "yield",
];

/// Words of paths, which cannot be escaped, and what a pattern names instead of binding it: the prelude's
/// variants, and constants and structures that stand beside kernels.
const NEVER_VARIABLES: [&str; 10] =
    ["self", "Self", "super", "crate", "None", "Some", "Ok", "Err", "ENTRY", "Batch"];

/// The identifier of a spec's name. Other characters than ASCII letters, digits and underscores become
/// their code point, keywords are escaped, and a word that cannot be a variable ends in `_`.
pub fn identifier(name: &str) -> Ident {
    let mut text = String::with_capacity(name.len());
    for character in name.chars() {
        match character {
            'a'..='z' | 'A'..='Z' | '_' => text.push(character),
            '0'..='9' if !text.is_empty() => text.push(character),
            '-' if !text.is_empty() => text.push('_'),
            other => text.push_str(&format!("u{:x}_", u32::from(other))),
        }
    }
    if text.chars().all(|c| c == '_') {
        text.push_str("_name");
    }
    if NEVER_VARIABLES.contains(&text.as_str()) {
        text.push('_');
    }
    if KEYWORDS.binary_search(&text.as_str()).is_ok() {
        Ident::new_raw(&text, Span::call_site())
    } else {
        Ident::new(&text, Span::call_site())
    }
}

#[cfg(test)]
mod tests {
    use super::{KEYWORDS, identifier};

    #[test]
    fn names_become_identifiers() {
        for (name, expected) in [
            ("h_dot", "h_dot"),
            ("hu2003-linear", "hu2003_linear"),
            ("type", "r#type"),
            ("gen", "r#gen"),
            ("union", "union"),
            ("self", "self_"),
            ("None", "None_"),
            ("_", "__name"),
            ("2x", "u32_x"),
            ("", "_name"),
            ("a; panic!()", "au3b_u20_panicu21_u28_u29_"),
            ("θ", "u3b8_"),
        ] {
            assert_eq!(identifier(name).to_string(), expected);
        }
    }

    #[test]
    fn keywords_are_found() {
        assert!(KEYWORDS.is_sorted());
        for word in KEYWORDS {
            assert_eq!(identifier(word).to_string(), format!("r#{word}"));
        }
    }
}
