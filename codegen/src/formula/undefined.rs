//! Operations that have no value, as far as their operands are known: one check for all that makes expressions of
//! formulas.

use num_traits::{Signed, Zero};

use crate::expression::{Graph, Id, normal};
use crate::rational::Rational;

/// Why nothing can be divided by this, if so.
pub(crate) fn division(graph: &Graph, divisor: Id) -> Option<&'static str> {
    constant(graph, divisor).filter(Zero::is_zero).map(|_| "division by zero")
}

/// Why base^exponent has no value, if so.
pub(crate) fn power(graph: &Graph, base: Id, exponent: &Rational) -> Option<&'static str> {
    let base = match exponent.is_integer() && !exponent.is_negative() {
        true => return None,
        false => constant(graph, base)?,
    };
    if base.is_negative() && !exponent.is_integer() {
        return Some("a fractional power of a negative number");
    }
    (base.is_zero() && exponent.is_negative()).then_some("division by zero")
}

/// The number that an expression is, whatever its symbols are. It is multiplied out only where its values say that it may
/// be one.
fn constant(graph: &Graph, id: Id) -> Option<Rational> {
    if let Some(number) = graph.as_number(id) {
        return Some(number.clone());
    }
    if !graph.seems_constant(id) {
        return None;
    }
    let mut trial = graph.clone();
    let expanded = normal::expand(&mut trial, id);
    let number = trial.as_number(expanded).cloned();
    number.filter(|_| !trial.exceeded())
}
