//! A body with its interface fixed: the modes that it has so and the factor of its stiffness, of which all that a reduction
//! is made of follows.

use std::borrow::Cow;

use crate::linalg::{LinearAlgebraError, LowerTriangle, Matrix, dot, transpose_multiply};
use crate::sparse::{Row, SparseMatrix};
use crate::together::both;

use super::constrained::{ConstrainedCholesky, Constraints};
use super::correction::corrected;
use super::craig_bampton::CraigBampton;
use super::modes::Uncounted;
use super::partition::{Interface, Partition};
use super::pencil::{Modes, Pencil};
use super::rigid::free_motions;
use super::solid::{Solid, lower};
use super::ties::Tied;
use crate::error::{FreeMotion, ReductionError};

/// Modes and factor of a body whose retained motions and held dofs are at zero.
pub(crate) struct FixedInterface<'a> {
    /// K and M of what the ties leave.
    stiffness: Cow<'a, SparseMatrix>,
    mass: Cow<'a, SparseMatrix>,
    /// Those of the inner dofs.
    inner: [LowerTriangle; 2],
    order: Vec<usize>,
    pins: Vec<usize>,
    components: Vec<usize>,
    memory: usize,
    /// As they were given, before ties.
    retained: Vec<Row>,
    /// How many modes were asked for.
    count: usize,
    modes: Modes,
    factored: Factored,
    uncounted: Option<Uncounted>,
}

/// The factor of the stiffness of the inner dofs.
pub(crate) struct Factored {
    tied: Option<Tied>,
    partition: Partition,
    factor: ConstrainedCholesky,
}

impl<'a> Solid<'a> {
    /// The body with its interface fixed, and the `count` lowest modes that it has so.
    ///
    /// # Errors
    /// See [`ReductionError`].
    pub(crate) fn fixed_interface(
        &self,
        interface: &Interface,
        count: usize,
    ) -> Result<FixedInterface<'a>, ReductionError> {
        let (tied, retained) = (self.tied(interface.held), interface.retained.to_vec());
        let Some(tied) = tied else {
            let matrices = (Cow::Borrowed(self.stiffness), Cow::Borrowed(self.mass));
            return self.found(matrices, None, (interface, retained), count);
        };
        let rows: Vec<Row> = retained.iter().map(|row| tied.row(row)).collect();
        let (stiffness, mass) = self.tied_matrices(&tied)?;
        let matrices = (Cow::Owned(stiffness), Cow::Owned(mass));
        let own = Interface { retained: &rows, ..*interface };
        self.found(matrices, Some(tied), (&own, retained), count)
    }

    /// The same of matrices in which nothing but the dependent dofs, which have no stiffness, follows from others.
    fn found(
        &self,
        (stiffness, mass): (Cow<'a, SparseMatrix>, Cow<'a, SparseMatrix>),
        tied: Option<Tied>,
        (interface, given): (&Interface, Vec<Row>),
        count: usize,
    ) -> Result<FixedInterface<'a>, ReductionError> {
        let retained = interface.retained;
        let dependent = tied.as_ref().map_or(&[][..], |tied| &tied.dependent);
        let partition = Partition::new(mass.size(), interface, dependent)?;
        let whole = lower(&stiffness, "stiffness")?;
        let held = interface.held.iter().map(|&dof| vec![(dof, 1.0)]);
        let held: Vec<Row> = retained.iter().map(of_order_one).chain(held).collect();
        let light = lower(&mass, "mass")?;
        let rest = || -> Result<_, ReductionError> {
            let motions = free_motions((self.coordinates, self.slots), &whole, &held)?;
            if !motions.is_empty() {
                return Err(ReductionError::Mechanism { motions });
            }
            let inner =
                [Cow::Borrowed(&*whole), light].map(|own| partition.inner(own).into_owned());
            Ok((inner, self.pins(&whole, &partition, interface)?))
        };
        let (order, rest) = both(|| self.order(&whole, &partition.inner), rest);
        let (inner, pins) = rest?;
        drop(whole);
        let components: Vec<usize> = partition.inner.iter().map(|dof| dof % 3).collect();
        let memory = self.memory;
        let pencil = pencil(&inner, (&order, &pins, &components), &partition, memory);
        // A mode that has lost its partner takes from a round body that it is round.
        let found = match pencil.lowest_pairs(count, pencil.counts_beside()) {
            // Counted before anything is made of them they take less.
            Err(ReductionError::LinearAlgebra(LinearAlgebraError::TooLarge { .. }))
                if pencil.counts_beside() =>
            {
                pencil.lowest_pairs(count, false)
            }
            found => found,
        };
        let (modes, factor, uncounted) = found.map_err(|error| of_body(error, &partition))?;
        if let Some(row) = moves_freely(&modes, &pencil) {
            return Err(loose(row, &partition));
        }
        let (retained, factored) = (given, Factored { tied, partition, factor });
        Ok(FixedInterface {
            stiffness,
            mass,
            inner,
            order,
            pins,
            components,
            memory,
            retained,
            count,
            modes,
            factored,
            uncounted,
        })
    }
}

