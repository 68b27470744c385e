use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::linalg::{LinearAlgebraError, LowerTriangle, Matrix, dot, transpose_multiply};
use crate::ordering::{Neighbours, nested_dissection};
use crate::sparse::SparseMatrix;

use super::constrained::{ConstrainedCholesky, Constraints};
use super::correction::corrected;
use super::partition::{Interface, Partition};
use super::pencil::{Modes, Pencil};
use super::rigid::{free_motions, free_shapes_of_parts, pins};
use super::solid::{Solid, lower};
use super::ties::Tied;
use crate::error::{FreeMotion, ReductionError};
use crate::sparse::Row;

/// A body in Craig–Bampton coordinates: amplitudes of its fixed-interface modes, then the displacements
/// of its retained dofs. Source: Craig, Bampton, AIAA J. 6 (1968) 1313–1319.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CraigBampton {
    /// Frequencies of the fixed-interface modes (Hz), ascending; behind them those of the shapes that correct the statics.
    pub hertz: Vec<f64>,
    /// Retained motions Σ cᵢ uᵢ over dofs i, in the order of their coordinates.
    pub retained: Vec<Row>,
    /// φ = [X Y; 0 I]: displacement of each dof (3·nodes rows) by a unit of each coordinate; the modes
    /// X come first, then the constraint modes Y. Rows of held dofs are zero.
    pub shapes: Matrix,
    /// M̄ = φᵀMφ.
    pub mass: Matrix,
    /// K̄ = φᵀKφ: diagonal ω² for the modes, coupled to nothing, then that of the retained dofs.
    pub stiffness: Matrix,
}

impl CraigBampton {
    /// Number of fixed-interface modes.
    pub fn modes(&self) -> usize {
        self.hertz.len()
    }

    /// Number of coordinates, modes and retained dofs.
    pub fn coordinates(&self) -> usize {
        self.shapes.cols
    }

    /// φᵀAφ for a matrix A of the body.
    pub fn reduce(&self, matrix: &SparseMatrix) -> Matrix {
        let mut product = Matrix::zeros(self.shapes.rows, self.shapes.cols);
        matrix.multiply(&self.shapes.data, &mut product.data);
        transpose_multiply(self.shapes.view(), product.view())
    }

    /// The rows of φ of one node: 3 × coordinates.
    pub fn node(&self, node: usize) -> Matrix {
        Matrix::from_fn(3, self.shapes.cols, |i, j| self.shapes[(3 * node + i, j)])
    }
}

