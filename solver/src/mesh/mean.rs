//! The mean motion of a set of nodes.

use std::collections::BTreeMap;

use super::Mesh;
use super::cut::Sample;
use super::surface::faces_within;
use crate::error::Error;
use crate::linalg::{Matrix, symmetric_eigen};

/// A set has no turn about an axis about which its second moment is less than this part of the largest: its nodes then
/// stand on the axis but for rounding.
const ON_AXIS: f64 = 1e-12;
/// An axis is no part of a line if its cosine with it is smaller.
const ON_LINE: f64 = 1e-6;

/// The rigid motion u = d + ω × (x − c) that fits the motion of a set of nodes best: it makes Σ w |u_a − u(x_a)|² least.
///
/// With c = Σ w x_a the displacement d at c is Σ w u_a, and the small rotation ω solves J ω = Σ w r_a × u_a with
/// r_a = x_a − c and J = Σ w (|r_a|² 1 − r_a r_aᵀ).
///
/// Where faces or cells are cut, sums over nodes are integrals over the area A of what is left, with the motion
/// u = Σ N_a u_a within them: w_a = ∫ N_a dA / A, J = ∫ (|r|² 1 − r rᵀ) dA / A, and ω solves J ω = ∫ r × u dA / A.
#[derive(Debug, Clone, PartialEq)]
pub struct NodeSetMean {
    /// The nodes that have a weight, ascending.
    nodes: Vec<usize>,
    /// w: one a node of `nodes`; they sum to 1.
    weights: Vec<f64>,
    /// c (m).
    centre: [f64; 3],
    /// Area of the faces (m²); none where the set has no whole face.
    area: Option<f64>,
    /// Factor and arm (m) of each node of `nodes`: w and r_a; or 1 and ∫ N_a (x − c) dA over the area.
    arms: Vec<(f64, [f64; 3])>,
    /// J⁻¹ (1/m²), without the axes that [`NodeSetMean::turns_about`] excludes.
    inverse: [[f64; 3]; 3],
    /// Unit vectors along these axes.
    undefined: Vec<[f64; 3]>,
    /// Unit vectors along axes about which places show no rotation, but turns of the nodes as dofs of their own do, and their
    /// mean over the nodes: Σ cᵢ uᵢ over dofs i.
    turned: Vec<([f64; 3], Vec<(usize, f64)>)>,
}

/// A component of a mean motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeanComponent {
    /// Displacement along x, y, z (0, 1, 2), in m.
    Displacement(usize),
    /// Small rotation about x, y, z (0, 1, 2), in rad.
    Rotation(usize),
}

impl MeanComponent {
    /// Displacements along x, y, z, then rotations about them.
    pub const ALL: [MeanComponent; 6] = [
        MeanComponent::Displacement(0),
        MeanComponent::Displacement(1),
        MeanComponent::Displacement(2),
        MeanComponent::Rotation(0),
        MeanComponent::Rotation(1),
        MeanComponent::Rotation(2),
    ];
}

impl NodeSetMean {
    /// The mean of a set of nodes, given by index in any order.
    ///
    /// Each node is weighted by its part of the area of the faces of cells that have all their nodes in the set: ∫ N_a dA
    /// over every such face, once where two cells share it. All nodes weigh the same where the set has no whole face: a
    /// line, or loose nodes.
    ///
    /// # Errors
    /// No nodes, or one that is not there.
    pub fn new(mesh: &Mesh, nodes: &[usize]) -> Result<NodeSetMean, Error> {
        let wrong = |what: String| Error::Mesh { origin: mesh.origin().to_owned(), what };
        let positions = mesh.nodes();
        if nodes.is_empty() {
            return Err(wrong("a set without nodes has no mean motion".to_owned()));
        }
        let mut inside = vec![false; positions.len()];
        for &node in nodes {
            *inside.get_mut(node).ok_or_else(|| wrong(format!("there is no node {node}")))? = true;
        }
        let areas = areas(mesh, &inside);
        let total: f64 = areas.iter().sum();
        let area = (total > 0.0).then_some(total);
        let has = |&node: &usize| match area {
            // Corners of six-node triangles have none, but for rounding.
            Some(area) => areas[node].abs() > 1e-12 * area,
            None => inside[node],
        };
        let nodes: Vec<usize> = (0..positions.len()).filter(has).collect();
        let weights: Vec<f64> = match area {
            Some(area) => nodes.iter().map(|&node| areas[node] / area).collect(),
            None => vec![1.0 / nodes.len() as f64; nodes.len()],
        };
        let own: Vec<[f64; 3]> = nodes.iter().map(|&node| positions[node]).collect();
        let mut mean = NodeSetMean::weighted(nodes, weights, &own, area)?;
        if let Some(matrices) = mesh.matrices() {
            mean.turn_by(&matrices.turns(mesh.labels(), &mean.nodes));
        }
        Ok(mean)
    }

