//! One kernel as Rust: what it needs is read, then come matrix–vector products, dot products, scalars and the outputs.

use std::collections::BTreeSet;

use proc_macro2::{Ident, Literal, TokenStream};
use quote::{format_ident, quote};

use super::combination::{Text, combination, entry};
use super::form::{Combination, Group};
use super::plan::{AFTER, BEFORE, KernelPlan, MatrixProduct};
use crate::emit::{Numbers, identifier, operand, statements};
use crate::expression::{Graph, Id, Node, Shape};
use crate::kinds::motion::MotionSpec;
use crate::operation::Operand;

/// What the outputs of a kernel are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ResultKind {
    /// One scalar.
    Value,
    /// 1 + n values: a scalar and a vector.
    Rows,
    /// (1 + n)² values: a scalar, a row, a column and a block.
    Blocks,
}

/// Writes the statements of a kernel.
pub(super) struct Writer<'a> {
    pub(super) spec: &'a MotionSpec,
    pub(super) graph: &'a Graph,
    pub(super) plan: &'a KernelPlan,
}

impl Writer<'_> {
    /// The statements that compute the outputs.
    pub(super) fn body(&self, result: ResultKind) -> TokenStream {
        let symbols = self.symbols();
        let before = statements(&self.plan.scalars, BEFORE, Numbers::Lanes);
        let after = statements(&self.plan.scalars, AFTER, Numbers::Lanes);
        let split = match result {
            ResultKind::Blocks => quote! {
                let out_ = &mut out_[..(n_ + 1) * (n_ + 1)];
                let (first_, columns_) = out_.split_at_mut(n_ + 1);
            },
            ResultKind::Rows => quote!(let out_ = &mut out_[..n_ + 1];),
            ResultKind::Value => quote!(),
        };
        let passes = self.passes(result);
        let dots = self.dots();
        let outputs = self.outputs(result);
        quote! {
            #symbols
            #split
            #(#before)*
            #passes
            #dots
            #(#after)*
            #outputs
        }
    }

    /// The symbols that are used, bound to names.
    fn symbols(&self) -> TokenStream {
        let used = self.used();
        let mut lines = vec![quote!(let n_ = state_.eta.len();)];
        for coordinate in &self.spec.coordinates {
            let symbols = [coordinate.position, coordinate.velocity, coordinate.acceleration];
            for symbol in symbols.into_iter().filter(|symbol| used.contains(symbol)) {
                let name = self.ident(symbol);
                lines.push(match self.graph.shape(symbol) {
                    Shape::Scalar => quote!(let #name = state_.#name;),
                    _ => quote!(let #name = &state_.#name[..n_];),
                });
            }
        }
        for (place, tensor) in self.spec.tensors.iter().enumerate() {
            if !used.contains(&tensor.symbol) {
                continue;
            }
            let name = self.ident(tensor.symbol);
            let place = Literal::usize_unsuffixed(place);
            lines.push(match tensor.shape {
                Shape::Scalar => {
                    quote!(let #name = L::splat(tensors_[#place][0]);)
                }
                Shape::Vector => quote!(let #name = &tensors_[#place][..n_];),
                _ => quote!(let #name = &tensors_[#place][..n_ * n_];),
            });
        }
        quote!(#(#lines)*)
    }

    /// Whether any tensor is used.
    pub(super) fn takes_tensors(&self) -> bool {
        let used = self.used();
        self.spec.tensors.iter().any(|tensor| used.contains(&tensor.symbol))
    }

    /// Symbols that the plan uses.
    fn used(&self) -> BTreeSet<Id> {
        let plan = self.plan;
        let mut roots: Vec<Id> = plan.products.iter().map(|product| product.id).collect();
        roots.extend(plan.dots.iter().flat_map(|dot| [dot.a, dot.b]));
        for form in &plan.outputs {
            roots.extend(form.vectors());
            roots.extend(form.matrices());
        }
        let mut used: BTreeSet<Id> = self.graph.reachable(&roots).into_iter().collect();
        for (id, name) in &plan.names {
            let mut operands = (plan.scalars.instructions.iter())
                .flat_map(|instruction| instruction.operation.operands())
                .chain(plan.scalars.outputs.iter().map(|output| output.operand));
            let is_input = |operand: Operand| matches!(operand, Operand::Input(place) if plan.scalars.inputs[place].name == *name);
            if operands.any(is_input) {
                used.insert(*id);
            }
        }
        used
    }

    /// The matrix–vector products, level by level; the first level in one pass with the matrix, where that is possible.
    fn passes(&self, result: ResultKind) -> TokenStream {
        let plan = self.plan;
        let fused = plan.outputs.iter().find(|form| plan.fuses(form));
        let levels = plan.products.iter().map(|product| product.level).max().unwrap_or(0);
        let mut text = quote!();
        for (place, product) in plan.products.iter().enumerate() {
            let name = self.ident(product.id);
            let rest = if place + 1 < plan.products.len() { quote!(workspace_) } else { quote!(_) };
            text.extend(quote!(let (#name, #rest) = workspace_.split_at_mut(n_);));
        }
        for product in plan.products.iter().filter(|product| !product.transposed) {
            let name = self.ident(product.id);
            text.extend(quote!(#name.fill(L::splat(0.0));));
        }
        for level in 1..=levels {
            let products: Vec<&MatrixProduct> =
                plan.products.iter().filter(|product| product.level == level).collect();
            text.extend(self.pass(&products, if level == 1 { fused } else { None }));
        }
        if let (0, Some(form), ResultKind::Blocks) = (levels, fused, result) {
            let block = self.block(form);
            text.extend(quote!(for j_ in 0..n_ { #block }));
        }
        text
    }

    /// Products of one level: those of whole matrices one by one, then in one pass over the columns what is not over lanes,
    /// rows, and the block.
    fn pass(
        &self,
        products: &[&MatrixProduct],
        fused: Option<&Combination<Operand>>,
    ) -> TokenStream {
        let is_whole = |product: &MatrixProduct| !product.transposed && self.is_lane(product.of);
        let (whole, rest): (Vec<&MatrixProduct>, Vec<&MatrixProduct>) =
            products.iter().partition(|product| is_whole(product));
        let whole = whole.iter().map(|product| {
            let (name, x) = (self.ident(product.id), self.ident(product.of));
            let matrix = self.ident(product.matrix);
            quote!(vector::add_columns(#name, #matrix, #x);)
        });
        let block = fused.map(|form| self.block(form));
        let pass = match (rest.is_empty(), block) {
            (true, None) => quote!(),
            (true, Some(block)) => quote!(for j_ in 0..n_ { #block }),
            (false, block) => {
                let some = self.some_columns(&rest);
                let block = block.map(|block| quote!(for j_ in start_..end_ { #block }));
                quote! {
                    for start_ in (0..n_).step_by(vector::COLUMNS) {
                        let end_ = n_.min(start_ + vector::COLUMNS);
                        #some
                        #block
                    }
                }
            }
        };
        quote!(#(#whole)* #pass)
    }

    /// What columns `start_..end_` of their matrices add to products, or rows give of them.
    fn some_columns(&self, products: &[&MatrixProduct]) -> TokenStream {
        let products = products.iter().map(|product| {
            let (name, x) = (self.ident(product.id), self.ident(product.of));
            let matrix = self.ident(product.matrix);
            if product.transposed {
                let dot = if self.is_lane(product.of) {
                    quote!(vector::dot_numbers(#x, &#matrix[j_ * n_..][..n_]))
                } else {
                    quote!(L::splat(vector::dot(#x, &#matrix[j_ * n_..][..n_])))
                };
                quote!(for j_ in start_..end_ { #name[j_] = #dot; })
            } else {
                let columns = quote!(&#matrix[start_ * n_..end_ * n_]);
                let x = quote!(&vector::lanes(&#x[start_..end_])[..end_ - start_]);
                quote!(vector::add_columns(#name, #columns, #x);)
            }
        });
        quote!(#(#products)*)
    }

    /// Rows 1 … n of column j of the matrix.
    fn block(&self, form: &Combination<Operand>) -> TokenStream {
        let Combination::Matrix { stored, identity, outer } = form else { return quote!() };
        let plan = self.plan;
        let i = quote!(i_);
        let mut bound = Vec::new();
        for id in form.matrices() {
            if let Node::Symbol(_) = self.graph.node(id) {
                let (column, name) = (self.column_of(id), self.ident(id));
                bound.push(quote!(let #column = &#name[j_ * n_..][..n_];));
            }
        }
        let mut groups_text = vec![];
        if !stored.is_empty() {
            groups_text.push(combination(&plan.scalars, stored, |id| match *self.graph.node(id) {
                Node::Transpose(matrix) => {
                    let name = self.ident(matrix);
                    Text { tokens: quote!(#name[i_ * n_ + j_]), lane: false }
                }
                _ => {
                    let column = self.column_of(id);
                    Text { tokens: quote!(#column[i_]), lane: false }
                }
            }));
        }
        for (left, weights) in outer {
            let weight = format_ident!("weight_{}_", self.ident(*left));
            let value = self.at(weights, &quote!(j_)).into_lane();
            bound.push(quote!(let #weight = #value;));
            let left = entry(plan.name(*left), &i, self.is_lane(*left)).tokens;
            groups_text.push(Text { tokens: quote!(#weight * #left), lane: true });
        }
        groups_text.sort_by_key(|text| !text.lane);
        let value = groups_text.into_iter().reduce(|a, b| {
            let (left, right) = (a.tokens, b.tokens);
            Text { tokens: quote!(#left + #right), lane: a.lane || b.lane }
        });
        let value = value.unwrap_or(Text { tokens: quote!(0.0), lane: false }).into_lane();
        let diagonal = identity.as_ref().map(|coefficient| {
            let coefficient = self.scalar(*coefficient);
            quote!(block_[j_] = block_[j_] + #coefficient;)
        });
        quote! {
            #(#bound)*
            let block_ = &mut columns_[j_ * (n_ + 1)..][1..n_ + 1];
            for i_ in 0..n_ {
                block_[i_] = #value;
            }
            #diagonal
        }
    }

    fn dots(&self) -> TokenStream {
        let lines = self.plan.dots.iter().map(|dot| {
            let name = identifier(&dot.name);
            // The lane comes first.
            let (a, b) = if self.is_lane(dot.a) { (dot.a, dot.b) } else { (dot.b, dot.a) };
            let (left, right) = (self.ident(a), self.ident(b));
            match (self.is_lane(a), self.is_lane(b)) {
                (true, true) => quote!(let #name = vector::dot(#left, #right);),
                (true, false) => quote!(let #name = vector::dot_numbers(#left, #right);),
                (false, _) => quote!(let #name = L::splat(vector::dot(#left, #right));),
            }
        });
        quote!(#(#lines)*)
    }

    fn outputs(&self, result: ResultKind) -> TokenStream {
        match (result, self.plan.outputs.as_slice()) {
            (ResultKind::Value, [Combination::Scalar(value)]) => self.scalar(*value),
            (ResultKind::Rows, [Combination::Scalar(value), Combination::Vector(groups)]) => {
                let value = self.scalar(*value);
                let entries = self.filled(quote!(out_[1..]), groups);
                quote!(out_[0] = #value; #entries)
            }
            (
                ResultKind::Blocks,
                [
                    Combination::Scalar(corner),
                    Combination::Vector(row),
                    Combination::Vector(column),
                    block,
                ],
            ) => {
                let corner = self.scalar(*corner);
                let column = self.filled(quote!(first_[1..]), column);
                let row = self.at(row, &quote!(j_)).into_lane();
                let block = (!self.plan.fuses(block)).then(|| self.block(block));
                quote! {
                    first_[0] = #corner;
                    #column
                    for j_ in 0..n_ {
                        columns_[j_ * (n_ + 1)] = #row;
                        #block
                    }
                }
            }
            _ => unreachable!("kernels ask for the outputs of their kind"),
        }
    }

    /// A loop that fills n entries.
    fn filled(&self, target: TokenStream, groups: &[Group<Operand>]) -> TokenStream {
        let value = self.at(groups, &quote!(i_)).into_lane();
        quote! {
            let rows_ = &mut #target[..n_];
            for i_ in 0..n_ {
                rows_[i_] = #value;
            }
        }
    }

    /// Entry `index` of a combination of vectors.
    fn at(&self, groups: &[Group<Operand>], index: &TokenStream) -> Text {
        combination(&self.plan.scalars, groups, |id| {
            entry(self.plan.name(id), index, self.is_lane(id))
        })
    }

    fn scalar(&self, value: Operand) -> TokenStream {
        operand(&self.plan.scalars, value, Numbers::Lanes)
    }

    /// Whether the entries of a vector are lanes: all but those of constant tensors.
    fn is_lane(&self, id: Id) -> bool {
        !self.spec.tensors.iter().any(|tensor| tensor.symbol == id)
    }

    fn ident(&self, id: Id) -> Ident {
        identifier(self.plan.name(id))
    }

    fn column_of(&self, matrix: Id) -> Ident {
        format_ident!("column_of_{}_", identifier(self.plan.name(matrix)))
    }
}
