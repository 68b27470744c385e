//! The kernel of one form on one cell: a loop over the points of the rule, then one over pairs of basis
//! functions, with the components of a pair unrolled.

use std::collections::BTreeSet;

use proc_macro2::{Ident, TokenStream};
use quote::{format_ident, quote};

use super::element::lane_name;
use super::facts::unscheduled;
use super::program::{PAIR, Pairs, point_program};
use super::table::{Tables, count, names, row, slopes};
use crate::diagnostic::Diagnostics;
use crate::element::Table;
use crate::emit::{Numbers, documented, identifier, operand, statements};
use crate::form::Structure;
use crate::spec::element::{ElementSpec, ModeJacobian};
use crate::spec::form::{Form, FormSpec};

/// A form on an element.
pub(super) struct CellForm<'a> {
    pub(super) element: &'a ElementSpec,
    pub(super) spec: &'a FormSpec,
    pub(super) form: &'a Form,
}

impl CellForm<'_> {
    /// The functions of the form: over lanes, and over blocks of cells.
    pub(super) fn functions(&self, tables: &mut Tables) -> Result<TokenStream, Diagnostics> {
        let pairs = Pairs::new(self.spec, self.form)
            .map_err(|error| unscheduled(&self.spec.file, &error))?;
        let values_only = pairs.moments.iter().all(|moment| *moment == (0, 0));
        let kronecker = matches!(self.form.structure, Structure::Kronecker { .. });
        let (body, about) = if values_only && kronecker {
            self.values_only(&pairs, tables)?
        } else {
            self.general(&pairs, tables)?
        };
        let (nodes, len) = (count(self.element.nodes.len()), count(self.stored()));
        let material: Vec<Ident> = pairs.material.iter().map(|name| identifier(name)).collect();
        let places = (0..material.len()).map(count);
        let (function, lane) = (identifier(&self.form.name), lane_name(&self.form.name));
        let about_lane = documented(&self.header(&pairs, &about));
        let about_block = documented(&format!(
            "`{}` of a block of cells: see [`crate::CellKernel`].",
            self.form.name
        ));
        Ok(quote! {
            #about_lane
            #[inline(always)]
            pub fn #lane<L: Lane>(x: &[[L; 3]; #nodes], #(#material: L,)* matrix: &mut [L; #len]) -> L {
                #body
            }
            #about_block
            pub fn #function(
                coordinates: &[f64],
                material: &[f64],
                matrices: &mut [f64],
                jacobians: &mut [f64],
            ) {
                cells::each_cell::<#nodes, #len>(coordinates, matrices, jacobians, |x, matrix| {
                    #lane(x, #(material[#places],)* matrix)
                });
            }
        })
    }

    /// Stored values of a cell.
    fn stored(&self) -> usize {
        let (nodes, size) = (self.element.nodes.len(), 3 * self.element.nodes.len());
        match self.form.structure {
            Structure::Symmetric => size * (size + 1) / 2,
            Structure::Full => size * size,
            Structure::Kronecker { .. } => nodes * (nodes + 1) / 2,
        }
    }

    fn header(&self, pairs: &Pairs, about: &str) -> String {
        let (nodes, form) = (self.element.nodes.len(), self.form);
        let (size, stored) = (3 * nodes, self.stored());
        let matrix = match &form.structure {
            Structure::Symmetric => {
                format!("symmetric {size} × {size}, upper triangle by rows: {stored} values")
            }
            Structure::Full => format!("{size} × {size} by rows: {stored} values"),
            Structure::Kronecker { .. } => format!(
                "a symmetric {nodes} × {nodes} matrix times a constant 3 × 3 pattern, upper triangle \
                 by rows: {stored} values"
            ),
        };
        let material: Vec<String> = (self.spec.material_of(form).iter())
            .map(|property| format!("{} ({})", property.name, property.unit))
            .collect();
        format!(
            "`{}`: ∫ `{}` dV (`{}`), rows from v, columns from u.\n\nx: nodes × 3 (m). {}. matrix: {matrix}. \
             Gives the smallest det J.\n\nRule: {}. {about} Once a cell: {}; once a pair: {}.",
            form.name,
            form.text.text(),
            self.spec.file.path.display(),
            material.join(", "),
            self.element.rule(&form.name).title,
            pairs.once_counts(),
            pairs.program.counts(PAIR),
        )
    }

    fn table(&self, tables: &mut Tables) -> &Table {
        let form = &self.form.name;
        let table = self.element.table(form);
        let (points, nodes) = (count(table.weights.len()), count(self.element.nodes.len()));
        let rows = table.slopes.iter().map(|rows| slopes(rows));
        tables.add(
            &tables.named("SLOPES", form),
            "∂N_a/∂(ξ, η, ζ) at the points.",
            quote!([[[f64; 3]; #nodes]; #points]),
            quote!([#(#rows),*]),
        );
        table
    }

    /// Only N_a N_b occurs, whose products at the points are constants: Σ_q det J w N_a N_b, of which few
    /// differ.
    fn values_only(
        &self,
        pairs: &Pairs,
        tables: &mut Tables,
    ) -> Result<(TokenStream, String), Diagnostics> {
        let form = &self.form.name;
        let table = self.table(tables);
        let (points, products) = (table.weights.len(), &table.products);
        let (rows, places) = (products.rows.len(), products.places.len());
        let (products_name, places_name) =
            (tables.named("PRODUCTS", form), tables.named("PLACES", form));
        let values = products.rows.iter().map(|values| row(values));
        let (points, rows, places) = (count(points), count(rows), count(places));
        tables.add(
            &products_name,
            "w N_a N_b at the points, each different row once.",
            quote!([[f64; #points]; #rows]),
            quote!([#(#values),*]),
        );
        let values = products.places.iter().map(|place| count(*place));
        tables.add(
            &places_name,
            "The row of every pair of nodes a ≤ b.",
            quote!([usize; #places]),
            quote!([#(#values),*]),
        );
        let slopes = tables.named("SLOPES", form);
        let once = pairs.once();
        let pair = statements(&pairs.program, PAIR, Numbers::Lanes);
        let result = operand(&pairs.program, pairs.program.outputs[0].operand, Numbers::Lanes);
        let about = format!(
            "{rows} different entries of {places}; {} mul, {} add for them and det J.",
            products.rows.len() * products.rows[0].len()
                + self.jacobian_cost(products.rows[0].len()),
            products.rows.len() * products.rows[0].len()
                + self.jacobian_cost(products.rows[0].len()),
        );
        let body = quote! {
            #once
            let mut det = [L::splat(0.0); #points];
            let mut least_det = L::splat(f64::INFINITY);
            for q in 0..#points {
                det[q] = cells::Jacobian::new(x, &#slopes[q]).det;
                least_det = cells::least(least_det, det[q]);
            }
            let mut entries = [L::splat(0.0); #rows];
            for (entry, products) in entries.iter_mut().zip(&#products_name) {
                let mut s_nn = L::splat(0.0);
                for q in 0..#points {
                    s_nn = s_nn + det[q] * products[q];
                }
                #(#pair)*
                *entry = #result;
            }
            for (entry, place) in matrix.iter_mut().zip(#places_name) {
                *entry = entries[place];
            }
            least_det
        };
        Ok((body, about))
    }

    /// Multiplications (about as many additions) for the Jacobians at the points.
    fn jacobian_cost(&self, points: usize) -> usize {
        points * (9 * self.element.nodes.len() + 21)
    }

    /// Values and gradients of all basis functions at all points, then sums of their products.
    fn general(
        &self,
        pairs: &Pairs,
        tables: &mut Tables,
    ) -> Result<(TokenStream, String), Diagnostics> {
        let form = &self.form.name;
        let table = self.table(tables);
        let enhanced = self.element.enhanced_in(form);
        let nodes = self.element.nodes.len();
        let modes = enhanced.map_or(0, |enhanced| enhanced.modes.len());
        let total = nodes + modes;
        let points = table.weights.len();
        let weights_name = tables.named("WEIGHTS", form);
        let points_count = count(points);
        tables.add(
            &weights_name,
            "Weights of the points.",
            quote!([f64; #points_count]),
            row(&table.weights),
        );
        let used: BTreeSet<usize> = pairs.moments.iter().flat_map(|(a, b)| [*a, *b]).collect();
        let with_values = used.contains(&0);
        let fill = self.fill(tables, table, with_values)?;
        let once = pairs.once();
        let sums = self.sums(pairs, &used);
        let (total_count, size) = (count(total), count(3 * total));
        let nodes_size = count(3 * nodes);
        let outputs: Vec<TokenStream> = (pairs.program.outputs.iter())
            .map(|output| operand(&pairs.program, output.operand, Numbers::Lanes))
            .collect();
        let target = if modes > 0 { quote!(&mut whole) } else { quote!(matrix) };
        let (first, store) = match &self.form.structure {
            Structure::Kronecker { .. } => {
                let entry = &outputs[0];
                (quote!(a), quote!(cells::store_entry(#target, #total_count, a, b, #entry);))
            }
            structure => {
                let rows = outputs.chunks(3).map(|row| quote!([#(#row),*]));
                let block = quote!([#(#rows),*]);
                match structure {
                    Structure::Symmetric => {
                        (quote!(a), quote!(cells::store_block(#target, #size, a, b, #block);))
                    }
                    _ => (quote!(0), quote!(cells::store_full(#target, #size, a, b, #block);)),
                }
            }
        };
        let (before, after) = if modes > 0 {
            let len = count(3 * total * (3 * total + 1) / 2);
            let modes_size = count(3 * modes);
            (
                quote!(let mut whole = [L::splat(0.0); #len];),
                quote!(cells::condense::<L, #nodes_size, #modes_size>(&whole, matrix);),
            )
        } else {
            (TokenStream::new(), TokenStream::new())
        };
        let body = quote! {
            #once
            #fill
            #before
            for a in 0..#total_count {
                for b in #first..#total_count {
                    #sums
                    #store
                }
            }
            #after
            least_det
        };
        let ordered = matches!(self.form.structure, Structure::Full);
        let loops = if ordered { total * total } else { total * (total + 1) / 2 };
        let work =
            loops * points * pairs.moments.len() + self.jacobian_cost(points) + 12 * total * points;
        let mut about = format!("{loops} pairs × {points} points; {work} mul and add");
        if modes > 0 {
            let (n, m) = (3 * nodes, 3 * modes);
            let condensing = m * m * m / 6 + n * m * m / 2 + n * (n + 1) / 2 * m;
            about += &format!(", {condensing} more to condense {m} parameters");
        }
        Ok((body, about + "."))
    }

    /// Fills `basis[function][point]` with √(w det J) times the parts that the form uses.
    fn fill(
        &self,
        tables: &mut Tables,
        table: &Table,
        with_values: bool,
    ) -> Result<TokenStream, Diagnostics> {
        let form = &self.form.name;
        let enhanced = self.element.enhanced_in(form);
        let nodes = self.element.nodes.len();
        let modes = enhanced.map_or(0, |enhanced| enhanced.modes.len());
        let program = point_program(self.element, form)
            .map_err(|error| unscheduled(&self.element.file, &error))?;
        let scales = statements(&program, 0, Numbers::Lanes);
        let scale = |name: &str| match program.output(name) {
            Some(found) => operand(&program, found, Numbers::Lanes),
            None => TokenStream::new(),
        };
        let (root, nodal, mode) = (scale("root"), scale("nodal"), scale("mode"));
        let (nodes_count, points_count) = (count(nodes), count(table.weights.len()));
        let (total, modes_count) = (count(nodes + modes), count(modes));
        let (weights, slopes_name) = (tables.named("WEIGHTS", form), tables.named("SLOPES", form));
        let parts = count(if with_values { 4 } else { 3 });
        let node = if with_values {
            let values = tables.named("VALUES", form);
            let rows = table.values.iter().map(|values| row(values));
            tables.add(
                &values,
                "N_a at the points.",
                quote!([[f64; #nodes_count]; #points_count]),
                quote!([#(#rows),*]),
            );
            quote! {
                let [g_x, g_y, g_z] = at.gradient(&#slopes_name[q][a], #nodal);
                basis[a][q] = [#root * #values[q][a], g_x, g_y, g_z];
            }
        } else {
            quote!(basis[a][q] = at.gradient(&#slopes_name[q][a], #nodal);)
        };
        let mut centre = TokenStream::new();
        let mut mode_loop = TokenStream::new();
        if let Some(enhanced) = enhanced {
            let mode_slopes = tables.named("MODE_SLOPES", form);
            let rows = table.mode_slopes.iter().map(|rows| slopes(rows));
            tables.add(
                &mode_slopes,
                "∂M_m/∂(ξ, η, ζ) at the points.",
                quote!([[[f64; 3]; #modes_count]; #points_count]),
                quote!([#(#rows),*]),
            );
            let uses_centre = enhanced.jacobian == ModeJacobian::Centre;
            let used = scales.iter().chain([&mode]).any(|text| names(text).contains("det0"));
            if uses_centre || used {
                tables.add(
                    &format_ident!("CENTRE_SLOPES"),
                    "∂N_a/∂(ξ, η, ζ) at the centre.",
                    quote!([[f64; 3]; #nodes_count]),
                    slopes(&table.centre_slopes),
                );
            }
            if uses_centre || used {
                centre = quote!(let centre = cells::Jacobian::new(x, &CENTRE_SLOPES););
            }
            if used {
                centre.extend(quote!(let det0 = centre.det;));
            }
            let map = match enhanced.jacobian {
                ModeJacobian::Centre => quote!(centre),
                ModeJacobian::Point => quote!(at),
            };
            let gradient = quote!(#map.gradient(&#mode_slopes[q][m], #mode));
            let filled = if with_values {
                quote! {
                    let [g_x, g_y, g_z] = #gradient;
                    basis[#nodes_count + m][q] = [L::splat(0.0), g_x, g_y, g_z];
                }
            } else {
                quote!(basis[#nodes_count + m][q] = #gradient;)
            };
            mode_loop = quote!(for m in 0..#modes_count { #filled });
        }
        Ok(quote! {
            #centre
            let mut least_det = L::splat(f64::INFINITY);
            let mut basis = [[[L::splat(0.0); #parts]; #points_count]; #total];
            for q in 0..#points_count {
                let at = cells::Jacobian::new(x, &#slopes_name[q]);
                let (det, weight) = (at.det, L::splat(#weights[q]));
                least_det = cells::least(least_det, det);
                #(#scales)*
                for a in 0..#nodes_count {
                    #node
                }
                #mode_loop
            }
        })
    }

    /// The sums of products over the points for the pair (a, b), then the components.
    fn sums(&self, pairs: &Pairs, used: &BTreeSet<usize>) -> TokenStream {
        let parts: Vec<usize> = if used.contains(&0) { vec![0, 1, 2, 3] } else { vec![1, 2, 3] };
        let parts_of = |side: &str, place: fn(&(usize, usize)) -> usize| -> Vec<Ident> {
            let of = |part: &usize| pairs.moments.iter().any(|moment| place(moment) == *part);
            let prefix = |part: &usize| if of(part) { "" } else { "_" };
            parts
                .iter()
                .map(|p| format_ident!("{}{side}_{}", prefix(p), Pairs::PARTS[*p]))
                .collect()
        };
        let (test, trial) = (parts_of("a", |m| m.0), parts_of("b", |m| m.1));
        let sums: Vec<Ident> =
            pairs.moments.iter().map(|moment| identifier(&Pairs::name(*moment))).collect();
        let at = |part: usize| parts.iter().position(|p| *p == part).unwrap_or(0);
        let products = pairs.moments.iter().map(|(i, j)| {
            let (a, b) = (&test[at(*i)], &trial[at(*j)]);
            quote!(#a * #b)
        });
        let statements = statements(&pairs.program, PAIR, Numbers::Lanes);
        quote! {
            #(let mut #sums = L::splat(0.0);)*
            for (a_q, b_q) in basis[a].iter().zip(&basis[b]) {
                let ([#(#test),*], [#(#trial),*]) = (*a_q, *b_q);
                #(#sums = #sums + #products;)*
            }
            #(#statements)*
        }
    }
}
