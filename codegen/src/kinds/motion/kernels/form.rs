//! Linear combinations: what a kernel writes, as coefficients times matrix–vector products, stored matrices and outer
//! products of vectors.

use std::collections::BTreeMap;

use num_traits::{One, Signed};

use crate::expression::{Graph, Id, Node, Rational, Shape};

/// An output of a kernel, with coefficients of a type `C`.
#[derive(Debug)]
pub enum Combination<C> {
    /// One number.
    Scalar(C),
    /// Σ coefficient · vectors.
    Vector(Vec<Group<C>>),
    /// The sum of three parts.
    Matrix {
        /// Σ coefficient · stored matrices.
        stored: Vec<Group<C>>,
        /// Coefficient of the unit matrix.
        identity: Option<C>,
        /// Σ left ⊗ (Σ coefficient · vectors), by the left vector.
        outer: Vec<(Id, Vec<Group<C>>)>,
    },
}

/// coefficient · Σ ± terms.
#[derive(Debug)]
pub struct Group<C> {
    /// What all terms are multiplied by.
    pub coefficient: C,
    /// The terms, at least one.
    pub terms: Vec<Term>,
}

/// ± a vector or matrix.
#[derive(Debug, Clone, Copy)]
pub struct Term {
    /// Whether it is subtracted.
    pub negative: bool,
    /// A vector symbol or a product; a stored matrix, or its transpose.
    pub id: Id,
}

impl<C> Combination<C> {
    /// The same form with other coefficients; `change` sees the first term of each group, if any.
    pub(super) fn map<D>(self, mut change: impl FnMut(C, Option<Id>) -> D) -> Combination<D> {
        match self {
            Combination::Scalar(scalar) => Combination::Scalar(change(scalar, None)),
            Combination::Vector(groups) => Combination::Vector(groups_map(groups, &mut change)),
            Combination::Matrix { stored, identity, outer } => Combination::Matrix {
                stored: groups_map(stored, &mut change),
                identity: identity.map(|coefficient| change(coefficient, None)),
                outer: (outer.into_iter())
                    .map(|(left, groups)| (left, groups_map(groups, &mut change)))
                    .collect(),
            },
        }
    }

    /// Every vector that it combines.
    pub(super) fn vectors(&self) -> Vec<Id> {
        let of = |groups: &[Group<C>]| -> Vec<Id> {
            groups.iter().flat_map(|group| group.terms.iter().map(|term| term.id)).collect()
        };
        match self {
            Combination::Scalar(_) => Vec::new(),
            Combination::Vector(groups) => of(groups),
            Combination::Matrix { outer, .. } => (outer.iter())
                .flat_map(|(left, groups)| std::iter::once(*left).chain(of(groups)))
                .collect(),
        }
    }

    /// Every stored matrix that it combines.
    pub(super) fn matrices(&self) -> Vec<Id> {
        match self {
            Combination::Matrix { stored, .. } => {
                stored.iter().flat_map(|group| group.terms.iter().map(|term| term.id)).collect()
            }
            _ => Vec::new(),
        }
    }
}

fn groups_map<C, D>(
    groups: Vec<Group<C>>,
    change: &mut impl FnMut(C, Option<Id>) -> D,
) -> Vec<Group<D>> {
    let one = |group: Group<C>| Group {
        coefficient: change(group.coefficient, group.terms.first().map(|term| term.id)),
        terms: group.terms,
    };
    groups.into_iter().map(one).collect()
}

/// The expanded expression as a form.
pub(super) fn form(graph: &mut Graph, expanded: Id) -> Combination<Id> {
    let form = combination(graph, expanded);
    let parts = parts(graph, &form);
    graph.keep_sum(expanded, &parts);
    form
}

/// What a combination adds up, each as factor · coefficient · vector or matrix.
fn parts(graph: &mut Graph, form: &Combination<Id>) -> Vec<(Rational, Id, Id)> {
    let sign = |term: &Term| Rational::from(if term.negative { -1 } else { 1 });
    let of = |groups: &[Group<Id>]| -> Vec<(Rational, Id, Id)> {
        let each = |group: &Group<Id>| -> Vec<_> {
            group.terms.iter().map(|term| (sign(term), group.coefficient, term.id)).collect()
        };
        groups.iter().flat_map(each).collect()
    };
    match form {
        Combination::Scalar(scalar) => vec![(Rational::one(), graph.integer(1), *scalar)],
        Combination::Vector(groups) => of(groups),
        Combination::Matrix { stored, identity, outer } => {
            let mut parts = of(stored);
            if let Some(coefficient) = identity {
                parts.push((Rational::one(), *coefficient, graph.identity()));
            }
            for (left, groups) in outer {
                let products = of(groups).into_iter();
                parts.extend(products.map(|(s, c, right)| (s, c, graph.outer(*left, right))));
            }
            parts
        }
    }
}

