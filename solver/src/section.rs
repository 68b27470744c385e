//! Sections of a body: how they move, and what the part beyond one exerts on the part before it, as rows over the coordinates.
//!
//! A mesh is cut between its cells. With the forces (K + Ω²G) u of the cells beyond on the nodes that they share with those before, and
//! their part of M(a − g) there, the force that passes the section is −Σ ((K + Ω²G) u + M(a − g)). It is the sum of what acts on the part
//! beyond, inertia included, as far as the coordinates of the body answer that: so the answers to accelerations of the body,
//! linear in place, and to the inertia of these answers are kept beside its modes. What stands is then exact; of motions below
//! the modes of the body some 1e-3 of the largest force may be missing.

use serde::{Deserialize, Serialize};

use crate::assembly::each_cell;
use crate::body::{Coordinates, Rayleigh};
use crate::error::Error;
use crate::linalg::{Matrix, multiply};
use crate::measure::MeanMotion;
use crate::mesh::{Block, MeanComponent, Mesh, NodeSetMean};
use crate::reduction::{CraigBampton, Row};
use crate::sparse::SparseMatrix;

/// Nodes of a section stand at its z to this part of the body's length.
const FLAT: f64 = 1e-6;
/// Nodes that an end face has at least.
const FACE: usize = 3;

/// A section of a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Section {
    /// Mean motion of its nodes.
    pub motion: MeanMotion,
    /// Force of the part at larger z on that at smaller z, along x, y, z by a unit of each coordinate (N): 3 × n.
    pub force: Matrix,
    /// Its moment about x, y, z through the point of the section on the axis (N·m): 3 × n.
    pub moment: Matrix,
    /// The same by the centrifugal stress at Ω = 1; none of a body that it does not stiffen.
    pub stressed: Option<[Matrix; 2]>,
    /// Mass of the cells beyond, as its nodes share it.
    pub mass: SharedMass,
    /// Force by rates over that by displacements (s): β of the body's damping.
    pub damping: f64,
}

/// Mass of the cells beyond a section that is at the nodes of the section, over which the sums are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SharedMass {
    /// Σ m, Σ m x and Σ m y of what is there (kg, kg·m).
    pub moments: [f64; 3],
    /// Σ m u, Σ m x u and Σ m y u by a unit of each coordinate: 3 × n each.
    pub moved: [Matrix; 3],
    /// Σ m p with the places p of what is there (kg·m).
    pub places: [f64; 3],
}

impl Section {
    /// z (m).
    pub fn z(&self) -> f64 {
        self.motion.centre[2]
    }

    /// Over other coordinates, of which these are a transform.
    pub(crate) fn over(&self, transform: &Matrix) -> Section {
        let over = |rows: &Matrix| multiply(rows.view(), transform.view());
        Section {
            motion: self.motion.over(transform),
            force: over(&self.force),
            moment: over(&self.moment),
            stressed: self.stressed.as_ref().map(|own| own.each_ref().map(over)),
            mass: SharedMass { moved: self.mass.moved.each_ref().map(over), ..self.mass },
            damping: self.damping,
        }
    }
}

/// Sections in active coordinates.
pub(crate) fn active(all: &[Section], active: &Coordinates, damping: Rayleigh) -> Vec<Section> {
    let own = all.iter().map(|own| own.over(&active.transform));
    own.map(|own| Section { damping: damping.beta, ..own }).collect()
}

/// A cut of a mesh, between the cells whose middle is beyond it and the others.
struct Cut {
    /// Whether a node is one of both.
    shared: Vec<bool>,
    /// Where it was asked for (m).
    asked: f64,
    /// z of the nodes (m).
    z: f64,
}

/// Planes of nodes nearest to these z (m), each once, at which a mesh can be cut: those with cells on both sides, and with no ties
/// of loose cells from one side to the other; and its end faces. None of a body of matrices.
pub fn planes(mesh: &Mesh, wanted: &[f64]) -> Vec<f64> {
    cuts(mesh, wanted).into_iter().map(|own| own.z).collect()
}

fn middle(mesh: &Mesh, cell: &[usize]) -> f64 {
    cell.iter().map(|&node| mesh.nodes()[node][2]).sum::<f64>() / cell.len() as f64
}

