//! How well the cells of a mesh are shaped, and the axis about which it is round.

use super::measure::circle;
use super::surface::faces_within;
use super::{Cell, Mesh};

/// The worst cell of a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WorstCell {
    /// Smallest over largest det ∂x/∂ξ at its nodes: 1 of a cell that is its reference cell scaled, negative of one that is
    /// turned inside out somewhere.
    pub ratio: f64,
    /// Which cell it is.
    pub cell: Cell,
}

impl Mesh {
    /// The cell with the smallest ratio of Jacobians, and how many have one that is not positive; none of a mesh without
    /// cells.
    pub fn worst_cell(&self) -> Option<(WorstCell, usize)> {
        let (mut worst, mut inverted) = (None::<WorstCell>, 0);
        for (block, own) in self.blocks().iter().enumerate() {
            let nodes = own.element.nodes;
            let (mut values, mut slopes) = (vec![0.0; nodes], vec![[0.0; 3]; nodes]);
            for (cell, places) in own.cells().enumerate() {
                let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
                for &at in own.element.reference_nodes {
                    (own.element.shape)(at, &mut values, &mut slopes);
                    let jacobian = determinant(places.iter().map(|&a| self.nodes()[a]), &slopes);
                    // At the apex of a pyramid there is none.
                    if jacobian.is_finite() {
                        (least, most) = (least.min(jacobian), most.max(jacobian));
                    }
                }
                let ratio = least / most.abs().max(least.abs());
                inverted += usize::from(!(least > 0.0));
                if worst.is_none_or(|known| !(ratio >= known.ratio)) {
                    worst = Some(WorstCell { ratio, cell: Cell { block, cell } });
                }
            }
        }
        worst.map(|worst| (worst, inverted))
    }

    /// x and y of the axis along z about which most of the surface is round (m): through which the normals of most faces
    /// go. None where hardly any do.
    pub fn round_axis(&self) -> Option<[f64; 2]> {
        let all = vec![true; self.nodes().len()];
        let mut lines = Vec::new();
        for face in faces_within(self, &all).into_iter().filter(|face| !face.shared) {
            let ([x, y, _], [a, b, _]) = face.middle(self.nodes());
            let length = a.hypot(b);
            if length > 0.9 {
                lines.push(([x, y], [a / length, b / length]));
            }
        }
        let extent = lines.iter().fold(0.0, |most: f64, ([x, y], _)| most.max(x.hypot(*y)));
        // How far a normal passes from a point.
        let beside = |([x, y], [a, b]): &([f64; 2], [f64; 2]), [c, d]: [f64; 2]| {
            ((c - x) * b - (d - y) * a).abs()
        };
        let near = |centre: [f64; 2]| {
            lines.iter().filter(|own| beside(own, centre) < 1e-3 * extent).count()
        };
        let mut best = (0, [0.0; 2]);
        let tries = 400.min(lines.len());
        for k in 0..tries {
            let first = lines[k * lines.len() / tries];
            let second = lines[(k * lines.len() / tries + lines.len() / 3 + k) % lines.len()];
            let ([x, y], [a, b]) = first;
            let ([u, v], [c, d]) = second;
            let det = a * d - b * c;
            if det.abs() < 0.1 {
                continue;
            }
            let along = ((u - x) * d - (v - y) * c) / det;
            let centre = [x + along * a, y + along * b];
            let count = near(centre);
            if count > best.0 {
                best = (count, centre);
            }
        }
        let (count, centre) = best;
        if count < 12 || count < lines.len() / 20 {
            return None;
        }
        // Normals of faces are not those of the cylinder that they stand for, but nodes are on it.
        let cylinders = self.cylinders_with_nodes(centre);
        let (_, nodes) = cylinders.iter().max_by_key(|(_, nodes)| nodes.len())?;
        let points: Vec<[f64; 2]> =
            nodes.iter().map(|&node| self.nodes()[node]).map(|[x, y, _]| [x, y]).collect();
        let fitted = circle(&points)?.centre;
        // Rounding of the coordinates of a file is no offset.
        Some(fitted.map(|x: f64| if x.abs() < 1e-6 * extent { 0.0 } else { x }))
    }
}

/// det ∂x/∂ξ of a cell.
fn determinant(positions: impl Iterator<Item = [f64; 3]>, slopes: &[[f64; 3]]) -> f64 {
    let mut columns = [[0.0; 3]; 3];
    for (x, slope) in positions.zip(slopes) {
        for (column, slope) in columns.iter_mut().zip(slope) {
            column.iter_mut().zip(x).for_each(|(sum, x)| *sum += slope * x);
        }
    }
    let [a, b, c] = columns;
    (0..3).map(|i| a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3])).sum()
}
