//! A case from the mesh of a shaft and the mesh of its support: bearings stand where cylinders of both meet.

mod bearings;
mod draft;
mod text;

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};

use whirl_solver::mesh::{Mesh, Selection};

use self::bearings::Meeting;
use self::draft::{Draft, Held, Part};
use crate::errors::Failure;
use crate::mesh_file::{body_name, bounds, open};

/// The text of a case, and what was found, guessed and left open. `folder`: where the case will stand.
///
/// # Errors
/// Meshes that cannot be read, and meshes in which no journal meets a bore.
pub(super) fn case(
    files: [&PathBuf; 2],
    units: Option<&str>,
    folder: &Path,
) -> Result<(String, String), Failure> {
    let mut names = files.map(|file| body_name(file));
    if names[0].eq_ignore_ascii_case(&names[1]) {
        names = ["shaft", "support"].map(str::to_owned);
    }
    let [shaft, support] = [0, 1].map(|place| -> Result<Part, Failure> {
        let (file, name) = (files[place], names[place].clone());
        // A name of a case's own.
        let taken = name.is_empty() || name.eq_ignore_ascii_case("ground");
        let name = if taken { ["shaft", "support"][place].to_owned() } else { name };
        Ok(Part { opened: open(file, units, None)?, name, path: seen_from(folder, file) })
    });
    let (shaft, support) = (shaft?, support?);
    let Some(axis) = shaft.mesh().round_axis() else {
        return Err(Failure::Argument {
            message: format!("`{}` has no cylinders about an axis along z", files[0].display()),
            help: "name the mesh of a shaft whose axis is parallel to z as `--shaft`; rotate it in the program that made it"
                .to_owned(),
        });
    };
    let (meetings, left) = bearings::find([&shaft, &support].map(Part::mesh), axis);
    if meetings.is_empty() {
        return Err(Failure::Argument {
            message: format!(
                "no journal of `{}` meets a bore of `{}`{}",
                files[0].display(),
                files[1].display(),
                match left.as_slice() {
                    [] => ", which has no bores about the axis of the shaft".to_owned(),
                    left => format!(": {}", left.join("; ")),
                }
            ),
            help: "bores are a little larger than their journals, on one axis and at the same z: look at both with `whirl \
                   mesh FILE`, and give `--units` if their sizes differ"
                .to_owned(),
        });
    }
    let held = held(support.mesh(), axis, &meetings);
    let draft =
        Draft { shaft, support, axis, meetings, left, held, units_guessed: units.is_none() };
    Ok((text::case(&draft), text::decided(&draft)))
}

/// Words in the names of sets by which bodies are held.
const HOLDING: [&str; 10] =
    ["FOOT", "FEET", "MOUNT", "HELD", "FIX", "CLAMP", "GROUND", "BOTTOM", "BASE", "BOLT"];
/// Nodes of a plane are so far from it at most (m), as cases have it.
const FLAT: f64 = 1e-5;
/// The other end is taken where it has so many times the nodes.
const LARGER: usize = 2;

/// What may hold the support: a set that is called so, its lower side (x is up), or an end of it; no plane with an end of a
/// bore.
fn held(mesh: &Mesh, axis: [f64; 2], meetings: &[Meeting]) -> Option<Held> {
    let by_name = |(name, nodes): &(&String, &Vec<usize>)| {
        let name = name.to_ascii_uppercase();
        nodes.len() > 2 && HOLDING.iter().any(|word| name.contains(word))
    };
    if let Some((name, _)) = mesh.node_sets().iter().find(by_name) {
        return Some(Held::Set(name.clone()));
    }
    let bores = meetings.iter().flat_map(|own| {
        let (radius, z) = (own.bore.radius, own.bore.z);
        mesh.selected(&Selection::Cylinder { centre: axis, radius, within: 0.01 * radius, z })
    });
    let bores: BTreeSet<usize> = bores.collect();
    let [low, high] = bounds(mesh.nodes().iter());
    let nodes_at = |across: usize, at: f64| {
        let nodes = mesh.selected(&Selection::Plane { across, at, within: FLAT });
        let free = nodes.len() > 2 && !nodes.iter().any(|node| bores.contains(node));
        if free { nodes.len() } else { 0 }
    };
    if nodes_at(0, low[0]) > 0 {
        return Some(Held::Plane(0, low[0]));
    }
    let [lower, upper] = [low[2], high[2]].map(|z| (z, nodes_at(2, z)));
    let chosen = if upper.1 > LARGER * lower.1 { upper } else { lower };
    (chosen.1 > 0).then_some(Held::Plane(2, chosen.0))
}

/// The path of a file as a case in a folder names it.
fn seen_from(folder: &Path, file: &Path) -> String {
    if file.is_absolute() || folder == Path::new(".") {
        return file.display().to_string();
    }
    let absolute = |path: &Path| std::path::absolute(path).map(plain);
    let (Ok(folder), Ok(whole)) = (absolute(folder), absolute(file)) else {
        return file.display().to_string();
    };
    let common = folder.components().zip(whole.components()).take_while(|(a, b)| a == b).count();
    let up = folder.components().skip(common).map(|_| Component::ParentDir);
    let path: PathBuf = up.chain(whole.components().skip(common)).collect();
    path.display().to_string()
}

/// A path without `..`.
fn plain(path: PathBuf) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => {
                plain.pop();
            }
            other => plain.push(other),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_seen_from_the_case() {
        let seen = |folder: &str, file: &str| seen_from(Path::new(folder), Path::new(file));
        assert_eq!(seen(".", "a/rotor.msh"), "a/rotor.msh");
        assert_eq!(seen("cases", "rotor.msh"), "../rotor.msh");
        assert_eq!(seen("a/b", "a/rotor.msh"), "../rotor.msh");
        assert_eq!(seen("a/../b", "b/c/rotor.msh"), "c/rotor.msh");
        assert_eq!(seen("cases", "/meshes/rotor.msh"), "/meshes/rotor.msh");
    }
}
