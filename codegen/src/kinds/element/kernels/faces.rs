//! Faces of an element: its functions at the points of a rule over each face.

use num_traits::ToPrimitive;
use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::super::{ElementSpec, Table};
use super::table::row;
use crate::emit::number;

/// Functions that are smaller than this all over a face vanish there: the fixed-point numbers behind them are much finer.
const VANISHES: f64 = 1e-12;

/// The entries of the faces in the registry.
pub(super) fn entries(element: &ElementSpec) -> Vec<TokenStream> {
    let cell = element.cell;
    let mut entries = Vec::new();
    for face in cell.faces() {
        let rule = face.rule(element.complete);
        let table = Table::new(cell, &element.shape, &[], &rule);
        let table =
            table.expect("functions that have values within the cell have them on its faces");
        let present = |a: &usize| table.values.iter().any(|point| point[*a].abs() > VANISHES);
        let nodes: Vec<usize> = (0..element.nodes.len()).filter(present).collect();
        let along = face
            .along
            .each_ref()
            .map(|along| along.each_ref().map(|x| x.to_f64().expect("a small number")));
        let points = (0..table.weights.len()).map(|q| {
            let weight = number(table.weights[q]);
            let values: Vec<f64> = nodes.iter().map(|&a| table.values[q][a]).collect();
            let slopes = nodes.iter().map(|&a| {
                let slope = &table.slopes[q][a];
                let [s, t] = along.map(|along| (0..3).map(|k| slope[k] * along[k]).sum::<f64>());
                row(&[s, t])
            });
            let values = row(&values);
            quote!(FacePoint { weight: #weight, values: &#values, slopes: &[#(#slopes),*] })
        });
        let nodes = nodes.iter().map(|&a| Literal::usize_unsuffixed(a));
        let corners = Literal::usize_unsuffixed(face.corners);
        let origin = row(&face.origin.each_ref().map(|x| x.to_f64().expect("a small number")));
        let along = along.iter().map(|along| row(along));
        entries.push(quote! {
            Face {
                nodes: &[#(#nodes),*],
                corners: #corners,
                origin: #origin,
                along: [#(#along),*],
                points: &[#(#points),*],
            }
        });
    }
    entries
}
