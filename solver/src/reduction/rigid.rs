//! Rigid motions of a body, and those that nothing stops.

use std::fmt;

use crate::linalg::{
    LinearAlgebraError, LowerTriangle, Matrix, multiply, symmetric_eigen, transpose_multiply,
};

/// A held motion moves the retained dofs by at least this part of the body's own motion, and a sprung
/// one costs at least this part of the stiffness of a single dof; rounding leaves far less.
const NEGLIGIBLE: f64 = 1e-10;

/// A motion that strains nothing.
#[derive(Debug, Clone, PartialEq)]
pub enum FreeMotion {
    /// The body shifts.
    Translation {
        /// Unit vector.
        direction: [f64; 3],
    },
    /// The body turns, perhaps sliding along the axis as well.
    Rotation {
        /// Unit vector along the axis.
        direction: [f64; 3],
        /// The point of the axis nearest to the middle of the body (m).
        through: [f64; 3],
    },
    /// Part of the mesh is loose: it is not joined to the rest.
    Part {
        /// A node of it: its label in a mesh, its index where there are matrices only.
        node: u64,
    },
}

impl fmt::Display for FreeMotion {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            FreeMotion::Translation { direction } => write!(f, "shift along {}", axis(direction)),
            FreeMotion::Rotation { direction, through: [x, y, z] } => {
                let direction = axis(direction);
                // Without the sign of what rounds to zero.
                let [x, y, z] = [x, y, z].map(|value| (1e4 * value).round() / 1e4 + 0.0);
                write!(f, "turn about an axis along {direction} through ({x:.4}, {y:.4}, {z:.4}) m")
            }
            FreeMotion::Part { node } => {
                write!(f, "the part of the mesh around node {node} is loose")
            }
        }
    }
}

fn axis(direction: &[f64; 3]) -> String {
    for (component, name) in direction.iter().zip(["x", "y", "z"]) {
        if component.abs() > 1.0 - 1e-6 {
            return name.to_string();
        }
    }
    let [x, y, z] = direction;
    format!("({x:.3}, {y:.3}, {z:.3})")
}

/// The rigid motions of a body: shifts along x, y, z (columns 0 to 2) and turns about the axes through
/// its middle, scaled by its size (columns 3 to 5).
#[derive(Debug, Clone)]
pub(crate) struct RigidMotions {
    middle: [f64; 3],
    size: f64,
    /// Motion of the dofs, 3·nodes × 6.
    shapes: Matrix,
}

impl RigidMotions {
    pub(crate) fn new(coordinates: &[[f64; 3]]) -> Self {
        let count = coordinates.len().max(1) as f64;
        let mut middle = [0.0; 3];
        for point in coordinates {
            for (sum, value) in middle.iter_mut().zip(point) {
                *sum += value / count;
            }
        }
        let offsets: Vec<[f64; 3]> =
            coordinates.iter().map(|point| std::array::from_fn(|i| point[i] - middle[i])).collect();
        let size = offsets.iter().flatten().fold(0.0, |size: f64, value| size.max(value.abs()));
        let size = if size > 0.0 { size } else { 1.0 };
        let mut shapes = Matrix::zeros(3 * coordinates.len(), 6);
        for (node, offset) in offsets.iter().enumerate() {
            for i in 0..3 {
                // e_i × offset has components i+1 and i+2.
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                shapes[(3 * node + i, i)] = 1.0;
                shapes[(3 * node + j, 3 + i)] = -offset[k] / size;
                shapes[(3 * node + k, 3 + i)] = offset[j] / size;
            }
        }
        RigidMotions { middle, size, shapes }
    }

    /// The rigid motions that leave the `held` dofs where they are and strain nothing.
    pub(super) fn free(
        &self,
        stiffness: &LowerTriangle,
        held: &[usize],
    ) -> Result<Vec<FreeMotion>, LinearAlgebraError> {
        let all: Vec<usize> = (0..6).collect();
        self.free_under(stiffness, &self.shapes.select(held, &all))
    }

