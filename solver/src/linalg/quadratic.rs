//! Eigenvalues of (λ²M + λC + K) x = 0.

use num_complex::Complex64;

use super::{
    LinearAlgebraError, Matrix, congruence, generalised_symmetric_eigen, multiply, on_one_thread,
    transpose_multiply, view,
};

/// ω below this share of the largest one stand for it where speeds are scaled by it.
const SLOWEST: f64 = 1e-4;

/// An eigenvalue with its right vector.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct QuadraticPair {
    /// λ (1/s).
    pub(crate) value: Complex64,
    /// x, a value a coordinate.
    pub(crate) vector: Vec<Complex64>,
}

/// What hangs on x by rates of its own: ṡ = A s + B x + D ẋ, with the forces P s on x.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FirstOrder {
    /// A, m × m.
    pub(crate) rates: Matrix,
    /// B and D, m × n.
    pub(crate) by_position: Matrix,
    pub(crate) by_rate: Matrix,
    /// P, n × m.
    pub(crate) forces: Matrix,
}

impl FirstOrder {
    /// Of x = T y.
    pub(crate) fn in_basis(&self, basis: &Matrix) -> FirstOrder {
        let [by_position, by_rate] =
            [&self.by_position, &self.by_rate].map(|own| multiply(own.view(), basis.view()));
        let forces = transpose_multiply(basis.view(), self.forces.view());
        FirstOrder { rates: self.rates.clone(), by_position, by_rate, forces }
    }

    /// By s in units in which what goes in is as large as what goes out.
    fn balanced(mut self) -> FirstOrder {
        let (m, n) = (self.rates.rows, self.forces.rows);
        let size = |values: &mut dyn Iterator<Item = f64>| values.map(f64::abs).fold(0.0, f64::max);
        for k in 0..m {
            let of = [&self.by_position, &self.by_rate];
            let inward = size(&mut of.into_iter().flat_map(|own| (0..n).map(move |j| own[(k, j)])));
            let outward = size(&mut self.forces.col(k).iter().copied());
            let unit = (inward / outward).sqrt();
            if !(unit > 0.0 && unit.is_finite()) {
                continue;
            }
            for j in 0..n {
                self.by_position[(k, j)] /= unit;
                self.by_rate[(k, j)] /= unit;
            }
            for j in 0..m {
                self.rates[(k, j)] /= unit;
                self.rates[(j, k)] *= unit;
            }
            self.forces.col_mut(k).iter_mut().for_each(|own| *own *= unit);
        }
        self
    }
}

/// All pairs with Im λ ≥ 0, real ones as they come, of M symmetric and positive definite, C and K of any kind; the largest
/// eigenvalue ω² of the symmetric part of K by M beside them.
///
/// In modes of M and that part the equations are ü + Ĉ u̇ + K̂ u = 0. With y = W u, W = |ω| on the diagonal, the rates of
/// (u̇, y) are [−Ĉ, −K̂W⁻¹; W, 0] (u̇, y): all entries are of the size of ω, so that slow modes beside fast ones keep their
/// digits.
///
/// # Errors
/// M that is not positive definite, or values that are not finite.
pub(crate) fn quadratic_eigen(
    mass: &Matrix,
    damping: &Matrix,
    stiffness: &Matrix,
) -> Result<(Vec<QuadraticPair>, f64), LinearAlgebraError> {
    quadratic_eigen_with(mass, damping, stiffness, None)
}

