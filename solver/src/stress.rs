//! Stresses of a displacement: at the points of the cells' rules, and at nodes.

use whirl_specs::Element;

use crate::cells::{BlockKernel, evaluate};
use crate::error::Error;
use crate::mesh::Mesh;

/// σ_xx, σ_yy, σ_zz, σ_xy, σ_yz, σ_zx (Pa).
pub type Stress = [f64; 6];

/// The form whose stress is asked for.
const FORM: &str = "stiffness";

/// √(3/2 s:s) with the deviator s of the stress (Pa), by von Mises.
pub fn von_mises([xx, yy, zz, xy, yz, zx]: &Stress) -> f64 {
    let normal = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
    (0.5 * normal + 3.0 * (xy.powi(2) + yz.powi(2) + zx.powi(2))).sqrt()
}

/// The stress at the points of every cell's rule, with the cells' own modes as they follow the displacement: a block each
/// of the mesh, cells × points.
///
/// `displacement`: 3·nodes (m).
///
/// # Errors
/// [`Error::MissingForm`], [`Error::MissingProperty`], or [`Error::InvertedCells`] naming the cells.
///
/// # Panics
/// If the displacement has fewer values.
pub fn at_points(mesh: &Mesh, displacement: &[f64]) -> Result<Vec<Vec<Vec<Stress>>>, Error> {
    let blocks = mesh.blocks().iter();
    let kernels: Vec<BlockKernel> =
        blocks.map(|block| BlockKernel::of_stress(mesh, block, FORM)).collect::<Result<_, _>>()?;
    let mut found: Vec<Vec<Vec<Stress>>> = vec![Vec::new(); kernels.len()];
    evaluate(mesh, &kernels, displacement, |place, _, values| {
        let values: Vec<f64> = values.values().collect();
        let (points, _) = values.as_chunks::<6>();
        found[place].push(points.to_vec());
    })?;
    Ok(found)
}

/// The stress at every node: in each cell the linear function that comes closest to the stress at the points, then the
/// mean of the cells at the node. Where cells of several materials meet, the mean of the material with the largest stress
/// by von Mises; zero at nodes of no cell.
///
/// `displacement`: 3·nodes (m).
///
/// # Errors
/// As [`at_points`].
///
/// # Panics
/// As [`at_points`].
pub fn at_nodes(mesh: &Mesh, displacement: &[f64]) -> Result<Vec<Stress>, Error> {
    let points = at_points(mesh, displacement)?;
    let mut largest = vec![[0.0; 6]; mesh.nodes().len()];
    for material in 0..mesh.materials().len() {
        let mut sums = vec![([0.0; 6], 0usize); mesh.nodes().len()];
        let blocks = mesh.blocks().iter().zip(&points);
        for (block, cells) in blocks.filter(|(block, _)| block.material == material) {
            let weights = nodes_from_points(block.element);
            for (cell, stresses) in block.cells().zip(cells) {
                for (&node, weights) in cell.iter().zip(&weights) {
                    let (sum, count) = &mut sums[node];
                    *count += 1;
                    for (weight, stress) in weights.iter().zip(stresses) {
                        sum.iter_mut().zip(stress).for_each(|(sum, own)| *sum += weight * own);
                    }
                }
            }
        }
        for (largest, (sum, count)) in largest.iter_mut().zip(sums) {
            let mean = sum.map(|own| own / count.max(1) as f64);
            if von_mises(&mean) > von_mises(largest) {
                *largest = mean;
            }
        }
    }
    Ok(largest)
}

/// Of values at the points of a rule, the values at the nodes of the cell's linear function that comes closest to them by
/// least squares with the weights of the rule: nodes × points.
fn nodes_from_points(element: &Element) -> Vec<Vec<f64>> {
    let Some(kernel) = element.stress_of(FORM) else { return Vec::new() };
    let at = |powers: &[u8; 3], x: &[f64; 3]| -> f64 {
        powers.iter().zip(x).map(|(power, x)| x.powi(i32::from(*power))).product()
    };
    let weight: Vec<f64> = kernel.points.iter().map(|(_, weight)| *weight).collect();
    let product = |a: &[f64], b: &[f64]| -> f64 {
        a.iter().zip(b).zip(&weight).map(|((a, b), weight)| weight * a * b).sum()
    };
    let mut fitted = vec![vec![0.0; weight.len()]; element.nodes];
    // Functions of length 1 and at right angles over the points, as values there and at the nodes.
    let mut functions: Vec<(Vec<f64>, Vec<f64>)> = Vec::new();
    for powers in kernel.linear {
        let mut points: Vec<f64> = kernel.points.iter().map(|(x, _)| at(powers, x)).collect();
        let mut nodes: Vec<f64> = element.reference_nodes.iter().map(|x| at(powers, x)).collect();
        let length = product(&points, &points).sqrt();
        for (other, at_nodes) in &functions {
            let along = product(&points, other);
            points.iter_mut().zip(other).for_each(|(own, other)| *own -= along * other);
            nodes.iter_mut().zip(at_nodes).for_each(|(own, other)| *own -= along * other);
        }
        let rest = product(&points, &points).sqrt();
        // What the points cannot tell from the functions before: rules with few points have less than a linear function.
        if rest <= 1e-9 * length {
            continue;
        }
        points.iter_mut().chain(&mut nodes).for_each(|value| *value /= rest);
        for (row, at_node) in fitted.iter_mut().zip(&nodes) {
            for ((entry, at_point), weight) in row.iter_mut().zip(&points).zip(&weight) {
                *entry += at_node * at_point * weight;
            }
        }
        functions.push((points, nodes));
    }
    fitted
}
