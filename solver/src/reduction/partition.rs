//! Which dofs of a body stay coordinates, which are held, and which follow from the others.

use std::collections::{BTreeMap, BTreeSet};

use crate::error::ReductionError;
use crate::linalg::{LowerTriangle, Matrix};

use super::rigid::Row;
use super::updated::UpdatedMatrix;

/// What is left of a row after elimination counts as zero below this part of its largest coefficient.
const ROUNDING: f64 = 1e-11;

/// What is kept of a body's dofs, and what is held.
#[derive(Debug, Clone, Copy, Default)]
pub struct Interface<'a> {
    /// Motions that stay coordinates, in their order: Σ cᵢ uᵢ over dofs i. A dof is one term with c = 1, a mean of a set has
    /// many.
    pub retained: &'a [Row],
    /// Dofs that do not move, in any order.
    pub held: &'a [usize],
}

/// Where a dof goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    /// Among the inner ones.
    Inner(usize),
    /// Among the retained ones.
    Retained(usize),
    /// It follows from others: its place among the dependent ones.
    Dependent(usize),
    Held,
}

/// The dofs u of a body as a linear function of v, the inner dofs and then the retained motions: u = T v.
///
/// A retained mean Σ cᵢ uᵢ = m takes the place of the dof k that weighs most in it, u_k = (m − Σ_{i≠k} cᵢ uᵢ)/c_k. A matrix
/// of the body becomes TᵀAT: itself without these dofs, and a pair of rows for each, which couple the dofs of the mean with
/// each other.
pub(super) struct Partition {
    /// Inner dofs, ascending.
    pub(super) inner: Vec<usize>,
    /// Number of retained motions.
    pub(super) retained: usize,
    place: Vec<Place>,
    /// Rows of T of the dependent dofs: by places in v, ascending.
    dependent: Vec<Row>,
}

impl Partition {
    pub(super) fn new(dofs: usize, interface: &Interface) -> Result<Self, ReductionError> {
        let mut place = vec![Place::Inner(0); dofs];
        let out_of_range =
            |dof: usize| ReductionError::Retained { dof, node: dof / 3, component: dof % 3, dofs };
        for &dof in interface.held {
            *place.get_mut(dof).ok_or_else(|| out_of_range(dof))? = Place::Held;
        }
        let mut means = Vec::new();
        for (index, row) in interface.retained.iter().enumerate() {
            match row[..] {
                [(dof, 1.0)] => match place.get_mut(dof) {
                    Some(slot @ Place::Inner(_)) => *slot = Place::Retained(index),
                    Some(Place::Held) => return Err(ReductionError::Follows { place: index }),
                    _ => return Err(out_of_range(dof)),
                },
                _ => means.push(index),
            }
        }
        let mut solved: Vec<Solved> = Vec::with_capacity(means.len());
        for index in means {
            let mut row = Solved::unsolved(&interface.retained[index], index, &place)
                .map_err(out_of_range)?;
            for other in &solved {
                row.substitute(other);
            }
            if !row.solve() {
                return Err(ReductionError::Follows { place: index });
            }
            solved.iter_mut().for_each(|other| other.substitute(&row));
            solved.push(row);
        }
        for (index, row) in solved.iter().enumerate() {
            place[row.pivot] = Place::Dependent(index);
        }
        let is_inner = |&dof: &usize| matches!(place[dof], Place::Inner(_));
        let inner: Vec<usize> = (0..dofs).filter(is_inner).collect();
        for (index, &dof) in inner.iter().enumerate() {
            place[dof] = Place::Inner(index);
        }
        let retained = interface.retained.len();
        let mut partition = Partition { inner, retained, place, dependent: Vec::new() };
        partition.dependent = solved.iter().map(|row| partition.row(row)).collect();
        Ok(partition)
    }

    /// The row of T of a solved one.
    fn row(&self, solved: &Solved) -> Row {
        let mut row: BTreeMap<usize, f64> = BTreeMap::new();
        for (&dof, &c) in &solved.dofs {
            *row.entry(self.column(dof).expect("other dofs do not depend")).or_insert(0.0) += c;
        }
        for (&index, &c) in &solved.retained {
            *row.entry(self.inner.len() + index).or_insert(0.0) += c;
        }
        row.into_iter().collect()
    }

    /// The place in v of a dof that is one of v.
    fn column(&self, dof: usize) -> Option<usize> {
        match self.place[dof] {
            Place::Inner(index) => Some(index),
            Place::Retained(index) => Some(self.inner.len() + index),
            Place::Dependent(_) | Place::Held => None,
        }
    }

