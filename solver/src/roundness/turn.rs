//! The generator of turns of a body, out of its reduced matrices and the pairs of rows that it shows.
//!
//! In coordinates (i, p) with p = Pη the rows of the pairs, and i the modes of (K, M) with p = 0, the rest being relaxed
//! against them (K_ip = 0), a turn is J in every pair of p, exactly, and acts in i within equal frequencies alone. Which
//! modes turn, and in which sense, is told by the inertia L = M_ip that they share with the pairs: S_i L = L J_r, so that
//! S_i is the polar factor of L J_r Lᵀ. H, which might tell it, too, misleads where I_d is ½ I_p or a ring turns oval.

use super::pairs::Chosen;
use crate::linalg::{
    Cholesky, LinearAlgebraError, Lu, Matrix, multiply, symmetric_eigen, transpose_multiply,
};
use crate::reduction::hertz;

/// Share by which frequencies, inertias and dampings of a pair may differ in a body that counts as round.
pub const ASYMMETRY: f64 = 1e-3;
/// Multiples of n · eps of the stiffest eigenvalue of K below which one is none: rounding of a motion that bends nothing.
const RIGID: f64 = 64.0;
/// Share by which neighbouring eigenvalues of a chain may differ: pairs of coarse meshes do by 1e-2.
const CHAIN: f64 = 2e-2;
/// Share of its inertia that a mode must have in common with a pair for its turn to be seen.
const SEEN: f64 = 1e-6;
/// Two modes are a pair if the pairs of rows see so much of them turn: all, but for what a mesh without symmetry adds.
const PAIRED: f64 = 0.5;

/// Coordinates of a body in which its turns are seen: η = T (i, p).
#[derive(Debug, Clone)]
pub(super) struct Turn {
    /// T; n × n.
    pub(super) basis: Matrix,
    /// Which coordinates turn into each other: S of the first is the second, S of the second minus the first.
    pub(super) pairs: Vec<[usize; 2]>,
    /// S = T S_T T⁻¹; n × n.
    pub(super) generator: Matrix,
    /// Frequencies (Hz) of the pairs among the modes i, ascending.
    pub(super) paired: Vec<f64>,
    /// Those of modes without a turn, ascending: axial, torsional and what else the rows do not see.
    pub(super) still: Vec<f64>,
    /// The lowest of a mode that moves sideways without a partner.
    pub(super) alone: Option<f64>,
}

