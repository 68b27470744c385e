//! Where cells touch without sharing nodes, so that they come apart: nodes at one place, nodes on faces of cells that do
//! not have them, and faces of quadratic cells on those of linear ones.
//!
//! All of these lie on faces that only one cell has, of which a mesh has few.

use whirl_specs::{Element, Face};
use whirl_text::rounded;

use super::super::Tie;
use super::super::regions::connected;
use super::super::surface_face::beyond;
use super::RawMesh;
use super::grid::{PointGrid, distance, extent, spacing};
use super::onto::nearest;
use super::report::{MeshReport, list};

/// Nodes are at one place where they are apart by less than this part of the shortest edge of a face beside them…
const SAME: f64 = 1e-4;
/// … or by the digits of a file, as a part of the mesh's extent,
const DIGITS: f64 = 1e-6;
/// but never by more than this part of that edge.
const MOST: f64 = 1e-2;
/// Coordinates beyond this (m) are an error of their own.
const FARTHEST: f64 = 1e6;

/// A face of a cell by their places; the corners are sorted, and the last one of a triangle is none.
#[derive(Debug, Clone, Copy)]
struct CellFace {
    corners: [usize; 4],
    cell: usize,
    face: usize,
}

/// A face that only one cell has, with its size.
struct OuterFace {
    own: CellFace,
    /// Corners of the box around its nodes (m).
    bounds: [[f64; 3]; 2],
    /// Longest side of the box (m).
    size: f64,
    /// How far a node on it may be from it (m).
    reach: f64,
}

impl RawMesh {
    /// Warns of cells that touch and do not share nodes.
    pub(super) fn seams(&self, report: &mut MeshReport) {
        let positions = &self.nodes.positions;
        if !positions.iter().flatten().all(|x| x.abs() < FARTHEST) {
            return;
        }
        let (outer, mixed) = self.outer_faces();
        let digits = DIGITS * extent(positions);
        let outer: Vec<OuterFace> = outer.into_iter().map(|own| self.sized(own, digits)).collect();
        // How far from each node another one is at its place; infinite of nodes within.
        let mut reach = vec![f64::INFINITY; positions.len()];
        for face in &outer {
            self.nodes_of(face.own).for_each(|node| reach[node] = reach[node].min(face.reach));
        }
        let pairs = self.ties.iter().flat_map(Tie::pairs);
        let tied = connected(positions.len(), pairs);
        let nodes: Vec<usize> = (0..reach.len()).filter(|&node| reach[node].is_finite()).collect();
        self.warn_of_mixed(&mixed, report);
        self.warn_of_pairs(&nodes, (&reach, &tied), report);
        let mut explained = vec![false; positions.len()];
        for face in mixed.iter().flatten() {
            self.nodes_of(*face).for_each(|node| explained[node] = true);
        }
        self.warn_of_hanging(&outer, &nodes, (&explained, &tied), report);
    }

    fn face(&self, own: CellFace) -> Option<(&'static Element, &'static Face)> {
        let element = self.cells.list[own.cell].element?;
        Some((element, &element.faces[own.face]))
    }

    fn nodes_of(&self, own: CellFace) -> impl Iterator<Item = usize> {
        let nodes = self.face(own).map_or(&[][..], |(_, face)| face.nodes);
        nodes.iter().map(move |&place| self.cells.list[own.cell].nodes[place])
    }

    /// The faces that only one cell has, and pairs of faces with the same corners and other nodes between them.
    fn outer_faces(&self) -> (Vec<CellFace>, Vec<[CellFace; 2]>) {
        let mut all = Vec::new();
        for (cell, own) in self.cells.list.iter().enumerate() {
            let Some(element) = own.element.filter(|_| !own.nodes.is_empty()) else { continue };
            for (place, face) in element.faces.iter().enumerate() {
                let mut corners = [usize::MAX; 4];
                // Elements list their corners first.
                for (corner, &node) in corners.iter_mut().zip(&face.nodes[..face.corners]) {
                    *corner = own.nodes[node];
                }
                corners.sort_unstable();
                all.push(CellFace { corners, cell, face: place });
            }
        }
        // By their first corner, so that few are left to be compared.
        let mut starts = vec![0; self.nodes.positions.len() + 1];
        all.iter().for_each(|face| starts[face.corners[0] + 1] += 1);
        (1..starts.len()).for_each(|node| starts[node] += starts[node - 1]);
        let mut order = vec![0; all.len()];
        let mut next = starts.clone();
        for (place, face) in all.iter().enumerate() {
            order[next[face.corners[0]]] = place;
            next[face.corners[0]] += 1;
        }
        let (mut outer, mut mixed) = (Vec::new(), Vec::new());
        for ends in starts.windows(2) {
            let at_node = &mut order[ends[0]..ends[1]];
            at_node.sort_unstable_by_key(|&place| (all[place].corners, place));
            for alike in at_node.chunk_by(|&a, &b| all[a].corners == all[b].corners) {
                match *alike {
                    [one] => outer.push(all[one]),
                    [one, other] if self.differ(all[one], all[other]) => {
                        outer.extend([all[one], all[other]]);
                        mixed.push([all[one], all[other]]);
                    }
                    _ => {}
                }
            }
        }
        (outer, mixed)
    }

