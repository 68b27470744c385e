//! What is said of the cells of meshes made from dimensions.

use whirl_codegen::diagnostic::Located;
use whirl_solver::mesh::Fineness;
use whirl_text::rounded;

use super::wording::mm;

/// Frequencies of bending that are off by more than this part are warned of.
const OFF: f64 = 0.05;

/// The cells in words, with the error of frequencies that is expected.
pub(crate) fn described(own: &Fineness) -> String {
    let kind = if own.order == 1 { "linear" } else { "quadratic" };
    format!(
        "{kind} cells in layers of up to {}: bending frequencies are about {} % above those of a Timoshenko beam",
        mm(own.longest),
        rounded(100.0 * own.error, 2)
    )
}

/// Warns of layers that are too long for their cells; `table`: of the body, or of its dimensions.
pub(super) fn warn(body: &str, table: &Located, own: Option<Fineness>, warnings: &mut Vec<String>) {
    let Some(own) = own.filter(|own| own.error > OFF) else { return };
    let help = match own.order {
        1 => "make more layers, or quadratic cells: `cells.order = 2`",
        _ => "make more layers, or leave their number out",
    };
    warnings.push(format!(
        "{}: {body} has {}: {help}",
        table.source().path.display(),
        described(&own)
    ));
}
