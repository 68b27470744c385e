//! Where bodies stand along the axis of which the case does not say it: what does not tilt is alike anywhere. They are drawn where their
//! joints have them, or behind what they are coupled to.

use super::marks::has_place;
use crate::case::{Case, Joint, JointKind};
use crate::machine::JoinedPlan;

/// Free length behind a body that is coupled to another one, as a part of its own.
const GAP: f64 = 0.3;

/// Centres along z (m), where `spans` has the ends of those bodies that have a place, and `lengths` of those that have none.
pub(super) fn placed(
    case: &Case,
    plan: &JoinedPlan,
    mut spans: Vec<Option<[f64; 2]>>,
    lengths: &[f64],
) -> Vec<f64> {
    let about = |z: f64, length: f64| [z - 0.5 * length, z + 0.5 * length];
    let joints: Vec<(usize, &Joint)> = case.machine.joints.iter().enumerate().collect();
    let bodies = |joint: &Joint| joint.sides.each_ref().map(|side| side.body);
    // By joints in their plane that have a place themselves.
    for body in 0..spans.len() {
        if spans[body].is_some() {
            continue;
        }
        let own = joints.iter().filter(|(_, joint)| {
            let plane = !matches!(joint.kind, JointKind::Coupling);
            plane && has_place(joint) && bodies(joint).contains(&Some(body))
        });
        let z: Vec<f64> = own.flat_map(|(place, _)| plan.stations(*place)).collect();
        if !z.is_empty() {
            let mean = z.iter().sum::<f64>() / z.len() as f64;
            spans[body] = Some(about(mean, lengths[body]));
        }
    }
    // By what they are coupled to or mesh with, one after another.
    let mut taken: Vec<[bool; 2]> = vec![[false; 2]; spans.len()];
    while let Some(first) = spans.iter().position(Option::is_none) {
        let next = joints.iter().find_map(|(place, joint)| {
            let [Some(a), Some(b)] = bodies(joint) else { return None };
            let (from, to) = match (spans[a], spans[b]) {
                (Some(from), None) => ((a, from), b),
                (None, Some(from)) => ((b, from), a),
                _ => return None,
            };
            Some((plan.stations(*place)[0], joint.kind, from, to))
        });
        let Some((z, kind, (from, [low, high]), to)) = next else {
            spans[first] = Some(about(0.0, lengths[first]));
            continue;
        };
        if kind != JointKind::Coupling {
            spans[to] = Some(about(0.5 * (low + high), lengths[to]));
            continue;
        }
        // At the end that is nearer, or at the one that is left.
        let wanted = usize::from(z >= 0.5 * (low + high));
        let side =
            if taken[from][wanted] && !taken[from][1 - wanted] { 1 - wanted } else { wanted };
        taken[from][side] = true;
        taken[to][1 - side] = true;
        let (end, sense) = if side == 1 { (high, 1.0) } else { (low, -1.0) };
        let middle = end + sense * (0.5 + GAP) * lengths[to];
        spans[to] = Some(about(middle, lengths[to]));
    }
    spans.into_iter().flatten().map(|[low, high]| 0.5 * (low + high)).collect()
}
