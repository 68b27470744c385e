//! What modules of kernels have in common: facts of the registries as Rust, and the hash that names what a kernel
//! was made from.

use std::sync::Arc;

use proc_macro2::TokenStream;
use quote::quote;

use super::kind::About;
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Source};
use crate::emit::formatted;
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
        let hash = hash(&texts);
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

/// Hash (hex) of a list of texts.
fn hash(texts: &[&str]) -> String {
    // A byte that no UTF-8 text has ends each text.
    let bytes = texts.iter().flat_map(|text| text.bytes().chain([0xff]));
    format!("{:032x}", fnv_1a(bytes))
}

/// FNV-1a, 128 bits.
fn fnv_1a(bytes: impl Iterator<Item = u8>) -> u128 {
    const START: u128 = 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d;
    const PRIME: u128 = 0x0000_0000_0100_0000_0000_0000_0000_013b;
    bytes.fold(START, |hash, byte| (hash ^ u128::from(byte)).wrapping_mul(PRIME))
}

/// An expression of a spec that cannot be scheduled.
pub(super) fn unscheduled(file: &Arc<Source>, error: &ScheduleError) -> Diagnostics {
    let code = match error {
        ScheduleError::Exceeded => Code::LIMIT,
        _ => Code::UNDEFINED,
    };
    Diagnostic::new(file, code, None, error.to_string()).into()
}

#[cfg(test)]
mod tests {
    use super::{fnv_1a, hash};

    #[test]
    fn the_hash_is_that_of_fnv_1a() {
        // The values that its authors publish (draft-eastlake-fnv).
        for (text, expected) in [
            ("", 0x6c62_272e_07bb_0142_62b8_2175_6295_c58d),
            ("a", 0xd228_cb69_6f1a_8caf_7891_2b70_4e4a_8964),
            ("foobar", 0x343e_1662_793c_64bf_6f0d_3597_ba44_6f18),
        ] {
            assert_eq!(fnv_1a(text.bytes()), expected, "{text}");
        }
    }

    #[test]
    fn a_list_of_texts_has_a_hash_of_its_own() {
        let ends = |bytes: &[u8]| format!("{:032x}", fnv_1a(bytes.iter().copied()));
        assert_eq!(hash(&["ab", "c"]), ends(b"ab\xffc\xff"));
        assert_ne!(hash(&["ab", "c"]), hash(&["a", "bc"]));
        assert_ne!(hash(&["ab"]), hash(&["ab", ""]));
    }
}
