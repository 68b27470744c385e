use std::cmp::Ordering;

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
        let mut lower =
            LowerTriangle { size, starts: vec![0], rows: Vec::new(), values: Vec::new() };
        let mut entries: Vec<(usize, f64)> = Vec::new();
        for j in 0..size {
            entries.clear();
            entries.extend(column(j).filter(|&(i, _)| i >= j));
            entries.sort_unstable_by_key(|&(i, _)| i);
            lower.rows.extend(entries.iter().map(|&(i, _)| i));
            lower.values.extend(entries.iter().map(|&(_, value)| value));
            lower.starts.push(lower.rows.len());
        }
        lower
    }

    /// The entries (row, value) of column j, diagonal first where it is stored.
    #[inline(always)]
    pub fn column(&self, j: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let range = self.starts[j]..self.starts[j + 1];
        self.rows[range.clone()].iter().copied().zip(self.values[range].iter().copied())
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
        let n = self.size;
        for (x, y) in x.chunks_exact(n).zip(y.chunks_exact_mut(n)) {
            y.fill(0.0);
            for j in 0..n {
                let (xj, mut sum) = (x[j], 0.0);
                for (i, value) in self.column(j) {
                    if i == j {
                        sum += value * xj;
                    } else {
                        y[i] += value * xj;
                        sum += value * x[i];
                    }
                }
                y[j] += sum;
            }
        }
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
    }
}
