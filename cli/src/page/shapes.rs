//! The machine in space: surfaces of its bodies, and how they move where the case wants `[fields]`: shapes.json. Analyses show the
//! same surfaces in their motions.

use serde::Serialize;
use whirl_solver::mesh::Mesh;

use super::encode::Packed;
use super::marks::Mark;
use crate::fields::Motions;
use crate::machine::Watched;
use crate::outside::outer_corners;

/// Nodes of all surfaces, and numbers of all frames, at most: a page is to open.
const MOST_NODES: usize = 60_000;
const MOST_NUMBERS: usize = 5_000_000;
/// Cells of a mesh whose surface is looked for, at most.
const MOST_CELLS: usize = 400_000;

/// All of them.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Shapes {
    bodies: Vec<Shape>,
    /// Where joints stand.
    joints: Vec<Mark>,
    /// Names of those that are too large.
    left_out: Vec<String>,
    /// Names of those without inertias by which cylinders could be drawn.
    without_shape: Vec<String>,
}

/// A body in its own frame.
#[derive(Debug, Serialize)]
struct Shape {
    name: String,
    /// Whether its frame turns; x and y of the axis from which its points count (m).
    turns: bool,
    axis: [f64; 2],
    /// Three a node (m), and three places of nodes a triangle, as short as they can be.
    points: Packed,
    triangles: Packed,
    /// Whether it is a cylinder in the place of what has no mesh.
    #[serde(skip_serializing_if = "is_false")]
    sketched: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    motion: Option<Moved>,
    /// The body that its points are of, by its place, and what they are there.
    #[serde(skip)]
    on: (usize, Watched),
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

fn is_false(own: &bool) -> bool {
    !own
}

/// A body or a disc without a mesh.
pub(super) struct Solid<'a> {
    pub(super) name: &'a str,
    /// The body, by its place, and which of what it carries it is.
    pub(super) body: usize,
    pub(super) carried: Option<usize>,
    pub(super) turns: bool,
    pub(super) axis: [f64; 2],
    /// Where its centre is across the axis, and along it (m); kg, and kg m² about z and across it, if that is known.
    pub(super) centre: [f64; 2],
    pub(super) z: f64,
    pub(super) mass: f64,
    pub(super) polar: f64,
    pub(super) across: Option<f64>,
    /// The film in front of it, of a pad: where it begins, how far it reaches (rad), its radius and its length (m).
    pub(super) pad: Option<[f64; 4]>,
}

impl Solid<'_> {
    /// Radius and length of the cylinder with its mass and inertias; none where they are those of none.
    pub(super) fn cylinder(&self) -> Option<[f64; 2]> {
        // I_p = m r²/2, I_t = m (3 r² + l²)/12.
        let square = 2.0 * self.polar / self.mass;
        let length = self.across.map(|across| 12.0 * across / self.mass - 3.0 * square);
        let radius = square.sqrt();
        let length = length.filter(|square| *square > 0.0).map_or(LENGTH * radius, f64::sqrt);
        (radius > 0.0 && length.is_finite()).then_some([radius, length])
    }

    /// Its points and triangles: a cylinder, or a shell behind its film.
    fn surface(&self) -> Option<(Vec<[f64; 3]>, Vec<u32>)> {
        let about = |length: f64| [self.z - 0.5 * length, self.z + 0.5 * length];
        let [x, y] = self.centre;
        if let Some([start, size, radius, length]) = self.pad {
            // As thick as its centre is behind the film, twice over.
            let behind = x.hypot(y) - radius;
            let thick = if behind > 0.0 && behind < radius { 2.0 * behind } else { THICK * radius };
            return Some(shell([start, size], [radius, radius + thick], about(length)));
        }
        let [radius, length] = self.cylinder()?;
        let (mut points, triangles) = cylinder(radius, about(length));
        points.iter_mut().for_each(|own| *own = [own[0] + x, own[1] + y, own[2]]);
        Some((points, triangles))
    }
}

