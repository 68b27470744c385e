//! Kernels of a film: fields at nodes, what nodes hold, the residual of cells, forces and outputs; all with their slopes.

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};

use super::derive::{AtNode, Derived, at_node};
use super::prove::number;
use super::spec::{FieldKind, FilmSpec, Variable};
use crate::diagnostic::Diagnostics;
use crate::emit::{self, Numbers, documented, identifier, operand, statements};
use crate::kinds::kernel::{self, unscheduled, variable};
use crate::schedule::{Input, Output, Program, Request, Stage, schedule, schedule_as_written};

impl FilmSpec {
    /// The module of its kernels.
    pub(crate) fn module(&self) -> Result<String, Diagnostics> {
        let own = [&self.unknowns[0], &self.unknowns[1], &self.gap].map(|own| own.name.clone());
        let nodal = self.kernel("Nodal", &own, &self.nodal_program()?);
        let stored = self.kernel("Stored", &own, &self.stored_program()?);
        let (residual, surface) = (self.residual_program()?, self.surface_program()?);
        let about = self.about();
        let [flow, surface_kernel] =
            [("Flow", &residual), ("Surface", &surface)].map(|(name, (derived, program))| {
                let inputs: Vec<String> = derived
                    .fields
                    .iter()
                    .flat_map(|(_, name, nodes)| (0..nodes.len()).map(|a| at_node(name, a)))
                    .collect();
                self.kernel(name, &inputs, program)
            });
        let functions = quote!(#nodal #stored #flow #surface_kernel);
        let origin = about.origin(&functions);
        let entry = self.entry(&origin, &residual.0, &surface.0);
        let name = identifier(&self.name);
        let mut heading = about.heading();
        for term in &self.terms {
            heading += &format!("\n* `{}` = `{}`", term.name, term.formula.text.text());
        }
        let heading = documented(&heading);
        Ok(kernel::text(quote! {
            #heading
            pub mod #name {
                use crate::{
                    Film, FilmEdge, FilmField, FilmFieldKind, FilmForce, FilmKernel, FilmParameter, FilmSlope, FilmValues,
                    Lane, Origin, Variable, each_of_film,
                };
                #functions
                #entry
            }
        }))
    }

    /// The residual of a cell with its program: what is uniform, then the fields at the nodes of the cell; every value, then
    /// its slopes, then that by the speed if there is one.
    ///
    /// # Errors
    /// What cannot be differentiated or scheduled.
    pub fn residual_program(&self) -> Result<(Derived, Program), Diagnostics> {
        let derived = self.residual()?;
        let program = self.cell_program(&derived)?;
        Ok((derived, program))
    }

    /// Forces and outputs of a cell with their program: as [`FilmSpec::residual_program`].
    ///
    /// # Errors
    /// As there.
    pub fn surface_program(&self) -> Result<(Derived, Program), Diagnostics> {
        let derived = self.surface()?;
        let program = self.cell_program(&derived)?;
        Ok((derived, program))
    }

    fn uniform_inputs(&self) -> Vec<Input> {
        let uniform = self.uniform().into_iter();
        uniform.map(|(name, symbol)| Input { name: name.to_owned(), symbol, stage: 0 }).collect()
    }

    fn cell_program(&self, derived: &Derived) -> Result<Program, Diagnostics> {
        let mut inputs = self.uniform_inputs();
        for (_, name, nodes) in &derived.fields {
            for (a, symbol) in nodes.iter().enumerate() {
                inputs.push(Input { name: at_node(name, a), symbol: *symbol, stage: 0 });
            }
        }
        let mut outputs = Vec::new();
        for own in &derived.values {
            outputs.push(Output { name: own.name.clone(), expression: own.value });
            for slope in &own.slopes {
                let name = format!("{}by{}_at{}_", own.name, slope.field, slope.node);
                outputs.push(Output { name, expression: slope.slope });
            }
            if let Some(expression) = own.by_speed {
                outputs.push(Output { name: format!("{}by_speed_", own.name), expression });
            }
        }
        let request = Request {
            stages: vec![Stage::new("cell", &[], 1.0)],
            inputs,
            outputs,
            names: Vec::new(),
        };
        let program = schedule_as_written(&mut derived.graph.clone(), &request);
        program.map_err(|error| unscheduled(&self.file, &error))
    }

    /// The fields that follow at a node, each with its slopes by both unknowns and the gap; inputs are what is uniform, then
    /// these three.
    ///
    /// # Errors
    /// What cannot be differentiated or scheduled.
    pub fn nodal_program(&self) -> Result<Program, Diagnostics> {
        self.node_program(self.nodal_values()?)
    }

    /// What a node holds, with its slopes: as [`FilmSpec::nodal_program`].
    ///
    /// # Errors
    /// As there.
    pub fn stored_program(&self) -> Result<Program, Diagnostics> {
        self.node_program(self.stored_value()?)
    }

    fn node_program(&self, at: AtNode) -> Result<Program, Diagnostics> {
        let own = [&self.unknowns[0], &self.unknowns[1], &self.gap];
        let mut inputs = self.uniform_inputs();
        inputs.extend(own.map(|own| Input {
            name: own.name.clone(),
            symbol: own.symbol,
            stage: 0,
        }));
        let mut outputs = Vec::new();
        for (place, (_, values)) in at.values.iter().enumerate() {
            for (slope, expression) in values.iter().enumerate() {
                outputs.push(Output {
                    name: format!("value{place}_by{slope}_"),
                    expression: *expression,
                });
            }
        }
        let request = Request {
            stages: vec![Stage::new("node", &[], 1.0)],
            inputs,
            outputs,
            names: Vec::new(),
        };
        schedule(&mut at.graph.clone(), &request).map_err(|error| unscheduled(&self.file, &error))
    }

