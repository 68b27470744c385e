//! How a bore moves at its springs and as a whole, as rows over the coordinates of its body.

use std::collections::BTreeSet;

use whirl_specs::{BoreMotion, Clearance};

use super::{Bearing, BoreSurface, periodic_spline};
use crate::bodies::Body;
use crate::body::BodyNode;
use crate::error::Error;
use crate::linalg::Matrix;
use crate::mesh::measure::mean_radius;

/// The bore of a bearing: three rings of nodes, left, middle and right, of which some may be empty; or faces.
pub(super) struct Bore<'a> {
    kernels: &'a Clearance,
    bearing: &'a Bearing,
    rings: [Vec<&'a BodyNode>; 3],
    body: &'a Body,
    /// From values at the nodes of a ring to those at the springs, where a law asks for them.
    splines: [Option<Matrix>; 3],
    /// Coordinates of the body.
    size: usize,
}

impl<'a> Bore<'a> {
    /// The bore of the bearing at `place`; `at_springs`: whether its motion is wanted spring by spring.
    ///
    /// # Errors
    /// Every ring through whose nodes no spline passes, though one is needed.
    pub(super) fn new(
        kernels: &'a Clearance,
        (place, bearing): (usize, &'a Bearing),
        body: &'a Body,
        at_springs: bool,
    ) -> Result<Self, Vec<Error>> {
        let rings = bearing.bore.each_ref();
        let rings = rings.map(|ring| ring.iter().map(|&node| &body.nodes()[node]).collect());
        let mut bore =
            Bore { kernels, bearing, rings, body, splines: [None, None, None], size: body.size() };
        let weights = bearing.stations.iter().map(|&station| (kernels.axial)(station));
        let weights: Vec<[f64; 3]> = weights.collect();
        let mut errors = Vec::new();
        for (ring, nodes) in bore.rings.iter().enumerate() {
            let used = weights.iter().any(|weights| weights[ring] != 0.0);
            if !at_springs || nodes.is_empty() || !used {
                continue;
            }
            let [x, y] = bearing.sides.bore_axis;
            let angle = |node: &&BodyNode| (node.position[1] - y).atan2(node.position[0] - x);
            let knots: Vec<f64> = nodes.iter().map(angle).collect();
            bore.splines[ring] = periodic_spline(&knots, &bearing.angles);
            if bore.splines[ring].is_none() {
                let (bearing, nodes) = (bearing.name.clone(), nodes.len());
                errors.push(Error::Bore { bearing, place, ring, nodes });
            }
        }
        if errors.is_empty() { Ok(bore) } else { Err(errors) }
    }

    /// Rows of the plane at a station, by its place, one a spring or one a ring: the motion of each of the three rings,
    /// eqs. (20) to (23), with A_i(z) between them; or of the faces there.
    pub(super) fn rows(&self, place: usize, motion: BoreMotion) -> Vec<Vec<f64>> {
        let mut rows = self.rows_of(place, motion);
        let weights = (self.kernels.axial)(self.bearing.stations[place]);
        let [x, y] = between(&self.bearing.sides.offset, weights);
        // b0 turns with the bore: β ẑ×b0.
        let arm = match motion {
            BoreMotion::MeanX => -y,
            BoreMotion::MeanY => x,
            _ => 0.0,
        };
        if arm != 0.0 {
            let turn = self.rows_of(place, BoreMotion::MeanTurn);
            let turned = rows.iter_mut().flatten().zip(turn.iter().flatten());
            turned.for_each(|(own, turn)| *own += arm * turn);
        }
        rows
    }

    fn rows_of(&self, place: usize, motion: BoreMotion) -> Vec<Vec<f64>> {
        if let Some(surface) = &self.bearing.sides.surface {
            return match at_springs(motion) {
                true => self.on_faces(&surface.points[place], motion),
                false => {
                    let mean =
                        mean_on_faces(surface, self.body, self.bearing, surface.stations[place]);
                    vec![mean[mean_row(motion)].clone()]
                }
            };
        }
        let station = self.bearing.stations[place];
        let angles = if at_springs(motion) { self.bearing.angles.as_slice() } else { &[0.0] };
        let mut rows = vec![vec![0.0; self.size]; angles.len()];
        let weights = (self.kernels.axial)(station);
        for ((ring, spline), weight) in self.rings.iter().zip(&self.splines).zip(weights) {
            if ring.is_empty() || weight == 0.0 {
                continue;
            }
            match spline {
                _ if !at_springs(motion) => {
                    let axis = self.bearing.sides.bore_axis;
                    add_rigid(ring, axis, weight, motion, &mut rows[0]);
                }
                Some(spline) => add_spline(ring, spline, weight, motion, angles, &mut rows),
                None => {}
            }
        }
        rows
    }

    /// Rows of points on faces, a spring each.
    fn on_faces(&self, points: &[Vec<(usize, f64)>], motion: BoreMotion) -> Vec<Vec<f64>> {
        let nodes = self.body.nodes();
        let row = |(point, &angle): (&Vec<(usize, f64)>, &f64)| {
            let [along_x, along_y] = direction(motion, angle);
            let at = |j: usize| -> f64 {
                let moved = |&(node, weight): &(usize, f64)| {
                    let shapes = &nodes[node].shapes;
                    weight * (along_x * shapes[(0, j)] + along_y * shapes[(1, j)])
                };
                point.iter().map(moved).sum()
            };
            (0..self.size).map(at).collect()
        };
        points.iter().zip(&self.bearing.angles).map(row).collect()
    }

    /// b0 in the plane at `station`, in the rows of [`Bore::rows`].
    pub(super) fn offset(&self, station: f64, motion: BoreMotion) -> Vec<f64> {
        let weights = (self.kernels.axial)(station);
        let [x, y] = between(&self.bearing.sides.offset, weights);
        let at = |along: [f64; 2]| along[0] * x + along[1] * y;
        match motion {
            BoreMotion::MeanX => vec![x],
            BoreMotion::MeanY => vec![y],
            BoreMotion::Radial | BoreMotion::Tangential => {
                self.bearing.angles.iter().map(|&angle| at(direction(motion, angle))).collect()
            }
            _ => vec![0.0],
        }
    }
}

/// Values between those of the left end, the middle and the right end.
pub(super) fn between(values: &[[f64; 2]; 3], weights: [f64; 3]) -> [f64; 2] {
    [0, 1].map(|axis| values.iter().zip(weights).map(|(own, weight)| weight * own[axis]).sum())
}

/// The direction of a motion at a spring: the normal or the tangent.
fn direction(motion: BoreMotion, angle: f64) -> [f64; 2] {
    let (sin, cos) = angle.sin_cos();
    if motion == BoreMotion::Radial { [cos, sin] } else { [-sin, cos] }
}

/// Whether a motion is that of the bore at each spring.
pub(super) fn at_springs(motion: BoreMotion) -> bool {
    matches!(motion, BoreMotion::Radial | BoreMotion::Tangential)
}

/// Adds splines of δ_x and δ_y along the ring, along the normal or the tangent of every spring.
fn add_spline(
    ring: &[&BodyNode],
    spline: &Matrix,
    weight: f64,
    motion: BoreMotion,
    angles: &[f64],
    rows: &mut [Vec<f64>],
) {
    for (place, (row, angle)) in rows.iter_mut().zip(angles).enumerate() {
        let [along_x, along_y] = direction(motion, *angle);
        for (knot, node) in ring.iter().enumerate() {
            let coefficient = weight * spline[(place, knot)];
            for (j, value) in row.iter_mut().enumerate() {
                *value +=
                    coefficient * (along_x * node.shapes[(0, j)] + along_y * node.shapes[(1, j)]);
            }
        }
    }
}

/// Adds the displacement of the axis or the rotation of the ring's [`rigid_fit`].
fn add_rigid(ring: &[&BodyNode], axis: [f64; 2], weight: f64, motion: BoreMotion, row: &mut [f64]) {
    let [x, y, turn] = rigid_fit(ring, axis, row.len());
    let fitted = &[x, y, turn][mean_row(motion)];
    row.iter_mut().zip(fitted).for_each(|(sum, value)| *sum += weight * value);
}

/// Which of the displacement along x and y and the rotation a motion of the whole ring is.
fn mean_row(motion: BoreMotion) -> usize {
    match motion {
        BoreMotion::MeanX => 0,
        BoreMotion::MeanY => 1,
        _ => 2,
    }
}

/// The displacement of the bore's axis at `z` (m) along x and y and the rotation about it, by the mean motion of all of it:
/// rows over the coordinates of the body.
fn mean_on_faces(surface: &BoreSurface, body: &Body, bearing: &Bearing, z: f64) -> [Vec<f64>; 3] {
    let mean = &body.measures()[surface.mean];
    let [x, y] = bearing.sides.bore_axis;
    let axis = mean.node_at([x, y, z]).shapes;
    let row = |matrix: &Matrix, i: usize| (0..matrix.cols).map(|j| matrix[(i, j)]).collect();
    [row(&axis, 0), row(&axis, 1), row(&mean.rotation, 2)]
}

/// The displacement b of the bore's `bore_axis` along x and y and the rotation β of the rigid motion δ = b + β ẑ×x
/// that fits the nodes of the ring best, as rows over the `size` coordinates of the body; zeros without nodes.
///
/// Their plain mean is not b: nodes that stand unevenly around have their centroid off the axis, and it moves
/// when the ring turns.
fn rigid_fit(ring: &[&BodyNode], bore_axis: [f64; 2], size: usize) -> [Vec<f64>; 3] {
    if ring.is_empty() {
        return [0, 1, 2].map(|_| vec![0.0; size]);
    }
    let count = ring.len() as f64;
    let centre = [0, 1].map(|axis| ring.iter().map(|n| n.position[axis]).sum::<f64>() / count);
    let arm = |node: &BodyNode| [0, 1].map(|axis| node.position[axis] - centre[axis]);
    let square: f64 = ring.iter().map(|node| arm(node).iter().map(|x| x * x).sum::<f64>()).sum();
    // Nodes at one place do not turn.
    let turns = if square > 0.0 { 1.0 / square } else { 0.0 };
    let motion = |j: usize| {
        let mut mean = [0.0; 2];
        let mut turn = 0.0;
        for node in ring {
            let ([x, y], delta) = (arm(node), [node.shapes[(0, j)], node.shapes[(1, j)]]);
            mean[0] += delta[0] / count;
            mean[1] += delta[1] / count;
            turn += turns * (x * delta[1] - y * delta[0]);
        }
        let [x, y] = [0, 1].map(|axis| centre[axis] - bore_axis[axis]);
        [mean[0] + turn * y, mean[1] - turn * x, turn]
    };
    let motions: Vec<[f64; 3]> = (0..size).map(motion).collect();
    [0, 1, 2].map(|row| motions.iter().map(|motion| motion[row]).collect())
}

/// Displacement of the axis of a bore in its middle along x and y, as laws of rings see it, with what a turn makes of its offset:
/// rows over the coordinates of its body.
pub(crate) fn axis_motion(bearing: &Bearing, body: &Body) -> [Vec<f64>; 2] {
    let [mut x, mut y, turn] = match &bearing.sides.surface {
        Some(surface) => mean_on_faces(surface, body, bearing, surface.middle),
        None => {
            let middle = bearing.bore[1].iter().map(|&node| &body.nodes()[node]);
            rigid_fit(&middle.collect::<Vec<_>>(), bearing.sides.bore_axis, body.size())
        }
    };
    let [_, [along_x, along_y], _] = bearing.sides.offset;
    for ((x, y), turn) in x.iter_mut().zip(&mut y).zip(&turn) {
        *x -= along_y * turn;
        *y += along_x * turn;
    }
    [x, y]
}

/// Radius of the journal in a bore whose nodes stand at their mean distance from the axis, c further out;
/// `None` where the bore has no nodes.
pub(super) fn journal_radius(bearing: &Bearing, nodes: &[BodyNode]) -> Option<f64> {
    let surface = bearing.sides.surface.iter().flat_map(|own| own.points.iter().flatten());
    let on_faces: BTreeSet<usize> = surface.flatten().map(|&(node, _)| node).collect();
    let all = bearing.bore.iter().flatten().chain(&on_faces);
    let positions = all.map(|&node| nodes[node].position);
    let [left, below] = bearing.sides.bore_axis;
    let mean = mean_radius(positions.map(|[x, y, _]| [x - left, y - below]));
    (!mean.is_nan()).then_some(mean - bearing.clearance)
}

#[cfg(test)]
mod tests {
    use super::super::Sides;
    use super::*;
    use crate::centre_of_mass::CentreOfMass;
    use crate::measure::MeanMotion;
    use crate::support::Support;

