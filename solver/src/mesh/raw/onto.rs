//! Points on faces of cells, and nodes that follow the faces on which they stand.

use whirl_specs::{Element, Face};

use super::grid::spacing;
use super::grid::{PointGrid, distance};
use super::ties::{FileDof, FileRow};
use super::{Cells, NodeTable};

/// Nodes are tied to faces from which they are at most this part of the face's size away, unless a file says how far.
const NEAR: f64 = 0.05;
/// A node is on a face if it is away from it by less than this part of its size.
const ON: f64 = 1e-10;

/// Edges of a box in cells of the grid beyond which all nodes are looked at.
const WIDE: f64 = 4.0;

/// A face of a cell: the cell's index, and its face.
pub(crate) type FaceOfCell = (usize, &'static Face);

/// The point of a face that is nearest to another one.
pub(super) struct Nearest {
    /// In the face's own coordinates.
    pub(super) at: [f64; 2],
    /// From the point to it (m).
    pub(super) away: f64,
    /// Where it is.
    place: [f64; 3],
    /// Shape functions of the face's nodes there, and their slopes by the face's coordinates.
    weights: Vec<(f64, [f64; 2])>,
    /// Tangents of the face by its coordinates.
    by: [[f64; 3]; 2],
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|k| a[k] * b[k]).sum()
}

/// The point of a face, whose nodes are at `places`, that is nearest to a point, by its shape functions; `within` brings
/// coordinates back to where they may be. `None` where there is none.
pub(super) fn nearest(
    (element, face): (&Element, &Face),
    places: &[[f64; 3]],
    point: [f64; 3],
    within: impl Fn([f64; 2]) -> [f64; 2],
) -> Option<Nearest> {
    const ITERATIONS: usize = 30;
    let (mut values, mut slopes) = (vec![0.0; element.nodes], vec![[0.0; 3]; element.nodes]);
    let mut at = [if face.corners == 3 { 1.0 / 3.0 } else { 0.0 }; 2];
    // Gauss and Newton's way to it.
    for iteration in 0..ITERATIONS {
        let cell_at =
            [0, 1, 2].map(|k| face.origin[k] + at[0] * face.along[0][k] + at[1] * face.along[1][k]);
        (element.shape)(cell_at, &mut values, &mut slopes);
        let (mut place, mut by) = ([0.0; 3], [[0.0; 3]; 2]);
        let slope = |own: usize, along: &[f64; 3]| dot(slopes[own], *along);
        for (x, &own) in places.iter().zip(face.nodes) {
            for (along, by) in face.along.iter().zip(&mut by) {
                let slope = slope(own, along);
                (0..3).for_each(|k| by[k] += slope * x[k]);
            }
            (0..3).for_each(|k| place[k] += values[own] * x[k]);
        }
        let residual: [f64; 3] = std::array::from_fn(|k| place[k] - point[k]);
        let (aa, ab, bb) = (dot(by[0], by[0]), dot(by[0], by[1]), dot(by[1], by[1]));
        let (ra, rb) = (dot(by[0], residual), dot(by[1], residual));
        let det = aa * bb - ab * ab;
        let step = [(bb * ra - ab * rb) / det, (aa * rb - ab * ra) / det];
        // Written so that NaN ends it as well.
        if !(step[0].abs().max(step[1].abs()) < 10.0) {
            return None;
        }
        let next = within([at[0] - step[0], at[1] - step[1]]);
        let moved = (next[0] - at[0]).abs().max((next[1] - at[1]).abs());
        if moved < 1e-13 || iteration + 1 == ITERATIONS {
            let weights = face.nodes.iter().map(|&own| {
                (values[own], [slope(own, &face.along[0]), slope(own, &face.along[1])])
            });
            let (away, weights) = (dot(residual, residual).sqrt(), weights.collect());
            return Some(Nearest { at, away, place, weights, by });
        }
        at = next;
    }
    None
}

impl Nearest {
    /// How a point that is carried along by the face moves along x, y and z: of each node of the face, a factor of its
    /// displacement, and a vector by which its displacement along the normal counts; and the normal.
    ///
    /// From the face to the point leads g. What of it lies in the face is stretched as the face is there, and what stands on
    /// it turns with it, so that rigid motions are followed exactly.
    fn carries(&self, point: [f64; 3], size: f64) -> (Vec<(f64, [f64; 3])>, [f64; 3]) {
        let g: [f64; 3] = std::array::from_fn(|k| point[k] - self.place[k]);
        let [a, b] = self.by;
        let cross: [f64; 3] = std::array::from_fn(|k| {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            a[i] * b[j] - a[j] * b[i]
        });
        let length = dot(cross, cross).sqrt();
        let normal = cross.map(|x| x / length);
        if dot(g, g).sqrt() <= ON * size {
            return (self.weights.iter().map(|(own, _)| (*own, [0.0; 3])).collect(), normal);
        }
        let (aa, ab, bb) = (dot(a, a), dot(a, b), dot(b, b));
        let det = aa * bb - ab * ab;
        // Reciprocal to the tangents.
        let duals: [[f64; 3]; 2] = [
            std::array::from_fn(|k| (bb * a[k] - ab * b[k]) / det),
            std::array::from_fn(|k| (aa * b[k] - ab * a[k]) / det),
        ];
        let (up, along) = (dot(g, normal), duals.map(|dual| dot(dual, g)));
        let carried = self.weights.iter().map(|(own, by)| {
            let turns = std::array::from_fn(|k| -up * (by[0] * duals[0][k] + by[1] * duals[1][k]));
            (own + by[0] * along[0] + by[1] * along[1], turns)
        });
        (carried.collect(), normal)
    }
}

