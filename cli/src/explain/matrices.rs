//! The matrices that an element gives to every form.

use whirl_codegen::kinds::element::ElementSpec;
use whirl_codegen::kinds::page::Page;
use whirl_specs::{ELEMENTS, FormKernel, Structure};

/// The matrices of the built-in kernels on this element.
pub(super) fn explain(page: &mut Page, element: &ElementSpec) {
    let same = |kernels: &&whirl_specs::Element| kernels.origin.text == element.file.text;
    let Some(kernels) = ELEMENTS.iter().find(same) else { return };
    page.heading("Matrices of a cell");
    let rows = kernels.forms.iter().map(|kernel| {
        let stored = kernel.structure.len(kernels.nodes);
        vec![
            kernel.form.to_string(),
            words(kernel, kernels.nodes),
            format!("{stored} values stored"),
        ]
    });
    page.columns(&rows.collect::<Vec<_>>());
}

/// The structure of a form's matrix on an element.
fn words(kernel: &FormKernel, nodes: usize) -> String {
    let size = 3 * nodes;
    match &kernel.structure {
        Structure::Symmetric => format!("{size} × {size}, symmetric"),
        Structure::Full => format!("{size} × {size}"),
        Structure::Kronecker { pattern } => {
            let skew = (0..3).any(|i| (0..3).any(|j| pattern[i][j] != pattern[j][i]));
            let word = if skew { "skew" } else { "symmetric" };
            format!("{size} × {size}, {word}: one symmetric {nodes} × {nodes} matrix ⊗ 3 × 3")
        }
    }
}
