//! What an analysis comes to.

use whirl_solver::linear::{Campbell, LinearMachine, Range};

use super::facts::Facts;
use super::speeds::Wanted;
use crate::case::Analysis;
use crate::errors::Failure;
use crate::figures::{Figure, png, svg};
use crate::signals::Interruption;

/// What is left of an analysis that was interrupted before it came to anything: nothing.
pub(super) fn nothing() -> Failure {
    let reason = "interrupted before anything was found".to_owned();
    Failure::Unfinished { reason, kept: None, help: None }
}

/// A text, and files.
pub(crate) struct Found {
    /// For people.
    pub(crate) text: String,
    /// Files by their names.
    pub(crate) files: Vec<(String, Vec<u8>)>,
    /// Whether it was interrupted before its end.
    pub(crate) interrupted: bool,
    /// For programs.
    pub(super) facts: Facts,
}

/// A figure as files: SVG, and PNG where it can be made.
pub(super) fn drawn(name: &str, figure: &Figure) -> impl Iterator<Item = (String, Vec<u8>)> {
    let drawing = svg(figure);
    let image = png(&drawing).map(|image| (format!("{name}.png"), image));
    image.into_iter().chain([(format!("{name}.svg"), drawing.into_bytes())])
}

/// Modes followed over the speeds of an analysis, with critical speeds of some orders.
///
/// # Errors
/// None of the speeds was done.
pub(super) fn followed(
    linear: &LinearMachine,
    (analysis, wanted): (&Analysis, &Wanted),
    interruption: &Interruption,
    orders: &[f64],
) -> Result<Campbell, Failure> {
    let range = Range {
        of: wanted.of.expect("a body that turns"),
        speeds: wanted.speeds.clone(),
        ratios: analysis.ratios.clone(),
        count: analysis.count,
        orders: orders.to_vec(),
    };
    let all = linear.campbell(&range, &|| !interruption.asked())?;
    if all.speeds.is_empty() {
        return Err(nothing());
    }
    Ok(all)
}