impl Solid<'_> {
    /// The factor alone.
    ///
    /// # Errors
    /// As [`Solid::fixed_interface`], but that motions which nothing stops are named by a dof only.
    pub(crate) fn factored(&self, interface: &Interface) -> Result<Factored, ReductionError> {
        let (whole, tied) = (lower(self.stiffness, "stiffness")?, self.tied(interface.held));
        let (whole, retained) = match &tied {
            Some(tied) => (
                Cow::Owned(tied.matrix(&whole, self.memory)?),
                interface.retained.iter().map(|row| tied.row(row)).collect(),
            ),
            None => (whole, interface.retained.to_vec()),
        };
        let interface = &Interface { retained: &retained, ..*interface };
        let dependent = tied.as_ref().map_or(&[][..], |tied| &tied.dependent);
        let partition = Partition::new(self.mass.size(), interface, dependent)?;
        let order = self.order(&whole, &partition.inner);
        let pins = self.pins(&whole, &partition, interface)?;
        let constraints = Constraints { rows: &partition.rows, pins: &pins };
        let stiffness = partition.inner(whole);
        let mut factor = ConstrainedCholesky::new(&stiffness, &order, constraints, self.memory)?;
        factor.settle();
        Ok(Factored { tied, partition, factor })
    }
}

impl FixedInterface<'_> {
    /// What is made of it, while its modes are counted; made again where one of them was missing.
    ///
    /// # Errors
    /// See [`ReductionError`]: not those of what is made.
    pub(crate) fn counted<T: Send>(
        self,
        make: impl Fn(&Self) -> T + Sync,
    ) -> Result<T, ReductionError> {
        let (made, agrees) = both(|| make(&self), || self.agrees());
        if agrees? {
            return Ok(made);
        }
        drop(made);
        Ok(make(&self.found_again()?))
    }

    /// The same with its modes found anew by the same factor, and counted.
    fn found_again(self) -> Result<Self, ReductionError> {
        let Factored { tied, partition, factor } = self.factored;
        let parts = (&self.order[..], &self.pins[..], &self.components[..]);
        let pencil = pencil(&self.inner, parts, &partition, self.memory);
        let found = pencil.lowest_pairs_by(factor, self.count);
        let (modes, factor) = found.map_err(|error| of_body(error, &partition))?;
        if let Some(row) = moves_freely(&modes, &pencil) {
            return Err(loose(row, &partition));
        }
        let factored = Factored { tied, partition, factor };
        Ok(FixedInterface { modes, factored, uncounted: None, ..self })
    }

    /// Whether no mode is missing.
    fn agrees(&self) -> Result<bool, ReductionError> {
        match &self.uncounted {
            Some(found) => self.pencil().agrees(found, self.count, &self.factored.factor),
            None => Ok(true),
        }
    }

    fn pencil(&self) -> Pencil<'_> {
        let parts = (&self.order[..], &self.pins[..], &self.components[..]);
        pencil(&self.inner, parts, &self.factored.partition, self.memory)
    }

    /// The reduction with these modes and, beside them, what answers these loads on dofs.
    ///
    /// # Errors
    /// Of the linear algebra.
    pub(crate) fn reduce(&self, corrections: &[Row]) -> Result<CraigBampton, ReductionError> {
        let Factored { tied, partition, factor } = &self.factored;
        let pencil = self.pencil();
        let loads = self.factored.loads(corrections);
        let fixed = corrected(self.modes.clone(), &pencil, factor, loads)?;
        let modes = fixed.eigenvalues.len();

        let (coupling, held) = partition.coupling(&*lower(&self.stiffness, "stiffness")?);
        let mut constraint = coupling.clone();
        constraint.data.iter_mut().for_each(|value| *value = -*value);
        let multipliers = factor.solve_with(&mut constraint.data, &partition.given());

        // K̄ of the retained dofs is the Schur complement K_rr − K_ri K_ii⁻¹ K_ir, that of the means what brings them about.
        let mut condensed = transpose_multiply(coupling.view(), constraint.view());
        for (value, k) in condensed.data.iter_mut().zip(&held.data) {
            *value += k;
        }
        partition.add_multipliers(&multipliers, &mut condensed);
        let condensed = condensed.symmetric_part();
        let size = modes + self.retained.len();
        let stiffness = Matrix::from_fn(size, size, |i, j| {
            match (i.checked_sub(modes), j.checked_sub(modes)) {
                (Some(i), Some(j)) => condensed[(i, j)],
                (None, None) if i == j => fixed.eigenvalues[i],
                _ => 0.0,
            }
        });
        let shapes = partition.shapes(&fixed.vectors, &constraint);
        let mut reduced = CraigBampton {
            hertz: fixed.hertz(),
            retained: self.retained.clone(),
            shapes,
            mass: Matrix::default(),
            stiffness,
        };
        let mass = reduced.reduce(&self.mass).symmetric_part();
        reduced.mass = Matrix::from_fn(size, size, |i, j| match (i < modes, j < modes) {
            (true, true) if i == j => 1.0,
            (true, true) => 0.0,
            _ => mass[(i, j)],
        });
        tied.iter().for_each(|tied| tied.expand(&mut reduced.shapes));
        Ok(reduced)
    }

    /// The factor.
    pub(crate) fn factored(&self) -> &Factored {
        &self.factored
    }
}

