//! Block Lanczos iteration with thick restarts and full reorthogonalisation, for the largest
//! eigenvalues θ of A⁻¹M x = θ x, in the inner product of M.
//!
//! With A = K + sM these are the lowest ω² = 1/θ − s of K x = ω² M x. Source: Grimes, Lewis, Simon,
//! SIAM J. Matrix Anal. Appl. 15 (1994) 228–272; restarts: Wu, Simon, ibid. 22 (2000) 602–616.

use std::ops::Range;

use crate::linalg::{
    Cholesky, Columns, LinearAlgebraError, Matrix, dot, multiply, multiply_add_beside,
    multiply_in_place_beside, symmetric_eigen, transpose_multiply, transpose_multiply_beside,
};

use crate::sparse::{HalfMemory, SparseMatrix};

use super::constrained::ConstrainedCholesky;

use crate::error::ReductionError;

/// Vectors of a block. One pass over the factor serves them all, and a multiple eigenvalue shows up to
/// this many of its vectors at once.
const BLOCK: usize = 8;
/// Blocks at least between two checks of the Ritz values.
const STRIDE: usize = 4;
/// A Ritz pair has converged when its residual is below this part of θ: the eigenvalue is then right to
/// the square of this part over the relative gap, the vector to this part over the relative gap.
const RESIDUAL: f64 = 1e-10;
/// Residuals below this part of θ, all of them, that a restart no longer halves are rounding of the solves: a body that many
/// constraints hold is soft where only its pins do, and its solves lose the digits by which it is softer.
const STALLED: f64 = 1e-8;
/// What is left of a vector after orthogonalisation is noise below this part of it.
const NOISE: f64 = 1e-14;
const RESTARTS: usize = 60;
/// Restarts after which an iteration without a converged pair is given up: what it looks for lies too close together, seen
/// from the shift of its factor.
const BARREN: usize = 12;

/// Dofs below which a dense decomposition of the whole is as quick as `count` vectors by iteration, and
/// for which the iteration might run out of dimensions.
pub(super) fn dense_limit(count: usize) -> usize {
    3 * capacity(count)
}

/// Bytes of an iteration for the `wanted` largest of a pencil with `n` dofs, its answer included.
pub(super) fn memory(n: usize, wanted: usize) -> usize {
    // The basis, what comes of it in the end, and in a step the block, its product, a copy of it, both interleaved for M, and the
    // two of a solution; where it begins anew two more.
    let columns = capacity(wanted) + BLOCK + wanted + 9 * BLOCK;
    n.saturating_mul(columns).saturating_mul(size_of::<f64>())
}

/// Vectors kept at most.
fn capacity(count: usize) -> usize {
    (2 * count).max(count + 8 * BLOCK).next_multiple_of(BLOCK)
}

/// The state of the iteration: an M-orthonormal basis V and T = VᵀM A⁻¹M V.
pub(super) struct Lanczos<'a> {
    factor: &'a ConstrainedCholesky,
    mass: &'a SparseMatrix,
    wanted: usize,
    /// V: n × (capacity + BLOCK); columns `..size + BLOCK` are set.
    basis: Matrix,
    /// T, of which `..size` rows and columns are set.
    projected: Matrix,
    /// Columns of V to which A⁻¹M has been applied.
    size: usize,
    /// Ritz vectors kept at the last restart, which stand first.
    kept: usize,
    /// Coupling of the last applied block to the next: A⁻¹M V = V T + W·coupling in those columns.
    coupling: Matrix,
    /// M times the newest block of V.
    mass_block: Vec<f64>,
    /// Memory of a block, and of products with M.
    spare: Vec<f64>,
    products: HalfMemory,
    random: Random,
}

/// What an iteration came to.
pub(super) struct Found {
    /// θ of the wanted pairs, descending; those that have not converged are below the eigenvalues that they approach.
    pub(super) theta: Vec<f64>,
    /// Vectors of those that have converged, M-orthonormal.
    pub(super) vectors: Matrix,
}

impl Found {
    /// Whether all that were wanted have converged.
    pub(super) fn is_whole(&self) -> bool {
        self.vectors.cols == self.theta.len()
    }
}

