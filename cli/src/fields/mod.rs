//! Motions of whole bodies for other programs: frames kept during the march, written as VTU files when it is over.

mod frames;
mod vtu;

use std::fs;
use std::io;
use std::path::Path;

use whirl_solver::machine::{Field, Machine};

pub(crate) use self::frames::{FRAMES, Frame, FrameWriter, Schedule, read};
use crate::machine::Built;

/// The folder of the files among the results.
pub(crate) const FOLDER: &str = "fields";

/// Takes away the files that an earlier run left in the folder.
///
/// # Errors
/// A file cannot be removed.
pub(crate) fn clear(results: &Path) -> io::Result<()> {
    let Ok(entries) = fs::read_dir(results.join(FOLDER)) else { return Ok(()) };
    for entry in entries {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "vtu" || ending == "pvd") {
            fs::remove_file(path)?;
        }
    }
    Ok(())
}

/// Writes the files of all bodies: one a frame, and one a body that lists them with their times.
///
/// # Errors
/// What cannot be written.
pub(crate) fn write(built: &Built, frames: &[Frame], results: &Path) -> io::Result<()> {
    let folder = results.join(FOLDER);
    fs::create_dir_all(&folder)?;
    for (field, own) in built.machine.fields.iter().zip(&built.fields) {
        let name = built.machine.bodies[field.body].name();
        let mut listed = Vec::with_capacity(frames.len());
        for (number, frame) in frames.iter().enumerate() {
            let file = format!("{name}_{number:04}.vtu");
            let moved = moved(&built.machine, field, (own.axis, frame));
            vtu::write(&folder.join(&file), &own.mesh, &moved)?;
            listed.push((frame.time, file));
        }
        vtu::collection(&folder.join(format!("{name}.pvd")), &listed)?;
    }
    Ok(())
}

/// A body at an instant, in space.
struct Moved {
    /// Where its nodes would be without deformation (m).
    positions: Vec<[f64; 3]>,
    /// By which they are beside that (m).
    deformation: Vec<[f64; 3]>,
}

/// `axis`: x and y in space of where the coordinates of the nodes count from (m).
fn moved(machine: &Machine, field: &Field, (axis, frame): ([f64; 2], &Frame)) -> Moved {
    let place = &machine.places()[field.body];
    let theta = place.rotation.map_or(0.0, |at| frame.q[at]);
    let (sin, cos) = theta.sin_cos();
    let turned = |[x, y, z]: [f64; 3]| [cos * x - sin * y, sin * x + cos * y, z];
    let flexible = &frame.q[place.flexible.clone()];
    let mut moved = Moved { positions: Vec::new(), deformation: Vec::new() };
    for node in &field.nodes {
        let [x, y, z] = turned(node.position);
        moved.positions.push([x + axis[0], y + axis[1], z]);
        let along = |i: usize| (0..flexible.len()).map(|j| node.shapes[(i, j)] * flexible[j]).sum();
        moved.deformation.push(turned([0, 1, 2].map(along)));
    }
    moved
}
