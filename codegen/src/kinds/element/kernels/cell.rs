//! The kernel of one form on one cell: a loop over the points of the rule fills the basis functions, then the kernel
//! of the form takes them pair by pair.

use proc_macro2::TokenStream;
use quote::{ToTokens, quote};

use super::linear::Linear;
use super::modes::Aligned;
use super::table::{Tables, Tangents, row};
use crate::emit::{Size, Value, Work, count, documented, identifier};
use crate::kinds::cells;
use crate::kinds::element::{ElementSpec, Table};
use crate::kinds::form::kernels::{
    Pairs, Sizes, block_name, by_values, once_name, pairs_name, work as form_work,
};
use crate::kinds::form::{Form, FormSpec, Structure};
use crate::schedule::Program;

/// A form on an element.
pub(super) struct CellForm<'a> {
    pub(super) element: &'a ElementSpec,
    pub(super) spec: &'a FormSpec,
    pub(super) form: &'a Form,
    pub(super) pairs: &'a Pairs,
    /// The form that gives the stress, of the same set, where there is one.
    pub(super) of_stress: Option<(&'a Form, &'a Pairs)>,
    /// Scale factors at a point.
    pub(super) point: &'a Program,
    /// An element with the same functions at the same points, whose kernel this form calls.
    pub(super) same_kernel: Option<&'a ElementSpec>,
}