    /// Dofs whose place a retained mean takes.
    pub(super) fn replaced(&self) -> impl Iterator<Item = usize> {
        let is_dependent = |dof: &usize| matches!(self.place[*dof], Place::Dependent(_));
        (0..self.place.len()).filter(is_dependent)
    }

    /// Number of inner dofs that belong to a retained mean.
    pub(super) fn coupled(&self) -> usize {
        let columns = self.dependent.iter().flatten().map(|&(column, _)| column);
        columns.filter(|column| *column < self.inner.len()).collect::<BTreeSet<_>>().len()
    }

    /// TᵀAT, parted.
    pub(super) fn part(&self, whole: &LowerTriangle) -> Parted {
        let folded = self.fold(whole);
        Parted { inner: self.inner(whole, &folded), folded }
    }

    /// What the dependent dofs add to TᵀAT: Σ t gᵀ + g tᵀ over the pairs (t, g), one a dependent dof, with t its row of T.
    ///
    /// g = ½ Σ A_pq t_q over dependent dofs q, and A_pr over the others r.
    fn fold(&self, whole: &LowerTriangle) -> Vec<(Row, Row)> {
        if self.dependent.is_empty() {
            return Vec::new();
        }
        let mut sums: Vec<BTreeMap<usize, f64>> = vec![BTreeMap::new(); self.dependent.len()];
        let mut add = |p: usize, other: usize, value: f64| match self.place[other] {
            Place::Dependent(q) => {
                for &(column, t) in &self.dependent[q] {
                    *sums[p].entry(column).or_insert(0.0) += 0.5 * value * t;
                }
            }
            Place::Held => {}
            _ => {
                let column = self.column(other).expect("an inner or a retained dof");
                *sums[p].entry(column).or_insert(0.0) += value;
            }
        };
        for j in 0..whole.size {
            for (i, value) in whole.column(j) {
                if let Place::Dependent(p) = self.place[i] {
                    add(p, j, value);
                }
                if let (Place::Dependent(p), true) = (self.place[j], i != j) {
                    add(p, i, value);
                }
            }
        }
        let sums = sums.into_iter().map(|sum| sum.into_iter().collect());
        self.dependent.iter().cloned().zip(sums).collect()
    }

    fn inner(&self, whole: &LowerTriangle, folded: &[(Row, Row)]) -> UpdatedMatrix {
        let size = self.inner.len();
        let own = |j: usize| {
            whole.column(self.inner[j]).filter_map(|(row, value)| match self.place[row] {
                Place::Inner(i) => Some((i, value)),
                _ => None,
            })
        };
        let inner = |row: &Row| row.iter().copied().filter(|(column, _)| *column < size).collect();
        let pairs = folded.iter().map(|(t, g)| (inner(t), inner(g))).collect();
        UpdatedMatrix { sparse: LowerTriangle::from_columns(size, own), pairs }
    }

    /// The blocks (inner, retained) and (retained, retained) of TᵀAT.
    pub(super) fn coupling(&self, whole: &LowerTriangle, parted: &Parted) -> (Matrix, Matrix) {
        let (inner, count) = (self.inner.len(), self.retained);
        let mut coupling = Matrix::zeros(inner, count);
        let mut held = Matrix::zeros(count, count);
        for column in 0..whole.size {
            for (row, value) in whole.column(column) {
                match (self.place[row], self.place[column]) {
                    (Place::Inner(i), Place::Retained(j))
                    | (Place::Retained(j), Place::Inner(i)) => coupling[(i, j)] = value,
                    (Place::Retained(i), Place::Retained(j)) => {
                        held[(i, j)] = value;
                        held[(j, i)] = value;
                    }
                    _ => {}
                }
            }
        }
        for (t, g) in &parted.folded {
            for (left, right) in [(t, g), (g, t)] {
                for &(j, y) in right.iter().filter(|(j, _)| *j >= inner) {
                    for &(i, x) in left {
                        match i.checked_sub(inner) {
                            None => coupling[(i, j - inner)] += x * y,
                            Some(i) => held[(i, j - inner)] += x * y,
                        }
                    }
                }
            }
        }
        (coupling, held)
    }

    /// Forces on the inner dofs by forces on all dofs: the first rows of Tᵀ f.
    pub(super) fn inner_load(&self, force: &[f64]) -> Vec<f64> {
        let mut load: Vec<f64> = self.inner.iter().map(|&dof| force[dof]).collect();
        for (dof, place) in self.place.iter().enumerate() {
            let Place::Dependent(index) = place else { continue };
            for &(column, t) in &self.dependent[*index] {
                if let Some(sum) = load.get_mut(column) {
                    *sum += t * force[dof];
                }
            }
        }
        load
    }