fn cuts(mesh: &Mesh, wanted: &[f64]) -> Vec<Cut> {
    let ends = mesh.ends();
    let ties = mesh.tie_rows();
    let mut found: Vec<Cut> = Vec::new();
    for &asked in wanted {
        let count = mesh.nodes().len();
        let [mut before, mut beyond] = [vec![false; count], vec![false; count]];
        for cell in mesh.blocks().iter().flat_map(Block::cells) {
            let side = if middle(mesh, cell) > asked { &mut beyond } else { &mut before };
            cell.iter().for_each(|&node| side[node] = true);
        }
        let mut shared: Vec<bool> = before.iter().zip(&beyond).map(|(a, b)| *a && *b).collect();
        // At an end all cells are on one side, and its nodes are those of the end face.
        for (end, other) in [(ends[0], &before), (ends[1], &beyond)] {
            if !other.contains(&true) {
                let near = FLAT * (ends[1] - ends[0]);
                shared = mesh.nodes().iter().map(|own| (own[2] - end).abs() <= near).collect();
                if shared.iter().filter(|own| **own).count() < FACE {
                    shared.fill(false);
                }
            }
        }
        let levels = || (0..count).filter(|&node| shared[node]).map(|node| mesh.nodes()[node][2]);
        let number = levels().count();
        let is_tied = ties.iter().any(|row| {
            let on = |side: &[bool], other: &[bool]| {
                row.iter().any(|(dof, _)| side[dof / 3] && !other[dof / 3])
            };
            on(&before, &beyond) && on(&beyond, &before)
        });
        if number == 0 || is_tied {
            continue;
        }
        let z = levels().sum::<f64>() / number as f64;
        let near = FLAT * (ends[1] - ends[0]);
        if levels().all(|own| (own - z).abs() <= near) {
            // What acts in a flat section on nodes of the cells beyond alone acts before it, too: as of a bearing at a step.
            let is_in = |node: &usize| beyond[*node] && (mesh.nodes()[*node][2] - z).abs() <= near;
            (0..count).filter(is_in).for_each(|node| shared[node] = true);
        }
        if found.iter().all(|own| (own.z - z).abs() > FLAT * (ends[1] - ends[0])) {
            found.push(Cut { shared, asked, z });
        }
    }
    found.sort_by(|a, b| a.z.total_cmp(&b.z));
    found
}

/// The sections of a mesh nearest to these z (m) over the coordinates of its reduction, with the shapes of all nodes. `spun`:
/// displacement (m) whose stress stiffens the body by Ω².
///
/// # Errors
/// As [`crate::assembly::assemble_under`].
pub(crate) fn sections(
    mesh: &Mesh,
    wanted: &[f64],
    spun: Option<&[f64]>,
    reduction: &CraigBampton,
) -> Result<Vec<Section>, Error> {
    let cuts = cuts(mesh, wanted);
    if cuts.is_empty() {
        return Ok(Vec::new());
    }
    let elastic = passed(mesh, &cuts, ("stiffness", &[]), reduction)?;
    let stressed = match spun {
        Some(spun) => {
            let own = passed(mesh, &cuts, ("stiffening", spun), reduction)?;
            own.into_iter().map(Some).collect()
        }
        None => vec![None; cuts.len()],
    };
    // Rows over nodes of Σ m, Σ m x and Σ m y.
    let mut shares: Vec<[Vec<f64>; 3]> =
        cuts.iter().map(|_| std::array::from_fn(|_| vec![0.0; mesh.nodes().len()])).collect();
    each_cell(mesh, ("mass", &[]), |cell, entry| {
        let middle = middle(mesh, cell);
        for (cut, shares) in cuts.iter().zip(&mut shares).filter(|(cut, _)| middle > cut.asked) {
            for (a, &node) in cell.iter().enumerate().filter(|(_, node)| cut.shared[**node]) {
                let [x, y, _] = mesh.nodes()[node];
                for (b, &other) in cell.iter().enumerate() {
                    // ρ Nₐ N_b stands on the diagonal of the 3 × 3 block.
                    let mass = entry([a, 0], [b, 0]);
                    for (share, arm) in shares.iter_mut().zip([1.0, x, y]) {
                        share[other] += mass * arm;
                    }
                }
            }
        }
    })?;
    let whole =
        Coordinates { transform: Matrix::identity(reduction.coordinates()), names: Vec::new() };
    let made = cuts.iter().zip(elastic).zip(stressed.into_iter().zip(shares));
    let made = made.map(|((cut, [force, moment]), (stressed, shares))| {
        let nodes: Vec<usize> = (0..cut.shared.len()).filter(|&node| cut.shared[node]).collect();
        let mean = NodeSetMean::new(mesh, &nodes)?;
        let motion = MeanMotion::new(reduction, &whole, &mean, |node| node);
        let motion = MeanMotion { centre: [0.0, 0.0, cut.z], ..at_axis(motion, cut.z) };
        let mass = SharedMass::new(mesh, reduction, &shares);
        Ok(Section { motion, force, moment, stressed, mass, damping: 0.0 })
    });
    made.collect()
}

