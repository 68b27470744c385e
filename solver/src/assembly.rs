//! From a mesh and a form to a sparse matrix: kernels evaluated block by block, then scattered.

use whirl_specs::{CellMatrix, Structure};

use crate::cells::{BlockKernel, evaluate};
use crate::error::Error;
use crate::linalg::LowerTriangle;
use crate::mesh::{Block, Cell, Mesh};
use crate::sparse::{SparseColumns, SparseMatrix};

/// The matrix of the form called `form` (`stiffness` K, `mass` M, `spin_inertia` Y, `spin_coupling` H)
/// over all cells of a mesh, or that which a body of matrices has; `3·nodes` rows, SI.
///
/// # Errors
/// [`Error::MissingForm`], [`Error::MissingProperty`], or [`Error::InvertedCells`] naming the cells; [`Error::Mesh`] for a
/// matrix that a body of matrices lacks.
pub fn assemble(mesh: &Mesh, form: &str) -> Result<SparseMatrix, Error> {
    assemble_under(mesh, form, &[])
}

/// The same of a form under the stress of a displacement: `stiffening`, ∫ σ_ij ∂_i u · ∂_j v dV. `displacement`: 3·nodes (m);
/// other forms do not read it.
///
/// # Errors
/// As [`assemble`].
///
/// # Panics
/// If the form is one under a stress and the displacement has fewer values.
pub fn assemble_under(
    mesh: &Mesh,
    form: &str,
    displacement: &[f64],
) -> Result<SparseMatrix, Error> {
    if let Some(own) = mesh.matrices() {
        return own.form(form, mesh.origin());
    }
    let (kernels, structures) = kernels(mesh, form)?;
    let mut scatter = Scatter::new(mesh, common_structure(&structures));
    evaluate(mesh, &kernels, displacement, |block, cell, values| {
        scatter.add(structures[block], cell, values);
    })?;
    Ok(scatter.finish())
}

/// Mass, centre and second moments of a body, by the cells' own quadrature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassProperties {
    /// ∫ρ dV (kg).
    pub mass: f64,
    /// ∫dV (m³); 0 of a body of matrices.
    pub volume: f64,
    /// ∫ρ x dV / mass (m).
    pub centre: [f64; 3],
    /// ∫ρ xᵢ xⱼ dV about the origin (kg·m²); the polar inertia about z is `[0][0] + [1][1]`.
    pub second_moment: [[f64; 3]; 3],
}

/// Mass, centre and second moments of a body.
///
/// # Errors
/// As [`assemble`].
pub fn mass_properties(mesh: &Mesh) -> Result<MassProperties, Error> {
    if let Some(own) = mesh.matrices() {
        let own = own.rigid_mass(mesh);
        return Ok(MassProperties {
            mass: own.mass,
            volume: 0.0,
            centre: own.first.map(|first| first / own.mass),
            second_moment: own.second_moments(),
        });
    }
    let (kernels, structures) = kernels(mesh, "mass")?;
    // kg/m³; 1 where the material has none.
    let density = |block: &Block| {
        let properties = &mesh.materials()[block.material].properties;
        properties.get("rho").copied().unwrap_or(1.0)
    };
    let (mut mass, mut volume, mut first, mut second) = (0.0, 0.0, [0.0; 3], [[0.0; 3]; 3]);
    evaluate(mesh, &kernels, &[], |block, cell, values| {
        let entry = Entries { structure: structures[block], nodes: cell.len(), values };
        let mut cell_mass = 0.0;
        let (mut own_first, mut own_second) = (first, second);
        for (a, &node) in cell.iter().enumerate() {
            let x = mesh.nodes()[node];
            for (b, &other) in cell.iter().enumerate() {
                // ρ Nₐ N_b stands on the diagonal of the 3 × 3 block; Σₐ Nₐ xₐ = x.
                let m = entry.get(a, 0, b, 0);
                let y = mesh.nodes()[other];
                cell_mass += m;
                for i in 0..3 {
                    own_first[i] += m * x[i];
                    for j in 0..3 {
                        own_second[i][j] += m * x[i] * y[j];
                    }
                }
            }
        }
        (first, second) = (own_first, own_second);
        mass += cell_mass;
        volume += cell_mass / density(&mesh.blocks()[block]);
    })?;
    // Cells without mass have a volume all the same.
    if let Some(light) = mesh.materials().iter().find(|material| !material.has_mass()) {
        let mut of_unit_density = light.clone();
        of_unit_density.properties.insert("rho".to_owned(), 1.0);
        let is_light =
            |cell: Cell| !mesh.materials()[mesh.blocks()[cell.block].material].has_mass();
        volume = mass_properties(&mesh.with_material(&of_unit_density, is_light)?)?.volume;
    }
    Ok(MassProperties { mass, volume, centre: first.map(|m| m / mass), second_moment: second })
}