impl Turn {
    /// `lower`: the factor of M.
    pub(super) fn new(
        mass: &Matrix,
        stiffness: &Matrix,
        lower: &Cholesky,
        chosen: &Chosen,
    ) -> Result<Turn, LinearAlgebraError> {
        let (n, rows) = (mass.rows, chosen.count());
        let inner = n - rows;
        let modes = Modes::new(stiffness, lower, chosen)?;
        let relaxed = modes.relaxed(chosen)?;
        let seen = modes.seen(&relaxed);
        let mut found = Chains { modes: &modes, seen: &seen, pairs: Vec::new(), still: Vec::new() };
        let mut first = 0;
        while first < inner {
            let next = |last: usize| last + 1 < inner && modes.next_to(last);
            let last = (first..inner).find(|&last| !next(last)).unwrap_or(inner - 1);
            let (pairs, still) = found.chain(first..last + 1)?;
            found.pairs.extend(pairs);
            found.still.extend(still);
            first = last + 1;
        }
        let Chains { pairs: paired, still, .. } = found;
        // T in ξ: pairs, what does not turn, relaxed rows.
        let columns =
            paired.iter().flat_map(|pair| &pair.columns).chain(still.iter().map(|own| &own.column));
        let inside = Matrix {
            rows: n,
            cols: inner,
            data: columns.flat_map(|own| modes.vectors.apply(own)).collect(),
        };
        let mut basis = inside.clone();
        basis.data.extend_from_slice(&relaxed.data);
        basis.cols = n;
        // T⁻¹ in ξ: p by the rows themselves, i what is left of a motion without its relaxed part.
        let mut inverse = inside;
        let shared = transpose_multiply(relaxed.view(), inverse.view());
        let taken = multiply(chosen.rows.view(), shared.view());
        inverse.data.iter_mut().zip(&taken.data).for_each(|(own, taken)| *own -= taken);
        inverse.data.extend_from_slice(&chosen.rows.data);
        inverse.cols = n;
        lower.solve_upper_in_place(&mut basis.data);
        // (T⁻¹)ᵀ = L (T_ξ⁻¹)ᵀ = M L⁻ᵀ (T_ξ⁻¹)ᵀ.
        lower.solve_upper_in_place(&mut inverse.data);
        let inverse = multiply(mass.view(), inverse.view());
        let pairs = (0..paired.len()).map(|k| [2 * k, 2 * k + 1]);
        let pairs: Vec<[usize; 2]> =
            pairs.chain((inner..n).step_by(2).map(|first| [first, first + 1])).collect();
        let mut turned = Matrix::zeros(n, n);
        for &[a, b] in &pairs {
            turned.col_mut(a).copy_from_slice(basis.col(b));
            turned.col_mut(b).iter_mut().zip(basis.col(a)).for_each(|(own, value)| *own = -value);
        }
        let generator = multiply(turned.view(), inverse.transpose().view());
        let sorted = |mut own: Vec<f64>| {
            own.sort_by(f64::total_cmp);
            own
        };
        let alone = still.iter().filter(|own| own.sideways > ASYMMETRY).map(|own| own.hertz);
        Ok(Turn {
            basis,
            pairs,
            generator,
            paired: sorted(paired.iter().map(|pair| pair.hertz).collect()),
            alone: alone.reduce(f64::min),
            still: sorted(still.iter().map(|own| own.hertz).collect()),
        })
    }
}

/// Modes with all rows held, in coordinates in which M is the identity.
struct Modes {
    stiffness: Matrix,
    values: Vec<f64>,
    /// n × n − 2m.
    vectors: Matrix,
    /// Eigenvalues that are none.
    rigid: f64,
}

impl Modes {
    fn new(
        stiffness: &Matrix,
        lower: &Cholesky,
        chosen: &Chosen,
    ) -> Result<Modes, LinearAlgebraError> {
        let (n, rows) = (stiffness.rows, chosen.count());
        let mut scaled = stiffness.clone();
        lower.solve_lower_in_place(&mut scaled.data);
        scaled = scaled.transpose();
        lower.solve_lower_in_place(&mut scaled.data);
        let stiffness = scaled.symmetric_part();
        // Held: (1 − QQᵀ) K (1 − QQᵀ), and beyond all of that what the rows span.
        let basis = &chosen.basis;
        let by_rows = multiply(stiffness.view(), basis.view());
        let both = transpose_multiply(basis.view(), by_rows.view());
        let largest = (0..n)
            .map(|j| stiffness.col(j).iter().map(|value| value.abs()).sum::<f64>())
            .fold(0.0, f64::max);
        let beyond = 2.0 * largest + f64::from(u8::from(largest == 0.0));
        let projected = multiply(basis.view(), both.view());
        let shifted = Matrix::from_fn(n, rows, |i, j| {
            by_rows[(i, j)] - 0.5 * projected[(i, j)] - 0.5 * beyond * basis[(i, j)]
        });
        let mut held = stiffness.clone();
        let product = multiply(shifted.view(), basis.transpose().view());
        for j in 0..n {
            for i in 0..n {
                held[(i, j)] -= product[(i, j)] + product[(j, i)];
            }
        }
        let eigen = symmetric_eigen(&held)?;
        let inner = n - rows;
        let vectors =
            Matrix { rows: n, cols: inner, data: eigen.vectors.data[..n * inner].to_vec() };
        let rigid = RIGID * n as f64 * f64::EPSILON * largest;
        Ok(Modes { stiffness, values: eigen.values[..inner].to_vec(), vectors, rigid })
    }

