//! A constant matrix times a vector in few operations: shape functions that are products of functions of one
//! coordinate make its rows alike group by group, so that sums over a group serve many rows.

use proc_macro2::TokenStream;
use quote::{format_ident, quote};

use crate::emit::number;

/// How the rows follow from the entries of the vector.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Linear {
    /// Value `columns + i` is `value[first] + factor · value[second]`; the values before are the vector's.
    pub(super) steps: Vec<Step>,
    /// A row is `scale · value`; absent where all its coefficients are zero.
    pub(super) rows: Vec<Option<(usize, f64)>>,
}

/// One multiply-add.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    pub(super) first: usize,
    pub(super) second: usize,
    pub(super) factor: f64,
}

/// Ratios that differ by no more, relative to 1, are the same number rounded in two ways.
const SAME: f64 = 8.0 * f64::EPSILON;

/// Most steps written one after the other; beyond that a loop is smaller and as fast.
const MOST: usize = 150;

impl Linear {
    /// The matrix (rows × columns) in steps, if that takes at most three quarters of its entries.
    pub(super) fn new(matrix: &[Vec<f64>]) -> Option<Self> {
        let columns = matrix.first()?.len();
        let mut linear = Linear { steps: Vec::new(), rows: vec![None; matrix.len()] };
        let rows = matrix.iter().enumerate().map(|(place, row)| Row { place, row: row.clone() });
        linear.sum((0..columns).collect(), rows.collect(), columns);
        let operations = linear.steps.len() + matrix.len();
        let fewer = 4 * operations < 3 * matrix.len() * columns && linear.steps.len() <= MOST;
        fewer.then_some(linear)
    }

