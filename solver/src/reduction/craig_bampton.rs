use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use crate::linalg::{LinearAlgebraError, LowerTriangle, Matrix, transpose_multiply};
use crate::ordering::{Neighbours, nested_dissection};
use crate::sparse::SparseMatrix;

use super::modes::{Modes, Pencil};
use super::partition::{Interface, Parted, Partition};
use super::rigid::{Row, free_motions};
use super::updated::UpdatedCholesky;
use crate::error::{FreeMotion, ReductionError};

/// A body's mesh matrices. Dof 3a + i is the translation of node a along x, y, z (i = 0, 1, 2).
#[derive(Debug, Clone, Copy)]
pub struct Solid<'a> {
    /// K (N/m), 3·nodes, symmetric.
    pub stiffness: &'a SparseMatrix,
    /// M (kg), 3·nodes, symmetric.
    pub mass: &'a SparseMatrix,
    /// Node coordinates (m).
    pub coordinates: &'a [[f64; 3]],
    /// Bytes that the factor of K may take.
    pub memory: usize,
}

/// A body in Craig–Bampton coordinates: amplitudes of its fixed-interface modes, then the displacements
/// of its retained dofs. Source: Craig, Bampton, AIAA J. 6 (1968) 1313–1319.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct CraigBampton {
    /// Frequencies of the fixed-interface modes (Hz), ascending.
    pub hertz: Vec<f64>,
    /// Retained motions Σ cᵢ uᵢ over dofs i, in the order of their coordinates.
    pub retained: Vec<Row>,
    /// φ = [X Y; 0 I]: displacement of each dof (3·nodes rows) by a unit of each coordinate; the modes
    /// X come first, then the constraint modes Y. Rows of held dofs are zero, rows of dofs whose place a retained mean
    /// takes follow from the others.
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
        self.reduce(&Interface { retained: &retained, held: &[] }, modes)
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
        let retained = interface.retained;
        let partition = Partition::new(self.mass.size(), interface)?;
        let whole = lower(self.stiffness, "stiffness")?;
        let held = interface.held.iter().map(|&dof| vec![(dof, 1.0)]);
        let held: Vec<Row> = retained.iter().map(of_order_one).chain(held).collect();
        let motions = free_motions(self.coordinates, &whole, &held)?;
        if !motions.is_empty() {
            return Err(ReductionError::Mechanism { motions });
        }
        let parted = self.part(&whole, &partition, interface)?;
        let stiffness = &parted.inner;
        let mut mass = partition.part(&*lower(self.mass, "mass")?).inner;
        if stiffness.pairs.is_empty() && !mass.pairs.is_empty() {
            mass = mass.merged();
        }
        let order = self.order(&whole, &partition.inner);
        let components: Vec<usize> = partition.inner.iter().map(|dof| dof % 3).collect();
        let pencil = Pencil {
            stiffness,
            mass: &mass,
            order: &order,
            components: &components,
            memory: self.memory,
        };
        let loose = |row: usize| ReductionError::Mechanism {
            motions: vec![FreeMotion::Part { node: (partition.inner[row] / 3) as u64 }],
        };
        let (fixed, factor) = pencil.lowest_modes(modes).map_err(|error| match error {
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

        let (coupling, held) = partition.coupling(&whole, &parted);
        let mut constraint = coupling.clone();
        constraint.data.iter_mut().for_each(|value| *value = -*value);
        factor.solve_in_place(&mut constraint.data);

        // K̄ of the retained dofs is the Schur complement K_rr − K_ri K_ii⁻¹ K_ir.
        let mut condensed = transpose_multiply(coupling.view(), constraint.view());
        for (value, k) in condensed.data.iter_mut().zip(&held.data) {
            *value += k;
        }
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
        let partition = Partition::new(self.mass.size(), interface)?;
        let whole = lower(self.stiffness, "stiffness")?;
        let order = self.order(&whole, &partition.inner);
        let parted = self.part(&whole, &partition, interface)?;
        let factor = UpdatedCholesky::new(&parted.inner, &order, self.memory)?;
        let mut inner = partition.inner_load(force);
        factor.solve_in_place(&mut inner);
        Ok(partition.displacement(&inner))
    }

    /// The `count` lowest modes of the body with no dof held, rigid motions first.
    ///
    /// # Errors
    /// See [`ReductionError`].
    pub fn free_modes(&self, count: usize) -> Result<Modes, ReductionError> {
        let all: Vec<usize> = (0..self.mass.size()).collect();
        let (stiffness, mass) = (lower(self.stiffness, "stiffness")?, lower(self.mass, "mass")?);
        let components: Vec<usize> = all.iter().map(|dof| dof % 3).collect();
        let pencil = Pencil {
            stiffness: &stiffness.clone().into_owned().into(),
            mass: &mass.into_owned().into(),
            order: &self.order(&stiffness, &all),
            components: &components,
            memory: self.memory,
        };
        pencil.free_modes(count)
    }

    /// The stiffness in parts. Its factor begins without the pairs of the means, with the dofs that they replace at zero:
    /// where these leave the body loose, the pairs are put into the sparse matrix.
    fn part(
        &self,
        whole: &LowerTriangle,
        partition: &Partition,
        interface: &Interface,
    ) -> Result<Parted, ReductionError> {
        let mut parted = partition.part(whole);
        if parted.inner.pairs.is_empty() {
            return Ok(parted);
        }
        let single = interface.retained.iter().filter(|row| row.len() == 1).cloned();
        let dofs = interface.held.iter().copied().chain(partition.replaced());
        let rows: Vec<Row> = single.chain(dofs.map(|dof| vec![(dof, 1.0)])).collect();
        if !free_motions(self.coordinates, whole, &rows)?.is_empty() {
            let coupled = partition.coupled();
            let bytes = coupled.saturating_mul(coupled).saturating_mul(MERGED);
            if bytes > self.memory {
                let (size, limit) = (partition.inner.len(), self.memory);
                return Err(LinearAlgebraError::TooLarge { size, bytes, limit }.into());
            }
            parted.inner = parted.inner.merged();
        }
        Ok(parted)
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

/// Bytes for a pair of dofs of a mean that the sparse matrix and its factor have.
const MERGED: usize = 40;

/// A row divided by the sum of its coefficients' absolute values.
fn of_order_one(row: &Row) -> Row {
    let sum: f64 = row.iter().map(|(_, c)| c.abs()).sum();
    row.iter().map(|&(dof, c)| (dof, c / sum)).collect()
}

pub(super) fn lower<'a>(
    matrix: &'a SparseMatrix,
    name: &'static str,
) -> Result<Cow<'a, LowerTriangle>, ReductionError> {
    matrix.lower().ok_or(ReductionError::NotSymmetric { matrix: name })
}

/// The row of largest motion in the first mode, if that mode costs no more than rounding.
fn moves_freely(fixed: &Modes, pencil: &Pencil) -> Option<usize> {
    if *fixed.eigenvalues.first()? > pencil.blur() {
        return None;
    }
    let shape = fixed.vectors.col(0);
    (0..shape.len()).max_by(|&a, &b| shape[a].abs().total_cmp(&shape[b].abs()))
}
