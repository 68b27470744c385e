//! Matrices of a body as they would be if it were round: their means over turns.

use super::turn::{ASYMMETRY, Turn};
use crate::linalg::{LinearAlgebraError, Matrix, congruence, generalised_symmetric_eigen};
use crate::reduction::hertz;

/// Share of the largest eigenvalue below which one is that of a rigid motion.
const RIGID: f64 = 1e-10;
/// The same of a body that nothing holds, where the next one is larger by [`GAP`]: a reduced stiffness is a difference, with the rounding
/// of what is stiff within the mesh.
const FREE: f64 = 1e-7;
const GAP: f64 = 1e6;
/// Share by which eigenvalues of the mean body differ within a pair: rounding, as it is round.
const EQUAL: f64 = 1e-7;

/// What a matrix is measured by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scale {
    /// By the mass of each mode: 1.
    Mass,
    /// By ω² of each mode.
    Stiffness,
    /// By what it is itself.
    Itself,
}

/// X̄ = (1/2π) ∫ R(α)ᵀ X R(α) dα of a form, R(α) = 1 + sin α S + (1 − cos α) S²: what turns and what does not, apart.
pub(super) fn mean_over_turns(own: &Matrix, generator: &Matrix, square: &Matrix) -> Matrix {
    let n = own.rows;
    let still = Matrix::from_fn(n, n, |i, j| square[(i, j)] + f64::from(u8::from(i == j)));
    let [still, once, twice] = [&still, generator, square].map(|turned| congruence(own, turned));
    Matrix::from_fn(n, n, |i, j| still[(i, j)] + 0.5 * (once[(i, j)] + twice[(i, j)]))
}

/// How far the matrices of a body are from those of a round one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Asymmetry {
    /// ‖X − X̄‖/‖X‖ of each matrix in the modes of the mean body within the band, mass 1 each; of K and of C in those of
    /// ω² = 1 each.
    pub(super) shares: Vec<f64>,
    /// The largest share by which anything of two modes of a pair differs: for K and M twice that of their frequencies.
    pub(super) splitting: f64,
    /// The frequency of the pair (Hz).
    pub(super) split: f64,
    /// The lowest frequency of a pair that is split by [`ASYMMETRY`] or more (Hz).
    pub(super) first_split: Option<f64>,
    /// The lowest frequency of the mean body at which it bends or twists (Hz).
    pub(super) lowest: Option<f64>,
}

impl Turn {
    /// X̄ = ⅙ Σ_k R(kπ/3)ᵀ X R(kπ/3) of a matrix in the coordinates of the turn: what turns by ±2 or ±1 of these angles adds
    /// up to nothing.
    fn averaged(&self, own: &Matrix) -> Matrix {
        let mut mean = own.clone();
        let mut turns = vec![false; own.rows];
        for &[a, b] in &self.pairs {
            (turns[a], turns[b]) = (true, true);
        }
        for j in 0..own.cols {
            for i in 0..own.rows {
                if turns[i] != turns[j] {
                    mean[(i, j)] = 0.0;
                }
            }
        }
        for &[a, b] in &self.pairs {
            for &[c, d] in &self.pairs {
                let alike = 0.5 * (own[(a, c)] + own[(b, d)]);
                let across = 0.5 * (own[(a, d)] - own[(b, c)]);
                (mean[(a, c)], mean[(b, d)]) = (alike, alike);
                (mean[(a, d)], mean[(b, c)]) = (across, -across);
            }
        }
        mean
    }

