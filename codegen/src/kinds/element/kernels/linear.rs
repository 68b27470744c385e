//! A constant matrix times a vector in few operations: shape functions that are products of functions of one
//! coordinate make its rows alike group by group, so that sums over a group serve many rows.

use proc_macro2::TokenStream;
use quote::{ToTokens, format_ident, quote};

use crate::emit::{Value, Work, number};

/// How the rows follow from the entries of the vector. In every sum the coefficient of largest size is 1, of two
/// such the positive one: what is left to scale rows with then takes few values, often one.
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
        let few = (3 * matrix.len() * columns).saturating_sub(4 * matrix.len()).div_ceil(4);
        let mut search = Search { columns, steps: Vec::new(), rows: Vec::new() };
        let rows: Vec<Row> = (matrix.iter().enumerate())
            .map(|(place, row)| Row { place, row: row.clone() })
            .collect();
        let ids: Vec<usize> = (0..columns).collect();
        if !search.sum(&ids, &rows, few.min(MOST + 1)) {
            return None;
        }
        let mut linear = Linear { steps: search.steps, rows: vec![None; matrix.len()] };
        search.rows.into_iter().for_each(|(place, row)| linear.rows[place] = row);
        Some(linear)
    }

    /// The steps and the rows over lanes; `entry`: text of an entry of the vector, which has `columns`.
    pub(super) fn work(
        &self,
        columns: usize,
        entry: impl Fn(usize) -> TokenStream,
    ) -> (Work, Vec<Value>) {
        let name = |place: usize| format_ident!("part_{place}").to_token_stream();
        let value =
            |id: usize| Value::free(id.checked_sub(columns).map_or_else(|| entry(id), name));
        let mut steps = Work::new();
        for (place, step) in self.steps.iter().enumerate() {
            let (first, second) = (value(step.first), value(step.second));
            let factor = number(step.factor);
            let sum = match step.factor {
                1.0 => first + second,
                -1.0 => first - second,
                _ => second.mul_add(Value::free(quote!(L::splat(#factor))), first),
            };
            steps.bind(name(place), sum);
        }
        let rows = self.rows.iter().map(|row| match row {
            Some((id, 1.0)) => value(*id),
            Some((id, scale)) => {
                let scale = number(*scale);
                value(*id) * Value::free(quote!((#scale)))
            }
            None => Value::free(quote!(L::splat(0.0))),
        });
        (steps, rows.collect())
    }

    /// The scale that all rows have in common, if it is positive; they are left without it.
    pub(super) fn take_scale(&mut self) -> Option<f64> {
        let (_, common) = (*self.rows.first()?)?;
        let alike = |row: &Option<(usize, f64)>| row.is_some_and(|(_, s)| same(&[s], &[common]));
        if common <= 0.0 || !self.rows.iter().all(alike) {
            return None;
        }
        self.rows.iter_mut().flatten().for_each(|(_, scale)| *scale = 1.0);
        Some(common)
    }

    /// The largest scale of a row, by which all are divided: rows that have it are left without one.
    pub(super) fn take_largest(&mut self) -> f64 {
        let largest = self.rows.iter().flatten().fold(0.0, |l: f64, (_, scale)| l.max(scale.abs()));
        if largest == 0.0 {
            return 1.0;
        }
        self.rows.iter_mut().flatten().for_each(|(_, scale)| *scale = unit(*scale / largest));
        largest
    }
}

/// Steps and rows so far; what a trial adds to them is taken off again.
struct Search {
    /// Length of the vector.
    columns: usize,
    steps: Vec<Step>,
    /// Places of rows, and what they are.
    rows: Vec<(usize, Option<(usize, f64)>)>,
}

impl Search {
    /// Adds the steps for rows over the values `ids` and says whether all steps are then fewer than `limit`;
    /// if not, what was added is of no use.
    fn sum(&mut self, ids: &[usize], rows: &[Row], mut limit: usize) -> bool {
        if let [id] = *ids {
            let row = |row: &Row| (row.place, (row.row[0] != 0.0).then_some((id, row.row[0])));
            self.rows.extend(rows.iter().map(row));
            return self.steps.len() < limit;
        }
        let before = (self.steps.len(), self.rows.len());
        let mut best = None;
        for size in (2..=ids.len()).filter(|size| ids.len().is_multiple_of(*size)) {
            let fewer = self.sum_groups(size, ids, rows, limit);
            let all = self.steps.len();
            let added = (self.steps.split_off(before.0), self.rows.split_off(before.1));
            if fewer {
                (limit, best) = (all, Some(added));
            }
        }
        let Some((steps, rows)) = best else { return false };
        self.steps.extend(steps);
        self.rows.extend(rows);
        true
    }

    /// The same with the values in groups of `size`.
    fn sum_groups(&mut self, size: usize, ids: &[usize], rows: &[Row], limit: usize) -> bool {
        let groups: Vec<&[usize]> = ids.chunks(size).collect();
        // The values of each group that are known, by their ratios.
        let mut known: Vec<Vec<(Vec<f64>, usize)>> = vec![Vec::new(); groups.len()];
        let mut classes: Vec<(Vec<usize>, Vec<Row>)> = Vec::new();
        for Row { place, row } in rows {
            let mut values = Vec::with_capacity(groups.len());
            let mut scales = Vec::with_capacity(groups.len());
            for ((group, known), row) in groups.iter().zip(&mut known).zip(row.chunks(size)) {
                let Some(leading) = leading(row) else {
                    // Nothing of this group: any of its values, times zero.
                    values.push(group[0]);
                    scales.push(0.0);
                    continue;
                };
                let ratios: Vec<f64> = row.iter().map(|c| unit(c / row[leading])).collect();
                let found = known.iter().find(|(other, _)| same(other, &ratios));
                let value = match found {
                    Some((_, value)) => *value,
                    None => {
                        let value = self.combine(group, leading, &ratios);
                        if self.steps.len() >= limit {
                            return false;
                        }
                        known.push((ratios, value));
                        value
                    }
                };
                values.push(value);
                scales.push(row[leading]);
            }
            let row = Row { place: *place, row: scales };
            match classes.iter_mut().find(|(ids, _)| *ids == values) {
                Some((_, rows)) => rows.push(row),
                None => classes.push((values, vec![row])),
            }
        }
        classes.iter().all(|(ids, rows)| self.sum(ids, rows, limit)) && self.steps.len() < limit
    }

    /// The value Σ ratio · value over a group, in steps from the one whose ratio is 1.
    fn combine(&mut self, group: &[usize], leading: usize, ratios: &[f64]) -> usize {
        let mut value = group[leading];
        for (place, (id, factor)) in group.iter().zip(ratios).enumerate() {
            if place != leading && *factor != 0.0 {
                self.steps.push(Step { first: value, second: *id, factor: *factor });
                value = self.columns + self.steps.len() - 1;
            }
        }
        value
    }
}

struct Row {
    place: usize,
    row: Vec<f64>,
}

/// Place of the coefficient of largest size, of two such the positive one; none where all are zero.
fn leading(row: &[f64]) -> Option<usize> {
    let largest = row.iter().fold(0.0, |largest: f64, c| largest.max(c.abs()));
    let large = |c: &f64| *c != 0.0 && c.abs() >= largest * (1.0 - SAME);
    let positive = row.iter().position(|c| large(c) && *c > 0.0);
    positive.or_else(|| row.iter().position(large))
}

/// ±1 where a ratio is that but for rounding.
fn unit(ratio: f64) -> f64 {
    if same(&[ratio.abs()], &[1.0]) { ratio.signum() } else { ratio }
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
    fn rows_that_differ_by_signs_and_order_have_one_scale() {
        // The tangents of a brick at its Gauss points: −1, 1 along one direction, interpolated along the others.
        let (near, far) = (0.8, 0.2);
        let coefficient = |direction: usize, point: usize, node: usize, k: usize| {
            let [node, point] = [node, point].map(|place| place >> k & 1);
            match k == direction {
                true => [-1.0, 1.0][node],
                false => [far, near][usize::from(node == point)],
            }
        };
        let mut matrix: Vec<Vec<f64>> = Vec::new();
        for direction in 0..3 {
            for point in (0..8).filter(|point| point >> direction & 1 == 0) {
                let row = |node| (0..3).map(|k| coefficient(direction, point, node, k)).product();
                matrix.push((0..8).map(row).collect());
            }
        }
        let mut linear = Linear::new(&matrix).expect("fewer operations");
        assert_eq!(linear.steps.len(), 40);
        let x = [0.3, -1.2, 0.7, 2.0, -0.4, 1.1, 0.9, -0.6];
        let before = times(&linear, &x);
        let scale = linear.take_scale().expect("one of all");
        assert!((scale - near * near).abs() < 4.0 * f64::EPSILON);
        assert!(linear.rows.iter().all(|row| row.is_some_and(|(_, scale)| scale == 1.0)));
        let found = times(&linear, &x).into_iter().map(|value| value * scale);
        for ((found, before), row) in found.zip(before).zip(&matrix) {
            let expected: f64 = row.iter().zip(&x).map(|(a, x)| a * x).sum();
            // Eight terms of size 1, each with some roundings; the scales differ in their last digit.
            assert!((found - expected).abs() < 8.0 * 8.0 * f64::EPSILON, "{found} {expected}");
            assert!((found - before).abs() <= 16.0 * f64::EPSILON * before.abs());
        }
    }

    #[test]
    fn rows_of_different_scales_keep_them() {
        let mut linear = Linear::new(&[vec![1.0; 6], vec![2.0; 6]]).expect("fewer operations");
        assert_eq!(linear.take_scale(), None);
        assert_eq!(times(&linear, &[1.0; 6]), [6.0, 12.0]);
        assert_eq!(linear.take_largest(), 2.0);
        assert_eq!(times(&linear, &[1.0; 6]), [3.0, 6.0]);
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