impl Solid<'_> {
    /// The Craig–Bampton reduction with `modes` fixed-interface modes and these dofs retained.
    ///
    /// # Errors
    /// See [`ReductionError`].
    pub fn craig_bampton(
        &self,
        retained: &[usize],
        modes: usize,
    ) -> Result<CraigBampton, ReductionError> {
        let retained: Vec<Row> = retained.iter().map(|&dof| vec![(dof, 1.0)]).collect();
        self.reduce(&Interface { retained: &retained, ..Interface::default() }, modes)
    }

    /// The Craig–Bampton reduction with `modes` fixed-interface modes: those with the retained motions and the held dofs at
    /// zero. Held dofs have no coordinates, and cost no constraint modes.
    ///
    /// # Errors
    /// See [`ReductionError`].
    pub fn reduce(
        &self,
        interface: &Interface,
        modes: usize,
    ) -> Result<CraigBampton, ReductionError> {
        let Some(tied) = self.tied(interface.held) else {
            return self.reduce_free(interface, &[], modes);
        };
        let rows = |rows: &[Row]| -> Vec<Row> { rows.iter().map(|row| tied.row(row)).collect() };
        let (retained, corrections) = (rows(interface.retained), rows(interface.corrections));
        let own = Interface { retained: &retained, corrections: &corrections, ..*interface };
        let (stiffness, mass) = self.tied_matrices(&tied)?;
        let solid = Solid { stiffness: &stiffness, mass: &mass, ties: &[], ..*self };
        let mut reduced = solid.reduce_free(&own, &tied.dependent, modes)?;
        tied.expand(&mut reduced.shapes);
        Ok(CraigBampton { retained: interface.retained.to_vec(), ..reduced })
    }

    /// [`Solid::reduce`] of a body in which nothing but `dependent` dofs, which have no stiffness, follows from others.
    fn reduce_free(
        &self,
        interface: &Interface,
        dependent: &[usize],
        modes: usize,
    ) -> Result<CraigBampton, ReductionError> {
        let retained = interface.retained;
        let partition = Partition::new(self.mass.size(), interface, dependent)?;
        let whole = lower(self.stiffness, "stiffness")?;
        let held = interface.held.iter().map(|&dof| vec![(dof, 1.0)]);
        let held: Vec<Row> = retained.iter().map(of_order_one).chain(held).collect();
        let motions = free_motions((self.coordinates, self.slots), &whole, &held)?;
        if !motions.is_empty() {
            return Err(ReductionError::Mechanism { motions });
        }
        let stiffness = partition.inner(&whole);
        let mass = partition.inner(&*lower(self.mass, "mass")?);
        let order = self.order(&whole, &partition.inner);
        let pins = self.pins(&whole, &partition, interface)?;
        let components: Vec<usize> = partition.inner.iter().map(|dof| dof % 3).collect();
        let pencil = Pencil {
            stiffness: &stiffness,
            mass: &mass,
            order: &order,
            constraints: Constraints { rows: &partition.rows, pins: &pins },
            components: &components,
            memory: self.memory,
            columns: retained.len(),
        };
        let loose = |row: usize| ReductionError::Mechanism {
            motions: vec![FreeMotion::Part { node: (partition.inner[row] / 3) as u64 }],
        };
        // A mode that has lost its partner takes from a round body that it is round.
        let found = pencil.lowest_pairs(modes);
        let (fixed, factor) = found.map_err(|error| match error {
            ReductionError::LinearAlgebra(LinearAlgebraError::NotPositiveDefinite {
                row, ..
            }) => loose(row),
            ReductionError::Hidden { node: row, stiffest, modes, .. } => {
                let dof = partition.inner[row as usize];
                let (node, component) = ((dof / 3) as u64, dof % 3);
                ReductionError::Hidden { node, component, stiffest, modes }
            }
            error => error,
        })?;
        if let Some(row) = moves_freely(&fixed, &pencil) {
            return Err(loose(row));
        }

        let loads = partition.inner_loads(interface.corrections);
        let fixed = corrected(fixed, &pencil, &factor, loads)?;
        let modes = fixed.eigenvalues.len();

        let (coupling, held) = partition.coupling(&whole);
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
        let size = modes + retained.len();
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
            retained: retained.to_vec(),
            shapes,
            mass: Matrix::default(),
            stiffness,
        };
        let mass = reduced.reduce(self.mass).symmetric_part();
        reduced.mass = Matrix::from_fn(size, size, |i, j| match (i < modes, j < modes) {
            (true, true) if i == j => 1.0,
            (true, true) => 0.0,
            _ => mass[(i, j)],
        });
        Ok(reduced)
    }

    /// The displacement under `force` (N, 3·nodes) with the retained motions and the held dofs at zero; 3·nodes values, in m.
    ///
    /// # Errors
    /// As [`Solid::reduce`], but that motions which nothing stops are named by a dof only.
    pub(crate) fn held(
        &self,
        interface: &Interface,
        force: &[f64],
    ) -> Result<Vec<f64>, ReductionError> {
        let tied = self.tied(interface.held);
        let force = tied.as_ref().map_or(Cow::Borrowed(force), |tied| tied.forces(force).into());
        let (partition, factor) = self.factored(interface, tied.as_ref())?;
        let mut inner = partition.inner_load(&force);
        factor.solve_in_place(&mut inner);
        let data = partition.displacement(&inner);
        let mut moved = Matrix { rows: data.len(), cols: 1, data };
        tied.iter().for_each(|tied| tied.expand(&mut moved));
        Ok(moved.data)
    }

    /// The displacement under each of these loads in its own direction, with the retained motions and the held dofs at
    /// zero.
    ///
    /// # Errors
    /// As [`Solid::held`].
    pub(crate) fn compliances(
        &self,
        interface: &Interface,
        loads: &[Row],
    ) -> Result<Vec<f64>, ReductionError> {
        let tied = self.tied(interface.held);
        let own: Vec<Row> = match &tied {
            Some(tied) => loads.iter().map(|load| tied.row(load)).collect(),
            None => loads.to_vec(),
        };
        let (partition, factor) = self.factored(interface, tied.as_ref())?;
        let loads = partition.inner_loads(&own);
        let mut moved = loads.clone();
        factor.solve_in_place(&mut moved.data);
        Ok((0..loads.cols).map(|j| dot(loads.col(j), moved.col(j))).collect())
    }

    /// What is inner, and the factor of its stiffness.
    fn factored(
        &self,
        interface: &Interface,
        tied: Option<&Tied>,
    ) -> Result<(Partition, ConstrainedCholesky), ReductionError> {
        let whole = lower(self.stiffness, "stiffness")?;
        let (whole, retained, dependent) = match tied {
            Some(tied) => (
                Cow::Owned(tied.matrix(&whole, self.memory)?),
                interface.retained.iter().map(|row| tied.row(row)).collect(),
                &tied.dependent[..],
            ),
            None => (whole, interface.retained.to_vec(), &[][..]),
        };
        let interface = &Interface { retained: &retained, ..*interface };
        let partition = Partition::new(self.mass.size(), interface, dependent)?;
        let order = self.order(&whole, &partition.inner);
        let pins = self.pins(&whole, &partition, interface)?;
        let constraints = Constraints { rows: &partition.rows, pins: &pins };
        let stiffness = partition.inner(&whole);
        let factor = ConstrainedCholesky::new(&stiffness, &order, constraints, self.memory)?;
        Ok((partition, factor))
    }

    /// The `count` lowest modes of the body with no dof held, rigid motions first.
    ///
    /// # Errors
    /// See [`ReductionError`].
    pub fn free_modes(&self, count: usize) -> Result<Modes, ReductionError> {
        if let Some(tied) = self.tied(&[]) {
            let (stiffness, mass) = self.tied_matrices(&tied)?;
            let solid = Solid { stiffness: &stiffness, mass: &mass, ties: &[], ..*self };
            let mut modes = solid.free_modes_of(&tied.dependent, count)?;
            tied.expand(&mut modes.vectors);
            return Ok(modes);
        }
        self.free_modes_of(&[], count)
    }

    /// [`Solid::free_modes`] of a body in which nothing but `dependent` dofs follows from others.
    fn free_modes_of(&self, dependent: &[usize], count: usize) -> Result<Modes, ReductionError> {
        let partition = Partition::new(self.mass.size(), &Interface::default(), dependent)?;
        let (whole, mass) = (lower(self.stiffness, "stiffness")?, lower(self.mass, "mass")?);
        let components: Vec<usize> = partition.inner.iter().map(|dof| dof % 3).collect();
        let order = self.order(&whole, &partition.inner);
        let (stiffness, mass) = match dependent {
            [] => (whole, mass),
            _ => (Cow::Owned(partition.inner(&whole)), Cow::Owned(partition.inner(&mass))),
        };
        let pencil = Pencil {
            stiffness: &stiffness,
            mass: &mass,
            order: &order,
            constraints: Constraints::NONE,
            components: &components,
            memory: self.memory,
            columns: 0,
        };
        let Modes { eigenvalues, vectors } = pencil.free_modes(count)?;
        let none = Matrix::zeros(partition.inner.len(), 0);
        Ok(Modes { eigenvalues, vectors: partition.shapes(&vectors, &none) })
    }

    /// Inner dofs, by their places, without which nothing of the body moves freely while its means may: those that the rigid
    /// motions move most. None where there are no means.
    fn pins(
        &self,
        whole: &LowerTriangle,
        partition: &Partition,
        interface: &Interface,
    ) -> Result<Vec<usize>, ReductionError> {
        if partition.rows.is_empty() {
            return Ok(Vec::new());
        }
        let single = interface.retained.iter().filter(|row| matches!(row[..], [(_, 1.0)])).cloned();
        let held = interface.held.iter().map(|&dof| vec![(dof, 1.0)]);
        let rows: Vec<Row> = single.chain(held).collect();
        let motions = free_shapes_of_parts((self.coordinates, self.slots), whole, &rows)?;
        Ok(pins(motions, &partition.inner))
    }

    /// Order of elimination of the dofs listed (ascending), as places in that list.
    fn order(&self, stiffness: &LowerTriangle, dofs: &[usize]) -> Vec<usize> {
        let nodes = self.coordinates.len();
        let mut neighbours: Neighbours = vec![Vec::new(); nodes];
        for dof in 0..stiffness.size {
            for (other, _) in stiffness.column(dof) {
                let (a, b) = (dof / 3, other / 3);
                if a != b {
                    neighbours[a].push(b);
                    neighbours[b].push(a);
                }
            }
        }
        for row in &mut neighbours {
            row.sort_unstable();
            row.dedup();
        }
        let mut place = vec![None; stiffness.size];
        for (index, &dof) in dofs.iter().enumerate() {
            place[dof] = Some(index);
        }
        nested_dissection(self.coordinates, &neighbours)
            .into_iter()
            .flat_map(|node| [3 * node, 3 * node + 1, 3 * node + 2])
            .filter_map(|dof| place[dof])
            .collect()
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