    /// Whether the mode after this one is as good as at its frequency.
    fn next_to(&self, mode: usize) -> bool {
        let [own, next] = [self.values[mode], self.values[mode + 1]];
        next - own <= f64::max(CHAIN * next, self.rigid)
    }

    fn hertz(&self, square: f64) -> f64 {
        hertz(if square > self.rigid { square } else { 0.0 })
    }

    /// Motions with a unit of each row, in no force against the modes; n × 2m.
    fn relaxed(&self, chosen: &Chosen) -> Result<Matrix, LinearAlgebraError> {
        let rows = chosen.count();
        if rows == 0 {
            return Ok(Matrix::zeros(self.vectors.rows, 0));
        }
        let mut lu = Lu::new(rows);
        lu.factor(&transpose_multiply(chosen.rows.view(), chosen.basis.view()).data)?;
        let mut square = Matrix::identity(rows);
        lu.solve_in_place(&mut square.data);
        let mut relaxed = multiply(chosen.basis.view(), square.view());
        // The second time takes what rounding left.
        for _ in 0..2 {
            let forces = multiply(self.stiffness.view(), relaxed.view());
            let mut parts = transpose_multiply(self.vectors.view(), forces.view());
            for j in 0..rows {
                for (part, value) in parts.col_mut(j).iter_mut().zip(&self.values) {
                    *part = if *value > self.rigid { *part / value } else { 0.0 };
                }
            }
            let taken = multiply(self.vectors.view(), parts.view());
            relaxed.data.iter_mut().zip(&taken.data).for_each(|(own, taken)| *own -= taken);
        }
        Ok(relaxed)
    }

    /// L, a mode a column, with each pair of rows of mean inertia 1: 2m × modes.
    fn seen(&self, relaxed: &Matrix) -> Matrix {
        let mut seen = transpose_multiply(relaxed.view(), self.vectors.view());
        let square = |column: &[f64]| column.iter().map(|value| value * value).sum::<f64>();
        for k in (0..relaxed.cols).step_by(2) {
            let inertia = 0.5 * (square(relaxed.col(k)) + square(relaxed.col(k + 1)));
            for j in 0..seen.cols {
                seen[(k, j)] /= inertia.sqrt();
                seen[(k + 1, j)] /= inertia.sqrt();
            }
        }
        seen
    }
}

/// Two motions over the modes that turn into each other.
struct Paired {
    columns: [Vec<f64>; 2],
    hertz: f64,
}

/// A motion over the modes that does not turn.
struct Still {
    column: Vec<f64>,
    hertz: f64,
    /// The largest share of a pair's inertia that it has.
    sideways: f64,
}

struct Chains<'a> {
    modes: &'a Modes,
    /// L, a mode a column.
    seen: &'a Matrix,
    pairs: Vec<Paired>,
    still: Vec<Still>,
}

