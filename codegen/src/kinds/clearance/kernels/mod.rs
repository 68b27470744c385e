//! Kernels of a clearance: its value, the weights of the rings of a bearing, and those of every kind of law.

mod functions;
mod part;
mod program;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use self::part::Kernels;
use self::program::program;
use super::ClearanceSpec;
use crate::diagnostic::{Code, Diagnostics};
use crate::emit::{Numbers, documented, identifier, operand, statements};
use crate::expression::Id;
use crate::kinds::kernel::{self, unscheduled};
use crate::schedule::{Program, Request, ScheduleError, schedule as in_stages};

impl ClearanceSpec {
    /// The module of its kernels.
    pub(crate) fn module(&self) -> Result<String, Diagnostics> {
        let refused = |error: ScheduleError| unscheduled(&self.file, &error);
        let flat = flat(self, &springs_own(self), &[(&self.clearance, self.value)]);
        let own = [
            value(self, &flat.map_err(refused)?),
            axial(self, &axial_program(self).map_err(refused)?),
            apart(self, &apart_program(self)?.map_err(refused)?),
        ];
        // Where there are more measures than the clearance.
        let measures = measures_program(self).transpose().map_err(refused)?;
        let measure = measure(self, measures.is_some());
        let coordinates = match measures.is_some() {
            true => all_coordinates(self).len(),
            false => springs_own(self).len(),
        };
        let coordinates = Literal::usize_unsuffixed(coordinates);
        let measures = measures.map(|program| measures_of(self, &program));
        let kinds = self.contacts.iter().map(|contact| {
            let (program, sums) = program(self, contact, self.derive(contact)?).map_err(refused)?;
            Ok(Kernels::new(self, contact, &program, &sums).module())
        });
        let kinds = kinds.collect::<Result<TokenStream, Diagnostics>>()?;
        let kinds = quote!(#[doc = " Kinds of laws."] pub mod contacts { #kinds });
        let functions: TokenStream =
            own.into_iter().chain(measures).chain([measure, kinds]).collect();
        let names = self.measures.iter().map(|(name, _)| name);
        let entries = self.contacts.iter().map(|contact| identifier(&contact.name));
        let about = self.about();
        let origin = about.origin(&functions);
        let name = identifier(&self.name);
        let heading = documented(&format!(
            "{}\n{} = `{}`\n",
            about.heading(),
            self.clearance,
            self.formula.text.text()
        ));
        Ok(kernel::text(quote! {
            #heading
            pub mod #name {
                use crate::{Clearance, Lane, Origin};
                #functions
                /// The entry of the registry.
                pub const ENTRY: Clearance = Clearance {
                    origin: #origin,
                    axial,
                    apart,
                    measures: &[#(#names),*],
                    coordinates: #coordinates,
                    measure,
                    contacts: &[#(contacts::#entries::ENTRY),*],
                };
            }
        }))
    }
}

/// Names and symbols of what the clearance depends on.
fn springs_own(spec: &ClearanceSpec) -> Vec<(&str, Id)> {
    let all = [&spec.spring].into_iter().chain(&spec.ring).chain([&spec.radial, &spec.constant]);
    all.map(|own| (own.name.as_str(), own.symbol)).collect()
}

/// The same for all measures.
fn all_coordinates(spec: &ClearanceSpec) -> Vec<(&str, Id)> {
    let all = std::iter::once(&spec.spring)
        .chain(&spec.ring)
        .chain([&spec.radial])
        .chain(&spec.tangential)
        .chain(&spec.bore)
        .chain(&spec.section)
        .chain(&spec.sensor)
        .chain(&spec.gear)
        .chain([&spec.constant])
        .chain(&spec.radius);
    all.map(|own| (own.name.as_str(), own.symbol)).collect()
}

/// Outputs of inputs, with the definitions by their names.
fn flat(
    spec: &ClearanceSpec,
    inputs: &[(&str, Id)],
    outputs: &[(&str, Id)],
) -> Result<Program, ScheduleError> {
    let names = spec.definitions.iter().map(|(name, id)| (*id, name.clone())).collect();
    in_stages(&mut spec.graph.clone(), &Request { names, ..Request::flat(inputs, outputs) })
}

fn axial_program(spec: &ClearanceSpec) -> Result<Program, ScheduleError> {
    let variable = (spec.axial_variable.name.as_str(), spec.axial_variable.symbol);
    let outputs = [("A_1_", spec.axial[0]), ("A_2_", spec.axial[1]), ("A_3_", spec.axial[2])];
    in_stages(&mut spec.graph.clone(), &Request::flat(&[variable], &outputs))
}

/// What is added, its derivatives by the angle and theirs.
fn apart_program(spec: &ClearanceSpec) -> Result<Result<Program, ScheduleError>, Diagnostics> {
    let (own, mut graph) = (&spec.apart, spec.graph.clone());
    let mut values = vec![own.values];
    for order in 0..2 {
        let mut slopes = [own.values[0]; 2];
        for (slope, value) in slopes.iter_mut().zip(values[order]) {
            *slope = graph.differentiate(value, own.angle.symbol).map_err(|error| {
                let text = &spec.formula.text;
                Diagnostics::from(text.error_here(Code::UNDEFINED, error.to_string()))
            })?;
        }
        values.push(slopes);
    }
    let inputs = [&own.angle, &own.distances[0], &own.distances[1]];
    let inputs = inputs.map(|own| (own.name.as_str(), own.symbol));
    let names = ["x_", "y_", "by_angle_x_", "by_angle_y_", "twice_x_", "twice_y_"];
    let outputs: Vec<(&str, Id)> = names.into_iter().zip(values.into_iter().flatten()).collect();
    Ok(in_stages(&mut graph, &Request::flat(&inputs, &outputs)))
}

fn measures_program(spec: &ClearanceSpec) -> Option<Result<Program, ScheduleError>> {
    let outputs: Vec<(&str, Id)> =
        spec.measures.iter().map(|(name, id)| (name.as_str(), *id)).collect();
    let request = Request::flat(&all_coordinates(spec), &outputs);
    (outputs.len() > 1).then(|| in_stages(&mut spec.graph.clone(), &request))
}

fn list(of: &[(&str, Id)]) -> String {
    of.iter().map(|(name, _)| *name).collect::<Vec<_>>().join(", ")
}

/// h over one lane, as the formula says it: for evaluation with dual numbers.
fn value(spec: &ClearanceSpec, program: &Program) -> TokenStream {
    let inputs = springs_own(spec);
    let names = inputs.iter().map(|(name, _)| identifier(name));
    let statements = statements(program, 0, Numbers::Lanes);
    let result = operand(program, program.outputs[0].operand, Numbers::Lanes);
    let about = documented(&format!(
        "{} (m) of {}, SI; {}.",
        spec.clearance,
        list(&inputs),
        program.total_counts()
    ));
    quote! {
        #about
        pub fn value<L: Lane>(#(#names: L),*) -> L {
            #(#statements)*
            #result
        }
    }
}

fn axial(spec: &ClearanceSpec, program: &Program) -> TokenStream {
    let variable = &spec.axial_variable.name;
    let name = identifier(variable);
    let statements = statements(program, 0, Numbers::Plain);
    let results = program.outputs.iter().map(|o| operand(program, o.operand, Numbers::Plain));
    let about = documented(&format!(
        "Weights of the left, middle and right ring at {variable} = z/L_b; {}.",
        program.total_counts()
    ));
    quote! {
        #about
        pub fn axial(#name: f64) -> [f64; 3] {
            #(#statements)*
            [#(#results),*]
        }
    }
}

fn apart(spec: &ClearanceSpec, program: &Program) -> TokenStream {
    let (angle, [x, y]) = (&spec.apart.angle.name, &spec.apart.distances);
    let names = [angle, &x.name, &y.name].map(|name| identifier(name));
    let [first, second, third] = names;
    let statements = statements(program, 0, Numbers::Plain);
    let results = program.outputs.iter().map(|o| operand(program, o.operand, Numbers::Plain));
    let results: Vec<TokenStream> = results.collect();
    let rows = results.chunks(2).map(|row| quote!([#(#row),*]));
    let about = documented(&format!(
        "What axes that are apart by ({}, {}) add to the displacements of the ring, its derivatives by {angle} and \
         theirs; {}.",
        x.name,
        y.name,
        program.total_counts()
    ));
    quote! {
        #about
        pub fn apart(#first: f64, [#second, #third]: [f64; 2]) -> [[f64; 2]; 3] {
            #(#statements)*
            [#(#rows),*]
        }
    }
}

/// All measures over one lane, as the formulas say them: for evaluation with dual numbers.
fn measures_of(spec: &ClearanceSpec, program: &Program) -> TokenStream {
    let inputs = all_coordinates(spec);
    let arguments = inputs.iter().map(|(name, _)| identifier(name));
    let count = Literal::usize_unsuffixed(program.outputs.len());
    let statements = statements(program, 0, Numbers::Lanes);
    let results = program.outputs.iter().map(|o| operand(program, o.operand, Numbers::Lanes));
    let names = spec.measures.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>().join(", ");
    let about = documented(&format!("{names} of {}, SI.", list(&inputs)));
    quote! {
        #about
        pub fn measures<L: Lane>(#(#arguments: L),*) -> [L; #count] {
            #(#statements)*
            [#(#results),*]
        }
    }
}

/// All measures at once, by the place of each coordinate.
fn measure(spec: &ClearanceSpec, further: bool) -> TokenStream {
    let (function, count) = match further {
        true => (quote!(measures), all_coordinates(spec).len()),
        false => (quote!(value), springs_own(spec).len()),
    };
    // Of all coordinates those of the clearance: what moves first, c and R last.
    let places = (0..count).map(Literal::usize_unsuffixed);
    let call = quote!(#function(#(at_[#places]),*));
    let out = match further {
        true => quote!(out_.copy_from_slice(&#call);),
        false => quote!(out_[0] = #call;),
    };
    quote! {
        /// All measures from the coordinates in the order of the spec: see [`Clearance::measure`].
        pub fn measure(at_: &[f64], out_: &mut [f64]) {
            #out
        }
    }
}
