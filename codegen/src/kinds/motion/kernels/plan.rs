//! What a kernel over vectors and matrices computes, in order: matrix–vector products, dot
//! products, scalars, and outputs that are linear combinations of matrix–vector products, stored matrices and outer
//! products.

use std::collections::{BTreeMap, BTreeSet};

use super::form::{Combination, form, without_choices};
use super::product::{self, Split};
use crate::expression::{Graph, Id, Node, Shape, Symbol, normal};
use crate::operation::Operand;
use crate::schedule::{Input, Output, Program, Request, ScheduleError, Stage, schedule};

/// Stage of scalars that need no dot product.
pub const BEFORE: usize = 0;
/// Stage of scalars that need dot products.
pub const AFTER: usize = 1;

/// A kernel, ready to be written.
#[derive(Debug)]
pub struct KernelPlan {
    /// Matrix–vector products, operands first.
    pub products: Vec<MatrixProduct>,
    /// Dot products, after all matrix–vector products.
    pub dots: Vec<DotProduct>,
    /// Scalars, in the stages [`BEFORE`] and [`AFTER`] the dot products.
    pub scalars: Program,
    /// The outputs, in the order of the request.
    pub outputs: Vec<Combination<Operand>>,
    /// Names of symbols, products, and stored matrices that are used transposed.
    pub(crate) names: BTreeMap<Id, String>,
}

/// matrix × vector.
#[derive(Debug)]
pub struct MatrixProduct {
    /// The product.
    pub id: Id,
    /// The stored matrix.
    pub matrix: Id,
    /// Whether the transpose of the matrix is meant.
    pub transposed: bool,
    /// A vector symbol or an earlier product.
    pub of: Id,
    /// Matrices in the product: 1 for a product with a symbol.
    pub(crate) level: usize,
}

/// A dot product of symbols or matrix–vector products.
#[derive(Debug)]
pub struct DotProduct {
    /// Name of its value among the scalars.
    pub name: String,
    /// One vector.
    pub a: Id,
    /// The other.
    pub b: Id,
}

/// An output as asked for.
pub(super) struct Asked {
    /// Name of a scalar output; begins the names of the coefficients of others.
    pub(super) name: &'static str,
    pub(super) expression: Id,
}

impl KernelPlan {
    /// Whether a matrix can be written in the same pass over the columns as the products of the first level.
    pub(super) fn fuses(&self, form: &Combination<Operand>) -> bool {
        let early = |operand: &Operand| self.scalars.stage_of(*operand) == BEFORE;
        match form {
            Combination::Matrix { stored, identity, outer } => {
                outer.is_empty()
                    && identity.iter().all(early)
                    && stored.iter().all(|group| early(&group.coefficient))
            }
            _ => false,
        }
    }

    /// The name of a symbol or product.
    pub(super) fn name(&self, id: Id) -> &str {
        &self.names[&id]
    }
}

/// Plans the computation of `outputs`.
///
/// # Errors
/// Expressions beyond the graph's bounds, or that are not linear in what they combine.
pub(super) fn plan(graph: &mut Graph, outputs: &[Asked]) -> Result<KernelPlan, ScheduleError> {
    let mut forms = Vec::with_capacity(outputs.len());
    for output in outputs {
        let plain = without_choices(graph, output.expression);
        let expanded = normal::expand(graph, plain);
        if graph.exceeded() {
            return Err(ScheduleError::Exceeded);
        }
        if graph.changed().is_some() || !graph.same_signature(output.expression, expanded) {
            return Err(ScheduleError::MeaningChanged { output: output.name.to_owned() });
        }
        forms.push(form(graph, expanded));
    }
    let (dots, needed) = choose_products(graph, outputs, &forms)?;
    let products: Vec<MatrixProduct> = needed.iter().map(|id| matrix_product(graph, *id)).collect();
    let mut taken = BTreeSet::new();
    let names = names(graph, outputs, &products, &mut taken);
    let (dots, by) = dot_products(graph, &names, &dots, &mut taken);

    let mut coefficients: Vec<Output> = Vec::new();
    let mut numbered = Vec::with_capacity(forms.len());
    for (form, output) in forms.into_iter().zip(outputs) {
        numbered.push(form.map(|coefficient, first| {
            let name = match first {
                Some(first) => format!("{}_{}", output.name, names[&first]),
                None => output.name.to_owned(),
            };
            let name = free(&mut taken, name);
            let expression = graph.substitute(coefficient, &by);
            coefficients.push(Output { name, expression });
            coefficients.len() - 1
        }));
    }
    let request = Request {
        stages: vec![Stage::new("before", &[], 1.0), Stage::new("after", &[BEFORE], 1.0)],
        inputs: inputs(graph, &coefficients, &dots, &names),
        outputs: coefficients,
        names: Vec::new(),
    };
    let scalars = schedule(graph, &request)?;
    let outputs = (numbered.into_iter())
        .map(|form| form.map(|place, _| scalars.outputs[place].operand))
        .collect();
    Ok(KernelPlan { products, dots, scalars, outputs, names })
}

