//! What a kernel of a form computes apart from loops: coefficients of the material and components of a
//! pair of basis functions.

use std::collections::{BTreeMap, BTreeSet};

use num_traits::One;
use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::{Numbers, identifier, operand, statements};
use crate::expression::{Graph, Id, Rational};
use crate::schedule::{Input, Output, Program, Request, ScheduleError, Stage, schedule};
use crate::spec::form::{Form, FormSpec, Structure};

/// Once a cell.
pub(in crate::spec) const MATERIAL: usize = 0;
/// Once a pair of basis functions.
pub(in crate::spec) const PAIR: usize = 1;

/// The components of a pair of basis functions over the sums of their products at the points,
/// s_xy = Σ_q w det J ∂N_a/∂x ∂N_b/∂y and the like.
pub(crate) struct Pairs {
    /// The products that occur: parts (N, ∂x, ∂y, ∂z) of test and trial function.
    pub(in crate::spec) moments: Vec<(usize, usize)>,
    /// Names of the properties of the material, in the order of the kernel.
    pub(in crate::spec) material: Vec<String>,
    /// The coefficients that occur, from the material; outputs by name.
    pub(in crate::spec) coefficients: Program,
    /// Stages [`MATERIAL`], over material and coefficients, and [`PAIR`]; outputs: the nine components by rows, or the scalar entry of a
    /// Kronecker structure.
    pub(in crate::spec) program: Program,
}

impl Pairs {
    /// Letters of the parts in names.
    pub(in crate::spec) const PARTS: [&'static str; 4] = ["n", "x", "y", "z"];

    /// Name of the sum of a product.
    pub(in crate::spec) fn name((test, trial): (usize, usize)) -> String {
        format!("s_{}{}_", Self::PARTS[test], Self::PARTS[trial])
    }

    pub(in crate::spec) fn new(spec: &FormSpec, form: &Form) -> Result<Self, ScheduleError> {
        let mut graph = spec.graph.clone();
        let moments: BTreeSet<(usize, usize)> = match &form.structure {
            Structure::Kronecker { scalar, .. } => scalar.keys().copied().collect(),
            _ => form.bilinear.keys().map(|place| (place.test, place.trial)).collect(),
        };
        let sums: BTreeMap<(usize, usize), Id> =
            moments.iter().map(|moment| (*moment, graph.scalar(&Self::name(*moment)))).collect();
        let mut outputs = Vec::new();
        let mut output = |graph: &mut Graph, name: String, terms: Vec<(Id, Id)>| {
            let mut products = vec![(graph.integer(0), Rational::one())];
            for (coefficient, sum) in terms {
                products.push((graph.mul(coefficient, sum), Rational::one()));
            }
            let expression = graph.sum(&products);
            outputs.push(Output { name, expression });
        };
        match &form.structure {
            Structure::Kronecker { scalar, .. } => {
                let terms = scalar.iter().map(|(moment, c)| (*c, sums[moment])).collect();
                output(&mut graph, "s".to_owned(), terms);
            }
            _ => {
                for i in 0..3 {
                    for j in 0..3 {
                        let here = form.bilinear.iter().filter(|(p, _)| (p.i, p.j) == (i, j));
                        let terms = here.map(|(p, c)| (*c, sums[&(p.test, p.trial)])).collect();
                        let name = format!("k_{}{}", Self::PARTS[1 + i], Self::PARTS[1 + j]);
                        output(&mut graph, name, terms);
                    }
                }
            }
        }
        let properties = spec.material_of(form);
        let material: Vec<String> = properties.iter().map(|p| p.name.clone()).collect();
        let uses = |symbol: Id| form.bilinear.values().any(|id| graph.depends(*id, symbol));
        let used: Vec<_> = spec.coefficients.iter().filter(|c| uses(c.symbol)).collect();
        let input = |name: String, symbol: Id, stage| Input { name, symbol, stage };
        let mut inputs = Vec::new();
        for (property, name) in properties.iter().zip(&material) {
            inputs.push(input(name.clone(), property.symbol, MATERIAL));
        }
        let request = Request {
            stages: vec![Stage::new("material", &[], 1.0)],
            inputs: inputs.clone(),
            outputs: (used.iter())
                .map(|c| Output { name: c.name.clone(), expression: c.value })
                .collect(),
            names: Vec::new(),
        };
        inputs.extend(used.iter().map(|c| input(c.name.clone(), c.symbol, MATERIAL)));
        inputs.extend(sums.iter().map(|(m, symbol)| input(Self::name(*m), *symbol, PAIR)));
        let coefficients = schedule(&mut graph.clone(), &request)?;
        let pairs = if moments.len() > 1 { 36.0 } else { 27.0 };
        let stages = vec![Stage::new("material", &[], 1.0), Stage::new("pair", &[MATERIAL], pairs)];
        let request = Request { stages, inputs, outputs, names: Vec::new() };
        let program = schedule(&mut graph, &request)?;
        Ok(Pairs { moments: moments.into_iter().collect(), material, coefficients, program })
    }

    /// The parts that the basis functions are filled with, in their order: values where they occur, and gradients.
    pub(in crate::spec) fn parts(&self) -> &'static [usize] {
        match self.moments.iter().any(|(test, trial)| *test == 0 || *trial == 0) {
            true => &[0, 1, 2, 3],
            false => &[1, 2, 3],
        }
    }

    /// The components of a pair as text.
    pub(in crate::spec) fn outputs(&self) -> Vec<TokenStream> {
        let outputs = self.program.outputs.iter();
        outputs.map(|output| operand(&self.program, output.operand, Numbers::Fused)).collect()
    }

    /// The nine components as rows.
    pub(in crate::spec) fn block(&self) -> TokenStream {
        let outputs = self.outputs();
        let rows = outputs.chunks(3).map(|row| quote!([#(#row),*]));
        quote!([#(#rows),*])
    }

    /// The statements that run once a cell.
    pub(in crate::spec) fn once(&self) -> TokenStream {
        let coefficients = statements(&self.coefficients, 0, Numbers::Fused);
        let bound = self.coefficients.outputs.iter().filter_map(|output| {
            let name = identifier(&output.name);
            let value = operand(&self.coefficients, output.operand, Numbers::Fused);
            (name != value.to_string()).then(|| quote!(let #name = #value;))
        });
        let material = statements(&self.program, MATERIAL, Numbers::Fused);
        quote!(#(#coefficients)* #(#bound)* #(#material)*)
    }

    /// Operations once a cell.
    pub(in crate::spec) fn once_flops(&self) -> usize {
        self.coefficients.total_counts().arithmetic() + self.program.counts(MATERIAL).arithmetic()
    }

    /// Operations once a pair, without the sums.
    pub(in crate::spec) fn flops(&self) -> usize {
        self.program.counts(PAIR).arithmetic()
    }

    /// The same in words.
    pub(in crate::spec) fn pair_counts(&self) -> String {
        self.program.counts(PAIR).to_string()
    }

    /// Operations once a cell, in words.
    pub(in crate::spec) fn once_counts(&self) -> String {
        let (coefficients, rest) =
            (self.coefficients.total_counts(), self.program.counts(MATERIAL));
        format!("{coefficients} for coefficients, then {rest}")
    }
}
