//! The nodes of a journal and of a bore, as their sets give them.

use whirl_codegen::diagnostic::Located;
use whirl_solver::bearing::spline_passes;
use whirl_solver::mesh::Mesh;
use whirl_solver::mesh::measure::{Circle, mean_radius, rim, section_radius};

use super::place::{nodes_of, single};

/// Planes that belong together are apart by at most this part of the bearing's length: the arm of each ring
/// about the middle, half the length, is then right to a tenth.
pub(super) const PLANES: f64 = 0.05;

/// Nodes of a journal.
pub(super) struct Journal<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) sets: &'a [Located],
    pub(super) at: [[f64; 3]; 3],
}

impl<'a> Journal<'a> {
    pub(super) fn find(mesh: &'a Mesh, sets: &'a [Located]) -> Option<Self> {
        let [left, middle, right] = sets else { return None };
        let at = |set| Some(mesh.nodes()[single(mesh, set)?]);
        Some(Journal { mesh, sets, at: [at(left)?, at(middle)?, at(right)?] })
    }

    /// Three sets of nodes, each at their mean; none of one node each, or of one set alone.
    pub(super) fn means(mesh: &'a Mesh, sets: &'a [Located]) -> Option<Self> {
        let [left, middle, right] = sets else { return None };
        if same(mesh, sets) || sets.iter().all(|set| single(mesh, set).is_some()) {
            return None;
        }
        let at = |set| {
            let nodes = nodes_of(mesh, set)?;
            let mean = |axis: usize| {
                nodes.iter().map(|&node| mesh.nodes()[node][axis]).sum::<f64>() / nodes.len() as f64
            };
            Some([0, 1, 2].map(mean))
        };
        Some(Journal { mesh, sets, at: [at(left)?, at(middle)?, at(right)?] })
    }

    pub(super) fn planes(&self) -> [f64; 3] {
        self.at.map(|position| position[2])
    }

    /// Radius of the shaft between the ends: not at them, where a shoulder may stand. None for a journal in one
    /// plane.
    pub(super) fn radius(&self) -> Option<f64> {
        let [left, _, right] = self.planes();
        let (left, right) = (left.min(right), left.max(right));
        let margin = PLANES * (right - left);
        let within = |z: f64| left + margin < z && z < right - margin;
        let nodes = self.mesh.nodes().iter().filter(|position| within(position[2]));
        let points: Vec<[f64; 2]> = nodes.map(|[x, y, _]| [*x, *y]).collect();
        section_radius(&points)
    }
}

/// Nodes of a bore.
pub(super) struct Bore<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) sets: &'a [Located],
    pub(super) rings: [Vec<[f64; 3]>; 3],
}

impl<'a> Bore<'a> {
    pub(super) fn find(mesh: &'a Mesh, sets: &'a [Located]) -> Option<Self> {
        let [left, middle, right] = sets else { return None };
        let ring = |set| {
            let nodes = nodes_of(mesh, set)?.iter();
            Some(nodes.map(|&node| mesh.nodes()[node]).collect::<Vec<_>>())
        };
        Some(Bore { mesh, sets, rings: [ring(left)?, ring(middle)?, ring(right)?] })
    }

    /// Mean z of each ring.
    pub(super) fn planes(&self) -> [f64; 3] {
        self.rings
            .each_ref()
            .map(|ring| ring.iter().map(|position| position[2]).sum::<f64>() / ring.len() as f64)
    }

    /// Mean and largest distance of the nodes from the axis.
    pub(super) fn radii(&self) -> [f64; 2] {
        let points = || self.rings.iter().flatten().map(|&[x, y, _]| [x, y]);
        let largest = points().map(|[x, y]| x.hypot(y)).fold(0.0, f64::max);
        [mean_radius(points()), largest]
    }
}

/// The circle on which the outermost nodes of a set stand, if they go all around.
pub(in crate::machine) fn rim_of(mesh: &Mesh, set: &Located) -> Option<Circle> {
    let nodes = nodes_of(mesh, set)?;
    let across = |&node: &usize| [mesh.nodes()[node][0], mesh.nodes()[node][1]];
    rim(&nodes.iter().map(across).collect::<Vec<[f64; 2]>>())
}

/// Whether three sets have the same nodes.
pub(super) fn same(mesh: &Mesh, sets: &[Located]) -> bool {
    let nodes = |set: &Located| {
        let mut nodes = nodes_of(mesh, set).unwrap_or_default().to_vec();
        nodes.sort_unstable();
        nodes
    };
    let first = nodes(&sets[0]);
    sets[1..].iter().all(|set| nodes(set) == first)
}

/// Least and largest z.
pub(super) fn spread(positions: &[[f64; 3]]) -> (f64, f64) {
    let z = || positions.iter().map(|position| position[2]);
    (z().fold(f64::INFINITY, f64::min), z().fold(f64::NEG_INFINITY, f64::max))
}

/// A set of nodes that all stand around the axis at `z`.
pub(super) fn ring_at(mesh: &Mesh, z: f64, allowed: f64) -> Option<&str> {
    let found = mesh.node_sets().iter().find(|(_, nodes)| {
        let positions: Vec<[f64; 3]> = nodes.iter().map(|&node| mesh.nodes()[node]).collect();
        let (low, high) = spread(&positions);
        z - low <= allowed && high - z <= allowed && goes_around(&positions)
    });
    found.map(|(name, _)| name.as_str())
}

/// Whether nodes stand at different angles about the axis, three at least, so that a spline goes through them.
pub(super) fn goes_around(positions: &[[f64; 3]]) -> bool {
    let knots: Vec<f64> = positions.iter().map(|[x, y, _]| y.atan2(*x)).collect();
    spline_passes(&knots)
}
