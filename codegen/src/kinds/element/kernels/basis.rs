//! Values and gradients of all basis functions at all points, as the kernel of a form computes them.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::cell::CellForm;
use super::modes::Aligned;
use super::table::{Tables, row, slopes};
use crate::emit::{Numbers, Size, Value, Work, count, names, operand};
use crate::kinds::cells;
use crate::kinds::element::{ModeJacobian, Table};

impl CellForm<'_> {
    /// Fills `basis[function][point]` with √(w det J) times the parts that the form uses.
    pub(super) fn fill(
        &self,
        tables: &mut Tables,
        table: &Table,
        with_values: bool,
        aligned: Option<&Aligned>,
    ) -> Work {
        let form = self.form.integrated_as();
        let enhanced = self.element.enhanced_in(form);
        let nodes = self.element.nodes.len();
        let modes = enhanced.map_or(0, |enhanced| enhanced.modes.len());
        let program = self.point;
        let mut scales = Work::new();
        scales.stage(program, 0, Numbers::Fused);
        let scale = |name: &str| match program.output(name) {
            Some(found) => operand(program, found, Numbers::Lanes),
            None => TokenStream::new(),
        };
        let (root, nodal, mode) = (scale("root"), scale("nodal"), scale("mode"));
        let (nodes_count, points_count) = (count(nodes), count(table.weights.len()));
        let modes_count = count(modes);
        let (weights, slopes_name) = (tables.named("WEIGHTS", form), tables.named("SLOPES", form));
        let rows = table.slopes.iter().map(|rows| slopes(rows));
        tables.add(
            &slopes_name,
            "∂N_a/∂(ξ, η, ζ) at the points.",
            quote!([[[f64; 3]; #nodes_count]; #points_count]),
            quote!([#(#rows),*]),
        );
        let (slopes_text, rows) =
            (quote!(#slopes_name.as_flattened()), quote!(workspace.basis[..#nodes_count]));
        let node = if with_values {
            let values = tables.named("VALUES", form);
            let rows_of = table.values.iter().map(|values| row(values));
            tables.add(
                &values,
                "N_a at the points.",
                quote!([[f64; #nodes_count]; #points_count]),
                quote!([#(#rows_of),*]),
            );
            quote! {
                cells::values_and_gradients(
                    &workspace.maps, #slopes_text, &workspace.roots, #values.as_flattened(), #rows.as_flattened_mut()
                )
            }
        } else {
            quote!(cells::gradients(&workspace.maps, #slopes_text, #rows.as_flattened_mut()))
        };
        let points = table.weights.len();
        let node = Value::call(node, cells::gradients(points, nodes, with_values));
        let [mut work, mut mode_maps, mut at_mode, mut of_modes] = [const { Work::new() }; 4];
        if let Some(enhanced) = enhanced {
            let uses_centre = enhanced.jacobian == ModeJacobian::Centre;
            let used = names(&quote!(#scales #mode)).contains("det0");
            if uses_centre || used {
                let rows = [0, 1, 2].map(|k| {
                    let values: Vec<f64> = table.centre_slopes.iter().map(|s| s[k]).collect();
                    row(&values)
                });
                tables.add(
                    &format_ident!("CENTRE_TANGENTS_"),
                    "Coefficients of the nodes in ∂x/∂ξ, ∂x/∂η and ∂x/∂ζ at the centre.",
                    quote!([[f64; #nodes_count]; 3]),
                    quote!([#(#rows),*]),
                );
                let along = |k| uses_centre && aligned.is_none_or(|modes| modes.along(k));
                let operations = cells::tangents(nodes, 3) + cells::jacobian(used, along);
                let centre = quote!(cells::centre(x, &CENTRE_TANGENTS_));
                work.bind(quote!(centre), Value::call(centre, operations));
            }
            if used {
                work.name(quote!(det0), quote!(centre.det));
            }
            if let Some(aligned) = aligned {
                [mode_maps, at_mode] = aligned.fill(tables, form, &mode);
            } else {
                let mode_slopes = tables.named("MODE_SLOPES", form);
                let rows = table.mode_slopes.iter().map(|rows| slopes(rows));
                tables.add(
                    &mode_slopes,
                    "∂M_m/∂(ξ, η, ζ) at the points.",
                    quote!([[[f64; 3]; #modes_count]; #points_count]),
                    quote!([#(#rows),*]),
                );
                let map = match enhanced.jacobian {
                    ModeJacobian::Centre => quote!(centre),
                    ModeJacobian::Point => quote!(at),
                };
                let zeros = quote!([[[L::splat(0.0); 3]; 3]; #points_count]);
                mode_maps.name(quote!(mut mode_maps), zeros);
                let map = Value::call(quote!(#map.map(#mode)), cells::MAP);
                at_mode.store(quote!(mode_maps[q]), map);
                let (slopes_text, rows) = (
                    quote!(#mode_slopes.as_flattened()),
                    quote!(workspace.basis[#nodes_count..].as_flattened_mut()),
                );
                let gradients = if with_values {
                    of_modes.name(
                        quote!((none, zeros)),
                        quote!(([L::splat(0.0); #points_count], [0.0; #points_count * #modes_count])),
                    );
                    quote!(cells::values_and_gradients(&mode_maps, #slopes_text, &none, &zeros, #rows))
                } else {
                    quote!(cells::gradients(&mode_maps, #slopes_text, #rows))
                };
                let operations = cells::gradients(points, modes, with_values);
                of_modes.call(Value::call(gradients, operations));
            }
        }
        work.then(self.tangents(tables, table));
        if enhanced.is_none() {
            let columns = tables.named("COLUMNS", form);
            let maps = quote! {
                cells::maps(
                    &workspace.tangents, &#columns, &#weights, &mut workspace.maps, &mut workspace.roots
                )
            };
            work.bind(quote!(least_det), Value::call(maps, cells::maps(points)));
        } else {
            let whole = cells::jacobian(true, |_| true);
            let mut point = self.jacobian(tables, &quote!(workspace.tangents), whole);
            point.name(quote!((det, weight)), quote!((at.det, L::splat(#weights[q]))));
            point.store(quote!(least_det), Value::free(quote!(cells::least(least_det, det))));
            point.then(scales);
            point.store(quote!(workspace.maps[q]), Value::call(quote!(at.map(#nodal)), cells::MAP));
            if with_values || self.form.stress.is_some() {
                point.store(quote!(workspace.roots[q]), Value::free(root));
            }
            point.then(at_mode);
            work.name(quote!(mut least_det), quote!(L::splat(f64::INFINITY)));
            work.then(mode_maps);
            work.kept("q", Size::Number(points), point);
        }
        work.call(node);
        work.then(of_modes);
        work
    }
}
