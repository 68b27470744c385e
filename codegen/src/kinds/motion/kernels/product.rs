//! Matrix–vector products: matrices applied to a vector symbol, such as Y η; and which of them dot products need.

use std::collections::{BTreeMap, BTreeSet};

use num_traits::One;

use crate::expression::{Graph, Id, Node, Rational};

/// Matrices, outermost first, and the vector symbol they are applied to; `None` of anything else.
pub(super) fn chain(graph: &Graph, product: Id) -> Option<(Vec<Id>, Id)> {
    let (mut matrices, mut rest) = (Vec::new(), product);
    loop {
        match *graph.node(rest) {
            Node::Apply(matrix, inner) => {
                matrices.push(matrix);
                rest = inner;
            }
            Node::Symbol(_) => return Some((matrices, rest)),
            _ => return None,
        }
    }
}

/// The products that a product is made of, itself last; symbols are not among them.
pub(super) fn parts(graph: &Graph, product: Id) -> Vec<Id> {
    let mut parts = Vec::new();
    let mut rest = product;
    while let Node::Apply(_, inner) = *graph.node(rest) {
        parts.push(rest);
        rest = inner;
    }
    parts.reverse();
    parts
}

/// A dot product of matrix–vector products, and what its value is multiplied by.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Split {
    pub(super) factor: Rational,
    pub(super) left: Id,
    pub(super) right: Id,
}

/// Every way to write a dot product: x·A B y = (Aᵀx)·(B y) = …; `None` if its operands are no such products.
fn splits(graph: &mut Graph, a: Id, b: Id) -> Option<Vec<Split>> {
    let (front, x) = chain(graph, a)?;
    let (back, y) = chain(graph, b)?;
    // xᵀ F₁ᵀ … with the transposes that moving a factor across brings.
    let mut factor = Rational::one();
    let mut matrices = Vec::new();
    for matrix in front.iter().rev() {
        let (sign, transposed) = transposed(graph, *matrix);
        factor *= sign;
        matrices.push(transposed);
    }
    matrices.extend(back);
    let mut splits = Vec::with_capacity(matrices.len() + 1);
    for place in 0..=matrices.len() {
        let (mut factor, mut left, mut right) = (factor.clone(), x, y);
        for matrix in &matrices[..place] {
            let (sign, transposed) = transposed(graph, *matrix);
            factor *= sign;
            left = graph.apply(transposed, left);
        }
        for matrix in matrices[place..].iter().rev() {
            right = graph.apply(*matrix, right);
        }
        splits.push(Split { factor, left, right });
    }
    Some(splits)
}

/// Aᵀ as a factor and a stored matrix.
fn transposed(graph: &mut Graph, matrix: Id) -> (Rational, Id) {
    let transposed = graph.transpose(matrix);
    let terms = graph.terms(transposed);
    let [(matrix, factor)] = terms.as_slice() else { return (Rational::one(), transposed) };
    (factor.clone(), *matrix)
}

/// For every dot product the way to write it that needs the fewest products beside `needed`, to which those
/// are added: first what needs none, then always the product that serves most of the rest. Dot products of
/// anything else are left out.
pub(super) fn choose(
    graph: &mut Graph,
    dots: &BTreeSet<Id>,
    needed: &mut BTreeSet<Id>,
) -> BTreeMap<Id, Split> {
    let mut open: BTreeMap<Id, Vec<Split>> = BTreeMap::new();
    for dot in dots {
        let Node::Dot(a, b) = *graph.node(*dot) else { continue };
        open.extend(splits(graph, a, b).map(|splits| (*dot, splits)));
    }
    let mut chosen = BTreeMap::new();
    while !open.is_empty() {
        open.retain(|dot, splits| {
            let split = splits.iter().find(|split| missing(graph, split, needed).is_empty());
            if let Some(split) = split {
                chosen.insert(*dot, split.clone());
            }
            split.is_none()
        });
        // A product counts for a dot product that it alone completes.
        let mut serves: BTreeMap<Id, usize> = BTreeMap::new();
        let mut shortest: Option<Vec<Id>> = None;
        for splits in open.values() {
            for split in splits {
                let missing = missing(graph, split, needed);
                if let [product] = missing.as_slice() {
                    *serves.entry(*product).or_default() += 1;
                }
                if shortest.as_ref().is_none_or(|best| missing.len() < best.len()) {
                    shortest = Some(missing);
                }
            }
        }
        let best =
            serves.iter().max_by_key(|(product, count)| (**count, std::cmp::Reverse(**product)));
        match (best, shortest) {
            (Some((product, _)), _) => {
                needed.insert(*product);
            }
            (None, Some(products)) => needed.extend(products),
            (None, None) => {}
        }
    }
    chosen
}

fn missing(graph: &Graph, split: &Split, needed: &BTreeSet<Id>) -> Vec<Id> {
    let mut products: Vec<Id> = parts(graph, split.left);
    products.extend(parts(graph, split.right));
    products.retain(|product| !needed.contains(product));
    products.sort_unstable();
    products.dedup();
    products
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expression::Symmetry;

    #[test]
    fn a_word_that_is_there_serves() {
        let mut g = Graph::new();
        let (x, y) = (g.vector("x"), g.vector("y"));
        let (s, h) = (g.matrix("S", Symmetry::Symmetric), g.matrix("H", Symmetry::Skew));
        let (sy, hx, hy) = (g.apply(s, y), g.apply(h, x), g.apply(h, y));
        let (symmetric, skew) = (g.dot(x, sy), g.dot(x, hy));
        let mut needed = BTreeSet::from([sy, hx]);
        let chosen = choose(&mut g, &BTreeSet::from([symmetric, skew]), &mut needed);
        assert_eq!(needed.len(), 2);
        assert_eq!((chosen[&symmetric].left, chosen[&symmetric].right), (x, sy));
        assert_eq!(chosen[&skew].factor, -Rational::one());
        assert_eq!((chosen[&skew].left, chosen[&skew].right), (hx, y));
    }

    #[test]
    fn the_word_that_serves_most_is_added() {
        let mut g = Graph::new();
        let (x, y, z) = (g.vector("x"), g.vector("y"), g.vector("z"));
        let s = g.matrix("S", Symmetry::Symmetric);
        let (sx, sy, sz) = (g.apply(s, x), g.apply(s, y), g.apply(s, z));
        let dots = BTreeSet::from([g.dot(x, sy), g.dot(z, sy), g.dot(y, sz)]);
        let mut needed = BTreeSet::new();
        choose(&mut g, &dots, &mut needed);
        assert_eq!(needed, BTreeSet::from([sy]));
        let chain = g.apply(s, sx);
        let long = g.dot(y, chain);
        let mut needed = BTreeSet::new();
        let chosen = choose(&mut g, &BTreeSet::from([long]), &mut needed);
        assert_eq!(chosen.len(), 1);
        assert!(needed.len() <= 2);
    }
}