/// The same with what hangs on x by rates of its own beside it, whose own motions are among the pairs.
///
/// # Errors
/// As [`quadratic_eigen`].
pub(crate) fn quadratic_eigen_with(
    mass: &Matrix,
    damping: &Matrix,
    stiffness: &Matrix,
    beside: Option<&FirstOrder>,
) -> Result<(Vec<QuadraticPair>, f64), LinearAlgebraError> {
    let n = mass.rows;
    if n == 0 {
        return Ok((Vec::new(), 0.0));
    }
    let eigen = generalised_symmetric_eigen(&stiffness.symmetric_part(), mass)?;
    let largest = eigen.values.iter().fold(0.0, |most: f64, own| most.max(own.abs()));
    let scale = if largest > 0.0 { largest.sqrt() } else { 1.0 };
    let speeds: Vec<f64> =
        eigen.values.iter().map(|square| square.abs().sqrt().max(SLOWEST * scale)).collect();
    let [damping, stiffness] = [damping, stiffness].map(|own| congruence(own, &eigen.vectors));
    // In x = V u, with u = W⁻¹ y.
    let beside = beside.map(|own| {
        let mut own = own.in_basis(&eigen.vectors);
        for (j, speed) in speeds.iter().enumerate() {
            own.by_position.col_mut(j).iter_mut().for_each(|entry| *entry /= speed);
        }
        own.balanced()
    });
    let m = beside.as_ref().map_or(0, |own| own.rates.rows);
    let rates = Matrix::from_fn(2 * n + m, 2 * n + m, |i, j| {
        if let (Some(own), true) = (&beside, i >= 2 * n || j >= 2 * n) {
            let entry = match (i.checked_sub(2 * n), j.checked_sub(2 * n)) {
                (Some(k), Some(l)) => own.rates[(k, l)],
                (Some(k), None) if j < n => own.by_rate[(k, j)],
                (Some(k), None) => own.by_position[(k, j - n)],
                (None, Some(l)) if i < n => own.forces[(i, l)],
                _ => 0.0,
            };
            return entry / scale;
        }
        let entry = match (i.checked_sub(n), j.checked_sub(n)) {
            (None, None) => -damping[(i, j)],
            (None, Some(k)) => -stiffness[(i, k)] / speeds[k],
            (Some(k), None) if k == j => speeds[k],
            _ => 0.0,
        };
        entry / scale
    });
    let failure = LinearAlgebraError::NoConvergence { size: n };
    if rates.data.iter().any(|value| !value.is_finite()) {
        return Err(failure);
    }
    on_one_thread();
    let size = 2 * n + m;
    let found = view(size, size, &rates.data).eigen().map_err(|_| failure)?;
    let (values, vectors) = (found.S().column_vector(), found.U());
    let upper: Vec<usize> = (0..size).filter(|&k| values[k].im >= 0.0).collect();
    // u = W⁻¹ y, both parts side by side.
    let parts = Matrix {
        rows: n,
        cols: 2 * upper.len(),
        data: upper
            .iter()
            .flat_map(|&k| [false, true].map(|imaginary| (k, imaginary)))
            .flat_map(|(k, imaginary)| {
                let speeds = &speeds;
                (0..n).map(move |i| {
                    let y = vectors[(n + i, k)];
                    (if imaginary { y.im } else { y.re }) / speeds[i]
                })
            })
            .collect(),
    };
    let parts = multiply(eigen.vectors.view(), parts.view());
    let pairs = upper.iter().enumerate().map(|(place, &k)| {
        let both = parts.col(2 * place).iter().zip(parts.col(2 * place + 1));
        QuadraticPair {
            value: Complex64::new(values[k].re, values[k].im) * scale,
            vector: both.map(|(re, im)| Complex64::new(*re, *im)).collect(),
        }
    });
    Ok((pairs.collect(), largest))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain with damping and a skew stiffness: every pair solves the equations, and slow ones keep their digits beside fast
    /// ones.
    #[test]
    fn pairs_solve_the_equations() {
        let n = 12;
        let stiff = |i: usize| 10f64.powi(i as i32);
        let mass = Matrix::from_fn(n, n, |i, j| if i == j { 2.0 } else { 0.0 });
        let stiffness = Matrix::from_fn(n, n, |i, j| {
            if i == j { stiff(i) } else { 0.02 * stiff(i.min(j)) * if i < j { 1.0 } else { -1.0 } }
        });
        let damping = Matrix::from_fn(n, n, |i, j| {
            let size = 0.01 * stiff(i.min(j)).sqrt();
            if i == j { size } else { 0.3 * size }
        });
        let (pairs, largest) = quadratic_eigen(&mass, &damping, &stiffness).unwrap();
        assert_eq!(pairs.iter().map(|own| 1 + usize::from(own.value.im > 0.0)).sum::<usize>(), 24);
        let fastest = largest.sqrt();
        for QuadraticPair { value, vector } in &pairs {
            let size = vector.iter().map(|x| x.norm()).fold(0.0, f64::max);
            for i in 0..n {
                let terms = (0..n).map(|j| {
                    let entry = value * value * mass[(i, j)]
                        + value * damping[(i, j)]
                        + Complex64::from(stiffness[(i, j)]);
                    entry * vector[j]
                });
                let left: Complex64 = terms.sum();
                // λ is as exact as the fastest ω; and y of fast modes is divided by the slowest W.
                let exact = n as f64 * f64::EPSILON;
                let rounding = exact * 2.0 * value.norm() * (fastest + value.norm() / SLOWEST);
                let bound = (rounding + 1e-11 * stiffness[(i, i)]) * size;
                assert!(left.norm() < bound, "{value} row {i}: {left} for {bound:e}");
            }
        }
    }
}
