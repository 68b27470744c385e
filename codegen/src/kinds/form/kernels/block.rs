//! From sums over the points of products of the parts of two basis functions to what a form makes of them.

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream, TokenTree};
use quote::{ToTokens, format_ident, quote};

use super::pairs::{PAIR, Pairs};
use crate::emit::{Numbers, count, documented, identifier, names, statements};
use crate::kinds::form::{Form, FormSpec, Structure};

/// Name of the function of what is computed once a cell.
pub(in crate::kinds) fn once_name(form: &Form) -> Ident {
    format_ident!("{}_once_", identifier(&form.name))
}

/// Name of the function of what is computed once a pair.
pub(in crate::kinds) fn block_name(form: &Form) -> Ident {
    format_ident!("{}_block_", identifier(&form.name))
}

/// What a form makes of the sums: functions that its own loops and kernels of modes call.
pub(super) struct Block<'a> {
    form: &'a Form,
    pairs: &'a Pairs,
    /// What is computed once a cell and used once a pair.
    pub(super) once: Vec<Ident>,
    /// The components from the sums.
    body: TokenStream,
}

impl<'a> Block<'a> {
    pub(super) fn new(form: &'a Form, pairs: &'a Pairs) -> Self {
        let statements = statements(&pairs.program, PAIR, Numbers::Fused);
        let result = match form.structure {
            Structure::Kronecker { .. } if !pairs.under_stress => pairs.outputs()[0].clone(),
            _ => pairs.block(),
        };
        let body = quote!(#(#statements)* #result);
        let used = names(&body);
        let material = pairs.material.iter().map(|name| identifier(name));
        let mut known: Vec<Ident> = material.collect();
        known.extend(bound(&pairs.once().to_token_stream()));
        let mut seen = BTreeSet::new();
        let once = known.into_iter().filter(|name| {
            let name = name.to_string();
            used.contains(&name) && seen.insert(name)
        });
        Block { form, pairs, once: once.collect(), body }
    }

    /// Both functions.
    pub(super) fn functions(&self, spec: &FormSpec) -> TokenStream {
        let Block { form, pairs, once, body } = self;
        let material: Vec<Ident> = pairs.material.iter().map(|name| identifier(name)).collect();
        let (length, parts) = (count(once.len()), count(pairs.parts().len()));
        let taken = pairs.taken();
        let sums = taken.iter().map(|row| {
            let row = row.iter().map(|name| match name {
                Some(name) if names(body).contains(name) => identifier(name),
                _ => format_ident!("_"),
            });
            quote!([#(#row),*])
        });
        let (name, once_name, statements) = (block_name(form), once_name(form), pairs.once());
        let properties: Vec<String> = (spec.material_of(form).iter())
            .map(|property| format!("{} ({})", property.name, property.unit))
            .collect();
        let about_once = format!(
            "`{}`: what all pairs of a cell share, from {}: {}.",
            form.name,
            properties.join(", "),
            pairs.once_counts()
        );
        let (result, what) = match form.structure {
            _ if form.at_points() => {
                (quote!([[L; 3]; 3]), "the components at a point by the slopes of the displacement")
            }
            _ if pairs.under_stress => (
                quote!([[L; 3]; 3]),
                "the coefficients of products of gradients at a point by the slopes of the displacement",
            ),
            Structure::Kronecker { .. } => (
                quote!(L),
                "the entry of a pair of basis functions by the sums of their products over the points",
            ),
            _ => (
                quote!([[L; 3]; 3]),
                "the components of a pair of basis functions by the sums of their products over the points",
            ),
        };
        let about = format!("`{}`: {what}: {}.", form.name, pairs.pair_counts());
        let (about_once, about) = (documented(&about_once), documented(&about));
        let properties_count = count(material.len());
        quote! {
            #about_once
            #[inline(always)]
            pub fn #once_name<L: Lane>([#(#material),*]: [L; #properties_count]) -> [L; #length] {
                #statements
                [#(#once),*]
            }
            #about
            #[inline(always)]
            pub fn #name<L: Lane>(
                sums: [[L; #parts]; #parts],
                once: [L; #length],
            ) -> #result {
                let [#(#sums),*] = sums;
                let [#(#once),*] = once;
                #body
            }
        }
    }
}

/// The variables that statements declare, in their order.
fn bound(statements: &TokenStream) -> Vec<Ident> {
    let tokens: Vec<TokenTree> = statements.clone().into_iter().collect();
    let declared = tokens.windows(2).filter_map(|pair| match pair {
        [TokenTree::Ident(word), TokenTree::Ident(name)] if word == "let" => Some(name.clone()),
        _ => None,
    });
    declared.collect()
}

impl Pairs {
    /// The sums of a function with itself that differ: s_yx = s_xy there.
    pub(in crate::kinds) fn different(&self) -> usize {
        let mirrored = |(i, j): &&(usize, usize)| i > j && self.moments.contains(&(*j, *i));
        self.moments.len() - self.moments.iter().filter(mirrored).count()
    }
}
