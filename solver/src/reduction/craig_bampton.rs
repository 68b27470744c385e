use serde::{Deserialize, Serialize};

use crate::linalg::{LowerTriangle, Matrix, transpose_multiply};
use crate::ordering::{Neighbours, nested_dissection};
use crate::sparse::SparseMatrix;

use super::constrained::Constraints;
use super::partition::{Interface, Partition};
use super::pencil::{Modes, Pencil};
use super::rigid::{free_shapes_of_parts, pins};
use super::solid::{Solid, lower};
use crate::error::ReductionError;
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
        self.fixed_interface(interface, modes)?
            .counted(|fixed| fixed.reduce(interface.corrections))?
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
        let (stiffness, mass) = (partition.inner(whole), partition.inner(mass));
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
    pub(super) fn pins(
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
    pub(super) fn order(&self, stiffness: &LowerTriangle, dofs: &[usize]) -> Vec<usize> {
        let nodes = self.coordinates.len();
        let mut neighbours: Neighbours = vec![Vec::new(); nodes];
        for dof in 0..stiffness.size {
            for (other, _) in stiffness.column(dof) {
                let (a, b) = (dof / 3, other / 3);
                if a != b {
                    push_new(&mut neighbours[a], b);
                    push_new(&mut neighbours[b], a);
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

/// Adds a neighbour that is not the last one.
fn push_new(neighbours: &mut Vec<usize>, node: usize) {
    if neighbours.last() != Some(&node) {
        neighbours.push(node);
    }
}
