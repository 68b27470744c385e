//! Kernels of an element: one for every form, over one lane and over blocks of cells.

use num_traits::ToPrimitive;
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::Kernel;
use super::cell::CellForm;
use super::facts::{About, variable};
use super::form::Forms;
use super::table::{Tables, names};
use crate::diagnostic::{Code, Diagnostics};
use crate::element::demand;
use crate::emit::{documented, identifier, number};
use crate::form::Structure;
use crate::rational::nearest;
use crate::spec::element::ElementSpec;
use crate::spec::form::Form;

/// The kernels of all forms on one element. Those that one of `others` has, too, are called there.
pub(super) fn kernel(
    element: &ElementSpec,
    others: &[ElementSpec],
    all: &[Forms],
) -> Result<Kernel, Diagnostics> {
    let forms = || all.iter().flat_map(|forms| &forms.spec.forms);
    check_enhanced(element, &forms().collect::<Vec<_>>())?;
    demand::prove(element, forms().map(|form| (form.name.as_str(), form.products())))?;
    let mut tables = Tables::new(element);
    let mut functions = TokenStream::new();
    let (mut entries, mut known) = (Vec::new(), Vec::new());
    for forms in all {
        for (form, pairs) in forms.spec.forms.iter().zip(&forms.pairs) {
            let same_kernel = others.iter().find(|other| other.integrates_as(element, &form.name));
            let cell = CellForm { element, spec: forms.spec, form, pairs, same_kernel };
            let (text, flops) = cell.functions(&mut tables, &mut known)?;
            functions.extend(text);
            entries.push(entry(&cell, flops));
        }
    }
    let read = tables.read();
    let functions = quote!(#read #functions);
    let about = About {
        name: &element.name,
        title: &element.title,
        reference: &element.reference,
        file: &element.file,
        // What the kernels do counts for the hash, wherever they stand.
        beside: (all.iter().map(|forms| forms.written.text.as_str()))
            .chain(known.iter().map(|kernel| kernel.work.as_str()))
            .collect(),
    };
    let registered = registered(element, &about, &tables.all(), &entries);
    let heading = documented(&heading(element, &about));
    let name = identifier(&element.name);
    // An element may do nothing that another does not.
    let used = names(&functions);
    let called = ["cells", "forms", "Batch", "Lane", "Matrix", "Register"];
    let called = called.iter().filter(|name| used.contains(**name));
    let called = called.map(|name| format_ident!("{name}"));
    let module = quote! {
        #heading
        pub mod #name {
            use crate::{#(#called,)* Element, FormKernel, Origin, Structure, Variable};
            #functions
            #registered
        }
    };
    Ok(Kernel { name: element.name.clone(), module })
}

/// Modes can be condensed out of symmetric forms only, and only out of forms that exist.
fn check_enhanced(element: &ElementSpec, forms: &[&Form]) -> Result<(), Diagnostics> {
    let mut errors = Diagnostics::new();
    for name in element.enhanced.iter().flat_map(|enhanced| &enhanced.forms) {
        let message = match forms.iter().find(|form| form.name == name.text()) {
            None => format!("there is no form `{}`", name.text()),
            Some(form) if form.structure != Structure::Symmetric => format!(
                "enhanced modes cannot be condensed out of `{}`: it is not a symmetric form that \
                 couples the components of u",
                name.text()
            ),
            Some(_) => continue,
        };
        let names: Vec<&str> = forms.iter().map(|form| form.name.as_str()).collect();
        let help = crate::diagnostic::suggest(name.text(), &names);
        errors.push(name.error_here(Code::FORM, message).maybe_help(help));
    }
    errors.into_result(())
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
            flops: #flops,
            evaluate: #function,
        }
    }
}

fn registered(
    element: &ElementSpec,
    about: &About,
    tables: &TokenStream,
    entries: &[TokenStream],
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
    let vtk = Literal::u8_unsuffixed(element.vtk);
    quote! {
        /// The entry of the registry.
        pub const ENTRY: Element = Element {
            origin: #origin,
            nodes: #count,
            reference_nodes: &[#(#nodes),*],
            abaqus: &[#(#abaqus),*],
            abaqus_order: #abaqus_order,
            vtk: #vtk,
            vtk_order: #vtk_order,
            forms: &[#(#entries),*],
        };
    }
}
