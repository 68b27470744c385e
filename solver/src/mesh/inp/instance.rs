//! How an instance is moved and turned.

use super::super::raw::MeshReport;
use super::cards::Card;
use super::values::number;

/// A displacement, and behind it a turn about an axis by an angle (rad).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Motion {
    by: [f64; 3],
    /// A point of the axis, its direction and the angle.
    turn: Option<([f64; 3], [f64; 3], f64)>,
}

impl Motion {
    /// Where a point of the part is in the assembly.
    pub(super) fn place(&self, position: [f64; 3]) -> [f64; 3] {
        let moved = [0, 1, 2].map(|i| position[i] + self.by[i]);
        match self.turn {
            Some((from, axis, angle)) => turned(moved, from, axis, angle),
            None => moved,
        }
    }

    /// Where x, y and z of the part point in the assembly.
    pub(super) fn axes(&self) -> [[f64; 3]; 3] {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        match self.turn {
            Some((_, axis, angle)) => axes.map(|own| turned(own, [0.0; 3], axis, angle)),
            None => axes,
        }
    }
}

/// The motion of an `*INSTANCE`: the first line moves, and the second one turns about the line from a to b, by an angle in degrees.
pub(super) fn motion(card: &Card, report: &mut MeshReport) -> Motion {
    let mut values: [Vec<f64>; 2] = [Vec::new(), Vec::new()];
    for (line, values) in card.lines.iter().zip(&mut values) {
        values.extend(line.iter().filter_map(|token| match token.text {
            "" => Some(0.0),
            _ => number(token, "a coordinate", report),
        }));
    }
    // What is left blank behind the last comma is 0.
    if let (Some(true), [_, _]) = (card.open.first(), &values[0][..]) {
        values[0].push(0.0);
    }
    let [by, turn] = values;
    match (&by[..], &turn[..], card.lines.len()) {
        ([], [], 0) => Motion::default(),
        (&[x, y, z], [], 1) => Motion { by: [x, y, z], turn: None },
        (&[x, y, z], &[ax, ay, az, bx, by, bz, angle], 2) => {
            let axis = [bx - ax, by - ay, bz - az];
            if axis == [0.0; 3] {
                let what = "the two points of the axis are one";
                report.error(card.lines[1][0], what, "write two points");
                return Motion::default();
            }
            Motion { by: [x, y, z], turn: Some(([ax, ay, az], axis, angle.to_radians())) }
        }
        _ => {
            let help = "write x, y, z, and below them two points and an angle: ax, ay, az, bx, by, bz, angle";
            let at = card.lines[0].first().copied().unwrap_or(card.place);
            report.error(at, "an *INSTANCE is moved by other numbers than these", help);
            Motion::default()
        }
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
