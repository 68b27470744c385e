//! A body as its reduction leaves it, before anything that costs nothing: constraints, names, damping, and which of its
//! nodes are output. This is what a cache keeps, under a key of all that it depends on.

use std::collections::BTreeSet;

use serde::{Deserialize, Serialize};

use crate::assembly::{assemble, assemble_under};
use crate::body::{Assembled, BodyNode, BodySpec, Coordinates, Retained};
use crate::cache::{Key, PROGRAM, instruction_set};
use crate::centre_of_mass::CentreOfMass;
use crate::constraints::{Equation, GroundSpring};
use crate::error::Error;
use crate::linalg::Matrix;
use crate::measure::MeanMotion;
use crate::mesh::matrices::BodyMatrices;
use crate::mesh::{Mesh, NodeSetMean};
use crate::reduction::{CraigBampton, FixedInterface, Row};
use crate::section::{self, Section};
use crate::sparse::SparseMatrix;
use crate::stiffening::displacement;
use crate::together::{both, on_workers};

/// Which body a reduction is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum BodyKind {
    /// One that turns: it has a `SpinTensors`.
    Shaft,
    /// One that stands.
    Support,
}

/// What couples the deformation of a reduced body to its rotation about z, in Craig–Bampton coordinates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct SpinTensors {
    /// J0 = x0ᵀY x0 (kg·m²).
    pub(crate) j0: f64,
    /// φᵀY x0 and φᵀH x0.
    pub(crate) y0: Vec<f64>,
    pub(crate) h0: Vec<f64>,
    /// φᵀYφ and φᵀHφ.
    pub(crate) inertia: Matrix,
    pub(crate) coupling: Matrix,
    /// φᵀGφ; zero where rotation does not stiffen.
    pub(crate) stiffening: Matrix,
}

impl SpinTensors {
    /// Of a reduction with its Y and H, G if rotation stiffens, and what they do to the undeformed body.
    pub(crate) fn new(
        reduction: &CraigBampton,
        inertia: &SparseMatrix,
        coupling: &SparseMatrix,
        stiffening: Option<&SparseMatrix>,
        undeformed: &Undeformed,
    ) -> SpinTensors {
        let size = reduction.coordinates();
        SpinTensors {
            j0: undeformed.j0,
            y0: reduction.shapes.apply_transpose(&undeformed.y_x0),
            h0: reduction.shapes.apply_transpose(&undeformed.h_x0),
            inertia: reduction.reduce(inertia),
            coupling: reduction.reduce(coupling),
            stiffening: stiffening.map_or(Matrix::zeros(size, size), |g| reduction.reduce(g)),
        }
    }
}

/// What Y and H make of the positions x0 of the nodes.
pub(crate) struct Undeformed {
    /// x0ᵀY x0 (kg·m²).
    j0: f64,
    /// Y x0 and H x0 (kg·m), 3·nodes.
    y_x0: Vec<f64>,
    h_x0: Vec<f64>,
}

impl Undeformed {
    /// By the positions (m).
    pub(crate) fn new(
        inertia: &SparseMatrix,
        coupling: &SparseMatrix,
        positions: &[[f64; 3]],
    ) -> Undeformed {
        let x0 = positions.as_flattened();
        let (y_x0, h_x0) = (applied(inertia, x0), applied(coupling, x0));
        Undeformed { j0: x0.iter().zip(&y_x0).map(|(x, y)| x * y).sum(), y_x0, h_x0 }
    }

    /// Of a mesh. Reduced matrices need not have x0 among their motions, but do have a turn about z, r: x0ᵀY x0 = rᵀM r and
    /// H x0 = −M r.
    fn of(mesh: &Mesh, inertia: &SparseMatrix, coupling: &SparseMatrix) -> Undeformed {
        let given = mesh.matrices().and_then(|own| Some((own, own.spin_load()?)));
        let Some((own, load)) = given else {
            return Undeformed::new(inertia, coupling, mesh.nodes());
        };
        let rigid = own.rigid_mass(mesh);
        let h_x0 = rigid.momenta.col(5).iter().map(|own| -own).collect();
        Undeformed { j0: rigid.inertia[2][2], y_x0: load.to_vec(), h_x0 }
    }
}

fn applied(matrix: &SparseMatrix, x: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; x.len()];
    matrix.multiply(x, &mut product);
    product
}

/// What gravity takes of a reduced body, in Craig–Bampton coordinates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Weight {
    /// kg.
    mass: f64,
    /// s0 = ∫ρ x0 dV (kg·m).
    first_moment: [f64; 3],
    /// φᵀM 1 along x, y and z.
    momenta: [Vec<f64>; 3],
}

