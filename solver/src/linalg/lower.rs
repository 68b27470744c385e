use std::cmp::Ordering;

use crate::together::both;

/// A sparse symmetric matrix by its lower triangle, column after column (compressed).
#[derive(Debug, Clone, PartialEq)]
pub struct LowerTriangle {
    /// Number of rows and columns.
    pub size: usize,
    /// Where each column begins in `rows` and `values`; `size + 1` values.
    pub(crate) starts: Vec<usize>,
    /// Row of each value, ascending in a column, none above the diagonal.
    pub rows: Vec<usize>,
    /// The values.
    pub values: Vec<f64>,
}

impl LowerTriangle {
    /// From the entries (row, value) of each column; entries above the diagonal are left out.
    pub fn from_columns<'a, C>(size: usize, column: impl Fn(usize) -> C) -> Self
    where
        C: Iterator<Item = (usize, f64)> + 'a,
    {
        let mut starts = Vec::with_capacity(size + 1);
        starts.push(0);
        let mut lower = LowerTriangle { size, starts, rows: Vec::new(), values: Vec::new() };
        for j in 0..size {
            let start = lower.rows.len();
            for (i, value) in column(j).filter(|&(i, _)| i >= j) {
                lower.rows.push(i);
                lower.values.push(value);
            }
            lower.sort_from(start);
            lower.starts.push(lower.rows.len());
        }
        lower
    }

    /// Sorts what stands from a place on by its rows.
    fn sort_from(&mut self, start: usize) {
        let (rows, values) = (&mut self.rows[start..], &mut self.values[start..]);
        if rows.is_sorted() {
            return;
        }
        let mut entries: Vec<_> = rows.iter().copied().zip(values.iter().copied()).collect();
        entries.sort_unstable_by_key(|&(i, _)| i);
        for (place, (row, value)) in entries.into_iter().enumerate() {
            (rows[place], values[place]) = (row, value);
        }
    }

    /// The rows and columns `kept` (ascending) alone; `place`: where each row stands among them.
    pub(crate) fn block(
        &self,
        kept: &[usize],
        place: impl Fn(usize) -> Option<usize> + Sync,
    ) -> Self {
        let columns = |kept: &[usize]| {
            let count = kept.iter().map(|&j| self.starts[j + 1] - self.starts[j]).sum();
            let (mut ends, mut rows) = (Vec::with_capacity(kept.len()), Vec::with_capacity(count));
            let mut values = Vec::with_capacity(count);
            for &j in kept {
                for (row, value) in self.column(j) {
                    if let Some(row) = place(row) {
                        rows.push(row);
                        values.push(value);
                    }
                }
                ends.push(rows.len());
            }
            (ends, rows, values)
        };
        let (early, late) = kept.split_at(kept.len() / 2);
        let ((ends, mut rows, mut values), (late, more, others)) =
            both(|| columns(early), || columns(late));
        let first = rows.len();
        let starts = std::iter::once(0).chain(ends).chain(late.iter().map(|end| first + end));
        let starts = starts.collect();
        rows.extend(more);
        values.extend(others);
        LowerTriangle { size: kept.len(), starts, rows, values }
    }

    /// The entries (row, value) of column j, diagonal first where it is stored.
    #[inline(always)]
    pub fn column(&self, j: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.starts[j]..self.starts[j + 1];
        self.rows[range.clone()].iter().copied().zip(self.values[range].iter().copied())
    }

    /// Whether values stand at the same places.
    pub(crate) fn has_entries_of(&self, other: &LowerTriangle) -> bool {
        self.starts == other.starts && self.rows == other.rows
    }

    /// The diagonal; 0 where nothing is stored.
    pub fn diagonal(&self) -> Vec<f64> {
        (0..self.size)
            .map(|j| self.column(j).take_while(|&(i, _)| i == j).map(|(_, value)| value).sum())
            .collect()
    }

