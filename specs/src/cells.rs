//! What kernels of cells share: the map from the reference cell, the loop over cells, storage of symmetric
//! matrices.

use std::marker::PhantomData;

use crate::Lane;
pub use crate::condensation::*;
use crate::registers::{Register, Registers, Task};

/// The Jacobian J = Σ x_a ⊗ ∇N_a of the map from the reference cell, by its cofactors: J⁻ᵀ = cof J / det J.
#[derive(Debug, Clone, Copy)]
pub struct Jacobian<L> {
    /// `cofactors[k][i]` belongs to Jᵢₖ = ∂x_i/∂ξ_k.
    pub cofactors: [[L; 3]; 3],
    /// det J.
    pub det: L,
}

/// Σ x_a row_a for every row of coefficients.
#[inline(always)]
pub fn tangents<L: Lane, const N: usize, const ROWS: usize>(
    x: &[[L; 3]; N],
    rows: &[[f64; N]; ROWS],
) -> [[L; 3]; ROWS] {
    let mut tangents = [[L::splat(0.0); 3]; ROWS];
    for (tangent, row) in tangents.iter_mut().zip(rows).take(looped(ROWS)) {
        let mut sum = [L::splat(0.0); 3];
        for a in 0..N {
            let factor = L::splat(row[a]);
            for i in 0..3 {
                sum[i] = x[a][i].mul_add(factor, sum[i]);
            }
        }
        *tangent = sum;
    }
    tangents
}

/// Σ_q det_q row_q for every row.
#[inline(always)]
pub fn sums<L: Lane, const POINTS: usize, const ROWS: usize>(
    det: &[L; POINTS],
    rows: &[[f64; POINTS]; ROWS],
) -> [L; ROWS] {
    let mut sums = [L::splat(0.0); ROWS];
    for (sum, row) in sums.iter_mut().zip(rows).take(looped(ROWS)) {
        for q in 0..POINTS {
            *sum = det[q].mul_add(L::splat(row[q]), *sum);
        }
    }
    sums
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

/// The gradient in space of a function with the reference gradient `slope`.
#[inline(always)]
pub fn gradient<L: Lane>(map: &[[L; 3]; 3], slope: &[f64; 3]) -> [L; 3] {
    let (xi, eta, zeta) = (L::splat(slope[0]), L::splat(slope[1]), L::splat(slope[2]));
    let mut gradient = [L::splat(0.0); 3];
    for i in 0..3 {
        let sum = map[1][i].mul_add(eta, map[0][i] * xi);
        gradient[i] = map[2][i].mul_add(zeta, sum);
    }
    gradient
}

/// The trip count of a loop that is to stay one: its code is smaller and, with as many values in registers
/// as there are, faster than what a compiler makes of it when it knows the count.
#[inline(always)]
pub fn looped(count: usize) -> usize {
    std::hint::black_box(count).min(count)
}

/// The smaller of two values.
#[inline(always)]
pub fn least<L: Lane>(a: L, b: L) -> L {
    L::select(L::lt(b, a), b, a)
}

/// The matrix of a form on one lane of cells with NODES nodes: MATERIAL properties, LEN stored values.
pub trait CellLanes<const NODES: usize, const MATERIAL: usize, const LEN: usize> {
    /// Room for values between the steps, so that it is not cleared for every lane.
    type Room<L: Lane>;

    /// The room, whose contents do not matter.
    fn room<L: Lane>() -> Self::Room<L>;

    /// Fills the matrix and gives the smallest det J. To be `#[inline(always)]`.
    fn cell<L: Lane>(
        x: &[[L; 3]; NODES],
        material: [L; MATERIAL],
        room: &mut Self::Room<L>,
        matrix: &mut [L; LEN],
    ) -> L;
}

/// Values of all basis functions at all points, and a matrix before condensation.
#[derive(Debug, Clone)]
pub struct Room<
    L,
    const FUNCTIONS: usize,
    const POINTS: usize,
    const PARTS: usize,
    const WHOLE: usize,
> {
    /// `basis[function][point]`.
    pub basis: [[[L; PARTS]; POINTS]; FUNCTIONS],
    /// The matrix before condensation.
    pub whole: [L; WHOLE],
}

impl<L: Lane, const F: usize, const P: usize, const PARTS: usize, const W: usize>
    Room<L, F, P, PARTS, W>
{
    /// Zeros.
    #[inline(always)]
    pub fn new() -> Self {
        let zero = L::splat(0.0);
        Room { basis: [[[zero; PARTS]; P]; F], whole: [zero; W] }
    }
}

impl<L: Lane, const F: usize, const P: usize, const PARTS: usize, const W: usize> Default
    for Room<L, F, P, PARTS, W>
{
    fn default() -> Self {
        Room::new()
    }
}

/// Evaluates a kernel for all cells, several side by side where the processor can. Arguments as of
/// [`crate::CellKernel`].
pub fn each_cell<K: CellLanes<N, M, LEN>, const N: usize, const M: usize, const LEN: usize>(
    coordinates: &[f64],
    material: &[f64],
    matrices: &mut [f64],
    jacobians: &mut [f64],
) {
    let mut properties = [0.0; M];
    properties.copy_from_slice(&material[..M]);
    let kernel = PhantomData::<K>;
    Registers::current().run(EachCell { coordinates, properties, matrices, jacobians, kernel });
}

struct EachCell<'a, K, const N: usize, const M: usize, const LEN: usize> {
    coordinates: &'a [f64],
    properties: [f64; M],
    matrices: &'a mut [f64],
    jacobians: &'a mut [f64],
    kernel: PhantomData<K>,
}

