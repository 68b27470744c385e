//! Components of nodes, digits from 1 to 6.

use std::collections::BTreeSet;

use super::super::raw::MeshReport;
use super::fields::Card;

/// Digits from 1 to 6, from 0; none for a blank field or 0.
pub(super) fn components(text: &str) -> Option<Vec<usize>> {
    let own: BTreeSet<usize> = match text {
        "0" => BTreeSet::new(),
        _ => text
            .bytes()
            .map(|c| (b'1'..=b'6').contains(&c).then(|| usize::from(c - b'1')))
            .collect::<Option<_>>()?,
    };
    Some(own.into_iter().collect())
}

/// The components in a field; none where it is blank.
pub(super) fn components_in(card: &Card, at: usize, report: &mut MeshReport) -> Option<Vec<usize>> {
    let Some(&field) = card.field(at) else { return Some(Vec::new()) };
    let own = components(field.text);
    if own.is_none() {
        report.wrong(card, &field, "components", "digits from 1 to 6");
    }
    own
}
