//! Rigid bodies and couplings: nodes that move rigidly with a reference node, and a reference node that moves as the mean of
//! others.

use std::collections::BTreeSet;

use super::super::raw::{Direction, FileDof, FileRow, MeshReport, did_you_mean, follows_mean};
use super::cards::{Card, Token};
use super::joining::Joining;
use super::values::{number, required, whole};

const BASIC: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Reads `*RIGID BODY`: nodes of a set, or of the cells of one, move as one body.
pub(super) fn of_rigid_body(
    card: &Card,
    joining: &Joining,
    report: &mut MeshReport,
) -> Vec<FileRow> {
    let value = |name: &str| card.parameter(name).and_then(|parameter| parameter.value);
    let mut nodes: BTreeSet<usize> = BTreeSet::new();
    for name in ["NSET", "PIN NSET", "TIE NSET"] {
        if let Some(token) = value(name) {
            nodes.extend(joining.named(&token, report));
        }
    }
    if let Some(token) = value("ELSET") {
        let cells = joining.cells.named.sets.get(token.text);
        let others = joining.others.sets.get(token.text);
        if cells.is_none() && others.is_none() && !joining.cells.named.lost {
            let what = format!("no set of cells is called {}", token.text);
            report.error(token, what, did_you_mean(token.text, joining.cells.named.sets.names()));
        }
        let own =
            cells.unwrap_or_default().iter().flat_map(|&cell| &joining.cells.list[cell].nodes);
        nodes.extend(own);
        let left = others.unwrap_or_default().iter().flat_map(|&own| &joining.others.nodes[own]);
        nodes.extend(left);
    }
    let Some(token) = required(card, "REF NODE", "*RIGID BODY, REF NODE=1, NSET=NAME", report)
    else {
        return Vec::new();
    };
    let Some(reference) = joining.single(&token, report) else { return Vec::new() };
    let mut body = joining.point(reference);
    // CalculiX has the turns as displacements of a node of their own.
    if let Some(turns) = value("ROT NODE").and_then(|token| joining.single(&token, report)) {
        (0..3).for_each(|k| body.dofs[3 + k] = FileDof::Other(turns as u64, k));
    }
    nodes.remove(&reference);
    let follows = |&node: &usize| {
        let point = joining.point(node);
        Direction::all().map(|direction| point.follows(&body, &direction))
    };
    nodes.iter().flat_map(follows).collect()
}

/// Reads `*COUPLING` with the `*KINEMATIC` or `*DISTRIBUTING` below it.
pub(super) fn of_coupling(
    card: &Card,
    next: Option<&Card>,
    joining: &Joining,
    report: &mut MeshReport,
) -> Vec<FileRow> {
    let example = "*COUPLING, CONSTRAINT NAME=C, REF NODE=1, SURFACE=BORE";
    let reference = required(card, "REF NODE", example, report)
        .and_then(|token| joining.single(&token, report));
    let surface =
        required(card, "SURFACE", example, report).map(|token| joining.named(&token, report));
    let (Some(reference), Some(mut nodes)) = (reference, surface) else { return Vec::new() };
    if let Some(token) = card.parameter("INFLUENCE RADIUS").and_then(|own| own.value) {
        let Some(radius) = number(&token, "INFLUENCE RADIUS", report) else { return Vec::new() };
        let at = |node: usize| joining.nodes.positions[node];
        let away = |node: usize| -> f64 {
            (0..3).map(|k| (at(node)[k] - at(reference)[k]).powi(2)).sum::<f64>().sqrt()
        };
        nodes.retain(|&node| away(node) <= radius);
    }
    nodes.retain(|&node| node != reference);
    let body = joining.point(reference);
    let turned = card.parameter("ORIENTATION");
    let chosen = |card: &Card, report: &mut MeshReport| -> Vec<Direction> {
        let own = components(&card.lines, report);
        let whole = [[0, 1, 2], [3, 4, 5]]
            .iter()
            .all(|of| [0, 3].contains(&of.iter().filter(|k| own.contains(k)).count()));
        if let Some(turned) = turned.filter(|_| !whole) {
            let what = "ORIENTATION turns the axes of some components, which is not read";
            report.error(
                turned.place,
                what,
                "couple all of 1 to 3, or write the coupling in x, y, z",
            );
        }
        own.into_iter().map(|k| Direction::of(BASIC, k)).collect()
    };
    match next {
        Some(kind) if kind.keyword == "KINEMATIC" => {
            let directions = chosen(kind, report);
            let follows = |node: usize| -> Vec<FileRow> {
                let point = joining.point(node);
                directions.iter().map(|direction| point.follows(&body, direction)).collect()
            };
            nodes.into_iter().flat_map(follows).collect()
        }
        Some(kind) if kind.keyword == "DISTRIBUTING" => {
            let directions = chosen(kind, report);
            let translations = Direction::all()[..3].to_vec();
            let others: Vec<_> = nodes
                .into_iter()
                .map(|node| (joining.point(node), translations.clone(), 1.0))
                .collect();
            follows_mean(&body, &directions, &others).unwrap_or_default()
        }
        _ => {
            let what = "*COUPLING has no *KINEMATIC or *DISTRIBUTING below it";
            report.error(card.place, what, "write *KINEMATIC in the next line");
            Vec::new()
        }
    }
}

/// Reads `*KINEMATIC COUPLING`: nodes or sets a line, with the first and the last component.
pub(super) fn of_old_coupling(
    card: &Card,
    joining: &Joining,
    report: &mut MeshReport,
) -> Vec<FileRow> {
    let reference = required(card, "REF NODE", "*KINEMATIC COUPLING, REF NODE=1", report)
        .and_then(|token| joining.single(&token, report));
    let Some(reference) = reference else { return Vec::new() };
    let body = joining.point(reference);
    let mut rows = Vec::new();
    for line in &card.lines {
        let Some((nodes, own)) = line.split_first() else { continue };
        let own = components(&[own.to_vec()], report);
        for node in joining.named(nodes, report).into_iter().filter(|&node| node != reference) {
            let point = joining.point(node);
            rows.extend(own.iter().map(|&k| point.follows(&body, &Direction::of(BASIC, k))));
        }
    }
    rows
}

/// Components from 0 to 5, by lines with the first and the last of them; all where there are none.
fn components(lines: &[Vec<Token>], report: &mut MeshReport) -> Vec<usize> {
    let mut own: BTreeSet<usize> = BTreeSet::new();
    for line in lines {
        let filled = line.iter().filter(|token| !token.text.is_empty());
        let ends: Vec<(&Token, i64)> =
            filled.map(|token| (token, whole(token.text).unwrap_or(0))).collect();
        match ends[..] {
            [] => {}
            [(_, first), ..]
                if ends.len() <= 2 && ends.iter().all(|(_, k)| (1..=6).contains(k)) =>
            {
                let last = ends.last().map_or(first, |(_, last)| *last);
                own.extend((first..=last).map(|k| k as usize - 1));
            }
            [(token, _), ..] => {
                let what = "components are the first and the last of 1 to 6";
                report.error(*token, what, "write 1, 6");
            }
        }
    }
    if own.is_empty() { (0..6).collect() } else { own.into_iter().collect() }
}
