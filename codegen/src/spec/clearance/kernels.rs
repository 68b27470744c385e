//! Kernels of a clearance and its entry in the registry.

#[path = "../../generate/clearance.rs"]
mod clearance;
#[path = "../../generate/clearance_contact.rs"]
mod clearance_contact;
#[path = "../../generate/clearance_kernels.rs"]
mod clearance_kernels;

use proc_macro2::TokenStream;

use super::ClearanceSpec;
use crate::diagnostic::Diagnostics;
use crate::spec::kernel;

/// What the files above take from here.
mod facts {
    pub(super) use crate::spec::{kernel::unscheduled, kind::About};
}

/// The kernels of one spec.
struct Kernel {
    #[expect(dead_code, reason = "the spec has its name")]
    name: String,
    module: TokenStream,
}

pub(super) fn text(spec: &ClearanceSpec) -> Result<String, Diagnostics> {
    clearance::kernel(spec).map(|kernel| kernel::text(kernel.module))
}