/// How each dot product is written, and the products that they and the forms need.
fn choose_products(
    graph: &mut Graph,
    outputs: &[Asked],
    forms: &[Combination<Id>],
) -> Result<(BTreeMap<Id, Split>, BTreeSet<Id>), ScheduleError> {
    let mut needed = BTreeSet::new();
    let mut dots = BTreeSet::new();
    for (form, output) in forms.iter().zip(outputs) {
        let refused = || ScheduleError::NotScalar { output: output.name.to_owned() };
        for vector in form.vectors() {
            product::chain(graph, vector).ok_or_else(refused)?;
            needed.extend(product::parts(graph, vector));
        }
        let stored = |id: &Id| matches!(graph.node(*id), Node::Symbol(_) | Node::Transpose(_));
        if !form.matrices().iter().all(stored) {
            return Err(refused());
        }
        for id in graph.reachable(&scalars(form)) {
            if let Node::Dot(a, b) = *graph.node(id) {
                product::chain(graph, a).and(product::chain(graph, b)).ok_or_else(refused)?;
                dots.insert(id);
            }
        }
    }
    let chosen = product::choose(graph, &dots, &mut needed);
    Ok((chosen, needed))
}

/// Every coefficient of a form.
fn scalars(form: &Combination<Id>) -> Vec<Id> {
    match form {
        Combination::Scalar(scalar) => vec![*scalar],
        Combination::Vector(groups) => groups.iter().map(|group| group.coefficient).collect(),
        Combination::Matrix { stored, identity, outer } => {
            let outer = outer.iter().flat_map(|(_, groups)| groups);
            let groups = stored.iter().chain(outer).map(|group| group.coefficient);
            groups.chain(*identity).collect()
        }
    }
}

fn matrix_product(graph: &Graph, id: Id) -> MatrixProduct {
    let Node::Apply(matrix, of) = *graph.node(id) else {
        unreachable!("products are matrices applied to vectors")
    };
    let (matrix, transposed) = match *graph.node(matrix) {
        Node::Transpose(stored) => (stored, true),
        _ => (matrix, false),
    };
    MatrixProduct { id, matrix, transposed, of, level: product::parts(graph, id).len() }
}

/// Names of all symbols and matrix–vector products: the spec's own, and those joined; what is no name of the spec gives way
/// to what is.
fn names(
    graph: &Graph,
    outputs: &[Asked],
    products: &[MatrixProduct],
    taken: &mut BTreeSet<String>,
) -> BTreeMap<Id, String> {
    let mut names = BTreeMap::new();
    let roots: Vec<Id> = outputs.iter().map(|output| output.expression).collect();
    let reachable = graph.reachable(&roots);
    for id in &reachable {
        if let Node::Symbol(Symbol { name, .. }) = graph.node(*id) {
            names.insert(*id, name.clone());
            taken.insert(name.clone());
        }
    }
    for id in reachable {
        if let Node::Transpose(matrix) = *graph.node(id) {
            names.insert(id, free(taken, format!("{}_transposed", names[&matrix])));
        }
    }
    for product in products {
        let joint = if product.transposed { "_transposed_" } else { "_" };
        let name = format!("{}{joint}{}", names[&product.matrix], names[&product.of]);
        names.insert(product.id, free(taken, name));
    }
    names
}

/// The dot products to compute, and what stands for each one of the graph.
fn dot_products(
    graph: &mut Graph,
    names: &BTreeMap<Id, String>,
    chosen: &BTreeMap<Id, Split>,
    taken: &mut BTreeSet<String>,
) -> (Vec<DotProduct>, BTreeMap<Id, Id>) {
    let mut dots: Vec<DotProduct> = Vec::new();
    let mut by = BTreeMap::new();
    for (dot, split) in chosen {
        graph.keep_dot(*dot, &split.factor, [split.left, split.right]);
        let (a, b) = (split.left.min(split.right), split.left.max(split.right));
        let name = match dots.iter().find(|other| (other.a, other.b) == (a, b)) {
            Some(known) => known.name.clone(),
            None => {
                let name = free(taken, format!("dot_{}_{}", names[&a], names[&b]));
                dots.push(DotProduct { name: name.clone(), a, b });
                name
            }
        };
        let symbol = graph.scalar(&name);
        by.insert(*dot, graph.times(split.factor.clone(), symbol));
    }
    (dots, by)
}

/// The scalar symbols of the coefficients, each at its stage; the names of vectors and matrices too, as
/// inputs that nothing uses, so that no value is called like one of them.
fn inputs(
    graph: &mut Graph,
    coefficients: &[Output],
    dots: &[DotProduct],
    names: &BTreeMap<Id, String>,
) -> Vec<Input> {
    let roots: Vec<Id> = coefficients.iter().map(|output| output.expression).collect();
    let mut inputs = Vec::new();
    for symbol in graph.reachable(&roots) {
        if let (Node::Symbol(Symbol { name, .. }), Shape::Scalar) =
            (graph.node(symbol), graph.shape(symbol))
        {
            let is_dot = dots.iter().any(|dot| dot.name == *name);
            let stage = if is_dot { AFTER } else { BEFORE };
            inputs.push(Input { name: name.clone(), symbol, stage });
        }
    }
    for (id, name) in names {
        if graph.shape(*id) != Shape::Scalar {
            let symbol = graph.scalar(name);
            inputs.push(Input { name: name.clone(), symbol, stage: BEFORE });
        }
    }
    inputs
}

fn free(taken: &mut BTreeSet<String>, name: String) -> String {
    let mut free = name.clone();
    let mut number = 2;
    while !taken.insert(free.clone()) {
        free = format!("{name}_{number}");
        number += 1;
    }
    free
}
