//! The largest stresses of a body over the frames of a cycle.

use serde::Serialize;
use whirl_solver::Error;
use whirl_solver::machine::{Field, Machine};
use whirl_solver::mesh::Mesh;
use whirl_solver::stress::von_mises;
use whirl_text::rounded;

use super::frames::Frame;
use super::motion::motion;
use super::vtu::{Array, Values};

/// The largest stress of every node by von Mises, and when it was.
pub(super) struct Envelope {
    /// Pa.
    sizes: Vec<f64>,
    /// s.
    times: Vec<f64>,
}

/// Where and when the stress of a body is largest by von Mises.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct LargestStress {
    /// MPa.
    #[serde(rename = "von_mises_MPa")]
    pub(crate) size: f64,
    /// Label of the node in its file.
    pub(crate) node: u64,
    /// Where that is in the mesh, mm.
    #[serde(rename = "position_mm")]
    pub(crate) position: [f64; 3],
    /// s.
    #[serde(rename = "time_s")]
    pub(crate) time: f64,
}

impl LargestStress {
    /// For people.
    pub(crate) fn words(&self) -> String {
        let [x, y, z] = self.position.map(|x| rounded(x, 3));
        let (size, time) = (rounded(self.size, 3), rounded(1e3 * self.time, 4));
        format!("{size} MPa (von Mises) at node {} ({x}, {y}, {z} mm), at {time} ms", self.node)
    }
}

impl Envelope {
    /// Over the frames of the last cycle; over all, if none is of it.
    ///
    /// # Errors
    /// A mesh without stresses.
    pub(super) fn new(
        mesh: &Mesh,
        machine: &Machine,
        field: &Field,
        frames: &[Frame],
    ) -> Result<Self, Error> {
        let nodes = mesh.nodes().len();
        let mut envelope = Envelope { sizes: vec![0.0; nodes], times: vec![0.0; nodes] };
        let cycle = frames.iter().any(|frame| frame.of_cycle);
        for frame in frames.iter().filter(|frame| frame.of_cycle || !cycle) {
            let stresses = motion(machine, field, frame).in_body(mesh)?;
            for (node, stress) in stresses.iter().enumerate() {
                let size = von_mises(stress);
                if size > envelope.sizes[node] {
                    (envelope.sizes[node], envelope.times[node]) = (size, frame.time);
                }
            }
        }
        Ok(envelope)
    }

    /// The largest of all; none of a body without stress.
    pub(super) fn largest(&self, mesh: &Mesh) -> Option<LargestStress> {
        let nodes = 0..self.sizes.len();
        // Of equal ones the first.
        let node = nodes.rev().max_by(|a, b| self.sizes[*a].total_cmp(&self.sizes[*b]))?;
        (self.sizes[node] > 0.0).then(|| LargestStress {
            size: rounded(1e-6 * self.sizes[node], 6),
            node: mesh.labels()[node],
            // To a nanometre.
            position: mesh.nodes()[node].map(|x| (1e9 * x).round() / 1e6 + 0.0),
            time: self.times[node],
        })
    }

    /// At the nodes as the mesh has them, beside the axis of the body (m).
    pub(super) fn arrays(&self, mesh: &Mesh, axis: [f64; 2]) -> Vec<Array> {
        let points = mesh.nodes().iter().map(|[x, y, z]| [x + axis[0], y + axis[1], *z]);
        vec![
            Array::points(points.collect()),
            Array { name: "von_mises_Pa", values: Values::Scalars(self.sizes.clone()) },
            Array { name: "time_s", values: Values::Scalars(self.times.clone()) },
        ]
    }
}
