//! The machine of bodies by name.

mod attached;
mod bodies;
mod clearance;
mod compare;
mod joints;
mod of_case;
mod others;
mod planes;
mod planned_body;
mod planned_joint;
mod pushing;
mod section;
mod surfaces;

use std::sync::Arc;

use whirl_codegen::diagnostic::{Code, Diagnostics};
use whirl_solver::bearing::{Bearing, OtherMotion, Sides};
use whirl_solver::bodies::Rotation;
use whirl_solver::dynamics::BodyStart;
use whirl_solver::mesh::measure::Circle;
use whirl_solver::model::{Attachment, BodyModel, Form, Model, Place};
use whirl_solver::schedule::Schedule;

pub(crate) use self::planned_body::PlannedBody;
use self::planned_joint::PlannedJoint;
use super::described::Described;
use super::laws::laws_of;
use super::plan::{BodyPlan, geometry};
use super::springs::{self, Laws, angles};
use super::{forces, outputs};
use crate::case::{self, Fields, JoinedMachine, LawSource, Output, Turning};
use crate::errors::Failure;

/// Bodies, joints, drives and loads before the reduction of what has a mesh.
pub(crate) struct JoinedPlan {
    /// In the order of the case.
    pub(crate) bodies: Vec<PlannedBody>,
    /// What each body carries.
    attached: Vec<Vec<Attachment>>,
    /// In the order of the case.
    joints: Vec<PlannedJoint>,
    /// Where each drive acts on its body; of two nodes top, then bottom.
    drives: Vec<Place>,
    /// Where each load acts on its body.
    loads: Vec<Place>,
    /// Places of the points of outputs among the output nodes of their bodies, an output each.
    outputs: Vec<usize>,
    /// Bodies that are written as wholes, with the place of their first node among the output nodes.
    fields: Vec<(usize, usize)>,
    /// The laws with the values with which the joints use them, a joint each.
    pub(crate) laws: Vec<LawSource>,
}

impl JoinedPlan {
    /// Reads or makes the meshes, finds the sets that the case names, and places the joints.
    ///
    /// # Errors
    /// Everything that is wrong with the meshes, every set that is missing or of the wrong size, what does not fit
    /// together, and what is wrong with laws.
    pub(crate) fn new(
        joined: &JoinedMachine,
        (wanted, fields): (&[Output], Option<&Fields>),
        warnings: &mut Vec<String>,
    ) -> Result<JoinedPlan, Failure> {
        warnings.extend(joined.joints.iter().flat_map(pushing::pushes_away));
        warnings.extend(joined.joints.iter().flat_map(|joint| others::on_nothing(joint, joined)));
        let mut errors = Diagnostics::new();
        let mut bodies = bodies::plan(joined, warnings)?;
        let carried = joined.bodies.iter().zip(&mut bodies);
        let attached =
            carried.map(|(own, body)| attached::plan(&own.attached, body, &mut errors)).collect();
        let mut joints = Vec::with_capacity(joined.joints.len());
        for joint in &joined.joints {
            let placed = joints::place(joint, joined, &mut bodies, &mut errors);
            if placed.is_none() && errors.is_empty() {
                // A machine without one of its joints must not run, whatever the reason.
                let message =
                    format!("the joint `{}` cannot be placed on its bodies", joint.name.text());
                errors.push(joint.name.error_here(Code::BAD_VALUE, message));
            }
            joints.extend(placed);
        }
        if joints.len() == joined.joints.len() {
            let placed = joined.joints.iter().zip(&joints);
            warnings.extend(placed.filter_map(|(joint, own)| own.torque_on_frame(joint, &bodies)));
            compare::compare(joined, &joints, &bodies, warnings, &mut errors)?;
        }
        let (mut drives, mut loads) = (Vec::new(), Vec::new());
        for drive in &joined.drives {
            let body = &mut bodies[drive.body];
            if let PlannedBody::Meshed(plan) = &*body {
                geometry::driven(&drive.couple, &plan.mesh, &mut errors);
            }
            drives.push(body.driven(&drive.couple, &mut errors));
        }
        for load in &joined.loads {
            let body = &mut bodies[load.body];
            if let PlannedBody::Meshed(plan) = &*body {
                geometry::loaded_twice(&load.load, &plan.mesh, &mut errors);
            }
            loads.push(body.loaded(load, &mut errors));
        }
        for (joint, own) in joined.joints.iter().zip(&joints) {
            own.add_bore(joint, &mut bodies);
        }
        for (place, body) in bodies.iter_mut().enumerate() {
            body.hold(place, joined, &mut errors);
            if let PlannedBody::Meshed(plan) = &mut *body {
                plan.correct(&mut errors);
            }
        }
        // Last, so that their points are the last nodes of their bodies.
        let outputs = outputs::places(wanted, |body, set, z| match (&mut bodies[body], set) {
            (PlannedBody::Meshed(plan), Some(set)) => outputs::on_mesh(plan, set, &mut errors),
            (PlannedBody::Meshed(_), None) => 0,
            (PlannedBody::Rigid(own), _) => {
                let [x, y, centre] = own.body.centre;
                own.node([x, y, z.unwrap_or(centre)])
            }
        });
        let fields = fields.iter().flat_map(|own| &own.bodies);
        let fields = fields.filter_map(|&body| match &mut bodies[body] {
            PlannedBody::Meshed(plan) => Some((body, plan.output_all())),
            PlannedBody::Rigid(_) => None,
        });
        let fields = fields.collect();
        errors.into_result(())?;
        let measured = joints.iter().map(|joint| (&joint.bearing, joint.measured(&bodies)));
        let laws = laws_of(
            measured.collect(),
            if joined.short { "the bearing, or to `[springs]` for all" } else { "the joint" },
        )?;
        Ok(JoinedPlan { bodies, attached, joints, drives, loads, outputs, fields, laws })
    }