/// Corners of a cylinder, and its length over its radius where it has no inertia across.
const CORNERS: u32 = 48;
const LENGTH: f64 = 0.5;
/// How thick a pad is over its radius, where its centre does not tell it.
const THICK: f64 = 0.2;
/// Parts of the arc of a pad.
const PARTS: u32 = 16;

/// A body that has a mesh.
pub(super) struct Meshed<'a> {
    pub(super) name: &'a str,
    /// By its place.
    pub(super) body: usize,
    pub(super) turns: bool,
    pub(super) axis: [f64; 2],
    pub(super) mesh: &'a Mesh,
}

impl Shapes {
    /// Of bodies that have meshes; none where none has. Those with their motions are not given here.
    pub(super) fn of<'a>(bodies: impl Iterator<Item = Meshed<'a>>) -> Option<Self> {
        let mut all = Shapes::default();
        let mut room = MOST_NODES;
        for own in bodies {
            let surface = (own.mesh.cell_count() <= MOST_CELLS).then(|| Surface::of(own.mesh));
            match surface.filter(|own| own.nodes.len() <= room) {
                // A body of matrices has no cells.
                Some(surface) if surface.nodes.is_empty() => {}
                Some(surface) => {
                    room -= surface.nodes.len();
                    all.bodies.push(Shape {
                        name: own.name.to_owned(),
                        turns: own.turns,
                        axis: own.axis,
                        points: surface.points(own.mesh),
                        triangles: triangles(surface.triangles, surface.nodes.len()),
                        sketched: false,
                        motion: None,
                        on: (own.body, Watched::Nodes(surface.nodes)),
                    });
                }
                None => all.left_out.push(own.name.to_owned()),
            }
        }
        (!all.bodies.is_empty()).then_some(all)
    }

    /// With cylinders of the same mass and inertias for bodies and discs that have no mesh.
    pub(super) fn sketched<'a>(
        own: Option<Self>,
        solids: impl Iterator<Item = Solid<'a>>,
    ) -> Option<Self> {
        let mut all = own.unwrap_or_default();
        for own in solids {
            let Some((points, corners)) = own.surface() else {
                all.without_shape.push(own.name.to_owned());
                continue;
            };
            all.bodies.push(Shape {
                name: own.name.to_owned(),
                turns: own.turns,
                axis: own.axis,
                points: Packed::single(points.iter().copied().flatten()),
                triangles: triangles(corners, points.len()),
                sketched: true,
                motion: None,
                on: (own.body, Watched::Fixed(own.carried, points)),
            });
        }
        (!all.bodies.is_empty()).then_some(all)
    }

    /// The points of each shape, with the body that they are of.
    pub(crate) fn points(&self) -> impl Iterator<Item = (usize, &Watched)> {
        self.bodies.iter().map(|own| (own.on.0, &own.on.1))
    }

    /// With joints.
    pub(super) fn joined(mut self, joints: Vec<Mark>) -> Self {
        self.joints = joints;
        self
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

/// Places of so many nodes.
fn triangles(places: Vec<u32>, nodes: usize) -> Packed {
    match u16::try_from(nodes) {
        Ok(_) => Packed::short(places.into_iter().map(|own| own as u16)),
        Err(_) => Packed::whole(places),
    }
}

/// Points and triangles of a closed cylinder about z, which faces outwards.
fn cylinder(radius: f64, [low, high]: [f64; 2]) -> (Vec<[f64; 3]>, Vec<u32>) {
    let around = |k: u32, z: f64| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(CORNERS)).sin_cos();
        [radius * cos, radius * sin, z]
    };
    let mut points: Vec<[f64; 3]> = (0..CORNERS).map(|k| around(k, low)).collect();
    points.extend((0..CORNERS).map(|k| around(k, high)));
    points.extend([[0.0, 0.0, low], [0.0, 0.0, high]]);
    let triangles = (0..CORNERS).flat_map(|k| {
        let (a, b) = (k, (k + 1) % CORNERS);
        let (c, d, below, above) = (a + CORNERS, b + CORNERS, 2 * CORNERS, 2 * CORNERS + 1);
        [a, b, d, a, d, c, below, b, a, above, c, d]
    });
    let triangles = triangles.collect();
    (points, triangles)
}

