//! Sums over the points of products of the parts of two basis functions.

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::program::{PAIR, Pairs};
use crate::emit::{Numbers, identifier, statements};

/// The sums that a form needs.
pub(super) struct Sums<'a> {
    pub(super) pairs: &'a Pairs,
}

impl Sums<'_> {
    /// The sums of a function with itself that differ: s_yx = s_xy there.
    pub(super) fn different(&self) -> usize {
        self.pairs.moments.iter().filter(|moment| self.twin(**moment).is_none()).count()
    }

    /// The sum that is the same for a function with itself.
    fn twin(&self, (i, j): (usize, usize)) -> Option<(usize, usize)> {
        (i > j && self.pairs.moments.contains(&(j, i))).then_some((j, i))
    }

    /// The sums for the pair (a, b), then the components. `same`: a = b.
    pub(super) fn text(&self, same: bool) -> TokenStream {
        let parts = self.pairs.parts();
        let (twins, own): (Vec<_>, Vec<_>) =
            self.pairs.moments.iter().partition(|moment| same && self.twin(**moment).is_some());
        let parts_of = |side: &str, place: fn(&(usize, usize)) -> usize| -> Vec<Ident> {
            let of = |part: &usize| own.iter().any(|moment| place(moment) == *part);
            let prefix = |part: &usize| if of(part) { "" } else { "_" };
            parts
                .iter()
                .map(|p| format_ident!("{}{side}_{}", prefix(p), Pairs::PARTS[*p]))
                .collect()
        };
        let (test, trial) = (parts_of("a", |m| m.0), parts_of("b", |m| m.1));
        let name = |moment: &(usize, usize)| identifier(&Pairs::name(*moment));
        let sums: Vec<Ident> = own.iter().map(&name).collect();
        let at = |part: usize| parts.iter().position(|p| *p == part).unwrap_or(0);
        let products = own.iter().zip(&sums).map(|((i, j), sum)| {
            let (a, b) = (&test[at(*i)], &trial[at(*j)]);
            quote!(#a.mul_add(#b, #sum))
        });
        let copies = twins.iter().map(|(i, j)| {
            let (sum, twin) = (name(&(*i, *j)), name(&(*j, *i)));
            quote!(let #sum = #twin;)
        });
        let statements = statements(&self.pairs.program, PAIR, Numbers::Fused);
        quote! {
            #(let mut #sums = L::splat(0.0);)*
            for (a_q, b_q) in of_a.iter().zip(of_b) {
                let ([#(#test),*], [#(#trial),*]) = (*a_q, *b_q);
                #(#sums = #products;)*
            }
            #(#copies)*
            #(#statements)*
        }
    }
}
