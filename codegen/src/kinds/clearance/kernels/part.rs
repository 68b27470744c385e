//! What one function of a kind of law computes: its part of the program, as text.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::program::{AFTER_SUMS, EACH_RING, EACH_SPRING, Sum, TABLE};
use crate::emit::{Numbers, documented, identifier, operand, statements};
use crate::kinds::clearance::{ClearanceSpec, Contact};
use crate::operation::Operand;
use crate::schedule::Program;

/// The kernels of a kind of law.
pub(super) struct Kernels<'a> {
    pub(super) spec: &'a ClearanceSpec,
    pub(super) contact: &'a Contact,
    pub(super) program: &'a Program,
    pub(super) sums: &'a [Sum],
    /// What the table holds, row by row.
    pub(super) table: Vec<Operand>,
}

impl<'a> Kernels<'a> {
    pub(super) fn new(
        spec: &'a ClearanceSpec,
        contact: &'a Contact,
        program: &'a Program,
        sums: &'a [Sum],
    ) -> Self {
        let table = program.carried(TABLE, &[EACH_RING, EACH_SPRING, AFTER_SUMS], true);
        Kernels { spec, contact, program, sums, table }
    }

    pub(super) fn table_names(&self) -> Vec<&str> {
        self.table.iter().filter_map(|operand| self.program.name_of(*operand)).collect()
    }
}

/// What a function reads of every spring.
pub(super) fn row(name: &str) -> Ident {
    format_ident!("{}_row_", identifier(name))
}

/// The outputs that one function gives, with the sums that they need.
pub(super) struct KernelPart<'a> {
    kernels: &'a Kernels<'a>,
    program: Program,
    /// Inputs, and values of the table, that it uses.
    used: Vec<String>,
    sums: Vec<&'a Sum>,
}

impl<'a> KernelPart<'a> {
    pub(super) fn new(kernels: &'a Kernels<'a>, wanted: impl Fn(&str) -> bool) -> Self {
        let used = kernels.program.restricted(&wanted).used_inputs();
        let sums: Vec<&Sum> = kernels.sums.iter().filter(|s| used.contains(&s.total)).collect();
        let program = kernels
            .program
            .restricted(|name| wanted(name) || sums.iter().any(|sum| sum.part == name));
        let mut used = program.used_inputs();
        // What only fills the table is not read again.
        let kept = program.carried(TABLE, &[EACH_RING, EACH_SPRING, AFTER_SUMS], true);
        let kept: Vec<String> =
            kept.iter().filter_map(|o| program.name_of(*o).map(str::to_owned)).collect();
        used.retain(|name| *name != kernels.spec.spring.name);
        used.extend(kept);
        KernelPart { kernels, program, used, sums }
    }

    pub(super) fn about(&self, what: &str) -> TokenStream {
        let mut text = format!(
            "{what}.\n\nOnce a ring: {}; each spring: {}",
            self.program.counts(EACH_RING),
            self.program.counts(EACH_SPRING)
        );
        if !self.sums.is_empty() {
            let count = self.sums.len();
            let after = self.program.counts(AFTER_SUMS);
            text += &format!(", {count} add into sums; after the springs: {after}");
        }
        documented(&format!("{text}."))
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
    pub(super) fn before(&self) -> TokenStream {
        let spec = self.kernels.spec;
        let mut text = TokenStream::new();
        for (source, names) in self.sources() {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            if let Some(pattern) = self.pattern(&names, true) {
                text.extend(quote!(let #pattern = crate::strided(count_, state_.stride, #source);));
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
    pub(super) fn each(&self) -> TokenStream {
        let names: Vec<String> = self.sources().into_iter().flat_map(|(_, names)| names).collect();
        let reads = names.iter().filter(|name| self.uses(name)).map(|name| {
            let (value, row) = (identifier(name), row(name));
            quote!(let #value = #row[j_];)
        });
        let statements = statements(&self.program, EACH_SPRING, Numbers::Plain);
        quote!(#(#reads)* #(#statements)*)
    }

    /// Rows of outputs, and how one spring's values are written to them.
    pub(super) fn rows(&self, names: &[String]) -> (Vec<Ident>, TokenStream) {
        let rows: Vec<Ident> = names.iter().map(|name| format_ident!("{name}out_")).collect();
        let values = names.iter().map(|name| self.output(name));
        let write = quote!(#(#rows[j_] = #values;)*);
        (rows, write)
    }

    /// Sums set to zero.
    pub(super) fn start(&self) -> TokenStream {
        let totals = self.sums.iter().map(|sum| identifier(&sum.total));
        quote!(#(let mut #totals = 0.0;)*)
    }

    /// Their growth by one spring.
    pub(super) fn add(&self) -> TokenStream {
        let totals = self.sums.iter().map(|sum| identifier(&sum.total));
        let parts = self.sums.iter().map(|sum| self.output(&sum.part));
        quote!(#(#totals += #parts;)*)
    }

    /// What follows from the sums.
    pub(super) fn after(&self) -> TokenStream {
        let statements = statements(&self.program, AFTER_SUMS, Numbers::Plain);
        quote!(#(#statements)*)
    }

    pub(super) fn output(&self, name: &str) -> TokenStream {
        let found = self.program.output(name).expect("the part has this output");
        operand(&self.program, found, Numbers::Plain)
    }
}