impl Chains<'_> {
    /// What turns of the modes of a chain. Where that is not all it is asked of both parts beside its widest gap: rows that
    /// are fewer than its pairs tell these by themselves.
    fn chain(
        &self,
        range: std::ops::Range<usize>,
    ) -> Result<(Vec<Paired>, Vec<Still>), LinearAlgebraError> {
        let whole = self.polar(range.clone())?;
        if range.len() <= 2 || whole.1.is_empty() {
            return Ok(whole);
        }
        let gap = |k: &usize| self.modes.values[k + 1] - self.modes.values[*k];
        let widest = (range.start..range.end - 1).max_by(|a, b| gap(a).total_cmp(&gap(b)));
        let middle = widest.expect("three modes or more") + 1;
        let (mut pairs, mut still) = self.chain(range.start..middle)?;
        let (more, rest) = self.chain(middle..range.end)?;
        pairs.extend(more);
        still.extend(rest);
        Ok(if pairs.len() > whole.0.len() { (pairs, still) } else { whole })
    }

    /// The polar factor of L J_r Lᵀ of a chain, where it is one.
    fn polar(
        &self,
        range: std::ops::Range<usize>,
    ) -> Result<(Vec<Paired>, Vec<Still>), LinearAlgebraError> {
        let size = range.len();
        let seen = self.seen.columns(range.clone());
        let mut turned = Matrix { rows: seen.rows, cols: size, data: seen.data.to_vec() };
        for column in turned.data.chunks_exact_mut(seen.rows.max(1)) {
            for pair in column.chunks_exact_mut(2) {
                // J of what the rows have of a mode.
                (pair[0], pair[1]) = (-pair[1], pair[0]);
            }
        }
        // Lᵀ here: entry (a, b) is l_a · J l_b.
        let skew = transpose_multiply(seen, turned.view()).skew_part();
        let eigen = symmetric_eigen(&transpose_multiply(skew.view(), skew.view()))?;
        let inertia = transpose_multiply(seen, seen);
        let of =
            |u: &[f64]| -> f64 { inertia.apply(u).iter().zip(u).map(|(a, b)| a * b).sum::<f64>() };
        let (mut pairs, mut own): (Vec<Paired>, Vec<Vec<f64>>) = (Vec::new(), Vec::new());
        let mut k = size;
        while k >= 2 && self.seen.rows > 0 {
            let first = self.without(eigen.vectors.col(k - 1), &own);
            k -= 2;
            let image = skew.apply(&first);
            let second =
                self.without(&image, &[own.as_slice(), std::slice::from_ref(&first)].concat());
            let turn = image.iter().zip(&second).map(|(a, b)| a * b).sum::<f64>();
            let common = 0.5 * (of(&first) + of(&second));
            if !(common > SEEN * SEEN && turn > PAIRED * common) {
                break;
            }
            let square = 0.5 * (self.square(&range, &first) + self.square(&range, &second));
            let columns = [&first, &second].map(|u| self.placed(&range, u));
            pairs.push(Paired { columns, hertz: self.modes.hertz(square) });
            own.extend([first, second]);
        }
        let mut still = Vec::new();
        // What is left, by the modes that are farthest from what is taken.
        while own.len() < size {
            let unit =
                |j: usize| -> Vec<f64> { (0..size).map(|i| f64::from(u8::from(i == j))).collect() };
            let left = |j: &usize| 1.0 - own.iter().map(|u| u[*j] * u[*j]).sum::<f64>();
            let farthest = (0..size).max_by(|a, b| left(a).total_cmp(&left(b)));
            let rest = self.without(&unit(farthest.expect("a mode")), &own);
            let column = self.placed(&range, &rest);
            let rows = self.seen.apply(&column);
            let shares = rows.chunks_exact(2).map(|pair| pair[0].powi(2) + pair[1].powi(2));
            let sideways = shares.fold(0.0, f64::max);
            let hertz = self.modes.hertz(self.square(&range, &rest));
            still.push(Still { column, hertz, sideways });
            own.push(rest);
        }
        Ok((pairs, still))
    }

    /// The direction of a vector without its parts along others that are orthonormal.
    fn without(&self, vector: &[f64], others: &[Vec<f64>]) -> Vec<f64> {
        let mut own = vector.to_vec();
        for _ in 0..2 {
            for other in others {
                let part: f64 = own.iter().zip(other).map(|(a, b)| a * b).sum();
                own.iter_mut().zip(other).for_each(|(own, along)| *own -= part * along);
            }
            let norm = own.iter().map(|value| value * value).sum::<f64>().sqrt();
            if norm > 0.0 {
                own.iter_mut().for_each(|value| *value /= norm);
            }
        }
        own
    }

    /// ω² of a motion of a chain.
    fn square(&self, range: &std::ops::Range<usize>, u: &[f64]) -> f64 {
        u.iter().zip(&self.modes.values[range.clone()]).map(|(u, value)| u * u * value).sum()
    }

    /// A motion of a chain over all modes.
    fn placed(&self, range: &std::ops::Range<usize>, u: &[f64]) -> Vec<f64> {
        let mut all = vec![0.0; self.modes.values.len()];
        all[range.clone()].copy_from_slice(u);
        all
    }
}
