//! Constraints by elimination, and springs to ground.
//!
//! Homogeneous linear equations Σ cᵢ uᵢ = 0 (a fixed dof is u = 0) on any coordinates: the dofs of a mesh
//! or the retained dofs of a reduced body. Elimination gives u = Z û with û the free coordinates among u.

use std::collections::{BTreeMap, BTreeSet};

use crate::error::{Error, FreeMotion, ReductionError};
use crate::mesh::Mesh;
use crate::mesh::matrices::Slot;
use crate::reduction::{self, Tied};
use crate::sparse::{SparseColumns, SparseMatrix};

/// What is left of an equation after elimination counts as zero below this part of its largest
/// coefficient: a few hundred roundings.
const ROUNDING: f64 = 1e-13;

/// Σ cᵢ uᵢ = 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Equation {
    /// How messages call it, such as `mounts[0] (y of MOUNTS)`.
    pub name: String,
    /// (i, cᵢ).
    pub(crate) terms: Vec<(usize, f64)>,
}

/// Homogeneous linear constraints, in the order in which they were given.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Constraints {
    equations: Vec<Equation>,
}

/// u = Z û.
#[derive(Debug, Clone, PartialEq)]
pub struct Elimination {
    /// Z: coordinates × free coordinates.
    pub(crate) transform: SparseColumns,
    /// Which of u each free coordinate is, ascending.
    pub free: Vec<usize>,
}

impl Constraints {
    /// No constraints.
    pub fn new() -> Self {
        Constraints::default()
    }

    /// The equations, in order.
    pub fn equations(&self) -> &[Equation] {
        &self.equations
    }

    /// u = 0 for one coordinate.
    pub fn fix(&mut self, name: impl Into<String>, dof: usize) {
        self.equation(name, [(dof, 1.0)]);
    }

    /// Σ cᵢ uᵢ = 0; terms (i, cᵢ) with the same i are summed.
    pub fn equation(
        &mut self,
        name: impl Into<String>,
        terms: impl IntoIterator<Item = (usize, f64)>,
    ) {
        let terms = terms.into_iter().collect();
        self.equations.push(Equation { name: name.into(), terms });
    }

    /// Eliminates the equations from `size` coordinates: each takes the coordinate with its largest
    /// coefficient (the first of equals) out.
    ///
    /// # Errors
    /// [`Error::Constraint`]: an equation without a term, with a coordinate that is not there, or one
    /// that already follows from others, which are named.
    pub fn eliminate(&self, size: usize) -> Result<Elimination, Error> {
        // Each row is solved for its pivot: u_pivot = Σ row[i] uᵢ over coordinates without a row.
        let mut solved: BTreeMap<usize, EquationRow> = BTreeMap::new();
        for (index, equation) in self.equations.iter().enumerate() {
            let mut row = equation.row(size)?;
            let scale = row.values().fold(0.0, |scale: f64, c| scale.max(c.abs()));
            let mut origins = BTreeSet::from([index]);
            let pivots: Vec<usize> =
                row.keys().copied().filter(|i| solved.contains_key(i)).collect();
            for pivot in pivots {
                let Some(factor) = row.remove(&pivot) else { continue };
                let other = &solved[&pivot];
                other.terms.iter().for_each(|(&i, c)| *row.entry(i).or_insert(0.0) += factor * c);
                origins.extend(&other.origins);
            }
            row.retain(|_, c| c.abs() > ROUNDING * scale);
            let largest =
                row.iter().fold(None, |best: Option<(usize, f64)>, (&i, &c)| match best {
                    Some((_, b)) if b.abs() >= c.abs() => best,
                    _ => Some((i, c)),
                });
            let Some((pivot, leading)) = largest else {
                return Err(self.redundant(index, &origins));
            };
            row.remove(&pivot);
            row.values_mut().for_each(|c| *c /= -leading);
            let new = EquationRow { terms: row, origins };
            for other in solved.values_mut() {
                other.substitute(pivot, &new);
            }
            solved.insert(pivot, new);
        }
        let free: Vec<usize> = (0..size).filter(|i| !solved.contains_key(i)).collect();
        let column: BTreeMap<usize, usize> =
            free.iter().enumerate().map(|(j, &i)| (i, j)).collect();
        let mut triplets: Vec<(usize, usize, f64)> =
            free.iter().enumerate().map(|(j, &i)| (i, j, 1.0)).collect();
        for (&pivot, row) in &solved {
            triplets.extend(row.terms.iter().map(|(i, &c)| (pivot, column[i], c)));
        }
        let transform = SparseColumns::from_triplets(size, free.len(), triplets);
        Ok(Elimination { transform, free })
    }

