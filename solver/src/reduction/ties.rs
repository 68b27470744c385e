//! Ties between dofs: equations Σ cᵢ uᵢ = 0 that a mesh brings along, eliminated before anything is solved.
//!
//! u = T û, with û the dofs that no equation is solved for; K becomes TᵀKT, and M likewise. All keep the numbering of the
//! mesh: rows and columns of dependent dofs are zero, and stay in the graph, so that what was joined is joined.
//!
//! T is kept as equations that are put in one after the other. Multiplied out, each of 3m dofs of a rigid part that follows
//! the mean of n nodes would have 3n terms; so only the six do by which the others are said.

use std::collections::{BTreeMap, BTreeSet};

use crate::linalg::{LinearAlgebraError, LowerTriangle, Matrix};

use crate::sparse::Row;

/// What is left of an equation after elimination counts as zero below this part of its largest coefficient: a few hundred
/// roundings.
const ROUNDING: f64 = 1e-13;
/// An equation of which less than this part is left follows from the others: files have coefficients of six digits and more. Taken
/// by its word it would hold what the others leave free.
const FOLLOWS: f64 = 1e-5;
/// The first dof of an equation depends on the others unless its coefficient is smaller than this part of the largest, so
/// that no term is larger than ten. A mean of n nodes solved for one of these would have terms of n, and the roundings of K
/// would grow by n².
const PREFERRED: f64 = 0.1;
/// Bytes of an entry of TᵀAT, a number and its row, in two matrices, one of which is copied as it grows.
const BYTES: usize = 4 * (size_of::<f64>() + size_of::<usize>());

/// Equations solved for dofs: u = T û.
#[derive(Debug, Clone)]
pub(crate) struct Tied {
    /// Dofs that depend on others, ascending.
    pub(super) dependent: Vec<usize>,
    /// Each of them, and what it is over dofs for which neither this equation nor an earlier one is solved.
    solved: Vec<(usize, Row)>,
    /// Place among `solved` of every dof, or `usize::MAX`.
    place: Vec<usize>,
}

impl Tied {
    /// Solves equations between `dofs` dofs, of which `held` are zero; `None` where there are none. An equation that
    /// follows from others adds nothing.
    ///
    /// # Panics
    /// If an equation or what is held names a dof that is not there.
    pub(crate) fn new(dofs: usize, equations: &[Row], held: &[usize]) -> Option<Tied> {
        if equations.is_empty() {
            return None;
        }
        let mut still = vec![false; dofs];
        held.iter().for_each(|&dof| still[dof] = true);
        let mut tied =
            Tied { dependent: Vec::new(), solved: Vec::new(), place: vec![usize::MAX; dofs] };
        // Short ones first: what a long one is solved for stands in no other.
        let mut ordered: Vec<&Row> = equations.iter().collect();
        ordered.sort_by_key(|equation| equation.len());
        for equation in ordered {
            let scale = equation.iter().fold(0.0, |most: f64, (_, c)| most.max(c.abs()));
            let mut row = tied.free(equation.iter().copied().filter(|(dof, _)| !still[*dof]));
            row.retain(|_, c| c.abs() > ROUNDING * scale);
            let largest =
                row.iter().fold(None, |best: Option<(usize, f64)>, (&dof, &c)| match best {
                    Some((_, most)) if most.abs() >= c.abs() => best,
                    _ => Some((dof, c)),
                });
            let Some((mut pivot, most)) = largest.filter(|(_, most)| most.abs() > FOLLOWS * scale)
            else {
                continue;
            };
            let first = equation[0].0;
            if row.get(&first).is_some_and(|c| c.abs() >= PREFERRED * most.abs()) {
                pivot = first;
            }
            let leading = row.remove(&pivot).expect("it is one of the row's");
            tied.place[pivot] = tied.solved.len();
            tied.solved
                .push((pivot, row.into_iter().map(|(dof, c)| (dof, -c / leading)).collect()));
        }
        tied.dependent = (0..dofs).filter(|&dof| tied.depends(dof)).collect();
        Some(tied)
    }

    fn depends(&self, dof: usize) -> bool {
        self.place[dof] != usize::MAX
    }

