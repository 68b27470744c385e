//! Kernels of elements, evaluated block by block over the cells of a mesh.

use whirl_specs::{Batch, CellKernel, CellMatrix, Structure, Variable};

use crate::error::{Error, InvertedCell};
use crate::mesh::{Block, Mesh};

/// Cells evaluated by one call of a kernel: many lanes' worth, few enough to stay in cache.
const BATCH: usize = 256;

/// Inverted cells that an error lists.
const LISTED: usize = 5;

/// A kernel on a block of cells, with the values of its material.
pub(crate) struct BlockKernel<'a> {
    block: &'a Block,
    evaluate: CellKernel,
    material: Vec<f64>,
    /// Values a cell.
    stored: usize,
    /// Whether it takes displacements behind the coordinates.
    displaced: bool,
}

impl<'a> BlockKernel<'a> {
    /// That of a form, and how it stores a cell's matrix.
    ///
    /// # Errors
    /// [`Error::MissingForm`], [`Error::MissingProperty`].
    pub(crate) fn of_form(
        mesh: &Mesh,
        block: &'a Block,
        form: &str,
    ) -> Result<(Self, Structure), Error> {
        let element = block.element;
        let known = || element.forms.iter().map(|kernel| kernel.form).collect();
        let kernel = element.form(form).ok_or_else(|| missing(block, form, known()))?;
        let own = BlockKernel {
            block,
            evaluate: kernel.evaluate,
            material: properties(mesh, block, kernel.material, form)?,
            stored: kernel.structure.len(element.nodes),
            displaced: kernel.under_stress,
        };
        Ok((own, kernel.structure))
    }

    /// That of the stress that a form gives to a displacement: six values a point.
    ///
    /// # Errors
    /// As [`BlockKernel::of_form`].
    pub(crate) fn of_stress(mesh: &Mesh, block: &'a Block, form: &str) -> Result<Self, Error> {
        let element = block.element;
        let known = || element.stresses.iter().map(|kernel| kernel.form).collect();
        let kernel = element.stress_of(form).ok_or_else(|| missing(block, form, known()))?;
        Ok(BlockKernel {
            block,
            evaluate: kernel.evaluate,
            material: properties(mesh, block, kernel.material, form)?,
            stored: 6 * kernel.points.len(),
            displaced: true,
        })
    }
}

fn missing(block: &Block, form: &str, known: Vec<&str>) -> Error {
    let element = block.element.origin.name.to_owned();
    Error::MissingForm { element, form: form.to_owned(), known: known.join(", ") }
}

/// The values of a block's material, in the order of the kernel.
fn properties(
    mesh: &Mesh,
    block: &Block,
    wanted: &[Variable],
    form: &str,
) -> Result<Vec<f64>, Error> {
    let material = &mesh.materials()[block.material];
    let value = |own: &Variable| {
        material.properties.get(own.name).copied().ok_or_else(|| Error::MissingProperty {
            origin: mesh.origin().to_owned(),
            material: material.name.clone(),
            property: own.name.to_owned(),
            form: form.to_owned(),
        })
    };
    wanted.iter().map(value).collect()
}

/// Evaluates the kernels and hands the place of each one, a cell's nodes and its values to `take`. `displacement`: 3·nodes
/// (m), for those that take one.
///
/// # Errors
/// [`Error::InvertedCells`], naming the cells.
pub(crate) fn evaluate(
    mesh: &Mesh,
    kernels: &[BlockKernel],
    displacement: &[f64],
    mut take: impl FnMut(usize, &[usize], CellMatrix),
) -> Result<(), Error> {
    let mut inverted = Vec::new();
    let mut count = 0;
    for (place, kernel) in kernels.iter().enumerate() {
        let (block, stored) = (kernel.block, kernel.stored);
        let nodes = block.element.nodes;
        let mut coordinates = Vec::with_capacity(2 * BATCH * nodes * 3);
        let mut matrices = Batch::storage(BATCH, stored);
        let mut jacobians = vec![0.0; BATCH];
        let batches = block.connectivity.chunks(BATCH * nodes);
        for (connectivity, labels) in batches.zip(block.labels.chunks(BATCH)) {
            let cells = labels.len();
            coordinates.clear();
            for cell in connectivity.chunks_exact(nodes) {
                coordinates.extend(cell.iter().flat_map(|&node| mesh.nodes()[node]));
                if kernel.displaced {
                    coordinates.extend(cell.iter().flat_map(|&n| &displacement[3 * n..][..3]));
                }
            }
            let jacobians = &mut jacobians[..cells];
            (kernel.evaluate)(&coordinates, &kernel.material, &mut matrices, jacobians);
            for (&jacobian, &label) in jacobians.iter().zip(labels) {
                let upright = jacobian > 0.0;
                if !upright {
                    count += 1;
                    if inverted.len() < LISTED {
                        let element = block.element.origin.name.to_owned();
                        inverted.push(InvertedCell { label, element, jacobian });
                    }
                }
            }
            for (number, cell) in connectivity.chunks_exact(nodes).enumerate() {
                take(place, cell, CellMatrix::new(&matrices, stored, number));
            }
        }
    }
    if count > 0 {
        let origin = mesh.origin().to_owned();
        return Err(Error::InvertedCells { origin, cells: inverted, count });
    }
    Ok(())
}