    /// What one node or cell computes, and the function that does so for many.
    fn kernel(&self, kernel: &str, inputs: &[String], program: &Program) -> TokenStream {
        let function = format_ident!("{}", kernel.to_lowercase());
        let kernel = format_ident!("{kernel}");
        let used = program.used_inputs();
        let pattern = |name: &str| match used.iter().any(|own| own == name) {
            true => identifier(name).to_token_stream(),
            false => quote!(_),
        };
        let uniform: Vec<TokenStream> =
            self.uniform().into_iter().map(|(name, _)| pattern(name)).collect();
        let taken: Vec<TokenStream> = inputs.iter().map(|name| pattern(name)).collect();
        let (shared, own) = (emit::count(uniform.len()), emit::count(taken.len()));
        let given = emit::count(program.outputs.len());
        let statements = statements(program, 0, Numbers::Lanes);
        let outputs =
            program.outputs.iter().map(|own| operand(program, own.operand, Numbers::Lanes));
        let about = documented(&format!("SI; {}.", program.total_counts()));
        let rows = documented("Rows of `count` values, SI: see [`crate::FilmFunction`].");
        quote! {
            enum #kernel {}

            impl FilmKernel<#shared, #own, #given> for #kernel {
                #about
                #[inline(always)]
                fn one<L: Lane>([#(#uniform),*]: [L; #shared], [#(#taken),*]: [L; #own]) -> [L; #given] {
                    #(#statements)* [#(#outputs),*]
                }
            }

            #rows
            pub fn #function(count: usize, uniform: &[f64], inputs: &[f64], offsets: &[usize], outputs: &mut [f64]) {
                each_of_film::<#kernel, #shared, #own, #given>(count, uniform, inputs, offsets, outputs);
            }
        }
    }

    fn entry(&self, origin: &TokenStream, residual: &Derived, surface: &Derived) -> TokenStream {
        let known = |own: &Variable| variable(&own.name, &own.unit, &own.title);
        let [around, along] = self.nodes.map(emit::count);
        let unknowns = self.unknowns.iter().map(known);
        let (gap, speed) = (known(&self.gap), known(&self.speed));
        let parameters = self.parameters.iter().map(|own| {
            let (name, title, unit) = (&own.name, &own.title, own.unit.text());
            let [value, per_unit] = [number(own), own.unit.factor().to_f64()].map(emit::number);
            quote!(FilmParameter { name: #name, unit: #unit, title: #title, value: #value, per_unit: #per_unit })
        });
        let nodal = self.nodal.iter().map(|own| &own.name);
        let [flow, forces] = [(residual, quote!(flow)), (surface, quote!(surface))]
            .map(|(derived, function)| values(derived, &function));
        let force = self.forces.iter().map(|own| {
            let (name, on) = (&own.name, own.on.text());
            quote!(FilmForce { name: #name, on: #on })
        });
        let outputs = self.outputs.iter().map(|own| variable(&own.name, &own.unit, &own.title));
        let edges = self.edges.iter().map(|own| {
            let (name, [first, second], out) = (&own.name, own.given, own.out);
            quote!(FilmEdge { name: #name, given: [#first, #second], out: #out })
        });
        quote! {
            /// The entry of the registry.
            pub const ENTRY: Film = Film {
                origin: #origin,
                nodes: [#around, #along],
                unknowns: [#(#unknowns),*],
                gap: #gap,
                speed: #speed,
                parameters: &[#(#parameters),*],
                nodal: &[#(#nodal),*],
                at_nodes: nodal,
                stored,
                flow: #flow,
                forces: &[#(#force),*],
                outputs: &[#(#outputs),*],
                surface: #forces,
                edges: &[#(#edges),*],
            };
        }
    }
}

/// What a kernel of cells takes and gives.
fn values(derived: &Derived, function: &TokenStream) -> TokenStream {
    let fields = derived.fields.iter().map(|(kind, name, _)| {
        let kind = match kind {
            FieldKind::Unknown(place) => {
                let place = emit::count(*place);
                quote!(FilmFieldKind::Unknown(#place))
            }
            FieldKind::Gap => quote!(FilmFieldKind::Gap),
            FieldKind::Nodal(place) => {
                let place = emit::count(*place);
                quote!(FilmFieldKind::Nodal(#place))
            }
        };
        quote!(FilmField { name: #name, kind: #kind })
    });
    // Rows: a value, then its slopes.
    let mut row = 0;
    let (mut rows, mut slopes): (Vec<Literal>, Vec<TokenStream>) = (Vec::new(), Vec::new());
    let mut by_speed = Vec::new();
    for (place, own) in derived.values.iter().enumerate() {
        rows.push(emit::count(row));
        for slope in &own.slopes {
            row += 1;
            let [row, value, field, node] = [row, place, slope.field, slope.node].map(emit::count);
            slopes.push(quote!(FilmSlope { row: #row, value: #value, field: #field, node: #node }));
        }
        row += 1;
        if own.by_speed.is_some() {
            let [row, value] = [row, place].map(emit::count);
            by_speed.push(quote!((#row, #value)));
        }
        row += usize::from(own.by_speed.is_some());
    }
    let count = emit::count(row);
    quote! {
        FilmValues { fields: &[#(#fields),*], rows: &[#(#rows),*], slopes: &[#(#slopes),*], by_speed: &[#(#by_speed),*], count: #count, evaluate: #function }
    }
}
