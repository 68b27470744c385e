//! The functions of a clearance, each from its part of the one program.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::clearance::{
    AFTER_SUMS, EACH_RING, EACH_SPRING, SPRING_FORCE, SPRING_SPRING, Sum, TABLE, ring_force,
    ring_ring, ring_spring, spring_ring,
};
use crate::emit::{Numbers, documented, identifier, operand, statements};
use crate::operation::Operand;
use crate::schedule::Program;
use crate::spec::clearance::{ClearanceSpec, RING};

pub(super) struct Kernels<'a> {
    spec: &'a ClearanceSpec,
    program: &'a Program,
    sums: &'a [Sum],
    /// What the table holds, row by row.
    table: Vec<Operand>,
}

impl<'a> Kernels<'a> {
    pub(super) fn new(spec: &'a ClearanceSpec, program: &'a Program, sums: &'a [Sum]) -> Self {
        let table = program.carried(TABLE, &[EACH_RING, EACH_SPRING, AFTER_SUMS], true);
        Kernels { spec, program, sums, table }
    }

    /// Rows of the table.
    pub(super) fn table(&self) -> usize {
        self.table.len()
    }

    /// Fills the table.
    pub(super) fn prepare(&self) -> TokenStream {
        let names = self.table.iter().map(|o| self.program.name_of(*o).unwrap_or_default());
        let names: Vec<&str> = names.collect();
        let rows: Vec<Ident> = names.iter().map(|name| row(name)).collect();
        let about = format!(
            "Fills the rows {} from the angles of the springs; {} a spring.",
            names.join(", "),
            self.program.counts(TABLE)
        );
        prepare(&self.spec.spring.name, self.program, &names, &rows, &about)
    }

    /// h and ḣ of every spring.
    pub(super) fn clearance(&self) -> TokenStream {
        let h = self.spec.clearance.clone();
        let h_dot = format!("{h}_dot");
        let part = Part::new(self, |name| name == h || name == h_dot);
        let (delta, delta_dot) = self.radial_rows();
        let (h_row, h_dot_row) = (out(&h), out(&h_dot));
        let (h, h_dot) = (part.output(&h), part.output(&h_dot));
        let (before, each) = (part.before(), part.each_spring());
        let inputs = part.input_rows(&[&delta, &delta_dot]);
        let about = part.about("h (m) and ḣ (m/s) of every spring");
        quote! {
            #about
            pub fn clearance(
                springs_: usize, table_: &[f64], ring_: &Ring,
                #delta: &[f64], #delta_dot: &[f64],
                #h_row: &mut [f64], #h_dot_row: &mut [f64],
            ) {
                #before
                #inputs
                let #h_row = &mut #h_row[..springs_];
                let #h_dot_row = &mut #h_dot_row[..springs_];
                for j_ in 0..springs_ {
                    #each
                    #h_row[j_] = #h;
                    #h_dot_row[j_] = #h_dot;
                }
            }
        }
    }

