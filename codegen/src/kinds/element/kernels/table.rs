//! Constant tables of an element's kernels, and small pieces of text.

use std::collections::BTreeMap;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::ElementSpec;
use crate::emit::{count, documented, number};

/// The tables that kernels of an element read, each once.
pub(super) struct Tables<'a> {
    element: &'a ElementSpec,
    items: BTreeMap<String, Item>,
    /// Whether the kernel at hand is another element's, which has these tables, too.
    pub(super) elsewhere: bool,
}

struct Item {
    text: TokenStream,
    /// Whether a kernel of this element reads it.
    read: bool,
}

impl<'a> Tables<'a> {
    pub(super) fn new(element: &'a ElementSpec) -> Self {
        Tables { element, items: BTreeMap::new(), elsewhere: false }
    }

    /// Those that kernels of this element read.
    pub(super) fn read(&self) -> TokenStream {
        self.items.values().filter(|item| item.read).map(|item| item.text.clone()).collect()
    }

    /// All, also those that its kernels read elsewhere.
    pub(super) fn all(&self) -> TokenStream {
        self.items.values().map(|item| item.text.clone()).collect()
    }

    /// The identifier of a table for a form; tables of the common rule have no form in their name.
    pub(super) fn named(&self, table: &str, form: &str) -> Ident {
        match self.element.quadrature_of.contains_key(form) {
            true => format_ident!("{}_{}_", table, form.to_uppercase()),
            false => format_ident!("{}_", table),
        }
    }

    /// The weights of the points for a form.
    pub(super) fn weights(&mut self, form: &str, weights: &[f64]) -> Ident {
        let (name, points) = (self.named("WEIGHTS", form), count(weights.len()));
        self.add(&name, "Weights of the points.", quote!([f64; #points]), row(weights));
        name
    }

    pub(super) fn add(
        &mut self,
        name: &Ident,
        about: &str,
        kind: TokenStream,
        values: TokenStream,
    ) {
        let about = documented(about);
        let text = quote!(#about const #name: #kind = #values;);
        let item = self.items.entry(name.to_string()).or_insert(Item { text, read: false });
        item.read |= !self.elsewhere;
    }
}

pub(super) fn row(values: &[f64]) -> TokenStream {
    let values = values.iter().map(|value| number(*value));
    quote!([#(#values),*])
}

pub(super) fn slopes(rows: &[[f64; 3]]) -> TokenStream {
    let rows = rows.iter().map(|slope| row(slope));
    quote!([#(#rows),*])
}

/// The rows Σ_a x_a row_a = ∂x/∂ξ_k of all points, each different one once: along ξ a tangent of a brick does
/// not change with ξ.
pub(super) struct Tangents {
    /// rows × nodes.
    pub(super) rows: Vec<Vec<f64>>,
    /// points × (ξ, η, ζ): places of the rows.
    pub(super) columns: Vec<[usize; 3]>,
}

impl Tangents {
    /// From the slopes, points × nodes × (ξ, η, ζ).
    pub(super) fn new(slopes: &[Vec<[f64; 3]>]) -> Self {
        let mut rows: Vec<Vec<f64>> = Vec::new();
        let mut place = |row: Vec<f64>| {
            rows.iter().position(|known| *known == row).unwrap_or_else(|| {
                rows.push(row);
                rows.len() - 1
            })
        };
        let columns = slopes
            .iter()
            .map(|nodes| [0, 1, 2].map(|k| place(nodes.iter().map(|slope| slope[k]).collect())))
            .collect();
        Tangents { rows, columns }
    }
}
