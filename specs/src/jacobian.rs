//! The map from the reference cell at the points of a rule, and what it makes of basis functions: what generated
//! kernels of cells call as [`crate::cells`].

use crate::Lane;
use crate::lane::shared;
use crate::matrices::Matrix;
use crate::register::Register;

/// The Jacobian J = Σ x_a ⊗ ∇N_a of the map from the reference cell, by its cofactors: J⁻ᵀ = cof J / det J.
#[derive(Debug, Clone, Copy)]
pub struct Jacobian<L> {
    /// `cofactors[k][i]` belongs to Jᵢₖ = ∂x_i/∂ξ_k.
    pub cofactors: [[L; 3]; 3],
    /// det J.
    pub det: L,
}

impl<L: Lane> Jacobian<L> {
    /// The Jacobian with the columns ∂x/∂ξ, ∂x/∂η, ∂x/∂ζ.
    #[inline(always)]
    pub fn new(columns: [[L; 3]; 3]) -> Self {
        let mut cofactors = [[L::splat(0.0); 3]; 3];
        for k in 0..3 {
            let (u, v) = (columns[(k + 1) % 3], columns[(k + 2) % 3]);
            for (i, cofactor) in cofactors[k].iter_mut().enumerate() {
                let (p, q) = ((i + 1) % 3, (i + 2) % 3);
                *cofactor = u[p].mul_add(v[q], -(u[q] * v[p]));
            }
        }
        let (first, normal) = (columns[0], cofactors[0]);
        let det = first[1].mul_add(normal[1], first[0] * normal[0]);
        Jacobian { cofactors, det: first[2].mul_add(normal[2], det) }
    }

    /// scale · cof J, which turns reference gradients into gradients in space times scale · det J.
    #[inline(always)]
    pub fn map(&self, scale: L) -> [[L; 3]; 3] {
        let mut map = self.cofactors;
        for column in &mut map {
            for entry in column {
                *entry = *entry * scale;
            }
        }
        map
    }
}

/// The smaller of two values.
#[inline(always)]
pub fn least<L: Lane>(a: L, b: L) -> L {
    L::select(L::lt(b, a), b, a)
}

/// The gradient in space of a function with the reference gradient `slope`.
#[inline(always)]
fn gradient<L: Lane>(map: &[[L; 3]; 3], slope: &[f64; 3]) -> [L; 3] {
    let (xi, eta, zeta) = (L::splat(slope[0]), L::splat(slope[1]), L::splat(slope[2]));
    let mut gradient = [L::splat(0.0); 3];
    for i in 0..3 {
        let sum = map[1][i].mul_add(eta, map[0][i] * xi);
        gradient[i] = map[2][i].mul_add(zeta, sum);
    }
    gradient
}

/// Σ x_a row_a for some rows of coefficients: together they read x once.
#[inline(always)]
fn sides<L: Lane, const ROWS: usize>(x: &[[L; 3]], rows: &[f64]) -> [[L; 3]; ROWS] {
    let rows: [&[f64]; ROWS] = std::array::from_fn(|k| &rows[k * x.len()..][..x.len()]);
    let mut sums = [[L::splat(0.0); 3]; ROWS];
    for (a, x) in x.iter().enumerate() {
        for k in 0..ROWS {
            let factor = L::splat(rows[k][a]);
            for i in 0..3 {
                sums[k][i] = x[i].mul_add(factor, sums[k][i]);
            }
        }
    }
    sums
}

/// Σ x_a row_a for every row of coefficients.
#[inline(always)]
pub fn tangents<L: Lane, const N: usize>(
    x: &[[L; 3]; N],
    rows: &[[f64; N]],
    tangents: &mut [[L; 3]],
) {
    tangents_of(x, rows.as_flattened(), tangents);
}

shared! {
    /// As [`tangents`], of any number of nodes.
    fn tangents_of<'a, L: Lane>(
        x: &'a [[L; 3]],
        rows: &'a [f64],
        tangents: &'a mut [[L; 3]],
    ) {
        let nodes = x.len();
        let (threes, rest) = tangents.as_chunks_mut::<3>();
        let (of_threes, of_rest) = rows.split_at(3 * nodes * threes.len());
        for (three, rows) in threes.iter_mut().zip(of_threes.chunks_exact(3 * nodes)) {
            *three = sides(x, rows);
        }
        for (tangent, row) in rest.iter_mut().zip(of_rest.chunks_exact(nodes)) {
            [*tangent] = sides(x, row);
        }
    }
}