impl Factored {
    /// Loads on dofs as columns over the inner ones.
    fn loads(&self, loads: &[Row]) -> Matrix {
        match &self.tied {
            Some(tied) => {
                let rows: Vec<Row> = loads.iter().map(|load| tied.row(load)).collect();
                self.partition.inner_loads(&rows)
            }
            None => self.partition.inner_loads(loads),
        }
    }

    /// The displacement under each of these loads in its own direction, with the retained motions and the held dofs at
    /// zero.
    pub(crate) fn compliances(&self, loads: &[Row]) -> Vec<f64> {
        let loads = self.loads(loads);
        let mut moved = loads.clone();
        self.factor.solve_in_place(&mut moved.data);
        (0..loads.cols).map(|j| dot(loads.col(j), moved.col(j))).collect()
    }

    /// The displacement under `force` (N, 3·nodes) with the retained motions and the held dofs at zero; 3·nodes values, in m.
    pub(crate) fn displacement(&self, force: &[f64]) -> Vec<f64> {
        let tied = self.tied.as_ref();
        let force = tied.map_or(Cow::Borrowed(force), |tied| tied.forces(force).into());
        let mut inner = self.partition.inner_load(&force);
        self.factor.solve_in_place(&mut inner);
        let data = self.partition.displacement(&inner);
        let mut moved = Matrix { rows: data.len(), cols: 1, data };
        tied.iter().for_each(|tied| tied.expand(&mut moved));
        moved.data
    }
}

