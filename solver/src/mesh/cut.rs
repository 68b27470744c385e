//! Points at which what is cut is summed: of the parts of faces within a band along z, and of the section of cells across z.

use super::Mesh;
use super::surface_face::SurfaceFace;

/// A point with its part of an area.
pub(super) struct Sample<'a> {
    /// Nodes whose functions do not vanish there, and these functions.
    pub(super) nodes: &'a [usize],
    pub(super) values: &'a [f64],
    /// Where it is (m).
    pub(super) at: [f64; 3],
    /// Its part of the area, as a vector along the normal (m²).
    pub(super) area: [f64; 3],
}

/// Gauss's points and weights over 0 ≤ x ≤ 1, exact to degree 11.
const GAUSS: [(f64, f64); 6] = [
    (0.033_765_242_898_423_99, 0.085_662_246_189_585_17),
    (0.169_395_306_766_867_74, 0.180_380_786_524_069_3),
    (0.380_690_406_958_401_56, 0.233_956_967_286_345_52),
    (0.619_309_593_041_598_4, 0.233_956_967_286_345_52),
    (0.830_604_693_233_132_3, 0.180_380_786_524_069_3),
    (0.966_234_757_101_576, 0.085_662_246_189_585_17),
];
/// Parts into which the way from one kink to the next is divided where z is not linear over a face.
const PANELS: usize = 4;
/// A number counts as zero beside 1.
const ZERO: f64 = 1e-12;

/// Roots of c0 + c1 x + c2 x² = 0.
fn roots([c0, c1, c2]: [f64; 3]) -> impl Iterator<Item = f64> {
    let scale = c0.abs().max(c1.abs()).max(c2.abs());
    let square = c1 * c1 - 4.0 * c0 * c2;
    let (first, second) = if c2.abs() > ZERO * scale {
        let sum = -0.5 * (c1 + square.max(0.0).sqrt().copysign(c1));
        ((square >= 0.0).then_some(sum / c2), (square >= 0.0 && sum != 0.0).then(|| c0 / sum))
    } else {
        ((c1.abs() > ZERO * scale).then(|| -c0 / c1), None)
    };
    first.into_iter().chain(second)
}

/// c0 + c1 x + c2 x² through the values at 0, ½ and 1.
fn parabola([start, middle, end]: [f64; 3]) -> [f64; 3] {
    [start, 4.0 * middle - 3.0 * start - end, 2.0 * (start + end) - 4.0 * middle]
}

impl SurfaceFace {
    /// The points of its own rule.
    pub(super) fn each_point(&self, positions: &[[f64; 3]], mut visit: impl FnMut(&Sample)) {
        let nodes: Vec<usize> = self.nodes().collect();
        for point in self.face.points {
            let slopes = point.slopes.iter().copied();
            let (at, area) = placed(positions, &nodes, point.values, slopes, point.weight);
            visit(&Sample { nodes: &nodes, values: point.values, at, area });
        }
    }

