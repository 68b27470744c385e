//! Ties between dofs: equations Σ cᵢ uᵢ = 0 that a mesh brings along, eliminated before anything is solved.
//!
//! u = T û, with û the dofs that no equation is solved for; K becomes TᵀKT, and M likewise. All keep the numbering of the
//! mesh: rows and columns of dependent dofs are zero, and stay in the graph, so that what was joined is joined.

use std::collections::BTreeMap;

use crate::linalg::{LowerTriangle, Matrix};
use crate::sparse::SparseColumns;

use crate::sparse::Row;

/// What is left of an equation after elimination counts as zero below this part of its largest coefficient: a few hundred
/// roundings.
const ROUNDING: f64 = 1e-13;
/// The first dof of an equation depends on the others unless its coefficient is smaller than this part of the largest.
const PREFERRED: f64 = 0.1;

/// Equations solved for dofs: u = T û.
#[derive(Debug, Clone)]
pub(crate) struct Tied {
    /// Dofs that depend on others, ascending.
    pub(super) dependent: Vec<usize>,
    /// For each of them what it is, over dofs that are free.
    terms: Vec<Row>,
    /// Place among `dependent` of every dof, or `usize::MAX`.
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
        let mut place = vec![usize::MAX; dofs];
        let mut solved: Vec<(usize, BTreeMap<usize, f64>)> = Vec::new();
        for equation in equations {
            let scale = equation.iter().fold(0.0, |most: f64, (_, c)| most.max(c.abs()));
            let mut row: BTreeMap<usize, f64> = BTreeMap::new();
            for &(dof, c) in equation.iter().filter(|(dof, _)| !still[*dof]) {
                *row.entry(dof).or_insert(0.0) += c;
            }
            // What a dof is may name dofs that later equations were solved for.
            while let Some(dof) = row.keys().copied().find(|&dof| place[dof] != usize::MAX) {
                substitute(&mut row, dof, &solved[place[dof]].1);
            }
            row.retain(|_, c| c.abs() > ROUNDING * scale);
            let largest =
                row.iter().fold(None, |best: Option<(usize, f64)>, (&dof, &c)| match best {
                    Some((_, most)) if most.abs() >= c.abs() => best,
                    _ => Some((dof, c)),
                });
            let Some((mut pivot, most)) = largest else { continue };
            let first = equation[0].0;
            if row.get(&first).is_some_and(|c| c.abs() >= PREFERRED * most.abs()) {
                pivot = first;
            }
            let leading = row.remove(&pivot).expect("it is one of the row's");
            row.values_mut().for_each(|c| *c /= -leading);
            place[pivot] = solved.len();
            solved.push((pivot, row));
        }
        // Later ones name none that are solved for.
        for index in (0..solved.len()).rev() {
            let mut row = std::mem::take(&mut solved[index].1);
            let own: Vec<usize> =
                row.keys().copied().filter(|&dof| place[dof] != usize::MAX).collect();
            own.iter().for_each(|&dof| substitute(&mut row, dof, &solved[place[dof]].1));
            solved[index].1 = row;
        }
        solved.sort_unstable_by_key(|(dof, _)| *dof);
        for (index, (dof, _)) in solved.iter().enumerate() {
            place[*dof] = index;
        }
        let (dependent, terms) = solved
            .into_iter()
            .map(|(dof, row)| (dof, row.into_iter().filter(|(_, c)| *c != 0.0).collect()))
            .unzip();
        Some(Tied { dependent, terms, place })
    }

    /// TᵀAT of a symmetric matrix.
    pub(crate) fn matrix(&self, whole: &LowerTriangle) -> LowerTriangle {
        let depends = |dof: usize| self.place[dof] != usize::MAX;
        let mut more = Vec::new();
        for j in 0..whole.size {
            for (i, value) in whole.column(j).filter(|&(i, _)| depends(i) || depends(j)) {
                let (rows, columns) = (self.terms_of(i), self.terms_of(j));
                for &(a, by_row) in rows.as_ref() {
                    for &(b, by_column) in columns.as_ref() {
                        let value = value * by_row * by_column;
                        match i == j {
                            // Both (a, b) and (b, a) come along.
                            true if a >= b => more.push((a, b, value)),
                            true => {}
                            // A (i, j) and A (j, i) meet at one place.
                            false if a == b => more.push((a, a, 2.0 * value)),
                            false => more.push((a.max(b), a.min(b), value)),
                        }
                    }
                }
            }
        }
        let own = LowerTriangle::from_columns(whole.size, |j| {
            let own = whole.column(j);
            own.map(move |(i, value)| (i, if depends(i) || depends(j) { 0.0 } else { value }))
        });
        own.plus(1.0, &SparseColumns::from_triplets(whole.size, whole.size, more).into_lower())
    }

    /// Tᵀ of a motion Σ cᵢ uᵢ, or of a load.
    pub(crate) fn row(&self, row: &Row) -> Row {
        if row.iter().all(|(dof, _)| self.place[*dof] == usize::MAX) {
            return row.clone();
        }
        let mut own: BTreeMap<usize, f64> = BTreeMap::new();
        for &(dof, c) in row {
            for &(free, by) in self.terms_of(dof).as_ref() {
                *own.entry(free).or_insert(0.0) += c * by;
            }
        }
        let scale = row.iter().fold(0.0, |most: f64, (_, c)| most.max(c.abs()));
        own.into_iter().filter(|(_, c)| c.abs() > ROUNDING * scale).collect()
    }

    /// Tᵀ of forces on all dofs.
    pub(super) fn forces(&self, force: &[f64]) -> Vec<f64> {
        let mut own = force.to_vec();
        for (&dof, terms) in self.dependent.iter().zip(&self.terms) {
            own[dof] = 0.0;
            terms.iter().for_each(|&(free, by)| own[free] += by * force[dof]);
        }
        own
    }

    /// Puts into columns of displacements what depends on the others.
    pub(super) fn expand(&self, shapes: &mut Matrix) {
        for column in shapes.data.chunks_exact_mut(self.place.len()) {
            for (&dof, terms) in self.dependent.iter().zip(&self.terms) {
                column[dof] = terms.iter().map(|&(free, by)| by * column[free]).sum();
            }
        }
    }

    /// What a dof is, over free ones.
    fn terms_of(&self, dof: usize) -> std::borrow::Cow<'_, [(usize, f64)]> {
        match self.terms.get(self.place[dof]) {
            Some(terms) => terms.into(),
            None => vec![(dof, 1.0)].into(),
        }
    }
}

/// Puts what a dof is in its place.
fn substitute(row: &mut BTreeMap<usize, f64>, dof: usize, terms: &BTreeMap<usize, f64>) {
    let Some(factor) = row.remove(&dof) else { return };
    terms.iter().for_each(|(&other, c)| *row.entry(other).or_insert(0.0) += factor * c);
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
        let own = tied.matrix(&whole);
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
}