/// Approximate eigenpairs out of the basis, θ descending.
struct Ritz {
    theta: Vec<f64>,
    vectors: Matrix,
    /// How many of the first have converged.
    converged: usize,
    /// The largest residual of the wanted ones, as a part of θ.
    worst: f64,
}

impl<'a> Lanczos<'a> {
    /// An iteration for the `wanted` largest θ, where `factor` is that of A.
    pub(super) fn new(
        factor: &'a ConstrainedCholesky,
        mass: &'a SparseMatrix,
        wanted: usize,
    ) -> Result<Self, ReductionError> {
        let (n, capacity) = (mass.size(), capacity(wanted));
        let mut lanczos = Lanczos {
            factor,
            mass,
            wanted,
            basis: Matrix::zeros(n, capacity + BLOCK),
            projected: Matrix::zeros(capacity + BLOCK, capacity + BLOCK),
            size: 0,
            kept: 0,
            coupling: Matrix::zeros(BLOCK, BLOCK),
            mass_block: vec![0.0; n * BLOCK],
            spare: vec![0.0; n * BLOCK],
            products: HalfMemory::default(),
            random: Random(0x9E37_79B9_7F4A_7C15),
        };
        lanczos.start_block()?;
        Ok(lanczos)
    }

    /// Iterates until the wanted pairs have converged, or as long as that is of any use.
    pub(super) fn run(&mut self) -> Result<Found, ReductionError> {
        let mut before = f64::INFINITY;
        for restart in 0..=RESTARTS {
            let mut ritz = self.expand()?;
            if ritz.worst <= STALLED && ritz.worst > 0.5 * before {
                ritz.converged = self.wanted;
            }
            before = ritz.worst;
            let barren = restart >= BARREN && ritz.converged == 0;
            if ritz.converged >= self.wanted || barren || restart == RESTARTS {
                let converged = ritz.converged.min(self.wanted);
                self.compress(&ritz, self.wanted);
                let Columns { rows, cols, data } = self.basis.columns(0..converged);
                let vectors = Matrix { rows, cols, data: data.to_vec() };
                return Ok(Found { theta: ritz.theta[..self.wanted].to_vec(), vectors });
            }
            let keep = (self.wanted + self.size) / 2;
            self.compress(&ritz, keep);
        }
        unreachable!("the last restart returns")
    }

    /// After [`Lanczos::run`]: begins anew beside the converged pairs, in search of vectors that the start block had no
    /// part of.
    pub(super) fn search_again(&mut self) -> Result<(), ReductionError> {
        self.start_block()
    }

    /// Enlarges the basis until the wanted pairs have converged or it is full.
    fn expand(&mut self) -> Result<Ritz, ReductionError> {
        let capacity = self.basis.cols - BLOCK;
        let mut check = usize::max(self.size + STRIDE * BLOCK, self.wanted + BLOCK);
        while self.size + BLOCK <= capacity {
            self.step()?;
            if self.size >= check && self.size + BLOCK <= capacity {
                let ritz = self.ritz()?;
                if ritz.converged >= self.wanted {
                    return Ok(ritz);
                }
                // As a rule fewer pairs converge than there are new vectors.
                check = self.size + usize::max(STRIDE * BLOCK, self.wanted - ritz.converged);
            }
        }
        self.ritz()
    }

    /// Applies A⁻¹M to the newest block and appends what is new in the result.
    fn step(&mut self) -> Result<(), ReductionError> {
        let (size, known) = (self.size, self.size + BLOCK);
        // The three-term recurrence, but for the first block after the kept Ritz vectors.
        let coupled = if size == self.kept { 0 } else { size - BLOCK };
        let mut block = std::mem::take(&mut self.mass_block);
        self.factor.solve_in_place(&mut block);
        let (h, coupling) = self.append(coupled, known, block)?;
        for j in 0..BLOCK {
            for i in 0..known {
                // The newest diagonal block is symmetric but for rounding.
                let value =
                    if i < size { h[(i, j)] } else { 0.5 * (h[(i, j)] + h[(size + j, i - size)]) };
                self.projected[(i, size + j)] = value;
                self.projected[(size + j, i)] = value;
            }
        }
        self.coupling = coupling;
        self.size = known;
        Ok(())
    }