    /// Displacements of all dofs by those of the inner ones, with the retained motions at zero.
    pub(super) fn displacement(&self, inner: &[f64]) -> Vec<f64> {
        let value = |column: usize| inner.get(column).copied().unwrap_or(0.0);
        let displaced = |place: &Place| match place {
            Place::Inner(index) => inner[*index],
            Place::Retained(_) | Place::Held => 0.0,
            Place::Dependent(index) => {
                self.dependent[*index].iter().map(|&(column, t)| t * value(column)).sum()
            }
        };
        self.place.iter().map(displaced).collect()
    }

    /// φ = T [X Y; 0 I], rows in the body's numbering: zero for held dofs.
    pub(super) fn shapes(&self, modes: &Matrix, constraint: &Matrix) -> Matrix {
        let (count, dofs, inner) = (modes.cols, self.place.len(), self.inner.len());
        let mut shapes = Matrix::zeros(dofs, count + self.retained);
        let value =
            |column: usize, j: usize| match (column.checked_sub(inner), j.checked_sub(count)) {
                (None, None) => modes[(column, j)],
                (None, Some(j)) => constraint[(column, j)],
                (Some(retained), Some(j)) if retained == j => 1.0,
                (Some(_), _) => 0.0,
            };
        for j in 0..shapes.cols {
            for dof in 0..dofs {
                shapes[(dof, j)] = match self.place[dof] {
                    Place::Held => 0.0,
                    Place::Dependent(index) => {
                        self.dependent[index].iter().map(|&(column, t)| t * value(column, j)).sum()
                    }
                    Place::Inner(index) => value(index, j),
                    Place::Retained(index) => value(inner + index, j),
                };
            }
        }
        shapes
    }
}

/// A matrix of the body in v.
pub(super) struct Parted {
    /// The block of the inner dofs.
    pub(super) inner: UpdatedMatrix,
    folded: Vec<(Row, Row)>,
}

/// u_pivot = Σ `dofs` uᵢ + Σ `retained` q_k.
struct Solved {
    pivot: usize,
    dofs: BTreeMap<usize, f64>,
    retained: BTreeMap<usize, f64>,
    /// The largest coefficient at first.
    scale: f64,
}

impl Solved {
    /// 0 = Σ cᵢ uᵢ − q_index, without dofs that are held.
    ///
    /// # Errors
    /// A dof that is not there.
    fn unsolved(row: &Row, index: usize, place: &[Place]) -> Result<Self, usize> {
        let mut new = Solved {
            pivot: 0,
            dofs: BTreeMap::new(),
            retained: BTreeMap::from([(index, -1.0)]),
            scale: 0.0,
        };
        for &(dof, c) in row {
            match place.get(dof).ok_or(dof)? {
                Place::Held => {}
                Place::Retained(other) => *new.retained.entry(*other).or_insert(0.0) += c,
                _ => *new.dofs.entry(dof).or_insert(0.0) += c,
            }
            new.scale = new.scale.max(c.abs());
        }
        Ok(new)
    }

    /// Puts a solved row in for its pivot.
    fn substitute(&mut self, other: &Solved) {
        let Some(factor) = self.dofs.remove(&other.pivot) else { return };
        let add = |sums: &mut BTreeMap<usize, f64>, terms: &BTreeMap<usize, f64>| {
            terms.iter().for_each(|(&i, c)| *sums.entry(i).or_insert(0.0) += factor * c);
        };
        add(&mut self.dofs, &other.dofs);
        add(&mut self.retained, &other.retained);
    }

    /// Solves for the dof with the largest coefficient, the first of equals; `false` if there is none.
    fn solve(&mut self) -> bool {
        self.dofs.retain(|_, c| c.abs() > ROUNDING * self.scale);
        let larger = |best: Option<(usize, f64)>, (&dof, &c): (&usize, &f64)| match best {
            Some((_, b)) if b.abs() >= c.abs() => best,
            _ => Some((dof, c)),
        };
        let Some((pivot, leading)) = self.dofs.iter().fold(None, larger) else { return false };
        self.pivot = pivot;
        self.dofs.remove(&pivot);
        let terms = self.dofs.values_mut().chain(self.retained.values_mut());
        terms.for_each(|c| *c /= -leading);
        true
    }
}
