//! The kernel of a form under the stress of a displacement: the displacement of the cell's own modes first, then its
//! slopes and the coefficients that the stress gives at every point, then the pairs of nodes.

use quote::quote;

use super::cell::{Body, CellForm};
use super::table::{Tables, Tangents};
use crate::emit::{Value, Work, count, identifier};
use crate::kinds::cells;
use crate::kinds::form::kernels::{Pairs, Sizes, once_name, pairs_name, work as form_work};

impl CellForm<'_> {
    pub(super) fn under_stress(&self, pairs: &Pairs, tables: &mut Tables) -> Body {
        let form = self.form.integrated_as();
        let table = self.table(tables);
        let nodes = self.element.nodes.len();
        let modes = self.element.enhanced_in(form).map_or(0, |enhanced| enhanced.modes.len());
        let (total, points) = (nodes + modes, table.weights.len());
        tables.weights(form, &table.weights);
        let fill = self.fill(tables, table, false, None);
        let [nodes_count, given_count, total_count, points_count] =
            [nodes, 2 * nodes, total, points].map(count);
        let module = identifier(&self.spec.name);
        let (once, sums) = (once_name(self.form), pairs_name(self.form));
        let mut about = format!("{points} points.");
        if !self.form.at_points() {
            about = format!("{} pairs × {about}", nodes * (nodes + 1) / 2);
        }
        let sizes = Sizes { functions: total, nodes, points };
        let mut work = Work::new();
        let halves = quote!(cells::halves::<L, #nodes_count, #given_count>(x));
        work.name(quote!([x, displacement]), halves);
        work.bind(
            quote!(once),
            Value::call(quote!(forms::#module::#once(material)), pairs.once().operations()),
        );
        work.then(fill);
        let whole = if let (Some((stress, pairs_of_stress)), 1..) = (self.of_stress, modes) {
            let (of_stress, once_of_stress) = (pairs_name(stress), once_name(stress));
            let taken = self.spec.material_of(stress);
            let places = taken.iter().filter_map(|property| {
                pairs.material.iter().position(|name| *name == property.name).map(count)
            });
            let (modes_count, parameters) = (count(modes), count(3 * modes));
            let whole = count(3 * total * (3 * total + 1) / 2);
            about +=
                &format!(" The {modes} modes follow the displacement as in `{}`.", stress.name);
            let once = quote!(forms::#module::#once_of_stress([#(material[#places]),*]));
            work.bind(
                quote!(once_of_stress),
                Value::call(once, pairs_of_stress.once().operations()),
            );
            // All of the matrix, of which the modes need a part.
            let matrix = quote! {
                forms::#module::#of_stress(
                    workspace.basis.as_flattened(),
                    #points_count,
                    once_of_stress,
                    matrix.beside(&mut workspace.whole),
                )
            };
            let of_matrix = form_work(stress, pairs_of_stress, sizes).operations();
            work.call(Value::call(matrix, of_matrix));
            let follow = quote! {
                cells::follow::<L, #nodes_count, #parameters, #modes_count>(
                    &matrix.beside(&mut workspace.whole),
                    displacement,
                )
            };
            let operations = cells::follow(3 * nodes, 3 * modes);
            work.bind(quote!(modes), Value::call(follow, operations));
            quote!([Batch; #whole])
        } else {
            work.name(quote!(modes), quote!([]));
            quote!(())
        };
        let sums = quote! {
            forms::#module::#sums(
                &workspace.basis, &workspace.roots, [displacement, &modes], once, matrix,
            )
        };
        work.call(Value::call(sums, form_work(self.form, pairs, sizes).operations()));
        work.give(Value::free(quote!(least_det)));
        let rows = count(Tangents::new(&table.slopes).rows.len());
        let workspace = quote!(cells::Workspace<L, #total_count, #points_count, 3, #rows, #whole>);
        let (cell, point) = (pairs.once_counts(), pairs.pair_counts());
        about += &format!(" Once a cell: {cell}; once a point: {point}.");
        Body { workspace: Some(workspace), matrix: quote!(matrix), work, about }
    }
}