    fn weighted(
        nodes: Vec<usize>,
        weights: Vec<f64>,
        positions: &[[f64; 3]],
        area: Option<f64>,
    ) -> Result<NodeSetMean, crate::linalg::LinearAlgebraError> {
        let mean = |axis: usize| weights.iter().zip(positions).map(|(w, x)| w * x[axis]).sum();
        let centre: [f64; 3] = [0, 1, 2].map(mean);
        let arms: Vec<[f64; 3]> =
            positions.iter().map(|x| [0, 1, 2].map(|axis| x[axis] - centre[axis])).collect();
        let moment = Matrix::from_fn(3, 3, |i, j| {
            let square = |r: &[f64; 3]| r.iter().map(|x| x * x).sum::<f64>();
            let term = |r: &[f64; 3]| if i == j { square(r) - r[i] * r[j] } else { -r[i] * r[j] };
            weights.iter().zip(&arms).map(|(w, r)| w * term(r)).sum()
        });
        let (inverse, undefined) = inverse_of(&moment)?;
        let arms = weights.iter().copied().zip(arms).collect();
        Ok(NodeSetMean {
            nodes,
            weights,
            centre,
            area,
            arms,
            inverse,
            undefined,
            turned: Vec::new(),
        })
    }

    /// The mean of sets by their names; of those by place whose faces are cut, that of the parts within.
    ///
    /// # Errors
    /// As [`NodeSetMean::new`], and a set that is not there.
    pub fn of_sets(mesh: &Mesh, names: &[&str]) -> Result<NodeSetMean, Error> {
        if !names.iter().any(|name| mesh.is_cut(name)) {
            let mut nodes = Vec::new();
            for name in names {
                nodes.extend_from_slice(mesh.node_set(name)?);
            }
            return NodeSetMean::new(mesh, &nodes);
        }
        let mut sums = Sums::default();
        for name in names {
            match mesh.place_of(name).filter(|own| own.is_cut()) {
                Some(own) => own.each_point(mesh, |sample| sums.add(sample)),
                None => {
                    let mut inside = vec![false; mesh.nodes().len()];
                    mesh.node_set(name)?.iter().for_each(|&node| inside[node] = true);
                    let faces = faces_within(mesh, &inside);
                    faces
                        .iter()
                        .for_each(|face| face.each_point(mesh.nodes(), |own| sums.add(own)));
                }
            }
        }
        sums.mean(mesh)
    }

    /// The mean of the section of all cells across z (m); none where no cell is cut there.
    ///
    /// # Errors
    /// Of linear algebra.
    pub fn of_section(mesh: &Mesh, z: f64) -> Result<Option<NodeSetMean>, Error> {
        let mut sums = Sums::default();
        mesh.each_point_of_section(z, |sample| sums.add(sample));
        if sums.area > 0.0 { sums.mean(mesh).map(Some) } else { Ok(None) }
    }

