//! The files that the crate of the specs includes.

use std::collections::BTreeMap;

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::Kernels;
use crate::emit::identifier;
use crate::spec::kernel::text;
use crate::spec::kind::Kind;
use crate::spec::list::KINDS;

/// A file of Rust text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GeneratedFile {
    /// Name, such as `laws.rs`.
    pub name: String,
    /// The text.
    pub text: String,
}

/// One file a kind, and `kernels.rs`, which includes them and holds the registries and the tables of laws.
pub(super) fn write(kernels: &[Kernels]) -> Vec<GeneratedFile> {
    let mut kinds: Vec<&Kind> = KINDS.iter().collect();
    kinds.sort_by_key(|kind| (!kind.called, kind.folder));
    let (mut files, mut registries) = (Vec::new(), TokenStream::new());
    for kind in kinds {
        let own: Vec<_> = kernels.iter().filter(|own| own.spec.kind().name == kind.name).collect();
        let text = own.iter().map(|own| own.text.as_str()).collect();
        files.push(GeneratedFile { name: format!("{}.rs", kind.registry), text });
        registries.extend(registry(kind, &own));
    }
    let tables = kernels.iter().flat_map(|own| own.spec.tables());
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

fn registry(kind: &Kind, kernels: &[&Kernels]) -> TokenStream {
    let name = kind.registry;
    let (module, file) = (format_ident!("{name}"), format!("/{name}.rs"));
    let registry = format_ident!("{}", name.to_uppercase());
    let entry = format_ident!("{}", kind.entry);
    let (about, list) = (
        format!(" Kernels of the {name}, one module a spec."),
        format!(" All {name}, sorted by the path of the spec."),
    );
    let entries = kernels.iter().map(|kernel| {
        let name = identifier(kernel.spec.about().name);
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
