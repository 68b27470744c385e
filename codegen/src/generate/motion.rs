//! Kernels of a motion and its entry in the registry.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::Kernel;
use super::facts::{About, unscheduled};
use crate::diagnostic::Diagnostics;
use crate::emit::{self, documented, identifier};
use crate::expression::{Shape, Symmetry};
use crate::spec::motion::{MotionSpec, Tensor};

pub(super) fn kernel(spec: &MotionSpec) -> Result<Kernel, Diagnostics> {
    let emitted = emit::motion(spec).map_err(|error| unscheduled(&spec.file, &error))?;
    let about = About {
        name: &spec.name,
        title: &spec.title,
        reference: &spec.reference,
        file: &spec.file,
    };
    let (name, functions) = (identifier(&spec.name), &emitted.functions);
    let words = Literal::usize_unsuffixed(emitted.words);
    let origin = about.origin(functions);
    let heading = documented(&about.heading());
    let tensors = spec.tensors.iter().map(tensor);
    let has_energy = spec.equations.kinetic_energy.is_some();
    let optional = |name: TokenStream| if has_energy { quote!(Some(#name)) } else { quote!(None) };
    let kinetic_energy = optional(quote!(kinetic_energy::<f64>));
    let momentum = optional(quote!(momentum::<f64>));
    let module = quote! {
        #heading
        pub mod #name {
            use crate::vector;
            use crate::{Lane, Motion, MotionState, Origin, Symmetry, Tensor, TensorShape};

            /// Length of the workspace of every kernel, for n flexible coordinates.
            pub fn workspace(n: usize) -> usize {
                #words * n
            }
            #functions
            /// The entry of the registry.
            pub const ENTRY: Motion = Motion {
                origin: #origin,
                tensors: &[#(#tensors),*],
                workspace,
                kinetic_energy: #kinetic_energy,
                momentum: #momentum,
                inertia_force: inertia_force::<f64>,
                quadratic_velocity: quadratic_velocity::<f64>,
                mass: mass::<f64>,
                pf: pf::<f64>,
                b: b::<f64>,
                p: p::<f64>,
                tangent: tangent::<f64>,
            };
        }
    };
    Ok(Kernel { name: spec.name.clone(), module })
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
