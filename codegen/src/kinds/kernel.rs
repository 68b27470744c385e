//! What modules of kernels have in common: facts of the registries as Rust.

use std::sync::Arc;

use proc_macro2::TokenStream;
use quote::quote;

use super::kind::About;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source};
use crate::emit::formatted;
use crate::hash::hash;
use crate::schedule::ScheduleError;

/// The text of items.
pub(crate) fn text(items: TokenStream) -> String {
    formatted(items).unwrap_or_else(|message| panic!("{message}"))
}

impl About<'_> {
    /// Heading of the module's documentation.
    pub(super) fn heading(&self) -> String {
        let title = self.title.trim_end_matches('.');
        format!("{title}.\n\nSpec: `{}`. Source: {}.\n", self.path(), self.reference)
    }

    /// An `Origin`. `kernels`: what was made from the spec; it counts for the hash, so that a change of the
    /// generator that changes a kernel changes the hash.
    pub(super) fn origin(&self, kernels: &TokenStream) -> TokenStream {
        let (name, title, reference) = (self.name, self.title, self.reference);
        let (path, text) = (self.path(), &self.file.text);
        let kernels = kernels.to_string();
        let mut texts = vec![env!("CARGO_PKG_VERSION"), &path, text, &kernels];
        texts.extend(&self.beside);
        let hash = hash(texts);
        quote! {
            Origin {
                name: #name, title: #title, source: #reference,
                spec: #path, text: #text, hash: #hash,
            }
        }
    }

    fn path(&self) -> String {
        self.file.path.display().to_string()
    }
}

/// A `Variable`.
pub(super) fn variable(name: &str, unit: &str, title: &str) -> TokenStream {
    quote!(Variable { name: #name, unit: #unit, title: #title })
}

/// An expression of a spec that cannot be scheduled.
pub(super) fn unscheduled(file: &Arc<Source>, error: &ScheduleError) -> Diagnostics {
    let code = match error {
        ScheduleError::Exceeded => Code::LIMIT,
        _ => Code::UNDEFINED,
    };
    Diagnostic::new(file, code, None, error.to_string()).into()
}
