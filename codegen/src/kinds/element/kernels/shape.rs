//! The shape functions of an element at any point of its cell.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::super::ElementSpec;
use crate::emit::{Numbers, documented, identifier, operand, statements};
use crate::expression::Id;
use crate::schedule::{Program, Request, ScheduleError, schedule};

/// Names of ξ, η, ζ in specs.
const COORDINATES: [&str; 3] = ["xi", "eta", "zeta"];

/// N_a, ∂N_a/∂ξ, ∂N_a/∂η and ∂N_a/∂ζ of every node.
pub(super) fn program(element: &ElementSpec) -> Result<Program, ScheduleError> {
    let mut graph = element.graph.clone();
    let inputs: Vec<(&str, Id)> = COORDINATES.into_iter().zip(element.coordinates).collect();
    let functions = element.shape.iter().enumerate();
    let outputs = functions.flat_map(|(a, own)| {
        let slopes = COORDINATES.iter().zip(own.gradient);
        let slopes = slopes.map(move |(by, slope)| (format!("N_{}_by_{by}_", a + 1), slope));
        [(format!("N_{}_", a + 1), own.value)].into_iter().chain(slopes)
    });
    let outputs: Vec<(String, Id)> = outputs.collect();
    let outputs: Vec<(&str, Id)> = outputs.iter().map(|(name, id)| (name.as_str(), *id)).collect();
    schedule(&mut graph, &Request::flat(&inputs, &outputs))
}

/// As a function.
pub(super) fn function(program: &Program) -> TokenStream {
    let statements = statements(program, 0, Numbers::Plain);
    let results = program.outputs.iter().map(|o| operand(program, o.operand, Numbers::Plain));
    let results: Vec<TokenStream> = results.collect();
    let rows = results.chunks(4).enumerate().map(|(a, row)| {
        let place = Literal::usize_unsuffixed(a);
        let (value, slopes) = (&row[0], &row[1..]);
        quote! {
            values_[#place] = #value;
            slopes_[#place] = [#(#slopes),*];
        }
    });
    let about = documented(&format!(
        "N_a and ∂N_a/∂(ξ, η, ζ) at a point of the cell; {}.",
        program.total_counts()
    ));
    // A function of few terms does not use all of them.
    let used = crate::emit::names(&quote!(#(#statements)* #(#results)*));
    let names = COORDINATES.map(|name| match used.contains(name) {
        true => {
            let name = identifier(name);
            quote!(#name)
        }
        false => quote!(_),
    });
    quote! {
        #about
        pub fn shape(at_: [f64; 3], values_: &mut [f64], slopes_: &mut [[f64; 3]]) {
            let [#(#names),*] = at_;
            #(#statements)*
            #(#rows)*
        }
    }
}
