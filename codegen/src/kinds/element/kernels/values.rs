//! Kernels of forms in which only the values of the functions occur: Σ_q det J w N_a N_b for every pair of nodes.

use proc_macro2::TokenStream;
use quote::quote;

use super::basis::DET_FLOPS;
use super::cell::{Body, CellForm};
use super::linear::Linear;
use super::table::{Tables, Tangents, row};
use crate::emit::{NumberText, Numbers, count, identifier, number, operand, statements};
use crate::kinds::element::{Products, Table};
use crate::kinds::form::kernels::{PAIR, Pairs};

impl CellForm<'_> {
    /// What the form makes of N_a N_b is a multiple of it, so that det J takes that factor at every point.
    pub(super) fn values_only(&self, pairs: &Pairs, tables: &mut Tables) -> Body {
        let table = self.table(tables);
        let few = table.products.as_ref().and_then(|products| {
            let tangents = Linear::new(&Tangents::new(&table.slopes).rows)?;
            Some((products, Linear::new(&products.rows)?, tangents))
        });
        match few {
            Some((products, sums, tangents)) => {
                self.in_registers(pairs, tables, products, (sums, tangents))
            }
            None => self.in_loops(pairs, tables, table),
        }
    }

    /// Few sums make all tangents and all entries, of which few differ: they stay in registers. What all tangents and
    /// the entries have as a scale goes into the factor, too.
    fn in_registers(
        &self,
        pairs: &Pairs,
        tables: &mut Tables,
        products: &Products,
        (mut sums, mut tangents): (Linear, Linear),
    ) -> Body {
        let form = &self.form.name;
        let scale = tangents.take_scale();
        // det J over that of the tangents without their scale.
        let volume = scale.map(|scale| scale.powi(3));
        let factor = number(volume.unwrap_or(1.0) * sums.take_largest());
        let steps = self.linear_tangents(&tangents, &quote!(tangents));
        let rows = count(tangents.rows.len());
        let least = match volume {
            Some(volume) => {
                let volume = number(volume);
                quote!(least_det * #volume)
            }
            None => quote!(least_det),
        };
        let number_of_points = self.element.table(form).weights.len();
        let points = count(number_of_points);
        let det = |q: usize| {
            let q = count(q);
            quote!(det[#q])
        };
        let (sum_steps, entries) = sums.text(number_of_points, det);
        let places_name = tables.named("PLACES", form);
        let (places, values) =
            (count(products.places.len()), products.places.iter().map(|p| count(*p)));
        tables.add(
            &places_name,
            "The entry of every pair of nodes a ≤ b.",
            quote!([usize; #places]),
            quote!([#(#values),*]),
        );
        let scaled = in_matrix(pairs, &factor);
        let jacobian = self.jacobian(tables, &quote!(tangents));
        let text = quote! {
            let factor = #scaled;
            let mut tangents = [[L::splat(0.0); 3]; #rows];
            for i in 0..3 { #steps }
            let mut det = [L::splat(0.0); #points];
            let mut least_det = L::splat(f64::INFINITY);
            for q in 0..#points {
                #jacobian
                least_det = cells::least(least_det, at.det);
                det[q] = at.det * factor;
            }
            #sum_steps
            let entries = [#(#entries),*];
            for (entry, place) in #places_name.iter().enumerate() {
                matrix.set(entry, &[entries[*place]]);
            }
            #least
        };
        let about = format!(
            "{} different entries of {}. Once a cell: {}, then {}.",
            products.rows.len(),
            products.places.len(),
            pairs.once_counts(),
            pairs.pair_counts()
        );
        let flops = 3 * tangents.flops()
            + number_of_points * (DET_FLOPS + 1)
            + pairs.flops()
            + usize::from(volume.is_some())
            + sums.flops();
        Body { workspace: None, matrix: quote!(mut matrix), text, about, flops }
    }

    /// A loop over the pairs of nodes and one over the points.
    fn in_loops(&self, pairs: &Pairs, tables: &mut Tables, table: &Table) -> Body {
        let form = &self.form.name;
        let (nodes, points) = (self.element.nodes.len(), table.weights.len());
        let (tangents, tangent_flops) = self.tangents(tables, table);
        let (columns, shapes) = (tables.named("COLUMNS", form), tables.named("SHAPES", form));
        let weights = tables.weights(form, &table.weights);
        let (node_count, point_count) = (count(nodes), count(points));
        let values = (0..nodes).map(|a| {
            let values: Vec<f64> = table.values.iter().map(|values| values[a]).collect();
            row(&values)
        });
        tables.add(
            &shapes,
            "N_a at the points.",
            quote!([[f64; #point_count]; #node_count]),
            quote!([#(#values),*]),
        );
        let scaled = in_matrix(pairs, &number(1.0));
        let text = quote! {
            let factor = #scaled;
            #tangents
            let least_det = cells::determinants(
                &workspace.tangents, &#columns, &#weights, factor, &mut workspace.det
            );
            cells::products(&workspace.det, #shapes.as_flattened(), &mut workspace.weighted, matrix);
            least_det
        };
        let pairs_of_nodes = nodes * (nodes + 1) / 2;
        let about = format!(
            "{pairs_of_nodes} pairs × {points} points. Once a cell: {}, then {}.",
            pairs.once_counts(),
            pairs.pair_counts()
        );
        let flops = tangent_flops
            + points * (DET_FLOPS + 2)
            + pairs.flops()
            + nodes * points
            + 2 * pairs_of_nodes * points;
        let rows = count(Tangents::new(&table.slopes).rows.len());
        let workspace = Some(quote!(cells::Scalars<L, #point_count, #rows>));
        Body { workspace, matrix: quote!(matrix), text, about, flops }
    }
}

/// What the form makes of a product N_a N_b whose sum over the points is `sum`; the material's names hold in
/// there only.
fn in_matrix(pairs: &Pairs, sum: &NumberText) -> TokenStream {
    let material = pairs.material.iter().map(|name| identifier(name));
    let (once, pair) = (pairs.once(), statements(&pairs.program, PAIR, Numbers::Fused));
    let name = identifier(&Pairs::name((0, 0)));
    let result = operand(&pairs.program, pairs.program.outputs[0].operand, Numbers::Fused);
    quote! {
        {
            let [#(#material),*] = material;
            #once
            let #name = L::splat(#sum);
            #(#pair)*
            #result
        }
    }
}