    /// Σ cᵢ uᵢ over dofs that are free.
    fn free(&self, terms: impl Iterator<Item = (usize, f64)>) -> BTreeMap<usize, f64> {
        let mut own: BTreeMap<usize, f64> = BTreeMap::new();
        terms.for_each(|(dof, c)| *own.entry(dof).or_insert(0.0) += c);
        let mut due: BTreeSet<usize> =
            own.keys().map(|&dof| self.place[dof]).filter(|&place| place != usize::MAX).collect();
        // What is put in names only those that come later.
        while let Some(place) = due.pop_first() {
            let (dof, terms) = &self.solved[place];
            let Some(factor) = own.remove(dof) else { continue };
            for &(other, c) in terms {
                *own.entry(other).or_insert(0.0) += factor * c;
                if self.depends(other) {
                    due.insert(self.place[other]);
                }
            }
        }
        own
    }

    /// TᵀAT of a symmetric matrix, column after column.
    ///
    /// # Errors
    /// [`LinearAlgebraError::TooLarge`] if it would need more than `memory` bytes, with about so many as it would.
    pub(crate) fn matrix(
        &self,
        whole: &LowerTriangle,
        memory: usize,
    ) -> Result<LowerTriangle, LinearAlgebraError> {
        let size = whole.size;
        let upper = Upper::of(whole);
        // What depends on each dof, with its coefficient.
        let mut names: Vec<Row> = vec![Vec::new(); size];
        for (place, (_, terms)) in self.solved.iter().enumerate() {
            terms.iter().for_each(|&(dof, c)| names[dof].push((place, c)));
        }
        let beside = |dof: usize| whole.column(dof).chain(upper.row(dof));
        let changes: Vec<bool> = (0..size)
            .map(|dof| !names[dof].is_empty() || beside(dof).any(|(other, _)| self.depends(other)))
            .collect();
        let mut own = LowerTriangle { size, starts: vec![0], rows: Vec::new(), values: Vec::new() };
        let (mut x, mut y) = (Sums::new(size), Sums::new(size));
        let mut entries: Row = Vec::new();
        for (j, &changed) in changes.iter().enumerate() {
            entries.clear();
            if self.depends(j) {
                entries.extend(whole.column(j).map(|(i, _)| (i, 0.0)));
            } else if changed {
                self.column_of_t(j, &names, &mut x);
                for &dof in &x.rows {
                    beside(dof).for_each(|(i, value)| y.add(i, value * x.values[dof]));
                }
                self.transposed(&mut y);
                let free = y.rows.iter().filter(|&&i| i >= j && !self.depends(i));
                entries.extend(free.map(|&i| (i, y.values[i])));
                let joined = whole.column(j).filter(|&(i, _)| self.depends(i));
                entries.extend(joined.map(|(i, _)| (i, 0.0)));
                entries.sort_unstable_by_key(|&(i, _)| i);
                x.clear();
                y.clear();
            } else {
                entries.extend(whole.column(j));
            }
            let bytes = BYTES.saturating_mul(own.rows.len() + entries.len());
            if bytes > memory {
                // The others will need as much each.
                let bytes = (bytes / (j + 1)).saturating_mul(size);
                return Err(LinearAlgebraError::TooLarge { size, bytes, limit: memory });
            }
            own.rows.extend(entries.iter().map(|&(i, _)| i));
            own.values.extend(entries.iter().map(|&(_, value)| value));
            own.starts.push(own.rows.len());
        }
        Ok(own)
    }

    /// T of a unit of a free dof: that dof, and all that depends on it.
    fn column_of_t(&self, dof: usize, names: &[Row], x: &mut Sums) {
        x.add(dof, 1.0);
        let mut due: BTreeSet<usize> = BTreeSet::new();
        let mut next = dof;
        loop {
            for &(place, c) in &names[next] {
                x.add(self.solved[place].0, c * x.values[next]);
                due.insert(place);
            }
            // All that it names come later, and are known.
            let Some(place) = due.pop_last() else { break };
            next = self.solved[place].0;
        }
    }

    /// Tᵀ of forces; nothing is left on dependent dofs.
    fn transposed(&self, y: &mut Sums) {
        let places = y.rows.iter().map(|&dof| self.place[dof]);
        let mut due: BTreeSet<usize> = places.filter(|&place| place != usize::MAX).collect();
        while let Some(place) = due.pop_first() {
            let (dof, terms) = &self.solved[place];
            let force = std::mem::take(&mut y.values[*dof]);
            for &(other, c) in terms {
                y.add(other, c * force);
                if self.depends(other) {
                    due.insert(self.place[other]);
                }
            }
        }
    }