/// The map at the centre; `rows`: coefficients of the nodes in ∂x/∂ξ, ∂x/∂η and ∂x/∂ζ.
#[inline(always)]
pub fn centre<L: Lane, const N: usize>(x: &[[L; 3]; N], rows: &[[f64; N]; 3]) -> Jacobian<L> {
    let mut columns = [[L::splat(0.0); 3]; 3];
    tangents(x, rows, &mut columns);
    Jacobian::new(columns)
}

shared! {
    /// Maps of gradients times r = √(w det J), that is r/det J · cof J, and r, at every point with the weight w, whose
    /// three tangents are those at `columns`. Gives the smallest det J.
    pub fn maps<'a, L: Lane>(
        tangents: &'a [[L; 3]],
        columns: &'a [[usize; 3]],
        weights: &'a [f64],
        maps: &'a mut [[[L; 3]; 3]],
        roots: &'a mut [L],
    ) -> L {
        let mut smallest = L::splat(f64::INFINITY);
        let points = columns.iter().zip(weights);
        let outputs = maps.iter_mut().zip(roots);
        for ((map, root), ([xi, eta, zeta], weight)) in outputs.zip(points) {
            let columns = [tangents[*xi], tangents[*eta], tangents[*zeta]];
            let at = Jacobian::new(columns);
            smallest = least(smallest, at.det);
            *root = (at.det * *weight).sqrt();
            *map = at.map(*root / at.det);
        }
        smallest
    }
}

shared! {
    /// w det J · factor at every point with the weight w, whose three tangents are those at `columns`. Gives the smallest
    /// det J.
    pub fn determinants<'a, L: Lane>(
        tangents: &'a [[L; 3]],
        columns: &'a [[usize; 3]],
        weights: &'a [f64],
        factor: L,
        det: &'a mut [L],
    ) -> L {
        let mut smallest = L::splat(f64::INFINITY);
        let points = columns.iter().zip(weights);
        for (det, ([xi, eta, zeta], weight)) in det.iter_mut().zip(points) {
            let columns = [tangents[*xi], tangents[*eta], tangents[*zeta]];
            let at = Jacobian::new(columns);
            smallest = least(smallest, at.det);
            *det = at.det * *weight * factor;
        }
        smallest
    }
}

/// Stores Σ_q weighted_q N_bq for the first functions b, from `entry` on, and gives their number: with many of them at once a
/// sum does not wait for the one before it, and what is weighted is read once.
#[inline(always)]
fn sums<L: Register, const FUNCTIONS: usize>(
    weighted: &[L],
    of_b: &[f64],
    matrix: &mut Matrix<L>,
    entry: usize,
) -> usize {
    let points = weighted.len();
    let of_b: [&[f64]; FUNCTIONS] = std::array::from_fn(|b| &of_b[b * points..][..points]);
    let mut sums = [L::splat(0.0); FUNCTIONS];
    for (q, weighted) in weighted.iter().enumerate() {
        for b in 0..FUNCTIONS {
            sums[b] = weighted.mul_add(L::splat(of_b[b][q]), sums[b]);
        }
    }
    matrix.set(entry, &sums);
    FUNCTIONS
}

shared! {
    /// Σ_q det_q N_a N_b for all nodes a ≤ b, row by row. values: nodes × points. `weighted` holds as many values as there
    /// are points, in between.
    pub fn products<'a, L: Register>(
        det: &'a [L],
        values: &'a [f64],
        weighted: &'a mut [L],
        matrix: Matrix<'a, L>,
    ) {
        let mut matrix = matrix;
        let points = det.len();
        let mut entry = 0;
        for start in (0..values.len()).step_by(points) {
            let (of_a, values) = (&values[start..][..points], &values[start..]);
            for ((weighted, det), value) in weighted.iter_mut().zip(det).zip(of_a) {
                *weighted = *det * *value;
            }
            let mut left = values.len() / points;
            while left > 0 {
                let of_b = &values[values.len() - left * points..];
                let done = match left {
                    8.. => sums::<L, 8>(weighted, of_b, &mut matrix, entry),
                    4.. => sums::<L, 4>(weighted, of_b, &mut matrix, entry),
                    2.. => sums::<L, 2>(weighted, of_b, &mut matrix, entry),
                    _ => sums::<L, 1>(weighted, of_b, &mut matrix, entry),
                };
                entry += done;
                left -= done;
            }
        }
    }
}

