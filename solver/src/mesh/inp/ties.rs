//! Cards that tie nodes to one another: what they say of nodes of cells is read as equations. What cannot be read is
//! refused where it joins nodes of cells, and left out where it joins none.

use std::collections::BTreeSet;

use super::super::Tie;
use super::super::raw::{
    FileDof, MeshReport, RawTie, count, did_you_mean, eliminate, list, onto_faces,
};
use super::cards::{Card, Token};
use super::joining::{Joining, REMEDY};
use super::values::number;
use super::{couplings, equations};

/// Cards that are read.
pub(super) const READ: [&str; 8] = [
    "EQUATION",
    "MPC",
    "TIE",
    "RIGID BODY",
    "COUPLING",
    "KINEMATIC COUPLING",
    "KINEMATIC",
    "DISTRIBUTING",
];
/// Cards that join all that they name, in a way that is not read.
const REFUSED: [&str; 5] = [
    "EMBEDDED ELEMENT",
    "SHELL TO SOLID COUPLING",
    "CYCLIC SYMMETRY MODEL",
    "FASTENER",
    "DISTRIBUTING COUPLING",
];

/// Whether a card ties nodes.
pub(super) fn is_tie(keyword: &str) -> bool {
    READ.contains(&keyword) || is_refused(keyword)
}

/// Whether a card ties nodes in a way that is not read.
pub(super) fn is_refused(keyword: &str) -> bool {
    REFUSED.contains(&keyword)
}

/// Reads the ties of all cards, with the labels of the nodes beside the cells that they name.
pub(super) fn read(
    (all, cards): (&[Card], &[&Card]),
    joining: &Joining,
    report: &mut MeshReport,
) -> (Vec<Tie>, BTreeSet<u64>) {
    let mut raw: Vec<RawTie> = Vec::new();
    let mut in_part = false;
    let mut skipped: BTreeSet<&str> = BTreeSet::new();
    // Cards of ties.
    let mut wanted: Vec<Option<&Card>> = Vec::new();
    for (place, card) in cards.iter().enumerate() {
        let keyword = card.keyword.as_str();
        match keyword {
            "PART" | "INSTANCE" => in_part = true,
            "END PART" | "END INSTANCE" => in_part = false,
            _ => {}
        }
        if !is_tie(keyword) {
            continue;
        }
        let name = called(card);
        let basic = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let axes = if in_part { joining.axes } else { basic };
        let rows = match keyword {
            "EQUATION" => equations::of_equations(card, joining, axes, report),
            "MPC" => equations::of_mpc(card, joining, axes, report),
            "TIE" => onto_surface(card, joining, report),
            "RIGID BODY" => couplings::of_rigid_body(card, joining, report),
            "KINEMATIC COUPLING" => couplings::of_old_coupling(card, joining, report),
            "COUPLING" => {
                let next = cards.get(place + 1).copied();
                couplings::of_coupling(card, next, joining, report)
            }
            "KINEMATIC" | "DISTRIBUTING" => continue,
            _ => {
                refuse(card, joining, &mut skipped, report);
                continue;
            }
        };
        // What spreads a load joins nothing, unless its node does; nodes beyond a tolerance are said.
        let next = cards.get(place + 1).map_or("", |next| &next.keyword);
        let idle = keyword == "TIE" || keyword == "COUPLING" && next == "DISTRIBUTING";
        wanted.push((!idle).then_some(card));
        raw.push(RawTie { name, rows });
    }
    turned_nodes(all, joining, &raw, report);
    let broken = report.error_count() > 0;
    let beside = |(dof, _): &(FileDof, f64)| match *dof {
        FileDof::Cell(_) => None,
        FileDof::Other(node, _) => Some(joining.nodes.named.labels[node as usize]),
    };
    let rows = raw.iter().flat_map(|tie| &tie.rows);
    let named = rows.flatten().filter_map(beside).collect();
    let (ties, idle) = eliminate(raw);
    for card in wanted.into_iter().zip(idle).filter_map(|(card, idle)| card.filter(|_| idle)) {
        if !broken && skipped.insert(&card.keyword) {
            let what = format!("*{} is left out: it joins no two nodes of cells", card.keyword);
            report.warn(card.place, what, "");
        }
    }
    (ties, named)
}

/// `*TIE BOND`, or `*EQUATION of line 12`.
fn called(card: &Card) -> String {
    let name = ["NAME", "CONSTRAINT NAME"].iter().find_map(|name| card.parameter(name)?.value);
    match name {
        Some(name) => format!("*{} {}", card.keyword, name.text),
        None => format!("*{} of line {}", card.keyword, card.place.line),
    }
}

