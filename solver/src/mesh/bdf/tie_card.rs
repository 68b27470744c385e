//! Cards that tie nodes to one another, as they are written.

use std::collections::{BTreeMap, BTreeSet};

use super::super::raw::{LinePosition, MeshReport};
use super::components::{components, components_in};
use super::fields::{Card, Field};
use super::known::TIED;
use super::numbers;

/// A card as written.
pub(super) struct RawCard {
    pub(super) name: String,
    /// Its label; that of an `MPC` is the one of its set.
    pub(super) label: u64,
    pub(super) place: LinePosition,
    pub(super) kind: Kind,
}

/// What a card says.
pub(super) enum Kind {
    /// Node, component, coefficient; of a scalar point the component is none.
    Equation(Vec<(u64, Option<usize>, f64)>),
    /// Nodes with the components of theirs that move as one body.
    Rigid(Vec<(u64, Vec<usize>)>),
    /// The distance of two nodes.
    Rod([u64; 2]),
    /// Nodes of a card that is not read, among which components may be.
    Refused(BTreeSet<u64>),
}

/// Which sets of equations count.
#[derive(Default)]
pub(super) struct Chosen {
    /// Whether there is case control.
    pub(super) control: bool,
    /// Sets that it names.
    pub(super) named: BTreeMap<u64, LinePosition>,
    /// `MPCADD`: sets that a set stands for.
    pub(super) sums: BTreeMap<u64, Vec<u64>>,
}

/// Reads a card; `None` after an error.
pub(super) fn read(card: &Card, report: &mut MeshReport) -> Option<RawCard> {
    let made =
        |label, kind| Some(RawCard { name: card.name.to_string(), label, place: card.place, kind });
    let name = card.name.as_ref();
    if !TIED.contains(&name) {
        let at = |at: usize| numbers::whole(card.field(at)?.text);
        let nodes = (1..card.fields.len()).filter_map(at).collect();
        return made(at(0).unwrap_or(0), Kind::Refused(nodes));
    }
    let label = report.label(card, 0, "label")?;
    match name {
        "MPC" => made(label, Kind::Equation(terms(card, report)?)),
        "RBE1" => {
            let fields: Vec<Field> = card.filled_from(1).copied().collect();
            let mut points: Vec<(u64, Vec<usize>)> = Vec::new();
            let mut at = 0;
            let mut own = 0;
            let mut independent = None;
            while let Some(field) = fields.get(at) {
                if numbers::is_real(field.text) {
                    break;
                }
                if field.text.eq_ignore_ascii_case("UM") {
                    independent = Some(own);
                    at += 1;
                    continue;
                }
                let node = report.label_in(card, field, "node")?;
                let Some(next) = fields.get(at + 1) else {
                    let what = format!("RBE1 {label} gives no components of node {node}");
                    report.error(card.place, what, "write them behind it, such as 123456");
                    return None;
                };
                let Some(components) = components(next.text) else {
                    report.wrong(card, next, "components", "digits from 1 to 6");
                    return None;
                };
                own += components.len();
                points.push((node, components));
                at += 2;
            }
            six(independent.unwrap_or(own), card, label, report)?;
            made(label, Kind::Rigid(points))
        }
        "RBAR1" => {
            let nodes = [report.label(card, 1, "node")?, report.label(card, 2, "node")?];
            let own = components_in(card, 3, report)?;
            let own = if own.is_empty() { (0..6).collect() } else { own };
            made(label, Kind::Rigid(vec![(nodes[0], (0..6).collect()), (nodes[1], own)]))
        }
        "RROD" => {
            let nodes = [report.label(card, 1, "node")?, report.label(card, 2, "node")?];
            made(label, Kind::Rod(nodes))
        }
        _ => {
            let nodes = [report.label(card, 1, "node")?, report.label(card, 2, "node")?];
            let mut all = [const { Vec::new() }; 4];
            for (at, own) in all.iter_mut().enumerate() {
                *own = components_in(card, 3 + at, report)?;
            }
            let [first, second, by_first, by_second] = all;
            six(first.len() + second.len(), card, label, report)?;
            let rest = by_first.is_empty() && by_second.is_empty();
            let both = |independent: Vec<usize>, dependent: Vec<usize>| -> Vec<usize> {
                if rest { (0..6).collect() } else { [independent, dependent].concat() }
            };
            let points =
                vec![(nodes[0], both(first, by_first)), (nodes[1], both(second, by_second))];
            made(label, Kind::Rigid(points))
        }
    }
}

/// A rigid body has six independent components.
fn six(number: usize, card: &Card, label: u64, report: &mut MeshReport) -> Option<()> {
    if number == 6 {
        return Some(());
    }
    let what = format!(
        "{} {label} has {number} independent components, where a rigid body has six",
        card.name
    );
    report.error(card.place, what, "let one node have all of them, 123456");
    None
}

/// The terms of an `MPC`: node, component and coefficient, twice a line.
fn terms(card: &Card, report: &mut MeshReport) -> Option<Vec<(u64, Option<usize>, f64)>> {
    let mut terms = Vec::new();
    for at in (0..card.fields.len()).filter(|at| [1, 4].contains(&(at % 8))) {
        if card.field(at).is_none() && card.field(at + 2).is_none() {
            continue;
        }
        let node = report.label(card, at, "node")?;
        let own = components_in(card, at + 1, report)?;
        if let [_, _, ..] = own[..] {
            let field = *card.field(at + 1)?;
            report.wrong(card, &field, "component", "a digit from 1 to 6");
            return None;
        }
        let by = report.real(card, at + 2, "coefficient")?;
        terms.push((node, own.first().copied(), by));
    }
    Some(terms)
}

impl RawCard {
    /// Nodes that it names, and components where these cannot be told apart.
    pub(super) fn nodes(&self) -> Vec<u64> {
        match &self.kind {
            Kind::Equation(terms) => terms.iter().map(|(node, ..)| *node).collect(),
            Kind::Rigid(points) => points.iter().map(|(node, _)| *node).collect(),
            Kind::Rod(nodes) => nodes.to_vec(),
            Kind::Refused(nodes) => nodes.iter().copied().collect(),
        }
    }
}