/// Mass (kg) of a body at larger z than this (m), as its nodes share it; of nodes at this z half.
///
/// # Errors
/// As [`assemble`].
pub fn mass_above(mesh: &Mesh, z: f64) -> Result<f64, Error> {
    /// Of the largest coordinate.
    const AT: f64 = 1e-9;
    let reach = mesh.nodes().iter().fold(0.0, |most: f64, node| most.max(node[2].abs()));
    let part = |node: usize| match mesh.nodes()[node][2] - z {
        off if off.abs() <= AT * reach => 0.5,
        off if off > 0.0 => 1.0,
        _ => 0.0,
    };
    let mut mass = 0.0;
    if let Some(own) = mesh.matrices() {
        let momenta = own.rigid_mass(mesh).momenta;
        for node in 0..mesh.placed() {
            mass += part(node) * momenta[(3 * node, 0)];
        }
        return Ok(mass);
    }
    let (kernels, structures) = kernels(mesh, "mass")?;
    evaluate(mesh, &kernels, &[], |block, cell, values| {
        let entry = Entries { structure: structures[block], nodes: cell.len(), values };
        for (a, &node) in cell.iter().enumerate() {
            let own: f64 = (0..cell.len()).map(|b| entry.get(a, 0, b, 0)).sum();
            mass += part(node) * own;
        }
    })?;
    Ok(mass)
}

/// Hands the matrix of a form of every cell, under the stress of a displacement if it is one of these, to `take`: the nodes of
/// the cell, and entry (3a+i, 3b+j) by [a, i] and [b, j].
///
/// # Errors
/// As [`assemble`].
///
/// # Panics
/// As [`assemble_under`].
pub(crate) fn each_cell(
    mesh: &Mesh,
    (form, displacement): (&str, &[f64]),
    mut take: impl FnMut(&[usize], &dyn Fn([usize; 2], [usize; 2]) -> f64),
) -> Result<(), Error> {
    let (kernels, structures) = kernels(mesh, form)?;
    evaluate(mesh, &kernels, displacement, |block, cell, values| {
        let entries = Entries { structure: structures[block], nodes: cell.len(), values };
        take(cell, &|[a, i], [b, j]| entries.get(a, i, b, j));
    })
}

/// The kernels of a form, and how each stores its matrices; a block each.
fn kernels<'a>(
    mesh: &'a Mesh,
    form: &str,
) -> Result<(Vec<BlockKernel<'a>>, Vec<Structure>), Error> {
    let own = mesh.blocks().iter().map(|block| BlockKernel::of_form(mesh, block, form));
    Ok(own.collect::<Result<Vec<_>, _>>()?.into_iter().unzip())
}

/// The most special structure that holds the matrices of all blocks.
fn common_structure(structures: &[Structure]) -> Structure {
    let structures = || structures.iter().copied();
    let Some(first) = structures().next() else { return Structure::Symmetric };
    let symmetric = |structure: Structure| match structure {
        Structure::Symmetric => true,
        Structure::Full => false,
        Structure::Kronecker { pattern } => {
            (0..3).all(|i| (0..i).all(|j| pattern[i][j] == pattern[j][i]))
        }
    };
    if structures().all(|structure| structure == first) {
        first
    } else if structures().all(symmetric) {
        Structure::Symmetric
    } else {
        Structure::Full
    }
}

/// The entries of one cell's matrix, whatever its storage.
struct Entries<'a> {
    structure: Structure,
    nodes: usize,
    values: CellMatrix<'a>,
}

/// Place of (r, c), r ≤ c, in an upper triangle of n rows stored by rows.
#[inline]
fn upper(n: usize, r: usize, c: usize) -> usize {
    r * (2 * n - r + 1) / 2 + c - r
}

impl Entries<'_> {
    /// Entry (3a+i, 3b+j).
    #[inline]
    fn get(&self, a: usize, i: usize, b: usize, j: usize) -> f64 {
        let (row, column) = (3 * a + i, 3 * b + j);
        match self.structure {
            Structure::Symmetric => {
                self.values.get(upper(3 * self.nodes, row.min(column), row.max(column)))
            }
            Structure::Full => self.values.get(row * 3 * self.nodes + column),
            Structure::Kronecker { pattern } => self.scalar(a, b) * pattern[i][j],
        }
    }

    /// s[a,b] of a Kronecker structure.
    #[inline]
    fn scalar(&self, a: usize, b: usize) -> f64 {
        self.values.get(upper(self.nodes, a.min(b), a.max(b)))
    }
}

/// Sums the cells' matrices into a sparse one.
enum Scatter {
    Symmetric { graph: LowerTriangle, matrix: LowerTriangle },
    Kronecker { scalar: LowerTriangle, pattern: [[f64; 3]; 3] },
    Full { size: usize, triplets: Vec<(usize, usize, f64)> },
}