/// Refuses a card that is not read, unless it joins no nodes of cells.
fn refuse<'c>(
    card: &'c Card,
    joining: &Joining,
    skipped: &mut BTreeSet<&'c str>,
    report: &mut MeshReport,
) {
    let sets = &joining.nodes.named.sets;
    let of_cells = |token: &Token| {
        let own = match token.text.parse() {
            Ok(label) => joining.nodes.named.index.get(&label).map(std::slice::from_ref),
            Err(_) => sets.get(token.text),
        };
        own.unwrap_or_default().iter().any(|&node| joining.of_cells[node])
    };
    let keyword = card.keyword.as_str();
    if keyword != "DISTRIBUTING COUPLING" && card.lines.iter().flatten().any(of_cells) {
        let what = format!("*{keyword} ties nodes of cells to one another, which is not read");
        report.error(card.place, what, REMEDY);
    } else if skipped.insert(keyword) {
        report.warn(
            card.place,
            format!("*{keyword} is left out: it joins no two nodes of cells"),
            "",
        );
    }
}

/// Nodes whose axes a card turns are named by no equation.
fn turned_nodes(cards: &[Card], joining: &Joining, raw: &[RawTie], report: &mut MeshReport) {
    let Some((card, set)) = cards.iter().find_map(|card| {
        let set = card.parameter("NSET")?.value?;
        (card.keyword == "TRANSFORM").then_some((card, set))
    }) else {
        return;
    };
    let own: BTreeSet<usize> =
        joining.nodes.named.sets.get(set.text).unwrap_or_default().iter().copied().collect();
    let node_of = |dof: &FileDof| match *dof {
        FileDof::Cell(dof) => dof / 3,
        FileDof::Other(node, _) => node as usize,
    };
    let met = |tie: &&RawTie| tie.rows.iter().flatten().any(|(dof, _)| own.contains(&node_of(dof)));
    if let Some(tie) = raw.iter().find(met) {
        let what = format!(
            "*TRANSFORM turns the axes of nodes that {} names, which is not read",
            tie.name
        );
        report.error(card.place, what, "write the equations in x, y, z");
    }
}

/// Reads `*TIE`: nodes of the first surface follow the faces of the second one.
fn onto_surface(
    card: &Card,
    joining: &Joining,
    report: &mut MeshReport,
) -> Vec<super::super::raw::FileRow> {
    let value = |name: &str| card.parameter(name).and_then(|parameter| parameter.value);
    let most =
        value("POSITION TOLERANCE").and_then(|token| number(&token, "POSITION TOLERANCE", report));
    // Nodes of a set that is named are tied however far away they are.
    let within: Option<BTreeSet<usize>> =
        value("TIED NSET").map(|token| joining.named(&token, report).into_iter().collect());
    let most = most.or(within.as_ref().map(|_| f64::INFINITY));
    let mut rows = Vec::new();
    for line in &card.lines {
        let [follower, master, ..] = line[..] else {
            report.error(
                line.first().copied().unwrap_or(card.place),
                "*TIE needs two surfaces",
                "write the \
                surface whose nodes follow, and the one that they follow",
            );
            continue;
        };
        let followers: Vec<usize> = joining
            .named(&follower, report)
            .into_iter()
            .filter(|node| {
                joining.of_cells[*node] && within.as_ref().is_none_or(|own| own.contains(node))
            })
            .collect();
        let text = master.text.trim_matches('"').to_uppercase();
        let bare = text.rsplit_once('.').map_or(text.as_str(), |(_, name)| name);
        let faces = joining.surfaces.get(&text).or_else(|| joining.surfaces.get(bare));
        let Some(faces) = faces.filter(|faces| !faces.is_empty()) else {
            if !joining.nodes.named.lost && !joining.cells.named.lost {
                let what = format!("{} has no faces of cells that nodes could follow", master.text);
                let help = did_you_mean(master.text, joining.surfaces.keys().map(String::as_str));
                report.error(master, what, format!("a *SURFACE of TYPE=ELEMENT has; {help}"));
            }
            continue;
        };
        let (own, lost) = onto_faces(joining.nodes, joining.cells, (&followers, faces), most);
        if !lost.is_empty() {
            let labels = list(lost.iter().map(|&node| joining.nodes.named.labels[node]));
            let what = format!(
                "{} of {} {} farther from the faces of {} than the tolerance, and not tied: {labels}",
                count(lost.len(), "node"),
                follower.text,
                if lost.len() == 1 { "is" } else { "are" },
                master.text
            );
            let help = "if they are to be tied, write POSITION TOLERANCE=… on the card, in units of the file";
            report.warn(follower, what, help);
        }
        rows.extend(own);
    }
    rows
}
