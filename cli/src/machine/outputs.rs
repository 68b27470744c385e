//! Where the points of outputs are on their bodies.

use whirl_codegen::diagnostic::{Diagnostics, Located};
use whirl_solver::output;

use super::plan::BodyPlan;
use crate::case::{Output, Wanted};

/// Places of the points of outputs among the output nodes of their bodies; those of other outputs mean nothing.
/// `point` finds one by its body, its set and its z.
pub(super) fn places(
    outputs: &[Output],
    mut point: impl FnMut(usize, Option<&Located>, Option<f64>) -> usize,
) -> Vec<usize> {
    let place = |own: &Output| match &own.what {
        Wanted::Motion { body, set, z, .. } => point(*body, set.as_ref(), *z),
        _ => 0,
    };
    outputs.iter().map(place).collect()
}

/// The place of the point of a set: its node, or the mean of its nodes.
pub(super) fn on_mesh(plan: &mut BodyPlan, set: &Located, errors: &mut Diagnostics) -> usize {
    match plan.nodes(set, errors).as_slice() {
        [] => 0,
        [node] if !plan.is_cut(set) => plan.output_node(*node),
        nodes => plan.output_mean(set, nodes),
    }
}

/// Outputs with their points at these places.
pub(super) fn placed(outputs: &[Output], places: &[usize]) -> Vec<output::Output<usize>> {
    let made = |(own, &point): (&Output, &usize)| output::Output {
        name: own.name.text().to_owned(),
        what: match &own.what {
            Wanted::Motion { body, motion, frame, components, .. } => output::Wanted::Motion {
                body: *body,
                point,
                motion: *motion,
                frame: *frame,
                components: components.clone(),
            },
            &Wanted::Joint { joint, quantity, frame } => {
                output::Wanted::Joint { joint, quantity, frame }
            }
            &Wanted::Energy { body } => output::Wanted::Energy { body },
            &Wanted::Power { body } => output::Wanted::Power { body },
            &Wanted::JointPower { joint } => output::Wanted::JointPower { joint },
        },
    };
    outputs.iter().zip(places).map(made).collect()
}