impl<K: CellLanes<N, M, LEN>, const N: usize, const M: usize, const LEN: usize> Task
    for EachCell<'_, K, N, M, LEN>
{
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let mut x = [[L::splat(0.0); 3]; N];
        let mut matrix = [L::splat(0.0); LEN];
        let mut room = K::room::<L>();
        let mut material = [L::splat(0.0); M];
        for (lane, property) in material.iter_mut().zip(self.properties) {
            *lane = L::splat(property);
        }
        let cells = self.coordinates.chunks(3 * N * L::WIDTH);
        let matrices = self.matrices.chunks_mut(LEN * L::WIDTH);
        let jacobians = self.jacobians.chunks_mut(L::WIDTH);
        for ((cells, matrices), jacobians) in cells.zip(matrices).zip(jacobians) {
            // Lanes without a cell repeat the last one.
            L::gather(cells, x.as_flattened_mut());
            let det = K::cell(&x, material, &mut room, &mut matrix);
            L::scatter(&matrix, matrices);
            L::scatter(&[det], jacobians);
        }
    }
}

/// Place of entry (row, row) in the upper triangle by rows of a symmetric matrix with `size` rows.
#[inline(always)]
pub(crate) const fn diagonal(size: usize, row: usize) -> usize {
    row * (2 * size + 1 - row) / 2
}

/// Stores the 3 × 3 block of basis functions a < b in the upper triangle by rows of a symmetric matrix
/// with `size` rows.
#[inline(always)]
pub fn store_block<L: Lane>(matrix: &mut [L], size: usize, a: usize, b: usize, block: [[L; 3]; 3]) {
    for (i, entries) in block.iter().enumerate() {
        let row = 3 * a + i;
        let start = diagonal(size, row) + 3 * b - row;
        matrix[start..start + 3].copy_from_slice(entries);
    }
}

/// Stores the upper triangle of the 3 × 3 block of basis function a on the diagonal.
#[inline(always)]
pub fn store_diagonal<L: Lane>(matrix: &mut [L], size: usize, a: usize, block: [[L; 3]; 3]) {
    for (i, entries) in block.iter().enumerate() {
        let start = diagonal(size, 3 * a + i);
        matrix[start..start + 3 - i].copy_from_slice(&entries[i..]);
    }
}

/// Stores the 3 × 3 block of basis functions a, b in a matrix by rows with `size` rows.
#[inline(always)]
pub fn store_full<L: Lane>(matrix: &mut [L], size: usize, a: usize, b: usize, block: [[L; 3]; 3]) {
    for (i, entries) in block.iter().enumerate() {
        let start = (3 * a + i) * size + 3 * b;
        matrix[start..start + 3].copy_from_slice(entries);
    }
}

/// Stores the entry of nodes a ≤ b in the upper triangle by rows of a symmetric matrix with `size` rows.
#[inline(always)]
pub fn store_entry<L: Lane>(matrix: &mut [L], size: usize, a: usize, b: usize, entry: L) {
    matrix[diagonal(size, a) + b - a] = entry;
}

#[cfg(test)]
mod tests {
    use std::array::from_fn;

    use super::*;

    #[test]
    fn blocks_land_in_the_upper_triangle() {
        let mut matrix = [0.0; 21];
        let block = |start: f64| from_fn(|i| from_fn(|j| start + (3 * i + j) as f64));
        store_diagonal(&mut matrix, 6, 0, block(0.0));
        store_block(&mut matrix, 6, 0, 1, block(10.0));
        store_diagonal(&mut matrix, 6, 1, block(20.0));
        let rows = [
            &[0.0, 1.0, 2.0, 10.0, 11.0, 12.0][..],
            &[4.0, 5.0, 13.0, 14.0, 15.0],
            &[8.0, 16.0, 17.0, 18.0],
            &[20.0, 21.0, 22.0],
            &[24.0, 25.0],
            &[28.0],
        ];
        assert_eq!(matrix.to_vec(), rows.concat());
    }

    #[test]
    fn the_jacobian_of_a_box() {
        let corners: [[f64; 3]; 4] =
            [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]];
        let slopes = [[-1.0, 1.0, 0.0, 0.0], [-1.0, 0.0, 1.0, 0.0], [-1.0, 0.0, 0.0, 1.0]];
        let jacobian = Jacobian::new(tangents(&corners, &slopes));
        assert_eq!(jacobian.det, 24.0);
        assert_eq!(gradient(&jacobian.map(1.0 / 24.0), &[1.0, 0.0, 0.0]), [0.5, 0.0, 0.0]);
    }
}
