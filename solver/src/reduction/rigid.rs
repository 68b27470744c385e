//! Rigid motions of a body, and those that nothing stops.

use super::solid::{Solid, lower};
use crate::error::{FreeMotion, ReductionError};
use crate::sparse::Row;

use crate::linalg::{
    LinearAlgebraError, LowerTriangle, Matrix, multiply, symmetric_eigen, transpose_multiply,
};
use crate::mesh::connected;
use crate::mesh::matrices::Slot;

/// Coordinates of the nodes (m), and what their dofs are; all are translations where this is empty.
pub(crate) type Places<'a> = (&'a [[f64; 3]], &'a [Slot]);

/// A held motion moves the retained dofs by at least this part of the body's own motion, and a sprung
/// one costs at least this part of the stiffness of a single dof; rounding leaves far less.
const NEGLIGIBLE: f64 = 1e-10;

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
    /// Of nodes at these coordinates, whose dofs are these `slots`; all are translations where there are none.
    pub(crate) fn new((coordinates, slots): Places) -> Self {
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
        for (dof, slot) in slots.iter().enumerate() {
            if !matches!(slot, Slot::Translation(_)) {
                (0..6).for_each(|j| shapes[(dof, j)] = 0.0);
            }
            if let Slot::Turn(i) = slot {
                shapes[(dof, 3 + i)] = 1.0 / size;
            }
        }
        RigidMotions { middle, size, shapes }
    }

    /// Of the nodes listed; the others stay where they are.
    fn of_part(coordinates: &[[f64; 3]], nodes: &[usize]) -> Self {
        let own: Vec<[f64; 3]> = nodes.iter().map(|&node| coordinates[node]).collect();
        let part = RigidMotions::new((&own, &[]));
        let mut shapes = Matrix::zeros(3 * coordinates.len(), 6);
        for (place, &node) in nodes.iter().enumerate() {
            for i in 0..3 {
                (0..6).for_each(|j| shapes[(3 * node + i, j)] = part.shapes[(3 * place + i, j)]);
            }
        }
        RigidMotions { shapes, ..part }
    }

    /// The motions that make every one of `rows` zero and strain nothing.
    fn free(
        &self,
        stiffness: &LowerTriangle,
        rows: &[Row],
    ) -> Result<Vec<FreeMotion>, LinearAlgebraError> {
        let free = self.combinations(stiffness, rows)?;
        Ok((0..free.cols).map(|j| self.describe(free.col(j))).collect())
    }

    /// The same as combinations of the six: 6 × as many.
    fn combinations(
        &self,
        stiffness: &LowerTriangle,
        rows: &[Row],
    ) -> Result<Matrix, LinearAlgebraError> {
        let rows = Matrix::from_fn(rows.len(), 6, |i, j| {
            rows[i].iter().map(|&(dof, c)| c * self.shapes[(dof, j)]).sum()
        });
        let moving = self.moving()?;
        let rows = multiply(rows.view(), moving.view());
        let held = small(&transpose_multiply(rows.view(), rows.view()), NEGLIGIBLE)?;
        let loose = multiply(moving.view(), held.view());
        let moves = multiply(self.shapes.view(), loose.view());
        let mut forces = Matrix::zeros(moves.rows, moves.cols);
        stiffness.multiply(&moves.data, &mut forces.data);
        // Coordinates without a place, such as those of modes, have another measure.
        let placed = |dof: usize| (0..6).any(|j| self.shapes[(dof, j)] != 0.0);
        let diagonal = stiffness.diagonal().into_iter().enumerate();
        let stiffest =
            diagonal.filter(|(dof, _)| placed(*dof)).fold(0.0, |most: f64, (_, own)| most.max(own));
        let energy = transpose_multiply(moves.view(), forces.view());
        Ok(multiply(loose.view(), small(&energy, NEGLIGIBLE * stiffest)?.view()))
    }

    /// The motions that move anything, as columns: all six but for nodes on a line, or one alone.
    fn moving(&self) -> Result<Matrix, LinearAlgebraError> {
        let mut gram = transpose_multiply(self.shapes.view(), self.shapes.view());
        let largest = (0..6).map(|j| gram[(j, j)]).fold(0.0, f64::max);
        let still = small(&gram, NEGLIGIBLE * largest)?;
        if still.cols == 0 {
            return Ok(Matrix::identity(6));
        }
        gram.data.iter_mut().for_each(|value| *value = -*value);
        small(&gram, -NEGLIGIBLE * largest)
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

/// The rigid motions of a body that make every one of `rows` (whose coefficients are of order 1) zero and strain nothing. Of a mesh in several
/// parts each is checked alone, too: one that nothing holds is reported as a part, but for the largest.
pub(crate) fn free_motions(
    (coordinates, slots): Places,
    stiffness: &LowerTriangle,
    rows: &[Row],
) -> Result<Vec<FreeMotion>, LinearAlgebraError> {
    // Dofs without a place, such as modes, are parts of their own only in the stiffness.
    let parts = if slots.is_empty() { parts(coordinates.len(), stiffness) } else { Vec::new() };
    let count = parts.len();
    if count < 2 {
        return RigidMotions::new((coordinates, slots)).free(stiffness, rows);
    }
    // The first of the largest.
    let largest = (0..count).rev().max_by_key(|&part| parts[part].len()).unwrap_or(0);
    let mut free = Vec::new();
    for (part, nodes) in parts.iter().enumerate() {
        let own = RigidMotions::of_part(coordinates, nodes).free(stiffness, rows)?;
        match own.is_empty() {
            true => {}
            false if part == largest => free.extend(own),
            false => free.push(FreeMotion::Part { node: nodes[0] as u64 }),
        }
        if free.len() > MOST_PARTS {
            break;
        }
    }
    if free.is_empty() {
        // Parts that equations hold together may move as one.
        return RigidMotions::new((coordinates, slots)).free(stiffness, rows);
    }
    Ok(free)
}

/// The rigid motions of a body as a whole that make every one of `rows` zero and strain nothing: 3·nodes × as many, linearly
/// independent.
///
/// # Errors
/// A stiffness that is not symmetric by its structure, or with values that are not finite.
pub(crate) fn free_shapes(solid: &Solid, rows: &[Row]) -> Result<Matrix, ReductionError> {
    let whole = lower(solid.stiffness, "stiffness")?;
    // What equations resist costs energy on what they leave free.
    let stiffness = match solid.tied(&[]) {
        Some(tied) => std::borrow::Cow::Owned(tied.matrix(&whole, solid.memory)?),
        None => whole,
    };
    let motions = RigidMotions::new((solid.coordinates, solid.slots));
    let free = motions.combinations(&stiffness, rows)?;
    Ok(multiply(motions.shapes.view(), free.view()))
}

/// The rigid motions of every part of a body by itself that make every one of `rows` zero and strain nothing: for each part
/// 3·nodes × as many.
pub(super) fn free_shapes_of_parts(
    (coordinates, slots): Places,
    stiffness: &LowerTriangle,
    rows: &[Row],
) -> Result<Vec<Matrix>, LinearAlgebraError> {
    let shapes = |motions: RigidMotions| -> Result<Matrix, LinearAlgebraError> {
        let free = motions.combinations(stiffness, rows)?;
        Ok(multiply(motions.shapes.view(), free.view()))
    };
    if !slots.is_empty() {
        return Ok(vec![shapes(RigidMotions::new((coordinates, slots)))?]);
    }
    parts(coordinates.len(), stiffness)
        .iter()
        .map(|nodes| shapes(RigidMotions::of_part(coordinates, nodes)))
        .collect()
}

/// For each of these motions of the parts a dof of those listed, by its place there: the one that it moves most when the
/// dofs before stand still. Ascending.
pub(super) fn pins(motions: Vec<Matrix>, dofs: &[usize]) -> Vec<usize> {
    let mut pins = Vec::new();
    for mut motions in motions {
        for _ in 0..motions.cols {
            let square =
                |dof: usize| -> f64 { (0..motions.cols).map(|j| motions[(dof, j)].powi(2)).sum() };
            let places = (0..dofs.len()).map(|place| (place, square(dofs[place])));
            let larger =
                |a: &(usize, f64), b: &(usize, f64)| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0));
            let Some((place, most)) = places.max_by(larger).filter(|(_, most)| *most > 0.0) else {
                break;
            };
            pins.push(place);
            // What is left of the motions does not move it.
            let own: Vec<f64> = (0..motions.cols).map(|j| motions[(dofs[place], j)]).collect();
            for i in 0..motions.rows {
                let along: f64 = (0..motions.cols).map(|j| motions[(i, j)] * own[j]).sum();
                (0..motions.cols).for_each(|j| motions[(i, j)] -= along / most * own[j]);
            }
        }
    }
    pins.sort_unstable();
    pins
}

