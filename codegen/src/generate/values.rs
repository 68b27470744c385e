//! Kernels of forms in which only the values of the functions occur: a few numbers, each at many places.

use quote::quote;

use super::basis::DET_FLOPS;
use super::cell::{Body, CellForm};
use super::linear::Linear;
use super::program::{PAIR, Pairs};
use super::table::{Tables, Tangents, count, row};
use crate::diagnostic::Diagnostics;
use crate::emit::{Numbers, number, operand, statements};

impl CellForm<'_> {
    /// Only N_a N_b occurs, whose products at the points are constants: Σ_q det J w N_a N_b, of which few
    /// differ. What the form makes of N_a N_b is a multiple of it, so that det J takes that factor at every
    /// point, together with what all tangents and the entries have as a scale.
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
        let (mut linear, mut linear_tangents) =
            (Linear::new(&products.rows), Linear::new(&Tangents::new(&table.slopes).rows));
        let scale = linear.as_mut().and(linear_tangents.as_mut()).and_then(Linear::take_scale);
        // det J over that of the tangents without their scale.
        let volume = scale.map(|scale| scale.powi(3));
        let largest = linear.as_mut().map_or(1.0, Linear::take_largest);
        let factor = number(volume.unwrap_or(1.0) * largest);
        let (row_count, tangents, tangent_flops) = match &linear_tangents {
            // Few: they stay in registers, all components at once.
            Some(linear) => {
                let steps = self.linear_tangents(linear, &quote!(tangents));
                let rows = count(linear.rows.len());
                let text = quote! {
                    let mut tangents = [[L::splat(0.0); 3]; #rows];
                    for i in 0..3 { #steps }
                };
                (count(0), text, 3 * linear.flops())
            }
            None => {
                let (text, flops) = self.tangents(tables, table);
                (count(Tangents::new(&table.slopes).rows.len()), text, flops)
            }
        };
        let least = match volume {
            Some(volume) => {
                let volume = number(volume);
                quote!(least_det * #volume)
            }
            None => quote!(least_det),
        };
        let (points, rows, places) = (count(points), count(different), count(pairs_of_nodes));
        let det = |q: usize| {
            let q = count(q);
            quote!(det[#q])
        };
        let sums = match &linear {
            Some(linear) => {
                let (steps, sums) = linear.text(table.weights.len(), det);
                quote! {
                    #steps
                    let entries = [#(#sums),*];
                    for (entry, place) in matrix.iter_mut().zip(&#places_name) {
                        *entry = entries[*place];
                    }
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
                quote! {
                    cells::sums(&det, &#products_name, &mut room.entries);
                    cells::spread(&room.entries, &#places_name, matrix);
                }
            }
        };
        let values = products.places.iter().map(|place| count(*place));
        tables.add(
            &places_name,
            "The row of every pair of nodes a ≤ b.",
            quote!([usize; #places]),
            quote!([#(#values),*]),
        );
        let once = pairs.once();
        let pair = statements(&pairs.program, PAIR, Numbers::Fused);
        let result = operand(&pairs.program, pairs.program.outputs[0].operand, Numbers::Fused);
        let (before, then) = (pairs.once_counts(), pairs.program.counts(PAIR));
        let about = format!(
            "{different} different entries of {pairs_of_nodes}. Once a cell: {before}, then {then}."
        );
        let sums_by_rows = linear.is_none();
        let sum_flops = linear.map_or(2 * different * table.weights.len(), |linear| linear.flops());
        let flops = tangent_flops
            + table.weights.len() * (DET_FLOPS + 1)
            + pairs.flops()
            + usize::from(volume.is_some())
            + sum_flops;
        let columns = tables.named("COLUMNS", form);
        let determinants = match linear_tangents {
            Some(_) => {
                let jacobian = self.jacobian(tables, &quote!(tangents));
                quote! {
                    let mut det = [L::splat(0.0); #points];
                    let mut least_det = L::splat(f64::INFINITY);
                    for q in 0..#points {
                        #jacobian
                        least_det = cells::least(least_det, at.det);
                        det[q] = at.det * s_factor;
                    }
                }
            }
            None => quote! {
                let least_det =
                    cells::determinants(&room.tangents, &#columns, s_factor, &mut room.det);
                let det = &room.det;
            },
        };
        let text = quote! {
            #once
            #tangents
            let s_nn = L::splat(#factor);
            #(#pair)*
            let s_factor = #result;
            #determinants
            #sums
            #least
        };
        let entries = if sums_by_rows { rows } else { count(0) };
        let needs_room = sums_by_rows || linear_tangents.is_none();
        let room = needs_room.then(|| quote!(cells::Scalars<L, #points, #row_count, #entries>));
        Ok(Body { room, text, about, flops })
    }
}