impl Weight {
    /// Of a reduction with shapes of all nodes, and M; the positions of the nodes in m.
    pub(crate) fn new(
        reduction: &CraigBampton,
        mass: &SparseMatrix,
        positions: &[[f64; 3]],
    ) -> Weight {
        let along = |axis: usize| -> Vec<f64> {
            let unit = (0..3 * positions.len()).map(|i| f64::from(i % 3 == axis));
            applied(mass, &unit.collect::<Vec<f64>>())
        };
        let forces = [0, 1, 2].map(along);
        let first = |axis: usize| -> f64 {
            positions.iter().enumerate().map(|(k, x)| forces[axis][3 * k + axis] * x[axis]).sum()
        };
        Weight {
            mass: forces[0].iter().step_by(3).sum(),
            first_moment: [0, 1, 2].map(first),
            momenta: forces.each_ref().map(|own| reduction.shapes.apply_transpose(own)),
        }
    }

    /// Of a body of matrices.
    fn of_matrices(reduction: &CraigBampton, mesh: &Mesh, own: &BodyMatrices) -> Weight {
        let rigid = own.rigid_mass(mesh);
        let momentum = |axis: usize| reduction.shapes.apply_transpose(rigid.momenta.col(axis));
        Weight { mass: rigid.mass, first_moment: rigid.first, momenta: [0, 1, 2].map(momentum) }
    }

    /// As the motion of the centre of mass by the active coordinates.
    pub(crate) fn centre_of_mass(&self, active: &Coordinates) -> CentreOfMass {
        let rows = self.momenta.each_ref().map(|own| active.transform.apply_transpose(own));
        let shapes = Matrix::from_fn(3, rows[0].len(), |i, j| rows[i][j] / self.mass);
        let position = self.first_moment.map(|own| own / self.mass);
        CentreOfMass { mass: self.mass, node: BodyNode { position, shapes } }
    }
}

/// A reduced body with the shapes of the nodes that its mesh has sets of, not counting a set of all nodes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reduced {
    /// Its shapes have three rows a node of `nodes`.
    pub(crate) reduction: CraigBampton,
    pub(crate) spin: Option<SpinTensors>,
    pub(crate) weight: Weight,
    /// Nodes of the mesh, ascending, and where they are (m).
    nodes: Vec<usize>,
    pub(crate) positions: Vec<[f64; 3]>,
    /// Those of the spec.
    pub(crate) sections: Vec<Section>,
}

impl Reduced {
    /// Reduces a mesh. Of the spec it takes what is retained and held, the modes, the springs and the nodes: those, and
    /// the nodes and means of all sets of the mesh, can be output. A turning body that rotation stiffens depends on the
    /// constraints, too.
    ///
    /// # Errors
    /// Of the spec and the mesh, and of the linear algebra: see [`crate::error::ReductionError`].
    pub fn new(kind: BodyKind, mesh: &Mesh, spec: &BodySpec) -> Result<Reduced, Error> {
        on_workers(|| Reduced::made(kind, mesh, spec))
    }

    fn made(kind: BodyKind, mesh: &Mesh, spec: &BodySpec) -> Result<Reduced, Error> {
        let body = spec.assemble(mesh)?;
        let fixed = spec.fixed_interface(mesh, &body)?;
        let made = fixed.counted(|fixed| Reduced::of((kind, mesh, spec), &body, fixed));
        made.map_err(|error| spec.named(error, mesh))?
    }

    /// All that is made of the modes and the factor of a body.
    fn of(
        (kind, mesh, spec): (BodyKind, &Mesh, &BodySpec),
        body: &Assembled,
        fixed: &FixedInterface,
    ) -> Result<Reduced, Error> {
        let has_sections = !spec.sections.is_empty() && mesh.matrices().is_none();
        let mut corrections = spec.corrections.clone();
        if has_sections {
            corrections.extend(section::answered(mesh, &body.mass, &spec.means));
            let once = fixed.reduce(&corrections)?;
            corrections.extend(section::inertia_of_answers(&once, spec.modes, &body.mass));
        }
        let whole = fixed.reduce(&corrections)?;
        let mut spun = None;
        let spin = match kind {
            BodyKind::Shaft => {
                let (inertia, coupling) =
                    both(|| assemble(mesh, "spin_inertia"), || assemble(mesh, "spin_coupling"));
                let (inertia, coupling) = (inertia?, coupling?);
                let undeformed = Undeformed::of(mesh, &inertia, &coupling);
                let mut under_load = || match mesh.matrices() {
                    Some(_) => assemble(mesh, "stiffening"),
                    None => {
                        let load = &undeformed.y_x0;
                        let displaced =
                            displacement(mesh, spec, body, (&whole, fixed.factored()), load)?;
                        assemble_under(mesh, "stiffening", spun.insert(displaced))
                    }
                };
                let under_load = spec.stiffening.then(&mut under_load).transpose()?;
                let stiffening = under_load.as_ref();
                Some(SpinTensors::new(&whole, &inertia, &coupling, stiffening, &undeformed))
            }
            BodyKind::Support => None,
        };
        let sections = match has_sections {
            true => section::sections(mesh, &spec.sections, spun.as_deref(), &whole)?,
            false => Vec::new(),
        };
        let weight = match mesh.matrices() {
            Some(own) => Weight::of_matrices(&whole, mesh, own),
            None => Weight::new(&whole, &body.mass, mesh.nodes()),
        };
        let nodes = output_nodes(mesh, spec);
        let row = |i: usize| 3 * nodes[i / 3] + i % 3;
        let shapes =
            Matrix::from_fn(3 * nodes.len(), whole.shapes.cols, |i, j| whole.shapes[(row(i), j)]);
        let positions = nodes.iter().map(|&node| mesh.nodes()[node]).collect();
        let reduction = CraigBampton { shapes, ..whole };
        Ok(Reduced { reduction, spin, weight, nodes, positions, sections })
    }

