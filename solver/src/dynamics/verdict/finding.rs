//! Something beyond its limit, and remedies in words.

use crate::dynamics::lengths::AutomaticStep;
use crate::dynamics::motion::MovingPart;

/// Something that was measured and is beyond its limit.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// What was measured.
    pub what: String,
    /// The bearing or stop where it was, counted from 0, if it was at one.
    pub bearing: Option<usize>,
    /// The part of the machine where it was, if it was in one.
    pub part: Option<MovingPart>,
    /// The coordinate of the machine whose equation it is of, by its place in q, if it is of one.
    pub coordinate: Option<usize>,
    /// How much it is, in `unit`.
    pub value: f64,
    /// How much it may be.
    pub limit: f64,
    /// Unit of value and limit; `1` for a fraction.
    pub unit: String,
    /// What to do about it.
    pub remedy: String,
}

/// What is beyond its limit, at no place yet.
pub(super) fn beyond(
    what: impl Into<String>,
    (value, limit, unit): (f64, f64, &str),
    remedy: String,
) -> Finding {
    let (what, unit) = (what.into(), unit.to_owned());
    Finding { what, bearing: None, part: None, coordinate: None, value, limit, unit, remedy }
}

/// The remedy of a shorter step, or of a narrower tolerance where the march chooses its steps.
pub(super) fn mended(step: f64, automatic: Option<AutomaticStep>) -> String {
    automatic.map_or_else(|| shorter(step), narrower)
}

/// The remedy of a shorter step, in two digits rounded down.
pub(super) fn shorter(step: f64) -> String {
    let unit = 10.0_f64.powf(step.log10().floor() - 1.0);
    let text = format!("{:.1e}", (step / unit + 1e-6).floor() * unit);
    format!("set `time_step = \"{text} s\"` in [march], and as many more steps")
}

/// The remedy where the march chooses its steps: a tenth of the tolerance, in two digits.
fn narrower(AutomaticStep { tolerance, .. }: AutomaticStep) -> String {
    format!("set `step_tolerance = {:.1e}` or less in [march]", 0.1 * tolerance)
}
