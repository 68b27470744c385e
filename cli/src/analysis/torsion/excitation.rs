//! What excites torsion: orders of the shafts of a train, and teeth.

use whirl_solver::linear::LinearMachine;

use crate::case::{Analysis, Case};

/// Speeds are alike to this share.
const ALIKE: f64 = 1e-9;

/// What excites a train.
pub(super) struct Excitation {
    /// Such as `2 × motor`.
    pub(super) name: String,
    /// What its line in the diagram is called.
    pub(super) kind: String,
    /// Of the speed over which the diagram is.
    pub(super) order: f64,
}

/// Orders of all bodies of the train that turn at speeds of their own, and of the teeth.
pub(super) fn excitations(
    case: &Case,
    linear: &LinearMachine,
    (analysis, of): (&Analysis, usize),
    speeds: &[f64],
) -> Vec<Excitation> {
    let mut tied = linear.machine().tied_bodies();
    tied.extend(Some(of).filter(|of| !tied.contains(of)));
    // That of the diagram first.
    tied.sort_by_key(|body| (*body != of, *body));
    let first = speeds[of];
    let mut shafts: Vec<(usize, f64)> = Vec::new();
    for body in tied {
        let ratio = if first == 0.0 { 1.0 } else { (speeds[body] / first).abs() };
        let alike = |own: &(usize, f64)| (own.1 - ratio).abs() <= ALIKE * ratio;
        if ratio > 0.0 && !shafts.iter().any(alike) {
            shafts.push((body, ratio));
        }
    }
    let name = |body: usize| linear.machine().bodies[body].name();
    let mut all = Vec::new();
    for &(body, ratio) in &shafts {
        all.extend(analysis.orders.iter().map(|order| Excitation {
            name: format!("{order} × {}", name(body)),
            kind: format!("orders of {}", name(body)),
            order: order * ratio,
        }));
    }
    for joint in &case.machine.joints {
        let (Some(gears), Some(body)) = (&joint.gears, joint.sides[0].body) else { continue };
        let Some([teeth, _]) = gears.teeth else { continue };
        let ratio = if first == 0.0 { 1.0 } else { (speeds[body] / first).abs() };
        all.extend(analysis.mesh_orders.iter().map(|order| Excitation {
            name: format!("{order} × teeth of {}", joint.name.text()),
            kind: format!("teeth of {}", joint.name.text()),
            order: order * teeth * ratio,
        }));
    }
    all
}
