//! Values and gradients of all basis functions at all points, as the kernel of a form computes them.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use super::cell::CellForm;
use super::modes::Aligned;
use super::table::{Tables, row, slopes};
use crate::emit::{Numbers, count, names, operand, statements};
use crate::kinds::element::{ModeJacobian, Table};

/// det J by one column's cofactors.
pub(super) const DET_FLOPS: usize = 14;
/// The other columns' cofactors.
const COFACTOR_FLOPS: usize = 18;
/// A gradient by a 3 × 3 map.
const GRADIENT_FLOPS: usize = 15;

impl CellForm<'_> {
    /// Fills `basis[function][point]` with √(w det J) times the parts that the form uses.
    pub(super) fn fill(
        &self,
        tables: &mut Tables,
        table: &Table,
        with_values: bool,
        aligned: Option<&Aligned>,
    ) -> (TokenStream, usize) {
        let form = self.form.integrated_as();
        let enhanced = self.element.enhanced_in(form);
        let nodes = self.element.nodes.len();
        let modes = enhanced.map_or(0, |enhanced| enhanced.modes.len());
        let program = self.point;
        let scales = statements(program, 0, Numbers::Fused);
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
                );
            }
        } else {
            quote!(cells::gradients(&workspace.maps, #slopes_text, #rows.as_flattened_mut());)
        };
        let points = table.weights.len();
        let (tangents, tangent_flops) = self.tangents(tables, table);
        let mut flops = tangent_flops
            + points * (DET_FLOPS + COFACTOR_FLOPS + 9 + program.total_counts().arithmetic())
            + points * nodes * (GRADIENT_FLOPS + usize::from(with_values));
        let (mut centre, mut mode_maps) = (TokenStream::new(), TokenStream::new());
        let (mut keep_mode_map, mut mode_loop) = (TokenStream::new(), TokenStream::new());
        if let Some(enhanced) = enhanced {
            let uses_centre = enhanced.jacobian == ModeJacobian::Centre;
            let used = scales.iter().chain([&mode]).any(|text| names(text).contains("det0"));
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
                flops += 18 * nodes + DET_FLOPS;
                centre = quote!(let centre = cells::centre(x, &CENTRE_TANGENTS_););
            }
            if used {
                centre.extend(quote!(let det0 = centre.det;));
            }
            if let Some(aligned) = aligned {
                [mode_maps, keep_mode_map] = aligned.fill(tables, form, &mode);
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
                flops += points * (9 + modes * GRADIENT_FLOPS);
                mode_maps = quote!(let mut mode_maps = [[[L::splat(0.0); 3]; 3]; #points_count];);
                keep_mode_map = quote!(mode_maps[q] = #map.map(#mode););
                let (slopes_text, rows) = (
                    quote!(#mode_slopes.as_flattened()),
                    quote!(workspace.basis[#nodes_count..].as_flattened_mut()),
                );
                mode_loop = if with_values {
                    quote! {
                        let (none, zeros) =
                            ([L::splat(0.0); #points_count], [0.0; #points_count * #modes_count]);
                        cells::values_and_gradients(&mode_maps, #slopes_text, &none, &zeros, #rows);
                    }
                } else {
                    quote!(cells::gradients(&mode_maps, #slopes_text, #rows);)
                };
            }
        }
        let maps = match enhanced {
            None => {
                let columns = tables.named("COLUMNS", form);
                quote! {
                    let least_det = cells::maps(
                        &workspace.tangents, &#columns, &#weights, &mut workspace.maps, &mut workspace.roots
                    );
                }
            }
            Some(_) => {
                let jacobian = self.jacobian(tables, &quote!(workspace.tangents));
                let with_roots = with_values || self.form.stress.is_some();
                let keep_root = with_roots.then(|| quote!(workspace.roots[q] = #root;));
                quote! {
                    let mut least_det = L::splat(f64::INFINITY);
                    #mode_maps
                    for q in 0..cells::looped(#points_count) {
                        #jacobian
                        let (det, weight) = (at.det, L::splat(#weights[q]));
                        least_det = cells::least(least_det, det);
                        #(#scales)*
                        workspace.maps[q] = at.map(#nodal);
                        #keep_root
                        #keep_mode_map
                    }
                }
            }
        };
        let text = quote! {
            #centre
            #tangents
            #maps
            #node
            #mode_loop
        };
        (text, flops)
    }
}
