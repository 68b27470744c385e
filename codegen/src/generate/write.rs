//! The files that the crate of the specs includes.

use std::collections::BTreeMap;

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::modules::Module;
use crate::emit::identifier;
use crate::kinds::kernel::text;
use crate::kinds::kind::{ByKind, Kind};
use crate::kinds::list::{KINDS, Specs};

/// A file of Rust text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GeneratedFile {
    /// Name, such as `laws.rs`.
    pub name: String,
    /// The text.
    pub text: String,
}

/// One file a kind, and `kernels.rs`, which includes them and holds the registries and the tables of laws.
pub(super) fn write(specs: &Specs, modules: ByKind<Vec<Module>>) -> Vec<GeneratedFile> {
    let (mut files, mut registries) = (Vec::new(), TokenStream::new());
    for (kind, modules) in KINDS.in_order().iter().zip(modules.in_order()) {
        registries.extend(registry(kind, &modules));
        let text = modules.into_iter().map(|own| own.text).collect();
        files.push(GeneratedFile { name: format!("{}.rs", kind.registry), text });
    }
    let tables = specs.laws.iter().flat_map(|law| &law.tables).map(|table| &table.file);
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

fn registry(kind: &Kind, modules: &[Module]) -> TokenStream {
    let name = kind.registry;
    let (module, file) = (format_ident!("{name}"), format!("/{name}.rs"));
    let registry = format_ident!("{}", name.to_uppercase());
    let entry = format_ident!("{}", kind.entry);
    let (about, list) = (
        format!(" Kernels of the {name}, one module a spec."),
        format!(" All {name}, sorted by the path of the spec."),
    );
    let entries = modules.iter().map(|own| {
        let name = identifier(&own.name);
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