fn pencil<'p>(
    [stiffness, mass]: &'p [LowerTriangle; 2],
    (order, pins, components): (&'p [usize], &'p [usize], &'p [usize]),
    partition: &'p Partition,
    memory: usize,
) -> Pencil<'p> {
    let constraints = Constraints { rows: &partition.rows, pins };
    Pencil { stiffness, mass, order, constraints, components, memory, columns: partition.retained }
}

fn loose(row: usize, partition: &Partition) -> ReductionError {
    ReductionError::Mechanism {
        motions: vec![FreeMotion::Part { node: (partition.inner[row] / 3) as u64 }],
    }
}

/// An error with nodes of the body for rows of the inner dofs.
fn of_body(error: ReductionError, partition: &Partition) -> ReductionError {
    match error {
        ReductionError::LinearAlgebra(LinearAlgebraError::NotPositiveDefinite { row, .. }) => {
            loose(row, partition)
        }
        ReductionError::Hidden { node: row, stiffest, modes, .. } => {
            let dof = partition.inner[row as usize];
            let (node, component) = ((dof / 3) as u64, dof % 3);
            ReductionError::Hidden { node, component, stiffest, modes }
        }
        error => error,
    }
}

/// A row divided by the sum of its coefficients' absolute values.
fn of_order_one(row: &Row) -> Row {
    let sum: f64 = row.iter().map(|(_, c)| c.abs()).sum();
    row.iter().map(|&(dof, c)| (dof, c / sum)).collect()
}

/// The row of largest motion in the first mode, if that mode costs no more than rounding.
fn moves_freely(fixed: &Modes, pencil: &Pencil) -> Option<usize> {
    if *fixed.eigenvalues.first()? > pencil.blur() {
        return None;
    }
    let shape = fixed.vectors.col(0);
    (0..shape.len()).max_by(|&a, &b| shape[a].abs().total_cmp(&shape[b].abs()))
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    /// Unconnected oscillators, twelve each with ω² = 1, 2 and 3, of which the iteration misses some at first.
    #[test]
    fn what_was_made_of_too_few_modes_is_made_again() {
        let n = 402;
        let square = |dof: usize| match dof {
            0..36 => (1 + dof / 12) as f64,
            _ => 1e6 * (1.0 + 1e-5 * dof as f64 / n as f64),
        };
        let diagonal = |value: &dyn Fn(usize) -> f64| {
            SparseMatrix::Symmetric(LowerTriangle::from_columns(n, |j| {
                std::iter::once((j, value(j)))
            }))
        };
        let (stiffness, mass) = (diagonal(&square), diagonal(&|_| 1.0));
        let coordinates: Vec<[f64; 3]> =
            (0..n / 3).map(|k| [(k % 5) as f64, (k % 7) as f64, k as f64]).collect();
        let solid = Solid {
            coordinates: &coordinates,
            slots: &[],
            stiffness: &stiffness,
            mass: &mass,
            ties: &[],
            memory: usize::MAX,
        };
        let fixed = solid.fixed_interface(&Interface::default(), 15).unwrap();
        assert!(fixed.uncounted.is_some() && !fixed.agrees().unwrap());
        let times = AtomicUsize::new(0);
        let found = fixed.counted(|own| {
            times.fetch_add(1, Ordering::Relaxed);
            own.modes.eigenvalues.clone()
        });
        let found = found.unwrap();
        assert_eq!(times.into_inner(), 2);
        for (k, value) in found[..15].iter().enumerate() {
            assert!((value / square(k) - 1.0).abs() < 1e-10, "{found:?}");
        }
    }
}
