//! Meshes of a case: read from a file, or made from dimensions.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::Arc;
use std::{fs, io};

use whirl_codegen::diagnostic::{Code, Diagnostic, Diagnostics, Located, Source, suggest};
use whirl_solver::error::{Error, InputErrors};
use whirl_solver::mesh::format::{self, Format, ReadOptions};
use whirl_solver::mesh::{self, Cell, Material, Mesh, matrices};
use whirl_specs::{ELEMENTS, Element};

use super::{masses, selections};
use crate::case::{self, MatrixFiles, MeshFile};
use crate::errors::Failure;

/// The mesh of a body, with its materials and the sets of the case. `axis` (m) is that of
/// the body in space, as in files. `warnings` are added to, here and below.
///
/// # Errors
/// What is wrong with its file or its dimensions, with places.
pub(super) fn mesh(
    (body, axis): (&case::Body, [f64; 2]),
    warnings: &mut Vec<String>,
) -> Result<Mesh, Failure> {
    let mesh = match &body.mesh {
        case::Mesh::File(file) => read(file, body.material.as_ref(), &body.regions, warnings),
        case::Mesh::Generated(generated) => {
            let mesh = generated.dimensions.mesh(&elements());
            in_regions(mesh.map_err(|error| impossible(generated, error))?, &body.regions)
        }
        case::Mesh::Matrices(files) => of_matrices(files, warnings),
    }?;
    // Those made from dimensions are about their own axis.
    let axis = match body.mesh {
        case::Mesh::File(_) | case::Mesh::Matrices(_) => axis,
        case::Mesh::Generated(_) => [0.0; 2],
    };
    has_mass(&mesh, &body.mesh.place())?;
    unusual_materials(body, &mesh, warnings);
    selections::with_selections(mesh, &body.selections, axis, warnings)
}

/// Refuses a body nothing of which has mass: it has no motion of its own, and discs on it leave the rest without one.
fn has_mass(mesh: &Mesh, place: &Located) -> Result<(), Failure> {
    let materials = mesh.materials();
    if mesh.matrices().is_some()
        || mesh.blocks().iter().any(|block| materials[block.material].has_mass())
    {
        return Ok(());
    }
    let error = place.error_here(Code::BAD_VALUE, "this body has no mass: its density is 0");
    let help =
        "give its material a density, which may be small, or parts of it another one by `regions`";
    Err(Diagnostics::from(error.help(help)).into())
}

/// Warns of materials of the case that no solid is made of; those of a file are judged where they are read.
fn unusual_materials(body: &case::Body, mesh: &Mesh, warnings: &mut Vec<String>) {
    let of_rows = match &body.mesh {
        case::Mesh::Generated(made) => made.dimensions.materials(),
        _ => Vec::new(),
    };
    let given = body.material.iter().chain(body.regions.iter().map(|region| &region.material));
    let given = given.chain(of_rows);
    let used = |material: &&Material| {
        let mut blocks = mesh.blocks().iter();
        blocks.any(|block| mesh.materials()[block.material] == **material)
    };
    let doubts = given.filter(used).flat_map(Material::implausible_properties);
    for doubt in doubts.filter(|doubt| !doubt.refused) {
        let path = body.mesh.place().source().path.display().to_string();
        let warning = format!("{path}: {}: {}", doubt.what, doubt.help);
        if !warnings.contains(&warning) {
            warnings.push(warning);
        }
    }
}

fn elements() -> Vec<&'static Element> {
    ELEMENTS.iter().collect()
}

/// An error about a dimension, where the case says it.
fn impossible(generated: &case::GeneratedMesh, error: Error) -> Failure {
    let Error::Dimension { dimension, value, what, help } = &error else {
        return error.into();
    };
    let place = generated.places.get(dimension).unwrap_or(&generated.table);
    let message = format!("`{dimension} = {value}` {what}");
    Diagnostics::from(place.error_here(Code::BAD_VALUE, message).help(help)).into()
}

