//! One face of a cell.

use whirl_specs::{Element, Face};

/// A face of a cell.
#[derive(Debug, Clone)]
pub(crate) struct SurfaceFace {
    pub(crate) element: &'static Element,
    pub(crate) face: &'static Face,
    /// Nodes of the cell, in the order of the element.
    pub(super) cell: Vec<usize>,
    /// Whether another cell has it, too.
    pub(crate) shared: bool,
}

impl SurfaceFace {
    /// Its nodes.
    pub(crate) fn nodes(&self) -> impl Iterator<Item = usize> {
        self.face.nodes.iter().map(|&place| self.cell[place])
    }

    /// Its mean point over the points of its rule (m), and its outward unit normal there.
    pub(crate) fn middle(&self, positions: &[[f64; 3]]) -> ([f64; 3], [f64; 3]) {
        let (mut centre, mut normal, mut weights) = ([0.0; 3], [0.0; 3], 0.0);
        for point in self.face.points {
            let mut tangents = [[0.0; 3]; 2];
            weights += point.weight;
            for ((node, value), slope) in self.nodes().zip(point.values).zip(point.slopes) {
                let x = positions[node];
                for k in 0..3 {
                    centre[k] += point.weight * value * x[k];
                    tangents[0][k] += slope[0] * x[k];
                    tangents[1][k] += slope[1] * x[k];
                }
            }
            let [a, b] = tangents;
            for (k, normal) in normal.iter_mut().enumerate() {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                *normal += point.weight * (a[i] * b[j] - a[j] * b[i]);
            }
        }
        let length = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
        (centre.map(|x| x / weights), normal.map(|n| n / length))
    }
}

/// How far a point is beyond the edges of a face, in s and t; negative within.
pub(super) fn beyond(face: &Face, [s, t]: [f64; 2]) -> f64 {
    match face.corners {
        3 => (-s).max(-t).max(s + t - 1.0),
        _ => s.abs().max(t.abs()) - 1.0,
    }
}