    /// Generalised forces.
    pub(super) fn force(&self) -> TokenStream {
        let part = Part::new(self, |name| {
            name == SPRING_FORCE || (0..RING).any(|i| name == ring_force(i))
        });
        let (delta, _) = self.radial_rows();
        let (before, each, after) = (part.before(), part.each_spring(), part.after());
        let (start, add) = part.sums();
        let inputs = part.input_rows(&[&delta, &row("Q")]);
        let spring_force = part.output(SPRING_FORCE);
        let ring_forces = (0..RING).map(|i| part.output(&ring_force(i)));
        let about = part.about("Generalised forces of the springs, N and N·m");
        quote! {
            #about
            pub fn force(
                springs_: usize, table_: &[f64], ring_: &Ring,
                #delta: &[f64], Q_row_: &[f64],
                ring_force_: &mut [f64; 3], spring_force_out_: &mut [f64],
            ) {
                #before
                #inputs
                let spring_force_out_ = &mut spring_force_out_[..springs_];
                #start
                for j_ in 0..springs_ {
                    #each
                    spring_force_out_[j_] = #spring_force;
                    #add
                }
                #after
                *ring_force_ = [#(#ring_forces),*];
            }
        }
    }

    /// B + a1·P of the generalised forces.
    pub(super) fn tangent(&self) -> TokenStream {
        let ring_ring_names: Vec<String> =
            (0..RING).flat_map(|i| (0..RING).map(move |k| ring_ring(i, k))).collect();
        let part = Part::new(self, |name| {
            name == SPRING_SPRING
                || ring_ring_names.iter().any(|entry| entry == name)
                || (0..RING).any(|i| name == ring_spring(i) || name == spring_ring(i))
        });
        let (delta, delta_dot) = self.radial_rows();
        let (before, each, after) = (part.before(), part.each_spring(), part.after());
        let (start, add) = part.sums();
        let forces = ["Q", "dQ_dh", "dQ_dh_dot"].map(row);
        let fields = ["q", "dq_dh", "dq_dh_dot"].map(|field| format_ident!("{field}"));
        let laws = forces.iter().zip(&fields).filter(|(force, _)| part.takes(force));
        let laws: Vec<TokenStream> =
            laws.map(|(force, field)| quote!(let #force = &law_.#field[..springs_];)).collect();
        let inputs = part.input_rows(&[&delta, &delta_dot]);
        let by_spring: Vec<Ident> = (0..RING).map(|i| out(&ring_spring(i))).collect();
        let by_ring: Vec<Ident> = (0..RING).map(|i| out(&spring_ring(i))).collect();
        let by_spring_values = (0..RING).map(|i| part.output(&ring_spring(i)));
        let by_ring_values = (0..RING).map(|i| part.output(&spring_ring(i)));
        let spring_spring = part.output(SPRING_SPRING);
        let entries = (0..RING).map(|i| {
            let row = (0..RING).map(|k| part.output(&ring_ring(i, k)));
            quote!([#(#row),*])
        });
        let about = part.about("Derivatives B + a1·P of the generalised forces");
        quote! {
            #about
            pub fn tangent(
                springs_: usize, table_: &[f64], ring_: &Ring,
                #delta: &[f64], #delta_dot: &[f64],
                law_: &SpringForce, a1_: f64, tangent_: &mut RingTangent,
            ) {
                #before
                #inputs
                #(#laws)*
                let [#(#by_spring),*] =
                    tangent_.ring_spring.each_mut().map(|row_| &mut row_[..springs_]);
                let [#(#by_ring),*] =
                    tangent_.spring_ring.each_mut().map(|row_| &mut row_[..springs_]);
                let spring_spring_out_ = &mut tangent_.spring_spring[..springs_];
                #start
                for j_ in 0..springs_ {
                    #each
                    #(#by_spring[j_] = #by_spring_values;)*
                    #(#by_ring[j_] = #by_ring_values;)*
                    spring_spring_out_[j_] = #spring_spring;
                    #add
                }
                #after
                tangent_.ring_ring = [#(#entries),*];
            }
        }
    }

    fn radial_rows(&self) -> (Ident, Ident) {
        let name = &self.spec.radial.name;
        (row(name), row(&format!("{name}_dot")))
    }
}

/// What a function reads of every spring.
fn row(name: &str) -> Ident {
    format_ident!("{}_row_", identifier(name))
}

/// What it writes.
fn out(name: &str) -> Ident {
    format_ident!("{}_out_", identifier(name.trim_end_matches('_')))
}

/// What one function computes.
struct Part<'a> {
    kernels: &'a Kernels<'a>,
    program: Program,
    /// The sums it needs.
    sums: Vec<&'a Sum>,
}

impl<'a> Part<'a> {
    /// The outputs that `wanted` names, with the sums that they need.
    fn new(kernels: &'a Kernels<'a>, wanted: impl Fn(&str) -> bool) -> Self {
        let totals = kernels.program.restricted(&wanted);
        let used = used_inputs(&totals);
        let sums: Vec<&Sum> = kernels.sums.iter().filter(|s| used.contains(&s.total)).collect();
        let program = kernels
            .program
            .restricted(|name| wanted(name) || sums.iter().any(|sum| sum.part == name));
        Part { kernels, program, sums }
    }

    fn about(&self, what: &str) -> TokenStream {
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

    /// Table rows, ring variables and what follows from them.
    fn before(&self) -> TokenStream {
        let spec = self.kernels.spec;
        let used = used_inputs(&self.program);
        let or_nothing = |name: &str| {
            if used.contains(&name.to_string()) {
                let name = identifier(name);
                quote!(#name)
            } else {
                quote!(_)
            }
        };
        let rate = |name: &String| format!("{name}_dot");
        let position: Vec<_> = spec.ring.iter().map(|c| or_nothing(&c.name)).collect();
        let velocity: Vec<_> = spec.ring.iter().map(|c| or_nothing(&rate(&c.name))).collect();
        let c = identifier(&spec.constant.name);
        let constant = used.contains(&spec.constant.name).then(|| quote!(let #c = ring_.c;));
        let any = |names: &[TokenStream]| names.iter().any(|name| name.to_string() != "_");
        let position = any(&position).then(|| quote!(let [#(#position),*] = ring_.position;));
        let velocity = any(&velocity).then(|| quote!(let [#(#velocity),*] = ring_.velocity;));
        let table = self.table_names();
        let rows = table.iter().map(|name| match name {
            Some(name) => {
                let row = row(name);
                quote!(#row)
            }
            None => quote!(_),
        });
        let statements = statements(&self.program, EACH_RING, Numbers::Plain);
        quote! {
            let [#(#rows),*] = crate::rows(springs_, table_);
            #position
            #velocity
            #constant
            #(#statements)*
        }
    }

    /// Names of the table's rows that this part uses.
    fn table_names(&self) -> Vec<Option<String>> {
        let used = self.program.carried(TABLE, &[EACH_RING, EACH_SPRING, AFTER_SUMS], true);
        let used: Vec<&str> = used.iter().filter_map(|o| self.program.name_of(*o)).collect();
        let name = |operand: &Operand| {
            let name = self.kernels.program.name_of(*operand)?;
            used.contains(&name).then(|| name.to_string())
        };
        self.kernels.table.iter().map(name).collect()
    }

    /// Whether the part reads the rows of an input.
    fn takes(&self, input_row: &Ident) -> bool {
        used_inputs(&self.program).iter().any(|name| row(name) == *input_row)
    }

    /// Rows of springs cut to length; those that are not read are named so that nothing is unused.
    fn input_rows(&self, rows: &[&Ident]) -> TokenStream {
        rows.iter()
            .map(|row| match self.takes(row) {
                true => quote!(let #row = &#row[..springs_];),
                false => quote!(let _ = #row;),
            })
            .collect()
    }

    /// Values of one spring.
    fn each_spring(&self) -> TokenStream {
        let table = self.table_names();
        let own = self.program.inputs.iter().filter(|input| input.stage == EACH_SPRING);
        let used = used_inputs(&self.program);
        let own = own.map(|input| input.name.clone()).filter(|name| used.contains(name));
        let reads = table.into_iter().flatten().chain(own).map(|name| {
            let (value, row) = (identifier(&name), row(&name));
            quote!(let #value = #row[j_];)
        });
        let statements = statements(&self.program, EACH_SPRING, Numbers::Plain);
        quote!(#(#reads)* #(#statements)*)
    }

    /// Sums set to zero, and their growth by one spring.
    fn sums(&self) -> (TokenStream, TokenStream) {
        let totals: Vec<Ident> = self.sums.iter().map(|sum| identifier(&sum.total)).collect();
        let parts = self.sums.iter().map(|sum| self.output(&sum.part));
        (quote!(#(let mut #totals = 0.0;)*), quote!(#(#totals += #parts;)*))
    }

    fn after(&self) -> TokenStream {
        let statements = statements(&self.program, AFTER_SUMS, Numbers::Plain);
        quote!(#(#statements)*)
    }

    fn output(&self, name: &str) -> TokenStream {
        let found = self.program.output(name).expect("the part has this output");
        operand(&self.program, found, Numbers::Plain)
    }
}

/// Names of the inputs that a program uses.
fn used_inputs(program: &Program) -> Vec<String> {
    let stages: Vec<usize> = (0..program.stages.len()).collect();
    let used = stages.iter().flat_map(|stage| program.carried(*stage, &stages, true));
    used.filter(|operand| matches!(operand, Operand::Input(_)))
        .filter_map(|operand| program.name_of(operand).map(str::to_string))
        .collect()
}

/// The function that fills the rows of a table with the values called `names`, from the angle of each spring.
pub(super) fn prepare(
    spring: &str,
    program: &Program,
    names: &[&str],
    rows: &[Ident],
    about: &str,
) -> TokenStream {
    let (psi, psi_row) = (identifier(spring), row(spring));
    let statements = statements(program, TABLE, Numbers::Plain);
    let values = names.iter().map(|name| identifier(name));
    let about = documented(about);
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