shared! {
    /// Gradients in space of functions at points. maps: of the points. slopes: points × functions, in the reference cell.
    /// basis: functions × points.
    pub fn gradients<'a, L: Lane>(
        maps: &'a [[[L; 3]; 3]],
        slopes: &'a [[f64; 3]],
        basis: &'a mut [[L; 3]],
    ) {
        let points = maps.len();
        let functions = basis.len() / points;
        for (q, map) in maps.iter().enumerate() {
            // In registers: what is written might be a map for all that a compiler knows.
            let map = *map;
            let slopes = &slopes[q * functions..][..functions];
            for (function, slope) in basis.chunks_exact_mut(points).zip(slopes) {
                function[q] = gradient(&map, slope);
            }
        }
    }
}

shared! {
    /// Values and gradients in space of functions at points: as [`gradients`]. values: points × functions; roots: their
    /// factors at the points.
    pub fn values_and_gradients<'a, L: Lane>(
        maps: &'a [[[L; 3]; 3]],
        slopes: &'a [[f64; 3]],
        roots: &'a [L],
        values: &'a [f64],
        basis: &'a mut [[L; 4]],
    ) {
        let points = maps.len();
        let functions = basis.len() / points;
        for (q, (map, root)) in maps.iter().zip(roots).enumerate() {
            let (map, root) = (*map, *root);
            let slopes = &slopes[q * functions..][..functions];
            let values = &values[q * functions..][..functions];
            let basis = basis.chunks_exact_mut(points);
            for ((function, slope), value) in basis.zip(slopes).zip(values) {
                let [x, y, z] = gradient(&map, slope);
                function[q] = [root * *value, x, y, z];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrices::{Batch, CellMatrix};

    #[test]
    fn the_jacobian_of_a_box() {
        let corners: [[f64; 3]; 4] =
            [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]];
        let slopes = [[-1.0, 1.0, 0.0, 0.0], [-1.0, 0.0, 1.0, 0.0], [-1.0, 0.0, 0.0, 1.0]];
        let jacobian = centre(&corners, &slopes);
        assert_eq!(jacobian.det, 24.0);
        let map = jacobian.map(1.0 / 24.0);
        // Two functions at two points with the same map.
        let slopes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0]];
        let mut basis = [[0.0; 3]; 4];
        gradients(&[map, map], &slopes, &mut basis);
        let (half, third, quarter) = (0.5, 1.0 / 3.0, 0.25);
        let expected =
            [[half, 0.0, 0.0], [0.0, 0.0, quarter], [0.0, third, 0.0], [half, third, quarter]];
        assert_eq!(basis, expected);
        let mut both = [[0.0; 4]; 4];
        let (roots, values) = ([2.0, 3.0], [1.0, 10.0, 100.0, 1000.0]);
        values_and_gradients(&[map, map], &slopes, &roots, &values, &mut both);
        assert_eq!(both.map(|[_, x, y, z]| [x, y, z]), expected);
        assert_eq!(both.map(|[value, ..]| value), [2.0, 300.0, 20.0, 3000.0]);
    }

    #[test]
    fn determinants_maps_and_products() {
        let tangents = [[2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0], [0.0, 0.0, 0.5]];
        let mut det = [0.0; 2];
        let columns = [[0, 1, 2], [0, 1, 3]];
        let least = determinants(&tangents, &columns, &[1.0, 2.0], 10.0, &mut det);
        assert_eq!((least, det), (3.0, [240.0, 60.0]));
        // Two functions at the two points.
        let (mut weighted, mut memory) = ([0.0; 2], Batch::storage(1, 3));
        products(&det, &[1.0, 0.5, -1.0, 2.0], &mut weighted, Matrix::new(&mut memory, 0));
        let matrix: Vec<f64> = CellMatrix::new(&memory, 3, 0).values().collect();
        assert_eq!(matrix, [240.0 + 15.0, -240.0 + 60.0, 240.0 + 240.0]);
        let (mut to, mut roots) = ([[[0.0; 3]; 3]; 2], [0.0; 2]);
        let least = maps(&tangents, &columns, &[6.0, 3.0], &mut to, &mut roots);
        assert_eq!((least, roots), (3.0, [12.0, 3.0]));
        // r/det J · cof J = r · J⁻ᵀ.
        assert_eq!(to[0], [[6.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, 0.0, 3.0]]);
        assert_eq!(to[1], [[1.5, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 6.0]]);
    }
}
