//! What a kernel of a form computes apart from loops: coefficients of the material and components of a
//! pair of basis functions.

use std::collections::{BTreeMap, BTreeSet};

use num_traits::One;
use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::{Numbers, Work, identifier, operand};
use crate::expression::{Graph, Id, Rational};
use crate::kinds::form::stress::slope;
use crate::kinds::form::{Form, FormSpec, Structure};
use crate::schedule::{Input, Output, Program, Request, ScheduleError, Stage, schedule};

/// Once a cell.
pub(in crate::kinds) const MATERIAL: usize = 0;
/// Once a pair of basis functions.
pub(in crate::kinds) const PAIR: usize = 1;

/// The components of a pair of basis functions over the sums of their products at the points,
/// s_xy = Σ_q w det J ∂N_a/∂x ∂N_b/∂y and the like.
pub(crate) struct Pairs {
    /// The products that occur: parts (N, ∂x, ∂y, ∂z) of test and trial function.
    pub(in crate::kinds) moments: Vec<(usize, usize)>,
    /// Names of the properties of the material, in the order of the kernel.
    pub(in crate::kinds) material: Vec<String>,
    /// The coefficients that occur, from the material; outputs by name.
    pub(in crate::kinds) coefficients: Program,
    /// Stages [`MATERIAL`], over material and coefficients, and [`PAIR`]; outputs: the nine components by rows, or the scalar entry of a
    /// Kronecker structure.
    pub(in crate::kinds) program: Program,
    /// Whether the coefficients follow from a stress, point by point: then the second stage is over the slopes of the
    /// displacement, and its outputs are the coefficients of the products of gradients, by rows.
    pub(in crate::kinds) under_stress: bool,
}

impl Pairs {
    /// Letters of the parts in names.
    pub(in crate::kinds) const PARTS: [&'static str; 4] = ["n", "x", "y", "z"];

    /// Name of the sum of a product.
    pub(in crate::kinds) fn name((test, trial): (usize, usize)) -> String {
        format!("s_{}{}_", Self::PARTS[test], Self::PARTS[trial])
    }

    pub(in crate::kinds) fn new(spec: &FormSpec, form: &Form) -> Result<Self, ScheduleError> {
        let mut graph = spec.graph.clone();
        let moments: BTreeSet<(usize, usize)> = match &form.structure {
            Structure::Kronecker { scalar, .. } => scalar.keys().copied().collect(),
            _ => form.bilinear.keys().map(|place| (place.test, place.trial)).collect(),
        };
        // What comes in at every pair, or at every point.
        let mut symbols: Vec<(String, Id)> = Vec::new();
        let mut outputs = Vec::new();
        if let Some(stress) = &form.stress {
            for (j, l) in (0..9).map(|n| (n / 3, n % 3)) {
                symbols.push((slope(j, l), stress.slopes[j][l]));
                let zero = graph.integer(0);
                let expression = *stress.scalar.get(&(1 + j, 1 + l)).unwrap_or(&zero);
                outputs.push(Output { name: Self::component(j, l), expression });
            }
        } else {
            let sums: BTreeMap<(usize, usize), Id> = moments
                .iter()
                .map(|moment| (*moment, graph.scalar(&Self::name(*moment))))
                .collect();
            symbols.extend(sums.iter().map(|(moment, symbol)| (Self::name(*moment), *symbol)));
            outputs = Self::of_sums(&mut graph, form, &sums);
        }
        let properties = spec.material_of(form);
        let material: Vec<String> = properties.iter().map(|p| p.name.clone()).collect();
        let of_stress = form.stress.iter().flat_map(|stress| stress.scalar.values());
        let values: Vec<Id> = form.bilinear.values().chain(of_stress).copied().collect();
        let uses = |symbol: Id| values.iter().any(|id| graph.depends(*id, symbol));
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
        inputs.extend(symbols.into_iter().map(|(name, symbol)| input(name, symbol, PAIR)));
        let coefficients = schedule(&mut graph.clone(), &request)?;
        let pairs = if moments.len() > 1 { 36.0 } else { 27.0 };
        let stages = vec![Stage::new("material", &[], 1.0), Stage::new("pair", &[MATERIAL], pairs)];
        let request = Request { stages, inputs, outputs, names: Vec::new() };
        let program = schedule(&mut graph, &request)?;
        let moments = moments.into_iter().collect();
        let under_stress = form.stress.is_some();
        Ok(Pairs { moments, material, coefficients, program, under_stress })
    }

    /// The components of a pair over the sums.
    fn of_sums(graph: &mut Graph, form: &Form, sums: &BTreeMap<(usize, usize), Id>) -> Vec<Output> {
        let mut outputs = Vec::new();
        let mut output = |graph: &mut Graph, name: String, terms: Vec<(Id, Id)>| {
            let mut products = vec![(graph.integer(0), Rational::one())];
            for (coefficient, sum) in terms {
                products.push((graph.mul(coefficient, sum), Rational::one()));
            }
            let expression = graph.sum(&products);
            outputs.push(Output { name, expression });
        };
        if let Structure::Kronecker { scalar, .. } = &form.structure {
            let terms = scalar.iter().map(|(moment, c)| (*c, sums[moment])).collect();
            output(graph, "s".to_owned(), terms);
            return outputs;
        }
        for (i, j) in (0..9).map(|n| (n / 3, n % 3)) {
            let here = form.bilinear.iter().filter(|(p, _)| (p.i, p.j) == (i, j));
            let terms = here.map(|(p, c)| (*c, sums[&(p.test, p.trial)])).collect();
            output(graph, Self::component(i, j), terms);
        }
        outputs
    }

    /// Name of component (i, j) of what the second stage gives.
    fn component(i: usize, j: usize) -> String {
        format!("k_{}{}", Self::PARTS[1 + i], Self::PARTS[1 + j])
    }

    /// What the second stage takes: rows of names, where they are used.
    pub(in crate::kinds) fn taken(&self) -> Vec<Vec<Option<String>>> {
        let name = |i: usize, j: usize| match self.under_stress {
            true => Some(slope(i - 1, j - 1)),
            false => self.moments.contains(&(i, j)).then(|| Self::name((i, j))),
        };
        self.parts().iter().map(|i| self.parts().iter().map(|j| name(*i, *j)).collect()).collect()
    }

    /// The parts that the basis functions are filled with, in their order: values where they occur, and gradients.
    pub(in crate::kinds) fn parts(&self) -> &'static [usize] {
        match self.moments.iter().any(|(test, trial)| *test == 0 || *trial == 0) {
            true => &[0, 1, 2, 3],
            false => &[1, 2, 3],
        }
    }