    /// Points over the part of it within a band along z (m): exact where z is linear over the face, else to a rule of high
    /// order.
    pub(super) fn each_point_within(
        &self,
        positions: &[[f64; 3]],
        band: [f64; 2],
        mut visit: impl FnMut(&Sample),
    ) {
        let nodes: Vec<usize> = self.nodes().collect();
        let heights: Vec<f64> = nodes.iter().map(|&node| positions[node][2]).collect();
        let mut shape = FaceShape::new(self);
        // s from 0 to 1, and t from 0 to 1 of what there is of it.
        let z = |shape: &mut FaceShape, s: f64, t: f64| -> f64 {
            shape.evaluate(s, t);
            shape.values.iter().zip(&heights).map(|(value, z)| value * z).sum()
        };
        let along_t =
            |shape: &mut FaceShape, s: f64| parabola([0.0, 0.5, 1.0].map(|t| z(shape, s, t)));
        let mut kinks = vec![0.0, 1.0];
        for t in [0.0, 1.0] {
            let edge = parabola([0.0, 0.5, 1.0].map(|s| z(&mut shape, s, t)));
            for end in band.into_iter().filter(|end| end.is_finite()) {
                kinks.extend(
                    roots([edge[0] - end, edge[1], edge[2]]).filter(|s| *s > 0.0 && *s < 1.0),
                );
            }
        }
        kinks.sort_by(f64::total_cmp);
        let span = heights.iter().fold(0.0, |most: f64, z| most.max((z - heights[0]).abs()));
        let linear =
            [0.0, 0.31, 1.0].iter().all(|&s| along_t(&mut shape, s)[2].abs() <= ZERO.sqrt() * span);
        let panels = if linear { 1 } else { PANELS };
        for pair in kinks.windows(2).filter(|pair| pair[1] - pair[0] > ZERO) {
            for panel in 0..panels {
                let width = (pair[1] - pair[0]) / panels as f64;
                for (place, weight) in GAUSS {
                    let s = pair[0] + width * (panel as f64 + place);
                    let course = along_t(&mut shape, s);
                    let mut ends = vec![0.0, 1.0];
                    for end in band.into_iter().filter(|end| end.is_finite()) {
                        let crossings = roots([course[0] - end, course[1], course[2]]);
                        ends.extend(crossings.filter(|t| *t > 0.0 && *t < 1.0));
                    }
                    ends.sort_by(f64::total_cmp);
                    for part in ends.windows(2) {
                        let (middle, length) = (0.5 * (part[0] + part[1]), part[1] - part[0]);
                        let height = course[0] + middle * (course[1] + middle * course[2]);
                        if !(band[0]..=band[1]).contains(&height) {
                            continue;
                        }
                        for (along, part_weight) in GAUSS {
                            let stretch = shape.evaluate(s, part[0] + length * along);
                            let weight = stretch * width * weight * length * part_weight;
                            let slopes = shape.slopes.iter().copied();
                            let (at, area) =
                                placed(positions, &nodes, &shape.values, slopes, weight);
                            visit(&Sample { nodes: &nodes, values: &shape.values, at, area });
                        }
                    }
                }
            }
        }
    }
}

/// Functions of the nodes of a face at a point of it.
struct FaceShape<'a> {
    own: &'a SurfaceFace,
    all: Vec<f64>,
    all_slopes: Vec<[f64; 3]>,
    values: Vec<f64>,
    /// By the face's own coordinates.
    slopes: Vec<[f64; 2]>,
}