/// By cut force and moment of the matrices of a form of the cells beyond, with the sign changed: 3 × n each.
fn passed(
    mesh: &Mesh,
    cuts: &[Cut],
    form: (&str, &[f64]),
    reduction: &CraigBampton,
) -> Result<Vec<[Matrix; 2]>, Error> {
    // By cut and component the rows over dofs.
    let mut rows: Vec<[Vec<f64>; 6]> =
        cuts.iter().map(|_| std::array::from_fn(|_| vec![0.0; mesh.dof_count()])).collect();
    each_cell(mesh, form, |cell, entry| {
        let middle = middle(mesh, cell);
        for (cut, rows) in cuts.iter().zip(&mut rows).filter(|(cut, _)| middle > cut.asked) {
            for (a, &node) in cell.iter().enumerate().filter(|(_, node)| cut.shared[**node]) {
                let [x, y, z] = mesh.nodes()[node];
                let r = [x, y, z - cut.z];
                for (b, &other) in cell.iter().enumerate() {
                    for j in 0..3 {
                        let force: [f64; 3] = std::array::from_fn(|i| -entry([a, i], [b, j]));
                        for axis in 0..3 {
                            let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
                            let moment = r[next] * force[last] - r[last] * force[next];
                            rows[axis][3 * other + j] += force[axis];
                            rows[3 + axis][3 * other + j] += moment;
                        }
                    }
                }
            }
        }
    })?;
    let reduced = rows.into_iter().map(|rows| {
        let rows = rows.map(|row| reduction.shapes.apply_transpose(&row));
        [0, 3].map(|first| Matrix::from_fn(3, reduction.shapes.cols, |i, j| rows[first + i][j]))
    });
    Ok(reduced.collect())
}

impl SharedMass {
    /// By rows over the nodes.
    fn new(mesh: &Mesh, reduction: &CraigBampton, shares: &[Vec<f64>; 3]) -> SharedMass {
        let moved = |share: &Vec<f64>| {
            let along = |axis: usize| {
                let row = |i: usize| if i % 3 == axis { share[i / 3] } else { 0.0 };
                let row: Vec<f64> = (0..mesh.dof_count()).map(row).collect();
                reduction.shapes.apply_transpose(&row)
            };
            let rows = [0, 1, 2].map(along);
            Matrix::from_fn(3, reduction.shapes.cols, |i, j| rows[i][j])
        };
        let places = |share: &Vec<f64>| {
            let place = |axis: usize| {
                mesh.nodes()
                    .iter()
                    .zip(share)
                    .map(|(place, share)| share * place[axis])
                    .sum::<f64>()
            };
            [0, 1, 2].map(place)
        };
        SharedMass {
            moments: shares.each_ref().map(|share| share.iter().sum()),
            moved: shares.each_ref().map(moved),
            places: places(&shares[0]),
        }
    }
}

/// A mean motion as that of the point on the axis at z that moves with it.
fn at_axis(motion: MeanMotion, z: f64) -> MeanMotion {
    let displacement = motion.node_at([0.0, 0.0, z]).shapes;
    MeanMotion { displacement, ..motion }
}

/// The inertia of the answers themselves, which are the shapes of a reduction beyond its modes, as loads on dofs.
pub(crate) fn inertia_of_answers(
    reduction: &CraigBampton,
    modes: usize,
    mass: &SparseMatrix,
) -> Vec<Row> {
    let answers = modes..reduction.modes();
    let load = |place: usize| {
        let mut load = vec![0.0; reduction.shapes.rows];
        mass.multiply(reduction.shapes.col(place), &mut load);
        load.into_iter().enumerate().filter(|(_, own)| *own != 0.0).collect()
    };
    answers.map(load).collect()
}

/// Loads on dofs that a body with sections answers exactly: its inertia under accelerations that are linear in place, and the
/// components of means, through which joints and attachments act.
pub(crate) fn answered(mesh: &Mesh, mass: &SparseMatrix, means: &[NodeSetMean]) -> Vec<Row> {
    let mut all: Vec<Row> = Vec::new();
    for axis in 0..3 {
        for slope in 0..4 {
            let mut field = vec![0.0; mesh.dof_count()];
            for (node, place) in mesh.nodes().iter().enumerate() {
                field[3 * node + axis] = if slope == 3 { 1.0 } else { place[slope] };
            }
            let mut load = vec![0.0; field.len()];
            mass.multiply(&field, &mut load);
            all.push(load.into_iter().enumerate().filter(|(_, own)| *own != 0.0).collect());
        }
    }
    let rows = means.iter().flat_map(|mean| MeanComponent::ALL.map(|motion| mean.row(motion)));
    all.extend(rows);
    all.retain(|row| !row.is_empty());
    all
}