    /// A + α·B, on the union of both patterns.
    pub(crate) fn plus(&self, alpha: f64, other: &LowerTriangle) -> LowerTriangle {
        let mut sum = LowerTriangle {
            size: self.size,
            starts: vec![0],
            rows: Vec::with_capacity(self.rows.len()),
            values: Vec::with_capacity(self.rows.len()),
        };
        for j in 0..self.size {
            let (mut a, mut b) = (self.column(j).peekable(), other.column(j).peekable());
            loop {
                let order = match (a.peek(), b.peek()) {
                    (None, None) => break,
                    (Some(_), None) => Ordering::Less,
                    (None, Some(_)) => Ordering::Greater,
                    (Some(&(i, _)), Some(&(k, _))) => i.cmp(&k),
                };
                let mut entry = (0, 0.0);
                if order != Ordering::Greater {
                    entry = a.next().unwrap_or_default();
                }
                if order != Ordering::Less {
                    let (row, value) = b.next().unwrap_or_default();
                    entry = (row, entry.1 + alpha * value);
                }
                sum.rows.push(entry.0);
                sum.values.push(entry.1);
            }
            sum.starts.push(sum.rows.len());
        }
        sum
    }

    /// y = A x, for each column of `x` (columns of `size` values).
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        /// Columns that one pass over the matrix serves.
        const COLUMNS: usize = 8;
        let n = self.size;
        if x.is_empty() {
            return;
        }
        if x.len() == n {
            y.fill(0.0);
            return self.add_product::<1>(x.as_chunks().0, y.as_chunks_mut().0);
        }
        for (x, y) in x.chunks(COLUMNS * n).zip(y.chunks_mut(COLUMNS * n)) {
            let (mut from, mut to) = (vec![[0.0; COLUMNS]; n], vec![[0.0; COLUMNS]; n]);
            for (c, column) in x.chunks_exact(n).enumerate() {
                from.iter_mut().zip(column).for_each(|(row, &value)| row[c] = value);
            }
            self.add_product(&from, &mut to);
            for (c, column) in y.chunks_exact_mut(n).enumerate() {
                column.iter_mut().zip(&to).for_each(|(value, row)| *value = row[c]);
            }
        }
    }

    /// Adds A x to `y`, both a row of C columns after the other.
    #[inline(always)]
    pub(crate) fn add_product<const C: usize>(&self, x: &[[f64; C]], y: &mut [[f64; C]]) {
        for j in 0..self.size {
            let xj = x[j];
            let mut sum = [0.0; C];
            for (i, value) in self.column(j) {
                add_scaled(&mut sum, value, &x[i]);
                if i != j {
                    add_scaled(&mut y[i], value, &xj);
                }
            }
            add_scaled(&mut y[j], 1.0, &sum);
        }
    }
}

/// Adds a multiple of a row of columns.
#[inline(always)]
pub(crate) fn add_scaled<const C: usize>(sum: &mut [f64; C], factor: f64, x: &[f64; C]) {
    for (sum, x) in sum.iter_mut().zip(x) {
        *sum += factor * x;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lower(entries: &[&[(usize, f64)]]) -> LowerTriangle {
        LowerTriangle::from_columns(entries.len(), |j| entries[j].iter().copied())
    }

    #[test]
    fn sums_patterns_and_multiplies_by_both_triangles() {
        let a = lower(&[&[(2, 3.0), (0, 1.0)], &[(1, 2.0), (0, 9.0)], &[(2, 5.0)]]);
        let b = lower(&[&[(1, 1.0)], &[(1, 1.0)], &[]]);
        let c = a.plus(-2.0, &b);
        assert_eq!(c, lower(&[&[(0, 1.0), (1, -2.0), (2, 3.0)], &[(1, 0.0)], &[(2, 5.0)]]));
        assert_eq!(c.diagonal(), [1.0, 0.0, 5.0]);
        assert_eq!(b.diagonal(), [0.0, 1.0, 0.0]);
        let mut y = vec![0.0; 6];
        c.multiply(&[1.0, 2.0, 3.0, 0.0, 0.0, 1.0], &mut y);
        assert_eq!(y, [1.0 - 4.0 + 9.0, -2.0, 3.0 + 15.0, 3.0, 0.0, 5.0]);
        // More columns than one pass serves.
        let x: Vec<f64> = (0..33).map(f64::from).collect();
        let (mut all, mut single) = (vec![1.0; 33], vec![2.0; 3]);
        c.multiply(&x, &mut all);
        for (x, all) in x.chunks_exact(3).zip(all.chunks_exact(3)) {
            c.multiply(x, &mut single);
            assert_eq!(single, all);
        }
        let block = c.block(&[0, 2], |row| [Some(0), None, Some(1)][row]);
        assert_eq!(block, lower(&[&[(0, 1.0), (1, 3.0)], &[(1, 5.0)]]));
    }
}