    /// The components of a pair as text.
    pub(in crate::kinds) fn outputs(&self) -> Vec<TokenStream> {
        let outputs = self.program.outputs.iter();
        outputs.map(|output| operand(&self.program, output.operand, Numbers::Fused)).collect()
    }

    /// The nine components as rows.
    pub(in crate::kinds) fn block(&self) -> TokenStream {
        let outputs = self.outputs();
        let rows = outputs.chunks(3).map(|row| quote!([#(#row),*]));
        quote!([#(#rows),*])
    }

    /// What is done once a cell.
    pub(in crate::kinds) fn once(&self) -> Work {
        let mut work = Work::new();
        work.stage(&self.coefficients, 0, Numbers::Fused);
        for output in &self.coefficients.outputs {
            let name = identifier(&output.name);
            let value = operand(&self.coefficients, output.operand, Numbers::Fused);
            if name != value.to_string() {
                work.name(quote!(#name), value);
            }
        }
        work.stage(&self.program, MATERIAL, Numbers::Fused);
        work
    }

    /// Operations once a pair, without the sums.
    pub(in crate::kinds) fn flops(&self) -> usize {
        self.program.counts(PAIR).arithmetic()
    }

    /// The same where no more than the upper triangle of the components is used.
    pub(in crate::kinds) fn own_flops(&self) -> usize {
        let upper =
            |name: &str| (0..9).any(|n| n / 3 <= n % 3 && name == Self::component(n / 3, n % 3));
        self.program.restricted(upper).counts(PAIR).arithmetic()
    }

    /// The same in words.
    pub(in crate::kinds) fn pair_counts(&self) -> String {
        self.program.counts(PAIR).to_string()
    }

    /// Operations once a cell, in words.
    pub(in crate::kinds) fn once_counts(&self) -> String {
        let (coefficients, rest) =
            (self.coefficients.total_counts(), self.program.counts(MATERIAL));
        format!("{coefficients} for coefficients, then {rest}")
    }
}
