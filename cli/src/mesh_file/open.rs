//! A mesh file that a command names, in the units that it is given or that its size suggests.

use std::fs;
use std::path::Path;

use whirl_codegen::units::{Dimension, Quantity};
use whirl_solver::mesh::format::{self, Format, MeshUnits, ReadMesh, ReadOptions};
use whirl_solver::mesh::{Cylinder, Mesh};
use whirl_specs::ELEMENTS;
use whirl_text::rounded;

use crate::case::mesh_units;
use crate::errors::Failure;
use crate::machine::placed_errors;
use crate::streams;

/// No machine is larger (m): numbers that are, are millimetres.
const LARGEST: f64 = 20.0;
/// What a file in millimetres is taken for.
const MILLIMETRES: &str = "mm, N, t";

/// A mesh with what is known of its file.
pub(crate) struct Opened {
    /// In SI units.
    pub(crate) mesh: Mesh,
    pub(crate) format: Format,
    /// As a case writes them; none are m, N, kg.
    pub(crate) units: Option<String>,
}

/// Reads a mesh; cells without material are none the worse for it.
///
/// # Errors
/// A file that cannot be read, whatever is wrong with it, and units or a distance that are none.
pub(crate) fn open(
    file: &Path,
    units: Option<&str>,
    merge: Option<&str>,
) -> Result<Opened, Failure> {
    let path = file.display().to_string();
    let bytes = fs::read(file).map_err(|error| Failure::Argument {
        message: format!("cannot read `{path}`: {error}"),
        help: "name a mesh file, such as `rotor.msh`, `housing.inp` or `casing.bdf`".to_owned(),
    })?;
    let format = Format::of(&bytes, &path);
    let given = units.map(|text| {
        let wrong = |(message, help)| Failure::Argument { message, help };
        mesh_units(text).map(|units| (text.to_owned(), units)).map_err(wrong)
    });
    let given = given.transpose()?;
    let merge = merge.map(distance).transpose()?;
    let read = |units: MeshUnits| -> Result<ReadMesh, Failure> {
        let elements: Vec<_> = ELEMENTS.iter().collect();
        let units_given = given.is_some();
        let options = ReadOptions { elements: &elements, open: true, units, units_given, merge };
        let read = format::read(bytes.clone(), &path, &options);
        read.map_err(|errors| Failure::from(placed_errors(&errors)))
    };
    let (units, found) = match &given {
        Some((text, units)) => (Some(text.clone()), read(*units)?),
        None => {
            let in_millimetres = || read(mesh_units(MILLIMETRES).unwrap_or_default());
            let found = match read(MeshUnits::default()) {
                Ok(found) if largest(&found.mesh) <= LARGEST => Ok((None, found)),
                Ok(_) => in_millimetres().map(|found| (Some(MILLIMETRES.to_owned()), found)),
                // Materials may fit in the other system only. What is wrong in both is said of the first.
                Err(failure) => match in_millimetres() {
                    Ok(found) => Ok((Some(MILLIMETRES.to_owned()), found)),
                    Err(_) => Err(failure),
                },
            };
            found?
        }
    };
    found.warnings.iter().for_each(streams::warn);
    Ok(Opened { mesh: found.mesh, format, units })
}

/// How far nodes may be apart that are to be one (m).
fn distance(text: &str) -> Result<f64, Failure> {
    let read = Quantity::parse(text).ok().filter(|own| *own.dimension() == Dimension::LENGTH);
    read.map(|own| own.si()).filter(|&length| length > 0.0).ok_or_else(|| Failure::Argument {
        message: format!("`--merge {text}` is no length above zero"),
        help: "write a number with its unit, such as `--merge \"1e-6 m\"`".to_owned(),
    })
}

/// The name of a body for a file: what of its stem a case can call it.
pub(crate) fn body_name(file: &Path) -> String {
    let name = file.file_stem().map_or("part".into(), |stem| stem.to_string_lossy());
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    name.chars().map(|c| if plain(c) { c } else { '_' }).collect()
}

/// Names for cylinders.
pub(crate) fn named(cylinders: &[Cylinder]) -> impl Iterator<Item = (String, &Cylinder)> {
    let (mut holes, mut outsides) = (0, 0);
    cylinders.iter().map(move |own| {
        let (word, count) =
            if own.hollow { ("BORE", &mut holes) } else { ("JOURNAL", &mut outsides) };
        *count += 1;
        (format!("{word}_{count}"), own)
    })
}

/// The longest side of the box around a mesh (m).
fn largest(mesh: &Mesh) -> f64 {
    let [low, high] = bounds(mesh.nodes().iter());
    (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max)
}

/// Corners of the box around nodes (m).
pub(crate) fn bounds<'a>(nodes: impl Iterator<Item = &'a [f64; 3]>) -> [[f64; 3]; 2] {
    let mut ends = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for node in nodes {
        for k in 0..3 {
            ends[0][k] = ends[0][k].min(node[k]);
            ends[1][k] = ends[1][k].max(node[k]);
        }
    }
    ends
}

/// A length in mm: to six digits, and to the picometre, below which there is only rounding of other lengths.
pub(crate) fn mm(x: f64) -> String {
    // Adding zero takes the sign off what rounds to it.
    let shown = rounded((1e12 * x).round() / 1e9, 6) + 0.0;
    shown.to_string()
}