/// The mesh in a file: with its own sections, the `regions` of the case in place of them, and `material` where
/// there is neither.
fn read(
    file: &MeshFile,
    material: Option<&Material>,
    regions: &[case::Region],
    warnings: &mut Vec<String>,
) -> Result<Mesh, Failure> {
    let bytes = fs::read(&file.path).map_err(|error| {
        let message = format!("cannot read `{}`: {error}", file.path.display());
        Diagnostics::from(file.name.error_here(Code::BAD_VALUE, message))
    })?;
    let path = file.path.display().to_string();
    let open = material.is_some() || !regions.is_empty();
    let MeshFile { units, units_given, merge, .. } = *file;
    let options = ReadOptions { elements: &elements(), open, units, units_given, merge };
    let read = format::read(bytes, &path, &options).map_err(|errors| placed(&errors))?;
    warnings.extend(read.warnings.iter().map(ToString::to_string));
    warnings.extend(read.masses.iter().map(|mass| masses::in_case(&path, mass)));
    let mesh = in_regions(read.mesh, regions)?;
    complete(file, &path, &mesh)?;
    let bare: Vec<bool> =
        mesh.materials().iter().map(|material| material.properties.is_empty()).collect();
    let is_bare = |cell: Cell| bare[mesh.blocks()[cell.block].material];
    if let Some(material) = material {
        let filled = mesh.with_material(material, is_bare).map_err(Failure::from)?;
        return Ok(filled);
    }
    let cells = mesh.blocks().iter().filter(|block| bare[block.material]);
    let labels: Vec<u64> = cells.flat_map(|block| block.labels.iter().copied()).collect();
    if let Some(first) = labels.first() {
        let message = format!(
            "{path}: {} cells have neither a section nor a region of the case, such as cell {first}",
            labels.len()
        );
        let help = "write `material = \"…\"`, which fills what is missing";
        return Err(
            Diagnostics::from(file.name.error_here(Code::BAD_VALUE, message).help(help)).into()
        );
    }
    Ok(mesh)
}

/// Refuses materials of the file that lack a property: that of the case is another material's.
fn complete(file: &MeshFile, path: &str, mesh: &Mesh) -> Result<(), Failure> {
    let mut errors = Diagnostics::new();
    for (index, material) in mesh.materials().iter().enumerate() {
        let Some(property) = material.lacks().filter(|_| !material.properties.is_empty()) else {
            continue;
        };
        let blocks = mesh.blocks().iter().filter(|block| block.material == index);
        let labels: Vec<u64> = blocks.flat_map(|block| block.labels.iter().copied()).collect();
        let Some(first) = labels.first() else { continue };
        let message = format!(
            "{path}: material {} of {} cells, such as cell {first}, has no {property}",
            material.name,
            labels.len()
        );
        let help = "write it into the file, or give these cells a whole material by `regions`";
        errors.push(file.name.error_here(Code::BAD_VALUE, message).help(help));
    }
    Ok(errors.into_result(())?)
}

/// A body of matrices.
fn of_matrices(files: &MatrixFiles, warnings: &mut Vec<String>) -> Result<Mesh, Failure> {
    let load = |path: &Path| {
        // A device or a pipe may have no end.
        if !fs::metadata(path)?.is_file() {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no file"));
        }
        fs::read(path)
    };
    let read = matrices::read(&files.request, &load).map_err(|errors| placed(&errors))?;
    warnings.extend(read.warnings.iter().map(ToString::to_string));
    Ok(read.mesh)
}

/// The text of a mesh file.
fn text(path: &Path) -> std::io::Result<String> {
    fs::read(path).map(mesh::inp::decode)
}