    /// Has nodes turn by dofs of their own about the axes that their places do not show; `turns` are these dofs about x, y and z,
    /// one a node.
    fn turn_by(&mut self, turns: &[[Option<usize>; 3]]) {
        let (weights, turned) = (&self.weights, &mut self.turned);
        self.undefined.retain(|line| {
            let parts = || (0..3).filter(|&axis| line[axis].abs() > ON_LINE);
            let mut row = Vec::with_capacity(turns.len());
            for (own, weight) in turns.iter().zip(weights) {
                for axis in parts() {
                    let Some(dof) = own[axis] else { return true };
                    row.push((dof, weight * line[axis]));
                }
            }
            turned.push((*line, row));
            false
        });
    }

    /// The nodes of which dofs are in the rows of the mean: those that have a weight, and those that hold their turns.
    pub(crate) fn all_nodes(&self) -> impl Iterator<Item = usize> {
        let turned = self.turned.iter().flat_map(|(_, row)| row.iter().map(|(dof, _)| dof / 3));
        self.nodes.iter().copied().chain(turned)
    }

    /// The nodes that have a weight, ascending.
    pub fn nodes(&self) -> &[usize] {
        &self.nodes
    }

    /// Weight of each of these nodes; they sum to 1.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// The point c (m) whose displacement is the mean displacement.
    pub fn centre(&self) -> [f64; 3] {
        self.centre
    }

    /// Area of the set's faces (m²); `None` where it has no whole face.
    pub fn area(&self) -> Option<f64> {
        self.area
    }

    /// Whether the set shows a turn about x, y or z (0, 1, 2): nodes on a line show none about the line, and one node shows
    /// none at all, unless their turns are dofs.
    pub fn turns_about(&self, axis: usize) -> bool {
        self.undefined.iter().all(|line| line[axis].abs() < ON_LINE)
    }

    /// Whether nodes show a turn by dofs of their own.
    pub fn has_turns(&self) -> bool {
        !self.turned.is_empty()
    }

    /// Σ cᵢ uᵢ over dofs i = 3·node + component that gives a component of the mean motion. A rotation that the set does not
    /// show (see [`NodeSetMean::turns_about`]) counts as zero.
    pub fn row(&self, motion: MeanComponent) -> Vec<(usize, f64)> {
        match motion {
            MeanComponent::Displacement(axis) => {
                let nodes = self.nodes.iter().zip(&self.weights);
                nodes.map(|(node, w)| (3 * node + axis, *w)).collect()
            }
            // ω_axis = Σ_a w (J⁻¹)_axis · (r × u) = Σ_a w ((J⁻¹)_axis × r) · u.
            MeanComponent::Rotation(axis) => {
                let [a, b, c] = self.inverse[axis];
                let nodes = self.nodes.iter().zip(&self.arms);
                let terms = nodes.flat_map(|(&node, (w, [x, y, z]))| {
                    let cross = [b * z - c * y, c * x - a * z, a * y - b * x];
                    cross.into_iter().enumerate().map(move |(i, value)| (3 * node + i, w * value))
                });
                let by_turns = self.turned.iter().flat_map(|(line, row)| {
                    row.iter().map(move |&(dof, value)| (dof, line[axis] * value))
                });
                let mut row: Vec<(usize, f64)> = terms.chain(by_turns).collect();
                row.sort_by_key(|(dof, _)| *dof);
                row.dedup_by(|other, own| {
                    let same = other.0 == own.0;
                    own.1 += if same { other.1 } else { 0.0 };
                    same
                });
                row.retain(|&(_, value)| value != 0.0);
                row
            }
        }
    }
}

/// J⁻¹ without the axes about which there is no moment, and unit vectors along these.
#[allow(clippy::type_complexity, reason = "a matrix and vectors")]
fn inverse_of(
    moment: &Matrix,
) -> Result<([[f64; 3]; 3], Vec<[f64; 3]>), crate::linalg::LinearAlgebraError> {
    let eigen = symmetric_eigen(moment)?;
    let largest = eigen.values[2].max(0.0);
    let mut inverse = [[0.0; 3]; 3];
    let mut undefined = Vec::new();
    for (k, &value) in eigen.values.iter().enumerate() {
        let axis = eigen.vectors.col(k);
        if value <= ON_AXIS * largest {
            undefined.push([axis[0], axis[1], axis[2]]);
            continue;
        }
        for (row, &x) in inverse.iter_mut().zip(axis) {
            row.iter_mut().zip(axis).for_each(|(entry, &y)| *entry += x * y / value);
        }
    }
    Ok((inverse, undefined))
}

