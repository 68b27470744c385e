//! Springs between journals and bores: where they stand, how far the film is open there, what they push.

pub mod law;
mod spline;
pub(crate) mod state;

use std::ops::Range;

use whirl_specs::Clearance;

pub use law::SpringLaw;
pub(crate) use law::{BoundLaw, Input};
pub use spline::periodic_spline;
pub use state::SpringState;

use crate::body::BodyNode;
use crate::error::Error;
use crate::linalg::Matrix;
use crate::shaft::Shaft;
use crate::support::Support;

/// A journal in its bore, as a case describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Bearing {
    /// Name in messages, such as `bearing 2`.
    pub name: String,
    /// Centre-line nodes at the left end, the middle and the right end, as places in `Shaft::nodes`.
    pub journal: [usize; 3],
    /// Bore nodes in the planes of the same three, as places in `Support::nodes`; all empty where the
    /// support is rigid.
    pub bore: [Vec<usize>; 3],
    /// Radial clearance c (m).
    pub clearance: f64,
    /// Planes of springs by their distance from the left end over the length L_b; 0, ½ and 1 are the three.
    pub stations: Vec<f64>,
    /// Fixed angles ψ_j of the springs of each plane (rad).
    pub angles: Vec<f64>,
    /// Which of the laws given to [`Springs::new`].
    pub law: usize,
}

/// One plane of springs.
pub(crate) struct Plane {
    /// Which bearing, counted from 0.
    pub(crate) bearing: usize,
    /// Its springs among all.
    pub(crate) springs: Range<usize>,
    /// ε_x and ε_y as Σ coefficient · η.
    pub(crate) eccentricity: [Vec<(usize, f64)>; 2],
    /// Radial clearance c (m).
    pub(crate) clearance: f64,
    /// What the clearance kernels keep a spring.
    pub(crate) table: Vec<f64>,
}

/// All springs of a machine, law after law.
pub struct Springs {
    pub(crate) kernels: &'static Clearance,
    pub(crate) laws: Vec<(BoundLaw, Range<usize>)>,
    pub(crate) planes: Vec<Plane>,
    /// T_b: radial displacement of the bore at every spring from the support's coordinates
    /// (springs × coordinates), eq. (22).
    pub(crate) bore: Matrix,
    /// T_bᵀ: one column a spring.
    pub(crate) bore_transposed: Matrix,
}

impl Springs {
    /// Places the springs of all bearings.
    ///
    /// # Errors
    /// A law whose inputs no spring has; bore nodes through which no spline passes.
    pub fn new(
        kernels: &'static Clearance,
        laws: Vec<Box<dyn SpringLaw>>,
        bearings: &[Bearing],
        shaft: &Shaft,
        support: &Support,
    ) -> Result<Self, Error> {
        let mut planes = Vec::new();
        let mut bound = Vec::new();
        let mut rows: Vec<Vec<f64>> = Vec::new();
        for (place, law) in laws.into_iter().enumerate() {
            let first = rows.len();
            for (number, bearing) in bearings.iter().enumerate().filter(|(_, b)| b.law == place) {
                for &station in &bearing.stations {
                    let start = rows.len();
                    rows.extend(bore_rows(kernels, bearing, station, support)?);
                    let mut table = vec![0.0; kernels.table * bearing.angles.len()];
                    (kernels.prepare)(&bearing.angles, &mut table);
                    planes.push(Plane {
                        bearing: number,
                        springs: start..rows.len(),
                        eccentricity: eccentricity(kernels, bearing, station, shaft),
                        clearance: bearing.clearance,
                        table,
                    });
                }
            }
            bound.push((BoundLaw::new(law)?, first..rows.len()));
        }
        let bore = Matrix::from_fn(rows.len(), support.size(), |i, j| rows[i][j]);
        let bore_transposed = bore.transpose();
        Ok(Springs { kernels, laws: bound, planes, bore, bore_transposed })
    }

    /// Number of springs.
    pub fn len(&self) -> usize {
        self.bore.rows
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether any law depends on the rate of the clearance.
    pub(crate) fn needs_rates(&self) -> bool {
        self.laws.iter().any(|(law, _)| law.uses(Input::ClearanceRate))
    }
}

/// ε(z) = Σ A_i(z) ε_i, eqs. (11) to (13), as rows over η.
fn eccentricity(
    kernels: &Clearance,
    bearing: &Bearing,
    station: f64,
    shaft: &Shaft,
) -> [Vec<(usize, f64)>; 2] {
    let weights = (kernels.axial)(station);
    [0, 1].map(|direction| {
        (0..shaft.size())
            .map(|j| {
                let parts = bearing.journal.iter().zip(weights);
                let shape = |node: &usize| shaft.nodes[*node].shapes[(direction, j)];
                (j, parts.map(|(node, weight)| weight * shape(node)).sum())
            })
            .filter(|&(_, value): &(usize, f64)| value != 0.0)
            .collect()
    })
}

/// Rows of T_b of one plane, eqs. (20) to (23): splines of δ_x and δ_y along each of the three bore rings,
/// then A_i(z) between them, then n_j·δ.
fn bore_rows(
    kernels: &Clearance,
    bearing: &Bearing,
    station: f64,
    support: &Support,
) -> Result<Vec<Vec<f64>>, Error> {
    let mut rows = vec![vec![0.0; support.size()]; bearing.angles.len()];
    for (ring, weight) in bearing.bore.iter().zip((kernels.axial)(station)) {
        if ring.is_empty() || weight == 0.0 {
            continue;
        }
        let ring: Vec<&BodyNode> = ring.iter().map(|&node| &support.nodes[node]).collect();
        let knots: Vec<f64> =
            ring.iter().map(|node| node.position[1].atan2(node.position[0])).collect();
        let spline = periodic_spline(&knots, &bearing.angles).ok_or_else(|| Error::Bore {
            bearing: bearing.name.clone(),
            what: format!(
                "{} nodes of its bore give no spline: at least three at different angles are needed",
                ring.len()
            ),
        })?;
        for (place, (row, angle)) in rows.iter_mut().zip(&bearing.angles).enumerate() {
            let (sin, cos) = angle.sin_cos();
            for (knot, node) in ring.iter().enumerate() {
                let share = weight * spline[(place, knot)];
                for (j, value) in row.iter_mut().enumerate() {
                    *value += share * (cos * node.shapes[(0, j)] + sin * node.shapes[(1, j)]);
                }
            }
        }
    }
    Ok(rows)
}

/// Mean displacement of a ring of nodes along x and y, as rows over the support's coordinates.
pub(crate) fn mean_motion(ring: &[usize], support: &Support) -> [Vec<f64>; 2] {
    [0, 1].map(|direction| {
        let shape = |node: &usize, j| support.nodes[*node].shapes[(direction, j)];
        let mean = |j| ring.iter().map(|node| shape(node, j)).sum::<f64>();
        (0..support.size()).map(|j| mean(j) / ring.len().max(1) as f64).collect()
    })
}
