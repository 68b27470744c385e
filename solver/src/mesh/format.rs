//! Which format a file of a mesh has.
//!
//! A new format is a variant of [`Format`] with its arms here, and a reader that fills a raw mesh.

use std::path::Path;

use super::foreign::{Foreign, foreign};
pub use super::reading::{ReadMesh, ReadOptions};
use super::text::decode;
pub use super::units::MeshUnits;
use super::{bdf, inp, msh, unv};
use crate::error::{InputError, InputErrors};

/// Formats that are read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Input of Abaqus and CalculiX.
    Inp,
    /// Gmsh.
    Msh,
    /// Bulk data of Nastran.
    Bdf,
    /// Universal file, as of Salome and I-DEAS.
    Unv,
}

impl Format {
    /// The format of a file: by its first characters, and by its extension where they leave it open.
    pub fn of(bytes: &[u8], path: &str) -> Format {
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes).trim_ascii_start();
        let extension = Path::new(path).extension().and_then(|extension| extension.to_str());
        let extension = extension.unwrap_or_default().to_ascii_lowercase();
        match bytes {
            [b'*', ..] => Format::Inp,
            [b'$', rest @ ..]
                if [&b"MeshFormat"[..], b"NOD", b"Comments"]
                    .iter()
                    .any(|name| rest.starts_with(name)) =>
            {
                Format::Msh
            }
            _ if unv::is_universal(bytes) => Format::Unv,
            _ if bdf::is_bulk_data(bytes) => Format::Bdf,
            _ if extension == "unv" => Format::Unv,
            _ if extension == "msh" => Format::Msh,
            _ if ["bdf", "nas", "nastran"].contains(&extension.as_str()) => Format::Bdf,
            _ => Format::Inp,
        }
    }

    /// What a file of it is called.
    pub fn called(self) -> &'static str {
        match self {
            Format::Inp => "Abaqus or CalculiX input",
            Format::Msh => "Gmsh",
            Format::Bdf => "Nastran bulk data",
            Format::Unv => "universal file",
        }
    }

    /// Where files of it may state their units.
    pub fn units_in(self) -> Option<&'static str> {
        (self == Format::Unv).then_some("dataset 164")
    }

    /// The line of a text, from 1, in which a cell has its label; the cell may go on in the next lines.
    pub fn line_of_cell(self, text: &str, label: u64) -> Option<usize> {
        match self {
            Format::Bdf => return bdf::line_of_element(text, label),
            Format::Unv => return unv::line_of_element(text, label),
            Format::Inp | Format::Msh => {}
        }
        let mut among_elements = false;
        for (number, line) in text.lines().enumerate() {
            let words = line.trim();
            let keyword = match self {
                Format::Msh => words.starts_with('$').then_some("$ELEMENTS"),
                _ => words.starts_with('*').then_some("*ELEMENT"),
            };
            if let Some(keyword) = keyword {
                if !words.starts_with("**") {
                    among_elements = words.to_ascii_uppercase().starts_with(keyword);
                }
                continue;
            }
            let mut values = words.split(|c: char| c == ',' || c.is_whitespace());
            let first = values.next().and_then(|word| word.parse().ok());
            // Blocks of Gmsh have a line of four numbers of their own; a solid has more.
            let is_cell = self == Format::Inp || values.count() > 3;
            if among_elements && first == Some(label) && is_cell {
                return Some(number + 1);
            }
        }
        None
    }
}

/// Reads a mesh, in whatever format it is.
///
/// # Errors
/// All that is wrong, each with its place, and how to fix it.
pub fn read(bytes: Vec<u8>, path: &str, options: &ReadOptions) -> Result<ReadMesh, InputErrors> {
    if let Some(Foreign { what, help }) = foreign(&bytes, path) {
        let what = format!("this is {what}, which is not read");
        let file = path.to_owned();
        return Err(InputErrors(vec![InputError { file, line: 0, column: 0, what, help }]));
    }
    match Format::of(&bytes, path) {
        Format::Inp => inp::read_with(&decode(bytes), path, options),
        Format::Msh => msh::read(&bytes, path, options),
        Format::Bdf => bdf::read(&decode(bytes), path, options, &load),
        Format::Unv => unv::read(&decode(bytes), path, options),
    }
}

/// The text of an included file.
fn load(path: &Path) -> std::io::Result<String> {
    // A device or a pipe may have no end.
    if !std::fs::metadata(path)?.is_file() {
        return Err(std::io::Error::new(std::io::ErrorKind::InvalidInput, "it is no file"));
    }
    let bytes = std::fs::read(path)?;
    match foreign(&bytes, &path.display().to_string()) {
        Some(Foreign { what, help }) => Err(std::io::Error::new(
            std::io::ErrorKind::InvalidData,
            format!("it is {what}: {help}"),
        )),
        None => Ok(decode(bytes)),
    }
}

#[cfg(test)]
mod tests {
    use super::Format;

    #[test]
    fn contents_come_before_the_extension() {
        assert_eq!(Format::of(b"$MeshFormat\n", "a.inp"), Format::Msh);
        assert_eq!(Format::of(b"\xef\xbb\xbf\n** mesh\n", "a.msh"), Format::Inp);
        assert_eq!(Format::of(b"", "a.MSH"), Format::Msh);
        assert_eq!(Format::of(b"1, 2", "a"), Format::Inp);
        assert_eq!(Format::of(b"", "a.nas"), Format::Bdf);
        assert_eq!(Format::of(b"$ shaft\n\nSOL 103\nCEND\n", "a.inp"), Format::Bdf);
        assert_eq!(Format::of(b"$ shaft\nGRID,1", "a.dat"), Format::Bdf);
        assert_eq!(Format::of(b"    -1\n  2411\n", "a.inp"), Format::Unv);
        assert_eq!(Format::of(b"    -1\r\n   164\r\n", "a"), Format::Unv);
        assert_eq!(Format::of(b"", "a.UNV"), Format::Unv);
        assert_eq!(Format::of(b"$ bulk\nGRID,1\n", "a.unv"), Format::Bdf);
        assert_eq!(Format::of(b"$ shaft\ninclude 'more.dat'", "a"), Format::Bdf);
    }

    #[test]
    fn cells_are_found_among_elements_only() {
        let text = "*NODE\n7, 0, 0, 0\n*ELEMENT, TYPE=C3D8\n** 7\n 17, 1\n 7, 1, 2\n*NSET\n7\n";
        assert_eq!(Format::Inp.line_of_cell(text, 7), Some(6));
        assert_eq!(Format::Inp.line_of_cell(text, 1), None);
        let text =
            "$Nodes\n3 1 2 3 4\n$EndNodes\n$Elements\n1 1 3 3\n3 1 4 1\n3 1 2 5 4 \n$EndElements\n";
        assert_eq!(Format::Msh.line_of_cell(text, 3), Some(7));
        let text = "GRID           7\n$CHEXA        7\nCHEXA          7       1\nCPENTA*                8\nCTETRA,9,1\n";
        let lines = [7, 8, 9, 1].map(|label| Format::Bdf.line_of_cell(text, label));
        assert_eq!(lines, [Some(3), Some(4), Some(5), None]);
        let text = "    -1\n  2411\n 7 1 1 11\n 0 0 0\n    -1\n    -1\n  2412\n 9 111 1 1 7 4\n 7 8 9 10\n 7 111 1 1 7 4\n 7 8 9 11\n    -1\n";
        let lines = [7, 8, 9].map(|label| Format::Unv.line_of_cell(text, label));
        assert_eq!(lines, [Some(10), None, Some(8)]);
    }
}
