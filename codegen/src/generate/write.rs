//! The files that the crate of the specs includes.

use std::collections::BTreeMap;

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::SpecKind;
use crate::diagnostic::Source;
use crate::emit::{formatted, identifier};

/// A file of Rust text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GeneratedFile {
    /// Name, such as `laws.rs`.
    pub name: String,
    /// The text.
    pub text: String,
}

/// One file a kind, and `kernels.rs`, which includes them and holds the registries and the tables of laws.
pub(super) fn files<'t>(
    kinds: &[SpecKind],
    tables: impl Iterator<Item = &'t Source>,
) -> Vec<GeneratedFile> {
    let text_of =
        |kind: &SpecKind| kind.kernels.iter().map(|kernel| kernel.text.as_str()).collect();
    let file_of = |kind: &SpecKind| GeneratedFile {
        name: format!("{}.rs", kind.module),
        text: text_of(kind),
    };
    let mut files: Vec<GeneratedFile> = kinds.iter().map(file_of).collect();
    let mut registries: TokenStream = kinds.iter().map(registry).collect();
    let tables: BTreeMap<String, &str> =
        tables.map(|table| (table.path.display().to_string(), table.text.as_str())).collect();
    let tables = tables.iter().map(|(path, text)| quote!((#path, #text)));
    registries.extend(quote! {
        /// Path and text of every file of columns that a law reads, sorted by path.
        pub static TABLES: &[(&str, &str)] = &[#(#tables),*];
    });
    files.push(GeneratedFile { name: "kernels.rs".to_string(), text: text(registries) });
    files
}

fn registry(kind: &SpecKind) -> TokenStream {
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

/// The text of items.
pub(super) fn text(tokens: TokenStream) -> String {
    formatted(tokens).unwrap_or_else(|message| panic!("{message}"))
}