    /// The steps and the rows over lanes; `entry`: text of an entry of the vector, which has `columns`.
    pub(super) fn numbers(
        &self,
        columns: usize,
        entry: impl Fn(usize) -> TokenStream,
    ) -> (TokenStream, Vec<TokenStream>) {
        let step = |first: TokenStream, second: TokenStream, factor: TokenStream| quote!(#second.mul_add(L::splat(#factor), #first));
        self.text(columns, entry, step, |value, scale| quote!(#value * (#scale)))
    }

    /// The same where an entry is a vector of three lanes.
    pub(super) fn vectors(
        &self,
        columns: usize,
        entry: impl Fn(usize) -> TokenStream,
    ) -> (TokenStream, Vec<TokenStream>) {
        let step = |first: TokenStream, second: TokenStream, factor: TokenStream| quote!(cells::add_scaled(#first, #second, #factor));
        self.text(columns, entry, step, |value, scale| quote!(cells::scaled(#value, #scale)))
    }

    fn text(
        &self,
        columns: usize,
        entry: impl Fn(usize) -> TokenStream,
        step: impl Fn(TokenStream, TokenStream, TokenStream) -> TokenStream,
        scaled: impl Fn(TokenStream, TokenStream) -> TokenStream,
    ) -> (TokenStream, Vec<TokenStream>) {
        let value = |id: usize| match id.checked_sub(columns) {
            Some(place) => {
                let name = format_ident!("part_{place}");
                quote!(#name)
            }
            None => entry(id),
        };
        let steps = self.steps.iter().enumerate().map(|(place, s)| {
            let name = format_ident!("part_{place}");
            let text = step(value(s.first), value(s.second), number(s.factor));
            quote!(let #name = #text;)
        });
        let steps = steps.collect();
        let rows = self.rows.iter().map(|row| match row {
            Some((id, scale)) => scaled(value(*id), number(*scale)),
            None => scaled(value(0), number(0.0)),
        });
        (steps, rows.collect())
    }

    /// Multiplications and additions.
    pub(super) fn flops(&self) -> usize {
        2 * self.steps.len() + self.rows.len()
    }

    /// Adds the steps for rows over the values `ids`; `columns`: length of the vector.
    fn sum(&mut self, ids: Vec<usize>, rows: Vec<Row>, columns: usize) {
        if let [id] = ids[..] {
            for Row { place, row } in rows {
                self.rows[place] = (row[0] != 0.0).then_some((id, row[0]));
            }
            return;
        }
        let trial = |size: usize| {
            let mut trial = self.clone();
            trial.sum_groups(size, &ids, &rows, columns);
            trial
        };
        let sizes = (2..=ids.len()).filter(|size| ids.len().is_multiple_of(*size));
        if let Some(best) = sizes.map(trial).min_by_key(|trial| trial.steps.len()) {
            *self = best;
        }
    }

    /// The same with the values in groups of `size`.
    fn sum_groups(&mut self, size: usize, ids: &[usize], rows: &[Row], columns: usize) {
        let groups: Vec<&[usize]> = ids.chunks(size).collect();
        // The values of each group that are known, by their ratios.
        let mut known: Vec<Vec<(Vec<f64>, usize)>> = vec![Vec::new(); groups.len()];
        let mut classes: Vec<(Vec<usize>, Vec<Row>)> = Vec::new();
        for Row { place, row } in rows.iter().cloned() {
            let (mut values, mut scales) = (Vec::new(), Vec::new());
            for ((group, known), row) in groups.iter().zip(&mut known).zip(row.chunks(size)) {
                let Some(leading) = row.iter().position(|c| *c != 0.0) else {
                    // Nothing of this group: any of its values, times zero.
                    values.push(group[0]);
                    scales.push(0.0);
                    continue;
                };
                let ratios: Vec<f64> = row.iter().map(|c| c / row[leading]).collect();
                let found = known.iter().find(|(other, _)| same(other, &ratios));
                let value = match found {
                    Some((_, value)) => *value,
                    None => {
                        let mut value = group[leading];
                        for (id, factor) in group.iter().zip(&ratios).skip(leading + 1) {
                            if *factor != 0.0 {
                                let step = Step { first: value, second: *id, factor: *factor };
                                self.steps.push(step);
                                value = columns + self.steps.len() - 1;
                            }
                        }
                        known.push((ratios, value));
                        value
                    }
                };
                values.push(value);
                scales.push(row[leading]);
            }
            let row = Row { place, row: scales };
            match classes.iter_mut().find(|(ids, _)| *ids == values) {
                Some((_, rows)) => rows.push(row),
                None => classes.push((values, vec![row])),
            }
        }
        for (ids, rows) in classes {
            self.sum(ids, rows, columns);
        }
    }
}

#[derive(Debug, Clone)]
struct Row {
    place: usize,
    row: Vec<f64>,
}

fn same(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SAME * a.abs().max(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn times(linear: &Linear, x: &[f64]) -> Vec<f64> {
        let mut values = x.to_vec();
        for step in &linear.steps {
            values.push(values[step.first] + step.factor * values[step.second]);
        }
        linear.rows.iter().map(|row| row.map_or(0.0, |(id, scale)| scale * values[id])).collect()
    }

    #[test]
    fn a_product_of_three_directions_is_summed_one_at_a_time() {
        let line = [[0.6, 0.4], [0.5, 0.5], [0.1, 0.9]];
        let entry = |r: usize, q: usize| {
            [0, 1, 2].map(|k| line[r / 3_usize.pow(k) % 3][q >> k & 1]).iter().product::<f64>()
        };
        let matrix: Vec<Vec<f64>> =
            (0..27).map(|r| (0..8).map(|q| entry(r, q)).collect()).collect();
        let linear = Linear::new(&matrix).expect("fewer operations");
        assert_eq!(linear.steps.len(), 12 + 18 + 27);
        let x = [0.3, -1.2, 0.7, 2.0, -0.4, 1.1, 0.9, -0.6];
        for (found, row) in times(&linear, &x).iter().zip(&matrix) {
            let expected: f64 = row.iter().zip(&x).map(|(a, x)| a * x).sum();
            // Eight terms of size 1, each with some roundings.
            assert!((found - expected).abs() < 8.0 * 8.0 * f64::EPSILON, "{found} {expected}");
        }
    }

    #[test]
    fn zeros_cost_nothing() {
        let matrix = vec![
            vec![1.0, -1.0, 0.0, 0.0],
            vec![2.0, -2.0, 0.0, 0.0],
            vec![0.0, 0.0, 0.0, 3.0],
            vec![0.0; 4],
            vec![1.0, -1.0, 0.0, 3.0],
        ];
        let linear = Linear::new(&matrix).expect("fewer operations");
        let x = [5.0, 3.0, 7.0, 1.0];
        assert_eq!(times(&linear, &x), [2.0, 4.0, 3.0, 0.0, 5.0]);
    }

    #[test]
    fn a_matrix_without_structure_stays_one() {
        let matrix: Vec<Vec<f64>> =
            (0..9).map(|r| (0..5).map(|c| (1.7 * (5 * r + c) as f64).sin()).collect()).collect();
        assert_eq!(Linear::new(&matrix), None);
    }
}
