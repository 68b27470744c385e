//! Points of bodies whose motion is wanted beside their outputs.

use whirl_solver::model::Place;

use super::JoinedPlan;
use super::planned_body::PlannedBody;
use super::section::section_at;

/// Points of a body.
#[derive(Debug)]
pub(crate) enum Watched {
    /// Nodes of its mesh.
    Nodes(Vec<usize>),
    /// Places about its axis (m) that move with what it carries, by its place among that, or with a rigid body itself.
    Fixed(Option<usize>, Vec<[f64; 3]>),
    /// The means of its sections at these z (m), or the places on its axis; those of a mesh that has no section there are left out.
    Levels(Vec<f64>),
}

impl Watched {
    /// How many, of nodes and places.
    pub(crate) fn count(&self) -> usize {
        match self {
            Watched::Nodes(own) => own.len(),
            Watched::Fixed(_, own) => own.len(),
            Watched::Levels(own) => own.len(),
        }
    }
}

impl JoinedPlan {
    /// Asks for the motion of points, by bodies in rising order: those of each body are a field of the machine, in their order.
    /// What was written of whole bodies is not.
    pub(crate) fn watch<'a>(&mut self, points: impl Iterator<Item = (usize, &'a Watched)>) {
        self.fields.clear();
        for (place, points) in points {
            let body = &mut self.bodies[place];
            let carried = |at: usize| match &self.attached[place][at].at {
                Place::Mean(mean) => Some(*mean),
                Place::Nodes(_) => None,
            };
            let added: Vec<usize> = match (body, points) {
                (PlannedBody::Meshed(plan), Watched::Nodes(nodes)) => {
                    nodes.iter().map(|node| plan.output_node(*node)).collect()
                }
                (PlannedBody::Meshed(plan), Watched::Fixed(with, all)) => {
                    let mean = with.and_then(carried).expect("a section carries it");
                    all.iter().map(|own| plan.output_on(mean, *own)).collect()
                }
                (PlannedBody::Rigid(plan), Watched::Fixed(_, all)) => {
                    let [x, y, _] = plan.body.centre;
                    all.iter().map(|own| plan.node([own[0] + x, own[1] + y, own[2]])).collect()
                }
                (PlannedBody::Meshed(plan), Watched::Levels(all)) => {
                    let levels = all.iter().filter_map(|z| {
                        let mean = section_at(plan, *z).ok()?;
                        Some(plan.output_on(mean, plan.spec.means[mean].centre()))
                    });
                    levels.collect()
                }
                (PlannedBody::Rigid(plan), Watched::Levels(all)) => {
                    let [x, y, _] = plan.body.centre;
                    all.iter().map(|z| plan.node([x, y, *z])).collect()
                }
                (PlannedBody::Rigid(_), Watched::Nodes(_)) => unreachable!("it has no mesh"),
            };
            if let (Some(first), true) =
                (added.first(), self.fields.last().is_none_or(|own| own.0 != place))
            {
                self.fields.push((place, *first));
            }
        }
    }
}
