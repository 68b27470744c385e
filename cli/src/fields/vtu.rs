//! VTU and PVD, the files of VTK and ParaView: XML with the numbers behind it as they are in memory.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::Path;

use whirl_solver::mesh::Mesh;

use super::Moved;

/// The arrays behind the XML, one after the other.
#[derive(Default)]
struct Appended {
    bytes: Vec<u8>,
}

impl Appended {
    /// Adds an array; its place.
    fn add(&mut self, values: impl Iterator<Item = impl AsRef<[u8]>>) -> usize {
        let place = self.bytes.len();
        self.bytes.extend([0; 8]);
        values.for_each(|value| self.bytes.extend(value.as_ref()));
        let length = (self.bytes.len() - place - 8) as u64;
        self.bytes[place..place + 8].copy_from_slice(&length.to_le_bytes());
        place
    }

    fn vectors(&mut self, values: &[[f64; 3]]) -> usize {
        self.add(values.iter().flatten().map(|value| value.to_le_bytes()))
    }
}

/// Writes a mesh at an instant.
///
/// # Errors
/// It cannot be written.
pub(super) fn write(path: &Path, mesh: &Mesh, moved: &Moved) -> io::Result<()> {
    let mut data = Appended::default();
    let points = data.vectors(&moved.positions);
    let deformation = data.vectors(&moved.deformation);
    let cells =
        || mesh.blocks().iter().flat_map(|block| block.cells().map(move |own| (block, own)));
    let connectivity = data.add(cells().flat_map(|(block, cell)| {
        let order = block.element.vtk_order.iter();
        order.map(|&place| (cell[place] as i64).to_le_bytes()).collect::<Vec<_>>()
    }));
    let mut end = 0;
    let offsets = data.add(cells().map(|(block, _)| {
        end += block.element.nodes as i64;
        end.to_le_bytes()
    }));
    let types = data.add(cells().map(|(block, _)| [block.element.vtk]));
    let array = |kind: &str, name: &str, components: usize, place: usize| {
        let components = match components {
            1 => String::new(),
            count => format!(" NumberOfComponents=\"{count}\""),
        };
        format!(
            "<DataArray type=\"{kind}\" Name=\"{name}\"{components} format=\"appended\" offset=\"{place}\"/>\n"
        )
    };
    let (nodes, cells) = (moved.positions.len(), mesh.cell_count());
    let mut file = BufWriter::new(File::create(path)?);
    write!(
        file,
        "<?xml version=\"1.0\"?>\n\
         <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n\
         <UnstructuredGrid>\n\
         <Piece NumberOfPoints=\"{nodes}\" NumberOfCells=\"{cells}\">\n\
         <PointData Vectors=\"deformation_m\">\n{}</PointData>\n\
         <Points>\n{}</Points>\n\
         <Cells>\n{}{}{}</Cells>\n\
         </Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_",
        array("Float64", "deformation_m", 3, deformation),
        array("Float64", "points", 3, points),
        array("Int64", "connectivity", 1, connectivity),
        array("Int64", "offsets", 1, offsets),
        array("UInt8", "types", 1, types),
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
