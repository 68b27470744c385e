//! `*EQUATION`, and those `*MPC` that are linear.

use super::super::raw::{Direction, FileRow, MeshReport, TiePoint, count};
use super::cards::{Card, Token};
use super::joining::{Joining, REMEDY};
use super::values::{number, whole};

/// x, y and z of the nodes that a card names.
type Axes = [[f64; 3]; 3];

/// Reads `*EQUATION`: the number of terms, then a node or a set, a component and a coefficient for each. A set in the first
/// term stands for as many equations.
pub(super) fn of_equations(
    card: &Card,
    joining: &Joining,
    axes: Axes,
    report: &mut MeshReport,
) -> Vec<FileRow> {
    let mut rows = Vec::new();
    let mut lines = card.lines.iter();
    while let Some(head) = lines.next() {
        let Some(first) = head.first().copied() else { continue };
        let wanted = whole(first.text).and_then(|wanted| usize::try_from(wanted).ok());
        let Some(wanted) = wanted.filter(|wanted| head.len() == 1 && *wanted > 0) else {
            let what =
                format!("an equation begins with the number of its terms, found `{}`", first.text);
            report.error(first, what, "write the number in a line of its own, and the terms below");
            return rows;
        };
        let mut terms: Vec<[Token; 3]> = Vec::new();
        while terms.len() < wanted {
            let Some(line) = lines.next() else {
                let what = format!("the equation has {} of {wanted} terms", terms.len());
                report.error(first, what, "write a node, a component and a coefficient for each");
                return rows;
            };
            for term in line.chunks(3) {
                let &[node, component, by] = term else {
                    let what = "a term of an equation is a node, a component and a coefficient";
                    report.error(term[0], what, "write 17, 1, 1.0");
                    return rows;
                };
                terms.push([node, component, by]);
            }
        }
        if let Some(own) = of_terms(&terms, joining, axes, report) {
            rows.extend(own);
        }
    }
    rows
}

fn of_terms(
    terms: &[[Token; 3]],
    joining: &Joining,
    axes: Axes,
    report: &mut MeshReport,
) -> Option<Vec<FileRow>> {
    let before = report.error_count();
    let mut read: Vec<(Vec<usize>, Direction, f64)> = Vec::new();
    for [node, component, by] in terms {
        let nodes = joining.named(node, report);
        let direction = whole(component.text).filter(|own| (1..=6).contains(own));
        if direction.is_none() {
            let what = format!("a component must be 1 to 6, found `{}`", component.text);
            report.error(
                *component,
                what,
                "1, 2, 3 are displacements along x, y, z, 4, 5, 6 turns",
            );
        }
        let by = number(by, "a coefficient", report);
        if let (Some(own), Some(by)) = (direction, by) {
            read.push((nodes, Direction::of(axes, own as usize - 1), by));
        }
    }
    if report.error_count() > before || read.iter().any(|(nodes, ..)| nodes.is_empty()) {
        return None;
    }
    let many = read[0].0.len();
    if let Some(place) = read.iter().position(|(nodes, ..)| nodes.len() != 1 && nodes.len() != many)
    {
        let what = format!(
            "{} has {} where the first term has {many}",
            terms[place][0].text,
            count(read[place].0.len(), "node")
        );
        report.error(terms[place][0], what, "name sets of equally many nodes, or one node");
        return None;
    }
    let row = |place: usize| -> FileRow {
        let term = |(nodes, direction, by): &(Vec<usize>, Direction, f64)| -> FileRow {
            let node = nodes[if nodes.len() == 1 { 0 } else { place }];
            let motion = joining.point(node).motion(direction);
            motion.into_iter().map(|(dof, c)| (dof, by * c)).collect()
        };
        read.iter().flat_map(term).collect()
    };
    Some((0..many).map(row).collect())
}

/// Reads `*MPC`: a type and its nodes or sets a line.
pub(super) fn of_mpc(
    card: &Card,
    joining: &Joining,
    axes: Axes,
    report: &mut MeshReport,
) -> Vec<FileRow> {
    let mut rows = Vec::new();
    for line in &card.lines {
        let Some((&kind, members)) = line.split_first() else { continue };
        let before = report.error_count();
        let named = members.iter().filter(|token| !token.text.is_empty());
        let nodes: Vec<Vec<usize>> = named.map(|token| joining.named(token, report)).collect();
        if report.error_count() > before {
            continue;
        }
        let wanted = match kind.text.to_uppercase().as_str() {
            "TIE" | "PIN" | "BEAM" => 2,
            "LINEAR" => 3,
            _ => {
                let many =
                    nodes.iter().flatten().filter(|&&node| joining.is_of_cells(node)).count();
                if many > 1 {
                    let what = format!(
                        "*MPC of type {} ties nodes of cells, which is not read",
                        kind.text
                    );
                    report.error(
                        kind,
                        what,
                        format!("TIE, PIN, LINEAR and BEAM are read; {REMEDY}"),
                    );
                }
                continue;
            }
        };
        let many = nodes.first().map_or(0, Vec::len);
        let fits = |own: &Vec<usize>| own.len() == many || own.len() == 1;
        if nodes.len() != wanted || !nodes.iter().all(fits) {
            let what = format!("{} needs {wanted} nodes, or sets of equally many", kind.text);
            report.error(
                kind,
                what,
                format!("write {}, 1, 2{}", kind.text, if wanted == 3 { ", 3" } else { "" }),
            );
            continue;
        }
        for place in 0..many {
            let point =
                |own: &Vec<usize>| joining.point(own[if own.len() == 1 { 0 } else { place }]);
            let points: Vec<TiePoint> = nodes.iter().map(point).collect();
            rows.extend(of_points(&kind.text.to_uppercase(), &points, axes));
        }
    }
    rows
}

fn of_points(kind: &str, points: &[TiePoint], axes: Axes) -> Vec<FileRow> {
    let all = (0..6).map(|component| Direction::of(axes, component));
    let minus = |point: &TiePoint, direction: &Direction, by: f64| -> FileRow {
        point.motion(direction).into_iter().map(|(dof, c)| (dof, -by * c)).collect()
    };
    let linear = |directions: usize, others: &[(TiePoint, f64)]| -> Vec<FileRow> {
        let row = |direction: Direction| -> FileRow {
            let rest = others.iter().flat_map(|(other, by)| minus(other, &direction, *by));
            points[0].motion(&direction).into_iter().chain(rest).collect()
        };
        all.clone().take(directions).map(row).collect()
    };
    match *points {
        [point, body] if kind == "BEAM" => {
            all.map(|direction| point.follows(&body, &direction)).collect()
        }
        [_, other] => linear(if kind == "PIN" { 3 } else { 6 }, &[(other, 1.0)]),
        [point, from, to] => {
            let along: [f64; 3] = std::array::from_fn(|k| to.at[k] - from.at[k]);
            let dot = |from: [f64; 3]| -> f64 { (0..3).map(|k| from[k] * along[k]).sum() };
            let offset = std::array::from_fn(|k| point.at[k] - from.at[k]);
            let part = if dot(along) > 0.0 { dot(offset) / dot(along) } else { 0.5 };
            linear(6, &[(from, 1.0 - part), (to, part)])
        }
        _ => Vec::new(),
    }
}