/// The nodes of each part of a body.
fn parts(nodes: usize, stiffness: &LowerTriangle) -> Vec<Vec<usize>> {
    // The dofs of a node stand together.
    let mut last = None;
    let pairs = (0..stiffness.size)
        .flat_map(|dof| stiffness.column(dof).map(move |(other, _)| (dof / 3, other / 3)))
        .filter(|pair| last.replace(*pair) != Some(*pair));
    let part_of = connected(nodes, pairs);
    let count = part_of.iter().max().map_or(0, |last| last + 1);
    let mut parts: Vec<Vec<usize>> = vec![Vec::new(); count];
    part_of.iter().enumerate().for_each(|(node, &part)| parts[part].push(node));
    parts
}

/// Loose parts that are reported.
const MOST_PARTS: usize = 8;

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
        let motions = |stiffness: &LowerTriangle, held: &[usize]| {
            let rows: Vec<Row> = held.iter().map(|&dof| vec![(dof, 1.0)]).collect();
            RigidMotions::new((&coordinates, &[])).free(stiffness, &rows)
        };
        let nothing = LowerTriangle::from_columns(12, |j| std::iter::once((j, 0.0)));
        let held = [0, 1, 2, 3, 4, 5];
        let free = motions(&nothing, &held).unwrap();
        let [FreeMotion::Rotation { direction, through }] = free[..] else {
            panic!("{free:?}");
        };
        assert!((direction[2] - 1.0).abs() < 1e-12);
        assert!(through[0].abs() < 1e-12 && through[1].abs() < 1e-12, "{through:?}");
        assert!(free[0].to_string().starts_with("turn about an axis along z"));
        // A lateral spring on the third node stops the turn.
        let spring = |j| std::iter::once((j, if j == 7 { 1e3 } else { 0.0 }));
        let spring = LowerTriangle::from_columns(12, spring);
        assert_eq!(motions(&spring, &held).unwrap(), []);
        let free = motions(&nothing, &[0, 1, 3, 4, 7]).unwrap();
        assert_eq!(free.len(), 1);
        assert_eq!(free[0].to_string(), "shift along z");
        assert_eq!(motions(&nothing, &[]).unwrap().len(), 6);
    }

    /// Two triangles without stiffness; the first is held, and what the other one does depends on whether it is
    /// held as well.
    #[test]
    fn a_part_that_nothing_holds_is_reported() {
        let triangle = |x: f64| [[x, 0.0, 0.0], [x, 1.0, 0.0], [x + 1.0, 0.0, 0.0]];
        let coordinates = [triangle(0.0), triangle(5.0)].concat();
        let joined = LowerTriangle::from_columns(18, |dof| {
            let other = (dof / 3 % 3 < 2).then_some((dof + 3, 0.0));
            std::iter::once((dof, 0.0)).chain(other)
        });
        let free = |held: &[usize]| {
            let rows: Vec<Row> = held.iter().map(|&dof| vec![(dof, 1.0)]).collect();
            free_motions((&coordinates, &[]), &joined, &rows).unwrap()
        };
        let first = [0, 1, 2, 3, 5, 8];
        assert_eq!(free(&first), [FreeMotion::Part { node: 3 }]);
        let both: Vec<usize> = first.iter().copied().chain(first.map(|dof| dof + 9)).collect();
        assert_eq!(free(&both), []);
        let turning = free(&first[..5]);
        assert!(matches!(turning[..], [FreeMotion::Rotation { .. }, FreeMotion::Part { node: 3 }]));
        // A node alone has no turns, and is held by three dofs.
        let alone = LowerTriangle::from_columns(3, |dof| std::iter::once((dof, 0.0)));
        let held: Vec<Row> = (0..3).map(|dof| vec![(dof, 1.0)]).collect();
        assert_eq!(free_motions((&[[1.0, 2.0, 3.0]], &[]), &alone, &held).unwrap(), []);
    }
}
