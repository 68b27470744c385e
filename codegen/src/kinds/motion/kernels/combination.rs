//! Linear combinations as text, entry by entry. Entries of coordinates are lanes, those of constant
//! tensors plain numbers; an operation takes its lane on the left.

use proc_macro2::TokenStream;
use quote::quote;

use super::form::Group;
use crate::emit::{Numbers, identifier, number, operand};
use crate::operation::Operand;
use crate::schedule::Program;

/// A text and whether its value is a lane.
#[derive(Debug, Clone)]
pub(super) struct Text {
    pub(super) tokens: TokenStream,
    pub(super) lane: bool,
}

impl Text {
    /// The value as a lane.
    pub(super) fn into_lane(self) -> TokenStream {
        let tokens = self.tokens;
        if self.lane { tokens } else { quote!(L::splat(#tokens)) }
    }
}

/// A text with a sign in front.
struct Addend {
    negative: bool,
    text: Text,
    /// Whether the text is a sum, which needs parentheses in most places.
    sum: bool,
}

/// Σ coefficient · Σ ± entry.
pub(super) fn combination(
    scalars: &Program,
    groups: &[Group<Operand>],
    entry: impl Fn(crate::expression::Id) -> Text,
) -> Text {
    let parts = groups.iter().map(|group| {
        let terms = group.terms.iter().map(|term| Addend {
            negative: term.negative,
            text: entry(term.id),
            sum: false,
        });
        times(scalars, group.coefficient, sum(terms.collect()))
    });
    let total = sum(parts.collect());
    let Addend { negative, text, sum } = total;
    match (negative, sum) {
        (false, _) => text,
        (true, _) => {
            let inner = in_parentheses(&text, sum);
            Text { tokens: quote!(-#inner), lane: text.lane }
        }
    }
}

/// coefficient · value.
fn times(scalars: &Program, coefficient: Operand, value: Addend) -> Addend {
    let inner = in_parentheses(&value.text, value.sum);
    let (tokens, lane) = match coefficient {
        Operand::Constant(1.0) => return value,
        Operand::Constant(constant) => {
            let constant = number(constant);
            (quote!(#inner * #constant), value.text.lane)
        }
        named => {
            let name = operand(scalars, named, Numbers::Lanes);
            (quote!(#name * #inner), true)
        }
    };
    Addend { negative: value.negative, text: Text { tokens, lane }, sum: false }
}

/// Σ ± parts, lanes first, of those a positive one.
fn sum(mut parts: Vec<Addend>) -> Addend {
    parts.sort_by_key(|part| (!part.text.lane, part.negative));
    let mut rest = parts.into_iter();
    let Some(first) = rest.next() else {
        return Addend {
            negative: false,
            text: Text { tokens: quote!(0.0), lane: false },
            sum: false,
        };
    };
    // −a − b is −(a + b).
    let flip = first.negative;
    let mut total = first;
    for part in rest {
        let left = &total.text.tokens;
        let minus = part.negative != flip;
        let right = in_parentheses(&part.text, part.sum && minus);
        let tokens = if minus { quote!(#left - #right) } else { quote!(#left + #right) };
        let lane = total.text.lane || part.text.lane;
        total = Addend { negative: flip, text: Text { tokens, lane }, sum: true };
    }
    total
}

fn in_parentheses(text: &Text, needed: bool) -> TokenStream {
    let tokens = &text.tokens;
    if needed { quote!((#tokens)) } else { quote!(#tokens) }
}

/// `name[index]`.
pub(super) fn entry(name: &str, index: &TokenStream, lane: bool) -> Text {
    let name = identifier(name);
    Text { tokens: quote!(#name[#index]), lane }
}
