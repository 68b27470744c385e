//! Equations of points that move as one rigid body, and of a point that follows the mean motion of others.

use super::ties::{FileDof, FileRow};
use crate::linalg::{LinearAlgebraError, Matrix, symmetric_eigen};

/// Motions of a set of points that move none of them by more than this part are no motions of theirs.
const STILL: f64 = 1e-9;

/// A point of a file: what its dofs are, and where it is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TiePoint {
    /// Displacements along x, y, z and turns about them.
    pub(crate) dofs: [FileDof; 6],
    pub(crate) at: [f64; 3],
}

/// A direction in which a point moves, or about which it turns.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Direction {
    pub(crate) along: [f64; 3],
    pub(crate) turn: bool,
}

impl Direction {
    /// All six along x, y, z.
    pub(crate) fn all() -> [Direction; 6] {
        std::array::from_fn(|k| {
            Direction::of([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], k)
        })
    }

    /// A component, from 0 to 5, along these axes.
    pub(crate) fn of(axes: [[f64; 3]; 3], component: usize) -> Direction {
        Direction { along: axes[component % 3], turn: component >= 3 }
    }
}

impl TiePoint {
    /// The motion of the point in a direction.
    pub(crate) fn motion(&self, direction: &Direction) -> FileRow {
        let first = if direction.turn { 3 } else { 0 };
        let terms = (0..3).map(|k| (self.dofs[first + k], direction.along[k]));
        terms.filter(|(_, c)| *c != 0.0).collect()
    }

    /// How it moves in a direction when all moves rigidly by the six motions of another point.
    fn carried(&self, by: [f64; 3], direction: &Direction) -> [f64; 6] {
        let d = direction.along;
        if direction.turn {
            return [0.0, 0.0, 0.0, d[0], d[1], d[2]];
        }
        // d · (θ × r) = θ · (r × d).
        let r: [f64; 3] = std::array::from_fn(|k| self.at[k] - by[k]);
        let arm: [f64; 3] = std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            r[i] * d[j] - r[j] * d[i]
        });
        [d[0], d[1], d[2], arm[0], arm[1], arm[2]]
    }

    /// In a direction it moves as the rigid body that another point stands for.
    pub(crate) fn follows(&self, body: &TiePoint, direction: &Direction) -> FileRow {
        let mut row = self.motion(direction);
        let carried = self.carried(body.at, direction);
        let terms = body.dofs.iter().zip(carried).filter(|(_, c)| *c != 0.0);
        row.extend(terms.map(|(&dof, c)| (dof, -c)));
        row
    }
}

/// A point moves in these `components` as the rigid motion that fits the weighted motions of others best, in the sense of
/// least squares. A component that they do not show is left alone.
pub(crate) fn follows_mean(
    point: &TiePoint,
    components: &[Direction],
    others: &[(TiePoint, Vec<Direction>, f64)],
) -> Result<Vec<FileRow>, LinearAlgebraError> {
    let length = |own: &TiePoint| -> f64 {
        (0..3).map(|k| (own.at[k] - point.at[k]).powi(2)).sum::<f64>().sqrt()
    };
    let size = others.iter().map(|(own, ..)| length(own)).fold(0.0, f64::max);
    let size = if size > 0.0 { size } else { 1.0 };
    // Turns times the size, so that all have one unit.
    let scaled = |own: [f64; 6]| -> [f64; 6] {
        std::array::from_fn(|k| if k < 3 { own[k] } else { own[k] / size })
    };
    let shown: Vec<(FileRow, [f64; 6], f64)> = others
        .iter()
        .flat_map(|(own, directions, weight)| {
            directions.iter().map(move |direction| {
                (own.motion(direction), scaled(own.carried(point.at, direction)), *weight)
            })
        })
        .collect();
    let gram = Matrix::from_fn(6, 6, |i, j| {
        shown.iter().map(|(_, own, weight)| weight * own[i] * own[j]).sum()
    });
    let eigen = symmetric_eigen(&gram.symmetric_part())?;
    let most = eigen.values.iter().fold(0.0, |most: f64, &value| most.max(value));
    let seen: Vec<usize> = (0..6).filter(|&k| eigen.values[k] > STILL * most).collect();
    let mut rows = Vec::new();
    for direction in components {
        let wanted = scaled(point.carried(point.at, direction));
        let along: Vec<f64> =
            (0..6).map(|k| (0..6).map(|i| eigen.vectors[(i, k)] * wanted[i]).sum()).collect();
        let square = |places: &mut dyn Iterator<Item = usize>| -> f64 {
            places.map(|k| along[k].powi(2)).sum()
        };
        let unseen = square(&mut (0..6).filter(|k| !seen.contains(k)));
        if unseen > STILL * square(&mut (0..6)) {
            continue;
        }
        let mut row = point.motion(direction);
        for (motion, own, weight) in &shown {
            let share: f64 = seen
                .iter()
                .map(|&k| {
                    let by: f64 = (0..6).map(|i| eigen.vectors[(i, k)] * own[i]).sum();
                    along[k] * by / eigen.values[k]
                })
                .sum();
            row.extend(motion.iter().map(|&(dof, c)| (dof, -share * weight * c)));
        }
        rows.push(row);
    }
    Ok(rows)
}
