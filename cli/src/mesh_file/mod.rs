//! `whirl mesh`: what is in a mesh file, with the lines by which a case uses it.

mod open;
mod picture;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::Path;

use whirl_solver::mesh::Mesh;

pub(crate) use self::open::{Opened, body_name, bounds, mm, named, open};
use crate::arguments::MeshArguments;
use crate::errors::Failure;
use crate::picture_file;
use crate::report::table;

/// Adds a line to a text.
macro_rules! line {
    ($text:expr, $($what:tt)*) => {
        writeln!($text, $($what)*).expect("text can be written")
    };
}

/// Reads a mesh file and says what is in it.
///
/// # Errors
/// A file that cannot be read, whatever is wrong with it, and units that are none.
pub(crate) fn mesh(arguments: &MeshArguments) -> Result<String, Failure> {
    let path = arguments.file.display().to_string();
    // Before the mesh is read.
    if let Some(file) = &arguments.picture {
        picture_file::is_png(file)?;
    }
    let (units, merge) = (arguments.units.as_deref(), arguments.merge.as_deref());
    let Opened { mesh, format, units } = open(&arguments.file, units, merge)?;
    let mut text = String::new();
    line!(text, "{path}: {}", format.called());
    match (&units, &arguments.units) {
        (Some(units), None) => {
            line!(text, "units: taken for \"{units}\", by its size; else give `--units`")
        }
        (Some(units), Some(_)) => line!(text, "units: \"{units}\""),
        (None, _) => match format.units_in() {
            Some(place) => {
                line!(text, "units: those of the file ({place}), or m; else give `--units`")
            }
            None => line!(text, "units: m, N, kg, by its size; else give `--units`"),
        },
    }
    say(&mut text, &mesh);
    let said = (units.as_deref(), arguments.merge.as_deref());
    lines(&mut text, &arguments.file, &mesh, said);
    if let Some(file) = &arguments.picture {
        picture::draw(&mesh, &path, file)?;
    }
    Ok(text)
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
            false => match material.lacks() {
                Some(property) => format!("of {}, which has no {property}", material.name),
                None => format!("of {}", material.name),
            },
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
    ties(mesh).iter().for_each(|own| line!(text, "joined by {own}"));
    let mut rows = Vec::new();
    for (name, nodes) in mesh.node_sets() {
        let [low, high] = bounds(nodes.iter().map(|&node| &mesh.nodes()[node]));
        let mut row = vec![name.clone(), nodes.len().to_string()];
        let range = |k: usize| match nodes.is_empty() {
            true => "–".to_owned(),
            false => format!("{} to {}", mm(low[k]), mm(high[k])),
        };
        row.extend((0..3).map(range));
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

/// What joins nodes beside the cells, with the sets that it joins as a whole: by kinds of cards, as a mesh may have hundreds
/// of one kind.
pub(crate) fn ties(mesh: &Mesh) -> Vec<String> {
    let mut kinds: BTreeMap<&str, (usize, BTreeSet<usize>, usize)> = BTreeMap::new();
    for tie in mesh.ties() {
        // Names are `RBE2 12`, `*TIE SEAM`, `*RIGID BODY of line 30`.
        let name = tie.name.split(" of line ").next().unwrap_or_default();
        let kind = match name.strip_prefix('*') {
            Some(_) if tie.name != name => name,
            _ => name.rsplit_once(' ').map_or(name, |(kind, _)| kind),
        };
        let own = kinds.entry(kind).or_default();
        own.0 += 1;
        own.1.extend(tie.nodes());
        own.2 += tie.rows.len();
    }
    let said = |(kind, (number, nodes, equations)): (&str, (usize, BTreeSet<usize>, usize))| {
        let whole = |own: &[usize]| !own.is_empty() && own.iter().all(|node| nodes.contains(node));
        let sets: Vec<&str> = mesh
            .node_sets()
            .iter()
            .filter(|(_, own)| whole(own))
            .map(|(name, _)| name.as_str())
            .collect();
        let sets = match sets[..] {
            [] => String::new(),
            _ => format!(" (all of {})", sets.join(", ")),
        };
        format!("{number} {kind}: {} nodes{sets}, {equations} equations", nodes.len())
    };
    kinds.into_iter().map(said).collect()
}

/// Cylinders, and the lines by which a case names them.
fn lines(
    text: &mut String,
    file: &Path,
    mesh: &Mesh,
    (units, merge): (Option<&str>, Option<&str>),
) {
    let axis = mesh.round_axis();
    let about = axis.unwrap_or_default();
    let cylinders = mesh.cylinders(about);
    let about = if cylinders.is_empty() { [0.0; 2] } else { about };
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
    let name = body_name(file);
    line!(text, "\nIn a case:\n\n[body.{name}]");
    line!(text, "mesh = {:?}", file.display().to_string());
    if let Some(units) = units {
        line!(text, "units = {units:?}");
    }
    if let Some(merge) = merge {
        line!(text, "merge = {merge:?}");
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
