//! The functions of a kind of law, each from its part of the one program.

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::part::{KernelPart, Kernels, row};
use super::program::{TABLE, entry, force, of_ring, taken};
use crate::emit::{Numbers, documented, identifier, statements};
use crate::expression::Id;
use crate::kinds::clearance::{BoreMotion, Place, RING, Taken};

impl Kernels<'_> {
    pub(super) fn module(&self) -> TokenStream {
        let name = identifier(&self.contact.name);
        let title = format!("Laws that act {}", self.contact.place.words());
        let list = |names: Vec<&str>| names.join(", ");
        let inputs = list(self.contact.inputs.iter().map(|input| input.name.as_str()).collect());
        let forces = list(self.contact.forces.iter().map(|force| force.name.as_str()).collect());
        let heading = documented(&format!("{title}: {forces} of {inputs}."));
        let functions = [self.prepare(), self.inputs(), self.force(), self.tangent(), self.entry()];
        quote! {
            #heading
            pub mod #name {
                use crate::{
                    BoreMotion, Contact, ContactPlace, ContactState, ContactTangent, ContactVariable,
                    Lane,
                };
                #(#functions)*
            }
        }
    }

    /// Fills the table from the angle of each spring.
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
        let (psi, psi_row) = (identifier(&self.spec.spring.name), row(&self.spec.spring.name));
        let statements = statements(self.program, TABLE, Numbers::Plain);
        let values = names.iter().map(|name| identifier(name));
        let about = documented(&format!(
            "Fills the rows {} from the angles of the springs; {} a spring.",
            names.join(", "),
            self.program.counts(TABLE)
        ));
        quote! {
            #about
            pub fn prepare(#psi_row: &[f64], table_: &mut [f64]) {
                let [#(#rows),*] = crate::rows_mut(#psi_row.len(), table_);
                for j_ in 0..#psi_row.len() {
                    let #psi = #psi_row[j_];
                    #(#statements)*
                    #(#rows[j_] = #values;)*
                }
            }
        }
    }

    /// What the law takes, and the measures beside that on which its forces work.
    fn inputs(&self) -> TokenStream {
        let names = taken(self.contact);
        let part = KernelPart::new(self, |name| names.iter().any(|own| own == name));
        let (before, each, about) = (part.before(), part.each(), part.about("Inputs of the law"));
        let (rows, write) = part.rows(&names);
        quote! {
            #about
            pub fn inputs(count_: usize, state_: &ContactState, out_: &mut [f64]) {
                #before
                let [#(#rows),*] = crate::strided_mut(count_, state_.stride, out_);
                for j_ in 0..count_ {
                    #each
                    #write
                }
            }
        }
    }

    /// Generalised forces.
    fn force(&self) -> TokenStream {
        let ring: Vec<String> = (0..RING).map(|i| of_ring(&force(i))).collect();
        let bore: Vec<String> = (RING..self.contact.coordinates()).map(force).collect();
        let part = KernelPart::new(self, |name| ring.iter().chain(&bore).any(|own| own == name));
        let (before, each, about) = (part.before(), part.each(), part.about("Generalised forces"));
        let (rows, write) = part.rows(&bore);
        let (start, add, after) = (part.start(), part.add(), part.after());
        let totals = ring.iter().map(|name| part.output(name));
        quote! {
            #about
            pub fn force(
                count_: usize, state_: &ContactState, forces_: &[f64],
                ring_: &mut [f64; 3], out_: &mut [f64],
            ) {
                #before
                let [#(#rows),*] = crate::strided_mut(count_, state_.stride, out_);
                #start
                for j_ in 0..count_ {
                    #each
                    #write
                    #add
                }
                #after
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
        let ring: Vec<String> = block(0..RING, 0..RING).iter().map(|name| of_ring(name)).collect();
        let blocks = [
            (quote!(ring_bore), block(0..RING, RING..size)),
            (quote!(bore_ring), block(RING..size, 0..RING)),
            (quote!(bore_bore), block(RING..size, RING..size)),
        ];
        let all: Vec<&String> =
            ring.iter().chain(blocks.iter().flat_map(|(_, names)| names)).collect();
        let part = KernelPart::new(self, |name| all.iter().any(|own| *own == name));
        let about = part.about("Derivatives B + a1·P of the generalised forces");
        let (opening, each) = (part.before(), part.each());
        let (start, add, after) = (part.start(), part.add(), part.after());
        let totals: Vec<TokenStream> = ring.iter().map(|name| part.output(name)).collect();
        let totals = totals.chunks(RING).map(|row| quote!([#(#row),*]));
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
                #after
                out_.ring_ring = [#(#totals),*];
            }
        }
    }

    fn entry(&self) -> TokenStream {
        let contact = self.contact;
        let variable = |name: &str, unit: &str, expression: Id, rate: bool| {
            let uses = |symbol: Id| self.spec.graph.depends(expression, symbol);
            let bore = contact.bore.iter().enumerate().filter(|(_, (_, own))| uses(own.symbol));
            let bore = bore.map(|(place, _)| Literal::usize_unsuffixed(place));
            let radius = self.spec.radius.as_ref().is_some_and(|own| uses(own.symbol));
            quote! {
                ContactVariable {
                    name: #name, unit: #unit, bore: &[#(#bore),*], radius: #radius, rate: #rate,
                }
            }
        };
        let inputs = contact.inputs.iter().map(|own| {
            let rate = matches!(own.taken, Taken::Rate(_));
            variable(&own.name, &own.unit, own.taken.expression(), rate)
        });
        let forces = contact.forces.iter();
        let forces = forces.map(|own| variable(&own.name, &own.unit, own.measure, false));
        let measures = contact.forces.iter().map(|own| contact.measure(own));
        let measures = measures.map(Literal::usize_unsuffixed);
        let rows = Literal::usize_unsuffixed(taken(contact).len());
        let bore = contact.bore.iter().map(|(motion, _)| match motion {
            BoreMotion::Radial => quote!(BoreMotion::Radial),
            BoreMotion::Tangential => quote!(BoreMotion::Tangential),
            BoreMotion::MeanX => quote!(BoreMotion::MeanX),
            BoreMotion::MeanY => quote!(BoreMotion::MeanY),
            BoreMotion::MeanTurn => quote!(BoreMotion::MeanTurn),
            BoreMotion::MeanZ => quote!(BoreMotion::MeanZ),
            BoreMotion::MeanTiltX => quote!(BoreMotion::MeanTiltX),
            BoreMotion::MeanTiltY => quote!(BoreMotion::MeanTiltY),
            BoreMotion::SectionTurn => quote!(BoreMotion::SectionTurn),
            BoreMotion::SectionZ => quote!(BoreMotion::SectionZ),
            BoreMotion::SectionTiltX => quote!(BoreMotion::SectionTiltX),
            BoreMotion::SectionTiltY => quote!(BoreMotion::SectionTiltY),
            BoreMotion::SeenX => quote!(BoreMotion::SeenX),
            BoreMotion::SeenY => quote!(BoreMotion::SeenY),
            BoreMotion::BaseX => quote!(BoreMotion::BaseX),
            BoreMotion::BaseY => quote!(BoreMotion::BaseY),
            BoreMotion::SecondFrame => quote!(BoreMotion::SecondFrame),
            BoreMotion::SecondTurn => quote!(BoreMotion::SecondTurn),
        });
        let name = &contact.name;
        let place = match contact.place {
            Place::Spring => quote!(ContactPlace::Spring),
            Place::Ring => quote!(ContactPlace::Ring),
            Place::Joint => quote!(ContactPlace::Joint),
        };
        let table = Literal::usize_unsuffixed(self.table.len());
        quote! {
            /// The entry of the registry.
            pub const ENTRY: Contact = Contact {
                name: #name,
                place: #place,
                inputs: &[#(#inputs),*],
                forces: &[#(#forces),*],
                rows: #rows,
                measures: &[#(#measures),*],
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
