//! `whirl mesh`: what is in a mesh file, with the lines by which a case uses it.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use whirl_solver::mesh::format::{self, Format, MeshUnits, ReadOptions};
use whirl_solver::mesh::{Cylinder, Mesh};
use whirl_specs::ELEMENTS;
use whirl_text::rounded;

use crate::arguments::MeshArguments;
use crate::case::mesh_units;
use crate::errors::Failure;
use crate::machine::placed_errors;
use crate::report::table;
use crate::streams;

/// Adds a line to a text.
macro_rules! line {
    ($text:expr, $($what:tt)*) => {
        writeln!($text, $($what)*).expect("text can be written")
    };
}

/// No machine is larger (m): numbers that are, are millimetres.
const LARGEST: f64 = 20.0;
/// What a file in millimetres is taken for.
const MILLIMETRES: &str = "mm, N, t";

/// Reads a mesh file and says what is in it.
///
/// # Errors
/// A file that cannot be read, whatever is wrong with it, and units that are none.
pub(crate) fn mesh(arguments: &MeshArguments) -> Result<String, Failure> {
    let path = arguments.file.display().to_string();
    let bytes = fs::read(&arguments.file).map_err(|error| Failure::Argument {
        message: format!("cannot read `{path}`: {error}"),
        help: "name a mesh file, such as `rotor.msh`, `housing.inp` or `casing.bdf`".to_owned(),
    })?;
    let format = Format::of(&bytes, &path);
    let given = arguments.units.as_deref().map(|text| {
        let wrong = |(message, help)| Failure::Argument { message, help };
        mesh_units(text).map(|units| (text.to_owned(), units)).map_err(wrong)
    });
    let given = given.transpose()?;
    let read = |units: MeshUnits| {
        let elements: Vec<_> = ELEMENTS.iter().collect();
        let options = ReadOptions { elements: &elements, open: true, units };
        let read = format::read(bytes.clone(), &path, &options);
        read.map_err(|errors| Failure::from(placed_errors(&errors)))
    };
    let (units, found) = match given {
        Some((text, units)) => (Some(text), read(units)?),
        None => {
            let found = read(MeshUnits::default())?;
            match largest(&found.mesh) > LARGEST {
                true => {
                    let units = mesh_units(MILLIMETRES).unwrap_or_default();
                    (Some(MILLIMETRES.to_owned()), read(units)?)
                }
                false => (None, found),
            }
        }
    };
    found.warnings.iter().for_each(streams::warn);
    let mut text = String::new();
    let called = match format {
        Format::Inp => "Abaqus or CalculiX input",
        Format::Msh => "Gmsh",
        Format::Bdf => "Nastran bulk data",
    };
    line!(text, "{path}: {called}");
    match (&units, &arguments.units) {
        (Some(units), None) => {
            line!(text, "units: taken for \"{units}\", by its size; else give `--units`")
        }
        (Some(units), Some(_)) => line!(text, "units: \"{units}\""),
        (None, _) => line!(text, "units: m, N, kg, by its size; else give `--units`"),
    }
    say(&mut text, &found.mesh);
    lines(&mut text, &arguments.file, (&found.mesh, units.as_deref()));
    Ok(text)
}

/// The longest side of the box around a mesh (m).
fn largest(mesh: &Mesh) -> f64 {
    let [low, high] = bounds(mesh.nodes().iter());
    (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max)
}

/// Corners of the box around nodes (m).
fn bounds<'a>(nodes: impl Iterator<Item = &'a [f64; 3]>) -> [[f64; 3]; 2] {
    let mut ends = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for node in nodes {
        for k in 0..3 {
            ends[0][k] = ends[0][k].min(node[k]);
            ends[1][k] = ends[1][k].max(node[k]);
        }
    }
    ends
}

/// A length in mm.
fn mm(x: f64) -> String {
    rounded(1e3 * x, 6).to_string()
}