    /// Whether faces with the same corners have other nodes between them.
    fn differ(&self, one: CellFace, other: CellFace) -> bool {
        let sorted = |face| {
            let mut nodes: Vec<usize> = self.nodes_of(face).collect();
            nodes.sort_unstable();
            nodes
        };
        sorted(one) != sorted(other)
    }

    fn sized(&self, own: CellFace, digits: f64) -> OuterFace {
        let positions = &self.nodes.positions;
        let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
        for node in self.nodes_of(own) {
            for (k, &x) in positions[node].iter().enumerate() {
                bounds[0][k] = bounds[0][k].min(x);
                bounds[1][k] = bounds[1][k].max(x);
            }
        }
        let corners: Vec<usize> =
            own.corners.into_iter().filter(|&node| node != usize::MAX).collect();
        let pairs =
            corners.iter().enumerate().flat_map(|(k, a)| corners[..k].iter().map(move |b| (a, b)));
        let shortest = pairs
            .map(|(&a, &b)| distance(positions[a], positions[b]))
            .fold(f64::INFINITY, f64::min);
        let reach = (SAME * shortest).max(digits).min(MOST * shortest);
        let size = (0..3).map(|k| bounds[1][k] - bounds[0][k]).fold(0.0, f64::max);
        OuterFace { own, bounds, size, reach }
    }

    /// Warns of quadratic faces on linear ones.
    fn warn_of_mixed(&self, mixed: &[[CellFace; 2]], report: &mut MeshReport) {
        let Some([first, _]) = mixed.first() else { return };
        let label = |face: &CellFace| self.cells.named.labels[face.cell];
        let what = format!(
            "{} joined by their corners only, as one side has nodes in the middle of its edges which the other has not: \
                 those of cells {}; the cells come apart between the corners",
            match mixed.len() {
                1 => "1 pair of faces is".to_owned(),
                many => format!("{many} pairs of faces are"),
            },
            list(mixed.iter().map(|[a, b]| format!("{} and {}", label(a), label(b))))
        );
        let help =
            "mesh both sides with elements of one order, or put a layer between them that has both";
        report.warn(self.cells.named.places[first.cell], what, help);
    }

    /// Warns of nodes at one place, but for those that ties join.
    fn warn_of_pairs(
        &self,
        nodes: &[usize],
        (reach, tied): (&[f64], &[usize]),
        report: &mut MeshReport,
    ) {
        let positions = &self.nodes.positions;
        let largest = nodes.iter().map(|&node| reach[node]).fold(0.0, f64::max);
        let grid =
            PointGrid::new(positions, nodes, spacing(positions, nodes.len()).max(4.0 * largest));
        let (mut pairs, mut farthest) = (Vec::new(), 0.0_f64);
        for &node in nodes {
            let mut first: Option<(usize, f64)> = None;
            grid.each_near(positions, (positions[node], reach[node]), |other, away| {
                if other < node
                    && tied[other] != tied[node]
                    && away <= reach[other]
                    && first.is_none_or(|(known, _)| other < known)
                {
                    first = Some((other, away));
                }
            });
            if let Some((other, away)) = first {
                pairs.push((other, node));
                farthest = farthest.max(away);
            }
        }
        let Some(&(_, node)) = pairs.first() else { return };
        let label = |node: usize| self.nodes.named.labels[node];
        let listed = list(
            pairs
                .iter()
                .map(|&(a, b)| format!("{} and {} at {}", label(a), label(b), self.place(b))),
        );
        let what = match pairs.len() {
            1 => format!("1 pair of nodes is at one place: {listed}"),
            many => format!("{many} pairs of nodes are at one place: {listed}"),
        };
        // A power of ten that is at least twice as much.
        let enough =
            10_f64.powf((2.0 * farthest).log10().ceil()).max(DIGITS * extent(positions) / 10.0);
        let enough = 10_f64.powf(enough.log10().ceil());
        let help = format!(
            "the cells do not hold together there: `merge = \"{enough:e} m\"` beside `mesh` in the case makes each pair one \
             node; if a gap is meant, leave it"
        );
        report.warn(self.nodes.named.places[node], format!("{what}; they are not joined"), help);
    }

