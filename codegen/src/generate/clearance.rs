//! Kernels of a clearance: its value, the weights of the rings of a bearing, and those of every kind of law.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::Kernel;
use super::clearance_kernels;
use super::facts::{About, unscheduled};
use crate::diagnostic::Diagnostics;
use crate::emit::{Numbers, documented, identifier, operand, statements};
use crate::expression::Id;
use crate::schedule::{Request, ScheduleError, schedule};
use crate::spec::clearance::ClearanceSpec;

pub(super) fn kernel(spec: &ClearanceSpec) -> Result<Kernel, Diagnostics> {
    let refused = |error: ScheduleError| unscheduled(&spec.file, &error);
    let about = About {
        name: &spec.name,
        title: &spec.title,
        reference: &spec.reference,
        file: &spec.file,
        beside: Vec::new(),
    };
    let own = [value(spec), axial(spec), measures(spec)];
    let mut functions = TokenStream::new();
    for function in own {
        functions.extend(function.map_err(refused)?);
    }
    let mut kinds = TokenStream::new();
    for contact in &spec.contacts {
        kinds.extend(clearance_kernels::module(spec, contact)?);
    }
    functions.extend(quote!(#[doc = " Kinds of laws."] pub mod contacts { #kinds }));
    let entries = spec.contacts.iter().map(|contact| identifier(&contact.name));
    let origin = about.origin(&functions);
    let name = identifier(&spec.name);
    let heading = documented(&format!(
        "{}\n{} = `{}`\n",
        about.heading(),
        spec.clearance,
        spec.formula.text.text()
    ));
    let module = quote! {
        #heading
        pub mod #name {
            use crate::{Clearance, Lane, Origin};
            #functions
            /// The entry of the registry.
            pub const ENTRY: Clearance = Clearance {
                origin: #origin,
                axial,
                contacts: &[#(contacts::#entries::ENTRY),*],
            };
        }
    };
    Ok(Kernel { name: spec.name.clone(), module })
}

/// h over one lane, as the formula says it: for evaluation with dual numbers.
fn value(spec: &ClearanceSpec) -> Result<TokenStream, ScheduleError> {
    let coordinates: Vec<_> = [&spec.spring]
        .into_iter()
        .chain(&spec.ring)
        .chain([&spec.radial, &spec.constant])
        .collect();
    let inputs: Vec<(&str, Id)> = coordinates
        .iter()
        .map(|coordinate| (coordinate.name.as_str(), coordinate.symbol))
        .collect();
    let request = Request {
        names: spec.definitions.iter().map(|(name, id)| (*id, name.clone())).collect(),
        ..Request::flat(&inputs, &[(spec.clearance.as_str(), spec.value)])
    };
    let program = schedule(&mut spec.graph.clone(), &request)?;
    let names = coordinates.iter().map(|coordinate| identifier(&coordinate.name));
    let statements = statements(&program, 0, Numbers::Lanes);
    let result = operand(&program, program.outputs[0].operand, Numbers::Lanes);
    let about = documented(&format!(
        "{} (m) of {}, SI; {}.",
        spec.clearance,
        inputs.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", "),
        program.total_counts()
    ));
    Ok(quote! {
        #about
        pub fn value<L: Lane>(#(#names: L),*) -> L {
            #(#statements)*
            #result
        }
    })
}

fn axial(spec: &ClearanceSpec) -> Result<TokenStream, ScheduleError> {
    let variable = (spec.axial_variable.name.as_str(), spec.axial_variable.symbol);
    let outputs = [("A_1_", spec.axial[0]), ("A_2_", spec.axial[1]), ("A_3_", spec.axial[2])];
    let program = schedule(&mut spec.graph.clone(), &Request::flat(&[variable], &outputs))?;
    let name = identifier(variable.0);
    let statements = statements(&program, 0, Numbers::Plain);
    let results = program.outputs.iter().map(|o| operand(&program, o.operand, Numbers::Plain));
    let about = documented(&format!(
        "Weights of the left, middle and right ring at {} = z/L_b; {}.",
        variable.0,
        program.total_counts()
    ));
    Ok(quote! {
        #about
        pub fn axial(#name: f64) -> [f64; 3] {
            #(#statements)*
            [#(#results),*]
        }
    })
}

/// All measures over one lane, as the formulas say them: for evaluation with dual numbers.
pub(super) fn measures(spec: &ClearanceSpec) -> Result<TokenStream, ScheduleError> {
    if spec.measures.len() < 2 {
        return Ok(TokenStream::new());
    }
    let coordinates: Vec<_> = std::iter::once(&spec.spring)
        .chain(&spec.ring)
        .chain([&spec.radial])
        .chain(&spec.tangential)
        .chain(spec.bore.iter().flatten())
        .chain([&spec.constant])
        .chain(&spec.radius)
        .collect();
    let inputs: Vec<(&str, Id)> =
        coordinates.iter().map(|own| (own.name.as_str(), own.symbol)).collect();
    let outputs: Vec<(&str, Id)> =
        spec.measures.iter().map(|(name, id)| (name.as_str(), *id)).collect();
    let program = schedule(&mut spec.graph.clone(), &Request::flat(&inputs, &outputs))?;
    let arguments = coordinates.iter().map(|own| identifier(&own.name));
    let count = Literal::usize_unsuffixed(outputs.len());
    let statements = statements(&program, 0, Numbers::Lanes);
    let results = program.outputs.iter().map(|o| operand(&program, o.operand, Numbers::Lanes));
    let list = |of: &[(&str, Id)]| of.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ");
    let about = documented(&format!("{} of {}, SI.", list(&outputs), list(&inputs)));
    Ok(quote! {
        #about
        pub fn measures<L: Lane>(#(#arguments: L),*) -> [L; #count] {
            #(#statements)*
            [#(#results),*]
        }
    })
}