impl<'a> FaceShape<'a> {
    fn new(own: &'a SurfaceFace) -> FaceShape<'a> {
        let (all, of_face) = (own.element.nodes, own.face.nodes.len());
        FaceShape {
            own,
            all: vec![0.0; all],
            all_slopes: vec![[0.0; 3]; all],
            values: vec![0.0; of_face],
            slopes: vec![[0.0; 2]; of_face],
        }
    }

    /// At s from 0 to 1 and t from 0 to 1 of its range there; how much the face's own coordinates change by both.
    fn evaluate(&mut self, s: f64, t: f64) -> f64 {
        let face = self.own.face;
        let (at, stretch) = match face.corners {
            3 => ([s, (1.0 - s) * t], 1.0 - s),
            _ => ([2.0 * s - 1.0, 2.0 * t - 1.0], 4.0),
        };
        let cell_at =
            [0, 1, 2].map(|k| face.origin[k] + at[0] * face.along[0][k] + at[1] * face.along[1][k]);
        (self.own.element.shape)(cell_at, &mut self.all, &mut self.all_slopes);
        for (place, &node) in face.nodes.iter().enumerate() {
            self.values[place] = self.all[node];
            self.slopes[place] =
                face.along.map(|along| (0..3).map(|k| self.all_slopes[node][k] * along[k]).sum());
        }
        stretch
    }
}

/// Where a point of a surface is, and its part of the area, by the functions of nodes there.
fn placed(
    positions: &[[f64; 3]],
    nodes: &[usize],
    values: &[f64],
    slopes: impl Iterator<Item = [f64; 2]>,
    weight: f64,
) -> ([f64; 3], [f64; 3]) {
    let (mut at, mut tangents) = ([0.0; 3], [[0.0; 3]; 2]);
    for ((&node, value), slope) in nodes.iter().zip(values).zip(slopes) {
        for (k, x) in positions[node].into_iter().enumerate() {
            at[k] += value * x;
            tangents[0][k] += slope[0] * x;
            tangents[1][k] += slope[1] * x;
        }
    }
    (at, cross(tangents[0], tangents[1]).map(|x| weight * x))
}

fn cross([a, b, c]: [f64; 3], [x, y, z]: [f64; 3]) -> [f64; 3] {
    [b * z - c * y, c * x - a * z, a * y - b * x]
}

impl Mesh {
    /// Points over the section of all cells across z (m): exact where z is linear over the cells, such as tetrahedra with
    /// straight edges and cells between planes. Where z is a plane between cells, those below count.
    pub(super) fn each_point_of_section(&self, z: f64, mut visit: impl FnMut(&Sample)) {
        for block in self.blocks() {
            let element = block.element;
            // The cell as tetrahedra from its middle to its faces, in its own coordinates.
            let count = element.reference_nodes.len() as f64;
            let middle = [0, 1, 2]
                .map(|k| element.reference_nodes.iter().map(|at| at[k]).sum::<f64>() / count);
            let corners: Vec<[[f64; 3]; 3]> = element.faces.iter().flat_map(triangles).collect();
            let (mut values, mut slopes) =
                (vec![0.0; element.nodes], vec![[0.0; 3]; element.nodes]);
            for cell in block.cells() {
                let heights: Vec<f64> = cell.iter().map(|&node| self.nodes()[node][2]).collect();
                let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
                let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                if !(low < z && z <= high) {
                    continue;
                }
                for triangle in &corners {
                    let ends = [middle, triangle[0], triangle[1], triangle[2]];
                    let at_ends = ends.map(|at| {
                        // At the apex of a pyramid functions have no value by their formulas.
                        let node = element.reference_nodes.iter().position(|known| *known == at);
                        if let Some(node) = node {
                            return heights[node];
                        }
                        (element.shape)(at, &mut values, &mut slopes);
                        values.iter().zip(&heights).map(|(value, z)| value * z).sum::<f64>()
                    });
                    for polygon in cut(ends, at_ends.map(|own| own - z)) {
                        each_point_of_triangle(polygon, |at, tangents, weight| {
                            (element.shape)(at, &mut values, &mut slopes);
                            let along = slopes.iter().map(|slope| {
                                tangents.map(|tangent| {
                                    (0..3).map(|k| slope[k] * tangent[k]).sum::<f64>()
                                })
                            });
                            let (at, area) = placed(self.nodes(), cell, &values, along, weight);
                            visit(&Sample { nodes: cell, values: &values, at, area });
                        });
                    }
                }
            }
        }
    }
}

/// A face of a reference cell as triangles.
fn triangles(face: &whirl_specs::Face) -> Vec<[[f64; 3]; 3]> {
    let at = |s: f64, t: f64| {
        [0, 1, 2].map(|k| face.origin[k] + s * face.along[0][k] + t * face.along[1][k])
    };
    if face.corners == 3 {
        return vec![[at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)]];
    }
    let around = [at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)];
    (0..4).map(|k| [at(0.0, 0.0), around[k], around[(k + 1) % 4]]).collect()
}

/// The triangles in which a tetrahedron is cut where a linear function is zero, by its values at the corners.
fn cut(corners: [[f64; 3]; 4], values: [f64; 4]) -> Vec<[[f64; 3]; 3]> {
    let above = values.map(|value| value >= 0.0);
    let (up, down): (Vec<usize>, Vec<usize>) = (0..4).partition(|&k| above[k]);
    let on = |a: usize, b: usize| {
        let part = values[a] / (values[a] - values[b]);
        [0, 1, 2].map(|k| corners[a][k] + part * (corners[b][k] - corners[a][k]))
    };
    match (up.as_slice(), down.as_slice()) {
        (&[a], &[b, c, d]) | (&[b, c, d], &[a]) => vec![[on(a, b), on(a, c), on(a, d)]],
        (&[a, b], &[c, d]) => {
            vec![[on(a, c), on(a, d), on(b, d)], [on(a, c), on(b, d), on(b, c)]]
        }
        _ => Vec::new(),
    }
}

/// Points of a triangle with its tangents and their weights.
fn each_point_of_triangle(
    [a, b, c]: [[f64; 3]; 3],
    mut visit: impl FnMut([f64; 3], [[f64; 3]; 2], f64),
) {
    let tangents = [[0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k])];
    for (s, first) in GAUSS {
        for (t, second) in GAUSS {
            let (s, t, weight) = (s, (1.0 - s) * t, first * second * (1.0 - s));
            let at = [0, 1, 2].map(|k| a[k] + s * tangents[0][k] + t * tangents[1][k]);
            visit(at, tangents, weight);
        }
    }
}
