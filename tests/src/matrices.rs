//! K and M of a mesh as other programs write them.

use std::fmt::Write;

use whirl_solver::assembly::assemble;
use whirl_solver::mesh::Mesh;
use whirl_solver::sparse::SparseColumns;

/// K and M of a mesh, all entries.
///
/// # Panics
/// If they cannot be assembled.
pub fn of_mesh(mesh: &Mesh) -> [SparseColumns; 2] {
    ["stiffness", "mass"].map(|form| assemble(mesh, form).expect(form).to_columns())
}

/// A matrix in the Matrix Market format; of a symmetric one the lower triangle.
pub fn market(matrix: &SparseColumns, symmetry: &str) -> String {
    let mut count = 0;
    let mut text = String::new();
    for j in 0..matrix.width() {
        for (i, value) in matrix.column(j).filter(|(i, _)| symmetry == "general" || *i >= j) {
            count += 1;
            writeln!(text, "{} {} {value:e}", i + 1, j + 1).expect("text");
        }
    }
    let (rows, columns) = (matrix.height, matrix.width());
    format!(
        "%%MatrixMarket matrix coordinate real {symmetry}\n% a comment\n{rows} {columns} {count}\n{text}"
    )
}

/// The dofs of a mesh as a table, in mm.
pub fn dofs(mesh: &Mesh) -> String {
    let mut text = "node, direction, x [mm], y [mm], z [mm]\n".to_owned();
    for (label, [x, y, z]) in mesh.labels().iter().zip(mesh.nodes()) {
        for direction in ["x", "y", "z"] {
            writeln!(text, "{label}, {direction}, {:e}, {:e}, {:e}", 1e3 * x, 1e3 * y, 1e3 * z)
                .expect("text");
        }
    }
    text
}

/// The nodes of a mesh with its sets of nodes, as input of CalculiX.
pub fn input(mesh: &Mesh) -> String {
    let mut text = "*NODE\n".to_owned();
    for (label, [x, y, z]) in mesh.labels().iter().zip(mesh.nodes()) {
        writeln!(text, "{label}, {x:e}, {y:e}, {z:e}").expect("text");
    }
    for (name, nodes) in mesh.node_sets() {
        writeln!(text, "*NSET, NSET={name}").expect("text");
        nodes.iter().for_each(|&node| writeln!(text, "{},", mesh.labels()[node]).expect("text"));
    }
    text
}

/// A matrix as CalculiX stores it: the upper triangle, column after column.
pub fn calculix(matrix: &SparseColumns) -> String {
    let mut text = String::new();
    for j in 0..matrix.width() {
        for (i, value) in matrix.column(j).filter(|(i, _)| *i <= j) {
            writeln!(text, "{} {}  {value:.17e}", i + 1, j + 1).expect("text");
        }
    }
    text
}

/// The dofs of a mesh as CalculiX lists them.
pub fn calculix_dofs(mesh: &Mesh) -> String {
    let mut text = String::new();
    for label in mesh.labels() {
        (1..=3).for_each(|i| writeln!(text, "{label}.{i}").expect("text"));
    }
    text
}

/// A symmetric matrix as cards DMIG, in free fields with all digits.
pub fn dmig(name: &str, matrix: &SparseColumns, mesh: &Mesh) -> String {
    let dof = |dof: usize| (mesh.labels()[dof / 3], dof % 3 + 1);
    let mut text = format!("DMIG,{name},0,6,2,0\n");
    for j in 0..matrix.width() {
        let (node, component) = dof(j);
        let entries: Vec<String> = matrix
            .column(j)
            .filter(|(i, _)| *i >= j)
            .map(|(i, value)| {
                let (node, component) = dof(i);
                format!("{node},{component},{value:e},")
            })
            .collect();
        for (place, entry) in entries.iter().enumerate() {
            match place {
                0 => write!(text, "DMIG,{name},{node},{component},,{entry}"),
                _ if place % 2 == 1 => write!(text, "\n,{entry}"),
                _ => write!(text, ",{entry}"),
            }
            .expect("text");
        }
        text.push('\n');
    }
    text
}

/// The nodes of a mesh as grid points.
pub fn grids(mesh: &Mesh) -> String {
    let mut text = "BEGIN BULK\n".to_owned();
    for (label, [x, y, z]) in mesh.labels().iter().zip(mesh.nodes()) {
        writeln!(text, "GRID,{label},,{x:e},{y:e},{z:e}").expect("text");
    }
    text
}

/// A matrix as OUTPUT4 of Nastran writes it: as text, one run of values a column.
pub fn op4(name: &str, matrix: &SparseColumns) -> String {
    let (rows, columns) = (matrix.height, matrix.width());
    let mut text = format!("{columns:8}{rows:8}{:8}{:8}{name:<8}1P,1E26.17\n", 6, 2);
    for j in 0..columns {
        let column: Vec<(usize, f64)> = matrix.column(j).collect();
        let (Some(first), Some(last)) = (column.first(), column.last()) else { continue };
        let mut values = vec![0.0; last.0 - first.0 + 1];
        column.iter().for_each(|(i, value)| values[i - first.0] = *value);
        writeln!(text, "{:8}{:8}{:8}", j + 1, first.0 + 1, values.len()).expect("text");
        values.iter().for_each(|own| writeln!(text, "{own:26.17E}").expect("text"));
    }
    writeln!(text, "{:8}{:8}{:8}\n{:26.17E}", columns + 1, 1, 1, 1.0).expect("text");
    text
}

/// A matrix as Abaqus writes it: the lower triangle by nodes and dofs.
pub fn abaqus(matrix: &SparseColumns, mesh: &Mesh) -> String {
    let dof = |dof: usize| format!("{},{}", mesh.labels()[dof / 3], dof % 3 + 1);
    let mut text = String::new();
    for j in 0..matrix.width() {
        for (i, value) in matrix.column(j).filter(|(i, _)| *i >= j) {
            writeln!(text, "{}, {}, {value:.17e}", dof(i), dof(j)).expect("text");
        }
    }
    text
}