/// Nodes, cells, sets, materials, quality.
fn say(text: &mut String, mesh: &Mesh) {
    let [low, high] = bounds(mesh.nodes().iter());
    let range = |k: usize| format!("{} to {}", mm(low[k]), mm(high[k]));
    line!(text, "{} nodes: x {}, y {}, z {} mm", mesh.nodes().len(), range(0), range(1), range(2));
    for block in mesh.blocks() {
        let material = &mesh.materials()[block.material];
        let of = match material.properties.is_empty() {
            true => "without material".to_owned(),
            false => format!("of {}", material.name),
        };
        line!(text, "{} cells {}, {of}", block.len(), block.element.origin.name);
    }
    if let Some((worst, inverted)) = mesh.worst_cell() {
        let label = mesh.blocks()[worst.cell.block].labels[worst.cell.cell];
        line!(text, "worst ratio of Jacobians: {:.3}, cell {label}", worst.ratio);
        if inverted > 0 {
            line!(text, "turned inside out at a node: {inverted} cells");
        }
    }
    let mut rows = Vec::new();
    for (name, nodes) in mesh.node_sets() {
        let [low, high] = bounds(nodes.iter().map(|&node| &mesh.nodes()[node]));
        let mut row = vec![name.clone(), nodes.len().to_string()];
        row.extend((0..3).map(|k| format!("{} to {}", mm(low[k]), mm(high[k]))));
        rows.push(row);
    }
    if !rows.is_empty() {
        let heads = ["node set", "nodes", "x (mm)", "y (mm)", "z (mm)"].map(str::to_owned);
        rows.insert(0, heads.to_vec());
        line!(text, "\n{}", table(&rows).trim_end());
    }
    if !mesh.element_sets().is_empty() {
        let sets: Vec<String> = mesh
            .element_sets()
            .iter()
            .map(|(name, cells)| format!("{name} ({})", cells.len()))
            .collect();
        line!(text, "element sets: {}", sets.join(", "));
    }
}

/// Cylinders, and the lines by which a case names them.
fn lines(text: &mut String, file: &Path, (mesh, units): (&Mesh, Option<&str>)) {
    let axis = mesh.round_axis();
    let about = axis.unwrap_or_default();
    let cylinders = mesh.cylinders(about);
    match (axis, cylinders.is_empty()) {
        (_, true) => line!(text, "\nno cylinders about an axis along z"),
        (axis, false) => {
            let [x, y] = axis.unwrap_or_default();
            line!(text, "\ncylinders about x = {}, y = {} mm:", mm(x), mm(y));
            let mut rows = vec![["", "", "radius (mm)", "z (mm)"].map(str::to_owned).to_vec()];
            for (name, own) in named(&cylinders) {
                let kind = if own.hollow { "hole" } else { "outside" };
                let range = format!("{} to {}", mm(own.z[0]), mm(own.z[1]));
                rows.push(vec![name, kind.to_owned(), mm(own.radius), range]);
            }
            line!(text, "{}", table(&rows).trim_end());
        }
    }
    let name = file.file_stem().map_or("part".into(), |stem| stem.to_string_lossy());
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    let name: String = name.chars().map(|c| if plain(c) { c } else { '_' }).collect();
    line!(text, "\nIn a case:\n\n[body.{name}]");
    line!(text, "mesh = {:?}", file.display().to_string());
    if let Some(units) = units {
        line!(text, "units = {units:?}");
    }
    if about != [0.0; 2] {
        line!(text, "axis = [\"{} mm\", \"{} mm\"]", mm(about[0]), mm(about[1]));
    }
    for (set, own) in named(&cylinders) {
        line!(text, "\n[body.{name}.sets.{set}]");
        line!(text, "radius = \"{} mm\"", mm(own.radius));
        line!(text, "z = [\"{} mm\", \"{} mm\"]", mm(own.z[0]), mm(own.z[1]));
    }
}

/// Names for cylinders.
fn named(cylinders: &[Cylinder]) -> impl Iterator<Item = (String, &Cylinder)> {
    let (mut holes, mut outsides) = (0, 0);
    cylinders.iter().map(move |own| {
        let (word, count) =
            if own.hollow { ("BORE", &mut holes) } else { ("JOURNAL", &mut outsides) };
        *count += 1;
        (format!("{word}_{count}"), own)
    })
}