    /// `all`: M, K, and further ones, with what each is measured by. `band`: what counts (Hz). `free`: whether nothing holds the body.
    pub(super) fn asymmetry(
        &self,
        all: &[(&Matrix, Scale)],
        band: f64,
        free: bool,
    ) -> Result<Asymmetry, LinearAlgebraError> {
        let own: Vec<Matrix> = all.iter().map(|(own, _)| congruence(own, &self.basis)).collect();
        let mean: Vec<Matrix> = own.iter().map(|own| self.averaged(own)).collect();
        let eigen = generalised_symmetric_eigen(&mean[1], &mean[0])?;
        let largest = eigen.values.last().copied().unwrap_or(0.0).abs();
        let rigid = rigid_share(&eigen.values, largest, free);
        let is_rigid = |value: f64| value <= rigid * largest;
        let inside: Vec<usize> = (0..eigen.values.len())
            .filter(|&k| is_rigid(eigen.values[k]) || hertz(eigen.values[k]) < band)
            .collect();
        let vectors = Matrix {
            rows: eigen.vectors.rows,
            cols: inside.len(),
            data: inside.iter().flat_map(|&k| eigen.vectors.col(k)).copied().collect(),
        };
        let values: Vec<f64> = inside.iter().map(|&k| eigen.values[k]).collect();
        let mut clusters: Vec<Vec<usize>> = Vec::new();
        for (k, &value) in values.iter().enumerate() {
            let same = |other: f64| {
                is_rigid(value) && is_rigid(other) || value - other <= EQUAL * value.abs()
            };
            match clusters.last_mut().filter(|own| same(values[own[own.len() - 1]])) {
                Some(cluster) => cluster.push(k),
                None => clusters.push(vec![k]),
            }
        }
        let elastic = eigen.values.iter().copied().find(|value| !is_rigid(*value));
        let lowest = elastic.map(hertz);
        let mut found =
            Asymmetry { shares: Vec::new(), splitting: 0.0, split: 0.0, first_split: None, lowest };
        for ((own, mean), (_, scale)) in own.iter().zip(&mean).zip(all) {
            let apart = Matrix::from_fn(own.rows, own.cols, |i, j| own[(i, j)] - mean[(i, j)]);
            let [own, apart] = [own, &apart].map(|matrix| congruence(matrix, &vectors));
            let by_frequency = *scale != Scale::Mass;
            let weight = |k: usize| match by_frequency {
                true if is_rigid(values[k]) => 0.0,
                true => 1.0 / values[k].sqrt(),
                false => 1.0,
            };
            let norm = |matrix: &Matrix, of: &[usize], weight: &dyn Fn(usize) -> f64| -> f64 {
                let entries = of.iter().flat_map(|&i| of.iter().map(move |&j| (i, j)));
                entries
                    .map(|(i, j)| (weight(i) * matrix[(i, j)] * weight(j)).powi(2))
                    .sum::<f64>()
                    .sqrt()
            };
            let everything: Vec<usize> = (0..values.len()).collect();
            let whole = norm(&own, &everything, &weight);
            let share = if whole > 0.0 { norm(&apart, &everything, &weight) / whole } else { 0.0 };
            found.shares.push(share);
            // What damps a rigid motion less is rounding of what damps by stiffness.
            let rounding = rigid * norm(&own, &everything, &|_| 1.0);
            for cluster in &clusters {
                let square = values[cluster[0]];
                let one = |_: usize| 1.0;
                let size = match scale {
                    Scale::Mass => 1.0,
                    Scale::Stiffness if is_rigid(square) => continue,
                    Scale::Stiffness => square,
                    Scale::Itself if is_rigid(square) && norm(&own, cluster, &one) <= rounding => {
                        continue;
                    }
                    Scale::Itself => norm(&own, cluster, &one),
                };
                let left = norm(&apart, cluster, &one);
                // Of a difference of ±δ on the diagonal it is √2 δ.
                let splitting = if left > 0.0 { 2.0_f64.sqrt() * left / size } else { 0.0 };
                let at = hertz(square.max(0.0));
                if splitting > found.splitting {
                    (found.splitting, found.split) = (splitting, at);
                }
                if splitting >= ASYMMETRY {
                    found.first_split = Some(found.first_split.map_or(at, |own: f64| own.min(at)));
                }
            }
        }
        Ok(found)
    }
}

/// Share of the largest eigenvalue up to which ascending ones are those of rigid motions.
fn rigid_share(values: &[f64], largest: f64, free: bool) -> f64 {
    let is_last = |pair: &&[f64]| pair[0] <= FREE * largest && pair[1] > GAP * pair[0].max(0.0);
    let last = values.windows(2).rfind(is_last).filter(|_| free && largest > 0.0);
    last.map_or(RIGID, |pair| RIGID.max(pair[0] / largest))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of a stiffness is no mode of a body that nothing holds; a soft spring of one that is held is.
    #[test]
    fn rounding_of_a_stiffness_is_a_rigid_motion() {
        let values = [-3.0, 0.4, 4.7, 4.9e7, 4.9e7, 4.8e10];
        assert!(rigid_share(&values, 4.8e10, true) * 4.8e10 >= 4.7);
        assert_eq!(rigid_share(&values, 4.8e10, false), RIGID);
        // The lowest of many that follow each other is no gap.
        assert_eq!(rigid_share(&[4.7, 4e3, 4e6, 4.8e10], 4.8e10, true), RIGID);
    }
}
