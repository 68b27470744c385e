//! Parts and instances: one of each, which may be moved and turned.

use super::super::raw::{MeshReport, NodeTable};
use super::cards::Card;
use super::values::{number, read_number};

/// Keywords around parts and their instances.
pub(super) const PARTS: [&str; 6] =
    ["PART", "END PART", "ASSEMBLY", "END ASSEMBLY", "INSTANCE", "END INSTANCE"];

/// Whether there is one part and one instance at most. Of more the labels stand twice: nothing else can be said of
/// the file.
pub(super) fn is_one(cards: &[Card], report: &mut MeshReport) -> bool {
    let before = report.error_count();
    for keyword in ["PART", "INSTANCE"] {
        if let Some(second) = cards.iter().filter(|card| card.keyword == keyword).nth(1) {
            let help = "merge them into one part, or write a file for each body";
            report.error(second.place, format!("a second *{keyword} is not read"), help);
        }
    }
    report.error_count() == before
}

/// Puts the nodes where the instance has them.
pub(super) fn place(cards: &[Card], nodes: &mut NodeTable, report: &mut MeshReport) {
    if let Some(card) = cards.iter().find(|card| card.keyword == "INSTANCE") {
        move_and_turn(card, nodes, report);
    }
}

/// Where x, y and z of the part point in the instance.
pub(super) fn axes(cards: &[Card]) -> [[f64; 3]; 3] {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let turn = cards.iter().find(|card| card.keyword == "INSTANCE").and_then(|card| {
        let values = card.lines.get(1)?.iter().map(|token| read_number(token.text));
        let values: Vec<f64> = values.collect::<Option<_>>()?;
        <[f64; 7]>::try_from(values).ok()
    });
    let Some([ax, ay, az, bx, by, bz, angle]) = turn else { return axes };
    axes.map(|own| turned(own, [0.0; 3], [bx - ax, by - ay, bz - az], angle.to_radians()))
}

/// The first line moves, and the second one turns about the line from a to b, by an angle in degrees.
fn move_and_turn(card: &Card, nodes: &mut NodeTable, report: &mut MeshReport) {
    let mut values: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
    for (line, values) in card.lines.iter().zip(&mut values) {
        values.extend(line.iter().filter_map(|token| number(token, "a coordinate", report)));
    }
    let [by, turn] = values;
    let (by, turn) = match (&by[..], &turn[..], card.lines.len()) {
        ([], [], 0) => return,
        (&[x, y, z], [], 1) => ([x, y, z], None),
        (&[x, y, z], &[ax, ay, az, bx, by, bz, angle], 2) => {
            ([x, y, z], Some(([ax, ay, az], [bx - ax, by - ay, bz - az], angle)))
        }
        _ => {
            let help = "write x, y, z, and below them two points and an angle: ax, ay, az, bx, by, bz, angle";
            report.error(
                card.lines[0][0],
                "an *INSTANCE is moved by other numbers than these",
                help,
            );
            return;
        }
    };
    for position in &mut nodes.positions {
        *position = [0, 1, 2].map(|i| position[i] + by[i]);
        if let Some((from, axis, angle)) = turn {
            *position = turned(*position, from, axis, angle.to_radians());
        }
    }
    if turn.is_some_and(|(_, axis, _)| axis == [0.0; 3]) {
        report.error(card.lines[1][0], "the two points of the axis are one", "write two points");
    }
}

/// Rotation about an axis through a point (Rodrigues' formula).
fn turned(position: [f64; 3], from: [f64; 3], axis: [f64; 3], angle: f64) -> [f64; 3] {
    let length = axis.iter().map(|x| x * x).sum::<f64>().sqrt();
    let n = axis.map(|x| x / length);
    let r = [0, 1, 2].map(|i| position[i] - from[i]);
    let cross = [0, 1, 2].map(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        n[j] * r[k] - n[k] * r[j]
    });
    let along: f64 = (0..3).map(|i| n[i] * r[i]).sum();
    let (sin, cos) = angle.sin_cos();
    [0, 1, 2].map(|i| from[i] + cos * r[i] + sin * cross[i] + (1.0 - cos) * along * n[i])
}
