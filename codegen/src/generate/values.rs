//! Kernels of forms in which only the values of the functions occur: a few numbers, each at many places.

use quote::quote;

use super::basis::DET_FLOPS;
use super::cell::{Body, CellForm};
use super::linear::Linear;
use super::program::{PAIR, Pairs};
use super::table::{Tables, count, row};
use crate::diagnostic::Diagnostics;
use crate::emit::{Numbers, operand, statements};

impl CellForm<'_> {
    /// Only N_a N_b occurs, whose products at the points are constants: Σ_q det J w N_a N_b, of which few
    /// differ.
    pub(super) fn values_only(
        &self,
        pairs: &Pairs,
        tables: &mut Tables,
    ) -> Result<Body, Diagnostics> {
        let form = &self.form.name;
        let table = self.table(tables);
        let points = table.weights.len();
        let products = &table.products;
        let (different, pairs_of_nodes) = (products.rows.len(), products.places.len());
        let (products_name, places_name) =
            (tables.named("PRODUCTS", form), tables.named("PLACES", form));
        let linear = Linear::new(&products.rows);
        let (points, rows, places) = (count(points), count(different), count(pairs_of_nodes));
        let det = |q: usize| {
            let q = count(q);
            quote!(det[#q])
        };
        let sums = match &linear {
            Some(linear) => {
                let (steps, sums) = linear.numbers(table.weights.len(), det);
                quote! {
                    #steps
                    let sums = [#(#sums),*];
                }
            }
            None => {
                let values = products.rows.iter().map(|values| row(values));
                tables.add(
                    &products_name,
                    "w N_a N_b at the points, each different row once.",
                    quote!([[f64; #points]; #rows]),
                    quote!([#(#values),*]),
                );
                quote!(let sums = cells::sums(&det, &#products_name);)
            }
        };
        let values = products.places.iter().map(|place| count(*place));
        tables.add(
            &places_name,
            "The row of every pair of nodes a ≤ b.",
            quote!([usize; #places]),
            quote!([#(#values),*]),
        );
        let (tangents, jacobian) = (self.tangents(tables, table), self.jacobian(tables));
        let once = pairs.once();
        let pair = statements(&pairs.program, PAIR, Numbers::Fused);
        let result = operand(&pairs.program, pairs.program.outputs[0].operand, Numbers::Fused);
        let about = format!("{different} different entries of {pairs_of_nodes}.");
        let sum_flops = linear.map_or(2 * different * table.weights.len(), |linear| linear.flops());
        let flops = self.tangent_flops(table)
            + table.weights.len() * DET_FLOPS
            + sum_flops
            + different * pairs.flops();
        let text = quote! {
            #once
            #tangents
            let mut det = [L::splat(0.0); #points];
            let mut least_det = L::splat(f64::INFINITY);
            for q in 0..#points {
                #jacobian
                det[q] = at.det;
                least_det = cells::least(least_det, det[q]);
            }
            let mut entries = [L::splat(0.0); #rows];
            #sums
            for (entry, s_nn) in entries.iter_mut().zip(&sums) {
                let s_nn = *s_nn;
                #(#pair)*
                *entry = #result;
            }
            for (entry, place) in matrix.iter_mut().zip(&#places_name) {
                *entry = entries[*place];
            }
            least_det
        };
        Ok(Body { room: None, text, about, flops })
    }
}