    /// The key of [`Reduced::new`]: the same for whatever gives the same bits, another for everything else, another
    /// program included.
    pub fn key(kind: BodyKind, mesh: &Mesh, spec: &BodySpec) -> Key {
        let BodySpec {
            retained,
            held,
            modes,
            constraints,
            springs,
            // Made of the reduced matrices.
            damping: _,
            stiffening,
            // Among the nodes that are output, as the sets of the mesh.
            nodes: _,
            means,
            corrections,
            sections,
            // Says how, not what.
            memory: _,
        } = spec;
        let row = |Retained { terms, name: _ }: &Retained| terms.clone();
        let retained: Vec<_> = retained.iter().map(row).collect();
        let held: BTreeSet<usize> = held.iter().copied().collect();
        let spring = |GroundSpring { name: _, dof, stiffness }: &GroundSpring| (*dof, *stiffness);
        let springs: Vec<_> = springs.iter().map(spring).collect();
        // What is held while the centrifugal load acts.
        let stiffens = kind == BodyKind::Shaft && *stiffening;
        let terms = |Equation { name: _, terms }: &Equation| terms.clone();
        let held_while_turning: Option<Vec<_>> =
            stiffens.then(|| constraints.equations().iter().map(terms).collect());
        let program = (PROGRAM, instruction_set());
        let nodes = output_nodes(mesh, spec);
        let interface = (retained, held, modes, springs, corrections, sections);
        // What acts through means is answered where there are sections.
        let means: Option<Vec<_>> = (!sections.is_empty())
            .then(|| means.iter().map(|mean| (mean.nodes(), mean.weights())).collect());
        Key::of(&(program, kind, mesh.content(), (interface, means), nodes, held_while_turning))
    }

    /// The displacement of the modes, and of what corrects them, under a load in its own direction (m/N): Σ (f·x)²/ω². None
    /// for a load on nodes whose shapes are not kept.
    pub(crate) fn modal_compliance(&self, load: &Row) -> Option<f64> {
        let (shapes, stiffness) = (&self.reduction.shapes, &self.reduction.stiffness);
        let placed = load.iter().map(|&(dof, force)| {
            let node = self.nodes.binary_search(&(dof / 3)).ok()?;
            Some((3 * node + dof % 3, force))
        });
        let placed: Vec<(usize, f64)> = placed.collect::<Option<_>>()?;
        let by_mode = (0..self.reduction.modes()).map(|j| {
            let along: f64 = placed.iter().map(|&(row, force)| force * shapes[(row, j)]).sum();
            along.powi(2) / stiffness[(j, j)]
        });
        Some(by_mode.sum())
    }

    pub(crate) fn node(&self, active: &Coordinates, place: usize) -> BodyNode {
        BodyNode::new(&self.reduction, active, &self.positions, place)
    }

    /// The means of the spec.
    pub(crate) fn measures(&self, active: &Coordinates, spec: &BodySpec) -> Vec<MeanMotion> {
        let place = |node| self.place(node);
        let measure = |mean| MeanMotion::new(&self.reduction, active, mean, place);
        spec.means.iter().map(measure).collect()
    }

    /// Places of the output nodes among those with shapes.
    pub(crate) fn places(&self, spec: &BodySpec) -> impl Iterator<Item = usize> {
        spec.nodes.iter().map(|&node| self.place(node))
    }

    fn place(&self, node: usize) -> usize {
        self.nodes.binary_search(&node).expect("its shapes are kept")
    }
}

/// Nodes whose shapes are kept, ascending.
fn output_nodes(mesh: &Mesh, spec: &BodySpec) -> Vec<usize> {
    // A set of all nodes, such as many a mesher writes, says nothing of any of them.
    let sets = mesh.node_sets().values().filter(|nodes| nodes.len() < mesh.nodes().len());
    let means = spec.means.iter().flat_map(NodeSetMean::all_nodes);
    let all: BTreeSet<usize> = sets.flatten().chain(&spec.nodes).copied().chain(means).collect();
    all.into_iter().collect()
}
