//! Symmetry, skewness and Kronecker structure, found by comparing the components of a form.

use std::collections::BTreeMap;

use num_traits::{One, Zero};

use super::expand::{Bilinear, Place};
use crate::expression::{Graph, Id, Rational, normal};

/// A constant 3 × 3 pattern.
pub type Pattern = [[Rational; 3]; 3];

/// What a cell's matrix is known to be.
#[derive(Debug, Clone, PartialEq)]
pub enum Structure {
    /// Symmetric.
    Symmetric,
    /// Nothing is known.
    Full,
    /// A symmetric scalar matrix times a symmetric or skew pattern.
    Kronecker {
        /// The pattern; its first entry that is not zero is 1.
        pattern: Box<Pattern>,
        /// Coefficients of the scalar matrix by the parts (N, ∂x, ∂y, ∂z) of test and trial function.
        scalar: BTreeMap<(usize, usize), Id>,
    },
}

/// Finds the structure of a form; coefficients are compared as polynomials in the material's symbols.
pub(super) fn structure(graph: &mut Graph, form: &Bilinear) -> Structure {
    if let Some(kronecker) = kronecker(graph, form) {
        return kronecker;
    }
    // Exchanging (a, i) and (b, j) exchanges test and trial.
    let symmetric = form.iter().all(|(place, coefficient)| {
        let mirror = Place { i: place.j, j: place.i, test: place.trial, trial: place.test };
        form.get(&mirror).is_some_and(|other| normal::equal(graph, *coefficient, *other))
    });
    if symmetric { Structure::Symmetric } else { Structure::Full }
}

fn kronecker(graph: &mut Graph, form: &Bilinear) -> Option<Structure> {
    let first = *form.keys().next()?;
    let component = |i: usize, j: usize| -> BTreeMap<(usize, usize), Id> {
        let here = form.iter().filter(|(place, _)| (place.i, place.j) == (i, j));
        here.map(|(place, id)| ((place.test, place.trial), *id)).collect()
    };
    let scalar = component(first.i, first.j);
    let mut pattern: Pattern = Default::default();
    for (i, row) in pattern.iter_mut().enumerate() {
        for (j, entry) in row.iter_mut().enumerate() {
            *entry = multiple(graph, &component(i, j), &scalar)?;
        }
    }
    let transposed =
        |sign: Rational| (0..3).all(|i| (0..3).all(|j| pattern[i][j] == &sign * &pattern[j][i]));
    let even = transposed(Rational::one()) || transposed(-Rational::one());
    let symmetric = scalar.iter().all(|((test, trial), id)| {
        scalar.get(&(*trial, *test)).is_some_and(|other| normal::equal(graph, *id, *other))
    });
    let pattern = Box::new(pattern);
    (even && symmetric).then_some(Structure::Kronecker { pattern, scalar })
}

/// The number r with component = r · scalar, if there is one.
fn multiple(
    graph: &mut Graph,
    component: &BTreeMap<(usize, usize), Id>,
    scalar: &BTreeMap<(usize, usize), Id>,
) -> Option<Rational> {
    if component.is_empty() {
        return Some(Rational::zero());
    }
    if !component.keys().eq(scalar.keys()) {
        return None;
    }
    let (parts, id) = component.iter().next()?;
    let (above, below) = (normal::expand(graph, *id), normal::expand(graph, scalar[parts]));
    let ratio = &graph.terms(above).first()?.1 / &graph.terms(below).first()?.1;
    let ratio = match (graph.as_number(above), graph.as_number(below)) {
        (Some(above), Some(below)) => above / below,
        _ => ratio,
    };
    let alike = component.iter().all(|(parts, id)| {
        let expected = graph.times(ratio.clone(), scalar[parts]);
        normal::equal(graph, *id, expected)
    });
    alike.then_some(ratio)
}
