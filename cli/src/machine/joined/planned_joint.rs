//! A joint on its bodies.

use std::collections::BTreeSet;

use whirl_codegen::rational::nearest;
use whirl_solver::bearing::Sides;
use whirl_solver::contacts::{FilmNode, pressures};
use whirl_solver::film::Grid;
use whirl_solver::mesh::measure::Circle;
use whirl_solver::reduction::Row;

use super::others::PlannedOther;
use super::planned_body::PlannedBody;
use crate::case::{self, Joint, JointKind, JointSide};
use crate::machine::laws::Measured;
use crate::machine::plan::BodyPlan;
use crate::machine::plan::geometry::nodes_of;
use crate::machine::plan::geometry::stations::Extent;

/// A joint on its bodies.
pub(super) struct PlannedJoint {
    /// The bearing, with its station where it is in one plane.
    pub(super) bearing: case::Bearing,
    /// The bodies, and how their axes stand to each other.
    pub(super) sides: Sides,
    /// Axis of the journal among the nodes of its body (m).
    pub(super) axis: [f64; 2],
    /// Places among the output nodes of the first body.
    pub(super) journal: [usize; 3],
    /// Places among the output nodes of the second body; none of the ground.
    pub(super) bore: [Vec<usize>; 3],
    /// z of the left end, the middle and the right end, m.
    pub(super) z: [f64; 3],
    /// Laws on other motions than the displacement in its planes.
    pub(super) others: Vec<PlannedOther>,
    /// The nodes of a film under which the bore gives way.
    pub(super) film: Option<Grid>,
    /// The circles of journal and bore, where the meshes have both.
    pub(super) circles: Option<[Circle; 2]>,
}

impl PlannedJoint {
    /// Adds the bore to what its body knows of bores.
    pub(super) fn add_bore(&self, joint: &Joint, bodies: &mut [PlannedBody]) {
        let acts = matches!(joint.kind, JointKind::Bearing | JointKind::Stop);
        let Some(PlannedBody::Meshed(plan)) = bodies.get_mut(self.sides.bodies[1]) else { return };
        let rings: (Vec<Vec<usize>>, Option<String>) = match &self.sides.surface {
            Some(_) => {
                let set = joint.sides[1].sets.first();
                let nodes = set.and_then(|set| nodes_of(&plan.mesh, set)).map(<[usize]>::to_vec);
                (nodes.into_iter().collect(), set.map(|set| set.text().to_owned()))
            }
            None => (self.bore.iter().map(|ring| plan.mesh_nodes(ring)).collect(), None),
        };
        if acts {
            let name = joint.name.text().to_owned();
            let pressures = self.pressures(plan);
            plan.add_bore(name, self.sides.bore_axis, (rings.0, rings.1, pressures));
        }
    }

    /// The pressures of a film under which the bore gives way.
    fn pressures(&self, plan: &BodyPlan) -> Vec<Row> {
        let (Some(surface), Some(grid)) = (&self.sides.surface, &self.film) else {
            return Vec::new();
        };
        let places = grid.places().into_iter().zip(grid.areas());
        let nodes = places.zip(&surface.film).map(|(([angle, z], area), point)| {
            let places: Vec<usize> = point.iter().map(|(place, _)| *place).collect();
            let weights = point.iter().map(|(_, weight)| *weight);
            let point = plan.mesh_nodes(&places).into_iter().zip(weights).collect();
            FilmNode { angle, along: 2.0 * z / grid.length, area, point }
        });
        pressures(&nodes.collect::<Vec<FilmNode>>())
    }

    /// Where its rings may stand: between the ends of what its meshes have; along a rigid journal over the length of the
    /// bearing, if that is known.
    pub(super) fn extent(&self, joint: &Joint, bodies: &[PlannedBody]) -> Extent {
        let meshed = |side: &JointSide| {
            !side.sets.is_empty() && side.body.is_some_and(|body| bodies[body].meshed().is_some())
        };
        let [left, middle, right] = self.z;
        let on_mesh = joint.sides.iter().any(meshed);
        if !on_mesh && self.bearing.stations.len() > 1 {
            let length = self.bearing.facts.length.as_ref().map(nearest);
            return length.map_or(Extent::Open, |length| {
                Extent::Ends([middle - 0.5 * length, middle + 0.5 * length])
            });
        }
        match left == right {
            true => Extent::plane(middle, self.bearing.journal_radius),
            false => Extent::Ends([left, right]),
        }
    }

    /// A warning where the torque of a joint finds no section of its journal to act on.
    pub(super) fn torque_on_frame(&self, joint: &Joint, bodies: &[PlannedBody]) -> Option<String> {
        let plan = bodies[self.sides.bodies[0]].meshed().filter(|plan| !plan.rigid)?;
        let torque = !matches!(joint.kind, JointKind::Coupling | JointKind::Gear)
            && self.bearing.law.source.gives_torque();
        (torque && self.sides.torque_section.is_none()).then(|| {
            format!(
                "{}: the nodes of the journal of `{}` define no rotation of a section of {}: the torque of its law \
                 turns the body as a whole and does not twist it; name sets of nodes around the axis",
                joint.name.source().path.display(),
                joint.name.text(),
                plan.mesh.origin()
            )
        })
    }

    /// What meshes say of it.
    pub(super) fn measured(&self, bodies: &[PlannedBody]) -> Measured {
        let [x, y] = self.sides.bore_axis;
        let bore = match bodies.get(self.sides.bodies[1]) {
            Some(PlannedBody::Meshed(plan)) => {
                let points = self.sides.surface.iter().flat_map(|own| own.points.iter().flatten());
                let on_faces = points.flatten().map(|&(place, _)| place);
                let all: BTreeSet<usize> =
                    self.bore.iter().flatten().copied().chain(on_faces).collect();
                let positions = all.into_iter().map(|place| plan.position(place));
                positions.map(|position| [position[0] - x, position[1] - y]).collect()
            }
            _ => Vec::new(),
        };
        Measured { bore, ends: [self.z[0], self.z[2]] }
    }
}