/// Points and triangles of a closed part of a ring about z.
fn shell([start, size]: [f64; 2], radii: [f64; 2], ends: [f64; 2]) -> (Vec<[f64; 3]>, Vec<u32>) {
    let at = |k: u32| {
        let (sin, cos) = (start + size * f64::from(k) / f64::from(PARTS)).sin_cos();
        let corners = [(0, 0), (1, 0), (1, 1), (0, 1)];
        corners.map(|(radius, end)| [radii[radius] * cos, radii[radius] * sin, ends[end]])
    };
    let points: Vec<[f64; 3]> = (0..=PARTS).flat_map(at).collect();
    let mut triangles = Vec::new();
    for k in 0..PARTS {
        for side in 0..4 {
            let [a, b] = [side, (side + 1) % 4].map(|own| 4 * k + own);
            triangles.extend([a, b + 4, b, a, a + 4, b + 4]);
        }
    }
    let last = 4 * PARTS;
    triangles.extend([0, 1, 2, 0, 2, 3, last, last + 2, last + 1, last, last + 3, last + 2]);
    (points, triangles)
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume and inertias of a cylinder are those of the polygon with its corners, and it faces outwards.
    #[test]
    fn cylinders_have_the_inertias_of_what_they_stand_for() {
        let (points, triangles) = cylinder(0.1, [0.2, 0.7]);
        let mut volume = 0.0;
        for own in triangles.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|k| points[own[k] as usize]);
            let across = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
            volume += (a[0] * across(1, 2) + a[1] * across(2, 0) + a[2] * across(0, 1)) / 6.0;
        }
        let corners = f64::from(CORNERS);
        let polygon = 0.5 * corners * (std::f64::consts::TAU / corners).sin() * 0.1 * 0.1;
        assert!((volume / (0.5 * polygon) - 1.0).abs() < 1e-12, "{volume}");
        // m = 2 kg, r = 0.1 m, l = 0.6 m.
        let (mass, polar, across) = (2.0, 0.01, 2.0 * (0.03 + 0.36) / 12.0);
        let solid = |across| Solid {
            name: "a",
            body: 0,
            carried: None,
            turns: true,
            axis: [0.0; 2],
            centre: [0.0; 2],
            z: 0.3,
            mass,
            polar,
            across,
            pad: None,
        };
        let made = Shapes::sketched(None, [solid(Some(across))].into_iter()).expect("one");
        let (points, _) = cylinder(0.1, [0.0, 0.6]);
        assert_eq!(
            made.bodies[0].points,
            Packed::single(points.into_iter().flatten().map(|x| x + 0.0))
        );
        let made = Shapes::sketched(None, [solid(None)].into_iter()).expect("one");
        let (points, _) = cylinder(0.1, [0.275, 0.325]);
        assert_eq!(made.bodies[0].points, Packed::single(points.into_iter().flatten()));
        // A pad is a part of a ring, as thick as its centre tells.
        let pad = [0.0, 1.0, 0.05, 0.04];
        let (points, triangles) =
            Solid { centre: [0.0, 0.055], pad: Some(pad), ..solid(None) }.surface().expect("a pad");
        let volume = triangles.chunks_exact(3).map(|own| {
            let [a, b, c] = [0, 1, 2].map(|k| points[own[k] as usize]);
            let across = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
            (a[0] * across(1, 2) + a[1] * across(2, 0) + a[2] * across(0, 1)) / 6.0
        });
        let known = 0.5 * (0.06_f64.powi(2) - 0.05_f64.powi(2)) * 0.04;
        assert!((volume.sum::<f64>() / known - 1.0).abs() < 1e-3);
        let none = Solid { polar: 0.0, ..solid(None) };
        assert!(Shapes::sketched(None, [none].into_iter()).is_none());
    }
}