/// The mesh with the materials that the case gives to element sets.
fn in_regions(mut mesh: Mesh, regions: &[case::Region]) -> Result<Mesh, Failure> {
    let mut errors = Diagnostics::new();
    // By label, since places change with the materials.
    let mut taken: BTreeMap<u64, &Located> = BTreeMap::new();
    for case::Region { set, material } in regions {
        let cells: BTreeSet<Cell> = match mesh.element_set(set.text()) {
            Ok(cells) => cells.iter().copied().collect(),
            Err(_) => {
                let known: Vec<&str> = mesh.element_sets().keys().map(String::as_str).collect();
                let message = format!("{} has no element set `{}`", mesh.origin(), set.text());
                let error = set.error_here(Code::BAD_VALUE, message);
                errors.push(error.maybe_help(suggest(set.text(), &known)));
                continue;
            }
        };
        let labels = cells.iter().map(|cell| mesh.blocks()[cell.block].labels[cell.cell]);
        let twice = labels.filter_map(|label| taken.insert(label, set)).next();
        if let Some(other) = twice {
            let message = format!(
                "`{}` and `{}` share cells, whose material is ambiguous",
                other.text(),
                set.text()
            );
            let help = "name element sets that have no cell in common";
            errors.push(set.error_here(Code::BAD_VALUE, message).help(help));
        }
        mesh = mesh.with_material(material, |cell| cells.contains(&cell)).map_err(Failure::from)?;
    }
    Ok(errors.into_result(mesh)?)
}

/// Errors of a mesh file, and of those that it includes, with their places in the texts.
pub(crate) fn placed(errors: &InputErrors) -> Diagnostics {
    let mut sources: BTreeMap<&str, Arc<Source>> = BTreeMap::new();
    let mut diagnostics = Diagnostics::new();
    for error in &errors.0 {
        let source = sources.entry(&error.file).or_insert_with(|| {
            // What cannot be read any more has its errors without the lines.
            Source::new(&error.file, text(Path::new(&error.file)).unwrap_or_default())
        });
        let text = &source.text;
        let span = (error.line > 0 && !text.is_empty()).then(|| {
            let start = offset(text, error.line, error.column);
            let length =
                text[start..].find([',', '\n', ' ', '\t', '\r']).unwrap_or(text.len() - start);
            start..start + length.max(1)
        });
        let diagnostic = Diagnostic::new(source, Code::BAD_VALUE, span, &error.what);
        let help = (!error.help.is_empty()).then(|| error.help.clone());
        diagnostics.push(diagnostic.maybe_help(help));
    }
    diagnostics
}

/// Cells turned inside out, at their lines in the mesh's file; a generated mesh has no lines.
pub(super) fn inverted(error: &Error) -> Failure {
    let Error::InvertedCells { origin, cells, .. } = error else {
        return error.clone().into();
    };
    let Ok(text) = text(Path::new(origin)) else {
        return error.clone().into();
    };
    let format = Format::of(text.as_bytes(), origin);
    let source = Source::new(origin, text);
    let mut diagnostics = Diagnostics::new();
    for cell in cells {
        let message = format!(
            "cell {} ({}) is inverted or flat: its smallest det J is {:.3e}",
            cell.label, cell.element, cell.jacobian
        );
        let help = "look for nodes in another order (the first face's normal must point towards the \
                    second face), a wrong node label, two nodes at one place, or a distorted cell";
        let span = (format.line_of_cell(&source.text, cell.label)).map(|line| {
            let start = offset(&source.text, line, 1);
            let line = source.text[start..].lines().next().unwrap_or_default();
            start..start + line.trim_end().len()
        });
        diagnostics.push(Diagnostic::new(&source, Code::BAD_VALUE, span, message).help(help));
    }
    diagnostics.into()
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
    use super::offset;

    #[test]
    fn places_are_found() {
        let text = "ab\ncdµf\n";
        assert_eq!(&text[offset(text, 2, 1)..][..2], "cd");
        assert_eq!(&text[offset(text, 2, 4)..], "f\n");
        assert_eq!(offset(text, 1, 0), 0);
        assert_eq!(offset(text, 9, 9), text.len());
    }
}