    /// Warns of nodes that stand on faces of cells without being nodes of them, or tied to such.
    fn warn_of_hanging(
        &self,
        outer: &[OuterFace],
        nodes: &[usize],
        (explained, tied): (&[bool], &[usize]),
        report: &mut MeshReport,
    ) {
        let positions = &self.nodes.positions;
        let smallest = outer.iter().map(|face| face.size).filter(|&size| size > 0.0);
        let smallest = smallest.fold(f64::INFINITY, f64::min);
        let level = |face: &OuterFace| (face.size / smallest).log2().floor() as i32;
        // Faces of one size at a time, in a grid of that size: a large one is compared with what is near it only.
        let mut order: Vec<&OuterFace> = outer.iter().filter(|face| face.size > 0.0).collect();
        order.sort_by_key(|face| level(face));
        let mut on: Vec<Option<usize>> = vec![None; positions.len()];
        for alike in order.chunk_by(|a, b| level(a) == level(b)) {
            let size = smallest * 2_f64.powi(level(alike[0]) + 1);
            let grid = PointGrid::new(positions, nodes, size);
            for face in alike {
                let own: Vec<usize> = self.nodes_of(face.own).collect();
                let ends = [
                    face.bounds[0].map(|x| x - face.reach),
                    face.bounds[1].map(|x| x + face.reach),
                ];
                grid.each_in(ends, |node| {
                    let at = positions[node];
                    let inside = (0..3).all(|k| ends[0][k] <= at[k] && at[k] <= ends[1][k]);
                    if inside
                        && on[node].is_none()
                        && !explained[node]
                        && own.iter().all(|&other| {
                            tied[other] != tied[node] && distance(positions[other], at) > face.reach
                        })
                        && self.stands_on(face, &own, at)
                    {
                        on[node] = Some(face.own.cell);
                    }
                });
            }
        }
        let hanging: Vec<(usize, usize)> =
            on.iter().enumerate().filter_map(|(node, cell)| Some((node, (*cell)?))).collect();
        let Some(&(first, _)) = hanging.first() else { return };
        let label = |node: usize| self.nodes.named.labels[node];
        let listed = list(hanging.iter().map(|&(node, cell)| {
            let cell = self.cells.named.labels[cell];
            format!("{} on cell {cell} at {}", label(node), self.place(node))
        }));
        let what = match hanging.len() {
            1 => format!("1 node hangs on a face of a cell that does not have it: {listed}"),
            many => format!("{many} nodes hang on faces of cells that do not have them: {listed}"),
        };
        let help = "the cells come apart there: mesh both sides alike, so that they share their nodes; if a gap is meant, leave \
                    it";
        report.warn(self.nodes.named.places[first], what, help);
    }

    /// Whether a point is on a face, by the face's own shape functions.
    fn stands_on(&self, outer: &OuterFace, nodes: &[usize], point: [f64; 3]) -> bool {
        let Some((element, face)) = self.face(outer.own) else { return false };
        let places: Vec<[f64; 3]> = nodes.iter().map(|&node| self.nodes.positions[node]).collect();
        let within = |at: [f64; 2]| beyond(face, at) <= outer.reach / outer.size;
        nearest((element, face), &places, point, |at| at)
            .is_some_and(|own| own.away <= outer.reach && within(own.at))
    }

    /// Where a node is, for people.
    fn place(&self, node: usize) -> String {
        // Adding zero takes the sign off what rounds to it.
        let [x, y, z] =
            self.nodes.positions[node].map(|x| rounded((1e9 * x).round() / 1e6, 9) + 0.0);
        format!("({x}, {y}, {z} mm)")
    }
}
