//! From tokens to formatted text.

use proc_macro2::TokenStream;
use quote::quote;

/// Formatted Rust of a whole file. Tokens that are no Rust are a defect of the generator; the message
/// then holds what was to be formatted.
pub fn formatted(file: TokenStream) -> Result<String, String> {
    let text = file.to_string();
    match syn::parse2::<syn::File>(file) {
        Ok(file) => Ok(prettyplease::unparse(&file)),
        Err(error) => Err(format!("generated text is no Rust ({error}): {text}")),
    }
}

/// Doc attributes, one a line of `text`; they become `///` comments before the item that follows.
pub fn documented(text: &str) -> TokenStream {
    let lines = text.lines().map(|line| {
        let line = if line.is_empty() { String::new() } else { format!(" {line}") };
        quote!(#[doc = #line])
    });
    lines.collect()
}
