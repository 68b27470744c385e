//! Meshes of a case: read from a file, or made from dimensions.

use std::fs;
use std::ops::Range;
use std::path::Path;

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Source};
use whirl_solver::error::{Error, InputErrors};
use whirl_solver::mesh::{self, Material, Mesh, MeshParts};
use whirl_specs::{ELEMENTS, Element};

use crate::case::{self, MeshFile};
use crate::errors::Failure;

/// The mesh of the shaft.
///
/// # Errors
/// What is wrong with its file or its dimensions, with places.
pub(super) fn shaft(shaft: &case::Shaft) -> Result<Mesh, Failure> {
    match &shaft.mesh {
        case::Mesh::File(file) => read(file, shaft.material.as_ref()),
        case::Mesh::Made(made) => {
            made.dimensions.mesh(&elements()).map_err(|error| impossible(made, error))
        }
    }
}

/// The mesh of the support.
///
/// # Errors
/// As for the shaft.
pub(super) fn support(support: &case::Support) -> Result<Mesh, Failure> {
    match &support.mesh {
        case::Mesh::File(file) => read(file, support.material.as_ref()),
        case::Mesh::Made(made) => {
            made.dimensions.mesh(&elements()).map_err(|error| impossible(made, error))
        }
    }
}

fn elements() -> Vec<&'static Element> {
    ELEMENTS.iter().collect()
}

/// An error about a dimension, where the case says it.
fn impossible<D>(made: &case::Made<D>, error: Error) -> Failure {
    let Error::Dimension { dimension, value, what, help } = &error else {
        return error.into();
    };
    let place = made.places.get(dimension).unwrap_or(&made.table);
    let message = format!("`{dimension} = {value}` {what}");
    Diagnostics::from(place.error_here(Code::BAD_VALUE, message).help(help)).into()
}

/// The mesh in a file, with `material` in place of the file's own where the case names one.
fn read(file: &MeshFile, material: Option<&Material>) -> Result<Mesh, Failure> {
    let text = fs::read_to_string(&file.path).map_err(|error| {
        let message = format!("cannot read `{}`: {error}", file.path.display());
        Diagnostics::from(file.name.error_here(Code::BAD_VALUE, message))
    })?;
    let path = file.path.display().to_string();
    let read = mesh::inp::read(&text, &path, &elements())
        .map_err(|errors| placed(&file.path, &text, &errors))?;
    read.warnings.iter().for_each(|warning| eprintln!("warning: {warning}"));
    match material {
        Some(material) => with_material(&read.mesh, material).map_err(Failure::from),
        None => Ok(read.mesh),
    }
}

/// The mesh with one material everywhere.
fn with_material(mesh: &Mesh, material: &Material) -> Result<Mesh, Error> {
    let mut blocks = mesh.blocks().to_vec();
    blocks.iter_mut().for_each(|block| block.material = 0);
    Mesh::new(MeshParts {
        origin: mesh.origin().to_string(),
        nodes: mesh.nodes().to_vec(),
        labels: mesh.labels().to_vec(),
        blocks,
        materials: vec![material.clone()],
        node_sets: mesh.node_sets().clone(),
        element_sets: mesh.element_sets().clone(),
    })
}

/// Errors of a mesh file with their places in its text.
fn placed(path: &Path, text: &str, errors: &InputErrors) -> Diagnostics {
    let source = Source::new(path, text);
    let mut diagnostics = Diagnostics::new();
    for error in &errors.0 {
        let span = (error.line > 0).then(|| {
            let start = offset(text, error.line, error.column);
            let length = text[start..].find([',', '\n', ' ', '\r']).unwrap_or(text.len() - start);
            start..start + length.max(1)
        });
        let diagnostic = Diagnostic::new(&source, Code::BAD_VALUE, span, &error.what);
        let help = (!error.help.is_empty()).then(|| error.help.clone());
        diagnostics.push(diagnostic.maybe_help(help));
    }
    diagnostics
}

/// Cells turned inside out, at their lines in the mesh's file; a made mesh has no lines.
pub(super) fn inverted(error: &Error) -> Failure {
    let Error::InvertedCells { origin, cells, .. } = error else {
        return error.clone().into();
    };
    let Ok(text) = fs::read_to_string(origin) else {
        return error.clone().into();
    };
    let source = Source::new(origin, text);
    let mut diagnostics = Diagnostics::new();
    for cell in cells {
        let message = format!(
            "cell {} ({}) is turned inside out or flat: its smallest det J is {:.3e}",
            cell.label, cell.element, cell.jacobian
        );
        let help = "look for nodes in another order (the first face's normal must point towards the \
                    second face), a wrong node label, two nodes at one place, or a distorted cell";
        let span = line_of_cell(&source.text, cell.label);
        diagnostics.push(Diagnostic::new(&source, Code::BAD_VALUE, span, message).help(help));
    }
    diagnostics.into()
}

/// The first line of a cell among the elements of an input file.
fn line_of_cell(text: &str, label: u64) -> Option<Range<usize>> {
    let mut among_elements = false;
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let words = line.trim();
        if words.starts_with('*') {
            among_elements = match words.get(..2) {
                Some("**") => among_elements,
                _ => words.to_ascii_uppercase().starts_with("*ELEMENT"),
            };
        } else if among_elements
            && words.split(',').next().and_then(|word| word.trim().parse().ok()) == Some(label)
        {
            return Some(start..start + line.trim_end().len());
        }
        start += line.len();
    }
    None
}

/// Byte at a line and a column in characters, both from 1; column 0 is the start of the line.
fn offset(text: &str, line: usize, column: usize) -> usize {
    let mut start = 0;
    for _ in 1..line {
        start = text[start..].find('\n').map_or(text.len(), |end| start + end + 1);
    }
    let before = text[start..].chars().take(column.saturating_sub(1));
    (start + before.map(char::len_utf8).sum::<usize>()).min(text.len())
}

#[cfg(test)]
mod tests {
    use super::{line_of_cell, offset};

    #[test]
    fn cells_are_found_among_elements_only() {
        let text = "*NODE\n7, 0, 0, 0\n*ELEMENT, TYPE=C3D8\n** 7\n 17, 1\n 7, 1, 2\n*NSET\n7\n";
        assert_eq!(&text[line_of_cell(text, 7).unwrap()], " 7, 1, 2");
        assert_eq!(line_of_cell(text, 1), None);
    }

    #[test]
    fn places_are_found() {
        let text = "ab\ncdµf\n";
        assert_eq!(&text[offset(text, 2, 1)..][..2], "cd");
        assert_eq!(&text[offset(text, 2, 4)..], "f\n");
        assert_eq!(offset(text, 1, 0), 0);
        assert_eq!(offset(text, 9, 9), text.len());
    }
}