    /// Tᵀ of a motion Σ cᵢ uᵢ, or of a load.
    pub(crate) fn row(&self, row: &Row) -> Row {
        if !row.iter().any(|(dof, _)| self.depends(*dof)) {
            return row.clone();
        }
        let scale = row.iter().fold(0.0, |most: f64, (_, c)| most.max(c.abs()));
        let own = self.free(row.iter().copied());
        own.into_iter().filter(|(_, c)| c.abs() > ROUNDING * scale).collect()
    }

    /// Tᵀ of forces on all dofs.
    pub(super) fn forces(&self, force: &[f64]) -> Vec<f64> {
        let mut own = force.to_vec();
        for (dof, terms) in &self.solved {
            let force = std::mem::take(&mut own[*dof]);
            terms.iter().for_each(|&(other, by)| own[other] += by * force);
        }
        own
    }

    /// Puts into columns of displacements what depends on the others.
    pub(super) fn expand(&self, shapes: &mut Matrix) {
        for column in shapes.data.chunks_exact_mut(self.place.len()) {
            for (dof, terms) in self.solved.iter().rev() {
                column[*dof] = terms.iter().map(|&(other, by)| by * column[other]).sum();
            }
        }
    }
}

/// A column of numbers of which most are zero.
struct Sums {
    values: Vec<f64>,
    stands: Vec<bool>,
    /// Where numbers stand, in the order in which they came.
    rows: Vec<usize>,
}

impl Sums {
    fn new(size: usize) -> Sums {
        Sums { values: vec![0.0; size], stands: vec![false; size], rows: Vec::new() }
    }

    fn add(&mut self, row: usize, value: f64) {
        if !std::mem::replace(&mut self.stands[row], true) {
            self.rows.push(row);
        }
        self.values[row] += value;
    }

    fn clear(&mut self) {
        for row in self.rows.drain(..) {
            self.values[row] = 0.0;
            self.stands[row] = false;
        }
    }
}

/// What stands above the diagonal of a symmetric matrix, column after column.
struct Upper {
    starts: Vec<usize>,
    entries: Row,
}

impl Upper {
    fn of(lower: &LowerTriangle) -> Upper {
        let mut starts = vec![0; lower.size + 1];
        let below = |j: usize| lower.column(j).filter(move |&(i, _)| i > j);
        (0..lower.size).flat_map(below).for_each(|(i, _)| starts[i + 1] += 1);
        (0..lower.size).for_each(|i| starts[i + 1] += starts[i]);
        let mut next = starts.clone();
        let mut entries = vec![(0, 0.0); starts[lower.size]];
        for j in 0..lower.size {
            for (i, value) in below(j) {
                entries[next[i]] = (j, value);
                next[i] += 1;
            }
        }
        Upper { starts, entries }
    }

    fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        self.entries[self.starts[row]..self.starts[row + 1]].iter().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain, a circle that closes on itself, an equation that stands twice, and one with a held dof.
    fn equations() -> Vec<Row> {
        vec![
            vec![(0, 1.0), (1, -2.0), (6, 5.0)],
            vec![(1, 1.0), (2, -0.5), (3, 0.25)],
            vec![(2, -0.5), (1, 1.0), (3, 0.25)],
            vec![(4, 1e-3), (5, 1.0), (0, 3.0)],
        ]
    }

    /// Of a mean over six dofs, written once more with the digits of a file, nothing is left; a small coefficient counts.
    #[test]
    fn an_equation_that_follows_to_six_digits_adds_nothing() {
        let mean =
            |share: f64| [vec![(0, -1.0)], (1..7).map(|dof| (dof, share)).collect()].concat();
        let weak = vec![(7, 1.0), (8, -1.0), (9, 1e-7)];
        let rows = [mean(1.0 / 6.0), mean(0.166667), mean(0.1666667), weak.clone(), weak];
        let tied = Tied::new(10, &rows, &[]).expect("equations");
        assert_eq!(tied.dependent, [0, 7]);
        let mut u = Matrix::from_fn(10, 1, |i, _| (1.3 * i as f64).sin());
        u.data[9] = 1e3;
        tied.expand(&mut u);
        assert!((u.data[7] - (u.data[8] - 1e-4)).abs() < 1e-15, "{:?}", u.data);
    }

