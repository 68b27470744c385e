//! The last few of many vectors, and the sum of them that is nearest to another one.

use serde::{Deserialize, Serialize};
use whirl_specs::columns::{add_matrix, add_products};

use crate::linalg::{dot, widely};

/// Vectors that are kept at most.
pub(super) const MOST: usize = 8;
/// Times as many unknowns as vectors at least: else their sum would be known by too little.
const UNKNOWNS: usize = 8;

/// Share of all squares by which the sum is held where a vector is zero.
const NOTHING: f64 = 1e-30;

/// One value a column.
pub(super) type Shares = [f64; MOST];

/// Vectors as columns, in a ring, with their weighed products with each other.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct KeptColumns {
    values: Vec<f64>,
    /// How many there is room for.
    count: usize,
    /// Share of the square of each vector by which their sum is held from growing where they are alike.
    held: f64,
    is_empty: bool,
    /// The column of the last vector.
    last: usize,
    products: [Shares; MOST],
}

impl KeptColumns {
    /// Zeros; at most `most` of them, at least `least`, by the number of unknowns. `held`: the share of the square of each by which
    /// their sum is held from growing where they are alike.
    pub(super) fn new(unknowns: usize, [least, most]: [usize; 2], held: f64) -> Self {
        debug_assert!(1 <= least && least <= most && most <= MOST, "{least} to {most} vectors");
        let count = (unknowns / UNKNOWNS).clamp(least, most);
        let products = [[0.0; MOST]; MOST];
        let values = vec![0.0; count * unknowns];
        KeptColumns { values, count, held, is_empty: true, last: 0, products }
    }

    /// Makes all of them zeros.
    pub(super) fn clear(&mut self) {
        self.values.fill(0.0);
        (self.is_empty, self.last, self.products) = (true, 0, [[0.0; MOST]; MOST]);
    }

    /// How many there is room for.
    pub(super) fn room(&self) -> usize {
        self.count
    }

    /// Whether none was taken.
    pub(super) fn is_empty(&self) -> bool {
        self.is_empty
    }

    /// Weighed products of a vector with itself and with the columns; `weights`: what squares are divided by.
    pub(super) fn products_with(
        &self,
        vector: &[f64],
        weights: &[f64],
        weighed: &mut [f64],
    ) -> (f64, Shares) {
        let square = square(vector, weights, weighed);
        let mut with = [0.0; MOST];
        add_products(&mut with[..self.count], &self.values, weighed);
        (square, with)
    }

    /// Takes a vector in place of the oldest one, by its products.
    pub(super) fn push(&mut self, vector: &[f64], (square, with): (f64, Shares)) {
        let last = (self.last + 1) % self.count;
        for (column, product) in with.into_iter().enumerate().take(self.count) {
            (self.products[last][column], self.products[column][last]) = (product, product);
        }
        self.products[last][last] = square;
        self.values[last * vector.len()..][..vector.len()].copy_from_slice(vector);
        (self.is_empty, self.last) = (false, last);
    }

    /// Adds Σ a_i c_i.
    pub(super) fn add(&self, shares: &Shares, out: &mut [f64]) {
        add_matrix(out, &self.values, &shares[..self.count]);
    }

    /// ‖c − Σ a_i c_i‖² of a vector by its products, and no less than rounding of large shares leaves.
    pub(super) fn distance(&self, (square, with): (f64, Shares), shares: &Shares) -> f64 {
        let shares = &shares[..self.count];
        let product = |x: &Shares| x.iter().zip(shares).map(|(x, a)| x * a).sum::<f64>();
        let own: f64 = self.products.iter().zip(shares).map(|(row, a)| a * product(row)).sum();
        let sizes = shares.iter().enumerate().map(|(i, a)| a.abs() * self.products[i][i].sqrt());
        let rounding = f64::EPSILON * sizes.sum::<f64>().powi(2);
        (square - 2.0 * product(&with) + own).max(rounding)
    }

    /// The shares of the sum that is nearest to a vector by its products; none where they are no numbers.
    pub(super) fn nearest(&self, with: &Shares) -> Option<Shares> {
        let count = self.count;
        let nothing = NOTHING * (0..count).map(|i| self.products[i][i]).sum::<f64>();
        let (mut a, mut x) = (self.products, *with);
        (0..count).for_each(|i| a[i][i] += self.held * a[i][i] + nothing);
        for i in 0..count {
            for j in i + 1..count {
                let factor = a[j][i] / a[i][i];
                (i..count).for_each(|k| a[j][k] -= factor * a[i][k]);
                x[j] -= factor * x[i];
            }
        }
        for i in (0..count).rev() {
            let known: f64 = (i + 1..count).map(|k| a[i][k] * x[k]).sum();
            x[i] = (x[i] - known) / a[i][i];
        }
        x[..count].iter().all(|own| own.is_finite()).then_some(x)
    }