    /// The motion of the dofs, 3·nodes × 6.
    pub(crate) fn shapes(&self) -> &Matrix {
        &self.shapes
    }

    /// The rigid motions that make every one of `rows` zero (each a linear function of the six motions,
    /// of order 1) and strain nothing.
    pub(crate) fn free_under(
        &self,
        stiffness: &LowerTriangle,
        rows: &Matrix,
    ) -> Result<Vec<FreeMotion>, LinearAlgebraError> {
        let loose = small(&transpose_multiply(rows.view(), rows.view()), NEGLIGIBLE)?;
        let moves = multiply(self.shapes.view(), loose.view());
        let mut forces = Matrix::zeros(moves.rows, moves.cols);
        stiffness.multiply(&moves.data, &mut forces.data);
        let stiffest = stiffness.diagonal().into_iter().fold(0.0, f64::max);
        let energy = transpose_multiply(moves.view(), forces.view());
        let free = multiply(loose.view(), small(&energy, NEGLIGIBLE * stiffest)?.view());
        Ok((0..free.cols).map(|j| self.describe(free.col(j))).collect())
    }

    fn describe(&self, motion: &[f64]) -> FreeMotion {
        let shift = [motion[0], motion[1], motion[2]];
        let turn = [motion[3], motion[4], motion[5]].map(|value| value / self.size);
        let square = |v: &[f64; 3]| v.iter().map(|x| x * x).sum::<f64>();
        let unit = |v: [f64; 3]| {
            let first = v.iter().find(|x| x.abs() > 1e-6 * square(&v).sqrt());
            let sign = first.map_or(1.0, |x| x.signum());
            v.map(|x| sign * x / square(&v).sqrt())
        };
        if square(&turn).sqrt() * self.size <= 1e-6 * square(&shift).sqrt() {
            return FreeMotion::Translation { direction: unit(shift) };
        }
        // Points at rest but for sliding: middle + ω × v / ω².
        let w = square(&turn);
        let through = std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            self.middle[i] + (turn[j] * shift[k] - turn[k] * shift[j]) / w
        });
        FreeMotion::Rotation { direction: unit(turn), through }
    }
}

/// The eigenvectors, as columns, of the eigenvalues of `gram` that are at most `limit`.
fn small(gram: &Matrix, limit: f64) -> Result<Matrix, LinearAlgebraError> {
    let eigen = symmetric_eigen(&gram.symmetric_part())?;
    let count = eigen.values.iter().filter(|&&value| value <= limit).count();
    let columns = eigen.vectors.columns(0..count);
    Ok(Matrix { rows: columns.rows, cols: count, data: columns.data.to_vec() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_the_motions_that_held_dofs_leave() {
        let coordinates = [[0.0, 0.0, 0.0], [0.0, 0.0, 2.0], [0.5, 0.3, 1.0], [0.5, -0.3, 1.0]];
        let motions = RigidMotions::new(&coordinates);
        let nothing = LowerTriangle::from_columns(12, |j| std::iter::once((j, 0.0)));
        let held = [0, 1, 2, 3, 4, 5];
        let free = motions.free(&nothing, &held).unwrap();
        let [FreeMotion::Rotation { direction, through }] = free[..] else {
            panic!("{free:?}");
        };
        assert!((direction[2] - 1.0).abs() < 1e-12);
        assert!(through[0].abs() < 1e-12 && through[1].abs() < 1e-12, "{through:?}");
        assert!(free[0].to_string().starts_with("turn about an axis along z"));
        // A lateral spring on the third node stops the turn.
        let spring = |j| std::iter::once((j, if j == 7 { 1e3 } else { 0.0 }));
        let spring = LowerTriangle::from_columns(12, spring);
        assert_eq!(motions.free(&spring, &held).unwrap(), []);
        let free = motions.free(&nothing, &[0, 1, 3, 4, 7]).unwrap();
        assert_eq!(free.len(), 1);
        assert_eq!(free[0].to_string(), "shift along z");
        assert_eq!(motions.free(&nothing, &[]).unwrap().len(), 6);
    }
}