    #[test]
    fn every_equation_holds_whatever_the_free_dofs_are() {
        let tied = Tied::new(8, &equations(), &[6]).expect("equations");
        assert_eq!(tied.dependent, [0, 1, 2]);
        let mut u =
            Matrix { rows: 8, cols: 1, data: vec![9.0, 9.0, 1.0, -2.0, 3.0, 9.0, 0.0, 4.0] };
        tied.expand(&mut u);
        for row in equations() {
            let sum: f64 = row.iter().map(|&(dof, c)| c * u.data[dof]).sum();
            assert!(sum.abs() < 1e-14, "{row:?}: {sum}");
        }
        // A load does the work of its Tᵀ on what is free.
        let load: Vec<f64> = (0..8).map(|dof| f64::from(dof) - 2.5).collect();
        let work = |force: &[f64]| -> f64 { force.iter().zip(&u.data).map(|(f, u)| f * u).sum() };
        assert!((work(&load) - work(&tied.forces(&load))).abs() < 1e-13);
        let row: Row = load.iter().copied().enumerate().collect();
        let own: f64 = tied.row(&row).iter().map(|&(dof, c)| c * u.data[dof]).sum();
        assert!((work(&load) - own).abs() < 1e-13);
        assert!(Tied::new(8, &[], &[6]).is_none());
    }

    #[test]
    fn a_tied_matrix_has_the_energy_of_the_whole_one() {
        let tied = Tied::new(8, &equations(), &[6]).expect("equations");
        let whole = LowerTriangle::from_columns(8, |j| {
            (j..8).map(move |i| (i, 1.0 / (1.0 + (i * j) as f64) + if i == j { 4.0 } else { 0.0 }))
        });
        let own = tied.matrix(&whole, usize::MAX).unwrap();
        let mut u =
            Matrix { rows: 8, cols: 1, data: vec![0.0, 0.0, 0.0, -2.0, 3.0, 0.7, 0.5, 4.0] };
        // The held dof stands still.
        u.data[6] = 0.0;
        let energy = |a: &LowerTriangle, u: &[f64]| -> f64 {
            let mut forces = vec![0.0; 8];
            a.multiply(u, &mut forces);
            forces.iter().zip(u).map(|(f, u)| f * u).sum()
        };
        let reduced = energy(&own, &u.data);
        tied.expand(&mut u);
        let full = energy(&whole, &u.data);
        assert!((reduced - full).abs() < 1e-12 * full, "{reduced} {full}");
        for &dof in &tied.dependent {
            assert!(own.column(dof).all(|(_, value)| value == 0.0));
        }
    }

    /// 200 dofs that are one, and follow the mean of 300 others: a chain of springs has few entries besides those of the
    /// 300 with one another.
    #[test]
    fn many_that_follow_a_mean_of_many_are_not_multiplied_out() {
        let (rigid, mean) = (200, 300);
        let mut equations: Vec<Row> = vec![
            std::iter::once((0, 1.0))
                .chain((rigid..rigid + mean).map(|dof| (dof, -1.0 / mean as f64)))
                .collect(),
        ];
        equations.extend((1..rigid).map(|dof| vec![(dof, 1.0), (0, -1.0)]));
        let tied = Tied::new(rigid + mean, &equations, &[]).unwrap();
        assert_eq!(tied.dependent, (0..rigid).collect::<Vec<_>>());
        let terms: usize = tied.solved.iter().map(|(_, terms)| terms.len()).sum();
        assert_eq!(terms, mean + rigid - 1);
        let whole = LowerTriangle::from_columns(rigid + mean, |j| {
            [(j, 2.0), (j + 1, -1.0)].into_iter().filter(move |&(i, _)| i < rigid + mean)
        });
        let own = tied.matrix(&whole, usize::MAX).unwrap();
        assert_eq!(own.rows.len(), mean * (mean + 1) / 2 + 2 * rigid);
        // All of the 200 and the first of the others are joined in a row: u₀ = Σ uᵢ / 300.
        let u: Vec<f64> = (0..rigid + mean).map(|i| (i as f64).sin()).collect();
        let first: f64 = u[rigid..].iter().sum::<f64>() / mean as f64;
        let all: Vec<f64> =
            (0..rigid + mean).map(|i| if i < rigid { first } else { u[i] }).collect();
        let energy = |a: &LowerTriangle, u: &[f64]| -> f64 {
            let mut forces = vec![0.0; u.len()];
            a.multiply(u, &mut forces);
            forces.iter().zip(u).map(|(f, u)| f * u).sum()
        };
        let (own, known) = (energy(&own, &u), energy(&whole, &all));
        assert!((own - known).abs() < 1e-12 * known, "{own} {known}");
        let refused = tied.matrix(&whole, 1 << 20).unwrap_err();
        assert!(matches!(refused, LinearAlgebraError::TooLarge { limit: 1_048_576, .. }));
    }
}