    fn redundant(&self, index: usize, origins: &BTreeSet<usize>) -> Error {
        let others: Vec<&str> = origins
            .iter()
            .filter(|&&other| other != index)
            .map(|&other| self.equations[other].name.as_str())
            .collect();
        Error::Constraint {
            constraint: self.equations[index].name.clone(),
            what: format!("already follows from {}: take one of them out", others.join(" and ")),
        }
    }
}

impl Equation {
    fn row(&self, size: usize) -> Result<BTreeMap<usize, f64>, Error> {
        let wrong = |what: String| Error::Constraint { constraint: self.name.clone(), what };
        let mut row = BTreeMap::new();
        for &(i, c) in &self.terms {
            if i >= size {
                return Err(wrong(format!("names coordinate {i}, there are {size}")));
            }
            if !c.is_finite() {
                return Err(wrong(format!("has the coefficient {c}")));
            }
            *row.entry(i).or_insert(0.0) += c;
        }
        row.retain(|_, c| *c != 0.0);
        match row.is_empty() {
            true => Err(wrong("has no terms".to_owned())),
            false => Ok(row),
        }
    }
}

/// An equation solved for its pivot, and the equations that went into it.
struct EquationRow {
    terms: BTreeMap<usize, f64>,
    origins: BTreeSet<usize>,
}

impl EquationRow {
    fn substitute(&mut self, pivot: usize, new: &EquationRow) {
        let Some(factor) = self.terms.remove(&pivot) else { return };
        for (&i, c) in &new.terms {
            *self.terms.entry(i).or_insert(0.0) += factor * c;
        }
        self.terms.retain(|_, c| *c != 0.0);
        self.origins.extend(&new.origins);
    }
}

/// A spring from a dof to ground.
#[derive(Debug, Clone, PartialEq)]
pub struct GroundSpring {
    /// How messages call it.
    pub name: String,
    /// Dof of the mesh, 3·node + component.
    pub dof: usize,
    /// N/m, positive.
    pub stiffness: f64,
}

/// A spring is at most this many times as stiff as the stiffest dof of the body: its node then moves by a
/// millionth of what the body would let it. Beyond, it is a mount, and takes the body's digits away.
const STIFFEST_SPRING: f64 = 1e6;

/// K with the springs on its diagonal.
///
/// # Errors
/// [`Error::Constraint`]: a dof that is not there, or a stiffness that is not positive. [`Error::StiffSpring`]:
/// one beside which the body has no digits left.
pub fn add_ground_springs(
    k: SparseMatrix,
    springs: &[GroundSpring],
) -> Result<SparseMatrix, Error> {
    if springs.is_empty() {
        return Ok(k);
    }
    let size = k.size();
    let mut diagonal = Vec::with_capacity(springs.len());
    let own = k.lower().map(|lower| lower.diagonal().into_iter().fold(0.0, f64::max));
    for (place, spring) in springs.iter().enumerate() {
        let wrong = |what: String| Error::Constraint { constraint: spring.name.clone(), what };
        if spring.dof >= size {
            return Err(wrong(format!("acts on coordinate {}, there are {size}", spring.dof)));
        }
        let stiffness = spring.stiffness;
        if !(stiffness > 0.0 && stiffness.is_finite()) {
            return Err(wrong(format!("has a stiffness of {stiffness} N/m: it must be positive")));
        }
        if let Some(body) = own.filter(|&body| body > 0.0 && stiffness > STIFFEST_SPRING * body) {
            let (name, most) = (spring.name.clone(), STIFFEST_SPRING * body);
            return Err(Error::StiffSpring { place, name, stiffness, body, most });
        }
        diagonal.push((spring.dof, stiffness));
    }
    Ok(k.plus_diagonal(&diagonal))
}

/// The rigid motions of a body that no constraint stops and no stiffness resists.
///
/// `positions`: nodes (m); `k`: stiffness with ground springs (N/m), symmetric; `constraints`: on its dofs.
///
/// # Errors
/// A constraint without terms or on a dof that is not there; a stiffness that is not symmetric by its
/// structure, or holds values that are not finite.
pub fn free_motions(
    positions: &[[f64; 3]],
    k: &SparseMatrix,
    constraints: &Constraints,
) -> Result<Vec<FreeMotion>, Error> {
    free_motions_of((positions, &[]), k, constraints)
}

