//! What kernels of cells share, and the loop over cells.

use std::cell::Cell;
use std::marker::PhantomData;

use crate::Shared;
pub use crate::condensation::*;
pub use crate::jacobian::*;
use crate::matrices::{Batch, Matrix};
pub use crate::pairs::*;
use crate::registers::{Register, Registers, Task, Zeros};
pub use crate::triangle::*;

/// The matrix of a form on one lane of cells with NODES nodes: MATERIAL properties, LEN stored values.
///
/// # Safety
/// The workspace is memory that kernels share, typed as [`CellLanes::Workspace`]: before a kernel, and after one of another
/// type, its bytes are any numbers. So an implementation
/// * writes what it reads of the workspace first (else its results depend on the kernels before it), and
/// * leaves all of the workspace initialised: it writes fields and entries of them, never a value with padding over
///   the whole, and moves nothing out of it.
pub unsafe trait CellLanes<const NODES: usize, const MATERIAL: usize, const LEN: usize> {
    /// Memory for intermediate values, not cleared.
    type Workspace<L: Register>: Zeros;
    /// Whether the values of a cell keep to registers: then the way into lanes is part of the kernel, while all others
    /// share it.
    const IN_REGISTERS: bool;

    /// Fills the matrix and gives the smallest det J. To be `#[inline(always)]`.
    fn cell<L: Register>(
        x: &[[L; 3]; NODES],
        material: [L; MATERIAL],
        workspace: &mut Self::Workspace<L>,
        matrix: Matrix<L>,
    ) -> L;
}

/// The workspace of a kernel for one cell: the map at the points, values of all basis functions there, and what there is
/// before condensation.
#[derive(Debug, Clone)]
pub struct Workspace<
    L,
    const FUNCTIONS: usize,
    const POINTS: usize,
    const PARTS: usize,
    const ROWS: usize,
    W,
> {
    /// Different tangents ∂x/∂(ξ, η, ζ).
    pub tangents: [[L; 3]; ROWS],
    /// What turns reference gradients at the points into gradients in space, times √(w det J).
    pub maps: [[[L; 3]; 3]; POINTS],
    /// √(w det J) at the points.
    pub roots: [L; POINTS],
    /// `basis[function][point]`.
    pub basis: [[[L; PARTS]; POINTS]; FUNCTIONS],
    /// What there is before condensation.
    pub whole: W,
}

// SAFETY: nothing but its parts.
unsafe impl<L: Zeros, const F: usize, const P: usize, const A: usize, const R: usize, W: Zeros>
    Zeros for Workspace<L, F, P, A, R, W>
{
}

/// The same for a form of values only, which are constants at the points.
#[derive(Debug, Clone)]
pub struct Scalars<L, const POINTS: usize, const ROWS: usize> {
    /// Different tangents ∂x/∂(ξ, η, ζ).
    pub tangents: [[L; 3]; ROWS],
    /// w det J at the points, times a factor.
    pub det: [L; POINTS],
    /// The same times the values of one function.
    pub weighted: [L; POINTS],
}

// SAFETY: lanes only.
unsafe impl<L: Zeros, const P: usize, const R: usize> Zeros for Scalars<L, P, R> {}

thread_local! {
    /// For the workspaces of kernels, one after the other: clearing one for every call takes as long as some cells.
    static MEMORY: Cell<Vec<Batch>> = const { Cell::new(Vec::new()) };
}

/// A value in memory, with whatever the memory held before. To be written field by field: padding between them must stay the
/// numbers that it is.
#[inline(always)]
fn place<T: Zeros>(memory: &mut Vec<Batch>) -> &mut T {
    const { assert!(align_of::<T>() <= align_of::<Batch>()) };
    let needed = size_of::<T>().div_ceil(size_of::<Batch>());
    if memory.len() < needed {
        grow(memory, needed);
    }
    // SAFETY: so large and so aligned; initialised all of it, by `grow` and by what kernels promise; and any bits
    // are a value of the type.
    unsafe { &mut *memory.as_mut_ptr().cast::<T>() }
}

#[inline(never)]
fn grow(memory: &mut Vec<Batch>, needed: usize) {
    memory.resize(needed, Batch::default());
}

/// Evaluates a kernel for all cells, several side by side where the processor can. Arguments as of
/// [`crate::CellKernel`].
#[inline(always)]
pub fn each_cell<K: CellLanes<N, M, LEN>, const N: usize, const M: usize, const LEN: usize>(
    coordinates: &[f64],
    material: &[f64],
    matrices: &mut [Batch],
    jacobians: &mut [f64],
) {
    let mut properties = [0.0; M];
    properties.copy_from_slice(&material[..M]);
    let kernel = PhantomData::<K>;
    let mut memory = if K::IN_REGISTERS { Vec::new() } else { MEMORY.take() };
    Registers::current().run(EachCell {
        coordinates,
        properties,
        matrices,
        jacobians,
        memory: &mut memory,
        kernel,
    });
    if !K::IN_REGISTERS {
        MEMORY.set(memory);
    }
}

struct EachCell<'a, K, const N: usize, const M: usize, const LEN: usize> {
    coordinates: &'a [f64],
    properties: [f64; M],
    matrices: &'a mut [Batch],
    jacobians: &'a mut [f64],
    memory: &'a mut Vec<Batch>,
    kernel: PhantomData<K>,
}

impl<K: CellLanes<N, M, LEN>, const N: usize, const M: usize, const LEN: usize> Task
    for EachCell<'_, K, N, M, LEN>
{
    type Output = ();

    #[inline(always)]
    fn run<L: Register>(self) {
        let mut x = <[[L; 3]; N]>::zeros();
        let workspace = place::<K::Workspace<L>>(self.memory);
        let mut material = [L::splat(0.0); M];
        for (lane, property) in material.iter_mut().zip(&self.properties) {
            *lane = L::splat(*property);
        }
        let cells = self.jacobians.len();
        let mut cell = 0;
        while cell < cells {
            let nodes = x.as_flattened_mut();
            if K::IN_REGISTERS {
                L::gather(&self.coordinates[3 * N * cell..], nodes);
            } else {
                L::shared(Gather { rows: self.coordinates, cell, values: nodes });
            }
            let entries = &mut self.matrices[cell / Batch::CELLS * LEN..][..LEN];
            let matrix = Matrix::new(entries, cell % Batch::CELLS);
            let det = K::cell(&x, material, workspace, matrix);
            L::scatter(&[det], &mut self.jacobians[cell..]);
            cell += L::WIDTH;
        }
    }
}

/// Reads the cells from `cell` on. Lanes without a cell repeat the last one.
struct Gather<'a, L> {
    rows: &'a [f64],
    cell: usize,
    values: &'a mut [L],
}

impl<L: Register> Shared<L> for Gather<'_, L> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        L::gather(&self.rows[self.cell * self.values.len()..], self.values);
    }
}