    /// Makes a block W orthonormal, also to the first `known` columns V of the basis, and puts it after
    /// them: W = V h + W' r. Only the columns of V from `coupled` on have more than rounding in common
    /// with W. Returns h and r.
    fn append(
        &mut self,
        coupled: usize,
        known: usize,
        mut block: Vec<f64>,
    ) -> Result<(Matrix, Matrix), ReductionError> {
        let n = self.basis.rows;
        let spare = std::mem::take(&mut self.spare);
        let mut product = Matrix { rows: n, cols: BLOCK, data: spare };
        let mut h = Matrix::zeros(known, BLOCK);
        // Once is not enough, twice is; the first time may leave out what is rounding.
        for first in [coupled, 0] {
            self.mass.multiply_beside(&block, &mut product.data, &mut self.products);
            let part = self.remove_known(first..known, &mut block, &product);
            for j in 0..BLOCK {
                h.col_mut(j)[first..].iter_mut().zip(part.col(j)).for_each(|(sum, x)| *sum += x);
            }
        }
        self.mass.multiply_beside(&block, &mut product.data, &mut self.products);
        let r = match orthonormalise(&mut block, &mut product) {
            Some(r) => r,
            None => {
                let r = self.orthonormalise_by_columns(known, &mut block)?;
                self.mass.multiply(&block, &mut product.data);
                r
            }
        };
        self.basis.data[known * n..(known + BLOCK) * n].copy_from_slice(&block);
        (self.mass_block, self.spare) = (product.data, block);
        Ok((h, r))
    }

    /// W ← W − V h, h = VᵀMW, over some columns V of the basis, where `product` is MW. Returns h.
    fn remove_known(&self, known: Range<usize>, block: &mut [f64], product: &Matrix) -> Matrix {
        let basis = self.basis.columns(known);
        let h = transpose_multiply_beside(basis, product.view());
        multiply_add_beside(block, -1.0, basis, h.view());
        h
    }

    /// As [`orthonormalise`] for a block that is rank-deficient: a column that holds nothing new is
    /// replaced by a random one, with zeros in R.
    fn orthonormalise_by_columns(
        &mut self,
        known: usize,
        block: &mut [f64],
    ) -> Result<Matrix, ReductionError> {
        let n = self.basis.rows;
        let mut r = Matrix::zeros(BLOCK, BLOCK);
        for j in 0..BLOCK {
            let (before, rest) = block.split_at_mut(j * n);
            let column = &mut rest[..n];
            let norm = self.norm(column);
            let h = self.remove(known, before, column);
            let left = self.norm(column);
            r.col_mut(j)[..j].copy_from_slice(&h);
            if left > NOISE * norm {
                r[(j, j)] = left;
            } else {
                column.fill_with(|| self.random.next());
                self.remove(known, before, column);
            }
            let length = self.norm(column);
            if length == 0.0 || !length.is_finite() {
                // No direction is left, or the matrices are not finite.
                return Err(LinearAlgebraError::NoConvergence { size: n }.into());
            }
            column.iter_mut().for_each(|value| *value /= length);
        }
        Ok(r)
    }

    /// Makes `column` orthogonal to the first `known` of the basis and to the columns `before`; the
    /// components along the latter.
    fn remove(&self, known: usize, before: &[f64], column: &mut [f64]) -> Vec<f64> {
        let n = column.len();
        let earlier = Matrix { rows: n, cols: before.len() / n, data: before.to_vec() };
        let mut total = vec![0.0; earlier.cols];
        let mut product = Matrix::zeros(n, 1);
        for _ in 0..2 {
            self.mass.multiply(column, &mut product.data);
            self.remove_known(0..known, column, &product);
            self.mass.multiply(column, &mut product.data);
            for (k, component) in earlier.apply_transpose(&product.data).into_iter().enumerate() {
                total[k] += component;
                for (value, &w) in column.iter_mut().zip(earlier.col(k)) {
                    *value -= component * w;
                }
            }
        }
        total
    }

