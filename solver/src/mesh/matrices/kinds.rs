//! In which format a file has its matrix, by its first bytes.

use std::path::{Path, PathBuf};

use super::super::bdf::Dmig;
use super::super::raw::{LinePosition, MeshReport};
use super::super::text::decode;
use super::abaqus::{self, Listed};
use super::entries::Entries;
use super::{market, op4};

/// A format.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// Matrix Market; what is none of the others, too.
    Market,
    /// OUTPUT4 of Nastran.
    Op4,
    /// OUTPUT2 of Nastran, which is not read.
    Op2,
    /// `FORMAT=COORDINATE` of Abaqus.
    Coordinate,
    /// Of Abaqus by nodes and dofs.
    Labels,
}

/// A matrix among several of a file has its name behind a colon: `model.op4:KAA`.
pub fn file_and_name(path: &Path) -> (PathBuf, Option<String>) {
    let whole = || (path.to_owned(), None);
    let Some((file, name)) = path.to_str().and_then(|text| text.rsplit_once(':')) else {
        return whole();
    };
    let letters = name.starts_with(|c: char| c.is_ascii_alphabetic());
    let named =
        letters && name.len() <= 16 && name.bytes().all(|c| c.is_ascii_alphanumeric() || c == b'_');
    // A letter before a colon is a drive.
    match named && file.len() > 1 {
        true => (PathBuf::from(file), Some(name.to_owned())),
        false => whole(),
    }
}

/// The format of a file.
pub(super) fn kind(bytes: &[u8]) -> Kind {
    if op4::is_op4(bytes) {
        return Kind::Op4;
    }
    // Its first record is a number of four bytes, or of eight.
    let head = [[4, 0, 0, 0], [0, 0, 0, 4], [8, 0, 0, 0], [0, 0, 0, 8]];
    if bytes.get(..4).is_some_and(|own| head.iter().any(|known| known == own)) {
        return Kind::Op2;
    }
    // Whatever its first lines are, they are within these.
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(4000)]);
    match abaqus::listed(&start) {
        _ if start.starts_with("%%") => Kind::Market,
        Some(Listed::Coordinate) => Kind::Coordinate,
        Some(Listed::Labels) => Kind::Labels,
        None => Kind::Market,
    }
}

/// Reads a square matrix of `size` rows, called `name`; none after an error.
pub(super) fn matrix(
    kind: Kind,
    bytes: Vec<u8>,
    (name, file): (&str, usize),
    wanted: Option<&str>,
    size: usize,
    report: &mut MeshReport,
) -> Option<Entries> {
    match kind {
        Kind::Op4 => op4::matrix(&bytes, (name, file), wanted, size, report),
        Kind::Coordinate => abaqus::coordinate(&decode(bytes), (name, file), size, report),
        Kind::Market => market::matrix(&decode(bytes), (name, file), size, report),
        Kind::Op2 | Kind::Labels => {
            refuse(kind, (name, file), report);
            None
        }
    }
}

/// Reads one column of `size` values, called `name`; none after an error.
pub(super) fn column(
    bytes: Vec<u8>,
    (name, file): (&str, usize),
    wanted: Option<&str>,
    size: usize,
    report: &mut MeshReport,
) -> Option<Vec<f64>> {
    match kind(&bytes) {
        Kind::Op4 => op4::column(&bytes, (name, file), wanted, size, report),
        Kind::Market | Kind::Coordinate => {
            market::column(&decode(bytes), (name, file), size, report)
        }
        own @ (Kind::Op2 | Kind::Labels) => {
            refuse(own, (name, file), report);
            None
        }
    }
}

/// Reads what Abaqus lists by nodes and dofs: a matrix, or a load, which is called `Y x0`; none after an error.
pub(super) fn labelled(
    bytes: Vec<u8>,
    (name, file): (&str, usize),
    report: &mut MeshReport,
) -> Option<Dmig> {
    let (kind, is_load) = (kind(&bytes), name == "Y x0");
    match kind {
        Kind::Labels if !is_load => abaqus::labelled(&decode(bytes), (name, file), report),
        Kind::Coordinate if is_load => abaqus::load(&decode(bytes), (name, file), report),
        Kind::Op2 => {
            refuse(kind, (name, file), report);
            None
        }
        _ => {
            let what = format!("{name} has no labels of nodes and dofs");
            let help = match is_load {
                true => "write a line `node, dof, value` for each of its values",
                false => {
                    "let Abaqus write it with `FORMAT=MATRIX INPUT`; or name a table of the dofs as `dofs`, in place of `nodes`"
                }
            };
            report.error(LinePosition { file, line: 0, column: 0 }, what, help);
            None
        }
    }
}

/// Notes a format that is not read, or not here.
fn refuse(kind: Kind, (name, file): (&str, usize), report: &mut MeshReport) {
    let (what, help) = match kind {
        Kind::Op2 => (
            format!("{name} is in a file of OUTPUT2 of Nastran, which is not read"),
            "write it with OUTPUT4, or as DMIG",
        ),
        _ => (
            format!("{name} is listed by nodes and dofs"),
            "leave `dofs` out, and name the input file of Abaqus as `nodes`",
        ),
    };
    report.error(LinePosition { file, line: 0, column: 0 }, what, help);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_matrix_of_a_file_has_its_name_behind_a_colon() {
        for (text, file, name) in [
            ("a/model.op4:KAA", "a/model.op4", Some("KAA")),
            ("model.op4", "model.op4", None),
            ("C:\\model.op4", "C:\\model.op4", None),
            ("C:\\model.op4:K2", "C:\\model.op4", Some("K2")),
            ("C:K", "C:K", None),
            ("10:30/K.mtx", "10:30/K.mtx", None),
        ] {
            let own = file_and_name(Path::new(text));
            assert_eq!(own, (PathBuf::from(file), name.map(str::to_owned)), "{text}");
        }
    }

    #[test]
    fn formats_are_known_by_their_first_bytes() {
        for (bytes, known) in [
            (&b"%%MatrixMarket matrix coordinate real general\n1 1 1\n"[..], Kind::Market),
            (b"", Kind::Market),
            (b"some words\n", Kind::Market),
            (b"       2       2       6       2KAA     1P,3E23.16\n", Kind::Op4),
            (b"\x18\0\0\0\x02\0\0\0", Kind::Op4),
            (b"\0\0\0\x30\0\0\0\0", Kind::Op4),
            (b"\x04\0\0\0\x03\0\0\0", Kind::Op2),
            (b"** a comment\n1, 1, 2.5e3\n", Kind::Coordinate),
            (b"*MATRIX INPUT, NAME=K\n1,1, 1,1, 2.5e3\n", Kind::Labels),
            (b"7 1 -7 2 1e6\n", Kind::Labels),
        ] {
            assert_eq!(kind(bytes), known, "{}", String::from_utf8_lossy(bytes));
        }
    }
}