    /// Shares by columns of those by age, the last vector first, or by age of those by columns.
    pub(super) fn turned(&self, shares: &Shares) -> Shares {
        let (last, count) = (self.last, self.count);
        let mut turned = [0.0; MOST];
        (0..count).for_each(|place| turned[place] = shares[(last + count - place) % count]);
        turned
    }
}

/// The weighed square of a vector, which leaves it weighed.
pub(super) fn square(vector: &[f64], weights: &[f64], weighed: &mut [f64]) -> f64 {
    let terms = weighed.iter_mut().zip(vector).zip(weights);
    widely(|| terms.for_each(|((weighed, own), weight)| *weighed = own / weight));
    dot(weighed, vector)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns of 40 unknowns, more than are kept, and weights.
    fn kept(vectors: &[Vec<f64>]) -> (KeptColumns, Vec<f64>) {
        let weights: Vec<f64> = (0..40).map(|i| 1.0 + 0.1 * f64::from(i)).collect();
        let mut own = KeptColumns::new(40, [1, 3], 1e-12);
        for vector in vectors {
            let products = own.products_with(vector, &weights, &mut [0.0; 40]);
            own.push(vector, products);
        }
        (own, weights)
    }

    fn vector(seed: f64) -> Vec<f64> {
        (0..40).map(|i| (seed * f64::from(i + 1)).sin()).collect()
    }

    #[test]
    fn a_sum_of_the_last_ones_is_found_again() {
        let vectors: Vec<_> = [0.3, 0.7, 1.1, 1.7, 2.3].map(vector).into();
        let (own, weights) = kept(&vectors);
        let shares = own.turned(&[3.0, -2.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0]);
        let mut sum = vec![0.0; 40];
        own.add(&shares, &mut sum);
        for (i, sum) in sum.iter().enumerate() {
            let exact = 3.0 * vectors[4][i] - 2.0 * vectors[3][i] + 0.5 * vectors[2][i];
            assert!((sum - exact).abs() < 1e-14);
        }
        let products = own.products_with(&sum, &weights, &mut [0.0; 40]);
        let found = own.nearest(&products.1).expect("numbers");
        for (found, share) in own.turned(&found).iter().zip([3.0, -2.0, 0.5]) {
            assert!((found - share).abs() < 1e-9, "{found} for {share}");
        }
        assert!(own.distance(products, &found).abs() < 1e-9 * products.0);
    }

    /// The nearest sum leaves what is at right angles to all.
    #[test]
    fn what_no_sum_gives_is_left() {
        let (own, weights) = kept(&[0.3, 0.7, 1.1].map(vector));
        let products = own.products_with(&vector(1.9), &weights, &mut [0.0; 40]);
        let shares = own.nearest(&products.1).expect("numbers");
        let mut rest = vec![0.0; 40];
        own.add(&shares, &mut rest);
        rest.iter_mut().zip(vector(1.9)).for_each(|(rest, own)| *rest = own - *rest);
        let (square, with) = own.products_with(&rest, &weights, &mut [0.0; 40]);
        assert!(with.iter().all(|product| product.abs() < 1e-9 * products.0), "{with:?}");
        assert!((own.distance(products, &shares) / square - 1.0).abs() < 1e-9);
    }

    #[test]
    fn alike_ones_and_none_have_small_shares() {
        let (own, weights) = kept(&[vector(0.3), vector(0.3), vector(0.3)]);
        let products = own.products_with(&vector(0.3), &weights, &mut [0.0; 40]);
        let shares = own.nearest(&products.1).expect("numbers");
        assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-3, "{shares:?}");
        assert_eq!(KeptColumns::new(40, [1, 3], 1e-12).nearest(&[0.0; MOST]), None);
        let (one, weights) = kept(&[vector(0.3)]);
        let products = one.products_with(&vector(0.3), &weights, &mut [0.0; 40]);
        let shares = one.turned(&one.nearest(&products.1).expect("numbers"));
        assert!((shares[0] - 1.0).abs() < 1e-9 && shares[1..].iter().all(|own| *own == 0.0));
    }
}
