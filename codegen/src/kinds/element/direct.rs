//! A form on one cell without generated code, straight from the definitions: what kernels are tested
//! against, and the numbers in messages.

use std::array::from_fn;
use std::collections::BTreeMap;

use super::{ElementSpec, ModeJacobian};
use crate::expression::Id;
use crate::kinds::form::{Form, FormSpec, Stress};

/// The matrix of a form on one cell.
#[derive(Debug, Clone, PartialEq)]
pub struct CellMatrix {
    /// 3·nodes.
    pub size: usize,
    /// size × size, rows first; degree of freedom 3a + i is component i of node a.
    pub entries: Vec<f64>,
    /// Smallest det J over the points.
    pub(crate) least_det: f64,
}

/// A basis function at a point: weight of the point, then N, ∂N/∂x, ∂N/∂y, ∂N/∂z of every function, the
/// enhanced modes last.
struct AtPoint {
    weight: f64,
    basis: Vec<[f64; 4]>,
}

/// Evaluates a form on the cell with the given nodes (m) and material (SI, by name). `displacement`: of the nodes (m),
/// whose stress a form may be under; others do not read it.
pub fn evaluate(
    element: &ElementSpec,
    spec: &FormSpec,
    form: &Form,
    [nodes, displacement]: [&[[f64; 3]]; 2],
    material: &BTreeMap<String, f64>,
) -> CellMatrix {
    let (points, least_det) = points(element, form.integrated_as(), nodes);
    if let Some(stress) = &form.stress {
        let given = spec.forms.iter().find(|form| form.name == stress.form);
        let moves = given.map(|form| {
            let whole = summed(spec, form, &points, material);
            follow(&whole, displacement)
        });
        let mut stressed = vec![0.0; 9 * nodes.len() * nodes.len()];
        for point in &points {
            let slopes = slopes(point, moves.as_deref().unwrap_or_default());
            let coefficients = under_stress(spec, form, stress, &slopes, material);
            add(&mut stressed, nodes.len(), form, point, &coefficients);
        }
        return CellMatrix { size: 3 * nodes.len(), entries: stressed, least_det };
    }
    let mut entries = summed(spec, form, &points, material);
    let (total, size) = (entries.len().isqrt(), 3 * nodes.len());
    condense(&mut entries, total, size);
    let entries = entries.chunks(total).take(size).flat_map(|row| &row[..size]).copied().collect();
    CellMatrix { size, entries, least_det }
}

/// The matrix of all functions.
fn summed(
    spec: &FormSpec,
    form: &Form,
    points: &[AtPoint],
    material: &BTreeMap<String, f64>,
) -> Vec<f64> {
    let functions = points.first().map_or(0, |point| point.basis.len());
    let mut entries = vec![0.0; 9 * functions * functions];
    let coefficients = coefficients(spec, form, material);
    points.iter().for_each(|point| add(&mut entries, functions, form, point, &coefficients));
    entries
}

/// Adds what a point gives the first functions.
fn add(entries: &mut [f64], functions: usize, form: &Form, point: &AtPoint, coefficients: &[f64]) {
    let (total, basis) = (3 * functions, &point.basis[..functions]);
    for (place, coefficient) in form.bilinear.keys().zip(coefficients) {
        for (a, test) in basis.iter().enumerate() {
            for (b, trial) in basis.iter().enumerate() {
                entries[(3 * a + place.i) * total + 3 * b + place.j] +=
                    point.weight * coefficient * test[place.test] * trial[place.trial];
            }
        }
    }
}

/// Displacements of the nodes, then the parameters of the modes, on which no force acts: by Gauss without pivoting.
fn follow(whole: &[f64], displacement: &[[f64; 3]]) -> Vec<f64> {
    let (total, nodal) = (whole.len().isqrt(), displacement.as_flattened());
    let mut moves = nodal.to_vec();
    let own = nodal.len()..total;
    let mut matrix: Vec<Vec<f64>> =
        own.clone().map(|i| whole[i * total..(i + 1) * total][own.clone()].to_vec()).collect();
    let mut right: Vec<f64> = own
        .map(|i| -nodal.iter().enumerate().map(|(j, u)| whole[i * total + j] * u).sum::<f64>())
        .collect();
    for pivot in 0..right.len() {
        for row in 0..right.len() {
            if row != pivot {
                let factor = matrix[row][pivot] / matrix[pivot][pivot];
                let above = matrix[pivot].clone();
                matrix[row].iter_mut().zip(above).for_each(|(a, b)| *a -= factor * b);
                right[row] -= factor * right[pivot];
            }
        }
    }
    moves.extend((0..right.len()).map(|p| right[p] / matrix[p][p]));
    moves
}

/// ∂w_j/∂x_l at `[j][l]`.
fn slopes(point: &AtPoint, moves: &[f64]) -> [[f64; 3]; 3] {
    let functions = || point.basis.iter().zip(moves.chunks(3));
    from_fn(|j| from_fn(|l| functions().map(|(basis, w)| basis[1 + l] * w[j]).sum()))
}

