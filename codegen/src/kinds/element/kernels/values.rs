//! Kernels of forms in which only the values of the functions occur: Σ_q det J w N_a N_b for every pair of nodes.

use quote::quote;

use super::cell::{Body, CellForm};
use super::linear::Linear;
use super::table::{Tables, Tangents, row};
use crate::emit::{Head, Loop, NumberText, Numbers, Size, Value, Work, count, identifier, number};
use crate::kinds::cells;
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
        let rows = count(tangents.rows.len());
        let number_of_points = self.element.table(form).weights.len();
        let points = count(number_of_points);
        let det = |q: usize| {
            let q = count(q);
            quote!(det[#q])
        };
        let (sum_steps, entries) = sums.work(number_of_points, det);
        let places_name = tables.named("PLACES", form);
        let (places, values) =
            (count(products.places.len()), products.places.iter().map(|p| count(*p)));
        tables.add(
            &places_name,
            "The entry of every pair of nodes a ≤ b.",
            quote!([usize; #places]),
            quote!([#(#values),*]),
        );
        let mut work = Work::new();
        work.bind(quote!(factor), in_matrix(pairs, &factor));
        work.name(quote!(mut tangents), quote!([[L::splat(0.0); 3]; #rows]));
        work.each("i", 3, self.linear_tangents(&tangents, &quote!(tangents)));
        work.name(quote!(mut det), quote!([L::splat(0.0); #points]));
        work.name(quote!(mut least_det), quote!(L::splat(f64::INFINITY)));
        let mut point = self.jacobian(tables, &quote!(tangents), cells::jacobian(true, |_| false));
        let [det, factor] = [quote!(at.det), quote!(factor)].map(Value::free);
        point.store(quote!(least_det), Value::free(quote!(cells::least(least_det, at.det))));
        point.store(quote!(det[q]), det * factor);
        work.each("q", number_of_points, point);
        work.then(sum_steps);
        work.bind(quote!(entries), Value::list(&entries));
        let mut write = Work::new();
        write.call(Value::free(quote!(matrix.set(entry, &[entries[*place]]))));
        work.repeat(Loop {
            index: "entry",
            from: Size::Number(0),
            to: Size::Number(products.places.len()),
            head: Head::Over(quote!((entry, place)), quote!(#places_name.iter().enumerate())),
            body: write,
        });
        let least = Value::free(quote!(least_det));
        work.give(match volume.map(number) {
            Some(volume) => least * Value::free(quote!(#volume)),
            None => least,
        });
        let about = format!(
            "{} different entries of {}. Once a cell: {}, then {}.",
            products.rows.len(),
            products.places.len(),
            pairs.once_counts(),
            pairs.pair_counts()
        );
        Body { workspace: None, matrix: quote!(mut matrix), work, about }
    }

    /// A loop over the pairs of nodes and one over the points.
    fn in_loops(&self, pairs: &Pairs, tables: &mut Tables, table: &Table) -> Body {
        let form = &self.form.name;
        let (nodes, points) = (self.element.nodes.len(), table.weights.len());
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
        let mut work = Work::new();
        work.bind(quote!(factor), in_matrix(pairs, &number(1.0)));
        work.then(self.tangents(tables, table));
        let det = quote! {
            cells::determinants(
                &workspace.tangents, &#columns, &#weights, factor, &mut workspace.det
            )
        };
        work.bind(quote!(least_det), Value::call(det, cells::determinants(points)));
        let products = quote! {
            cells::products(&workspace.det, #shapes.as_flattened(), &mut workspace.weighted, matrix)
        };
        work.call(Value::call(products, cells::products(nodes, points)));
        work.give(Value::free(quote!(least_det)));
        let pairs_of_nodes = nodes * (nodes + 1) / 2;
        let about = format!(
            "{pairs_of_nodes} pairs × {points} points. Once a cell: {}, then {}.",
            pairs.once_counts(),
            pairs.pair_counts()
        );
        let rows = count(Tangents::new(&table.slopes).rows.len());
        let workspace = Some(quote!(cells::Scalars<L, #point_count, #rows>));
        Body { workspace, matrix: quote!(matrix), work, about }
    }
}

/// What the form makes of a product N_a N_b whose sum over the points is `sum`; the material's names hold in
/// there only.
fn in_matrix(pairs: &Pairs, sum: &NumberText) -> Value {
    let material = pairs.material.iter().map(|name| identifier(name));
    let name = identifier(&Pairs::name((0, 0)));
    let mut work = Work::new();
    work.name(quote!([#(#material),*]), quote!(material));
    work.then(pairs.once());
    work.name(quote!(#name), quote!(L::splat(#sum)));
    work.stage(&pairs.program, PAIR, Numbers::Fused);
    work.give(Value::free(pairs.outputs()[0].clone()));
    Value::block(&work)
}
