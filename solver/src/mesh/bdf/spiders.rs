//! Rigid and averaging spiders, `RBE2` and `RBE3`: their nodes are the interfaces of the mesh, and move as they say.

use super::super::raw::{LinePosition, MeshReport};
use super::components::{components as of_digits, components_in};
use super::fields::Card;
use super::numbers;
use super::sets::Ranges;

/// A spider as written.
#[derive(Debug, Clone)]
pub(super) struct Spider {
    pub(super) label: u64,
    /// `RBE2`, else `RBE3`.
    pub(super) rigid: bool,
    pub(super) reference: u64,
    pub(super) nodes: Ranges,
    /// Components of the reference node that follow the others, of `RBE3`.
    pub(super) components: Vec<usize>,
    /// The nodes by their weights and components.
    pub(super) groups: Vec<(f64, Vec<usize>, Ranges)>,
    /// Whether its nodes count differently.
    pub(super) weighted: bool,
    pub(super) place: LinePosition,
}

impl Spider {
    pub(super) fn card(&self) -> &'static str {
        if self.rigid { "RBE2" } else { "RBE3" }
    }
}

/// Reads `RBE2`: label, reference, components, nodes, and a coefficient of thermal expansion.
pub(super) fn rigid(card: &Card, report: &mut MeshReport) -> Option<Spider> {
    let label = report.label(card, 0, "label of the element");
    let reference = report.label(card, 1, "reference node");
    let mut members = card.clone();
    if members.filled_from(3).last().is_some_and(|last| numbers::is_real(last.text)) {
        let last = members.fields.iter().rposition(|field| !field.text.is_empty()).unwrap_or(0);
        members.fields.truncate(last);
    }
    let own = components_in(card, 2, report);
    let nodes = Ranges::of_card(&members, 3, report);
    let (label, reference, own) = (label?, reference?, own?);
    let groups = vec![(1.0, own, nodes.clone())];
    let components = Vec::new();
    let (rigid, weighted, place) = (true, false, card.place);
    Some(Spider { label, rigid, reference, nodes, components, groups, weighted, place })
}

/// Reads `RBE3`: label, nothing, reference, components, then groups of a weight, components and nodes.
pub(super) fn averaging(card: &Card, report: &mut MeshReport) -> Option<Spider> {
    let label = report.label(card, 0, "label of the element");
    let reference = report.label(card, 2, "reference node");
    let components = components_in(card, 3, report);
    let mut nodes = Ranges::default();
    let mut groups = Vec::new();
    let mut moved = Vec::new();
    let mut weights: Vec<f64> = Vec::new();
    let fields: Vec<_> = card.filled_from(4).copied().collect();
    let mut at = 0;
    while at < fields.len() {
        let field = fields[at];
        if ["UM", "ALPHA"].contains(&field.text.to_ascii_uppercase().as_str()) {
            break;
        }
        if weights.is_empty() || numbers::is_real(field.text) {
            weights.extend(report.real_in(card, &field, "weight"));
            if let Some(field) = fields.get(at + 1) {
                let Some(own) = of_digits(field.text) else {
                    report.wrong(card, field, "components", "digits from 1 to 6");
                    return None;
                };
                moved = own;
            }
            at += 2;
            continue;
        }
        let start = at;
        let is_member =
            |text: &str| numbers::whole(text).is_some() || text.eq_ignore_ascii_case("THRU");
        while fields.get(at).is_some_and(|field| is_member(field.text)) {
            at += 1;
        }
        if at == start {
            report.wrong(
                card,
                &field,
                "label",
                "a whole number from 1, a weight such as 1.0, or UM",
            );
            return None;
        }
        let mut group = card.clone();
        group.fields = fields[start..at].to_vec();
        let own = Ranges::of_card(&group, 0, report);
        groups.push((weights.last().copied().unwrap_or(1.0), moved.clone(), own.clone()));
        nodes.extend(own);
    }
    let weighted = weights.windows(2).any(|pair| pair[0] != pair[1]);
    let (label, reference, components) = (label?, reference?, components?);
    let (rigid, place) = (false, card.place);
    Some(Spider { label, rigid, reference, nodes, components, groups, weighted, place })
}
