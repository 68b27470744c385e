//! The kernel of a form under the stress of a displacement: the displacement of the cell's own modes first, then its
//! slopes and the coefficients that the stress gives at every point, then the pairs of nodes.

use quote::quote;

use super::cell::{Body, CellForm};
use super::table::{Tables, Tangents};
use crate::emit::{count, identifier};
use crate::kinds::form::kernels::{Pairs, once_name, pairs_name};

/// Operations of a slope, and of a pair at a point.
const SLOPE_FLOPS: usize = 18;
const WEIGHT_FLOPS: usize = 18;
const PRODUCT_FLOPS: usize = 6;

impl CellForm<'_> {
    pub(super) fn under_stress(&self, pairs: &Pairs, tables: &mut Tables) -> Body {
        let form = self.form.integrated_as();
        let table = self.table(tables);
        let nodes = self.element.nodes.len();
        let modes = self.element.enhanced_in(form).map_or(0, |enhanced| enhanced.modes.len());
        let (total, points) = (nodes + modes, table.weights.len());
        tables.weights(form, &table.weights);
        let (fill, fill_flops) = self.fill(tables, table, false, None);
        let [nodes_count, given_count, total_count, points_count] =
            [nodes, 2 * nodes, total, points].map(count);
        let module = identifier(&self.spec.name);
        let (once, sums) = (once_name(self.form), pairs_name(self.form));
        let mut flops = fill_flops + points * (total * SLOPE_FLOPS + 9 + pairs.flops());
        let mut about = format!("{points} points.");
        if !self.at_points() {
            let pair_count = nodes * (nodes + 1) / 2;
            flops += points * (nodes * WEIGHT_FLOPS + pair_count * PRODUCT_FLOPS);
            about = format!("{pair_count} pairs × {about}");
        }
        let (whole, follow) = if modes > 0 {
            let stress = self.stress_form();
            let (of_stress, once_of_stress) = (pairs_name(stress), once_name(stress));
            let taken = self.spec.material_of(stress);
            let places = taken.iter().filter_map(|property| {
                pairs.material.iter().position(|name| *name == property.name).map(count)
            });
            let (modes_count, parameters) = (count(modes), count(3 * modes));
            let whole = count(3 * total * (3 * total + 1) / 2);
            // The matrix of the form that gives the stress, as far as the modes need it: rarely, so all of it.
            flops += 2 * 9 * points * total * (total + 1) / 2 + 2 * 9 * modes * (nodes + 3 * modes);
            about +=
                &format!(" The {modes} modes follow the displacement as in `{}`.", stress.name);
            (
                quote!([Batch; #whole]),
                quote! {
                    let once_of_stress = forms::#module::#once_of_stress([#(material[#places]),*]);
                    forms::#module::#of_stress(
                        workspace.basis.as_flattened(),
                        #points_count,
                        once_of_stress,
                        matrix.beside(&mut workspace.whole),
                    );
                    let modes = cells::follow::<L, #nodes_count, #parameters, #modes_count>(
                        &matrix.beside(&mut workspace.whole),
                        displacement,
                    );
                },
            )
        } else {
            (quote!(()), quote!(let modes = [];))
        };
        let text = quote! {
            let [x, displacement] = cells::halves::<L, #nodes_count, #given_count>(x);
            let once = forms::#module::#once(material);
            #fill
            #follow
            forms::#module::#sums(
                &workspace.basis, &workspace.roots, [displacement, &modes], once, matrix,
            );
            least_det
        };
        let rows = count(Tangents::new(&table.slopes).rows.len());
        let workspace = quote!(cells::Workspace<L, #total_count, #points_count, 3, #rows, #whole>);
        let (cell, point) = (pairs.once_counts(), pairs.pair_counts());
        about += &format!(" Once a cell: {cell}; once a point: {point}.");
        Body { workspace: Some(workspace), matrix: quote!(matrix), text, about, flops }
    }

    /// The form that gives the stress, of the same set.
    fn stress_form(&self) -> &crate::kinds::form::Form {
        let name = self.form.integrated_as();
        self.spec.forms.iter().find(|form| form.name == name).unwrap_or(self.form)
    }
}