impl Scatter {
    fn new(mesh: &Mesh, structure: Structure) -> Scatter {
        match structure {
            Structure::Kronecker { pattern } => {
                Scatter::Kronecker { scalar: node_graph(mesh), pattern }
            }
            Structure::Symmetric => {
                let graph = node_graph(mesh);
                let matrix = LowerTriangle::from_columns(3 * graph.size, |dof| {
                    let (b, j) = (dof / 3, dof % 3);
                    let entries = move |(a, _)| (0..3).map(move |i| (3 * a + i, 0.0));
                    graph.column(b).flat_map(entries).filter(move |&(row, _)| row >= 3 * b + j)
                });
                Scatter::Symmetric { graph, matrix }
            }
            Structure::Full => Scatter::Full { size: mesh.dof_count(), triplets: Vec::new() },
        }
    }

    fn add(&mut self, structure: Structure, cell: &[usize], values: CellMatrix) {
        let entries = Entries { structure, nodes: cell.len(), values };
        match self {
            Scatter::Kronecker { scalar, .. } => {
                for_lower_pairs(cell, |a, b| {
                    let place = place(scalar, cell[a], cell[b]);
                    scalar.values[place] += entries.scalar(a, b);
                });
            }
            Scatter::Symmetric { graph, matrix } => {
                for_lower_pairs(cell, |a, b| {
                    let ahead = place(graph, cell[a], cell[b]) - graph.starts[cell[b]];
                    for j in 0..3 {
                        // Column 3b+j begins at row 3b+j, so it has lost j entries of its first block.
                        let start = matrix.starts[3 * cell[b] + j] + 3 * ahead;
                        for i in if ahead == 0 { j } else { 0 }..3 {
                            matrix.values[start + i - j] += entries.get(a, i, b, j);
                        }
                    }
                });
            }
            Scatter::Full { triplets, .. } => {
                for (a, &node) in cell.iter().enumerate() {
                    for (b, &other) in cell.iter().enumerate() {
                        for (i, j) in (0..9).map(|k| (k / 3, k % 3)) {
                            let value = entries.get(a, i, b, j);
                            triplets.push((3 * node + i, 3 * other + j, value));
                        }
                    }
                }
            }
        }
    }

    fn finish(self) -> SparseMatrix {
        match self {
            Scatter::Symmetric { matrix, .. } => SparseMatrix::Symmetric(matrix),
            Scatter::Kronecker { scalar, pattern } => SparseMatrix::Kronecker { scalar, pattern },
            Scatter::Full { size, triplets } => {
                SparseMatrix::General(SparseColumns::from_triplets(size, size, triplets))
            }
        }
    }
}

/// Pairs (a, b) of a cell's nodes for which node a is not above node b in the mesh's numbering.
fn for_lower_pairs(cell: &[usize], mut pair: impl FnMut(usize, usize)) {
    for b in 0..cell.len() {
        for a in 0..cell.len() {
            if cell[a] >= cell[b] {
                pair(a, b);
            }
        }
    }
}

/// Place of entry (row, column) among the values.
fn place(matrix: &LowerTriangle, row: usize, column: usize) -> usize {
    let start = matrix.starts[column];
    let rows = &matrix.rows[start..matrix.starts[column + 1]];
    start + rows.binary_search(&row).expect("the graph has every pair of nodes of every cell")
}

/// Zeros at every pair of nodes that share a cell.
fn node_graph(mesh: &Mesh) -> LowerTriangle {
    let nodes = mesh.nodes().len();
    let cells: Vec<&[usize]> = mesh.blocks().iter().flat_map(Block::cells).collect();
    // Cells of each node, one after the other.
    let mut ends = vec![0; nodes + 1];
    cells.iter().flat_map(|cell| cell.iter()).for_each(|&node| ends[node + 1] += 1);
    (0..nodes).for_each(|node| ends[node + 1] += ends[node]);
    let mut around = vec![0; ends[nodes]];
    let mut next = ends.clone();
    for (place, cell) in cells.iter().enumerate() {
        for &node in *cell {
            around[next[node]] = place;
            next[node] += 1;
        }
    }
    let mut graph =
        LowerTriangle { size: nodes, starts: vec![0], rows: Vec::new(), values: Vec::new() };
    // The last node that has taken each.
    let mut taken = vec![usize::MAX; nodes];
    for node in 0..nodes {
        let start = graph.rows.len();
        taken[node] = node;
        graph.rows.push(node);
        for &cell in &around[ends[node]..ends[node + 1]] {
            for &other in cells[cell] {
                if other > node && taken[other] != node {
                    taken[other] = node;
                    graph.rows.push(other);
                }
            }
        }
        graph.rows[start..].sort_unstable();
        graph.starts.push(graph.rows.len());
    }
    graph.values = vec![0.0; graph.rows.len()];
    graph
}
