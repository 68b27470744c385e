//! Identifiers: only characters that make a Rust identifier reach generated code.

use proc_macro2::{Ident, Span};

/// The identifier of a spec's name. Other characters than ASCII letters, digits and underscores become
/// their code point, keywords are escaped.
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
    if text.chars().all(|c| c == '_')
        || matches!(text.as_str(), "self" | "Self" | "super" | "crate")
    {
        text.push_str("_name");
    }
    if is_keyword(&text) {
        Ident::new_raw(&text, Span::call_site())
    } else {
        Ident::new(&text, Span::call_site())
    }
}

/// Whether a text of letters, digits and underscores is a word of Rust: none is long or has other signs than
/// letters, so that few texts are parsed.
fn is_keyword(text: &str) -> bool {
    let could_be = text.len() <= "continue".len() && text.bytes().all(|b| b.is_ascii_lowercase());
    could_be && syn::parse_str::<Ident>(text).is_err()
}

#[cfg(test)]
mod tests {
    use super::identifier;

    #[test]
    fn names_become_identifiers() {
        for (name, expected) in [
            ("h_dot", "h_dot"),
            ("hu2003-linear", "hu2003_linear"),
            ("type", "r#type"),
            ("self", "self_name"),
            ("_", "__name"),
            ("2x", "u32_x"),
            ("", "_name"),
            ("a; panic!()", "au3b_u20_panicu21_u28_u29_"),
            ("θ", "u3b8_"),
        ] {
            assert_eq!(identifier(name).to_string(), expected);
        }
    }
}
