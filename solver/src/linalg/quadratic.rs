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
        own
    });
    let m = beside.as_ref().map_or(0, |own| own.rates.rows);
    let mut rates = Matrix::from_fn(2 * n + m, 2 * n + m, |i, j| {
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
    // States may have any units.
    let units = if m > 0 { balance(&mut rates) } else { vec![1.0; size] };
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
                let (speeds, units) = (&speeds, &units);
                (0..n).map(move |i| {
                    let y = vectors[(n + i, k)];
                    (if imaginary { y.im } else { y.re }) * units[n + i] / speeds[i]
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

/// Times that all rows are balanced at most, and how much a factor must bring.
const BALANCINGS: usize = 20;
const BRINGS: f64 = 0.95;

/// D⁻¹ A D in the place of A, with powers of two as make rows as large as columns, and D (Osborne, J. ACM 7 (1960) 338-345): what
/// is similar has the same eigenvalues, and rounding goes by the sizes of entries.
fn balance(matrix: &mut Matrix) -> Vec<f64> {
    let n = matrix.rows;
    let mut units = vec![1.0; n];
    for _ in 0..BALANCINGS {
        let mut is_balanced = true;
        for k in 0..n {
            let others =
                |all: &mut dyn Iterator<Item = f64>| all.map(|own| own * own).sum::<f64>().sqrt();
            let row = others(&mut (0..n).filter(|&j| j != k).map(|j| matrix[(k, j)]));
            let column = others(&mut (0..n).filter(|&i| i != k).map(|i| matrix[(i, k)]));
            if !(row > 0.0 && column > 0.0) {
                continue;
            }
            let factor = (0.5 * (row / column).log2()).round().exp2();
            if factor == 1.0 || row / factor + column * factor >= BRINGS * (row + column) {
                continue;
            }
            is_balanced = false;
            units[k] *= factor;
            for j in 0..n {
                matrix[(k, j)] /= factor;
            }
            matrix.col_mut(k).iter_mut().for_each(|own| *own *= factor);
        }
        if is_balanced {
            break;
        }
    }
    units
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A mass with a controller whose states have units far from those of the mass: λ(λ + a) λ² m + … of a chain is solved to
    /// rounding, whatever the units of the chain.
    #[test]
    fn states_may_have_any_units() {
        let one = |value: f64| Matrix { rows: 1, cols: 1, data: vec![value] };
        let (mass, stiffness) = (one(60.0), one(-1.6e6));
        // An integral of x, and a current that follows P x + I ∫x at a rate.
        let (proportional, integral, rate, force) = (3000.0, 1e6, 5e3, 1e3);
        for unit in [1e-12, 1e-3, 1.0, 1e9] {
            let states = FirstOrder {
                rates: Matrix {
                    rows: 2,
                    cols: 2,
                    data: vec![0.0, rate * integral / unit, 0.0, -rate],
                },
                by_position: Matrix { rows: 2, cols: 1, data: vec![unit, rate * proportional] },
                by_rate: Matrix::zeros(2, 1),
                forces: Matrix { rows: 1, cols: 2, data: vec![0.0, -force] },
            };
            let (pairs, _) =
                quadratic_eigen_with(&mass, &one(0.0), &stiffness, Some(&states)).unwrap();
            assert_eq!(
                pairs.iter().map(|own| 1 + usize::from(own.value.im > 0.0)).sum::<usize>(),
                4
            );
            for QuadraticPair { value: s, .. } in pairs {
                // λ (λ + rate) (m λ² + k) + force rate (P λ + I) = 0.
                let terms = [
                    s * (s + rate) * (60.0 * s * s - 1.6e6),
                    force * rate * (proportional * s + integral),
                ];
                let left = (terms[0] + terms[1]).norm();
                let size = terms[0].norm() + s.norm() * (s.norm() + rate) * 1.6e6 + terms[1].norm();
                assert!(left < 1e-10 * size, "{unit:e}: {s}: {left:e} of {size:e}");
            }
        }
    }

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