/// Nodes follow the nearest of the faces: their equations, and those that no face is near enough to.
///
/// `most`: how far a node may be from a face, in units of the file; else by the size of the face.
pub(crate) fn onto_faces(
    nodes: &NodeTable,
    cells: &Cells,
    (followers, faces): (&[usize], &[FaceOfCell]),
    most: Option<f64>,
) -> (Vec<FileRow>, Vec<usize>) {
    let positions = &nodes.positions;
    let mut best: Vec<Option<(f64, usize)>> = vec![None; positions.len()];
    let of_face = |(cell, face): &FaceOfCell| -> Vec<usize> {
        face.nodes.iter().map(|&own| cells.list[*cell].nodes[own]).collect()
    };
    let size_of = |own: &[usize]| -> f64 {
        let ends = |k: usize| {
            let all = own.iter().map(|&node| positions[node][k]);
            all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
        };
        (0..3).map(ends).fold(0.0, f64::max)
    };
    let found = |place: usize, node: usize| -> Option<Nearest> {
        let (cell, face) = faces[place];
        let own = of_face(&faces[place]);
        let places: Vec<[f64; 3]> = own.iter().map(|&node| positions[node]).collect();
        let element = cells.list[cell].element?;
        nearest((element, face), &places, positions[node], |at| inside(face, at))
    };
    let sizes: Vec<f64> = faces.iter().map(|face| size_of(&of_face(face))).collect();
    let grid_size = sizes.iter().fold(spacing(positions, positions.len()), |a, b| a.max(*b));
    let grid = PointGrid::new(positions, followers, grid_size.max(f64::MIN_POSITIVE));
    for (place, face) in faces.iter().enumerate() {
        let own = of_face(face);
        let reach = most.unwrap_or(NEAR * sizes[place]);
        let ends = [f64::min as fn(f64, f64) -> f64, f64::max].map(|pick| -> [f64; 3] {
            std::array::from_fn(|k| {
                own.iter().map(|&node| positions[node][k]).reduce(pick).unwrap_or(0.0)
            })
        });
        // Curved faces bulge out of the box around their nodes.
        let bulge = 0.25 * sizes[place];
        let mut look = |node: usize| {
            let at = positions[node];
            let beside = (0..3).map(|k| (ends[0][k] - at[k]).max(at[k] - ends[1][k]));
            let nearest = best[node].map_or(reach, |(known, _)| known.min(reach));
            if beside.fold(0.0, f64::max) > nearest + bulge {
                return;
            }
            let away = match own.iter().any(|&own| distance(positions[own], at) == 0.0) {
                true => Some(0.0),
                false => found(place, node).map(|own| own.away),
            };
            if let Some(away) = away.filter(|away| *away <= reach)
                // Of faces that are as near, as those beside an edge are, the first.
                && best[node].is_none_or(|(known, _)| away < known - ON * sizes[place])
            {
                best[node] = Some((away, place));
            }
        };
        let margin = reach + bulge;
        match margin < WIDE * grid_size {
            true => {
                let ends = [ends[0].map(|x| x - margin), ends[1].map(|x| x + margin)];
                grid.each_in(ends, look);
            }
            // Nodes of a surface are fewer than the cells of so wide a box.
            false => followers.iter().for_each(|&node| look(node)),
        }
    }
    let (mut rows, mut lost) = (Vec::new(), Vec::new());
    for &node in followers {
        let Some((_, place)) = best[node] else {
            lost.push(node);
            continue;
        };
        let own = of_face(&faces[place]);
        if own.contains(&node) {
            continue;
        }
        let Some(on) = found(place, node) else { continue };
        let (carried, normal) = on.carries(positions[node], sizes[place]);
        for i in 0..3 {
            let mut row = vec![(FileDof::Cell(3 * node + i), 1.0)];
            for (&other, (by, turns)) in own.iter().zip(&carried) {
                for (k, along) in normal.iter().enumerate() {
                    let c = f64::from(i == k) * by + turns[i] * along;
                    // Shape functions of other corners vanish but for rounding.
                    if c.abs() > 1e-14 {
                        row.push((FileDof::Cell(3 * other + k), -c));
                    }
                }
            }
            rows.push(row);
        }
    }
    (rows, lost)
}

/// The nearest coordinates within a face.
fn inside(face: &Face, [s, t]: [f64; 2]) -> [f64; 2] {
    if face.corners != 3 {
        return [s.clamp(-1.0, 1.0), t.clamp(-1.0, 1.0)];
    }
    let (s, t) = (s.max(0.0), t.max(0.0));
    let over = s + t - 1.0;
    if over <= 0.0 {
        return [s, t];
    }
    let s = (s - 0.5 * over).clamp(0.0, 1.0);
    [s, 1.0 - s]
}
