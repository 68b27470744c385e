//! The machine in space: surfaces of its bodies, and how they move where the case wants `[fields]`: shapes.json.

use serde::Serialize;
use whirl_solver::mesh::Mesh;

use super::encode::Packed;
use crate::fields::Motions;
use crate::mesh_file::outer_corners;

/// Nodes of all surfaces, and numbers of all frames, at most: a page is to open.
const MOST_NODES: usize = 60_000;
const MOST_NUMBERS: usize = 5_000_000;
/// Cells of a mesh whose surface is looked for, at most.
const MOST_CELLS: usize = 400_000;

/// All of them.
#[derive(Debug, Serialize)]
pub(crate) struct Shapes {
    bodies: Vec<Shape>,
    /// Names of those that are too large.
    left_out: Vec<String>,
}

/// A body in its own frame.
#[derive(Debug, Serialize)]
struct Shape {
    name: String,
    /// Whether its frame turns; x and y of the axis from which its points count (m).
    turns: bool,
    axis: [f64; 2],
    /// Three a node (m), and three places of nodes a triangle.
    points: Packed,
    triangles: Packed,
    #[serde(skip_serializing_if = "Option::is_none")]
    motion: Option<Moved>,
}

/// How it moves.
#[derive(Debug, Serialize)]
struct Moved {
    /// By frame: s, and how far its frame has turned (rad).
    time: Vec<f64>,
    angle: Vec<f64>,
    /// Three a node frame by frame, in its frame, in parts of `largest` / 32767 (m) from 32768 on.
    displacement: Packed,
    largest: f64,
    /// The stress by von Mises of a node frame by frame, in parts of `largest_mpa` / 65535; none where the case wants none.
    #[serde(skip_serializing_if = "Option::is_none")]
    stress: Option<Packed>,
    largest_mpa: f64,
}

/// A body that has a mesh.
pub(crate) struct Meshed<'a> {
    pub(crate) name: &'a str,
    pub(crate) turns: bool,
    pub(crate) axis: [f64; 2],
    pub(crate) mesh: &'a Mesh,
}

impl Shapes {
    /// Of bodies that have meshes; none where none has. Those with their motions are not given here.
    pub(crate) fn of<'a>(bodies: impl Iterator<Item = Meshed<'a>>) -> Option<Self> {
        let mut all = Shapes { bodies: Vec::new(), left_out: Vec::new() };
        let mut room = MOST_NODES;
        for own in bodies {
            let surface = (own.mesh.cell_count() <= MOST_CELLS).then(|| Surface::of(own.mesh));
            match surface.filter(|own| own.nodes.len() <= room) {
                Some(surface) => {
                    room -= surface.nodes.len();
                    all.bodies.push(Shape {
                        name: own.name.to_owned(),
                        turns: own.turns,
                        axis: own.axis,
                        points: surface.points(own.mesh),
                        triangles: Packed::whole(surface.triangles),
                        motion: None,
                    });
                }
                None => all.left_out.push(own.name.to_owned()),
            }
        }
        (!all.bodies.is_empty()).then_some(all)
    }

    /// With the motions of a run.
    pub(crate) fn moved(mut self, motions: &Motions) -> Self {
        let mut room = MOST_NUMBERS;
        for own in motions.played() {
            let Some(shape) = self.bodies.iter_mut().find(|shape| shape.name == own.name) else {
                continue;
            };
            let surface = Surface::of(own.mesh);
            let numbers = 3 * surface.nodes.len() * own.frames.len();
            if numbers == 0 || numbers > room {
                continue;
            }
            room -= numbers;
            let moved = || {
                let of_frame = |frame: usize| {
                    let frame = &own.frames[frame];
                    surface.nodes.iter().flat_map(move |node| frame.displacement[*node])
                };
                (0..own.frames.len()).flat_map(of_frame)
            };
            let largest = moved().fold(f64::MIN_POSITIVE, |most: f64, own| most.max(own.abs()));
            let parts = moved().map(|own| (32768.0 + own / largest * 32767.0).round() as u16);
            let stressed = own.frames.iter().all(|frame| frame.stress.is_some());
            let stresses = || {
                let of = own.frames.iter().filter_map(|frame| frame.stress.as_ref());
                of.flat_map(|all| surface.nodes.iter().map(|node| 1e-6 * all[*node]))
            };
            let largest_mpa = stresses().fold(f64::MIN_POSITIVE, f64::max);
            let share = |own: f64| (own / largest_mpa * 65535.0).round() as u16;
            shape.motion = Some(Moved {
                time: own.frames.iter().map(|frame| frame.time).collect(),
                angle: own.frames.iter().map(|frame| frame.angle).collect(),
                displacement: Packed::short(parts),
                largest,
                stress: stressed.then(|| Packed::short(stresses().map(share))),
                largest_mpa: if stressed { largest_mpa } else { 0.0 },
            });
        }
        self
    }

    /// The text of the file.
    pub(crate) fn json(&self) -> String {
        serde_json::to_string(self).expect("the keys are strings") + "\n"
    }
}

/// Nodes of a mesh that are outside, and triangles of their places among these.
struct Surface {
    nodes: Vec<usize>,
    triangles: Vec<u32>,
}

impl Surface {
    fn of(mesh: &Mesh) -> Self {
        let faces = outer_corners(mesh);
        let mut places: Vec<Option<u32>> = vec![None; mesh.nodes().len()];
        let (mut nodes, mut triangles) = (Vec::new(), Vec::new());
        for face in &faces {
            let mut place = |node: usize| {
                *places[node].get_or_insert_with(|| {
                    nodes.push(node);
                    nodes.len() as u32 - 1
                })
            };
            let own: Vec<u32> = face.iter().map(|node| place(*node)).collect();
            (1..own.len().saturating_sub(1))
                .for_each(|k| triangles.extend([own[0], own[k], own[k + 1]]));
        }
        Surface { nodes, triangles }
    }

    /// Positions in the frame of the body.
    fn points(&self, mesh: &Mesh) -> Packed {
        Packed::single(self.nodes.iter().flat_map(|node| mesh.nodes()[*node]))
    }
}