fn combination(graph: &mut Graph, expanded: Id) -> Combination<Id> {
    match graph.shape(expanded) {
        Shape::Vector => {
            let combined = combined(graph, expanded);
            Combination::Vector(groups(graph, combined))
        }
        Shape::Matrix => {
            let (mut stored, mut identity) = (BTreeMap::new(), None);
            let mut outer: BTreeMap<Id, BTreeMap<Id, Id>> = BTreeMap::new();
            for (matrix, coefficient) in combined(graph, expanded) {
                match *graph.node(matrix) {
                    Node::Identity => identity = Some(coefficient),
                    Node::Outer(left, right) => {
                        outer.entry(left).or_default().insert(right, coefficient);
                    }
                    _ => {
                        stored.insert(matrix, coefficient);
                    }
                }
            }
            let stored = groups(graph, stored);
            let outer = outer.into_iter().map(|(left, row)| (left, groups(graph, row))).collect();
            Combination::Matrix { stored, identity, outer }
        }
        Shape::Scalar | Shape::Truth => Combination::Scalar(expanded),
    }
}

/// Σ coefficient · basis, each vector or matrix of the basis once.
fn combined(graph: &mut Graph, expanded: Id) -> BTreeMap<Id, Id> {
    let mut sums: BTreeMap<Id, Vec<(Id, Rational)>> = BTreeMap::new();
    for (term, coefficient) in graph.terms(expanded) {
        let (scalar, basis) = match *graph.node(term) {
            Node::Zero(_) => continue,
            Node::Scale(scalar, basis) => (scalar, basis),
            _ => (graph.integer(1), term),
        };
        sums.entry(basis).or_default().push((scalar, coefficient));
    }
    sums.into_iter().map(|(basis, terms)| (basis, graph.sum(&terms))).collect()
}

/// Terms with coefficients that differ at most in sign, together; in the order of the first term.
fn groups(graph: &mut Graph, combined: BTreeMap<Id, Id>) -> Vec<Group<Id>> {
    let mut groups: Vec<Group<Id>> = Vec::new();
    for (id, coefficient) in combined {
        let minus = graph.neg(coefficient);
        let found = groups
            .iter_mut()
            .find(|group| group.coefficient == coefficient || group.coefficient == minus);
        match found {
            Some(group) => {
                let negative = group.coefficient == minus;
                group.terms.push(Term { negative, id });
            }
            None => {
                let negative = is_negative(graph, coefficient);
                let coefficient = if negative { minus } else { coefficient };
                groups.push(Group { coefficient, terms: vec![Term { negative, id }] });
            }
        }
    }
    groups
}

/// Whether every term has a coefficient below zero.
fn is_negative(graph: &Graph, scalar: Id) -> bool {
    match graph.node(scalar) {
        Node::Number(value) => value.is_negative(),
        _ => graph.terms(scalar).iter().all(|(_, coefficient)| coefficient.is_negative()),
    }
}

/// The expression with every choice between vectors or matrices written as a sum with coefficients that
/// are 1 or 0, which makes it a linear combination.
pub(super) fn without_choices(graph: &mut Graph, id: Id) -> Id {
    let mut id = id;
    loop {
        let choice = graph.reachable(&[id]).into_iter().find_map(|node| match *graph.node(node) {
            Node::Select(mask, a, b) if graph.shape(node) != Shape::Scalar => {
                Some((node, mask, a, b))
            }
            _ => None,
        });
        let Some((node, mask, a, b)) = choice else { return id };
        let (one, zero) = (graph.integer(1), graph.integer(0));
        let (first, second) = (graph.select(mask, one, zero), graph.select(mask, zero, one));
        let (a, b) = (graph.scale(first, a), graph.scale(second, b));
        let sum = graph.sum(&[(a, Rational::one()), (b, Rational::one())]);
        graph.keep(node, sum);
        id = graph.substitute(id, &BTreeMap::from([(node, sum)]));
    }
}
