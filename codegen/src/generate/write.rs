//! The files that the crate of the specs includes.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::Kind;
use crate::emit::{formatted, identifier};

/// A file of Rust text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GeneratedFile {
    /// Name, such as `laws.rs`.
    pub name: String,
    /// The text.
    pub text: String,
}

/// One file a kind, and `kernels.rs`, which includes them and holds the registries.
pub(super) fn files(kinds: &[Kind]) -> Vec<GeneratedFile> {
    let mut files: Vec<GeneratedFile> = kinds.iter().map(kind).collect();
    let registries: TokenStream = kinds.iter().map(registry).collect();
    files.push(GeneratedFile { name: "kernels.rs".to_string(), text: text(registries) });
    files
}

fn kind(kind: &Kind) -> GeneratedFile {
    let modules = kind.kernels.iter().map(|kernel| &kernel.module);
    let text = text(quote!(#(#modules)*));
    GeneratedFile { name: format!("{}.rs", kind.module), text }
}

fn registry(kind: &Kind) -> TokenStream {
    let module = format_ident!("{}", kind.module);
    let file = format!("/{}.rs", kind.module);
    let registry = format_ident!("{}", kind.module.to_uppercase());
    let entry = format_ident!("{}", kind.entry);
    let (about, list) = (
        format!(" Kernels of the {}, one module a spec.", kind.module),
        format!(" All {}, sorted by the path of the spec.", kind.module),
    );
    let entries = kind.kernels.iter().map(|kernel| {
        let name = identifier(&kernel.name);
        quote!(#module::#name::ENTRY)
    });
    quote! {
        #[doc = #about]
        #[allow(
            non_snake_case, clippy::all,
            reason = "generated: names are those of the specs, one `let` a value"
        )]
        pub mod #module {
            include!(concat!(env!("OUT_DIR"), #file));
        }
        #[doc = #list]
        pub static #registry: &[#entry] = &[#(#entries),*];
    }
}

fn text(tokens: TokenStream) -> String {
    formatted(tokens).unwrap_or_else(|message| panic!("{message}"))
}
