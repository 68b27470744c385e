//! What the registry says of a set of forms: their kernels are in the modules of the elements.

use proc_macro2::TokenStream;

use super::facts::About;
use crate::spec::form::FormSpec;

/// The `Origin` of a set of forms.
pub(super) fn origin(spec: &FormSpec) -> TokenStream {
    let about = About {
        name: &spec.name,
        title: &spec.title,
        reference: &spec.reference,
        file: &spec.file,
        beside: Vec::new(),
    };
    about.origin(&TokenStream::new())
}
