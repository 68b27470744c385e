//! Which dofs of a body stay coordinates, which are held, and on which the means of others are.

use std::borrow::Cow;
use std::collections::BTreeMap;

use crate::error::ReductionError;
use crate::linalg::{LowerTriangle, Matrix};

use crate::sparse::Row;

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
    /// Loads on dofs whose static answers are kept beside the modes.
    pub corrections: &'a [Row],
}

/// Where a dof goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    /// Among the inner ones.
    Inner(usize),
    /// Among the retained ones.
    Retained(usize),
    Held,
}

/// The dofs of a body: inner ones, retained ones, and ones that are held. A retained mean Σ cᵢ uᵢ = m is a constraint on
/// the inner ones, and on retained ones where it has such.
pub(super) struct Partition {
    /// Inner dofs, ascending.
    pub(super) inner: Vec<usize>,
    /// Number of retained motions.
    pub(super) retained: usize,
    place: Vec<Place>,
    /// Places of the means among the retained motions.
    pub(super) means: Vec<usize>,
    /// Their coefficients of the inner dofs, by their places.
    pub(super) rows: Vec<Row>,
    /// Their coefficients of retained dofs, by their places.
    on_retained: Vec<Row>,
}

impl Partition {
    /// `dependent`: dofs that follow from others, and are left out as held ones are.
    pub(super) fn new(
        dofs: usize,
        interface: &Interface,
        dependent: &[usize],
    ) -> Result<Self, ReductionError> {
        let mut place = vec![Place::Inner(0); dofs];
        let out_of_range =
            |dof: usize| ReductionError::Retained { dof, node: dof / 3, component: dof % 3, dofs };
        for &dof in interface.held.iter().chain(dependent) {
            *place.get_mut(dof).ok_or_else(|| out_of_range(dof))? = Place::Held;
        }
        let mut means = Vec::new();
        for (index, row) in interface.retained.iter().enumerate() {
            match row[..] {
                [(dof, 1.0)] => match place.get_mut(dof) {
                    Some(slot @ Place::Inner(_)) => *slot = Place::Retained(index),
                    Some(Place::Held) => {
                        return Err(ReductionError::Follows { place: index, same: None });
                    }
                    // Two dofs that a tie makes one.
                    Some(Place::Retained(same)) if !dependent.is_empty() => {
                        let same = Some(*same);
                        return Err(ReductionError::Follows { place: index, same });
                    }
                    _ => return Err(out_of_range(dof)),
                },
                _ => means.push(index),
            }
        }
        let is_inner = |&dof: &usize| matches!(place[dof], Place::Inner(_));
        let inner: Vec<usize> = (0..dofs).filter(is_inner).collect();
        for (index, &dof) in inner.iter().enumerate() {
            place[dof] = Place::Inner(index);
        }
        let (mut rows, mut on_retained) = (Vec::new(), Vec::new());
        let mut solved: Vec<Solved> = Vec::with_capacity(means.len());
        for &index in &means {
            let (mut row, mut others) = (BTreeMap::new(), BTreeMap::new());
            for &(dof, c) in &interface.retained[index] {
                match place.get(dof).ok_or_else(|| out_of_range(dof))? {
                    Place::Inner(own) => *row.entry(*own).or_insert(0.0) += c,
                    Place::Retained(own) => *others.entry(*own).or_insert(0.0) += c,
                    Place::Held => {}
                }
            }
            let scale = interface.retained[index].iter().map(|(_, c)| c.abs()).fold(0.0, f64::max);
            let mut reduced = Solved { pivot: 0, terms: row.clone(), scale };
            solved.iter().for_each(|other| reduced.substitute(other));
            if !reduced.solve() {
                return Err(ReductionError::Follows { place: index, same: None });
            }
            solved.iter_mut().for_each(|other| other.substitute(&reduced));
            solved.push(reduced);
            rows.push(row.into_iter().collect());
            on_retained.push(others.into_iter().collect());
        }
        let retained = interface.retained.len();
        Ok(Partition { inner, retained, place, means, rows, on_retained })
    }

