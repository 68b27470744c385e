//! Rewriting by named rules, where it saves operations.
//!
//! Common factors of sums are not sought here: the schedule does that when it knows how often each value is
//! needed. Sums, products and constants are already in canonical form by construction of the graph.

mod rules;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use num_traits::{One, Signed, ToPrimitive};

use crate::expression::{Function, Graph, Id, Node, Rational};
use crate::operation::Operation;
use rules::*;

/// A rule: the node written anew, or `None` where the rule does not apply.
type Rule = fn(&mut Graph, Id) -> Option<Id>;

/// Every rule by what it says. A rule may make defined what was not, as ln(exp x) = x does for large x,
/// never the reverse.
const RULES: &[(&str, Rule)] = &[
    ("log(exp(a)) = a", |g, id| inverse(g, id, Function::Ln, Function::Exp)),
    ("exp(log(a)) = a", |g, id| inverse(g, id, Function::Exp, Function::Ln)),
    ("tan(atan(a)) = a", |g, id| inverse(g, id, Function::Tan, Function::Atan)),
    ("exp(a)^n*exp(b)^m = exp(n*a + m*b)", product_of_exponentials),
    ("n*log(a) + m*log(b) = log(a^n*b^m), a and b above zero", sum_of_logarithms),
    ("c*sin(a)^2 + c*cos(a)^2 = c", sum_of_squares),
    ("sin(a)^n/cos(a)^n = tan(a)^n", sine_over_cosine),
    ("(exp(a) - exp(-a))/(exp(a) + exp(-a)) = tanh(a)", hyperbolic_tangent),
    ("abs(a)^n = a^n, n even", even_power_of_absolute),
    ("(a^n)^m = abs(a)^(n*m), n even, m broken", root_of_even_power),
    ("select(m, a, select(m, b, c)) = select(m, a, c)", nested_choice),
    ("select(m, a, b) + select(m, c, d) = select(m, a + c, b + d)", sum_of_choices),
    ("select(m, a, b)*select(m, c, d) = select(m, a*c, b*d)", product_of_choices),
    ("select(m, a*c, b*c) = select(m, a, b)*c", factor_of_choice),
];

/// Most nodes of all expressions that are tried: what is not improved then stays as it is.
const TRIED: usize = 2_000_000;

/// The expressions with every rule applied that makes all of them together cheaper to compute.
pub(crate) fn simplify(graph: &mut Graph, roots: &[Id]) -> Vec<Id> {
    simplify_by(RULES, graph, roots)
}

fn simplify_by(rules: &[(&str, Rule)], graph: &mut Graph, roots: &[Id]) -> Vec<Id> {
    let mut roots = roots.to_vec();
    let mut best = cost(graph, &roots);
    let mut budget = TRIED;
    // Every round that goes on has a lower cost than the one before.
    while let Some((better, cost)) = improved(rules, graph, &roots, best, &mut budget) {
        roots = better;
        best = cost;
    }
    roots
}

fn improved(
    rules: &[(&str, Rule)],
    graph: &mut Graph,
    roots: &[Id],
    best: u64,
    budget: &mut usize,
) -> Option<(Vec<Id>, u64)> {
    let nodes = graph.reachable(roots);
    for id in nodes.iter().copied() {
        for (_, rule) in rules {
            let Some(other) = rule(graph, id).filter(|other| *other != id) else { continue };
            // Roots may share nothing, and the cost visits all nodes again.
            *budget = budget.checked_sub(nodes.len() * (roots.len() + 1))?;
            graph.keep(id, other);
            let by = BTreeMap::from([(id, other)]);
            let changed = graph.substitute_all(roots, &by);
            let cost = cost(graph, &changed);
            if cost < best && !graph.exceeded() {
                return Some((changed, cost));
            }
        }
    }
    None
}

/// The weights of the operations that the expressions need, shared ones once, as the schedule weighs them.
fn cost(graph: &Graph, roots: &[Id]) -> u64 {
    let of = |id: &Id| match graph.node(*id) {
        Node::Sum(terms) => {
            let scaled = terms.iter().filter(|(term, c)| !c.abs().is_one() && !graph.is_one(*term));
            (terms.len() - 1 + scaled.count()) as u64
        }
        Node::Product(factors) => {
            factors.iter().map(|(_, exponent)| power_cost(exponent)).sum::<u64>() - 1
        }
        Node::Function(function, _) => Operation::Function(*function, ()).weight(),
        Node::Compare(..) | Node::And(..) | Node::Or(..) | Node::Not(_) | Node::Select(..) => 1,
        Node::Number(_)
        | Node::Zero(_)
        | Node::Identity
        | Node::Symbol(_)
        | Node::Truth(_)
        | Node::Scale(..)
        | Node::Dot(..)
        | Node::Apply(..)
        | Node::Transpose(_)
        | Node::Outer(..) => 0,
    };
    graph.reachable(roots).iter().map(of).sum()
}

/// Cost of one more factor base^exponent.
fn power_cost(exponent: &Rational) -> u64 {
    let size = exponent.abs();
    let power = match size.to_u64() {
        Some(whole) if size.is_integer() => u64::from(whole.max(1).ilog2() + whole.count_ones()),
        _ if size.is_over(2) => 1 + Operation::Sqrt(()).weight(),
        _ => 1 + Operation::Power((), ()).weight(),
    };
    power + if exponent.is_negative() { Operation::Div((), ()).weight() } else { 0 }
}