/// The same of a mesh, or of a body of matrices, whose dofs need not be translations of its nodes; with the bytes that may
/// be in use while its ties are eliminated.
///
/// # Errors
/// As [`free_motions`]; ties that need more memory.
pub fn free_motions_of_mesh(
    mesh: &Mesh,
    k: &SparseMatrix,
    constraints: &Constraints,
    memory: usize,
) -> Result<Vec<FreeMotion>, Error> {
    match Tied::new(mesh.dof_count(), &mesh.tie_rows(), &[]) {
        Some(tied) => {
            let whole = k.lower().ok_or(ReductionError::NotSymmetric { matrix: "stiffness" })?;
            let own = tied.matrix(&whole, memory).map_err(ReductionError::from)?;
            let own = SparseMatrix::Symmetric(own);
            free_motions_of((mesh.nodes(), mesh.slots()), &own, constraints)
        }
        None => free_motions_of((mesh.nodes(), mesh.slots()), k, constraints),
    }
}

fn free_motions_of(
    places: (&[[f64; 3]], &[Slot]),
    k: &SparseMatrix,
    constraints: &Constraints,
) -> Result<Vec<FreeMotion>, Error> {
    let lower = k.lower().ok_or(ReductionError::NotSymmetric { matrix: "stiffness" })?;
    let mut rows: Vec<reduction::Row> = Vec::with_capacity(constraints.equations().len());
    for equation in constraints.equations() {
        let row = equation.row(k.size())?;
        let scale = row.values().fold(0.0, |scale: f64, c| scale.max(c.abs()));
        rows.push(row.into_iter().map(|(dof, c)| (dof, c / scale)).collect());
    }
    Ok(reduction::free_motions(places, &lower, &rows)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elimination_solves_every_equation() {
        let mut constraints = Constraints::new();
        constraints.fix("ground", 4);
        constraints.equation("torsion", [(0, 1.0), (2, -1.0)]);
        constraints.equation("rod", [(0, 1.0), (1, 3.0), (3, -2.0), (4, 7.0)]);
        let elimination = constraints.eliminate(6).unwrap();
        assert_eq!(elimination.free, [2, 3, 5]);
        let mut u = vec![0.0; 6];
        elimination.transform.multiply(&[1.0, 0.5, -1.0], &mut u);
        for equation in constraints.equations() {
            let sum: f64 = equation.terms.iter().map(|&(i, c)| c * u[i]).sum();
            assert!(sum.abs() < 1e-15, "{}: {sum}", equation.name);
        }
    }

    #[test]
    fn redundant_constraints_name_those_they_follow_from() {
        let mut constraints = Constraints::new();
        constraints.fix("left", 0);
        constraints.equation("bar", [(0, 1.0), (1, 0.1)]);
        constraints.fix("free", 3);
        constraints.fix("right", 1);
        let error = constraints.eliminate(4).unwrap_err().to_string();
        assert_eq!(error, "right already follows from left and bar: take one of them out");
        let mut constraints = Constraints::new();
        constraints.equation("nothing", [(0, 1.0), (0, -1.0)]);
        let error = constraints.eliminate(4).unwrap_err().to_string();
        assert_eq!(error, "nothing has no terms");
        let mut constraints = Constraints::new();
        constraints.fix("far", 9);
        let error = constraints.eliminate(4).unwrap_err().to_string();
        assert_eq!(error, "far names coordinate 9, there are 4");
    }

    #[test]
    fn springs_must_be_positive_and_act_on_a_dof() {
        let triplets = vec![(0, 0, 1.0), (1, 1, 2.0)];
        let k = SparseMatrix::Symmetric(SparseColumns::from_triplets(2, 2, triplets).into_lower());
        let spring = |dof, stiffness| GroundSpring { name: "swing".into(), dof, stiffness };
        let sum = add_ground_springs(k.clone(), &[spring(1, 5.0), spring(1, 1.0)]).unwrap();
        assert_eq!(sum.bilinear(&[0.0, 1.0], &[0.0, 1.0]), 8.0);
        assert!(add_ground_springs(k.clone(), &[spring(2, 5.0)]).is_err());
        let error = add_ground_springs(k, &[spring(0, -5.0)]).unwrap_err().to_string();
        assert_eq!(error, "swing has a stiffness of -5 N/m: it must be positive");
    }
}
