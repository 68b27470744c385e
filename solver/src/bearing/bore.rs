//! How a bore moves at its springs and as a whole, as rows over the support's coordinates.

use whirl_specs::{BoreMotion, Clearance};

use super::{Bearing, periodic_spline};
use crate::body::BodyNode;
use crate::error::Error;
use crate::support::Support;

/// Rows of one plane, one a spring or one a ring: the motion of each of the three bore rings, eqs. (20) to
/// (23), with A_i(z) between them.
///
/// # Errors
/// Nodes through which no spline passes.
pub(super) fn bore_rows(
    kernels: &Clearance,
    (place, bearing): (usize, &Bearing),
    station: f64,
    support: &Support,
    motion: BoreMotion,
) -> Result<Vec<Vec<f64>>, Error> {
    let at_springs = matches!(motion, BoreMotion::Radial | BoreMotion::Tangential);
    let count = if at_springs { bearing.angles.len() } else { 1 };
    let mut rows = vec![vec![0.0; support.size()]; count];
    for (ring, weight) in bearing.bore.iter().zip((kernels.axial)(station)) {
        if ring.is_empty() || weight == 0.0 {
            continue;
        }
        let ring: Vec<&BodyNode> = ring.iter().map(|&node| &support.nodes[node]).collect();
        if !at_springs {
            add_mean(&ring, weight, motion, &mut rows[0]);
        } else if !add_spline(&ring, weight, motion, &bearing.angles, &mut rows) {
            return Err(Error::Bore {
                bearing: bearing.name.clone(),
                place,
                what: format!(
                    "{} nodes of its bore give no spline: at least three at different angles are needed",
                    ring.len()
                ),
            });
        }
    }
    Ok(rows)
}

/// Adds splines of δ_x and δ_y along the ring, along the normal or the tangent of every spring; false where
/// there is no spline.
fn add_spline(
    ring: &[&BodyNode],
    weight: f64,
    motion: BoreMotion,
    angles: &[f64],
    rows: &mut [Vec<f64>],
) -> bool {
    let knots: Vec<f64> =
        ring.iter().map(|node| node.position[1].atan2(node.position[0])).collect();
    let Some(spline) = periodic_spline(&knots, angles) else { return false };
    for (place, (row, angle)) in rows.iter_mut().zip(angles).enumerate() {
        let (sin, cos) = angle.sin_cos();
        let [along_x, along_y] =
            if motion == BoreMotion::Radial { [cos, sin] } else { [-sin, cos] };
        for (knot, node) in ring.iter().enumerate() {
            let share = weight * spline[(place, knot)];
            for (j, value) in row.iter_mut().enumerate() {
                *value += share * (along_x * node.shapes[(0, j)] + along_y * node.shapes[(1, j)]);
            }
        }
    }
    true
}

/// Adds the displacement b of the axis or the rotation β of the rigid motion δ = b + β ẑ×x that fits the
/// nodes of the ring best.
fn add_mean(ring: &[&BodyNode], weight: f64, motion: BoreMotion, row: &mut [f64]) {
    let count = ring.len() as f64;
    let centre = [0, 1].map(|axis| ring.iter().map(|n| n.position[axis]).sum::<f64>() / count);
    let arm = |node: &BodyNode| [0, 1].map(|axis| node.position[axis] - centre[axis]);
    let square: f64 = ring.iter().map(|node| arm(node).iter().map(|x| x * x).sum::<f64>()).sum();
    // Nodes at one place do not turn.
    let turns = if square > 0.0 { 1.0 / square } else { 0.0 };
    for (j, value) in row.iter_mut().enumerate() {
        let mut mean = [0.0; 2];
        let mut turn = 0.0;
        for node in ring {
            let ([x, y], delta) = (arm(node), [node.shapes[(0, j)], node.shapes[(1, j)]]);
            mean[0] += delta[0] / count;
            mean[1] += delta[1] / count;
            turn += turns * (x * delta[1] - y * delta[0]);
        }
        *value += weight
            * match motion {
                BoreMotion::MeanX => mean[0] + turn * centre[1],
                BoreMotion::MeanY => mean[1] - turn * centre[0],
                _ => turn,
            };
    }
}

/// Radius of the journal in a bore whose nodes stand at their mean distance from the axis, c further out;
/// `None` where the bore has no nodes.
pub(super) fn journal_radius(bearing: &Bearing, support: &Support) -> Option<f64> {
    let nodes: Vec<usize> = bearing.bore.iter().flatten().copied().collect();
    let distance = |&node: &usize| {
        let [x, y, _] = support.nodes[node].position;
        x.hypot(y)
    };
    let mean = nodes.iter().map(distance).sum::<f64>() / nodes.len() as f64;
    (!nodes.is_empty()).then_some(mean - bearing.clearance)
}