impl CellForm<'_> {
    /// The function of the form, over blocks of cells, and what a cell costs. `known`: the
    /// work of the element so far; a form that does the same calls the kernels that do it.
    pub(super) fn functions(
        &self,
        tables: &mut Tables,
        known: &mut Vec<Known>,
    ) -> (TokenStream, usize) {
        let pairs = self.pairs;
        tables.elsewhere = self.same_kernel.is_some();
        let Body { workspace, matrix, work, about } = match by_values(self.form, pairs) {
            true => self.values_only(pairs, tables),
            false if pairs.under_stress => self.under_stress(pairs, tables),
            false => self.general(pairs, tables),
        };
        let (text, flops) = (work.to_token_stream(), work.operations());
        // Behind the positions of the nodes come their displacements, where there is a stress.
        let given = if pairs.under_stress { 2 } else { 1 };
        let (nodes, len) = (count(given * self.element.nodes.len()), count(self.stored()));
        let properties = count(pairs.material.len());
        let function = identifier(&self.form.name);
        let about = documented(&self.header(&about, flops));
        let in_registers = workspace.is_none();
        let (workspace, own_workspace) = match workspace {
            Some(workspace) => (workspace, quote!(workspace)),
            None => (quote!(()), quote!(_workspace)),
        };
        let work = format!("{workspace} {} {text}", pairs.material.join(" "));
        if let Some(same_kernel) = self.same_kernel {
            let element = identifier(&same_kernel.name);
            known.push(Known { work: work.clone(), function: quote!(super::#element::#function) });
        }
        let text = match known.iter().find(|other| other.work == work) {
            Some(Known { function, .. }) => {
                quote!(#function(coordinates, material, matrices, jacobians);)
            }
            None => {
                known.push(Known { work, function: quote!(#function) });
                quote! {
                    enum Cells {}
                    // SAFETY: it writes the entries of the workspace before it reads them, and only those.
                    unsafe impl cells::CellLanes<#nodes, #properties, #len> for Cells {
                        type Workspace<L: Register> = #workspace;
                        const IN_REGISTERS: bool = #in_registers;

                        #[inline(always)]
                        fn cell<L: Register>(
                            x: &[[L; 3]; #nodes],
                            material: [L; #properties],
                            #own_workspace: &mut Self::Workspace<L>,
                            #matrix: Matrix<L>,
                        ) -> L {
                            #text
                        }
                    }
                    cells::each_cell::<Cells, #nodes, #properties, #len>(
                        coordinates, material, matrices, jacobians,
                    );
                }
            }
        };
        let text = quote! {
            #about
            pub fn #function(
                coordinates: &[f64],
                material: &[f64],
                matrices: &mut [Batch],
                jacobians: &mut [f64],
            ) {
                #text
            }
        };
        (text, flops)
    }

    /// Stored values of a cell.
    fn stored(&self) -> usize {
        if self.form.at_points() {
            return 6 * self.element.rule(self.form.integrated_as()).points.len();
        }
        let (nodes, size) = (self.element.nodes.len(), 3 * self.element.nodes.len());
        match self.form.structure {
            Structure::Symmetric => size * (size + 1) / 2,
            Structure::Full => size * size,
            Structure::Kronecker { .. } => nodes * (nodes + 1) / 2,
        }
    }

    fn header(&self, about: &str, flops: usize) -> String {
        let (nodes, form) = (self.element.nodes.len(), self.form);
        let (size, stored) = (3 * nodes, self.stored());
        let matrix = match &form.structure {
            _ if self.form.at_points() => {
                format!(
                    "σ_xx, σ_yy, σ_zz, σ_xy, σ_yz, σ_zx (Pa) at every point of the rule: {stored} values"
                )
            }
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
        let given = match &form.stress {
            Some(stress) => format!(
                ", then their displacements × 3 (m), whose stress is that of `{}`",
                stress.form
            ),
            None => String::new(),
        };
        let what = match self.form.at_points() {
            true => format!("the stress of a displacement as `{}` has it", form.text.text()),
            false => format!("∫ `{}` dV, rows from v, columns from u", form.text.text()),
        };
        format!(
            "`{}`: {what} (`{}`), of every cell of a block ([`crate::CellKernel`]).\n\nA cell: {nodes} nodes × 3 (m){given}; {}; {matrix}; the smallest det J.\n\nRule: {}. {about} Together \
             {flops} operations a cell, a multiplication with the addition behind it counted as two; {} \
             bytes read, {} written.",
            form.name,
            self.spec.file.path.display(),
            material.join(", "),
            self.element.rule(form.integrated_as()).title,
            8 * 3 * nodes * if form.stress.is_some() { 2 } else { 1 },
            8 * (stored + 1),
        )
    }

    pub(super) fn table(&self, tables: &mut Tables) -> &Table {
        let form = self.form.integrated_as();
        let table = self.element.table(form);
        let (points, nodes) = (count(table.weights.len()), count(self.element.nodes.len()));
        let Tangents { rows, columns } = Tangents::new(&table.slopes);
        if Linear::new(&rows).is_none() {
            let (row_count, rows) = (count(rows.len()), rows.iter().map(|values| row(values)));
            tables.add(
                &tables.named("TANGENTS", form),
                "Coefficients of the nodes in ∂x/∂(ξ, η, ζ) at the points, each different row once.",
                quote!([[f64; #nodes]; #row_count]),
                quote!([#(#rows),*]),
            );
        }
        let columns = columns.iter().map(|places| {
            let places = places.map(count);
            quote!([#(#places),*])
        });
        tables.add(
            &tables.named("COLUMNS", form),
            "The rows of ∂x/∂ξ, ∂x/∂η and ∂x/∂ζ at every point.",
            quote!([[usize; 3]; #points]),
            quote!([#(#columns),*]),
        );
        table
    }

    /// Fills `workspace.tangents`.
    pub(super) fn tangents(&self, tables: &Tables, table: &Table) -> Work {
        let rows = Tangents::new(&table.slopes).rows;
        let mut work = Work::new();
        match Linear::new(&rows) {
            None => {
                let name = tables.named("TANGENTS", self.form.integrated_as());
                let text = quote!(cells::tangents(x, &#name, &mut workspace.tangents));
                let operations = cells::tangents(self.element.nodes.len(), rows.len());
                work.call(Value::call(text, operations));
            }
            Some(linear) => {
                work.kept(
                    "i",
                    Size::Number(3),
                    self.linear_tangents(&linear, &quote!(workspace.tangents)),
                );
            }
        }
        work
    }

    /// Component i of the tangents.
    pub(super) fn linear_tangents(&self, linear: &Linear, target: &TokenStream) -> Work {
        let node = |a: usize| {
            let a = count(a);
            quote!(x[#a][i])
        };
        let (mut work, rows) = linear.work(self.element.nodes.len(), node);
        for (place, row) in rows.into_iter().enumerate() {
            let place = count(place);
            work.store(quote!(#target[#place][i]), row);
        }
        work
    }

    /// Inside a loop over q, declares `at` from the tangents; `operations`: those of what is used of it.
    pub(super) fn jacobian(
        &self,
        tables: &Tables,
        tangents: &TokenStream,
        operations: usize,
    ) -> Work {
        let columns = tables.named("COLUMNS", self.form.integrated_as());
        let at = quote!(cells::Jacobian::new([#tangents[xi], #tangents[eta], #tangents[zeta]]));
        let mut work = Work::new();
        work.name(quote!([xi, eta, zeta]), quote!(#columns[q]));
        work.bind(quote!(at), Value::call(at, operations));
        work
    }

    /// Values and gradients of all basis functions at all points, then sums of their products.
    fn general(&self, pairs: &Pairs, tables: &mut Tables) -> Body {
        let form = &self.form.name;
        let table = self.table(tables);
        let enhanced = self.element.enhanced_in(form);
        let nodes = self.element.nodes.len();
        let modes = enhanced.map_or(0, |enhanced| enhanced.modes.len());
        let total = nodes + modes;
        let points = table.weights.len();
        let points_count = count(points);
        tables.weights(form, &table.weights);
        let parts = pairs.parts();
        let with_values = parts.contains(&0);
        let aligned = Aligned::of(self.element, form, pairs, table);
        let fill = self.fill(tables, table, with_values, aligned.as_ref());
        // Functions whose products are summed in full.
        let total = if aligned.is_some() { nodes } else { total };
        let (total_count, nodes_size) = (count(total), count(3 * nodes));
        let target = match (&aligned, modes) {
            (Some(_), _) => quote!(matrix.again()),
            (None, 0) => quote!(matrix),
            (None, _) => quote!(matrix.beside(&mut workspace.whole)),
        };
        let (module, sum) = (identifier(&self.spec.name), pairs_name(self.form));
        let (once_name, block) = (once_name(self.form), block_name(self.form));
        let once = quote!(forms::#module::#once_name(material));
        let sums = quote!(forms::#module::#sum(workspace.basis.as_flattened(), #points_count, once, #target));
        let mut work = Work::new();
        work.bind(quote!(once), Value::call(once, pairs.once().operations()));
        work.then(fill);
        let sizes = Sizes { functions: total, nodes, points };
        work.call(Value::call(sums, form_work(self.form, pairs, sizes).operations()));
        let condensing = cells::take_off(3 * nodes, 3 * modes);
        let whole = match &aligned {
            Some(aligned) => {
                work.then(aligned.condense(&quote!(forms::#module::#block), pairs));
                aligned.workspace()
            }
            None if modes > 0 => {
                let modes_size = count(3 * modes);
                let condense = quote!(cells::condense::<L, #nodes_size, #modes_size>(&matrix.beside(&mut workspace.whole), matrix));
                work.call(Value::call(condense, condensing));
                let whole = count(3 * total * (3 * total + 1) / 2);
                quote!([Batch; #whole])
            }
            None => quote!(()),
        };
        work.give(Value::free(quote!(least_det)));
        let parts = count(parts.len());
        let rows = count(Tangents::new(&table.slopes).rows.len());
        let workspace =
            quote!(cells::Workspace<L, #total_count, #points_count, #parts, #rows, #whole>);
        let pair_count = match self.form.structure {
            Structure::Full => total * total,
            _ => total * (total + 1) / 2,
        };
        let mut about = format!("{pair_count} pairs × {points} points.");
        if aligned.is_some() {
            about += &format!(" The gradients of the {modes} modes each lie along one vector.");
        }
        if modes > 0 {
            about += &format!(" {condensing} operations to condense {} parameters.", 3 * modes);
        }
        let (cell, pair) = (pairs.once_counts(), pairs.pair_counts());
        about += &format!(" Once a cell: {cell}; once a pair: {pair}.");
        let matrix = if aligned.is_some() { quote!(mut matrix) } else { quote!(matrix) };
        Body { workspace: Some(workspace), matrix, work, about }
    }
}

/// A kernel that another form may share: M, Y and H differ in their patterns only.
pub(super) struct Known {
    /// What it does.
    pub(super) work: String,
    /// Path of its function.
    function: TokenStream,
}

/// What a kernel does.
pub(super) struct Body {
    /// Type of the workspace that it needs; none if all that it computes stays in registers.
    pub(super) workspace: Option<TokenStream>,
    /// Pattern of the matrix that it fills.
    pub(super) matrix: TokenStream,
    pub(super) work: Work,
    pub(super) about: String,
}