    /// The bodies that have meshes.
    pub(super) fn meshed(&mut self) -> impl Iterator<Item = &mut BodyPlan> {
        self.bodies.iter_mut().filter_map(|body| match body {
            PlannedBody::Meshed(own) => Some(&mut **own),
            PlannedBody::Rigid(_) => None,
        })
    }

    /// Radial clearance of a joint (m), and the circles of journal and bore where the meshes have both.
    pub(crate) fn clearance(&self, joint: usize) -> (f64, Option<[Circle; 2]>) {
        let own = &self.joints[joint];
        (own.bearing.radial_clearance, own.circles)
    }

    /// z of the rings of springs of a joint, or of the planes in which its law acts (m).
    pub(crate) fn stations(&self, joint: usize) -> Vec<f64> {
        let own = &self.joints[joint];
        let [left, _, right] = own.z;
        let along = joints::stations(&own.bearing, [left, right]);
        along.into_iter().map(|part| left + part * (right - left)).collect()
    }

    /// Checks for what would keep the bodies from being reduced, without reducing them.
    ///
    /// # Errors
    /// Cells turned inside out, motions that nothing stops.
    pub(crate) fn verify(&self) -> Result<(), Failure> {
        let mut errors = Diagnostics::new();
        for body in &self.bodies {
            let PlannedBody::Meshed(plan) = body else { continue };
            if plan.rigid {
                continue;
            }
            match plan.verify().map_err(|error| plan.explain(error)) {
                Ok(()) => {}
                Err(Failure::Input(found)) => errors.append(found),
                Err(other) => return Err(other),
            }
        }
        Ok(errors.into_result(())?)
    }
}

/// The case as the solver takes it.
///
/// # Errors
/// Whatever is wrong with laws.
pub(super) fn describe<'a>(
    joined: &'a JoinedMachine,
    wanted: &[Output],
    plan: &'a JoinedPlan,
) -> Result<Described<'a>, Failure> {
    let (mut bodies, mut plans) = (Vec::new(), Vec::new());
    for ((own, planned), carried) in joined.bodies.iter().zip(&plan.bodies).zip(&plan.attached) {
        bodies.push(BodyModel {
            name: own.name.text(),
            form: planned.form(),
            rotation: own.turning.as_ref().map(rotation),
            carried: carried.clone(),
        });
        plans.push(planned.meshed());
    }
    let ground = Form::Ground;
    bodies.push(BodyModel { name: "ground", form: ground, rotation: None, carried: Vec::new() });
    plans.push(None);
    let mut laws = Laws::default();
    let mut bearings = Vec::with_capacity(joined.joints.len());
    for ((joint, own), law) in joined.joints.iter().zip(&plan.joints).zip(&plan.laws) {
        let springs = own.bearing.springs;
        let mut others = Vec::with_capacity(own.others.len());
        for other in &own.others {
            let law = laws.place(&other.law)?;
            others.push(OtherMotion { kind: other.kind, sections: other.sections, law });
        }
        bearings.push(Bearing {
            name: format!("{} {}", joint.kind.words().0, joint.name.text()),
            label: Some(joint.called.label.clone()),
            sides: Sides { run_out: joint.run_out, ..own.sides.clone() },
            journal: own.journal,
            bore: own.bore.clone(),
            clearance: own.bearing.radial_clearance,
            journal_radius: own.bearing.journal_radius,
            stations: joints::stations(&own.bearing, [own.z[0], own.z[2]]),
            angles: joint.angle.map_or_else(|| angles(springs), |angle| vec![angle]),
            law: laws.place(law)?,
            others,
        });
    }
    let loads = joined.loads.iter().zip(&plan.loads);
    let loads = loads.map(|(load, place)| forces::load(load, place));
    let drives = joined.drives.iter().zip(&plan.drives);
    let drives = drives.filter_map(|(drive, place)| forces::drive(drive, place));
    let initial = joined.bodies.iter().map(|body| BodyStart {
        speed: match body.turning {
            Some(Turning::Free { initial_speed }) => initial_speed.unwrap_or(0.0),
            _ => 0.0,
        },
        ..BodyStart::default()
    });
    Ok(Described {
        laws: laws.used(),
        law_hashes: laws.hashes(),
        model: Model {
            bodies,
            motion: joined.motion,
            clearance: springs::clearance(),
            laws: laws.into_laws(),
            bearings,
            loads: loads.chain(drives).collect(),
            gravity: forces::acceleration(joined.gravity.as_ref()),
            outputs: outputs::placed(wanted, &plan.outputs),
            fields: plan.fields.clone(),
        },
        axes: joined.bodies.iter().map(in_space).collect(),
        plans,
        initial: initial.collect(),
        gravity: joined.gravity.as_ref(),
        law_places: joined.joints.iter().map(|joint| &joint.bearing.law.name).collect(),
        bore_places: joined.joints.iter().map(|joint| joint.bearing.bore.as_slice()).collect(),
    })
}

/// x and y in space of where the coordinates of a mesh count from (m): its axis, if it turns.
fn in_space(body: &case::NamedBody) -> [f64; 2] {
    if body.turning.is_some() { body.axis } else { [0.0; 2] }
}

/// How a body turns.
fn rotation(turning: &Turning) -> Rotation {
    match turning {
        Turning::Free { .. } => Rotation::Free,
        Turning::Prescribed { speed, acceleration } => {
            Rotation::Prescribed { speed: *speed, acceleration: *acceleration }
        }
        Turning::Table(columns) => {
            let schedule = Schedule::of_speeds(&columns.rows).expect("rows that rise");
            Rotation::Scheduled(Arc::new(schedule))
        }
    }
}
