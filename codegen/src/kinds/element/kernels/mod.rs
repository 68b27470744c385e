//! Kernels of an element: one for every form, over one lane and over blocks of cells.

mod basis;
mod cell;
mod faces;
mod linear;
mod modes;
mod shape;
mod stressed;
mod table;
mod values;

use num_traits::ToPrimitive;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::{ElementSpec, ModeJacobian};
use crate::diagnostic::Diagnostics;
use crate::emit::{documented, identifier, names, number};
use crate::kinds::form::{FormKernels, Structure};
use crate::kinds::kernel::{self, unscheduled, variable};
use crate::kinds::kind::About;
use crate::rational::nearest;
use crate::schedule::{Program, Request, ScheduleError, schedule};
use cell::CellForm;
use table::Tables;

impl ElementSpec {
    /// The module of the kernels of all forms on one element. Those that an element before has, too, are called there.
    pub(crate) fn module(
        &self,
        forms: &[FormKernels<'_>],
        before: &[ElementSpec],
    ) -> Result<String, Diagnostics> {
        let refused = |error| unscheduled(&self.file, &error);
        let mut tables = Tables::new(self);
        let mut functions = TokenStream::new();
        let (mut entries, mut stresses, mut known) = (Vec::new(), Vec::new(), Vec::new());
        for FormKernels { spec, pairs: all, .. } in forms {
            for (form, pairs) in spec.kernels().zip(all) {
                let integrated_as = form.integrated_as();
                let same_kernel =
                    before.iter().find(|other| other.integrates_as(self, integrated_as));
                let point = &point_program(self, integrated_as).map_err(refused)?;
                let mut others = spec.kernels().zip(all);
                let of_stress = (form.stress.as_ref())
                    .and_then(|_| others.find(|(other, _)| other.name == integrated_as));
                let cell =
                    CellForm { element: self, spec, form, pairs, of_stress, point, same_kernel };
                let (text, flops) = cell.functions(&mut tables, &mut known);
                functions.extend(text);
                match cell.form.at_points() {
                    true => stresses.push(stress_entry(&cell, flops)),
                    false => entries.push(entry(&cell, flops)),
                }
            }
        }
        let read = tables.read();
        let shape = shape::function(&shape::program(self).map_err(refused)?);
        let functions = quote!(#read #functions #shape);
        // What the kernels do counts for the hash, wherever they stand.
        let works = known.iter().map(|kernel| kernel.work.as_str());
        let beside = forms.iter().map(|forms| forms.text.as_str()).chain(works).collect();
        let about = About { beside, ..self.about() };
        let registered = registered(self, &about, &tables.all(), [&entries, &stresses]);
        let heading = documented(&heading(self, &about));
        let name = identifier(&self.name);
        // A kernel that calls those of an element before it may use none of these itself.
        let used = names(&functions);
        let called = ["cells", "forms", "Batch", "Lane", "Matrix", "Register"];
        let called = called.iter().filter(|name| used.contains(**name));
        let called = called.map(|name| format_ident!("{name}"));
        let types = (!stresses.is_empty()).then(|| format_ident!("StressKernel"));
        let types = types.iter();
        Ok(kernel::text(quote! {
            #heading
            pub mod #name {
                use crate::{#(#called,)* Element, Face, FacePoint, FormKernel, Origin, #(#types,)* Structure, Variable};
                #functions
                #registered
            }
        }))
    }
}

/// Scale factors at a point, from `weight`, `det` and `det0`: `root` = √(w det J), `nodal` for the gradients
/// of nodal functions by cofactors, `mode` for those of enhanced modes.
fn point_program(element: &ElementSpec, form: &str) -> Result<Program, ScheduleError> {
    let mut graph = element.graph.clone();
    let enhanced = element.enhanced_in(form);
    let symbols = ["weight", "det", "det0"].map(|name| (name, graph.scalar(name)));
    let [weight, det, det0] = symbols.map(|(_, symbol)| symbol);
    let volume = graph.mul(weight, det);
    let root = graph.sqrt(volume);
    let nodal = graph.div(root, det);
    let mut outputs = vec![("root", root), ("nodal", nodal)];
    if let Some(enhanced) = enhanced {
        let by = match enhanced.jacobian {
            ModeJacobian::Centre => det0,
            ModeJacobian::Point => det,
        };
        let scaled = graph.mul(enhanced.scale, root);
        outputs.push(("mode", graph.div(scaled, by)));
    }
    let inputs = if enhanced.is_some() { &symbols[..] } else { &symbols[..2] };
    let names = vec![(root, "root".to_owned())];
    schedule(&mut graph, &Request { names, ..Request::flat(inputs, &outputs) })
}
fn heading(element: &ElementSpec, about: &About) -> String {
    let mut text = format!(
        "{}\n{} nodes on the {}; integrated with {}.\n",
        about.heading(),
        element.nodes.len(),
        element.cell.name(),
        element.quadrature.title
    );
    for (form, rule) in &element.quadrature_of {
        text += &format!("`{form}` is integrated with {}.\n", rule.title);
    }
    if let Some(enhanced) = &element.enhanced {
        let modes: Vec<String> =
            enhanced.modes.iter().map(|mode| format!("`{}`", mode.text.text())).collect();
        let forms: Vec<&str> = enhanced.forms.iter().map(|form| form.text()).collect();
        text += &format!("Enhanced modes {} in {}.\n", modes.join(", "), forms.join(", "));
    }
    text
}

/// The entry of a form in the registry.
fn entry(cell: &CellForm, flops: usize) -> TokenStream {
    let (name, flops) = (&cell.form.name, Literal::usize_unsuffixed(flops));
    let function = identifier(name);
    let under_stress = cell.form.stress.is_some();
    let material = (cell.spec.material_of(cell.form).into_iter())
        .map(|p| variable(&p.name, &p.unit.dimension().si_unit(), &p.title));
    let structure = match &cell.form.structure {
        Structure::Symmetric => quote!(Structure::Symmetric),
        Structure::Full => quote!(Structure::Full),
        Structure::Kronecker { pattern, .. } => {
            let rows = pattern.iter().map(|row| {
                let row = row.iter().map(|entry| number(entry.to_f64().unwrap_or(f64::NAN)));
                quote!([#(#row),*])
            });
            quote!(Structure::Kronecker { pattern: [#(#rows),*] })
        }
    };
    quote! {
        FormKernel {
            form: #name,
            material: &[#(#material),*],
            structure: #structure,
            under_stress: #under_stress,
            flops: #flops,
            evaluate: #function,
        }
    }
}

/// The entry of a stress.
fn stress_entry(cell: &CellForm, flops: usize) -> TokenStream {
    let (name, form) = (&cell.form.name, cell.form.integrated_as());
    let flops = Literal::usize_unsuffixed(flops);
    let function = identifier(name);
    let material = (cell.spec.material_of(cell.form).into_iter())
        .map(|p| variable(&p.name, &p.unit.dimension().si_unit(), &p.title));
    let rule = cell.element.rule(form);
    let points = rule.points.iter().map(|point| {
        let weight = number(rule.field.to_f64(&point.weight));
        let [xi, eta, zeta] = point.at.each_ref().map(|x| number(rule.field.to_f64(x)));
        quote!(([#xi, #eta, #zeta], #weight))
    });
    let linear = cell.element.cell.linear().iter().map(|powers| {
        let powers = powers.iter().map(|power| Literal::u8_unsuffixed(*power));
        quote!([#(#powers),*])
    });
    quote! {
        StressKernel {
            stress: #name,
            form: #form,
            material: &[#(#material),*],
            points: &[#(#points),*],
            linear: &[#(#linear),*],
            flops: #flops,
            evaluate: #function,
        }
    }
}

fn registered(
    element: &ElementSpec,
    about: &About,
    tables: &TokenStream,
    [entries, stresses]: [&[TokenStream]; 2],
) -> TokenStream {
    let origin = about.origin(tables);
    let count = Literal::usize_unsuffixed(element.nodes.len());
    let nodes = element.nodes.iter().map(|node| {
        let [xi, eta, zeta] = node.at.each_ref().map(|x| number(nearest(x)));
        quote!([#xi, #eta, #zeta])
    });
    let order = |order: &[usize]| {
        let places = order.iter().map(|place| Literal::usize_unsuffixed(*place));
        quote!(&[#(#places),*])
    };
    let (abaqus_order, vtk_order) = (order(&element.abaqus_order), order(&element.vtk_order));
    let abaqus = element.abaqus.iter().map(|kind| kind.text());
    let gmsh = match &element.gmsh {
        Some((kind, places)) => {
            let (kind, places) = (Literal::u8_unsuffixed(*kind), order(places));
            quote!(Some((#kind, #places)))
        }
        None => quote!(None),
    };
    let nastran = match &element.nastran {
        Some((card, places)) => {
            let (card, places) = (card.text(), order(places));
            quote!(Some((#card, #places)))
        }
        None => quote!(None),
    };
    let vtk = Literal::u8_unsuffixed(element.vtk);
    let faces = faces::entries(element);
    quote! {
        /// The entry of the registry.
        pub const ENTRY: Element = Element {
            origin: #origin,
            nodes: #count,
            reference_nodes: &[#(#nodes),*],
            abaqus: &[#(#abaqus),*],
            abaqus_order: #abaqus_order,
            gmsh: #gmsh,
            nastran: #nastran,
            vtk: #vtk,
            vtk_order: #vtk_order,
            shape,
            faces: &[#(#faces),*],
            forms: &[#(#entries),*],
            stresses: &[#(#stresses),*],
        };
    }
}
