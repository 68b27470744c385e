//! Kernels of a motion and its entry in the registry: loops over vectors and matrices of run-time length n.
//!
//! A kernel multiplies out what it computes, so that every output is a linear combination of
//! matrix–vector products (such as Y η), stored matrices and outer products, with scalar
//! coefficients. Each product is then computed once, all in one pass over the columns of the matrices.

mod combination;
mod form;
mod functions;
mod kernel;
mod plan;
mod product;

pub use form::{Combination, Group, Term};
pub use functions::{Planned, planned};
pub use kernel::ResultKind;
pub use plan::{AFTER, BEFORE, DotProduct, KernelPlan, MatrixProduct};

use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::{MotionSpec, Tensor};
use crate::diagnostic::Diagnostics;
use crate::emit::{documented, identifier};
use crate::expression::{Shape, Symmetry};
use crate::kinds::kernel::{text, unscheduled};

/// Kernels that a march calls again and again: their own loops, beside the sums that all share, are compiled
/// for wide registers too.
const WIDE: [&str; 2] = ["inertia_force", "tangent"];

impl MotionSpec {
    /// The module of its kernels.
    pub(crate) fn module(&self) -> Result<String, Diagnostics> {
        let planned = planned(self).map_err(|error| unscheduled(&self.file, &error))?;
        let functions: TokenStream =
            planned.iter().map(|kernel| functions::function(self, kernel)).collect();
        // Vectors of workspace: the most matrix–vector products in one kernel.
        let products = planned.iter().map(|kernel| kernel.plan.products.len()).max().unwrap_or(0);
        let products = Literal::usize_unsuffixed(products);
        let (about, name) = (self.about(), identifier(&self.name));
        let origin = about.origin(&functions);
        let heading = documented(&about.heading());
        let tensors = self.tensors.iter().map(tensor);
        let has_energy = self.equations.kinetic_energy.is_some();
        let optional =
            |name: TokenStream| if has_energy { quote!(Some(#name)) } else { quote!(None) };
        let kinetic_energy = optional(quote!(kinetic_energy::<f64>));
        let momentum = optional(quote!(momentum::<f64>));
        let wide = WIDE.map(wide_function);
        Ok(text(quote! {
            #heading
            pub mod #name {
                use crate::vector;
                use crate::wide::wide;
                use crate::{Lane, Motion, MotionState, Origin, Symmetry, Tensor, TensorShape};

                /// Length of the workspace of every kernel, for n flexible coordinates.
                pub fn workspace(n: usize) -> usize {
                    #products * n
                }
                #functions
                #(#wide)*
                /// The entry of the registry.
                pub const ENTRY: Motion = Motion {
                    origin: #origin,
                    tensors: &[#(#tensors),*],
                    workspace,
                    kinetic_energy: #kinetic_energy,
                    momentum: #momentum,
                    inertia_force: wide_inertia_force,
                    quadratic_velocity: quadratic_velocity::<f64>,
                    mass: mass::<f64>,
                    pf: pf::<f64>,
                    b: b::<f64>,
                    p: p::<f64>,
                    tangent: wide_tangent,
                };
            }
        }))
    }
}

/// The kernel over f64, for the registers that the machine has.
fn wide_function(kernel: &str) -> TokenStream {
    let (name, wide) = (format_ident!("{kernel}"), format_ident!("wide_{kernel}"));
    let newmark = (kernel == "tangent").then(|| quote!(a1: f64, a2: f64,));
    quote! {
        wide!(#name as #wide(
            tensors: &[&[f64]], state: &MotionState, #newmark
            workspace: &mut [f64], out: &mut [f64]
        ));
    }
}

fn tensor(tensor: &Tensor) -> TokenStream {
    let name = &tensor.name;
    let shape = match tensor.shape {
        Shape::Scalar | Shape::Truth => quote!(Scalar),
        Shape::Vector => quote!(Vector),
        Shape::Matrix => quote!(Matrix),
    };
    let symmetry = match tensor.symmetry {
        Symmetry::None => quote!(None),
        Symmetry::Symmetric => quote!(Symmetric),
        Symmetry::Skew => quote!(Skew),
    };
    quote!(Tensor { name: #name, shape: TensorShape::#shape, symmetry: Symmetry::#symmetry })
}