    /// Nodes at `places` that move as one body by b_x, b_y and β, coordinates 0, 1 and 2, and turn about
    /// themselves with the third to no effect.
    fn rigid(places: &[[f64; 2]]) -> Vec<BodyNode> {
        let node = |&[x, y]: &[f64; 2]| {
            let data = vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, -y, x, 9.0];
            BodyNode { position: [x, y, 0.1], shapes: Matrix { rows: 3, cols: 3, data } }
        };
        places.iter().map(node).collect()
    }

    fn close(found: &[Vec<f64>; 3], exact: [[f64; 3]; 3]) {
        for (found, exact) in found.iter().flatten().zip(exact.iter().flatten()) {
            assert!((found - exact).abs() < 1e-14, "{found} for {exact}");
        }
    }

    #[test]
    fn a_ring_that_moves_as_one_body_moves_by_its_own_motion() {
        // Unevenly around, with a centroid off the axis along both directions.
        let nodes = rigid(&[[0.3, 0.1], [0.2, 0.25], [-0.1, 0.3], [0.28, -0.12]]);
        let ring: Vec<&BodyNode> = nodes.iter().collect();
        close(&rigid_fit(&ring, [0.0; 2], 3), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    }

    #[test]
    fn nodes_at_one_place_do_not_turn() {
        let nodes = rigid(&[[0.3, 0.1]; 2]);
        let ring: Vec<&BodyNode> = nodes.iter().collect();
        // What turns them moves them, and nothing else.
        close(&rigid_fit(&ring, [0.0; 2], 3), [[1.0, 0.0, -0.1], [0.0, 1.0, 0.3], [0.0; 3]]);
        close(&rigid_fit(&[], [0.0; 2], 3), [[0.0; 3]; 3]);
    }

    #[test]
    fn the_bore_stands_the_clearance_out_from_the_journal() {
        let nodes = rigid(&[[0.3, 0.4], [-0.4, 0.3], [0.0, -0.7], [0.0, 0.3]]);
        let bearing = Bearing {
            others: Vec::new(),
            name: String::new(),
            label: None,
            sides: Sides::default(),
            journal: [0; 3],
            bore: [vec![0], vec![1, 2], vec![3]],
            clearance: 0.1,
            journal_radius: None,
            stations: vec![0.5],
            angles: Vec::new(),
            law: 0,
        };
        let radius = journal_radius(&bearing, &nodes).expect("four nodes");
        assert!((radius - 0.4).abs() < 1e-15, "{radius}");
        assert!(journal_radius(&Bearing { bore: Default::default(), ..bearing }, &nodes).is_none());
    }

    /// A bore of faces that tilts: laws of rings see its axis where their planes stand.
    #[test]
    fn the_axis_of_faces_moves_by_their_tilt_at_every_station() {
        // By b_x, b_y at z = 0.2 m, tilts α and β, and a turn.
        let rows = |rows: [[f64; 5]; 3]| Matrix::from_fn(3, 5, |i, j| rows[i][j]);
        let mean = MeanMotion {
            centre: [0.0, 0.0, 0.2],
            displacement: rows([[1.0, 0.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0, 0.0], [0.0; 5]]),
            rotation: rows([
                [0.0, 0.0, 1.0, 0.0, 0.0],
                [0.0, 0.0, 0.0, 1.0, 0.0],
                [0.0, 0.0, 0.0, 0.0, 1.0],
            ]),
        };
        let support = Support {
            stiffness: vec![0.0; 5],
            damping: vec![0.0; 5],
            hertz: Vec::new(),
            coordinates: ["x", "y", "α", "β", "γ"].map(str::to_owned).to_vec(),
            nodes: Vec::new(),
            measures: vec![mean],
            sections: Vec::new(),
            centre_of_mass: CentreOfMass::none(5),
        };
        let body = Body::standing("block", support);
        let surface = BoreSurface {
            stations: vec![0.15, 0.28],
            middle: 0.23,
            points: vec![Vec::new(); 2],
            mean: 0,
            film: Vec::new(),
        };
        let bearing = Bearing {
            others: Vec::new(),
            name: String::new(),
            label: None,
            sides: Sides { bore_axis: [0.03, -0.01], surface: Some(surface), ..Sides::default() },
            journal: [0; 3],
            bore: Default::default(),
            clearance: 0.1,
            journal_radius: None,
            stations: vec![0.1, 0.9],
            angles: Vec::new(),
            law: 0,
        };
        let bore = Bore::new(&whirl_specs::CLEARANCES[0], (0, &bearing), &body, false);
        let bore = bore.unwrap_or_else(|errors| panic!("{errors:?}"));
        for (place, z) in [(0, -0.05), (1, 0.08)] {
            // u = b + ω × r with r = (0.03, -0.01, z): x: β z − γ y, y: γ x − α z.
            for (motion, exact) in [
                (BoreMotion::MeanX, [1.0, 0.0, 0.0, z, 0.01]),
                (BoreMotion::MeanY, [0.0, 1.0, -z, 0.0, 0.03]),
                (BoreMotion::MeanTurn, [0.0, 0.0, 0.0, 0.0, 1.0]),
            ] {
                let found = &bore.rows(place, motion)[0];
                for (found, exact) in found.iter().zip(exact) {
                    assert!((found - exact).abs() < 1e-15, "{motion:?}: {found} for {exact}");
                }
            }
        }
    }
}