/// Coefficients of a form under the stress of these slopes.
fn under_stress(
    spec: &FormSpec,
    form: &Form,
    stress: &Stress,
    slopes: &[[f64; 3]; 3],
    material: &BTreeMap<String, f64>,
) -> Vec<f64> {
    let (mut symbols, mut values) = known(spec, material);
    symbols.extend(stress.slopes.as_flattened());
    values.extend(slopes.as_flattened());
    let components = stress.components.as_flattened();
    let found = spec.graph.bytecode(&symbols, components).values(&values);
    // The six symbols of the components, each once.
    for place in [0, 1, 2, 4, 5, 8] {
        symbols.push(stress.symbols.as_flattened()[place]);
        values.push(found[place]);
    }
    let all: Vec<Id> = form.bilinear.values().copied().collect();
    spec.graph.bytecode(&symbols, &all).values(&values)
}

/// ∫ ∂M/∂(x, y, z) of every enhanced mode over a cell; zero if a patch of such cells passes under constant
/// strain.
pub(crate) fn mode_integrals(
    element: &ElementSpec,
    form: &str,
    nodes: &[[f64; 3]],
) -> Vec<[f64; 3]> {
    let (points, _) = points(element, form, nodes);
    let modes = element.enhanced_in(form).map_or(0, |enhanced| enhanced.modes.len());
    let integral = |m: usize, axis: usize| {
        points.iter().map(|point| point.weight * point.basis[nodes.len() + m][1 + axis]).sum()
    };
    (0..modes).map(|m| from_fn(|axis| integral(m, axis))).collect()
}

fn points(element: &ElementSpec, form: &str, nodes: &[[f64; 3]]) -> (Vec<AtPoint>, f64) {
    let table = element.table(form);
    let (inverse0, det0) = inverse(nodes, &table.centre_slopes);
    let mut points = Vec::with_capacity(table.weights.len());
    let mut least_det = f64::INFINITY;
    for (q, weight) in table.weights.iter().enumerate() {
        let (inverse, det) = inverse(nodes, &table.slopes[q]);
        least_det = least_det.min(det);
        let physical = |slope: &[f64; 3], inverse: &[[f64; 3]; 3]| -> [f64; 3] {
            from_fn(|i| (0..3).map(|k| slope[k] * inverse[k][i]).sum())
        };
        let mut basis: Vec<[f64; 4]> = Vec::new();
        for (value, slope) in table.values[q].iter().zip(&table.slopes[q]) {
            let [x, y, z] = physical(slope, &inverse);
            basis.push([*value, x, y, z]);
        }
        if let Some(enhanced) = element.enhanced_in(form) {
            let dets = [enhanced.det, enhanced.det0];
            let scale = element.graph.bytecode(&dets, &[enhanced.scale]).value(&[det, det0]);
            let inverse = match enhanced.jacobian {
                ModeJacobian::Centre => &inverse0,
                ModeJacobian::Point => &inverse,
            };
            for slope in &table.mode_slopes[q] {
                let [x, y, z] = physical(slope, inverse).map(|g| scale * g);
                basis.push([0.0, x, y, z]);
            }
        }
        points.push(AtPoint { weight: weight * det, basis });
    }
    (points, least_det)
}

/// J⁻¹ [reference][physical] and det J of J = Σ x_a ⊗ ∇N_a.
fn inverse(nodes: &[[f64; 3]], slopes: &[[f64; 3]]) -> ([[f64; 3]; 3], f64) {
    let j: [[f64; 3]; 3] =
        from_fn(|i| from_fn(|k| nodes.iter().zip(slopes).map(|(x, s)| x[i] * s[k]).sum()));
    let cofactor = |i: usize, k: usize| {
        let (p, q, r, s) = ((i + 1) % 3, (i + 2) % 3, (k + 1) % 3, (k + 2) % 3);
        j[p][r] * j[q][s] - j[p][s] * j[q][r]
    };
    let det = (0..3).map(|k| j[0][k] * cofactor(0, k)).sum();
    (from_fn(|k| from_fn(|i| cofactor(i, k) / det)), det)
}

/// Eliminates the last rows and columns, by Gauss without pivoting.
fn condense(entries: &mut [f64], total: usize, size: usize) {
    for pivot in (size..total).rev() {
        for row in 0..pivot {
            let factor = entries[row * total + pivot] / entries[pivot * total + pivot];
            for column in 0..pivot {
                entries[row * total + column] -= factor * entries[pivot * total + column];
            }
        }
    }
}

fn coefficients(spec: &FormSpec, form: &Form, material: &BTreeMap<String, f64>) -> Vec<f64> {
    let (symbols, values) = known(spec, material);
    let all: Vec<Id> = form.bilinear.values().copied().collect();
    spec.graph.bytecode(&symbols, &all).values(&values)
}

/// Symbols of material and coefficients, with their values.
fn known(spec: &FormSpec, material: &BTreeMap<String, f64>) -> (Vec<Id>, Vec<f64>) {
    let (mut symbols, mut values) = (Vec::new(), Vec::new());
    for property in &spec.material {
        symbols.push(property.symbol);
        values.push(material.get(&property.name).copied().unwrap_or(f64::NAN));
    }
    for coefficient in &spec.coefficients {
        values.push(spec.graph.bytecode(&symbols, &[coefficient.value]).value(&values));
        symbols.push(coefficient.symbol);
    }
    (symbols, values)
}
