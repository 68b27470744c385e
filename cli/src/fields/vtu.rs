//! VTU and PVD, the files of VTK and ParaView: XML with the numbers behind it as they are in memory.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use whirl_solver::film::Grid;
use whirl_solver::mesh::Mesh;

/// Numbers at the nodes of a mesh.
pub(super) struct Array {
    /// With its unit.
    pub(super) name: &'static str,
    pub(super) values: Values,
}

/// What an array has at every node.
pub(super) enum Values {
    Scalars(Vec<f64>),
    Vectors(Vec<[f64; 3]>),
    /// xx, yy, zz, xy, yz, zx.
    Tensors(Vec<[f64; 6]>),
}

const POINTS: &str = "points";

impl Array {
    /// Where the nodes are (m).
    pub(super) fn points(points: Vec<[f64; 3]>) -> Self {
        Array { name: POINTS, values: Values::Vectors(points) }
    }
}

impl Values {
    /// The numbers one after the other, and how many a node has.
    fn flat(&self) -> (&[f64], usize) {
        match self {
            Values::Scalars(values) => (values, 1),
            Values::Vectors(values) => (values.as_flattened(), 3),
            Values::Tensors(values) => (values.as_flattened(), 6),
        }
    }
}

/// The arrays behind the XML, one after the other, and what it says of them.
#[derive(Default)]
struct Appended {
    bytes: Vec<u8>,
}

impl Appended {
    /// Adds an array: its element.
    fn add(
        &mut self,
        (kind, name, components): (&str, &str, usize),
        values: impl Iterator<Item = impl AsRef<[u8]>>,
    ) -> String {
        let place = self.bytes.len();
        self.bytes.extend([0; 8]);
        values.for_each(|value| self.bytes.extend(value.as_ref()));
        let length = (self.bytes.len() - place - 8) as u64;
        self.bytes[place..place + 8].copy_from_slice(&length.to_le_bytes());
        let components = match components {
            1 => String::new(),
            count => format!(" NumberOfComponents=\"{count}\""),
        };
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\"{components} format=\"appended\" offset=\"{place}\"/>\n"
        )
    }

    fn numbers(&mut self, array: &Array) -> String {
        let (values, components) = array.values.flat();
        let about = ("Float64", array.name, components);
        self.add(about, values.iter().map(|value| value.to_le_bytes()))
    }
}

/// Cells between points.
#[derive(Default)]
pub(super) struct Cells {
    points: usize,
    /// The points of all cells, one after the other.
    connectivity: Vec<i64>,
    /// Where the points of each cell end, and its kind.
    ends: Vec<i64>,
    kinds: Vec<u8>,
}

/// VTK's number of a quadrilateral.
const QUADRILATERAL: u8 = 9;

impl Cells {
    /// Of a mesh.
    pub(super) fn of(mesh: &Mesh) -> Self {
        let mut all = Cells { points: mesh.nodes().len(), ..Cells::default() };
        for block in mesh.blocks() {
            for cell in block.cells() {
                let order = block.element.vtk_order.iter().map(|&place| cell[place]);
                all.push(block.element.vtk, order);
            }
        }
        all
    }

    /// Between the nodes of a film.
    pub(super) fn between(grid: &Grid) -> Self {
        let mut all = Cells { points: grid.nodes(), ..Cells::default() };
        let cells = grid.around - usize::from(grid.arc.is_some());
        for row in 0..grid.along - 1 {
            for own in 0..cells {
                let next = (own + 1) % grid.around;
                let corners = [(own, row), (next, row), (next, row + 1), (own, row + 1)];
                all.push(QUADRILATERAL, corners.map(|(i, j)| j * grid.around + i).into_iter());
            }
        }
        all
    }

    fn push(&mut self, kind: u8, points: impl Iterator<Item = usize>) {
        self.connectivity.extend(points.map(|own| own as i64));
        self.ends.push(self.connectivity.len() as i64);
        self.kinds.push(kind);
    }
}

/// Writes cells with numbers at their points, where these are among them.
///
/// # Errors
/// It cannot be written.
pub(super) fn write(path: &Path, cells: &Cells, arrays: &[Array]) -> io::Result<()> {
    let mut data = Appended::default();
    let (mut points, mut at_nodes) = (String::new(), String::new());
    for array in arrays {
        let target = if array.name == POINTS { &mut points } else { &mut at_nodes };
        target.push_str(&data.numbers(array));
    }
    let numbers = |own: &[i64]| own.iter().map(|own| own.to_le_bytes()).collect::<Vec<_>>();
    let connectivity =
        data.add(("Int64", "connectivity", 1), numbers(&cells.connectivity).into_iter());
    let offsets = data.add(("Int64", "offsets", 1), numbers(&cells.ends).into_iter());
    let types = data.add(("UInt8", "types", 1), cells.kinds.iter().map(|own| [*own]));
    let vectors =
        arrays.iter().find(|own| own.name != POINTS && matches!(own.values, Values::Vectors(_)));
    let shown = vectors.map_or(String::new(), |own| format!(" Vectors=\"{}\"", own.name));
    let (nodes, cells) = (cells.points, cells.kinds.len());
    let mut file = BufWriter::new(File::create(path)?);
    write!(
        file,
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <UnstructuredGrid>\n\
         <Piece NumberOfPoints=\"{nodes}\" NumberOfCells=\"{cells}\">\n\
         <PointData{shown}>\n{at_nodes}</PointData>\n\
         <Points>\n{points}</Points>\n\
         <Cells>\n{connectivity}{offsets}{types}</Cells>\n\
         </Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_",
    )?;
    file.write_all(&data.bytes)?;
    file.write_all(b"\n</AppendedData>\n</VTKFile>\n")?;
    file.flush()
}

/// Writes the list of the files of a body with their times (s).
///
/// # Errors
/// It cannot be written.
pub(super) fn collection(path: &Path, files: &[(f64, String)]) -> io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    writeln!(
        file,
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>"
    )?;
    for (time, name) in files {
        writeln!(file, "<DataSet timestep=\"{time}\" part=\"0\" file=\"{name}\"/>")?;
    }
    writeln!(file, "</Collection>\n</VTKFile>")?;
    file.flush()
}