    /// √(xᵀMx).
    fn norm(&self, x: &[f64]) -> f64 {
        let mut product = vec![0.0; x.len()];
        self.mass.multiply(x, &mut product);
        dot(x, &product).max(0.0).sqrt()
    }

    /// The pairs of T with residuals ‖coupling · (last rows of the vector)‖.
    fn ritz(&self) -> Result<Ritz, ReductionError> {
        let size = self.size;
        let all: Vec<usize> = (0..size).collect();
        let eigen = symmetric_eigen(&self.projected.select(&all, &all))?;
        let descending: Vec<usize> = (0..size).rev().collect();
        let vectors = eigen.vectors.select(&all, &descending);
        let theta: Vec<f64> = descending.iter().map(|&i| eigen.values[i]).collect();
        // Rounding of the products with T leaves this much, however long the iteration.
        let floor = f64::EPSILON * theta[0] * (size as f64).sqrt();
        let residual = |i: usize| {
            let tail = &vectors.col(i)[size - BLOCK..];
            self.coupling.apply(tail).iter().map(|r| r * r).sum::<f64>().sqrt()
        };
        let residuals: Vec<f64> = (0..size.min(self.wanted)).map(residual).collect();
        let pairs = || residuals.iter().zip(&theta);
        let has_converged = |(own, theta): &(&f64, &f64)| **own <= (RESIDUAL * **theta).max(floor);
        let converged = pairs().take_while(has_converged).count();
        let worst = pairs().map(|(own, theta)| own / theta.abs()).fold(0.0, f64::max);
        Ok(Ritz { theta, vectors, converged, worst })
    }

    /// Replaces the basis by the first `keep` Ritz vectors, followed by the newest block.
    fn compress(&mut self, ritz: &Ritz, keep: usize) {
        let (n, size) = (self.basis.rows, self.size);
        let kept = ritz.vectors.columns(0..keep);
        multiply_in_place_beside(&mut self.basis.data[..size * n], n, kept);
        self.basis.data.copy_within(size * n..(size + BLOCK) * n, keep * n);
        self.projected.data.fill(0.0);
        for i in 0..keep {
            self.projected[(i, i)] = ritz.theta[i];
        }
        (self.size, self.kept) = (keep, keep);
    }

    /// Puts a random block, smoothed by one application of A⁻¹M, after the `size` columns of the basis.
    fn start_block(&mut self) -> Result<(), ReductionError> {
        let n = self.basis.rows;
        let mut raw = vec![0.0; n * BLOCK];
        raw.fill_with(|| self.random.next());
        let mut block = vec![0.0; n * BLOCK];
        self.mass.multiply(&raw, &mut block);
        self.factor.solve_in_place(&mut block);
        self.append(0, self.size, block)?;
        Ok(())
    }
}

/// W ← W R⁻¹ with WᵀMW = 1, where `product` is MW before and after; R. `None` if the block is
/// rank-deficient.
fn orthonormalise(block: &mut [f64], product: &mut Matrix) -> Option<Matrix> {
    let (n, cols) = (product.rows, product.cols);
    let original = block.to_vec();
    let mut r = Matrix::identity(cols);
    let mut cholesky = Cholesky::new(cols);
    // Cholesky QR, twice, is orthonormal to rounding if the first factor exists.
    for _ in 0..2 {
        let gram = transpose_multiply(Columns { rows: n, cols, data: block }, product.view());
        if cholesky.factor(&gram.symmetric_part().data).is_err() {
            block.copy_from_slice(&original);
            return None;
        }
        cholesky.orthonormalise(block, n);
        cholesky.orthonormalise(&mut product.data, n);
        let upper =
            Matrix::from_fn(cols, cols, |i, j| if i <= j { cholesky.lower(j, i) } else { 0.0 });
        r = multiply(upper.view(), r.view());
    }
    Some(r)
}

/// Uniform numbers in [−½, ½), always the same ones (xorshift64, Marsaglia 2003).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64 - 0.5
    }
}