    /// The block of the inner dofs.
    pub(super) fn inner<'w>(&self, whole: Cow<'w, LowerTriangle>) -> Cow<'w, LowerTriangle> {
        if self.inner.len() == whole.size {
            return whole;
        }
        let place = |row: usize| match self.place[row] {
            Place::Inner(i) => Some(i),
            _ => None,
        };
        Cow::Owned(whole.block(&self.inner, place))
    }

    /// The blocks (inner, retained) and (retained, retained), without what the means couple.
    pub(super) fn coupling(&self, whole: &LowerTriangle) -> (Matrix, Matrix) {
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
        (coupling, held)
    }

    /// What the inner dofs have to give each mean (rows) for a unit of each retained motion: C u = d.
    pub(super) fn given(&self) -> Matrix {
        let mut given = Matrix::zeros(self.means.len(), self.retained);
        for (k, (mean, row)) in self.means.iter().zip(&self.on_retained).enumerate() {
            given[(k, *mean)] = 1.0;
            row.iter().for_each(|&(j, c)| given[(k, j)] -= c);
        }
        given
    }

    /// Adds to forces on retained motions (rows) those of the multipliers of the means: λ on each mean, −c λ on retained
    /// dofs that are in it.
    pub(super) fn add_multipliers(&self, multipliers: &Matrix, forces: &mut Matrix) {
        for (k, (mean, row)) in self.means.iter().zip(&self.on_retained).enumerate() {
            for j in 0..forces.cols {
                let lambda = multipliers[(k, j)];
                forces[(*mean, j)] += lambda;
                row.iter().for_each(|&(i, c)| forces[(i, j)] -= c * lambda);
            }
        }
    }

    /// Loads on the inner dofs, a column each.
    pub(super) fn inner_loads(&self, loads: &[Row]) -> Matrix {
        let mut inner = Matrix::zeros(self.inner.len(), loads.len());
        for (j, load) in loads.iter().enumerate() {
            for &(dof, value) in load {
                if let Place::Inner(i) = self.place[dof] {
                    inner[(i, j)] += value;
                }
            }
        }
        inner
    }

    /// Forces on the inner dofs by forces on all dofs.
    pub(super) fn inner_load(&self, force: &[f64]) -> Vec<f64> {
        self.inner.iter().map(|&dof| force[dof]).collect()
    }

    /// Displacements of all dofs by those of the inner ones, with the retained dofs at zero.
    pub(super) fn displacement(&self, inner: &[f64]) -> Vec<f64> {
        let displaced = |place: &Place| match place {
            Place::Inner(index) => inner[*index],
            Place::Retained(_) | Place::Held => 0.0,
        };
        self.place.iter().map(displaced).collect()
    }

    /// φ = [X Y; 0 I], rows in the body's numbering: zero for held dofs.
    pub(super) fn shapes(&self, modes: &Matrix, constraint: &Matrix) -> Matrix {
        let (count, dofs) = (modes.cols, self.place.len());
        let mut shapes = Matrix::zeros(dofs, count + self.retained);
        for j in 0..shapes.cols {
            for dof in 0..dofs {
                shapes[(dof, j)] = match (self.place[dof], j.checked_sub(count)) {
                    (Place::Inner(index), None) => modes[(index, j)],
                    (Place::Inner(index), Some(j)) => constraint[(index, j)],
                    (Place::Retained(index), Some(j)) if index == j => 1.0,
                    _ => 0.0,
                };
            }
        }
        shapes
    }
}

/// A mean that is zero, solved for a dof: u_pivot = Σ `terms` uᵢ.
struct Solved {
    pivot: usize,
    terms: BTreeMap<usize, f64>,
    /// The largest coefficient at first.
    scale: f64,
}

impl Solved {
    /// Puts a solved row in for its pivot.
    fn substitute(&mut self, other: &Solved) {
        let Some(factor) = self.terms.remove(&other.pivot) else { return };
        other.terms.iter().for_each(|(&i, c)| *self.terms.entry(i).or_insert(0.0) += factor * c);
    }

    /// Solves for the dof with the largest coefficient, the first of equals; `false` if there is none.
    fn solve(&mut self) -> bool {
        self.terms.retain(|_, c| c.abs() > ROUNDING * self.scale);
        let larger = |best: Option<(usize, f64)>, (&dof, &c): (&usize, &f64)| match best {
            Some((_, b)) if b.abs() >= c.abs() => best,
            _ => Some((dof, c)),
        };
        let Some((pivot, leading)) = self.terms.iter().fold(None, larger) else { return false };
        self.pivot = pivot;
        self.terms.remove(&pivot);
        self.terms.values_mut().for_each(|c| *c /= -leading);
        true
    }
}
