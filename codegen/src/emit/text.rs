//! From tokens to formatted text.

use std::collections::BTreeSet;

use proc_macro2::{Literal, TokenStream, TokenTree};
use quote::quote;
use syn::parse::{ParseStream, Parser};

use super::tables;

/// Formatted Rust of a whole file. Tokens that are no Rust are a defect of the generator; the message
/// then holds what was to be formatted.
pub fn formatted(file: TokenStream) -> Result<String, String> {
    let mut taken = Vec::new();
    let file = tables::take_out(file, &mut taken);
    // The parser can give its tokens back, so that no copy of them all is made.
    let parse = |input: ParseStream| {
        let start = input.cursor();
        input.parse::<syn::File>().map_err(|error| {
            let message = format!("generated text is no Rust ({error}): {}", start.token_stream());
            syn::Error::new(error.span(), message)
        })
    };
    let put_back = |mut file: syn::File| {
        tables::put_back(&mut file.items, &mut taken.into_iter()).map(|()| file)
    };
    let file = parse.parse2(file).and_then(put_back).map_err(|error| error.to_string())?;
    Ok(prettyplease::unparse(&file))
}

/// Doc attributes, one a line of `text`; they become `///` comments before the item that follows. Signs
/// that a comment cannot hold appear as their escapes.
pub fn documented(text: &str) -> TokenStream {
    let lines = text.lines().map(|line| {
        let line = if line.is_empty() { String::new() } else { format!(" {}", printable(line)) };
        quote!(#[doc = #line])
    });
    lines.collect()
}

/// A whole number.
pub(crate) fn count(n: usize) -> Literal {
    Literal::usize_unsuffixed(n)
}

/// The identifiers in a text.
pub(crate) fn names(text: &TokenStream) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for token in text.clone() {
        match token {
            TokenTree::Ident(name) => {
                found.insert(name.to_string());
            }
            TokenTree::Group(group) => found.extend(names(&group.stream())),
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
    found
}

/// Control signs would end a comment's line or hide in it; signs that turn the direction of text would show
/// it in another order than the compiler reads it.
fn printable(line: &str) -> String {
    let hidden = |c: char| {
        c.is_control() && c != '\t'
            || matches!(c, '\u{2028}' | '\u{2029}' | '\u{200e}' | '\u{200f}' | '\u{61c}')
            || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
    };
    let mut text = String::with_capacity(line.len());
    for c in line.chars() {
        if hidden(c) { text.extend(c.escape_unicode()) } else { text.push(c) }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_comment_ends_where_its_line_ends() {
        let text = documented("a\rfn b() {}\n\u{202e}c */ /* \u{0}");
        let file = formatted(quote!(#text pub mod kernels {})).expect("Rust");
        let expected = "/// a\\u{d}fn b() {}\n/// \\u{202e}c */ /* \\u{0}\npub mod kernels {}\n";
        assert_eq!(file, expected);
    }
}
