//! Kernels of a kind of law beyond Q(h, ḣ): what the law takes, where its forces go, and their tangent.
//!
//! What is fixed once a spring goes to a table, what a ring shares is computed once a ring; forces on the
//! ring are summed spring by spring.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use crate::diagnostic::Diagnostics;
use crate::emit::{Numbers, documented, identifier, operand, statements};
use crate::expression::Id;
use crate::operation::Operand;
use crate::schedule::{Input, Output, Program, Request, ScheduleError, Stage, schedule};
use crate::spec::clearance::{BoreMotion, ClearanceSpec, Contact, DerivedContact, RING};

use super::clearance_kernels::prepare;
use super::facts::unscheduled;

const TABLE: usize = 0;
const EACH_RING: usize = 1;
const EACH_SPRING: usize = 2;
/// Springs a ring that hoisting reckons with.
const SPRINGS: f64 = 24.0;

/// The modules of all kinds of laws.
pub(super) fn modules(spec: &ClearanceSpec) -> Result<TokenStream, Diagnostics> {
    let mut modules = TokenStream::new();
    for contact in &spec.contacts {
        let derived = spec.derive_contact(contact)?;
        let program = program(spec, contact, derived).map_err(|e| unscheduled(&spec.file, &e))?;
        modules.extend(Kernels::new(spec, contact, &program).module());
    }
    // Apart from what the clearance's own kernels import.
    let any = !modules.is_empty();
    if !any {
        return Ok(TokenStream::new());
    }
    Ok(quote!(#[doc = " Kinds of laws."] pub mod contacts { #modules }))
}

/// The entries of the registry.
pub(super) fn entries(spec: &ClearanceSpec) -> TokenStream {
    let modules = spec.contacts.iter().map(|contact| identifier(&contact.name));
    quote!(&[#(contacts::#modules::ENTRY),*])
}

/// All measures over one lane, as the formulas say them: for evaluation with dual numbers.
pub(super) fn measures(spec: &ClearanceSpec) -> Result<TokenStream, ScheduleError> {
    if spec.contacts.is_empty() {
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
    let program = schedule(&mut spec.contact_graph.clone(), &Request::flat(&inputs, &outputs))?;
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

fn taken(place: usize) -> String {
    format!("taken_{place}_")
}
fn force(i: usize) -> String {
    format!("force_{i}_")
}
fn entry(i: usize, k: usize) -> String {
    format!("by_{i}_{k}_")
}

/// One program that computes everything, of which each kernel takes its part.
fn program(
    spec: &ClearanceSpec,
    contact: &Contact,
    derived: DerivedContact,
) -> Result<Program, ScheduleError> {
    let DerivedContact { mut graph, rates, forces, slopes, a1, inputs, force: f, tangent } =
        derived;
    let mut takes =
        vec![Input { name: spec.spring.name.clone(), symbol: spec.spring.symbol, stage: TABLE }];
    let mut take = |name: &str, symbol: Id, stage| {
        takes.push(Input { name: name.to_owned(), symbol, stage });
    };
    let shared = spec.ring.iter().chain(&rates[..RING]).chain([&spec.constant]).chain(&spec.radius);
    shared.for_each(|own| take(&own.name, own.symbol, EACH_RING));
    take("a1_", a1, EACH_RING);
    let own = contact.bore.iter().map(|(_, own)| own).chain(&rates[RING..]);
    own.for_each(|own| take(&own.name, own.symbol, EACH_SPRING));
    let laws = forces.iter().chain(slopes.iter().flatten());
    laws.for_each(|(name, symbol)| take(name, *symbol, EACH_SPRING));

    let mut outputs = Vec::new();
    let mut give = |name, expression| outputs.push(Output { name, expression });
    inputs.iter().enumerate().for_each(|(place, id)| give(taken(place), *id));
    f.iter().enumerate().for_each(|(i, id)| give(force(i), *id));
    for (i, row) in tangent.iter().enumerate() {
        row.iter().enumerate().for_each(|(k, id)| give(entry(i, k), *id));
    }
    let stages = vec![
        Stage::new("table", &[], 1.0 / SPRINGS),
        Stage::new("ring", &[], 1.0),
        Stage::new("spring", &[TABLE, EACH_RING], SPRINGS),
    ];
    let names = spec.definitions.iter().map(|(name, id)| (*id, name.clone())).collect();
    schedule(&mut graph, &Request { stages, inputs: takes, outputs, names })
}

struct Kernels<'a> {
    spec: &'a ClearanceSpec,
    contact: &'a Contact,
    program: &'a Program,
    /// What the table holds, row by row.
    table: Vec<Operand>,
}

impl<'a> Kernels<'a> {
    fn new(spec: &'a ClearanceSpec, contact: &'a Contact, program: &'a Program) -> Self {
        let table = program.carried(TABLE, &[EACH_RING, EACH_SPRING], true);
        Kernels { spec, contact, program, table }
    }

    fn module(&self) -> TokenStream {
        let name = identifier(&self.contact.name);
        let title = match self.contact.each_spring {
            true => "Laws that act at every spring",
            false => "Laws that act once a ring",
        };
        let list = |names: Vec<&str>| names.join(", ");
        let inputs = list(self.contact.inputs.iter().map(|input| input.name.as_str()).collect());
        let forces = list(self.contact.forces.iter().map(|force| force.name.as_str()).collect());
        let heading = documented(&format!("{title}: {forces} of {inputs}."));
        let functions = [self.prepare(), self.inputs(), self.force(), self.tangent(), self.entry()];
        quote! {
            #heading
            pub mod #name {
                use crate::{
                    BoreMotion, Contact, ContactState, ContactTangent, ContactVariable, Lane,
                };
                #(#functions)*
            }
        }
    }

    fn table_names(&self) -> Vec<&str> {
        self.table.iter().filter_map(|operand| self.program.name_of(*operand)).collect()
    }

    /// Fills the table.
    fn prepare(&self) -> TokenStream {
        let names = self.table_names();
        if names.is_empty() {
            return quote! {
                /// Nothing is kept.
                pub fn prepare(_: &[f64], _: &mut [f64]) {}
            };
        }
        let rows: Vec<Ident> =
            names.iter().map(|name| format_ident!("kept_{}", row(name))).collect();
        let about = format!("Fills the rows {}.", names.join(", "));
        prepare(&self.spec.spring.name, self.program, &names, &rows, &about)
    }

    /// What the law takes.
    fn inputs(&self) -> TokenStream {
        let names: Vec<String> = (0..self.contact.inputs.len()).map(taken).collect();
        let part = Part::new(self, |name| names.iter().any(|own| own == name));
        let (opening, each, about) = (part.opening(), part.each(), part.about("Inputs of the law"));
        let (rows, write) = part.rows(&names);
        quote! {
            #about
            pub fn inputs(count_: usize, state_: &ContactState, out_: &mut [f64]) {
                #opening
                let [#(#rows),*] = crate::rows_mut(count_, out_);
                for j_ in 0..count_ {
                    #each
                    #write
                }
            }
        }
    }

    /// Generalised forces.
    fn force(&self) -> TokenStream {
        let names: Vec<String> = (0..self.contact.coordinates()).map(force).collect();
        let part = Part::new(self, |name| names.iter().any(|own| own == name));
        let (opening, each, about) =
            (part.opening(), part.each(), part.about("Generalised forces"));
        let (ring, bore) = names.split_at(RING);
        let (rows, write) = part.rows(bore);
        let (start, add, totals) = part.sums(ring);
        quote! {
            #about
            pub fn force(
                count_: usize, state_: &ContactState, forces_: &[f64],
                ring_: &mut [f64; 3], out_: &mut [f64],
            ) {
                #opening
                let [#(#rows),*] = crate::rows_mut(count_, out_);
                #start
                for j_ in 0..count_ {
                    #each
                    #write
                    #add
                }
                *ring_ = [#(#totals),*];
            }
        }
    }

    /// B + a1·P of the generalised forces.
    fn tangent(&self) -> TokenStream {
        let size = self.contact.coordinates();
        let block = |rows: std::ops::Range<usize>, columns: std::ops::Range<usize>| {
            rows.flat_map(|i| columns.clone().map(move |k| entry(i, k))).collect::<Vec<_>>()
        };
        let part = Part::new(self, |name| name.starts_with("by_"));
        let about = part.about("Derivatives B + a1·P of the generalised forces");
        let (opening, each) = (part.opening(), part.each());
        let (start, add, totals) = part.sums(&block(0..RING, 0..RING));
        let totals: Vec<TokenStream> = totals.chunks(RING).map(|row| quote!([#(#row),*])).collect();
        let blocks = [
            (quote!(ring_bore), block(0..RING, RING..size)),
            (quote!(bore_ring), block(RING..size, 0..RING)),
            (quote!(bore_bore), block(RING..size, RING..size)),
        ];
        let mut before = TokenStream::new();
        let mut write = TokenStream::new();
        for (field, names) in &blocks {
            let (rows, writes) = part.rows(names);
            before.extend(quote!(let [#(#rows),*] = crate::rows_mut(count_, &mut out_.#field);));
            write.extend(writes);
        }
        quote! {
            #about
            pub fn tangent(
                count_: usize, state_: &ContactState, forces_: &[f64], slopes_: &[f64], a1_: f64,
                out_: &mut ContactTangent,
            ) {
                #opening
                #before
                #start
                for j_ in 0..count_ {
                    #each
                    #write
                    #add
                }
                out_.ring_ring = [#(#totals),*];
            }
        }
    }

    fn entry(&self) -> TokenStream {
        let contact = self.contact;
        let variable = |name: &str, unit: &str, expression: Id| {
            let bore = contact.bore.iter().enumerate();
            let bore = bore
                .filter(|(_, (_, own))| self.spec.contact_graph.depends(expression, own.symbol));
            let bore = bore.map(|(place, _)| Literal::usize_unsuffixed(place));
            let radius = self.spec.radius.as_ref();
            let radius =
                radius.is_some_and(|own| self.spec.contact_graph.depends(expression, own.symbol));
            quote! {
                ContactVariable { name: #name, unit: #unit, bore: &[#(#bore),*], radius: #radius }
            }
        };
        let inputs = contact.inputs.iter();
        let inputs = inputs.map(|own| variable(&own.name, &own.unit, own.taken.expression()));
        let forces = contact.forces.iter().map(|own| variable(&own.name, &own.unit, own.measure));
        let bore = contact.bore.iter().map(|(motion, _)| match motion {
            BoreMotion::Radial => quote!(BoreMotion::Radial),
            BoreMotion::Tangential => quote!(BoreMotion::Tangential),
            BoreMotion::MeanX => quote!(BoreMotion::MeanX),
            BoreMotion::MeanY => quote!(BoreMotion::MeanY),
            BoreMotion::MeanTurn => quote!(BoreMotion::MeanTurn),
        });
        let (name, each_spring) = (&contact.name, contact.each_spring);
        let table = Literal::usize_unsuffixed(self.table.len());
        quote! {
            /// The entry of the registry.
            pub const ENTRY: Contact = Contact {
                name: #name,
                each_spring: #each_spring,
                inputs: &[#(#inputs),*],
                forces: &[#(#forces),*],
                bore: &[#(#bore),*],
                table: #table,
                prepare,
                evaluate: inputs,
                force,
                tangent,
            };
        }
    }
}

fn row(name: &str) -> Ident {
    format_ident!("{}_row_", identifier(name))
}

/// What one function computes.
struct Part<'a> {
    kernels: &'a Kernels<'a>,
    program: Program,
    used: Vec<String>,
}

impl<'a> Part<'a> {
    fn new(kernels: &'a Kernels<'a>, wanted: impl Fn(&str) -> bool) -> Self {
        let program = kernels.program.restricted(wanted);
        let stages = [TABLE, EACH_RING, EACH_SPRING];
        // What only fills the table is not read again.
        let later = [EACH_RING, EACH_SPRING];
        let used = stages.iter().flat_map(|stage| program.carried(*stage, &later, true));
        let used = used.filter_map(|operand| program.name_of(operand).map(str::to_owned)).collect();
        Part { kernels, program, used }
    }

    fn about(&self, what: &str) -> TokenStream {
        documented(&format!(
            "{what}.\n\nOnce a ring: {}; each spring: {}.",
            self.program.counts(EACH_RING),
            self.program.counts(EACH_SPRING)
        ))
    }

    fn uses(&self, name: &str) -> bool {
        self.used.iter().any(|own| own == name)
    }

    /// A pattern for rows of the names, those that are not used left out; nothing if none is.
    fn pattern(&self, names: &[&str], as_rows: bool) -> Option<TokenStream> {
        let any = names.iter().any(|name| self.uses(name));
        let parts = names.iter().map(|name| match (self.uses(name), as_rows) {
            (false, _) => quote!(_),
            (true, true) => {
                let row = row(name);
                quote!(#row)
            }
            (true, false) => {
                let name = identifier(name);
                quote!(#name)
            }
        });
        any.then(|| quote!([#(#parts),*]))
    }

    /// Names of the rows of springs: what they are called in the state or among the arguments.
    fn sources(&self) -> [(TokenStream, Vec<String>); 5] {
        let contact = self.kernels.contact;
        let bore: Vec<String> = contact.bore.iter().map(|(_, own)| own.name.clone()).collect();
        let bore_dot = bore.iter().map(|name| format!("{name}_dot")).collect();
        let forces: Vec<String> = contact.forces.iter().map(|own| own.name.clone()).collect();
        let slopes = contact.slopes().into_iter().flatten().collect();
        let table = self.kernels.table_names().into_iter().map(str::to_owned).collect();
        [
            (quote!(state_.table), table),
            (quote!(state_.bore), bore),
            (quote!(state_.bore_dot), bore_dot),
            (quote!(forces_), forces),
            (quote!(slopes_), slopes),
        ]
    }

    /// Rows, what a ring shares, and what follows from that.
    fn opening(&self) -> TokenStream {
        let spec = self.kernels.spec;
        let mut text = TokenStream::new();
        for (source, names) in self.sources() {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            if let Some(pattern) = self.pattern(&names, true) {
                text.extend(quote!(let #pattern = crate::rows(count_, #source);));
            }
        }
        let ring: Vec<&str> = spec.ring.iter().map(|own| own.name.as_str()).collect();
        let rates: Vec<String> = ring.iter().map(|name| format!("{name}_dot")).collect();
        let rates: Vec<&str> = rates.iter().map(String::as_str).collect();
        if let Some(pattern) = self.pattern(&ring, false) {
            text.extend(quote!(let #pattern = state_.ring.position;));
        }
        if let Some(pattern) = self.pattern(&rates, false) {
            text.extend(quote!(let #pattern = state_.ring.velocity;));
        }
        let c = &spec.constant.name;
        if self.uses(c) {
            let c = identifier(c);
            text.extend(quote!(let #c = state_.ring.c;));
        }
        if let Some(radius) = spec.radius.iter().find(|own| self.uses(&own.name)) {
            let radius = identifier(&radius.name);
            text.extend(quote!(let #radius = state_.radius;));
        }
        text.extend(statements(&self.program, EACH_RING, Numbers::Plain));
        // A kernel may need less than it is given.
        quote!(let _ = state_; #text)
    }

    /// Values of one spring.
    fn each(&self) -> TokenStream {
        let names: Vec<String> = self.sources().into_iter().flat_map(|(_, names)| names).collect();
        let reads = names.iter().filter(|name| self.uses(name)).map(|name| {
            let (value, row) = (identifier(name), row(name));
            quote!(let #value = #row[j_];)
        });
        let statements = statements(&self.program, EACH_SPRING, Numbers::Plain);
        quote!(#(#reads)* #(#statements)*)
    }

    /// Rows of outputs, and how one spring's values are written to them.
    fn rows(&self, names: &[String]) -> (Vec<Ident>, TokenStream) {
        let rows: Vec<Ident> = names.iter().map(|name| format_ident!("{name}out_")).collect();
        let values = names.iter().map(|name| self.output(name));
        let write = quote!(#(#rows[j_] = #values;)*);
        (rows, write)
    }

    /// Sums set to zero, their growth by one spring, and their names.
    fn sums(&self, names: &[String]) -> (TokenStream, TokenStream, Vec<TokenStream>) {
        let totals: Vec<Ident> = names.iter().map(|name| format_ident!("total_{name}")).collect();
        let values = names.iter().map(|name| self.output(name));
        (
            quote!(#(let mut #totals = 0.0;)*),
            quote!(#(#totals += #values;)*),
            totals.iter().map(|total| quote!(#total)).collect(),
        )
    }

    fn output(&self, name: &str) -> TokenStream {
        let found = self.program.output(name).expect("the part has this output");
        operand(&self.program, found, Numbers::Plain)
    }
}
