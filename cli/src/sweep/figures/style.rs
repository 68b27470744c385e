//! How figures of a sweep show their series.

use crate::figures::Style;

/// What legends call points that are not sound.
pub(super) const DOUBTED: &str = "NOT SOUND: see `remark` in the table";

/// A style for each of two series, up and, if points are passed twice, down.
pub(super) fn style(series: usize, way: usize) -> Style {
    let styles = [Style::First, Style::Second, Style::Third, Style::Fourth];
    styles[(series + 2 * way) % styles.len()]
}
