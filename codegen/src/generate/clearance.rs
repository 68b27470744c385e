//! Kernels of a clearance: what is fixed once a spring goes to a table, what a ring shares is computed once
//! a ring, and what a sum over springs shares is multiplied after it.

use std::collections::BTreeSet;

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::Kernel;
use super::clearance_contact;
use super::clearance_kernels::Kernels;
use super::facts::{About, unscheduled};
use crate::diagnostic::Diagnostics;
use crate::emit::{Numbers, documented, identifier, operand, statements};
use crate::expression::{Function, Graph, Id, Node, Symbol};
use crate::schedule::{Input, Output, Program, Request, ScheduleError, Stage, schedule, take_out};
use crate::spec::clearance::{ClearanceSpec, Derived, RING};

/// Once a machine, from the springs' angles.
pub(super) const TABLE: usize = 0;
/// Once a ring.
pub(super) const EACH_RING: usize = 1;
/// Once a spring.
pub(super) const EACH_SPRING: usize = 2;
/// Once a ring, after the sums over its springs.
pub(super) const AFTER_SUMS: usize = 3;

/// Springs a ring that hoisting reckons with.
const SPRINGS: f64 = 24.0;

pub(super) fn kernel(spec: &ClearanceSpec) -> Result<Kernel, Diagnostics> {
    let refused = |error: ScheduleError| unscheduled(&spec.file, &error);
    let derived = spec.derive()?;
    let (program, sums) = program(spec, derived).map_err(refused)?;
    let kernels = Kernels::new(spec, &program, &sums);
    let about = About {
        name: &spec.name,
        title: &spec.title,
        reference: &spec.reference,
        file: &spec.file,
        beside: Vec::new(),
    };
    let (value, axial) = (value(spec).map_err(refused)?, axial(spec).map_err(refused)?);
    let functions =
        [value, kernels.prepare(), kernels.clearance(), kernels.force(), kernels.tangent(), axial];
    let measures = clearance_contact::measures(spec).map_err(refused)?;
    let contacts = clearance_contact::modules(spec)?;
    let functions: TokenStream = functions.into_iter().chain([measures, contacts]).collect();
    let entries = clearance_contact::entries(spec);
    let origin = about.origin(&functions);
    let table = Literal::usize_unsuffixed(kernels.table());
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
            use crate::{Clearance, Lane, Origin, Ring, RingTangent, SpringForce};
            #functions
            /// The entry of the registry.
            pub const ENTRY: Clearance = Clearance {
                origin: #origin,
                table: #table,
                prepare,
                clearance,
                force,
                tangent,
                axial,
                contacts: #entries,
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
        names: named(&spec.definitions),
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

fn named(definitions: &[(String, Id)]) -> Vec<(Id, String)> {
    definitions.iter().map(|(name, id)| (*id, name.clone())).collect()
}

/// Outputs of the program, by name.
pub(super) fn ring_force(i: usize) -> String {
    format!("ring_force_{i}_")
}
/// Entry (i, k) of the ring's tangent.
pub(super) fn ring_ring(i: usize, k: usize) -> String {
    format!("ring_ring_{i}{k}_")
}
/// Ring force i by the spring's coordinate.
pub(super) fn ring_spring(i: usize) -> String {
    format!("ring_spring_{i}_")
}
/// The spring's force by ring coordinate i.
pub(super) fn spring_ring(i: usize) -> String {
    format!("spring_ring_{i}_")
}
/// The spring's force.
pub(super) const SPRING_FORCE: &str = "spring_force_";
/// The spring's force by its own coordinate.
pub(super) const SPRING_SPRING: &str = "spring_spring_";

/// A sum over the springs of a ring.
pub(super) struct Sum {
    /// The output that gives one spring's part.
    pub(super) part: String,
    /// The input that takes the sum.
    pub(super) total: String,
}

/// One program that computes everything, of which each kernel takes its part.
fn program(spec: &ClearanceSpec, derived: Derived) -> Result<(Program, Vec<Sum>), ScheduleError> {
    let Derived { mut graph, ring_rates, radial_rate, q, dq_dh, dq_dh_dot, a1, .. } = derived;
    let input = |name: &str, symbol: Id, stage| Input { name: name.to_string(), symbol, stage };
    let mut inputs = vec![input(&spec.spring.name, spec.spring.symbol, TABLE)];
    for coordinate in spec.ring.iter().chain(&ring_rates).chain([&spec.constant]) {
        inputs.push(input(&coordinate.name, coordinate.symbol, EACH_RING));
    }
    inputs.push(input("a1_", a1, EACH_RING));
    let own = [
        (spec.radial.name.as_str(), spec.radial.symbol),
        (radial_rate.name.as_str(), radial_rate.symbol),
        ("Q", q),
        ("dQ_dh", dq_dh),
        ("dQ_dh_dot", dq_dh_dot),
    ];
    inputs.extend(own.iter().map(|(name, symbol)| input(name, *symbol, EACH_SPRING)));

    let h_dot = format!("{}_dot", spec.clearance);
    let taken = inputs.iter().map(|input| &input.name).chain([&spec.clearance, &h_dot]);
    let taken = taken.chain(spec.definitions.iter().map(|(name, _)| name)).cloned().collect();
    let mut collected = Sums {
        taken,
        varies: own.iter().map(|(_, symbol)| *symbol).chain([spec.spring.symbol]).collect(),
        graph: &mut graph,
        sums: Vec::new(),
    };
    let output = |name: String, expression: Id| Output { name, expression };
    let mut totals = Vec::new();
    for i in 0..RING {
        totals.push(output(ring_force(i), collected.total(derived.force.ring[i])));
    }
    for i in 0..RING {
        for k in 0..RING {
            let entry = collected.total(derived.tangent.ring_ring[i][k]);
            totals.push(output(ring_ring(i, k), entry));
        }
    }
    let sums = collected.sums;

    let mut outputs =
        vec![output(spec.clearance.clone(), spec.value), output(h_dot, derived.h_dot)];
    for (sum, part, total) in &sums {
        inputs.push(input(&sum.total, *total, AFTER_SUMS));
        outputs.push(output(sum.part.clone(), *part));
    }
    outputs.extend(totals);
    outputs.push(output(SPRING_FORCE.to_string(), derived.force.radial));
    for i in 0..RING {
        outputs.push(output(ring_spring(i), derived.tangent.ring_radial[i]));
        outputs.push(output(spring_ring(i), derived.tangent.radial_ring[i]));
    }
    outputs.push(output(SPRING_SPRING.to_string(), derived.tangent.radial_radial));
    let stages = vec![
        Stage::new("table", &[], 1.0 / SPRINGS),
        Stage::new("ring", &[], 1.0),
        Stage::new("spring", &[TABLE, EACH_RING], SPRINGS),
        Stage::new("after", &[EACH_RING], 1.0),
    ];
    let mut names = named(&spec.definitions);
    for (coordinate, slope) in spec.ring.iter().zip(&derived.gradient) {
        names.push((*slope, format!("d{}_d{}", spec.clearance, coordinate.name)));
    }
    let request = Request { stages, inputs, outputs, names };
    let program = schedule(&mut graph, &request)?;
    Ok((program, sums.into_iter().map(|(sum, ..)| sum).collect()))
}

/// The sums over springs that all totals together need.
struct Sums<'a> {
    graph: &'a mut Graph,
    /// Names of other things.
    taken: BTreeSet<String>,
    varies: Vec<Id>,
    /// Each with the part of one spring and the symbol of the sum.
    sums: Vec<(Sum, Id, Id)>,
}

impl Sums<'_> {
    /// Σ of `expression` over the springs, in terms of what is summed and what all share.
    fn total(&mut self, expression: Id) -> Id {
        let mut total = self.graph.integer(0);
        for (shared, part) in take_out(self.graph, expression, &self.varies.clone()) {
            let sum = self.sum(part);
            let product = self.graph.mul(shared, sum);
            total = self.graph.add(total, product);
        }
        total
    }

    fn sum(&mut self, part: Id) -> Id {
        if let Some((.., total)) = self.sums.iter().find(|(_, known, _)| *known == part) {
            return *total;
        }
        let mut name =
            describe(self.graph, part).unwrap_or_else(|| format!("part{}", self.sums.len()));
        while [&name, &format!("total_{name}")].iter().any(|name| self.taken.contains(*name)) {
            name += "_of_spring";
        }
        let total = format!("total_{name}");
        self.taken.extend([name.clone(), total.clone()]);
        let symbol = self.graph.scalar(&total);
        self.sums.push((Sum { part: name, total }, part, symbol));
        symbol
    }
}

/// A name for a short product, such as `Q_cos_psi`.
fn describe(graph: &Graph, id: Id) -> Option<String> {
    let factor = |id: Id| match graph.node(id) {
        Node::Symbol(Symbol { name, .. }) => Some(name.clone()),
        Node::Function(function, argument) => {
            let Node::Symbol(Symbol { name, .. }) = graph.node(*argument) else { return None };
            let turns = matches!(function, Function::Sin | Function::Cos);
            turns.then(|| format!("{}_{name}", function.lane()))
        }
        _ => None,
    };
    match graph.node(id) {
        Node::Product(factors) => {
            let mut names = Vec::new();
            for (base, exponent) in factors {
                let name = factor(*base)?;
                let power = exponent.is_integer().then(|| exponent.to_integer().to_string())?;
                names.push(if power == "1" { name } else { format!("{name}_{power}") });
            }
            // Forces first.
            names.sort_by_key(|name| !name.starts_with(['Q', 'd']));
            (names.len() <= 4 && !names.iter().any(|name| name.contains('-')))
                .then(|| names.join("_"))
        }
        _ => factor(id),
    }
}
