//! Sums over many springs (or points): Σⱼ a·bⱼ = a·Σⱼ bⱼ, so that what all of them share is multiplied
//! once, after the sum.

use std::collections::BTreeMap;

use num_traits::{One, Signed, ToPrimitive};

use crate::expression::{Graph, Id, Node, Rational};

/// Highest power that is multiplied out.
const HIGHEST: u32 = 4;
/// Most parts of one expression; one with more is summed as it is.
const MOST: usize = 256;

/// `expression` = Σ shared · varying, with every `varying` once and free of numbers.
///
/// `varies`: the symbols that differ from spring to spring. Where a function mixes both kinds, it counts as
/// varying.
pub fn take_out(graph: &mut Graph, expression: Id, varies: &[Id]) -> Vec<(Id, Id)> {
    let reachable = graph.reachable(&[expression]);
    let mut depends: BTreeMap<Id, (bool, bool)> = BTreeMap::new();
    let mut parts: BTreeMap<Id, Parts> = BTreeMap::new();
    for id in reachable {
        let node = graph.node(id).clone();
        let is_symbol = matches!(node, Node::Symbol(_));
        let varying = varies.contains(&id);
        let (mut shared, mut own) = (is_symbol && !varying, varying);
        node.operands(|operand| {
            shared |= depends[&operand].0;
            own |= depends[&operand].1;
        });
        depends.insert(id, (shared, own));
        let split = match (shared, own) {
            (_, false) => vec![(id, graph.integer(1))],
            (false, true) => vec![(graph.integer(1), id)],
            (true, true) => mixed(graph, id, &node, &parts),
        };
        parts.insert(id, split);
    }
    let merged = merged(graph, &parts[&expression]);
    let products: Vec<_> = merged.iter().map(|(a, b)| (Rational::one(), *a, *b)).collect();
    graph.keep_sum(expression, &products);
    merged
}

/// Pairs of a shared and a varying factor.
type Parts = Vec<(Id, Id)>;

fn mixed(graph: &mut Graph, id: Id, node: &Node, parts: &BTreeMap<Id, Parts>) -> Parts {
    let whole = |graph: &mut Graph| vec![(graph.integer(1), id)];
    match node {
        Node::Sum(terms) => {
            let mut all = Vec::new();
            for (term, coefficient) in terms {
                for (shared, own) in &parts[term] {
                    all.push((graph.times(coefficient.clone(), *shared), *own));
                }
            }
            if all.len() > MOST { whole(graph) } else { all }
        }
        Node::Product(factors) => {
            let mut all = vec![(graph.integer(1), graph.integer(1))];
            for (base, exponent) in factors {
                let whole_power = exponent.is_integer();
                let count = whole_power.then(|| exponent.abs().to_u32()).flatten();
                let next: (Parts, u32) = match (parts[base].as_slice(), count) {
                    (&[(shared, own)], _)
                        if whole_power || graph.is_one(shared) || graph.is_one(own) =>
                    {
                        let shared = graph.power(shared, exponent.clone());
                        (vec![(shared, graph.power(own, exponent.clone()))], 1)
                    }
                    (sum, Some(count)) if !exponent.is_negative() && count <= HIGHEST => {
                        (sum.to_vec(), count)
                    }
                    _ => {
                        let power = graph.power(*base, exponent.clone());
                        (vec![(graph.integer(1), power)], 1)
                    }
                };
                for _ in 0..next.1 {
                    if all.len() * next.0.len() > MOST {
                        return whole(graph);
                    }
                    all = times(graph, &all, &next.0);
                }
            }
            all
        }
        _ => whole(graph),
    }
}

fn times(graph: &mut Graph, a: &[(Id, Id)], b: &[(Id, Id)]) -> Parts {
    let mut all = Vec::with_capacity(a.len() * b.len());
    for (shared, own) in a {
        for (other_shared, other_own) in b {
            all.push((graph.mul(*shared, *other_shared), graph.mul(*own, *other_own)));
        }
    }
    all
}

/// One part for every varying factor, whose number goes to the shared one.
fn merged(graph: &mut Graph, parts: &[(Id, Id)]) -> Parts {
    let mut sums: BTreeMap<Id, Vec<(Id, Rational)>> = BTreeMap::new();
    for (shared, own) in parts {
        let (coefficient, own) = match graph.node(*own) {
            Node::Sum(terms) if terms.len() == 1 => (terms[0].1.clone(), terms[0].0),
            _ => (Rational::one(), *own),
        };
        sums.entry(own).or_default().push((*shared, coefficient));
    }
    let merged = sums.into_iter().map(|(own, terms)| (graph.sum(&terms), own));
    let merged: Vec<(Id, Id)> = merged.collect();
    merged.into_iter().filter(|(shared, _)| !graph.is_zero(*shared)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expression::normal;

    #[test]
    fn what_is_shared_is_taken_out() {
        let mut g = Graph::new();
        let [x, y, p, q] = ["x", "y", "p", "q"].map(|name| g.scalar(name));
        // (x p + y q)² = x²·p² + 2xy·pq + y²·q².
        let (xp, yq) = (g.mul(x, p), g.mul(y, q));
        let sum = g.add(xp, yq);
        let square = g.power(sum, Rational::from(2));
        let parts = take_out(&mut g, square, &[p, q]);
        assert_eq!(parts.len(), 3);
        let mut total = g.integer(0);
        for (shared, own) in &parts {
            assert!(!g.depends(*shared, p) && !g.depends(*own, x));
            let product = g.mul(*shared, *own);
            total = g.add(total, product);
        }
        assert!(normal::equal(&mut g, total, square));
    }

    #[test]
    fn what_cannot_be_taken_apart_is_summed_whole() {
        let mut g = Graph::new();
        let (x, p) = (g.scalar("x"), g.scalar("p"));
        let sum = g.add(x, p);
        let root = g.sqrt(sum);
        let product = g.mul(x, root);
        let one = g.integer(1);
        assert_eq!(take_out(&mut g, root, &[p]), [(one, root)]);
        assert_eq!(take_out(&mut g, product, &[p]), [(x, root)]);
        assert_eq!(take_out(&mut g, x, &[p]), [(x, one)]);
    }
}