/// Integrals over an area, about a point of it that keeps them small.
#[derive(Default)]
struct Sums {
    /// Where lengths count from (m); none before the first point.
    origin: Option<[f64; 3]>,
    /// ∫ dA (m²), ∫ x dA and ∫ x xᵀ dA.
    area: f64,
    first: [f64; 3],
    second: [[f64; 3]; 3],
    /// ∫ N_a dA and ∫ N_a x dA, a node each.
    of_nodes: BTreeMap<usize, (f64, [f64; 3])>,
}

impl Sums {
    fn add(&mut self, sample: &Sample) {
        let origin = *self.origin.get_or_insert(sample.at);
        let x = [0, 1, 2].map(|k| sample.at[k] - origin[k]);
        let area = sample.area.iter().map(|a| a * a).sum::<f64>().sqrt();
        self.area += area;
        for i in 0..3 {
            self.first[i] += area * x[i];
            (0..3).for_each(|j| self.second[i][j] += area * x[i] * x[j]);
        }
        for (&node, value) in sample.nodes.iter().zip(sample.values) {
            let (whole, moments) = self.of_nodes.entry(node).or_default();
            *whole += area * value;
            moments.iter_mut().zip(x).for_each(|(sum, x)| *sum += area * value * x);
        }
    }

    fn mean(self, mesh: &Mesh) -> Result<NodeSetMean, Error> {
        let (Some(origin), true) = (self.origin, self.area > 0.0) else {
            let what = "a set without area has no mean motion by area".to_owned();
            return Err(Error::Mesh { origin: mesh.origin().to_owned(), what });
        };
        let area = self.area;
        let middle = self.first.map(|sum| sum / area);
        let about = |i: usize, j: usize| self.second[i][j] / area - middle[i] * middle[j];
        let trace: f64 = (0..3).map(|k| about(k, k)).sum();
        let moment =
            Matrix::from_fn(3, 3, |i, j| if i == j { trace - about(i, j) } else { -about(i, j) });
        let (inverse, undefined) = inverse_of(&moment)?;
        let of_nodes = || self.of_nodes.values();
        let arm = |(weight, moments): &(f64, [f64; 3])| {
            (1.0, [0, 1, 2].map(|k| (moments[k] - weight * middle[k]) / area))
        };
        Ok(NodeSetMean {
            nodes: self.of_nodes.keys().copied().collect(),
            weights: of_nodes().map(|(weight, _)| weight / area).collect(),
            centre: [0, 1, 2].map(|k| origin[k] + middle[k]),
            area: Some(area),
            arms: of_nodes().map(arm).collect(),
            inverse,
            undefined,
            turned: Vec::new(),
        })
    }
}

/// ∫ N_a dA (m²) for every node of the mesh, over the faces all of whose nodes are `inside`, each once.
fn areas(mesh: &Mesh, inside: &[bool]) -> Vec<f64> {
    let mut areas = vec![0.0; inside.len()];
    for own in faces_within(mesh, inside) {
        for point in own.face.points {
            let mut tangents = [[0.0; 3]; 2];
            for (node, slope) in own.nodes().zip(point.slopes) {
                for (tangent, slope) in tangents.iter_mut().zip(slope) {
                    let position = mesh.nodes()[node];
                    tangent.iter_mut().zip(position).for_each(|(sum, x)| *sum += slope * x);
                }
            }
            let [[a, b, c], [x, y, z]] = tangents;
            let normal = [b * z - c * y, c * x - a * z, a * y - b * x];
            let area = point.weight * normal.iter().map(|n| n * n).sum::<f64>().sqrt();
            for (node, value) in own.nodes().zip(point.values) {
                areas[node] += area * value;
            }
        }
    }
    areas
}
