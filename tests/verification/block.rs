//! Blocks of hexahedra with matrices integrated here, so that tests of the reduction stand on nothing else.

use std::collections::BTreeMap;

use whirl_solver::linalg::LowerTriangle;
use whirl_solver::reduction::Solid;
use whirl_solver::sparse::SparseMatrix;

const PLENTY: usize = 1 << 32;

/// A block of 8-node hexahedra, sides along x, y, z.
pub(crate) struct Block {
    pub(crate) coordinates: Vec<[f64; 3]>,
    pub(crate) stiffness: SparseMatrix,
    pub(crate) mass: SparseMatrix,
}

impl Block {
    /// `cells` cells along each axis over a block with sides `sides` (m) of steel, with K and M times
    /// `scale` and Poisson's ratio `nu`.
    pub(crate) fn new(cells: [usize; 3], sides: [f64; 3], nu: f64, scale: [f64; 2]) -> Self {
        let step: [f64; 3] = std::array::from_fn(|i| sides[i] / cells[i] as f64);
        let (k, m) = hexahedron(step, 2e11, nu, 7860.0);
        let across = [cells[0] + 1, cells[1] + 1, cells[2] + 1];
        let node = |i: usize, j: usize, k: usize| (k * across[1] + j) * across[0] + i;
        let mut coordinates = Vec::new();
        for z in 0..across[2] {
            for y in 0..across[1] {
                for x in 0..across[0] {
                    let place = [x, y, z];
                    coordinates.push(std::array::from_fn(|i| place[i] as f64 * step[i]));
                }
            }
        }
        let mut columns = vec![BTreeMap::new(); 3 * coordinates.len()];
        for z in 0..cells[2] {
            for y in 0..cells[1] {
                for x in 0..cells[0] {
                    let corners: Vec<usize> =
                        CORNERS.iter().map(|c| node(x + c[0], y + c[1], z + c[2])).collect();
                    for a in 0..24 {
                        for b in 0..24 {
                            let (row, column) =
                                (3 * corners[a / 3] + a % 3, 3 * corners[b / 3] + b % 3);
                            let entry = columns[column].entry(row).or_insert([0.0; 2]);
                            entry[0] += scale[0] * k[a][b];
                            entry[1] += scale[1] * m[a][b];
                        }
                    }
                }
            }
        }
        let matrix = |which: usize| {
            symmetric(columns.len(), |j| {
                columns[j].iter().map(move |(&row, entry): (&usize, &[f64; 2])| (row, entry[which]))
            })
        };
        Block { stiffness: matrix(0), mass: matrix(1), coordinates }
    }

    pub(crate) fn solid(&self) -> Solid<'_> {
        Solid {
            stiffness: &self.stiffness,
            mass: &self.mass,
            coordinates: &self.coordinates,
            slots: &[],
            ties: &[],
            memory: PLENTY,
        }
    }

    /// Dofs of the nodes at the end z = 0.
    pub(crate) fn end(&self) -> Vec<usize> {
        let nodes = (0..self.coordinates.len()).filter(|&a| self.coordinates[a][2] == 0.0);
        nodes.flat_map(|a| [3 * a, 3 * a + 1, 3 * a + 2]).collect()
    }
}

const CORNERS: [[usize; 3]; 8] =
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];

/// K and M of a box with 2 × 2 × 2 Gauss points.
fn hexahedron(side: [f64; 3], e: f64, nu: f64, rho: f64) -> ([[f64; 24]; 24], [[f64; 24]; 24]) {
    let sign = |a: usize, i: usize| 2.0 * CORNERS[a][i] as f64 - 1.0;
    let (lambda, mu) = (e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), e / (2.0 * (1.0 + nu)));
    let det = side.iter().product::<f64>() / 8.0;
    let (mut k, mut m) = ([[0.0; 24]; 24], [[0.0; 24]; 24]);
    for q in 0..8 {
        let factor = |a: usize, i: usize| 1.0 + sign(a, i) * sign(q, i) / 3f64.sqrt();
        let shape = |a: usize| factor(a, 0) * factor(a, 1) * factor(a, 2) / 8.0;
        let slope = |a: usize, i: usize| {
            sign(a, i) * factor(a, (i + 1) % 3) * factor(a, (i + 2) % 3) / (4.0 * side[i])
        };
        for a in 0..8 {
            for b in 0..8 {
                let dot: f64 = (0..3).map(|i| slope(a, i) * slope(b, i)).sum();
                for i in 0..3 {
                    for j in 0..3 {
                        let mut value =
                            lambda * slope(a, i) * slope(b, j) + mu * slope(a, j) * slope(b, i);
                        if i == j {
                            value += mu * dot;
                            m[3 * a + i][3 * b + j] += rho * shape(a) * shape(b) * det;
                        }
                        k[3 * a + i][3 * b + j] += value * det;
                    }
                }
            }
        }
    }
    (k, m)
}

pub(crate) fn symmetric<'a, C>(size: usize, column: impl Fn(usize) -> C) -> SparseMatrix
where
    C: Iterator<Item = (usize, f64)> + 'a,
{
    SparseMatrix::Symmetric(LowerTriangle::from_columns(size, column))
}

pub(crate) fn lower(a: &SparseMatrix) -> &LowerTriangle {
    let SparseMatrix::Symmetric(lower) = a else { panic!("blocks have symmetric matrices") };
    lower
}
